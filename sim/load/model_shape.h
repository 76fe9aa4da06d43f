/* What is found of a model's points and triangles, whoever read them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MODEL_SHAPE_H
#define SIM_MODEL_SHAPE_H

#include "model.h"

/* A hash of points. */
struct sim_weld {
    uint32_t *slot, mask;
};

/* For so many corners; sim_weld_end when all are in. */
void sim_weld_begin(struct sim_weld *w, size_t corners);
void sim_weld_end(struct sim_weld *w);

/* The number of a point in model->point, the same for equal positions; a new one is put behind the last one, for which
 * there is room. */
uint32_t sim_weld_point(struct sim_weld *w, struct sim_model *model, const double p[3]);

/* Corners whose normal is 0 0 0 get the mean of the faces around their point, weighted by angle; with `flat`, faces
 * without any of a file that has some get their own. */
void sim_model_fill_normals(struct sim_model *model, int flat);

/* Corners get the normal of their face, where it has area. */
void sim_model_flatten(struct sim_model *model);

/* Box and sphere. SIM_OK; SIM_REFUSED where there is no extent, said why about model->file. */
int sim_model_fill_bounds(struct sim_model *model);

#endif
