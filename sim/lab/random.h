/* Seeded random numbers, everywhere the same: one draw to an expression, because C leaves the order
 * of two open.
 *
 * Source  SplitMix64, Steele, Lea and Flood, OOPSLA 2014.
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RANDOM_H
#define SIM_RANDOM_H

#include <math.h>
#include <stdint.h>

struct sim_random {
    uint64_t state;
};

static inline uint64_t sim_random_bits(struct sim_random *r)
{
    uint64_t v = r->state += 0x9e3779b97f4a7c15u;
    v = (v ^ v >> 30) * 0xbf58476d1ce4e5b9u;
    v = (v ^ v >> 27) * 0x94d049bb133111ebu;
    return v ^ v >> 31;
}

/* One of n: 0 .. n - 1. */
static inline uint32_t sim_random_pick(struct sim_random *r, uint32_t n)
{
    return (uint32_t)(sim_random_bits(r) % n);
}

/* lo .. hi, both included. */
static inline int32_t sim_random_range(struct sim_random *r, int32_t lo, int32_t hi)
{
    return (int32_t)(lo + (int64_t)(sim_random_bits(r) % ((uint64_t)((int64_t)hi - lo) + 1u)));
}

/* lo <= x < hi. */
static inline double sim_random_real(struct sim_random *r, double lo, double hi)
{
    return lo + (hi - lo) * (double)(sim_random_bits(r) >> 11) * 0x1p-53;
}

/* The same, all magnitudes equally likely; 0 < lo < hi. */
static inline double sim_random_log(struct sim_random *r, double lo, double hi)
{
    return lo * pow(hi / lo, sim_random_real(r, 0, 1));
}

#endif
