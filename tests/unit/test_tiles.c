/* Triangles that are skipped because large ones hide them: the frame is the same with and without, in any order, with
 * equal keys, states, small pools, every mapping; and layers cost about one layer.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "fast_lists.h"
#include "picture.h"
#include "internals.h"
#include "prng.h"
#include "shapes.h"
#include "zs_method.h"

#define QUADS_MAX 10
#define SCALE 64 /* world units to a step of the mesh */

static const struct zs_depth_state states[] = {
    { .func = ZS_DEPTH_ALWAYS },
    { .func = ZS_DEPTH_LESS_EQUAL },
    { .read_only = 1 },
    { .bias = -300 },
    { .bias = 300 },
    { .func = ZS_DEPTH_LESS_EQUAL, .read_only = 1, .bias = -5, .slope_bias = 90 }
};

static struct {
    int16_t pos[QUADS_MAX][4][3];
    struct zs_mesh mesh[QUADS_MAX];
    struct zs_material material[QUADS_MAX];
    struct zs_instance instance[QUADS_MAX];
    struct zs_scene scene;
    struct zs_camera camera;
} world;

/* Two triangles with an edge in common, in one of the ways to name them. */
static const uint16_t halves[4][2][3] = { { { 0, 1, 2 }, { 0, 2, 3 } }, { { 2, 0, 1 }, { 3, 0, 2 } },
                                          { { 0, 1, 3 }, { 1, 2, 3 } }, { { 0, 1, 2 }, { 1, 2, 3 } } /* overlap */ };

static void quad(struct prng *p, uint32_t n, int32_t half, int32_t z, int32_t tilt)
{
    static const int sign[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    const int32_t x = prng_range(p, -half / 2, half / 2), y = prng_range(p, -half / 2, half / 2);
    for (int k = 0; k < 4; k++) {
        world.pos[n][k][0] = (int16_t)(x + sign[k][0] * half + prng_range(p, -half / 3, half / 3));
        world.pos[n][k][1] = (int16_t)(y + sign[k][1] * half + prng_range(p, -half / 3, half / 3));
        world.pos[n][k][2] = (int16_t)(-z + prng_range(p, -tilt, tilt));
    }
}

static void begin(struct prng *p, uint32_t n, int perspective)
{
    world.scene = (struct zs_scene){ .instance = world.instance, .n_instances = n,
                                     .light = { .dir = { 0, 0, ZS_Q30_ONE }, .ambient = ZS_Q16_ONE },
                                     .background = 0x1234 };
    for (uint32_t i = 0; i < n; i++) {
        world.mesh[i] = (struct zs_mesh){ .pos = (const int16_t(*)[3])world.pos[i], .tri = halves[prng_pick(p, 4)],
                                          .n_verts = 4, .n_tris = 2, .scale = SCALE * ZS_Q16_ONE, .radius = 32767 };
        world.material[i] = (struct zs_material){ .shader = &zs_shade_raw,
                                                  .rgb = { (uint8_t)(40 + 20 * i), (uint8_t)(i * 77), 99 },
                                                  .cull = ZS_CULL_NONE };
        world.instance[i] = (struct zs_instance){ .mesh = &world.mesh[i], .material = &world.material[i] };
        zs_pose_identity(&world.instance[i].pose);
    }
    const int32_t eye[3] = { 0, 0, 0 }, at[3] = { 0, 0, -1000 }, up[3] = { 0, 1, 0 };
    assert_int_equal(perspective ? zs_camera_perspective(&world.camera, 12000, 120, 2000, 600000)
                                 : zs_camera_orthographic(&world.camera, 200000, 2000, 600000), ZS_OK);
    assert_int_equal(zs_camera_look_at(&world.camera, eye, at, up), ZS_OK);
}

static uint32_t setups_saved, untested; /* of all frames */

static uint32_t hidden_case(uint64_t seed)
{
    static const struct zs_depth *const depths[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_e3m13,
                                                     &zs_depth_float, &zs_depth_e5m11 };
    struct prng p = { seed };
    const uint32_t n = 2 + prng_pick(&p, QUADS_MAX - 1), mapping = prng_pick(&p, 5);
    const int perspective = mapping != 1 || prng_pick(&p, 2);
    for (uint32_t i = 0; i < n; i++) {
        const int32_t z = prng_range(&p, 100, 8000);
        quad(&p, i, prng_range(&p, 200, prng_pick(&p, 3) ? 9000 : 900), z, prng_pick(&p, 3) ? z / 20 : z);
    }
    begin(&p, n, perspective);
    for (uint32_t i = 1; i < n; i++) {
        if (prng_pick(&p, 5) == 0) /* the one before again: equal keys everywhere */
            world.instance[i].mesh = world.instance[i - 1].mesh;
        if (prng_pick(&p, 6) == 0)
            world.instance[i].depth_state = &states[prng_pick(&p, sizeof states / sizeof states[0])];
    }
    struct zs_config c = picture_config(prng_range(&p, 33, 330), prng_range(&p, 10, 130), depths[mapping]);
    c.depth_bits = (uint8_t)prng_range(&p, 8, 16);
    c.subpixel_bits = prng_pick(&p, 2) ? 8 : 4;
    c.fast = NULL;
    struct picture plain = picture_draw(&c, &world.scene, &world.camera);
    uint32_t hidden = 0;
    assert_int_equal(plain.err, ZS_OK);
    for (int k = 0; k < 3; k++) {
        const uint32_t list = prng_pick(&p, 2) ? FAST_ALL : prng_pick(&p, FAST_ALL + 1) | FAST_TILES;
        c.fast = fast_of(list);
        c.strip_h = (uint16_t)prng_range(&p, 1, 40);
        if (k == 2) {
            c.max_tris = (uint16_t)prng_range(&p, 1, 5);
            c.max_verts = (uint16_t)prng_range(&p, 3, 12);
        }
        struct picture got = picture_draw(&c, &world.scene, &world.camera);
        if (!picture_same(&plain, &got, "hidden"))
            fail_msg("seed %llu", (unsigned long long)seed);
        hidden += got.stats.tris_hidden > 0;
        setups_saved += got.stats.tris_hidden;
        untested += got.stats.pixels_untested > 0;
        if (!(list & FAST_TOUCH) && got.stats.pixels_untested)
            fail_msg("seed %llu: drawn without a test", (unsigned long long)seed);
        picture_free(&got);
    }
    picture_free(&plain);
    return hidden;
}

static void the_frame_is_the_same(void **state)
{
    uint32_t some = 0;
    for (uint64_t seed = 1; seed <= 1500; seed++)
        some += hidden_case(seed);
    print_message("hidden: triangles were skipped in %u of 4500 frames\n", some);
    print_message("%u set-ups saved; pixels without a test in %u frames\n", setups_saved, untested);
    assert_true(some > 2000 && untested > 1000);
}

/* Eight layers that fill the frame, front to back, back to front and mixed: set up and tested about as one. */
static void layers_cost_one(void **state)
{
    static const uint8_t order[3][8] = { { 0, 1, 2, 3, 4, 5, 6, 7 }, { 7, 6, 5, 4, 3, 2, 1, 0 },
                                         { 3, 6, 0, 5, 7, 1, 4, 2 } };
    for (int o = 0; o < 3; o++) {
        struct prng p = { 5 };
        begin(&p, 8, 1);
        for (uint32_t i = 0; i < 8; i++) {
            int32_t z = 1000;
            for (int k = 0; k < order[o][i]; k++)
                z = z * 5 / 4;
            static const int sign[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
            for (int k = 0; k < 4; k++) {
                world.pos[i][k][0] = (int16_t)(sign[k][0] * 4 * z);
                world.pos[i][k][1] = (int16_t)(sign[k][1] * 4 * z);
                world.pos[i][k][2] = (int16_t)(-z + sign[k][0] * z / 100);
            }
            world.mesh[i].tri = halves[0];
        }
        struct zs_config c = picture_config(320, 120, &zs_depth_float);
        c.strip_h = 24;
        struct picture with = picture_draw(&c, &world.scene, &world.camera);
        c.fast = NULL;
        struct picture without = picture_draw(&c, &world.scene, &world.camera);
        c.fast = fast_of(FAST_TILES);
        struct picture alone = picture_draw(&c, &world.scene, &world.camera);
        assert_true(picture_same(&without, &with, "layers"));
        assert_true(picture_same(&without, &alone, "layers, nothing else"));
        assert_int_equal(without.stats.pixels_tested, 8 * 320 * 120);
        assert_int_equal(with.stats.pixels_tested, 320 * 120);
        assert_int_equal(alone.stats.pixels_tested, 320 * 120);
        PICTURES_FREE(&alone, &with, &without);
    }
}

/* Instances behind a wall that comes first are not transformed; those beside it and before it are. */
static void instances_behind_a_wall(void **state)
{
    for (int off = 0; off < 2; off++) {
        struct prng p = { 7 };
        begin(&p, 10, 1);
        for (uint32_t i = 0; i < 10; i++) {
            static const int sign[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
            const int32_t z = i == 0 ? 1000 : i == 9 ? 500 : 3000, half = i == 0 ? 2000 : 20;
            for (int k = 0; k < 4; k++) {
                world.pos[i][k][0] = (int16_t)(sign[k][0] * half + (i ? ((int)i - 5) * 60 : 0));
                world.pos[i][k][1] = (int16_t)(sign[k][1] * half);
                world.pos[i][k][2] = (int16_t)-z;
            }
            world.mesh[i].tri = halves[0];
            world.mesh[i].radius = (uint16_t)(half * 3 / 2 + 1);
            world.mesh[i].center[0] = (int16_t)(i ? ((int)i - 5) * 60 : 0);
            world.mesh[i].center[2] = (int16_t)-z;
        }
        struct zs_config c = picture_config(320, 240, &zs_depth_float);
        c.strip_h = 24;
        c.fast = fast_of(off ? FAST_ALL & ~FAST_TILES : FAST_ALL);
        struct picture p0 = picture_draw(&c, &world.scene, &world.camera);
        assert_int_equal(p0.err, ZS_OK);
        assert_int_equal(p0.stats.instances_hidden, off ? 0 : 8);
        assert_int_equal(p0.stats.verts_transformed, off ? 40 : 8);
        assert_int_equal(p0.stats.tris_in, p0.stats.tris_drawn + p0.stats.tris_frustum);
        picture_free(&p0);
    }
}

/* Small instances in the very bucket of a wall that comes after them: they stay, also where the wall is known already,
 * in walks after the first. */
static void equal_keys_hide_nothing(void **state)
{
    uint32_t passes = 0;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        struct prng p = { seed };
        begin(&p, 10, 1);
        for (uint32_t i = 0; i < 10; i++) {
            static const int sign[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
            const int32_t z = 3000 + (i == 9 ? 0 : prng_range(&p, -40, 40)), half = i == 9 ? 9000 : 8;
            const int32_t x = i == 9 ? 0 : ((int)i - 4) * 350, y = i == 9 ? 0 : prng_range(&p, -1200, 1200);
            for (int k = 0; k < 4; k++) {
                world.pos[i][k][0] = (int16_t)(sign[k][0] * half + x);
                world.pos[i][k][1] = (int16_t)(sign[k][1] * half * (i == 9 ? 1 : 4) + y);
                world.pos[i][k][2] = (int16_t)-z;
            }
            world.mesh[i].tri = halves[0];
            world.mesh[i].radius = (uint16_t)(half * 4 + 6);
            world.mesh[i].center[0] = (int16_t)x;
            world.mesh[i].center[1] = (int16_t)y;
            world.mesh[i].center[2] = (int16_t)-z;
        }
        struct zs_config c = picture_config(320, 240, seed % 2 ? &zs_depth_recip : &zs_depth_e3m13);
        c.strip_h = 24;
        c.depth_bits = 8;
        c.fast = NULL;
        struct picture plain = picture_draw(&c, &world.scene, &world.camera);
        c.fast = fast_all;
        c.max_tris = (uint16_t)prng_range(&p, 2, 6);
        c.max_verts = (uint16_t)(3 * c.max_tris);
        struct picture small = picture_draw(&c, &world.scene, &world.camera);
        assert_true(picture_same(&plain, &small, "equal keys"));
        passes += small.stats.passes;
        PICTURES_FREE(&plain, &small);
    }
    assert_true(passes > 60);
}

/* Instance n: a rectangle that faces the eye, in mesh steps. */
static void rectangle(uint32_t n, int32_t x0, int32_t x1, int32_t y0, int32_t y1, int32_t z)
{
    const int32_t at[4][2] = { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
    for (int k = 0; k < 4; k++) {
        world.pos[n][k][0] = (int16_t)at[k][0];
        world.pos[n][k][1] = (int16_t)at[k][1];
        world.pos[n][k][2] = (int16_t)-z;
    }
    world.mesh[n].tri = halves[0];
    world.mesh[n].radius = (uint16_t)((x1 - x0 + y1 - y0) / 2 + 2);
    world.mesh[n].center[0] = (int16_t)((x0 + x1) / 2);
    world.mesh[n].center[1] = (int16_t)((y0 + y1) / 2);
    world.mesh[n].center[2] = (int16_t)-z;
}

/* Behind a wall that covers one half of the frame, left, right, upper or lower, and in the other half before another
 * one, or in its very bucket: what is half hidden is drawn. */
static void half_hidden_is_drawn(void **state)
{
    uint32_t hidden = 0, passes = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        static const int32_t far = 16000;
        struct prng p = { seed };
        const uint32_t side = (uint32_t)seed % 4, walls = 1 + prng_pick(&p, 2);
        const int32_t x = side < 2 ? 0 : prng_range(&p, -900, 900), y = side < 2 ? prng_range(&p, -700, 700) : 0;
        begin(&p, 2 + walls, 1);
        /* first in the scene or last: the walls are known in its later walks, or always */
        const uint32_t thing = prng_pick(&p, 2) ? 0 : 1 + walls, wall = thing ? 0 : 1;
        const int32_t z = prng_range(&p, 2500, 9000);
        rectangle(thing, x - 400, x + 400, y - 300, y + 300, z);
        rectangle(wall, side == 1 ? 0 : -far, side == 0 ? 0 : far, side == 3 ? 0 : -far, side == 2 ? 0 : far, 1500);
        if (walls > 1)
            rectangle(wall + 1, side == 0 ? 0 : -far, side == 1 ? 0 : far, side == 2 ? 0 : -far, side == 3 ? 0 : far,
                      z + prng_range(&p, -15, 15));
        rectangle(wall + walls, 300, 320, 300, 320, 4000); /* one more, so that pools fill */
        struct zs_config c = picture_config(320, 240, seed % 3 ? &zs_depth_recip : &zs_depth_e3m13);
        c.strip_h = (uint16_t)prng_range(&p, 8, 40);
        c.depth_bits = 8;
        c.fast = NULL;
        struct picture plain = picture_draw(&c, &world.scene, &world.camera);
        c.fast = fast_all;
        if (prng_pick(&p, 2)) {
            c.max_tris = (uint16_t)prng_range(&p, 2, 5);
            c.max_verts = (uint16_t)(3 * c.max_tris);
        }
        struct picture got = picture_draw(&c, &world.scene, &world.camera);
        if (!picture_same(&plain, &got, "half hidden"))
            fail_msg("seed %llu", (unsigned long long)seed);
        hidden += got.stats.instances_hidden;
        passes += got.stats.passes;
        PICTURES_FREE(&plain, &got);
    }
    print_message("%u instances hidden, %u walks\n", hidden, passes);
    assert_true(hidden > 50 && passes > 800);
}

/* A sphere that reaches before the near plane: what it holds may lie before the wall. */
static void a_sphere_before_near_hides_nothing(void **state)
{
    for (uint64_t seed = 1; seed <= 60; seed++) {
        struct prng p = { seed };
        const int32_t x = prng_range(&p, -200, 200), y = prng_range(&p, -200, 200), z = prng_range(&p, 100, 1200);
        const int32_t middle = prng_range(&p, 3000, 9000);
        begin(&p, 2, 1);
        rectangle(0, -9000, 9000, -9000, 9000, 1500);
        rectangle(1, x - 10, x + 10, y - 10, y + 10, z);
        world.mesh[1].center[2] = (int16_t)-middle;
        world.mesh[1].radius = (uint16_t)(middle + prng_range(&p, -30, 60));
        struct zs_config c = picture_config(320, 240, seed % 2 ? &zs_depth_recip : &zs_depth_e4m12);
        struct picture got = picture_draw(&c, &world.scene, &world.camera);
        c.fast = NULL;
        struct picture plain = picture_draw(&c, &world.scene, &world.camera);
        if (!picture_same(&plain, &got, "before near"))
            fail_msg("seed %llu", (unsigned long long)seed);
        assert_int_equal(got.stats.instances_hidden, 0);
        PICTURES_FREE(&plain, &got);
    }
}

/* ---- Sides and keys at their margins ----------------------------------------------------------------------- */

#define MARGIN_W 2048
#define MARGIN_H 128

static struct {
    struct lone wall;
    struct shape bits; /* one small triangle for each row, or for some tiles */
    struct zs_material bit;
    struct zs_instance instance[2]; /* the bits, the wall */
    struct zs_scene scene;
} edge;

static void edge_begin(const int16_t (*wall)[3], zs_uq16_16 scale)
{
    lone_set(&edge.wall, wall, 3, scale);
    shape_begin(&edge.bits);
    edge.bit = edge.wall.material;
    edge.instance[0] = edge.instance[1] = edge.wall.instance;
    edge.instance[0].mesh = &edge.bits.mesh;
    edge.instance[0].material = &edge.bit;
    edge.scene = edge.wall.scene;
    edge.scene.instance = edge.instance;
    edge.scene.n_instances = 2;
}

static void edge_bit(const int32_t corner[3][3])
{
    static const int32_t up[3] = { 0, 0, 1 };
    const uint32_t v = edge.bits.mesh.n_verts;
    for (int k = 0; k < 3; k++)
        (void)shape_vertex(&edge.bits, corner[k], up);
    shape_tri(&edge.bits, v, v + 1u, v + 2u);
}

/* The frame by tiles is the frame without. Returns its picture, to be freed. */
static struct picture edge_same(struct zs_config *c, const struct zs_camera *camera, uint64_t seed)
{
    c->fast = NULL;
    struct picture plain = picture_draw(c, &edge.scene, camera);
    c->fast = fast_of(FAST_TILES);
    struct picture got = picture_draw(c, &edge.scene, camera);
    if (!picture_same(&plain, &got, "at the margin"))
        fail_msg("seed %llu", (unsigned long long)seed);
    picture_free(&plain);
    return got;
}

/* A wall whose left or right side crosses the frame at 16 columns a row. It begins 370 rows above: its slope is known
 * to 1/256, so a column to two pixels. What lies behind it, in the one column of a tile that the wall may just not
 * cover, is drawn. */
static void a_long_side_covers_no_more_than_it_does(void **state)
{
    uint32_t beside = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= 24; seed++) {
        struct prng p = { seed };
        const int32_t sign = seed % 2 ? 1 : -1; /* -1: mirrored, the right side */
        const int32_t ax = -7024 * 4 + prng_range(&p, -90, 90), ay = -434 * 4, bx = 992 * 4 + prng_range(&p, -90, 90),
                      by = 67 * 4; /* quarters of a pixel, from the frame's middle */
        const int16_t wall[3][3] = { { (int16_t)(sign * ax), (int16_t)-ay, 0 },
                                     { (int16_t)(sign * bx), (int16_t)-by, 0 },
                                     { (int16_t)(sign * 6976 * 4), (int16_t)-ay, 0 } };
        edge_begin(wall, 64 * ZS_Q16_ONE);
        for (int32_t row = 0; row < MARGIN_H; row++) {
            const int32_t y = (row - MARGIN_H / 2) * 4 + 2, x = ax + (bx - ax) * (y - ay) / (by - ay);
            const int32_t tile = (x + MARGIN_W * 2) / 128, at = tile * 32 - MARGIN_W / 2;
            const int32_t down = 32 * (row - MARGIN_H / 2); /* 1/32 px */
            const int32_t corner[3][3] = { { sign * (32 * at + 7), -(down + 7), 0 },
                                           { sign * (32 * at + 28), -(down + 16), 0 },
                                           { sign * (32 * at + 7), -(down + 26), 0 } };
            if (at >= -MARGIN_W / 2 && at < MARGIN_W / 2)
                edge_bit(corner);
        }
        shape_end(&edge.bits);
        edge.bits.mesh.scale = 8 * ZS_Q16_ONE;
        edge.instance[0].pose.pos[2] = -30000;
        edge.instance[1].pose.pos[2] = -1000;
        struct zs_config c = picture_config(MARGIN_W, MARGIN_H, &zs_depth_linear);
        c.strip_h = 1;
        const struct zs_camera camera = pixel_camera(MARGIN_H, 0);
        struct picture got = edge_same(&c, &camera, seed);
        for (int32_t i = 0; i < MARGIN_W * MARGIN_H; i++)
            beside += got.key[i] > 20000 && got.key[i] != ZS_DEPTH_CLEAR;
        hidden += got.stats.tris_hidden;
        picture_free(&got);
    }
    print_message("%u drawn beside the wall, %u hidden behind it\n", beside, hidden);
    assert_true(beside > 1000 && hidden > 30);
}

/* A wall so wide that its keys, as drawn, rise above that of its farthest corner, by up to 0.03 of a bucket: small
 * triangles of the keys that it is drawn with, which come first, stay. */
static void keys_above_the_farthest_corner_count(void **state)
{
    uint32_t shown = 0, hidden = 0;
    for (int32_t off = 0; off < 1024; off += 20) { /* 1/1024 bucket: through all of one */
        const int16_t z = (int16_t)(-5000 - off), rise = 34; /* a gradient just above half of its unit */
        const int16_t wall[3][3] = { { -4 * 2056, 4 * 5, z }, { 4 * 2132, 4 * 5, (int16_t)(z - rise) },
                                     { -4 * 2056, -4 * 7996, z } }; /* quarters of a pixel */
        edge_begin(wall, 1024 * ZS_Q16_ONE);
        for (int32_t k = 0; k < 24; k++) {
            const int32_t x = 4 * (2032 - 32 * k), far = z - 60 * k - 50;
            const int32_t corner[3][3] = { { x, 8, far }, { x + 20, 8, far }, { x, -12, far } };
            edge_bit(corner);
        }
        shape_end(&edge.bits);
        edge.bits.mesh.scale = 1024 * ZS_Q16_ONE;
        struct zs_config c = picture_config(4096, 8, &zs_depth_linear);
        c.depth_bits = 8;
        struct zs_camera camera;
        assert_int_equal(zs_camera_orthographic(&camera, 8 * 4096, 1, 1 << 28), ZS_OK);
        edge.bit.rgb.r = 255;
        struct picture got = edge_same(&c, &camera, (uint64_t)off);
        for (int32_t i = 0; i < 4096 * 8; i++)
            shown += got.color[i] != got.color[0];
        hidden += got.stats.tris_hidden;
        picture_free(&got);
    }
    print_message("%u pixels before the wall, %u triangles hidden\n", shown, hidden);
    assert_true(shown > 1000 && hidden > 300);
}

/* Linear keys under perspective in a slab that is thin beside its distance: a pixel's key may be half a bucket beside
 * those of the vertices, so that no margin tells what is hidden. */
static void thin_begin(struct prng *p, uint32_t n, int32_t far)
{
    static uint8_t lo[QUADS_MAX][4][3];
    memset(lo, 0, sizeof lo);
    for (uint32_t i = 0; i < n; i++)
        quad(p, i, prng_range(p, 4000, 16000), 0, 0);
    begin(p, n, 1);
    assert_int_equal(zs_camera_perspective(&world.camera, 11, 60, 1, 2 * far), ZS_OK);
    for (uint32_t i = 0; i < n; i++) {
        for (int k = 0; k < 4; k++) /* most are parallel to the screen, less than a bucket apart */
            lo[i][k][2] = k && prng_pick(p, 8) ? lo[i][0][2] : (uint8_t)prng_pick(p, 16);
        world.mesh[i].scale = ZS_Q16_ONE;
        world.mesh[i].pos_lo = (const uint8_t(*)[3])lo[i];
        world.instance[i].pose.pos[2] = -far;
    }
}

static uint32_t thin_drawn(struct prng *p, uint64_t seed)
{
    static const struct zs_method *const methods[2] = { NULL, &zs_method_hiz };
    struct zs_config c = picture_config(80, 60, &zs_depth_linear);
    c.fast = NULL;
    struct picture plain = picture_draw(&c, &world.scene, &world.camera);
    assert_int_equal(plain.err, ZS_OK);
    for (int k = 0; k < 4; k++) {
        struct zs_config other = c;
        other.method = methods[k / 2];
        other.strip_h = (uint16_t)prng_range(p, 8, 40);
        other.fast = k < 2 ? fast_of(k ? FAST_ALL : FAST_TILES) : NULL;
        struct picture got = picture_draw(&other, &world.scene, &world.camera);
        if (!picture_same(&plain, &got, k < 2 ? "tiles" : "hiz"))
            fail_msg("seed %llu", (unsigned long long)seed);
        picture_free(&got);
    }
    const uint32_t covered = plain.covered;
    picture_free(&plain);
    return covered;
}

static void keys_of_a_thin_slab_hide_nothing(void **state)
{
    uint32_t shown = 0;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        struct prng p = { seed };
        const int32_t far = (1 << 24) - prng_range(&p, 60000, 1 << 21), thick = prng_range(&p, 300, 900);
        thin_begin(&p, 4 + prng_pick(&p, QUADS_MAX - 3), far); /* camera units are 1/64 of a unit */
        world.camera.z_near = ((int64_t)far - thick) * 65536;
        world.camera.z_far = ((int64_t)far + thick) * 65536;
        shown += thin_drawn(&p, seed) > 1000;
    }
    assert_true(shown > 150);
    /* A pair that is one camera unit apart, the farther one first: half a bucket, and the keys differ. */
    struct prng p = { 1 };
    thin_begin(&p, 2, 15190929);
    for (uint32_t i = 0; i < 2; i++) {
        static uint8_t part[2][4][3];
        for (int k = 0; k < 4; k++) {
            world.pos[i][k][0] = k == 1 || k == 2 ? 30000 : -30000;
            world.pos[i][k][1] = k > 1 ? 30000 : -30000;
            part[i][k][2] = i ? 180 : 176; /* 972219412 and 972219411 units from the eye */
        }
        world.mesh[i].tri = halves[0];
        world.mesh[i].radius = 42428;
        world.mesh[i].pos_lo = (const uint8_t(*)[3])part[i];
    }
    world.camera.z_near = (int64_t)972161463 * 1024;
    world.camera.z_far = (int64_t)(972161463 + 101252) * 1024;
    assert_int_equal(thin_drawn(&p, 0), 80 * 60);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(the_frame_is_the_same), cmocka_unit_test(layers_cost_one),
                                        cmocka_unit_test(instances_behind_a_wall),
                                        cmocka_unit_test(equal_keys_hide_nothing),
                                        cmocka_unit_test(half_hidden_is_drawn),
                                        cmocka_unit_test(a_sphere_before_near_hides_nothing),
                                        cmocka_unit_test(a_long_side_covers_no_more_than_it_does),
                                        cmocka_unit_test(keys_above_the_farthest_corner_count),
                                        cmocka_unit_test(keys_of_a_thin_slab_hide_nothing) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
