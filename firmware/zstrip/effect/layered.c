/* Any shader as a layer: its run goes to a buffer on the stack, 32 pixels at a time, and is mixed
 * with the strip, as in blend_over.c. The layer's shader is a copy of the other one, with a test
 * and a run of its own; while the other one's stages are called, it is the job's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/layered.h"

static void start(struct zs_job *job)
{
    const struct zs_layered *const layer = zs_layered_of(job);
    job->shader = layer->of;
    layer->of->start(job);
    job->shader = &layer->shader;
}

void zs_layered_draw(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                     uint16_t *px)
{
    const struct zs_layered *const layer = zs_layered_of(job);
    uint16_t *const color = job->color;
    struct zs_row here = *row;
    if (!layer->of->opaque) /* it may look at the old colours */
        zs_over_keep(px, color + row->at + from, to - from);
    here.at = -from; /* pixel `from` is px[0] */
    job->color = px;
    job->shader = layer->of;
    layer->of->run(job, &here, from, to);
    job->shader = &layer->shader;
    job->color = color;
}

int zs_layered_set(struct zs_layered *layer, const struct zs_shader *of,
                   const struct zs_layer_kind *kind, uint8_t alpha)
{
    if (!layer || !of || !of->run || !kind)
        return ZS_ERR_NULL;
    if (of->span || of->layer)
        return ZS_ERR_RANGE;
    layer->shader = *of;
    layer->shader.start = of->start ? start : 0;
    layer->shader.run = kind->run;
    layer->shader.span = kind->span;
    layer->shader.opaque = 0;
    layer->shader.layer = kind->layer;
    layer->of = of;
    layer->kind = kind;
    layer->alpha = alpha;
    layer->phase = 0;
    layer->fogged = 0;
    layer->fog = 0;
    return ZS_OK;
}

/* ---- Mixed ----------------------------------------------------------------------------------- */

/* Keys of columns from `first` on: sum, sum + step, ... */
struct keys {
    uint32_t sum, step;
    int32_t first;
};

/* Blend columns [from, to). add is a constant. keys: NULL: they are not known. */
ZS_ALWAYS_INLINE void blended(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, const struct keys *keys, int add)
{
    const struct zs_layered *const layer = zs_layered_of(job);
    const uint32_t weight = zs_blend_weight(layer->alpha);
    uint16_t px[ZS_OVER_MAX];
    for (int32_t next; from < to; from = next) {
        next = zs_min32(zs_over_next(row, from), to);
        const int32_t n = next - from;
        uint16_t *at = job->color + row->at + from;
        zs_layered_draw(job, row, from, next, px);
        if (layer->fogged && keys)
            layer->fogged(layer->fog, px, n,
                          keys->sum + zs_wrap_mul(keys->step, from - keys->first), keys->step, add);
        for (const uint16_t *of = px, *const end = px + n; of != end; of++, at++)
            *at = add ? zs_blend_plus(*at, *of, weight) : zs_blend_over(*at, *of, weight);
    }
}

static ZS_NOINLINE void mixed(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, const struct keys *keys)
{
    blended(job, row, from, to, keys, 0);
}

static ZS_NOINLINE void added(struct zs_job *job, const struct zs_row *row, int32_t from,
                              int32_t to, const struct keys *keys)
{
    blended(job, row, from, to, keys, 1);
}

typedef void mix_fn(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                    const struct keys *keys);

/* Test pixels; mix the runs of those that pass, by `mix`, a constant. */
ZS_ALWAYS_INLINE void span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                           uint32_t sum, uint32_t step, mix_fn *mix)
{
    const struct zs_blend_rule rule = zs_blend_rule(job);
    const struct keys keys = { sum, step, i0 };
    const uint16_t *const line = job->depth + row->at;
    for (int32_t i = i0; i < i1; i++, sum += step) { /* the step skips the pixel that failed */
        const int32_t from = i;
        while (i < i1 && zs_blend_key(&rule, sum, 0) < line[i] + rule.more) {
            i++;
            sum += step;
        }
        if (i > from) {
            zs_rows_written(job, i - from);
            mix(job, row, from, i, &keys);
        }
    }
}

static void mix_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    mixed(job, row, from, to, 0);
}

static void mix_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                     uint32_t sum, uint32_t step)
{
    span(job, row, i0, i1, sum, step, mixed);
}

static void add_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    added(job, row, from, to, 0);
}

static void add_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                     uint32_t sum, uint32_t step)
{
    span(job, row, i0, i1, sum, step, added);
}

const struct zs_layer_kind zs_layer_mix = { .run = mix_run, .span = mix_span, .layer = 1 };
const struct zs_layer_kind zs_layer_add = { .run = add_run, .span = add_span, .layer = 1 };
