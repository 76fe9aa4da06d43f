/* A frame (core/frame.c): calls out of order, frames that are begun anew in the middle, and sinks that fail.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "good.h"
#include "picture.h"

/* ---- The order of calls ------------------------------------------------------------------------------------------ */

/* A renderer whose set-up failed, or that never had one, can only be set up. */
static void nothing_works_before_init(void **state)
{
    const struct good g = good_scene();
    struct zs_renderer r;
    struct zs_strip strip;
    struct zs_config bad = g.config;
    uint32_t arena[4];
    memset(&r, 0, sizeof r);
    for (int n = 0; n < 2; n++) {
        assert_int_equal(zs_frame_begin(&r, &g.scene, &g.camera), ZS_ERR_SEQUENCE);
        assert_int_equal(zs_frame_strip(&r, &strip), ZS_ERR_SEQUENCE);
        assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);
        bad.buffers = 9;
        assert_int_equal(zs_init(&r, n ? &bad : &g.config, arena, sizeof arena),
                         n ? ZS_ERR_SIZE : ZS_ERR_ARENA);
    }
}

static void calls_out_of_order(void **state)
{
    const struct good g = good_scene();
    struct zs_renderer r;
    struct zs_strip s;
    const uint32_t bytes = zs_arena_bytes(&g.config);
    void *arena = malloc(bytes);
    assert_int_equal(zs_init(&r, &g.config, arena, bytes), ZS_OK);
    assert_int_equal(zs_frame_strip(&r, &s), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_begin(NULL, &g.scene, &g.camera), ZS_ERR_NULL);
    assert_int_equal(zs_frame_begin(&r, NULL, &g.camera), ZS_ERR_NULL);
    assert_int_equal(zs_frame_begin(&r, &g.scene, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_frame_strip(NULL, &s), ZS_ERR_NULL);
    assert_int_equal(zs_frame_end(NULL), ZS_ERR_NULL);
    assert_int_equal(zs_frame_strip(&r, &s), ZS_ERR_SEQUENCE);

    assert_int_equal(zs_frame_begin(&r, &g.scene, &g.camera), ZS_OK);
    assert_int_equal(zs_frame_strip(&r, NULL), ZS_ERR_NULL);
    for (int n = 0; n < 5; n++) { /* 30 rows, strips of 7 */
        assert_int_equal(zs_frame_strip(&r, &s), 1);
        assert_int_equal(s.y, 7 * n);
        assert_int_equal(s.h, n < 4 ? 7 : 2);
        assert_int_equal(s.n_bytes, 40 * s.h * 2);
    }
    assert_int_equal(zs_frame_strip(&r, &s), 0);
    assert_int_equal(zs_frame_strip(&r, &s), 0);
    assert_int_equal(zs_frame_end(&r), ZS_OK);
    assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_strip(&r, &s), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_stats(&r)->strips, 5); /* still there */

    /* a frame that is refused leaves no frame open */
    assert_int_equal(zs_frame_begin(&r, &g.scene, &g.camera), ZS_OK);
    struct zs_camera bad = g.camera;
    bad.focal = 0;
    assert_int_equal(zs_frame_begin(&r, &g.scene, &bad), ZS_ERR_CAMERA);
    assert_int_equal(zs_frame_strip(&r, &s), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);
    free(arena);
}

/* The rows of *p from strips, against the plain picture. */
static void strips_are(struct zs_renderer *r, const struct picture *p)
{
    struct zs_strip s;
    int32_t rows = 0;
    while (zs_frame_strip(r, &s) == 1) {
        for (int32_t i = 0; i < s.w * s.h; i++) {
            assert_int_equal(s.px[2 * i] << 8 | s.px[2 * i + 1], p->color[s.y * p->w + i]);
            assert_int_equal(s.depth[i], p->key[s.y * p->w + i]);
        }
        rows += s.h;
    }
    assert_int_equal(rows, p->h);
}

static void begin_in_the_middle_of_a_frame(void **state)
{
    const struct good g = good_scene();
    struct zs_config small = g.config;
    struct zs_strip s;
    struct picture plain = picture_draw(&g.config, &g.scene, &g.camera);
    for (int pools = 0; pools < 2; pools++) {
        small.max_tris = pools ? 3 : 200;
        small.max_verts = pools ? 5 : 200;
        small.strip_h = 4;
        struct zs_renderer r;
        const uint32_t bytes = zs_arena_bytes(&small);
        void *arena = malloc(bytes);
        assert_int_equal(zs_init(&r, &small, arena, bytes), ZS_OK);
        for (int n = 0; n < 8; n++) { /* dropped after n strips, or ended there */
            assert_int_equal(zs_frame_begin(&r, &g.scene, &g.camera), ZS_OK);
            for (int k = 0; k < n; k++)
                assert_int_equal(zs_frame_strip(&r, &s), 1);
            if (n % 2)
                assert_int_equal(zs_frame_end(&r), ZS_OK);
            assert_int_equal(zs_frame_begin(&r, &g.scene, &g.camera), ZS_OK);
            strips_are(&r, &plain);
            assert_int_equal(zs_frame_stats(&r)->tris_in, plain.stats.tris_in);
            assert_int_equal(zs_frame_stats(&r)->tris_drawn, plain.stats.tris_drawn);
            assert_int_equal(zs_frame_end(&r), ZS_OK);
        }
        free(arena);
    }
    picture_free(&plain);
}

/* ---- Sinks ----------------------------------------------------------------------------------- */

struct failing {
    int submits, waits, lent;
    int fail_submit, fail_wait; /* at this call, from 1 */
    int most_lent;
};

static int failing_submit(void *ctx, const struct zs_strip *s)
{
    struct failing *f = ctx;
    (void)s;
    if (++f->submits == f->fail_submit)
        return -777;
    f->lent++;
    f->most_lent = f->lent > f->most_lent ? f->lent : f->most_lent;
    return 0;
}

static int failing_wait(void *ctx)
{
    struct failing *f = ctx;
    f->lent--;
    return ++f->waits == f->fail_wait ? -888 : 0;
}

static void sink_errors_are_passed_on(void **state)
{
    const struct good g = good_scene();
    struct picture plain = picture_draw(&g.config, &g.scene, &g.camera);
    for (uint8_t buffers = 1; buffers <= 2; buffers++)
        for (int at = 1; at <= 6; at++)
            for (int in_wait = 0; in_wait < 2; in_wait++) {
                struct zs_config c = g.config;
                c.buffers = buffers;
                struct zs_renderer r;
                struct failing f = { 0 };
                const uint32_t bytes = zs_arena_bytes(&c);
                void *arena = malloc(bytes);
                assert_int_equal(zs_init(&r, &c, arena, bytes), ZS_OK);
                *(in_wait ? &f.fail_wait : &f.fail_submit) = at;
                const struct zs_sink sink = { .submit = failing_submit, .wait = failing_wait, .ctx = &f };
                const int want = at > 5 ? ZS_OK : in_wait ? -888 : -777; /* five strips */
                assert_int_equal(zs_render(&r, &g.scene, &g.camera, &sink), want);
                assert_int_equal(f.lent, 0); /* everything has been waited for */
                assert_int_equal(f.most_lent, at == 1 && !in_wait ? 0 : 1);
                /* no frame is open, and the next one is right */
                assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);
                assert_int_equal(zs_frame_begin(&r, &g.scene, &g.camera), ZS_OK);
                strips_are(&r, &plain);
                free(arena);
            }
    struct zs_renderer r;
    const struct zs_sink none = { 0 };
    memset(&r, 0, sizeof r);
    assert_int_equal(zs_render(&r, &g.scene, &g.camera, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_render(&r, &g.scene, &g.camera, &none), ZS_ERR_NULL);
    const struct zs_sink sink = { .submit = failing_submit, .ctx = &(struct failing){ 0 } };
    assert_int_equal(zs_render(&r, &g.scene, &g.camera, &sink), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_render(NULL, &g.scene, &g.camera, &sink), ZS_ERR_NULL);
    picture_free(&plain);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(nothing_works_before_init),
    cmocka_unit_test(calls_out_of_order),
    cmocka_unit_test(begin_in_the_middle_of_a_frame),
    cmocka_unit_test(sink_errors_are_passed_on),
};

CASES_MAIN(tests)
