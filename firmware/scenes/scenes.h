/* Demo and bench scenes: const meshes, animated with integers alone.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SCENES_H
#define SCENES_H

#include "zs_fast.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DEMO_INSTANCES_MAX 16u

/* What one frame of a scene is drawn from. scene.instance points into this struct. */
struct demo_frame {
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_instance instance[DEMO_INSTANCES_MAX];
};

struct demo {
    const char *name;             /* lower case, unique: also a file name */
    const char *what;             /* one sentence, no full stop */
    uint16_t width, height;       /* px it was composed for; others work */
    uint16_t frames;              /* of its animation, which then repeats; 1 .. */
    uint16_t varyings;               /* config.varyings that its shaders need */
    uint16_t bench;               /* 1: a bench scene */
    const struct zs_depth *depth; /* the mapping that its camera takes */
    const struct zs_fast *const *fast; /* accelerators for what is in it, the last one NULL */
    /* Fill *f for frame t (any; taken modulo frames) of a w x h px picture. */
    void (*pose)(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h);
};

extern const struct demo *const demos[]; /* [n_demos] */
extern const uint32_t n_demos;

/* One by one, so that a firmware which shows a single scene links the meshes of that one alone. */
extern const struct demo demo_teapot, demo_cubes, demo_knot, demo_flyover, demo_city,
    demo_hall, demo_globe, demo_china;
extern const struct demo demo_mesh, demo_mesh_lit, demo_mesh_tex, demo_mesh_tex_lit, demo_mesh_tex_smooth,
    demo_crowd_ftb, demo_crowd_btf, demo_floor_tex, demo_layers_ftb, demo_layers_btf, demo_layers_mixed, demo_sheet,
    demo_corridor, demo_slivers, demo_relief, demo_relief_tex;

#ifdef __cplusplus
}
#endif

#endif
