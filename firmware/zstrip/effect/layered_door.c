/* Any shader behind a screen-door pattern.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/layered.h"
#include "effect/stipple.h"

static uint32_t pattern_of(const struct zs_job *job, const struct zs_row *row)
{
    const struct zs_layered *const layer = zs_layered_of(job);
    return zs_stipple_pattern(job, row, layer->alpha, layer->phase);
}

/* Draw those of columns [from, to), at most 32, that have a bit. */
static void masked(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                   uint32_t bits)
{
    uint16_t px[ZS_OVER_MAX], *at = job->color + row->at + from;
    if (!bits)
        return;
    zs_layered_draw(job, row, from, to, px);
    for (const uint16_t *of = px; bits; bits >>= 1, of++, at++)
        if (bits & 1u)
            *at = *of;
}

static void door_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const uint32_t bits = pattern_of(job, row);
    for (int32_t next; from < to; from = next) {
        next = zs_min32(zs_over_next(row, from), to);
        masked(job, row, from, next,
               zs_stipple_turned(bits, from - row->x0) & zs_stipple_bits(next - from));
    }
}

static void door_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                      uint32_t sum, uint32_t step)
{
    const uint32_t bits = pattern_of(job, row);
    for (int32_t next; i0 < i1; i0 = next) {
        next = zs_min32(zs_over_next(row, i0), i1);
        masked(job, row, i0, next,
               zs_stipple_test(job, job->depth + row->at + i0, next - i0, sum, step,
                               zs_stipple_turned(bits, i0 - row->x0)));
        sum += zs_wrap_mul(step, next - i0);
    }
}

const struct zs_layer_kind zs_layer_door = { .run = door_run, .span = door_span };
