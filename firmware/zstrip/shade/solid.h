/* Kernels for a colour a face, shared by raw and flat shading. Internal.
 *
 * Pixel: key = sum >> 16, compare, store both, add. Nothing is divided and nothing is 64 bits wide.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_SOLID_H
#define ZS_SHADE_SOLID_H

#include "core/rows.h"

/* From a pixel's depth to its colour: so that one pointer is walked, not two. */
static inline uintptr_t zs_solid_beside(const struct zs_job *job)
{
    return (uintptr_t)job->color - (uintptr_t)job->depth;
}

/* n > 0 pixels. sum modulo 2^32: at covered pixels key + 1/2 bucket, in [0, 2^32) (plane.c). Return how many are
 * written, where that is counted. */
ZS_ALWAYS_INLINE int32_t zs_solid_pixels(uint16_t *depth, uintptr_t beside, int32_t n, uint32_t sum, uint32_t gx,
                                      uint16_t paint, uint32_t top, int clamp)
{
    const uint16_t *const end = depth + n;
    int32_t written = 0;
    do {
        uint32_t key = sum >> 16;
        if (clamp && key > top)
            key = top;
        if (key < *depth) {
            *depth = (uint16_t)key;
            *(uint16_t *)((uintptr_t)depth + beside) = paint;
            if (ZS_STATS)
                written++;
        }
        sum += gx;
    } while (++depth != end);
    return written;
}

void zs_solid_rows(struct zs_job *job);
int zs_small_draw(struct zs_job *job); /* small.c: zs_shader.small */
void zs_solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                   uint32_t gx);
void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

#endif
