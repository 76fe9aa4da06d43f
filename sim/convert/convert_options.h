/* The command line of `zsim convert`.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_CONVERT_OPTIONS_H
#define SIM_CONVERT_OPTIONS_H

#include "model.h"
#include "zstrip.h"

/* How the converted model is shaded; what a part without texture gets stands behind. */
enum sim_look {
    SIM_LOOK_FLAT,
    SIM_LOOK_SMOOTH,
    SIM_LOOK_TEXTURED,      /* smooth */
    SIM_LOOK_TEXTURED_FLAT, /* flat */
    SIM_LOOK_UNLIT,         /* raw */
    SIM_LOOK_RAW,
    SIM_LOOK_DEFAULT /* textured, smooth or flat, by what the file holds */
};

enum sim_texels {
    SIM_TEXELS_AUTO,
    SIM_TEXELS_565,
    SIM_TEXELS_PAL8,
    SIM_TEXELS_PAL4,
    /* With alpha; no options: a texture whose alpha counts gets one in place of those above. */
    SIM_TEXELS_4444,
    SIM_TEXELS_PAL8A,
    SIM_TEXELS_PAL4A
};

/* Strings point into argv. */
struct sim_convert_options {
    const char *input, *name, *out, *map, *texture; /* texture, map: NULL: none */
    double unit;                                    /* world units to a model unit; 0: chosen */
    int look, texels, wrap, cull;               /* enum sim_look, sim_texels, sim_wrap, zs_cull */
    int keep_origin;                            /* 1: the file's own origin stays the mesh's */
    int no_face_normals, precise, dither, mipmap, bvh, help; /* flags */
    long texture_size[2];                       /* texels, most: powers of two */
    struct zs_rgb color;
    int no_alpha;             /* flag: no material is transparent, and alpha of texels does nothing */
    int opaque;               /* flag: no material is transparent or has highlights, and alpha of texels does nothing */
    int chosen;               /* flag: nobody asked for the look */
    int by_material;          /* flag: unlit materials get a shader of their own */
    int lit;                  /* flag: texels are lit by more than a brightness, which is done at vertices alone */
    int has_color, has_unit;  /* flags */
    const char *simplify;     /* NULL: all triangles */
    struct sim_limits limits; /* of loading the model */
    int for_models;           /* flag: an option that pictures have no use for was given */
    const char *model_option; /* that option, for messages */
    char *command;            /* the command line without folders, safe in a comment; malloc'ed */
};

/* Fill *o from the arguments after "convert". SIM_USAGE or SIM_REFUSED, said why; *o is only
 * complete on SIM_OK. With o->help nothing else counts. free(o->command) in any case. */
int sim_convert_parse(struct sim_convert_options *o, int argc, char **argv);

void sim_convert_help(void);

#endif
