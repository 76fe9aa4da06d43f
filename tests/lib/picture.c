/* Whole frames through the public interface: see picture.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fast_lists.h"
#include "kept.h"
#include "strip_sum.h"
#include "wrong.h"

struct zs_config picture_config(int32_t w, int32_t h, const struct zs_depth *depth)
{
    const struct zs_config c = { .width = (uint16_t)w, .height = (uint16_t)h, .strip_h = (uint16_t)h, .max_tris = 4000,
                                 .max_verts = 4000, .varyings = ZS_VARYINGS_SMOOTH, .buffers = 1, .subpixel_bits = 8,
                                 .depth_bits = 16, .depth = depth, .fast = fast_all };
    return c;
}

void picture_any_way(struct prng *p, struct zs_config *c, int32_t tris, int32_t verts)
{
    c->strip_h = (uint16_t)prng_range(p, 1, c->height);
    if (prng_pick(p, 4)) {
        c->max_tris = (uint16_t)prng_range(p, tris, prng_pick(p, 2) ? 3 * tris : 60);
        c->max_verts = (uint16_t)prng_range(p, verts, prng_pick(p, 2) ? 12 : 120);
    }
    c->buffers = (uint8_t)(1 + prng_pick(p, 2));
    c->fast = fast_any(p);
}

int damage_compare_anew(struct zs_renderer *r, struct zs_strip_hashes *sums, uint64_t *memory, uint32_t columns)
{
    const int err = zs_strip_hashes_init(sums, memory, r->config.width, r->config.height, r->config.strip_h, columns);
    return err ? err : zs_damage_compare(r, sums);
}

struct copy {
    struct picture *to;
    int32_t rows;    /* arrived */
    int busy;        /* strips lent and not waited for */
    int ends;        /* calls of end */
    uint32_t before; /* checksum of a lent strip */
    struct zs_strip lent;
};

static int copy_submit(void *ctx, const struct zs_strip *s)
{
    struct copy *c = ctx;
    struct picture *p = c->to;
    if (c->busy || s->y != c->rows || s->x != 0 || s->w != p->w || s->y + s->h > p->h ||
        s->n_bytes != (uint32_t)s->w * s->h * 2u)
        return -1000;
    const int32_t n = s->w * s->h, first = s->y * p->w;
    for (int32_t i = 0; i < n; i++)
        p->color[first + i] = (uint16_t)(s->px[2 * i] << 8 | s->px[2 * i + 1]);
    for (int32_t i = 0; s->depth && i < n; i++)
        p->covered += s->depth[i] != ZS_DEPTH_CLEAR;
    if (s->depth)
        memcpy(p->key + first, s->depth, (size_t)n * sizeof *s->depth);
    c->rows += s->h;
    c->busy = 1;
    c->before = sim_strip_sum(s);
    c->lent = *s;
    return 0;
}

static int copy_wait(void *ctx)
{
    struct copy *c = ctx;
    if (!c->busy || sim_strip_sum(&c->lent) != c->before)
        return -1001; /* somebody drew into a strip that was lent */
    c->busy = 0;
    return 0;
}

static int copy_end(void *ctx)
{
    struct copy *c = ctx;
    c->ends++;
    return c->busy ? -1003 : 0;
}

/* An arena of exactly that many bytes of junk. */
static uint8_t *junk(uint32_t bytes)
{
    const uint32_t period = 4099;
    uint8_t *arena = sim_kept(bytes ? bytes : 4);
    if (!arena)
        abort();
    for (uint32_t i = 0; i < bytes && i < period; i++)
        arena[i] = (uint8_t)(i * 2654435761u >> 13);
    for (uint32_t done = period; done < bytes; done *= 2)
        memcpy(arena + done, arena, done < bytes - done ? done : bytes - done);
    return arena;
}

/* px zeros; of very many, those that are not looked at take no page */
#define KEPT_MOST ((size_t)1 << 27)
static uint16_t *blank(size_t px)
{
    const size_t bytes = 2 * (px ? px : 1);
    uint16_t *to = bytes > KEPT_MOST ? calloc(bytes, 1) : sim_kept(bytes);
    if (!to)
        abort();
    return bytes > KEPT_MOST ? to : memset(to, 0, bytes);
}

static struct picture drawn(const struct zs_config *config, const struct zs_pass *pass, uint32_t n)
{
    struct picture p = { .w = config->width, .h = config->height };
    const uint32_t bytes = zs_arena_bytes(config);
    uint8_t *arena = junk(bytes);
    struct zs_renderer *r = malloc(sizeof *r);
    const size_t px = (size_t)p.w * (size_t)p.h;
    p.color = blank(px);
    p.key = blank(px);
    if (!r)
        abort();
    memset(r, 0xa5, sizeof *r);
    p.err = zs_init(r, config, arena, bytes);
    if (!p.err) {
        struct copy c = { .to = &p };
        const struct zs_sink sink = { .submit = copy_submit, .wait = copy_wait, .end = copy_end, .ctx = &c };
        struct zs_pass_memory *memory = malloc((n ? n : 1u) * sizeof *memory);
        if (!memory)
            abort();
        memset(memory, 0xa5, (n ? n : 1u) * sizeof *memory);
        p.err = n ? zs_render_passes(r, pass, memory, n, &sink) : zs_render(r, pass->scene, pass->camera, &sink);
        if (!p.err && (c.rows != p.h || c.busy || c.ends != 1))
            p.err = -1002;
        p.stats = *zs_frame_stats(r);
        free(memory);
    }
    free(r);
    sim_kept_end(arena);
    return p;
}

struct picture picture_draw(const struct zs_config *config, const struct zs_scene *scene,
                            const struct zs_camera *camera)
{
    const struct zs_pass pass = { .scene = scene, .camera = camera };
    return drawn(config, &pass, 0);
}

struct picture picture_passes(const struct zs_config *config, const struct zs_pass *pass, uint32_t n)
{
    return drawn(config, pass, n);
}

void picture_free(struct picture *p)
{
    sim_kept_end(p->color);
    sim_kept_end(p->key);
    p->color = p->key = NULL;
}

void pictures_free(struct picture *const *p)
{
    while (*p)
        picture_free(*p++);
}

int picture_same(const struct picture *a, const struct picture *b, const char *name)
{
    if (a->err || b->err || a->w != b->w || a->h != b->h) {
        fprintf(stderr, "wrong: %s: errors %d and %d, %dx%d and %dx%d\n", name, a->err, b->err,
                a->w, a->h, b->w, b->h);
        return 0;
    }
    size_t n = (size_t)a->w * (size_t)a->h;
    if (!memcmp(a->color, b->color, n * sizeof *a->color) && !memcmp(a->key, b->key, n * sizeof *a->key))
        return 1;
    for (int32_t i = 0; i < a->w * a->h; i++)
        if (a->color[i] != b->color[i] || a->key[i] != b->key[i]) {
            fprintf(stderr, "wrong: %s: (%d, %d) is colour %04x key %u, and %04x %u\n", name,
                    i % a->w, i / a->w, a->color[i], a->key[i], b->color[i], b->key[i]);
            return 0;
        }
    return 1;
}

static int freed(struct picture *want, struct picture *is, int alike)
{
    picture_free(want);
    picture_free(is);
    return alike;
}

int picture_drawn_alike(struct picture *want, struct picture *is, const char *name)
{
    return freed(want, is, picture_same(want, is, name));
}

int picture_alike(struct picture *want, struct picture *is, const char *name)
{
    return freed(want, is, (want->err && want->err == is->err) || picture_same(want, is, name));
}

int picture_again(const struct picture *want, const struct zs_config *config, const struct zs_scene *scene,
                  const struct zs_camera *camera, const char *name)
{
    struct picture is = picture_draw(config, scene, camera);
    const int same = picture_same(want, &is, name);
    picture_free(&is);
    return same;
}

int picture_error(const struct zs_config *config, const struct zs_scene *scene, const struct zs_camera *camera)
{
    struct picture is = picture_draw(config, scene, camera);
    picture_free(&is);
    return is.err;
}

int picture_shows(const struct picture *p, uint32_t pixels)
{
    return (!p->err && p->covered > pixels) || wrong_said("", "error %d, %u pixels", p->err, p->covered);
}

int stats_add_up(const struct zs_stats *s)
{
    return s->tris_in == s->tris_drawn + s->tris_frustum + s->tris_cluster + s->tris_near + s->tris_far +
                             s->tris_offscreen + s->tris_facing + s->tris_zero + s->tris_empty +
                             s->tris_index;
}

struct zs_config lone_config(int32_t w, int32_t h, const struct zs_depth *depth)
{
    struct zs_config c = picture_config(w, h, depth);
    c.max_tris = 16;
    c.max_verts = 40;
    return c;
}

void lone_set(struct lone *l, const int16_t (*pos)[3], int n, zs_uq16_16 scale)
{
    static const uint16_t raw[7] = { 1, 2, 3, 4, 5, 6, 7 };
    memset(l, 0, sizeof *l);
    for (int v = 0; v < n; v++)
        memcpy(l->pos[v], pos[v], sizeof l->pos[v]);
    for (int t = 0; t + 2 < n; t++) {
        l->tri[t][0] = 0;
        l->tri[t][1] = (uint16_t)(t + 1);
        l->tri[t][2] = (uint16_t)(t + 2);
    }
    l->mesh.pos = (const int16_t (*)[3])l->pos;
    l->mesh.tri = (const uint16_t (*)[3])l->tri;
    l->mesh.face_raw = raw;
    l->mesh.n_verts = (uint32_t)n;
    l->mesh.n_tris = (uint32_t)(n - 2);
    l->mesh.scale = scale;
    l->mesh.radius = 57000; /* more than sqrt(3) * 32768 */
    l->material.shader = &zs_shade_raw;
    l->material.cull = ZS_CULL_NONE;
    l->instance.mesh = &l->mesh;
    l->instance.material = &l->material;
    zs_pose_identity(&l->instance.pose);
    l->scene.instance = &l->instance;
    l->scene.n_instances = 1;
}

struct zs_camera pixel_camera(int32_t height_px, int perspective)
{
    struct zs_camera c;
    int err;
    if (perspective) {
        err = zs_camera_perspective(&c, 8192, (uint16_t)height_px, PIXEL_Z / 2, 2 * PIXEL_Z);
        c.focal = (zs_uq32_32)(PIXEL_Z / 256) << 32;
    } else {
        err = zs_camera_orthographic(&c, height_px * 256, 1, 2 * PIXEL_Z);
    }
    if (err)
        abort();
    return c;
}
