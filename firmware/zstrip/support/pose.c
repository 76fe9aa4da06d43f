/* Sine and cosine, poses, and rotations that are composed a million times, in integers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"

#define QUARTER 16384u
#define EIGHTH 8192u
#define TWO_PI_Q28 1686629713 /* 2 pi * 2^28, nearest */

static int32_t q30_mul(int32_t a, int32_t b)
{
    return (int32_t)zs_round_shift((int64_t)a * b, 30); /* |a|, |b| <= 2^31: < 2^62 */
}

/* ---- Sine: Taylor series on an eighth of a turn -----------------------------------------------
 *
 * With x <= pi/4, the first omitted term is x^11/11! < 2^-29 for sin and x^12/12! < 2^-32 for cos.
 * Each of the five products adds half an ulp of 2^-30. Sum < 2^-28. */

/* Convert an angle <= EIGHTH to radians, q2_30. */
static int32_t radians(uint32_t a)
{
    return (int32_t)(((int64_t)a * TWO_PI_Q28 + (1 << 13)) >> 14); /* a 2 pi / 2^16 * 2^30 */
}

static int32_t sin_eighth(int32_t x)
{
    const int32_t xx = q30_mul(x, x); /* <= 0.617 */
    int32_t s = ZS_Q30_ONE - xx / 72;
    s = ZS_Q30_ONE - q30_mul(xx, s) / 42;
    s = ZS_Q30_ONE - q30_mul(xx, s) / 20;
    s = ZS_Q30_ONE - q30_mul(xx, s) / 6;
    return q30_mul(x, s);
}

static int32_t cos_eighth(int32_t x)
{
    const int32_t xx = q30_mul(x, x);
    int32_t c = ZS_Q30_ONE - xx / 90;
    c = ZS_Q30_ONE - q30_mul(xx, c) / 56;
    c = ZS_Q30_ONE - q30_mul(xx, c) / 30;
    c = ZS_Q30_ONE - q30_mul(xx, c) / 12;
    return ZS_Q30_ONE - q30_mul(xx, c) / 2;
}

zs_q2_30 zs_sin(zs_turn a)
{
    const uint32_t part = a & (QUARTER - 1u);
    const int odd = (a & QUARTER) != 0; /* second or fourth quarter: the cosine of the part */
    const int32_t s =
        odd ? (part <= EIGHTH ? cos_eighth(radians(part)) : sin_eighth(radians(QUARTER - part)))
            : (part <= EIGHTH ? sin_eighth(radians(part)) : cos_eighth(radians(QUARTER - part)));
    return a & 32768u ? -s : s;
}

zs_q2_30 zs_cos(zs_turn a)
{
    return zs_sin((zs_turn)(a + QUARTER));
}

/* ---- Poses ----------------------------------------------------------------------------------- */

void zs_pose_identity(struct zs_pose *pose)
{
    const struct zs_pose identity = {
        .rot = { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE }, .scale = ZS_Q16_ONE
    };
    *pose = identity;
}

void zs_pose_turn(struct zs_pose *pose, zs_turn yaw, zs_turn pitch, zs_turn roll)
{
    const int32_t sy = zs_sin(yaw), cy = zs_cos(yaw), sp = zs_sin(pitch), cp = zs_cos(pitch);
    const int32_t sr = zs_sin(roll), cr = zs_cos(roll);
    const zs_q2_30 ry[9] = { cy, 0, sy, 0, ZS_Q30_ONE, 0, -sy, 0, cy };
    const zs_q2_30 rx[9] = { ZS_Q30_ONE, 0, 0, 0, cp, -sp, 0, sp, cp };
    const zs_q2_30 rz[9] = { cr, -sr, 0, sr, cr, 0, 0, 0, ZS_Q30_ONE };
    zs_q2_30 yx[9];
    zs_rotation_mul(yx, ry, rx);
    zs_rotation_mul(pose->rot, yx, rz);
}

/* ---- Composed rotations ----------------------------------------------------------------------
 *
 * An error that is the same in every step grows with the number of steps; a random error grows with
 * its square root. So the rotation of a step is computed to 2^-52, and only the product is rounded
 * to q2_30, at random: 2^-29.6 rad for one step, 2^-19.6 after a million (root mean square).
 *
 * Rounding has to be random: with rounding to nearest, a point near the axis, which moves by a few
 * ulps in each step, gets the same error for thousands of steps (axis -3 0 101919, turns of 1:
 * 2^-15.4 rad after a million). The low bits of the matrix hold a counter: rotations that almost
 * cancel (a half turn and a small turn, again and again) bring the pose back to the same bits.
 * Random numbers that depend on these bits alone would then repeat for ever, and the small
 * remainder would be lost every time. */

typedef int64_t q4_60;
#define ONE_Q60 ((q4_60)1 << 60)
#define TWO_PI_Q47 INT64_C(884279719003555) /* 2 pi * 2^47, nearest, within 2^-54 of it */

static int32_t upper(q4_60 v) /* q2_30, floor. |v| < 2 */
{
    return (int32_t)(v >> 30);
}

static int32_t lower(q4_60 v) /* the 30 bits below those of upper() */
{
    return (int32_t)(v & (ZS_Q30_ONE - 1));
}

/* Return a * b, too small by less than 2^-59. |a|, |b| < 2. Not inlined: that saves 500 bytes of
 * flash. */
static ZS_NOINLINE q4_60 q60_mul(q4_60 a, q4_60 b)
{
    const int64_t mid = (int64_t)upper(a) * lower(b) + (int64_t)lower(a) * upper(b); /* < 2^62 */
    return (int64_t)upper(a) * upper(b) + (mid >> 30);
}

/* Return 1 - xx / n (n - 1) * (1 - xx / (n - 2) (n - 3) * (1 - ...)): for even n the cosine, for
 * odd n the sine / x. */
static q4_60 series(q4_60 xx, int n)
{
    q4_60 sum = ONE_Q60;
    for (; n > 1; n -= 2)
        sum = ONE_Q60 - q60_mul(xx, sum) / (n * (n - 1));
    return sum;
}

/* Compute sine and cosine within 2^-53. With |x| <= pi/4, the first omitted terms are x^17/17! <
 * 2^-54 and x^18/18! < 2^-58; the error of x is below 2^-54. */
static void fine_sin_cos(q4_60 *sine, q4_60 *cosine, zs_turn a)
{
    const int quarters = (int)((a + EIGHTH) / QUARTER);
    const int64_t x_q63 = (a - quarters * (int)QUARTER) * TWO_PI_Q47; /* a 2 pi / 2^16 * 2^63 */
    const q4_60 x = x_q63 >> 3, xx = q60_mul(x, x);
    const q4_60 s = q60_mul(x, series(xx, 15)), c = series(xx, 16);
    const q4_60 odd_s = quarters & 1 ? c : s, odd_c = quarters & 1 ? -s : c;
    *sine = quarters & 2 ? -odd_s : odd_s;
    *cosine = quarters & 2 ? -odd_c : odd_c;
}

/* Scale v to length 1, within 2^-54. Return ZS_OK; ZS_ERR_VECTOR: v is 0 0 0, out is untouched. */
static int fine_unit(q4_60 out[3], const int32_t v[3])
{
    const uint32_t mag = zs_vector_size(v);
    if (mag == 0)
        return ZS_ERR_VECTOR;
    int64_t w[3]; /* exact, largest component in [2^30, 2^31] */
    const uint64_t square = zs_vector_scaled(w, v, mag >> 31 ? 0 : zs_clz32(mag) - 1);
    /* guess: 2^30 / length (1 + e), |e| < 2^-28, in q60. One Newton step reduces e to 1.5 e^2. */
    const q4_60 guess = (q4_60)((uint64_t)ONE_Q60 / zs_isqrt64(square)) << 30;
    const q4_60 sixteenth = q60_mul((q4_60)(square >> 4),
                                    q60_mul(guess, guess)); /* (1 + e)^2 / 16 */
    const q4_60 inverse = guess + 8 * q60_mul(guess, (ONE_Q60 >> 4) - sixteenth);
    for (int k = 0; k < 3; k++)
        out[k] = w[k] * upper(inverse) + (w[k] * lower(inverse) >> 30);
    return ZS_OK;
}

/* Compute the rotation about u (Rodrigues): u u^T + cos (1 - u u^T) + sin [u], within 2^-52 for
 * each element. */
static void fine_turn(q4_60 turn[9], const q4_60 u[3], zs_turn angle)
{
    q4_60 s, c;
    fine_sin_cos(&s, &c, angle);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const q4_60 square = q60_mul(u[k], u[k]), both = q60_mul(u[i], u[j]);
        const q4_60 even = both - q60_mul(c, both), odd = q60_mul(s, u[k]);
        turn[4 * k] = square + q60_mul(c, ONE_Q60 - square);
        turn[3 * j + i] = even + odd;
        turn[3 * i + j] = even - odd;
    }
}

/* Make a matrix a rotation (Gram-Schmidt). The first row keeps its direction; the third becomes the
 * cross product of the other two. */
static void orthonormalise(zs_q2_30 m[9])
{
    (void)zs_unit(m, m);
    (void)zs_unit(m + 3, m + 3); /* so that a short one is not rounded to whole steps below */
    const int64_t along = zs_round_shift(zs_dot(m, m + 3), 30); /* < 2^31.8 */
    int64_t second[3];
    for (int k = 0; k < 3; k++)
        second[k] = m[3 + k] - zs_round_shift(along * m[k], 30);
    (void)zs_unit64(m + 3, second);
    zs_cross(m + 6, m, m + 3);
}

/* turn = turn (1 - (m m^T - 1) / 2). Then turn * m is orthonormal up to the square of m's own
 * error; m is orthonormal to 2^-20. The factor is symmetric, so it adds no rotation. */
static void correct(q4_60 turn[9], const zs_q2_30 m[9])
{
    int32_t off[9]; /* m m^T - 1, q40 */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            const int64_t dot = zs_dot(m + 3 * i, m + 3 * j) - (i == j ? ONE_Q60 : 0);
            off[3 * i + j] = off[3 * j + i] = (int32_t)(dot >> 20);
        }
    for (int i = 0; i < 3; i++) {
        q4_60 *const row = turn + 3 * i;
        const int32_t was[3] = { upper(row[0]), upper(row[1]), upper(row[2]) };
        for (int j = 0; j < 3; j++)
            row[j] -= zs_dot(was, off + 3 * j) >> 11;
    }
}

/* out = turn * m, within 2^-59. */
static void product(q4_60 out[9], const q4_60 turn[9], const zs_q2_30 m[9])
{
    for (int e = 0; e < 9; e++) {
        const q4_60 *const row = turn + e / 3 * 3;
        int64_t high = 0, low = 0; /* q60 and q90, < 2^63 */
        for (int k = 0; k < 3; k++) {
            const int32_t v = m[3 * k + e % 3];
            high += (int64_t)upper(row[k]) * v;
            low += (int64_t)lower(row[k]) * v;
        }
        out[e] = high + (low >> 30);
    }
}

/* Return 1 if all elements are 0, 1 or -1, to 2^-47. */
static int along_axes(const q4_60 m[9])
{
    for (int e = 0; e < 9; e++)
        if ((m[e] + (1 << 13)) & (ONE_Q60 - (1 << 14)))
            return 0;
    return 1;
}

/* Return the successor of a 15-bit counter. The sequence takes all 32768 values before it repeats,
 * in an order that looks random. */
static uint32_t count_next(uint32_t n)
{
    n = (n * 17483u + 10672u) & 0x7fffu;
    n = ((n ^ n >> 7) * 3729u) & 0x7fffu;
    return n ^ n >> 8;
}

/* The number of counter bits in the low bits of element e. Element 0 holds the counter's lowest. */
static int count_bits(int e)
{
    return e % 4 ? 2 : 1;
}

/* Round `exact` to m. Each element is rounded to the nearest value whose low bits are its part of
 * the next counter value; that moves it by up to 2 ulps, on the diagonal by up to 1. Before that, a
 * random number within 1/2 ulp is added, so that fractions of an ulp are not lost on average. It is
 * computed from all bits of m, so the same m and turn give the same bits on every machine. */
static void round_at_random(zs_q2_30 m[9], const q4_60 exact[9])
{
    uint32_t count = 0, draw = 0;
    for (int e = 8; e >= 0; e--) {
        const int bits = count_bits(e);
        count = count << bits | ((uint32_t)m[e] & ((1u << bits) - 1u));
        draw = (draw ^ (uint32_t)m[e]) * 2654435761u;
    }
    count = count_next(count);
    for (int e = 0; e < 9; e++) {
        const int bits = count_bits(e), one = 1 << bits, part = (int)count & (one - 1);
        count >>= bits;
        draw = (draw ^ draw >> 15) * 1664525u + 1013904223u;
        const int32_t fraction = (int32_t)(draw >> 2) - ZS_Q30_ONE / 2; /* -1/2 .. 1/2 ulp */
        const int64_t up = exact[e] + fraction + (int64_t)(one / 2 - part) * ZS_Q30_ONE;
        m[e] = (int32_t)(up >> (30 + bits)) * one + part;
    }
}

int zs_pose_rotate(struct zs_pose *pose, const int32_t axis[3], zs_turn angle)
{
    q4_60 u[3], turn[9], exact[9];
    const int err = fine_unit(u, axis);
    if (err)
        return err;
    fine_turn(turn, u, angle);
    if (zs_rotation_ok(pose->rot)) {
        correct(turn, pose->rot);
    } else {
        orthonormalise(pose->rot);
        if (!zs_rotation_ok(pose->rot)) /* its first two rows were parallel, or 0 */
            for (int e = 0; e < 9; e++)
                pose->rot[e] = e % 4 ? 0 : ZS_Q30_ONE;
    }
    product(exact, turn, pose->rot);
    if (along_axes(exact)) /* quarter turns of an axis-aligned object: keep them exact */
        for (int e = 0; e < 9; e++)
            pose->rot[e] = (int32_t)zs_round_shift(exact[e], 30);
    else
        round_at_random(pose->rot, exact);
    return ZS_OK;
}
