/* Edges: where they cross the scanlines, which gives the span of each scanline. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EDGES_H
#define ZS_EDGES_H

#include "core/fast.h"
#include "core/job.h"

/* Find the spans of rows [row, job->cut_end) into job->cut; each edge is stepped by quotient and
 * remainder. */
void zs_edges_columns(struct zs_job *job, int32_t row);

/* Find the spans of the next ZS_CUT_ROWS rows from `row` on, or fewer, up to job->row_end. */
static inline void zs_edges_cut(struct zs_job *job, int32_t row)
{
    const struct zs_renderer *r = job->r;
    job->row = row;
    job->cut_end = zs_min32(job->row_end, row + ZS_CUT_ROWS);
    if (!ZS_IF_FAST(r->edges) || !r->edges(job, row))
        zs_edges_columns(job, row);
}

/* Return 1 if the spans of all rows are known and empty. */
static inline int zs_edges_none(const struct zs_job *job)
{
    if (job->cut_end < job->row_end)
        return 0;
    const struct zs_cut *cut = job->cut, *const end = cut + (job->cut_end - job->row);
    while (cut != end && cut->x0 >= cut->x1)
        cut++;
    return cut == end;
}

#endif
