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

#include "core/fast.h"
#include "fast_lists.h"
#include "frame.h"
#include "prng.h"
#include "scenes.h"
#include "scene_share.h"
#include "zs_check.h"

#define W 96
#define H 72
#define N ((size_t)W * H)

/* Pools for everything, or (kind 1) so small that the scene is walked for a band of strips or for one, in sets;
 * kind 2: no accelerators. */
static struct zs_config config_of(const struct demo *demo, int kind, uint16_t strip_h)
{
    struct zs_config c;
    sim_frame_config(&c, W, H, (uint8_t)demo->varyings);
    c.strip_h = strip_h;
    c.depth = demo->depth;
    if (kind == 1)
        c.max_tris = c.max_verts = 150;
    if (kind == 2)
        c.fast = NULL;
    return c;
}

static int never(struct zs_renderer *r, const struct zs_bounds *b)
{
    (void)r, (void)b;
    return 0;
}

/* All accelerators, of which zs_fast_tiles drops triangles alone: which instances are dropped depends on the strips to
 * come. */
static const struct zs_fast *const *whole_instances(void)
{
    static const struct zs_fast *list[32];
    static struct zs_fast_tiles tiles;
    static struct zs_fast fast;
    size_t n = 0;
    for (const struct zs_fast *const *at = fast_all; *at; at++) {
        list[n] = *at;
        if ((*at)->tiles) {
            tiles = *(*at)->tiles;
            tiles.hides_sphere = never;
            fast = **at;
            fast.tiles = &tiles;
            list[n] = &fast;
        }
        n++;
    }
    list[n] = NULL;
    return list;
}

static uint64_t hidden; /* set-ups that were saved in frames whose counts are compared */

/* *parts: that the triangles were drawn in; NULL: not asked. drops, a flag: instances may be. */
static void check_list(const struct demo_frame *f, const struct zs_config *c, int drops, uint32_t threads,
                       uint32_t *parts)
{
    struct sim_frame one, many;
    struct sim_frame_time time;
    assert_int_equal(sim_frame_render(&one, &f->scene, &f->camera, c, NULL), ZS_OK);
    assert_int_equal(sim_frame_render_threads(&many, &f->scene, &f->camera, c, threads, &time), ZS_OK);
    assert_memory_equal(many.rgb565, one.rgb565, N * 2);
    assert_memory_equal(many.key, one.key, N * 2);
    const struct zs_stats *a = &one.stats, *b = &many.stats;
    assert_int_equal(b->tris_in, a->tris_in);
    if (!drops) {
        assert_int_equal(b->tris_drawn, a->tris_drawn);
        assert_int_equal(b->tris_facing, a->tris_facing);
    }
    assert_int_equal(b->strips, a->strips);
    assert_int_equal(b->tris_in, b->tris_drawn + b->tris_frustum + b->tris_cluster + b->tris_near + b->tris_far +
                                     b->tris_offscreen + b->tris_facing + b->tris_zero + b->tris_empty + b->tris_index);
    assert_int_equal(b->instances_in, a->instances_in);
    if (!drops) {
        assert_int_equal(b->tris_clipped, a->tris_clipped);
        assert_int_equal(b->instances_culled, a->instances_culled);
    }
    if (parts)
        *parts = time.parts;
    /* hidden triangles are not known across sets and parts; what is dropped depends on the strips that are to be
     * drawn */
    if (a->passes == 1 && !time.parts && !drops) {
        hidden += a->tris_hidden;
        assert_int_equal(b->tris_setup, a->tris_setup);
        assert_int_equal(b->tris_hidden, a->tris_hidden);
        assert_int_equal(b->pixels_tested, a->pixels_tested);
        assert_int_equal(b->pixels_written, a->pixels_written);
    }
    sim_frame_free(&one);
    sim_frame_free(&many);
}

static void check(const struct demo_frame *f, const struct zs_config *c, uint32_t threads, uint32_t *parts)
{
    check_list(f, c, c->fast != NULL, threads, parts);
}

static void frames_of_1_to_5_threads(void **state)
{
    uint32_t by_parts = 0, by_strips = 0, parts;
    for (uint32_t d = 0; d < n_demos; d++) {
        struct demo_frame f;
        demos[d]->pose(&f, 7, W, H);
        for (uint32_t threads = 1; threads <= 5; threads++)
            for (int kind = 0; kind < 3; kind++) {
                struct zs_config c = config_of(demos[d], kind, kind == 0 ? 5 : 10);
                check(&f, &c, threads, NULL);
                c.fast = c.fast ? whole_instances() : NULL;
                check_list(&f, &c, 0, threads, &parts);
                by_parts += parts > 1 && parts % threads == 0;
                by_strips += !parts;
            }
    }
    assert_true(by_parts > 20 && by_strips > 20); /* both ways have been taken */
    assert_true(hidden > 0);
}

static void more_threads_than_strips(void **state)
{
    struct demo_frame f;
    demo_cubes.pose(&f, 0, W, H);
    for (int kind = 0; kind < 2; kind++) {
        const struct zs_config c = config_of(&demo_cubes, kind, 30);
        check(&f, &c, SIM_THREADS_MAX, NULL);
    }
}

static void strip_is(const struct zs_strip *s, const struct sim_frame *whole)
{
    for (size_t i = 0; i < (size_t)W * s->h; i++)
        assert_int_equal(s->px[2 * i] << 8 | s->px[2 * i + 1], whole->rgb565[(size_t)s->y * W + i]);
}

/* Any strips may be left out: the others are as they are, with two buffers the one that was given out before too. */
static void strips_left_out_at_random(void **state)
{
    struct prng p = { 11 };
    for (uint32_t d = 0; d < n_demos; d++)
        for (int k = 0; k < 12; k++) {
            struct zs_renderer r;
            struct zs_strip s, before = { 0 };
            struct demo_frame f;
            struct sim_frame whole;
            struct zs_config c = config_of(demos[d], k % 3, (uint16_t)(1 + prng_pick(&p, 20)));
            c.buffers = (uint8_t)(1 + prng_pick(&p, 2));
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
                assert_memory_equal(s.depth, whole.key + (size_t)y * W, (size_t)W * s.h * 2);
                strip_is(&s, &whole);
                if (drawn && c.buffers == 2)
                    strip_is(&before, &whole);
                before = s;
                drawn++;
            }
            assert_int_equal(zs_frame_skip(&r), 0);
            assert_int_equal(zs_frame_strip(&r, &s), 0);
            assert_int_equal(zs_frame_stats(&r)->strips - zs_frame_stats(&r)->strips_skipped, drawn);
            assert_int_equal(zs_frame_stats(&r)->strips, r.n_strips); /* those that were left out count as given out */
            assert_int_equal(zs_frame_end(&r), ZS_OK);
            assert_int_equal(zs_frame_skip(&r), ZS_ERR_SEQUENCE);
            assert_int_equal(zs_frame_skip(NULL), ZS_ERR_NULL);
            free(arena);
            sim_frame_free(&whole);
        }
}

/* Parts that share vertices, keys that are equal, numbers of vertices that there are not: a mesh twice in the same
 * place, and twice another of its triangles in no order, cut anywhere. */
static void parts_meet_anywhere(void **state)
{
    static uint16_t tri[2520][3], raw[2520];
    static struct zs_cluster cluster[40];
    struct prng p = { 5 };
    struct demo_frame f;
    struct zs_mesh odd = *(demo_mesh.pose(&f, 0, W, H), f.instance[0].mesh);
    assert_int_equal(odd.n_tris, 2520);
    for (uint32_t t = 0; t < odd.n_tris; t++) {
        const uint32_t from = prng_pick(&p, odd.n_tris); /* in no order: vertices of a part lie anywhere */
        memcpy(tri[t], odd.tri[from], sizeof tri[t]);
        raw[t] = (uint16_t)(t * 40503u);
        if (prng_pick(&p, 50) == 0)
            tri[t][prng_pick(&p, 3)] = (uint16_t)(odd.n_verts + prng_pick(&p, 65536u - odd.n_verts));
    }
    for (uint32_t i = 0; i < 40; i++) { /* spheres and cones that hold everything */
        cluster[i] = (struct zs_cluster){ .first = 63 * i, .n_tris = 63, .radius = odd.radius, .cutoff = 127 };
        memcpy(cluster[i].center, odd.center, sizeof odd.center);
    }
    odd.tri = (const uint16_t (*)[3])tri;
    odd.face_raw = raw;
    odd.cluster = cluster;
    odd.n_clusters = 40;
    for (uint32_t i = 1; i < 4; i++) {
        f.instance[i] = f.instance[0];
        f.instance[i].mesh = i == 1 ? f.instance[0].mesh : &odd;
    }
    f.scene.n_instances = 4;
    for (uint32_t n_tris = 2520; n_tris > 1800; n_tris -= 1 + prng_pick(&p, 200)) {
        odd.n_tris = n_tris;
        odd.n_clusters = (n_tris + 62) / 63;
        cluster[odd.n_clusters - 1].n_tris = (uint16_t)(n_tris - 63 * (odd.n_clusters - 1));
        for (int kind = 0; kind < 3; kind++) {
            const struct zs_config c = config_of(&demo_mesh, kind, 7);
            uint32_t parts;
            check(&f, &c, 2 + prng_pick(&p, 6), &parts);
            assert_true(parts > 1);
        }
    }
}

/* What is cut out of a mesh is a sound mesh itself, clusters too, and has each triangle once. */
static void shares_are_sound_meshes(void **state)
{
    struct zs_cluster cluster[40];
    struct prng p = { 6 };
    struct demo_frame f;
    struct zs_mesh whole = *(demo_mesh.pose(&f, 0, W, H), f.instance[0].mesh);
    for (uint32_t i = 0; i < 40; i++) {
        cluster[i] = (struct zs_cluster){ .first = 63 * i, .n_tris = 63, .radius = whole.radius, .cutoff = 127 };
        memcpy(cluster[i].center, whole.center, sizeof whole.center);
    }
    whole.cluster = cluster;
    whole.n_clusters = 40;
    f.instance[0].mesh = &whole;
    for (int k = 0; k < 200; k++) {
        const uint32_t first = prng_pick(&p, 2520), end = first + 1 + prng_pick(&p, 2520 - first);
        struct sim_share share;
        sim_share_make(&share, &f.scene, first, end);
        const struct zs_mesh *mesh = share.instance[0].mesh;
        assert_int_equal(zs_mesh_check(mesh, NULL), ZS_FLAW_NONE);
        assert_int_equal(mesh->n_tris, end - first);
        assert_true(mesh->n_clusters >= mesh->n_tris / 63 && mesh->n_clusters <= mesh->n_tris / 63 + 2);
        for (uint32_t t = 0; t < mesh->n_tris; t++)
            for (int j = 0; j < 3; j++)
                assert_memory_equal(mesh->pos[mesh->tri[t][j]], whole.pos[whole.tri[first + t][j]], sizeof *whole.pos);
        sim_share_free(&share);
    }
}

/* A state minds what was drawn before: such scenes are shared out by strips. */
static void states_are_not_drawn_in_parts(void **state)
{
    static const struct zs_depth_state later = { .func = ZS_DEPTH_LESS_EQUAL };
    uint32_t parts;
    struct demo_frame f;
    demo_mesh.pose(&f, 0, W, H);
    const struct zs_config c = config_of(&demo_mesh, 0, 7);
    check(&f, &c, 2, &parts);
    assert_int_equal(parts, 2);
    f.instance[1] = f.instance[0];
    f.instance[1].depth_state = &later;
    f.scene.n_instances = 2;
    check(&f, &c, 2, &parts);
    assert_int_equal(parts, 0);
}

/* What a frame is refused for comes from each thread, once. */
static void a_refused_frame(void **state)
{
    struct demo_frame f;
    struct sim_frame frame;
    struct sim_frame_time time;
    struct zs_config c = config_of(&demo_teapot, 0, 10);
    demo_teapot.pose(&f, 0, W, H);
    c.varyings = 0;
    assert_int_equal(sim_frame_render_threads(&frame, &f.scene, &f.camera, &c, 3, &time), ZS_ERR_VARYINGS);
    assert_null(frame.rgb565);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(frames_of_1_to_5_threads),
                                        cmocka_unit_test(more_threads_than_strips),
                                        cmocka_unit_test(parts_meet_anywhere),
                                        cmocka_unit_test(shares_are_sound_meshes),
                                        cmocka_unit_test(states_are_not_drawn_in_parts),
                                        cmocka_unit_test(strips_left_out_at_random),
                                        cmocka_unit_test(a_refused_frame) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
