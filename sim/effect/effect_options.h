/* Options of `zsim render` for light, transparency, filtering, antialiasing, fog, dithering, shadows and reflection.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_EFFECT_OPTIONS_H
#define SIM_EFFECT_OPTIONS_H

#include "image.h"
#include "option_table.h"
#include "zstrip.h"

#define SIM_LIGHTS_MAX 4
#define SIM_SPOT_FULL 18.0 /* degrees from a spot's axis up to which it is full, ... */
#define SIM_SPOT_DARK 28.0 /* ... and from which on it is dark */

enum sim_light_kind { SIM_LIGHT_DIR, SIM_LIGHT_POINT, SIM_LIGHT_SPOT };
struct sim_light {
    enum sim_light_kind kind;
    double at[3]; /* dir: towards it, any length but 0; else where it is, model units */
    struct zs_rgb rgb;
    double range; /* model units; 0: no end */
};

enum sim_blend { SIM_BLEND_ALPHA, SIM_BLEND_ADD, SIM_BLEND_SCREEN_DOOR };
enum sim_filter { SIM_FILTER_NEAREST, SIM_FILTER_BILINEAR, SIM_FILTER_MIPMAP };
enum sim_dither { SIM_DITHER_NONE, SIM_DITHER_ORDERED, SIM_DITHER_BLUE };
enum sim_shadow { SIM_SHADOW_NONE, SIM_SHADOW_PLANAR, SIM_SHADOW_MAP };
enum sim_levels { SIM_LEVELS_565, SIM_LEVELS_GREY, SIM_LEVELS_MONO }; /* that the panel shows */
enum sim_fog { SIM_FOG_NONE, SIM_FOG_LINEAR, SIM_FOG_EXP };

struct sim_effect_options {
    struct sim_texts light_texts; /* of --light; sim_effects_take reads them */
    struct sim_light light[SIM_LIGHTS_MAX];
    int n_lights;
    const char *specular_text, *fog_text; /* NULL: not given */
    long specular_power;
    double specular_strength; /* 0 .. 1 */
    int per_pixel;            /* flag */
    double alpha;
    int has_alpha, blend, has_blend; /* blend: enum sim_blend */
    int filter;                      /* enum sim_filter */
    long samples;                    /* 1 or 4 */
    enum sim_fog fog;
    double fog_start, fog_end, fog_density; /* distances in model units; density by one of them */
    struct zs_rgb fog_rgb;
    enum sim_levels levels;
    int dither, shadow;                        /* enum sim_dither, enum sim_shadow */
    const char *environment;                   /* a picture; NULL: none */
    const struct sim_image *environment_image; /* in place of that file; NULL: it */
    int mirror;                                /* flag */
};

/* Rows of a table of options; member is a struct sim_effect_options of struct type. --light is a row of its own. */
#define SIM_EFFECT_OPTIONS(type, member)                                                                              \
    { "Effects", SIM_OPTION_HEADING },                                                                                \
        { "--specular", SIM_OPTION_TEXT, offsetof(type, member.specular_text), .value = "POWER:STRENGTH",             \
          .help = "highlights by Blinn-Phong, sharper with more POWER, at most 128; STRENGTH at most 1; with "        \
                  "--shade flat, smooth or textured" },                                                               \
        { "--per-pixel", SIM_OPTION_FLAG, offsetof(type, member.per_pixel),                                           \
          .help = "light at each pixel from interpolated normals (Phong shading); with --shade smooth or "        \
                  "textured" },                                                                                       \
        { "--alpha",                                                                                                  \
          SIM_OPTION_NUMBER,                                                                                          \
          offsetof(type, member.alpha),                                                                               \
          offsetof(type, member.has_alpha),                                                                           \
          0,                                                                                                          \
          1,                                                                                                          \
          .value = "A",                                                                                               \
          .help = "how much the whole model hides of what is behind it; its triangles are sorted (1)" },              \
        { "--blend",                                                                                                  \
          SIM_OPTION_CHOICE,                                                                                          \
          offsetof(type, member.blend),                                                                               \
          offsetof(type, member.has_blend),                                                                           \
          .words = "alpha|add|screen-door",                                                                           \
          .help = "how: mixed, added, or as a pattern of whole pixels, which needs no order (alpha)" },               \
        { "--filter", SIM_OPTION_CHOICE, offsetof(type, member.filter), .words = "nearest|bilinear|mipmap",           \
          .help = "how texels are read: the nearest; mixed of four; from a smaller image where the texture is far "   \
                  "(nearest); of an --environment, too" },                                                            \
        { "--samples", SIM_OPTION_COUNT, offsetof(type, member.samples), .words = "1|4",                              \
          .help = "samples a pixel; of 4 the colour is the mean (1)" },                                               \
        { "--fog", SIM_OPTION_TEXT, offsetof(type, member.fog_text), .value = "FOG",                                  \
          .help =                                                                                                     \
              "linear:START:END:RRGGBB or exp:DENSITY:RRGGBB: colours fade into this one with the distance, in the "  \
              "model's units" },                                                                                      \
        { "--dither", SIM_OPTION_CHOICE, offsetof(type, member.dither), .words = "none|ordered|blue",                 \
          .help = "spread what the panel's colours cannot show: by a Bayer matrix, or by blue noise (none)" },        \
        { "--shadow", SIM_OPTION_CHOICE, offsetof(type, member.shadow), .words = "none|planar|map",                   \
          .help =                                                                                                     \
              "a floor below the model, and the model's shadow on it: flattened, or by a shadow map of each light, "  \
              "which falls on the model too (none)" },                                                                \
        { "--environment", SIM_OPTION_FILE, offsetof(type, member.environment), .value = "IMAGE",                     \
          .help = "the model reflects this picture of a sphere (matcap)" },                                           \
    {                                                                                                                 \
        "--mirror", SIM_OPTION_FLAG, offsetof(type, member.mirror),                                                   \
            .help = "a floor below the model that reflects it; with --shadow every other square of it does"           \
    }

/* What they are where nothing is said. */
void sim_effects_defaults(struct sim_effect_options *e);

/* Read the texts of options that have parts. A plain x,y,z of --light goes to plain, and *has_plain becomes 1.
 * SIM_OK; SIM_USAGE where a text is not what it has to be; SIM_REFUSED where a value is out of range, said why about
 * `file`. */
int sim_effects_take(struct sim_effect_options *e, double plain[3], int *has_plain, const char *file);

/* Is a floor drawn? */
int sim_effects_floor(const struct sim_effect_options *e);

/* Does anything of it ask for more than the plain renderer does? */
/* The first of them that the double-precision reference does not know, as it is written; NULL: it knows all. */
const char *sim_effects_unreferenced(const struct sim_effect_options *e);
int sim_effects_any(const struct sim_effect_options *e);

#endif
