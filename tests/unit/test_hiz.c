/* The hierarchical depth buffer: colours and keys are the depth buffer's, bit for bit, for any scene, pools, strips
 * and accelerators, and with damage tracking; and hidden triangles, pixels and instances are skipped.
 *
 * The reference is zs_render without a method and without accelerators, in one strip.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "../lab/fuzz/world.h"
#include "own.h"
#include "picture.h"
#include "scenes.h"
#include "zs_method.h"

static const struct zs_method *const methods[] = { &zs_method_hiz, &zs_method_hiz_corner, &zs_method_hiz_vertex };
#define ONE(name_, ...) &zs_depth_##name_,
static const struct zs_depth *const mappings[] = { ZS_DEPTH_EACH(ONE) };
#undef ONE

/* Any way to draw the same frame. */
static void any_way(struct prng *p, struct zs_config *c)
{
    picture_any_way(p, c, 1, 3);
    c->method = methods[prng_pick(p, 3)];
}

static struct zs_config any_config(struct prng *p, int32_t w, int32_t h)
{
    struct zs_config c = picture_config(w, h, mappings[prng_pick(p, sizeof mappings / sizeof mappings[0])]);
    c.varyings = ZS_VARYINGS_MAX;
    c.depth_bits = (uint8_t)(prng_pick(p, 3) ? 16 : prng_range(p, 8, 15));
    c.fast = NULL;
    return c;
}

static void add(struct zs_stats *sum, const struct zs_stats *s)
{
    sum->pixels_tested += s->pixels_tested;
    sum->pixels_untested += s->pixels_untested;
    sum->pixels_hidden += s->pixels_hidden;
    sum->tris_hidden += s->tris_hidden;
    sum->instances_hidden += s->instances_hidden;
    sum->passes += s->passes > s->strips;
}

/* ---- Random worlds ---------------------------------------------------------------------------- */

static struct zs_stats worlds;
static unsigned drawn;

/* The frame without a method, and three ways to draw it by one: alike, or refused alike. sum: of what was drawn. */
static int three_ways(struct prng *p, struct zs_config *c, const struct zs_scene *scene,
                      const struct zs_camera *camera, struct zs_stats *sum, const char *name)
{
    struct picture want = picture_draw(c, scene, camera);
    int right = 1;
    for (int k = 0; k < 3 && right; k++) {
        any_way(p, c);
        struct picture is = picture_draw(c, scene, camera);
        right = want.err == is.err && (want.err || picture_same(&want, &is, name));
        if (!is.err)
            add(sum, &is.stats);
        drawn += !is.err;
        picture_free(&is);
    }
    picture_free(&want);
    return right;
}

static int world_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    world_make(&w, &p, prng_pick(&p, 4) ? 0 : 40);
    struct zs_config c = any_config(&p, prng_range(&p, 1, 140), prng_range(&p, 1, 90));
    c.max_tris = 4000;
    c.max_verts = 8000;
    const int right = three_ways(&p, &c, &w.scene, &w.camera, &worlds, "a world");
    world_free(&w);
    return right;
}

static void worlds_are_the_same(void **state)
{
    (void)state;
    memset(&worlds, 0, sizeof worlds);
    drawn = 0;
    CASES(world_case, 1200);
    print_message("%u frames: of %u pixels %u hidden, %u untested; %u triangles, %u instances hidden; small pools %u\n",
                  drawn, worlds.pixels_tested, worlds.pixels_hidden, worlds.pixels_untested, worlds.tris_hidden,
                  worlds.instances_hidden, worlds.passes);
    if (cases_all())
        assert_true(drawn > 1200 && worlds.pixels_hidden > 100000 && worlds.pixels_untested > 10000 &&
                    worlds.tris_hidden > 1000 && worlds.passes > 300);
}

/* ---- Walls: large quads at a few depths, in any order, with any state -------------------------- */

#define WALLS 14

static const struct zs_depth_state states[] = {
    { .func = ZS_DEPTH_ALWAYS },
    { .func = ZS_DEPTH_ALWAYS, .read_only = 1 },
    { .func = ZS_DEPTH_LESS_EQUAL },
    { .read_only = 1 },
    { .bias = -300 },
    { .bias = 300 },
    { .func = ZS_DEPTH_LESS_EQUAL, .bias = -5, .slope_bias = 90 }
};
static int16_t wall_pos[WALLS][4][3];
static const uint16_t wall_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static struct zs_mesh wall_mesh[WALLS];
static struct zs_material wall_material[WALLS];
static struct zs_instance wall[WALLS];

/* n walls; odd: some with states and shaders that read the picture. */
static struct zs_scene walls_make(struct prng *p, uint32_t n, int odd)
{
    static const int sign[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    for (uint32_t i = 0; i < n; i++) {
        const int32_t z = prng_range(p, 1500, 9000), half = prng_range(p, 100, prng_pick(p, 2) ? 8000 : 800),
                      tilt = prng_pick(p, 3) ? prng_pick(p, 2) ? 0 : z / 20 : z / 2;
        const int32_t x = prng_range(p, -z / 3, z / 3), y = prng_range(p, -z / 3, z / 3);
        for (int k = 0; k < 4; k++) {
            wall_pos[i][k][0] = (int16_t)(x + sign[k][0] * half);
            wall_pos[i][k][1] = (int16_t)(y + sign[k][1] * half);
            wall_pos[i][k][2] = (int16_t)(-z + (tilt ? prng_range(p, -tilt, tilt) : 0));
        }
        wall_mesh[i] = (struct zs_mesh){ .pos = (const int16_t(*)[3])wall_pos[i], .tri = wall_tri, .n_verts = 4,
                                         .n_tris = 2, .center = { (int16_t)x, (int16_t)y, (int16_t)-z },
                                         .radius = (uint16_t)(half * 3 / 2 + tilt + 2) };
        wall_material[i] = (struct zs_material){ .shader = odd && prng_pick(p, 6) == 0 ? &glass_shader : &zs_shade_raw,
                                                 .rgb = { (uint8_t)(30 + 16 * i), (uint8_t)(i * 77), 99 },
                                                 .cull = ZS_CULL_NONE };
        wall[i] = (struct zs_instance){ .mesh = &wall_mesh[i > 0 && prng_pick(p, 5) == 0 ? i - 1 : i],
                                        .material = &wall_material[i] };
        if (odd && prng_pick(p, 4) == 0)
            wall[i].depth_state = &states[prng_pick(p, sizeof states / sizeof states[0])];
    }
    return (struct zs_scene){ .instance = wall, .n_instances = n, .background = 0x1234 };
}

static struct zs_camera walls_camera(const struct zs_config *c, struct prng *p)
{
    struct zs_camera camera;
    const int flat = c->depth == &zs_depth_linear && prng_pick(p, 2);
    if (flat ? zs_camera_orthographic(&camera, 6000, 100, 20000)
             : zs_camera_perspective(&camera, ZS_DEGREES(60), c->height, 100, 20000))
        abort();
    return camera;
}

static struct zs_stats walls;

static int walls_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_config c = any_config(&p, prng_range(&p, 1, 330), prng_range(&p, 1, 130));
    const struct zs_camera camera = walls_camera(&c, &p);
    const struct zs_scene scene = walls_make(&p, (uint32_t)prng_range(&p, 2, WALLS), (int)prng_pick(&p, 2));
    const unsigned before = drawn;
    return three_ways(&p, &c, &scene, &camera, &walls, "walls") && (drawn == before + 3 || case_wrong("refused"));
}

static void walls_are_the_same(void **state)
{
    (void)state;
    memset(&walls, 0, sizeof walls);
    CASES(walls_case, 1200);
    print_message("of %u pixels %u hidden, %u untested; %u triangles, %u instances hidden; small pools in %u frames\n",
                  walls.pixels_tested, walls.pixels_hidden, walls.pixels_untested, walls.tris_hidden,
                  walls.instances_hidden, walls.passes);
    if (cases_all())
        assert_true(walls.pixels_hidden > 2000000 && walls.pixels_untested > 2000000 && walls.tris_hidden > 5000 &&
                    walls.instances_hidden > 100);
}

/* ---- One renderer, several frames, damage tracking --------------------------------------------- */

#define SHOW_W 150
#define SHOW_H 90
static uint8_t shown[SHOW_W * SHOW_H * 2];

static int show(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    for (uint32_t y = 0; y < s->h; y++)
        memcpy(shown + ((s->y + y) * SHOW_W + s->dirty_x) * 2u, s->px + (y * SHOW_W + s->dirty_x) * 2u,
               s->dirty_w * 2u);
    return 0;
}

static unsigned clean, frames_shown;

static int frames_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_config c = any_config(&p, SHOW_W, SHOW_H), plain = c;
    const struct zs_camera camera = walls_camera(&c, &p);
    struct zs_scene scene = walls_make(&p, WALLS, (int)prng_pick(&p, 2));
    any_way(&p, &c);
    uint32_t *memory = malloc(ZS_DAMAGE_WORDS(WALLS, SHOW_H, 1) * sizeof *memory);
    void *arena = malloc(zs_arena_bytes(&c));
    struct zs_renderer *r = malloc(sizeof *r);
    const struct zs_sink sink = { .submit = show };
    int right = memory && arena && r && zs_init(r, &c, arena, zs_arena_bytes(&c)) == ZS_OK;
    if (right && prng_pick(&p, 4))
        right = zs_damage_track(r, memory, WALLS) == ZS_OK && zs_damage_columns(r, (int)prng_pick(&p, 2)) == ZS_OK;
    for (int k = 0; k < 5 && right; k++) {
        if (k)
            wall[prng_pick(&p, WALLS)].pose.pos[prng_pick(&p, 3)] += prng_range(&p, -300, 300);
        struct picture want = picture_draw(&plain, &scene, &camera);
        right = !want.err && zs_render(r, &scene, &camera, &sink) == ZS_OK;
        clean += zs_frame_stats(r)->strips_clean;
        frames_shown++;
        for (int32_t i = 0; i < SHOW_W * SHOW_H && right; i++)
            right = want.color[i] == (shown[2 * i] << 8 | shown[2 * i + 1]) ||
                    case_wrong("frame %d, pixel (%d, %d)", k, i % SHOW_W, i / SHOW_W);
        picture_free(&want);
    }
    free(memory);
    free(arena);
    free(r);
    return right;
}

/* ---- What it skips ----------------------------------------------------------------------------- */

/* The bench's eight layers: from front to back all but the first are skipped before set-up; mixed, less is tested than
 * from back to front. A stronger test of pieces skips no less. */
static void layers_are_skipped(void **state)
{
    static const struct demo *const order[] = { &demo_layers_ftb, &demo_layers_mixed, &demo_layers_btf };
    static struct demo_frame frame;
    (void)state;
    for (int o = 0; o < 3; o++) {
        uint32_t compared[3];
        order[o]->pose(&frame, 0, 320, 240);
        struct zs_config c = picture_config(320, 240, order[o]->depth);
        c.strip_h = 24;
        for (int m = 0; m < 3; m++) {
            c.method = methods[m];
            struct picture is = picture_draw(&c, &frame.scene, &frame.camera);
            assert_int_equal(is.err, ZS_OK);
            compared[m] = is.stats.pixels_tested - is.stats.pixels_hidden - is.stats.pixels_untested;
            if (o == 0) {
                assert_true(is.stats.pixels_untested > 320 * 240 * 8 / 10);
                assert_true(is.stats.pixels_tested < 320 * 240 * 12 / 10);
                assert_true(is.stats.tris_hidden > 7 * 2 * 8);
            }
            if (o == 1)
                assert_true(compared[m] < 320 * 240 * 5);
            if (o == 2)
                assert_true(is.stats.pixels_hidden == 0 && compared[m] > 320 * 240 * 6);
            picture_free(&is);
        }
        assert_true(compared[0] <= compared[1] && compared[0] <= compared[2]);
    }
}

/* Quads that fill the frame, three in each bucket, each three one bucket nearer than those before: the first of three
 * is seen, and the others have bounds looked at. With 8 bits and depths of 0 .. 255 units of 256, the key is the depth,
 * rounded. */
static void one_bucket_nearer_is_seen(void **state)
{
    static const int sign[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    static const int32_t off[WALLS] = { 0, 30, -30, 60, -60, 90, -90, 120, 0, 0, 0, 0, 0, 120 }; /* of 256 */
    struct prng p = { 1 };
    struct zs_camera camera;
    (void)state;
    assert_int_equal(zs_camera_orthographic(&camera, 100 * 256, 0, 255 * 256), ZS_OK);
    const struct zs_scene scene = walls_make(&p, WALLS, 0);
    for (int i = 0; i < WALLS; i++) {
        for (int k = 0; k < 4; k++) {
            wall_pos[i][k][0] = (int16_t)(sign[k][0] * 30000);
            wall_pos[i][k][1] = (int16_t)(sign[k][1] * 30000);
            wall_pos[i][k][2] = (int16_t)-((100 - i / 3) * 128 + off[i] / 2);
        }
        wall_mesh[i].scale = 2 * ZS_Q16_ONE;
        memset(wall_mesh[i].center, 0, sizeof wall_mesh[i].center);
        wall_mesh[i].radius = 65535;
        wall[i].mesh = &wall_mesh[i];
    }
    for (uint32_t n = 1; n <= WALLS; n++)
        for (int m = 0; m < 3; m++) {
            struct zs_scene some = scene;
            struct zs_config c = picture_config(100, 100, &zs_depth_linear);
            some.n_instances = n;
            c.depth_bits = 8;
            c.method = methods[m];
            struct picture is = picture_draw(&c, &some, &camera);
            assert_int_equal(is.stats.tris_hidden, 2 * (n - 1 - (n - 1) / 3));
            const struct zs_rgb rgb = wall_material[(n - 1) / 3 * 3].rgb;
            for (int i = 0; i < 100 * 100; i++) {
                assert_int_equal(is.key[i], 100 - (n - 1) / 3);
                assert_int_equal(is.color[i], zs_rgb565(rgb.r, rgb.g, rgb.b));
            }
            picture_free(&is);
        }
}

/* A wall in front, a curtain far behind it that is drawn always, and a quad between them, which is seen in front of the
 * curtain: also where a pool is full between triangles of the curtain, while keys of the wall are still there. */
static void what_is_drawn_always_hides_no_more(void **state)
{
    enum { SLATS = 16 };
    static int16_t pos[2 * SLATS + 2][3];
    static uint16_t slat[2 * SLATS][3];
    static const struct zs_depth_state always = { .func = ZS_DEPTH_ALWAYS };
    struct prng p = { 1 };
    struct zs_camera camera;
    (void)state;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 64, 100, 20000), ZS_OK);
    struct zs_scene scene = walls_make(&p, 3, 0);
    static const int32_t z[3] = { 2000, 9000, 4000 }, half[3] = { 9000, 9000, 200 };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            wall_pos[i][k][0] = (int16_t)((k == 1 || k == 2 ? half[i] : -half[i]) + (i == 2 ? 2000 : 0));
            wall_pos[i][k][1] = (int16_t)(k >= 2 ? half[i] : -half[i]);
            wall_pos[i][k][2] = (int16_t)-z[i];
        }
        wall_mesh[i].center[0] = (int16_t)(i == 2 ? 2000 : 0);
        wall_mesh[i].center[1] = 0;
        wall_mesh[i].center[2] = (int16_t)-z[i];
        wall_mesh[i].radius = (uint16_t)(half[i] * 3 / 2);
        wall[i].mesh = &wall_mesh[i];
    }
    for (int v = 0; v < 2 * SLATS + 2; v++) {
        pos[v][0] = (int16_t)(-9000 + 18000 / SLATS * (v / 2));
        pos[v][1] = (int16_t)(v % 2 ? 9000 : -9000);
        pos[v][2] = -9000;
        if (v < 2 * SLATS)
            for (int k = 0; k < 3; k++)
                slat[v][k] = (uint16_t)(v + k);
    }
    wall_mesh[1].pos = (const int16_t(*)[3])pos;
    wall_mesh[1].tri = (const uint16_t(*)[3])slat;
    wall_mesh[1].n_verts = 2 * SLATS + 2;
    wall_mesh[1].n_tris = 2 * SLATS;
    wall[1].depth_state = &always;
    struct zs_config c = picture_config(64, 64, &zs_depth_float);
    c.fast = NULL;
    struct picture want = picture_draw(&c, &scene, &camera);
    c.method = &zs_method_hiz;
    for (uint16_t tris = 1; tris < 40; tris++) {
        c.max_tris = tris;
        struct picture is = picture_draw(&c, &scene, &camera);
        assert_true(picture_same(&want, &is, "a curtain"));
        picture_free(&is);
    }
    picture_free(&want);
}

static void passes_windows_and_a_mapping_without_memory_are_refused(void **state)
{
    static const int16_t corner[3][3] = { { 0, 0, -2000 }, { 900, 0, -2000 }, { 0, 900, -2000 } };
    struct lone l;
    (void)state;
    lone_set(&l, corner, 3, ZS_Q16_ONE);
    struct zs_config c = picture_config(64, 48, &zs_depth_none);
    const struct zs_camera camera = pixel_camera(48, 1);
    for (int m = 0; m < 3; m++) {
        c.method = methods[m];
        assert_int_equal(picture_error(&c, &l.scene, &camera), ZS_ERR_DEPTH);
        struct zs_config with_memory = picture_config(64, 48, &zs_depth_float);
        const struct zs_pass pass = { .scene = &l.scene, .camera = &camera };
        with_memory.method = methods[m];
        struct picture is = picture_passes(&with_memory, &pass, 1);
        assert_int_equal(is.err, ZS_ERR_PASS);
        picture_free(&is);
        /* a window's key grows: bounds of keys would hide what is seen */
        l.material.shader = &zs_shade_window;
        assert_int_equal(picture_error(&with_memory, &l.scene, &camera), ZS_ERR_DEPTH);
        l.material.shader = &zs_shade_raw;
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(worlds_are_the_same),
    cmocka_unit_test(walls_are_the_same),
    CASES_COUNTS(frames_with_damage_are_the_same, frames_case, 300,
                 { "strips clean", &clean, 500 }, { "frames", &frames_shown, 1000 }),
    cmocka_unit_test(layers_are_skipped),
    cmocka_unit_test(one_bucket_nearer_is_seen),
    cmocka_unit_test(what_is_drawn_always_hides_no_more),
    cmocka_unit_test(passes_windows_and_a_mapping_without_memory_are_refused)
};

CASES_MAIN(tests)
