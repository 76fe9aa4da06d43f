/* Counts by pixel. The renderer knows none of this: it is given a depth mapping of our own, which passes on what it is
 * asked to the one that was wanted, and says of itself that keys are not linear on the screen, so that it is asked to
 * draw every triangle. It finds the triangle's pixels from its spans, and those that were written from the keys that
 * have changed: a key that wins is less than the one before; pixels that nothing was drawn on yet hold no key, and are known by
 * the rows' ranges that the renderer keeps. Of instances with a state, which may win without that, it
 * looks on at the shader's runs.
 *
 * SPDX-License-Identifier: MIT
 */
#include "counts.h"

#include <stdlib.h>
#include <string.h>

#include "core/rows.h"
#include "sim.h"

/* What renderers see of it is `depth`. */
struct tap {
    struct zs_depth depth;
    const struct zs_depth *of;
    struct sim_counts *out;
    struct zs_renderer *r;          /* that draws */
    const struct zs_shader *shader; /* of the triangle in hand */
    uint16_t *before;               /* [strip_h][width]: keys before it */
    int16_t (*drawn)[2];            /* [strip_h]: columns that held keys before it; */
    uint8_t fresh;                  /* 1: others held none */
    uint32_t setups;                /* up to the strip before */
    uint8_t linear, broken;         /* flags: what the mapping says of keys; counts disagree */
};

static struct tap *tap_of(const struct zs_renderer *r)
{
    return (struct tap *)(uintptr_t)r->config.depth; /* its first member; ours to write */
}

static int tap_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    struct zs_renderer *r = (struct zs_renderer *)(void *)((char *)view - offsetof(struct zs_renderer, view));
    struct tap *tap = tap_of(r);
    const int err = tap->of->setup(view, camera, bits);
    tap->r = r;
    tap->linear = view->screen_linear;
    view->screen_linear = 0;
    view->piece_shift = 0; /* nor the way of small triangles, which asks no mapping */
    return err;
}

static void mark(uint32_t *map, const struct zs_job *job, int32_t y, int32_t from, int32_t to)
{
    for (int32_t i = from; i < to; i++)
        map[(size_t)y * (size_t)job->width + (size_t)i]++;
}

/* A run of a triangle with a state. */
static void tap_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct tap *tap = tap_of(job->r);
    mark(tap->out->written, job, row->y, from, to);
    tap->shader->run(job, row, from, to);
}

/* Pixels of a triangle that is drawn by now. `job` is as it was before. Return how many. */
static uint32_t count(const struct tap *tap, struct zs_job *job)
{
    uint32_t n = 0;
    for (int32_t y = job->row; y < job->row_end; y++) {
        if (y >= job->cut_end)
            zs_raster_cuts(job, y);
        const struct zs_cut *cut = &job->cut[y - job->row];
        const int32_t from = zs_max32(cut->x0, 0), to = zs_min32(cut->x1, job->width);
        if (from >= to)
            continue;
        mark(tap->out->tested, job, y, from, to);
        n += (uint32_t)(to - from);
        const size_t at = (size_t)(y - job->y0) * (size_t)job->width;
        const int16_t *const drawn = tap->drawn[y - job->y0];
        for (int32_t i = from; i < to && (tap->fresh || !job->state); i++) {
            const int fresh = tap->fresh && (i < drawn[0] || i >= drawn[1]);
            if (fresh && !(job->r->config.skip_off & ZS_SKIP_TEST))
                mark(tap->out->untested, job, y, i, i + 1);
            if (fresh || job->depth[at + (size_t)i] != tap->before[at + (size_t)i])
                mark(tap->out->written, job, y, i, i + 1);
        }
    }
    return n;
}

static void tap_rows(struct zs_job *job)
{
    struct tap *tap = tap_of(job->r);
    struct zs_renderer *r = job->r;
    struct zs_job copy = *job;
    struct zs_shader shader = *job->shader;
    const uint32_t tested = r->stats.pixels_tested;
    const size_t at = (size_t)(job->row - job->y0) * (size_t)job->width;
    memcpy(tap->before + at, job->depth + at, (size_t)(job->row_end - job->row) * (size_t)job->width * 2u);
    tap->fresh = job->fresh;
    if (tap->fresh)
        memcpy(tap->drawn, r->drawn, (size_t)(job->y1 - job->y0) * sizeof *tap->drawn);
    if (job->state && !tap->fresh) {
        tap->shader = job->shader;
        shader.run = tap_run;
        job->shader = &shader;
    }
    r->view.screen_linear = tap->linear;
    if (tap->linear)
        zs_raster_keys(job);
    else
        tap->of->rows(job);
    r->view.screen_linear = 0;
    job->shader = copy.shader; /* the next triangle's too */
    tap->broken |= count(tap, &copy) != r->stats.pixels_tested - tested;
}

/* ---- Strips ------------------------------------------------------------------------------------------ */

static int tap_submit(void *ctx, const struct zs_strip *strip)
{
    struct tap *tap = ctx;
    const struct zs_stats *s = zs_frame_stats(tap->r);
    tap->out->setups[strip->y / tap->r->config.strip_h] = s->tris_setup - tap->setups;
    tap->setups = s->tris_setup;
    return 0;
}

static int tap_wait(void *ctx)
{
    (void)ctx;
    return 0;
}

static uint64_t sum(const uint32_t *map, size_t n)
{
    uint64_t s = 0;
    for (size_t i = 0; i < n; i++)
        s += map[i];
    return s;
}

int sim_counts_draw(struct sim_counts *counts, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct zs_config *config)
{
    const size_t n = (size_t)config->width * config->height;
    const uint16_t rows = config->strip_h < config->height ? config->strip_h : config->height;
    struct tap tap = { .depth = *config->depth, .of = config->depth, .out = counts };
    struct zs_config with = *config;
    const struct zs_sink sink = { .submit = tap_submit, .wait = tap_wait, .ctx = &tap };
    memset(counts, 0, sizeof *counts);
    tap.depth.setup = tap_setup;
    tap.depth.rows = tap_rows;
    with.depth = &tap.depth;
    tap.before = sim_alloc((size_t)config->width * rows, sizeof *tap.before);
    counts->n_strips = ZS_STRIPS(config->height, rows);
    counts->tested = sim_alloc(n, sizeof *counts->tested);
    tap.drawn = sim_alloc(rows, sizeof *tap.drawn);
    counts->untested = sim_alloc(n, sizeof *counts->untested);
    counts->written = sim_alloc(n, sizeof *counts->written);
    counts->setups = sim_alloc(counts->n_strips, sizeof *counts->setups);
    int err = sim_frame_render_to(&counts->frame, scene, camera, &with, "counting", &sink);
    const struct zs_stats *s = &counts->frame.stats;
    if (err == ZS_OK && (tap.broken || sum(counts->tested, n) != s->pixels_tested ||
                         sum(counts->untested, n) != s->pixels_untested || sum(counts->written, n) != s->pixels_written ||
                         sum(counts->setups, counts->n_strips) != s->tris_setup))
        err = SIM_FRAME_BROKEN;
    free(tap.before);
    free(tap.drawn);
    if (err != ZS_OK)
        sim_counts_free(counts);
    return err;
}

void sim_counts_free(struct sim_counts *counts)
{
    sim_frame_free(&counts->frame);
    free(counts->tested);
    free(counts->untested);
    free(counts->written);
    free(counts->setups);
    memset(counts, 0, sizeof *counts);
}
