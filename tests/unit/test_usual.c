/* What 0 stands for, macros of the public headers, the light that a scene without one gets, and the end of frames.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "clusters.h"
#include "fast_lists.h"
#include "picture.h"
#include "shapes.h"
#include "zs_shader.h"

/* ---- Macros ---------------------------------------------------------------------------------------------------- */

static const struct {
    zs_turn turn;
    double degrees;
} angles[] = {
#define ANGLE(d) { ZS_DEGREES(d), d }
    ANGLE(0),     ANGLE(1),       ANGLE(45),        ANGLE(90),      ANGLE(180),   ANGLE(270),       ANGLE(359),
    ANGLE(360),   ANGLE(361),     ANGLE(720),       ANGLE(-1),      ANGLE(-45),   ANGLE(-90),       ANGLE(-359),
    ANGLE(-360),  ANGLE(-100000), ANGLE(100000),    ANGLE(22.5),    ANGLE(-22.5), ANGLE(0.001),     ANGLE(-0.001),
    ANGLE(0.003), ANGLE(-0.003),  ANGLE(33.333333), ANGLE(-179.99), ANGLE(60u),   ANGLE(30 + 2 * 4)
};

static void degrees_are_rounded_turns(void **state)
{
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++)
        assert_int_equal(angles[i].turn, (uint16_t)(int32_t)floor(angles[i].degrees * 65536 / 360 + 0.5));
    assert_int_equal(ZS_DEGREES(90), 16384);
}

static void colours_are_the_functions(void **state)
{
    static const struct zs_rgb c = ZS_RGB(0x12a4f6);
    assert_int_equal(c.r, 0x12);
    assert_int_equal(c.g, 0xa4);
    assert_int_equal(c.b, 0xf6);
    static const uint16_t constant = ZS_RGB565(0x12a4f6);
    assert_int_equal(constant, zs_rgb565(0x12, 0xa4, 0xf6));
    for (uint32_t v = 0; v < 256; v++) { /* by hand: nearest */
        const int32_t five = (int32_t)lrint(v * 31 / 255.0), six = (int32_t)lrint(v * 63 / 255.0);
        assert_int_equal(ZS_RGB565(v << 16), five << 11);
        assert_int_equal(ZS_RGB565(v << 8), six << 5);
        assert_int_equal(ZS_RGB565(v), five);
        assert_int_equal(zs_rgb565((uint8_t)v, (uint8_t)v, (uint8_t)v), five << 11 | six << 5 | five);
    }
    assert_int_equal(ZS_VERSION >> 16, ZS_VERSION_STRING[0] - '0');
    assert_int_equal(ZS_VERSION >> 8 & 255, ZS_VERSION_STRING[2] - '0');
    assert_int_equal(ZS_VERSION & 255, ZS_VERSION_STRING[4] - '0');
}

ZS_RENDERER(one, 48, 32, 8, 100, 80, ZS_VARYINGS_SMOOTH);
ZS_RENDERER_BUFFERS(two, 48, 32, 8, 100, 80, ZS_VARYINGS_SMOOTH, 2);

static void a_renderer_by_macro(void **state)
{
    assert_int_equal(ZS_INIT(one), ZS_ERR_NULL); /* no mapping */
    one_config.depth = two_config.depth = &zs_depth_float;
    assert_int_equal(ZS_INIT(one), ZS_OK);
    assert_int_equal(ZS_INIT(two), ZS_OK);
    assert_int_equal(sizeof one_arena, zs_arena_bytes(&one_config));
    assert_int_equal(sizeof two_arena, zs_arena_bytes(&two_config));
    assert_int_equal(sizeof two_arena - sizeof one_arena, 48 * 8 * 2);
    assert_true(one_config.width == 48 && one_config.height == 32 && one_config.strip_h == 8);
    assert_true(one_config.max_tris == 100 && one_config.max_verts == 80 && one_config.varyings == 3);
    one_config.buffers = 2; /* more than the arena was declared for */
    assert_int_equal(ZS_INIT(one), ZS_ERR_ARENA);
    one_config.buffers = 1;
    /* another build: the renderer is not touched */
    struct zs_renderer before = two;
    for (int bit = 0; bit < 32; bit++)
        assert_int_equal(zs_init_build(&two, &two_config, two_arena, sizeof two_arena, ZS_BUILD ^ 1u << bit),
                         ZS_ERR_BUILD);
    assert_memory_equal(&before, &two, sizeof two);
    assert_int_equal(zs_init_build(NULL, &two_config, two_arena, sizeof two_arena, ZS_BUILD), ZS_ERR_NULL);
}

/* ---- Zeros against what they stand for ------------------------------------------------------------------------- */

struct still {
    struct zs_config config;
    struct zs_material material;
    struct zs_mesh mesh;
    struct zs_texture texture;
    struct zs_instance instance;
    struct zs_scene scene;
    struct zs_camera camera;
};

static struct shape ball;
static int16_t uv[SHAPE_VERTS][2];
static const uint16_t texel[16] = { 0xffff, 0xf800, 0x07e0, 0x001f, 0xffe0, 0x07ff, 0xf81f, 0x8410,
                                    0xffff, 0xf800, 0x07e0, 0x001f, 0xffe0, 0x07ff, 0xf81f, 0x8410 };
static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_texture,
                                                   &zs_shade_texture_flat, &zs_shade_texture_smooth };
#define SHADERS (sizeof shaders / sizeof shaders[0])

static void still_open(struct still *s)
{
    memset(s, 0, sizeof *s);
    if (!ball.mesh.n_tris)
        shape_sphere(&ball, 8, 12, 600);
    for (uint32_t v = 0; v < ball.mesh.n_verts; v++) {
        uv[v][0] = (int16_t)(ball.pos[v][0] * 8);
        uv[v][1] = (int16_t)(ball.pos[v][1] * 8);
    }
    s->mesh = ball.mesh;
    s->mesh.uv = (const int16_t (*)[2])uv;
    s->mesh.uv_bits = 12;
    s->texture = (struct zs_texture){ .format = &zs_texel_565, .texel = texel, .log2_w = 2, .log2_h = 2 };
    s->material = (struct zs_material){ .shader = &zs_shade_flat, .rgb = ZS_RGB(0xffffff), .texture = &s->texture };
    s->instance.mesh = &s->mesh;
    s->instance.material = &s->material;
    zs_pose_identity(&s->instance.pose);
    s->scene.instance = &s->instance;
    s->scene.n_instances = 1;
    s->scene.light.dir[2] = ZS_Q30_ONE;
    s->scene.light.ambient = ZS_Q16_ONE / 8;
    s->scene.light.diffuse = ZS_Q16_ONE / 2;
    s->config = picture_config(64, 48, &zs_depth_recip);
    s->config.strip_h = 13;
    assert_int_equal(zs_camera_perspective(&s->camera, ZS_DEGREES(45), 48, 100, 20000), ZS_OK);
    s->camera.pos[2] = 2000;
}

static uint16_t differ_from(const struct still *zero, const struct still *written, const char *name)
{
    struct picture a = picture_draw(&zero->config, &zero->scene, &zero->camera);
    struct picture b = picture_draw(&written->config, &written->scene, &written->camera);
    const uint16_t wrong = !picture_same(&a, &b, name) || a.covered < 500;
    PICTURES_FREE(&a, &b);
    return wrong;
}

/* By every shader, with all accelerators and none: what is left out draws what is written out. */
static void zeros_draw_what_they_stand_for(void **state)
{
    static struct still zero, written;
    for (uint32_t k = 0; k < SHADERS; k++)
        for (int bare = 0; bare < 2; bare++) {
#define SAME(change) \
    do { \
        struct still *s = &zero; \
        still_open(&zero), still_open(&written); \
        zero.material.shader = written.material.shader = shaders[k]; \
        if (bare) \
            zero.config.fast = written.config.fast = NULL; \
        change; \
        assert_int_equal(differ_from(&zero, &written, #change), 0); \
    } while (0)
            SAME(s->mesh.scale = 0);
            SAME(s->instance.pose.scale = 0);
            SAME((s->mesh.scale = 0, written.mesh.scale = ZS_Q16_ONE, s->instance.pose.scale = 0));
            SAME(memset(s->instance.pose.rot, 0, sizeof s->instance.pose.rot));
            SAME(memset(&s->instance.pose, 0, sizeof s->instance.pose));
            SAME(memset(s->camera.rot, 0, sizeof s->camera.rot));
            SAME((s->config.buffers = 0, written.config.buffers = 1));
            SAME((s->config.subpixel_bits = 0, written.config.subpixel_bits = 8));
            SAME((s->config.depth_bits = 0, written.config.depth_bits = 16));
            SAME((memset(&s->scene.light, 0, sizeof s->scene.light),
                  written.scene.light = (struct zs_light){ .dir = { -357913941, 715827883, 715827883 },
                                                           .ambient = ZS_Q16_ONE / 4,
                                                           .diffuse = ZS_Q16_ONE * 3 / 4 }));
#undef SAME
        }
}

/* Clusters and the hidden test read the scale as well: as many triangles are left out. */
static void zeros_leave_out_the_same(void **state)
{
    static struct still zero, written;
    static struct shape large;
    static struct zs_cluster cluster[SHAPE_TRIS];
    struct prng p = { 7 };
    shape_sphere(&large, 20, 40, 600);
    clusters_make(&large.mesh, cluster, &p, 40, 0);
    for (int open = 0; open < 2; open++) {
        struct still *s = open ? &written : &zero;
        still_open(s);
        s->mesh = large.mesh;
        s->camera.pos[2] = 900; /* side planes cut the sphere */
    }
    memset(zero.instance.pose.rot, 0, sizeof zero.instance.pose.rot);
    for (int k = 0; k < 2; k++) {
        *(k ? &zero.mesh.scale : &zero.instance.pose.scale) = 0;
        *(k ? &zero.instance.pose.scale : &zero.mesh.scale) = ZS_Q16_ONE * 15 / 16;
        *(k ? &written.instance.pose.scale : &written.mesh.scale) = ZS_Q16_ONE * 15 / 16;
        *(k ? &written.mesh.scale : &written.instance.pose.scale) = ZS_Q16_ONE;
        struct picture a = picture_draw(&zero.config, &zero.scene, &zero.camera);
        struct picture b = picture_draw(&written.config, &written.scene, &written.camera);
        assert_true(picture_same(&a, &b, "clusters") && a.covered > 500);
        assert_memory_equal(&a.stats, &b.stats, sizeof a.stats);
        assert_true(a.stats.clusters_culled > 10 && a.stats.clusters_culled < a.stats.clusters_in);
        PICTURES_FREE(&a, &b);
    }
}

/* A pose of zeros is turned as no rotation is. */
static void zero_poses_turn(void **state)
{
    static const int32_t axis[3] = { 1, 2, 3 };
    struct zs_pose zero, whole;
    memset(&zero, 0, sizeof zero);
    zs_pose_identity(&whole);
    assert_int_equal(zs_pose_rotate(&zero, axis, ZS_DEGREES(20)), ZS_OK);
    assert_int_equal(zs_pose_rotate(&whole, axis, ZS_DEGREES(20)), ZS_OK);
    assert_memory_equal(zero.rot, whole.rot, sizeof zero.rot);
    assert_int_equal(zero.scale, 0);
}

/* ---- The usual light ------------------------------------------------------------------------------------------- */

static struct zs_light seen;
static zs_q2_30 seen_dir[3];

static uint16_t look(const struct zs_shading *s, uint32_t t)
{
    (void)t;
    seen = *s->light;
    memcpy(seen_dir, s->dir, sizeof seen_dir);
    return 0;
}

static void paint(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    *f->color = f->paint;
}

static int light_case(uint64_t seed)
{
    static const struct zs_shader looks = { .face = look, .fragment = paint, ZS_FRAGMENTS };
    struct prng p = { seed };
    struct still s;
    still_open(&s);
    s.material.shader = &looks;
    zs_pose_turn(&s.instance.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    memset(&s.scene.light, 0, sizeof s.scene.light);
    const int32_t at[3] = { 0, 0, 0 };
    CASE_CHECK(zs_camera_orbit(&s.camera, at, 2000, (zs_turn)prng_next(&p), (int16_t)prng_range(&p, -16000, 16000)) ==
               ZS_OK);
    memset(&seen, 0, sizeof seen);
    struct picture a = picture_draw(&s.config, &s.scene, &s.camera);
    picture_free(&a);
    CASE_CHECK(a.err == ZS_OK && seen.ambient == ZS_Q16_ONE / 4 && seen.diffuse == ZS_Q16_ONE * 3 / 4);
    for (int k = 0; k < 3; k++) { /* one part left, two up, two back */
        const double want = (-1.0 * s.camera.rot[k] + 2.0 * s.camera.rot[3 + k] + 2.0 * s.camera.rot[6 + k]) / 3;
        double mesh = 0;
        CASE_CHECK(fabs(seen.dir[k] - want) <= 2);
        for (int j = 0; j < 3; j++)
            mesh += ldexp(s.instance.pose.rot[3 * j + k], -30) * seen.dir[j];
        CASE_CHECK(fabs(seen_dir[k] - mesh) <= 2);
    }
    /* nothing but all zeros is replaced */
    const uint32_t which = (uint32_t)(seed % 5);
    if (which < 3)
        s.scene.light.dir[which] = 1;
    else
        *(which == 3 ? &s.scene.light.ambient : &s.scene.light.diffuse) = 1;
    a = picture_draw(&s.config, &s.scene, &s.camera);
    picture_free(&a);
    CASE_CHECK(a.err == ZS_OK && memcmp(&seen, &s.scene.light, sizeof seen) == 0);
    return 1;
}

/* ---- Damage tracking, and the end of frames -------------------------------------------------------------------- */

struct panel {
    uint16_t color[64 * 48];
    int submits, waits, ends, lent;
    int fail_submit, fail_wait, fail_end; /* the n-th call */
    int order;                            /* 1: something came after end, or end while a strip was lent */
};

static int submit(void *ctx, const struct zs_strip *s)
{
    struct panel *p = ctx;
    p->order |= p->ends || p->lent;
    if (++p->submits == p->fail_submit)
        return -501;
    for (uint32_t j = 0; j < s->h; j++)
        for (uint32_t i = s->dirty_x; i < (uint32_t)s->dirty_x + s->dirty_w; i++) {
            const uint8_t *const px = s->px + (j * s->w + i) * 2u;
            p->color[(s->y + j) * 64u + i] = (uint16_t)(px[0] << 8 | px[1]);
        }
    p->lent = 1;
    return 0;
}

static int wait(void *ctx)
{
    struct panel *p = ctx;
    p->order |= p->ends;
    p->lent = 0;
    return ++p->waits == p->fail_wait ? -502 : 0;
}

static int end(void *ctx)
{
    struct panel *p = ctx;
    p->order |= p->lent;
    return ++p->ends == p->fail_end ? -503 : 0;
}

static void panel_ready(struct panel *p)
{
    p->submits = p->waits = p->ends = p->lent = p->order = p->fail_submit = p->fail_wait = p->fail_end = 0;
}

/* Of a scene without a light, the camera alone moves the light: everything is drawn anew. */
static void tracking_sees_the_usual_light_turn(void **state)
{
    static struct still s;
    static struct panel panel;
    static uint32_t memory[ZS_DAMAGE_WORDS(1, 48, 13)];
    still_open(&s);
    memset(&s.scene.light, 0, sizeof s.scene.light);
    memset(s.camera.rot, 0, sizeof s.camera.rot);
    struct zs_renderer r;
    void *arena = malloc(zs_arena_bytes(&s.config));
    const struct zs_sink sink = { .submit = submit, .wait = wait, .end = end, .ctx = &panel };
    assert_int_equal(zs_init(&r, &s.config, arena, zs_arena_bytes(&s.config)), ZS_OK);
    assert_int_equal(zs_damage_track(&r, memory, 1), ZS_OK);
    for (int frame = 0; frame < 6; frame++) {
        if (frame == 2) { /* as no rotation: the same */
            s.camera.rot[0] = s.camera.rot[4] = s.camera.rot[8] = ZS_Q30_ONE;
        } else if (frame == 3) { /* upside down about the view */
            s.camera.rot[0] = s.camera.rot[4] = -ZS_Q30_ONE;
        } else if (frame == 5) { /* the light alone, written out: where it was, but brighter */
            s.scene.light = r.light;
            s.scene.light.ambient *= 2;
        }
        panel_ready(&panel);
        assert_int_equal(zs_render(&r, &s.scene, &s.camera, &sink), ZS_OK);
        struct picture whole = picture_draw(&s.config, &s.scene, &s.camera);
        assert_memory_equal(panel.color, whole.color, sizeof panel.color);
        picture_free(&whole);
        assert_int_equal(panel.submits, frame == 0 || frame == 3 || frame == 5 ? 4 : 0);
        assert_int_equal(panel.ends, 1);
    }
    free(arena);
}

/* end is called once for each frame that has begun, after everything, and its error counts if there was none. */
static void frames_end_once(void **state)
{
    static struct still s;
    static struct panel panel;
    still_open(&s);
    for (uint8_t buffers = 1; buffers <= 2; buffers++)
        for (int at = 0; at < 8; at++) { /* no failure; submit 1, 2, 4; wait 1, 2, 4; end */
            static const int nth[3] = { 1, 2, 4 };
            struct zs_renderer r;
            uint64_t memory[4];
            struct zs_strip_hashes sums;
            s.config.buffers = buffers;
            void *arena = malloc(zs_arena_bytes(&s.config));
            struct zs_sink sink = { .submit = submit, .wait = wait, .end = end, .ctx = &panel };
            assert_int_equal(zs_init(&r, &s.config, arena, zs_arena_bytes(&s.config)), ZS_OK);
            assert_int_equal(damage_compare_anew(&r, &sums, memory, 1), ZS_OK);
            panel_ready(&panel);
            if (at >= 1 && at <= 3)
                panel.fail_submit = nth[at - 1];
            else if (at >= 4 && at <= 6)
                panel.fail_wait = nth[at - 4];
            else if (at == 7)
                panel.fail_end = 1;
            const int want = at == 0 ? 0 : at <= 3 ? -501 : at <= 6 ? -502 : -503;
            assert_int_equal(zs_render(&r, &s.scene, &s.camera, &sink), want);
            assert_int_equal(panel.ends, 1);
            assert_int_equal(panel.order, 0);
            assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);

            /* both fail: the first one is returned */
            if (at >= 1 && at <= 3) {
                panel_ready(&panel);
                panel.fail_submit = panel.fail_end = 1;
                assert_int_equal(zs_render(&r, &s.scene, &s.camera, &sink), -501);
            }
            /* the next frame sends what has not arrived: all, after a failure of end */
            panel_ready(&panel);
            assert_int_equal(zs_render(&r, &s.scene, &s.camera, &sink), ZS_OK);
            if (at == 0 || at == 7)
                assert_int_equal(panel.submits, at ? 4 : 0);
            else
                assert_true(panel.submits > 0);
            assert_int_equal(panel.ends, 1);
            struct picture whole = picture_draw(&s.config, &s.scene, &s.camera);
            assert_memory_equal(panel.color, whole.color, sizeof panel.color);
            picture_free(&whole);

            /* nothing to send: end still comes; NULL: it does not, and a frame that is refused has none */
            panel_ready(&panel);
            assert_int_equal(zs_render(&r, &s.scene, &s.camera, &sink), ZS_OK);
            assert_int_equal(panel.submits, 0);
            assert_int_equal(panel.ends, 1);
            struct zs_camera bad = s.camera;
            bad.focal = 0;
            assert_int_equal(zs_render(&r, &s.scene, &bad, &sink), ZS_ERR_CAMERA);
            sink.end = NULL;
            assert_int_equal(zs_render(&r, &s.scene, &s.camera, &sink), ZS_OK);
            assert_int_equal(panel.ends, 1);
            free(arena);
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(degrees_are_rounded_turns),
    cmocka_unit_test(colours_are_the_functions),
    cmocka_unit_test(a_renderer_by_macro),
    cmocka_unit_test(zeros_draw_what_they_stand_for),
    cmocka_unit_test(zeros_leave_out_the_same),
    cmocka_unit_test(zero_poses_turn),
    CASES_TEST(the_usual_light_turns_with_the_camera, light_case, 500),
    cmocka_unit_test(tracking_sees_the_usual_light_turn),
    cmocka_unit_test(frames_end_once),
};

CASES_MAIN(tests)
