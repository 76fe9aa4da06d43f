/* Products of 32 x 32 bits with 64, leading zeros, and filling: what Armv6-M needs more than an instruction for.
 *
 * A Cortex-M0 or M0+ multiplies 32 x 32 bits to the low 32 in one cycle and has neither the high half nor CLZ.
 * Its compiler calls the library for both, some 40 and 25 cycles and all low registers. Here they are in line:
 * four products of 16-bit halves, about 18 cycles; a table, about 12. Everywhere else they are plain C.
 *
 * Exact tests/test_fx.c on the host, tests/checks/wide.sh on an emulated Cortex-M0.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_WIDE_H
#define ZS_WIDE_H

#include <stdint.h>

#if defined(__GNUC__) && defined(__ARM_ARCH_6M__)

/* a b = a1 b1 2^32 + (a1 b0 + a0 b1) 2^16 + a0 b0, the halves shifted into place by AH, BH: asrs where the factor
 * is signed, lsrs where not. A middle product has a sign where its high half has. In: a, b. Out: hi in a, lo. */
#define ZS_WIDE_PRODUCT(AH, BH)                                                         \
    __asm__(".syntax unified\n\t"                                                       \
            "uxth %3, %0\n\t" AH " %0, %0, #16\n\tuxth %4, %1\n\t" BH " %1, %1, #16\n\t" \
            "movs %2, %3\n\tmuls %2, %4\n\t" /* a0 b0 */                                \
            "muls %4, %0\n\t"                /* a1 b0 */                                \
            "muls %0, %1\n\t"                /* a1 b1 */                                \
            "muls %3, %1\n\t"                /* a0 b1 */                                \
            "lsls %1, %4, #16\n\t" AH " %4, %4, #16\n\tadds %2, %1\n\tadcs %0, %4\n\t"  \
            "lsls %1, %3, #16\n\t" BH " %3, %3, #16\n\tadds %2, %1\n\tadcs %0, %3"      \
            : "+l"(hi), "+l"(other), "=&l"(lo), "=&l"(t0), "=&l"(t1)                    \
            :                                                                           \
            : "cc")

static inline uint64_t zs_mul_uu(uint32_t a, uint32_t b)
{
    uint32_t hi = a, other = b, lo, t0, t1;
    ZS_WIDE_PRODUCT("lsrs", "lsrs");
    return (uint64_t)hi << 32 | lo;
}

static inline int64_t zs_mul_ss(int32_t a, int32_t b)
{
    uint32_t hi = (uint32_t)a, other = (uint32_t)b, lo, t0, t1;
    ZS_WIDE_PRODUCT("asrs", "asrs");
    return (int64_t)((uint64_t)hi << 32 | lo);
}

static inline int64_t zs_mul_su(int32_t a, uint32_t b)
{
    uint32_t hi = (uint32_t)a, other = b, lo, t0, t1;
    ZS_WIDE_PRODUCT("asrs", "lsrs");
    return (int64_t)((uint64_t)hi << 32 | lo);
}

/* (a1 b - c1 d) 2^16 + (a0 b - c0 d): the first below 2^30, the second below 2^31. */
static inline int64_t zs_cross_short(int32_t a, int32_t b, int32_t c, int32_t d)
{
    int32_t lo = a, other = c, hi, t;
    __asm__(".syntax unified\n\t"
            "asrs %2, %0, #16\n\tmuls %2, %4\n\tasrs %3, %1, #16\n\tmuls %3, %5\n\tsubs %2, %3\n\t"
            "uxth %0, %0\n\tmuls %0, %4\n\tuxth %1, %1\n\tmuls %1, %5\n\tsubs %0, %1\n\t"
            "asrs %1, %0, #31\n\tlsls %3, %2, #16\n\tasrs %2, %2, #16\n\tadds %0, %3\n\tadcs %2, %1"
            : "+l"(lo), "+l"(other), "=&l"(hi), "=&l"(t)
            : "l"(b), "l"(d)
            : "cc");
    return (int64_t)((uint64_t)(uint32_t)hi << 32 | (uint32_t)lo);
}

/* Fill 16 words at a time, up to n of them, four a STM: 1.4 cycles a word. Return how many. at is 4-byte aligned. */
static inline uint32_t zs_fill_blocks(void *at, uint32_t value, uint32_t n)
{
    register uint32_t a __asm__("r3") = value, b __asm__("r4") = value, c __asm__("r5") = value, d __asm__("r6") = value;
    uint32_t left = n;
    for (; left >= 16; left -= 16)
        __asm__ volatile(".syntax unified\n\t"
                         "stmia %0!, {r3, r4, r5, r6}\n\tstmia %0!, {r3, r4, r5, r6}\n\t"
                         "stmia %0!, {r3, r4, r5, r6}\n\tstmia %0!, {r3, r4, r5, r6}"
                         : "+l"(at)
                         : "l"(a), "l"(b), "l"(c), "l"(d)
                         : "memory");
    return n - left;
}

#else

/* Elsewhere a compiler's loop is as good. */
static inline uint32_t zs_fill_blocks(void *at, uint32_t value, uint32_t n)
{
    (void)at;
    (void)value;
    (void)n;
    return 0;
}

/* a * b, exact. */
static inline uint64_t zs_mul_uu(uint32_t a, uint32_t b)
{
    return (uint64_t)a * b;
}

static inline int64_t zs_mul_ss(int32_t a, int32_t b)
{
    return (int64_t)a * b;
}

static inline int64_t zs_mul_su(int32_t a, uint32_t b)
{
    return (int64_t)a * (int64_t)b;
}

/* a b - c d, |b| and |d| <= 2^14. */
static inline int64_t zs_cross_short(int32_t a, int32_t b, int32_t c, int32_t d)
{
    return (int64_t)a * b - (int64_t)c * d;
}

#endif

/* Ask that x live in a register that only ADD, CMP and MOV reach: the step of a sum in an inner loop that is short
 * of the other eight. Where the set is not split, or the compiler is another: nothing. */
#if defined(__GNUC__) && defined(__ARM_ARCH_6M__)
#define ZS_HIGH_REGISTER(x) __asm__("" : "+h"(x))
#else
#define ZS_HIGH_REGISTER(x) ((void)0)
#endif

/* High half of a 32 x 32 product, floor. */
static inline uint32_t zs_umulh(uint32_t a, uint32_t b)
{
    return (uint32_t)(zs_mul_uu(a, b) >> 32);
}

static inline int32_t zs_mulh_ss(int32_t a, int32_t b)
{
    return (int32_t)(zs_mul_ss(a, b) >> 32);
}

/* Leading zeros, v > 0. */
#if defined(__GNUC__) && !defined(__ARM_ARCH_6M__)

static inline int zs_clz32(uint32_t v)
{
    return __builtin_clz(v);
}

#else

extern const uint8_t zs_clz8[256]; /* fx.c: leading zeros of a byte, 8 of 0 */

static inline int zs_clz32(uint32_t v)
{
    int n = 16;
    if (v >> 16) {
        v >>= 16;
        n = 0;
    }
    if (v >> 8) {
        v >>= 8;
        n -= 8;
    }
    return n + 8 + zs_clz8[v];
}

#endif

/* v > 0. */
static inline int zs_clz64(uint64_t v)
{
    return v >> 32 ? zs_clz32((uint32_t)(v >> 32)) : 32 + zs_clz32((uint32_t)v);
}

#endif
