/* Supersampling: pixels are averages of samples, whatever strips, buffers and damage tracking are; coverage on the grid
 * of samples is the oracle's; four samples are nearer to the truth than one.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "../lab/fuzz/world.h"
#include "oracle.h"
#include "picture.h"
#include "zs_supersample.h"

/* ---- A panel, and what it should show ---------------------------------------------------------- */

#define PANEL_MAX 256

/* A panel that is sent to in the background: a strip is read when it is waited for. */
struct glass {
    uint8_t px[PANEL_MAX][PANEL_MAX][2];
    struct zs_strip lent;
    int busy, ends, later; /* later: 1: `wait` is called */
    int fails;             /* what submit returns; 0: it does not fail */
    uint32_t sent;         /* px */
    int32_t w, h;
};

static int glass_take(struct glass *g)
{
    const struct zs_strip *s = &g->lent;
    for (uint32_t y = 0; y < s->h; y++)
        memcpy(g->px[s->y + y][s->dirty_x], s->px + 2u * (y * s->w + s->dirty_x), 2u * s->dirty_w);
    g->sent += (uint32_t)s->dirty_w * s->h;
    g->busy = 0;
    return 0;
}

static int glass_submit(void *ctx, const struct zs_strip *s)
{
    struct glass *g = ctx;
    if (g->fails)
        return g->fails;
    if (g->busy || s->x || s->w != g->w || s->y + s->h > g->h || s->n_bytes != 2u * s->w * s->h || s->depth ||
        !s->dirty_w || s->dirty_x + s->dirty_w > s->w)
        return -1000;
    g->lent = *s;
    g->busy = 1;
    return g->later ? 0 : glass_take(g);
}

static int glass_wait(void *ctx)
{
    struct glass *g = ctx;
    return g->busy ? glass_take(g) : -1001;
}

static int glass_end(void *ctx)
{
    ((struct glass *)ctx)->ends++;
    return 0;
}

static struct zs_sink glass_sink(struct glass *g, int later)
{
    const struct zs_sink sink = {
        .submit = glass_submit, .wait = later ? glass_wait : NULL, .end = glass_end, .ctx = g
    };
    g->later = later;
    return sink;
}

/* The average of a channel, halves up, by the definition. */
static uint32_t mean(const uint16_t *above, const uint16_t *below, int shift, uint32_t most)
{
    const uint32_t sum = (above[0] >> shift & most) + (above[1] >> shift & most) + (below[0] >> shift & most) +
                         (below[1] >> shift & most);
    return (uint32_t)floor(sum / 4.0 + 0.5);
}

static uint16_t mean565(const uint16_t *samples, int32_t w, int32_t x, int32_t y)
{
    const uint16_t *above = samples + 2 * y * w + 2 * x, *below = above + w;
    return (uint16_t)(mean(above, below, 11, 31) << 11 | mean(above, below, 5, 63) << 5 | mean(above, below, 0, 31));
}

static uint16_t shown(const struct glass *g, int32_t x, int32_t y)
{
    return (uint16_t)(g->px[y][x][0] << 8 | g->px[y][x][1]);
}

/* 1: the panel shows the averages of a frame of samples. */
static int shows(const struct glass *g, const struct picture *samples)
{
    for (int32_t y = 0; y < g->h; y++)
        for (int32_t x = 0; x < g->w; x++) {
            const uint16_t want = mean565(samples->color, samples->w, x, y);
            if (shown(g, x, y) != want)
                return case_wrong("(%d, %d) is %04x, not %04x", x, y, shown(g, x, y), want);
        }
    return 1;
}

static struct glass glass;

/* A panel of w x h px on which nothing has arrived. */
static void glass_clear(int32_t w, int32_t h)
{
    memset(&glass, 0, sizeof glass);
    glass.w = w;
    glass.h = h;
}

/* A renderer over memory of its own. */
static int renderer_make(struct zs_renderer *r, const struct zs_config *c, void **arena)
{
    *arena = malloc(zs_arena_bytes(c));
    return *arena ? zs_init(r, c, *arena, zs_arena_bytes(c)) : -1;
}

/* Draw with four samples a pixel onto the glass, of a quarter of the size. */
static int show(const struct zs_config *c, const struct zs_scene *scene, const struct zs_camera *camera, int late)
{
    struct zs_renderer r;
    struct zs_supersample s;
    void *arena;
    glass_clear(c->width / 2, c->height / 2);
    const struct zs_sink sink = glass_sink(&glass, late);
    int err = renderer_make(&r, c, &arena);
    err = err ? err : zs_supersample_init(&s, &r, &sink);
    err = err ? err : zs_render(&r, scene, camera, &s.sink);
    free(arena);
    return err;
}

/* ---- Averages ---------------------------------------------------------------------------------- */

/* Sky: random samples, or one colour for all four of a pixel, that differs from pixel to pixel. */
static void random_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    for (uint32_t k = 0; k < n; k++) {
        struct prng p = { *(uint64_t *)ctx + (uint64_t)y * 8192u + x + k };
        out[k] = (uint16_t)prng_next(&p);
    }
}

static void level_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    for (uint32_t k = 0; k < n; k++)
        out[k] = (uint16_t)(y / 2u * 256u + (x + k) / 2u);
}

static int average_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_background sky = { .fill = random_fill, .ctx = &seed };
    const struct zs_scene scene = { .sky = &sky };
    struct zs_config c = {
        .width = (uint16_t)(2 * prng_range(&p, 1, 60)), .height = (uint16_t)(2 * prng_range(&p, 1, 40)), .max_tris = 1,
        .max_verts = 3, .depth = &zs_depth_linear, .buffers = (uint8_t)(1 + prng_pick(&p, 2))
    };
    c.strip_h = (uint16_t)(2 * prng_range(&p, 1, c.height / 2));
    if (!prng_pick(&p, 8)) { /* each colour, four times */
        c.width = c.height = 512;
        sky.fill = level_fill;
    }
    const struct zs_camera camera = pixel_camera(c.height, 0);
    const int err = show(&c, &scene, &camera, (int)prng_pick(&p, 2));
    struct picture samples = picture_draw(&c, &scene, &camera);
    CASE_CHECK(!err && !samples.err && glass.ends == 1 && glass.sent == (uint32_t)(glass.w * glass.h));
    int right = shows(&glass, &samples);
    for (int32_t k = 0; sky.fill == level_fill && k < 65536; k++) {
        uint16_t wire = (uint16_t)k;
        const uint8_t *bytes = (const uint8_t *)&wire;
        right &= !memcmp(glass.px[k / 256][k % 256], bytes, 2);
    }
    picture_free(&samples);
    return right || case_wrong("%d x %d", c.width, c.height);
}

/* ---- Any scene, any way ------------------------------------------------------------------------ */

static int world_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static const struct zs_depth *const depths[4] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_float,
                                                      &zs_depth_none };
    world_make(&w, &p, 0);
    struct zs_config c = { .width = (uint16_t)(2 * prng_range(&p, 1, 45)),
                           .height = (uint16_t)(2 * prng_range(&p, 1, 35)),
                           .max_tris = 4000,
                           .max_verts = 8000,
                           .varyings = ZS_VARYINGS_MAX,
                           .depth = w.camera.projection == ZS_PERSPECTIVE ? depths[prng_pick(&p, 4)]
                                                                          : &zs_depth_linear };
    c.strip_h = c.height;
    struct picture samples = picture_draw(&c, &w.scene, &w.camera);
    picture_any_way(&p, &c, 2, 6);
    c.strip_h = (uint16_t)((c.strip_h + 1) & ~1);
    const int err = show(&c, &w.scene, &w.camera, (int)prng_pick(&p, 2));
    const int right = err == samples.err && (err || shows(&glass, &samples));
    picture_free(&samples);
    world_free(&w);
    return right || case_wrong("errors %d and %d", err, samples.err);
}

/* ---- Coverage ---------------------------------------------------------------------------------- */

static unsigned parts;

/* A white triangle on black: a pixel's level is the oracle's count of its four samples. */
static int coverage_case(uint64_t seed)
{
    struct prng p = { seed };
    const int32_t w = 24, h = 20, reach = prng_pick(&p, 2) ? 2000 : 9000;
    static struct lone l;
    static const uint16_t white[1] = { 0xffff };
    struct oracle_tri t;
    int16_t pos[3][3];
    for (int k = 0; k < 3; k++) {
        const int coarse = prng_pick(&p, 3) == 0;
        for (int a = 0; a < 2; a++) {
            pos[k][a] = (int16_t)prng_range(&p, -reach, reach);
            if (coarse)
                pos[k][a] = (int16_t)(pos[k][a] / 128 * 128); /* on samples and between them */
        }
        pos[k][2] = -1000;
        t.x[k] = 2 * w * 128 + pos[k][0];
        t.y[k] = 2 * h * 128 - pos[k][1];
    }
    lone_set(&l, (const int16_t(*)[3])pos, 3, ZS_Q16_ONE);
    l.mesh.face_raw = white;
    struct zs_config c = lone_config(2 * w, 2 * h, &zs_depth_linear);
    c.strip_h = (uint16_t)(2 * prng_range(&p, 1, h));
    const struct zs_camera camera = pixel_camera(2 * h, 0);
    struct zs_renderer r;
    struct zs_supersample s;
    void *arena;
    glass_clear(w, h);
    const struct zs_sink sink = glass_sink(&glass, 0);
    int err = renderer_make(&r, &c, &arena);
    err = err ? err : zs_supersample_init(&s, &r, &sink);
    err = err ? err : zs_render(&r, &l.scene, &camera, &s.sink);
    free(arena);
    CASE_CHECK(!err);
    for (int32_t y = 0; y < h; y++)
        for (int32_t x = 0; x < w; x++) {
            uint32_t n = 0;
            for (int k = 0; k < 4; k++)
                n += (uint32_t)(oracle_area(&t) != 0 && oracle_covers(&t, 2 * x + k % 2, 2 * y + k / 2));
            parts += n % 4u != 0;
            const uint16_t want = (uint16_t)((31u * n + 2u) / 4u << 11 | (63u * n + 2u) / 4u << 5 |
                                             (31u * n + 2u) / 4u);
            if (shown(&glass, x, y) != want)
                return case_wrong("(%d, %d): %04x, %u samples", x, y, shown(&glass, x, y), n);
        }
    return 1;
}

/* ---- Nearer to the truth ----------------------------------------------------------------------- */

static double channel(uint16_t c, int k)
{
    return k == 0 ? (c >> 11) / 31.0 : k == 1 ? (c >> 5 & 63) / 63.0 : (c & 31) / 31.0;
}

/* Root of the mean square difference of a frame from the average of 16 x 16 samples a pixel. */
static double rms(const struct picture *many, int32_t w, int32_t h, uint16_t at(int32_t, int32_t))
{
    double sum = 0;
    for (int32_t y = 0; y < h; y++)
        for (int32_t x = 0; x < w; x++)
            for (int k = 0; k < 3; k++) {
                double exact = 0;
                for (int32_t i = 0; i < 256; i++)
                    exact += channel(many->color[(16 * y + i / 16) * many->w + 16 * x + i % 16], k);
                const double d = exact / 256 - channel(at(x, y), k);
                sum += d * d;
            }
    return sqrt(sum / (3.0 * w * h));
}

static struct picture once;
static uint16_t once_at(int32_t x, int32_t y)
{
    return once.color[y * once.w + x];
}

static uint16_t glass_at(int32_t x, int32_t y)
{
    return shown(&glass, x, y);
}

#define FAN 60

static void four_samples_are_nearer(void **state)
{
    static const char *const names[3] = { "bars", "ball", "grass" };
    static int16_t pos[3 * FAN][3];
    static uint16_t tri[FAN][3], raw[FAN];
    const int32_t w = 64, h = 48;
    (void)state;
    for (int scene_of = 0; scene_of < 3; scene_of++) {
        struct prng p = { (uint64_t)scene_of + 9 };
        for (int t = 0; t < FAN; t++) {
            const double a = 2 * M_PI * t / FAN, b = 2 * M_PI * (t + 1) / FAN;
            for (int k = 0; k < 3; k++) {
                double x = k == 0 ? 0 : 30 * cos(k == 1 ? a : b), y = k == 0 ? 0 : 22 * sin(k == 1 ? a : b);
                if (scene_of == 0 && k == 2) /* nearly upright and nearly level bars */
                    x = 30 * cos(a + 0.05), y = 22 * sin(a + 0.05);
                if (scene_of == 2)
                    x = t - 30 + k * 0.4, y = k == 1 ? prng_range(&p, 0, 22) : -22;
                pos[3 * t + k][0] = (int16_t)lround(256 * x);
                pos[3 * t + k][1] = (int16_t)lround(256 * y);
                pos[3 * t + k][2] = -1000;
                tri[t][k] = (uint16_t)(3 * t + k);
            }
            raw[t] = (uint16_t)(scene_of == 0 ? 0xffff : 0x3186 + 0x0841 * (t % 20));
        }
        const struct zs_mesh mesh = {
            .pos = pos, .tri = tri, .face_raw = raw, .n_verts = 3 * FAN, .n_tris = FAN, .radius = 65535
        };
        const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
        const struct zs_instance instance = { .mesh = &mesh, .material = &material };
        const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = 0x0010 };
        const struct zs_camera camera = pixel_camera(h, 0);
        struct zs_config c = picture_config(16 * w, 16 * h, &zs_depth_linear);
        struct picture many = picture_draw(&c, &scene, &camera);
        c = picture_config(w, h, &zs_depth_linear);
        once = picture_draw(&c, &scene, &camera);
        c = picture_config(2 * w, 2 * h, &zs_depth_linear);
        struct zs_renderer r;
        struct zs_supersample s;
        void *arena;
        glass_clear(w, h);
        const struct zs_sink sink = glass_sink(&glass, 0);
        assert_int_equal(renderer_make(&r, &c, &arena), ZS_OK);
        assert_int_equal(zs_supersample_init(&s, &r, &sink), ZS_OK);
        assert_int_equal(zs_render(&r, &scene, &camera, &s.sink), ZS_OK);
        assert_true(!many.err && !once.err);
        const double one = rms(&many, w, h, once_at), four = rms(&many, w, h, glass_at);
        printf("  RMS from 256 samples, %s: %.4f with one sample, %.4f with four\n", names[scene_of], one, four);
        assert_true(four < 0.6 * one);
        free(arena);
        PICTURES_FREE(&many, &once);
    }
}

/* ---- Damage ------------------------------------------------------------------------------------ */

static struct zs_rect mark; /* px of the panel */
static uint16_t mark_color;
static int32_t marks;

static void mark_draw(void *ctx, const struct zs_target *t)
{
    (void)ctx;
    marks += t->depth != NULL;
    for (uint32_t y = t->y0; y < t->y1; y++)
        for (uint32_t x = t->x0; x < t->x1; x++)
            if (y - mark.y < mark.h && x - mark.x < mark.w)
                t->color[(y - t->y0) * t->pitch + x] = mark_color;
}

static unsigned saved;

/* Frames in which things and a hook's drawing change: the panel shows what it would if all were drawn and sent. */
static int damage_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static uint32_t track[ZS_DAMAGE_WORDS(WORLD_INSTANCES, 70, 2)];
    static uint64_t sums[70 * 90];
    struct zs_strip_hashes hashes;
    world_make(&w, &p, 0);
    w.scene.n_resolves = 0;
    for (; !w.trusted; world_make(&w, &p, 0))
        world_free(&w);
    w.scene.n_resolves = 0;
    struct zs_config c = {
        .width = (uint16_t)(2 * prng_range(&p, 1, 45)), .height = (uint16_t)(2 * prng_range(&p, 1, 35)),
        .max_tris = 4000, .max_verts = 8000, .varyings = ZS_VARYINGS_MAX,
        .depth = w.camera.projection == ZS_PERSPECTIVE ? &zs_depth_float : &zs_depth_linear
    };
    struct zs_config whole = c;
    whole.strip_h = c.height;
    picture_any_way(&p, &c, 2, 6);
    c.strip_h = (uint16_t)((c.strip_h + 1) & ~1);
    const int32_t width = c.width / 2, height = c.height / 2;
    struct zs_renderer r;
    struct zs_supersample s;
    const struct zs_resolve hook = { .draw = mark_draw };
    void *arena;
    glass_clear(width, height);
    const struct zs_sink sink = glass_sink(&glass, (int)prng_pick(&p, 2));
    int err = renderer_make(&r, &c, &arena);
    err = err ? err : zs_supersample_init(&s, &r, &sink);
    s.resolve = &hook;
    s.n_resolves = 1;
    const int how = (int)prng_pick(&p, 4);
    if (how != 1)
        err = err ? err : damage_compare_anew(&r, &hashes, sums, (uint32_t)prng_range(&p, 1, c.width));
    if (how >= 1)
        err = err ? err : zs_damage_track(&r, track, w.scene.n_instances);
    if (how >= 2)
        err = err ? err : zs_damage_columns(&r, 1);
    int right = !err;
    for (int frame = 0; right && frame < 5; frame++) {
        for (uint32_t k = 0; frame && k < w.n_instances; k++)
            if (!prng_pick(&p, 3))
                w.instance[k].pose.pos[prng_pick(&p, 3)] += prng_range(&p, -50, 50);
        if (!prng_pick(&p, 3)) {
            (void)zs_supersample_invalidate(&s, &mark);
            mark = (struct zs_rect){ (uint16_t)prng_range(&p, 0, width), (uint16_t)prng_range(&p, 0, height),
                                     (uint16_t)prng_range(&p, 1, 9), (uint16_t)prng_range(&p, 1, 9) };
            mark_color = (uint16_t)prng_next(&p);
            (void)zs_supersample_invalidate(&s, &mark);
        }
        struct picture samples = picture_draw(&whole, &w.scene, &w.camera);
        glass.sent = 0;
        err = zs_render(&r, &w.scene, &w.camera, &s.sink);
        saved += !err && glass.sent < (uint32_t)(width * height);
        right = err == samples.err;
        for (int32_t y = 0; right && !err && y < height; y++)
            for (int32_t x = 0; x < width; x++) {
                uint8_t want[2];
                const uint16_t m = mean565(samples.color, samples.w, x, y);
                want[0] = (uint8_t)(m >> 8);
                want[1] = (uint8_t)m;
                if ((uint32_t)x - mark.x < mark.w && (uint32_t)y - mark.y < mark.h)
                    memcpy(want, &mark_color, 2);
                if (memcmp(want, glass.px[y][x], 2))
                    right = case_wrong("frame %d: (%d, %d)", frame, x, y);
            }
        picture_free(&samples);
    }
    free(arena);
    world_free(&w);
    return (right && !marks) || case_wrong("error %d", err);
}

static void column_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    (void)y;
    for (uint32_t k = 0; k < n; k++)
        out[k] = (uint16_t)(x + k == *(uint32_t *)ctx ? 0xffff : 0);
}

/* Cells of three samples: a change of one sample is sent with its whole pixel. */
static void cells_of_odd_width(void **state)
{
    (void)state;
    const struct zs_config c = {
        .width = 12, .height = 2, .strip_h = 2, .max_tris = 1, .max_verts = 3, .depth = &zs_depth_linear
    };
    const struct zs_camera camera = pixel_camera(2, 0);
    const struct zs_sink sink = glass_sink(&glass, 0);
    static uint64_t sums[12];
    struct zs_strip_hashes hashes;
    struct zs_renderer r;
    struct zs_supersample s;
    void *arena;
    glass_clear(6, 1);
    assert_int_equal(renderer_make(&r, &c, &arena), ZS_OK);
    assert_int_equal(damage_compare_anew(&r, &hashes, sums, 4), ZS_OK);
    assert_int_equal(zs_supersample_init(&s, &r, &sink), ZS_OK);
    for (uint32_t at = 0; at < 12; at++) {
        struct zs_background sky = { .fill = column_fill, .ctx = &at };
        const struct zs_scene scene = { .sky = &sky };
        assert_int_equal(zs_render(&r, &scene, &camera, &s.sink), ZS_OK);
        for (int32_t x = 0; x < 6; x++)
            assert_int_equal(shown(&glass, x, 0), x == (int32_t)at / 2 ? 0x8410 : 0);
    }
    free(arena);
}

/* ---- Calls ------------------------------------------------------------------------------------- */

ZS_RENDERER_2X2(macro, 20, 10, 4, 8, 8, ZS_VARYINGS_FLAT);

static void calls_and_errors(void **state)
{
    (void)state;
    struct zs_supersample s;
    const struct zs_sink sink = glass_sink(&glass, 0), none = { 0 };
    const struct zs_scene scene = { .background = 0x1234 };
    struct zs_camera camera = pixel_camera(20, 0);
    struct zs_strip strip;
    assert_int_equal(macro_config.width, 40);
    assert_int_equal(macro_config.height, 20);
    assert_int_equal(macro_config.strip_h, 8);
    macro_config.depth = &zs_depth_linear;
    assert_int_equal(zs_supersample_init(&macro_2x2, &macro, &sink), ZS_ERR_SEQUENCE);
    static const uint8_t odd[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (int k = 0; k < 3; k++) {
        struct zs_config c = macro_config;
        c.width = (uint16_t)(c.width - odd[k][0]);
        c.height = (uint16_t)(c.height - odd[k][1]);
        c.strip_h = (uint16_t)(c.strip_h - odd[k][2]);
        assert_int_equal(zs_init(&macro, &c, macro_arena, sizeof macro_arena), ZS_OK);
        assert_int_equal(zs_supersample_init(&macro_2x2, &macro, &sink), ZS_ERR_SIZE);
    }
    assert_int_equal(ZS_INIT(macro), ZS_OK);
    assert_int_equal(zs_supersample_init(NULL, &macro, &sink), ZS_ERR_NULL);
    assert_int_equal(zs_supersample_init(&s, NULL, &sink), ZS_ERR_NULL);
    assert_int_equal(zs_supersample_init(&s, &macro, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_supersample_init(&s, &macro, &none), ZS_ERR_NULL);
    assert_int_equal(zs_supersample_init(&macro_2x2, &macro, &sink), ZS_OK);
    assert_int_equal(zs_supersample_invalidate(NULL, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_supersample_invalidate(&macro_2x2, NULL), ZS_OK);

    glass_clear(20, 10);
    glass.fails = -200;
    assert_int_equal(zs_render(&macro, &scene, &camera, &macro_2x2.sink), -200);
    assert_int_equal(glass.ends, 1);
    glass.fails = 0;
    assert_int_equal(zs_render(&macro, &scene, &camera, &macro_2x2.sink), ZS_OK);
    assert_int_equal(glass.ends, 2);
    assert_int_equal(shown(&glass, 19, 9), 0x1234);
    assert_int_equal(zs_frame_begin(&macro, &scene, &camera), ZS_OK);
    for (int k = 0; k < 3; k++) {
        assert_int_equal(zs_frame_strip(&macro, &strip), 1);
        zs_supersample_strip(&macro_2x2, &strip);
        assert_int_equal(strip.y, 4 * k);
        assert_int_equal(strip.h, k < 2 ? 4 : 2);
        assert_int_equal(strip.w, 20);
        assert_int_equal(strip.dirty_w, 20);
        assert_int_equal(strip.n_bytes, 40 * strip.h);
    }
    assert_int_equal(zs_frame_strip(&macro, &strip), 0);
}

static const struct CMUnitTest tests[] = {
    CASES_TEST(pixels_are_averages, average_case, 60),
    CASES_TEST(any_scene_in_any_way, world_case, 150),
    CASES_COUNT(coverage_is_the_oracles, coverage_case, 300, &parts, 3000, "partly covered pixels"),
    cmocka_unit_test(four_samples_are_nearer),
    CASES_COUNT(damage_is_that_of_samples, damage_case, 150, &saved, 100, "frames not sent as a whole"),
    cmocka_unit_test(cells_of_odd_width),
    cmocka_unit_test(calls_and_errors),
};
CASES_MAIN(tests)
