/* A model's scene with what the options of effects ask for.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_EFFECT_SCENE_H
#define SIM_EFFECT_SCENE_H

#include "frame.h"
#include "framing.h"
#include "quantise.h"
#include "render_options.h"
#include "zs_pass.h"

#define SIM_PASSES_MAX 3

struct sim_effect_surface; /* materials of the effect that the model's surface has */

struct sim_effect_ground; /* a floor and what is on it */
struct sim_effect_hooks;  /* what is done to strips that are drawn */

struct sim_effect_scene {
    struct zs_scene scene;        /* of the first pass */
    struct zs_scene later[SIM_PASSES_MAX - 1];
    struct zs_pass pass[SIM_PASSES_MAX];
    uint32_t n_passes;            /* 1: one frame, without passes */
    struct zs_camera camera;
    struct zs_instance *model;    /* its parts */
    struct zs_instance *instance; /* of all passes */
    struct zs_mesh *ghost;        /* without triangles, of parts that a pass has for their reach alone */
    struct sim_effect_surface *surface;
    struct sim_effect_hooks *hooks;
    struct sim_effect_ground *ground; /* NULL: none */
    uint8_t varyings;                 /* least that the configuration has to have */
    const struct zs_method *method;   /* NULL: the depth buffer */
    long samples;                     /* a pixel, 1 or 4 */
};

/* Make a scene from one of the model, which it borrows. It points into *out: do not move it.
 * Return  SIM_OK; SIM_REFUSED, said why. sim_effect_free in either case. */
int sim_effect_make(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                    const struct sim_view *view, const struct sim_options *o);
void sim_effect_free(struct sim_effect_scene *scene);

/* Pools that hold in one pass all that it draws: the model, the floor, shadows, and the model in a mirror. */
struct sim_pools sim_effect_pools(const struct sim_effect_scene *scene, const struct sim_model *model,
                                  const struct sim_scene *from, const struct sim_view *view);

/* Make the configuration of a plain frame the one that it is drawn by, and its camera and hooks those of that frame.
 * ZS_OK, or an error of zs_fog_set. */
int sim_effect_config(struct sim_effect_scene *scene, struct zs_config *config);

/* Draw it; config is that of a plain frame. Return as sim_frame_render_to. */
int sim_effect_draw(const struct sim_effect_scene *scene, struct sim_frame *frame, const struct zs_config *config,
                    const char *what, const struct zs_sink *to);

#endif
