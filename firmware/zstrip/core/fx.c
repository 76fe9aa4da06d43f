/* Shifts, filling, reciprocal, square root and wide products.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"

/* ---- Leading zeros --------------------------------------------------------------------------- */

#define CLZ_2(n) (n), (n)
#define CLZ_8(n) CLZ_2(n), CLZ_2(n), CLZ_2(n), CLZ_2(n)
#define CLZ_32(n) CLZ_8(n), CLZ_8(n), CLZ_8(n), CLZ_8(n)
#define CLZ_64(n) CLZ_32(n), CLZ_32(n)

const uint8_t zs_clz8[256] = { 8,        7,        CLZ_2(6),  CLZ_2(5),  CLZ_2(5),  CLZ_8(4),
                               CLZ_8(3), CLZ_8(3), CLZ_32(2), CLZ_64(1), CLZ_64(0), CLZ_64(0) };

#if ZS_FOR_SIZE

int zs_clz64(uint64_t v)
{
    return v >> 32 ? zs_clz32((uint32_t)(v >> 32)) : 32 + zs_clz32((uint32_t)v);
}

#endif

/* ---- Shifts ---------------------------------------------------------------------------------- */

ZS_SHARED ZS_RARE int64_t zs_round_shift(int64_t v, int n)
{
    return n ? ((v >> (n - 1)) + 1) >> 1 : v;
}

ZS_RARE int64_t zs_scale2(int64_t v, int n)
{
    if (n >= 0)
        return (int64_t)((uint64_t)v << n);
    return n < -62 ? 0 : zs_round_shift(v, -n);
}

ZS_RARE int64_t zs_held64(int64_t v, int64_t most)
{
    return v > most ? most : v < -most ? -most : v;
}

/* ---- Filling --------------------------------------------------------------------------------- */

void zs_fill_run(uint16_t *out, uint16_t value, uint32_t n)
{
    const zs_pair pair = (zs_pair)((uint32_t)value << 16 | value);
    if ((uintptr_t)out & 2u) {
        *out++ = value;
        n--;
    }
    if (n & 1u)
        out[n - 1u] = value;
    zs_pair *at = (zs_pair *)(void *)out, *const end = at + n / 2u * (2u / ZS_PAIR);
    at += zs_fill_blocks(at, pair, (uint32_t)(end - at));
    for (; !ZS_FOR_SIZE && end - at >= 8; at += 8) {
        at[0] = at[1] = at[2] = at[3] = pair;
        at[4] = at[5] = at[6] = at[7] = pair;
    }
    while (at < end)
        *at++ = pair;
}

/* ---- Reciprocal ------------------------------------------------------------------------------
 *
 * With m = a / 2^32 in [1/2, 1), the result is r = 2^31 / m, for 1/m in (1, 2]. A table of 1/m - 1
 * in uq0_16 at 257 points and linear interpolation give y with a relative error e <= 2^-16.4:
 *   interpolation  h^2/8 * max |f''| / min f = (1/512)^2 / 8 * 16 / 1    = 2^-17
 *   rounding of the table                    2^-17 of a value >= 1       = 2^-17
 * (2^-17 + 2^-17 = 2^-16; the two maxima do not coincide.) One Newton step y (2 - m y) squares the
 * error: 2^-32, always from below. Its two truncations add 2^-31 and 2^-32. Sum < 2^-30. */

#define RECIP_AT(i)                                                                                \
    (uint16_t)(((33554432u + (256u + (i)) / 2u) / (256u + (i))) - 65536u - ((i) == 0u))
#if ZS_FOR_SIZE

uint32_t zs_recip_at(uint32_t i)
{
    return RECIP_AT(i);
}

#else

#define RECIP4(i) RECIP_AT(i), RECIP_AT((i) + 1u), RECIP_AT((i) + 2u), RECIP_AT((i) + 3u)
#define RECIP16(i) RECIP4(i), RECIP4((i) + 4u), RECIP4((i) + 8u), RECIP4((i) + 12u)
#define RECIP64(i) RECIP16(i), RECIP16((i) + 16u), RECIP16((i) + 32u), RECIP16((i) + 48u)

const uint16_t zs_recip_table[257] = { /* uq0_16: 512 / (256 + i) - 1; entry 0 saturated */
                                       RECIP64(0u), RECIP64(64u), RECIP64(128u), RECIP64(192u),
                                       RECIP_AT(256u)
};

#endif

uint32_t zs_recip(uint32_t a)
{
    ZS_FACT(a >> 31);
    return zs_recip_inline(a);
}

/* ---- Square root: one bit of the result in each step, without multiplication ----------------- */

ZS_RARE uint32_t zs_isqrt64(uint64_t v)
{
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << 62; bit; bit >>= 2) {
        if (v >= root + bit) {
            v -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
    }
    return (uint32_t)root; /* < 2^32 */
}

/* ---- 128-bit products ------------------------------------------------------------------------ */

struct wide {
    uint64_t hi, lo;
};

static ZS_RARE struct wide wide_mul(uint64_t a, uint64_t b)
{
    const uint32_t a0 = (uint32_t)a, a1 = (uint32_t)(a >> 32), b0 = (uint32_t)b,
                   b1 = (uint32_t)(b >> 32);
    const uint64_t low = zs_mul_uu(a0, b0);
    const uint64_t mid = zs_mul_uu(a1, b0) + (low >> 32);    /* <= (2^32-1)^2 + 2^32 - 1 < 2^64 */
    const uint64_t mid2 = zs_mul_uu(a0, b1) + (uint32_t)mid; /* the same */
    const struct wide w = { zs_mul_uu(a1, b1) + (mid >> 32) + (mid2 >> 32),
                            mid2 << 32 | (uint32_t)low };
    return w;
}

ZS_RARE uint64_t zs_muldiv_u64(uint64_t a, uint64_t b, uint64_t d)
{
    struct wide w = wide_mul(a, b);
    ZS_FACT(w.hi < d); /* the quotient has 64 bits */
    uint64_t q = 0;
    for (int i = 0; i < 64; i++) { /* shift and subtract; w.hi is the remainder, < d */
        const uint64_t carry = w.hi >> 63;
        w.hi = w.hi << 1 | w.lo >> 63;
        w.lo <<= 1;
        q <<= 1;
        if (carry || w.hi >= d) {
            w.hi -= d;
            q |= 1u;
        }
    }
    return q;
}

/* The path for b of 32 bits takes half of the products: 300 small cubes take 2 % less on the
 * Cortex-M3, 5 % on the M0, for 98 bytes. */
ZS_RARE int64_t zs_mulshift_s64(int64_t a, uint64_t b, int n)
{
    const uint64_t mag = a < 0 ? 0u - (uint64_t)a : (uint64_t)a;
    uint64_t r;
    if (!ZS_FOR_SIZE && !(b >> 32) && n < 96) { /* most: the product is high * 2^32 + low */
        const uint64_t high = zs_mul_uu((uint32_t)(mag >> 32), (uint32_t)b),
                       low = zs_mul_uu((uint32_t)mag, (uint32_t)b);
        r = n < 32 ? (high << (32 - n)) + (low >> n) : (high + (low >> 32)) >> (n - 32);
    } else {
        struct wide w = wide_mul(mag, b);
        for (; n >= 32; n -= 32) {
            w.lo = w.hi << 32 | w.lo >> 32;
            w.hi >>= 32;
        }
        r = w.hi << 1 << (63 - n) | w.lo >> n;
    }
    ZS_FACT(r <= (uint64_t)INT64_MAX);
    return a < 0 ? -(int64_t)r : (int64_t)r;
}
