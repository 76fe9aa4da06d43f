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

#endif
