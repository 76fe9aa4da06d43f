/* A model as meshes of integers: vertices joined, triangles sorted, cut where 16-bit indices end.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MESH_PIECES_H
#define SIM_MESH_PIECES_H

#include <stdint.h>

#include "convert_options.h"
#include "model.h"
#include "grid_step.h"
#include "zstrip.h"

enum sim_shader {
    SIM_SHADER_RAW,
    SIM_SHADER_FLAT,
    SIM_SHADER_SMOOTH,
    SIM_SHADER_TEXTURE,
    SIM_SHADER_TEXTURE_FLAT,
    SIM_SHADER_TEXTURE_SMOOTH
};

/* Highlights on a texture take a shader without accelerators: from here on they are drawn, of 255. Under the usual
 * lamp, SIM_LIT_STRENGTH, their top is an eighth of full light or more then: four codes of 31. Emission: a code. */
#define SIM_TEXTURE_SPECULAR_LEAST 43
#define SIM_TEXTURE_EMISSION_LEAST 8

/* Does a material have highlights or emission that are drawn, with a texture or without? */
int sim_material_lights(const struct sim_material *material, int textured);

/* A material as it will be written. */
struct sim_paint {
    enum sim_shader shader;
    struct zs_rgb rgb;
    uint32_t texture;          /* into sim_model.texture, or SIM_NO_TEXTURE */
    uint8_t cull;              /* enum zs_cull */
    uint8_t alpha_mode, alpha; /* enum sim_alpha, mask only with a texture; opacity, 255 is full */
    uint8_t power;             /* of highlights; 0: none */
    uint8_t lit;       /* flag: a struct zs_lit_material, which alone has what follows; flat, smooth or
                          SIM_SHADER_TEXTURE_SMOOTH, opaque */
    uint8_t two_sided; /* flag: light falls on back sides */
    struct zs_rgb specular, emission;
    const char *name; /* of the file's material, borrowed; "": several or none */
};

/* A mesh as it will be written. Arrays that its shader does not read are NULL. */
struct sim_piece {
    uint32_t paint, n_verts, n_tris, n_clusters, n_nodes;
    int32_t (*fine)[3]; /* [n_verts], 1/256 step */
    zs_q1_15 (*normal)[3], (*face_normal)[3];
    struct zs_rgb *vertex_rgb, *face_rgb;
    uint16_t *face_raw;
    int16_t (*uv)[2];
    uint16_t (*tri)[3];
    uint32_t *source;           /* [n_tris], the triangle's number in the model */
    struct zs_cluster *cluster; /* [n_clusters], of SIM_CLUSTER_TRIS triangles or fewer */
    struct zs_bvh_node *bvh;    /* [n_nodes]; NULL: not asked for */
    int16_t center[3];
    uint16_t radius;
    uint8_t uv_bits;
};

/* All of a model. */
struct sim_pieces {
    struct sim_paint *paint; /* [n_paints] */
    struct sim_piece *piece; /* [n_pieces] */
    uint32_t n_paints, n_pieces, n_verts, n_tris;
    uint32_t n_flat, n_flat_before;       /* triangles left out: without area on the grid; of them, in the file */
    double error_max, error_rms;          /* of positions, model units */
    double normal_error;                  /* largest angle, degrees; < 0: no normals */
    struct sim_lost lost[SIM_LOST_KINDS]; /* of the file: by the loader and here */
    double *uv_error;                     /* [model.n_textures], largest, texels; < 0: not used */
};

/* Make the meshes of a model.
 *
 * texture_size  [model->n_textures], texels each way of what will be written: coordinates must
 *               reach half a texel.
 * Return  SIM_OK; SIM_REFUSED, said why, *out empty. sim_pieces_free in either case. */
int sim_pieces_make(struct sim_pieces *out, const struct sim_model *model, const struct sim_steps *steps,
                    const struct sim_convert_options *o, const uint32_t (*texture_size)[2]);
void sim_pieces_free(struct sim_pieces *pieces);

/* The struct that a paint is written as. */
enum sim_form { SIM_FORM_MATERIAL, SIM_FORM_BLEND, SIM_FORM_LIT };
enum sim_form sim_paint_form(const struct sim_paint *paint);

/* The powers of highlights that paints have, ascending. Return how many. */
uint32_t sim_paint_powers(uint8_t power[128], const struct sim_pieces *pieces);

/* What a part of all meshes takes in flash, bytes. */
struct sim_flash {
    size_t pos, pos_lo, tri, normal, face_normal, uv, rgb, cluster, bvh;
};
void sim_pieces_flash(struct sim_flash *sum, const struct sim_pieces *pieces, int fine);

#endif
