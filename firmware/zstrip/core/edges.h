/* The columns of a triangle's rows. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EDGES_H
#define ZS_EDGES_H

#include "core/fast.h"
#include "core/job.h"

/* Columns of rows [row, job->cut_end), by quotient and remainder. */
void zs_edges_columns(struct zs_job *job, int32_t row);

/* Find the spans of rows from `row` on: of ZS_CUT_ROWS, or up to job->row_end. */
static inline void zs_edges_cut(struct zs_job *job, int32_t row)
{
    const struct zs_renderer *r = job->r;
    job->row = row;
    job->cut_end = zs_min32(job->row_end, row + ZS_CUT_ROWS);
    if (!ZS_IF_FAST(r->edges) || !r->edges(job, row))
        zs_edges_columns(job, row);
}

#endif
