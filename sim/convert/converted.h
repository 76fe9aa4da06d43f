/* A model as firmware holds it: what `zsim convert` writes, and what render, budget and zstrip-linux draw.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_CONVERTED_H
#define SIM_CONVERTED_H

#include "convert_options.h"
#include "grid_step.h"
#include "mesh_pieces.h"
#include "texel_pack.h"

struct sim_converted {
    struct sim_steps steps;
    struct sim_pieces pieces;
    struct sim_packed_texels *packed; /* [n_packed], by the model's textures */
    uint32_t n_packed;
};

/* The light of lit materials: the default of `zsim render`, until a program sets another. */
#define SIM_LIT_AMBIENT 64      /* of 255 */
#define SIM_LIT_STRENGTH 49152u /* uq16_16 */

/* Bytes by part on a 32-bit machine. */
struct sim_converted_bytes {
    struct sim_flash mesh;
    size_t texels, structs, total;
};

/* What these options say where they say nothing: those of `zsim convert` alone. */
void sim_convert_defaults(struct sim_convert_options *o);

/* Load o->input with what its look needs. A look that is left open is chosen, into o->look: textured if a face has a
 * texture, else smooth if the file has normals, else flat. Return SIM_OK; SIM_REFUSED, said why, *model empty. */
int sim_convert_load(struct sim_model *model, struct sim_convert_options *o);

/* Grid, meshes and textures. Return SIM_OK; SIM_REFUSED, said why. sim_converted_free in either case. */
int sim_converted_make(struct sim_converted *out, const struct sim_model *model,
                       const struct sim_convert_options *o);
void sim_converted_free(struct sim_converted *c);

void sim_converted_bytes(struct sim_converted_bytes *out, const struct sim_converted *c);

#endif
