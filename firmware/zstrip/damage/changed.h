/* Hashes for damage tracking: of pixels (damage/strip_sums.c) and of scene data (damage/track.c).
 * Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CHANGED_H
#define ZS_CHANGED_H

#include "zs_damage.h"

#define ZS_LANES                                                                                   \
    {                                                                                              \
        0x243f6a88u, 0x85a308d3u                                                                   \
    } /* the initial value of a hash */

static inline uint32_t zs_rotate_left(uint32_t v, int n)
{
    return v << n | v >> (32 - n);
}

/* Add a value to a hash of 64 bits, two lanes of 32. Each step is a bijection of the lane for a
 * given value, and of the value for a given lane. So two sets of data that differ in a single value
 * always have different hashes. */
static inline void zs_mix(uint32_t lane[2], uint32_t v)
{
    lane[0] = zs_rotate_left(lane[0] ^ v, 13) * 0x9e3779b1u;
    lane[1] = zs_rotate_left(lane[1] + v, 19) * 0x85ebca77u;
}

/* Mark what a sink has failed to send as changed: zs_renderer.unsent. */
void zs_unsent(struct zs_renderer *r, const struct zs_strip *last);

/* The width of a cell of zs_damage_compare, px. It is even if the frame's width is, so that cells
 * begin at even addresses. */
static inline uint32_t zs_strip_hash_step(const struct zs_renderer *r)
{
    const uint32_t w = (r->config.width + r->sums->columns - 1u) / r->sums->columns;
    return r->config.width & 1u ? w : (w + 1u) & ~1u;
}

/* Return 1 if strip s intersects the rows of rect. NULL: every strip does. */
static inline int zs_strip_in(const struct zs_renderer *r, uint32_t s, const struct zs_rect *rect)
{
    const uint32_t y0 = s * r->config.strip_h, y1 = y0 + r->config.strip_h;
    return !rect || (y1 > rect->y && y0 < (uint32_t)rect->y + rect->h);
}

#endif
