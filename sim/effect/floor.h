/* A chequered floor just below a model.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_FLOOR_H
#define SIM_FLOOR_H

#include "framing.h"
#include "quantise.h"

#define SIM_FLOOR_CELLS 16

struct sim_floor {
    struct zs_mesh mesh;
    struct zs_material material; /* flat; the mesh has normals at its vertices, too */
    struct zs_instance instance;
    double point[3], up[3]; /* model units: its middle; unit, towards the model */
    double half;            /* model units: half of its side */
    int16_t pos[(SIM_FLOOR_CELLS + 1) * (SIM_FLOOR_CELLS + 1)][3];
    zs_q1_15 normal[(SIM_FLOOR_CELLS + 1) * (SIM_FLOOR_CELLS + 1)][3];
    uint16_t tri[2 * SIM_FLOOR_CELLS * SIM_FLOOR_CELLS][3];
    zs_q1_15 face_normal[2 * SIM_FLOOR_CELLS * SIM_FLOOR_CELLS][3];
    struct zs_rgb face_rgb[2 * SIM_FLOOR_CELLS * SIM_FLOOR_CELLS];
};

/* Half of a floor's cells: the light or the dark ones. */
struct sim_floor_cells {
    struct zs_mesh mesh;
    struct zs_instance instance;
    uint16_t tri[SIM_FLOOR_CELLS * SIM_FLOOR_CELLS][3];
    zs_q1_15 face_normal[SIM_FLOOR_CELLS * SIM_FLOOR_CELLS][3];
    struct zs_rgb face_rgb[SIM_FLOOR_CELLS * SIM_FLOOR_CELLS];
};

/* Take the dark cells of a floor, or the light ones. They share its vertices and its material. */
void sim_floor_half(struct sim_floor_cells *half, const struct sim_floor *floor, int dark);

/* Lay a floor below a model, below along `up`, nearly twice as wide as the model. It points into itself: do not move
 * it. */
void sim_floor_lay(struct sim_floor *floor, const struct sim_model *model, const struct sim_scene *scene,
                   const double up[3]);

#endif
