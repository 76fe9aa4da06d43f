/* What the simulator counts by pixel and strip: it sums up to what the renderer says of a frame that nobody looks on
 * at, the frame is the same, and the pixels are those of the triangles drawn one by one.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pixel_counts.h"
#include "core/raster_fast.h"
#include "internals.h"
#include "fast_lists.h"
#include "scenes.h"

#define W 96
#define H 72
#define N ((size_t)W * H)

/* All accelerators but one. */
static const struct zs_fast *const *all_but(const char *name)
{
    unsigned k = 0;
    while (k < fast_count() && strcmp(fast_name(k), name) != 0)
        k++;
    assert_true(k < fast_count());
    return fast_without(k);
}

static struct zs_config config_of(const struct demo *demo, const struct zs_fast *const *fast)
{
    struct zs_config c;
    sim_frame_config(&c, W, H, (uint8_t)demo->varyings);
    c.strip_h = 10; /* seven strips, and one of two rows */
    c.depth = demo->depth;
    c.fast = fast;
    return c;
}

static uint64_t sum(const uint32_t *map, size_t n)
{
    uint64_t s = 0;
    for (size_t i = 0; i < n; i++)
        s += map[i];
    return s;
}

/* Counts of a configuration against the frame that zs_render draws by itself. Return what it says of it. */
static struct zs_stats check_frame(const struct demo_frame *f, const struct zs_config *c)
{
    struct sim_frame frame;
    struct sim_counts counts;
    assert_int_equal(sim_frame_render(&frame, &f->scene, &f->camera, c, NULL), ZS_OK);
    assert_int_equal(sim_counts_draw(&counts, &f->scene, &f->camera, c), ZS_OK);
    assert_memory_equal(counts.frame.rgb565, frame.rgb565, N * 2);
    assert_memory_equal(counts.frame.key, frame.key, N * 2);
    assert_memory_equal(&counts.frame.stats, &frame.stats, sizeof frame.stats);
    assert_true(sum(counts.tested, N) == frame.stats.pixels_tested);
    assert_true(sum(counts.untested, N) == frame.stats.pixels_untested);
    assert_true(sum(counts.written, N) == frame.stats.pixels_written);
    assert_int_equal(counts.n_strips, 8);
    assert_true(sum(counts.setups, counts.n_strips) == frame.stats.tris_setup);
    for (size_t i = 0; i < N; i++) {
        assert_true(counts.written[i] <= counts.tested[i]);
        assert_true((counts.written[i] > 0) == (frame.key[i] != ZS_DEPTH_CLEAR));
    }
    const struct zs_stats stats = frame.stats;
    sim_counts_free(&counts);
    sim_frame_free(&frame);
    return stats;
}

static void sums_of_every_scene(void **state)
{
    const struct zs_fast *const *const list[] = { fast_all, all_but("tiles"), NULL, all_but("touch"),
                                                  all_but("edges") };
    uint64_t untested = 0, hidden = 0;
    for (uint32_t d = 0; d < n_demos; d++)
        for (uint32_t t = 0; t < demos[d]->frames && t < 40; t += 21)
            for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
                struct demo_frame f;
                struct zs_config c = config_of(demos[d], list[k]);
                demos[d]->pose(&f, t, W, H);
                const struct zs_stats s = check_frame(&f, &c);
                if (k == 0) {
                    untested += s.pixels_untested;
                    hidden += s.tris_hidden;
                }
                assert_true(list[k] != NULL || s.pixels_untested + s.tris_hidden + s.clusters_in == 0);
                c.max_tris = 300; /* several passes, most of them sets of one strip */
                c.max_verts = 300;
                c.buffers = 1;
                check_frame(&f, &c);
            }
    assert_true(untested > 0 && hidden > 0);
}

/* A scene of which parts are drawn: what is left out has no triangles, but its place. */
struct part {
    struct zs_scene scene;
    struct zs_instance instance[DEMO_INSTANCES_MAX];
    struct zs_mesh mesh[DEMO_INSTANCES_MAX];
};

static void keys_of(uint16_t key[], struct part *p, const struct demo_frame *f, const struct zs_config *c)
{
    struct sim_frame frame;
    p->scene.instance = p->instance;
    assert_int_equal(sim_frame_render(&frame, &p->scene, &f->camera, c, NULL), ZS_OK);
    memcpy(key, frame.key, N * sizeof *key);
    sim_frame_free(&frame);
}

/* Triangle t of instance i: alone, or with all that come before it. */
static void part_of(struct part *p, const struct demo_frame *f, uint32_t i, uint32_t t, int alone)
{
    p->scene = f->scene;
    for (uint32_t k = 0; k < f->scene.n_instances; k++) {
        p->instance[k] = f->scene.instance[k];
        p->mesh[k] = *p->instance[k].mesh;
        p->instance[k].mesh = &p->mesh[k];
        if (k > i || (alone && k < i))
            p->mesh[k].n_tris = 0;
    }
    p->mesh[i].n_tris = alone ? 1 : t + 1;
    if (alone)
        p->mesh[i].tri += t;
    if (alone && p->mesh[i].face_normal)
        p->mesh[i].face_normal += t;
}

/* Coverage is the sum of every triangle alone; a pixel is written where a triangle more changes its key. */
static void pixels_of_every_triangle(void **state)
{
    static const struct demo *const some[] = { &demo_cubes, &demo_corridor, &demo_layers_mixed };
    for (size_t d = 0; d < sizeof some / sizeof some[0]; d++) {
        static uint16_t alone[N], before[N], now[N];
        static uint32_t cover[N], written[N];
        static struct part p;
        struct demo_frame f;
        struct sim_counts counts;
        const struct zs_config c = config_of(some[d], all_but("tiles"));
        some[d]->pose(&f, 0, W, H);
        memset(before, 0xff, sizeof before);
        memset(cover, 0, sizeof cover);
        memset(written, 0, sizeof written);
        for (uint32_t i = 0; i < f.scene.n_instances; i++)
            for (uint32_t t = 0; t < f.scene.instance[i].mesh->n_tris; t++) {
                part_of(&p, &f, i, t, 1);
                keys_of(alone, &p, &f, &c);
                part_of(&p, &f, i, t, 0);
                keys_of(now, &p, &f, &c);
                for (size_t k = 0; k < N; k++) {
                    cover[k] += alone[k] != ZS_DEPTH_CLEAR;
                    written[k] += now[k] != before[k];
                }
                memcpy(before, now, sizeof before);
            }
        assert_int_equal(sim_counts_draw(&counts, &f.scene, &f.camera, &c), ZS_OK);
        assert_memory_equal(counts.tested, cover, sizeof cover);
        assert_memory_equal(counts.written, written, sizeof written);
        sim_counts_free(&counts);
    }
}

/* Eight layers that fill the frame: how often each pixel is compared and written, in which order they come. */
static void eight_layers(void **state)
{
    static const struct {
        const struct demo *demo;
        uint32_t written; /* without zs_fast_tiles */
    } order[] = { { &demo_layers_ftb, 1 }, { &demo_layers_btf, 8 }, { &demo_layers_mixed, 2 } };
    for (size_t d = 0; d < 3; d++)
        for (int tiles = 0; tiles < 2; tiles++) {
            struct demo_frame f;
            struct sim_counts counts;
            const struct zs_config c = config_of(order[d].demo, tiles ? fast_all : all_but("tiles"));
            order[d].demo->pose(&f, 0, W, H);
            assert_int_equal(sim_counts_draw(&counts, &f.scene, &f.camera, &c), ZS_OK);
            for (size_t i = 0; i < N; i++) {
                assert_int_equal(counts.tested[i], tiles ? 1 : 8);
                assert_int_equal(counts.written[i], tiles ? 1 : order[d].written);
            }
            sim_counts_free(&counts);
        }
}

/* What a frame of every scene takes, in one pass and where pools are small: no more than this, which is what it took
 * when it was written down. An accelerator that saves less draws the same picture: here it shows. Less is welcome. */
struct work {
    const char *scene;
    uint32_t verts[2], setups[2], tested[2], met[2]; /* met: tested where something had been drawn before */
    uint32_t binned, instances, clusters, clusters_in; /* drawn, or not left out, in one pass */
    uint32_t at_once; /* triangles in strips that zs_fast.draw has drawn, in one pass: no fewer */
};

static const struct work work[] = {
#include "work.h"
};

/* Accelerators that count what `draw` takes. */
#define FAST_MAX 32
static struct counted_fast {
    struct zs_fast fast;
    int (*draw_of)(struct zs_job *job);
} counted[FAST_MAX];
static uint32_t at_once;

static int counted_draw(struct zs_job *job)
{
    zs_fast_chain(job, NULL); /* one triangle a call */
    const int done = ((const struct counted_fast *)(const void *)job->fast)->draw_of(job);
    at_once += (uint32_t)done;
    return done;
}

static const struct zs_fast *const *count_draws(void)
{
    static const struct zs_fast *list[FAST_MAX + 1];
    unsigned n = 0;
    for (; fast_all[n] != NULL; n++) {
        assert_true(n < FAST_MAX);
        counted[n].fast = *fast_all[n];
        counted[n].draw_of = fast_all[n]->draw;
        if (counted[n].draw_of)
            counted[n].fast.draw = counted_draw;
        list[n] = &counted[n].fast;
    }
    list[n] = NULL;
    return list;
}

static struct work work_of(const struct demo *demo)
{
    struct work w = { demo->name, { 0 }, { 0 }, { 0 }, { 0 }, 0, 0, 0, 0, 0 };
    for (int small = 0; small < 2; small++)
        for (uint32_t t = 0; t < demo->frames && t < 40; t += 21) {
            struct demo_frame f;
            struct sim_frame frame;
            struct zs_config c = config_of(demo, count_draws());
            demo->pose(&f, t, W, H);
            if (small)
                c.max_tris = c.max_verts = 300;
            at_once = 0;
            assert_int_equal(sim_frame_render(&frame, &f.scene, &f.camera, &c, NULL), ZS_OK);
            const struct zs_stats *s = &frame.stats;
            w.verts[small] += s->verts_transformed;
            w.setups[small] += s->tris_setup;
            w.tested[small] += s->pixels_tested;
            w.met[small] += s->pixels_tested - s->pixels_untested;
            if (!small) {
                w.binned += s->tris_drawn;
                w.instances += s->instances_in - s->instances_culled;
                w.clusters += s->clusters_in - s->clusters_culled;
                w.clusters_in += s->clusters_in;
                w.at_once += at_once;
            }
            sim_frame_free(&frame);
        }
    return w;
}

static void no_more_work_than_known(void **state)
{
    const int print = getenv("ZS_WORK") != NULL; /* the lines of work.h */
    for (uint32_t d = 0; d < n_demos; d++) {
        const struct work now = work_of(demos[d]), *known = NULL;
        if (print)
            print_message("{ \"%s\", { %u, %u }, { %u, %u }, { %u, %u }, { %u, %u }, %u, %u, %u, %u, %u },\n",
                          now.scene, now.verts[0], now.verts[1], now.setups[0], now.setups[1], now.tested[0],
                          now.tested[1], now.met[0], now.met[1], now.binned, now.instances, now.clusters,
                          now.clusters_in, now.at_once);
        for (size_t k = 0; k < sizeof work / sizeof *work; k++)
            if (!strcmp(work[k].scene, now.scene))
                known = &work[k];
        if (print || !known)
            continue;
        const uint32_t *is = now.verts, *was = known->verts;
        if (now.at_once < known->at_once)
            fail_msg("%s: %u triangles drawn at once, were %u", now.scene, now.at_once, known->at_once);
        for (int k = 0; k < 12; k++) /* from verts to clusters_in */
            if (is[k] > was[k])
                fail_msg("%s: number %d of its work is %u, was %u", now.scene, k, is[k], was[k]);
    }
}

/* Meshes of four clusters are drawn whole, without asking; of five they are asked. */
static void few_clusters_are_not_asked(void **state)
{
    static struct part p;
    uint32_t asked[6] = { 0 };
    for (uint32_t n = 1; n <= 5; n++) {
        struct demo_frame f;
        struct sim_frame frame;
        const struct zs_config c = config_of(&demo_flyover, fast_all);
        demo_flyover.pose(&f, 0, W, H);
        part_of(&p, &f, f.scene.n_instances - 1, 0, 0);
        p.scene.instance = p.instance;
        for (uint32_t k = 0; k < f.scene.n_instances; k++) {
            p.mesh[k] = *f.scene.instance[k].mesh;
            p.mesh[k].n_clusters = (uint16_t)(p.mesh[k].n_clusters < n ? p.mesh[k].n_clusters : n);
        }
        assert_int_equal(sim_frame_render(&frame, &p.scene, &f.camera, &c, NULL), ZS_OK);
        asked[n] = frame.stats.clusters_in;
        sim_frame_free(&frame);
    }
    assert_true(asked[1] + asked[2] + asked[3] + asked[4] == 0 && asked[5] > 0);
}

static int lists(const struct zs_fast *const *list, const struct zs_fast *fast)
{
    while (*list && *list != fast)
        list++;
    return *list == fast;
}

/* The scenes' own lists name what is for their shaders, texels and clusters, and nothing else of these. */
static void lists_of_scenes_are_of_what_is_in_them(void **state)
{
    for (uint32_t d = 0; d < n_demos; d++)
        for (const struct zs_fast *const *at = fast_all; *at; at++) {
            struct demo_frame f;
            int used = !(*at)->shader && !(*at)->format && !(*at)->clusters;
            demos[d]->pose(&f, 0, W, H);
            for (uint32_t i = 0; i < f.scene.n_instances; i++) {
                const struct zs_material *m = f.scene.instance[i].material;
                used |= (*at)->shader && (*at)->shader == m->shader;
                used |= (*at)->format && m->texture && (*at)->format == m->texture->format;
                used |= (*at)->clusters && f.scene.instance[i].mesh->n_clusters > 0;
            }
            if (lists(demos[d]->fast, *at) != used)
                fail_msg("%s lists %s", demos[d]->name, used ? "too little" : "too much");
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(lists_of_scenes_are_of_what_is_in_them),
                                        cmocka_unit_test(sums_of_every_scene),
                                        cmocka_unit_test(pixels_of_every_triangle),
                                        cmocka_unit_test(eight_layers),
                                        cmocka_unit_test(no_more_work_than_known),
                                        cmocka_unit_test(few_clusters_are_not_asked) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
