/* Counting what a frame does: it is drawn with copies that look on (costs_look.h), strip by strip.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "core/assemble.h"
#include "core/job.h"
#include "costs_look.h"
#include "fast/parts.h"
#include "sim.h"
#include "zs_method.h"

#define SIM_COST_NAME(name, stage, what) { #name, stage, what },
const struct sim_cost_name sim_cost_names[SIM_COST_N] = { SIM_COSTS(SIM_COST_NAME) };

struct sim_now sim_now;

/* ---- Walks -------------------------------------------------------------------------------------- */

static void on_needs(struct zs_renderer *r, const struct zs_bounds *b)
{
    sim_now.binned[!r->counting].instances++;
    sim_now.batch_of->needs(r, b);
}

/* Triangles of [from, end) that are looked at: not those of parts that do not reach the band. */
static uint32_t looked_at(const struct zs_renderer *r, uint32_t from, uint32_t end)
{
    uint32_t n, all = 0;
    if (!r->parts_tris)
        return end - from;
    for (; from < end && (n = zs_parts_next(r, &from, end, UINT32_MAX)) > 0; from += n)
        all += n;
    return all;
}

static uint32_t on_bin(struct zs_renderer *r, uint32_t from, uint32_t end, uint32_t *outcome, uint32_t *piece)
{
    struct binned *b = &sim_now.binned[!r->counting];
    const uint32_t before = outcome[ZS_OUTCOME_DRAWN] + outcome[ZS_OUTCOME_OFFSCREEN] + outcome[ZS_OUTCOME_EMPTY];
    const uint32_t reached = sim_now.batch_of->bin(r, from, end, outcome, piece), looked = looked_at(r, from, reached);
    b->tris += looked;
    b->gathered += r->direct ? 0 : looked;
    b->boxed += outcome[ZS_OUTCOME_DRAWN] + outcome[ZS_OUTCOME_OFFSCREEN] + outcome[ZS_OUTCOME_EMPTY] - before;
    if (r->parts_tris && (r->counting || r->noting))
        sim_now.n[SIM_COST_tri_noted] += looked;
    sim_now.unpacked = r->n_verts - r->vert_packed;
    sim_now.band = r->band_end;
    return reached;
}

/* Room has been made: all vertices are packed where the band has lost strips. */
static void on_full(struct zs_renderer *r, uint32_t t)
{
    sim_now.n[SIM_COST_vertex_packed] += r->band_end < sim_now.band ? r->config.max_verts : sim_now.unpacked;
    sim_now.batch_of->full(r, t);
}

static void copy_batch(const struct zs_fast *const *list)
{
    while (list && *list && !(*list)->batch)
        list++;
    if (!list || !*list)
        return;
    sim_now.batch_of = (*list)->batch;
    sim_now.batch = *sim_now.batch_of;
    sim_now.batch.needs = on_needs;
    sim_now.batch.bin = on_bin;
    sim_now.batch.full = on_full;
    sim_now.batch_fast.batch = &sim_now.batch;
}

/* How often all walks do what the first one does. */
static double walks_of(double first, double others)
{
    return first > 0.0 ? 1.0 + others / first : sim_now.walks;
}

/* ---- The frame ---------------------------------------------------------------------------------- */

/* Triangles that are wide enough to hide others: they are looked at for that, once a frame, drawn or not. */
static void count_bounds(const struct zs_strip *strip)
{
    const struct zs_renderer *r = sim_now.r;
    for (uint32_t t = 0; r->large && t < r->n_tris; t++) {
        const struct zs_vertex *a = &r->vert[r->tri[t].v[0]], *b = &r->vert[r->tri[t].v[1]], *c =
            &r->vert[r->tri[t].v[2]];
        const int32_t x0 = zs_min32(zs_min32(a->x, b->x), c->x), x1 = zs_max32(zs_max32(a->x, b->x), c->x);
        const int32_t y0 = zs_min32(zs_min32(a->y, b->y), c->y), y1 = zs_max32(zs_max32(a->y, b->y), c->y);
        sim_now.n[SIM_COST_cover] += zs_min32(zs_first_sample(x1), strip->w) - zs_max32(zs_first_sample(x0), 0) >=
            2 << ZS_TILE_LOG2 &&
                                 zs_first_sample(y0) < strip->y + strip->h && zs_first_sample(y1) > strip->y &&
                                 (zs_first_sample(y0) >= strip->y || strip->y == 0); /* once a frame */
    }
}

/* What was counted since the strip before. */
static void weigh_strip(uint32_t strip, int walked)
{
    const uint32_t at = strip / sim_now.neighbours;
    sim_now.walked[at] += (uint16_t)walked;
    sim_now.strips[at]++;
    for (int c = 0; c < SIM_CORES; c++) {
        double sum = 0.0;
        for (int k = 0; k < SIM_COST_N; k++)
            sum += (sim_now.n[k] - sim_now.before[k]) * sim_cost_of((enum sim_core)c, (enum sim_cost)k);
        if (sim_now.slowest[walked][c] < sum)
            sim_now.slowest[walked][c] = sum;
        sim_now.strip[c][at] += sum;
    }
    memcpy(sim_now.before, sim_now.n, sizeof sim_now.before);
}

static int on_submit(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    const uint32_t at = strip->y / sim_now.r->config.strip_h;
    const int walked = at >= sim_now.band_end;
    sim_now.walks += (uint32_t)walked;
    sim_now.band_end = sim_now.r->band_end;
    count_bounds(strip);
    if (sim_now.untouched && sim_now.r->untouched_left)
        sim_now.n[SIM_COST_row_clear] += strip->h;
    sim_now.untouched = 0;
    sim_look_count_method();
    weigh_strip(at, walked);
    for (uint32_t i = 0; i < strip->n_bytes; i++)
        sim_now.checksum = (sim_now.checksum ^ strip->px[i]) * 16777619u;
    return 0;
}

static int on_wait(void *ctx)
{
    (void)ctx;
    return 0;
}

/* What the renderer's own statistics say. */
static void count_frame(const struct zs_config *config, const struct zs_stats *s)
{
    double *n = sim_now.n;
    const double walks = sim_now.walks, walked = s->instances_in - s->instances_culled;
    n[SIM_COST_frame] = 1;
    n[SIM_COST_strip] = s->strips;
    n[SIM_COST_clear_px] = (double)config->width * config->height - s->pixels_untested;
    if (sim_now.of->span)
        n[SIM_COST_clear_px] /= 2.0; /* the colour alone */
    n[SIM_COST_instance] = walked * walks_of(sim_now.binned[0].instances, sim_now.binned[1].instances);
    n[SIM_COST_instance_culled] = walks * s->instances_culled;
    n[SIM_COST_vertex_out] =
        s->verts_transformed - (n[SIM_COST_vertex] + n[SIM_COST_vertex_recip] + n[SIM_COST_vertex_linear] +
                                                     n[SIM_COST_vertex_ortho]);
    if (n[SIM_COST_vertex_out] < 0) /* clipping projects too */
        n[SIM_COST_vertex_out] = 0;
    n[SIM_COST_tri] = (s->tris_in - s->tris_frustum) * walks_of(sim_now.binned[0].tris, sim_now.binned[1].tris);
    n[SIM_COST_tri_looked] = sim_now.binned[0].gathered + sim_now.binned[1].gathered;
    n[SIM_COST_tri_box] = (s->tris_drawn + s->tris_offscreen + s->tris_empty) *
                          walks_of(sim_now.binned[0].boxed, sim_now.binned[1].boxed);
    n[SIM_COST_tri_clip] = walks * s->tris_clipped;
    n[SIM_COST_tri_hidden] = s->tris_hidden;
    n[SIM_COST_setup_empty] += s->tris_setup - sim_now.setups;
    n[SIM_COST_instance_asked] += walks * s->instances_hidden;
}

/* Meshes whose triangles are all asked what they hide: of those that were walked, on average. */
static void count_asked(const struct zs_scene *scene, const struct zs_config *config, const struct zs_stats *s)
{
    double n = 0.0;
    for (size_t i = 0; i < scene->n_instances; i++)
        if (sim_look_all_asked(config->width, scene->instance[i].mesh))
            n += scene->instance[i].mesh->n_tris;
    if (s->instances_in > 0)
        sim_now.n[SIM_COST_tri_asked] += n * sim_now.walks * (1.0 - (double)s->instances_culled / s->instances_in);
}

/* Each strip, and the slowest: what was counted while it was drawn, its share of what is the same in all of them, and
 * in those that begin with a walk, a walk's share of the rest. */
static void find_strips(struct sim_counted *out)
{
    out->neighbours = sim_now.neighbours;
    out->n_strips = (out->stats.strips + sim_now.neighbours - 1u) / sim_now.neighbours;
    for (int c = 0; c < SIM_CORES; c++) {
        const enum sim_core core = (enum sim_core)c;
        double all = 0.0;
        for (int k = 0; k < SIM_COST_N; k++)
            all += (out->n[k] - sim_now.before[k]) * sim_cost_of(core, (enum sim_cost)k);
        const double strips = out->n[SIM_COST_strip] * sim_cost_of(core, SIM_COST_strip) +
                              out->n[SIM_COST_clear_px] * sim_cost_of(core, SIM_COST_clear_px);
        const double walk = sim_now.slowest[1][c] + (all - strips) / sim_now.walks;
        out->worst[c] = strips / out->stats.strips + (walk > sim_now.slowest[0][c] ? walk : sim_now.slowest[0][c]);
        for (uint32_t i = 0; i < out->n_strips; i++)
            out->strip[c][i] += strips / out->stats.strips * sim_now.strips[i] +
                                (all - strips) / sim_now.walks * sim_now.walked[i];
    }
}

/* A frame's passes, of copies that look on. */
struct copied {
    struct zs_pass pass[SIM_COUNT_PASSES];
    struct zs_scene scene[SIM_COUNT_PASSES];
    struct zs_instance *instance;
    struct thing *things;
    uint32_t first[SIM_COUNT_PASSES]; /* of a pass's instances and things */
    uint32_t n, all;
};

/* The pass before k that draws the same scene; k: none does. Its hooks are called once. */
static uint32_t same_scene(const struct zs_pass *pass, uint32_t k)
{
    uint32_t before = 0;
    while (pass[before].scene != pass[k].scene)
        before++;
    return before;
}

static void copy_passes(struct copied *c, const struct zs_pass *pass, uint32_t n, const struct zs_fast *const *fast)
{
    memset(c, 0, sizeof *c);
    c->n = n;
    for (uint32_t k = 0; k < n; k++) {
        c->first[k] = c->all;
        c->all += pass[k].scene->n_instances;
    }
    c->instance = sim_alloc((size_t)c->all + 1u, sizeof *c->instance);
    c->things = sim_alloc((size_t)c->all + 1u, sizeof *c->things);
    for (uint32_t k = 0; k < n; k++) {
        c->pass[k] = pass[k];
        c->scene[k] = *pass[k].scene;
        c->scene[k].instance = c->instance + c->first[k];
        c->pass[k].scene = &c->scene[same_scene(pass, k)];
        for (uint32_t i = 0; i < pass[k].scene->n_instances; i++) {
            c->instance[c->first[k] + i] = pass[k].scene->instance[i];
            sim_look_copy(&c->instance[c->first[k] + i], &c->things[c->first[k] + i], fast);
        }
    }
}

static int draw_passes(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    struct zs_pass_memory memory[SIM_COUNT_PASSES];
    const struct copied *c = ctx;
    return c->n == 1 ? zs_render(r, c->pass[0].scene, c->pass[0].camera, sink)
                     : zs_render_passes(r, c->pass, memory, c->n, sink);
}

/* What effects take, and viewports of later passes that are cleared. */
static void count_passes(struct sim_counted *out, const struct copied *c, const struct zs_pass *pass,
                         const struct sim_frame *frame)
{
    for (uint32_t k = 0; k < c->n; k++) {
        const struct zs_rect *v = &pass[k].viewport;
        const uint32_t before = same_scene(pass, k);
        if (k > 0 && pass[k].mask == NULL)
            out->n[SIM_COST_clear_px] += (v->w > 0 ? (double)v->w * v->h : (double)frame->width * frame->height) *
                                         (!(pass[k].keep & ZS_KEEP_COLOR) + !(pass[k].keep & ZS_KEEP_DEPTH)) / 2.0;
        if (before == k)
            sim_look_effects(out, pass[k].scene, c->things + c->first[k]);
        sim_look_around(out, &pass[k], frame, before == k);
    }
}

int sim_costs_count_passes(struct sim_counted *out, const struct zs_pass *pass, uint32_t n,
                           const struct zs_config *config)
{
    struct zs_config with = *config;
    struct sim_frame frame;
    struct copied c;
    const struct zs_sink sink = { .submit = on_submit, .wait = on_wait };
    memset(out, 0, sizeof *out);
    if (n < 1 || n > SIM_COUNT_PASSES)
        return ZS_ERR_SIZE;
    memset(&sim_now, 0, sizeof sim_now);
    sim_now.n = out->n;
    sim_now.strip = out->strip;
    sim_now.neighbours = 1u + (ZS_STRIPS(config->height, config->strip_h) - 1u) / SIM_COUNT_STRIPS;
    sim_look_depth(config->depth);
    sim_now.checksum = 2166136261u;
    sim_now.instance = UINT32_MAX;
    with.depth = &sim_now.depth;
    copy_passes(&c, pass, n, config->fast);
    copy_batch(config->fast);
    sim_look_method(&with);
    const struct zs_fast **fast = sim_look_list(config->fast, c.things, c.all);
    with.fast = fast;
    const struct sim_drawing drawing = { draw_passes, &c, config->width, config->height, sim_frame_no_keys(config) };
    int err = sim_frame_render_by(&frame, &drawing, &with, NULL, &sink);
    if (err == ZS_OK) {
        out->stats = frame.stats;
        out->checksum = sim_now.checksum;
        count_frame(config, &frame.stats);
        for (uint32_t k = 0; k < n; k++)
            count_asked(pass[k].scene, config, &frame.stats);
        count_passes(out, &c, pass, &frame);
        if (sim_now.walks > 0 && frame.stats.strips > 0)
            find_strips(out);
        if (sim_now.tested != frame.stats.pixels_tested)
            err = SIM_FRAME_BROKEN;
    }
    sim_frame_free(&frame);
    free(fast);
    SIM_FREE(c.instance, c.things);
    return err;
}

int sim_costs_count(struct sim_counted *out, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct zs_config *config)
{
    const struct zs_pass pass = { .scene = scene, .camera = camera };
    return sim_costs_count_passes(out, &pass, 1, config);
}
