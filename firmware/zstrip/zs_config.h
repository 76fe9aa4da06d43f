/* zstrip: sizes and budgets. Each can be set by the compiler's -D; the proofs in fx.h, xform.c,
 * plane.c and raster.c depend on them and are checked there when the library is built.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CONFIG_H
#define ZS_CONFIG_H

#ifndef ZS_SIZE_MAX
#define ZS_SIZE_MAX 4096 /* px, width and height of a frame */
#endif

#ifndef ZS_GUARD_PX
#define ZS_GUARD_PX 8188 /* px from the frame's middle; triangles that reach further are clipped */
#endif

#ifndef ZS_VARYINGS_MAX
#define ZS_VARYINGS_MAX 3 /* 16-bit values a vertex that shaders may interpolate; at most 8 */
#endif
#if ZS_VARYINGS_MAX > 8
#error "ZS_VARYINGS_MAX: at most 8"
#endif

/* 1: compiled for size (-Os): what arch/ has by table or by assembler is left to the compiler, and so is what is in line. */
#ifndef ZS_FOR_SIZE
#ifdef __OPTIMIZE_SIZE__
#define ZS_FOR_SIZE 1
#else
#define ZS_FOR_SIZE 0
#endif
#endif

/* 1: rows of a matrix are added up in 64 bits, where that is as cheap as in 32 (wide.h). Every file of a program must have it
 * alike. */
#ifndef ZS_ROW_WIDE
#if (defined(__ARM_ARCH) && __ARM_ARCH >= 7) || defined(__x86_64__)
#define ZS_ROW_WIDE 1
#else
#define ZS_ROW_WIDE 0
#endif
#endif
#define ZS_ROW_WORDS_MAX 10
#define ZS_ROW_WORDS (ZS_ROW_WIDE ? 7 : ZS_ROW_WORDS_MAX)

/* 1: no program lists an accelerator, and fast/ need not be there; the core does not ask for any
 * then. Every file of a program must have it alike. */
#ifndef ZS_NO_FAST
#define ZS_NO_FAST 0
#endif

#ifndef ZS_STATS
#define ZS_STATS 0 /* 1: count written pixels too, which costs an instruction a pixel */
#endif

/* What `zsim study time` varies, with ZS_STUDY = 1; errors are in NUMERICS.md. */
#ifndef ZS_STUDY
#define ZS_STUDY 0
#endif
#ifndef ZS_RECIP_STEPS
#define ZS_RECIP_STEPS 1 /* Newton steps of a vertex's reciprocal: 1 for 30 bits, 0 for 16 */
#endif
#ifndef ZS_TEXEL_COARSE_LOG2
#define ZS_TEXEL_COARSE_LOG2 10 /* texels, across a triangle, up to which a pixel's reciprocal has 15 bits; else 30 */
#endif
#ifndef ZS_SPAN_BOUND_LOG2
#define ZS_SPAN_BOUND_LOG2 3 /* affine where that is off by at most 2^-this texel, or code of colour; 2 .. 6 */
#endif
#if !ZS_STUDY && (ZS_RECIP_STEPS != 1 || ZS_TEXEL_COARSE_LOG2 != 10 || ZS_SPAN_BOUND_LOG2 != 3)
#error "ZS_RECIP_STEPS, ZS_TEXEL_COARSE_LOG2 and ZS_SPAN_BOUND_LOG2 are for studies: the error bounds are those of 1, 10, 3"
#endif

#ifndef ZS_ALIGNED
#if defined(__GNUC__)
#define ZS_ALIGNED __attribute__((aligned(32))) /* a Cortex-M7 cache line */
#else
#define ZS_ALIGNED
#endif
#endif

/* Preconditions restated at run time: on in test builds, nothing on a target. */
#ifndef ZS_ASSERT
#define ZS_ASSERT(condition) ((void)0)
#endif

/* Relations between values, which the proofs (make prove) cannot see from ranges alone and take as given: asserted in
 * test builds, and tried by tests/prove/facts.c. */
#ifndef ZS_FACT
#define ZS_FACT(condition) ZS_ASSERT(condition)
#endif

#define ZS_POOL_MAX 65534u /* records in a pool: 16-bit indices, one value for "none" */

#endif
