/* Seeded random numbers: case n of a test is seed n, everywhere the same. One draw to an expression, because C leaves
 * the order of two open.
 *
 * Source  SplitMix64, Steele, Lea and Flood, OOPSLA 2014.
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PRNG_H
#define SIM_PRNG_H

#include <stdint.h>

struct prng {
    uint64_t state;
};

static inline uint64_t prng_next(struct prng *p)
{
    uint64_t v = p->state += 0x9e3779b97f4a7c15u;
    v = (v ^ v >> 30) * 0xbf58476d1ce4e5b9u;
    v = (v ^ v >> 27) * 0x94d049bb133111ebu;
    return v ^ v >> 31;
}

/* lo .. hi, both included. */
static inline int32_t prng_range(struct prng *p, int32_t lo, int32_t hi)
{
    const uint64_t n = (uint64_t)((int64_t)hi - lo) + 1u;
    return (int32_t)(lo + (int64_t)(prng_next(p) % n));
}

/* One of n. */
static inline uint32_t prng_pick(struct prng *p, uint32_t n)
{
    return (uint32_t)(prng_next(p) % n);
}

/* Any value, all magnitudes equally likely. */
static inline int64_t prng_log(struct prng *p)
{
    return (int64_t)prng_next(p) >> prng_pick(p, 64);
}

/* lo <= x < hi. */
static inline double prng_real(struct prng *p, double lo, double hi)
{
    return lo + (hi - lo) * (double)(prng_next(p) >> 11) * 0x1p-53;
}

#endif
