/* The products, sums of products, leading zeros and filling of wide.h against plain C: edge values with each other,
 * then random ones. For the host (test_fx.c) and, freestanding, for emulated boards (checks/wide.c).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_PRODUCTS_H
#define TESTS_PRODUCTS_H

#include "core/fx.h"
#include "prng.h"

static inline int wide_pair_right(uint32_t a, uint32_t b)
{
    const int32_t sa = (int32_t)a, sb = (int32_t)b;
    volatile uint64_t ua = a, ub = b; /* so that nothing is known when this is compiled */
    volatile int64_t ia = sa, ib = sb;
    return zs_mul_uu(a, b) == ua * ub && zs_mul_ss(sa, sb) == ia * ib && zs_mul_su(sa, b) == ia * (int64_t)ub &&
           zs_umulh(a, b) == (uint32_t)(ua * ub >> 32) && zs_mulh_ss(sa, sb) == (int32_t)(ia * ib >> 32);
}

/* The edge values once more as differences: |b|, |d| <= 2^14. */
static inline int wide_cross_right(uint32_t a, uint32_t b)
{
    const int32_t short_b = (int32_t)(b % 32769u) - 16384, short_d = (int32_t)(a % 32769u) - 16384;
    volatile int64_t ia = (int32_t)a, ib = (int32_t)b, ib_short = short_b, id_short = short_d;
    return zs_cross_short((int32_t)a, short_b, (int32_t)b, short_d) == ia * ib_short - ib * id_short &&
           zs_cross_short((int32_t)a, 16384, (int32_t)b, -16384) == ia * 16384 + ib * 16384 &&
           zs_cross_short((int32_t)a, -16384, (int32_t)b, 16384) == (ia + ib) * -16384;
}

/* A plane's change over sub-pixels, to its ends. */
static inline int wide_step_right(uint32_t a, uint32_t b)
{
    volatile int32_t g[2] = { (int32_t)a, (int32_t)b }, at[2] = { (int32_t)(b ^ a) >> 9, (int32_t)(b + a * 3u) >> 9 };
    const int64_t sum = (int64_t)g[0] * at[0] + (int64_t)g[1] * at[1], ends = ((int64_t)g[0] - g[1]) * (1 << 22);
    return zs_plane_step(g[0], at[0], g[1], at[1]) == (uint32_t)((sum + 128) >> 8) &&
           zs_plane_step(g[0], 1 << 22, g[1], -(1 << 22)) == (uint32_t)((ends + 128) >> 8);
}

/* A row of an affine map as its comment has it, its words taken from the bits of a and b within their bounds. */
#if ZS_ROW_WIDE
static inline int wide_row_right(uint32_t a, uint32_t b)
{
    const int32_t shift = (int32_t)(a % 30u);
    const int32_t x = (int16_t)a, y = (int16_t)b, z = (int16_t)(a >> 16);
    const int64_t t = (int64_t)((uint64_t)a << 32 | b) >> 4; /* 60 bits: the result is modulo 2^32 */
    volatile int32_t row[10] = { (int32_t)(b % 2147483647u) - (1 << 30),
                                 1 << 30,
                                 (int32_t)(a % 2147483647u) - (1 << 30),
                                 (int32_t)(uint32_t)t,
                                 (int32_t)(t >> 32),
                                 shift,
                                 32 - shift };
    const int64_t sum = (int64_t)row[0] * x + (int64_t)row[1] * y + (int64_t)row[2] * z + t;
    return zs_matrix_row((const int32_t *)row, x, y, z) == (int32_t)(uint32_t)(sum >> shift);
}
#else
static inline int wide_row_right(uint32_t a, uint32_t b)
{
    const int32_t s = (int32_t)(a % 16u), s2 = s == 15 ? (int32_t)(b % 15u) : 0;
    const int32_t x = (int16_t)a, y = (int16_t)b, z = (int16_t)(a >> 16);
    volatile int32_t row[10] = { (int32_t)(b % 32769u) - 16384, -16384, (int32_t)(a % 32769u) - 16384,
                                 (int32_t)(a % 536870913u) - (1 << 28), s, (int32_t)(b % 37837u) - 18918, 18918,
                                 (int32_t)(a % 37837u) - 18918, s2, (int32_t)b };
    const int64_t low = (int64_t)row[0] * x + (int64_t)row[1] * y + (int64_t)row[2] * z + row[3];
    const int64_t high = (low >> s) + (int64_t)row[5] * x + (int64_t)row[6] * y + (int64_t)row[7] * z;
    return zs_matrix_row((const int32_t *)row, x, y, z) ==
           (int32_t)((uint32_t)((int32_t)high >> s2) + (uint32_t)row[9]);
}
#endif

/* Two points by three rows, which are the six rows that they are one by one. */
static inline int wide_rows_right(uint32_t a, uint32_t b)
{
    int32_t row[3 * ZS_ROW_WORDS], out[7];
    const int16_t p[6] = {
        (int16_t)a, (int16_t)b, (int16_t)(a >> 16), (int16_t)(b >> 16), (int16_t)~a, (int16_t)(a ^ b)
    };
    int right = 1;
    for (int k = 0; k < 3 * ZS_ROW_WORDS; k++)
        row[k] = (int32_t)((a * (uint32_t)(2 * k + 1)) ^ b) >> 18;
    for (int k = 0; k < 3; k++) {
        int32_t *const r = row + k * ZS_ROW_WORDS;
#if ZS_ROW_WIDE
        r[5] = (int32_t)(b % 30u);
        r[6] = 32 - r[5];
#else
        r[4] = (int32_t)(b % 16u);
        r[8] = (int32_t)(a % 15u);
#endif
    }
    out[6] = (int32_t)a;
    zs_matrix_rows(row, p, out, 2);
    for (int k = 0; k < 6; k++)
        right &= out[k] ==
                 zs_matrix_row(row + k % 3 * ZS_ROW_WORDS, p[k / 3 * 3], p[k / 3 * 3 + 1], p[k / 3 * 3 + 2]);
    return right && out[6] == (int32_t)a;
}

static inline int wide_two_right(uint32_t a, uint32_t b)
{
    const volatile uint32_t from[4] = { b, a, b ^ a, ~a };
    uint32_t x, y, z, w;
    zs_two((const uint32_t *)from, 0, &x, &y);
    zs_two((const uint32_t *)from, 2, &z, &w);
    return x == b && y == a && z == (b ^ a) && w == ~a && zs_high(a) == a / 65536u;
}

/* Corners near each other and far apart. */
static inline int wide_area_right(uint32_t a, uint32_t b)
{
    const uint32_t x = a * 2654435761u, y = b * 2246822519u;
    volatile int32_t corner[3][2] = { { (int32_t)x, (int32_t)y }, { (int32_t)(x + a), (int32_t)(y + b) },
                                      { (int32_t)(x - b), (int32_t)(y + (a >> 3)) } };
    int64_t d[4];
    int fits = 1;
    for (int k = 0; k < 4; k++) {
        d[k] = (int32_t)((uint32_t)corner[1 + k / 2][k % 2] - (uint32_t)corner[0][k % 2]);
        fits &= d[k] >= -32768 && d[k] <= 32767;
    }
    uint32_t wide;
    int32_t at[6];
    const int32_t area = zs_area_short(at, (const int32_t *)corner[0], (const int32_t *)corner[1],
                                       (const int32_t *)corner[2], &wide);
    return (wide == 0) == fits && (wide || area == d[0] * d[3] - d[2] * d[1]);
}

static inline int wide_clz_right(uint32_t v)
{
    int n = 0;
    for (uint32_t bit = 1u << 31; !(v & bit); bit >>= 1)
        n++;
    return zs_clz32(v) == n && zs_clz64(v) == 32 + n && zs_clz64((uint64_t)v << 32 | (v >> 7)) == n;
}

/* n values are filled, and none beside them. */
static inline int wide_fill_right(uint32_t n)
{
    static uint32_t words[160];
    uint16_t *const at = (uint16_t *)(void *)words;
    for (uint32_t k = 0; k < 320; k++)
        at[k] = (uint16_t)k;
    if (n)
        zs_fill_run(at + 4, 0xabcd, n);
    for (uint32_t k = 0; k < 320; k++)
        if (at[k] != (k >= 4 && k < 4 + n ? 0xabcdu : k))
            return 0;
    return 1;
}

/* Runs of the high halves of a sum, and nothing beside them. */
static inline int wide_halves_right(uint32_t sum, uint32_t step)
{
    static uint32_t words[24];
    uint16_t *const at = (uint16_t *)(void *)words;
    for (uint32_t n = 0; n <= 40; n += 8) {
        for (uint32_t k = 0; k < 48; k++)
            at[k] = (uint16_t)k;
        zs_high_halves(at + 4, n, sum, step);
        for (uint32_t k = 0; k < 48; k++)
            if (at[k] != (k >= 4 && k < 4 + n ? (sum + (k - 4) * step) >> 16 : k))
                return 0;
    }
    return 1;
}

/* 1 where all are right, else 0 and the pair in wrong[]. */
static inline int wide_right(uint32_t random_pairs, uint32_t wrong[2])
{
    struct prng p = { 7 };
    uint32_t edge[33 * 4], n = 0;
    for (int k = 0; k < 33; k++) { /* about each power of two, and its negative */
        const uint32_t power = (uint32_t)((uint64_t)1 << k);
        edge[n++] = power;
        edge[n++] = power - 1u;
        edge[n++] = 0u - power - 1u;
        edge[n++] = power + 0x8001u;
    }
    for (wrong[0] = 0; wrong[0] < 300; wrong[0]++)
        if (!wide_fill_right(wrong[0]))
            return 0;
    for (uint32_t k = 0; k < n * n + random_pairs; k++) {
        const uint32_t a = k < n * n ? edge[k / n] : (uint32_t)prng_log(&p),
                       b = k < n * n ? edge[k % n] : (uint32_t)prng_log(&p);
        wrong[0] = a;
        wrong[1] = b;
        if (!wide_pair_right(a, b) || !wide_cross_right(a, b) || !wide_row_right(a, b) ||
            !wide_two_right(a, b) || !wide_area_right(a, b) || !wide_rows_right(a, b) || !wide_step_right(a, b) ||
            (k % 16u == 0 && !wide_halves_right(a, b)) || (a && !wide_clz_right(a)))
            return 0;
    }
    return 1;
}

#endif
