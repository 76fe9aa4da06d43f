/* One mesh before a camera, as measurements have it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ONE_H
#define SIM_ONE_H

#include "zstrip.h"

/* The scene points at the instance, and that at mesh and material: keep it where it is. */
struct sim_one {
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
};

/* A mesh without vertices at the origin, unturned, its front sides in the colours that it gives, in a frame of width x
 * height px as sim_frame_config has it, with room for a texture. The camera is all 0. */
void sim_one_open(struct sim_one *one, uint16_t width, uint16_t height);

#endif
