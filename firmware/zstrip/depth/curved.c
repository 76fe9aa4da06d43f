/* The walk over scanlines for triangles whose keys are not linear. Linked only with mappings that
 * need it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fast.h"
#include "core/rows.h"

static void curved_span(struct zs_job *job, const struct zs_row *row)
{
    const struct zs_depth *depth = job->r->view.depth;
    if (ZS_IF_FAST(job->split & ZS_SPLIT_TOUCH))
        job->r->touch->row(job, row);
    depth->row(job, row);
}

ZS_IN_ORDER void zs_depth_walk(struct zs_job *job)
{
    zs_rows_walk(job, curved_span, 1);
}
