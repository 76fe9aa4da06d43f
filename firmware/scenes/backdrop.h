/* Backgrounds that cost little: between two colours, dithered, so that no bands show. For zs_scene.sky.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef BACKDROP_H
#define BACKDROP_H

#include "scenes.h"

#define BACKDROP_SHADES 64u

struct backdrop {
    uint16_t shade[BACKDROP_SHADES + 4u]; /* from one colour to the other */
    int32_t level, dx, dy; /* a sky: the level at pixel (0, 0), and its change by a pixel, q16; 0 .. 255 is used */
    int32_t x, y, step, fall; /* a glow: its middle, px; 1/64 unit to a pixel; how steeply it falls, units^-2, q11 */
};

void backdrop_colors(struct backdrop *b, struct zs_rgb from, struct zs_rgb to);

/* A sky: `from` up to the horizon, `to` from 35 degrees above it on, straight lines between them. Fill is
 * backdrop_sky_fill.
 * viewport  the pass's
 * mirror    its normal (zs_mirror.normal), or NULL */
void backdrop_sky(struct backdrop *b, const struct zs_camera *camera, const struct zs_rect *viewport,
                  const zs_q2_30 *mirror);
void backdrop_sky_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n);

/* A glow: `to` around the point x / 16, y / 16 of a picture of w x h px, `from` far from it. */
void backdrop_glow(struct backdrop *b, uint16_t w, uint16_t h, uint8_t x, uint8_t y, uint8_t fall);
void backdrop_glow_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n);

#endif
