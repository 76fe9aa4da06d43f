/* Unit vectors and rotations, in integers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"

/* ---- Vectors --------------------------------------------------------------------------------- */

uint32_t zs_vector_size(const int32_t v[3])
{
    return zs_size32(v[0]) | zs_size32(v[1]) | zs_size32(v[2]);
}

ZS_NOINLINE uint64_t zs_vector_scaled(int64_t w[3], const int32_t v[3], int n)
{
    uint64_t square = 0;
    for (int k = 0; k < 3; k++) {
        w[k] = zs_scale2(v[k], n);
        square += (uint64_t)(w[k] * w[k]);
    }
    return square;
}

int zs_unit(zs_q2_30 out[3], const int32_t v[3])
{
    const uint32_t mag = zs_vector_size(v);
    if (mag == 0)
        return ZS_ERR_VECTOR;
    int64_t w[3]; /* largest component in [2^30, 2^31) */
    const uint64_t square = zs_vector_scaled(w, v, zs_clz32(mag) - 1);
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
    const int down = most >> 30 ? 34 - zs_clz64(most) : 0; /* to at most 2^30 */
    for (int k = 0; k < 3; k++)
        w[k] = (int32_t)zs_round_shift(v[k], down);
    return zs_unit(out, w);
}

ZS_NOINLINE int64_t zs_dot(const int32_t a[3], const int32_t b[3])
{
    return zs_mul_ss(a[0], b[0]) + zs_mul_ss(a[1], b[1]) + zs_mul_ss(a[2], b[2]);
}

ZS_NOINLINE int64_t zs_cross_at(const int32_t a[3], const int32_t b[3], int k)
{
    const int i = k == 2 ? 0 : k + 1, j = 3 - k - i;
    return zs_mul_ss(a[i], b[j]) - zs_mul_ss(a[j], b[i]);
}

void zs_cross(zs_q2_30 out[3], const zs_q2_30 a[3], const zs_q2_30 b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)zs_round_shift(zs_cross_at(a, b, k), 30);
}

ZS_SHARED int zs_within(const int32_t *v, int n, int32_t most)
{
    for (int k = 0; k < n; k++)
        if (v[k] > most || v[k] < -most)
            return 0;
    return 1;
}

int zs_rotation_ok(const zs_q2_30 m[9])
{
    const int64_t tolerance = (int64_t)1 << 40; /* 2^-20 in q60 */
    if (!zs_within(m, 9, ZS_UNIT_MOST))
        return 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            const int64_t want = i == j ? (int64_t)1 << 60 : 0;
            const int64_t off = zs_dot(m + 3 * i, m + 3 * j) - want;
            if (off > tolerance || off < -tolerance)
                return 0;
        }
    zs_q2_30 right_handed[3];
    zs_cross(right_handed, m, m + 3);
    return zs_dot(right_handed, m + 6) > 0; /* a reflection would swap front and back faces */
}

void zs_rotation_row(zs_q2_30 out[3], const zs_q2_30 a[3], const zs_q2_30 b[9])
{
    for (int k = 0; k < 3; k++) {
        const int64_t sum = zs_mul_ss(a[0], b[k]) + zs_mul_ss(a[1], b[3 + k]) +
                            zs_mul_ss(a[2], b[6 + k]); /* |.| <= 2^60 (1 + 2^-19) */
        out[k] = (int32_t)((sum + ZS_Q30_ONE / 2) >> 30);
    }
}

void zs_rotation_mul(zs_q2_30 out[9], const zs_q2_30 a[9], const zs_q2_30 b[9])
{
    for (int k = 0; k < 9; k += 3)
        zs_rotation_row(out + k, a + k, b);
}
