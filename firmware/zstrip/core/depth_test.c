/* The depth test of a span's pixels, with any depth state. Runs of pixels that pass go to the
 * shader.
 *
 * The triangles of a strip are drawn in scene order. If the pools are too small for the scene, it
 * is drawn in several sets, which are in scene order too. So the picture is that of drawing all
 * triangles one after another, whatever strip height and pool sizes are.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "core/plane.h"
#include "core/rows.h"
#include "zs_shader.h"

#define BIAS_MAX 65536 /* buckets: a larger bias would only saturate every key */

ZS_RARE int32_t zs_depth_state_bias(const struct zs_job *job)
{
    const struct zs_geom *g = &job->geom;
    const struct zs_depth_state *state = job->depth_state;
    const struct zs_depth *depth = job->r->view.depth;
    int64_t key[3];
    if (state->slope_bias == 0)
        return state->bias;
    for (int k = 0; k < 3; k++)
        key[k] = depth->key ? depth->key(&job->r->view, job->v[k]->d) : job->v[k]->d;
    /* the larger gradient, |256 n / area| in 2^-16 buckets a pixel; at most 2^46 (slivers) */
    int64_t n = 0;
    for (int k = 0; k < 2; k++) { /* differences of keys: |.| < 2^32 */
        const int64_t one = zs_size64((int64_t)zs_plane_numerator(
            (uint64_t)(key[1] - key[0]), (uint64_t)(key[2] - key[0]), k ? g->dx : g->dy));
        n = one > n ? one : n;
    }
    const int64_t steep = zs_held64((n << 8) / g->area, (int64_t)1 << 46); /* n << 8 < 2^63 */
    const int64_t slope = zs_round_shift(state->slope_bias * steep, 24);   /* < 2^37 */
    return (int32_t)zs_held64(state->bias + slope, BIAS_MAX);
}

/* Depth-test the keys of a piece, write those that pass, and colour each run of them. A key is held
 * to top, moved by the bias, and held to 0 .. top; without a depth state the bias is 0. */
void zs_rows_test(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step)
{
    const struct zs_shader *shader = job->shader;
    const struct zs_depth_state *state = job->depth_state;
    const int32_t top = (int32_t)(job->r->view.key_top >> 16) - 1, bias = state ? job->bias : 0;
    const int32_t most = top + zs_min32(bias, 0);
    const uint32_t func = state ? state->func : ZS_DEPTH_LESS;
    /* a key passes if it is below depth + more */
    const uint32_t more = func == ZS_DEPTH_LESS     ? 0u
                          : func == ZS_DEPTH_ALWAYS ? 65536u
                                                    : 1u;
    const int writes = !state || !state->read_only;
    uint16_t *const line = job->depth + row->at;
    for (int32_t i = i0; i < i1; i++, sum += step) { /* the step skips the pixel that failed */
        const int32_t from = i;
        for (; i < i1; i++, sum += step) {
            const int32_t moved = zs_min32((int32_t)(sum >> 16) + bias, most);
            const uint32_t key = moved < 0 ? 0u : (uint32_t)moved;
            if (key >= line[i] + more)
                break;
            if (writes)
                line[i] = (uint16_t)key;
        }
        if (i > from) {
            zs_rows_written(job, i - from);
            shader->run(job, row, from, i);
        }
    }
}
