/* A textured triangle's coordinates: what texture.c, texture_run.c and accelerators share.
 * Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_TEXTURE_H
#define ZS_SHADE_TEXTURE_H

#include "zs_shader.h"
#include "shade/persp.h"

/* Texture coordinates walked along a run: fractions of the texture's size, modulo 1. */
struct zs_walk {
    uint32_t u, v, du, dv; /* uq0_32 */
};

struct zs_texel {
    /* n texels along a walk, RGB565 in wire order. */
    void (*fetch)(const struct zs_texture *texture, uint16_t *out, int32_t n,
                  const struct zs_walk *walk);
    uint16_t colors_max; /* of the palette; 0: there is none */
    uint8_t log2_w_min;
};

#define ZS_TEXTURE_GROUP_LOG2                                                                      \
    5                          /* pixels of a row that are affine together, or divided one by one */
#define ZS_TEXTURE_BIAS_LOG2 9 /* 2^-9 texel */
#define ZS_TEXTURE_FLOOR_LOG2 7u /* smaller textures are held to 1/8 texel of one of 128 */

/* log2 of the texels (of 128 or more to a repeat) that 16 bits stand for which are a difference of
 * coordinates, in 2^-uv_bits repeats, times 2^up. */
static inline int32_t zs_texture_texels(int32_t up, uint32_t uv_bits, uint32_t log2)
{
    return 16 - up - (int32_t)uv_bits + (int32_t)zs_maxu32(log2, ZS_TEXTURE_FLOOR_LOG2);
}

/* The shift that leaves a column or row of uq0_32. A texture of one: 31, and u or v is 0. */
static inline uint32_t zs_texture_cut(uint32_t log2)
{
    return log2 ? 32u - log2 : 31u;
}

/* Plain affine: 2^texels * change / least / 4 <= 1/8, for a range of all 16 bits. */
static inline int zs_texture_affine(int32_t texels, uint32_t change, uint32_t least)
{
    if (texels < 0)
        return texels < -31 || change >> -texels < least >> (ZS_SPAN_BOUND_LOG2 - 2);
    return texels < 31 && change <= (least >> (ZS_SPAN_BOUND_LOG2 - 2)) >> texels;
}

/* 256 * n / area * 2^(32 - uv_bits), nearest: a gradient in 2^-32 repeats, shift = 23 + uv_bits -
 * the leading zeros of the area, 1 .. 36. 0 in *ok where it does not fit 32 bits with its sign. |n|
 * < 2^31. Error 2^-30 of it and 1/2 ulp. */
static inline uint32_t zs_texture_gradient(uint32_t rcp, int32_t n, int32_t shift, int *ok)
{
    const int64_t product = zs_mul_su(n, rcp); /* |.| < 2^63 */
    if (shift > 32)
        return (uint32_t)((((int32_t)(product >> 32) >> (shift - 33)) + 1) >> 1);
    const int64_t q = product + (1u << (shift - 1));
    const int32_t hi = (int32_t)(q >> 32);
    if (shift == 32)
        return (uint32_t)hi;
    const uint32_t low = (uint32_t)hi << (32 - shift) | (uint32_t)q >> shift;
    *ok &= hi >> shift == (int32_t)low >> 31;
    return low;
}

/* The light's words: range * 2^-15 * 64 codes * change / least / 4 <= 1/8. */
static inline int zs_texture_light_affine(uint32_t range, uint32_t change, uint32_t least)
{
    return zs_mul_uu(range, change) <= (uint64_t)least << (11 - ZS_SPAN_BOUND_LOG2);
}

#define ZS_TEXTURE_LIGHT_ONE 1024u       /* light at a pixel, uq1_10 ... */
#define ZS_TEXTURE_LIGHT_SHIFT 21        /* ... of uq1_31 ... */
#define ZS_TEXTURE_LIGHT_HALF (1u << 20) /* ... to which a half of it is added */

/* RGB565 times light of 0 .. 2047 */
static inline uint32_t zs_texture_shine(uint32_t c, uint32_t level)
{
    const uint32_t rb = (((c & 0xf800u) << 5) | (c & 31u)) * level + 0x02000200u; /* 2 x 16 bits */
    const uint32_t g = ((c >> 5) & 63u) * level + 0x200u;                         /* < 2^17.1 */
    uint32_t red = rb >> 26, green = g >> 10, blue = (rb >> 10) & 63u;
    if (level > ZS_TEXTURE_LIGHT_ONE) {
        red = red > 31u ? 31u : red;
        green = green > 63u ? 63u : green;
        blue = blue > 31u ? 31u : blue;
    }
    return red << 11 | green << 5 | blue;
}

/* As zs_shader.run and .light. */
void zs_texture_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1);
void zs_texture_light(uint16_t *out, int32_t n, uint32_t l, uint32_t step);
/* Pixel i of a row of a triangle that is not affine, by a division of its own; by a reciprocal of
 * 15 bits where that does. */
void zs_texture_pixel(struct zs_job *job, const struct zs_row *row, int32_t i);

#define ZS_TEXTURE_FULL_LIGHT                                                                      \
    32768u /* zs_tri.paint, uq1_15, where a texture's colours are as they are */

/* attribute * w over w: uq2_30, a little below 0 or above 1 at most; 1/2 in 2^16 has been added to
 * c. */
static inline uint32_t zs_texture_coarse(uint32_t c, uint32_t rcp)
{
    return (uint32_t)((int32_t)c >> 16) * rcp; /* 16 bits with the sign, times 16: modulo 2^32 */
}

static inline void zs_texture_lighten(const struct zs_job *job, uint16_t *out, int32_t n,
                                      uint32_t level, int32_t step)
{
    const struct zs_shader *shader = job->shader;
    if (shader->n_varyings == 3)
        shader->light(out, n, level << 1, (uint32_t)step << 1);
    else if (!job->sampler.unlit)
        shader->light(out, n, (uint32_t)job->tri->paint << 16, 0);
}

#endif
