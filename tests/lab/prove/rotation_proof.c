/* rotation.c and support/pose.c: unit vectors, products, turns. Sines of every angle, and what intervals do not see,
 * are facts.c's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "core/fx.h"

/* floor of the square root: of 2^60 .. 2^64 - 1 in 2^30 .. 2^32 - 1 (tests/unit/test_fx.c) */
/*@ requires v >= 0x1000000000000000;
    assigns \result \from v;
    ensures bound: \result >= 0x40000000; */
uint32_t zs_isqrt64(uint64_t v);
/* Of absolute values, one of them in an octave and none beyond it, the or is in that octave. */
static uint32_t or_least, or_most;
/*@ assigns \result \from v[0..2], or_least, or_most;
    ensures bound: or_least <= \result <= or_most; */
uint32_t zs_vector_size(const int32_t v[3]);
#include "core/rotation.c"
#include "support/pose.c"

#define NEARLY_ONE (ZS_Q30_ONE + (1 << 10)) /* an element of what zs_rotation_ok lets pass */

static void any_matrix(int32_t m[9], int32_t most)
{
    for (int e = 0; e < 9; e++)
        m[e] = any_i32(-most, most);
}

/* Octave k of |v| in one component, the others no larger; each below 0 or not, as a bit of n says. k of 31 is -2^31. */
static int any_vector(int32_t v[3], int k, int n)
{
    const int64_t lo = (int64_t)OCTAVE_LO(k), hi = k == 31 ? lo : (int64_t)OCTAVE_HI(k);
    const int64_t below = hi > INT32_MAX ? INT32_MAX : hi;
    const int at = n >> 3, negative = n >> at & 1;
    if (k == 31 && !negative)
        return 0;
    for (int j = 0; j < 3; j++)
        v[j] = n >> j & 1 ? any_i32((int32_t)-hi, -1) : any_i32(0, (int32_t)below);
    v[at] = negative ? any_i32((int32_t)-hi, (int32_t)-lo) : any_i32((int32_t)lo, (int32_t)hi);
    or_least = (uint32_t)lo;
    or_most = k == 31 ? UINT32_MAX : (uint32_t)hi;
    return 1;
}

/* PROVE units -eva-use-spec=zs_recip,zs_isqrt64,zs_vector_size: every vector of 32 bits but 0, by octave and place of a
 * largest component, by signs: zs_unit, and the axis of zs_pose_rotate */
void units(void)
{
    for (int k = 0; k <= 31; k++)
        for (int n = 0; n < 24; n++) {
            int32_t v[3], out[3];
            int64_t fine[3];
            if (!any_vector(v, k, n))
                continue;
            (void)zs_unit(out, v);
            (void)fine_unit(fine, v);
        }
}

/* PROVE units_of_64_bits -eva-use-spec=zs_recip,zs_unit: |v| < 2^63 - 2^32: zs_unit64 up to its zs_unit */
void units_of_64_bits(void)
{
    const int64_t most = INT64_MAX - ((int64_t)1 << 32);
    for (int k = 0; k <= 62; k++) {
        const int64_t hi = k == 62 ? most : (int64_t)OCTAVE_HI(k);
        const int64_t v[3] = { any_i64((int64_t)OCTAVE_LO(k), hi), any_i64(-hi, hi), any_i64(-hi, hi) };
        const int64_t w[3] = { any_i64(-hi, hi), any_i64(-hi, (int64_t)-OCTAVE_LO(k)), any_i64(-hi, hi) };
        int32_t out[3];
        (void)zs_unit64(out, v);
        (void)zs_unit64(out, w);
    }
}

/* PROVE products -eva-split-return=auto: matrices of elements up to 2^30 + 2^10: zs_rotation_mul, zs_cross;
 * zs_rotation_ok of any 32 bits */
void products(void)
{
    int32_t a[9], b[9], out[9];
    any_matrix(a, NEARLY_ONE);
    any_matrix(b, NEARLY_ONE);
    zs_rotation_mul(out, a, b);
    zs_cross(out, a, b);
    for (int e = 0; e < 9; e++)
        a[e] = any_i32(INT32_MIN, INT32_MAX);
    if (zs_rotation_ok(a))
        for (int e = 0; e < 9; e++)
            ASSERT(a[e] >= -NEARLY_ONE && a[e] <= NEARLY_ONE);
}

/* PROVE turns: every angle by eighth of a turn, about every axis with components up to 1 + 2^-40: fine_turn; of
 * elements up to 2 each and a rotation's: product; round_at_random of what is up to 1 + 2^-15 */
void turns(void)
{
    const int64_t most = ONE_Q60 + (1 << 20);
    const q4_60 u[3] = { any_i64(-most, most), any_i64(-most, most), any_i64(-most, most) };
    q4_60 turn[9], exact[9];
    int32_t m[9];
    for (uint32_t a = 0; a < 65536u; a += EIGHTH)
        fine_turn(turn, u, (zs_turn)any_u32(a, a + EIGHTH - 1u));
    for (int e = 0; e < 9; e++)
        turn[e] = any_i64(-2 * ONE_Q60 + 1, 2 * ONE_Q60 - 1);
    any_matrix(m, NEARLY_ONE);
    product(exact, turn, m);
    (void)along_axes(exact);
    for (int e = 0; e < 9; e++) {
        exact[e] = any_i64(-ONE_Q60 - (ONE_Q60 >> 15), ONE_Q60 + (ONE_Q60 >> 15));
        m[e] = any_i32(INT32_MIN, INT32_MAX);
    }
    round_at_random(m, exact);
}

/* PROVE sines: every angle by eighth of a turn: zs_sin, zs_cos: at most 1 + 2^-28 */
void sines(void)
{
    for (uint32_t a = 0; a < 65536u; a += EIGHTH) {
        const int32_t s = zs_sin((zs_turn)any_u32(a, a + EIGHTH - 1u)),
                      c = zs_cos((zs_turn)any_u32(a, a + EIGHTH - 1u));
        ASSERT(s >= -ZS_Q30_ONE - 4 && s <= ZS_Q30_ONE + 4 && c >= -ZS_Q30_ONE - 4 && c <= ZS_Q30_ONE + 4);
    }
}
