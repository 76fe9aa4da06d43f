/* zstrip: limits and options that are fixed when the library is compiled. The compiler's -D can set
 * each of them. The error bounds in fx.h, xform.c, plane.c and raster.c depend on them; static
 * assertions in the library check that a value is within what the bounds allow.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CONFIG_H
#define ZS_CONFIG_H

#ifndef ZS_SIZE_MAX
#define ZS_SIZE_MAX 4096 /* px, width and height of a frame */
#endif

#ifndef ZS_GUARD_PX
#define ZS_GUARD_PX 8188 /* px: half of the guard band about the frame's centre: triangles beyond it
                            are clipped. 4097 .. 8191; from ZS_SIZE_MAX on with ZS_NO_FAST */
#endif

#ifndef ZS_VARYINGS_MAX
#define ZS_VARYINGS_MAX 3 /* most varyings (16-bit attributes) of a vertex; at most 8 */
#endif
#if ZS_VARYINGS_MAX > 8
#error "ZS_VARYINGS_MAX: at most 8"
#endif

/* 1: optimise for size (-Os). The tables and the assembler of arch/ are not used, and the compiler
 * alone decides what is inlined. */
#ifndef ZS_FOR_SIZE
#ifdef __OPTIMIZE_SIZE__
#define ZS_FOR_SIZE 1
#else
#define ZS_FOR_SIZE 0
#endif
#endif

/* 1: sum the products of a matrix row and a vector in 64 bits. That is the default on cores where
 * it costs no more than 32 bits (arch/wide.h): not on Armv6-M and the Cortex-M23. All files of a
 * program must agree on the value. */
#ifndef ZS_ROW_WIDE
#if (defined(__ARM_ARCH) && __ARM_ARCH >= 7 && (!defined(__thumb__) || defined(__thumb2__))) ||    \
    defined(__x86_64__)
#define ZS_ROW_WIDE 1
#else
#define ZS_ROW_WIDE 0
#endif
#endif
#define ZS_ROW_WORDS_MAX 10
#define ZS_ROW_WORDS (ZS_ROW_WIDE ? 7 : ZS_ROW_WORDS_MAX)

/* 1: compile without accelerators. The lists of zs_fast.h are empty, the core calls no hook, and
 * the folder fast/ can be left out. All files of a program must agree on the value. */
#ifndef ZS_NO_FAST
#define ZS_NO_FAST 0
#endif

#ifndef ZS_STATS
#define ZS_STATS 0 /* 1: also count written pixels, which costs one instruction for each pixel */
#endif

/* Parameters that `zsim study time` varies. They may be changed only with ZS_STUDY = 1. NUMERICS.md
 * lists the errors that other values give. */
#ifndef ZS_STUDY
#define ZS_STUDY 0
#endif
#ifndef ZS_RECIP_STEPS
#define ZS_RECIP_STEPS 1 /* Newton steps for the reciprocal of a vertex's z: 1 gives 30 bits, 0
                            gives 16 */
#endif
#ifndef ZS_TEXEL_COARSE_LOG2
#define ZS_TEXEL_COARSE_LOG2 10 /* log2 of texels across a triangle. Up to this, the reciprocal of a
                                   pixel's w has 15 bits; above, 30 */
#endif
#ifndef ZS_SPAN_BOUND_LOG2
#define ZS_SPAN_BOUND_LOG2 2 /* interpolate affinely where the error is at most 2^-this of a texel,
                                or of a code of colour (a step of an RGB565 channel); 2 .. 6 */
#endif
#if !ZS_STUDY && (ZS_RECIP_STEPS != 1 || ZS_TEXEL_COARSE_LOG2 != 10 || ZS_SPAN_BOUND_LOG2 != 2)
#error "ZS_RECIP_STEPS, ZS_TEXEL_COARSE_LOG2, ZS_SPAN_BOUND_LOG2: error bounds hold for 1, 10, 2"
#endif

#ifndef ZS_ALIGNED
#if defined(__GNUC__)
#define ZS_ALIGNED __attribute__((aligned(32))) /* a Cortex-M7 cache line */
#else
#define ZS_ALIGNED
#endif
#endif

/* Around the declarations of a header, for programs in C++. */
#ifdef __cplusplus
#define ZS_C_BEGIN extern "C" {
#define ZS_C_END }
#else
#define ZS_C_BEGIN
#define ZS_C_END
#endif

/* For functions that change nothing when they fail: from C23 and C++17 on, the compiler warns if
 * the result is ignored. */
#if (defined(__cplusplus) && __cplusplus >= 201703L) ||                                            \
    (defined(__STDC_VERSION__) && __STDC_VERSION__ > 201710L)
#define ZS_NODISCARD [[nodiscard]]
#else
#define ZS_NODISCARD
#endif

/* Check a precondition at run time. Test builds define it; on a target it compiles to nothing. */
#ifndef ZS_ASSERT
#define ZS_ASSERT(condition) ((void)0)
#endif

/* A relation between values that the proofs (make prove) cannot derive from ranges alone. The
 * proofs assume it, test builds assert it, and tests/lab/prove/facts.c tests it. */
#ifndef ZS_FACT
#define ZS_FACT(condition) ZS_ASSERT(condition)
#endif

#define ZS_POOL_MAX 65534u /* most records of a pool: indices have 16 bits, and 65535 means none */

#endif
