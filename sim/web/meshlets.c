/* meshoptimizer's part: not there yet.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>

#include "meshoptimizer.h"
#include "sim.h"

size_t meshopt_buildMeshletsBound(size_t n_index, size_t most_verts, size_t most_tris)
{
    (void)n_index;
    (void)most_verts;
    (void)most_tris;
    (void)sim_refuse(NULL, 0, "models are not there yet");
    exit(SIM_REFUSED);
}

size_t meshopt_buildMeshlets(struct meshopt_Meshlet *set, unsigned *vertex, unsigned char *corner, const unsigned *index,
                             size_t n_index, const float *point, size_t n_verts, size_t stride, size_t most_verts,
                             size_t most_tris, float cone_weight)
{
    (void)set, (void)vertex, (void)corner, (void)index, (void)n_index, (void)point, (void)n_verts, (void)stride;
    (void)most_verts, (void)most_tris, (void)cone_weight;
    return 0;
}

struct meshopt_Bounds meshopt_computeClusterBounds(const unsigned *index, size_t n_index, const float *point,
                                                   size_t n_verts, size_t stride)
{
    (void)index, (void)n_index, (void)point, (void)n_verts, (void)stride;
    return (struct meshopt_Bounds){ 0 };
}

size_t meshopt_optimizeVertexFetchRemap(unsigned *to, const unsigned *index, size_t n_index, size_t n_verts)
{
    (void)to, (void)index, (void)n_index, (void)n_verts;
    return 0;
}
