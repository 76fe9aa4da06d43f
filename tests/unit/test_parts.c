/* Scenes that the pools do not hold (fast/parts.c, and the bands of core/bin.c): the frame and its counts are those of
 * ample pools, the walks are few beside the fewest that pools of that size allow, and a walk for a part of the frame
 * does not transform all of the scene again.
 *
 * The fewest: from the triangles of a frame in ample pools, band after band as many strips as hold no more triangles
 * and vertices than the pools do. A strip with more is one walk too, which draws them in sets.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "internals.h"
#include "picture.h"
#include "shapes.h"
#include "things.h"

#define W 64
#define H 120
#define INSTANCES 3

static struct {
    struct shape shape[2];
    struct things of;
} world;

static void exchange(struct shape *s, uint32_t a, uint32_t b)
{
    uint16_t t[3];
    memcpy(t, s->tri[a], sizeof t);
    memcpy(s->tri[a], s->tri[b], sizeof t);
    memcpy(s->tri[b], t, sizeof t);
}

/* As they come, from the last to the first, or in any order. */
static void reorder(struct shape *s, struct prng *p, uint32_t how)
{
    const uint32_t n = s->mesh.n_tris;
    for (uint32_t t = 0; how == 1 && t < n / 2u; t++)
        exchange(s, t, n - 1u - t);
    for (uint32_t t = 1; how == 2 && t < n; t++)
        exchange(s, t, prng_pick(p, t + 1u));
}

static uint32_t world_open(struct prng *p)
{
    const uint32_t how = prng_pick(p, 3), n = 1u + prng_pick(p, INSTANCES);
    memset(&world, 0, sizeof world);
    if (prng_pick(p, 2))
        shape_sphere(&world.shape[0], 14 + prng_pick(p, 16), 14 + prng_pick(p, 16), 4000);
    else
        shape_torus(&world.shape[0], 14 + prng_pick(p, 16), 14 + prng_pick(p, 16), 3000, 1200);
    shape_ground(&world.shape[1], 10 + prng_pick(p, 20), 4000, 900, prng_next(p));
    for (int k = 0; k < 2; k++)
        reorder(&world.shape[k], p, how);
    for (uint32_t k = 0; k < n; k++) {
        world.of.material[k].shader = prng_pick(p, 2) ? &zs_shade_raw : &zs_shade_smooth;
        world.of.material[k].cull = (uint8_t)(prng_pick(p, 3) ? ZS_CULL_BACK : ZS_CULL_NONE);
        struct zs_instance *in = things_add(&world.of, &world.shape[prng_pick(p, 2)].mesh, p);
        in->pose.pos[0] = prng_range(p, -1500, 1500);
        in->pose.pos[1] = prng_range(p, -2500, 2500);
        in->pose.pos[2] = -prng_range(p, 4000, 14000); /* some are cut at near */
    }
    world.of.config = picture_config(W, H, &zs_depth_e4m12);
    world.of.config.strip_h = (uint16_t)prng_range(p, 3, 20);
    world.of.config.fast = fast_of(FAST_ALL & ~FAST_TILES);
    (void)zs_camera_perspective(&world.of.camera, 9000, H, 300, 30000);
    return how;
}

/* ---- The fewest walks ------------------------------------------------------------------------- */

#define TRIS_MAX 8000
static struct {
    uint16_t first, end; /* strips */
    uint16_t v[3];
} tri[TRIS_MAX];
static uint32_t n_tris, n_verts;
static struct zs_renderer r;
static uint32_t arena[200000];

/* Bin the frame in ample pools. */
static int look(void)
{
    struct zs_config c = world.of.config;
    struct zs_strip strip;
    c.max_tris = c.max_verts = TRIS_MAX;
    assert_true(zs_arena_bytes(&c) <= sizeof arena);
    CASE_CHECK(zs_init(&r, &c, arena, sizeof arena) == ZS_OK);
    CASE_CHECK(zs_frame_begin(&r, &world.of.scene, &world.of.camera) == ZS_OK &&
               zs_frame_strip(&r, &strip) == 1);
    n_tris = r.n_tris;
    n_verts = r.n_verts;
    for (uint32_t t = 0; t < n_tris; t++) {
        int32_t y0 = INT32_MAX, y1 = INT32_MIN;
        for (int k = 0; k < 3; k++) {
            const int32_t y = r.vert[r.tri[t].v[k]].y;
            tri[t].v[k] = r.tri[t].v[k];
            y0 = y < y0 ? y : y0;
            y1 = y > y1 ? y : y1;
        }
        y0 = y0 < 0 ? 0 : y0 >> 8;
        y1 = y1 >= H * 256 ? H - 1 : y1 >> 8;
        tri[t].first = (uint16_t)(y0 / c.strip_h);
        tri[t].end = (uint16_t)(y1 / c.strip_h + 1);
    }
    return zs_frame_end(&r) == ZS_OK && r.stats.passes == 1;
}

/* Return 1 if pools of so many hold the triangles of strips [s, end). */
static int holds(uint32_t s, uint32_t end, uint32_t tris, uint32_t verts)
{
    static uint8_t of[TRIS_MAX];
    uint32_t t_sum = 0, v_sum = 0;
    memset(of, 0, sizeof of);
    for (uint32_t t = 0; t < n_tris; t++) {
        if (tri[t].first >= end || tri[t].end <= s)
            continue;
        t_sum++;
        for (int k = 0; k < 3; k++) {
            v_sum += !of[tri[t].v[k]];
            of[tri[t].v[k]] = 1;
        }
    }
    return t_sum <= tris && v_sum <= verts;
}

static uint32_t fewest(uint32_t tris, uint32_t verts)
{
    const uint32_t strips = (H + world.of.config.strip_h - 1u) / world.of.config.strip_h;
    uint32_t n = 0;
    for (uint32_t s = 0, end; s < strips; s = end) {
        for (end = s + 1u; end < strips && holds(s, end + 1u, tris, verts); end++)
            ;
        n++;
    }
    return n;
}

/* How many walks a frame takes. */
static uint32_t walks_of(const struct zs_config *c)
{
    struct zs_strip strip;
    uint32_t n = 0;
    assert_true(zs_init(&r, c, arena, sizeof arena) == ZS_OK);
    assert_true(zs_frame_begin(&r, &world.of.scene, &world.of.camera) == ZS_OK);
    do
        n += r.strip < r.n_strips && r.strip >= r.band_end;
    while (zs_frame_strip(&r, &strip) == 1);
    assert_true(zs_frame_end(&r) == ZS_OK);
    return n;
}

/* ---- Cases ------------------------------------------------------------------------------------ */

static struct {
    uint32_t frames, least, walks;
    double again; /* vertices transformed, times those of one walk */
} sum[2];         /* [1]: triangles in any order */

static int few_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t any = world_open(&p) == 2;
    if (!look())
        return 0;
    if (n_tris < 300) /* next to nothing is seen */
        return 1;
    const uint32_t tris = n_tris / (1u + prng_pick(&p, 8)) + 1u + prng_pick(&p, 60);
    const uint32_t verts = tris * (uint32_t)prng_range(&p, 60, 120) / 100u + 3u;
    struct picture ample = picture_draw(&world.of.config, &world.of.scene, &world.of.camera);
    struct zs_config c = world.of.config;
    c.max_tris = (uint16_t)tris;
    c.max_verts = (uint16_t)verts;
    struct picture f = picture_draw(&c, &world.of.scene, &world.of.camera);
    const uint32_t least = fewest(tris, verts), walks = walks_of(&c);
    int ok = picture_same(&ample, &f, "small pools") && stats_add_up(&f.stats) &&
             f.stats.tris_drawn == ample.stats.tris_drawn &&
             f.stats.tris_facing == ample.stats.tris_facing && f.stats.max_tris_used <= tris &&
             f.stats.max_verts_used <= verts;
    if (ok && walks > (any ? 5u * least + 6u : least * 3u / 2u + 4u))
        ok = case_wrong("%u walks, %u at least", walks, least);
    sum[any].frames++;
    sum[any].least += least;
    sum[any].walks += walks;
    sum[any].again += (double)f.stats.verts_transformed / ample.stats.verts_transformed;
    PICTURES_FREE(&ample, &f);
    return ok ? 1
              : case_wrong("strips of %u, pools of %u and %u for %u and %u", c.strip_h, tris, verts,
                           n_tris, n_verts);
}

static void walks_are_few(void **state)
{
    memset(sum, 0, sizeof sum);
    CASES(few_case, 400);
    for (int any = 0; any < 2; any++)
        print_message("%s: %u walks in %u frames, %u at least; vertices %.1f times\n",
                      any ? "in any order" : "in rows", sum[any].walks, sum[any].frames,
                      sum[any].least, sum[any].again / sum[any].frames);
    if (!cases_all())
        return;
    assert_true(sum[0].frames > 150 && sum[0].least > 5 * sum[0].frames && sum[1].frames > 60);
    assert_true(sum[0].walks * 5u < sum[0].least * 6u && sum[1].walks * 2u < sum[1].least * 3u);
    assert_true(sum[0].again < 5.4 * sum[0].frames); /* a walk of all for each band: 11 */
}

/* Rows of a frame of more than 255 are noted two or more to a number: the picture is that of one walk. */
static unsigned tall_walks;

static int tall_case(uint64_t seed)
{
    struct prng p = { seed };
    (void)world_open(&p);
    struct zs_config c = world.of.config;
    c.height = (uint16_t)prng_range(&p, 256, 1100);
    c.max_tris = c.max_verts = TRIS_MAX;
    CASE_CHECK(zs_camera_perspective(&world.of.camera, 9000, c.height, 300, 30000) == ZS_OK);
    struct picture want = picture_draw(&c, &world.of.scene, &world.of.camera);
    c.max_tris = (uint16_t)prng_range(&p, 200, 500);
    c.max_verts = (uint16_t)prng_range(&p, 200, 500);
    struct picture is = picture_draw(&c, &world.of.scene, &world.of.camera);
    tall_walks += is.stats.passes > 2;
    return picture_drawn_alike(&want, &is, "small pools");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(walks_are_few),
    CASES_COUNT(tall_frames, tall_case, 60, &tall_walks, 8, "frames in three walks and more"),
};

CASES_MAIN(tests)
