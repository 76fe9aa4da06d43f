/* One colour a triangle: depth test and store.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade/solid.h"

#if !ZS_LEAN

/* Keys that do not saturate: as zs_rows_walk walks rows, with little else in registers. */
static ZS_NOINLINE void walk(struct zs_job *job)
{
    const int32_t width = job->width;
    const uint32_t gx = job->key.gx;
    const uint16_t paint = job->tri->paint;
    uint32_t tested = 0;
    int32_t written = 0, y = job->row;
    const uintptr_t beside = zs_solid_beside(job);
    uint16_t *depth = job->depth + (y - job->y0) * width;
    uint32_t key = job->key.base - zs_wrap_mul(gx, job->geom.ia) + zs_wrap_mul(job->key.gy, y - job->geom.ja);
    for (;;) {
        const struct zs_cut *cut = job->cut, *const end = cut + (job->cut_end - y);
        for (; cut != end; cut++) {
            const int32_t i0 = zs_max32(cut->x0, 0), n = zs_min32(cut->x1, width) - i0;
            if (n > 0) {
                tested += (uint32_t)n;
                written += zs_solid_pixels(depth + i0, beside, n, key + zs_wrap_mul(gx, i0), gx, paint, 0, 0);
            }
            depth += width;
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
    const uintptr_t beside = zs_solid_beside(job);
    uint16_t *depth = job->depth + row->at + i0;
    const uint16_t paint = job->tri->paint;
    int32_t written;
    if (job->saturates)
        written = zs_solid_pixels(depth, beside, i1 - i0, sum, gx, paint, (job->r->view.key_top >> 16) - 1u, 1);
    else
        written = zs_solid_pixels(depth, beside, i1 - i0, sum, gx, paint, 0, 0);
    zs_rows_written(job, written);
}

void zs_solid_rows(struct zs_job *job)
{
    job->saturates = (uint8_t)zs_keys_may_saturate(job);
    if (job->saturates)
        zs_raster_spans(job);
    else
        walk(job);
}

#endif

void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
#if ZS_LEAN
    for (uint16_t *at = job->color + row->at + from, *const end = at + (to - from); at != end; at++)
        *at = job->tri->paint;
#else
    zs_fill_run(job->color + row->at + from, job->tri->paint, (uint32_t)(to - from));
#endif
}
