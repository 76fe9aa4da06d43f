/* Angles, vectors and poses (core/rotation.c, support/pose.c) against double precision.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "internals.h"

/* ---- Angles and vectors ---------------------------------------------------------------------- */

static void sine_and_cosine_of_every_angle(void **state)
{
    double worst = 0;
    for (uint32_t a = 0; a < 65536; a++) {
        const double s = fabs(q30(zs_sin((zs_turn)a)) - sin(a * TURN));
        const double c = fabs(q30(zs_cos((zs_turn)a)) - cos(a * TURN));
        worst = fmax(worst, fmax(s, c));
    }
    print_message("sine and cosine: off by at most 2^-28 * %.3f\n", worst * 0x1p28);
    assert_true(worst <= 0x1p-28);
    assert_int_equal(zs_sin(0), 0);
    assert_int_equal(zs_sin(16384), ZS_Q30_ONE);
    assert_int_equal(zs_cos(32768), -ZS_Q30_ONE);
}

static int unit_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int n = 0; n < 200; n++) {
        int32_t v[3], in_place[3];
        for (int k = 0; k < 3; k++) {
            v[k] = (int32_t)prng_log(&p);
            if (prng_pick(&p, 8) == 0)
                v[k] = prng_pick(&p, 2) ? INT32_MIN : INT32_MAX;
            in_place[k] = v[k];
        }
        const double length = sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
        zs_q2_30 out[3];
        if (length == 0)
            continue;
        CASE_CHECK(zs_unit(out, v) == ZS_OK && zs_unit(in_place, in_place) == ZS_OK);
        for (int k = 0; k < 3; k++)
            if (fabs(q30(out[k]) - v[k] / length) > 0x1p-28 || out[k] != in_place[k])
                return case_wrong("zs_unit(%d %d %d): %d %d %d", v[0], v[1], v[2], out[0], out[1],
                                  out[2]);
    }
    return 1;
}

static void unit_vectors(void **state)
{
    CASES(unit_case, 2000);
    const int32_t none[3] = { 0, 0, 0 };
    zs_q2_30 out[3] = { 1, 2, 3 };
    assert_int_equal(zs_unit(out, none), ZS_ERR_VECTOR);
    assert_true(out[0] == 1 && out[1] == 2 && out[2] == 3);
}

/* ---- Poses ----------------------------------------------------------------------------------- */

/* Rodrigues' rotation about a unit axis. */
static void axis_turn(double out[9], const double u[3], double angle)
{
    const double c = cos(angle), s = sin(angle), v = 1 - c;
    const double m[9] = { c + u[0] * u[0] * v,        u[0] * u[1] * v - u[2] * s,
                          u[0] * u[2] * v + u[1] * s, u[1] * u[0] * v + u[2] * s,
                          c + u[1] * u[1] * v,        u[1] * u[2] * v - u[0] * s,
                          u[2] * u[0] * v - u[1] * s, u[2] * u[1] * v + u[0] * s,
                          c + u[2] * u[2] * v };
    memcpy(out, m, sizeof m);
}

static void mul(double out[9], const double a[9], const double b[9])
{
    double m[9];
    for (int k = 0; k < 9; k++)
        m[k] = a[k / 3 * 3] * b[k % 3] + a[k / 3 * 3 + 1] * b[3 + k % 3] +
               a[k / 3 * 3 + 2] * b[6 + k % 3];
    memcpy(out, m, sizeof m);
}

static double pose_worst;

static int turn_case(uint64_t seed)
{
    struct prng p = { seed };
    zs_turn a[3];
    for (int k = 0; k < 3; k++)
        a[k] = (zs_turn)(prng_pick(&p, 3) ? prng_next(&p) : prng_next(&p) & 0xe000u);
    struct zs_pose pose;
    memset(&pose, 0x55, sizeof pose);
    struct zs_pose before = pose;
    zs_pose_turn(&pose, a[0], a[1], a[2]);
    const double y[3] = { 0, 1, 0 }, x[3] = { 1, 0, 0 }, z[3] = { 0, 0, 1 };
    double ry[9], rx[9], rz[9];
    axis_turn(ry, y, a[0] * TURN);
    axis_turn(rx, x, a[1] * TURN);
    axis_turn(rz, z, a[2] * TURN);
    mul(ry, ry, rx);
    mul(ry, ry, rz);
    pose_worst = fmax(pose_worst, apart(pose.rot, ry));
    CASE_CHECK(apart(pose.rot, ry) <= 0x1p-27);
    CASE_CHECK(memcmp(pose.pos, before.pos, sizeof pose.pos) == 0 && pose.scale == before.scale);
    return 1;
}

static void pose_turn_is_yaw_pitch_roll(void **state)
{
    pose_worst = 0;
    CASES(turn_case, 20000);
    print_message("zs_pose_turn: off by at most 2^-27 * %.3f\n", pose_worst * 0x1p27);
}

static int rotate_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_pose pose;
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    int32_t axis[3];
    for (int k = 0; k < 3; k++)
        axis[k] = prng_pick(&p, 4) ? (int32_t)prng_log(&p) : 0;
    if (!axis[0] && !axis[1] && !axis[2])
        axis[seed % 3] = prng_pick(&p, 2) ? INT32_MIN : 1;
    const zs_turn angle = (zs_turn)(prng_pick(&p, 3) ? prng_next(&p) : prng_next(&p) & 0xc000u);
    double was[9], turn[9], u[3];
    const double length = sqrt((double)axis[0] * axis[0] + (double)axis[1] * axis[1] +
                               (double)axis[2] * axis[2]);
    for (int k = 0; k < 9; k++)
        was[k] = q30(pose.rot[k]);
    for (int k = 0; k < 3; k++)
        u[k] = axis[k] / length;
    axis_turn(turn, u, angle * TURN);
    mul(turn, turn, was);
    CASE_CHECK(zs_pose_rotate(&pose, axis, angle) == ZS_OK);
    const double off = apart(pose.rot, turn);
    pose_worst = fmax(pose_worst, off);
    if (off > 0x1p-27 || not_a_rotation(pose.rot) > 0x1p-27)
        return case_wrong("axis %d %d %d angle %u: off by %g, orthonormal to %g", axis[0], axis[1],
                          axis[2], angle, off, not_a_rotation(pose.rot));
    return 1;
}

static void pose_rotate_by_any_angle(void **state)
{
    pose_worst = 0;
    CASES(rotate_case, 20000);
    print_message("zs_pose_rotate, once: off by at most 2^-27 * %.3f\n", pose_worst * 0x1p27);
}

static void pose_rotate_by_half_a_turn(void **state)
{
    struct zs_pose pose;
    for (int n = 0; n < 27; n++) {
        const int32_t axis[3] = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
        zs_pose_identity(&pose);
        const struct zs_pose before = pose;
        if (n == 13) {
            assert_int_equal(zs_pose_rotate(&pose, axis, 32768), ZS_ERR_VECTOR);
            assert_memory_equal(&pose, &before, sizeof pose);
            continue;
        }
        const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        const double u[3] = { axis[0] / length, axis[1] / length, axis[2] / length };
        double want[9];
        axis_turn(want, u, 32768 * TURN);
        assert_int_equal(zs_pose_rotate(&pose, axis, 32768), ZS_OK);
        assert_true(apart(pose.rot, want) <= 0x1p-27);
    }
}

/* ---- Composed rotations ----------------------------------------------------------------------
 *
 * Compared with rotations composed in long double, from axis and angle as given. Drift is how far the end
 * of a lever of 160 px may be from where it should be, in sub-pixels (1/256 px). */

#define LEVER (160 * 256)

struct part {
    int32_t axis[3];
    zs_turn angle;
};

/* What is turned by in every frame. */
struct frame {
    struct part part[3];
    uint32_t parts;
};

static void show_frame(char *text, size_t size, const struct frame *f)
{
    *text = '\0';
    for (uint32_t i = 0; i < f->parts; i++) {
        const struct part *const p = &f->part[i];
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%d %d %d by %u", i ? ", " : "", p->axis[0], p->axis[1],
                 p->axis[2], p->angle);
    }
}

/* Quaternions: w x y z. out may be a or b. */
static void quat_mul(long double out[4], const long double a[4], const long double b[4])
{
    const long double q[4] = { a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                               a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                               a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                               a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0] };
    memcpy(out, q, sizeof q);
}

static void quat_turn(long double q[4], const struct part *p, uint32_t times)
{
    const long double pi = 3.141592653589793238462643383279502884L;
    const long double half = pi / 65536 * (zs_turn)(p->angle * times);
    long double length = 0;
    for (int k = 0; k < 3; k++)
        length += (long double)p->axis[k] * p->axis[k];
    length = sqrtl(length);
    q[0] = cosl(half);
    for (int k = 0; k < 3; k++)
        q[1 + k] = sinl(half) * p->axis[k] / length;
}

static void quat_matrix(double m[9], const long double q[4])
{
    const long double w = q[0], x = q[1], y = q[2], z = q[3], n = w * w + x * x + y * y + z * z;
    const long double r[9] = { w * w + x * x - y * y - z * z, 2 * (x * y - w * z),
                               2 * (x * z + w * y),           2 * (x * y + w * z),
                               w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
                               2 * (x * z - w * y),           2 * (y * z + w * x),
                               w * w - x * x - y * y + z * z };
    for (int k = 0; k < 9; k++)
        m[k] = (double)(r[k] / n);
}

/* The rotation nearest to m, which is nearly one. */
static void nearest_rotation(double out[9], const zs_q2_30 m[9])
{
    for (int k = 0; k < 9; k++)
        out[k] = q30(m[k]);
    for (int n = 0; n < 4; n++) {
        double fix[9];
        for (int k = 0; k < 9; k++) {
            const double *const a = out + k / 3 * 3, *const b = out + k % 3 * 3;
            fix[k] = (k % 4 ? 0 : 1.5) - (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / 2;
        }
        mul(out, fix, out);
    }
}

/* Sub-pixels: the difference of two rotations that are nearly the same is a vector's cross product, whose
 * sum of squares is twice the vector's. */
static double lever_end(const zs_q2_30 m[9], const double want[9])
{
    double sum = 0;
    for (int k = 0; k < 9; k++)
        sum += (q30(m[k]) - want[k]) * (q30(m[k]) - want[k]);
    return sqrt(sum / 2) * LEVER;
}

static double skew_worst;

/* The largest drift on the way of n rotations from start, looked at about 250 times. */
static double drift_of(const struct frame *f, const struct zs_pose *start, uint32_t n)
{
    struct zs_pose pose = *start;
    long double turn[3][4], all[4] = { 1, 0, 0, 0 };
    double first[9], want[9], worst = 0;
    nearest_rotation(first, start->rot);
    for (uint32_t i = 0; i < f->parts; i++)
        quat_turn(turn[i], &f->part[i], 1);
    const uint32_t frames = n / f->parts, every = frames / 250 + 1;
    for (uint32_t at = 1; at <= frames; at++) {
        for (uint32_t i = 0; i < f->parts; i++) {
            (void)zs_pose_rotate(&pose, f->part[i].axis, f->part[i].angle);
            quat_mul(all, turn[i], all);
        }
        if (at % every && at != frames)
            continue;
        if (f->parts == 1) /* one axis: the angle is known modulo a turn */
            quat_turn(all, &f->part[0], at);
        quat_matrix(want, all);
        mul(want, want, first);
        worst = fmax(worst, lever_end(pose.rot, want));
        skew_worst = fmax(skew_worst, not_a_rotation(pose.rot));
    }
    return worst;
}

/* ZS_STRESS=1 in the environment: everything at full length, some minutes. */
static int full_stress(void)
{
    const char *const text = getenv("ZS_STRESS");
    return text && *text && *text != '0';
}

/* Below a sub-pixel after a million; after fewer, below as many parts of it. */
static int drift_within(const struct frame *f, const struct zs_pose *start, uint32_t n, int show)
{
    char text[160];
    n /= (uint32_t)cases_step(n);
    const double drift = drift_of(f, start, n), most = n / 1e6;
    show_frame(text, sizeof text, f);
    if (show)
        print_message("%7u rotations: drift %.3f sub-pixels at 160 px (axis %s)\n", n, drift, text);
    if (!(drift < most) || skew_worst > 0x1p-27)
        return case_wrong("axis %s: drift %.3f of %.3f sub-pixels after %u, orthonormal to 2^-27 * %.3f",
                          text, drift, most, n, skew_worst * 0x1p27);
    return 1;
}

static void drift_of_frames(const struct frame *f, size_t count, uint32_t n)
{
    struct zs_pose pose;
    zs_pose_identity(&pose);
    skew_worst = 0;
    for (size_t i = 0; i < count; i++)
        assert_true(drift_within(&f[i], &pose, n, 1));
    print_message("orthonormal to 2^-27 * %.3f\n", skew_worst * 0x1p27);
}

/* One axis, three in turn, two that nearly undo each other (a frame turns by half an ulp, which a
 * rounding could lose in the same way for ever), and the worst that was found in a search. */
static void stress_17_drift_of_a_million_rotations(void **state)
{
    static const struct frame frames[] = {
        { { { { 1, 2, 3 }, 4099 } }, 1 },
        { { { { 0, 1, 0 }, 300 }, { { 1, 0, 0 }, 200 }, { { 30000, -1, 7 }, 65435 } }, 3 },
        { { { { 1, 0, 0 }, 1 }, { { -1462918, 8, 0 }, 1 } }, 2 },
        { { { { 133722534, 0, 100 }, 32768 } }, 1 }
    };
    drift_of_frames(frames, sizeof frames / sizeof frames[0], 1000000);
}

/* Each is among the worst of some way to do it worse: with sine, cosine and axis to 2^-30, rounded to
 * nearest, or drawn from the pose's bits without a count. */
static void stress_17_drift_of_many_axes(void **state)
{
    static const struct frame frames[] = {
        { { { { 0, 1, 0 }, 8192 } }, 1 },
        { { { { 0, 1, 0 }, 1 } }, 1 },
        { { { { 1, 2, 3 }, 65535 } }, 1 },
        { { { { 1, 2, 2 }, 32768 } }, 1 },
        { { { { 30000, -1, 7 }, 1 } }, 1 },
        { { { { 20000, 1, 0 }, 65535 } }, 1 },
        { { { { 5, 8905, 619720154 }, 1 } }, 1 },
        { { { { INT32_MIN, 3, INT32_MAX }, 5 } }, 1 },
        { { { { 0, 1, 0 }, 1 }, { { 1, 0, 0 }, 1 } }, 2 },
        { { { { INT32_MIN, 3, 5 }, 32768 }, { { 1, 0, 0 }, 32768 } }, 2 },
        { { { { -1, 0, 6 }, 14 }, { { 0, 4096049, -1 }, 32768 } }, 2 },
        { { { { 1, 0, 0 }, 16384 }, { { -1685873940, 1, 0 }, 16384 } }, 2 },
        { { { { 1, 2, 3 }, 1000 }, { { 3, -1, 2 }, 2000 }, { { 9, 9, 1 }, 3 } }, 3 }
    };
    drift_of_frames(frames, sizeof frames / sizeof frames[0], full_stress() ? 1000000 : 200000);
}

static int32_t search_component(struct prng *p, uint32_t kind)
{
    switch (kind) {
    case 0:
        return prng_range(p, -1, 1);
    case 1:
        return prng_range(p, -9, 9);
    case 2:
        return prng_pick(p, 2) ? prng_range(p, -3, 3) : prng_range(p, -200000, 200000);
    default:
        return (int32_t)prng_log(p);
    }
}

static zs_turn search_angle(struct prng *p)
{
    const zs_turn small = (zs_turn)prng_range(p, 1, 16);
    switch (prng_pick(p, 4)) {
    case 0:
        return small;
    case 1:
        return (zs_turn)-small;
    case 2:
        return (zs_turn)(prng_next(p) << prng_pick(p, 16));
    default:
        return (zs_turn)prng_next(p);
    }
}

static int search_case(uint64_t seed)
{
    struct prng p = { seed };
    struct frame f = { .parts = prng_pick(&p, 2) ? 1 : 1 + prng_pick(&p, 3) };
    for (uint32_t i = 0; i < f.parts; i++) {
        int32_t *const axis = f.part[i].axis;
        const uint32_t kind = prng_pick(&p, 4);
        do
            for (int k = 0; k < 3; k++)
                axis[k] = search_component(&p, kind);
        while (!axis[0] && !axis[1] && !axis[2]);
        f.part[i].angle = search_angle(&p);
    }
    struct zs_pose pose;
    zs_pose_identity(&pose);
    if (prng_pick(&p, 2))
        zs_pose_turn(&pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    return drift_within(&f, &pose, full_stress() ? 1000000 : 200000, full_stress());
}

static void stress_17_drift_searched(void **state)
{
    skew_worst = 0;
    CASES(search_case, full_stress() ? 400 : 8);
}

/* 32768 rotations in a row end in 32768 different counts (pose.c), so none brings bits back that have
 * been there: whatever is lost by a rounding is not lost again and again. */
static void poses_do_not_come_round(void **state)
{
    static uint8_t seen[32768];
    static const int32_t axis[2][3] = { { -1, 0, 6 }, { 0, 1, 0 } };
    static const zs_turn angle[2] = { 14, 32768 };
    struct zs_pose pose;
    zs_pose_identity(&pose);
    memset(seen, 0, sizeof seen);
    for (int n = 0; n < 32768; n++) {
        (void)zs_pose_rotate(&pose, axis[n & 1], angle[n & 1]);
        uint32_t count = 0;
        for (int e = 8; e >= 0; e--)
            count = e % 4 ? count << 2 | (pose.rot[e] & 3) : count << 1 | (pose.rot[e] & 1);
        assert_false(seen[count]);
        seen[count] = 1;
    }
}

/* What lies along the axes stays there, exactly, if it is turned by quarters. */
static void quarter_turns_are_exact(void **state)
{
    struct prng p = { 17 };
    struct zs_pose pose;
    zs_pose_identity(&pose);
    double want[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    for (int n = 0; n < 10000; n++) {
        int32_t axis[3] = { 0, 0, 0 };
        const uint32_t k = prng_pick(&p, 3), quarters = prng_pick(&p, 4);
        do
            axis[k] = (int32_t)prng_log(&p);
        while (!axis[k]);
        const double u[3] = { axis[0] > 0 ? 1 : -(axis[0] < 0), axis[1] > 0 ? 1 : -(axis[1] < 0),
                              axis[2] > 0 ? 1 : -(axis[2] < 0) };
        double turn[9];
        axis_turn(turn, u, quarters * 16384 * TURN);
        mul(want, turn, want);
        (void)zs_pose_rotate(&pose, axis, (zs_turn)(quarters * 16384));
        for (int e = 0; e < 9; e++) {
            want[e] = rint(want[e]);
            assert_true(q30(pose.rot[e]) == want[e]);
        }
    }
}

/* A matrix that is a rotation to 2^-20 only becomes the nearest that is one, turned; anything else becomes
 * a rotation too. */
static int repair_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_pose pose;
    double near[9], turn[9];
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    for (int e = 0; e < 9; e++)
        pose.rot[e] += prng_range(&p, -200, 200);
    nearest_rotation(near, pose.rot);
    const int32_t axis[3] = { 3, -4, 12 };
    const double u[3] = { 3 / 13.0, -4 / 13.0, 12 / 13.0 };
    const zs_turn angle = (zs_turn)prng_next(&p);
    axis_turn(turn, u, angle * TURN);
    mul(near, turn, near);
    CASE_CHECK(zs_pose_rotate(&pose, axis, angle) == ZS_OK);
    CASE_CHECK(apart(pose.rot, near) <= 0x1p-28 && not_a_rotation(pose.rot) <= 0x1p-27);

    for (int e = 0; e < 9; e++)
        pose.rot[e] = (int32_t)prng_log(&p);
    if (prng_pick(&p, 8) == 0)
        memset(pose.rot + prng_pick(&p, 3) * 3, 0, 12);
    if (prng_pick(&p, 8) == 0)
        for (int e = 0; e < 9; e++)
            pose.rot[e] = prng_pick(&p, 2) ? INT32_MIN : INT32_MAX;
    CASE_CHECK(zs_pose_rotate(&pose, axis, angle) == ZS_OK);
    (void)zs_pose_rotate(&pose, axis, angle); /* what is none after the first is put right by the second */
    CASE_CHECK(not_a_rotation(pose.rot) <= 0x1p-27);

    /* The second row is a multiple of the first, or 0. */
    for (int k = 0; k < 3; k++) {
        pose.rot[k] = prng_range(&p, -2000, 2000);
        pose.rot[3 + k] = pose.rot[k] * prng_range(&p, -1, 1) * (1 << 20);
        pose.rot[6 + k] = (int32_t)prng_log(&p);
    }
    for (int k = 1; k < 3; k++)
        pose.rot[3 + k] = pose.rot[0] ? (int32_t)((int64_t)pose.rot[3] * pose.rot[k] / pose.rot[0]) : 0;
    if (pose.rot[0] == 0)
        pose.rot[3] = 0;
    CASE_CHECK(zs_pose_rotate(&pose, axis, angle) == ZS_OK);
    CASE_CHECK(not_a_rotation(pose.rot) <= 0x1p-19);
    (void)zs_pose_rotate(&pose, axis, angle);
    CASE_CHECK(not_a_rotation(pose.rot) <= 0x1p-27);
    return 1;
}

static int wander_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_pose pose;
    zs_pose_identity(&pose);
    for (int n = 0; n < 10000; n++) {
        const int32_t axis[3] = { prng_range(&p, -9, 9), prng_range(&p, -9, 9),
                                  1 + prng_range(&p, 0, 8) };
        (void)zs_pose_rotate(&pose, axis, (zs_turn)prng_next(&p));
    }
    CASE_CHECK(not_a_rotation(pose.rot) <= 0x1p-27);
    return 1;
}

/* A rotation in units of 2^-15, as one may have it from another library, is made that rotation in 2^-30. */
static void short_matrices_keep_their_directions(void **state)
{
    static const int32_t axis[3] = { 0, 1, 0 };
    (void)state;
    for (int32_t yaw = 0; yaw < 65536; yaw += 997)
        for (int32_t pitch = 0; pitch < 65536; pitch += 4019) {
            struct zs_pose is, want;
            zs_pose_turn(&want, (zs_turn)yaw, (zs_turn)pitch, (zs_turn)(3 * yaw));
            for (int e = 0; e < 9; e++)
                is.rot[e] = (want.rot[e] + 16384) >> 15;
            assert_int_equal(zs_pose_rotate(&is, axis, 0), ZS_OK);
            assert_true(not_a_rotation(is.rot) <= 0x1p-26);
            for (int e = 0; e < 9; e++)
                assert_true(abs(is.rot[e] - want.rot[e]) < 1 << 17); /* four units of 2^-15 */
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(sine_and_cosine_of_every_angle),
    cmocka_unit_test(unit_vectors),
    cmocka_unit_test(pose_turn_is_yaw_pitch_roll),
    cmocka_unit_test(pose_rotate_by_half_a_turn),
    cmocka_unit_test(pose_rotate_by_any_angle),
    cmocka_unit_test(stress_17_drift_of_a_million_rotations),
    cmocka_unit_test(stress_17_drift_of_many_axes),
    cmocka_unit_test(stress_17_drift_searched),
    cmocka_unit_test(poses_do_not_come_round),
    cmocka_unit_test(quarter_turns_are_exact),
    cmocka_unit_test(short_matrices_keep_their_directions),
    CASES_TEST(any_matrix_becomes_a_rotation, repair_case, 20000),
    CASES_TEST(random_rotations_stay_rotations, wander_case, 20)
};

CASES_MAIN(tests)
