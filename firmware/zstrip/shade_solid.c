/* One colour a triangle: depth test and store.
 *
 * Pixel: key = sum >> 16, compare, store both, add. Nothing is divided and nothing is 64 bits wide.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade_solid.h"

#include "rows.h"

/* n > 0 pixels up to the two ends, counted up to 0: an index that both share. sum modulo 2^32: at covered pixels
 * key + 1/2 bucket, in [0, 2^32) (plane.c). Return how many are written, where that is counted. */
ZS_ALWAYS_INLINE int32_t solid_pixels(uint16_t *depth_end, uint16_t *color_end, int32_t n, uint32_t sum, uint32_t gx,
                                      uint16_t paint, uint32_t top, int clamp)
{
    int32_t written = 0;
    for (int32_t i = -n; i != 0; i++, sum += gx) {
        uint32_t key = sum >> 16;
        if (clamp && key > top)
            key = top;
        if (key < depth_end[i]) {
            depth_end[i] = (uint16_t)key;
            color_end[i] = paint;
            if (ZS_STATS)
                written++;
        }
    }
    return written;
}

/* Keys that do not saturate: as zs_rows_walk walks rows, with little else in registers. */
static ZS_NOINLINE void walk(struct zs_job *job)
{
    const int32_t width = job->width;
    const uint32_t gx = job->key.gx;
    const uint16_t paint = job->tri->paint;
    uint32_t tested = 0;
    int32_t written = 0, y = job->row;
    uint16_t *depth = job->depth + (y - job->y0) * width, *color = job->color + (y - job->y0) * width;
    uint32_t key = job->key.base - zs_wrap_mul(gx, job->geom.ia) + zs_wrap_mul(job->key.gy, y - job->geom.ja);
    for (;;) {
        const struct zs_cut *cut = job->cut, *const end = cut + (job->cut_end - y);
        for (; cut != end; cut++) {
            const int32_t i0 = zs_max32(cut->x0, 0), i1 = zs_min32(cut->x1, width), n = i1 - i0;
            if (n > 0) {
                tested += (uint32_t)n;
                written += solid_pixels(depth + i1, color + i1, n, key + zs_wrap_mul(gx, i0), gx, paint, 0, 0);
            }
            depth += width;
            color += width;
            key += job->key.gy;
        }
        y = job->cut_end;
        if (y >= job->row_end)
            break;
        zs_raster_cuts(job, y);
    }
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

void zs_solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                   uint32_t gx)
{
    const uint32_t top = (job->r->view.key_top >> 16) - 1u;
    zs_rows_written(job, solid_pixels(job->depth + row->at + i1, job->color + row->at + i1, i1 - i0, sum, gx,
                                      job->tri->paint, top, 1));
}

ZS_ALWAYS_INLINE void span_clamped(struct zs_job *job, const struct zs_row *row)
{
    zs_solid_span(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx);
}

void zs_solid_rows(struct zs_job *job)
{
    if (zs_keys_may_saturate(job))
        zs_rows_walk(job, span_clamped);
    else
        walk(job);
}

void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    uint16_t *color = job->color + row->at;
    for (int32_t i = from; i < to; i++)
        color[i] = job->tri->paint;
}
