/* The walk over the scanlines of a triangle: from the columns that edges.c has found to spans, and
 * from spans to visible runs.
 *
 * The walk is inlined. The core calls it for its general path. Accelerators pass it a function of
 * their own as a constant, so that the compiler builds a separate loop for each.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ROWS_H
#define ZS_ROWS_H

#include "core/edges.h"

/* One scanline of a triangle. Columns count from the viewport's left side. */
struct zs_row {
    int32_t y;      /* row of the frame */
    int32_t at;     /* index of column 0 of this row in job->color and job->depth */
    uint32_t key;   /* job->key at column 0, modulo 2^32; undefined if keys are not linear */
    int32_t x0, x1; /* the span [x0, x1); it may reach beyond the viewport */
    int32_t i0, i1; /* the span, clipped to the viewport: [i0, i1), i0 < i1 */
    uint64_t w;     /* job->w64 at column 0, if keys are not linear */
};

typedef void zs_row_fn(struct zs_job *job, const struct zs_row *row);

/* Call span() for each scanline of a job that has pixels in the viewport. Spans come from job->cut,
 * which is filled again when it is used up. wide is a constant: 1 steps row.w as well. */
ZS_ALWAYS_INLINE void zs_rows_walk(struct zs_job *job, zs_row_fn *span, int wide)
{
    const int32_t width = job->width;
    uint32_t tested = 0;
    struct zs_row row;
    row.y = job->row;
    row.at = (row.y - job->y0) * job->pitch; /* < 2^24 */
    row.key = job->key.base - zs_wrap_mul(job->key.gx, job->geom.ia) +
              zs_wrap_mul(job->key.gy, row.y - job->geom.ja);
    if (wide)
        row.w = job->w64.base - zs_times(job->w64.gx, job->geom.ia) +
                zs_times(job->w64.gy, row.y - job->geom.ja);
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
            if (wide)
                row.w += job->w64.gy;
            row.at += job->pitch;
        }
        if (row.y >= job->row_end)
            break;
        zs_edges_cut(job, row.y);
    }
    job->r->stats.pixels_tested += tested;
}

/* Return the buckets to add to each key of a triangle with a depth state: bias and slope bias. */
int32_t zs_depth_state_bias(const struct zs_job *job);

/* Depth-test pixels [i0, i1) of a scanline with the job's depth state, and call the shader for each
 * run of pixels that pass. */
zs_piece_fn zs_rows_test;

/* zs_shader.run (shade/solid.c): fill pixels with the triangle's paint, a colour in memory. */
void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

/* Count n written pixels, if ZS_STATS is 1. */
ZS_ALWAYS_INLINE void zs_rows_written(struct zs_job *job, int32_t n)
{
    if (ZS_STATS)
        job->r->stats.pixels_written += (uint32_t)n;
}

/* Count the pixels of a triangle's rows. */
ZS_ALWAYS_INLINE void zs_rows_counted(struct zs_job *job, uint32_t tested, int32_t written)
{
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

#endif
