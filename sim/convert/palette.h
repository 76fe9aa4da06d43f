/* Few colours for an image: palettes of RGB565 values, and texels.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PALETTE_H
#define SIM_PALETTE_H

#include <stdint.h>

#define SIM_PALETTE_MAX 256u

/* 8-bit pixels, row-major, dense. Borrowed. */
struct sim_pixels {
    uint32_t w, h;
    const uint8_t (*rgb)[3]; /* [h][w] */
};

/* Choose at most `most` (1 .. SIM_PALETTE_MAX) different RGB565 values for an image, ascending.
 * Where the image rounded to RGB565 has no more than that, they are exactly those. A function of
 * the pixels alone. Return  how many were chosen. */
uint32_t sim_palette_build(uint16_t palette[SIM_PALETTE_MAX], uint32_t most,
                           const struct sim_pixels *image);

/* Each pixel's nearest palette entry (plain RGB; the first of several), to [h][w]. dither: carry
 * what is lost on to the neighbours (Floyd and Steinberg, rows in turn from the left and from the
 * right). */
void sim_palette_map(uint8_t *index, const struct sim_pixels *image, const uint16_t *palette,
                     uint32_t n_colors, int dither);

/* The same with all of RGB565 to choose from. */
void sim_rgb565_map(uint16_t *out, const struct sim_pixels *image, int dither);

/* How far RGB565 values are from an image, over all channels: peak signal-to-noise ratio in dB
 * (infinite: equal) and the largest difference of a channel, of 255. */
struct sim_loss {
    double psnr_db, worst;
};
struct sim_loss sim_rgb565_loss(const struct sim_pixels *image, const uint16_t *have);

#endif
