/* What the shaders of zs_filter.h share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_FILTER_H
#define ZS_EFFECT_FILTER_H

#include "effect/alpha_texels.h"
#include "shade/stages.h"
#include "zs_filter.h"

/* Bilinear: the format of a texture in place of the instance's (zs_texture_instead), of texels in
 * the instance's format. Coordinates of that texture have so many bits below the texel, which count
 * in its size ... */
extern const struct zs_texel zs_filter_bilinear;
#define ZS_BILINEAR_LOG2 5u
/* ... and are counted from here after a border: the middle of the first texel, less 1/64 texel to
 * round. Return that in uq0_32 of a texture with 2^log2 texels. */
static inline int32_t zs_bilinear_first(uint32_t log2)
{
    return (int32_t)((1u << (31u - log2)) - (1u << (26u - log2)));
}

/* Let the rest of job's triangle be drawn so. To be called after the textured shader's start. */
void zs_bilinear_begin(struct zs_job *job);

/* Subtract from coordinate k of a triangle, 2^-32 repeats. */
static inline void zs_coordinate_less(struct zs_job *job, int k, int32_t by)
{
    if (job->sampler.direct)
        job->c[k].base -= (uint32_t)by;
    else
        job->sampler.base[k] -= (uint64_t)(int64_t)by; /* clamped ones need whole repeats */
}

struct zs_filter_kind {
    void (*instead)(struct zs_job *job); /* after the shader's start */
    void (*run)(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
    int (*check)(const struct zs_texture *t);
};

static inline const struct zs_filtered *zs_filtered_of(const struct zs_job *job)
{
    return (const struct zs_filtered *)(const void *)job->shader;
}
/* zs_filter_kind.run of filters without levels. */
void zs_filtered_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

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
