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
    SIM_MATERIAL_SHADOWED_LIT
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

/* Bytes of the struct that a material of that kind begins. */
size_t sim_shader_material_bytes(enum sim_shader_material material);

#endif
