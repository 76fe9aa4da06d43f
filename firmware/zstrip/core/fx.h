/* Fixed-point helpers.
 *
 * Formats: qI_F is signed, uqI_F unsigned, I counts the sign bit, I + F is the storage width.
 * Rounding is in each name or comment: floor, nearest (halves up), trunc (towards zero).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FX_H
#define ZS_FX_H

#include <stdint.h>

#include "zs_config.h"

#include "arch/wide.h"

_Static_assert((-3 >> 1) == -2, "right shift of negative values must be arithmetic");
_Static_assert(sizeof(int) >= 4, "int must hold 32 bits");

#define ZS_SUBPX_BITS 8 /* of every stored coordinate; 4-bit profiles snap to multiples of 16 */
#define ZS_SUBPX_ONE 256
#define ZS_SUBPX_HALF 128
#define ZS_GUARD_SUBPX ((int64_t)ZS_GUARD_PX * ZS_SUBPX_ONE)

/* The extent of a binned triangle is at most twice the guard band. plane.c and edges.c rely on a
 * bound of 2^22 sub-pixels. */
#define ZS_EXTENT_BITS 22
_Static_assert(2 * (ZS_GUARD_SUBPX + 8) < ((int64_t)1 << ZS_EXTENT_BITS), "guard band too wide");
_Static_assert(ZS_GUARD_PX >= ZS_SIZE_MAX, "the guard band must hold the frame");
_Static_assert(ZS_SIZE_MAX <= 4096,
               "see the step count in plane.c and the strip division in frame.c");

#if defined(__GNUC__)
#define ZS_KERNEL_INLINE                                                                           \
    static inline __attribute__((always_inline)) /* so functions passed to it are inlined too */
#else
#define ZS_KERNEL_INLINE static inline
#endif
#if ZS_FOR_SIZE /* the compiler decides, for size */
#define ZS_RARE
#define ZS_IN_ORDER
#define ZS_ALWAYS_INLINE static inline
#define ZS_NOINLINE
#elif defined(__GNUC__)
#define ZS_ALWAYS_INLINE static inline __attribute__((always_inline))
#if defined(__clang__)
#define ZS_NOINLINE __attribute__((noinline))
#else
#define ZS_NOINLINE                                                                                \
    __attribute__((noinline, noclone)) /* a clone takes fields as arguments, and spills them */
#endif
#if defined(__clang__) || !defined(__OPTIMIZE__)
#define ZS_RARE
#define ZS_IN_ORDER
#else
#define ZS_IN_ORDER                                                                                \
    __attribute__((                                                                                \
        optimize("no-schedule-insns"))) /* for many live values: early loads would be spilled */
#define ZS_RARE                                                                                    \
    __attribute__((optimize("Os"))) /* runs seldom, or is slow anyway: flash matters, not time */
#endif
#else
#define ZS_RARE
#define ZS_IN_ORDER
#define ZS_ALWAYS_INLINE static inline
#define ZS_NOINLINE
#endif

/* For functions with several callers: compilers would inline copies of them even at -Os. */
#if defined(__GNUC__)
#define ZS_SHARED __attribute__((noinline))
#define ZS_SELDOM(x) __builtin_expect((x) != 0, 0) /* x is not 0, which seldom happens */
#else
#define ZS_SHARED
#define ZS_SELDOM(x) (x)
#endif

/* Access to two 16-bit values at a time, in memory that is an array of uint16_t. */
#if defined(__GNUC__)
typedef uint32_t __attribute__((may_alias)) zs_pair;
#define ZS_PAIR 2u
#else
typedef uint16_t zs_pair;
#define ZS_PAIR 1u
#endif

/* Fill n > 0 16-bit values, at any even address. */
void zs_fill_run(uint16_t *out, uint16_t value, uint32_t n);

static inline int32_t zs_abs32(int32_t v)
{
    return v < 0 ? -v : v;
}

static inline int32_t zs_min32(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t zs_max32(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* The largest of 0, a and b minus the least. |a|, |b| < 2^30 */
static inline uint32_t zs_range32(int32_t a, int32_t b)
{
    const int32_t low = a < b ? a : b, high = a < b ? b : a;
    return (uint32_t)((high & ~(high >> 31)) - (low & low >> 31));
}

static inline uint32_t zs_minu32(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static inline uint32_t zs_maxu32(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* v / 2^n, nearest. 0 <= n <= 62, |v| < 2^63 - 1. */
int64_t zs_round_shift(int64_t v, int n);
/* v * 2^n, n of either sign, nearest. |result| < 2^62. */
int64_t zs_scale2(int64_t v, int n);

/* The low half of a product, for sums that wrap modulo 2^32 by design. */
static inline uint32_t zs_wrap_mul(uint32_t a, int32_t b)
{
    return a * (uint32_t)b;
}

/* v * d modulo 2^64. */
static inline uint64_t zs_times(uint64_t v, int32_t d)
{
    return (uint64_t)zs_mul_su(d, (uint32_t)v) +
           ((uint64_t)((uint32_t)(v >> 32) * (uint32_t)d) << 32);
}

/* The first sample (row or column) at or after a coordinate, q24_8 px: ceil((c - 1/2 px) / 1 px).
 */
static inline int32_t zs_first_sample(int32_t c)
{
    return (c + (ZS_SUBPX_HALF - 1)) >> ZS_SUBPX_BITS;
}

/* 2^63 / a, at most 2^32 - 1, within 2^-30 of it. a >= 2^31.
 * Cost  two table look-ups, one wide and three narrow multiplications; no division.
 * Exact tests/unit/test_fx.c checks the bound for arguments from 2^31 up in steps that reach every
 *       table entry. */
uint32_t zs_recip(uint32_t a);

#if ZS_FOR_SIZE
uint32_t zs_recip_at(uint32_t i); /* fx.c: computes a table entry with a division */
#else
extern const uint16_t zs_recip_table[257]; /* fx.c */
static inline uint32_t zs_recip_at(uint32_t i)
{
    return zs_recip_table[i];
}
#endif

/* 2^63 / a to 16 bits, with a relative error within 2^-16. a >= 2^31. */
ZS_ALWAYS_INLINE uint32_t zs_recip16(uint32_t a)
{
    const uint32_t at = a << 1 >> 24;
    const uint32_t t = a << 9 >> 16;                 /* uq0_16 within the cell */
    const uint32_t y0 = zs_recip_at(at);             /* < 2^16 */
    const uint32_t dy = y0 - zs_recip_at(at + 1u);   /* 128 .. 509 */
    return 0x80000000u + (y0 << 15) - (dy * t >> 1); /* uq1_31, dy * t < 2^25 */
}

/* zs_recip, inlined, for loops with few other calls. fx.c derives its error. */
ZS_ALWAYS_INLINE uint32_t zs_recip_inline(uint32_t a)
{
    const uint32_t y = zs_recip16(a);
    /* y (2 - m y) = y + y e with e = 1 - m y, |e| <= 2^14.6 in q_31: two narrow products instead of
     * a wide one */
    const int32_t e = (int32_t)(0x80000000u - zs_umulh(a, y));
    const int32_t upper = (int32_t)(y >> 16) * e,
                  lower = (int32_t)(y & 0xffffu) * e; /* |.| < 2^30.6 */
    /* floor: exact below 2^32 + 2 */
    const uint32_t r = y + (ZS_64 ? (uint32_t)((int64_t)y * e >> 31)
                                  : (uint32_t)((upper + (lower >> 16)) >> 15));
    return r >> 31 ? r : UINT32_MAX;
}

/* 2^46 / a, with a relative error within 2^-14, at most 2^16 - 1. 2^30 <= a < 2^31. Needs no 64-bit
 * product. */
static inline uint32_t zs_recip15(uint32_t a)
{
    const uint32_t at = a << 2 >> 24, y0 = zs_recip_at(at);
    const uint32_t t = a << 10 >> 16; /* uq0_16 within the cell */
    return (0x10000u + y0 - ((y0 - zs_recip_at(at + 1u)) * t >> 16)) >> 1;
}

/* floor(sqrt(v)). */
uint32_t zs_isqrt64(uint64_t v);

/* floor(a * b / d) with a 128-bit product. d > 0, result < 2^64. For set-up, not for loops. */
uint64_t zs_muldiv_u64(uint64_t a, uint64_t b, uint64_t d);

/* Clamp v to -most .. most. */
int64_t zs_held64(int64_t v, int64_t most);

/* |v|, also of INT32_MIN */
static inline uint32_t zs_size32(int32_t v)
{
    return v < 0 ? 0u - (uint32_t)v : (uint32_t)v;
}

/* |v|, for |v| < 2^63 */
static inline int64_t zs_size64(int64_t v)
{
    return v < 0 ? -v : v;
}

/* a * b / 2^n, floor of the magnitude, with a 128-bit product. 0 <= n <= 127, |result| < 2^63. */
int64_t zs_mulshift_s64(int64_t a, uint64_t b, int n);

#endif
