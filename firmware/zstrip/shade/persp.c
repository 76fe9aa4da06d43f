/* What shaders with interpolated attributes share.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade/persp.h"

#if !ZS_LEAN

#define OVER(n) (UINT32_MAX / (n))

const uint32_t zs_one_over_table[(1 << ZS_SUB_LOG2_MAX) + 1] = {
    0,        OVER(1),  OVER(2),  OVER(3),  OVER(4),  OVER(5),  OVER(6),  OVER(7),  OVER(8),
    OVER(9),  OVER(10), OVER(11), OVER(12), OVER(13), OVER(14), OVER(15), OVER(16), OVER(17),
    OVER(18), OVER(19), OVER(20), OVER(21), OVER(22), OVER(23), OVER(24), OVER(25), OVER(26),
    OVER(27), OVER(28), OVER(29), OVER(30), OVER(31), OVER(32)
};

#endif

void zs_persp_w(const struct zs_job *job, uint32_t w[3])
{
    const struct zs_depth *depth = job->r->config.depth;
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
    const int32_t shift = 33 - zs_clz64(most); /* -30 .. 32 */
    const uint64_t half = shift > 0 ? (uint64_t)1 << (shift - 1) : 0u;
    for (int k = 0; k < 3; k++)
        w[k] = (uint32_t)(shift > 0 ? (wide[k] + half) >> shift : wide[k] << -shift);
}

#if !ZS_LEAN

/* A key as it is tested. */
ZS_ALWAYS_INLINE uint32_t tested_key(uint32_t sum, uint32_t top, int clamp)
{
    const uint32_t key = sum >> 16;
    return clamp && key > top ? top : key;
}

/* Find runs of pixels that are seen, and colour them. */
ZS_ALWAYS_INLINE void test(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                           uint32_t sum, uint32_t gx, int clamp)
{
    const struct zs_shader *shader = job->shader;
    const uint32_t top = clamp ? (job->r->view.key_top >> 16) - 1u : 0u;
    uint16_t *at = job->depth + row->at + i0, *const end = at + (i1 - i0);
    while (at < end) {
        uint32_t key = tested_key(sum, top, clamp);
        sum += gx;
        if (key >= *at) {
            at++;
            continue;
        }
        const uint16_t *const from = at;
        do {
            *at++ = (uint16_t)key;
            key = tested_key(sum, top, clamp);
            sum += gx;
        } while (at < end && key < *at);
        const int32_t to = i1 - (int32_t)(end - at);
        zs_rows_run(job, shader, row, to - (int32_t)(at - from), to);
        at++; /* hidden, or beyond the end */
    }
}

void zs_persp_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                   uint32_t gx)
{
    if (job->saturates)
        test(job, row, i0, i1, sum, gx, 1);
    else
        test(job, row, i0, i1, sum, gx, 0);
}

static void keys_span(struct zs_job *job, const struct zs_row *row)
{
    zs_persp_span(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx);
}

void zs_persp_walk(struct zs_job *job)
{
    job->saturates = (uint8_t)zs_keys_may_saturate(job);
    zs_rows_walk(job, keys_span);
}

#endif
