/* A frame by several threads. What they share out:
 *
 *   strips   every n-th to each, as long as the pools hold the scene: a fair share of the pixels, but each thread walks
 *            the scene as often as one would do that draws all.
 *   bands    strips that lie together. Where the pools do not hold the scene walks take longer than drawing, and a band
 *            takes its part of them alone.
 *   parts    of the triangles, in scene order, where a walk takes longer than the pixels: every n-th part to each,
 *            drawn as a frame of its own. The nearest key wins at every pixel, and on equal keys the earlier part:
 *            least (key, scene order), as in one frame. Not with states, which mind what was drawn
 *            before.
 *
 * SPDX-License-Identifier: MIT
 */
#include "frame_inside.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "kept.h"
#include "scene_share.h"
#include "sim.h"
#include "zs_method.h"

enum way { BY_STRIPS, BY_BANDS, BY_PARTS };
#define PART_TRIS 1500u   /* a part has at least so many, ... */
#define PARTS_MAX 3u      /* ... and a thread at most so many parts, which evens out what threads take */
#define PIXELS_A_TRI 6u   /* at most, for parts to pay: a part clears and looks at every pixel of the frame */
#define INSTANCE_TRIS 64u /* at least, of an instance: a part sets all instances up */

struct worker {
    struct zs_renderer renderer;
    struct sim_frame *frame;
    const struct zs_scene *scene;
    const struct zs_camera *camera;
    pthread_t thread;
    void *arena;
    uint32_t share, of; /* which of how many */
    enum way way;
    uint32_t n_parts;   /* of the triangles, of all threads */
    uint64_t n_tris;
    struct sim_frame own; /* by parts: what is nearest of this thread's ... */
    uint16_t *part;       /* ... and of which part, per pixel */
    struct zs_stats stats;
    double cpu; /* seconds */
    int err;
};

static double clock_seconds(clockid_t clock)
{
    struct timespec t;
    (void)clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* What was done in two drawings of the same triangles, or (whole is 1) of different ones. */
static void add_stats(struct zs_stats *sum, const struct zs_stats *s, int whole)
{
    if (whole) {
        sum->tris_in += s->tris_in;
        sum->tris_drawn += s->tris_drawn;
        sum->tris_frustum += s->tris_frustum;
        sum->tris_cluster += s->tris_cluster;
        sum->clusters_in += s->clusters_in;
        sum->clusters_culled += s->clusters_culled;
        sum->tris_near += s->tris_near;
        sum->tris_far += s->tris_far;
        sum->tris_offscreen += s->tris_offscreen;
        sum->tris_facing += s->tris_facing;
        sum->tris_zero += s->tris_zero;
        sum->tris_empty += s->tris_empty;
        sum->tris_index += s->tris_index;
        sum->tris_clipped += s->tris_clipped;
    } else {
        sum->strips += s->strips;
    }
    sum->verts_transformed += s->verts_transformed;
    sum->tris_setup += s->tris_setup;
    sum->tris_hidden += s->tris_hidden;
    sum->pixels_tested += s->pixels_tested;
    sum->pixels_untested += s->pixels_untested;
    sum->pixels_written += s->pixels_written;
    sum->passes = larger(sum->passes, s->passes);
    sum->max_tris_used = larger(sum->max_tris_used, s->max_tris_used);
    sum->max_verts_used = larger(sum->max_verts_used, s->max_verts_used);
}

/* ---- A share of the strips */

static int has_strip(const struct worker *w, uint32_t strip)
{
    const struct zs_config *c = &w->renderer.config;
    return (w->way == BY_BANDS ? strip * w->of / ZS_STRIPS(c->height, c->strip_h) : strip % w->of) == w->share;
}

static void copy_strip(struct sim_frame *frame, const struct zs_strip *s)
{
    const size_t first = (size_t)s->y * frame->width, n = (size_t)s->w * s->h;
    if (!frame->no_keys)
        memcpy(frame->key + first, s->depth, n * sizeof *frame->key);
    for (size_t i = 0; i < n; i++)
        frame->rgb565[first + i] = (uint16_t)(s->px[2 * i] << 8 | s->px[2 * i + 1]);
}

static void draw_strips(struct worker *w)
{
    struct zs_strip strip;
    int got = 1;
    w->err = zs_frame_begin(&w->renderer, w->scene, w->camera);
    for (uint32_t s = 0; !w->err && got > 0; s++) {
        if (!has_strip(w, s)) {
            got = zs_frame_skip(&w->renderer);
            continue;
        }
        got = zs_frame_strip(&w->renderer, &strip);
        if (got <= 0)
            break;
        w->err = strip.y == s * w->renderer.config.strip_h ? ZS_OK : SIM_FRAME_BROKEN;
        copy_strip(w->frame, &strip);
    }
    if (!w->err)
        w->err = got < 0 ? got : zs_frame_end(&w->renderer);
    w->stats = *zs_frame_stats(&w->renderer);
    w->stats.strips -= w->stats.strips_skipped; /* those that others draw count as given out too */
    w->stats.strips_skipped = 0;
}

/* ---- A share of the triangles */

/* n pixels of a part, or of a thread. */
struct pixels {
    const uint16_t *key, *part; /* part NULL: all of the one */
    const uint16_t *rgb565;     /* NULL: px */
    const uint8_t *px;
    uint16_t the_one;
};

/* Those of `from` that are nearer, and on equal keys of an earlier part, go to a frame from pixel `first` on. */
static void keep_nearest(struct sim_frame *frame, uint16_t *frame_part, size_t first, const struct pixels *from,
                         size_t n)
{
    static const uint16_t none[4] = { ZS_DEPTH_CLEAR, ZS_DEPTH_CLEAR, ZS_DEPTH_CLEAR, ZS_DEPTH_CLEAR };
    uint16_t *key = frame->key + first, *rgb565 = frame->rgb565 + first, *part = frame_part + first;
    for (size_t i = 0; i < n;) {
        if (i + 4 <= n && memcmp(from->key + i, none, sizeof none) == 0) {
            i += 4;
            continue;
        }
        for (const size_t end = i + 4 < n ? i + 4 : n; i < end; i++) {
            const uint16_t of = from->part != NULL ? from->part[i] : from->the_one;
            if (from->key[i] < key[i] || (from->key[i] == key[i] && key[i] != ZS_DEPTH_CLEAR && of < part[i])) {
                key[i] = from->key[i];
                part[i] = of;
                rgb565[i] = from->rgb565 != NULL ? from->rgb565[i]
                                                 : (uint16_t)(from->px[2 * i] << 8 | from->px[2 * i + 1]);
            }
        }
    }
}

static int draw_part(struct worker *w, const struct zs_scene *scene, uint16_t part)
{
    struct zs_strip strip;
    int got, err = zs_frame_begin(&w->renderer, scene, w->camera);
    if (err)
        return err;
    while ((got = zs_frame_strip(&w->renderer, &strip)) > 0) {
        const struct pixels from = { .key = strip.depth, .px = strip.px, .the_one = part };
        keep_nearest(&w->own, w->part, (size_t)strip.y * strip.w, &from, (size_t)strip.w * strip.h);
    }
    err = zs_frame_end(&w->renderer);
    return got < 0 ? got : err;
}

static void draw_parts(struct worker *w)
{
    const size_t n = (size_t)w->own.width * w->own.height;
    memset(w->own.key, 0xff, n * sizeof *w->own.key); /* ZS_DEPTH_CLEAR */
    if (w->share == 0) { /* the others come on top of it */
        uint16_t *row = w->own.rgb565;
        for (uint32_t x = 0; x < w->own.width; x++)
            row[x] = w->scene->background;
        for (uint32_t y = 1; y < w->own.height; y++)
            memcpy(row + (size_t)y * w->own.width, row, w->own.width * sizeof *row);
    }
    for (uint32_t k = w->share; !w->err && k < w->n_parts; k += w->of) {
        struct sim_share share;
        sim_share_make(&share, w->scene, w->n_tris * k / w->n_parts, w->n_tris * (k + 1u) / w->n_parts);
        w->err = draw_part(w, &share.scene, (uint16_t)k);
        if (k == w->share)
            w->stats = *zs_frame_stats(&w->renderer);
        else
            add_stats(&w->stats, zs_frame_stats(&w->renderer), 1);
        sim_share_free(&share);
    }
}

/* What is nearest of all threads': the first's is the frame. */
static void gather(struct sim_frame *frame, struct worker *worker, uint32_t n)
{
    const struct sim_frame empty = { 0 };
    frame->key = worker[0].own.key;
    frame->rgb565 = worker[0].own.rgb565;
    worker[0].own = empty;
    for (uint32_t k = 1; k < n; k++) {
        const struct worker *w = &worker[k];
        const struct pixels from = { .key = w->own.key, .part = w->part, .rgb565 = w->own.rgb565 };
        keep_nearest(frame, worker[0].part, 0, &from, (size_t)frame->width * frame->height);
    }
}

/* ---- All threads */

static void *work(void *ctx)
{
    struct worker *w = ctx;
    const double start = clock_seconds(CLOCK_THREAD_CPUTIME_ID);
    (w->way == BY_PARTS ? draw_parts : draw_strips)(w);
    w->cpu = clock_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    return NULL;
}

/* How n threads draw a scene; by parts: *parts of them. */
static enum way way_of(const struct zs_scene *scene, const struct zs_config *config, uint32_t n, uint64_t *n_tris,
                       uint32_t *parts)
{
    uint64_t verts = 0;
    int simple = config->method == NULL; /* else there may be no keys */
    *n_tris = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const struct zs_mesh *mesh = scene->instance[i].mesh;
        if (mesh == NULL)
            return BY_STRIPS; /* which refuses it */
        *n_tris += mesh->n_tris;
        verts += mesh->n_verts;
        simple &= mesh->pos != NULL && mesh->tri != NULL && mesh->n_verts <= 65535u &&
                  scene->instance[i].depth_state == NULL &&
                  !(scene->instance[i].material && scene->instance[i].material->primitive);
    }
    const uint64_t pixels = (uint64_t)config->width * config->height;
    if (simple && n > 1 && *n_tris >= n && *n_tris * PIXELS_A_TRI >= pixels &&
        *n_tris >= (uint64_t)INSTANCE_TRIS * scene->n_instances) {
        const uint64_t each = *n_tris / n / PART_TRIS;
        *parts = n * (each < 1 ? 1 : each > PARTS_MAX ? PARTS_MAX : (uint32_t)each);
        return BY_PARTS;
    }
    return *n_tris <= config->max_tris && verts <= config->max_verts ? BY_STRIPS : BY_BANDS;
}

static int worker_init(struct worker *w, const struct zs_config *config, struct sim_frame *frame)
{
    const uint32_t bytes = zs_arena_bytes(config);
    const size_t n = (size_t)config->width * config->height;
    w->arena = sim_frame_arena(bytes);
    w->frame = frame;
    if (w->way == BY_PARTS) {
        w->own.width = config->width;
        w->own.height = config->height;
        w->own.key = sim_alloc(n, sizeof *w->own.key);
        w->own.rgb565 = sim_alloc(n, sizeof *w->own.rgb565);
        w->part = sim_alloc(n, sizeof *w->part);
    }
    return zs_init(&w->renderer, config, w->arena, bytes);
}

static void worker_free(struct worker *w)
{
    sim_frame_free(&w->own);
    free(w->part);
    sim_kept_end(w->arena);
}

/* Statistics of all, and the processor's time of the busiest. Return the first error. */
static int sum_up(struct sim_frame *frame, const struct worker *worker, uint32_t n, double *busiest)
{
    int err = ZS_OK;
    frame->stats = worker[0].stats;
    *busiest = 0.0;
    for (uint32_t k = 0; k < n; k++) {
        if (k > 0)
            add_stats(&frame->stats, &worker[k].stats, worker[k].way == BY_PARTS);
        if (!err)
            err = worker[k].err;
        if (*busiest < worker[k].cpu)
            *busiest = worker[k].cpu;
    }
    return err;
}

int sim_frame_render_threads(struct sim_frame *frame, const struct zs_scene *scene, const struct zs_camera *camera,
                             const struct zs_config *config, uint32_t n, struct sim_frame_time *time)
{
    struct worker *worker = sim_alloc(n, sizeof *worker);
    uint64_t n_tris;
    uint32_t started = 0, parts = 0;
    const enum way way = way_of(scene, config, n, &n_tris, &parts);
    int err = ZS_OK;
    memset(frame, 0, sizeof *frame);
    frame->width = config->width;
    frame->height = config->height;
    frame->arena_bytes = zs_arena_bytes(config);
    frame->no_depth = config->depth == &zs_depth_none || config->depth == &zs_depth_order;
    frame->no_keys = sim_frame_no_keys(config);
    if (way != BY_PARTS) {
        frame->rgb565 = sim_alloc((size_t)config->width * config->height, sizeof *frame->rgb565);
        frame->key = sim_alloc((size_t)config->width * config->height, sizeof *frame->key);
    }
    for (uint32_t k = 0; k < n; k++) {
        struct worker *w = &worker[k];
        w->scene = scene;
        w->camera = camera;
        w->share = k;
        w->of = n;
        w->way = way;
        w->n_parts = parts;
        w->n_tris = n_tris;
        if (!err)
            err = worker_init(w, config, frame);
    }
    const double start = clock_seconds(CLOCK_MONOTONIC);
    while (!err && started + 1 < n &&
           pthread_create(&worker[started + 1].thread, NULL, work, &worker[started + 1]) == 0)
        started++;
    if (!err)
        (void)work(&worker[0]); /* this thread's share */
    for (uint32_t k = 1; k <= started; k++)
        (void)pthread_join(worker[k].thread, NULL);
    for (uint32_t k = started + 1; !err && k < n; k++)
        (void)work(&worker[k]); /* those that the system would not start */
    const int first = sum_up(frame, worker, n, &time->busiest);
    err = err ? err : first;
    const double gathering = clock_seconds(CLOCK_THREAD_CPUTIME_ID);
    if (!err && way == BY_PARTS)
        gather(frame, worker, n);
    time->busiest += clock_seconds(CLOCK_THREAD_CPUTIME_ID) - gathering; /* while the others wait */
    time->wall = clock_seconds(CLOCK_MONOTONIC) - start;
    time->parts = parts;
    for (uint32_t k = 0; k < n; k++)
        worker_free(&worker[k]);
    free(worker);
    if (err != ZS_OK)
        sim_frame_free(frame);
    return err;
}
