/* Cameras (support/camera.c) against double precision.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "internals.h"

static void cross3(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Rows right, up, back; returns the sine between view and up. */
static double look_matrix(double m[9], const double dir[3], const double up[3])
{
    double forward[3] = { dir[0], dir[1], dir[2] }, u[3] = { up[0], up[1], up[2] };
    unit3(forward);
    unit3(u);
    cross3(m, forward, u);
    const double sine = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    unit3(m);
    for (int k = 0; k < 3; k++)
        m[6 + k] = -forward[k];
    cross3(m + 3, m + 6, m);
    return sine;
}

static double look_worst;

static int look_case(uint64_t seed)
{
    struct prng p = { seed };
    int32_t eye[3], at[3], up[3];
    for (int k = 0; k < 3; k++) {
        const int shift = prng_range(&p, 0, 29);
        eye[k] = prng_range(&p, -ZS_WORLD_MAX >> shift, ZS_WORLD_MAX >> shift);
        at[k] = prng_range(&p, -ZS_WORLD_MAX >> shift, ZS_WORLD_MAX >> shift);
        up[k] = (int32_t)prng_log(&p);
    }
    const double dir[3] = { (double)at[0] - eye[0], (double)at[1] - eye[1],
                            (double)at[2] - eye[2] };
    const double u[3] = { up[0], up[1], up[2] };
    double want[9];
    const double sine = look_matrix(want, dir, u);
    struct zs_camera c;
    memset(&c, 0x5a, sizeof c);
    const struct zs_camera before = c;
    const int err = zs_camera_look_at(&c, eye, at, up);
    if (!(sine >
          0x1p-19)) { /* parallel, or nearly: refused, or right to what is left of the precision */
        CASE_CHECK(err == ZS_ERR_VECTOR || (err == ZS_OK && sine > 0x1p-24));
        CASE_CHECK(!err || memcmp(&c, &before, sizeof c) == 0);
        return 1;
    }
    CASE_CHECK(err == ZS_OK && memcmp(c.pos, eye, sizeof eye) == 0 && c.focal == before.focal);
    const double off = apart(c.rot, want);
    look_worst = fmax(look_worst, off);
    if (off > 0x1p-27 || not_a_rotation(c.rot) > 0x1p-26)
        return case_wrong("eye %d %d %d at %d %d %d up %d %d %d: off by 2^-27 * %.3f, sine %g",
                          eye[0], eye[1], eye[2], at[0], at[1], at[2], up[0], up[1], up[2],
                          off * 0x1p27, sine);
    return 1;
}

static void look_at_against_doubles(void **state)
{
    (void)state;
    look_worst = 0;
    CASES(look_case, 20000);
    print_message("look-at, up at any angle above 2^-19: off by at most 2^-27 * %.3f\n",
                  look_worst * 0x1p27);
}

/* Directions that are nearly parallel, of any length: taken from 2^-19 rad on, refused below 2^-24; with components
 * above INT32_MIN, what is taken is right to 2^-27. */
static unsigned near_taken, near_refused;

static int near_case(uint64_t seed)
{
    struct prng p = { seed };
    const int shift = prng_range(&p, 0, 8);
    int32_t dir[3], up[3];
    double d[3], u[3], want[9];
    for (int k = 0; k < 3; k++) {
        const int32_t any = (int32_t)prng_next(&p), by = prng_range(&p, -8191, 8191) / (1 << prng_range(&p, 0, 12));
        dir[k] = any / (any == INT32_MIN ? 2 : 1 << shift);
        const int64_t at = (int64_t)dir[k] + by;
        up[k] = (int32_t)(at > INT32_MAX ? INT32_MAX : at < -INT32_MAX ? -INT32_MAX : at);
        d[k] = dir[k];
        u[k] = up[k];
    }
    static const int32_t eye[3] = { 0, 0, 0 };
    struct zs_camera c;
    const double sine = look_matrix(want, d, u);
    const int err = zs_camera_look_along(&c, eye, dir, up);
    near_taken += !err;
    near_refused += err != 0;
    CASE_CHECK(err == (sine >= 0x1p-19 ? ZS_OK : sine < 0x1p-24 ? ZS_ERR_VECTOR : err));
    return err || apart(c.rot, want) <= 0x1p-27 ? 1 : case_wrong("off by 2^-27 * %g", apart(c.rot, want) * 0x1p27);
}

static int orbit_case(uint64_t seed)
{
    struct prng p = { seed };
    const int32_t at[3] = { prng_range(&p, -100000, 100000), prng_range(&p, -100000, 100000),
                            prng_range(&p, -100000, 100000) };
    const int32_t distance = 1 + prng_range(&p, 0, 1 << prng_range(&p, 0, 28));
    const zs_turn yaw = (zs_turn)prng_next(&p);
    const int16_t pitch = (int16_t)prng_range(&p, -16383, 16383);
    struct zs_camera c;
    memset(&c, 0, sizeof c);
    CASE_CHECK(zs_camera_orbit(&c, at, distance, yaw, pitch) == ZS_OK);
    const double out[3] = { cos(pitch * TURN) * sin(yaw * TURN), sin(pitch * TURN),
                            cos(pitch * TURN) * cos(yaw * TURN) };
    const double dir[3] = { -out[0], -out[1], -out[2] }, up[3] = { 0, 1, 0 };
    double want[9];
    const double sine = look_matrix(want, dir, up);
    for (int k = 0; k < 3; k++)
        CASE_CHECK(fabs(c.pos[k] - (at[k] + out[k] * distance)) <= 0.5 + distance * 0x1p-27);
    CASE_CHECK(apart(c.rot, want) <= 0x1p-27 / fmin(1, sine / 0.5));
    CASE_CHECK(not_a_rotation(c.rot) < 0x1p-26);
    return 1;
}

static int focal_case(uint64_t seed)
{
    struct prng p = { seed };
    const zs_turn fov = (zs_turn)prng_range(&p, 1, 32767);
    const uint16_t height = (uint16_t)prng_range(&p, 1, 4096);
    struct zs_camera c;
    CASE_CHECK(zs_camera_perspective(&c, fov, height, 1, 2) == ZS_OK);
    const double want = height / 2.0 / tan(fov * TURN / 2), got = ldexp((double)c.focal, -32);
    /* sine and cosine to 2^-28 each */
    const double s = sin(fov * TURN / 2), k = cos(fov * TURN / 2);
    const double bound = want * 0x1p-28 * (1 / s + 1 / fmax(k, 1e-9)) + 0x1p-31;
    if (fabs(want - got) > bound)
        return case_wrong("fov %u, %u px: focal %.9f, not %.9f", fov, height, got, want);
    return 1;
}

static void cameras_refused_by_name(void **state)
{
    (void)state;
    struct zs_camera c;
    memset(&c, 0x5a, sizeof c);
    const struct zs_camera before = c;
    const int32_t zero[3] = { 0, 0, 0 }, one[3] = { 0, 0, -5 }, up[3] = { 0, 1, 0 };
    const int32_t along[3] = { 0, 0, 3 }, far_off[3] = { 0, ZS_WORLD_MAX + 1, 0 };
    const int32_t least[3] = { 0, INT32_MIN, 0 };

    assert_int_equal(zs_camera_perspective(&c, 0, 240, 1, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_perspective(&c, 32768, 240, 1, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_perspective(&c, 8192, 240, 0, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_perspective(&c, 8192, 240, -1, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_perspective(&c, 8192, 240, 2, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_perspective(&c, 8192, 240, 1, ZS_WORLD_MAX + 1), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_orthographic(&c, 0, 1, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_orthographic(&c, -1, 1, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_orthographic(&c, 100, 2, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_orthographic(&c, 100, INT32_MIN, 2), ZS_ERR_CAMERA);
    assert_int_equal(zs_camera_orthographic(&c, 100, 1, INT32_MAX), ZS_ERR_CAMERA);

    assert_int_equal(zs_camera_look_at(&c, one, one, up), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_look_at(&c, zero, one, zero), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_look_at(&c, zero, one, along), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_look_at(&c, far_off, one, up), ZS_ERR_RANGE);
    assert_int_equal(zs_camera_look_at(&c, zero, far_off, up), ZS_ERR_RANGE);
    assert_int_equal(zs_camera_look_at(&c, least, one, up), ZS_ERR_RANGE);
    assert_int_equal(zs_camera_look_along(&c, zero, zero, up), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_look_along(&c, least, one, up), ZS_ERR_RANGE);
    assert_int_equal(zs_camera_look_along(&c, zero, least, up), ZS_ERR_VECTOR); /* parallel to up */
    const int32_t steep[3] = { 0, 1 << 21, 1 }, less[3] = { 0, (1 << 21) - 1, 1 };
    assert_int_equal(zs_camera_look_at(&c, steep, zero, up), ZS_ERR_VECTOR);
    struct zs_camera taken;
    assert_int_equal(zs_camera_look_at(&taken, less, zero, up), ZS_OK);
    assert_int_equal(zs_camera_orbit(&c, zero, 0, 0, 0), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_orbit(&c, zero, -1, 0, 0), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_orbit(&c, zero, 10, 0, 16384), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_orbit(&c, zero, 10, 0, -16384), ZS_ERR_VECTOR);
    assert_int_equal(zs_camera_orbit(&c, zero, INT32_MAX, 0, 0), ZS_ERR_RANGE);
    assert_int_equal(zs_camera_orbit(&c, least, 10, 0, 0), ZS_ERR_RANGE);
    const int32_t west[3] = { -ZS_WORLD_MAX, 0, 0 },
                  beyond[3] = { ZS_WORLD_MAX + 1, 0, 0 }; /* the eye would be inside */
    assert_int_equal(zs_camera_orbit(&c, west, 2 * ZS_WORLD_MAX, 16384, 0), ZS_ERR_RANGE);
    assert_int_equal(zs_camera_orbit(&c, beyond, 10, 49152, 0), ZS_ERR_RANGE);
    assert_memory_equal(&c, &before, sizeof c); /* none of them touched it */
    assert_int_equal(zs_camera_orbit(&c, zero, 10, 0, 16383), ZS_OK);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(look_at_against_doubles),
    CASES_COUNTS(near_parallel, near_case, 20000, { "taken", &near_taken, 4000 },
                 { "refused", &near_refused, 2000 }),
    CASES_TEST(orbit_against_doubles, orbit_case, 10000),
    CASES_TEST(focal_length_against_doubles, focal_case, 20000),
    cmocka_unit_test(cameras_refused_by_name)
};

CASES_MAIN(tests)
