/* What the files mesh_*.c share: the work on a model's meshes. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MESH_WORK_H
#define SIM_MESH_WORK_H

#include "mesh_pieces.h"

/* Triangles that share a material. */
struct group {
    struct sim_paint paint;
    uint32_t n_tris;
    uint32_t material; /* of its first triangle in the file */
    int same_material; /* flags: all of its triangles have that, and one colour */
    int same_rgb;
};

struct groups {
    struct group *at;
    uint32_t n;
    uint32_t *of; /* [model.n_tris], which; UINT32_MAX: left out */
};

/* What the work goes on, and where it goes to. */
struct work {
    const struct sim_model *model;
    const struct sim_steps *steps;
    const struct sim_convert_options *options;
    const uint32_t (*texture_size)[2];
    int32_t (*place)[3]; /* [model->n_points] */
    struct groups groups;
    struct sim_pieces *out;
};

static inline int is_textured(enum sim_shader shader)
{
    return shader >= SIM_SHADER_TEXTURE;
}

static inline int has_normals(enum sim_shader shader)
{
    return shader == SIM_SHADER_SMOOTH || shader == SIM_SHADER_TEXTURE_SMOOTH;
}

static inline int same_rgb(struct zs_rgb a, struct zs_rgb b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* Sort the model's triangles into groups. Return 0: by colour is impossible, or not worth trying. sim_groups_free in
 * either case. */
int sim_groups_make(struct work *w, int by_color);
void sim_groups_free(struct groups *g);

/* Count what of materials is not drawn, into w->out->lost. */
void sim_groups_losses(struct work *w);

/* Make the pieces of a group, after those that are there. Return SIM_OK; SIM_REFUSED, said why. */
int sim_group_cut(struct work *w, uint32_t group);

#endif
