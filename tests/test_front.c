/* Instances from front to back (order.c): whatever is drawn first, the frame is that of the scene's order. Keys of few bits, so
 * that near things share buckets: there, the earlier instance wins.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "picture.h"
#include "shapes.h"

#define W 64
#define H 48
#define INSTANCES 20
#define SHAPES 4

struct world {
    struct shape shape[SHAPES];
    struct zs_material material[INSTANCES];
    struct zs_instance instance[INSTANCES];
    struct zs_scene scene;
    struct zs_camera camera;
};

static struct world world;
static uint64_t earlier;

/* Away from the mesh's origin, so that turning an instance moves its sphere. */
static void move(struct prng *p, struct shape *s)
{
    for (int k = 0; k < 3; k++) {
        const int32_t by = prng_range(p, -300, 300);
        for (uint32_t v = 0; v < s->mesh.n_verts; v++)
            s->pos[v][k] = (int16_t)(s->pos[v][k] + by);
        s->mesh.center[k] = (int16_t)(s->mesh.center[k] + by);
    }
}

/* A point so far along the view, so far beside it; world units. */
static void stand(const struct zs_camera *c, struct zs_pose *pose, int32_t x, int32_t y, int32_t z)
{
    for (int k = 0; k < 3; k++)
        pose->pos[k] = c->pos[k] + (int32_t)(((int64_t)c->rot[k] * x + (int64_t)c->rot[3 + k] * y -
                                              (int64_t)c->rot[6 + k] * z) >> 30);
}

static void world_open(struct prng *p, int orthographic)
{
    struct world *w = &world;
    const int32_t eye[3] = { prng_range(p, -9000, 9000), prng_range(p, -9000, 9000), prng_range(p, -9000, 9000) };
    const int32_t to[3] = { prng_range(p, -50, 50), prng_range(p, -50, 50), -40 }, up[3] = { 1, 90, 3 };
    memset(w, 0, sizeof *w);
    shape_sphere(&w->shape[0], 10, 12, 60);
    shape_sphere(&w->shape[1], 10, 14, 200);
    shape_soup(&w->shape[2], 210, 90, prng_next(p));
    shape_sphere(&w->shape[3], 3, 4, 80); /* few triangles: alone, not worth an order */
    for (uint32_t k = 0; k < SHAPES; k++)
        move(p, &w->shape[k]);
    if (orthographic)
        (void)zs_camera_orthographic(&w->camera, 1500, 200, 20000);
    else
        (void)zs_camera_perspective(&w->camera, 9000, H, 200, 20000);
    (void)zs_camera_look_along(&w->camera, eye, to, up);
    w->scene.instance = w->instance;
    w->scene.n_instances = 2 + prng_pick(p, INSTANCES - 1);
    int32_t z = 3000;
    static const struct zs_state states[] = { ZS_STATE(1, 0, 0, 0), ZS_STATE(0, 1, 0, 0), ZS_STATE(0, 0, -20, 0),
                                              ZS_STATE(0, 0, 20, 0) };
    for (uint32_t i = 0; i < w->scene.n_instances; i++) {
        struct zs_instance *in = &w->instance[i];
        z = prng_pick(p, 2) ? prng_range(p, 400, 19000) : z + prng_range(p, z > 900 ? -400 : 0, z < 18000 ? 400 : 0);
        in->mesh = &w->shape[prng_pick(p, SHAPES)].mesh;
        in->material = &w->material[i];
        zs_pose_identity(&in->pose);
        zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
        in->pose.scale = ZS_Q16_ONE / 2 + prng_pick(p, ZS_Q16_ONE);
        stand(&w->camera, &in->pose, prng_range(p, -z / 8, z / 8), prng_range(p, -z / 8, z / 8), z);
        in->state = prng_pick(p, 12) ? NULL : &states[prng_pick(p, 4)];
        w->material[i].shader = prng_pick(p, 2) ? &zs_shade_raw : &zs_shade_smooth;
        w->material[i].rgb.r = (uint8_t)(40u + i * 10u);
        w->material[i].rgb.b = (uint8_t)(255u - i * 10u);
        w->material[i].cull = (uint8_t)prng_pick(p, 3);
    }
    w->scene.light.ambient = ZS_Q16_ONE;
}

static int one_scene(uint64_t seed)
{
    static const struct zs_depth *const mapping[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear, &zs_depth_e4m12 };
    struct prng p = { seed };
    const int orthographic = !prng_pick(&p, 4);
    world_open(&p, orthographic);
    struct zs_config c = picture_config(W, H, orthographic ? &zs_depth_linear : mapping[prng_pick(&p, 4)]);
    c.depth_bits = (uint8_t)(8 + prng_pick(&p, 5));
    c.skip_off = ZS_SKIP_ALL;
    struct picture plain = picture_draw(&c, &world.scene, &world.camera);
    c.skip_off = prng_pick(&p, 2) ? 0 : ZS_SKIP_ALL & ~ZS_SKIP_ORDER;
    c.strip_h = (uint16_t)(1 + prng_pick(&p, H));
    if (prng_pick(&p, 2)) {
        c.max_tris = (uint16_t)(20 + prng_pick(&p, 300));
        c.max_verts = (uint16_t)(20 + prng_pick(&p, 300));
    }
    struct picture got = picture_draw(&c, &world.scene, &world.camera);
    CASE_CHECK(plain.err == ZS_OK && got.err == ZS_OK && plain.stats.instances_earlier == 0);
    const int same = picture_same(&plain, &got, "from front to back");
    earlier += got.stats.instances_earlier;
    picture_free(&plain);
    picture_free(&got);
    return same ? 1 : case_wrong("%u instances", (unsigned)world.scene.n_instances);
}

static void the_frame_is_the_scenes(void **state)
{
    (void)state;
    earlier = 0;
    CASES(one_scene, 3000);
    print_message("%llu instances were drawn before earlier ones\n", (unsigned long long)earlier);
    assert_true(getenv("ZS_SEED") || earlier > 3000);
}

/* Balls in a row, the last one first, or with one that is out of order. */
static struct zs_stats row_of(uint32_t n, int32_t step, const struct zs_mesh *mesh, const struct zs_shader *shader, uint16_t off)
{
    struct world *w = &world;
    const int32_t eye[3] = { 0, 0, 0 }, to[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    (void)zs_camera_perspective(&w->camera, 9000, H, 200, 20000);
    (void)zs_camera_look_along(&w->camera, eye, to, up);
    w->scene.instance = w->instance;
    w->scene.n_instances = n;
    for (uint32_t i = 0; i < n; i++) {
        const struct zs_instance in = { .mesh = mesh, .material = &w->material[i] };
        w->instance[i] = in;
        w->material[i].shader = shader;
        zs_pose_identity(&w->instance[i].pose);
        w->instance[i].pose.pos[2] = -2000 - step * (int32_t)(n - i);
    }
    struct zs_config c = picture_config(W, H, &zs_depth_float);
    c.skip_off = off;
    struct picture got = picture_draw(&c, &w->scene, &w->camera);
    assert_int_equal(got.err, ZS_OK);
    const struct zs_stats stats = got.stats;
    picture_free(&got);
    return stats;
}

static void what_is_apart_is_put_in_order(void **state)
{
    (void)state;
    memset(&world, 0, sizeof world);
    shape_sphere(&world.shape[0], 10, 12, 100); /* 216 triangles */
    shape_sphere(&world.shape[1], 4, 6, 100);
    const struct zs_mesh *dense = &world.shape[0].mesh, *sparse = &world.shape[1].mesh;
    const struct zs_shader *smooth = &zs_shade_smooth;
    assert_true(dense->n_tris >= 200 && sparse->n_tris < 200);
    assert_int_equal(row_of(9, 230, dense, smooth, 0).instances_earlier, 8);
    assert_int_equal(row_of(9, 230, dense, smooth, ZS_SKIP_ORDER).instances_earlier, 0);
    assert_int_equal(row_of(9, 190, dense, smooth, 0).instances_earlier, 0); /* neighbours touch: none may pass the one before it */
    assert_int_equal(row_of(9, 20, dense, smooth, 0).instances_earlier, 0);
    assert_int_equal(row_of(9, 230, dense, &zs_shade_raw, 0).instances_earlier, 8);
    assert_int_equal(row_of(9, 230, sparse, smooth, 0).instances_earlier, 0);
    assert_int_equal(row_of(18, 230, dense, smooth, 0).instances_earlier, 15 + 1); /* sixteen at a time */
    assert_int_equal(row_of(9, -150, dense, smooth, 0).instances_earlier, 0);      /* they are in order */
    assert_int_equal(row_of(9, -900, dense, smooth, 0).instances_earlier, 0);      /* some are behind the eye */
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_frame_is_the_scenes),
    cmocka_unit_test(what_is_apart_is_put_in_order),
};
CASES_MAIN(tests)
