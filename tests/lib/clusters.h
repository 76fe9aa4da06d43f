/* Clusters of a mesh as it is: runs of its triangles, with spheres, cones and heights as tight as the format has them,
 * or a little larger. Doubles, checked by zs_mesh_check.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_CLUSTERS_H
#define TESTS_CLUSTERS_H

#include "prng.h"
#include "zs_check.h"
#include "zstrip.h"

/* Fill out[n_tris], and the mesh's fields. Runs of 1 .. most triangles. loose: 1 in how many is made larger; 0:
 * none. */
void clusters_make(struct zs_mesh *mesh, struct zs_cluster *out, struct prng *p, uint32_t most, uint32_t loose);

#endif
