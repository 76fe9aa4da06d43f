/* Depth sort and coverage: the nearest triangle at every pixel, on cycles and intersections too, by exact rationals and
 * by the depth buffer; the same for any pools, strips and accelerators; and what it costs.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "core/depth.h"
#include "core/fx.h"
#include "fast_lists.h"
#include "method_needs.h"
#include "own.h"
#include "picture.h"
#include "ways.h"
#include "zs_method.h"

/* How many random scenes; by hand 10,000 of each of the first two: CFLAGS or the command line say -DCUT_EXACT=10000 */
#ifndef CUT_EXACT
#define CUT_EXACT 300
#endif
#ifndef CUT_BUFFER
#define CUT_BUFFER 150
#endif
#define CUT_WAYS 120
#define TRIS 100
#define SIDE 48

static int16_t pos[TRIS * 3][3];
static uint16_t corners[TRIS][3], color[TRIS];
static struct zs_mesh mesh = { .pos = pos, .tri = corners, .face_raw = color, .radius = 65535 };
static const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
static const struct zs_instance instance = { .mesh = &mesh, .material = &material };
static const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };

/* A mesh of n triangles without common vertices, triangle t of colour t + 1. */
static void mesh_set(uint32_t n)
{
    mesh.n_tris = n;
    mesh.n_verts = 3 * n;
    for (uint32_t k = 0; k < 3 * n; k++)
        corners[k / 3][k % 3] = (uint16_t)k;
    for (uint32_t t = 0; t < n; t++)
        color[t] = (uint16_t)(t + 1);
}

static int triangle_at(const struct picture *p, int32_t k)
{
    return p->color[k] - 1; /* -1: the background */
}

static const struct zs_method *any_method(struct prng *p)
{
    return prng_pick(p, 2) ? &zs_method_depthsort : &zs_method_coverage;
}

/* Coverage writes each visible pixel once. */
static int writes_once(const struct zs_config *c, const struct picture *p)
{
    uint32_t visible = 0;
    for (int32_t k = 0; k < p->w * p->h; k++)
        visible += p->color[k] != 0;
    return c->method != &zs_method_coverage || p->stats.pixels_written == visible ||
           case_wrong("%u pixels written, %u visible", p->stats.pixels_written, visible);
}

static unsigned splits, walks, changes;

/* ---- Against exact rationals ------------------------------------------------------------------ */

/* Positions are sub-pixels from the frame's middle, and z is linear on the screen. */
static struct zs_camera flat_camera(void)
{
    return pixel_camera(SIDE, 0);
}

/* Fill a random triangle: anywhere near the frame, from 0 to `depth` deep. */
static void any_triangle(struct prng *p, int16_t v[3][3], int32_t size, int32_t depth)
{
    const int32_t nearest = prng_range(p, 2, 2 + 30000 - depth);
    const int32_t x = prng_range(p, -SIDE * 128, SIDE * 128), y = prng_range(p, -SIDE * 128, SIDE * 128);
    for (int k = 0; k < 3; k++) {
        v[k][0] = (int16_t)(x + prng_range(p, -size, size));
        v[k][1] = (int16_t)(y + prng_range(p, -size, size));
        v[k][2] = (int16_t)-(nearest + prng_range(p, 0, depth));
    }
}

/* Bar k of n around the middle, its one end before the next bar, its other one behind the last: a cycle. */
static void bar(int16_t (*v)[3], int k, int n, int32_t nearest)
{
    static const int16_t at[4][2] = { { 5000, 0 }, { 0, 5000 }, { -5000, 0 }, { 0, -5000 } };
    const int16_t *a = at[k], *b = at[(k + 1) % n % 4];
    const int32_t dx = b[0] - a[0], dy = b[1] - a[1];
    const int32_t end[4][2] = { { a[0] - dx / 4 - dy / 12, a[1] - dy / 4 + dx / 12 },
                                { a[0] - dx / 4 + dy / 12, a[1] - dy / 4 - dx / 12 },
                                { b[0] + dx / 4 + dy / 12, b[1] + dy / 4 - dx / 12 },
                                { b[0] + dx / 4 - dy / 12, b[1] + dy / 4 + dx / 12 } };
    static const int order[6] = { 0, 1, 2, 0, 2, 3 };
    for (int i = 0; i < 6; i++) {
        v[i][0] = (int16_t)end[order[i]][0];
        v[i][1] = (int16_t)end[order[i]][1];
        v[i][2] = (int16_t)-(order[i] < 2 ? nearest : nearest + 800);
    }
}

/* Triangles that intersect, overlap in a cycle, share edges, lie in one plane, or are slivers. */
static void any_scene(struct prng *p, uint32_t n)
{
    const int32_t size = prng_range(p, 300, 9000), depth = prng_pick(p, 3) ? prng_range(p, 0, 30000) : 3;
    for (uint32_t t = 0; t < n; t++) {
        int16_t (*v)[3] = pos + 3 * t;
        any_triangle(p, v, prng_pick(p, 3) ? size : 9000, depth);
        const uint32_t like = t ? prng_pick(p, t) : 0;
        switch (prng_pick(p, 8)) {
        case 0: /* in the plane of another */
            if (t)
                memcpy(v, pos + 3 * like, sizeof pos[0] * 3);
            break;
        case 1: /* an edge or a corner of another */
            if (t)
                memcpy(v, pos + 3 * like, sizeof pos[0] * (1 + prng_pick(p, 2)));
            break;
        case 2: /* a sliver, steep */
            for (int k = 0; k < 2; k++)
                v[2][k] = (int16_t)((v[0][k] + v[1][k]) / 2 + prng_range(p, -40, 40));
            break;
        case 3: /* level */
            v[1][2] = v[2][2] = v[0][2];
            break;
        case 4:
            if (t + 6 <= n) {
                const int bars = 3 + (int)prng_pick(p, 2);
                for (int k = 0; k < bars && t + 2 <= n; k++, t += 2)
                    bar(pos + 3 * t, k, bars, 2000 + prng_range(p, 0, 20000));
                t--;
            }
            break;
        default:
            break;
        }
    }
    const int32_t step = prng_pick(p, 3) ? 1 : prng_pick(p, 2) ? 128 : 1024; /* samples on edges */
    for (uint32_t v = 0; v < 3 * n; v++)
        for (int k = 0; k < 2; k++)
            pos[v][k] = (int16_t)(pos[v][k] / step * step + (step > 1 ? 128 : 0));
}

/* Return 1 if sample (256 i + 128, 256 j + 128) of the frame is in triangle t, and its depth as *num / *den. */
static int covers(uint32_t t, int32_t i, int32_t j, __int128 *num, __int128 *den)
{
    int64_t x[3], y[3], z[3], e[3];
    for (int k = 0; k < 3; k++) {
        x[k] = pos[3 * t + (uint32_t)k][0] + SIDE * 128 - (256 * i + 128);
        y[k] = SIDE * 128 - pos[3 * t + (uint32_t)k][1] - (256 * j + 128);
        z[k] = -pos[3 * t + (uint32_t)k][2];
    }
    const int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0)
        return 0;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const int64_t dx = area > 0 ? x[b] - x[a] : x[a] - x[b], dy = area > 0 ? y[b] - y[a] : y[a] - y[b];
        e[k] = x[a] * y[b] - x[b] * y[a]; /* the corner's weight */
        const int64_t in = area > 0 ? e[k] : -e[k];
        if (in < 0 || (in == 0 && !(dy < 0 || (dy == 0 && dx > 0))))
            return 0;
    }
    *num = (__int128)e[0] * z[0] + (__int128)e[1] * z[1] + (__int128)e[2] * z[2];
    *den = area;
    return 1;
}

/* Every pixel has a triangle that covers it and is as near as any, within 1/64 of a unit, 2^-22 of the range; a tie is
 * that of the first. */
static int is_nearest(const struct picture *p, uint32_t n)
{
    for (int32_t k = 0; k < p->w * p->h; k++) {
        double least = 1e9, own = 1e9;
        int first = -1;
        for (uint32_t t = 0; t < n; t++) {
            __int128 num, den;
            if (!covers(t, k % p->w, k / p->w, &num, &den))
                continue;
            const double d = (double)num / (double)den;
            if (d < least) {
                least = d;
                first = (int)t;
            }
            if (triangle_at(p, k) == (int)t)
                own = d;
        }
        const int is = triangle_at(p, k);
        if (own - least > 1.0 / 64 || (is < 0) != (first < 0) ||
            (is != first && !memcmp(pos + 3 * is, pos + 3 * first, sizeof pos[0] * 3)))
            return case_wrong("pixel %d, %d: triangle %d, not %d; %f, %f", k % p->w, k / p->w, is, first, own, least);
        changes += first >= 0;
    }
    return 1;
}

static int exact_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t n = (uint32_t)prng_range(&p, 1, prng_pick(&p, 4) ? 14 : 40);
    const struct zs_camera camera = flat_camera();
    struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_order);
    any_scene(&p, n);
    mesh_set(n);
    c.method = any_method(&p);
    c.strip_h = (uint16_t)prng_range(&p, 1, SIDE);
    if (prng_pick(&p, 3) == 0)
        picture_any_way(&p, &c, 2, 6);
    struct picture is = picture_draw(&c, &scene, &camera);
    const int right = (!is.err || case_wrong("error %d", is.err)) && is_nearest(&is, n) && writes_once(&c, &is);
    splits += is.stats.splits;
    walks += is.stats.passes > is.stats.strips;
    picture_free(&is);
    return right;
}

/* ---- Against the depth buffer ----------------------------------------------------------------- */

static struct picture lone_picture[TRIS];

/* Perspective, with triangles that reach beyond near: where the picture differs from that of zs_depth_recip, the keys
 * of both triangles differ by one bucket at most. */
static int buffer_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t n = (uint32_t)prng_range(&p, 1, prng_pick(&p, 4) ? 12 : 30);
    const int32_t depth = prng_pick(&p, 4) ? prng_range(&p, 0, 20000) : 10;
    struct zs_camera camera;
    int right = 1;
    if (zs_camera_perspective(&camera, ZS_DEGREES(60), SIDE, 500, 40000))
        return case_wrong("camera");
    for (uint32_t t = 0; t < n; t++) {
        const int32_t nearest = prng_range(&p, prng_pick(&p, 6) ? 600 : 100, 9000);
        for (uint32_t v = 3 * t; v < 3 * t + 3; v++) {
            pos[v][2] = (int16_t)-(nearest + prng_range(&p, 0, depth));
            pos[v][0] = (int16_t)(prng_range(&p, -900, 900) * -pos[v][2] / 1000);
            pos[v][1] = (int16_t)(prng_range(&p, -900, 900) * -pos[v][2] / 1000);
        }
    }
    mesh_set(n);
    struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_recip);
    struct picture want = picture_draw(&c, &scene, &camera);
    for (uint32_t t = 0; t < n; t++) {
        struct zs_mesh one = mesh;
        one.tri = corners + t;
        one.n_tris = 1;
        one.face_raw = color + t;
        const struct zs_instance in = { .mesh = &one, .material = &material };
        const struct zs_scene alone = { .instance = &in, .n_instances = 1 };
        lone_picture[t] = picture_draw(&c, &alone, &camera);
    }
    c.depth = &zs_depth_order;
    c.method = any_method(&p);
    picture_any_way(&p, &c, 2, 6);
    struct picture is = picture_draw(&c, &scene, &camera);
    right = right && (!is.err || case_wrong("error %d", is.err)) && writes_once(&c, &is);
    for (int32_t k = 0; right && k < SIDE * SIDE; k++) {
        const int a = triangle_at(&want, k), b = triangle_at(&is, k);
        if (a == b)
            continue;
        changes++;
        if (a < 0 || b < 0 || lone_picture[b].key[k] == ZS_DEPTH_CLEAR ||
            lone_picture[b].key[k] - lone_picture[a].key[k] > 1)
            right = case_wrong("pixel %d, %d: triangle %d, not %d", k % SIDE, k / SIDE, b, a);
    }
    splits += is.stats.splits;
    PICTURES_FREE(&is, &want);
    for (uint32_t t = 0; t < n; t++)
        picture_free(&lone_picture[t]);
    return right;
}

/* ---- Any pools, any strips, any accelerators -------------------------------------------------- */

static unsigned again;

/* Both methods show the same, and the same in any other way; single shaders may mix or leave pixels. */
static int way_case(uint64_t seed)
{
    static const struct ways of = { 40, 20, .depth = &zs_depth_order,
                                    .method = { &zs_method_depthsort, &zs_method_coverage }, .again = &again,
                                    .splits = &splits };
    return ways_alike(seed, &of);
}

/* ---- What it costs ---------------------------------------------------------------------------- */

static struct zs_stats cost_of(uint32_t n, const struct zs_method *method)
{
    const struct zs_camera camera = flat_camera();
    struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_order);
    c.method = method;
    mesh_set(n);
    struct picture is = picture_draw(&c, &scene, &camera);
    const struct zs_stats stats = is.stats;
    assert_int_equal(is.err, ZS_OK);
    assert_true(is_nearest(&is, n));
    picture_free(&is);
    return stats;
}

static void quad(uint32_t t, int32_t x, int32_t y, int32_t z, int32_t dz)
{
    for (int k = 0; k < 3; k++) {
        pos[3 * t + (uint32_t)k][0] = (int16_t)(x + (k == 1 ? 9000 : -4000));
        pos[3 * t + (uint32_t)k][1] = (int16_t)(y + (k == 2 ? 9000 : -4000));
        pos[3 * t + (uint32_t)k][2] = (int16_t)-(z + (k == 1 ? dz : 0));
    }
}

/* Layers one behind the other: no pair is compared. The same in one range of depths, disjoint: every pair is. */
static void costs_n_log_n_where_depths_are_apart(void **state)
{
    (void)state;
    for (uint32_t t = 0; t < TRIS; t++)
        quad(t, 0, 0, 100 + (int32_t)(t * 37 % TRIS) * 200, 100);
    const struct zs_stats apart = cost_of(TRIS, &zs_method_depthsort);
    assert_int_equal(apart.sorted, TRIS);
    assert_int_equal(apart.pairs, 0);
    assert_int_equal(apart.splits, 0);
    for (uint32_t t = 0; t < TRIS; t++)
        quad(t, 0, 0, 100 + (int32_t)t * 10, 2000);
    const struct zs_stats worst = cost_of(TRIS, &zs_method_depthsort);
    assert_int_equal(worst.pairs, TRIS * (TRIS - 1) / 2);
    assert_int_equal(worst.splits, 0);
}

/* Two triangles that intersect are split once, a cycle of three bars once, and n in a fan around a line n^2. */
static void splits_are_counted(void **state)
{
    (void)state;
    for (int both = 0; both < 2; both++) {
        const struct zs_method *method = both ? &zs_method_coverage : &zs_method_depthsort;
        quad(0, 0, 0, 1000, 4000);
        quad(1, 0, 0, 4000, -3000);
        assert_int_equal(cost_of(2, method).splits, 1);
        for (int k = 0; k < 3; k++)
            bar(pos + 6 * k, k, 3, 1000);
        const struct zs_stats cycle = cost_of(6, method);
        printf("cycle of three bars: %u splits, %u pairs\n", cycle.splits, cycle.pairs);
        assert_true(cycle.splits >= 1 && cycle.splits <= 3);
        for (uint32_t n = 4; n <= 16; n *= 2) {
            for (uint32_t t = 0; t < n; t++)
                quad(t, 0, 0, 1000 + (int32_t)(t * 400), 9000 - (int32_t)(t * 800));
            const struct zs_stats fan = cost_of(n, method);
            printf("%u that intersect: %u splits, %u pairs\n", n, fan.splits, fan.pairs);
            assert_true(fan.splits >= n - 1 && fan.splits <= n * n);
        }
    }
}

/* Every triangle of one half crosses every one of the other: n^2 / 4 lines. */
static void shows_the_worst_case(void **state)
{
    (void)state;
    for (uint32_t n = 4; n <= 32; n *= 2) {
        for (uint32_t t = 0; t < n; t++)
            quad(t, 0, 0, t % 2 ? 9000 + (int32_t)(t * 100) : 1000 + (int32_t)(t * 100), t % 2 ? -9000 : 9000);
        const struct zs_stats s = cost_of(n, &zs_method_depthsort);
        printf("%u that cross %u: %u splits, %u pairs, %u set-ups\n", n / 2, n / 2, s.splits, s.pairs, s.tris_setup);
        assert_true(s.splits >= n / 2 && s.splits <= n * n && s.pairs <= 40 * n * n);
    }
}

/* Frames of the scene with a pool for all of it, and with one of max_tris, which show the same. */
static struct both {
    struct zs_stats all, cut;
} same_in_a_pool(struct zs_config *c, const struct zs_camera *camera, uint16_t max_tris)
{
    struct picture all = picture_draw(c, &scene, camera);
    c->max_tris = max_tris;
    struct picture cut = picture_draw(c, &scene, camera);
    const struct both stats = { all.stats, cut.stats };
    assert_int_equal(all.err, ZS_OK);
    assert_int_equal(cut.err, ZS_OK);
    assert_memory_equal(all.color, cut.color, (size_t)c->width * c->height * sizeof all.color[0]);
    PICTURES_FREE(&all, &cut);
    return stats;
}

/* A hundred triangles that cross each other in 8 x 8 pixels, with records for their thousands of pieces: that asks no
 * more than all triangles at all pixels, once for each size of a rectangle, and shows what a pool of two shows, which
 * has no room for an order. */
static void is_halved_where_pixels_take_less(void **state)
{
    const struct zs_camera camera = pixel_camera(8, 0);
    (void)state;
    for (int both = 0; both < 2; both++) {
        struct prng p = { 1 };
        struct zs_config c = picture_config(8, 8, &zs_depth_order);
        for (uint32_t v = 0; v < 3 * TRIS; v++) {
            pos[v][0] = v % 3 == 1 ? 9000 : -4000;
            pos[v][1] = v % 3 == 2 ? 9000 : -4000;
            pos[v][2] = (int16_t)-prng_range(&p, 1, 30000);
        }
        mesh_set(TRIS);
        c.method = both ? &zs_method_coverage : &zs_method_depthsort;
        const struct zs_stats all = same_in_a_pool(&c, &camera, 2).all;
        printf("%d that cross in 8 x 8 pixels: %u pairs, %u splits\n", TRIS, all.pairs, all.splits);
        assert_true(all.pairs <= 7 * 8 * 8 * TRIS);
    }
}

/* Bars from corner to corner, side by side, more than the pool holds: the box of each is nearly the frame, but parts of
 * it have few. */
static void leaves_out_what_is_beside_a_rectangle(void **state)
{
    const struct zs_camera camera = flat_camera();
    (void)state;
    for (int both = 0; both < 2; both++) {
        struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_order);
        const int32_t end = SIDE * 128;
        for (uint32_t t = 0; t < TRIS; t++) {
            const int32_t at = (int32_t)t * 2 * end / TRIS - end; /* where it crosses the other diagonal, twice */
            const int32_t x[3] = { at - end, at - end + 256, at + end };
            const int32_t y[3] = { -at - end, -at - end - 256, -at + end };
            for (uint32_t k = 0; k < 3; k++) {
                pos[3 * t + k][0] = (int16_t)x[k];
                pos[3 * t + k][1] = (int16_t)y[k];
                pos[3 * t + k][2] = (int16_t)(-100 - (int32_t)(t * 37 % TRIS) * 50);
            }
        }
        mesh_set(TRIS);
        c.method = both ? &zs_method_coverage : &zs_method_depthsort;
        const uint32_t passes = same_in_a_pool(&c, &camera, 60).cut.passes;
        printf("%d bars in a pool of 60: %u walks\n", TRIS, passes);
        assert_true(passes <= 200); /* by boxes alone 2,124: each pixel by itself */
    }
}

/* A hundred layers of glass in a pool of 40: a walk finds several layers of a pixel, and they show what they show where
 * all have room. */
static void finds_several_layers_in_a_walk(void **state)
{
    static const struct zs_material glass = { .shader = &glass_shader, .cull = ZS_CULL_NONE };
    const struct zs_instance in = { .mesh = &mesh, .material = &glass };
    const struct zs_scene layers = { .instance = &in, .n_instances = 1 };
    const struct zs_camera camera = pixel_camera(8, 0);
    struct zs_config c = picture_config(8, 8, &zs_depth_order);
    (void)state;
    for (uint32_t t = 0; t < TRIS; t++)
        quad(t, 0, 0, 100 + (int32_t)(t * 37 % TRIS) * 20, 2000);
    for (uint32_t v = 30; v < 60; v++) /* some as near as each other */
        pos[v][2] = pos[v % 3][2];
    mesh_set(TRIS);
    c.method = &zs_method_depthsort;
    struct picture want = picture_draw(&c, &layers, &camera);
    c.max_tris = c.max_verts = 40;
    struct picture is = picture_draw(&c, &layers, &camera);
    assert_int_equal(is.err, ZS_OK);
    assert_int_equal(want.err, ZS_OK);
    assert_memory_equal(is.color, want.color, 8 * 8 * sizeof is.color[0]);
    printf("%d layers in a pool of 40: %u walks, of 64 pixels\n", TRIS, is.stats.passes);
    assert_true(is.stats.passes <= 64 * (TRIS / 6 + 4)); /* one by one: 64 * TRIS and more */
    PICTURES_FREE(&is, &want);
}

/* Strips that are not drawn hand their triangles on. */
static void strips_may_be_skipped(void **state)
{
    const struct zs_camera camera = flat_camera();
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        struct prng p = { seed };
        static uint32_t arena[1 << 16];
        static struct zs_renderer r;
        struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_order);
        struct zs_strip strip;
        any_scene(&p, 20);
        mesh_set(20);
        c.method = any_method(&p);
        c.strip_h = (uint16_t)prng_range(&p, 1, 20);
        c.max_tris = (uint16_t)prng_range(&p, 10, 40);
        c.max_verts = 120;
        c.buffers = 1;
        struct picture want = picture_draw(&c, &scene, &camera);
        assert_int_equal(want.err, ZS_OK);
        assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
        assert_int_equal(zs_frame_begin(&r, &scene, &camera), ZS_OK);
        for (int32_t y = 0; y < SIDE; y += c.strip_h) {
            if (prng_pick(&p, 2)) {
                assert_int_equal(zs_frame_skip(&r), 1);
                continue;
            }
            assert_int_equal(zs_frame_strip(&r, &strip), 1);
            for (int32_t k = 0; k < strip.w * strip.h; k++)
                assert_int_equal(strip.px[2 * k] << 8 | strip.px[2 * k + 1], want.color[y * SIDE + k]);
        }
        picture_free(&want);
    }
}

/* Two meshes, of which one moves: with damage tracking, the columns given out make the whole frame. */
static void only_what_changed_may_be_drawn(void **state)
{
    static uint32_t arena[1 << 16], memory[ZS_DAMAGE_WORDS(2, SIDE, 1)];
    static struct zs_renderer r;
    static uint16_t panel[SIDE * SIDE];
    const struct zs_camera camera = flat_camera();
    uint32_t narrow = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        struct prng p = { seed };
        struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_order);
        struct zs_instance two[2] = { instance, instance };
        const struct zs_scene both = { .instance = two, .n_instances = 2 };
        any_scene(&p, 20);
        mesh_set(20);
        struct zs_mesh small = mesh;
        small.n_tris = 8;
        small.radius = 2000;
        for (int v = 0; v < 24; v++)
            for (int k = 0; k < 3; k++)
                pos[v][k] = (int16_t)(k < 2 ? prng_range(&p, -1000, 1000) : prng_range(&p, -1000, 1000));
        two[0].mesh = &small;
        c.method = any_method(&p);
        c.strip_h = (uint16_t)prng_range(&p, 1, 20);
        c.max_tris = (uint16_t)prng_range(&p, 4, 60);
        c.max_verts = (uint16_t)prng_range(&p, 8, 120);
        c.buffers = 1;
        assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
        assert_int_equal(zs_damage_track(&r, memory, 2), ZS_OK);
        assert_int_equal(zs_damage_columns(&r, 1), ZS_OK);
        for (int frame = 0; frame < 4; frame++) {
            struct zs_strip strip;
            two[0].pose.pos[0] = (int32_t)(seed * 50) + prng_range(&p, -900, 900);
            two[0].pose.pos[2] = -prng_range(&p, 9000, 20000);
            struct picture want = picture_draw(&c, &both, &camera);
            assert_int_equal(want.err, ZS_OK);
            assert_int_equal(zs_frame_begin(&r, &both, &camera), ZS_OK);
            while (zs_frame_strip(&r, &strip) > 0) {
                narrow += strip.dirty_w && strip.dirty_w < SIDE;
                for (int32_t y = 0; y < strip.h; y++)
                    for (int32_t x = strip.dirty_x; x < strip.dirty_x + strip.dirty_w; x++) {
                        const uint8_t *px = strip.px + 2 * (y * SIDE + x);
                        panel[(strip.y + y) * SIDE + x] = (uint16_t)(px[0] << 8 | px[1]);
                    }
            }
            assert_memory_equal(panel, want.color, sizeof panel);
            picture_free(&want);
        }
    }
    assert_true(narrow > 100);
}

/* In perspective, what is sorted by is zs_depth_recip's key in 16 bits, however few bits the renderer has. */
static void sorts_by_keys_of_16_bits(void **state)
{
    (void)state;
    struct zs_view is = { .perspective = 1, .z_near = 256 }, want = is;
    struct zs_camera camera = { .z_near = 65536, .z_far = 100 * 65536 };
    assert_int_equal(zs_depth_order.setup(&is, &camera, 8), ZS_OK);
    assert_int_equal(zs_depth_recip.setup(&want, &camera, 16), ZS_OK);
    for (int32_t z = 256; z < 25600; z += 97) {
        const int32_t lz = zs_clz32((uint32_t)z);
        const uint32_t rcp = zs_recip_inline((uint32_t)z << lz);
        assert_int_equal(zs_depth_order.vertex(&is, z, rcp, lz), zs_depth_recip.vertex(&want, z, rcp, lz));
    }
}

/* ---- What is refused ------------------------------------------------------------------------- */

static void small_pools_and_other_mappings_are_refused(void **state)
{
    (void)state;
    for (int both = 0; both < 2; both++)
        for (int none = 0; none < 2; none++)
            assert_method_needs(&(struct method_needs){ both ? &zs_method_coverage : &zs_method_depthsort,
                                                        &zs_depth_order, none ? &zs_depth_none : &zs_depth_linear,
                                                        2 });
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(shows_the_nearest_exactly, exact_case, CUT_EXACT,
                 { "splits", &splits, CUT_EXACT / 3 }, { "walks", &walks, CUT_EXACT / 20 }),
    CASES_COUNTS(agrees_with_the_depth_buffer, buffer_case, CUT_BUFFER,
                 { "splits", &splits, CUT_BUFFER }, { "pixels within a bucket", &changes, 0 }),
    CASES_COUNTS(is_the_same_in_any_way, way_case, CUT_WAYS,
                 { "scenes in several walks", &again, CUT_WAYS / 4 }, { "splits", &splits, 0 }),
    cmocka_unit_test(costs_n_log_n_where_depths_are_apart),
    cmocka_unit_test(splits_are_counted),
    cmocka_unit_test(shows_the_worst_case),
    cmocka_unit_test(is_halved_where_pixels_take_less),
    cmocka_unit_test(leaves_out_what_is_beside_a_rectangle),
    cmocka_unit_test(finds_several_layers_in_a_walk),
    cmocka_unit_test(strips_may_be_skipped),
    cmocka_unit_test(only_what_changed_may_be_drawn),
    cmocka_unit_test(sorts_by_keys_of_16_bits),
    cmocka_unit_test(small_pools_and_other_mappings_are_refused)
};

CASES_MAIN(tests)
