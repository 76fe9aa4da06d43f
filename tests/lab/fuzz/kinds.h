/* What the fuzzers choose from: one table a kind. A new shader, mapping or format is fuzzed once it is
 * listed here.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_KINDS_H
#define TESTS_FUZZ_KINDS_H

#include "own.h"
#include "zs_blend.h"
#include "zs_method.h"
#include "zstrip.h"

#define KINDS(table) (sizeof(table) / sizeof(table)[0])

struct kind_shader {
    const struct zs_shader *shader;
    const char *name;
    uint8_t attrs;   /* config.varyings that it needs */
    uint8_t texture; /* 1: reads material.texture and mesh.uv */
};

static const struct kind_shader kind_shaders[] = {
    { &zs_shade_raw, "raw", ZS_VARYINGS_FLAT, 0 },
    { &zs_shade_flat, "flat", ZS_VARYINGS_FLAT, 0 },
    { &zs_shade_smooth, "smooth", ZS_VARYINGS_SMOOTH, 0 },
    { &zs_shade_texture, "texture", ZS_VARYINGS_TEXTURE, 1 },
    { &zs_shade_texture_flat, "texture_flat", ZS_VARYINGS_TEXTURE, 1 },
    { &zs_shade_texture_smooth, "texture_smooth", ZS_VARYINGS_TEXTURE_SMOOTH, 1 },
    { &own_shader, "own", 3, 0 },
    { &glass_shader, "glass", 3, 0 },
};

struct kind_depth {
    const struct zs_depth *depth;
    const char *name;
    uint8_t any_camera; /* 0: perspective only */
};

static const struct kind_depth kind_depths[] = {
#define KIND(name_, any_camera_) { &zs_depth_##name_, #name_, any_camera_ },
    ZS_DEPTH_EACH(KIND)
#undef KIND
};

struct kind_method {
    const struct zs_method *method; /* NULL: the depth buffer */
    const char *name;
    const struct zs_depth *depth;   /* the mapping that it needs; NULL: any with depth memory */
    uint16_t least_tris, least_verts;
};

static const struct kind_method kind_methods[] = {
    { NULL, "zbuffer", NULL, 1, 3 },
#define KIND(name_, depth_, tris_, verts_, records_) { &zs_method_##name_, #name_, depth_, tris_, verts_ },
    ZS_METHOD_EACH(KIND)
#undef KIND
    { &zs_method_transparent, "transparent", NULL, 2, 6 },
};

/* The row of a configuration's method, which is one of them. */
static inline const struct kind_method *method_of(const struct zs_config *c)
{
    const struct kind_method *k = kind_methods;
    while (k->method != c->method)
        k++;
    return k;
}

struct kind_texel {
    const struct zs_texel *format;
    const char *name;
    uint8_t bits;        /* a texel */
    uint16_t colors_max; /* 0: no palette */
};

static const struct kind_texel kind_texels[] = {
    { &zs_texel_565, "565", 16, 0 },
    { &zs_texel_pal8, "pal8", 8, 256 },
    { &zs_texel_pal4, "pal4", 4, 16 },
};

/* Shaders that are opaque, and those that lay the same colour over what is there. */
static const struct zs_shader *const layer_shaders[6][4] = {
    { &zs_shade_raw, &zs_blend_raw, &zs_add_raw, &zs_stipple_raw },
    { &zs_shade_flat, &zs_blend_flat, &zs_add_flat, &zs_stipple_flat },
    { &zs_shade_smooth, &zs_blend_smooth, &zs_add_smooth, &zs_stipple_smooth },
    { &zs_shade_texture, &zs_blend_texture, &zs_add_texture, &zs_stipple_texture },
    { &zs_shade_texture_flat, &zs_blend_texture_flat, &zs_add_texture_flat, &zs_stipple_texture_flat },
    { &zs_shade_texture_smooth, &zs_blend_texture_smooth, &zs_add_texture_smooth, &zs_stipple_texture_smooth },
};
enum layer_kind { OPAQUE, BLEND, ADD, STIPPLE };

#endif
