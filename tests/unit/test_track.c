/* zs_damage_track: what is not drawn is on the glass already. A glass that gets the changed columns alone shows, after
 * every frame that was not broken off, what a full redraw shows; every strip that is given out as changed is that of a
 * full redraw.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "clusters.h"
#include "fast_lists.h"
#include "picture.h"
#include "shapes.h"
#include "zs_blend.h"
#include "zs_damage.h"
#include "zs_method.h"

#define W_MAX 90
#define H_MAX 70
#define INSTANCES 9
#define SHAPES 5

/* ---- A world that changes ---------------------------------------------------------------------------- */

struct world {
    struct shape shape[SHAPES];
    struct zs_cluster cluster[SHAPES][SHAPE_TRIS];
    int16_t uv[SHAPE_VERTS][2];
    uint16_t texel[2][64], palette[16];
    struct zs_texture texture[2];
    struct zs_material material[INSTANCES];
    struct zs_depth_state state;
    struct zs_instance instance[INSTANCES];
    struct zs_scene scene;
    struct zs_camera camera;
    int calm; /* small things, and changes of some of them alone: most strips stay */
};

static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_texture,
                                                   &zs_shade_texture_flat, &zs_shade_texture_smooth };

static void place(struct prng *p, struct zs_instance *in, int calm)
{
    static const int32_t reach[] = { 300, 3000, 9000, 60000 };
    const int32_t far = reach[calm ? 1 : prng_pick(p, 16) ? prng_pick(p, 3) : 3];
    zs_pose_identity(&in->pose);
    zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    for (int k = 0; k < 3; k++)
        in->pose.pos[k] = prng_range(p, -far, far);
    in->pose.scale = ZS_Q16_ONE / (1u + prng_pick(p, 8) + (calm ? 8u : 0u)) + prng_pick(p, 9);
}

static void cover(struct prng *p, struct world *w, struct zs_material *m)
{
    m->shader = shaders[prng_pick(p, 6)];
    m->rgb.r = (uint8_t)prng_next(p);
    m->rgb.g = (uint8_t)prng_next(p);
    m->cull = (uint8_t)prng_pick(p, 3);
    m->texture = &w->texture[prng_pick(p, 2)];
}

static void look(struct prng *p, struct world *w, uint16_t h)
{
    const int32_t at[3] = { prng_range(p, -900, 900), prng_range(p, -900, 900), 0 };
    const int near = !w->calm && !prng_pick(p, 4); /* among the instances: they cross the near plane */
    if (w->camera.projection == ZS_PERSPECTIVE)
        (void)zs_camera_perspective(&w->camera, (zs_turn)(3000 + prng_pick(p, 12000)), h, near ? 20 : 400,
                                    prng_pick(p, 3) ? 60000 : 13000);
    else
        (void)zs_camera_orthographic(&w->camera, 2000 + prng_range(p, 0, 20000), near ? 11000 : 300, 30000);
    (void)zs_camera_orbit(&w->camera, at, near ? 2500 : 12000, (zs_turn)prng_next(p),
                          (int16_t)prng_range(p, -16000, 16000));
}

static void light(struct prng *p, struct world *w)
{
    const int32_t dir[3] = { prng_range(p, -9, 9), prng_range(p, -9, 9), 3 };
    (void)zs_unit(w->scene.light.dir, dir);
    w->scene.light.ambient = prng_pick(p, ZS_Q16_ONE);
    w->scene.light.diffuse = prng_pick(p, ZS_Q16_ONE);
}

static void texels(struct prng *p, struct world *w)
{
    for (uint32_t i = 0; i < 64; i++) {
        w->texel[0][i] = (uint16_t)prng_next(p);
        w->texel[1][i] = (uint16_t)(prng_next(p) & 0x0f0f); /* two numbers below 16 */
    }
    for (uint32_t i = 0; i < 16; i++)
        w->palette[i] = (uint16_t)prng_next(p);
}

static void world_open(struct prng *p, struct world *w, uint16_t h)
{
    static const struct zs_depth_state state = { .func = ZS_DEPTH_LESS };
    memset(w, 0, sizeof *w);
    w->calm = prng_pick(p, 2) != 0;
    shape_sphere(&w->shape[0], 4, 6, 900);
    shape_torus(&w->shape[1], 6, 5, 1200, 400);
    shape_soup(&w->shape[2], 20, 700, prng_next(p));
    shape_ground(&w->shape[3], 4, 5000, 300, prng_next(p));
    shape_sphere(&w->shape[4], 3, 4, 100);
    for (uint32_t v = 0; v < SHAPE_VERTS; v++)
        for (int k = 0; k < 2; k++)
            w->uv[v][k] = (int16_t)prng_next(p);
    for (uint32_t i = 0; i < SHAPES; i++) {
        w->shape[i].mesh.uv = (const int16_t (*)[2])w->uv;
        w->shape[i].mesh.uv_bits = 12;
        clusters_make(&w->shape[i].mesh, w->cluster[i], p, 6,
                      5); /* of them, what strips that are not due show is left out */
    }
    const struct zs_texture texture[2] = { { .format = &zs_texel_565, .texel = w->texel[0], .log2_w = 3, .log2_h = 3 },
                                           { .format = &zs_texel_pal8, .texel = w->texel[1], .palette = w->palette,
                                             .n_colors = 16, .log2_w = 3, .log2_h = 3, .clamp = ZS_CLAMP_U } };
    memcpy(w->texture, texture, sizeof texture);
    texels(p, w);
    w->state = state;
    for (uint32_t i = 0; i < INSTANCES; i++) {
        w->instance[i].mesh = &w->shape[prng_pick(p, SHAPES)].mesh;
        w->instance[i].material = &w->material[i];
        cover(p, w, &w->material[i]);
        place(p, &w->instance[i], w->calm);
        w->instance[i].depth_state = prng_pick(p, 4) ? NULL : &w->state;
    }
    w->scene.instance = w->instance;
    w->scene.n_instances = 1 + prng_pick(p, INSTANCES);
    w->scene.background = (uint16_t)prng_next(p);
    w->camera.projection = (uint8_t)prng_pick(p, 2);
    light(p, w);
    look(p, w, h);
}

/* One change. Return 1: of bytes behind pointers, which have to be told. */
static int change(struct prng *p, struct world *w, uint16_t h)
{
    struct zs_instance *in = &w->instance[prng_pick(p, w->scene.n_instances ? w->scene.n_instances : 1u)];
    struct zs_material *m = &w->material[in - w->instance];
    struct zs_texture *t = &w->texture[prng_pick(p, 2)];
    struct zs_mesh *mesh = &w->shape[prng_pick(p, SHAPES)].mesh;
    switch (w->calm && prng_pick(p, 12) ? 16 + prng_pick(p, 10) : prng_pick(p, 26)) {
    case 0: look(p, w, h); return 0;
    case 1: light(p, w); return 0;
    case 2: w->scene.background ^= (uint16_t)(1u << prng_pick(p, 16)); return 0;
    case 3: w->scene.n_instances = prng_pick(p, INSTANCES + 1u); return 0;
    case 4: { /* order */
        struct zs_instance *other = &w->instance[prng_pick(p, INSTANCES)];
        const struct zs_instance swap = *in;
        *in = *other;
        *other = swap;
        return 0;
    }
    case 5: in->mesh = &w->shape[prng_pick(p, SHAPES)].mesh; return 0;
    case 6: cover(p, w, m); return 0;
    case 7: m->rgb.b ^= 0x10; return 0;
    case 8: in->depth_state = in->depth_state ? NULL : &w->state; return 0;
    case 9: w->state.bias = (int16_t)prng_range(p, -2000, 2000); return 0;
    case 10: w->state.func ^= 1; return 0;
    case 11: t->clamp = (uint8_t)prng_pick(p, 4); return 0;
    case 12: t->log2_w = (uint8_t)(1 + prng_pick(p, 3)); return 0;
    case 13: mesh->scale = ZS_Q16_ONE / 2 + prng_pick(p, ZS_Q16_ONE); return 0;
    case 14: mesh->n_tris -= mesh->n_tris > 4; return 0;
    case 15: texels(p, w); return 1;
    case 16: /* a vertex, inside the sphere */
        mesh = &w->shape[mesh == &w->shape[2].mesh].mesh;
        ((int16_t (*)[3])(uintptr_t)mesh->pos)[prng_pick(p, 6)][prng_pick(p, 3)] /= 2;
        clusters_make(mesh, w->cluster[mesh == &w->shape[1].mesh], p, 6, 5);
        return 1;
    case 17: case 18: case 19: /* a little */
        in->pose.pos[prng_pick(p, 3)] += prng_range(p, -40, 40);
        return 0;
    default: place(p, in, w->calm); return 0;
    }
}

/* ---- The glass ----------------------------------------------------------------------------------------- */

struct glass {
    uint8_t px[H_MAX][W_MAX * 2];
    const struct picture *want;
    struct zs_strip out; /* submitted, not yet waited for */
    uint32_t calls, fail_at; /* submit and wait, from 1; 0: never */
    uint32_t sent, wrong;
    int columns; /* zs_damage_columns is on */
    uint32_t x, end; /* columns that arrived, since they were set to the frame's end and 0 */
};

/* A strip that is given out as changed: is it what a full redraw has there, keys and all? By columns: where it is
 * drawn, which is as far as a range can be widened to ZS_DAMAGE_GRAIN. */
static void judge(struct glass *g, const struct zs_strip *s)
{
    const uint32_t x = g->columns ? s->dirty_x & (0u - ZS_DAMAGE_GRAIN) : 0u;
    const uint32_t end = g->columns ? (s->dirty_x + s->dirty_w + ZS_DAMAGE_GRAIN - 1u) & (0u - ZS_DAMAGE_GRAIN) : s->w;
    for (uint32_t i = 0; i < (uint32_t)s->w * s->h; i++) {
        if (i % s->w < x || i % s->w >= end)
            continue;
        const uint32_t at = (uint32_t)s->y * s->w + i;
        g->wrong += (s->px[2 * i] << 8 | s->px[2 * i + 1]) != g->want->color[at] || s->depth[i] != g->want->key[at];
    }
}

static void arrive(struct glass *g, const struct zs_strip *s)
{
    for (uint32_t row = 0; row < s->h; row++)
        memcpy(&g->px[s->y + row][s->dirty_x * 2u], s->px + (row * s->w + s->dirty_x) * 2u, s->dirty_w * 2u);
    g->x = s->dirty_x < g->x ? s->dirty_x : g->x;
    g->end = (uint32_t)s->dirty_x + s->dirty_w > g->end ? (uint32_t)s->dirty_x + s->dirty_w : g->end;
    g->sent++;
}

static int submit(void *ctx, const struct zs_strip *s)
{
    struct glass *g = ctx;
    judge(g, s);
    g->wrong += s->dirty_w == 0;
    if (++g->calls == g->fail_at)
        return -777;
    g->out = *s;
    return 0;
}

static int wait(void *ctx)
{
    struct glass *g = ctx;
    if (++g->calls == g->fail_at) { /* junk arrived */
        memset(g->px[g->out.y], 0x5a, g->out.w);
        return -888;
    }
    arrive(g, &g->out);
    return 0;
}

struct show {
    struct zs_config config;
    struct zs_renderer r;
    void *arena;
    uint32_t *memory;
    uint64_t sum[H_MAX * 4];
    struct zs_strip_hashes sums;
    struct glass glass;
};

static void show_open(struct show *s, const struct zs_config *config)
{
    const uint32_t bytes = zs_arena_bytes(config), words = ZS_DAMAGE_WORDS(INSTANCES, config->height, config->strip_h);
    memset(s, 0, sizeof *s);
    memset(&s->r, 0xa5, sizeof s->r);
    s->config = *config;
    s->arena = malloc(bytes);
    s->memory = malloc(words * 4u); /* exactly: the sanitizer sees one too many */
    memset(s->arena, 0xcd, bytes);
    memset(s->memory, 0xab, words * 4u);
    memset(s->glass.px, 0xee, sizeof s->glass.px);
    assert_int_equal(zs_init(&s->r, config, s->arena, bytes), ZS_OK);
    assert_int_equal(zs_damage_track(&s->r, s->memory, INSTANCES), ZS_OK);
}

static void show_close(struct show *s)
{
    free(s->arena);
    free(s->memory);
}

static struct picture full(const struct show *s, const struct world *w)
{
    struct zs_config plain = s->config;
    plain.strip_h = plain.height;
    plain.max_tris = plain.max_verts = 4000;
    plain.fast = NULL;
    return picture_draw(&plain, &w->scene, &w->camera);
}

static int glass_shows(const struct glass *g, const struct picture *want)
{
    for (int32_t y = 0; y < want->h; y++)
        for (int32_t x = 0; x < want->w; x++)
            if ((g->px[y][2 * x] << 8 | g->px[y][2 * x + 1]) != want->color[y * want->w + x])
                return case_wrong("pixel %d, %d", (int)x, (int)y);
    return 1;
}

/* Something else draws on the glass, and is told. */
static void smear(struct prng *p, struct show *s)
{
    const struct zs_rect rect = { (uint16_t)prng_pick(p, s->config.width), (uint16_t)prng_pick(p, s->config.height),
                                  (uint16_t)(1 + prng_pick(p, 40)), (uint16_t)(1 + prng_pick(p, 40)) };
    for (uint32_t y = rect.y; y < s->config.height && y < (uint32_t)rect.y + rect.h; y++)
        for (uint32_t x = rect.x; x < s->config.width && x < (uint32_t)rect.x + rect.w; x++)
            s->glass.px[y][2 * x] ^= 0x55;
    assert_int_equal(zs_invalidate(&s->r, &rect), ZS_OK);
}

/* A frame by a loop of our own, which may break off, fail to send, or be disturbed. Return 1: the glass is right. */
static int own_loop(struct prng *p, struct show *s, const struct world *w, int trouble)
{
    const uint32_t strips = ZS_STRIPS(s->config.height, s->config.strip_h);
    const uint32_t stop = trouble ? prng_pick(p, 2u * strips) : UINT32_MAX;
    const uint32_t smeared = trouble && !prng_pick(p, 3) ? prng_pick(p, strips) : UINT32_MAX;
    uint32_t n = 0, skipped = 0;
    struct zs_strip out;
    int right = smeared == UINT32_MAX;
    assert_int_equal(zs_frame_begin(&s->r, &w->scene, &w->camera), ZS_OK);
    while (n < stop && zs_frame_strip(&s->r, &out) == 1) {
        skipped += out.dirty_w == 0;
        if (out.dirty_w) {
            judge(&s->glass, &out);
            if (trouble && !prng_pick(p, 8)) {
                const struct zs_rect rows = { 0, out.y, out.w, out.h };
                assert_int_equal(zs_invalidate(&s->r, &rows), ZS_OK); /* could not be sent */
                right = 0;
            } else {
                arrive(&s->glass, &out);
            }
        }
        if (n++ == smeared)
            smear(p, s);
    }
    const struct zs_stats *stats = zs_frame_stats(&s->r);
    assert_int_equal(stats->strips, n);
    assert_int_equal(stats->strips_clean, skipped);
    assert_true(stats->strips_skipped <= skipped && stats_add_up(stats));
    if (!trouble || prng_pick(p, 2)) /* or the next begin drops the frame */
        assert_int_equal(zs_frame_end(&s->r), ZS_OK);
    return right && n == strips;
}

static int a_frame(struct prng *p, struct show *s, struct world *w)
{
    struct glass *g = &s->glass;
    struct picture want = full(s, w);
    int right, trouble = !prng_pick(p, 4);
    g->want = &want;
    g->calls = g->fail_at = g->sent = 0;
    if (!want.err && prng_pick(p, 2)) {
        const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = g };
        g->fail_at = trouble ? 1u + prng_pick(p, 12) : 0u;
        const int err = zs_render(&s->r, &w->scene, &w->camera, &sink);
        CASE_CHECK(err == 0 || (g->fail_at && (err == -777 || err == -888)));
        right = !err;
    } else if (!want.err) {
        right = own_loop(p, s, w, trouble);
    } else {
        CASE_CHECK(zs_frame_begin(&s->r, &w->scene, &w->camera) == want.err);
        right = 0;
    }
    CASE_CHECK(g->wrong == 0);
    right = !right || glass_shows(g, &want);
    picture_free(&want);
    return right;
}

static int frames_of(uint64_t seed)
{
    static struct world w;
    static struct show s;
    static const struct zs_depth *const persp[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear };
    struct prng p = { seed };
    const uint16_t width = (uint16_t)(40 + prng_pick(&p, W_MAX - 39)),
                   height = (uint16_t)(30 + prng_pick(&p, H_MAX - 29));
    world_open(&p, &w, height);
    struct zs_config c = picture_config(width, height,
                                        w.camera.projection ? &zs_depth_linear : persp[prng_pick(&p, 3)]);
    c.strip_h = (uint16_t)(prng_pick(&p, 2) ? 1 + prng_pick(&p, 6) : 1 + prng_pick(&p, height));
    c.buffers = (uint8_t)(1 + prng_pick(&p, 2));
    c.max_tris = (uint16_t)(prng_pick(&p, 2) ? 600 : 2 + prng_pick(&p, 80));
    c.max_verts = (uint16_t)(prng_pick(&p, 2) ? 600 : 9 + prng_pick(&p, 80));
    c.subpixel_bits = prng_pick(&p, 4) ? 8 : 4;
    c.fast = prng_pick(&p, 4) ? fast_all : prng_pick(&p, 4) ? fast_any(&p) : NULL;
    show_open(&s, &c);
    int right = 1;
    for (int frame = 0; frame < 24 && right; frame++) {
        int told = 0;
        for (uint32_t n = prng_pick(&p, 4); n; n--)
            told |= change(&p, &w, height);
        if (told)
            assert_int_equal(zs_invalidate(&s.r, NULL), ZS_OK);
        if (!s.r.scene && !prng_pick(&p, 10))
            assert_int_equal(prng_pick(&p, 3) ? damage_compare_anew(&s.r, &s.sums, s.sum, 1 + prng_pick(&p, 4))
                                              : zs_damage_compare(&s.r, NULL),
                             ZS_OK);
        if (!s.r.scene && !prng_pick(&p, 20))
            s.glass.columns = zs_damage_track(&s.r, prng_pick(&p, 3) ? s.memory : NULL, INSTANCES); /* 0 */
        if (!s.r.scene && s.r.track && !prng_pick(&p, 5)) {
            s.glass.columns = prng_pick(&p, 4) != 0;
            assert_int_equal(zs_damage_columns(&s.r, s.glass.columns), ZS_OK);
        }
        if (!prng_pick(&p, 6))
            smear(&p, &s);
        if (!prng_pick(&p, 10)) { /* a frame that is refused leaves the glass as it is */
            struct zs_camera bad = w.camera;
            bad.focal = 2 * bad.focal + 1;
            bad.height = bad.height * 2;
            bad.z_far = prng_pick(&p, 2) ? bad.z_near : bad.z_far;
            struct zs_instance junk = { .mesh = &w.shape[0].mesh, .material = prng_pick(&p, 2) ? NULL : &w.material[0],
                                        .pose = w.instance[0].pose };
            junk.pose.rot[4] = 0;
            const struct zs_scene scene = { .instance = &junk, .n_instances = 1, .light = w.scene.light };
            assert_true(zs_frame_begin(&s.r, &scene, &bad) < 0);
        }
        if (w.scene.n_instances && !prng_pick(&p, 10)) { /* one that is like the last, but for an instance */
            const int32_t kept = w.instance[0].pose.rot[0];
            w.instance[0].pose.rot[0] = INT32_MIN;
            assert_true(zs_frame_begin(&s.r, &w.scene, &w.camera) < 0);
            w.instance[0].pose.rot[0] = kept;
            place(&p, &w.instance[0], w.calm);
        }
        right = a_frame(&p, &s, &w);
        if (!right)
            case_wrong("frame %d", frame);
    }
    show_close(&s);
    return right;
}

static void the_glass_is_right_whatever_happens(void **state)
{
    CASES(frames_of, 250); /* 6,000 frames */
}

/* ---- One change at a time ------------------------------------------------------------------------------ */

#define INPUTS 24
/* Change one thing that a frame is drawn from. */
static void change_input(struct world *w, uint32_t which)
{
    struct zs_instance *in = &w->instance[1];
    struct zs_camera *c = &w->camera;
    switch (which) {
    case 0: c->pos[0] += 700; break;
    case 1: c->pos[1] += 700; break;
    case 2: c->pos[2] += 700; break;
    case 3: c->focal += c->focal / 8; break;
    case 4: c->height += c->height / 8; break;
    case 5: c->z_near = (zs_q48_16)12000 * 65536; break;
    case 6: c->z_far = (zs_q48_16)12000 * 65536; break;
    case 7: for (int k = 0; k < 6; k++) c->rot[k] = -c->rot[k]; break; /* upside down */
    case 8: c->projection = !c->projection; break;
    case 9: w->scene.light.dir[0] /= 2; break;
    case 10: w->scene.light.ambient /= 2; break;
    case 11: w->scene.light.diffuse /= 2; break;
    case 12: w->scene.background ^= 1; break;
    case 13: w->scene.n_instances--; break;
    case 14: w->state.bias = 30000; break;
    case 15: w->state.func = 1; break;
    case 16: w->state.read_only = 1; break;
    case 17: w->state.slope_bias = 32000; break;
    case 18: w->shape[1].mesh.scale /= 2; break;
    case 19: w->shape[1].mesh.center[1] += 1; w->shape[1].mesh.n_tris /= 2; break;
    case 20: in->material = &w->material[3]; break;
    case 21: w->texture[0].log2_h = 1; break;
    case 22: zs_pose_turn(&in->pose, 5000, 0, 0); break;
    default: in->pose.scale /= 2; break;
    }
}

static uint32_t shown[INPUTS]; /* how often the picture differed */

static int one_input(uint64_t seed)
{
    static struct world w;
    static struct show s;
    struct prng p = { seed };
    const uint32_t which = (uint32_t)(seed % INPUTS);
    const int32_t at[3] = { 0, 0, 0 };
    const int flat = which == 4 || (which != 3 && which != 8 && (seed / INPUTS) % 2u);
    world_open(&p, &w, H_MAX);
    w.scene.n_instances = 4;
    for (uint32_t i = 0; i < 4; i++) { /* two overlap; all of one material, but for the last */
        w.instance[i].mesh = &w.shape[i & 1u].mesh;
        w.instance[i].material = &w.material[i == 3];
        w.instance[i].depth_state = i < 2 ? &w.state : NULL;
        place(&p, &w.instance[i], 1);
        w.instance[i].pose.scale = ZS_Q16_ONE;
    }
    w.instance[1].pose.pos[0] = w.instance[0].pose.pos[0];
    w.instance[1].pose.pos[1] = w.instance[0].pose.pos[1] + 200;
    w.instance[1].pose.pos[2] = w.instance[0].pose.pos[2];
    if (which == 15) /* the same twice: keys are equal */
        w.instance[1] = w.instance[0], w.instance[1].material = &w.material[1];
    w.material[0].shader = which == 21 ? &zs_shade_texture : &zs_shade_flat;
    w.material[0].texture = &w.texture[0];
    w.material[1].shader = &zs_shade_raw;
    w.material[0].cull = w.material[1].cull = ZS_CULL_NONE;
    (void)(flat ? zs_camera_orthographic(&w.camera, 12000, 1000, 60000)
                : zs_camera_perspective(&w.camera, 6000, H_MAX, 1000, 60000));
    w.camera.height = (zs_q48_16)12000 * 65536;
    w.camera.focal = w.camera.focal ? w.camera.focal : (zs_uq32_32)70 << 32;
    (void)zs_camera_orbit(&w.camera, at, 12000, (zs_turn)prng_next(&p), 3000);
    struct zs_config c = picture_config(W_MAX, H_MAX, &zs_depth_linear);
    c.strip_h = (uint16_t)(1 + prng_pick(&p, 4));
    show_open(&s, &c);
    struct picture want[2];
    for (int k = 0; k < 2; k++) {
        const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
        want[k] = full(&s, &w);
        s.glass.want = &want[k];
        CASE_CHECK(want[k].err == ZS_OK && zs_render(&s.r, &w.scene, &w.camera, &sink) == ZS_OK);
        if (s.glass.wrong || !glass_shows(&s.glass, &want[k]))
            return case_wrong("input %u, frame %d", (unsigned)which, k);
        if (!k)
            change_input(&w, which);
    }
    shown[which] += memcmp(want[0].color, want[1].color, W_MAX * H_MAX * 2u) != 0;
    PICTURES_FREE(&want[0], &want[1]);
    show_close(&s);
    return 1;
}

static void every_input_counts(void **state)
{
    CASES(one_input, 12 * INPUTS);
    for (uint32_t i = 0; i < INPUTS && cases_all(); i++)
        if (!shown[i])
            fail_msg("input %u never shows", (unsigned)i);
}

/* Two neighbours in the scene share a mesh, and each has a material of its own: a change of the second material, or of
 * its texture, shows. */
static void a_shared_mesh_hides_no_material(void **state)
{
    static struct world w;
    static struct show s;
    struct prng p = { 11 };
    world_open(&p, &w, H_MAX);
    const int32_t at[3] = { 0, 0, 0 };
    w.scene.n_instances = 2;
    w.shape[0].mesh.face_rgb = NULL; /* the material's colour */
    for (int i = 0; i < 2; i++) {
        w.instance[i].mesh = &w.shape[0].mesh;
        w.instance[i].depth_state = NULL;
        w.material[i] = (struct zs_material){ .shader = &zs_shade_flat, .rgb = { 200, 100, 50 },
                                              .cull = ZS_CULL_NONE };
        zs_pose_identity(&w.instance[i].pose);
        w.instance[i].pose.pos[0] = i ? 1500 : -1500;
    }
    w.scene.light = (struct zs_light){ .dir = { 0, 0, ZS_Q30_ONE }, .ambient = ZS_Q16_ONE };
    w.camera.projection = ZS_PERSPECTIVE;
    (void)zs_camera_perspective(&w.camera, 8000, H_MAX, 400, 60000);
    (void)zs_camera_orbit(&w.camera, at, 9000, 0, 0);
    struct zs_config c = picture_config(W_MAX, H_MAX, &zs_depth_float);
    c.strip_h = 5;
    show_open(&s, &c);
    for (int k = 0; k < 4; k++) {
        const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
        struct picture want = full(&s, &w);
        s.glass.want = &want;
        s.glass.sent = 0;
        assert_int_equal(zs_render(&s.r, &w.scene, &w.camera, &sink), ZS_OK);
        assert_true(want.covered > 200);
        assert_true(s.glass.wrong == 0 && glass_shows(&s.glass, &want));
        assert_true(s.glass.sent > 0);
        picture_free(&want);
        switch (k) {
        case 0: w.material[1].rgb.g = 240; break;
        case 1: w.material[1].shader = &zs_shade_texture; w.material[1].texture = &w.texture[0]; break;
        case 2: w.texture[0].log2_w = 1; break;
        default: break;
        }
    }
    show_close(&s);
}

/* A sphere alone, of strips of one row, wherever it can be: across near and far, at the frame's edge, far beside the
 * axis; and so far away that camera units become coarse for what stands near. */
static int one_sphere(uint64_t seed)
{
    static struct world w;
    static struct show s;
    struct prng p = { seed };
    const int distant = !(seed % 4u);
    memset(&w, 0, sizeof w);
    shape_sphere(&w.shape[0], 16, 20, 2000);
    w.material[0].shader = &zs_shade_raw;
    w.material[0].rgb.g = 255;
    w.material[0].cull = ZS_CULL_NONE;
    for (int i = 0; i < 2; i++) {
        w.instance[i].mesh = &w.shape[0].mesh;
        w.instance[i].material = &w.material[0];
        zs_pose_identity(&w.instance[i].pose);
    }
    w.instance[1].pose.pos[0] = 100;
    w.instance[1].pose.pos[2] = -1500;
    w.instance[1].pose.scale = ZS_Q16_ONE / 4;
    w.scene.instance = w.instance;
    w.scene.n_instances = distant ? 2 : 1;
    const int32_t eye[3] = { 0, 0, 0 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    if (distant || seed % 4u < 3)
        (void)zs_camera_perspective(&w.camera, distant ? 8000 : (zs_turn)(8000 + prng_pick(&p, 20000)), H_MAX, 300,
                                    distant ? ZS_WORLD_MAX : 9000);
    else
        (void)zs_camera_orthographic(&w.camera, 12000, 500, 9000);
    (void)zs_camera_look_along(&w.camera, eye, along, up);
    struct zs_config c = picture_config(W_MAX, H_MAX, w.camera.projection ? &zs_depth_linear : &zs_depth_float);
    c.strip_h = 1;
    show_open(&s, &c);
    s.glass.columns = (int)(seed / 4u % 2u);
    CASE_CHECK(zs_damage_columns(&s.r, s.glass.columns) == ZS_OK);
    for (int k = 0; k < 12; k++) {
        struct zs_pose *pose = &w.instance[0].pose;
        const int32_t z = distant ? prng_range(&p, 1000, 1 << 19) << prng_pick(&p, 10) : prng_range(&p, -1000, 10500);
        const int32_t wide = (distant ? z / 4 : 7000) + 1;
        pose->pos[0] = prng_range(&p, -wide, wide);
        pose->pos[1] = prng_range(&p, -wide, wide);
        pose->pos[2] = -z;
        pose->scale = ZS_Q16_ONE / (1u + prng_pick(&p, 4));
        const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
        struct picture want = full(&s, &w);
        s.glass.want = &want;
        CASE_CHECK(want.err == ZS_OK && zs_render(&s.r, &w.scene, &w.camera, &sink) == ZS_OK);
        if (s.glass.wrong || !glass_shows(&s.glass, &want))
            return case_wrong("frame %d, sphere at %d %d %d", k, (int)pose->pos[0], (int)pose->pos[1], (int)z);
        picture_free(&want);
    }
    show_close(&s);
    return 1;
}

static uint32_t dots; /* frames in which the sphere covers the pixel in the middle */

/* A focal length of a few thousandths of a pixel, and camera units as long as world units: a sphere of 700 is a few
 * sub-pixels, and its vertices are rounded one by one. One of them may come to lie a sub-pixel beyond all corners of
 * the octagon around the sphere: the pixel whose sample lies there is drawn. */
static int one_dot(uint64_t seed)
{
    static struct world w;
    static struct show s;
    struct prng p = { seed };
    memset(&w, 0, sizeof w);
    shape_sphere(&w.shape[0], 12, 16, 700);
    w.material[0] = (struct zs_material){ .shader = &zs_shade_raw, .rgb = { 0, 255, 0 }, .cull = ZS_CULL_NONE };
    for (int i = 0; i < 2; i++) {
        w.instance[i].mesh = &w.shape[0].mesh;
        w.instance[i].material = &w.material[0];
        zs_pose_identity(&w.instance[i].pose);
    }
    w.instance[1].pose.pos[2] = 4096 - ZS_WORLD_MAX;
    w.scene.instance = w.instance;
    w.scene.n_instances = 2;
    (void)zs_camera_perspective(&w.camera, 8000, 69, 256, ZS_WORLD_MAX);
    w.camera.focal = ((zs_uq32_32)1 << 32) / (200u + prng_pick(&p, 800));
    struct zs_config c = picture_config(89, 69, &zs_depth_float); /* odd: a sample lies in the middle */
    c.strip_h = 1;
    show_open(&s, &c);
    s.glass.columns = (int)(seed % 2u);
    CASE_CHECK(zs_damage_columns(&s.r, s.glass.columns) == ZS_OK);
    for (int k = 0; k < 8; k++) {
        struct zs_pose *pose = &w.instance[0].pose;
        pose->pos[0] = k % 2 ? prng_range(&p, -600, 600) : 10000000;
        pose->pos[1] = prng_range(&p, -600, 600);
        pose->pos[2] = -prng_range(&p, 970, 1010);
        zs_pose_turn(pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), 0);
        const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
        struct picture want = full(&s, &w);
        s.glass.want = &want;
        CASE_CHECK(want.err == ZS_OK && zs_render(&s.r, &w.scene, &w.camera, &sink) == ZS_OK);
        if (s.glass.wrong || !glass_shows(&s.glass, &want))
            return case_wrong("frame %d, sphere at %d %d %d", k, (int)pose->pos[0], (int)pose->pos[1],
                              (int)pose->pos[2]);
        dots += k % 2 && want.covered;
        picture_free(&want);
    }
    show_close(&s);
    return 1;
}

/* A row of 20 triangles of one depth, and two movers in two strips and other columns: a pool that is too small loses
 * none of them where only columns are drawn. Walks for both strips bin what walks for one do not. */
static int changed_columns(void *ctx, const struct zs_strip *s)
{
    uint16_t *const glass = ctx;
    for (uint32_t k = 0; k < (uint32_t)s->h * s->dirty_w; k++) {
        const uint32_t row = k / s->dirty_w, column = s->dirty_x + k % s->dirty_w;
        memcpy(&glass[(s->y + row) * 64u + column], s->px + 2u * (row * 64u + column), 2);
    }
    return 0;
}
static void ties_beside_the_columns(void **state)
{
    static int16_t pos[60][3];
    static uint16_t tri[20][3];
    static struct zs_rgb rgb[20];
    for (int i = 0; i < 20; i++) {
        const int16_t corner[3][3] = { { (int16_t)(3 * i - 30), 1, 0 }, { (int16_t)(3 * i - 27), 1, 0 },
                                       { (int16_t)(3 * i - 30), 7, 0 } };
        memcpy(pos[3 * i], corner, sizeof corner);
        for (int k = 0; k < 3; k++)
            tri[i][k] = (uint16_t)(3 * i + k);
        rgb[i] = (struct zs_rgb){ 255, (uint8_t)(12 * i), 128 };
    }
    static const int16_t corners[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
    static const uint16_t halves[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    const struct zs_mesh row = { .pos = (const int16_t (*)[3])pos, .tri = (const uint16_t (*)[3])tri, .n_verts = 60,
                                 .n_tris = 20, .radius = 40, .face_rgb = rgb };
    const struct zs_mesh square = { .pos = corners, .tri = halves, .n_verts = 4, .n_tris = 2, .radius = 2 };
    static const struct zs_blend glass = { .material = { .shader = &zs_blend_flat, .rgb = { 255, 255, 255 } },
                                           .alpha = 128 };
    static const struct zs_material solid = { .shader = &zs_shade_flat, .rgb = { 64, 255, 64 } };
    struct zs_camera camera;
    assert_int_equal(zs_camera_orthographic(&camera, 16, -10, 10), ZS_OK);
    for (uint32_t k = 0; k < 2 * 37; k++) {
        const int painter = k % 2 != 0;
        const struct zs_config c = { .width = 64, .height = 16, .strip_h = 8, .max_tris = (uint16_t)(4 + k / 2),
                                     .max_verts = 200, .depth = painter ? &zs_depth_none : &zs_depth_linear,
                                     .method = painter ? &zs_method_painter : &zs_method_transparent };
        struct zs_instance in[3] = { { .mesh = &row, .material = painter ? &solid : &glass.material },
                                     { .mesh = &square, .material = &solid, .pose.pos = { 20, 4, -5 } },
                                     { .mesh = &square, .material = &solid, .pose.pos = { -24, -4, -5 } } };
        const struct zs_scene scene = { .instance = in, .n_instances = 3 };
        static struct zs_renderer r;
        static uint32_t arena[8000], memory[200];
        static uint16_t ours[64 * 16], whole[64 * 16];
        const struct zs_sink panel = { .submit = changed_columns, .ctx = ours },
                             all = { .submit = changed_columns, .ctx = whole };
        assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
        assert_int_equal(zs_damage_track(&r, memory, 3), ZS_OK);
        assert_int_equal(zs_damage_columns(&r, 1), ZS_OK);
        assert_int_equal(zs_render(&r, &scene, &camera, &panel), ZS_OK);
        in[1].pose.pos[0] = 22;
        in[2].pose.pos[0] = -22;
        assert_int_equal(zs_render(&r, &scene, &camera, &panel), ZS_OK);
        assert_true(zs_frame_stats(&r)->pixels_written < 64 * 16 / 2); /* columns alone */
        assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
        assert_int_equal(zs_render(&r, &scene, &camera, &all), ZS_OK);
        if (memcmp(ours, whole, sizeof whole) != 0)
            fail_msg("%s, %u triangles: another picture than a full frame's", painter ? "painter" : "transparent",
                     c.max_tris);
    }
}

/* ---- What it saves ------------------------------------------------------------------------------------ */

static uint32_t binned[2][2]; /* triangles, of whole frames and of those with one mover, by strips and by columns */

/* Nothing but the strips of one small sphere, before and after; their number is that of its rows. By columns too: no
 * others than its own. */
static int one_mover(uint64_t seed)
{
    static struct world w;
    static struct show s;
    struct prng p = { seed };
    world_open(&p, &w, H_MAX);
    w.scene.n_instances = INSTANCES;
    w.camera.projection = (uint8_t)(seed & 1u);
    for (uint32_t i = 0; i < INSTANCES; i++) { /* within 10,000 of the middle */
        do
            place(&p, &w.instance[i], 0);
        while (abs(w.instance[i].pose.pos[0]) > 5000 || abs(w.instance[i].pose.pos[1]) > 5000 ||
               abs(w.instance[i].pose.pos[2]) > 5000);
        w.instance[i].depth_state = NULL;
        w.material[i].shader = &zs_shade_flat;
    }
    const int32_t at[3] = { 0, 0, 0 };
    if (w.camera.projection)
        (void)zs_camera_orthographic(&w.camera, 12000, 1000, 60000);
    else
        (void)zs_camera_perspective(&w.camera, 6000, H_MAX, 1000, 60000);
    (void)zs_camera_orbit(&w.camera, at, 22000, (zs_turn)prng_next(&p), 3000);
    struct zs_instance *mover = &w.instance[INSTANCES - 1];
    struct zs_material paint = { .shader = &zs_shade_raw, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_NONE };
    const struct zs_depth_state first = { .bias = -32768 }; /* before all others: its rows can be seen */
    mover->mesh = &w.shape[0].mesh;
    mover->material = &paint;
    mover->depth_state = &first;
    struct zs_config c = picture_config(W_MAX, H_MAX, w.camera.projection ? &zs_depth_linear : &zs_depth_float);
    c.strip_h = 2;
    c.max_tris = seed & 2u ? 30 : 4000;
    show_open(&s, &c);
    s.glass.columns = (int)(seed / 4u % 2u);
    CASE_CHECK(zs_damage_columns(&s.r, s.glass.columns) == ZS_OK);
    int32_t rows[2][2], columns[2] = { W_MAX, 0 };
    uint32_t passes = 0;
    for (int k = 0; k < 2; k++) {
        struct zs_scene lone = { .instance = mover, .n_instances = 1, .light = w.scene.light };
        for (int axis = 0; axis < 3; axis++)
            mover->pose.pos[axis] = prng_range(&p, -3000, 3000);
        mover->pose.scale = ZS_Q16_ONE / 2;
        struct picture alone = picture_draw(&s.config, &lone, &w.camera);
        rows[k][0] = H_MAX;
        rows[k][1] = 0;
        for (int32_t i = 0; i < W_MAX * H_MAX; i++)
            if (alone.key[i] != ZS_DEPTH_CLEAR) {
                rows[k][0] = rows[k][0] < i / W_MAX ? rows[k][0] : i / W_MAX;
                rows[k][1] = i / W_MAX;
                columns[0] = columns[0] < i % W_MAX ? columns[0] : i % W_MAX;
                columns[1] = columns[1] > i % W_MAX + 1 ? columns[1] : i % W_MAX + 1;
            }
        picture_free(&alone);
        struct picture want = full(&s, &w);
        const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
        s.glass.want = &want;
        s.glass.sent = s.glass.end = 0;
        s.glass.x = W_MAX;
        CASE_CHECK(zs_render(&s.r, &w.scene, &w.camera, &sink) == ZS_OK);
        CASE_CHECK(s.glass.wrong == 0 && glass_shows(&s.glass, &want));
        CASE_CHECK(k || s.glass.sent == H_MAX / 2);
        picture_free(&want);
        const struct zs_stats *stats = zs_frame_stats(&s.r);
        binned[s.glass.columns][k] += stats->max_tris_used;
        if (!k)
            passes = stats->passes;
    }
    uint32_t own = 0;
    for (int32_t y = 0; y < H_MAX; y += 2)
        own += (y + 1 >= rows[0][0] && y <= rows[0][1]) || (y + 1 >= rows[1][0] && y <= rows[1][1]);
    if (s.glass.sent < own || s.glass.sent > own + 6) /* a strip beside each end, and an octagon for a coarse sphere */
        return case_wrong("%u strips are drawn, the mover has %u", (unsigned)s.glass.sent, (unsigned)own);
    CASE_CHECK(zs_frame_stats(&s.r)->strips_skipped == H_MAX / 2 - s.glass.sent);
    const uint32_t slack = 4u + ZS_DAMAGE_GRAIN; /* an octagon for a coarse sphere */
    if (s.glass.columns && own &&
        (s.glass.x + slack < (uint32_t)columns[0] || s.glass.end > (uint32_t)columns[1] + slack))
        return case_wrong("columns %u to %u are drawn, the mover is in %u to %u", (unsigned)s.glass.x,
                          (unsigned)s.glass.end, (unsigned)columns[0], (unsigned)columns[1]);
    CASE_CHECK(s.glass.columns || !own || (s.glass.x == 0 && s.glass.end == W_MAX));
    CASE_CHECK(zs_frame_stats(&s.r)->passes <= passes);
    show_close(&s);
    return 1;
}

static void one_moving_thing_draws_its_own_strips(void **state)
{
    CASES(one_mover, 100);
    assert_true(!cases_all() || binned[0][1] + binned[1][1] < (binned[0][0] + binned[1][0]) * 3u / 4u);
    assert_true(!cases_all() || binned[1][1] < binned[1][0] * 5u / 8u);
}

static void a_still_scene_draws_nothing(void **state)
{
    static struct world w;
    static struct show s;
    struct prng p = { 3 };
    world_open(&p, &w, H_MAX);
    struct zs_config c = picture_config(W_MAX, H_MAX, w.camera.projection ? &zs_depth_linear : &zs_depth_float);
    c.strip_h = 7;
    c.max_tris = 20; /* several walks */
    show_open(&s, &c);
    struct picture want = full(&s, &w);
    const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
    s.glass.want = &want;
    for (int k = 0; k < 3; k++) {
        s.glass.sent = 0;
        assert_int_equal(zs_render(&s.r, &w.scene, &w.camera, &sink), ZS_OK);
        const struct zs_stats *stats = zs_frame_stats(&s.r);
        assert_int_equal(s.glass.sent, k ? 0 : 10);
        assert_int_equal(stats->strips_skipped, k ? 10 : 0);
        assert_int_equal(stats->passes != 0, !k);
        assert_int_equal(stats->verts_transformed != 0, !k);
    }
    /* one strip is wanted again: one strip is drawn, of what lies in it */
    const struct zs_rect row = { 5, 30, 1, 1 };
    const uint32_t all = want.stats.verts_transformed;
    assert_int_equal(zs_invalidate(&s.r, &row), ZS_OK);
    s.glass.sent = 0;
    assert_int_equal(zs_render(&s.r, &w.scene, &w.camera, &sink), ZS_OK);
    assert_int_equal(s.glass.sent, 1);
    assert_true(zs_frame_stats(&s.r)->verts_transformed <= all);
    assert_int_equal(s.glass.wrong, 0);
    picture_free(&want);
    show_close(&s);
}

/* Three spheres below each other; the highest and the lowest move, and the middle one's strips are wanted in the middle
 * of that frame: they are drawn with what stands there. */
static void invalidated_in_a_frame(void **state)
{
    static struct world w;
    static struct show s;
    memset(&w, 0, sizeof w);
    shape_sphere(&w.shape[0], 6, 8, 1000);
    w.material[0].shader = &zs_shade_raw;
    w.material[0].rgb.r = 255;
    for (int i = 0; i < 3; i++) {
        w.instance[i].mesh = &w.shape[0].mesh;
        w.instance[i].material = &w.material[0];
        zs_pose_identity(&w.instance[i].pose);
        w.instance[i].pose.pos[1] = 3000 * (1 - i);
    }
    w.scene.instance = w.instance;
    w.scene.n_instances = 3;
    const int32_t eye[3] = { 0, 0, 10000 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    (void)zs_camera_orthographic(&w.camera, 9000, 100, 20000);
    (void)zs_camera_look_at(&w.camera, eye, at, up);
    struct zs_config c = picture_config(W_MAX, 60, &zs_depth_linear);
    c.strip_h = 2;
    show_open(&s, &c);
    for (int k = 0; k < 2; k++) {
        struct picture want = full(&s, &w);
        struct zs_strip out;
        s.glass.want = &want;
        s.glass.sent = 0;
        assert_int_equal(zs_frame_begin(&s.r, &w.scene, &w.camera), ZS_OK);
        for (uint32_t n = 0; zs_frame_strip(&s.r, &out) == 1; n++) {
            if (out.dirty_w) {
                judge(&s.glass, &out);
                arrive(&s.glass, &out);
            }
            const struct zs_rect middle = { 0, 28, 4, 4 };
            if (k && n == 10)
                assert_int_equal(zs_invalidate(&s.r, &middle), ZS_OK);
        }
        assert_int_equal(zs_frame_end(&s.r), ZS_OK);
        assert_int_equal(s.glass.wrong, 0);
        assert_true(glass_shows(&s.glass, &want));
        assert_true(!k || s.glass.sent < 24); /* two spheres of 15 rows, and two strips */
        picture_free(&want);
        w.instance[0].pose.pos[0] += 500;
        w.instance[2].pose.pos[0] += 500;
    }
    show_close(&s);
}

static void wrong_calls_are_refused(void **state)
{
    static struct world w;
    static struct show s;
    struct prng p = { 5 };
    struct zs_renderer junk;
    memset(&junk, 0xa5, sizeof junk);
    junk.ready = 0;
    world_open(&p, &w, H_MAX);
    const struct zs_config c = picture_config(W_MAX, H_MAX, w.camera.projection ? &zs_depth_linear : &zs_depth_float);
    show_open(&s, &c);
    assert_int_equal(zs_damage_track(NULL, s.memory, 1), ZS_ERR_NULL);
    assert_int_equal(zs_damage_track(&junk, s.memory, 1), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_damage_track(&s.r, s.memory, 65536), ZS_ERR_SIZE);
    w.scene.n_instances = 3;
    assert_int_equal(zs_damage_track(&s.r, s.memory, 2), ZS_OK);
    assert_int_equal(zs_frame_begin(&s.r, &w.scene, &w.camera), ZS_ERR_SIZE);
    assert_int_equal(zs_damage_track(&s.r, s.memory, 3), ZS_OK);
    const struct zs_scene none = { .n_instances = 2, .light = w.scene.light };
    assert_int_equal(zs_frame_begin(&s.r, &none, &w.camera), ZS_ERR_NULL);
    assert_int_equal(zs_frame_begin(&s.r, &w.scene, &w.camera), ZS_OK);
    assert_int_equal(zs_damage_track(&s.r, NULL, 0), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_damage_columns(&s.r, 1), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_end(&s.r), ZS_OK);
    assert_int_equal(zs_damage_columns(&s.r, 1), ZS_OK);
    assert_int_equal(zs_damage_track(&s.r, NULL, 0), ZS_OK);
    assert_int_equal(zs_damage_columns(&s.r, 1), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_damage_columns(&junk, 1), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_damage_columns(NULL, 1), ZS_ERR_NULL);
    show_close(&s);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_glass_is_right_whatever_happens),
    cmocka_unit_test(every_input_counts),
    cmocka_unit_test(a_shared_mesh_hides_no_material),
    CASES_TEST(a_sphere_wherever_it_is, one_sphere, 200),
    CASES_COUNT(a_vertex_rounded_beyond_its_sphere_is_drawn, one_dot, 150, &dots, 50, "frames with a dot"),
    cmocka_unit_test(ties_beside_the_columns),
    cmocka_unit_test(one_moving_thing_draws_its_own_strips),
    cmocka_unit_test(a_still_scene_draws_nothing),
    cmocka_unit_test(invalidated_in_a_frame),
    cmocka_unit_test(wrong_calls_are_refused),
};
CASES_MAIN(tests)
