/* The renderer's shaders: what each is called, what its material is, and which measurements say what it takes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SHADER_TABLE_H
#define SIM_SHADER_TABLE_H

#include <stddef.h>

#include "zstrip.h"

/* The struct that a material of the shader begins: struct zs_material itself, zs_blend, ... */
enum sim_shader_material { SIM_MATERIAL_PLAIN, SIM_MATERIAL_BLEND, SIM_MATERIAL_LIT, SIM_MATERIAL_SHADOWED };

struct sim_shader_row {
    const struct zs_shader *shader;
    const char *name;           /* as C has it */
    const char *effect;         /* words of what it does beyond the six plain shaders; NULL: it is one of those */
    enum sim_shader_material material;
    /* Rows of tests/records/effects.txt. A pixel takes pixel[0] + pixel[1] - pixel[2], a vertex vertex[0] likewise; ""
     * ends them early, NULL as the first: not measured. Of plain shaders, stage costs are what counts. */
    const char *pixel[3], *vertex;
};

/* NULL: not one of the renderer's. */
const struct sim_shader_row *sim_shader_row_of(const struct zs_shader *shader);

/* Bytes of the struct that a material of that kind begins. */
size_t sim_shader_material_bytes(enum sim_shader_material material);

#endif
