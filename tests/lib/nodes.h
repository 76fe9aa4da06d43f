/* A hierarchy of spheres over a mesh's triangles as they are, for ray casting.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_NODES_H
#define TESTS_NODES_H

#include "zs_method.h"
#include "zstrip.h"

/* Halves, again and again, down to leaves of at most so many triangles, from at[0] on. Return the number of nodes; 0:
 * no room, a vertex that there is not, a sphere that is too large, or no triangles. */
uint32_t nodes_make(struct zs_bvh_node *at, uint32_t room, const struct zs_mesh *m, uint32_t leaf);

#endif
