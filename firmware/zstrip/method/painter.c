/* Painter's algorithm: the triangles of a strip are drawn from far to near.
 *
 * The order of two triangles is that of their farthest vertices (zs_vertex.d); on a tie, scene
 * order. It is the same in every strip. Within the pools, scene order is pool order.
 *
 * Pools that cannot hold a strip's triangles: method/sort.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/method.h"
#include "core/raster.h"
#include "core/walk.h"
#include "method/sort.h"
#include "zs_method.h"

/* The strip's triangles, sorted. r->active is sorted already: it was appended to in the order of
 * drawing. */
static uint16_t painter_list(struct zs_renderer *r)
{
    const uint16_t list = zs_sort_merge(r, r->active, zs_sort_list(r, r->bin[r->strip]));
    r->bin[r->strip] = ZS_NIL;
    return list;
}

/* ---- Bounded memory -------------------------------------------------------------------------- */

/* Remove what does not belong to this walk from the triangles that were binned since the last call.
 */
static void sift(struct zs_renderer *r)
{
    struct zs_farthest *f = r->method_state;
    for (uint32_t t = 0; t < r->n_tris; t++)
        r->tri[t].next = t < f->sifted || zs_farthest_belongs(r, f, t) ? 0 : ZS_NIL;
    zs_sort_pack(r);
    f->sifted = r->n_tris;
}

static void painter_full(struct zs_renderer *r)
{
    sift(r);
    zs_farthest_room(r, r->method_state);
}

static void painter_strip(struct zs_renderer *r)
{
    struct zs_farthest f = { .again = 0 };
    r->method_state = &f;
    if (r->strip >= r->band_end) {
        zs_walk(r, r->draw_end);
        if (f.dropped)
            sift(r);
    }
    zs_raster_strip(r);
    while (f.dropped) {
        f = zs_farthest_next(r, &f);
        zs_walk(r, (uint16_t)(r->strip + 1u));
        sift(r);
        zs_raster_strip(r);
    }
}

static int painter_begin(struct zs_renderer *r)
{
    if (r->config.depth != &zs_depth_none)
        return ZS_ERR_DEPTH;
    return r->config.max_tris >= 2 && r->config.max_verts >= 6 ? ZS_OK : ZS_ERR_SIZE;
}

const struct zs_method zs_method_painter = {
    .begin = painter_begin, .strip = painter_strip, .full = painter_full, .list = painter_list
};
