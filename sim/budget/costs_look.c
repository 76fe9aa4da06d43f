/* Counting by looking on: callbacks in the place of those of shaders, texel formats, accelerators and the depth
 * mapping, which count and pass on.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "core/job.h"
#include "core/pass.h"
#include "core/raster_fast.h"
#include "core/xform.h"
#include "costs_look.h"
#include "zs_filter.h"
#include "zs_method.h"

static const struct our_texel *texel_of(const struct zs_texel *texel)
{
    return (const struct our_texel *)(const void *)texel;
}

/* Of the shader in hand. */
static const struct our_fast *fast_of(const struct zs_job *job)
{
    return (const struct our_fast *)(const void *)job->fast;
}

/* The renderer that a stage is called by. */
static const struct zs_renderer *renderer_of(const struct zs_shading *s)
{
    return (const struct zs_renderer *)(const void *)((const char *)s - offsetof(struct zs_renderer, shading));
}

/* Let a program's own stages see their own material, and ours again. */
static void whole(const struct zs_instance *in, const struct zs_material *m)
{
    if (m != NULL)
        ((struct zs_instance *)(uintptr_t)in)->material = m;
}

static void on_vertex(const struct zs_shading *shading, uint32_t v, uint16_t *out)
{
    struct our_shader *s = sim_shader_of(shading->instance->material->shader);
    sim_now.n[s->vertex]++;
    sim_now.n[SIM_COST_lit_shine] += s->vertex == SIM_COST_lit_vertex && s->shines;
    s->work.vertices++;
    const struct zs_material *const ours = shading->instance->material;
    whole(shading->instance, s->whole);
    s->of->vertex(shading, v, out);
    whole(shading->instance, ours);
}

static void on_position(const struct zs_shading *shading, uint32_t v, int16_t out[3])
{
    const struct zs_material *const ours = shading->instance->material;
    const struct our_shader *s = sim_shader_of(ours->shader);
    whole(shading->instance, s->whole);
    s->of->position(shading, v, out);
    whole(shading->instance, ours);
}

/* Strips all of whose rows lie in [row, end). */
static int32_t strips_within(const struct zs_renderer *r, int32_t row, int32_t end)
{
    const int32_t h = r->config.strip_h, height = r->config.height;
    const int32_t first = zs_max32((zs_max32(row, 0) + h - 1) / h, r->strip);
    const int32_t last = zs_min32(end >= height ? (height + h - 1) / h : end / h, r->draw_end);
    return last > first ? last - first : 0;
}

/* Has a triangle left bounds behind, as fast/tiles.c finds them? Those of a triangle that shares an edge with it are
 * found for both at once. */
static void count_cover(const struct zs_renderer *r)
{
    if (sim_look_is_hiz() || !r->large || !r->cover_known) /* else cover_next is not set yet; hiz has another `large` */
        return;
    const struct zs_cover *last = &r->cover[!r->cover_next], *before = &r->cover[r->cover_next];
    if (memcmp(last->v, sim_now.cover, sizeof sim_now.cover) == 0)
        return;
    memcpy(sim_now.cover, last->v, sizeof sim_now.cover);
    sim_now.n[SIM_COST_bound]++;
    const int32_t both = strips_within(r, last->done[0], last->done[1]);
    double strips = strips_within(r, zs_first_sample(last->v[0].y), zs_first_sample(last->v[2].y));
    if (both > 0 && last->done[0] == before->done[0] && last->done[1] == before->done[1])
        strips -= both; /* counted with the one before */
    sim_now.n[SIM_COST_bound_strip] += strips;
}

/* An instance that is walked: the first that is seen of it. */
static void count_instance(const struct zs_renderer *r)
{
    if (sim_now.instance == r->xform.number && sim_now.walk == r->stats.passes)
        return;
    sim_now.instance = r->xform.number;
    sim_now.walk = r->stats.passes;
    sim_now.n[SIM_COST_instance_asked] += r->large;
}

/* Is a triangle of the instance in hand 128 px wide or high? In a mesh that is transformed at once. */
static int is_large(const struct zs_renderer *r, uint32_t t)
{
    const uint16_t *index = r->xform.instance->mesh->tri[t];
    const struct zs_vertex *v = r->vert + r->vert_base;
    int32_t lo[2] = { INT32_MAX, INT32_MAX }, hi[2] = { INT32_MIN, INT32_MIN };
    for (int k = 0; k < 3; k++) {
        if (v[index[k]].d >= ZS_D_OUT)
            return 0; /* cut */
        lo[0] = zs_min32(lo[0], v[index[k]].x);
        lo[1] = zs_min32(lo[1], v[index[k]].y);
        hi[0] = zs_max32(hi[0], v[index[k]].x);
        hi[1] = zs_max32(hi[1], v[index[k]].y);
    }
    return hi[0] - lo[0] >= 2 * ZS_TINY || hi[1] - lo[1] >= 2 * ZS_TINY;
}

#define ASKED_WIDTH 160 /* frames up to so wide, meshes up to so many triangles: each triangle is asked what it hides */
#define ASKED_TRIS 40

int sim_look_all_asked(uint32_t width, const struct zs_mesh *mesh)
{
    return sim_now.tiles && width <= ASKED_WIDTH && mesh->n_tris <= ASKED_TRIS;
}

static uint16_t on_face(const struct zs_shading *shading, uint32_t t)
{
    const struct zs_renderer *r = renderer_of(shading);
    struct our_shader *s = sim_shader_of(r->xform.instance->material->shader);
    s->work.faces++;
    count_cover(r);
    if (sim_now.tiles && r->direct && !sim_look_all_asked(r->config.width, r->xform.instance->mesh) && is_large(r, t))
        sim_now.n[SIM_COST_tri_asked]++;
    sim_now.n[SIM_COST_tri_bin]++;
    if (s->face == SIM_COST_face_flat && r->xform.instance->mesh->face_normal)
        sim_now.n[SIM_COST_face_flat_given]++;
    else if (s->face != SIM_COST_N)
        sim_now.n[s->face]++;
    const struct zs_material *const ours = shading->instance->material;
    whole(shading->instance, s->whole);
    const uint16_t paint = s->of->face ? s->of->face(shading, t) : 0u;
    whole(shading->instance, ours);
    return paint;
}

static uint32_t on_depth_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    const struct zs_renderer *r = sim_now.r;
    const enum sim_cost cost = !view->perspective              ? SIM_COST_vertex_ortho
                               : sim_now.of == &zs_depth_recip     ? SIM_COST_vertex_recip
                               : sim_now.of == &zs_depth_linear    ? SIM_COST_vertex_linear
                                                               : SIM_COST_vertex;
    sim_now.n[cost]++;
    if (r->xform.clip_depth || r->xform.clip_guard)
        sim_now.n[SIM_COST_vertex_test]++;
    if (r->xform.instance->mesh->pos_lo)
        sim_now.n[SIM_COST_vertex_fine]++;
    count_instance(r);
    return sim_now.of->vertex(view, z, rcp, lz);
}

static int on_planes(struct zs_job *job);

static int on_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    sim_now.r = (struct zs_renderer *)(void *)((char *)view - offsetof(struct zs_renderer, view));
    const int err = sim_now.of->setup(view, camera, bits);
    sim_now.linear = view->screen_linear;
    if (sim_now.depth.planes == on_planes)
        view->screen_linear = 0; /* all triangles that are set up come by on_planes */
    sim_now.tiles = sim_now.r->tiles != NULL;
    return err;
}

static uint32_t tested(void)
{
    return sim_now.r->stats.pixels_tested;
}

static uint32_t written(void)
{
    return sim_now.r->stats.pixels_written;
}

void sim_look_setup(const struct zs_job *job, int plain)
{
    const struct shape *s = &sim_now.shape;
    sim_look_shape(&sim_now.shape, job);
    sim_now.wide = !job->geom.tiny; /* how planes are found (core/plane.c) */
    sim_now.huge = !job->geom.rcp;
    sim_now.setups++;
    sim_now.tested += (uint64_t)s->px;
    sim_now.n[SIM_COST_setup]++;
    sim_now.n[SIM_COST_setup_wide] += sim_now.wide || plain;
    if (sim_now.r->depth) {
        sim_now.n[SIM_COST_plane_wide] += sim_now.huge && s->tilted; /* its key */
        sim_now.n[SIM_COST_tilt] += s->tilted && !sim_now.huge;
    }
    sim_now.n[SIM_COST_row] += s->rows;
    sim_now.n[sim_now.wide ? SIM_COST_edge : SIM_COST_edge_tiny] += s->edges;
    sim_now.n[SIM_COST_edge_div] += s->divided;
    sim_now.n[SIM_COST_edge_div64] += s->divided64;
}

int sim_look_gloss(const struct zs_job *job, const struct our_shader *s)
{
    return s->made.of == &zs_shade_texture_gloss && (job->c[3].base | job->c[3].gx | job->c[3].gy) != 0;
}

static void count_start(const struct zs_job *job, const struct our_shader *s)
{
    const int affine = job->sub_log2 == ZS_AFFINE;
    if (s->kind == KIND_SMOOTH)
        sim_now.n[affine ? SIM_COST_start_smooth : SIM_COST_start_smooth_w]++;
    else if (s->kind == KIND_TEXTURE)
        sim_now.n[affine ? SIM_COST_start_texture : SIM_COST_start_texture_w]++;
    if (s->kind == KIND_TEXTURE && s->of->n_varyings >= 3)
        sim_now.n[SIM_COST_start_light]++;
    sim_now.n[SIM_COST_gloss_start] += sim_look_gloss(job, s);
    if (s->kind != KIND_SOLID && sim_now.wide)
        sim_now.n[sim_now.huge ? SIM_COST_plane_wide : SIM_COST_plane_mid] += s->of->n_varyings + !affine;
}

static void on_start(struct zs_job *job)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    sim_look_as(job, s);
    s->of->start(job);
    job->shader = &s->shader;
    count_start(job, s);
}

/* What tests the pieces of its rows. */
static zs_piece_fn *tester(const struct zs_job *job)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    const struct zs_fast *of = fast_of(job)->of;
    return of && of->span ? of->span : s->of->span ? s->of->span : zs_rows_test;
}

/* Pixels of a cut-out: their keys are kept before the test. */
static void count_kept(const struct our_shader *s, int32_t n)
{
    if (s->of->span && !s->blends)
        sim_now.n[SIM_COST_cutout_tested_px] += n;
}

/* A row by what tests the shader's pieces; not by on_span. */
ZS_ALWAYS_INLINE void row_tested(struct zs_job *job, const struct zs_row *row)
{
    count_kept(sim_shader_of(job->shader), row->i1 - row->i0);
    tester(job)(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx);
}

/* Linear keys, no state, no pixel untouched: an accelerator draws rows itself, or they are tested and have runs
 * coloured. */
static int on_rows(struct zs_job *job)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    const struct zs_fast *of = fast_of(job)->of;
    const struct shape *shape = &sim_now.shape;
    const double runs = sim_now.n[SIM_COST_run];
    const uint32_t before = written();
    if (!of || !of->rows || !of->rows(job))
        zs_rows_walk(job, row_tested, 0);
    const double won = written() - before;
    const int affine = job->sub_log2 == ZS_AFFINE && (s->kind == KIND_SMOOTH ||
                                                      (s->kind == KIND_TEXTURE && job->sampler.direct &&
                                                       job->sampler.unlit));
    if (s->kind == KIND_SOLID && !s->like) {
        sim_now.n[SIM_COST_span_solid] += shape->spans;
        sim_now.n[SIM_COST_px_solid] += shape->px;
        sim_now.n[SIM_COST_won_solid] += won;
    } else if (!affine || runs < sim_now.n[SIM_COST_run]) {
        sim_now.n[SIM_COST_span_runs] += shape->spans;
        sim_now.n[SIM_COST_px_runs] += shape->px;
        sim_now.n[SIM_COST_won_runs] += won;
    } else if (s->kind == KIND_SMOOTH) {
        sim_now.n[SIM_COST_span_smooth] += shape->spans;
        sim_now.n[SIM_COST_px_smooth] += shape->px;
        sim_now.n[SIM_COST_won_smooth] += won;
    } else {
        sim_now.n[SIM_COST_span_direct] += shape->spans;
        sim_now.n[SIM_COST_px_direct] += shape->px;
        sim_now.n[texel_of(job->sampler.texture->format)->won] += won;
    }
    return 1;
}

/* Is each pixel's key found by itself? */
static int pixelwise(void)
{
    return !sim_now.linear && sim_now.of == &zs_depth_linear;
}

/* A piece of a row, or all of one, of an instance without a state. */
static void on_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    const uint32_t before = written();
    count_kept(s, i1 - i0);
    sim_now.testing = 1;
    tester(job)(job, row, i0, i1, sum, gx);
    sim_now.testing = 0;
    const double won = written() - before;
    if (pixelwise()) { /* a piece a pixel; on_planes counts them */
        sim_now.n[SIM_COST_won_runs] += won;
        return;
    }
    const int solid = s->kind == KIND_SOLID && !s->like;
    sim_now.n[SIM_COST_piece]++;
    sim_now.n[solid ? SIM_COST_px_solid : SIM_COST_px_runs] += i1 - i0;
    sim_now.n[solid ? SIM_COST_won_solid : SIM_COST_won_runs] += won;
}

/* A piece of a row of an instance with a state, whose keys are not linear. */
static void on_piece(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    sim_now.n[SIM_COST_piece]++;
    sim_now.n[SIM_COST_px_state] += i1 - i0;
    sim_now.piece(job, row, i0, i1, sum, gx);
}

#define NO_OCTAVES INT32_MIN /* job->w64_scale, where a triangle's keys lie in one */

/* Texels that a format's other function has fetched, or that are taken to be. */
static void count_alpha_texels(const struct zs_job *job, int32_t n)
{
    if (job->sampler.texture->format->fetch == sim_look_texel.fetch)
        return; /* it counts them */
    sim_now.n[SIM_COST_fetch]++;
    sim_now.n[SIM_COST_fetch_565_px] += n;
    sim_now.n[SIM_COST_fetch_group] += job->sub_log2 != ZS_AFFINE;
    if (job->sampler.unlit)
        return;
    sim_now.n[SIM_COST_shine]++;
    sim_now.n[SIM_COST_shine_px] += n;
}

void sim_look_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    sim_now.job = job;
    sim_now.own = job->shader;
    sim_look_as(job, s);
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_material *const ours = in->material;
    whole(in, s->whole);
    s->of->run(job, row, from, to);
    whole(in, ours);
    job->shader = &s->shader;
    sim_now.job = NULL;
}

static void on_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    struct our_shader *s = sim_shader_of(job->shader);
    const int untouched = job->split & ZS_SPLIT_TOUCH && !sim_now.testing, texels = s->kind == KIND_TEXTURE;
    if (s->effect) {
        sim_look_effect_run(job, row, from, to);
        return;
    }
    const int plain = sim_now.method_of && !sim_look_is_hiz();
    sim_now.n[sim_look_is(&zs_method_coverage) ? SIM_COST_run_covered : plain ? SIM_COST_run_plain : SIM_COST_run]++;
    sim_now.n[SIM_COST_run_untouched] += untouched;
    if (untouched)
        sim_now.n[SIM_COST_px_untouched] += to - from;
    if (untouched && job->w64_scale != NO_OCTAVES)
        sim_now.n[SIM_COST_piece]++;
    if (job->depth_state)
        sim_now.n[SIM_COST_won_runs] += to - from;
    if (s->kind == KIND_SOLID)
        sim_now.n[plain ? SIM_COST_run_plain_px : untouched ? SIM_COST_fill_px : SIM_COST_run_solid_px] += to - from;
    if (s->kind == KIND_SMOOTH) {
        sim_now.n[SIM_COST_run_smooth_px] += to - from;
        if (job->sub_log2 != ZS_AFFINE)
            sim_now.n[SIM_COST_run_smooth_part] +=
                ((to - 1 - row->x0) >> job->sub_log2) - ((from - row->x0) >> job->sub_log2) + 1;
    }
    if (sim_look_gloss(job, s))
        sim_now.n[SIM_COST_gloss_px] += to - from;
    if (s->of->span) {
        sim_now.n[s->blends ? SIM_COST_blend_px : SIM_COST_cutout_px] += to - from;
        if (!s->blends && texels && job->sampler.texture->format->fetch != zs_texel_4444.fetch)
            sim_now.n[SIM_COST_cutout_pal_px] += to - from;
        sim_now.n[SIM_COST_add_px] += s->adds ? to - from : 0;
        sim_now.n[!s->blends ? SIM_COST_cutout_run : texels ? SIM_COST_blend_texel_run : SIM_COST_blend_run]++;
    }
    if (s->of->span && texels)
        count_alpha_texels(job, to - from);
    sim_look_run(job, row, from, to);
}

static void count_lit(int32_t n)
{
    sim_now.n[SIM_COST_shine]++;
    sim_now.n[SIM_COST_shine_px] += n;
}

static void on_light(uint16_t *out, int32_t n, uint32_t level, uint32_t step)
{
    count_lit(n);
    zs_shade_texture_flat.light(out, n, level, step);
}

/* A triangle that may be drawn in one go. */
static int on_draw(struct zs_job *job)
{
    const struct our_shader *s = sim_shader_of(job->shader);
    const uint32_t setups = sim_now.r->stats.tris_setup, px = tested(), before = written();
    sim_now.lit = 0;
    zs_fast_chain(job, NULL); /* one triangle a call */
    if (!fast_of(job)->of->draw(job))
        return 0;
    if (sim_now.r->stats.tris_setup == setups)
        return 1;
    sim_now.setups++;
    struct shape shape;
    sim_look_shape(&shape, job);
    sim_now.n[SIM_COST_edge_small_div] += shape.divided;
    if (tested() == px) {
        sim_now.n[SIM_COST_setup_small_empty]++;
        return 1;
    }
    sim_now.tested += (uint64_t)shape.px;
    const int texel = s->kind == KIND_TEXTURE;
    const struct zs_material *material = zs_instance_of(job->r, job->tri->instance)->material;
    sim_now.n[texel ? SIM_COST_setup_small_texel : SIM_COST_setup_small]++;
    sim_now.n[SIM_COST_tilt_small] += shape.tilted;
    sim_now.n[texel ? SIM_COST_row_small_texel : SIM_COST_row_small] += shape.rows;
    sim_now.n[texel ? SIM_COST_span_small_texel : SIM_COST_span_small] += shape.spans;
    sim_now.n[texel ? SIM_COST_px_small_texel : SIM_COST_px_small] += shape.px;
    sim_now.n[texel ? texel_of(material->texture->format)->won : SIM_COST_won_small] += written() - before;
    if (sim_now.lit) {
        sim_now.n[SIM_COST_setup_small_lit]++;
        sim_now.n[SIM_COST_span_small_lit] += shape.spans;
        sim_now.n[SIM_COST_won_small_lit] += written() - before;
    }
    return 1;
}

/* A triangle that has been set up, before its rows are drawn. on_rows counts those of linear keys, without a state and
 * on pixels that were drawn on before. */
static int on_planes(struct zs_job *job)
{
    const struct shape *shape = &sim_now.shape;
    sim_look_setup(job, sim_shader_of(job->shader)->effect && sim_shader_of(job->shader)->kind == KIND_SOLID);
    job->w64_scale = NO_OCTAVES;
    const int linear = sim_now.linear || sim_now.of->planes(job);
    if (sim_shader_of(job->shader)->effect) {
        sim_now.n[SIM_COST_span_runs] += shape->spans;
        if (sim_shader_of(job->shader)->shader.span == NULL)
            sim_now.n[job->depth_state ? SIM_COST_px_state : SIM_COST_px_runs] += shape->px;
    } else if (job->split & ZS_SPLIT_TOUCH) {
        sim_now.untouched = 1;
        sim_now.n[SIM_COST_setup_untouched]++;
        sim_now.n[SIM_COST_setup_octaves] += job->w64_scale != NO_OCTAVES;
        sim_now.n[SIM_COST_row_untouched] += shape->spans;
    } else if (linear && job->depth_state) {
        sim_now.n[SIM_COST_span_runs] += shape->spans;
        sim_now.n[SIM_COST_px_state] += shape->px;
    } else if (pixelwise()) {
        sim_now.n[SIM_COST_setup_linear]++;
        sim_now.n[SIM_COST_span_linear] += shape->spans;
        sim_now.n[SIM_COST_px_linear] += shape->px;
    } else if (!linear) {
        sim_now.n[SIM_COST_setup_octaves]++;
    }
    return linear;
}

/* A row whose keys are not linear. */
static void on_row(struct zs_job *job, const struct zs_row *row)
{
    if (job->depth_state && !pixelwise() && job->piece != on_piece) {
        sim_now.piece = job->piece;
        job->piece = on_piece;
    }
    sim_now.of->row(job, row);
}

/* Texels that are lit by another name than on_light. */
static void count_gloss_lit(int32_t n)
{
    if (sim_now.job && !sim_now.job->sampler.unlit && sim_shader_of(sim_now.own)->of == &zs_shade_texture_gloss)
        count_lit(n);
}

static void on_fetch(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    const struct our_texel *x = texel_of(t->format);
    const int divided = sim_now.job && sim_now.job->sub_log2 != ZS_AFFINE;
    if (n == 1 && t->clamp && !divided) { /* one of a part that goes beyond the border */
        sim_now.n[SIM_COST_fetch_single]++;
    } else {
        sim_now.n[SIM_COST_fetch]++;
        sim_now.n[x->fetch] += n;
        sim_now.n[SIM_COST_fetch_clamped] += t->clamp != 0;
        if (divided)
            sim_now.n[n > 1 ? SIM_COST_fetch_group : SIM_COST_fetch_one]++;
    }
    count_gloss_lit(n);
    x->of->fetch(t, out, n, walk);
}

static void on_gather(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at)
{
    count_gloss_lit(n);
    /* light between vertices is applied without a call, but to a single pixel */
    if (n > 1 && sim_now.job && sim_now.job->shader->n_varyings == 3 && sim_now.job->shader->light == on_light)
        count_lit(n);
    sim_now.n[SIM_COST_divide]++;
    sim_now.n[SIM_COST_divide_px] += n;
    texel_of(t->format)->fast_of->gather(t, out, n, at);
}

static void on_small_lit(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *rows)
{
    sim_now.lit = 1;
    texel_of(t->format)->fast_of->small_lit(job, t, rows);
}

const struct zs_shader sim_look_shader = { .vertex = on_vertex, .face = on_face, .start = on_start, .run = on_run,
                                           .light = on_light, .position = on_position };
const struct zs_texel sim_look_texel = { .fetch = on_fetch };
const struct zs_fast sim_look_fast = { .draw = on_draw, .rows = on_rows, .span = on_span };
const struct zs_fast_texel sim_look_fast_texel = { .gather = on_gather, .small_lit = on_small_lit };

void sim_look_depth(const struct zs_depth *of)
{
    sim_now.of = of;
    sim_now.depth = *of;
    sim_now.depth.setup = on_setup;
    sim_now.depth.vertex = on_depth_vertex;
    sim_now.depth.planes = on_planes;
    sim_now.depth.row = on_row;
}
