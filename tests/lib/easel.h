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

#include "oracle.h"
#include "zstrip.h"

struct easel_tri {
    int32_t x[3], y[3]; /* 1/256 px, at most ZS_GUARD_PX px from the frame's middle */
    uint32_t d[3];      /* key in uq16_16; linear under perspective: z in camera units */
    uint16_t rgb[3][3]; /* [corner]. smooth: channels, uq0_16; textured: see EASEL_UV */
    uint32_t state;     /* 0: none; k: the easel's state[k - 1]; not read where that has none */
};

/* Textured: rgb[corner] is u, v in 2^-uv_bits of the texture, an int16 each, and with smooth light
 * an intensity in uq1_15. */
#define EASEL_UV(uv) ((uint16_t)((uv) + 32768))
#define EASEL_LIGHT_ONE 32768u

struct easel {
    int32_t width, height, strip_h;
    const struct zs_depth *depth;
    int32_t depth_bits;
    int32_t z_near, z_far; /* world units; the camera unit is 2^-shift of them */
    int smooth; /* 0: triangle k is drawn in the colour k + 1, or unlit; 1: Gouraud, or lit by
                   the intensities of the corners */
    const struct zs_texture *texture; /* NULL: none */
    int32_t uv_bits;
    const struct zs_depth_state *state; /* [n_states] */
    uint32_t n_states;
    int lit;     /* 1: a texture is lit by the first corner's intensity; not with smooth */
    const struct zs_fast *const *fast; /* accelerators, as zs_config.fast */
};

#define EASEL_STATES_MAX 16u

struct easel_frame {
    uint16_t *color; /* [height][width], RGB565; 0 where nothing was drawn, or k + 1 */
    uint16_t *key;   /* [height][width] */
    uint32_t tested, written, setups;
    uint32_t at_once;        /* triangles in strips that zs_fast.draw has drawn */
    int32_t unit_near, shift; /* of the camera unit */
    double key_far;           /* recip: key of z at infinity, buckets; exact */
};

/* Reciprocal keys of 16 bits, near 256 and far 2^20 world units, one strip, all accelerators. */
struct easel easel_default(int32_t width, int32_t height);
/* Draw n <= 20000 triangles. Aborts on an error of the library: an easel is always valid. */
void easel_draw(const struct easel *s, const struct easel_tri *t, uint32_t n,
                struct easel_frame *out);
void easel_free(struct easel_frame *f);
/* 1 / z of a corner up to a factor that all corners of the triangle share, exactly what its d says:
 * a whole number, 1 .. 2^60. */
int64_t easel_inverse(const struct easel *s, const struct easel_frame *f, const uint32_t d[3],
                      int k);
/* Exponent bits of a float mapping, 0 of another. */
int easel_float_bits(const struct zs_depth *depth);

/* The triangle as the oracle has it. */
struct oracle_tri easel_oracle(const struct easel_tri *t);

#endif
