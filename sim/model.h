/* A model file as triangles in file order, in double precision.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MODEL_H
#define SIM_MODEL_H

#include <stdint.h>

#include "zstrip.h"

struct sim_model {
    const char *file;        /* borrowed: its name, for messages */
    double (*point)[3];      /* [n_points], distinct positions that faces use, model units */
    uint32_t (*tri)[3];      /* [n_tris], into point; file order, polygons as fans */
    float (*normal)[3][3];   /* [n_tris], unit, by corner; NULL: not asked for */
    struct zs_rgb (*rgb)[3]; /* [n_tris], by corner */
    uint32_t n_points, n_tris;
    int single;              /* 1: positions came through single precision */
    double lo[3], hi[3];     /* box around the points */
    double center[3], radius; /* of a sphere around the points, > 0 */
};

/* Load a model. file stays borrowed. want_normals: fill normal, from the file where it has them,
 * else from the faces around a point, weighted by their angles there.
 *
 * Colours: color where it is not NULL, else vertex colours, else the material's diffuse colour,
 * else 204 204 204.
 *
 * Return  SIM_OK; SIM_REFUSED, said why, *model empty. sim_model_free in either case. */
int sim_model_load(struct sim_model *model, const char *file, int want_normals,
                   const struct zs_rgb *color);
void sim_model_free(struct sim_model *model);

/* Unit normal of a triangle in double; 0 0 0 where it has no area. */
void sim_model_face_normal(const struct sim_model *model, uint32_t tri, double out[3]);

/* The colour of a face: the mean of its corners'. */
struct zs_rgb sim_model_face_rgb(const struct sim_model *model, uint32_t tri);

#endif
