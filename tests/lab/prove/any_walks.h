/* The loop over rows: strips of ROWS rows of 1 and of 4096 columns, triangles of 1, 16 and up to ROWS rows from the
 * first, the fourth and the last on, any columns (any_columns.h), any anchor. What includes it has core/rows.h, ROWS,
 * `renderer` and `job`, whose planes it has set.
 *
 * SPDX-License-Identifier: MIT
 */
#include "any_columns.h"

static inline void any_walks(zs_row_fn *span, int wide)
{
    static const int32_t width[2] = { 1, ZS_SIZE_MAX }, from[3] = { 0, 3, ROWS - 1 }, n[3] = { 1, ZS_CUT_ROWS, ROWS };
    job.r = &renderer;
    job.y0 = 4 * ROWS;
    job.y1 = job.y0 + ROWS;
    job.geom.ia = any_i32(-(1 << 14), 1 << 14);
    job.geom.ja = any_i32(-(1 << 14), 1 << 14);
    for (int k = 0; k < 18; k++) {
        const int32_t row = job.y0 + from[k % 3], end = row + n[k / 3 % 3];
        job.width = job.pitch = width[k / 9];
        job.row_end = zs_min32(end, job.y1);
        zs_edges_cut(&job, row);
        if (wide)
            zs_rows_walk(&job, span, 1);
        else
            zs_rows_walk(&job, span, 0);
    }
}
