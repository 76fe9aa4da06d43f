/* Filling memory with words and with runs of depth keys, in assembler where a core has an
 * instruction for several words and a compiler stores word by word.
 *
 * Exact: tests/unit/test_fx.c here, tests/checks/wide.sh on an emulated Cortex-M0, M3 and M4.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FILL_H
#define ZS_FILL_H

#include <stdint.h>

#include "zs_config.h"

#if defined(__GNUC__) && defined(__thumb2__) && defined(__OPTIMIZE__) && !ZS_FOR_SIZE

/* Fill up to n words, 32 at a time, eight with each STM: 0.2 instructions a word. Return how many
 * were filled. at is 4-byte aligned. */
static inline uint32_t zs_fill_blocks(void *at, uint32_t value, uint32_t n)
{
    uint32_t left = n - 32u;
    if (n < 32u)
        return 0;
    __asm__ volatile(".syntax unified\n\t"
                     "mov r3, %2\n\tmov r4, %2\n\tmov r5, %2\n\tmov r6, %2\n\t"
                     "mov r8, %2\n\tmov r9, %2\n\tmov r10, %2\n\tmov r12, %2\n"
                     "1:\n\t"
                     "stmia %0!, {r3, r4, r5, r6, r8, r9, r10, r12}\n\t"
                     "stmia %0!, {r3, r4, r5, r6, r8, r9, r10, r12}\n\t"
                     "stmia %0!, {r3, r4, r5, r6, r8, r9, r10, r12}\n\t"
                     "stmia %0!, {r3, r4, r5, r6, r8, r9, r10, r12}\n\t"
                     "subs %1, #32\n\tbcs 1b"
                     : "+r"(at), "+r"(left)
                     : "r"(value)
                     : "r3", "r4", "r5", "r6", "r8", "r9", "r10", "r12", "cc", "memory");
    return n & ~31u;
}

#elif defined(__GNUC__) && defined(__thumb__) && !ZS_FOR_SIZE

/* Fill up to n words, 16 at a time, four with each STM: 0.3 instructions, on Armv6-M 1.4 cycles a
 * word. Return how many were filled. at is 4-byte aligned. */
static inline uint32_t zs_fill_blocks(void *at, uint32_t value, uint32_t n)
{
    register uint32_t a __asm__("r3") = value, b __asm__("r4") = value;
    register uint32_t c __asm__("r5") = value, d __asm__("r6") = value;
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

#elif defined(__GNUC__) && defined(__OPTIMIZE__) && !ZS_FOR_SIZE && \
    (defined(__x86_64__) || defined(__aarch64__))

/* The same with vectors of four words: 0.4 instructions a word. */
typedef uint32_t __attribute__((vector_size(16), aligned(4), may_alias)) zs_four;
static inline uint32_t zs_fill_blocks(void *at, uint32_t value, uint32_t n)
{
    const zs_four four = { value, value, value, value };
    zs_four *to = (zs_four *)at;
    uint32_t left = n;
    for (; left >= 32; left -= 32, to += 8) {
        to[0] = to[1] = to[2] = to[3] = four;
        to[4] = to[5] = to[6] = to[7] = four;
    }
    return n - left;
}

#else

/* On other cores, the compiler's loop is as good. */
static inline uint32_t zs_fill_blocks(void *at, uint32_t value, uint32_t n)
{
    (void)at;
    (void)value;
    (void)n;
    return 0;
}

#endif

/* at[k] = (sum + k step) >> 16, modulo 2^32, for k < n. n is a multiple of 8, at is 4-byte aligned.
 * Armv7-M: two at a time, from the sums of an even and an odd k, 2.4 instructions each; 1.9 if the
 * core has an instruction that combines two halves. */
#if defined(__GNUC__) && defined(__ARM_ARCH) && __ARM_ARCH >= 7 && defined(__thumb2__) && \
    !defined(__ARM_BIG_ENDIAN)

#if defined(__ARM_FEATURE_DSP)
#define ZS_HALVES(out) "pkhtb " out ", %2, %1, asr #16\n\tadd %1, %3\n\tadd %2, %3\n\t"
#else
#define ZS_HALVES(out)                                              \
    "and " out ", %2, %4\n\torr " out ", " out ", %1, lsr #16\n\t" \
    "add %1, %3\n\tadd %2, %3\n\t"
#endif

static inline void zs_high_halves(uint16_t *at, uint32_t n, uint32_t sum, uint32_t step)
{
    uint32_t next = sum + step;
    for (uint16_t *const end = at + n; at != end;)
        __asm__ volatile(".syntax unified\n\t"
                         ZS_HALVES("r3") ZS_HALVES("r4") ZS_HALVES("r5") ZS_HALVES("r6")
                         "stmia %0!, {r3, r4, r5, r6}"
                         : "+&r"(at), "+&r"(sum), "+&r"(next)
                         : "r"(2u * step), "r"(0xffff0000u)
                         : "r3", "r4", "r5", "r6", "memory");
}

#else

static inline void zs_high_halves(uint16_t *at, uint32_t n, uint32_t sum, uint32_t step)
{
#define ZS_HALF(k) (at[k] = (uint16_t)(sum >> 16), sum += step)
    for (uint16_t *const end = at + n; at != end; at += 8)
        ZS_HALF(0), ZS_HALF(1), ZS_HALF(2), ZS_HALF(3), ZS_HALF(4), ZS_HALF(5), ZS_HALF(6),
            ZS_HALF(7);
#undef ZS_HALF
}

#endif

#endif
