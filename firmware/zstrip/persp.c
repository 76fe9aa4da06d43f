/* What shaders with interpolated attributes share.
 *
 * SPDX-License-Identifier: MIT
 */
#include "persp.h"

#define OVER(n) (65536u / (n))

const uint32_t zs_one_over[(1 << ZS_SUB_LOG2_MAX) + 1] = {
    0,        OVER(1),  OVER(2),  OVER(3),  OVER(4),  OVER(5),  OVER(6),  OVER(7),  OVER(8),
    OVER(9),  OVER(10), OVER(11), OVER(12), OVER(13), OVER(14), OVER(15), OVER(16), OVER(17),
    OVER(18), OVER(19), OVER(20), OVER(21), OVER(22), OVER(23), OVER(24), OVER(25), OVER(26),
    OVER(27), OVER(28), OVER(29), OVER(30), OVER(31), OVER(32)
};

void zs_persp_w(const struct zs_job *job, uint32_t w[3])
{
    const struct zs_depth *depth = job->r->config.depth;
    uint64_t wide[3], most = 0;
    for (int k = 0; k < 3; k++) {
        if (!job->r->view.perspective) {
            w[k] = 1u << 30;
            continue;
        }
        wide[k] = depth->inverse(&job->r->view, job->v[k]->d); /* 1 .. 2^62 */
        most |= wide[k];
    }
    if (!job->r->view.perspective)
        return;
    const int32_t shift = 33 - zs_clz64(most);
    for (int k = 0; k < 3; k++)
        w[k] = (uint32_t)zs_scale2((int64_t)wide[k], -shift);
}

void zs_persp_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                   uint32_t gx)
{
    zs_rows_test(job, row, i0, i1, sum, gx, 0);
}

ZS_ALWAYS_INLINE void keys_span(struct zs_job *job, const struct zs_row *row)
{
    zs_rows_test(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx, 0);
}

void zs_persp_rows(struct zs_job *job)
{
    const struct zs_shader *shader = job->shader;
    shader->start(job);
    zs_rows_walk(job, keys_span);
}
