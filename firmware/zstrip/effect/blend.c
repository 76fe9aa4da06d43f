/* Alpha and additive blending of one colour a face.
 *
 * The source is multiplied by alpha once for each triangle. A pixel then takes a load, the spread
 * to three fields, a product and a sum, and the way back; keys are tested in the same loop.
 *
 * Alpha has 8 bits, and fields have room for 5. The old colour, 0 .. m, is multiplied by keep =
 * round(32 (1 - alpha / 255)) in 32nds, which is off by e of them, |e| <= 1/2. What that adds lies
 * within m / 128 of its middle, m e / 64, which is taken from the source's part. So the error is at
 * most 63 / 128 code, 1/64 for the rounding of the source's part, and 31/64 for that of the sum:
 * less than one.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/blend.h"
#include "effect/over.h"

#define KEEP base /* fields of job->c[0], which triangles of one colour do not use */
#define ADD gx

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* The part of a source's channel in a sum of 32nds: source * alpha, the middle of what keep is
 * off, and a half. code: 0 .. most; part = alpha / 255 * 2^21, off = 32 (keep - exact) * 2^16. */
static uint32_t share(uint32_t code, uint32_t most, uint32_t part, int32_t off)
{
    const int32_t middle = (int32_t)most * (off >> 1);                     /* |.| <= 63 * 2^14 */
    return (uint32_t)((int32_t)(code * part) - middle + (16 << 16)) >> 16; /* < 2^27.1, >= 0 */
}

static void mix_start(struct zs_job *job)
{
    const uint32_t alpha = zs_blend_of(job)->alpha, source = zs_blend_spread(job->tri->paint);
    const uint32_t part = alpha * 8224u + ((alpha + 1u) >> 3); /* alpha * 2^21 / 255, within 1 */
    const uint32_t gone = (part + 0x8000u) >> 16;              /* 0 .. 32 */
    const int32_t off = (int32_t)part - (int32_t)(gone << 16); /* |.| <= 2^15 */
    job->c[0].KEEP = 32u - gone;
    job->c[0].ADD = share(source >> ZS_BLEND_R & 31u, 31, part, off) << ZS_BLEND_R |
                    share(source >> ZS_BLEND_G & 63u, 63, part, off) << ZS_BLEND_G |
                    share(source >> ZS_BLEND_B & 31u, 31, part, off) << ZS_BLEND_B;
}

/* code * alpha / 255, nearest. */
static uint32_t scaled(uint32_t code, uint32_t alpha)
{
    const uint32_t t = code * alpha + 127u; /* < 2^14 */
    return (t + (t >> 8) + 1u) >> 8;
}

static void add_start(struct zs_job *job)
{
    const uint32_t alpha = zs_blend_of(job)->alpha, source = zs_blend_spread(job->tri->paint);
    job->c[0].ADD = scaled(source >> ZS_BLEND_R & 31u, alpha) << ZS_BLEND_R |
                    scaled(source >> ZS_BLEND_G & 63u, alpha) << ZS_BLEND_G |
                    scaled(source >> ZS_BLEND_B & 31u, alpha) << ZS_BLEND_B;
}

/* ---- Pixels ---------------------------------------------------------------------------------- */

/* zs_blend_mix or zs_blend_add. */
typedef uint16_t kernel_fn(uint32_t pixel, uint32_t keep, uint32_t add);

/* Blend n > 0 pixels. */
ZS_ALWAYS_INLINE void untested(const struct zs_job *job, uint16_t *at, int32_t n, kernel_fn *kernel)
{
    const uint32_t keep = job->c[0].KEEP, add = job->c[0].ADD;
    for (uint16_t *const end = at + n; at != end; at++)
        *at = kernel(*at, keep, add);
}

/* Test n > 0 pixels, and blend those that pass. Return how many, if ZS_STATS is 1. */
ZS_ALWAYS_INLINE int32_t tested(const struct zs_job *job, const uint16_t *depth, int32_t n,
                                uint32_t sum, uint32_t step, const struct zs_blend_test *test,
                                int plain, kernel_fn *kernel)
{
    const uint32_t keep = job->c[0].KEEP, add = job->c[0].ADD;
    const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth;
    const uint16_t *const end = depth + n;
    int32_t passed = 0;
    do {
        if (zs_blend_key(test, sum, plain) < *depth + (plain ? 0u : test->more)) {
            uint16_t *const at = (uint16_t *)((uintptr_t)depth + beside);
            *at = kernel(*at, keep, add);
            passed += ZS_STATS;
        }
        sum += step;
    } while (++depth != end);
    return passed;
}

ZS_ALWAYS_INLINE void span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                           uint32_t sum, uint32_t step, kernel_fn *kernel)
{
    const struct zs_blend_test test = zs_blend_test_of(job);
    const uint16_t *const depth = job->depth + row->at + i0;
    int32_t passed;
    if (test.plain)
        passed = tested(job, depth, i1 - i0, sum, step, &test, 1, kernel);
    else
        passed = tested(job, depth, i1 - i0, sum, step, &test, 0, kernel);
    zs_rows_written(job, passed);
}

static void mix_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    untested(job, job->color + row->at + from, to - from, zs_blend_mix);
}

static void mix_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                     uint32_t sum, uint32_t step)
{
    span(job, row, i0, i1, sum, step, zs_blend_mix);
}

static void add_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    untested(job, job->color + row->at + from, to - from, zs_blend_add);
}

static void add_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                     uint32_t sum, uint32_t step)
{
    span(job, row, i0, i1, sum, step, zs_blend_add);
}

#define SOLID(of, face_)                                                                           \
    {                                                                                              \
        .face = face_, .start = of##_start, .run = of##_run, .span = of##_span, .layer = 1         \
    }

const struct zs_shader zs_blend_raw = SOLID(mix, zs_over_raw_face);
const struct zs_shader zs_blend_flat = SOLID(mix, zs_over_flat_face);
const struct zs_shader zs_add_raw = SOLID(add, zs_over_raw_face);
const struct zs_shader zs_add_flat = SOLID(add, zs_over_flat_face);
