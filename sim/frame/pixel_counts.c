/* Counts by pixel. The renderer knows none of this: it is given a depth mapping of our own, which passes on what it is
 * asked to the one that was wanted, and says of itself that keys are not linear on the screen, so that it is asked
 * about every triangle that is set up. It finds the triangle's pixels from its spans; those that are drawn without a
 * test are known by the rows' ranges that zs_fast_touch keeps. The triangle's shader becomes one whose runs it looks on
 * at: they are what is written, as accelerators of shaders and texels, which write pixels by themselves, are left out.
 * Those of the frame are not.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pixel_counts.h"

#include <stdlib.h>
#include <string.h>

#include "core/depth.h"
#include "core/fast.h"
#include "core/rows.h"
#include "core/xform.h"
#include "zs_shader.h"
#include "sim.h"

#define FAST_MAX 64 /* entries of a list that are kept */

/* What renderers see of it is `depth`. */
struct tap {
    struct zs_depth depth;
    const struct zs_depth *of;
    struct sim_counts *out;
    struct zs_renderer *r;            /* that draws */
    struct zs_shader shader;          /* of the instance in hand, its runs ours ... */
    const struct zs_shader *of_shader; /* ... and as it was */
    const struct zs_fast *fast[FAST_MAX + 1];
    uint32_t setups;                  /* up to the strip before */
    uint8_t linear;                   /* flag: what the mapping says of keys */
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
    return err;
}

static void mark(uint32_t *map, const struct zs_job *job, int32_t y, int32_t from, int32_t to)
{
    for (int32_t i = from; i < to; i++)
        map[(size_t)y * (size_t)job->width + (size_t)i]++;
}

static void tap_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct tap *tap = tap_of(job->r);
    mark(tap->out->written, job, row->y, from, to);
    tap->of_shader->run(job, row, from, to);
}

/* Pixels of a triangle that is about to be drawn. */
static void count(const struct tap *tap, const struct zs_job *job)
{
    struct zs_job copy = *job; /* all its rows are cut */
    for (int32_t y = copy.row; y < copy.row_end; y++) {
        if (y >= copy.cut_end)
            zs_edges_cut(&copy, y);
        const struct zs_cut *cut = &copy.cut[y - copy.row];
        const int32_t from = zs_max32(cut->x0, 0), to = zs_min32(cut->x1, job->width);
        if (from >= to)
            continue;
        mark(tap->out->tested, job, y, from, to);
        if (!(job->split & ZS_SPLIT_TOUCH))
            continue;
        const int16_t *const drawn = job->r->drawn[y - job->y0];
        for (int32_t i = from; i < to; i++)
            if (i < drawn[0] || i >= drawn[1])
                mark(tap->out->untested, job, y, i, i + 1);
    }
}

static int tap_planes(struct zs_job *job)
{
    struct tap *tap = tap_of(job->r);
    count(tap, job);
    if (job->shader != &tap->shader) { /* else a triangle of the same instance was before it */
        tap->of_shader = job->shader;
        tap->shader = *job->shader;
        tap->shader.run = tap_run;
        job->shader = &tap->shader;
    }
    return tap->linear || tap->of->planes(job);
}

/* Accelerators of the frame alone. */
static void tap_fast(struct tap *tap, const struct zs_fast *const *fast)
{
    size_t n = 0;
    for (; fast && *fast && n < FAST_MAX; fast++)
        if (!(*fast)->shader && !(*fast)->format)
            tap->fast[n++] = *fast;
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
    tap.depth.planes = tap_planes;
    with.depth = &tap.depth;
    tap_fast(&tap, config->fast);
    with.fast = tap.fast;
    counts->n_strips = ZS_STRIPS(config->height, rows);
    counts->tested = sim_alloc(n, sizeof *counts->tested);
    counts->untested = sim_alloc(n, sizeof *counts->untested);
    counts->written = sim_alloc(n, sizeof *counts->written);
    counts->setups = sim_alloc(counts->n_strips, sizeof *counts->setups);
    int err = sim_frame_render_to(&counts->frame, scene, camera, &with, "counting", &sink);
    const struct zs_stats *s = &counts->frame.stats;
    if (err == ZS_OK &&
        (sum(counts->tested, n) != s->pixels_tested || sum(counts->untested, n) != s->pixels_untested ||
         sum(counts->written, n) != s->pixels_written || sum(counts->setups, counts->n_strips) != s->tris_setup))
        err = SIM_FRAME_BROKEN;
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
