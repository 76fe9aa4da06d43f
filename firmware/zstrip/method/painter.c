/* Painter's algorithm: the triangles of a strip are drawn from far to near.
 *
 * The order of two triangles is that of their farthest vertices (zs_vertex.d); on a tie, scene
 * order. It is the same in every strip. Within the pools, scene order is pool order.
 *
 * Bounded memory. If the pools cannot hold a strip's triangles, several walks draw the strip. Each
 * walk keeps the farthest triangles among those that are not drawn yet. A walk has two limits:
 *   drawn  what earlier walks have drawn: triangles farther than drawn.d, and the first drawn.ties
 *          triangles in scene order that are as far as drawn.d;
 *   near   once a pool is full, the nearest triangles are dropped. Those that are as near as one
 *          that was dropped, or nearer, are left to later walks. Of equally far ones, the later in
 *          scene order are dropped; those that follow them in the walk are later still.
 * A full pool keeps at least one triangle, the farthest so far, and has room for one more. So each
 * walk draws at least one triangle.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/method.h"
#include "core/raster.h"
#include "core/walk.h"
#include "method/sort.h"
#include "zs_method.h"

struct state {
    uint32_t d, ties; /* the limit `drawn` ... */
    uint32_t passed;  /* ... and how many triangles as far as drawn.d this walk has met */
    uint32_t near;    /* the limit `near`, if `dropped` */
    uint32_t sifted;  /* the pool's first triangles, which belong to this walk */
    uint8_t again;    /* 1: an earlier walk has drawn a part of the strip */
    uint8_t dropped;  /* 1: this walk has dropped triangles */
};

/* The strip's triangles, sorted. r->active is sorted already: it was appended to in the order of
 * drawing. */
static uint16_t painter_list(struct zs_renderer *r)
{
    const uint16_t list = zs_sort_merge(r, r->active, zs_sort_list(r, r->bin[r->strip]));
    r->bin[r->strip] = ZS_NIL;
    return list;
}

/* ---- Bounded memory -------------------------------------------------------------------------- */

/* Return 1 if triangle t of the pool is neither drawn yet nor left to a later walk. To be called
 * once for each triangle, in pool order. */
static int belongs(const struct zs_renderer *r, struct state *s, uint32_t t)
{
    const uint32_t d = zs_sort_farthest(r, t);
    if (s->dropped && d <= s->near)
        return 0;
    if (!s->again || d < s->d)
        return 1;
    return d == s->d && s->passed++ >= s->ties;
}

/* Remove what does not belong to this walk from the triangles that were binned since the last call.
 */
static void sift(struct zs_renderer *r)
{
    struct state *s = r->method_state;
    for (uint32_t t = 0; t < r->n_tris; t++)
        r->tri[t].next = t < s->sifted || belongs(r, s, t) ? 0 : ZS_NIL;
    zs_sort_pack(r);
    s->sifted = r->n_tris;
}

/* Keep the first n triangles of a sorted list, and drop the others. */
static void keep_first(struct zs_renderer *r, uint16_t list, uint32_t n)
{
    struct state *s = r->method_state;
    for (uint32_t k = 0; list != ZS_NIL; k++) {
        const uint16_t next = r->tri[list].next;
        if (k == n)
            s->near = zs_sort_farthest(r, list);
        r->tri[list].next = k < n ? 0 : ZS_NIL;
        list = next;
    }
    zs_sort_pack(r);
    s->sifted = n;
    s->dropped = 1;
}

/* Drop the nearest triangles, until a quarter of both pools is free or one triangle is left. With
 * one triangle, at least three vertices are free. */
static void painter_full(struct zs_renderer *r)
{
    const uint32_t tris = r->config.max_tris, verts = r->config.max_verts;
    sift(r);
    for (uint32_t n; (n = r->n_tris) > 1 && (tris - n < tris / 4u + 1u ||
                                             verts - r->n_verts < verts / 4u + 3u);)
        keep_first(r, zs_sort_list(r, r->bin[r->strip]), n - n / 4u - 1u);
}

/* After a set that is not the strip's last one: set the limit of what is drawn, and walk again. */
static void next_set(struct zs_renderer *r)
{
    struct state *s = r->method_state;
    uint32_t ties = s->again && s->d == s->near ? s->ties : 0u;
    for (uint32_t t = 0; t < r->n_tris; t++)
        ties += zs_sort_farthest(r, t) == s->near;
    const struct state next = { .d = s->near, .ties = ties, .again = 1 };
    *s = next;
    zs_walk(r, (uint16_t)(r->strip + 1u));
    sift(r);
}

static void painter_strip(struct zs_renderer *r)
{
    struct state s = { .again = 0 };
    r->method_state = &s;
    if (r->strip >= r->band_end) {
        zs_walk(r, r->draw_end);
        if (s.dropped)
            sift(r);
    }
    zs_raster_strip(r);
    while (s.dropped) {
        next_set(r);
        zs_raster_strip(r);
    }
}

static int painter_begin(struct zs_renderer *r)
{
    if (!r->config.depth->span) /* the mapping has depth memory */
        return ZS_ERR_DEPTH;
    return r->config.max_tris >= 2 && r->config.max_verts >= 6 ? ZS_OK : ZS_ERR_SIZE;
}

const struct zs_method zs_method_painter = { .begin = painter_begin,
                                             .strip = painter_strip,
                                             .full = painter_full,
                                             .list = painter_list };
