/* Values held to a range by one instruction, with twins in C. Internal.
 *
 * On a Cortex-M3 a pixel of Phong shading takes 9 to 10 instructions less with them (57 and 77
 * without). tests/lab/effects.sh draws it with both.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_HELD_H
#define ZS_HELD_H

#include <stdint.h>

#if defined(__GNUC__) && defined(__thumb2__)

/* max(0, v) */
static inline uint32_t zs_positive(int32_t v)
{
    uint32_t result;
    __asm__("usat %0, #31, %1" : "=r"(result) : "r"(v) : "cc");
    return result;
}

/* v / 2^shift, at most 2^bits - 1; v < 2^31. bits and shift are constants. */
#define ZS_HELD(to, v, shift, bits)                                                                \
    __asm__("usat %0, %3, %1, asr %2" : "=r"(to) : "r"(v), "I"(shift), "I"(bits) : "cc")

#else

static inline uint32_t zs_positive(int32_t v)
{
    return (uint32_t)(v & ~(v >> 31));
}

static inline uint32_t zs_held_to(uint32_t v, uint32_t most)
{
    return v < most ? v : most;
}

#define ZS_HELD(to, v, shift, bits) ((to) = zs_held_to((v) >> (shift), (1u << (bits)) - 1u))

#endif

#endif
