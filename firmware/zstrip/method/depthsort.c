/* Depth sort: pieces of triangles, drawn from far to near.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/method.h"
#include "core/rows.h"
#include "method/order.h"
#include "zs_method.h"
#include "zs_shader.h"

static void sorted_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    (void)sum;
    (void)step;
    if (!zs_order_clip(job, row->y, &i0, &i1))
        return;
    zs_rows_written(job, i1 - i0);
    job->shader->run(job, row, i0, i1);
}

static int depthsort_begin(struct zs_renderer *r)
{
    r->span = sorted_span;
    return zs_order_begin(r);
}

static void depthsort_strip(struct zs_renderer *r)
{
    struct zs_order o;
    o.near_first = 0;
    zs_order_strip(r, &o, r->config.max_tris / 4u);
}

const struct zs_method zs_method_depthsort = { .begin = depthsort_begin,
                                               .strip = depthsort_strip,
                                               .full = zs_order_full,
                                               .list = zs_order_list,
                                               .records = 1 };
