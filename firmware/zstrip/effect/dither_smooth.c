/* Smooth shading, dithered to RGB565 where its colours still have 16 fraction bits.
 *
 * Set-up and sub-spans are those of shade/smooth.c. That adds half a code and cuts; here
 * a threshold t of the pattern takes the place of the half: (t - 1/2) * 31/32 is added to a code
 * that has the half already. The sum with a code c of 0 .. most is above c + 0.015 and below
 * c + 0.985, so that the error of planes, 0.014 codes, leads to no level below 0 or above most.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/plane.h"
#include "shade/persp.h"
#include "shade/stages.h"
#include "zs_dither.h"
#include "zs_shader.h"

static const uint8_t up[3] = { 11, 10, 11 }; /* from codes in uq16_16 to the top of a word */

/* A row of the pattern: ranks, and how they become parts of a code of 5 bits at the top of a word:
 * 2 rank * scale + scale - half, |.| < 2^26 * 31/32. */
struct threshold {
    const uint8_t *rank;
    uint32_t mask, scale;
};
#define HALF ((1u << 26) / 32u * 31u)

/* Fill n > 0 pixels with colours that change by step; the first one is in column x. */
static void fill(uint16_t *out, int32_t n, const uint32_t c[3], const uint32_t step[3], uint32_t x,
                 const struct threshold *t)
{
    const struct threshold at = { t->rank, t->mask, 2u * t->scale };
    const uint32_t least = t->scale - HALF; /* < 0, modulo 2^32; even */
    uint32_t red = c[0] + least, green = c[1] - (0u - least) / 2u, blue = c[2] + least;
    for (uint16_t *const end = out + n; out != end; out++, x++) {
        const uint32_t by = at.rank[x & at.mask] * at.scale; /* < 2^27 */
        *out = zs_smooth_pack(red + by, green + (by >> 1), blue + by);
        red += step[0];
        green += step[1];
        blue += step[2];
    }
}

/* Return the change for each pixel where a colour changes from c to next over `length` pixels. */
static uint32_t step_of(uint32_t c, uint32_t next, int32_t length)
{
    return (uint32_t)(zs_mul_su((int32_t)(next - c), zs_one_over(length)) >> 32);
}

static void run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1,
                const struct zs_dither_pattern *pattern)
{
    const uint32_t log2 = pattern->log2, mask = (1u << log2) - 1u;
    const struct threshold t = { pattern->rank + (((uint32_t)row->y & mask) << log2), mask,
                                 ((1u << 26) >> 2u * log2) / 32u * 31u };
    const uint32_t x = job->r->view.x; /* of the viewport's left side in the frame */
    uint16_t *const color = job->color + row->at;
    uint32_t c[3], next[3], step[3];
    if (job->sub_log2 == ZS_AFFINE) {
        for (int k = 0; k < 3; k++) {
            c[k] = zs_plane_at(&job->c[k], r0, row->y);
            step[k] = job->c[k].gx;
        }
        fill(color + r0, r1 - r0, c, step, x + (uint32_t)r0, &t);
        return;
    }
    const int32_t length = 1 << job->sub_log2;
    int32_t from = row->x0 + ((r0 - row->x0) & -length);
    zs_smooth_at(job, from, row->y, next);
    for (; from < r1; from += length) {
        const int32_t to = zs_min32(from + length, row->x1 - 1); /* its far end: a covered pixel */
        const int32_t i0 = zs_max32(from, r0), i1 = zs_min32(from + length, r1);
        for (int k = 0; k < 3; k++)
            c[k] = next[k];
        if (to > from)
            zs_smooth_at(job, to, row->y, next);
        for (int k = 0; k < 3; k++) {
            const uint32_t by = step_of(c[k], next[k], to - from);
            c[k] = (c[k] + zs_wrap_mul(by, i0 - from)) << up[k];
            step[k] = by << up[k];
        }
        fill(color + i0, i1 - i0, c, step, x + (uint32_t)i0, &t);
    }
}

static void ordered_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run(job, row, from, to, &zs_dither_ordered);
}

static void blue_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run(job, row, from, to, &zs_dither_blue);
}

/* zs_shade_smooth but for how a run is written. */
#define DITHERED(run_) \
    { .vertex = zs_smooth_vertex, .start = zs_smooth_start, .run = (run_), \
      .check = zs_smooth_usable, .n_varyings = ZS_VARYINGS_SMOOTH, .opaque = 1 }

const struct zs_shader zs_shade_smooth_ordered = DITHERED(ordered_run);
const struct zs_shader zs_shade_smooth_blue = DITHERED(blue_run);
