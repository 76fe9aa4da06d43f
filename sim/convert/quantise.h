/* A model in double precision as a zstrip scene of integers.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_QUANTISE_H
#define SIM_QUANTISE_H

#include "model.h"
#include "palette.h"
#include "framing.h"
#include "zs_blend.h"
#include "zs_lights.h"
#include "zstrip.h"

/* A consecutive run of triangles with one texture, or none, whose vertices fit 16-bit indices.
 * Memory of its own. */
struct sim_part {
    struct zs_mesh mesh;
    const struct zs_material *material;
    int16_t (*uv)[2];
    int16_t (*pos)[3];
    uint8_t (*pos_lo)[3];
    uint16_t (*tri)[3];
    zs_q1_15 (*normal)[3], (*face_normal)[3];
    struct zs_rgb *vertex_rgb, *face_rgb;
    uint16_t *face_raw;
    struct zs_cluster *cluster; /* NULL with --mesh file */
};

/* Its mesh with its arrays, of n_verts and n_tris elements; all else is 0. */
struct zs_mesh sim_part_mesh(const struct sim_part *part, uint32_t n_verts, uint32_t n_tris);

/* Everything that a frame is drawn from. All parts lie on one grid:
 * position = origin + step * n, n = 256 * pos + pos_lo, 0 where there is no pos_lo. With --mesh convert it is the grid
 * that `zsim convert` writes, and a world unit is one of its own or 2^-k of that; with --mesh file a mesh step is 2^k
 * world units. */
struct sim_scene {
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_material *material; /* [n_textures + 1]: faces without a texture, then by texture */
    struct zs_texture *texture;   /* [n_textures] */
    struct zs_blend *blend; /* in place of materials that are transparent; NULL with --mesh file */
    struct zs_lit_material *lit; /* in place of those with highlights or emission; likewise */
    struct zs_shine *shine;
    struct zs_lamp lamp; /* of those: the scene's light */
    struct zs_lighting lighting;
    uint16_t (*palette)[2 * SIM_PALETTE_MAX]; /* [n_textures] */
    uint32_t n_textures;
    struct zs_instance *instance; /* [n_parts] */
    struct sim_part *part;        /* [n_parts] */
    uint32_t n_parts;
    uint64_t n_verts;             /* of all parts */
    uint32_t *source;  /* the number in the model of each triangle, by parts; NULL: they are in its order */
    struct sim_lost lost[SIM_LOST_KINDS]; /* of the file */
    size_t data_bytes; /* that firmware keeps, as `zsim convert` writes it; 0 with --mesh file */
    double origin[3], step, unit; /* model units: of n = 0, of 1, and of a world unit */
    double made_unit;             /* model units: convert's own world unit; 0 with --mesh file */
    double error;                 /* largest |position - its place on the grid|, model units */
    double uv_error;              /* the same of texture coordinates, texels; at most 1/16 */
    uint32_t uv_bits_least;       /* of all textured parts; 0 where there are none */
    double psnr_db; /* least of all textures as they are stored against 8 bits a channel; INFINITY */
};

/* Quantise for one view. The scene points into *out: do not move it.
 * Return  SIM_OK; SIM_REFUSED, said why, *out empty. sim_scene_free in either case. */
int sim_scene_build(struct sim_scene *out, const struct sim_model *model,
                    const struct sim_view *view, const struct sim_options *o);

/* The same scene from another view, which is quick. Not with --mesh file.
 * o       as it was built with, but for what says the view, light and background
 * Return  SIM_OK; SIM_REFUSED, said why, and the scene is only good for this or for sim_scene_free. */
int sim_scene_aim(struct sim_scene *scene, const struct sim_model *model, const struct sim_view *view,
                  const struct sim_options *o);

/* The scene of a model, kept from one frame to the next, as it takes longer to make than to draw. All zero: none yet.
 * It points into itself: do not move it. */
struct sim_kept_scene {
    struct sim_scene scene;
    int is_built; /* flag */
};

/* The scene for this view: the one that is kept, or a new one. Return as sim_scene_build. */
int sim_kept_take(struct sim_kept_scene *kept, const struct sim_model *model, const struct sim_view *view,
                  const struct sim_options *o);

/* Call it before an option changes that is not about the view, light or background, and at the end. */
void sim_kept_free(struct sim_kept_scene *kept);

/* The varyings that its shaders need. */
uint8_t sim_scene_varyings(const struct zs_scene *scene);

/* The method that it needs: NULL, the depth buffer, or zs_method_transparent. */
const struct zs_method *sim_scene_method(const struct zs_scene *scene);

/* Numbers of the scene's triangles, + 1, to those in the file, + 1. */
void sim_scene_file_ids(uint32_t *id, size_t n, const struct sim_scene *scene);

void sim_scene_free(struct sim_scene *scene);

#endif
