/* The checksum of a frame's pixels or keys that tests/records has: FNV-1a, 64 bits, most significant byte first.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef FRAME_SUM_H
#define FRAME_SUM_H

#include <stddef.h>
#include <stdint.h>

static inline uint64_t frame_sum(const uint16_t *at, size_t n)
{
    uint64_t sum = 0xcbf29ce484222325u;
    for (size_t i = 0; i < n; i++) {
        sum = (sum ^ at[i] >> 8) * 0x100000001b3u;
        sum = (sum ^ (at[i] & 255u)) * 0x100000001b3u;
    }
    return sum;
}

#endif
