/* What an effect scene is made of, shared by the files that make it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_EFFECT_PARTS_H
#define SIM_EFFECT_PARTS_H

#include "effect_scene.h"
#include "floor.h"
#include "light_map.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_fog.h"
#include "zs_lights.h"

/* One material for each of the model's, in the form that its shader takes. */
struct sim_effect_surface {
    struct zs_blend *blend;
    struct zs_material *plain; /* with another shader */
    struct zs_lit_material *lit;
    struct zs_lamp lamp[SIM_LIGHTS_MAX];
    struct zs_lighting lighting;
    struct zs_shine shine;
    struct zs_texture environment; /* its texels are its own */
    struct zs_texture *leveled;    /* [n_leveled], with mipmap levels of their own */
    uint32_t n_leveled;
    struct zs_mesh *mesh; /* of the parts, with uv_bits for it */
};

/* What is drawn beside the model. */
struct sim_effect_ground {
    struct sim_floor floor;
    struct zs_mesh *shadow; /* of each of the model's parts */
    int16_t (**pos)[3];     /* its vertices */
    uint32_t n_shadows;
    struct zs_material shade;
    struct zs_mirror mirror;
    struct zs_scene seen; /* in the mirror */
    struct sim_light_map map;
    struct zs_shadowed_material *shadowed; /* of the floor, and of the model's parts; or, in a lamp's light: */
    struct zs_shadowed_lit *shadowed_lit;
};

/* Hooks over strips that are drawn, in this order. */
#define HOOKS_MAX 2
struct sim_effect_hooks {
    struct zs_resolve hook[HOOKS_MAX];
    struct zs_fog fog;
    struct zs_dither dither;
};

/* Give the model's n instances, the first of out->instance, the surface that the options ask for. from: the model's
 * scene. SIM_OK; SIM_REFUSED, said why, here and below. */
int sim_effect_surfaces(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                        const struct sim_view *view, const struct sim_options *o);
void sim_effect_surfaces_free(struct sim_effect_surface *surface);

/* Lay a floor if there is one, with shadows, a shadow map or a mirror. */
int sim_effect_ground(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                      const struct sim_view *view, const struct sim_options *o);
void sim_effect_ground_free(struct sim_effect_ground *ground);

#endif
