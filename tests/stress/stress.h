/* What the stress runner runs: cases by seed, and what they add up to.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_STRESS_H
#define TESTS_STRESS_H

#include <stdint.h>

/* Sums over cases, and over runs (stress.c keeps them in a file). */
struct stress_counts {
    uint64_t cases, units; /* units: triangles, or frames of at least STRESS_TRIS triangles drawn */
    uint64_t frames, tris, pixels; /* drawn and compared */
    uint64_t findings;
};

#define STRESS_TRIS 32u
#define STRESS_PX 64 /* frames are at least as wide and high */

/* Run one case and add to *c. 1; 0 after a sentence on stderr: what was drawn is wrong. */
typedef int stress_fn(uint64_t seed, struct stress_counts *c);

/* A frame of thousands of snapped triangles, each against whole numbers. */
int stress_tris(uint64_t seed, struct stress_counts *c);
/* Eight frames of a random scene that moves, each drawn some way and the plainest way. */
int stress_frames(uint64_t seed, struct stress_counts *c);

/* Say what is wrong with a case; always 0. */
int stress_wrong(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
