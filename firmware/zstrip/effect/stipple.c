/* Screen-door transparency: of 64 pixels, as many are drawn as alpha says, in an ordered pattern.
 *
 * Bayer's matrix M of order 8 has each of 0 .. 63 once: its value interleaves the bits of y and of
 * x ^ y, the lowest first. A pixel of the frame is drawn if M(x, y) < round(64 alpha / 255). A row
 * of the pattern is 8 bits, which repeat.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/stipple.h"

/* ---- The pattern ----------------------------------------------------------------------------- */

/* M(x, y) as [y][x]. */
static const uint8_t bayer[8][8] = {
    { 0, 32, 8, 40, 2, 34, 10, 42 },  { 48, 16, 56, 24, 50, 18, 58, 26 },
    { 12, 44, 4, 36, 14, 46, 6, 38 }, { 60, 28, 52, 20, 62, 30, 54, 22 },
    { 3, 35, 11, 43, 1, 33, 9, 41 },  { 51, 19, 59, 27, 49, 17, 57, 25 },
    { 15, 47, 7, 39, 13, 45, 5, 37 }, { 63, 31, 55, 23, 61, 29, 53, 21 }
};

uint32_t zs_stipple_pattern(const struct zs_job *job, const struct zs_row *row, uint32_t alpha,
                            uint32_t phase)
{
    const uint32_t level = zs_blend_weight(alpha), y = (uint32_t)row->y;
    const uint32_t x = (uint32_t)(row->x0 + job->r->view.x) + phase;
    const uint8_t *const line = bayer[(y + (phase >> 3)) & 7u];
    uint32_t bits = 0;
    for (uint32_t k = 0; k < 8; k++)
        bits |= (uint32_t)(line[(x + k) & 7u] < level) << k;
    return bits * 0x01010101u;
}

static uint32_t pattern_of(const struct zs_job *job, const struct zs_row *row)
{
    const struct zs_blend *const m = zs_blend_of(job);
    return zs_stipple_pattern(job, row, m->alpha, m->phase);
}

/* ---- Pixels ---------------------------------------------------------------------------------- */

/* Draw those of n pixels, 1 .. 32, that have a bit. */
static ZS_NOINLINE void masked(struct zs_job *job, const struct zs_row *row, int32_t from,
                               int32_t n, uint32_t bits, zs_run_fn *run)
{
    uint16_t old[ZS_OVER_MAX], *const at = job->color + row->at + from;
    if (bits == 0)
        return;
    if (run == zs_solid_run) {
        const uint16_t paint = job->tri->paint;
        for (uint16_t *to = at; bits; bits >>= 1, to++)
            if (bits & 1u)
                *to = paint;
        return;
    }
    zs_over_keep(old, at, n);
    run(job, row, from, from + n);
    for (int32_t k = 0; k < n; k++)
        if (!(bits >> k & 1u))
            at[k] = old[k];
}

ZS_ALWAYS_INLINE void run_over(struct zs_job *job, const struct zs_row *row, int32_t from,
                               int32_t to, zs_run_fn *run)
{
    const uint32_t bits = pattern_of(job, row);
    for (int32_t next; from < to; from = next) {
        next = zs_min32(zs_over_next(row, from), to);
        masked(job, row, from, next - from,
               zs_stipple_turned(bits, from - row->x0) & zs_stipple_bits(next - from), run);
    }
}

ZS_NOINLINE uint32_t zs_stipple_test(struct zs_job *job, uint16_t *depth, int32_t n, uint32_t sum,
                                     uint32_t step, uint32_t bits)
{
    const struct zs_blend_rule rule = zs_blend_rule(job);
    const int writes = !job->depth_state || !job->depth_state->read_only;
    uint32_t passed = 0;
    for (uint32_t bit = 1; n > 0; n--, depth++, sum += step, bit <<= 1) {
        if (!(bits & bit))
            continue;
        const uint32_t key = zs_blend_key(&rule, sum, 0);
        if (key >= *depth + rule.more)
            continue;
        passed |= bit;
        if (writes)
            *depth = (uint16_t)key;
        zs_rows_written(job, 1);
    }
    return passed;
}

ZS_ALWAYS_INLINE void span_over(struct zs_job *job, const struct zs_row *row, int32_t i0,
                                int32_t i1, uint32_t sum, uint32_t step, zs_run_fn *run)
{
    const uint32_t bits = pattern_of(job, row);
    for (int32_t next; i0 < i1; i0 = next) {
        next = zs_min32(zs_over_next(row, i0), i1);
        const uint32_t passed = zs_stipple_test(job, job->depth + row->at + i0, next - i0, sum,
                                                step, zs_stipple_turned(bits, i0 - row->x0));
        masked(job, row, i0, next - i0, passed, run);
        sum += zs_wrap_mul(step, next - i0);
    }
}

static void solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run_over(job, row, from, to, zs_solid_run);
}

static void solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                       uint32_t sum, uint32_t step)
{
    span_over(job, row, i0, i1, sum, step, zs_solid_run);
}

static void smooth_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run_over(job, row, from, to, zs_smooth_run);
}

static void smooth_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    span_over(job, row, i0, i1, sum, step, zs_smooth_run);
}

static void texture_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run_over(job, row, from, to, zs_texture_run);
}

static void texture_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                         uint32_t sum, uint32_t step)
{
    span_over(job, row, i0, i1, sum, step, zs_texture_run);
}

#define STIPPLE(of) .run = of##_run, .span = of##_span
const struct zs_shader zs_stipple_raw = { .face = zs_raw_face, STIPPLE(solid) };
const struct zs_shader zs_stipple_flat = { .face = zs_flat_face, STIPPLE(solid) };
const struct zs_shader zs_stipple_smooth = { ZS_OVER_SMOOTH(zs_smooth_usable), STIPPLE(smooth) };
const struct zs_shader zs_stipple_texture = { ZS_OVER_TEXTURE(zs_texture_start, zs_texture_usable),
                                              STIPPLE(texture) };
const struct zs_shader zs_stipple_texture_flat = {
    ZS_OVER_TEXTURE_FLAT(zs_texture_start, zs_texture_usable), STIPPLE(texture)
};
const struct zs_shader zs_stipple_texture_smooth = {
    ZS_OVER_TEXTURE_SMOOTH(zs_texture_start, zs_texture_lit_usable), STIPPLE(texture)
};
