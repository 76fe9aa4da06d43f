/* FNV-1a, 32 bits, over a strip's pixels: whether they change while they are lent.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_STRIP_SUM_H
#define SIM_STRIP_SUM_H

#include "zstrip.h"

static inline uint32_t sim_strip_sum(const struct zs_strip *strip)
{
    uint32_t h = 2166136261u;
    for (uint32_t i = 0; i < strip->n_bytes; i++)
        h = (h ^ strip->px[i]) * 16777619u;
    return h;
}

#endif
