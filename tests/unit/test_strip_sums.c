/* zs_damage_compare and zs_invalidate: only what has changed is sent, and the glass is right all the same, whatever
 * failed before.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "picture.h"
#include "prng.h"
#include "scenes.h"
#include "zs_damage.h"

#define W_MAX 80
#define H_MAX 60

/* A panel that shows what arrived last. */
struct glass {
    uint8_t px[H_MAX][W_MAX * 2];
    struct zs_strip strip; /* submitted, not yet waited for */
    uint32_t n_submits, n_px;
    uint32_t fail_submit, fail_wait; /* at this call from 1; 0: never */
    uint32_t n_waits;
    int partial; /* 1: send the changed columns alone */
};

static int submit(void *ctx, const struct zs_strip *s)
{
    struct glass *g = ctx;
    assert_true(s->dirty_w > 0 && s->dirty_x + s->dirty_w <= s->w);
    if (++g->n_submits == g->fail_submit)
        return -777;
    g->strip = *s;
    return 0;
}

static int wait(void *ctx)
{
    struct glass *g = ctx;
    const struct zs_strip *s = &g->strip;
    const uint32_t x = g->partial ? s->dirty_x : 0, w = g->partial ? s->dirty_w : s->w;
    if (++g->n_waits == g->fail_wait) { /* half of it arrived, as junk */
        memset(g->px[s->y], 0x5a, s->w);
        return -888;
    }
    for (uint32_t row = 0; row < s->h; row++)
        memcpy(&g->px[s->y + row][x * 2u], s->px + (row * s->w + x) * 2u, w * 2u);
    g->n_px += w * s->h;
    return 0;
}

struct show {
    struct zs_config config;
    struct zs_renderer r;
    uint32_t *arena;
    uint64_t *sum;
    struct zs_strip_hashes sums;
    uint32_t n_sums, columns;
    struct glass glass;
    const struct demo *demo;
    struct demo_frame frame;
};

static void open_show(struct show *s, const struct demo *demo, uint16_t w, uint16_t h, uint16_t rows,
                      uint8_t buffers, uint32_t columns)
{
    memset(s, 0, sizeof *s);
    s->config = picture_config(w, h, demo->depth);
    s->config.strip_h = rows;
    s->config.buffers = buffers;
    s->config.varyings = (uint8_t)demo->varyings;
    s->demo = demo;
    s->columns = columns;
    s->n_sums = ZS_STRIPS(h, rows) * columns;
    const uint32_t bytes = zs_arena_bytes(&s->config);
    s->arena = malloc(bytes);
    s->sum = malloc(s->n_sums * sizeof *s->sum); /* exactly: the sanitizer sees one too many */
    memset(s->arena, 0xcd, bytes);
    memset(s->glass.px, 0xee, sizeof s->glass.px);
    assert_int_equal(zs_init(&s->r, &s->config, s->arena, bytes), ZS_OK);
    assert_int_equal(damage_compare_anew(&s->r, &s->sums, s->sum, columns), ZS_OK);
    s->glass.partial = 1;
}

static void close_show(struct show *s)
{
    free(s->arena);
    free(s->sum);
}

static int draw(struct show *s, uint32_t t)
{
    const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s->glass };
    s->demo->pose(&s->frame, t, s->config.width, s->config.height);
    s->glass.n_submits = s->glass.n_waits = s->glass.n_px = 0;
    return zs_render(&s->r, &s->frame.scene, &s->frame.camera, &sink);
}

/* Is what the glass shows the frame? */
static void glass_is_right(struct show *s)
{
    struct zs_config plain = s->config;
    plain.strip_h = plain.height;
    plain.fast = NULL;
    struct picture p = picture_draw(&plain, &s->frame.scene, &s->frame.camera);
    assert_int_equal(p.err, ZS_OK);
    for (int32_t y = 0; y < p.h; y++)
        for (int32_t x = 0; x < p.w; x++) {
            const uint8_t *at = &s->glass.px[y][x * 2];
            if ((at[0] << 8 | at[1]) != p.color[y * p.w + x])
                fail_msg("pixel %d, %d: %02x%02x, not %04x", (int)x, (int)y, at[0], at[1], p.color[y * p.w + x]);
        }
    picture_free(&p);
}

static void a_still_scene_sends_nothing(void **state)
{
    static const uint16_t rows[] = { 1, 7, 8, 60 };
    for (uint8_t buffers = 1; buffers <= 2; buffers++)
        for (uint32_t i = 0; i < 4; i++)
            for (uint32_t columns = 1; columns <= 5; columns += 2) {
                struct show s;
                open_show(&s, &demo_teapot, i & 1 ? 75 : 80, 60, rows[i], buffers, columns);
                assert_int_equal(draw(&s, 3), ZS_OK);
                assert_int_equal(s.glass.n_px, s.config.width * 60);
                glass_is_right(&s);
                assert_int_equal(draw(&s, 3), ZS_OK);
                assert_int_equal(s.glass.n_submits, 0);
                assert_int_equal(zs_frame_stats(&s.r)->strips_clean, ZS_STRIPS(60, rows[i]));
                glass_is_right(&s);
                assert_int_equal(draw(&s, 4), ZS_OK);
                assert_true(s.glass.n_submits > 0);
                glass_is_right(&s);
                assert_int_equal(damage_compare_anew(&s.r, &s.sums, s.sum, columns), ZS_OK); /* begins anew */
                assert_int_equal(draw(&s, 4), ZS_OK);
                assert_int_equal(s.glass.n_px, s.config.width * 60);
                close_show(&s);
            }
}

static void one_moving_thing_sends_its_own_part(void **state)
{
    struct show s;
    open_show(&s, &demo_cubes, 80, 60, 4, 2, 10);
    assert_int_equal(draw(&s, 0), ZS_OK);
    /* by hand: the same frame, the last instance turned */
    const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &s.glass };
    struct zs_instance *last = &s.frame.instance[s.frame.scene.n_instances - 1u];
    struct picture before = picture_draw(&s.config, &s.frame.scene, &s.frame.camera);
    zs_pose_turn(&last->pose, 5000, 300, 0);
    struct picture after = picture_draw(&s.config, &s.frame.scene, &s.frame.camera);
    s.glass.n_px = s.glass.n_submits = 0;
    assert_int_equal(zs_render(&s.r, &s.frame.scene, &s.frame.camera, &sink), ZS_OK);
    glass_is_right(&s);
    uint32_t box = 0, strips = 0;
    for (int32_t y0 = 0; y0 < 60; y0 += 4) { /* the changed cells of each strip, from the pictures */
        int32_t x0 = 80, x1 = 0;
        for (int32_t y = y0; y < y0 + 4; y++)
            for (int32_t x = 0; x < 80; x++)
                if (before.color[y * 80 + x] != after.color[y * 80 + x]) {
                    x0 = x < x0 ? x : x0;
                    x1 = x >= x1 ? x + 1 : x1;
                }
        if (x1) {
            box += (uint32_t)((x1 + 7) / 8 * 8 - x0 / 8 * 8) * 4u;
            strips++;
        }
    }
    assert_true(strips > 0 && strips < 15);
    assert_int_equal(s.glass.n_submits, strips);
    assert_int_equal(s.glass.n_px, box);
    PICTURES_FREE(&before, &after);
    close_show(&s);
}

/* Invalidated rectangles are sent again, and nothing else. */
static void invalidated_parts_are_sent_again(void **state)
{
    struct prng p = { 77 };
    for (int run = 0; run < 60; run++) {
        struct show s;
        const uint16_t w = (uint16_t)(60 + prng_pick(&p, 21)), rows = (uint16_t)(1 + prng_pick(&p, 20));
        open_show(&s, &demo_cubes, w, 60, rows, (uint8_t)(1 + prng_pick(&p, 2)), 1 + prng_pick(&p, 9));
        assert_int_equal(draw(&s, 0), ZS_OK);
        const struct zs_rect rect = { (uint16_t)prng_pick(&p, w), (uint16_t)prng_pick(&p, 60),
                                      (uint16_t)(1 + prng_pick(&p, w)), (uint16_t)(1 + prng_pick(&p, 60)) };
        for (uint32_t y = rect.y; y < 60 && y < rect.y + rect.h; y++)
            for (uint32_t x = rect.x; x < w && x < rect.x + rect.w; x++)
                s.glass.px[y][2 * x] ^= 0xff;
        assert_int_equal(zs_invalidate(&s.r, &rect), ZS_OK);
        assert_int_equal(draw(&s, 0), ZS_OK);
        glass_is_right(&s);
        const uint32_t y1 = rect.y + rect.h < 60 ? rect.y + rect.h : 60u;
        assert_int_equal(s.glass.n_submits, (y1 - 1u) / rows - rect.y / rows + 1u);
        assert_int_equal(zs_invalidate(&s.r, NULL), ZS_OK);
        assert_int_equal(draw(&s, 0), ZS_OK);
        assert_int_equal(s.glass.n_px, w * 60u);
        close_show(&s);
    }
}

/* A failed send: the error reaches the caller, and the next good frame is right. */
static void failed_sends_are_sent_again(void **state)
{
    for (uint8_t buffers = 1; buffers <= 2; buffers++)
        for (uint32_t at = 1; at <= 10; at++)
            for (int in_wait = 0; in_wait < 2; in_wait++) {
                struct show s;
                open_show(&s, &demo_teapot, 80, 60, 8, buffers, 4);
                assert_int_equal(draw(&s, 0), ZS_OK);
                assert_int_equal(zs_invalidate(&s.r, NULL), ZS_OK);
                *(in_wait ? &s.glass.fail_wait : &s.glass.fail_submit) = at;
                const int err = draw(&s, 9);
                assert_int_equal(err, at > 8 ? ZS_OK : in_wait ? -888 : -777); /* eight strips */
                s.glass.fail_wait = s.glass.fail_submit = 0;
                assert_int_equal(draw(&s, 9), ZS_OK);
                glass_is_right(&s);
                /* and what did arrive before the fault was not sent again */
                if (at > 3)
                    assert_true(s.glass.n_px < 80 * 60);
                close_show(&s);
            }
}

/* Two renderers take turns at the strips of one panel: A, B, A. What A draws the second time is what it drew the first
 * time, but the panel shows B's. */
static void renderers_that_take_turns_share_the_panels_sums(void **state)
{
    struct show a, b;
    open_show(&a, &demo_cubes, 64, 48, 8, 1, 2);
    open_show(&b, &demo_knot, 64, 48, 8, 1, 2);
    assert_int_equal(zs_damage_compare(&b.r, &a.sums), ZS_OK);
    assert_int_equal(draw(&a, 0), ZS_OK);
    memcpy(b.glass.px, a.glass.px, sizeof b.glass.px); /* one panel */
    assert_int_equal(draw(&b, 0), ZS_OK);
    assert_true(b.glass.n_submits > 0);
    glass_is_right(&b);
    memcpy(a.glass.px, b.glass.px, sizeof a.glass.px);
    assert_int_equal(draw(&a, 0), ZS_OK);
    assert_true(a.glass.n_submits > 0);
    glass_is_right(&a);
    close_show(&a);
    close_show(&b);
}

static void wrong_calls_are_refused(void **state)
{
    struct show s;
    struct zs_renderer junk;
    memset(&junk, 0xa5, sizeof junk);
    junk.ready = 0;
    open_show(&s, &demo_cubes, 64, 48, 8, 1, 2);
    assert_int_equal(zs_damage_compare(NULL, &s.sums), ZS_ERR_NULL);
    assert_int_equal(zs_invalidate(NULL, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_damage_compare(&junk, &s.sums), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_invalidate(&junk, NULL), ZS_ERR_SEQUENCE);
    struct zs_strip_hashes other = s.sums;
    assert_int_equal(zs_strip_hashes_init(NULL, s.sum, 64, 48, 8, 2), ZS_ERR_NULL);
    assert_int_equal(zs_strip_hashes_init(&other, NULL, 64, 48, 8, 2), ZS_ERR_NULL);
    assert_int_equal(zs_strip_hashes_init(&other, s.sum, 64, 48, 8, 0), ZS_ERR_SIZE);
    assert_int_equal(zs_strip_hashes_init(&other, s.sum, 64, 48, 8, 65), ZS_ERR_SIZE);
    assert_int_equal(zs_strip_hashes_init(&other, s.sum, 64, 48, 0, 2), ZS_ERR_SIZE);
    assert_int_equal(zs_strip_hashes_init(&other, s.sum, 0, 48, 8, 2), ZS_ERR_SIZE);
    assert_int_equal(zs_strip_hashes_init(&other, s.sum, 64, ZS_SIZE_MAX + 1, 8, 2), ZS_ERR_SIZE);
    other.strip_h = 9;
    assert_int_equal(zs_damage_compare(&s.r, &other), ZS_ERR_SIZE);
    assert_int_equal(draw(&s, 0), ZS_OK);
    assert_int_equal(zs_frame_begin(&s.r, &s.frame.scene, &s.frame.camera), ZS_OK);
    assert_int_equal(zs_damage_compare(&s.r, NULL), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_end(&s.r), ZS_OK);
    assert_int_equal(draw(&s, 0), ZS_OK); /* as before: still compared */
    assert_int_equal(s.glass.n_submits, 0);
    assert_int_equal(zs_damage_compare(&s.r, NULL), ZS_OK);
    assert_int_equal(draw(&s, 0), ZS_OK);
    assert_int_equal(s.glass.n_px, 64 * 48);
    assert_int_equal(zs_invalidate(&s.r, NULL), ZS_OK); /* no effect */
    close_show(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_still_scene_sends_nothing),
        cmocka_unit_test(one_moving_thing_sends_its_own_part),
        cmocka_unit_test(invalidated_parts_are_sent_again),
        cmocka_unit_test(failed_sends_are_sent_again),
        cmocka_unit_test(renderers_that_take_turns_share_the_panels_sums),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
