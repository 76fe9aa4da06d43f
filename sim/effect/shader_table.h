/* The renderer's shaders: what each is called, what its material is, and which measurements say what it takes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SHADER_TABLE_H
#define SIM_SHADER_TABLE_H

#include <stddef.h>

#include "zstrip.h"

/* The struct that a material of the shader begins: struct zs_material itself, zs_blend, ... */
enum sim_shader_material {
    SIM_MATERIAL_PLAIN,
    SIM_MATERIAL_BLEND,
    SIM_MATERIAL_LIT,
    SIM_MATERIAL_SHADOWED,
    SIM_MATERIAL_SHADOWED_LIT,
    SIM_MATERIAL_SHADOWED_PHONG
};

struct sim_shader_row {
    const struct zs_shader *shader;
    const char *name;           /* as C has it */
    const char *effect;         /* words of what it does beyond the six plain shaders; NULL: it is one of those */
    enum sim_shader_material material;
    int is_flat; /* flag: its faces are lit as by zs_shade_flat */
    const char *vertex;   /* row of tests/records/effects.txt of what a vertex takes; NULL: it has no attributes */
    const char *pixel[3]; /* rows of what a pixel takes: the first, with the second, less the third ("": none); NULL as
                             the first: it was not measured */
};

/* NULL: not one of the renderer's. */
const struct sim_shader_row *sim_shader_row_of(const struct zs_shader *shader);

/* What a shader that a program has made of others is made of. */
enum sim_layer_kind { SIM_LAYER_NONE, SIM_LAYER_MIX, SIM_LAYER_ADD, SIM_LAYER_DOOR };
enum sim_filter_kind { SIM_KIND_NEAREST, SIM_KIND_LINEAR, SIM_KIND_LEVELS, SIM_KIND_LEVELS_LINEAR };
struct sim_shader_made {
    const struct sim_shader_row *row; /* what is drawn in the end; NULL: a program's own, or unknown */
    const struct zs_shader *of;       /* that shader */
    enum sim_layer_kind layer;
    enum sim_filter_kind filter;
    int is_made, is_fogged, is_dithered; /* flags: there is any of it; the layer has fog; colours are dithered */
};

/* Look through layers (struct zs_layered), filters (struct zs_filtered) and dithered copies. */
void sim_shader_made(struct sim_shader_made *out, const struct zs_shader *shader);

/* Bytes of the struct that a material of that kind begins. */
size_t sim_shader_material_bytes(enum sim_shader_material material);

#endif
