/* Strips to frames.
 *
 * SPDX-License-Identifier: MIT
 */
#include "frame_inside.h"

#include <stdlib.h>
#include <string.h>

#include "kept.h"
#include "method_names.h"
#include "sim.h"
#include "strip_sum.h"
#include "zs_fast.h"

int sim_frame_no_keys(const struct zs_config *config)
{
    const struct sim_method *method = sim_method_of(config);
    return config->depth == &zs_depth_none || config->depth == &zs_depth_order || (method && !method->keys);
}

/* The receiving end of the sink. */
struct receiver {
    struct sim_frame *frame;
    const char *what;
    const struct zs_sink *to; /* gets the strips too; NULL: nobody */
    struct zs_strip strip; /* submitted, not yet fetched */
    uint32_t sum;          /* over its pixels when it was submitted */
    int pending;           /* flag */
    int ends;              /* calls of end */
    uint16_t next_y;       /* first row that has not come yet */
};

static int submit(void *ctx, const struct zs_strip *strip)
{
    struct receiver *to = ctx;
    struct sim_frame *f = to->frame;
    if (to->pending || strip->x != 0 || strip->w != f->width || strip->y != to->next_y ||
        strip->h == 0 || strip->h > f->height - strip->y ||
        strip->n_bytes != (uint32_t)strip->w * strip->h * 2u)
        return SIM_FRAME_BROKEN;
    const size_t n = (size_t)strip->w * strip->h;
    f->no_depth = strip->depth == NULL;
    if (!f->no_keys && !f->no_depth)
        memcpy(f->key + (size_t)strip->y * f->width, strip->depth, n * sizeof *f->key);
    to->strip = *strip;
    to->sum = sim_strip_sum(strip);
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
    if (sim_strip_sum(s) != to->sum)
        return SIM_FRAME_BROKEN; /* it was on the wire */
    uint16_t *out = to->frame->rgb565 + (size_t)s->y * to->frame->width;
    for (size_t i = 0; i < (size_t)s->w * s->h; i++)
        out[i] = (uint16_t)(s->px[2 * i] << 8 | s->px[2 * i + 1]);
    to->pending = 0;
    return 0;
}

static int end(void *ctx)
{
    struct receiver *to = ctx;
    to->ends++;
    return to->to != NULL && to->to->end != NULL ? to->to->end(to->to->ctx) : 0;
}

void sim_frame_config(struct zs_config *config, uint16_t width, uint16_t height, uint8_t attrs)
{
    static const struct zs_fast *const all[] = { ZS_FAST_ALL, ZS_FAST_END };
    memset(config, 0, sizeof *config);
    config->width = width;
    config->height = height;
    config->strip_h = 16;
    config->max_tris = ZS_POOL_MAX;
    config->max_verts = ZS_POOL_MAX;
    config->varyings = attrs;
    config->buffers = 2;
    config->subpixel_bits = 8;
    config->depth_bits = 16;
    config->depth = &zs_depth_float;
    config->fast = all;
}

void *sim_frame_arena(size_t bytes)
{
    void *const arena = sim_kept(bytes);
    if (arena == NULL) {
        (void)sim_refuse(NULL, 0, "out of memory: an arena of %zu bytes was needed", bytes);
        exit(SIM_REFUSED);
    }
    return memset(arena, 0xa5, bytes);
}

int sim_frame_render(struct sim_frame *frame, const struct zs_scene *scene,
                     const struct zs_camera *camera, const struct zs_config *config,
                     const char *what)
{
    return sim_frame_render_to(frame, scene, camera, config, what, NULL);
}

struct scene_and_camera {
    const struct zs_scene *scene;
    const struct zs_camera *camera;
};

static int draw_scene(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    const struct scene_and_camera *of = ctx;
    return zs_render(r, of->scene, of->camera, sink);
}

int sim_frame_render_to(struct sim_frame *frame, const struct zs_scene *scene, const struct zs_camera *camera,
                        const struct zs_config *config, const char *what, const struct zs_sink *to)
{
    struct scene_and_camera of = { scene, camera };
    const struct sim_drawing drawing = { draw_scene, &of, config->width, config->height, sim_frame_no_keys(config) };
    return sim_frame_render_by(frame, &drawing, config, what, to);
}

int sim_frame_render_by(struct sim_frame *frame, const struct sim_drawing *drawing, const struct zs_config *config,
                        const char *what, const struct zs_sink *to)
{
    memset(frame, 0, sizeof *frame);
    struct zs_renderer renderer;
    const uint32_t bytes = zs_arena_bytes(config);
    void *arena = sim_frame_arena(bytes);
    int err = zs_init(&renderer, config, arena, bytes);
    if (err == ZS_OK) {
        const size_t n = (size_t)drawing->width * drawing->height;
        frame->width = drawing->width;
        frame->height = drawing->height;
        frame->arena_bytes = bytes;
        frame->no_keys = drawing->no_keys;
        frame->rgb565 = sim_alloc(n, sizeof *frame->rgb565);
        frame->key = sim_alloc(n, sizeof *frame->key);
        struct receiver receiver = { .frame = frame, .what = what, .to = to };
        const struct zs_sink sink = { .submit = submit, .wait = wait, .end = end, .ctx = &receiver };
        err = drawing->draw(drawing->ctx, &renderer, &sink);
        frame->stats = *zs_frame_stats(&renderer);
        if (err == ZS_OK && (receiver.pending || receiver.next_y != frame->height || receiver.ends != 1))
            err = SIM_FRAME_BROKEN;
    }
    sim_kept_end(arena);
    if (what != NULL)
        sim_progress_end();
    if (err != ZS_OK)
        sim_frame_free(frame);
    return err;
}

void sim_frame_free(struct sim_frame *frame)
{
    SIM_FREE(frame->rgb565, frame->key);
    memset(frame, 0, sizeof *frame);
}

void sim_frame_cover(struct sim_frame *frame, const uint32_t *id)
{
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++)
        frame->key[i] = id[i] ? 0 : ZS_DEPTH_CLEAR;
}

uint32_t sim_frame_visible(const struct sim_frame *frame)
{
    uint32_t n = 0;
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++)
        n += frame->key[i] != ZS_DEPTH_CLEAR;
    return n;
}
