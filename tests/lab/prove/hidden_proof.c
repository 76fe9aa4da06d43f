/* tiles.c: slopes, keys. Its sides and its boxes are facts.c's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "fast/tiles.c"

#define SPAN_MAX (((int32_t)1 << ZS_EXTENT_BITS) - 1)

static struct zs_renderer renderer;
static struct zs_cover cover;

static void slope_of(int32_t lo, int32_t hi)
{
    const struct zs_vertex a = { 0, 0, 0 }, b = { any_i32(lo, hi), any_i32(0, SPAN_MAX), 0 };
    slope(&cover, LONG, &a, &b);
    ASSERT(cover.shift[LONG] >= 8 && cover.shift[LONG] <= 12);
    ASSERT(cover.slope[LONG] >= -(1 << 30) && cover.slope[LONG] <= 1 << 30);
}

/* PROVE slopes: every |dx| < 2^22 by octave and sign, every dy of 0 .. 2^22 - 1: shifts 8 .. 12, slopes up to 2^30 */
void slopes(void)
{
    slope_of(0, 0);
    for (int k = 0; k < ZS_EXTENT_BITS; k++) {
        slope_of((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k));
        slope_of(-(int32_t)OCTAVE_HI(k), -(int32_t)OCTAVE_LO(k));
    }
}

/* PROVE bound_keys: every depth, a margin added or not or taken off, 8 .. 16 bits: a key below the one that keys
 * saturate at */
void bound_keys(void)
{
    static const struct zs_depth depth = { 0 };
    renderer.view.depth = &depth;
    for (uint32_t bits = 8; bits <= 16; bits++)
        for (int32_t add = -MARGIN; add <= MARGIN; add += MARGIN) {
            const uint32_t top = ((1u << bits) - 1u) << 16;
            renderer.view.key_top = top;
            ASSERT(key_of(&renderer, any_u32(0, top), add) <= (top >> 16) - 1u);
        }
}
