/* The methods against each other, on random worlds of triangles in cycles, through each other, and any: ray casting and
 * the hierarchical depth buffer are the depth buffer's frame, bit for bit; depth sort and coverage are one picture, and
 * it differs from that frame only where the keys of both triangles are within a bucket.
 *
 * ZS_WORLDS=10000 in the environment: so many worlds (make methods-worlds).
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "nodes.h"
#include "picture.h"
#include "zs_method.h"

#define TRIS 60u
#define SIDE 40

static int16_t pos[TRIS * 3][3];
static uint16_t corners[TRIS][3], color[TRIS];
static struct zs_bvh_node node[2 * TRIS];
static struct zs_cluster cluster;
static struct zs_mesh mesh;
static const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
static const struct zs_instance instance = { .mesh = &mesh, .material = &material };
static const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };

/* What the worlds had in them; of the frames compared. */
static unsigned worlds, cycles, by_nodes, cut, painter_wrong;
static uint64_t pixels, splits, within_a_bucket, rays;

/* A corner by its place on the screen, in thousandths of half a side at 90 degrees, and its distance. */
static void corner_set(uint32_t v, int32_t x, int32_t y, int32_t z)
{
    pos[v][0] = (int16_t)(x * z / 1000);
    pos[v][1] = (int16_t)(y * z / 1000);
    pos[v][2] = (int16_t)-z;
}

/* Blades around a point, each before the next one and behind the one before it: no order is right. */
static uint32_t cycle(struct prng *p, uint32_t t)
{
    const uint32_t n = 3 + prng_pick(p, 4);
    const int32_t x = prng_range(p, -400, 400), y = prng_range(p, -400, 400), z = prng_range(p, 2000, 8000);
    const double step = 6.283185307 / n, first = prng_pick(p, 1000) * 0.006;
    for (uint32_t k = 0; k < n; k++, t++) {
        const double a = first + step * k, b = a + step * 1.6;
        corner_set(3 * t, x + (int32_t)(60 * cos(a)), y + (int32_t)(60 * sin(a)), z);
        corner_set(3 * t + 1, x + (int32_t)(500 * cos(a)), y + (int32_t)(500 * sin(a)), z - 500);
        corner_set(3 * t + 2, x + (int32_t)(500 * cos(b)), y + (int32_t)(500 * sin(b)), z + 900);
    }
    cycles++;
    return t;
}

/* A world of n triangles or some more; some reach beyond the near plane. */
static uint32_t world_set(struct prng *p)
{
    const uint32_t n = 4 + prng_pick(p, prng_pick(p, 4) ? 12 : 40);
    const int32_t depth = prng_pick(p, 4) ? prng_range(p, 0, 20000) : 10;
    uint32_t t = 0;
    for (uint32_t k = prng_pick(p, 3); k; k--)
        t = cycle(p, t);
    for (; t < n; t++) {
        const int32_t nearest = prng_range(p, prng_pick(p, 6) ? 600 : 100, 9000);
        for (uint32_t v = 3 * t; v < 3 * t + 3; v++)
            corner_set(v, prng_range(p, -900, 900), prng_range(p, -900, 900), nearest + prng_range(p, 0, depth));
    }
    for (uint32_t k = 0; k < 3 * t; k++)
        corners[k / 3][k % 3] = (uint16_t)k;
    for (uint32_t k = 0; k < t; k++)
        color[k] = (uint16_t)(k + 1);
    cluster = (struct zs_cluster){ .n_tris = (uint16_t)t, .radius = 65535, .cutoff = 127 };
    mesh = (struct zs_mesh){
        .pos = (const int16_t(*)[3])pos, .tri = (const uint16_t(*)[3])corners, .face_raw = color, .n_verts = 3 * t,
        .n_tris = t, .radius = 65535, .cluster = &cluster, .n_clusters = 1
    };
    if (prng_pick(p, 2) && nodes_make(node, 2 * TRIS, &mesh, 1 + prng_pick(p, 4))) {
        mesh.bvh = node;
        by_nodes++;
    }
    return t;
}

static struct picture drawn(struct prng *p, struct zs_config c, const struct zs_method *method,
                            const struct zs_depth *depth, const struct zs_camera *camera)
{
    c.method = method;
    c.depth = depth;
    if (prng_pick(p, 3))
        picture_any_way(p, &c, 4, 6);
    struct picture is = picture_draw(&c, &scene, camera);
    cut += !is.err && is.stats.passes > is.stats.strips;
    return is;
}

/* Triangle t alone, by the depth buffer. */
static struct picture lone(const struct zs_config *c, const struct zs_camera *camera, uint32_t t)
{
    struct zs_mesh one = mesh;
    one.tri = (const uint16_t(*)[3])(corners + t);
    one.face_raw = color + t;
    one.n_tris = 1;
    one.cluster = NULL;
    one.bvh = NULL;
    const struct zs_instance in = { .mesh = &one, .material = &material };
    const struct zs_scene alone = { .instance = &in, .n_instances = 1 };
    return picture_draw(c, &alone, camera);
}

/* The picture of methods that compare depths, not keys. */
static int nearly(const struct zs_config *c, const struct zs_camera *camera, uint32_t n, const struct picture *want,
                  const struct picture *is)
{
    static struct picture of[TRIS];
    memset(of, 0, sizeof of);
    int right = 1;
    for (int32_t k = 0; right && k < SIDE * SIDE; k++) {
        const int a = want->color[k] - 1, b = is->color[k] - 1;
        if (a == b)
            continue;
        within_a_bucket++;
        if (a < 0 || b < 0)
            right = case_wrong("(%d, %d): triangle %d, not %d", k % SIDE, k / SIDE, b, a);
        for (int which = 0; right && which < 2; which++) {
            const int t = which ? b : a;
            if (!of[t].color)
                of[t] = lone(c, camera, (uint32_t)t);
        }
        if (right && (of[b].key[k] == ZS_DEPTH_CLEAR || of[b].key[k] - of[a].key[k] > 1))
            right = case_wrong("(%d, %d): triangle %d, key %u, not %d, key %u", k % SIDE, k / SIDE, b, of[b].key[k], a,
                               of[a].key[k]);
    }
    for (uint32_t t = 0; t < n; t++)
        picture_free(&of[t]);
    return right;
}

static int world_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_camera camera;
    memset(&camera, 0, sizeof camera);
    const int flat = prng_pick(&p, 4) == 0;
    const int err = flat ? zs_camera_orthographic(&camera, 8000, 500, 40000)
                         : zs_camera_perspective(&camera, ZS_DEGREES(60), SIDE, 500, 40000);
    const uint32_t n = world_set(&p);
    const struct zs_depth *const depth = flat ? &zs_depth_linear : &zs_depth_recip;
    const struct zs_config c = picture_config(SIDE, SIDE, depth);
    struct picture want = picture_draw(&c, &scene, &camera);
    struct picture hiz = drawn(&p, c, &zs_method_hiz, depth, &camera);
    struct picture ray = drawn(&p, c, &zs_method_raycast, depth, &camera);
    struct picture sort = drawn(&p, c, &zs_method_depthsort, &zs_depth_order, &camera);
    struct picture cover = drawn(&p, c, &zs_method_coverage, &zs_depth_order, &camera);
    struct picture paint = drawn(&p, c, &zs_method_painter, &zs_depth_none, &camera);
    int right = !err && !want.err && !ray.err ? 1 : case_wrong("errors %d %d %d", err, want.err, ray.err);
    if (right) {
        memcpy(ray.key, want.key, SIDE * SIDE * sizeof *want.key); /* without hooks rays leave none */
        right = picture_same(&want, &hiz, "hiz") && picture_same(&want, &ray, "raycast") &&
                picture_same(&sort, &cover, "depth sort and coverage") && nearly(&c, &camera, n, &want, &sort);
    }
    if (right && ray.stats.rays != SIDE * SIDE)
        right = case_wrong("%u rays", ray.stats.rays);
    worlds++;
    pixels += want.covered;
    splits += sort.stats.splits;
    rays += ray.stats.rays;
    painter_wrong += right && memcmp(paint.color, want.color, SIDE * SIDE * sizeof *want.color) != 0;
    PICTURES_FREE(&want, &hiz, &ray, &sort, &cover, &paint);
    return right;
}

static void methods_agree(void **state)
{
    const char *const more = getenv("ZS_WORLDS");
    (void)state;
    CASES(world_case, more ? strtoull(more, NULL, 10) : 150);
    printf("%u worlds, %u cycles, hierarchies in %u, %u frames in several walks; pixels covered %llu, rays %llu, "
           "splits %llu\n",
           worlds, cycles, by_nodes, cut, (unsigned long long)pixels, (unsigned long long)rays,
           (unsigned long long)splits);
    printf("raycast, hiz: 0 pixels off; depthsort and coverage: one picture, %llu pixels of it another triangle, "
           "within a "
           "bucket; painter: wrong in %u worlds\n",
           (unsigned long long)within_a_bucket, painter_wrong);
    if (cases_all())
        assert_true(cycles > worlds / 2 && by_nodes > worlds / 3 && cut > worlds / 3 && splits > worlds &&
                    painter_wrong > worlds / 3);
}

static const struct CMUnitTest tests[] = { cmocka_unit_test(methods_agree) };

CASES_MAIN(tests)
