/* fx.c, fx.h, wide.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "core/fx.h"

#include "core/fx.c"

/* PROVE round_shift: every |v| < 2^62, every shift 0 .. 62 */
void round_shift(void)
{
    for (int n = 0; n <= 62; n++) {
        const int64_t r = zs_round_shift(any_i64(1 - ((int64_t)1 << 62), ((int64_t)1 << 62) - 1), n);
        ASSERT(n == 0 || (r >= -((int64_t)1 << (62 - n)) && r <= (int64_t)1 << (62 - n)));
    }
}

/* PROVE scale2: every shift -100 .. 62, every v with a result below 2^62 */
void scale2(void)
{
    for (int n = -100; n <= 62; n++) {
        const int64_t most = ((int64_t)1 << (62 - (n > 0 ? n : 0))) - (n <= 0);
        (void)zs_scale2(any_i64(-most, most), n);
    }
}

/* PROVE leading_zeros: every v > 0 of 32 and of 64 bits, by the table and by octave: the octave's own number */
void leading_zeros(void)
{
    for (int k = 0; k < 32; k++)
        ASSERT(zs_clz32(any_u32((uint32_t)OCTAVE_LO(k), (uint32_t)OCTAVE_HI(k))) == 31 - k);
    for (int k = 0; k < 64; k++)
        ASSERT(zs_clz64(any_u64(OCTAVE_LO(k), OCTAVE_HI(k))) == 63 - k);
}

/* PROVE reciprocal15: every a of 2^30 .. 2^31 - 1, by the table's 256 cells; the result has 16 bits */
void reciprocal15(void)
{
    for (uint32_t i = 0; i < 256; i++) {
        const uint32_t a = (1u << 30) + (i << 22);
        const uint32_t r = zs_recip15(any_u32(a, a + (1u << 22) - 1u));
        ASSERT(r >= 1u << 15 && r <= 65535u);
    }
}

/* PROVE square_root: every v of 64 bits; the shift and subtract loop */
void square_root(void)
{
    (void)zs_isqrt64(any_u64(0, UINT64_MAX));
}

/* PROVE muldiv: every a, b of 64 bits, every d > 0 for which the quotient has 64 bits (relation: taken as given) */
void muldiv(void)
{
    const uint64_t a = any_u64(0, UINT64_MAX), b = any_u64(0, UINT64_MAX), d = any_u64(1, UINT64_MAX);
    (void)zs_muldiv_u64(a, b, d);
}

/* PROVE mulshift: every |a| < 2^63, every b, every shift 0 .. 127, results below 2^63 (relation: taken as given) */
void mulshift(void)
{
    for (int n = 0; n < 128; n++) {
        const int64_t r = zs_mulshift_s64(any_i64(-INT64_MAX, INT64_MAX), any_u64(0, UINT64_MAX), n);
        ASSERT(r >= -INT64_MAX);
    }
}

/* PROVE times: every v of 64 bits, every d */
void times(void)
{
    (void)zs_times(any_u64(0, UINT64_MAX), any_i32(INT32_MIN, INT32_MAX));
    (void)zs_wrap_mul(any_u32(0, UINT32_MAX), any_i32(INT32_MIN, INT32_MAX));
    (void)zs_mulh_ss(any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX));
}

/* PROVE first_sample: every coordinate within guard and frame, |c| <= 2^23 */
void first_sample(void)
{
    const int32_t i = zs_first_sample(any_i32(-(1 << 23), 1 << 23));
    ASSERT(i >= -(1 << 15) && i <= 1 << 15);
}

/* PROVE cross_short: |a|, |c| of 32 bits, |b|, |d| <= 2^14 */
void cross_short(void)
{
    const int64_t n = zs_cross_short(any_i32(INT32_MIN, INT32_MAX), any_i32(-(1 << 14), 1 << 14),
                                     any_i32(INT32_MIN, INT32_MAX), any_i32(-(1 << 14), 1 << 14));
    ASSERT(n >= -((int64_t)1 << 46) && n <= (int64_t)1 << 46);
}

/* PROVE area_short: corners of 32 bits, any: the area fits wherever the differences fit 16 bits */
void area_short(void)
{
    const int32_t a[2] = { any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX) };
    const int32_t b[2] = { any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX) };
    const int32_t c[2] = { any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX) };
    uint32_t wide;
    int32_t at[6];
    (void)zs_area_short(at, a, b, c, &wide);
}

/* PROVE row: low words |.| <= 2^14, their constant |.| <= 2^28 + 2^15, every point of 16 bits, shifts 0 .. 15 and 0 ..
 * 14 */
void row(void)
{
    int32_t r[10];
    for (int s = 0; s <= 15; s++) {
        for (int k = 0; k < 3; k++) {
            r[k] = any_i32(-(1 << 14), 1 << 14);
            r[5 + k] = any_i32(INT32_MIN, INT32_MAX);
        }
        r[3] = any_i32(-(1 << 28), (1 << 28) + (1 << 15));
        r[4] = s;
        r[8] = any_i32(0, 14);
        r[9] = any_i32(INT32_MIN, INT32_MAX);
        (void)zs_matrix_row(r, any_i32(-32768, 32767), any_i32(-32768, 32767), any_i32(-32768, 32767));
    }
}

/* PROVE fill: 1 .. 70 values, from an even and from an odd place */
void fill(void)
{
    static uint32_t out[36];
    for (uint32_t n = 1; n <= 70; n++)
        for (int from = 0; from < 2; from++)
            zs_fill_run((uint16_t *)out + from, (uint16_t)any_u32(0, 65535), n);
}
