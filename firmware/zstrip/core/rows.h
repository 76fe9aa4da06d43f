/* The row loop that every kernel shares: a span a row, from columns that raster.c has found.
 *
 * Each kernel passes its span function as a constant, so that the compiler builds one loop a kernel.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ROWS_H
#define ZS_ROWS_H

#include "core/pipeline.h"

/* One row of a triangle in its strip. */
struct zs_row {
    int32_t y;      /* in the frame */
    int32_t at;     /* of its first pixel in the strip's buffers */
    uint32_t key;   /* job->key at column 0, modulo 2^32; nonsense where keys are not screen-linear */
    int32_t x0, x1; /* the span, first sample to one beyond the last; may reach beyond the frame */
    int32_t i0, i1; /* the part of it that is in the frame, i0 < i1 */
};

typedef void zs_span_fn(struct zs_job *job, const struct zs_row *row);

/* The rows of a job: those that are cut, then cut more. */
ZS_ALWAYS_INLINE void zs_rows_walk(struct zs_job *job, zs_span_fn *span)
{
    const int32_t width = job->width;
    uint32_t tested = 0;
    struct zs_row row;
    row.y = job->row;
    row.at = (row.y - job->y0) * width; /* < 2^24 */
    row.key = job->key.base - zs_wrap_mul(job->key.gx, job->geom.ia) +
              zs_wrap_mul(job->key.gy, row.y - job->geom.ja);
    for (;;) {
        for (const struct zs_cut *cut = job->cut; row.y < job->cut_end; row.y++, cut++) {
            row.x0 = cut->x0;
            row.x1 = cut->x1;
            row.i0 = zs_max32(row.x0, 0);
            row.i1 = zs_min32(row.x1, width);
            if (row.i0 < row.i1) {
                tested += (uint32_t)(row.i1 - row.i0);
                span(job, &row);
            }
            row.key += job->key.gy;
            row.at += width;
        }
        if (row.y >= job->row_end)
            break;
        zs_raster_cuts(job, row.y);
    }
    job->r->stats.pixels_tested += tested;
}

/* Draw pixels [i, i + n) of a row, on which keys are linear. */
ZS_ALWAYS_INLINE void zs_rows_piece(struct zs_job *job, const struct zs_row *row, int32_t i, int32_t n, uint32_t sum,
                                    uint32_t step)
{
#if ZS_LEAN
    zs_raster_span(job, row, i, i + n, sum, step);
#else
    int32_t to = i + n;
    for (;; sum += zs_wrap_mul(step, to - i), i = to, to = i + n) {
        if (job->fresh)
            to = zs_fresh_to(job, row, i, to);
        if (job->state) {
            const struct zs_state_kernel *kernel = job->state->kernel;
            kernel->span(job, row, i, to, sum, step);
        } else {
            const struct zs_shader *shader = job->shader;
            shader->span(job, row, i, to, sum, step);
        }
        n -= to - i;
        if (n <= 0)
            return;
    }
#endif
}

ZS_ALWAYS_INLINE void zs_rows_written(struct zs_job *job, int32_t n)
{
    if (ZS_STATS)
        job->r->stats.pixels_written += (uint32_t)n;
}

/* 1: a rounded key of the triangle might reach B - 1, which saturates at B - 2. Half a bucket and the
 * error of the plane (plane.c) below it, no key can. */
ZS_ALWAYS_INLINE int zs_keys_may_saturate(const struct zs_job *job)
{
    const uint32_t limit = job->r->view.key_top - 0x10000u;
    return job->v[0]->d >= limit || job->v[1]->d >= limit || job->v[2]->d >= limit;
}

/* The end of a run of pixels that pass the depth test: colour it. from < 0: there is none. */
ZS_ALWAYS_INLINE void zs_rows_run(struct zs_job *job, const struct zs_shader *shader,
                                  const struct zs_row *row, int32_t from, int32_t to)
{
    if (from < 0)
        return;
    zs_rows_written(job, to - from);
    shader->run(job, row, from, to);
}

/* Whether a key wins its pixel under a state, and its writing. */
ZS_ALWAYS_INLINE int zs_rows_state(const struct zs_job *job, const struct zs_state *state, uint32_t key,
                                   uint32_t top, uint16_t *depth)
{
    const int32_t moved = (int32_t)(key > top ? top : key) + job->bias;
    key = moved < 0 ? 0u : (uint32_t)moved > top ? top : (uint32_t)moved;
    if (key >= (uint32_t)*depth + (state->equal != 0))
        return 0;
    if (!state->read_only)
        *depth = (uint16_t)key;
    return 1;
}

#endif
