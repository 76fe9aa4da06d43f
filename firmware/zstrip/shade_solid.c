/* One colour a triangle: depth test and store.
 *
 * Pixel: key = sum >> 16, compare, store both, add. Nothing is divided and nothing is 64 bits wide.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade_solid.h"

#include "rows.h"

/* sum modulo 2^32: at covered pixels key + 1/2 bucket, in [0, 2^32) (plane.c) */
ZS_ALWAYS_INLINE void solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                                 uint32_t sum, uint32_t gx, int clamp)
{
    uint16_t *depth = job->depth + row->at + i0, *color = job->color + row->at + i0;
    const uint16_t *const end = depth + (i1 - i0);
    const uint16_t paint = job->tri->paint;
    const uint32_t top = clamp ? (job->r->view.key_top >> 16) - 1u : 0u;
    int32_t written = 0;
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

ZS_ALWAYS_INLINE void span_plain(struct zs_job *job, const struct zs_row *row)
{
    solid_span(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx, 0);
}

ZS_ALWAYS_INLINE void span_clamped(struct zs_job *job, const struct zs_row *row)
{
    solid_span(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx, 1);
}

void zs_solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                   uint32_t gx)
{
    if (job->saturates)
        solid_span(job, row, i0, i1, sum, gx, 1);
    else
        solid_span(job, row, i0, i1, sum, gx, 0);
}

void zs_solid_rows(struct zs_job *job)
{
    if (zs_keys_may_saturate(job))
        zs_rows_walk(job, span_clamped);
    else
        zs_rows_walk(job, span_plain);
}

void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    uint16_t *color = job->color + row->at;
    for (int32_t i = from; i < to; i++)
        color[i] = job->tri->paint;
}
