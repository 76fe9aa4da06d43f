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
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"

struct sim_effect_corners;

/* A material in the form that its shader takes, and what its shader is made of. Of one of the model's parts, or of the
 * floor. */
struct sim_effect_part {
    union {
        struct zs_material plain; /* begins all of them */
        struct zs_blend blend;
        struct zs_lit_material lit;
        struct zs_shadowed_material shadowed;
        struct zs_shadowed_lit shadowed_lit;
        struct zs_shadowed_phong shadowed_phong;
    } of;
    struct zs_shader dithered;
    struct zs_filtered filtered;
    struct zs_layered layered;
    struct zs_mesh mesh;         /* of a part that mirrors an environment, with uv_bits for it; or with: */
    struct sim_effect_corners *corner; /* vertices of each triangle's own, with its normal; NULL: none */
    struct zs_texture leveled;   /* with mipmap levels of its own; texel NULL: none */
};

/* The model's surface: part[0] is the floor's, part[1 + i] that of the model's i-th part. */
struct sim_effect_surface {
    struct sim_effect_part *part;
    uint32_t n_parts;
    struct zs_lamp lamp[SIM_LIGHTS_MAX];
    struct zs_lighting lighting;
    struct zs_shine shine;
    struct zs_texture environment; /* its texels are its own */
};

/* What is drawn beside the model. */
struct sim_effect_ground {
    struct sim_floor floor;
    struct sim_floor_cells window, matt; /* of a floor that mirrors and lies in shadow */
    struct zs_mesh *shadow; /* of each of the model's parts */
    int16_t (**pos)[3];     /* its vertices */
    struct zs_instance *shade; /* [n_shadows] */
    uint32_t n_shadows;
    struct zs_material dark, glass; /* of shadows; of windows */
    struct zs_mirror mirror;
    struct sim_light_map map[SIM_LIGHTS_MAX];
};

/* Hooks over strips that are drawn. */
#define HOOKS_MAX 2
struct sim_effect_hooks {
    struct zs_resolve of_pass[SIM_PASSES_MAX][HOOKS_MAX];
    struct zs_fog fog, mirrored; /* of all; of a pass in windows */
    struct zs_dither dither;
};

/* Is the model drawn as sorted layers? */
int sim_effect_layered(const struct sim_effect_options *e);

/* Give the model's n instances, out->model, the surface that the options ask for, but for that of shadow maps. from:
 * the model's scene. SIM_OK; SIM_REFUSED, said why, here and below. */
int sim_effect_surfaces(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                        const struct sim_view *view, const struct sim_options *o);
/* Let the floor, and the model unless it mirrors an environment, lie in the shadows of out->ground's maps. */
int sim_effect_shadowed(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o);
/* What comes on top of any surface of the model: filters, dithering, transparency. */
int sim_effect_coat(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o);
void sim_effect_surfaces_free(struct sim_effect_surface *surface);

/* Lay a floor if there is one, with shadows, a shadow map or a mirror. */
int sim_effect_ground(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                      const struct sim_view *view, const struct sim_options *o);
void sim_effect_ground_free(struct sim_effect_ground *ground);

/* Part the model, the floor and what is on it into passes. */
void sim_effect_passes(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o);

#endif
