/* The depth buffer as a method of hidden-surface removal: the usual one.
 *
 * Lists are kept in pool order, which is scene order. So a strict depth comparison gives each pixel
 * to the least (key, scene order), and the triangles of a strip may be drawn in several sets.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/method.h"
#include "core/raster.h"
#include "core/walk.h"

/* Reverse a list. */
static uint16_t reversed(struct zs_tri *tri, uint16_t list)
{
    uint16_t out = ZS_NIL;
    while (list != ZS_NIL) {
        const uint16_t next = tri[list].next;
        tri[list].next = out;
        out = list;
        list = next;
    }
    return out;
}

/* Merge two ascending lists. */
static uint16_t merged(struct zs_tri *tri, uint16_t a, uint16_t b)
{
    uint16_t head = ZS_NIL, *tail = &head;
    while (a != ZS_NIL && b != ZS_NIL) {
        uint16_t *least = a < b ? &a : &b;
        *tail = *least;
        tail = &tri[*least].next;
        *least = *tail;
    }
    *tail = a != ZS_NIL ? a : b;
    return head;
}

/* Take the strip's triangles, in scene order. */
uint16_t zs_scene_list(struct zs_renderer *r)
{
    const uint16_t list = merged(r->tri, r->active, reversed(r->tri, r->bin[r->strip]));
    r->bin[r->strip] = ZS_NIL;
    return list;
}

static ZS_RARE void buffer_strip(struct zs_renderer *r)
{
    if (r->strip >= r->band_end)
        zs_walk(r, r->draw_end);
    zs_raster_strip(r);
}

void zs_buffer_full(struct zs_renderer *r)
{
    zs_raster_strip(r);
    zs_bin_empty(r);
    r->stats.passes++;
}

const struct zs_method zs_method_buffer = { .strip = buffer_strip,
                                            .full = zs_buffer_full,
                                            .list = zs_scene_list,
                                            .passes = 1,
                                            .buffer = 1 };
