/* The view (core/view.c): camera units in which everything in reach fits 30 bits and a focal length keeps its, in long
 * doubles; errors by their names.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "internals.h"

static struct zs_config config_of(struct prng *p)
{
    return (struct zs_config){ .width = (uint16_t)prng_range(p, 1, 800), .height = (uint16_t)prng_range(p, 1, 600),
                               .strip_h = 1, .max_tris = 4, .max_verts = 4, .buffers = 1,
                               .subpixel_bits = (uint8_t)(prng_pick(p, 2) ? 8 : 4), .depth_bits = 16,
                               .depth = &zs_depth_linear };
}

static unsigned perspectives, orthographics, coarse;

/* Any camera that the view takes: units, planes, axes. */
static int units_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int t = 0; t < 50; t++) {
        const struct zs_config config = config_of(&p);
        struct zs_camera camera;
        const int ortho = prng_pick(&p, 3) == 0;
        const int64_t near = 1 + (prng_log(&p) & INT64_MAX) % 1000000000;
        const int64_t far = near + 1 + (int64_t)prng_pick(&p, 1u << prng_range(&p, 1, 30)) * 65536;
        CASE_CHECK(zs_camera_perspective(&camera, ZS_DEGREES(45), config.height, 1, 2) == ZS_OK);
        if (ortho) {
            camera.projection = ZS_ORTHOGRAPHIC;
            camera.height = 1 + (int64_t)(prng_next(&p) >> prng_range(&p, 17, 60));
        } else {
            camera.focal = ZS_FOCAL_MIN + (prng_next(&p) >> prng_range(&p, 9, 50));
        }
        camera.z_near = ortho && prng_pick(&p, 2) ? -near : near;
        camera.z_far = far;
        for (int k = 0; k < 3; k++)
            camera.pos[k] = (int32_t)(prng_log(&p) >> 34);
        struct zs_view view;
        memset(&view, 0xa5, sizeof view);
        zs_view_frame(&view, &config);
        CASE_CHECK(view.depth == config.depth && !view.mirror && view.width == config.width && !view.x && !view.y);
        if (zs_view_camera(&view, &config, &camera))
            continue;
        CASE_CHECK(view.perspective == !ortho && !memcmp(view.pos, camera.pos, sizeof view.pos));
        CASE_CHECK(view.snap == 8 - config.subpixel_bits);
        CASE_CHECK(view.cx == config.width * 128 && view.cy == config.height * 128);
        const int64_t reach = 1 + (int64_t)(prng_next(&p) >> prng_range(&p, 17, 60)); /* < 2^47 */
        const int err = zs_view_units(&view, &camera, reach);
        if (err) {
            coarse++;
            CASE_CHECK(err == ZS_ERR_NEAR || (err == ZS_ERR_RANGE && ortho));
            continue;
        }
        *(ortho ? &orthographics : &perspectives) += 1;
        const long double unit = ldexpl(1, view.shift - 16); /* camera units for a 65536th of a world unit */
        CASE_CHECK(view.shift <= 30 && reach * unit < ldexpl(1, 30));
        CASE_CHECK(ortho || view.shift == 30 || camera.z_near > reach || camera.z_far > reach ||
                   reach * unit > ldexpl(1, 29) * 0.98L - unit); /* as fine as 30 bits let it be */
        CASE_CHECK(view.z_near < view.z_far && (ortho || view.z_near >= 256));
        CASE_CHECK(fabsl(view.z_near - camera.z_near * unit) <= 0.5L);
        CASE_CHECK(camera.z_far * unit > ldexpl(1, 30) ? view.z_far == 1 << 30
                                                       : fabsl(view.z_far - camera.z_far * unit) <= 0.5L);
        /* sub-pixels: a focal length, or of a camera unit */
        const long double want = ortho ? config.height * 256.0L / (camera.height * unit)
                                       : ldexpl((long double)camera.focal, 8 - 32);
        const long double got = ldexpl(view.ratio, (ortho ? -view.scale_bits : view.scale_bits) - 30);
        CASE_CHECK(view.ratio > 0 && view.ratio <= 1 << 30);
        CASE_CHECK(fabsl(got - want) <= (ortho ? ldexpl(want, -28) : ldexpl(0.5L, view.scale_bits - 30)));
        CASE_CHECK(view.scale_bits >= 0 && (ortho || view.scale_bits == 8 || view.ratio >= 1 << 29));
        for (int k = 0; k < 9; k++) { /* a camera that is not turned: right, down, distance */
            const int32_t one = k == 0 ? view.ratio : k == 4 ? -view.ratio : k == 8 ? -(1 << 30) : 0;
            CASE_CHECK(view.rot[k] == one);
        }
    }
    return 1;
}

/* The planes of the sides: through the eye and the column, of length 1. */
static int side_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int t = 0; t < 200; t++) {
        const uint64_t focal = ZS_FOCAL_MIN + (prng_next(&p) >> prng_range(&p, 10, 50));
        const uint32_t subpx = (uint32_t)prng_range(&p, 1, 128 * 2048);
        int32_t n[2];
        zs_view_side(n, focal, subpx);
        const long double f = ldexpl((long double)focal, -24), length = hypotl(f, subpx);
        CASE_CHECK(fabsl(n[0] - ldexpl(f / length, 30)) < 4 && fabsl(n[1] - ldexpl(subpx / length, 30)) < 4);
    }
    return 1;
}

/* Lengths: nearest, and held at 2^30. */
static int length_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_view view = { 0 };
    for (int t = 0; t < 200; t++) {
        const int64_t length = prng_log(&p);
        view.shift = prng_range(&p, -3, 30);
        const long double want = ldexpl((long double)length, view.shift - 16), most = 1 << 30;
        const int32_t got = zs_view_length(&view, length);
        CASE_CHECK(want > most ? got == 1 << 30 : want < -most ? got == -(1 << 30) : fabsl(got - want) <= 0.5L);
    }
    return 1;
}

/* What a camera has that is refused, and its error. */
static const struct refused {
    const char *what;
    int64_t near, far, height;
    uint64_t focal;
    int32_t x;
    uint8_t ortho;
    int err;
} refused[] = {
    { "near is far", 1000, 1000, 0, ZS_FOCAL_MIN, 0, 0, ZS_ERR_CAMERA },
    { "near is 0", 0, 1000, 0, ZS_FOCAL_MIN, 0, 0, ZS_ERR_CAMERA },
    { "near is behind the eye", -5, 1000, 0, ZS_FOCAL_MIN, 0, 0, ZS_ERR_CAMERA },
    { "near and far are a 65537th apart", 65536 * 3 - 3 + 1, 65536 * 3, 0, ZS_FOCAL_MIN, 0, 0, ZS_ERR_CAMERA },
    { "no focal length", 1, 1000, 0, ZS_FOCAL_MIN - 1, 0, 0, ZS_ERR_CAMERA },
    { "focal length", 1, 1000, 0, (uint64_t)ZS_FOCAL_MAX + 1, 0, 0, ZS_ERR_CAMERA },
    { "far", 1, (int64_t)ZS_FAR_MAX * 65536 + 1, 0, ZS_FOCAL_MIN, 0, 0, ZS_ERR_CAMERA },
    { "height", 1, 1000, ZS_HEIGHT_MIN - 1, 0, 0, 1, ZS_ERR_CAMERA },
    { "height", 1, 1000, ((int64_t)ZS_WORLD_MAX << 17) + 1, 0, 0, 1, ZS_ERR_CAMERA },
    { "no such projection", 1, 1000, ZS_HEIGHT_MIN, ZS_FOCAL_MIN, 0, 7, ZS_ERR_CAMERA },
    { "the eye beyond the world", 1, 1000, 0, ZS_FOCAL_MIN, ZS_WORLD_MAX + 1, 0, ZS_ERR_RANGE },
    { "the eye at its end", 1, 1000, 0, ZS_FOCAL_MIN, -ZS_WORLD_MAX, 0, ZS_OK },
    { "the longest focal length", 1, 1000, 0, ZS_FOCAL_MAX, 0, 0, ZS_OK },
    { "a 65536th apart", 65536 * 3 - 3, 65536 * 3, 0, ZS_FOCAL_MIN, 0, 0, ZS_OK },
    { "behind the eye", -1000, -5, ZS_HEIGHT_MIN, 0, 0, 1, ZS_OK },
};

static void errors_have_their_names(void **state)
{
    struct prng p = { 7 };
    const struct zs_config config = config_of(&p);
    for (uint32_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        const struct refused *c = &refused[k];
        struct zs_view view;
        struct zs_camera camera;
        assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(45), 16, 1, 2), ZS_OK);
        camera.projection = c->ortho == 7 ? 7 : c->ortho ? ZS_ORTHOGRAPHIC : ZS_PERSPECTIVE;
        camera.z_near = c->near;
        camera.z_far = c->far;
        camera.height = c->height;
        camera.focal = c->focal;
        camera.pos[0] = c->x;
        zs_view_frame(&view, &config);
        const int err = zs_view_camera(&view, &config, &camera);
        if (err != c->err)
            fail_msg("%s: %d, not %d", c->what, err, c->err);
    }
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(units_are_as_fine_as_30_bits, units_case, 2000, { "perspective views", &perspectives, 5000 },
                 { "orthographic views", &orthographics, 2000 }, { "views that are refused", &coarse, 100 }),
    CASES_TEST(planes_of_the_sides, side_case, 500),
    CASES_TEST(lengths_are_nearest, length_case, 500),
    cmocka_unit_test(errors_have_their_names),
};
CASES_MAIN(tests)
