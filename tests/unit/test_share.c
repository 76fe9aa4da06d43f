/* Two renderers that share a frame (fast/share.c), step by step as two cores take them: wherever the scene is cut,
 * whichever renderer draws a strip, the frame is the one that one renderer draws; where pools are too small, too.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "own.h"
#include "picture.h"
#include "scenes.h"
#include "shapes.h"
#include "zs_damage.h"
#include "zs_method.h"
#include "zs_share.h"

#define W 96
#define H 72

struct two {
    struct zs_renderer r[2];
    struct zs_share share;
    void *arena[2];
};

static int begins(struct two *t, const struct zs_config *c)
{
    const uint32_t bytes = zs_arena_bytes(c);
    int ok = 1;
    for (uint32_t i = 0; i < 2; i++) {
        t->arena[i] = malloc(bytes);
        memset(t->arena[i], 0xa5, bytes);
        ok &= zs_init(&t->r[i], c, t->arena[i], bytes) == ZS_OK;
    }
    return ok;
}

static void ends(struct two *t)
{
    free(t->arena[0]);
    free(t->arena[1]);
}

/* Begin a frame and take its steps, in either order. Return zs_share_step's last answer, -1: an error. */
static int steps(struct two *t, const struct zs_scene *scene, const struct zs_camera *camera, uint32_t cut,
                 struct prng *p)
{
    int said[2] = { 0, 0 };
    zs_share_set(&t->share, &t->r[0], &t->r[1], cut);
    for (uint32_t i = 0; i < 2; i++)
        if (zs_frame_begin(&t->r[i], scene, camera))
            return -1;
    for (uint32_t step = 0; step < ZS_SHARE_STEPS; step++)
        for (uint32_t first = prng_pick(p, 2), i = 0; i < 2; i++)
            said[first ^ i] = zs_share_step(&t->share, first ^ i, step);
    return said[0] == said[1] ? said[0] : -1;
}

/* Return 1 if the strips that either renderer draws are those of the picture. */
static int strips_are(struct two *t, const struct picture *whole, uint32_t strip_h, struct prng *p)
{
    int ok = 1;
    for (uint32_t y = 0; y < H; y += strip_h) {
        struct zs_strip s;
        const uint32_t by = prng_pick(p, 2);
        ok &= zs_frame_skip(&t->r[!by]) == 1 && zs_frame_strip(&t->r[by], &s) == 1;
        for (size_t i = 0; ok && i < (size_t)W * s.h; i++)
            ok = (s.px[2 * i] << 8 | s.px[2 * i + 1]) == whole->color[(size_t)s.y * W + i] &&
                 s.depth[i] == whole->key[(size_t)s.y * W + i];
    }
    for (uint32_t i = 0; i < 2; i++)
        ok &= zs_frame_end(&t->r[i]) == ZS_OK;
    return ok;
}

static int shared; /* the last frame that is_drawn drew */

/* Two frames, one after the other. */
static int is_drawn(const struct zs_scene *scene, const struct zs_camera *camera, const struct zs_config *c,
                    uint32_t cut, struct prng *p)
{
    struct two t;
    struct picture whole = picture_draw(c, scene, camera);
    int ok = !whole.err && begins(&t, c);
    for (uint32_t frame = 0; ok && frame < 2; frame++) {
        shared = steps(&t, scene, camera, cut, p);
        ok = shared >= 0 && strips_are(&t, &whole, c->strip_h, p);
    }
    if (!ok)
        printf("  cut at %u, strips of %d, pools of %d and %d, shared %d\n", cut, c->strip_h, c->max_tris,
               c->max_verts, shared);
    if (!whole.err)
        ends(&t);
    picture_free(&whole);
    return ok;
}

/* ---- Demo scenes ------------------------------------------------------------------------------------------------- */

static int demo_is_drawn(uint32_t d, uint32_t frame, uint32_t pools, uint32_t cut, struct prng *p)
{
    struct demo_frame f;
    struct zs_config c = picture_config(W, H, demos[d]->depth);
    c.varyings = (uint8_t)demos[d]->varyings;
    c.strip_h = (uint16_t)(1 + prng_pick(p, 30));
    c.buffers = (uint8_t)(1 + prng_pick(p, 2));
    c.max_tris = (uint16_t)(pools ? 1 + prng_pick(p, pools) : 22000);
    c.max_verts = (uint16_t)(pools ? 3 + prng_pick(p, pools + pools / 2) : 22000);
    demos[d]->pose(&f, frame, W, H);
    return is_drawn(&f.scene, &f.camera, &c, cut, p) || (printf("  %s, frame %u\n", demos[d]->name, frame), 0);
}

static void cut_anywhere(void **state)
{
    struct prng p = { 5 };
    for (uint32_t d = 0; d < n_demos; d++)
        for (uint32_t k = 0; k < 4; k++)
            if (!demo_is_drawn(d, k * 13, 0, k == 0 ? 0 : k == 1 ? 65536 : prng_pick(&p, 65537), &p) || !shared)
                fail();
}

/* At times both parts fit, at times one does, or the sum does not. */
static void pools_of_any_size(void **state)
{
    struct prng p = { 6 };
    uint32_t together = 0, apart = 0;
    for (uint32_t d = 0; d < n_demos; d++)
        for (uint32_t k = 0; k < 8; k++) {
            if (!demo_is_drawn(d, k * 5, prng_pick(&p, 2) ? 300 : 2500, prng_pick(&p, 65537), &p))
                fail();
            together += shared == 1;
            apart += shared == 0;
        }
    assert_true(together > 30 && apart > 30);
}

/* ---- Scenes at random -------------------------------------------------------------------------------------------- */

#define INSTANCES 7

static struct shape wall, ball, ground, soup;
static struct zs_instance instance[INSTANCES];
static struct zs_material material[INSTANCES];
static const struct zs_depth_state always = { .func = ZS_DEPTH_ALWAYS };

/* What hides tiles, few triangles and many, pixels that are mixed with what is there, keys that are not compared. */
static struct zs_scene scene_at_random(struct prng *p)
{
    static const struct zs_shader *const shader[4] = { &zs_shade_raw, &zs_shade_smooth, &own_shader, &glass_shader };
    static const struct shape *const shape[4] = { &wall, &ball, &ground, &soup };
    const struct zs_scene scene = { .instance = instance, .n_instances = 1 + prng_pick(p, INSTANCES),
                                    .background = 0x1234 };
    for (uint32_t i = 0; i < scene.n_instances; i++) {
        const struct zs_instance none = { 0 };
        instance[i] = none;
        material[i] = (struct zs_material){ .shader = shader[prng_pick(p, 4)], .rgb = { 200, 120, 250 },
                                            .cull = (uint8_t)prng_pick(p, 3) };
        instance[i].mesh = &shape[prng_pick(p, 4)]->mesh;
        instance[i].material = &material[i];
        instance[i].depth_state = prng_pick(p, 6) ? NULL : &always;
        zs_pose_identity(&instance[i].pose);
        zs_pose_turn(&instance[i].pose, (zs_turn)prng_range(p, -3000, 3000), (zs_turn)prng_range(p, -9000, 9000), 0);
        for (int k = 0; k < 3; k++)
            instance[i].pose.pos[k] = prng_range(p, -3000, 3000);
    }
    return scene;
}

static void random_scenes(void **state)
{
    static const int32_t eye[3] = { 500, 900, 7000 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    struct prng p = { 7 };
    struct zs_camera camera;
    uint32_t together = 0;
    shape_ground(&wall, 2, 6000, 100, 3);
    shape_sphere(&ball, 6, 10, 2500);
    shape_ground(&ground, 9, 9000, 400, 7);
    shape_soup(&soup, 60, 5000, 11);
    if (zs_camera_perspective(&camera, 9000, H, 60, 60000) || zs_camera_look_at(&camera, eye, at, up))
        fail();
    for (uint32_t k = 0; k < 400; k++) {
        const struct zs_scene scene = scene_at_random(&p);
        struct zs_config c = picture_config(W, H, prng_pick(&p, 2) ? &zs_depth_recip : &zs_depth_float);
        c.varyings = 3;
        c.strip_h = (uint16_t)(1 + prng_pick(&p, 30));
        c.fast = prng_pick(&p, 3) ? c.fast : fast_any(&p);
        if (prng_pick(&p, 4) == 0) {
            c.max_tris = (uint16_t)(1 + prng_pick(&p, 200));
            c.max_verts = (uint16_t)(3 + prng_pick(&p, 200));
        }
        if (!is_drawn(&scene, &camera, &c, prng_pick(&p, 65537), &p))
            fail_msg("scene %u", k);
        together += shared == 1;
    }
    assert_true(together > 200);
}

/* ---- Pools that are packed empty --------------------------------------------------------------------------------- */

#define CELLS 14
struct sheet {
    int16_t pos[(CELLS + 1) * (CELLS + 1)][3];
    uint16_t tri[2 * CELLS * CELLS][3];
    struct zs_mesh mesh;
};

static void sheet_make(struct sheet *s, int n)
{
    uint32_t t = 0;
    s->mesh = (struct zs_mesh){ .pos = (const int16_t (*)[3])s->pos, .tri = (const uint16_t (*)[3])s->tri,
                                .n_verts = (uint32_t)((n + 1) * (n + 1)), .scale = ZS_Q16_ONE, .radius = 150 };
    for (int v = 0; v < (n + 1) * (n + 1); v++) {
        s->pos[v][0] = (int16_t)(v % (n + 1) * 200 / n - 100);
        s->pos[v][1] = (int16_t)(v / (n + 1) * 200 / n - 100);
    }
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++, t += 2) {
            const uint16_t a = (uint16_t)(y * (n + 1) + x), b = (uint16_t)(a + n + 1);
            const uint16_t two[2][3] = { { a, (uint16_t)(a + 1), b }, { (uint16_t)(a + 1), (uint16_t)(b + 1), b } };
            memcpy(s->tri[t], two, sizeof two);
        }
    s->mesh.n_tris = t;
}

/* The second part begins within a sheet that turns away, and has no triangle of it; the next sheet needs the room of
 * its vertices, before it is binned (12 cells) or while it is (4). */
static void a_part_of_nothing_makes_room(void **state)
{
    static struct sheet away, next;
    const struct zs_material red = { .shader = &zs_shade_raw, .rgb = { 255, 0, 0 } };
    struct zs_instance in[2] = { { .mesh = &away.mesh, .material = &red }, { .mesh = &next.mesh, .material = &red } };
    const struct zs_scene scene = { .instance = in, .n_instances = 2 };
    const int32_t at[3] = { 0, 0, 0 };
    struct zs_camera camera;
    struct prng p = { 9 };
    uint32_t together = 0;
    sheet_make(&away, CELLS);
    zs_pose_turn(&in[0].pose, 32768, 0, 0);
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), H, 50, 2000), ZS_OK);
    assert_int_equal(zs_camera_orbit(&camera, at, 300, 0, 0), ZS_OK);
    for (int n = 4; n <= 12; n += 8) {
        sheet_make(&next, n);
        struct zs_config c = picture_config(W, H, &zs_depth_float);
        c.strip_h = 16;
        c.max_tris = 1000;
        c.max_verts = n == 4 ? 226 : 300;
        for (uint32_t cut = 0; cut <= 65536; cut += 512) {
            if (!is_drawn(&scene, &camera, &c, cut, &p))
                fail_msg("%d cells, cut at %u", n, cut);
            together += shared == 1;
        }
    }
    assert_true(together > 100);
}

/* 2^32 triangles and more are not counted in 32 bits: each bins for itself. */
static void more_triangles_than_a_word(void **state)
{
    static struct sheet sheet;
    static struct zs_instance many[65535];
    const struct zs_material red = { .shader = &zs_shade_raw, .rgb = { 255, 0, 0 } };
    const struct zs_scene scene = { .instance = many, .n_instances = 65535 };
    const int32_t at[3] = { 0, 0, 0 };
    struct zs_camera camera;
    struct prng p = { 10 };
    sheet_make(&sheet, 4);
    struct zs_mesh large = sheet.mesh;
    large.n_tris = 70000; /* none is looked at: out of view */
    for (uint32_t i = 0; i < 65535; i++) {
        const int seen = i == 100 || i == 65000;
        many[i] = (struct zs_instance){ .mesh = seen ? &sheet.mesh : &large, .material = &red };
        many[i].pose.pos[0] = seen ? i == 100 ? -50 : 50 : 100000;
    }
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), H, 50, 2000), ZS_OK);
    assert_int_equal(zs_camera_orbit(&camera, at, 300, 0, 0), ZS_OK);
    const struct zs_config c = picture_config(W, H, &zs_depth_float);
    assert_true(is_drawn(&scene, &camera, &c, 32768, &p) && !shared);
}

/* ---- Where each bins for itself ---------------------------------------------------------------------------------- */

static int not_for(struct zs_config *c, int track)
{
    static uint32_t memory[2][256];
    struct prng p = { 8 };
    struct demo_frame f;
    struct two t;
    demo_cubes.pose(&f, 3, W, H);
    struct picture whole = picture_draw(c, &f.scene, &f.camera);
    int ok = !whole.err && begins(&t, c);
    for (uint32_t i = 0; ok && track && i < 2; i++)
        ok = zs_damage_track(&t.r[i], memory[i], 24) == ZS_OK;
    ok = ok && steps(&t, &f.scene, &f.camera, 32768, &p) == 0;
    if (ok && !track)
        ok = strips_are(&t, &whole, c->strip_h, &p);
    ends(&t);
    picture_free(&whole);
    return ok;
}

static void other_frames(void **state)
{
    struct zs_config c = picture_config(W, H, demo_cubes.depth);
    c.varyings = 3;
    c.strip_h = 20;
    const struct zs_config usual = c;
    c.fast = NULL;
    const int bare = not_for(&c, 0);
    c = usual;
    c.method = &zs_method_hiz;
    assert_true(bare && not_for(&c, 0));
    c = usual;
    assert_true(not_for(&c, 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_anywhere), cmocka_unit_test(pools_of_any_size), cmocka_unit_test(random_scenes),
        cmocka_unit_test(a_part_of_nothing_makes_room), cmocka_unit_test(more_triangles_than_a_word),
        cmocka_unit_test(other_frames)
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
