/* Set-up of cluster culling. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_CLUSTERS_H
#define ZS_FAST_CLUSTERS_H

#include "core/cull.h"

#define ZS_PLANE_BITS 12 /* of struct zs_clusters.plane */
#define ZS_EYE_SHIFT_MAX 20 /* of eye_shift, without that of orthographic cameras */

/* zs_fast_clusters.edges and open (core/fast.h). */
int zs_cluster_edges(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number);
int zs_cluster_open(struct zs_renderer *r, const struct zs_bounds *b);

/* While vertex v is vert[vert_base + v]: forget the marks of the current mesh's vertices; mark
 * those of triangles [from, to); transform those that are marked, and return the last one's number
 * + 1. */
void zs_mark_none(struct zs_renderer *r);
void zs_mark_verts(struct zs_renderer *r, uint32_t from, uint32_t to);
uint32_t zs_marked_verts(struct zs_renderer *r);

#endif
