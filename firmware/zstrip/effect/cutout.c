/* Alpha test: texels of little alpha leave colour and key alone.
 *
 * The depth test is that of core/depth_test.c, by the same rule. But a key is written only when the
 * alpha is known: runs that pass are fetched into a buffer first.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/method.h"
#include "effect/filter.h"
#include "zs_filter.h"

/* Methods with a span of their own take a triangle as a wall: at coverage and ray casting a pixel
 * is coloured by one triangle, and the hierarchical depth buffer bounds what is behind. */
static int method_draws(const struct zs_config *config)
{
    return config->method == &zs_method_buffer || config->depth->vertex == zs_none_vertex;
}

static int cutout_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_filter_check(in, config);
    return err || method_draws(config) ? err : ZS_ERR_DEPTH;
}

static int cutout_check_lit(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_filter_check_lit(in, config);
    return err || method_draws(config) ? err : ZS_ERR_DEPTH;
}

static void cutout_start(struct zs_job *job)
{
    zs_alpha_start(job, zs_shade_texture.start);
}

/* Colour n <= ZS_ALPHA_RUN pixels that have passed the depth test, and write their keys where
 * `keys` is given. sum is that of the first one. */
static ZS_NOINLINE void cut(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t n,
                            uint32_t sum, uint32_t step, const struct zs_depth_rule *keys)
{
    uint16_t px[2 * ZS_ALPHA_RUN];
    const uint32_t given = job->sampler.texture->alpha_least, least = given ? given : 128u;
    uint16_t *const color = job->color + row->at + from;
    zs_alpha_fetch(job, row, from, n, px);
    for (int32_t i = 0; i < n; i++, sum += step) {
        if (px[ZS_ALPHA_RUN + i] < least)
            continue;
        color[i] = px[i];
        if (keys)
            job->depth[row->at + from + i] = (uint16_t)zs_depth_key(keys, sum);
    }
}

static void cutout_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    const struct zs_depth_rule rule = zs_depth_rule(job);
    const uint16_t *const line = job->depth + row->at;
    while (i0 < i1) {
        const uint32_t at = sum;
        int32_t n = 0;
        for (; i0 + n < i1 && n < ZS_ALPHA_RUN; n++, sum += step)
            if (zs_depth_key(&rule, sum) >= line[i0 + n] + rule.more)
                break;
        if (n) {
            zs_rows_written(job, n);
            cut(job, row, i0, n, at, step, rule.writes ? &rule : 0);
            i0 += n;
        } else {
            i0++;
            sum += step;
        }
    }
}

/* Without depth memory. */
static void cutout_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    for (; from < to; from += ZS_ALPHA_RUN)
        cut(job, row, from, zs_min32(to - from, ZS_ALPHA_RUN), 0, 0, 0);
}

ZS_FILTER_SHADERS(cutout, cutout_start, cutout_run, cutout_check, cutout_check_lit,
                  .span = cutout_span);
