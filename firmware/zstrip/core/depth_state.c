/* Instances that meet the depth buffer in their own way: less or equal, read only, offset.
 *
 * The triangles of a strip are drawn in scene order, and sets from pools that are too small follow each
 * other in scene order, so the outcome is that of drawing one after another, whatever strips and pools are.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/rows.h"

#define BIAS_MAX 65536 /* buckets: beyond it, all keys stop at an end anyway */

/* |256 n / area| in 2^-16 buckets a pixel, at most 2^46: slivers have any slope. |n| < 2^55 */
static uint64_t steepness(int64_t n, int64_t area)
{
    const uint64_t mag = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
#if ZS_LEAN
    const uint64_t q = zs_muldiv_u64(mag, 256, (uint64_t)area);
#else
    const uint64_t q = (mag << 8) / (uint64_t)area;
#endif
    return q >> 46 ? (uint64_t)1 << 46 : q;
}

static int32_t state_bias(const struct zs_job *job)
{
    const struct zs_geom *g = &job->geom;
    const struct zs_state *state = job->state;
    const struct zs_depth *depth = job->r->config.depth;
    int64_t key[3];
    if (state->slope == 0)
        return state->offset;
    for (int k = 0; k < 3; k++)
        key[k] = depth->key ? depth->key(&job->r->view, job->v[k]->d) : job->v[k]->d;
    const int64_t d1 = key[1] - key[0], d2 = key[2] - key[0]; /* |.| < 2^32 */
    const uint64_t x = steepness(d1 * g->dy2 - d2 * g->dy1, g->area);
    const uint64_t y = steepness(d2 * g->dx1 - d1 * g->dx2, g->area);
    const int64_t slope = zs_round_shift((int64_t)state->slope * (int64_t)(x > y ? x : y), 24); /* < 2^37 */
    const int64_t bias = state->offset + slope;
    return bias > BIAS_MAX ? BIAS_MAX : bias < -BIAS_MAX ? -BIAS_MAX : (int32_t)bias;
}

static void state_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                       uint32_t gx)
{
    const struct zs_shader *shader = job->shader;
    const struct zs_state *state = job->state;
    const uint32_t top = (job->r->view.key_top >> 16) - 1u;
    uint16_t *depth = job->depth + row->at;
    int32_t from = -1; /* first pixel of the current run */
    for (int32_t i = i0; i < i1; i++, sum += gx) {
        if (zs_rows_state(job, state, sum >> 16, top, &depth[i])) {
            if (from < 0)
                from = i;
        } else {
            zs_rows_run(job, shader, row, from, i);
            from = -1;
        }
    }
    zs_rows_run(job, shader, row, from, i1);
}

const struct zs_state_kernel zs_state_kernel = { state_bias, state_span };
