/* The walk (core/walk.c): pools that hold next to nothing draw the same frame with the same counts, nothing twice, and
 * go on where they were full: in the middle of a mesh, of a clipped triangle's fan, of a cluster.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "clusters.h"
#include "fast_lists.h"
#include "picture.h"
#include "shapes.h"
#include "things.h"

#define W 70
#define H 50

/* ---- Counts that pools and strips do not change ---------------------------------------------- */

#define FIELD(name) { offsetof(struct zs_stats, name), #name }
static const struct {
    size_t at;
    const char *name;
} fields[] = {
    FIELD(instances_in), FIELD(instances_culled), FIELD(instances_hidden), FIELD(clusters_in), FIELD(clusters_culled),
    FIELD(tris_in), FIELD(tris_drawn), FIELD(tris_frustum), FIELD(tris_cluster), FIELD(tris_near), FIELD(tris_far),
    FIELD(tris_offscreen), FIELD(tris_facing), FIELD(tris_zero), FIELD(tris_empty), FIELD(tris_index),
    FIELD(tris_clipped),
    /* of one strip height, where nothing is hidden: a triangle in a strip is set up once, in whichever set it is */
    FIELD(tris_setup), FIELD(pixels_tested), FIELD(pixels_written)
};
#define FIELDS (sizeof fields / sizeof fields[0])
#define FIELDS_OF_SCENE (FIELDS - 3)

static int counts_same(const struct zs_stats *a, const struct zs_stats *b, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        uint32_t of[2];
        memcpy(&of[0], (const uint8_t *)a + fields[k].at, sizeof of[0]);
        memcpy(&of[1], (const uint8_t *)b + fields[k].at, sizeof of[1]);
        if (of[0] != of[1])
            return case_wrong("%s is %u, and %u", fields[k].name, of[0], of[1]);
    }
    return 1;
}

/* ---- Fans ------------------------------------------------------------------------------------ */

static uint32_t fans[10]; /* how many had so many pieces */

/* A triangle around the eye or beside it, so that it is cut; pools of one triangle take a pass for each piece. */
static int fan_case(uint64_t seed)
{
    static struct lone l;
    struct prng p = { seed };
    int16_t pos[3][3];
    const int32_t reach = 200 << prng_pick(&p, 8);
    for (int k = 0; k < 9; k++)
        pos[k / 3][k % 3] = (int16_t)(prng_range(&p, -reach, reach) / (prng_pick(&p, 3) ? 1 : 16));
    lone_set(&l, (const int16_t (*)[3])pos, 3, ZS_Q16_ONE << prng_pick(&p, 8));
    l.instance.pose.pos[2] = -prng_range(&p, 0, reach);
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, (zs_turn)prng_range(&p, 100, 20000), H, prng_range(&p, 1, 200),
                                3 * reach + 300);
    struct zs_config c = lone_config(W, H, seed % 2 ? &zs_depth_recip : &zs_depth_e4m12);
    c.fast = seed % 3 ? NULL : fast_of(FAST_ALL & ~FAST_TILES & ~FAST_TOUCH);
    struct picture ample = picture_draw(&c, &l.scene, &camera);
    if (ample.err) { /* a camera that is refused */
        picture_free(&ample);
        return 1;
    }
    const uint32_t pieces = ample.stats.max_tris_used;
    CASE_CHECK(ample.stats.passes == 1 && pieces <= 7);
    fans[ample.stats.tris_clipped ? pieces : 9]++;
    for (uint16_t tris = 1; tris <= 3; tris++) {
        c.max_tris = tris;
        c.max_verts = (uint16_t)(3 * tris);
        struct picture f = picture_draw(&c, &l.scene, &camera);
        int ok = picture_same(&ample, &f, "a fan") && counts_same(&ample.stats, &f.stats, FIELDS);
        if (ok && tris == 1 && f.stats.passes != (pieces ? pieces : 1))
            ok = case_wrong("%u pieces, %u passes", pieces, f.stats.passes);
        picture_free(&f);
        if (!ok)
            return 0;
    }
    picture_free(&ample);
    return 1;
}

static void a_fan_goes_on_with_its_next_piece(void **state)
{
    memset(fans, 0, sizeof fans);
    CASES(fan_case, 4000);
    print_message("fans of 1 to 7 pieces: %u %u %u %u %u %u %u\n", fans[1], fans[2], fans[3], fans[4], fans[5],
                  fans[6], fans[7]);
    assert_true(!cases_all() || (fans[2] > 200 && fans[3] > 100 && fans[4] > 20 && fans[5] > 5));
}

/* ---- Scenes ---------------------------------------------------------------------------------- */

#define INSTANCES 5

static struct {
    struct shape shape[3];
    struct zs_cluster cluster[3][SHAPE_TRIS];
    struct things of;
} world;

/* The eye is among what it sees: all outcomes are met. Of two instances in one place, keys are equal. */
static void world_open(struct prng *p, int clusters)
{
    static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth };
    static const struct zs_depth *const depths[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_e3m13,
                                                     &zs_depth_e5m11 };
    memset(&world, 0, sizeof world);
    shape_soup(&world.shape[0], 5 + prng_pick(p, 40), 4000, prng_next(p));
    shape_sphere(&world.shape[1], 4 + prng_pick(p, 6), 5 + prng_pick(p, 8), 2500);
    shape_ground(&world.shape[2], 2 + prng_pick(p, 6), 9000, 700, prng_next(p));
    for (int n = 0; clusters && n < 3; n++)
        clusters_make(&world.shape[n].mesh, world.cluster[n], p, 1 + prng_pick(p, 12), 0);
    world.of.scene.light.dir[2] = ZS_Q30_ONE;
    world.of.scene.light.ambient = ZS_Q16_ONE / 4;
    world.of.scene.light.diffuse = ZS_Q16_ONE / 2;
    for (uint32_t n = 0; n < INSTANCES; n++) {
        world.of.material[n].shader = shaders[prng_pick(p, 3)];
        world.of.material[n].rgb.g = (uint8_t)(50 * n);
        world.of.material[n].cull = (uint8_t)prng_pick(p, 3);
        struct zs_instance *in = things_add(&world.of, &world.shape[prng_pick(p, 3)].mesh, p);
        for (int k = 0; k < 3; k++)
            in->pose.pos[k] = prng_range(p, -6000, 6000);
        if (n && !prng_pick(p, 3)) {
            in->mesh = world.of.instance[n - 1].mesh;
            in->pose = world.of.instance[n - 1].pose;
        }
    }
    world.of.config = picture_config(W, H, depths[prng_pick(p, 4)]);
    (void)zs_camera_perspective(&world.of.camera, (zs_turn)prng_range(p, 3000, 14000), H, prng_range(p, 20, 1500),
                                12000);
}

static uint32_t passes, out, clipped, most_used;

/* The frame of the world as it is, by a list of accelerators and pools of so many: as ample pools draw it. */
static int as_ample(const struct picture *plain, struct zs_config c, uint32_t tris, uint32_t verts)
{
    struct picture ample = picture_draw(&c, &world.of.scene, &world.of.camera);
    c.max_tris = (uint16_t)tris;
    c.max_verts = (uint16_t)verts;
    struct picture f = picture_draw(&c, &world.of.scene, &world.of.camera);
    const int all = !c.fast; /* what is hidden depends on what was binned before, what is untouched on sets */
    int ok = picture_same(plain, &ample, "ample pools") && picture_same(plain, &f, "small pools") &&
             stats_add_up(&f.stats) && counts_same(&ample.stats, &f.stats, all ? FIELDS : FIELDS_OF_SCENE);
    if (ok && (f.stats.max_tris_used > tris || f.stats.max_verts_used > verts))
        ok = case_wrong("%u triangles and %u vertices used", f.stats.max_tris_used, f.stats.max_verts_used);
    passes += f.stats.passes;
    out += f.stats.clusters_culled;
    clipped += f.stats.tris_clipped;
    most_used = most_used > ample.stats.max_tris_used ? most_used : ample.stats.max_tris_used;
    PICTURES_FREE(&ample, &f);
    return ok ? 1 : case_wrong("strips of %u, pools of %u and %u, seed's list", c.strip_h, tris, verts);
}

static int scene_of(uint64_t seed, int clusters)
{
    static const uint16_t pools[][2] = { { 1, 3 },   { 1, 4 }, { 2, 3 }, { 1, 200 },
                                         { 300, 3 }, { 2, 7 }, { 5, 9 }, { 40, 30 } };
    struct prng p = { seed };
    world_open(&p, clusters);
    world.of.config.fast = NULL;
    struct picture plain = picture_draw(&world.of.config, &world.of.scene, &world.of.camera);
    int ok = plain.err == ZS_OK;
    for (uint32_t k = 0; k < 4 && ok; k++) {
        struct zs_config c = world.of.config;
        const uint16_t *pool = pools[prng_pick(&p, sizeof pools / sizeof pools[0])];
        const struct zs_fast *const *const lists[2][4] = {
            { NULL, NULL, fast_all, fast_any(&p) },
            { fast_of(FAST_CLUSTERS), fast_of(FAST_CLUSTERS | FAST_BATCH), fast_all, fast_any(&p) }
        };
        c.fast = lists[clusters][k];
        c.strip_h = (uint16_t)(prng_pick(&p, 2) ? H : prng_range(&p, 1, H));
        ok = as_ample(&plain, c, pool[0], pool[1]);
    }
    picture_free(&plain);
    return ok;
}

static int scene_case(uint64_t seed) { return scene_of(seed, 0); }
static int cluster_case(uint64_t seed) { return scene_of(seed, 1); }

/* One triangle a pass, in scene order: of equal keys the first stays, in whichever set it is. */
static void the_first_of_equals_stays_in_any_set(void **state)
{
    static struct lone l;
    static const int16_t pos[9][3] = { { -3000, -3000, 0 }, { 3000, -3000, 0 }, { 3000, 3000, 0 },
                                       { -3000, 3000, 0 },  { -3000, -2000, 0 }, { 2000, -3000, 0 },
                                       { 3000, 1000, 0 },   { 0, 0, 0 },         { 9, 9, 0 } };
    lone_set(&l, pos, 9, ZS_Q16_ONE);
    l.instance.pose.pos[2] = -PIXEL_Z;
    const struct zs_camera camera = pixel_camera(H, 0);
    struct zs_config c = lone_config(W, H, &zs_depth_linear);
    c.fast = NULL;
    struct picture ample = picture_draw(&c, &l.scene, &camera);
    assert_true(ample.err == ZS_OK && ample.covered > 300);
    for (uint16_t tris = 1; tris <= 7; tris++) {
        c.max_tris = tris;
        c.max_verts = (uint16_t)(tris + 2);
        struct picture f = picture_draw(&c, &l.scene, &camera);
        assert_true(picture_same(&ample, &f, "equal keys"));
        assert_true(counts_same(&ample.stats, &f.stats, FIELDS));
        assert_true(f.stats.passes >= ample.stats.tris_drawn / tris);
        picture_free(&f);
    }
    picture_free(&ample);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_fan_goes_on_with_its_next_piece),
    CASES_COUNTS(small_pools_count_the_same, scene_case, 200,
                 { "passes", &passes, 10000 }, { "triangles clipped", &clipped, 5000 },
                 { "triangles at most in ample pools", &most_used, 0 }),
    CASES_COUNTS(clusters_with_small_pools, cluster_case, 120,
                 { "passes", &passes, 5000 }, { "clusters left out", &out, 500 }),
    cmocka_unit_test(the_first_of_equals_stays_in_any_set),
};

CASES_MAIN(tests)
