/* Counting effects: runs of their shaders, and their work by the figures of effect_costs.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "core/job.h"
#include "costs_look.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_method.h"

#define LONG_PART 32.0 /* px of a part in the runs that effects were measured in */

/* A run of an effect, of n pixels of a row: what begins it, beyond what it was in the long runs that were measured. */
static void count_begin(const struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    const int smooth = s->made.of->start == zs_shade_smooth.start; /* else sub_log2 is another thing, or not set */
    const int perspective = smooth && job->sub_log2 != ZS_AFFINE;
    const int log2 = s->kind == KIND_SMOOTH && perspective ? (int)job->sub_log2 : 5;
    const double parts = ((to - 1 - row->x0) >> log2) - ((from - row->x0) >> log2) + 1;
    const double more = parts - (to - from) / LONG_PART;
    if (more > 0.0 && !s->begins && s->kind == KIND_SMOOTH && perspective)
        sim_now.n[SIM_COST_run_smooth_part] += more;
}

void sim_look_effect_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    struct our_shader *s = sim_shader_of(job->shader);
    s->work.px += to - from;
    s->work.runs++;
    s->work.gloss += sim_look_gloss(job, s) ? to - from : 0;
    sim_look_lamps(job, row, from, to, to - from, s);
    sim_now.n[SIM_COST_run]++;
    sim_now.n[SIM_COST_won_runs] += to - from;
    count_begin(job, row, from, to);
    sim_look_run(job, row, from, to);
}

/* A piece of a row of an effect that tests depth in its own way. */
static void on_own_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                        uint32_t step)
{
    struct our_shader *s = sim_shader_of(job->shader);
    const uint32_t before = sim_now.r->stats.pixels_written;
    const double runs = s->work.runs, px = s->work.px, before_won = sim_now.n[SIM_COST_won_runs];
    sim_now.job = job;
    sim_now.own = job->shader;
    sim_look_as(job, s);
    s->of->span(job, row, i0, i1, sum, step);
    job->shader = &s->shader;
    sim_now.job = NULL;
    const uint32_t won = sim_now.r->stats.pixels_written - before;
    sim_now.windows += s->of == &zs_shade_window ? won : 0.0;
    sim_now.n[job->depth_state ? SIM_COST_px_state : SIM_COST_px_runs] += i1 - i0;
    sim_now.n[SIM_COST_won_runs] = before_won + won;
    s->work.px = px + (s->own ? (double)(i1 - i0) : (double)won);
    sim_now.n[SIM_COST_run] += s->own || s->made.layer != SIM_LAYER_NONE; /* its pattern, or its buffer */
    if (won > 0 && s->work.runs == runs) { /* it has not called run */
        s->work.runs++;
        s->work.gloss += sim_look_gloss(job, s) ? s->work.px - px : 0.0;
        sim_look_lamps(job, row, i0, i1, s->work.px - px, s);
        count_begin(job, row, i0, i1);
    }
}

/* An opaque effect whose texels come as those of zs_shade_texture do, by which it is drawn to be counted. */
static int is_like_texture(const struct zs_shader *of)
{
    const struct zs_shader *const like[] = {
        &zs_shade_bilinear,        &zs_shade_bilinear_flat,         &zs_shade_bilinear_smooth,
        &zs_shade_mipmap,          &zs_shade_mipmap_flat,           &zs_shade_mipmap_smooth,
        &zs_shade_mipmap_bilinear, &zs_shade_mipmap_bilinear_flat,  &zs_shade_mipmap_bilinear_smooth,
        &zs_shade_texture_lit
    };
    for (size_t i = 0; i < sizeof like / sizeof like[0]; i++)
        if (of == like[i])
            return 1;
    return 0;
}

void sim_look_copy_effect(struct our_shader *s, const struct zs_texture *texture)
{
    const struct zs_shader *of = s->of;
    const struct sim_shader_row *const row = s->made.row;
    const int has_varyings = row != NULL && row->vertex != NULL && of->n_varyings > 0, textured = texture != NULL;
    s->kind = !has_varyings ? KIND_SOLID : textured ? KIND_TEXTURE : KIND_SMOOTH;
    s->begins = !has_varyings || sim_effects_begin_runs(row);
    s->work.fetched = s->kind == KIND_TEXTURE && !s->made.is_made && (!s->begins || is_like_texture(of)) &&
                      (texture->format == &zs_texel_565 || texture->format == &zs_texel_pal8 ||
                       texture->format == &zs_texel_pal4);
    if (s->work.fetched && is_like_texture(of)) {
        s->of = of = &zs_shade_texture;
        s->shader = *of;
        s->shader.vertex = sim_look_shader.vertex;
        s->shader.face = sim_look_shader.face;
        s->shader.start = sim_look_shader.start;
        s->shader.run = sim_look_shader.run;
    }
    s->vertex = textured ? SIM_COST_attr_texture : SIM_COST_light_smooth;
    s->own = s->made.layer == SIM_LAYER_DOOR || (row != NULL && strncmp(row->name, "zs_stipple", 10) == 0);
    s->face = row != NULL && row->is_flat ? SIM_COST_face_flat : SIM_COST_N;
    s->shader.light = of->light;
    s->shader.span = of->span != NULL ? on_own_span : NULL;
}

void sim_look_effects(struct sim_counted *out, const struct zs_scene *scene, const struct thing *things)
{
    for (uint32_t i = 0; i < scene->n_instances; i++)
        if (things[i].shader.effect)
            sim_effects_add(out, scene->instance[i].material, &things[i].shader.work);
        else if (things[i].shader.lit)
            sim_effects_add_lamps(out, scene->instance[i].material, &things[i].shader.work);
}

void sim_look_around(struct sim_counted *out, const struct zs_pass *pass, const struct sim_frame *frame, int hooks)
{
    const double all = (double)frame->width * frame->height,
                 seen = pass->viewport.w > 0 ? (double)pass->viewport.w * pass->viewport.h : all;
    double drawn = 0.0;
    for (size_t i = 0; frame->key != NULL && i < all; i++)
        drawn += frame->key[i] != ZS_DEPTH_CLEAR;
    double mirrored = 0.0;
    for (uint32_t i = 0; pass->mirror != NULL && i < pass->scene->n_instances; i++)
        mirrored += pass->scene->instance[i].mesh->n_tris;
    if (mirrored > 0.0)
        sim_effects_add_mirrored(out, mirrored);
    if (pass->mask != NULL)
        sim_effects_add_windows(out, seen);
    if (pass->scene->sky != NULL && !(pass->keep & ZS_KEEP_COLOR))
        sim_effects_add_sky(out, pass->scene->sky, pass->mask != NULL ? sim_now.windows : seen);
    for (uint32_t i = 0; hooks && i < pass->scene->n_resolves; i++)
        sim_effects_add_hook(out, &pass->scene->resolve[i], drawn, all);
}
