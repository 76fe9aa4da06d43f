/* Strips to frames.
 *
 * SPDX-License-Identifier: MIT
 */
#include "frame.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sim.h"

#define ARENA_ALIGN 32u

/* The receiving end of the sink. */
struct receiver {
    struct sim_frame *frame;
    const char *what;
    const struct zs_sink *to; /* gets the strips too; NULL: nobody */
    struct zs_strip strip; /* submitted, not yet fetched */
    uint32_t sum;          /* over its pixels when it was submitted */
    int pending;           /* flag */
    uint16_t next_y;       /* first row that has not come yet */
};

static uint32_t checksum(const struct zs_strip *strip)
{
    uint32_t h = 2166136261u; /* FNV-1a */
    for (uint32_t i = 0; i < strip->n_bytes; i++)
        h = (h ^ strip->px[i]) * 16777619u;
    return h;
}

static int submit(void *ctx, const struct zs_strip *strip)
{
    struct receiver *to = ctx;
    struct sim_frame *f = to->frame;
    if (to->pending || strip->x != 0 || strip->w != f->width || strip->y != to->next_y ||
        strip->h == 0 || strip->h > f->height - strip->y ||
        strip->n_bytes != (uint32_t)strip->w * strip->h * 2u ||
        strip->last != (strip->y + strip->h == f->height))
        return SIM_FRAME_BROKEN;
    const size_t n = (size_t)strip->w * strip->h;
    memcpy(f->key + (size_t)strip->y * f->width, strip->depth, n * sizeof *f->key);
    to->strip = *strip;
    to->sum = checksum(strip);
    to->pending = 1;
    to->next_y = (uint16_t)(strip->y + strip->h);
    if (to->what != NULL)
        sim_progress(to->what, to->next_y, f->height);
    return to->to != NULL ? to->to->submit(to->to->ctx, strip) : 0;
}

static int wait(void *ctx)
{
    struct receiver *to = ctx;
    const struct zs_strip *s = &to->strip;
    if (!to->pending)
        return 0;
    const int err = to->to != NULL ? to->to->wait(to->to->ctx) : 0;
    if (err < 0)
        return err;
    if (checksum(s) != to->sum)
        return SIM_FRAME_BROKEN; /* it was on the wire */
    uint16_t *out = to->frame->rgb565 + (size_t)s->y * to->frame->width;
    for (size_t i = 0; i < (size_t)s->w * s->h; i++)
        out[i] = (uint16_t)(s->px[2 * i] << 8 | s->px[2 * i + 1]);
    to->pending = 0;
    return 0;
}

void sim_frame_config(struct zs_config *config, uint16_t width, uint16_t height, uint8_t attrs)
{
    memset(config, 0, sizeof *config);
    config->width = width;
    config->height = height;
    config->strip_h = 16;
    config->max_tris = ZS_POOL_MAX;
    config->max_verts = ZS_POOL_MAX;
    config->attrs = attrs;
    config->buffers = 2;
    config->subpixel_bits = 8;
    config->depth_bits = 16;
    config->depth = &zs_depth_float;
}

/* An arena of exactly the bytes that the configuration asks for, at the end of its block, so that
 * AddressSanitizer sees a step beyond it. */
static void *arena_alloc(size_t bytes, void **block)
{
    const size_t room = (bytes / ARENA_ALIGN + 1) * ARENA_ALIGN;
    *block = aligned_alloc(ARENA_ALIGN, room);
    if (*block == NULL) {
        (void)sim_refuse(NULL, 0, "out of memory: an arena of %zu bytes was needed", bytes);
        exit(SIM_REFUSED);
    }
    memset(*block, 0xa5, room);
    return (char *)*block + (room - bytes) / 4 * 4;
}

int sim_frame_render(struct sim_frame *frame, const struct zs_scene *scene,
                     const struct zs_camera *camera, const struct zs_config *config,
                     const char *what)
{
    return sim_frame_render_to(frame, scene, camera, config, what, NULL);
}

int sim_frame_render_to(struct sim_frame *frame, const struct zs_scene *scene, const struct zs_camera *camera,
                        const struct zs_config *config, const char *what, const struct zs_sink *to)
{
    memset(frame, 0, sizeof *frame);
    struct zs_renderer renderer;
    const uint32_t bytes = zs_arena_bytes(config);
    void *block;
    void *arena = arena_alloc(bytes, &block);
    int err = zs_init(&renderer, config, arena, bytes);
    if (err == ZS_OK) {
        const size_t n = (size_t)config->width * config->height;
        frame->width = config->width;
        frame->height = config->height;
        frame->arena_bytes = bytes;
        frame->rgb565 = sim_alloc(n, sizeof *frame->rgb565);
        frame->key = sim_alloc(n, sizeof *frame->key);
        struct receiver receiver = { .frame = frame, .what = what, .to = to };
        const struct zs_sink sink = { submit, wait, &receiver };
        err = zs_render(&renderer, scene, camera, &sink);
        frame->stats = *zs_frame_stats(&renderer);
        if (err == ZS_OK && (receiver.pending || receiver.next_y != config->height))
            err = SIM_FRAME_BROKEN;
    }
    free(block);
    if (what != NULL)
        sim_progress_end();
    if (err != ZS_OK)
        sim_frame_free(frame);
    return err;
}

/* ---- Threads ------------------------------------------------------------------------------------------- */

struct worker {
    struct zs_renderer renderer;
    struct receiver receiver;
    const struct zs_scene *scene;
    const struct zs_camera *camera;
    pthread_t thread;
    void *block; /* its arena's */
    uint32_t share, of;   /* which of how many */
    int bands;            /* 1: its strips lie together; 0: it draws every of-th */
    double cpu;         /* seconds */
    int err;
};

static double clock_seconds(clockid_t clock)
{
    struct timespec t;
    (void)clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Every of-th strip is a fair share, but each thread walks the scene as often as one would do that draws all. Where the
 * pools do not hold the scene, walks take longer than drawing, and a band of strips takes its part of them alone. */
static int has_strip(const struct worker *w, uint32_t strip)
{
    const struct zs_config *c = &w->renderer.config;
    return (w->bands ? strip * w->of / ZS_STRIPS(c->height, c->strip_h) : strip % w->of) == w->share;
}

static int pools_hold(const struct zs_scene *scene, const struct zs_config *config)
{
    uint64_t tris = 0, verts = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        tris += scene->instance[i].mesh->n_tris;
        verts += scene->instance[i].mesh->n_verts;
    }
    return tris <= config->max_tris && verts <= config->max_verts;
}

static void *work(void *ctx)
{
    struct worker *w = ctx;
    struct zs_strip strip;
    int got = 1;
    const double start = clock_seconds(CLOCK_THREAD_CPUTIME_ID);
    w->err = zs_frame_begin(&w->renderer, w->scene, w->camera);
    for (uint32_t s = 0; !w->err && got > 0; s++) {
        if (!has_strip(w, s)) {
            got = zs_frame_skip(&w->renderer);
            continue;
        }
        got = zs_frame_strip(&w->renderer, &strip);
        if (got <= 0)
            break;
        w->receiver.next_y = (uint16_t)(s * w->renderer.config.strip_h);
        w->err = submit(&w->receiver, &strip);
        if (!w->err)
            w->err = wait(&w->receiver);
    }
    if (!w->err)
        w->err = got < 0 ? got : zs_frame_end(&w->renderer);
    w->cpu = clock_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    return NULL;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

static void add_stats(struct zs_stats *sum, const struct zs_stats *s)
{
    sum->verts_transformed += s->verts_transformed;
    sum->tris_setup += s->tris_setup;
    sum->tris_hidden += s->tris_hidden;
    sum->pixels_tested += s->pixels_tested;
    sum->pixels_untested += s->pixels_untested;
    sum->pixels_written += s->pixels_written;
    sum->strips += s->strips;
    sum->passes = larger(sum->passes, s->passes);
    sum->max_tris_used = larger(sum->max_tris_used, s->max_tris_used);
    sum->max_verts_used = larger(sum->max_verts_used, s->max_verts_used);
}

int sim_frame_render_threads(struct sim_frame *frame, const struct zs_scene *scene, const struct zs_camera *camera,
                             const struct zs_config *config, uint32_t n, struct sim_frame_time *time)
{
    const uint32_t bytes = zs_arena_bytes(config);
    struct worker *worker = sim_alloc(n, sizeof *worker);
    uint32_t started = 0;
    int err = ZS_OK;
    memset(frame, 0, sizeof *frame);
    frame->width = config->width;
    frame->height = config->height;
    frame->arena_bytes = bytes;
    frame->rgb565 = sim_alloc((size_t)config->width * config->height, sizeof *frame->rgb565);
    frame->key = sim_alloc((size_t)config->width * config->height, sizeof *frame->key);
    for (uint32_t k = 0; k < n; k++) {
        struct worker *w = &worker[k];
        void *arena = arena_alloc(bytes, &w->block);
        w->receiver.frame = frame;
        w->scene = scene;
        w->camera = camera;
        w->share = k;
        w->of = n;
        w->bands = !pools_hold(scene, config);
        if (!err)
            err = zs_init(&w->renderer, config, arena, bytes);
    }
    const double start = clock_seconds(CLOCK_MONOTONIC);
    while (!err && started + 1 < n && pthread_create(&worker[started + 1].thread, NULL, work, &worker[started + 1]) == 0)
        started++;
    if (!err)
        (void)work(&worker[0]); /* this thread's share */
    for (uint32_t k = 1; k <= started; k++)
        (void)pthread_join(worker[k].thread, NULL);
    for (uint32_t k = started + 1; !err && k < n; k++)
        (void)work(&worker[k]); /* those that the system would not start */
    time->wall = clock_seconds(CLOCK_MONOTONIC) - start;
    time->busiest = 0.0;
    frame->stats = *zs_frame_stats(&worker[0].renderer);
    for (uint32_t k = 0; k < n; k++) {
        if (k > 0)
            add_stats(&frame->stats, zs_frame_stats(&worker[k].renderer));
        if (!err)
            err = worker[k].err;
        if (time->busiest < worker[k].cpu)
            time->busiest = worker[k].cpu;
        free(worker[k].block);
    }
    free(worker);
    if (err != ZS_OK)
        sim_frame_free(frame);
    return err;
}

void sim_frame_free(struct sim_frame *frame)
{
    free(frame->rgb565);
    free(frame->key);
    memset(frame, 0, sizeof *frame);
}

/* Instances of copies of their meshes, painted with 16 bits of the numbers. */
struct painted {
    struct zs_instance *instance;
    struct zs_mesh *mesh;
    struct zs_material *material;
    uint16_t *raw; /* of all triangles */
};

static uint64_t count_tris(const struct zs_scene *scene)
{
    uint64_t n = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++)
        n += scene->instance[i].mesh->n_tris;
    return n;
}

static void paint(struct painted *p, const struct zs_scene *scene, uint64_t n_tris, int shift)
{
    size_t at = 0;
    for (uint64_t t = 0; t < n_tris; t++)
        p->raw[t] = (uint16_t)((t + 1u) >> shift);
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        p->instance[i] = scene->instance[i];
        p->mesh[i] = *scene->instance[i].mesh;
        p->material[i] = *scene->instance[i].material;
        p->mesh[i].face_raw = p->raw + at;
        p->material[i].shader = &zs_shade_raw;
        p->instance[i].mesh = &p->mesh[i];
        p->instance[i].material = &p->material[i];
        at += p->mesh[i].n_tris;
    }
}

int sim_frame_ids(uint32_t *id, const struct zs_scene *scene, const struct zs_camera *camera,
                  const struct zs_config *config)
{
    const uint64_t n_tris = count_tris(scene);
    const uint32_t n = scene->n_instances;
    struct painted p = { sim_alloc(n, sizeof *p.instance), sim_alloc(n, sizeof *p.mesh),
                         sim_alloc(n, sizeof *p.material), sim_alloc(n_tris, sizeof *p.raw) };
    struct zs_scene raw = *scene;
    raw.instance = p.instance;
    raw.background = 0;
    const size_t pixels = (size_t)config->width * config->height;
    memset(id, 0, pixels * sizeof *id);
    int err = ZS_OK;
    for (int shift = 0; err == ZS_OK && n_tris >> shift > 0 && shift < 32; shift += 16) {
        struct sim_frame frame;
        paint(&p, scene, n_tris, shift);
        err = sim_frame_render(&frame, &raw, camera, config, "numbering");
        for (size_t i = 0; err == ZS_OK && i < pixels; i++)
            if (frame.key[i] != ZS_DEPTH_CLEAR)
                id[i] |= (uint32_t)frame.rgb565[i] << shift;
        sim_frame_free(&frame);
    }
    free(p.instance);
    free(p.mesh);
    free(p.material);
    free(p.raw);
    return err;
}

uint32_t sim_frame_visible(const struct sim_frame *frame)
{
    uint32_t n = 0;
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++)
        n += frame->key[i] != ZS_DEPTH_CLEAR;
    return n;
}
