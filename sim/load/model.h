/* A model file as triangles in file order, in double precision.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MODEL_H
#define SIM_MODEL_H

#include <stdint.h>

#include "losses.h"
#include "resample.h"
#include "zstrip.h"

#define SIM_NO_TEXTURE UINT32_MAX
#define SIM_UV_MAX 1e6 /* repeats */

/* A material that triangles name. */
struct sim_material {
    char *name;        /* as in the file; "" where it has none */
    struct zs_rgb rgb; /* diffuse; 204 204 204 where the file says nothing; where it is black, the emission, unlit */
    struct zs_rgb emission; /* light of its own besides; 0: none */
    struct zs_rgb specular; /* of its highlights; 0: none */
    uint8_t power;          /* of their cosine, 1 .. 128; 0: none */
    uint8_t alpha_mode;     /* enum sim_alpha; the texture has its own, which is no more than this */
    uint8_t alpha;          /* opacity, 255 is full; SIM_ALPHA_BLEND */
    uint8_t alpha_least;    /* least alpha of a texel that is drawn, 1 .. 255; SIM_ALPHA_MASK */
    uint8_t two_sided;      /* flags: back sides are seen; light does not change it */
    uint8_t unlit;
    uint32_t texture;  /* into sim_model.texture, or SIM_NO_TEXTURE */
};

struct sim_model {
    const char *file;        /* borrowed: its name, for messages */
    double (*point)[3];      /* [n_points], distinct positions that faces use, model units */
    uint32_t (*tri)[3];      /* [n_tris], into point; file order; polygons cut as polygon.h says */
    float (*normal)[3][3];   /* [n_tris], unit, by corner; NULL: not asked for */
    struct zs_rgb (*rgb)[3]; /* [n_tris], by corner */
    double (*uv)[3][2];      /* [n_tris], by corner: u to the right, v down from the top of the
                                picture, 1 is once around; |uv| <= SIM_UV_MAX; NULL: not
                                asked for */
    uint8_t *has_uv;         /* [n_tris], 0: the file gives this face none, uv is 0; NULL as uv */
    uint32_t *tri_material;  /* [n_tris], into material */
    struct sim_material *material; /* [n_materials]; some may be used by no triangle */
    struct sim_texture *texture;   /* [n_textures]; each is used */
    struct sim_lost lost[SIM_LOST_KINDS];
    char *lost_materials;    /* OBJ: its first material file that could not be read; else NULL */
    uint32_t n_points, n_tris, n_materials, n_textures;
    int single;              /* 1: positions came through single precision */
    int file_normals;        /* 1: normals were asked for, and the file gives some corner one */
    double lo[3], hi[3];     /* box around the points */
    double center[3], radius; /* of a sphere around the points, > 0 */
    double simplify_error;    /* of the extent, where simplified_from is not 0 */
    uint8_t simplified_to_none; /* flag: it was not, as no triangle would be left */
    uint32_t simplified_from; /* triangles in the file, where it was simplified; 0: it was not */
};

enum sim_wrap { SIM_WRAP_FILE, SIM_WRAP_REPEAT, SIM_WRAP_CLAMP };

/* What loading may take: models come from strangers. All zero: the usual. */
struct sim_limits {
    int outside;    /* flag: files outside the model's folder are read, too, where it names them */
    long megabytes; /* of memory; 0: 1536 and 64 times the file's, at most 3/4 of the machine's */
    long seconds;   /* of CPU time; 0: 20 and one for each megabyte of the file */
};

/* What of a model is wanted besides its shape and colours. All zero: nothing. */
struct sim_want {
    int normals;  /* flag: fill normal, from the file where it has them, else from the faces around
                     a point, weighted by their angles there; faces without any of a glTF file that has some: flat */
    int textures; /* flag: fill uv, has_uv and texture */
    const char *picture;        /* with textures: this file for all faces in place of the model's
                                   own; NULL: its own */
    int lenient;  /* flag: with textures, without picture: one that cannot be loaded is noted in lost */
    enum sim_wrap wrap;         /* with textures: as the file says, or one mode for all, both axes */
    const struct zs_rgb *color; /* of everything; NULL: as below */
    const char *simplify;       /* as sim_simplify takes it; NULL: all triangles */
    struct sim_limits limits;
};

/* Load a model. file stays borrowed.
 *
 * The file is read in a process of its own (loader.c): where that crashes, or takes more memory or time than
 * want->limits, the file is refused. What the model names is read if it is a regular file in the model's folder or
 * below, links followed; else the model is refused, unless want->limits.outside.
 *
 * Colours: want->color, else vertex colours, else the material's diffuse colour, else 204 204 204.
 *
 * Textures: OBJ with MTL (map_Kd with -s, -o and -clamp, times Kd unless that is black), glTF
 * (baseColorTexture, times baseColorFactor, with KHR_texture_transform), and what else assimp gives as diffuse
 * texture; PNG or JPEG, in files, data URIs or the model itself. A file is looked for at the path that the model
 * gives, from the model's folder, then under its bare name there. Refused: a picture that is
 * missing or broken; want->picture where no face has uv; a picture too large to be doubled where it is repeated
 * mirrored (mirrored.h). Vertex colours are not multiplied
 * into textures. Texels' alpha is kept where the material asks for it: glTF's alphaMode MASK and BLEND, MTL's
 * map_d, as a mask, of the same size.
 *
 * Return  SIM_OK; SIM_REFUSED, said why, *model empty. sim_model_free in either case. */
int sim_model_load(struct sim_model *model, const char *file, const struct sim_want *want);
void sim_model_free(struct sim_model *model);

/* The same in this process, without limits of memory and time. */
int sim_model_read(struct sim_model *model, const char *file, const struct sim_want *want);

/* The texture of a face; NULL: its material has none, or the face no uv. */
const struct sim_texture *sim_model_texture(const struct sim_model *model, uint32_t tri);

/* Unit normal of a triangle in double; 0 0 0 where it has no area. */
void sim_model_face_normal(const struct sim_model *model, uint32_t tri, double out[3]);

/* The colour of a face: the mean of its corners'. */
struct zs_rgb sim_model_face_rgb(const struct sim_model *model, uint32_t tri);

#endif
