/* An easel for the rasterizer alone: snapped triangles in, pixels out, by the same strips as a
 * scene's.
 *
 * Fills the pools and bins of a renderer whose scene is empty, then asks for the strips.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_EASEL_H
#define TESTS_EASEL_H

#include <stdint.h>

#include "zstrip.h"

struct easel_tri {
    int32_t x[3], y[3];  /* 1/256 px, at most ZS_GUARD_PX px from the frame's middle */
    uint32_t d[3];       /* key in uq16_16; linear under perspective: z in camera units */
    uint16_t rgb[3][3];  /* smooth: uq0_16, [corner][channel] */
};

struct easel {
    int32_t width, height, strip_h;
    const struct zs_depth *depth;
    int32_t depth_bits;
    int32_t z_near, z_far; /* world units; the camera unit is 2^-shift of them */
    int smooth;             /* 0: triangle k is drawn in the colour k + 1; 1: Gouraud */
};

struct easel_frame {
    uint16_t *color;   /* [height][width], RGB565; 0 where nothing was drawn, or k + 1 */
    uint16_t *key;     /* [height][width] */
    uint32_t tested, written;
    int32_t unit_near, shift; /* of the camera unit */
    double key_far;    /* recip: key of z at infinity, buckets */
};

/* Reciprocal keys of 16 bits, near 256 and far 2^20 world units, one strip. */
struct easel easel_default(int32_t width, int32_t height);
/* Draw n <= 20000 triangles. Aborts on an error of the library: an easel is always valid. */
void easel_draw(const struct easel *s, const struct easel_tri *t, uint32_t n,
                struct easel_frame *out);
void easel_free(struct easel_frame *f);

#endif
