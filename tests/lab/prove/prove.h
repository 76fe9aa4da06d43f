/* What proofs are written with: values of any size in a range, and what the preconditions of the code become.
 *
 * ZS_ASSERT, a precondition, is something to be shown: Eva must find that prove_violated is not called. ZS_FACT, a
 * relation between intermediates that intervals do not see, is taken as given; tests/lab/prove/facts.c tries each.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PROVE_H
#define PROVE_H

#include <__fc_builtin.h>
#include <stdint.h>

/*@ requires never: \false; assigns \nothing; */
void prove_violated(void);
/*@ assigns \nothing; ensures never: \false; */
void prove_given(void);
#define ZS_ASSERT(c) ((c) ? (void)0 : prove_violated())
#define ZS_FACT(c) ((c) ? (void)0 : prove_given())
#define ASSERT(c) ((c) ? (void)0 : prove_violated())

#define any_i32(lo, hi) Frama_C_int_interval(lo, hi)
#define any_u32(lo, hi) Frama_C_unsigned_int_interval(lo, hi)
#define any_i64(lo, hi) Frama_C_long_long_interval(lo, hi)
#define any_u64(lo, hi) Frama_C_unsigned_long_long_interval(lo, hi)

/* Every argument of it is tried by tests/lab/prove/facts.c: no sum or product in it overflows; the result is this. */
/*@ assigns \result \from a;
    ensures bound: 0x80000000 <= \result; */
uint32_t zs_recip(uint32_t a);

/* Octave k of the positive numbers, cut at most. */
#define OCTAVE_LO(k) ((uint64_t)1 << (k))
#define OCTAVE_HI(k) (((uint64_t)1 << (k)) - 1u + ((uint64_t)1 << (k)))

#endif
