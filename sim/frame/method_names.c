/* Methods of hidden-surface removal by name. What the gallery says of each stands here, the rest in ZS_METHOD_EACH.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method_names.h"

#include <stddef.h>

#define ABOUT_hiz \
    .keys = 1, .title = "Hierarchical depth buffer", \
    .take = "Take it for programs without accelerators in whose scenes much is hidden. Beside the accelerators touch " \
            "and tiles, whose memory it takes, it does not pay.", \
    .fails = "As the depth buffer, bit for bit."
#define ABOUT_painter \
    .title = "Painter's algorithm", \
    .take = "Take it for small parts that hold no depth memory and scenes of separate things. It costs a sort of " \
            "each strip's triangles.", \
    .fails = "Triangles that intersect, overlap in a cycle, or reach far behind what they cover are drawn in the " \
             "wrong order."
#define ABOUT_depthsort \
    .title = "Depth sort", \
    .take = "Take it where depth memory does not fit and surfaces cross or overlap in a cycle. Triangles are split " \
            "where no order is right; it costs a comparison of each pair whose depths overlap.", \
    .fails = "As the depth buffer, but with finer depths. Many triangles whose depths overlap take long."
#define ABOUT_coverage \
    .title = "Coverage", \
    .take = "Take it for many layers and dear shaders without depth memory: depth sort's list from near to far, so " \
            "that each pixel is coloured once.", \
    .fails = "As depth sort; a shader that mixes with what is there sees the background alone."
#define ABOUT_raycast \
    .title = "Ray casting", \
    .take = "Take it to see what the other order of the loops costs: for each pixel the nearest triangle, in place " \
            "of, for each triangle, its pixels.", \
    .fails = "Shaders that mix with what is there see the background alone: each pixel is coloured once."

const struct sim_method sim_methods[SIM_METHODS] = {
    { .name = "zbuffer",
      .keys = 1,
      .title = "Depth buffer",
      .take = "Take it when in doubt: it is right for any scene, in any order, and the fastest for most. It costs two "
              "bytes a pixel of a strip.",
      .fails = "Surfaces closer than a bucket of depth are sorted by scene order." },
#define ROW(name_, depth_, tris_, verts_, records_) \
    { .name = #name_, .method = &zs_method_##name_, .depth = depth_, .least_tris = tris_, .least_verts = verts_, \
      .records = records_, ABOUT_##name_ },
    ZS_METHOD_EACH(ROW)
#undef ROW
};

const struct sim_method *sim_method_of(const struct zs_config *config)
{
    for (size_t k = 0; k < SIM_METHODS; k++)
        if (sim_methods[k].method == config->method)
            return &sim_methods[k];
    return NULL;
}

void sim_method_apply(struct zs_config *config, const struct sim_method *method)
{
    config->method = method->method;
    if (method->depth)
        config->depth = method->depth;
    if (config->max_tris < method->least_tris)
        config->max_tris = method->least_tris;
    if (config->max_verts < method->least_verts)
        config->max_verts = method->least_verts;
}

uint16_t sim_method_pool(const struct sim_method *method, uint32_t used)
{
    const uint32_t n = method->records ? used * 5 / 2 + 64 : used > 0 ? used : 1;
    return (uint16_t)(n < ZS_POOL_MAX ? n : ZS_POOL_MAX);
}
