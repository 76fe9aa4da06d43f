/* Methods of hidden-surface removal by name.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method_names.h"

const struct sim_method sim_methods[SIM_METHODS] = {
    { .name = "zbuffer", .title = "Depth buffer",
      .take = "Take it when in doubt: it is right for any scene, in any order, and the fastest here. It costs two bytes "
              "a pixel of a strip.",
      .fails = "Surfaces closer than a bucket of depth are sorted by scene order." },
    { .name = "painter", .method = &zs_method_painter, .depth = &zs_depth_none, .least_tris = 2, .least_verts = 6,
      .title = "Painter's algorithm",
      .take = "Take it for small parts that hold no depth memory and scenes of separate things. It costs a sort of each "
              "strip's triangles.",
      .fails = "Triangles that intersect, overlap in a cycle, or reach far behind what they cover are drawn in the wrong "
               "order." },
};

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
