/* One colour a triangle.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/job.h"
#include "core/rows.h"
#include "shade/stages.h"

void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    zs_fill_run(job->color + row->at + from, job->tri->paint, (uint32_t)(to - from));
}
