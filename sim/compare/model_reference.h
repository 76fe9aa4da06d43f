/* A model as the double-precision reference draws it: the file's own positions, never quantised.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MODEL_REFERENCE_H
#define SIM_MODEL_REFERENCE_H

#include "model.h"
#include "render_options.h"
#include "reference.h"
#include "framing.h"

/* The reference's frame, and what it was drawn with. */
struct sim_model_reference {
    struct ref_image image; /* rgb565, key, id, z and exact_key; textured: u, v, texel and texture
                               too; memory of its own */
    struct ref_texture *texture; /* [model->n_textures]; texels are the model's; then levels, whose are their own */
    uint32_t n_textures, n_levels;
    struct ref_lamp lamp[SIM_LIGHTS_MAX];
    struct ref_fog fog;
    struct ref_camera camera;
    struct ref_depth depth;
};

/* Draw it with the same camera, colours and light, with lights, highlights, fog, layers, bilinear textures and mipmaps
 * of the options, and highlights and emission of materials. The model must outlive *out.
 * SIM_OK; SIM_REFUSED, said why, *out empty. */
int sim_model_reference_render(struct sim_model_reference *out, const struct sim_model *model,
                               const struct sim_view *view, const struct sim_options *o);
void sim_model_reference_free(struct sim_model_reference *original);

#endif
