/* Alpha and additive blending of smooth colours and textures: any opaque shader's run, blended over
 * what was there.
 *
 * The opaque shader draws into a buffer on the stack, 32 pixels at a time, and these are mixed with
 * the strip's. Pieces begin where the shader's own groups begin, so that none of these is set up
 * twice. Where a run is cut does not change its colours (shade/persp.h).
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/alpha_texels.h"
#include "effect/blend.h"
#include "effect/over.h"
#include "shade/texture.h"

/* ---- The depth test -------------------------------------------------------------------------- */

/* Colour the runs of pixels that pass. */
ZS_ALWAYS_INLINE void runs(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                           uint32_t sum, uint32_t step, const struct zs_blend_rule *rule, int plain)
{
    const uint16_t *const line = job->depth + row->at, *const end = line + i1;
    const uint32_t more = plain ? 0u : rule->more;
    for (const uint16_t *at = line + i0; at < end;) {
        const uint16_t *const from = at;
        while (at < end && zs_blend_key(rule, sum, plain) < *at + more) {
            at++;
            sum += step;
        }
        if (at > from) {
            zs_rows_written(job, (int32_t)(at - from));
            job->shader->run(job, row, (int32_t)(from - line), (int32_t)(at - line));
        }
        at++; /* the pixel that failed, or beyond the end */
        sum += step;
    }
}

void zs_layer_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                   uint32_t sum, uint32_t step)
{
    const struct zs_blend_rule rule = zs_blend_rule(job);
    if (rule.plain)
        runs(job, row, i0, i1, sum, step, &rule, 1);
    else
        runs(job, row, i0, i1, sum, step, &rule, 0);
}

/* ---- Runs ------------------------------------------------------------------------------------ */

/* zs_blend_over or zs_blend_plus. */
typedef uint16_t kernel_fn(uint32_t old, uint32_t source, uint32_t weight);

ZS_ALWAYS_INLINE void blended(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, zs_run_fn *run, kernel_fn *kernel)
{
    const uint32_t weight = zs_blend_weight(zs_blend_of(job)->alpha);
    uint16_t source[ZS_OVER_MAX], *const color = job->color;
    struct zs_row here = *row;
    for (int32_t next; from < to; from = next) {
        next = zs_min32(zs_over_next(row, from), to);
        uint16_t *at = color + row->at + from;
        const uint16_t *of = source, *const end = source + (next - from);
        here.at = -from; /* pixel `from` is source[0] */
        job->color = source;
        run(job, &here, from, next);
        for (; of != end; of++, at++)
            *at = kernel(*at, *of, weight);
    }
    job->color = color;
}

static ZS_NOINLINE void mixed(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, zs_run_fn *run)
{
    blended(job, row, from, to, run, zs_blend_over);
}

static ZS_NOINLINE void added(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, zs_run_fn *run)
{
    blended(job, row, from, to, run, zs_blend_plus);
}

static void mix_smooth(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    mixed(job, row, from, to, zs_smooth_run);
}

static void add_smooth(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    added(job, row, from, to, zs_smooth_run);
}

/* ---- Textures -------------------------------------------------------------------------------- */

/* Return 1 if texels have alphas of their own. */
static inline int has_alpha(const struct zs_job *job)
{
    return job->texture->format->both != 0;
}

static void texture_start(struct zs_job *job)
{
    if (has_alpha(job))
        zs_alpha_start(job);
    else
        zs_texture_start(job);
}

/* As blended(), with the product of the texel's alpha and the material's: in 64ths, within 0.502
 * of them. */
ZS_ALWAYS_INLINE void texels(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                             kernel_fn *kernel)
{
    const uint32_t part = (zs_blend_of(job)->alpha * 66052u + 512u) >>
                          10; /* alpha * 64 * 2^16 / 255^2, nearest; at most 16448 */
    uint16_t px[2 * ZS_ALPHA_RUN];
    for (int32_t next; from < to; from = next) {
        next = zs_min32(zs_over_next(row, from), to);
        uint16_t *at = job->color + row->at + from;
        const uint16_t *of = px, *const end = px + (next - from);
        zs_alpha_fetch(job, row, from, next - from, px);
        for (; of != end; of++, at++)
            *at = kernel(*at, *of, (of[ZS_ALPHA_RUN] * part + 0x8000u) >> 16);
    }
}

static ZS_NOINLINE void texels_mixed(struct zs_job *job, const struct zs_row *row, int32_t from,
                                     int32_t to)
{
    texels(job, row, from, to, zs_blend_over);
}

static ZS_NOINLINE void texels_added(struct zs_job *job, const struct zs_row *row, int32_t from,
                                     int32_t to)
{
    texels(job, row, from, to, zs_blend_plus);
}

static void mix_texture(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    if (has_alpha(job))
        texels_mixed(job, row, from, to);
    else
        mixed(job, row, from, to, zs_texture_run);
}

static void add_texture(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    if (has_alpha(job))
        texels_added(job, row, from, to);
    else
        added(job, row, from, to, zs_texture_run);
}

#define LAYER(run_) .run = run_, ZS_LAYER
const struct zs_shader zs_blend_smooth = { ZS_OVER_SMOOTH(zs_smooth_usable), LAYER(mix_smooth) };
const struct zs_shader zs_add_smooth = { ZS_OVER_SMOOTH(zs_smooth_usable), LAYER(add_smooth) };
const struct zs_shader zs_blend_texture = { ZS_OVER_TEXTURE(texture_start, zs_texture_usable),
                                            LAYER(mix_texture) };
const struct zs_shader zs_add_texture = { ZS_OVER_TEXTURE(texture_start, zs_texture_usable),
                                          LAYER(add_texture) };
const struct zs_shader zs_blend_texture_flat = {
    ZS_OVER_TEXTURE_FLAT(texture_start, zs_texture_usable), LAYER(mix_texture)
};
const struct zs_shader zs_add_texture_flat = {
    ZS_OVER_TEXTURE_FLAT(texture_start, zs_texture_usable), LAYER(add_texture)
};
const struct zs_shader zs_blend_texture_smooth = {
    ZS_OVER_TEXTURE_SMOOTH(texture_start, zs_texture_lit_usable), LAYER(mix_texture)
};
const struct zs_shader zs_add_texture_smooth = {
    ZS_OVER_TEXTURE_SMOOTH(texture_start, zs_texture_lit_usable), LAYER(add_texture)
};
