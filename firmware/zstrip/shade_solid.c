/* One colour a triangle: depth test and store.
 *
 * Pixel: key = sum >> 16, compare, store both, add. Nothing is divided and nothing is 64 bits wide.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade_solid.h"

#include "rows.h"

ZS_ALWAYS_INLINE void solid_span(struct zs_job *job, int32_t row, int32_t x0, int32_t x1, int clamp)
{
    x0 = zs_max32(x0, 0);
    x1 = zs_min32(x1, job->width);
    const uint32_t gx = job->key.gx;
    /* modulo 2^32: at covered pixels key + 1/2 bucket, in [0, 2^32) (plane.c) */
    uint32_t sum = job->key.base + zs_wrap_mul(gx, x0 - job->geom.ia) +
                   zs_wrap_mul(job->key.gy, row - job->geom.ja);
    const int32_t at = (row - job->y0) * job->width; /* < 2^24 */
    uint16_t *depth = job->depth + at + x0, *color = job->color + at + x0;
    const uint16_t *const end = job->depth + at + x1;
    const uint16_t paint = job->tri->paint;
    const uint32_t top = (job->r->view.key_top >> 16) - 1u;
    int32_t written = 0;
    zs_rows_tested(job, x1 - x0);
    for (; depth != end; depth++, color++, sum += gx) {
        uint32_t key = sum >> 16;
        if (clamp && key > top)
            key = top;
        if (key < *depth) {
            *depth = (uint16_t)key;
            *color = paint;
            if (ZS_STATS)
                written++;
        }
    }
    zs_rows_written(job, written);
}

static inline void span_plain(void *ctx, int32_t row, int32_t x0, int32_t x1)
{
    solid_span(ctx, row, x0, x1, 0);
}

static inline void span_clamped(void *ctx, int32_t row, int32_t x0, int32_t x1)
{
    solid_span(ctx, row, x0, x1, 1);
}

void zs_solid_rows(struct zs_job *job)
{
    if (zs_keys_may_saturate(job))
        zs_rows_walk(job, span_clamped, job);
    else
        zs_rows_walk(job, span_plain, job);
}

void zs_solid_run(struct zs_job *job, int32_t row, int32_t x0, int32_t x1, int32_t r0, int32_t r1)
{
    (void)x0;
    (void)x1;
    uint16_t *color = job->color + (row - job->y0) * job->width;
    for (int32_t i = r0; i < r1; i++)
        color[i] = job->tri->paint;
}
