/* Blending of RGB565 pixels as they lie in memory, most significant byte first. Internal.
 *
 * A pixel is loaded as a half-word without a swap. Doubled, v | v << 16, it has each channel in one
 * piece on a little-endian machine: red in bits 3 .. 7 and 19 .. 23, green in 13 .. 18, blue in
 * 8 .. 12 and 24 .. 28. Big-endian machines swap.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_BLEND_H
#define ZS_EFFECT_BLEND_H

#include "core/fx.h"
#include "core/pass.h"
#include "core/rows.h"
#include "zs_blend.h"

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define ZS_BLEND_LOW_FIRST(v) (((v) << 8 & 0xff00u) | (v) >> 8)
#else
#define ZS_BLEND_LOW_FIRST(v) ((v)&0xffffu)
#endif

/* The material of the job's instance. */
static inline const struct zs_blend *zs_blend_of(const struct zs_job *job)
{
    return (const struct zs_blend *)(const void *)zs_instance_of(job->r, job->tri->instance)
        ->material;
}

/* ---- One word: fields with room for 5 more bits --------------------------------------------- */

#define ZS_BLEND_R 0u /* first bits of the fields */
#define ZS_BLEND_G 10u
#define ZS_BLEND_B 21u
#define ZS_BLEND_FIELDS (31u << ZS_BLEND_R | 63u << ZS_BLEND_G | 31u << ZS_BLEND_B)
#define ZS_BLEND_OVER                                                                              \
    (1u << (ZS_BLEND_R + 5u) | 1u << (ZS_BLEND_G + 6u) |                                           \
     1u << (ZS_BLEND_B + 5u)) /* the bit above each field */

/* Spread a pixel's channels to the three fields. */
ZS_ALWAYS_INLINE uint32_t zs_blend_spread(uint32_t pixel)
{
    const uint32_t v = ZS_BLEND_LOW_FIRST(pixel), two = v | v << 16;
    return (two >> 3 | two << 29) & ZS_BLEND_FIELDS;
}

/* The inverse, of fields * 2^3. Other bits are 0. */
ZS_ALWAYS_INLINE uint16_t zs_blend_gather(uint32_t fields_8)
{
    const uint32_t v = fields_8 | fields_8 >> 16;
    return (uint16_t)ZS_BLEND_LOW_FIRST(v);
}

/* (old * keep + add) / 32 in each field. keep: 0 .. 32; the sums are below 32 * 32 (64 * 32). */
ZS_ALWAYS_INLINE uint16_t zs_blend_mix(uint32_t pixel, uint32_t keep, uint32_t add)
{
    return zs_blend_gather((zs_blend_spread(pixel) * keep + add) >> 2 & ZS_BLEND_FIELDS << 3);
}

/* old + add in each field, at most full. */
ZS_ALWAYS_INLINE uint16_t zs_blend_add(uint32_t pixel, uint32_t keep, uint32_t add)
{
    const uint32_t sum = zs_blend_spread(pixel) + add, over = sum & ZS_BLEND_OVER;
    const uint32_t full = (over - (over >> 5)) | over >> 6; /* green has a bit more */
    (void)keep;
    return zs_blend_gather(((sum | full) & ZS_BLEND_FIELDS) << 3);
}

/* ---- Two words: red and blue, and green, with room for 6 more bits -------------------------- */

#define ZS_BLEND_ONE 64u /* alpha, uq_6 */
#define ZS_BLEND_RB (31u << 19 | 31u << 8)
#define ZS_BLEND_GREEN (63u << 13)

/* Alpha, 0 .. 255, in 64ths, nearest: within 1/128 of alpha / 255. */
static inline uint32_t zs_blend_weight(uint32_t alpha)
{
    const uint32_t t = alpha * ZS_BLEND_ONE + 127u; /* < 2^15 */
    return (t + (t >> 8) + 1u) >> 8;                /* floor(t / 255) */
}

/* (old * (64 - weight) + source * weight) / 64, nearest. Error below 63 / 128 + 1/2 code. Sums of
 * blue are below 2^19, those of red below 2^30, of green below 2^25. */
ZS_ALWAYS_INLINE uint16_t zs_blend_over(uint32_t old, uint32_t source, uint32_t weight)
{
    uint32_t d = ZS_BLEND_LOW_FIRST(old), s = ZS_BLEND_LOW_FIRST(source);
    const uint32_t keep = ZS_BLEND_ONE - weight;
    d |= d << 16;
    s |= s << 16;
    const uint32_t rb = (d & ZS_BLEND_RB) * keep + (s & ZS_BLEND_RB) * weight +
                        (32u << 19 | 32u << 8);
    const uint32_t g = (d & ZS_BLEND_GREEN) * keep + (s & ZS_BLEND_GREEN) * weight + (32u << 13);
    const uint32_t out = (rb >> 6 & ZS_BLEND_RB) | (g >> 6 & ZS_BLEND_GREEN);
    const uint32_t v = out | out >> 16;
    return (uint16_t)ZS_BLEND_LOW_FIRST(v);
}

/* old + source * weight / 64, the product to nearest, at most full. */
ZS_ALWAYS_INLINE uint16_t zs_blend_plus(uint32_t old, uint32_t source, uint32_t weight)
{
    uint32_t d = ZS_BLEND_LOW_FIRST(old), s = ZS_BLEND_LOW_FIRST(source);
    d |= d << 16;
    s |= s << 16;
    uint32_t rb = (s & ZS_BLEND_RB) * weight + (32u << 19 | 32u << 8);
    uint32_t g = (s & ZS_BLEND_GREEN) * weight + (32u << 13);
    rb = (d & ZS_BLEND_RB) + (rb >> 6 & ZS_BLEND_RB); /* the bits above the fields are free */
    g = (d & ZS_BLEND_GREEN) + (g >> 6 & ZS_BLEND_GREEN);
    const uint32_t over = rb & (1u << 24 | 1u << 13), over_g = g & 1u << 19;
    rb |= over - (over >> 5);
    g |= over_g - (over_g >> 6);
    const uint32_t out = (rb & ZS_BLEND_RB) | (g & ZS_BLEND_GREEN);
    const uint32_t v = out | out >> 16;
    return (uint16_t)ZS_BLEND_LOW_FIRST(v);
}

/* ---- The depth test ------------------------------------------------------------------------- */

/* The test of a triangle's pixels, as in core/depth_test.c. */
struct zs_blend_test {
    int32_t bias, most;
    uint32_t more; /* a key passes if it is below depth + more */
    int plain;     /* 1: key = sum / 65536, and it passes if it is less */
};

static inline struct zs_blend_test zs_blend_test_of(const struct zs_job *job)
{
    const struct zs_depth_state *state = job->depth_state;
    const int32_t top = (int32_t)(job->r->view.key_top >> 16) - 1;
    struct zs_blend_test t = { 0, top, 0, !job->saturates };
    if (state) {
        t.bias = job->bias;
        t.most = top + zs_min32(job->bias, 0);
        t.more = state->func == ZS_DEPTH_LESS ? 0u : state->func == ZS_DEPTH_ALWAYS ? 65536u : 1u;
        t.plain &= t.bias == 0 && t.more == 0;
    }
    return t;
}

/* The key of a sum. */
ZS_ALWAYS_INLINE uint32_t zs_blend_key(const struct zs_blend_test *t, uint32_t sum, int plain)
{
    if (plain)
        return sum >> 16;
    const int32_t moved = zs_min32((int32_t)(sum >> 16) + t->bias, t->most);
    return moved < 0 ? 0u : (uint32_t)moved;
}

#endif
