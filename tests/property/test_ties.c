/* Instances in front of each other in any order: whatever is left out, the frame is that of the scene's order. Keys of
 * few bits, so that near things share buckets: there, the earlier instance wins.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
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
    shape_sphere(&w->shape[3], 3, 4, 80);
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
    static const struct zs_depth_state states[] = {
        { .func = ZS_DEPTH_LESS_EQUAL }, { .read_only = 1 }, { .bias = -20 }, { .bias = 20 }
    };
    for (uint32_t i = 0; i < w->scene.n_instances; i++) {
        struct zs_instance *in = &w->instance[i];
        z = prng_pick(p, 2) ? prng_range(p, 400, 19000) : z + prng_range(p, z > 900 ? -400 : 0, z < 18000 ? 400 : 0);
        in->mesh = &w->shape[prng_pick(p, SHAPES)].mesh;
        in->material = &w->material[i];
        zs_pose_identity(&in->pose);
        zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
        in->pose.scale = ZS_Q16_ONE / 2 + prng_pick(p, ZS_Q16_ONE);
        stand(&w->camera, &in->pose, prng_range(p, -z / 8, z / 8), prng_range(p, -z / 8, z / 8), z);
        in->depth_state = prng_pick(p, 12) ? NULL : &states[prng_pick(p, 4)];
        w->material[i].shader = prng_pick(p, 2) ? &zs_shade_raw : &zs_shade_smooth;
        w->material[i].rgb.r = (uint8_t)(40u + i * 10u);
        w->material[i].rgb.b = (uint8_t)(255u - i * 10u);
        w->material[i].cull = (uint8_t)prng_pick(p, 3);
    }
    w->scene.light.ambient = ZS_Q16_ONE;
}

static int one_scene(uint64_t seed)
{
    static const struct zs_depth *const mapping[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear,
                                                      &zs_depth_e4m12 };
    struct prng p = { seed };
    const int orthographic = !prng_pick(&p, 4);
    world_open(&p, orthographic);
    struct zs_config c = picture_config(W, H, orthographic ? &zs_depth_linear : mapping[prng_pick(&p, 4)]);
    c.depth_bits = (uint8_t)(8 + prng_pick(&p, 5));
    c.fast = NULL;
    struct picture plain = picture_draw(&c, &world.scene, &world.camera);
    c.fast = prng_pick(&p, 2) ? fast_all : fast_any(&p);
    c.strip_h = (uint16_t)(1 + prng_pick(&p, H));
    if (prng_pick(&p, 2)) {
        c.max_tris = (uint16_t)(20 + prng_pick(&p, 300));
        c.max_verts = (uint16_t)(20 + prng_pick(&p, 300));
    }
    struct picture got = picture_draw(&c, &world.scene, &world.camera);
    CASE_CHECK(plain.err == ZS_OK && got.err == ZS_OK);
    const int same = picture_same(&plain, &got, "ties");
    PICTURES_FREE(&plain, &got);
    return same ? 1 : case_wrong("%u instances", (unsigned)world.scene.n_instances);
}

static const struct CMUnitTest tests[] = { CASES_TEST(the_frame_is_the_scenes, one_scene, 3000) };

CASES_MAIN(tests)
