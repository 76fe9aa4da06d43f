/* Functions that are worth assembler on some core: 32 x 32-bit products with 64 bits, leading
 * zeros, rows of a matrix; filling is in fill.h. Besides, loads and hints that keep a compiler from
 * spilling, and what says which accelerators in assembler a core has (ZS_SET_UP, ZS_V7M).
 *
 * A Cortex-M0 or M0+ computes the low 32 bits of a 32 x 32-bit product in one cycle. It has neither
 * the high half nor CLZ. Its compiler calls the library for both, which takes some 40 and 25 cycles
 * and all low registers. Here they are inlined: four products of 16-bit halves take about 18
 * cycles, a table for leading zeros about 12. On Armv7-M, a row of a matrix is in assembler, as a
 * compiler loads and stores word by word. Every function also exists in plain C for all other
 * cores.
 *
 * Exact: tests/unit/test_fx.c here, tests/checks/wide.sh on an emulated Cortex-M0, M3 and M4.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_WIDE_H
#define ZS_WIDE_H

#include <stdint.h>

#include "arch/fill.h"
#include "zs_config.h"

/* 1: the core has a 32-bit divide instruction. */
#if defined(__ARM_ARCH) && !defined(__ARM_FEATURE_IDIV) || defined(__riscv) && !defined(__riscv_div)
#define ZS_DIVIDES 0
#else
#define ZS_DIVIDES 1
#endif

/* 1: registers hold 64 bits. ZS_64 = 0 is for tests: such a machine draws as others do. */
#if defined(__x86_64__) || defined(__aarch64__)
#define ZS_HAS_64 1
#else
#define ZS_HAS_64 0
#endif
#ifndef ZS_64
#define ZS_64 ZS_HAS_64
#endif

#if defined(__GNUC__) && defined(__ARM_ARCH_6M__) && !ZS_FOR_SIZE

/* a b = a1 b1 2^32 + (a1 b0 + a0 b1) 2^16 + a0 b0. AH and BH are the shifts that extract the high
 * halves: asrs for a signed factor, lsrs for an unsigned one. A middle product is signed if its
 * high half is. In: a, b. Out: hi in a, lo. */
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

/* 1: zs_cross_short takes short arguments only; 0: any */
#define ZS_CROSS_SHORT 1
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

#else

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

#define ZS_CROSS_SHORT 0
/* a b - c d, |b| and |d| <= 2^14; here any below 2^31. */
static inline int64_t zs_cross_short(int32_t a, int32_t b, int32_t c, int32_t d)
{
    return (int64_t)a * b - (int64_t)c * d;
}

#endif

/* One row of an affine map, for points of 16 bits: (m . p + t) / 2^shift, floor, |.| < 2^30 + 2.
 * With ZS_ROW_WIDE, on cores where a 64-bit sum costs no more than a 32-bit one: row = { m[3], t's
 * low half, its high half, shift, 32 - shift }. Otherwise 32 bits hold every sum: row = { low[3],
 * t_low, s, high[3], s2, t_high } gives
 *   ((((low . p + t_low) >> s) + high . p) >> s2) + t_high
 * low . p + t_low fits 32 bits; the other sums are modulo 2^32; s, s2 < 32. Armv6-M: 30 cycles and
 * the seven registers here; a compiler takes 45 cycles and spills. */
#if ZS_ROW_WIDE

static inline int32_t zs_matrix_row(const int32_t *row, int32_t x, int32_t y, int32_t z)
{
    int64_t sum = (int64_t)((uint64_t)(uint32_t)row[4] << 32 | (uint32_t)row[3]);
    sum += (int64_t)row[0] * x;
    sum += (int64_t)row[1] * y;
    sum += (int64_t)row[2] * z;
    return (int32_t)(sum >> row[5]);
}

#elif defined(__GNUC__) && defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__)

static inline int32_t zs_matrix_row(const int32_t *row, int32_t x, int32_t y, int32_t z)
{
    /* ldm goes by their numbers */
    register int32_t sum __asm__("r3"), t1 __asm__("r4"), t2 __asm__("r5");
    __asm__(".syntax unified\n\t"
            "ldmia %0!, {r3, r4, r5}\n\t"
            "muls r3, %4\n\tmuls r4, %5\n\tmuls r5, %6\n\tadds r3, r4\n\tadds r3, r5\n\t"
            "ldmia %0!, {r4, r5}\n\tadds r3, r4\n\tasrs r3, r5\n\t"
            "ldmia %0!, {r4, r5}\n\tmuls r4, %4\n\tmuls r5, %5\n\tadds r3, r4\n\tadds r3, r5\n\t"
            "ldmia %0!, {r4, r5}\n\tmuls r4, %6\n\tadds r3, r4\n\tasrs r3, r5\n\t"
            "ldmia %0!, {r4}\n\tadds r3, r4"
            : "+l"(row), "=&r"(sum), "=&r"(t1), "=&r"(t2)
            : "l"(x), "l"(y), "l"(z)
            : "cc", "memory");
    return sum;
}

#else

static inline int32_t zs_matrix_row(const int32_t *row, int32_t x, int32_t y, int32_t z)
{
    const int32_t low = row[0] * x + row[1] * y + row[2] * z + row[3];
    const uint32_t high = (uint32_t)(low >> row[4]) + (uint32_t)row[5] * (uint32_t)x +
                          (uint32_t)row[6] * (uint32_t)y + (uint32_t)row[7] * (uint32_t)z;
    return (int32_t)((uint32_t)((int32_t)high >> row[8]) + (uint32_t)row[9]);
}

#endif

/* Transform n > 0 points, p[3] each, by three consecutive rows; out[3] each. */
#if ZS_ROW_WIDE && defined(__GNUC__) && !defined(__clang__) && defined(__thumb2__) && \
    defined(__OPTIMIZE__)

static inline void zs_matrix_rows(const int32_t *row, const int16_t *p, int32_t *out, uint32_t n)
{
    const int32_t *const end = out + 3u * n;
#define ZS_ROW_NEXT                                                            \
    "ldm %0!, {r4, r5, r6, r8, r9, r10, r11}\n\t"                              \
    "smlal r8, r9, r4, %3\n\tsmlal r8, r9, r5, %4\n\tsmlal r8, r9, r6, %5\n\t" \
    "lsr r8, r10\n\tlsl r9, r11\n\torr r8, r9\n\tstr r8, [%2], #4\n\t"
    do {
        int32_t x, y, z;
        __asm__ volatile(".syntax unified\n\t"
                         "ldrsh %3, [%1], #2\n\tldrsh %4, [%1], #2\n\tldrsh %5, [%1], #2\n\t"
                         ZS_ROW_NEXT ZS_ROW_NEXT ZS_ROW_NEXT
                         "sub %0, #84"
                         : "+&r"(row), "+&r"(p), "+&r"(out), "=&r"(x), "=&r"(y), "=&r"(z)
                         :
                         : "r4", "r5", "r6", "r8", "r9", "r10", "r11", "cc", "memory");
    } while (out != end);
#undef ZS_ROW_NEXT
}

#else

static inline void zs_matrix_rows(const int32_t *row, const int16_t *p, int32_t *out, uint32_t n)
{
    for (int32_t *const end = out + 3u * n; out != end; out += 3, p += 3) {
        const int32_t x = p[0], y = p[1], z = p[2];
        out[0] = zs_matrix_row(row, x, y, z);
        out[1] = zs_matrix_row(row + ZS_ROW_WORDS, x, y, z);
        out[2] = zs_matrix_row(row + 2 * ZS_ROW_WORDS, x, y, z);
    }
}

#endif

/* Return (gx x + gy y + 128) / 256, floor, modulo 2^32: how much a plane changes over x, y, q24_8.
 * |x|, |y| <= 2^22. Cores without wide products take the low 8 bits of the gradients apart: their
 * sum is below 2^31. */
static inline uint32_t zs_plane_step(int32_t gx, int32_t x, int32_t gy, int32_t y)
{
    if (ZS_DIVIDES)
        return (uint32_t)((zs_mul_ss(gx, x) + zs_mul_ss(gy, y) + 128) >> 8);
    return (uint32_t)(gx >> 8) * (uint32_t)x + (uint32_t)(gy >> 8) * (uint32_t)y +
           (uint32_t)(((gx & 255) * x + (gy & 255) * y + 128) >> 8);
}

/* x has 32 bits: keep the compiler from holding it in 64 bits because it is used in products. */
#if defined(__GNUC__)
#define ZS_NARROW(x) __asm__("" : "+r"(x))
#else
#define ZS_NARROW(x) ((void)0)
#endif

/* Load two adjacent words with one instruction, exactly here: for a scanline loop that is short of
 * registers, where the compiler would keep these values in registers and spill others. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__thumb2__) && defined(__OPTIMIZE__) && \
    !ZS_FOR_SIZE

/* Load p[at] and p[at + 1]; at is a constant, because a computed address would take a register. */
static inline __attribute__((always_inline)) void zs_two(const uint32_t *p, int at, uint32_t *a,
                                                         uint32_t *b)
{
    __asm__ volatile("ldrd %0, %1, [%2, %3]"
                     : "=&r"(*a), "=r"(*b)
                     : "r"(p), "n"(4 * at)
                     : "memory");
}

/* Load x[0] and x[1] with one instruction. */
static inline void zs_xy(const int32_t *x, int32_t *a, int32_t *b)
{
    const struct pair { int32_t word[2]; } *const pair = (const void *)x;
    __asm__("ldrd %0, %1, %2" : "=&r"(*a), "=r"(*b) : "Q"(*pair));
}

/* v >> 16, computed here and not earlier. */
static inline uint32_t zs_high(uint32_t v)
{
    uint32_t out;
    __asm__("lsr %0, %1, #16" : "=r"(out) : "r"(v));
    return out;
}

#else

static inline uint32_t zs_high(uint32_t v)
{
    return v >> 16;
}

static inline void zs_xy(const int32_t *x, int32_t *a, int32_t *b)
{
    *a = x[0];
    *b = x[1];
}

static inline void zs_two(const uint32_t *p, int at, uint32_t *a, uint32_t *b)
{
    *a = p[at];
    *b = p[at + 1];
}

#endif

/* Ask the compiler to keep x in a high register, which only ADD, CMP and MOV reach: for the step of
 * a sum, in an inner loop that is short of the eight low ones. Without effect on cores whose
 * registers are all alike, and with other compilers. */
#if defined(__GNUC__) && defined(__ARM_ARCH_6M__)
#define ZS_HIGH_REGISTER(x) __asm__("" : "+h"(x))
#else
#define ZS_HIGH_REGISTER(x) ((void)0)
#endif

/* Hide the origin of x from the compiler. */
#if defined(__GNUC__)
#define ZS_ANEW(x) __asm__("" : "+r"(x))
#else
#define ZS_ANEW(x) ((void)0)
#endif

/* Keep the compiler from holding what it has loaded: it would spill it, and load it from there. Of
 * variables it holds those whose address it alone knows, until ZS_IN_MEMORY gives it away. */
#if defined(__GNUC__)
#define ZS_FORGET __asm__ volatile("" : : : "memory")
#define ZS_IN_MEMORY(at) __asm__ volatile("" : : "r"(at) : "memory")
#else
#define ZS_FORGET ((void)0)
#define ZS_IN_MEMORY(at) ((void)(at))
#endif

/* Not 0 if v does not fit 16 bits. */
#if defined(__ARM_ARCH_6M__)
#define ZS_OVER_16(v) ((uint32_t)(v) ^ (uint32_t)(int16_t)(v)) /* without a constant to load */
#else
#define ZS_OVER_16(v) (((uint32_t)(v) + 0x8000u) & 0xffff0000u)
#endif

/* Set at[0] and at[1] to the vertex a = { x, y }, the others to b and c from it, modulo 2^32.
 * Return twice the area of the triangle, (b - a) x (c - a). *wide becomes not 0 if one of the
 * differences does not fit 16 bits; the result is then undefined. Otherwise |result| < 2^31: both
 * products are at most 2^30, and if both are 2^30, they have the same sign. */
static inline int32_t zs_area_short(int32_t at[6], const int32_t *a, const int32_t *b,
                                    const int32_t *c, uint32_t *wide)
{
    int32_t bx, by, cx, cy;
    zs_xy(a, &at[0], &at[1]);
    zs_xy(b, &bx, &by);
    zs_xy(c, &cx, &cy);
    at[2] = bx = (int32_t)((uint32_t)bx - (uint32_t)at[0]);
    at[3] = by = (int32_t)((uint32_t)by - (uint32_t)at[1]);
    at[4] = cx = (int32_t)((uint32_t)cx - (uint32_t)at[0]);
    at[5] = cy = (int32_t)((uint32_t)cy - (uint32_t)at[1]);
    *wide = ZS_OVER_16(bx) | ZS_OVER_16(by) | ZS_OVER_16(cx) | ZS_OVER_16(cy);
    ZS_FACT(*wide || (bx >= -32768 && bx <= 32767 && by >= -32768 && by <= 32767 && cx >= -32768 &&
                      cx <= 32767 && cy >= -32768 && cy <= 32767));
    return *wide ? 0 : bx * cy - cx * by;
}

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
#if defined(__GNUC__) && (!defined(__ARM_ARCH_6M__) || ZS_FOR_SIZE)

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
    ZS_FACT(v < 256u);
    return n + 8 + zs_clz8[v];
}

#endif

/* v > 0. */
#if ZS_FOR_SIZE
int zs_clz64(uint64_t v); /* fx.c */
#else
static inline int zs_clz64(uint64_t v)
{
    return v >> 32 ? zs_clz32((uint32_t)(v >> 32)) : 32 + zs_clz32((uint32_t)v);
}
#endif

/* 1: the core has an accelerator that sets up tiny triangles by hand (fast/set_up.c). With more
 * varyings fields of a job are beyond what its instructions reach. */
#if defined(__GNUC__) && defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__) && !ZS_FOR_SIZE && \
    !ZS_NO_FAST && ZS_VARYINGS_MAX <= 3
#define ZS_SET_UP 1
#else
#define ZS_SET_UP 0
#endif

/* 1: the core, an Armv7-M or later, has loops by hand over small triangles (fast/solid_v7m.c,
 * fast/texture_v7m.c) and over a mesh's triangles (fast/sweep_v7m.c). They count no written pixels.
 * ZS_V7M = 0 is for tests. */
#ifndef ZS_V7M
#if defined(__GNUC__) && defined(__thumb2__) && defined(__ARM_FEATURE_IDIV) &&                     \
    defined(__ARM_ARCH_PROFILE) && !defined(__ARM_BIG_ENDIAN) && defined(__OPTIMIZE__) &&          \
    !ZS_FOR_SIZE && !ZS_NO_FAST && !ZS_STATS
#define ZS_V7M (__ARM_ARCH_PROFILE == 'M')
#else
#define ZS_V7M 0
#endif
#endif

/* A function that is one piece of assembler. */
#define ZS_NAKED __attribute__((naked, noinline))
#define ZS_TAKEN __attribute__((unused)) /* of its parameters: it takes them from registers */

#endif
