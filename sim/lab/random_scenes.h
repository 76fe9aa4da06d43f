/* Random scenes: scene n is seed n, everywhere the same.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RANDOM_SCENES_H
#define SIM_RANDOM_SCENES_H

#include "zstrip.h"

#define SCATTER_INSTANCES 60
#define SCATTER_MESHES 6
#define SCATTER_TEXTURES 3

struct sim_scatter_mesh;

/* Points into itself: keep it where it is. */
struct sim_scatter {
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
    struct zs_instance instance[SCATTER_INSTANCES];
    struct zs_material material[SCATTER_INSTANCES];
    struct zs_texture texture[SCATTER_TEXTURES];
    struct sim_scatter_mesh *mesh; /* [SCATTER_MESHES] */
    uint16_t *texel;               /* 256 x 256, RGB565 */
    uint8_t *number;               /* 64 x 32, into the palette */
    uint16_t palette[16];
    int textured; /* 1: an instance is */
};

/* Memory for scenes; sim_scatter_free frees it. */
void sim_scatter_alloc(struct sim_scatter *s);
void sim_scatter_free(struct sim_scatter *s);

/* 3 to 60 instances of soups, boxes, balls, ribbons and grounds, from sub-pixel to more than the
 * frame, before, around and behind near and beyond far, under a random lens, mapping and pools. */
void sim_scatter_make(struct sim_scatter *s, uint64_t seed, uint16_t width, uint16_t height);

#endif
