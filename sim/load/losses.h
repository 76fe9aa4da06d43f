/* What a model file has and a scene of zstrip does not.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LOSSES_H
#define SIM_LOSSES_H

#include <stdint.h>
#include <stdio.h>

enum sim_lost_kind {
    SIM_LOST_ANIMATION,
    SIM_LOST_SKIN,
    SIM_LOST_MORPH,
    SIM_LOST_CAMERA,
    SIM_LOST_LIGHT,
    SIM_LOST_LINES,
    SIM_LOST_CURVES,
    SIM_LOST_STRIPS,
    SIM_LOST_CORNERS,
    SIM_LOST_UV_SETS,
    SIM_LOST_VERTEX_COLOR,
    SIM_LOST_VERTEX_ALPHA,
    SIM_LOST_MEAN_COLOR,
    SIM_LOST_COLORS,
    SIM_LOST_TEXTURE,
    SIM_LOST_FURTHER_TEXTURE,
    SIM_LOST_UNPLACED,
    SIM_LOST_MATERIAL,
    SIM_LOST_EXTENSION,
    SIM_LOST_TEXEL_ALPHA,
    SIM_LOST_TEXTURE_TURN,
    SIM_LOST_NORMAL_MAP,
    SIM_LOST_METAL_MAP,
    SIM_LOST_EMISSION_MAP,
    SIM_LOST_OCCLUSION_MAP,
    SIM_LOST_SPECULAR_MAP,
    SIM_LOST_OPACITY_MAP,
    SIM_LOST_OTHER_MAP,
    SIM_LOST_OPACITY,
    SIM_LOST_TWO_SIDED,
    SIM_LOST_SPECULAR,
    SIM_LOST_FAINT_SPECULAR,
    SIM_LOST_EMISSION,
    SIM_LOST_KINDS
};

/* All zero: nothing. */
struct sim_lost {
    uint32_t n;     /* how many there are */
    char first[40]; /* the name of the first, cut off; "": it has none */
};

struct sim_model;
struct aiScene;

/* One more. lost: [SIM_LOST_KINDS] */
void sim_lose(struct sim_lost *lost, enum sim_lost_kind kind, const char *name);

/* Count what of a scene no model keeps: all but materials' colours and alpha, and textures that were meant to be
 * loaded. used: [mNumMaterials], flags: of these materials maps are counted; NULL: of none. */
void sim_losses_count(struct sim_lost *lost, const struct aiScene *scene, const uint8_t *used);

/* The material file that could not be read, if any: a line begun by lead. */
void sim_lost_materials_print(FILE *f, const char *lead, const char *materials);
/* A line a kind, each begun by lead: what, how many, the first one's name. */
void sim_losses_print(FILE *f, const char *lead, const struct sim_lost *lost);

#endif
