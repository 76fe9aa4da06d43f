/* Alpha and additive blending of smooth colours and textures: any opaque shader's run, blended over
 * what was there.
 *
 * Old colours are kept on the stack, 32 pixels at a time; the opaque shader draws its own in their
 * place, and both are mixed there. Pieces begin where the shader's own groups begin, so that none
 * of these is set up twice. Where a run is cut does not change its colours (shade/persp.h).
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/blend.h"
#include "effect/over.h"
#include "shade/texture.h"

void zs_layer_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                   uint32_t sum, uint32_t step)
{
    const struct zs_depth_state *const asked = job->depth_state;
    struct zs_depth_state state = { .read_only = 1 };
    if (asked) {
        state = *asked;
        state.read_only = 1;
    } else {
        job->bias = 0;
    }
    job->depth_state = &state;
    zs_rows_test(job, row, i0, i1, sum, step);
    job->depth_state = asked;
}

/* zs_blend_over or zs_blend_plus. */
typedef uint16_t kernel_fn(uint32_t old, uint32_t source, uint32_t weight);

ZS_ALWAYS_INLINE void blended(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, zs_run_fn *run, kernel_fn *kernel)
{
    const uint32_t weight = zs_blend_weight(zs_blend_of(job)->alpha);
    uint16_t old[ZS_OVER_MAX];
    for (int32_t next; from < to; from = next) {
        next = zs_min32(zs_over_next(row, from), to);
        uint16_t *const at = job->color + row->at + from;
        const int32_t n = next - from; /* 1 .. 32 */
        zs_over_keep(old, at, n);
        run(job, row, from, next);
        for (int32_t k = 0; k < n; k++)
            at[k] = kernel(old[k], at[k], weight);
    }
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
    mixed(job, row, from, to, zs_shade_smooth.run);
}

static void add_smooth(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    added(job, row, from, to, zs_shade_smooth.run);
}

static void mix_texture(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    mixed(job, row, from, to, zs_texture_run);
}

static void add_texture(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    added(job, row, from, to, zs_texture_run);
}

#define LAYER(run_) .run = run_, ZS_LAYER
const struct zs_shader zs_blend_smooth = { ZS_OVER_SMOOTH(zs_over_smooth_check),
                                           LAYER(mix_smooth) };
const struct zs_shader zs_add_smooth = { ZS_OVER_SMOOTH(zs_over_smooth_check), LAYER(add_smooth) };
const struct zs_shader zs_blend_texture = { ZS_OVER_TEXTURE(zs_over_texture_check),
                                            LAYER(mix_texture) };
const struct zs_shader zs_add_texture = { ZS_OVER_TEXTURE(zs_over_texture_check),
                                          LAYER(add_texture) };
const struct zs_shader zs_blend_texture_flat = { ZS_OVER_TEXTURE_FLAT(zs_over_texture_check),
                                                 LAYER(mix_texture) };
const struct zs_shader zs_add_texture_flat = { ZS_OVER_TEXTURE_FLAT(zs_over_texture_check),
                                               LAYER(add_texture) };
const struct zs_shader zs_blend_texture_smooth = {
    ZS_OVER_TEXTURE_SMOOTH(zs_over_texture_lit_check), LAYER(mix_texture)
};
const struct zs_shader zs_add_texture_smooth = { ZS_OVER_TEXTURE_SMOOTH(zs_over_texture_lit_check),
                                                 LAYER(add_texture) };
