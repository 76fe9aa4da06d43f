/* The grid of a converted model: mesh steps, model units, world units.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_GRID_STEP_H
#define SIM_GRID_STEP_H

#include <stdint.h>

#include "model.h"

#define SIM_STEPS_MAX 32767 /* mesh steps from 0, each way */

/* position = origin + step * n in model units, n a whole number of steps (of 1/256 step where
 * fine). A step is scale / 65536 world units and a model unit is `unit` of them, both exactly. */
struct sim_steps {
    double origin[3], step, unit;
    uint32_t scale;           /* uq16_16, zs_mesh.scale */
    int fine;                 /* 1: 24 bits a coordinate */
    int exact;                /* 1: every point of the model lies on the grid */
    double lattice, first[3]; /* exact grids: places to a model unit, and the origin's number */
};

/* What is asked of a grid. */
struct sim_steps_want {
    double unit;     /* world units to a model unit; 0: choose */
    int keep_origin; /* 1: origin 0,0,0; 0: the middle of the model's box */
    int fine;        /* 1: 24 bits, where 16 are not exact */
};

/* Choose a grid: the coarsest that loses nothing, or else the finest that holds the model. Without
 * a unit, the least power of ten that makes the model span 1000 world units (times 10 or 100 where
 * that loses nothing), but 1 for models of 1000 to 10^6 units. Return  SIM_OK; SIM_REFUSED, said
 * why. */
int sim_steps_choose(struct sim_steps *out, const struct sim_model *model,
                     const struct sim_steps_want *want);

/* The place of a position, in 1/256 step: a multiple of 256 unless fine. */
void sim_steps_place(int32_t out[3], const struct sim_steps *s, const double position[3]);

/* And back, in model units. */
void sim_steps_position(double out[3], const struct sim_steps *s, const int32_t place[3]);

#endif
