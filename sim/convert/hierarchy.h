/* A hierarchy of spheres over a mesh's triangles, for ray casting.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_HIERARCHY_H
#define SIM_HIERARCHY_H

#include "cluster.h"

#define SIM_LEAF_TRIS 8u

/* Order clusters, and triangles within them, by halves of their number along the longest side of
 * their box; down to leaves of at most SIM_LEAF_TRIS triangles.
 *
 * order    [n_tris], of sim_cluster: permuted
 * cluster  [n_clusters], permuted, `first` set anew
 * Return   malloc'ed [*n], in preorder: spheres hold every vertex after rounding. */
struct zs_bvh_node *sim_hierarchy(uint32_t *n, uint32_t *order, struct zs_cluster *cluster,
                                  uint32_t n_clusters, const struct sim_shape *shape);

#endif
