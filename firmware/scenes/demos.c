/* The table of all scenes: those to look at first, then the bench.
 *
 * SPDX-License-Identifier: MIT
 */
#include "scenes.h"

const struct demo *const demos[] = {
    &demo_teapot,          &demo_cubes,     &demo_knot,       &demo_flyover,   &demo_city,      &demo_hall,
    &demo_globe,           &demo_china,     &demo_mesh,       &demo_mesh_lit,  &demo_mesh_tex,  &demo_mesh_tex_lit,
    &demo_mesh_tex_smooth, &demo_floor_tex, &demo_layers_ftb, &demo_crowd_ftb, &demo_crowd_btf, &demo_layers_btf,
    &demo_layers_mixed,    &demo_sheet,     &demo_corridor,   &demo_slivers,   &demo_relief,    &demo_relief_tex,
};
const uint32_t n_demos = sizeof demos / sizeof demos[0];
