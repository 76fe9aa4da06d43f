/* What random scenes may be drawn with besides the kinds of kinds.h: effect/, overlay/, lines and points. A new effect
 * is fuzzed and stressed once it is listed here.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_EFFECTS_H
#define TESTS_FUZZ_EFFECTS_H

#include "kinds.h"
#include "prng.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_lines.h"
#include "zs_overlay.h"
#include "zs_shadow.h"

enum effect_needs {
    EFFECT_TEXTURE = 1,  /* reads material.texture and mesh.uv */
    EFFECT_BUFFER = 2,   /* refused by methods that take a triangle for a wall */
    EFFECT_PLAIN = 4,    /* for the depth buffer and no other method */
    EFFECT_LIT = 8,      /* its material is a struct zs_lit_material, ... */
    EFFECT_SHADOWED = 16, /* ... a struct zs_shadowed_material, ... */
    EFFECT_LAMP_MAP = 32  /* ... a struct zs_shadowed_phong, which begins as a struct zs_shadowed_lit; else a struct
                             zs_blend does for all */
};

struct kind_effect {
    const struct zs_shader *shader;
    const char *name;
    uint8_t needs; /* enum effect_needs, or-ed */
};

#define EFFECT_KINDS 60
extern const struct kind_effect kind_effects[EFFECT_KINDS];

/* Formats with alpha. */
#define EFFECT_TEXELS 3
extern const struct kind_texel kind_alpha_texels[EFFECT_TEXELS];

/* Any of the structs that materials of effects are. */
union effect_material {
    struct zs_material material;
    struct zs_lit_material lit;
    struct zs_blend blend;
    struct zs_shadowed_material shadowed;
    struct zs_shadowed_phong phong;
};

enum effect_hook { EFFECT_FOG, EFFECT_DITHER, EFFECT_OVERLAY, EFFECT_HOOKS };

#define EFFECT_LINES 40 /* of a primitive */
#define EFFECT_ITEMS 4
#define EFFECT_MAP 32 /* a shadow map's sides, at most */

/* What such materials and hooks point to. One instance of it a scene; of a fixed address while the scene lives. */
struct effects {
    struct zs_lamp lamp[ZS_LIGHTS_MAX];
    struct zs_lighting lighting, single; /* the first lamp alone */
    struct zs_shine shine;
    struct zs_shadow_map map;
    uint16_t key[EFFECT_MAP * EFFECT_MAP];
    struct zs_depth_state lift; /* what zs_shade_shadow takes */
    uint16_t line[EFFECT_LINES][2];
    struct zs_lines lines;
    struct zs_points points;
    struct zs_sky_gradient sky;
    struct zs_fog fog;
    struct zs_dither dither;
    struct zs_item item[EFFECT_ITEMS];
    uint32_t memory[ZS_OVERLAY_WORDS(EFFECT_ITEMS)];
    struct zs_overlay overlay;
};

/* Set the lamps, the shine, the lines and the items at random. size: of the scene, world units. */
void effects_make(struct effects *e, struct prng *p, int64_t size);
/* Draw the shadow map of instances by a light of the scene's size, twice, in two ways. 1: the same map, or none. */
int effects_map(struct effects *e, struct prng *p, const struct zs_instance *in, uint32_t n, int64_t size);
/* A material at random: of an effect, or lines or points by such a shader. without: enum effect_needs not to be. */
void effects_cover(struct effects *e, struct prng *p, union effect_material *m, const struct zs_texture *texture,
                   uint32_t without);
/* A hook over strips, of one kind. 1; 0: it cannot be with this frame, and *hook is as it was. */
int effects_hook(struct effects *e, struct prng *p, enum effect_hook kind, const struct zs_config *config,
                 const struct zs_camera *camera, struct zs_resolve *hook);
/* The effect of a shader, or -1. */
int effects_of(const struct zs_shader *shader);

#endif
