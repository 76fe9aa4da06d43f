/* Ray casting: the depth buffer's frame, bit for bit, for any world, mapping, depth state, pools, strips, accelerators
 * and hierarchy; one ray a pixel; and what rays of doubles see.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "method_needs.h"
#include "nodes.h"
#include "../lab/fuzz/kinds.h"
#include "../lab/fuzz/world.h"
#include "own.h"
#include "picture.h"
#include "../../sim/reference/rays.h"
#include "zs_method.h"

/* A ray ends where it meets something: a shader that leaves pixels alone is not drawn by rays. */
static void make_opaque(struct world *w)
{
    for (int k = 0; k < WORLD_MATERIALS; k++)
        if (!w->material[k].shader->opaque)
            w->material[k].shader = &own_shader;
}

/* ---- Hierarchies ------------------------------------------------------------------------------- */

#define NODES 2048

static struct zs_bvh_node nodes[WORLD_MESHES][NODES];
static int shrink; /* radii are a quarter: what a wrong hierarchy does */

static unsigned trees;

/* Give some of a world's meshes a hierarchy, and clusters, without which it is not used. */
static void grow_trees(struct world *w, struct prng *p)
{
    static const struct zs_cluster some;
    for (int k = 0; k < WORLD_MESHES; k++) {
        struct zs_mesh *m = &w->mesh[k];
        if (m->n_tris == 0 || one_in(p, 3))
            continue;
        const uint32_t n = nodes_make(nodes[k], NODES, m, 1u + prng_pick(p, 8));
        if (n == 0)
            continue;
        for (uint32_t i = 0; shrink && i < n; i++)
            nodes[k][i].radius /= 4u;
        m->bvh = nodes[k];
        if (!m->cluster)
            m->cluster = &some;
        trees++;
    }
}

/* ---- The depth buffer's frame ------------------------------------------------------------------ */

static unsigned drawn, cut, curved, stated, clipped, left_out;

static int world_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    world_make(&w, &p, 0);
    make_opaque(&w);
    const struct kind_depth *depth = &kind_depths[prng_pick(&p, KINDS(kind_depths))];
    if (w.camera.projection == ZS_ORTHOGRAPHIC)
        depth = &kind_depths[1];
    struct zs_config c = { .width = (uint16_t)prng_range(&p, 1, 60), .height = (uint16_t)prng_range(&p, 1, 50),
                           .max_tris = 4000, .max_verts = 8000, .varyings = ZS_VARYINGS_MAX, .depth = depth->depth,
                           .depth_bits = (uint8_t)(prng_pick(&p, 3) ? 16 : prng_range(&p, 8, 16)),
                           .subpixel_bits = prng_pick(&p, 4) ? 8 : 4 };
    c.strip_h = c.height;
    struct picture want = picture_draw(&c, &w.scene, &w.camera);
    grow_trees(&w, &p);
    c.method = &zs_method_raycast;
    picture_any_way(&p, &c, 4, 6);
    struct picture is = picture_draw(&c, &w.scene, &w.camera);
    int right = 1;
    if (!want.err && !is.err) {
        const size_t px = (size_t)c.width * c.height;
        if (!w.scene.n_resolves)
            memcpy(is.key, want.key, px * 2);
        right = is.stats.rays == px && stats_add_up(&is.stats);
        left_out += is.stats.tris_cluster > want.stats.tris_cluster;
        drawn += want.covered > 0;
        cut += is.stats.passes > is.stats.strips;
        curved += depth->depth != &zs_depth_recip && w.camera.projection == ZS_PERSPECTIVE;
        clipped += want.stats.tris_clipped > 0;
        for (uint32_t k = 0; k < w.scene.n_instances; k++)
            stated += w.instance[k].depth_state != NULL;
    }
    world_free(&w);
    return picture_alike(&want, &is, depth->name) && (right || case_wrong("%u rays", is.stats.rays));
}

static void is_the_frame_of_the_depth_buffer(void **state)
{
    (void)state;
    drawn = cut = curved = stated = clipped = left_out = trees = 0;
    CASES(world_case, getenv("ZS_STRESS") ? 10000 : 150);
    if (cases_all())
        assert_true(drawn > 50 && cut > 25 && curved > 25 && stated > 75 && clipped > 25 && trees > 200 &&
                    left_out > 10);
}

/* A sphere that does not hold its triangles is noticed: the frames are not the depth buffer's. */
static void small_spheres_are_noticed(void **state)
{
    unsigned other = 0;
    (void)state;
    shrink = 1;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        struct prng p = { seed };
        static struct world w;
        world_make(&w, &p, 0);
        make_opaque(&w);
        struct zs_config c = picture_config(40, 30, &zs_depth_linear);
        c.strip_h = 5;
        c.max_tris = 40;
        struct picture want = picture_draw(&c, &w.scene, &w.camera);
        grow_trees(&w, &p);
        c.method = &zs_method_raycast;
        struct picture is = picture_draw(&c, &w.scene, &w.camera);
        other += !want.err && !is.err && memcmp(want.color, is.color, 40 * 30 * 2) != 0;
        PICTURES_FREE(&want, &is);
        world_free(&w);
    }
    shrink = 0;
    assert_true(other > 2);
}

/* ---- Layers ------------------------------------------------------------------------------------ */

#define TRIS 120

/* Triangles parallel to the screen, at few distances, in keys of few bits: boxes of one key, and many ties. */
static int layers_case(uint64_t seed)
{
    static int16_t pos[TRIS * 3][3];
    static uint16_t corners[TRIS][3], color[TRIS];
    struct prng p = { seed };
    const uint32_t n = (uint32_t)prng_range(&p, 1, TRIS);
    struct zs_mesh mesh = { .pos = (const int16_t (*)[3])pos, .tri = (const uint16_t (*)[3])corners, .face_raw = color,
                            .n_verts = 3 * n, .n_tris = n, .radius = 65535 };
    const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    const struct zs_instance instance = { .mesh = &mesh, .material = &material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = 7 };
    struct zs_camera camera;
    if (zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 1000, 1300))
        return case_wrong("camera");
    for (uint32_t v = 0; v < 3 * n; v++) {
        pos[v][0] = (int16_t)prng_range(&p, -600, 600);
        pos[v][1] = (int16_t)prng_range(&p, -600, 600);
        pos[v][2] = (int16_t)(v % 3 ? pos[v - 1][2] : -1000 - prng_range(&p, 0, 12));
        corners[v / 3][v % 3] = (uint16_t)v;
        color[v / 3] = (uint16_t)(prng_next(&p) | 1u);
    }
    struct zs_config c = picture_config(64, 48, prng_pick(&p, 2) ? &zs_depth_recip : &zs_depth_linear);
    c.depth_bits = (uint8_t)prng_range(&p, 8, 9);
    struct picture want = picture_draw(&c, &scene, &camera);
    c.method = &zs_method_raycast;
    c.strip_h = (uint16_t)prng_range(&p, 1, 48);
    struct picture is = picture_draw(&c, &scene, &camera);
    memcpy(is.key, want.key, 64 * 48 * 2);
    return picture_drawn_alike(&want, &is, "layers");
}

/* ---- Rays of doubles ----------------------------------------------------------------------------- */

#define SEEN_W 48
#define SEEN_H 40

static const struct ref_light above = { { 0, 1, 0 }, 0.25, 0.75 };
static size_t compared, differ;

/* sim/reference: rays see what its loop over triangles sees. */
static int doubles_case(uint64_t seed)
{
    static uint32_t id[2][SEEN_W * SEEN_H];
    static double z[2][SEEN_W * SEEN_H];
    static uint16_t color[2][SEEN_W * SEEN_H];
    struct prng p = { seed };
    struct ref_triangle t[60];
    struct ref_image loop = { .id = id[0], .z = z[0], .rgb565 = color[0] };
    struct ref_image ray = { .id = id[1], .z = z[1], .rgb565 = color[1] };
    struct ref_camera camera = { .right = { 1, 0, 0 }, .up = { 0, 1, 0 }, .back = { 0, 0, 1 }, .focal = 40, .height = 3,
                                 .near_z = 1, .far_z = 9, .orthographic = prng_pick(&p, 3) == 0 };
    const struct ref_depth depth = { REF_DEPTH_LINEAR, 16 };
    struct ref_rays rays = { .shadows = 0 };
    const uint32_t n = prng_pick(&p, 61);
    memset(t, 0, sizeof t);
    for (uint32_t i = 0; i < n; i++) {
        for (int k = 0; k < 9; k++)
            t[i].p[k / 3][k % 3] = prng_range(&p, -300000, 300000) / 100000.0 - (k % 3 == 2 ? 5.0 : 0.0);
        t[i].id = i + 1;
        t[i].raw = (uint16_t)prng_next(&p);
        t[i].shade = prng_pick(&p, 2) ? REF_SHADE_RAW : REF_SHADE_FLAT;
        t[i].cull = (int)prng_pick(&p, 3);
        for (int k = 0; k < 3; k++)
            t[i].rgb[0][k] = prng_pick(&p, 256) / 255.0;
    }
    CASE_CHECK(!ref_render(t, n, &camera, &above, &depth, 7, SEEN_W, SEEN_H, &loop, NULL, NULL));
    CASE_CHECK(!ref_cast(t, n, &camera, &above, 7, SEEN_W, SEEN_H, &rays, &ray));
    CASE_CHECK(rays.cast == SEEN_W * SEEN_H);
    for (int i = 0; i < SEEN_W * SEEN_H; i++) {
        compared += id[0][i] != 0;
        differ += id[0][i] != id[1][i] || color[0][i] != color[1][i];
        if (id[0][i] && id[0][i] == id[1][i] && !(z[0][i] - z[1][i] < 1e-9 && z[1][i] - z[0][i] < 1e-9))
            return case_wrong("pixel %d: %g and %g", i, z[0][i], z[1][i]);
    }
    return 1;
}

static void rays_of_doubles_see_what_the_reference_sees(void **state)
{
    (void)state;
    compared = differ = 0;
    CASES(doubles_case, 100);
    if (cases_all())
        assert_true(compared > 50000);
    assert_true(differ * 10000 <= compared);
}

static void rectangle(struct ref_triangle t[2], const double at[4][3], uint32_t id, double red)
{
    memset(t, 0, 2 * sizeof *t);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            memcpy(t[i].p[k], at[k ? k + i : 0], sizeof t[i].p[k]);
        t[i].id = id;
        t[i].shade = REF_SHADE_FLAT;
        t[i].cull = REF_CULL_NONE;
        t[i].rgb[0][0] = red;
    }
}

/* A floor below a plate, seen from above between them and beside: the plate's shadow, and the plate in the floor. */
static void shadows_and_mirrors(void **state)
{
    static const double floor_at[4][3] = { { -4, 0, 4 }, { 4, 0, 4 }, { 4, 0, -4 }, { -4, 0, -4 } };
    static const double plate_at[4][3] = { { -1, 2, 1 }, { 1, 2, 1 }, { 1, 2, -1 }, { -1, 2, -1 } };
    static const double shiny[4] = { 1, 1, 0, 0 };
    static const double eye[3] = { 0, 1, 6 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    static uint16_t color[41 * 41];
    static uint32_t id[41 * 41];
    struct ref_image image = { .rgb565 = color, .id = id };
    struct ref_camera camera = { .focal = 60, .near_z = 1, .far_z = 20 };
    struct ref_triangle t[4];
    (void)state;
    rectangle(t, floor_at, 1, 1.0);
    rectangle(t + 2, plate_at, 2, 0.5);
    assert_int_equal(ref_camera_look_at(&camera, eye, at, up), REF_OK);
    struct ref_rays rays = { .shadows = 0 };
    assert_int_equal(ref_cast(t, 4, &camera, &above, 7, 41, 41, &rays, &image), REF_OK);
    assert_int_equal(id[20 * 41 + 20], 1);
    assert_int_equal(color[20 * 41 + 20], 31 << 11);
    rays.shadows = 1;
    assert_int_equal(ref_cast(t, 4, &camera, &above, 7, 41, 41, &rays, &image), REF_OK);
    assert_int_equal(color[20 * 41 + 20], 8 << 11);  /* below the plate: 31 / 4, rounded */
    assert_int_equal(color[36 * 41 + 20], 31 << 11); /* before it */
    assert_true(rays.cast > 41 * 41);
    rays.shadows = 0;
    rays.mirror = shiny;
    rays.bounces = 1;
    assert_int_equal(ref_cast(t, 4, &camera, &above, 7, 41, 41, &rays, &image), REF_OK);
    assert_int_equal(color[20 * 41 + 20], 7); /* passes below the plate's edge */
    int plates = 0;
    for (int i = 0; i < 41 * 41; i++)
        plates += id[i] == 1 && color[i] != 7 && color[i] != 0;
    assert_true(plates > 20);
}

/* ---- What is refused ------------------------------------------------------------------------- */

/* By every method: boxes of rays lie behind the pools, in what the triangle pool has given up. */
static void an_arena_that_is_short_by_a_byte_is_refused(void **state)
{
    static uint32_t arena[20000];
    struct zs_renderer r;
    (void)state;
    for (size_t k = 0; k < KINDS(kind_methods); k++)
        for (uint16_t tris = 4; tris < 40; tris++) {
            const struct kind_method *m = &kind_methods[k];
            struct zs_config c = picture_config(32, 16, m->depth ? m->depth : &zs_depth_recip);
            c.method = m->method;
            c.max_tris = tris;
            c.max_verts = 30;
            const uint32_t bytes = zs_arena_bytes(&c);
            assert_true(bytes && bytes <= sizeof arena);
            assert_int_equal(zs_init(&r, &c, arena, bytes), ZS_OK);
            assert_int_equal(zs_init(&r, &c, arena, bytes - 1), ZS_ERR_ARENA);
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_arena_that_is_short_by_a_byte_is_refused),
    cmocka_unit_test(is_the_frame_of_the_depth_buffer),
    cmocka_unit_test(small_spheres_are_noticed),
    CASES_TEST(layers_are_those_of_the_depth_buffer, layers_case, 60),
    cmocka_unit_test(rays_of_doubles_see_what_the_reference_sees),
    cmocka_unit_test(shadows_and_mirrors),
    METHOD_NEEDS_TEST(small_pools_and_no_depth_memory_are_refused,
                      &zs_method_raycast, &zs_depth_float, &zs_depth_none, 4)
};

CASES_MAIN(tests)
