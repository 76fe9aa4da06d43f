/* Texture coordinates of a triangle: shared by shade/texture.c, shade/texture_run.c and
 * accelerators. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_TEXTURE_H
#define ZS_SHADE_TEXTURE_H

#include "zs_shader.h"
#include "shade/persp.h"

/* zs_shader.opaque of shaders that read texels through job->sampler.texture, and no filter yet:
 * zs_filtered_set takes these. */
#define ZS_TEXTURED 3u

/* Texture coordinates that are stepped along a run: fractions of the texture's size, modulo 1. */
struct zs_walk {
    uint32_t u, v, du, dv; /* uq0_32 */
};

struct zs_texel {
    /* Fetch n texels along a walk: RGB565, most significant byte first. */
    void (*fetch)(const struct zs_texture *texture, uint16_t *out, int32_t n,
                  const struct zs_walk *walk);
    /* The same, for the `fetch` of a format that stands in place of this one
     * (effect/alpha_texels.h). NULL in such formats. */
    void (*own)(const struct zs_texture *texture, uint16_t *out, int32_t n,
                const struct zs_walk *walk);
    uint16_t colors_max; /* of the palette; 0: there is none */
    uint8_t log2_bits; /* of a texel, 2 .. 4; 2: two texels share a byte */
    /* As fetch, and alphas too, 0 .. 255, to out[ZS_ALPHA_RUN ..]; n <= ZS_ALPHA_RUN
     * (effect/alpha_texels.h). NULL: every texel is opaque. */
    void (*both)(const struct zs_texture *, uint16_t *out, int32_t n, const struct zs_walk *walk);
    /* As both, for zs_job.gather; NULL: there is none. */
    zs_gather_fn *gather;
};

/* Return ZS_OK, or why the shaders cannot read a texture. */
static inline int zs_texture_error(const struct zs_texture *t)
{
    if (!t || !t->format || !t->texel || (t->format->colors_max && !t->palette))
        return ZS_ERR_NULL;
    if (t->log2_w > ZS_TEXTURE_LOG2_MAX || t->log2_h > ZS_TEXTURE_LOG2_MAX ||
        t->log2_w + t->format->log2_bits < 3 || t->clamp > (ZS_CLAMP_U | ZS_CLAMP_V))
        return ZS_ERR_TEXTURE;
    return ZS_OK;
}

#define ZS_TEXTURE_GROUP_LOG2                                                                      \
    5                          /* log2 of a group's pixels: affine, or divided one by one */
#define ZS_TEXTURE_BIAS_LOG2 9 /* 2^-9 texel is added to coordinates (shade/texture.c) */
#define ZS_TEXTURE_FLOOR_LOG2 7u /* the error bound of a smaller texture is that of one with 128
                                    texels: 1/4 of its texels */

/* A coordinate at the vertices of a triangle, 2^-uv_bits repeats: a of the first one, unsigned; d1
 * and d2, the differences of the others from it; range, the largest minus the least. */
struct zs_coordinate {
    int32_t a, d1, d2;
    uint32_t range;
};

ZS_ALWAYS_INLINE void zs_texture_coordinate(struct zs_coordinate *out, int32_t a, int32_t b,
                                            int32_t c)
{
    out->a = a;
    out->d1 = b - a;
    out->d2 = c - a;
    out->range = zs_range32(b - a, c - a);
}

/* Return the least n for which u and v each span less than 2^n texels, counting at least 128 texels
 * to a repeat. Or-ed, the two spans have as many bits as the larger. */
ZS_ALWAYS_INLINE int32_t zs_texture_most(const struct zs_texture *t, const struct zs_coordinate *u,
                                         const struct zs_coordinate *v, uint32_t uv_bits)
{
    const uint32_t both = /* < 2^(16 + 10) */
        (u->range | 1u) << zs_maxu32(t->log2_w, ZS_TEXTURE_FLOOR_LOG2) |
        (v->range | 1u) << zs_maxu32(t->log2_h, ZS_TEXTURE_FLOOR_LOG2);
    return 32 - zs_clz32(both) - (int32_t)uv_bits;
}

/* Return the shift from uq0_32 to a column or row. For a size of one texel it is 31; u or v is then
 * 0. */
static inline uint32_t zs_texture_cut(uint32_t log2)
{
    return log2 ? 32u - log2 : 31u;
}

/* Return 1 if affine interpolation is exact enough: 2^texels * change / least / 4 <= 1/4, for a
 * range of all 16 bits. */
static inline int zs_texture_affine(int32_t texels, uint32_t change, uint32_t least)
{
    if (texels < 0)
        return texels < -31 || change >> -texels < least >> (ZS_SPAN_BOUND_LOG2 - 2);
    return texels < 31 && change <= (least >> (ZS_SPAN_BOUND_LOG2 - 2)) >> texels;
}

/* Return v * rcp + more. rcp >= 2^31. A core with wide products takes one signed product,
 * v * (rcp - 2^32), and adds v * 2^32. */
static inline int64_t zs_times_rcp(int32_t v, uint32_t rcp, uint32_t more)
{
    if (ZS_CROSS_SHORT)
        return zs_mul_su(v, rcp) + more;
    return zs_mul_ss(v, (int32_t)(rcp - 0x80000000u) - 0x7fffffff - 1) +
           ((int64_t)v * ((int64_t)1 << 32) + more);
}

/* zs_texture_gradient for shift > 31; for any shift, with ZS_FOR_SIZE. */
uint64_t zs_texture_gentle(int32_t n, uint32_t rcp, int32_t shift);

#if ZS_DIVIDES
#define ZS_TEXTURE_GRADIENT ZS_ALWAYS_INLINE
#else /* few registers: a function of its own, for 0.5 % of relief_tex and 148 bytes on the M0 */
#define ZS_TEXTURE_GRADIENT static ZS_NOINLINE __attribute__((unused))
#endif

/* Return 256 * n / area * 2^(32 - uv_bits), nearest: a gradient in 2^-32 repeats. shift = 23 +
 * uv_bits - the leading zeros of the area, 1 .. 36. The upper word is not 0 if the result does not
 * fit 32 bits with its sign. |n| < 2^31. The error is 2^-30 of the result, and 1/2 ulp. */
ZS_TEXTURE_GRADIENT uint64_t zs_texture_gradient(int32_t n, uint32_t rcp, int32_t shift)
{
    if (ZS_FOR_SIZE || ZS_SELDOM(shift > 31))
        return zs_texture_gentle(n, rcp, shift);
    const int64_t q = zs_times_rcp(n, rcp, (uint32_t)1 << (shift - 1)); /* |.| < 2^63 */
    const int32_t hi = (int32_t)(q >> 32);
    const uint32_t low = (uint32_t)hi << (32 - shift) | (uint32_t)q >> shift;
    return (uint64_t)(uint32_t)(hi >> shift ^ (int32_t)low >> 31) << 32 | low;
}

/* Compute a coordinate's gradients, and its value at the sample x, y, q24_8, from the first vertex:
 * 2^-32 repeats, modulo one repeat. The 32768 that make coordinates unsigned are whole repeats. For
 * a range below 2^14; of g, the differences, at most 2^16, and rcp are used. shift: that of
 * gradients. Return not 0 if a gradient is too steep. */
ZS_ALWAYS_INLINE int32_t zs_texture_plane(struct zs_plane *out, const struct zs_coordinate *c,
                                          const struct zs_geom *g, int32_t shift, int32_t x,
                                          int32_t y, uint32_t uv_bits, uint32_t log2)
{
    const uint64_t gx = zs_texture_gradient(c->d1 * g->dy2 - c->d2 * g->dy1, g->rcp, shift),
                   gy = zs_texture_gradient(c->d2 * g->dx1 - c->d1 * g->dx2, g->rcp, shift);
    out->gx = (uint32_t)gx;
    out->gy = (uint32_t)gy;
    out->base = ((uint32_t)c->a << 1 << (31u - uv_bits)) +
                (1u << (32u - ZS_TEXTURE_BIAS_LOG2 - log2)) +
                zs_plane_step((int32_t)gx, x, (int32_t)gy, y);
    return (int32_t)((gx | gy) >> 32);
}

/* Return 1 if affine interpolation of the light is exact enough: range * 2^-15 * 64 codes * change
 * / least / 4 <= 1/4. */
static inline int zs_texture_light_affine(uint32_t range, uint32_t change, uint32_t least)
{
    return zs_mul_uu(range, change) <= (uint64_t)least << (11 - ZS_SPAN_BOUND_LOG2);
}

#define ZS_TEXTURE_LIGHT_ONE 1024u       /* light at a pixel, uq1_10 ... */
#define ZS_TEXTURE_LIGHT_SHIFT 21        /* ... of uq1_31 ... */
#define ZS_TEXTURE_LIGHT_HALF (1u << 20) /* ... to which a half of it is added */

/* Multiply an RGB565 value by light, uq1_10, 0 .. 2047. */
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

/* zs_shader.start, run and light of textured shaders. */
void zs_texture_start(struct zs_job *job);
void zs_texture_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1);
void zs_texture_light(uint16_t *out, int32_t n, uint32_t l, uint32_t step);
/* Colour pixel i of a scanline with a perspective division, in a triangle that is not affine. */
void zs_texture_pixel(struct zs_job *job, const struct zs_row *row, int32_t i);

#define ZS_TEXTURE_FULL_LIGHT                                                                      \
    32768u /* zs_tri.paint, uq1_15: light that leaves the texture's colours unchanged */

/* Divide attribute * w by w: uq2_30, at most slightly below 0 or above 1. The caller has added 1/2
 * in 2^16 to c. */
static inline uint32_t zs_texture_coarse(uint32_t c, uint32_t rcp)
{
    return (uint32_t)((int32_t)c >> 16) * rcp; /* 16 signed bits times 16 bits, modulo 2^32 */
}

/* Light n pixels: by the interpolated light, or by that of the face. */
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
