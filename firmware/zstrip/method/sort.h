/* Sorting the triangles of a pool, and taking triangles out of it. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_METHOD_SORT_H
#define ZS_METHOD_SORT_H

#include "core/bin.h"

/* The largest zs_vertex.d of triangle t of the pool. */
static inline uint32_t zs_sort_farthest(const struct zs_renderer *r, uint32_t t)
{
    const uint16_t *v = r->tri[t].v;
    return zs_maxu32(zs_maxu32(r->vert[v[0]].d, r->vert[v[1]].d), r->vert[v[2]].d);
}

/* Merge two lists that are sorted from far to near. Of equally far triangles, those that are first
 * in the pool come first. */
uint16_t zs_sort_merge(const struct zs_renderer *r, uint16_t a, uint16_t b);
/* Sort a list like that, and count its triangles in r->stats.sorted. n log n. */
uint16_t zs_sort_list(struct zs_renderer *r, uint16_t list);
/* Remove the triangles with next == ZS_NIL from the pool. The others keep their order, and are all
 * binned in r->strip. */
void zs_sort_pack(struct zs_renderer *r);

/* ---- The farthest triangles, in bounded memory ----------------------------------------------
 *
 * If the pools cannot hold a strip's triangles, several walks draw them. Each walk keeps the
 * farthest among those that are not drawn yet. A walk has two limits:
 *   drawn  what earlier walks have drawn: triangles farther than d, and the first `ties` triangles
 *          in scene order that are as far as d;
 *   near   once a pool is full, the nearest triangles are dropped. Those that are as near as one
 *          that was dropped, or nearer, are left to later walks. Of equally far ones, the later in
 *          scene order are dropped; those that follow them in the walk are later still.
 * A full pool keeps at least one triangle, the farthest so far, and has room for one more. So each
 * walk draws at least one triangle. */
struct zs_farthest {
    uint32_t d, ties; /* the limit `drawn`, if `again` ... */
    uint32_t passed;  /* ... and how many triangles as far as d this walk has met */
    uint32_t near;    /* the limit `near`, if `dropped` */
    uint32_t sifted;  /* the pool's first triangles, which belong to this walk */
    uint8_t again;    /* 1: an earlier walk has drawn some */
    uint8_t dropped;  /* 1: this walk has dropped triangles */
};

/* Return 1 if triangle t of the pool reaches the columns that are drawn, and is neither drawn yet
 * nor left to a later walk. To be called
 * once for each triangle, in pool order. */
int zs_farthest_belongs(const struct zs_renderer *r, struct zs_farthest *f, uint32_t t);
/* All triangles of the pool belong to this walk: drop the nearest, until a quarter of both pools is
 * free or one triangle is left. With one triangle, at least three vertices are free. */
void zs_farthest_room(struct zs_renderer *r, struct zs_farthest *f);
/* The limits of the next walk, after one that has dropped triangles and whose pool is drawn. */
struct zs_farthest zs_farthest_next(const struct zs_renderer *r, const struct zs_farthest *f);

#endif
