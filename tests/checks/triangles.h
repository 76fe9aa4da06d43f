/* Random triangles for programs that hold code in assembler against the same in C. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef CHECKS_TRIANGLES_H
#define CHECKS_TRIANGLES_H

#include "zs_renderer.h"

/* Xorshift, 32 bits. */
static inline uint32_t next(void)
{
    static uint32_t state = 2463534242u;
    state ^= state << 13;
    state ^= state >> 17;
    return state ^= state << 5;
}

/* -most .. most */
static inline int32_t within(int32_t most)
{
    return (int32_t)(next() % (2u * (uint32_t)most + 1u)) - most;
}

/* A triangle of up to `extent` sub-pixels, a power of two, from its top corner at (x, y), clockwise, with depths that
 * differ from `key` by up to 2^steep. */
static inline void random_triangle(struct zs_vertex v[3], int32_t x, int32_t y, int32_t extent, uint32_t key,
                                   uint32_t steep)
{
    v[0].x = x;
    v[0].y = y;
    for (int k = 1; k < 3; k++) {
        v[k].x = x + within(extent);
        v[k].y = y + (within(extent) & (extent - 1));
    }
    for (int k = 0; k < 3; k++)
        v[k].d = key ^ next() >> (32u - steep);
    const int64_t area = (int64_t)(v[1].x - x) * (v[2].y - y) - (int64_t)(v[2].x - x) * (v[1].y - y);
    if (area < 0) {
        const struct zs_vertex b = v[1];
        v[1] = v[2];
        v[2] = b;
    }
}

#endif
