/* Scenes whose parts are of very different sizes, cameras at the ends of their ranges.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "fast_lists.h"
#include "picture.h"

#define SIZE 200
static uint32_t arena[200000];

static uint32_t red_pixels(struct zs_renderer *r, const struct zs_scene *scene,
                           const struct zs_camera *camera, const struct zs_fast *const *fast)
{
    const struct zs_config config = { .width = SIZE, .height = SIZE, .strip_h = SIZE, .max_tris = 10, .max_verts = 20,
                                      .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip,
                                      .fast = fast };
    struct zs_strip strip;
    uint32_t red = 0;
    assert_int_equal(zs_init(r, &config, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_frame_begin(r, scene, camera), ZS_OK);
    assert_int_equal(zs_frame_strip(r, &strip), 1);
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        red += strip.px[2 * i] >= 0xf8;
    assert_int_equal(zs_frame_end(r), ZS_OK);
    return red;
}

/* A small triangle that hangs a little before the near plane, and one so far away that a camera unit
 * is a quarter of a world unit: whether the small one's sphere is that small, or reaches beyond all near planes, so
 * that nothing is known by it, must not matter. Nor do accelerators. */
static void stress_26_spheres_beside_a_far_reach(void **state)
{
    static const int16_t far_p[3][3] = { { -30000, -30000, 0 }, { 30000, -30000, 0 }, { 0, 30000, 0 } };
    static const int16_t small_p[3][3] = { { 412, 412, -100 }, { 582, 412, -100 }, { 412, 582, -100 } };
    static const uint16_t t[1][3] = { { 0, 1, 2 } };
    const struct zs_mesh far_mesh = { .pos = far_p, .tri = t, .n_verts = 3, .n_tris = 1,
                                      .scale = 65536, .radius = 42427 };
    struct zs_mesh small_mesh = { .pos = small_p, .tri = t, .n_verts = 3, .n_tris = 1,
                                  .scale = 66, .center = { 497, 497, -100 }, .radius = 121 };
    uint32_t culled = 0, drawn = 0;
    const struct zs_material blue = { .shader = &zs_shade_raw, .rgb = { 0, 0, 80 }, .cull = ZS_CULL_NONE };
    const struct zs_material red = { .shader = &zs_shade_raw, .rgb = { 255, 0, 0 }, .cull = ZS_CULL_NONE };
    struct zs_instance in[2] = { { .mesh = &far_mesh, .material = &blue },
                                 { .mesh = &small_mesh, .material = &red } };
    zs_pose_identity(&in[0].pose);
    zs_pose_identity(&in[1].pose);
    in[0].pose.pos[2] = -(1 << 28);
    in[1].pose.pos[2] = -300;
    const struct zs_scene scene = { .instance = in, .n_instances = 2,
                                    .light = { .dir = { 0, 0, ZS_Q30_ONE }, .ambient = ZS_Q16_ONE } };
    struct zs_camera camera;
    struct zs_renderer r;
    assert_int_equal(zs_camera_perspective(&camera, 500, SIZE, 300, 1 << 29), ZS_OK);
    for (int32_t n = 0; n < 600; n++) { /* near planes from before the small one to behind it */
        camera.z_near = 299 * 65536 + n * 1000;
        small_mesh.radius = 121;
        const uint32_t on = red_pixels(&r, &scene, &camera, NULL);
        culled += zs_frame_stats(&r)->instances_culled;
        drawn += on > 0;
        assert_int_equal(on, red_pixels(&r, &scene, &camera, fast_all));
        small_mesh.radius = 65535;
        assert_int_equal(on, red_pixels(&r, &scene, &camera, NULL));
        assert_int_equal(zs_frame_stats(&r)->instances_culled, 0);
        assert_int_equal(on, red_pixels(&r, &scene, &camera, fast_all));
    }
    assert_true(culled > 20 && drawn > 20);
}

static struct zs_config one_strip(const struct zs_depth *depth)
{
    return (struct zs_config){ .width = 64, .height = 64, .strip_h = 64, .max_tris = 1, .max_verts = 3,
                               .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = depth };
}

/* Orthographic views of any height are taken, whatever is in view. */
static void orthographic_heights(void **state)
{
    const struct zs_config config = one_strip(&zs_depth_linear);
    const struct zs_scene empty = { .light = { .dir = { 0, 0, ZS_Q30_ONE } } };
    struct zs_renderer r;
    struct zs_camera camera;
    assert_int_equal(zs_init(&r, &config, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_camera_orthographic(&camera, 1, 1, 1 << 20), ZS_OK);
    for (int bits = 3; bits <= 46; bits++) {
        camera.height = (zs_q48_16)1 << bits;
        const int err = zs_frame_begin(&r, &empty, &camera);
        assert_true(err == ZS_OK || (bits < 12 && err == ZS_ERR_RANGE)); /* sub-pixels of 2^-27 */
    }
    camera.height = ZS_HEIGHT_MIN - 1;
    assert_int_equal(zs_frame_begin(&r, &empty, &camera), ZS_ERR_CAMERA);
}

/* The scale of the least orthographic heights, of which a shift takes bits: its ratio is in (1/2, 1] all the same, and
 * it is sub-pixels by height to 2^-29. */
static void ratios_of_least_heights(void **state)
{
    const struct zs_scene empty = { .light = { .dir = { 0, 0, ZS_Q30_ONE } } };
    struct zs_renderer r;
    struct zs_camera camera;
    assert_int_equal(zs_camera_orthographic(&camera, 1, 1, 2), ZS_OK);
    for (int32_t px = 16; px <= 200; px++)
        for (int32_t height = (int32_t)ZS_HEIGHT_MIN; height < 80; height++) {
            const struct zs_config config = { .width = 8, .height = (uint16_t)px, .strip_h = 8, .max_tris = 1,
                                              .max_verts = 3, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                              .depth = &zs_depth_linear };
            assert_int_equal(zs_init(&r, &config, arena, sizeof arena), ZS_OK);
            camera.height = height;
            if (zs_frame_begin(&r, &empty, &camera) != ZS_OK)
                continue; /* units are coarser than sub-pixels */
            const double exact = ldexp(px, 24) / height, ratio = ldexp(r.view.ratio, -30);
            assert_true(ratio > 0.5 && ratio <= 1);
            assert_true(fabs(ldexp(ratio, r.view.shift - r.view.scale_bits) / exact - 1) < 0x1p-29);
            (void)zs_frame_end(&r);
        }
}

/* A mesh beyond its sphere, outside one side of the guard band: two corners by so little that they snap onto its
 * edge. */
static void beyond_the_guard_by_less_than_a_step(void **state)
{
    static const int16_t corner[3][3] = { { 32752, -16, 0 },
                                          { 32753, 16, 0 },
                                          { 32752, 16, 0 } }; /* 64 units: 8188 px */
    static struct lone l;
    struct zs_config config = lone_config(64, 48, &zs_depth_linear);
    struct zs_camera camera;
    assert_int_equal(zs_camera_orthographic(&camera, 48 * 256, 1, 1 << 23), ZS_OK); /* 1/256 px a unit */
    lone_set(&l, corner, 3, 64 * ZS_Q16_ONE);
    l.mesh.radius = 1;
    l.instance.pose.pos[0] = 4;
    l.instance.pose.pos[2] = -(1 << 22);
    config.subpixel_bits = 4;
    struct picture f = picture_draw(&config, &l.scene, &camera);
    assert_int_equal(f.err, ZS_OK);
    assert_int_equal(f.covered, 0);
    assert_int_equal(f.stats.tris_offscreen, 1);
    assert_true(stats_add_up(&f.stats));
    picture_free(&f);
}

/* The basis stays exact to 2^-27 however close up is to the view. */
static void look_along_nearly_parallel(void **state)
{
    const int32_t eye[3] = { 0, 0, 0 };
    double worst = 0.0;
    for (int32_t step = 1; step <= 1 << 29; step *= 2) {
        struct zs_camera c;
        const int32_t dir[3] = { 300000000, -400000000, 123456789 };
        const int32_t up[3] = { -300000000 + step / 3, 400000000 + step, -123456789 - step / 5 };
        const int err = zs_camera_look_along(&c, eye, dir, up);
        if (step < 1024) /* a millionth of the length and below: parallel or not, a defined answer */
            continue;
        assert_int_equal(err, ZS_OK);
        long double right[3], length = 0.0L;
        for (int k = 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            right[k] = (long double)dir[i] * up[j] - (long double)dir[j] * up[i];
            length += right[k] * right[k];
        }
        for (int k = 0; k < 3; k++) {
            const double off = fabs((double)(right[k] / sqrtl(length)) - c.rot[k] / 1073741824.0);
            worst = off > worst ? off : worst;
        }
    }
    print_message("right: off by at most 2^%.2f\n", log2(worst));
    assert_true(worst <= 0x1p-27);
}

/* A frame that is refused for a missing pointer leaves none open. */
static void null_closes_the_frame(void **state)
{
    const struct zs_config config = one_strip(&zs_depth_recip);
    const struct zs_scene empty = { .light = { .dir = { 0, 0, ZS_Q30_ONE } } };
    struct zs_renderer r;
    struct zs_camera camera;
    struct zs_strip strip;
    assert_int_equal(zs_init(&r, &config, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_camera_perspective(&camera, 8192, 64, 1000, 2000), ZS_OK);
    assert_int_equal(zs_frame_begin(&r, &empty, &camera), ZS_OK);
    assert_int_equal(zs_frame_begin(&r, NULL, &camera), ZS_ERR_NULL);
    assert_int_equal(zs_frame_strip(&r, &strip), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_init(&r, &config, NULL, sizeof arena), ZS_ERR_NULL);
    assert_int_equal(zs_frame_begin(&r, &empty, &camera), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_camera_perspective(&camera, 8192, 0, 1000, 2000), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_perspective(&camera, 1, 4096, 1000, 2000), ZS_ERR_CAMERA);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stress_26_spheres_beside_a_far_reach),
        cmocka_unit_test(orthographic_heights),
        cmocka_unit_test(ratios_of_least_heights),
        cmocka_unit_test(beyond_the_guard_by_less_than_a_step),
        cmocka_unit_test(look_along_nearly_parallel),
        cmocka_unit_test(null_closes_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
