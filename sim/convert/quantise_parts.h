/* What the files quantise*.c share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_QUANTISE_PARTS_H
#define SIM_QUANTISE_PARTS_H

#include <math.h>

#include "quantise.h"

/* The longest side of a model's box. */
static inline double sim_model_extent(const struct sim_model *model)
{
    double extent = 0.0;
    for (int k = 0; k < 3; k++)
        extent = fmax(extent, model->hi[k] - model->lo[k]);
    return extent;
}

/* Choose the scene's world unit for a view, and set its camera and light. Its grid is set, and made_unit.
 * scale   world units to a mesh step, uq16_16
 * Return  SIM_OK; SIM_REFUSED, said why. */
int sim_scene_view(struct sim_scene *s, uint32_t *scale, const struct sim_model *model, const struct sim_view *view,
                   const struct sim_options *o);

/* Build the scene of a model's triangles as they are, but for its instances. Return as sim_scene_view. */
int sim_scene_file(struct sim_scene *out, const struct sim_model *model, const struct sim_view *view,
                   const struct sim_options *o);

/* Its materials and textures. */
void sim_scene_materials(struct sim_scene *s, const struct sim_model *model, const struct sim_options *o);

#endif
