/* Two pairs of accumulators that step by themselves: the interpolators of an RP2040, or a twin in C
 * that gives the same values. Internal.
 *
 * RP2040 datasheet, 2.3.1.6. Each core has its own two. Here each lane adds its base to its
 * accumulator as it is (ADD_RAW) whenever a result is popped, and gives the result a field of it:
 * (accum >> shift) masked. A pop takes one cycle, as any access to SIO.
 *
 * A handler of interrupts that uses the interpolators, or draws, has to put them back: a triangle's
 * colours are in them while it is drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_LANES_H
#define ZS_LANES_H

#include <stdint.h>

/* 1: the core is one of an RP2040's. Its board defines it. */
#ifndef ZS_RP2040
#define ZS_RP2040 0
#endif

#if ZS_RP2040

struct zs_lanes {
    volatile uint32_t accum[2], base[3];
    const volatile uint32_t pop[3], peek[3]; /* lane 0, lane 1, both with base[2] */
    volatile uint32_t ctrl[2], add[2], bases;
};
_Static_assert(sizeof(struct zs_lanes) == 64, "as SIO has them");

#else

struct zs_lanes {
    uint32_t accum[2], base[3], ctrl[2];
};

static inline uint32_t zs_lanes_field(uint32_t accum, uint32_t ctrl)
{
    const uint32_t least = ctrl >> 5 & 31u, most = ctrl >> 10 & 31u;
    return accum >> (ctrl & 31u) & (0xffffffffu >> (31u - most)) & (0xffffffffu << least);
}

/* Return base[2] and the fields of both lanes in sum, and step both. */
static inline uint32_t zs_lanes_pop(struct zs_lanes *lanes)
{
    const uint32_t both = lanes->base[2] + zs_lanes_field(lanes->accum[0], lanes->ctrl[0]) +
                          zs_lanes_field(lanes->accum[1], lanes->ctrl[1]);
    lanes->accum[0] += lanes->base[0];
    lanes->accum[1] += lanes->base[1];
    return both;
}

#endif

/* What the lanes do for a triangle: 0 and 1 of the first interpolator, 0 and 1 of the second. */
struct zs_lanes_set {
    uint32_t ctrl[4];        /* ZS_LANES_FIELD */
    uint32_t base;           /* added to the first interpolator's result */
    const uint16_t *palette;
    const void *texel; /* for the twin, whose bases are no addresses */
};

#endif
