/* Strips that are left out, and frames that several threads draw: bit for bit the frame that one renderer draws.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "frame.h"
#include "prng.h"
#include "scenes.h"

#define W 96
#define H 72
#define N ((size_t)W * H)

/* Pools for everything, or (kind 1) so small that the scene is walked for a band of strips or for one, in sets. */
static struct zs_config config_of(const struct demo *demo, int kind, uint16_t strip_h)
{
    struct zs_config c;
    sim_frame_config(&c, W, H, (uint8_t)demo->attrs);
    c.strip_h = strip_h;
    c.depth = demo->depth;
    if (kind == 1)
        c.max_tris = c.max_verts = 150;
    if (kind == 2)
        c.skip_off = ZS_SKIP_BINS;
    return c;
}

static void check(const struct demo_frame *f, const struct zs_config *c, uint32_t threads)
{
    struct sim_frame one, many;
    struct sim_frame_time time;
    assert_int_equal(sim_frame_render(&one, &f->scene, &f->camera, c, NULL), ZS_OK);
    assert_int_equal(sim_frame_render_threads(&many, &f->scene, &f->camera, c, threads, &time), ZS_OK);
    assert_memory_equal(many.rgb565, one.rgb565, N * 2);
    assert_memory_equal(many.key, one.key, N * 2);
    const struct zs_stats *a = &one.stats, *b = &many.stats;
    assert_int_equal(b->tris_in, a->tris_in);
    if (c->skip_off & ZS_SKIP_BEHIND) {
        assert_int_equal(b->tris_drawn, a->tris_drawn);
        assert_int_equal(b->tris_facing, a->tris_facing);
    }
    assert_int_equal(b->strips, a->strips);
    if (a->passes == 1 && c->skip_off & ZS_SKIP_BEHIND) { /* what is dropped depends on the strips that are to be drawn */
        assert_int_equal(b->tris_setup, a->tris_setup);
        assert_int_equal(b->tris_hidden, a->tris_hidden);
        assert_int_equal(b->pixels_tested, a->pixels_tested);
        assert_int_equal(b->pixels_written, a->pixels_written);
    }
    sim_frame_free(&one);
    sim_frame_free(&many);
}

static void frames_of_1_to_5_threads(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < n_demos; d++) {
        struct demo_frame f;
        demos[d]->pose(&f, 7, W, H);
        for (uint32_t threads = 1; threads <= 5; threads++)
            for (int kind = 0; kind < 3; kind++) {
                struct zs_config c = config_of(demos[d], kind, kind == 0 ? 5 : 10);
                check(&f, &c, threads);
                c.skip_off |= ZS_SKIP_BEHIND;
                check(&f, &c, threads);
            }
    }
}

static void more_threads_than_strips(void **state)
{
    (void)state;
    struct demo_frame f;
    demo_cubes.pose(&f, 0, W, H);
    for (int kind = 0; kind < 2; kind++) {
        const struct zs_config c = config_of(&demo_cubes, kind, 30);
        check(&f, &c, SIM_THREADS_MAX);
    }
}

/* Any strips may be left out: the others are as they are. */
static void strips_left_out_at_random(void **state)
{
    (void)state;
    struct prng p = { 11 };
    for (uint32_t d = 0; d < n_demos; d++)
        for (int k = 0; k < 12; k++) {
            struct zs_renderer r;
            struct zs_strip s;
            struct demo_frame f;
            struct sim_frame whole;
            const struct zs_config c = config_of(demos[d], k % 3, (uint16_t)(1 + prng_pick(&p, 20)));
            const uint32_t bytes = zs_arena_bytes(&c), odds = 1 + prng_pick(&p, 4);
            void *arena = malloc(bytes);
            demos[d]->pose(&f, (uint32_t)k, W, H);
            assert_int_equal(sim_frame_render(&whole, &f.scene, &f.camera, &c, NULL), ZS_OK);
            assert_int_equal(zs_init(&r, &c, arena, bytes), ZS_OK);
            assert_int_equal(zs_frame_begin(&r, &f.scene, &f.camera), ZS_OK);
            uint32_t drawn = 0;
            for (uint32_t y = 0; y < H; y += c.strip_h) {
                if (prng_pick(&p, 5) < odds) {
                    assert_int_equal(zs_frame_skip(&r), 1);
                    continue;
                }
                assert_int_equal(zs_frame_strip(&r, &s), 1);
                assert_int_equal(s.y, y);
                assert_int_equal(s.last, (int)(y + s.h == H));
                assert_memory_equal(s.depth, whole.key + (size_t)y * W, (size_t)W * s.h * 2);
                for (size_t i = 0; i < (size_t)W * s.h; i++)
                    assert_int_equal(s.px[2 * i] << 8 | s.px[2 * i + 1], whole.rgb565[(size_t)y * W + i]);
                drawn++;
            }
            assert_int_equal(zs_frame_skip(&r), 0);
            assert_int_equal(zs_frame_strip(&r, &s), 0);
            assert_int_equal(zs_frame_stats(&r)->strips, drawn);
            assert_int_equal(zs_frame_end(&r), ZS_OK);
            assert_int_equal(zs_frame_skip(&r), ZS_ERR_STATE);
            assert_int_equal(zs_frame_skip(NULL), ZS_ERR_NULL);
            free(arena);
            sim_frame_free(&whole);
        }
}

/* What a frame is refused for comes from each thread, once. */
static void a_refused_frame(void **state)
{
    (void)state;
    struct demo_frame f;
    struct sim_frame frame;
    struct sim_frame_time time;
    struct zs_config c = config_of(&demo_teapot, 0, 10);
    demo_teapot.pose(&f, 0, W, H);
    c.attrs = 0;
    assert_int_equal(sim_frame_render_threads(&frame, &f.scene, &f.camera, &c, 3, &time), ZS_ERR_ATTRS);
    assert_null(frame.rgb565);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(frames_of_1_to_5_threads),
                                        cmocka_unit_test(more_threads_than_strips),
                                        cmocka_unit_test(strips_left_out_at_random), cmocka_unit_test(a_refused_frame) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
