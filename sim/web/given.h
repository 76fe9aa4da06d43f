/* A model as the page hands it over: kept as it came, and made into a struct sim_model as often as options ask for
 * another one. The engine's sim_model_load (model.h) does that.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_GIVEN_H
#define WEB_GIVEN_H

#include "model.h"

/* How a material is given; all of it from the page, which is not trusted. */
struct web_paint {
    double rgb[3], emission[3], specular[3]; /* 0 .. 1; rgb[0] < 0: the file says nothing */
    double power;                            /* of highlights, < 1: none */
    double opacity, alpha_least;             /* 0 .. 1 */
    double factor[3];                        /* of its texture, 0 .. 1 */
    double alpha_mode;                       /* enum sim_alpha */
    double flags;                            /* of enum web_paint_flag */
    double texture;                          /* its number; < 0: none */
    double textured[4];                      /* specular and power where it is drawn; power < 0: the same */
};
enum web_paint_flag {
    WEB_TWO_SIDED = 1,
    WEB_UNLIT = 2,
    WEB_CLAMP_U = 4,
    WEB_CLAMP_V = 8,
    WEB_SAYS_ALPHA = 16,
    WEB_MIRROR_U = 32,
    WEB_MIRROR_V = 64
};

struct web_image {
    uint32_t width, height;
    uint8_t *rgba; /* [height][width][4] */
    char *name;
};

struct web_given {
    char *name;
    double (*point)[3];      /* [n_verts], model units */
    double (*uv)[2];         /* [n_verts], v down; NULL: none; NaN: this vertex has none */
    float (*normal)[3];      /* [n_verts], any length; NULL: none */
    float (*rgb)[3];         /* [n_verts], 0 .. 1; NULL: none */
    uint32_t (*tri)[3];      /* [n_tris] */
    uint32_t *tri_material;  /* [n_tris]; NULL: 0 */
    struct web_paint *paint; /* [n_paints], at least one */
    char **paint_name;
    struct web_image *image; /* [n_images] */
    uint32_t n_verts, n_tris, n_paints, n_images;
    int up_z, single; /* flags: z is up; positions came through single precision */
    int flat;         /* flag: faces without normals are flat where others have some */
};

void web_given_free(struct web_given *g);

/* What sim_model_load gives from here on. Borrowed; NULL: nothing. */
extern const struct web_given *web_given_now;

#endif
