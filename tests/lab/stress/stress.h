/* What the stress runner runs: cases by seed, and what they add up to.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_STRESS_H
#define TESTS_STRESS_H

#include <stdint.h>

#include "effects.h"
#include "prng.h"
#include "wrong.h"
#include "zs_method.h"
#include "zstrip.h"

#define STRESS_FASTS 14 /* fast_count() */

/* Frames of units in which something was there: of each accelerator not listed, listed, and listed with something done
 * by it; then what else a way or a scene has. Named in stress.c. */
enum stress_seen {
    SEEN_OFF = 0,
    SEEN_ON = SEEN_OFF + STRESS_FASTS,
    SEEN_DID = SEEN_ON + STRESS_FASTS,
    SEEN_PASSES = SEEN_DID + STRESS_FASTS,
    SEEN_BUFFERS,
    SEEN_KEYS,
    SEEN_SUBPIXELS,
    SEEN_WATCH,
    SEEN_TRACK,
    SEEN_BOTH,
    SEEN_UNCHANGED,
    SEEN_UNDRAWN,
    SEEN_INVALIDATED,
    SEEN_SHARED,
    SEEN_CLIPPED,
    SEEN_CLUSTERS,
    SEEN_INSIDE,
    SEEN_ORTHOGRAPHIC,
    SEEN_STATE,
    SEEN_SKY,
    SEEN_RESOLVE,
    SEEN_DEPTH,
#define ONE(...) +1
    SEEN_SHADER = SEEN_DEPTH ZS_DEPTH_EACH(ONE),
    SEEN_TEXEL = SEEN_SHADER + 8,
    SEEN_METHOD = SEEN_TEXEL + 3 + EFFECT_TEXELS,
    SEEN_EFFECT = SEEN_METHOD + 2 ZS_METHOD_EACH(ONE),
#undef ONE
    SEEN_LINES = SEEN_EFFECT + EFFECT_KINDS,
    SEEN_POINTS,
    SEEN_HOOK,
    SEEN_N = SEEN_HOOK + EFFECT_HOOKS
};

/* Sums over cases, and over runs (stress.c keeps them in a file). */
struct stress_counts {
    uint64_t cases, units; /* units: triangles; or frames of at least STRESS_TRIS triangles drawn, one for each way that
                              was compared with the plainest */
    uint64_t frames, tris, pixels; /* drawn and compared */
    uint64_t findings;
    uint64_t seen[SEEN_N]; /* enum stress_seen */
};

/* Accelerators by bits, as fast_of takes them: mostly all, or all but one; or none, or one; or any. */
uint32_t stress_fasts(struct prng *p);
/* The list of them: NULL where there is none. Static storage, as fast_of's. */
const struct zs_fast *const *stress_list(uint32_t fasts);
/* A frame was drawn with these accelerators; did: those that did something. */
void stress_saw_fasts(uint64_t *seen, uint32_t fasts, uint32_t did);

#define STRESS_TRIS 32u
#define STRESS_PX 64 /* frames are at least as wide and high */

/* Run one case and add to *c. 1; 0 after a sentence on stderr: what was drawn is wrong. */
typedef int stress_fn(uint64_t seed, struct stress_counts *c);

/* A frame of thousands of snapped triangles, each against whole numbers. */
int stress_tris(uint64_t seed, struct stress_counts *c);
/* Eight frames of a random scene that moves, each drawn the plainest way and eight others. */
int stress_frames(uint64_t seed, struct stress_counts *c);

/* Say what is wrong with a case; always 0. */
#define stress_wrong(...) wrong_said("\n", __VA_ARGS__)

#endif
