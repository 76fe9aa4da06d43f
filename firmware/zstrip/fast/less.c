/* The usual depth test (less) for a piece of a scanline. It does what zs_rows_test does for a
 * triangle without a depth state, without the tests for one at each pixel. The accelerators of
 * smooth and textured shaders use it where they have no loop of their own; it never declines.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/job.h"
#include "zs_shader.h"
#include "fast/less.h"

/* Return the key of a sum, clamped if it may saturate. */
ZS_ALWAYS_INLINE uint32_t tested_key(uint32_t sum, uint32_t top, int clamp)
{
    const uint32_t key = sum >> 16;
    return clamp && key > top ? top : key;
}

/* Find the runs of pixels that pass the test, and colour them. */
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
        zs_rows_written(job, (int32_t)(at - from));
        shader->run(job, row, to - (int32_t)(at - from), to);
        at++; /* skip the pixel that failed, or step beyond the end */
    }
}

void zs_fast_less(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t gx)
{
    if (job->saturates)
        test(job, row, i0, i1, sum, gx, 1);
    else
        test(job, row, i0, i1, sum, gx, 0);
}

ZS_ALWAYS_INLINE void less_span(struct zs_job *job, const struct zs_row *row)
{
    zs_fast_less(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0),
                 job->key.gx);
}

int zs_fast_less_rows(struct zs_job *job)
{
    zs_rows_walk(job, less_span, 0);
    return 1;
}
