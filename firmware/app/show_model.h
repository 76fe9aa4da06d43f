/* The show of a model that is put beside the program in flash: at SHOW_MODEL lies a struct show_model, and what it
 * points to, with the addresses that they have there. The program is linked once; sim/web/page/uf2.js puts a model into
 * its image.
 *
 * Pointers are those of the part, 32 bits; the engine of sim/web, whose pointers are as wide, fills the same structs.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SHOW_MODEL_H
#define SHOW_MODEL_H

#include "pieces.h"
#include "show.h"

#define SHOW_MODEL 0x10040000u      /* where: 256 KB into the Pico's flash */
#define SHOW_MODEL_MAGIC 0x316c646du /* "mdl1" */

/* One frame of the animation. */
struct show_view {
    struct zs_camera camera;
    struct zs_light light;
    const struct zs_instance *instance; /* [scene.n_instances]: seen from elsewhere, the world unit may be another one,
                                           and so scales, or lamps stand elsewhere */
};

struct show_model {
    struct show show; /* arena, scratch, rows, pools: the program's arrays; demo is &piece.demo */
    struct piece piece; /* pose is show_model_pose */
    uint32_t magic;
    struct zs_scene scene; /* of all frames, but for what struct show_view has */
    const struct show_view *view; /* [piece.demo.frames] */
};

/* The same struct on both machines. */
_Static_assert(sizeof(void *) != 4 || (sizeof(struct show_view) == 112 && sizeof(struct show_model) == 128 &&
                                       sizeof(struct zs_instance) == 64 && sizeof(struct zs_mesh) == 72 &&
                                       sizeof(struct zs_material) == 16 && sizeof(struct zs_texture) == 20),
               "structs of a model in flash have another layout");

#endif
