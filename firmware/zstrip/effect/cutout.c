/* Alpha test: texels of little alpha leave colour and key alone.
 *
 * The depth test is core/depth_test.c itself, some pixels at a time. It writes the keys of pixels
 * that pass before the alphas are known; those of texels that are left out are put back.
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
    return config->method->passes || config->depth->vertex == zs_none_vertex;
}

static int cutout_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_texture_usable(in, config);
    return err || method_draws(config) ? err : ZS_ERR_DEPTH;
}

static int cutout_check_lit(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_texture_lit_usable(in, config);
    return err || method_draws(config) ? err : ZS_ERR_DEPTH;
}

static void cutout_start(struct zs_job *job)
{
    zs_alpha_start(job);
}

/* Keys before the test, of columns [begin, begin + ZS_ALPHA_RUN), in memory that is a lit palette's
 * otherwise. */
struct keys {
    uint16_t begin, before[ZS_ALPHA_RUN];
};
_Static_assert(sizeof(struct keys) <= 2 * ZS_LIT_COLORS, "keys fit");

static struct keys *keys_of(struct zs_job *job)
{
    return (struct keys *)job->r->lit.color;
}

/* Colour n <= ZS_ALPHA_RUN pixels that have passed the depth test. */
static ZS_NOINLINE void cut(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t n)
{
    uint16_t px[2 * ZS_ALPHA_RUN];
    const struct keys *const keys = keys_of(job);
    const uint32_t given = job->sampler.texture->alpha_least, least = given ? given : 128u;
    uint16_t *const color = job->color + row->at;
    zs_alpha_fetch(job, row, from, n, px);
    for (int32_t i = 0; i < n; i++)
        if (px[ZS_ALPHA_RUN + i] >= least)
            color[from + i] = px[i];
        else if (job->depth)
            job->depth[row->at + from + i] = keys->before[from + i - keys->begin];
}

static void cutout_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    for (; from < to; from += ZS_ALPHA_RUN)
        cut(job, row, from, zs_min32(to - from, ZS_ALPHA_RUN));
}

static void cutout_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    struct keys *const keys = keys_of(job);
    for (; i0 < i1; i0 += ZS_ALPHA_RUN, sum += step * ZS_ALPHA_RUN) {
        const int32_t n = zs_min32(i1 - i0, ZS_ALPHA_RUN);
        const uint16_t *const line = job->depth + row->at + i0;
        keys->begin = (uint16_t)i0;
        for (int32_t i = 0; i < n; i++)
            keys->before[i] = line[i];
        zs_rows_test(job, row, i0, i0 + n, sum, step);
    }
}

ZS_FILTER_SHADERS(cutout, cutout_start, cutout_run, cutout_check, cutout_check_lit,
                  .span = cutout_span);
