/* Of meshoptimizer's interface what zsim convert calls for every model, for machines that the library is not built for:
 * sim/web/meshlets.c does the same to the bit.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_MESHOPTIMIZER_H
#define WEB_MESHOPTIMIZER_H

#include <stddef.h>

struct meshopt_Meshlet {
    unsigned vertex_offset, triangle_offset, vertex_count, triangle_count;
};

struct meshopt_Bounds {
    float center[3], radius;
    float cone_apex[3], cone_axis[3], cone_cutoff;
    signed char cone_axis_s8[3], cone_cutoff_s8;
};

size_t meshopt_buildMeshletsBound(size_t n_index, size_t most_verts, size_t most_tris);
size_t meshopt_buildMeshlets(struct meshopt_Meshlet *set, unsigned *vertex, unsigned char *corner, const unsigned *index,
                             size_t n_index, const float *point, size_t n_verts, size_t stride, size_t most_verts,
                             size_t most_tris, float cone_weight);
struct meshopt_Bounds meshopt_computeClusterBounds(const unsigned *index, size_t n_index, const float *point,
                                                   size_t n_verts, size_t stride);
size_t meshopt_optimizeVertexFetchRemap(unsigned *to, const unsigned *index, size_t n_index, size_t n_verts);

struct meshopt_VertexCacheStatistics {
    unsigned vertices_transformed, warps_executed;
    float acmr, atvr;
};
struct meshopt_VertexCacheStatistics meshopt_analyzeVertexCache(const unsigned *index, size_t n_index, size_t n_verts,
                                                                unsigned cache, unsigned warp, unsigned primitive);

#endif
