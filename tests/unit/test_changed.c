/* zs_invalidate under zs_damage_track: after it, what stands behind pointers is as if the renderer were new: the same
 * pixels, the same refusals.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "damage/changed.h"
#include "picture.h"
#include "zs_damage.h"
#include "zs_lights.h"
#include "zs_lines.h"

#define W 64
#define H 64

static const int16_t pos[3][3] = { { -3, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 } };
static const uint16_t tri[1][3] = { { 0, 1, 2 } };
static const zs_q1_15 normal[3][3] = { { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 } };
static const struct zs_mesh thing = {
    .pos = pos, .tri = tri, .normal = normal, .n_verts = 3, .n_tris = 1, .radius = 4
};

/* A renderer that tracks a scene of at most an instance, and the panel behind it. */
static struct tracked {
    struct zs_renderer r;
    struct zs_config config;
    struct zs_camera camera;
    uint32_t memory[ZS_DAMAGE_WORDS(1, H, 1)];
    uint32_t arena[60000];
    uint16_t shown[H][W];
} tracked;

static void begin(struct tracked *t, int columns, uint16_t tris)
{
    static const int32_t at[3] = { 0, 0, 0 };
    memset(t, 0, sizeof *t);
    assert_int_equal(zs_camera_perspective(&t->camera, ZS_DEGREES(45), H, 10, 1000), ZS_OK);
    assert_int_equal(zs_camera_orbit(&t->camera, at, 100, 0, 0), ZS_OK);
    t->config = picture_config(W, H, &zs_depth_recip);
    t->config.strip_h = 4;
    t->config.varyings = ZS_VARYINGS_MAX;
    t->config.max_tris = tris;
    t->config.max_verts = 60;
    assert_int_equal(zs_init(&t->r, &t->config, t->arena, sizeof t->arena), ZS_OK);
    assert_int_equal(zs_damage_track(&t->r, t->memory, 1), ZS_OK);
    assert_int_equal(zs_damage_columns(&t->r, columns), ZS_OK);
}

static int show(void *ctx, const struct zs_strip *s)
{
    struct tracked *t = ctx;
    for (uint32_t y = 0; y < s->h; y++)
        for (uint32_t x = s->dirty_x; x < (uint32_t)s->dirty_x + s->dirty_w; x++) {
            const uint8_t *px = s->px + 2 * (y * s->w + x);
            t->shown[s->y + y][x] = (uint16_t)(px[0] << 8 | px[1]);
        }
    return 0;
}

/* Draw a frame: what zs_render says is what it says to a new renderer, and the panel shows that one's frame. */
static int frame(struct tracked *t, const struct zs_scene *scene)
{
    const struct zs_sink sink = { .submit = show, .ctx = t };
    const int err = zs_render(&t->r, scene, &t->camera, &sink);
    struct picture fresh = picture_draw(&t->config, scene, &t->camera);
    assert_int_equal(err, fresh.err);
    if (!err)
        assert_memory_equal(t->shown, fresh.color, sizeof t->shown);
    picture_free(&fresh);
    return err;
}

static void lines_and_points_of_another_width(void **state)
{
    (void)state;
    static const uint16_t pair[6][2] = { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 1 }, { 1, 2 }, { 2, 0 } };
    static const struct zs_rect all = { .w = W, .h = H };
    for (int k = 0; k < 32; k++) {
        struct zs_lines wire = { ZS_LINES(pair, 6), .width = 1 };
        struct zs_points dots = { ZS_POINTS(NULL, 3), .size = 1 };
        const struct zs_material ink = { .shader = &zs_shade_plain, .rgb = ZS_RGB(0xffffff),
                                         .primitive = k & 1 ? &wire.primitive : &dots.primitive };
        const struct zs_instance in = { /* in the frame, or above it */
            .mesh = &thing, .material = &ink, .pose = { .pos = { 0, k & 8 ? 52 : 0, 0 } }
        };
        const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
        begin(&tracked, k & 2, k & 4 ? 4 : 60);
        assert_int_equal(frame(&tracked, &scene), ZS_OK);
        dots.size = wire.width = 40;
        assert_int_equal(zs_invalidate(&tracked.r, k & 16 ? &all : NULL), ZS_OK);
        assert_int_equal(frame(&tracked, &scene), ZS_OK);
        assert_int_equal(frame(&tracked, &scene), ZS_OK);
        assert_int_equal(zs_frame_stats(&tracked.r)->strips_skipped, H / 4);
        dots.size = wire.width = 255;
        assert_int_equal(zs_invalidate(&tracked.r, NULL), ZS_OK);
        assert_int_equal(frame(&tracked, &scene), ZS_ERR_RANGE);
        dots.size = wire.width = 3;
        assert_int_equal(frame(&tracked, &scene), ZS_OK);
    }
}

static void lamps_that_are_no_longer_right(void **state)
{
    (void)state;
    struct zs_lamp lamp = { .kind = ZS_LAMP_POINT, .pos = { 0, 0, 50 }, .range = 300 };
    const struct zs_lamp good = lamp;
    struct zs_lighting lighting = { .lamp = &lamp, .n_lamps = 1 };
    const struct zs_lit_material red = {
        .material = { .shader = &zs_shade_lit, .rgb = ZS_RGB(0xc02010), .cull = ZS_CULL_NONE }, .lighting = &lighting
    };
    const struct zs_instance in = { .mesh = &thing, .material = &red.material };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    begin(&tracked, 0, 60);
    assert_int_equal(frame(&tracked, &scene), ZS_OK);
    lamp.pos[1] = INT32_MIN;
    lamp.range = lamp.half = UINT32_MAX;
    assert_int_equal(zs_invalidate(&tracked.r, NULL), ZS_OK);
    assert_int_equal(frame(&tracked, &scene), ZS_ERR_RANGE);
    assert_int_equal(frame(&tracked, &scene), ZS_ERR_RANGE);
    lamp = good;
    assert_int_equal(frame(&tracked, &scene), ZS_OK);
    lighting.lamp = NULL;
    assert_int_equal(zs_invalidate(&tracked.r, NULL), ZS_OK);
    assert_int_equal(frame(&tracked, &scene), ZS_ERR_NULL);
}

static void paint(void *ctx, const struct zs_target *t)
{
    for (int32_t y = t->y0; y < t->y1; y++)
        for (int32_t x = t->x0; x < t->x1 && x < 8; x++)
            t->color[(uint32_t)(y - t->y0) * t->pitch + (uint32_t)x] = *(const uint16_t *)ctx;
}

/* Hooks are compared themselves, not what they point to. */
static void hooks_that_are_exchanged(void **state)
{
    (void)state;
    uint16_t color[2] = { 0x1111, 0x2222 };
    struct zs_resolve hook[2] = { { .draw = paint, .ctx = color }, { .draw = paint, .ctx = color } };
    const struct zs_scene scene = { .resolve = hook, .n_resolves = 2 };
    begin(&tracked, 0, 60);
    assert_int_equal(frame(&tracked, &scene), ZS_OK);
    hook[1].ctx = color + 1;
    assert_int_equal(frame(&tracked, &scene), ZS_OK);
    assert_int_equal(frame(&tracked, &scene), ZS_OK);
    assert_int_equal(zs_frame_stats(&tracked.r)->strips_skipped, H / 4);
    color[1] = 0x3333;
    assert_int_equal(zs_invalidate(&tracked.r, NULL), ZS_OK);
    assert_int_equal(frame(&tracked, &scene), ZS_OK);
}

/* After a refused frame all strips are drawn, whatever it was refused for. */
static void after_a_refused_frame(void **state)
{
    (void)state;
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff), .cull = ZS_CULL_NONE };
    const struct zs_instance in[2] = { { .mesh = &thing, .material = &raw }, { .mesh = &thing, .material = &raw } };
    const struct zs_scene good = { .instance = in, .n_instances = 1 };
    const struct zs_scene bad[2] = { { .instance = in, .n_instances = 2 }, { .n_instances = 1 } };
    static const int errors[2] = { ZS_ERR_SIZE, ZS_ERR_NULL };
    const struct zs_sink sink = { .submit = show, .ctx = &tracked };
    for (int k = 0; k < 2; k++) {
        begin(&tracked, 0, 60);
        assert_int_equal(frame(&tracked, &good), ZS_OK);
        assert_int_equal(zs_render(&tracked.r, &bad[k], &tracked.camera, &sink), errors[k]);
        assert_int_equal(frame(&tracked, &good), ZS_OK);
        assert_int_equal(zs_frame_stats(&tracked.r)->strips_skipped, 0);
    }
}

static int not_shown(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    (void)s;
    return 1;
}

/* The first strip does not arrive: it is drawn again, where strips are a row as well. */
static void a_first_strip_that_is_lost(void **state)
{
    (void)state;
    const struct zs_sink lost = { .submit = not_shown };
    for (uint16_t strip_h = 1; strip_h <= 4; strip_h++) {
        struct zs_scene scene = { .background = 0x1111 };
        begin(&tracked, 0, 60);
        tracked.config.strip_h = strip_h;
        assert_int_equal(zs_init(&tracked.r, &tracked.config, tracked.arena, sizeof tracked.arena), ZS_OK);
        assert_int_equal(zs_damage_track(&tracked.r, tracked.memory, 1), ZS_OK);
        assert_int_equal(frame(&tracked, &scene), ZS_OK);
        scene.background = 0x2222;
        assert_int_equal(zs_render(&tracked.r, &scene, &tracked.camera, &lost), 1);
        assert_int_equal(frame(&tracked, &scene), ZS_OK);
        assert_int_equal(zs_frame_stats(&tracked.r)->strips_skipped, 0);
    }
}

/* Of a hash either half notices two changes in a row, of which the second would take back the first if values were
 * only rotated and added. (Of the highest bits one alone does: a product hardly moves them.) */
static void changes_do_not_cancel(void **state)
{
    (void)state;
    struct prng p = { 1 };
    for (int n = 0; n < 24 * 64; n++) {
        const uint32_t back = 1u << n % 24, v[2] = { (uint32_t)prng_next(&p), (uint32_t)prng_next(&p) };
        uint32_t was[2] = ZS_LANES, by_xor[2] = ZS_LANES, by_sum[2] = ZS_LANES;
        zs_mix(was, v[0]);
        zs_mix(was, v[1]);
        zs_mix(by_xor, v[0] ^ zs_rotate_left(back, 32 - 13));
        zs_mix(by_xor, v[1] ^ back);
        zs_mix(by_sum, v[0] + zs_rotate_left(back, 32 - 19));
        zs_mix(by_sum, v[1] - back);
        assert_int_not_equal(by_xor[0], was[0]);
        assert_int_not_equal(by_sum[1], was[1]);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(lines_and_points_of_another_width),
    cmocka_unit_test(lamps_that_are_no_longer_right),
    cmocka_unit_test(hooks_that_are_exchanged),
    cmocka_unit_test(after_a_refused_frame),
    cmocka_unit_test(a_first_strip_that_is_lost),
    cmocka_unit_test(changes_do_not_cancel),
};
CASES_MAIN(tests)
