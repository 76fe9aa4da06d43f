/* Perspective-correct interpolation: functions that shaders share.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "shade/persp.h"

#define OVER(n) (UINT32_MAX / (n))

const uint32_t zs_over_table[(1 << ZS_SUB_LOG2_MAX) + 1] = {
    0,        OVER(1),  OVER(2),  OVER(3),  OVER(4),  OVER(5),  OVER(6),  OVER(7),  OVER(8),
    OVER(9),  OVER(10), OVER(11), OVER(12), OVER(13), OVER(14), OVER(15), OVER(16), OVER(17),
    OVER(18), OVER(19), OVER(20), OVER(21), OVER(22), OVER(23), OVER(24), OVER(25), OVER(26),
    OVER(27), OVER(28), OVER(29), OVER(30), OVER(31), OVER(32)
};

void zs_persp_w(const struct zs_job *job, uint32_t w[3])
{
    const struct zs_depth *depth = job->r->view.depth;
    const struct zs_view *view = &job->r->view;
    uint64_t wide[3], most = 0;
    if (!view->perspective) {
        w[0] = w[1] = w[2] = 1u << 30;
        return;
    }
    if (depth->inverses) {
        depth->inverses(view, job->v, w);
        return;
    }
    for (int k = 0; k < 3; k++) {
        wide[k] = depth->inverse(view, job->v[k]->d);
        most |= wide[k];
    }
    const int32_t up = zs_clz64(most) - 33; /* -32 .. 30 */
    for (int k = 0; k < 3; k++)
        w[k] = (uint32_t)zs_scale2((int64_t)wide[k], up);
}
