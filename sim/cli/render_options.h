/* The command line of `zsim render`.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RENDER_OPTIONS_H
#define SIM_RENDER_OPTIONS_H

#include "accelerator_names.h"
#include "effect_options.h"
#include "line_style.h"
#include "model.h"
#include "panel_frame.h"
#include "false_colors.h"
#include "zstrip.h"

enum sim_shade {
    SIM_SHADE_ID,
    SIM_SHADE_FLAT,
    SIM_SHADE_SMOOTH,
    SIM_SHADE_TEXTURED,      /* texels times smooth light; faces without a texture: smooth */
    SIM_SHADE_TEXTURED_FLAT, /* texels times flat light; others: flat */
    SIM_SHADE_UNLIT,         /* texels; others: their colour */
    SIM_SHADE_DEFAULT        /* by what the file holds: sim_scene_load chooses */
};
enum sim_depth {
#define SIM_DEPTH_ONE(name_, ...) SIM_DEPTH_##name_,
    ZS_DEPTH_EACH(SIM_DEPTH_ONE) /* float: the one of e3m13, e4m12, e5m11 that far / near asks for: see sim_depth_of */
    SIM_DEPTH_DEFAULT            /* float; orthographic: linear */
};
#define SIM_DEPTH_WORD(name_, ...) "|" #name_
#define SIM_DEPTH_WORDS (&("" ZS_DEPTH_EACH(SIM_DEPTH_WORD))[1]) /* in the order of the enum */
enum sim_mesh {
    SIM_MESH_CONVERT, /* as `zsim convert` writes it */
    SIM_MESH_FILE     /* as the file has it, on a grid of 24 bits */
};
enum sim_texel { SIM_TEXEL_565, SIM_TEXEL_PAL8, SIM_TEXEL_PAL4 };

/* has_* is 0 where the user said nothing and the simulator chooses. Strings point into argv. */
struct sim_options {
    const char *model, *out, *depth_out, *id_out, *stats; /* files; NULL: not wanted */
    long size[2], strip;                                  /* px: width, height, rows */
    long tris, verts;                                     /* pool sizes; 0: ample */
    long depth_bits, subpixel, buffers;                   /* as in struct zs_config */
    const char *fast_names;                               /* NULL: all */
    struct sim_fast fast;                                 /* accelerators, which it names */
    double eye[3], at[3], up[3];                          /* model units */
    double fov;                                           /* degrees, vertical */
    double near_z, far_z;                                 /* model units */
    double light[3];                                      /* towards the light, any length but 0 */
    double ambient, diffuse;                              /* 0 .. 1 */
    enum zs_projection projection;
    enum sim_depth depth;
    enum sim_shade shade;
    enum sim_mesh mesh;
    enum zs_cull cull;
    enum sim_show show;
    int method;             /* of sim_methods */
    int style;              /* enum sim_style */
    long line_width;        /* px, of lines and points */
    const char *edges, *dash; /* of lines; NULL: not given */
    double crease;          /* degrees */
    struct sim_line_wish lines; /* what edges and dash say */
    const char *texture;    /* a file for all faces; NULL: the model's own */
    enum sim_texel texel;   /* how textures are stored; without has_texel the smallest that is good enough */
    int clamp;              /* with has_wrap: 1 clamp, 0 repeat, both ways */
    struct zs_rgb background, color;
    int has_eye, has_at, has_near, has_far, has_light, has_color, has_wrap, has_crease,
        has_texel; /* flags */
    int precise;                          /* flag: 24 bits a coordinate */
    int opaque;                           /* flag: alpha, highlights and emission do nothing */
    int shade_chosen;                     /* flag: shade is what sim_scene_load chose */
    int reference, compare, help;                                  /* flags */
    int explain; /* flag, or SIM_EXPLAIN_EMPTY */
#define SIM_EXPLAIN_EMPTY 2 /* if nothing is seen in the frame */
    struct sim_panel_wish panel; /* size is its picture's, where it has a name */
    long threads;                /* 0: not given */
    long spi_hz;                 /* of its wire */
    int has_size, has_spi;
    struct sim_effect_options effects;
    const char *simplify;        /* NULL: all triangles */
    long turntable;              /* views of a turn; 0: one frame */
    struct sim_limits limits;    /* of loading the model */
};

/* Fill *o from the arguments after "render". SIM_USAGE where they make no sense, SIM_REFUSED where
 * a value is outside what zsim can do; *o is only complete on SIM_OK. With o->help nothing else
 * counts. */
int sim_options_parse(struct sim_options *o, int argc, char **argv);

/* What they are where nothing is said: no model, 240x240. */
void sim_options_defaults(struct sim_options *o);

/* The rows of its table. */
const struct sim_option *sim_options_rows(size_t *n);

/* Do these options ask for textures; for normals at the vertices? */
int sim_options_textured(const struct sim_options *o);
int sim_options_smooth(const struct sim_options *o);

/* Print the help text of `zsim render`. */
void sim_options_help(void);

#endif
