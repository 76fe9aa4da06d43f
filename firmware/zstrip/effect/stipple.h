/* Screen-door patterns, for stipple.c and layers. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_STIPPLE_H
#define ZS_EFFECT_STIPPLE_H

#include "effect/blend.h"
#include "effect/over.h"

/* The pattern of the job from the first pixel of a row's span on: bit k is 1 if pixel k is drawn.
 */
uint32_t zs_stipple_pattern(const struct zs_job *job, const struct zs_row *row, uint32_t alpha,
                            uint32_t phase);

/* Test n pixels, 1 .. 32: those that have a bit. Write the keys of those that pass. Return their
 * bits. */
uint32_t zs_stipple_test(struct zs_job *job, uint16_t *depth, int32_t n, uint32_t sum,
                         uint32_t step, uint32_t bits);

/* The pattern n >= 0 pixels further on. */
static inline uint32_t zs_stipple_turned(uint32_t bits, int32_t n)
{
    const uint32_t by = (uint32_t)n & 7u;
    return bits >> by | bits << ((32u - by) & 31u);
}

/* The bits of n pixels, 1 .. 32. */
static inline uint32_t zs_stipple_bits(int32_t n)
{
    return UINT32_MAX >> (32 - n);
}

#endif
