/* Angles, unit vectors, rotations and poses, from integers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "rotation.h"

#include "fx.h"

#define QUARTER 16384u
#define EIGHTH 8192u
#define TWO_PI_Q28 1686629713 /* 2 pi * 2^28, nearest */

static int32_t q30_mul(int32_t a, int32_t b)
{
    return (int32_t)zs_round_shift((int64_t)a * b, 30); /* |a|, |b| <= 2^31: < 2^62 */
}

/* ---- Sine: Taylor on an eighth of a turn ------------------------------------------------------
 *
 * With x <= pi/4 the first term left out is x^11/11! < 2^-29 for sin and x^10/10! = 2.5e-8 * ... for
 * cos x^12/12! < 2^-32; each of the five products adds half an ulp of 2^-30. Sum < 2^-28. */

/* x in q2_30 radians of an angle <= EIGHTH. */
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
    const int odd = (a & QUARTER) != 0; /* second and fourth quarter: cosine of the part */
    const int32_t s = odd ? (part <= EIGHTH ? cos_eighth(radians(part))
                                            : sin_eighth(radians(QUARTER - part)))
                          : (part <= EIGHTH ? sin_eighth(radians(part))
                                            : cos_eighth(radians(QUARTER - part)));
    return a & 32768u ? -s : s;
}

zs_q2_30 zs_cos(zs_turn a)
{
    return zs_sin((zs_turn)(a + QUARTER));
}

/* ---- Vectors ------------------------------------------------------------------------------------- */

int zs_unit(zs_q2_30 out[3], const int32_t v[3])
{
    uint32_t mag = 0;
    for (int k = 0; k < 3; k++)
        mag |= v[k] < 0 ? 0u - (uint32_t)v[k] : (uint32_t)v[k];
    if (mag == 0)
        return ZS_ERR_VECTOR;
    const int lz = zs_clz32(mag);
    int64_t w[3]; /* largest component in [2^30, 2^31) */
    uint64_t square = 0;
    for (int k = 0; k < 3; k++) {
        w[k] = zs_scale2(v[k], lz - 1);
        square += (uint64_t)(w[k] * w[k]); /* <= 3 * 2^62 */
    }
    const int64_t length = zs_isqrt64(square); /* [2^30, 2^31.8), floor: relative error < 2^-30 */
    for (int k = 0; k < 3; k++) {
        const int64_t n = w[k] * ((int64_t)1 << 31) / length; /* q1_31, truncated; < 2^62 / 2^30 */
        out[k] = (int32_t)zs_round_shift(n, 1);
    }
    return ZS_OK;
}

int zs_unit64(zs_q2_30 out[3], const int64_t v[3])
{
    uint64_t most = 0;
    int32_t w[3];
    for (int k = 0; k < 3; k++)
        most |= (uint64_t)(v[k] < 0 ? -v[k] : v[k]);
    const int down = most >> 30 ? 34 - zs_clz64(most) : 0; /* below 2^30 */
    for (int k = 0; k < 3; k++)
        w[k] = (int32_t)zs_round_shift(v[k], down);
    return zs_unit(out, w);
}

void zs_cross(zs_q2_30 out[3], const zs_q2_30 a[3], const zs_q2_30 b[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = (int32_t)zs_round_shift((int64_t)a[i] * b[j] - (int64_t)a[j] * b[i], 30);
    }
}

static int64_t dot_q60(const zs_q2_30 *a, const zs_q2_30 *b)
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

int zs_rotation_ok(const zs_q2_30 m[9])
{
    const int64_t tolerance = (int64_t)1 << 40; /* 2^-20 in q60 */
    const int32_t limit = ZS_Q30_ONE + (1 << 10);
    for (int k = 0; k < 9; k++)
        if (m[k] > limit || m[k] < -limit)
            return 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            const int64_t want = i == j ? (int64_t)1 << 60 : 0;
            const int64_t off = dot_q60(m + 3 * i, m + 3 * j) - want;
            if (off > tolerance || off < -tolerance)
                return 0;
        }
    zs_q2_30 right_handed[3];
    zs_cross(right_handed, m, m + 3);
    return dot_q60(right_handed, m + 6) > 0; /* a mirror would turn faces inside out */
}

void zs_rotation_mul(zs_q2_30 out[9], const zs_q2_30 a[9], const zs_q2_30 b[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int64_t sum = (int64_t)a[3 * i] * b[j] + (int64_t)a[3 * i + 1] * b[3 + j] +
                                (int64_t)a[3 * i + 2] * b[6 + j]; /* |.| <= 2^60 (1 + 2^-19) */
            out[3 * i + j] = (int32_t)zs_round_shift(sum, 30);
        }
}

/* ---- Poses --------------------------------------------------------------------------------------- */

void zs_pose_identity(struct zs_pose *pose)
{
    const struct zs_pose identity = {
        { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE }, { 0, 0, 0 }, ZS_Q16_ONE
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

/* Gram-Schmidt: the first row keeps its direction, the third is their product. */
static void orthonormalise(zs_q2_30 m[9])
{
    (void)zs_unit(m, m);
    const int64_t along = zs_round_shift(dot_q60(m, m + 3), 30);
    int32_t second[3];
    for (int k = 0; k < 3; k++)
        second[k] = m[3 + k] - (int32_t)zs_round_shift(along * m[k], 30);
    (void)zs_unit(m + 3, second);
    zs_cross(m + 6, m, m + 3);
}

int zs_pose_rotate(struct zs_pose *pose, const int32_t axis[3], zs_turn angle)
{
    zs_q2_30 u[3];
    const int err = zs_unit(u, axis);
    if (err)
        return err;
    const int32_t s = zs_sin(angle), c = zs_cos(angle);
    const int64_t v = (int64_t)ZS_Q30_ONE - c; /* <= 2^31 */
    zs_q2_30 turn[9], result[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int64_t uu = zs_round_shift((int64_t)u[i] * u[j], 30);
            turn[3 * i + j] = (int32_t)(zs_round_shift(uu * v, 30) + (i == j ? c : 0)); /* sum <= 1 */
        }
    for (int k = 0; k < 3; k++) { /* the antisymmetric part */
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const int32_t su = q30_mul(s, u[k]);
        turn[3 * j + i] += su;
        turn[3 * i + j] -= su;
    }
    zs_rotation_mul(result, turn, pose->rot);
    orthonormalise(result);
    for (int k = 0; k < 9; k++)
        pose->rot[k] = result[k];
    return ZS_OK;
}
