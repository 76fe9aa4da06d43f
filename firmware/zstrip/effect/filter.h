/* What the shaders of zs_filter.h share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_FILTER_H
#define ZS_EFFECT_FILTER_H

#include "effect/alpha_texels.h"
#include "shade/stages.h"

/* The `fetch` of a texture in place of the instance's (zs_texture_instead): bilinear, of texels in
 * the instance's format. */
extern const struct zs_texel zs_filter_bilinear;

/* The three shaders of a filter: unlit, lit for the face, lit at the vertices. check and check_lit
 * are functions; ... are further fields. */
#define ZS_FILTER_SHADERS(name, start_, run_, check_, check_lit_, ...)                             \
    const struct zs_shader zs_shade_##name = {                                                     \
        .vertex = zs_texture_vertex, .start = start_, .run = run_, .check = check_,                \
        .n_varyings = ZS_VARYINGS_TEXTURE, __VA_ARGS__                                             \
    };                                                                                             \
    const struct zs_shader zs_shade_##name##_flat = {                                              \
        .vertex = zs_texture_vertex, .face = zs_texture_lit_face, .start = start_, .run = run_,    \
        .check = check_, .light = zs_texture_light, .n_varyings = ZS_VARYINGS_TEXTURE, __VA_ARGS__ \
    };                                                                                             \
    const struct zs_shader zs_shade_##name##_smooth = {                                            \
        .vertex = zs_texture_lit_vertex, .start = start_, .run = run_, .check = check_lit_,        \
        .light = zs_texture_light, .n_varyings = ZS_VARYINGS_TEXTURE_SMOOTH, __VA_ARGS__           \
    }

#endif
