/* Pictures and raw buffers into streams.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_IMAGE_H
#define SIM_IMAGE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* RGB565 to three 8-bit channels by repeating the bits: 31 and 63 become 255, nothing is lost. */
void sim_rgb565_expand(uint8_t rgb[3], uint16_t c);

/* n pixels to a malloc'ed [n][3]. */
uint8_t *sim_rgb565_to_rgb8(const uint16_t *px, size_t n);

/* Write a PNG of 8-bit RGB, rgb: [height][width][3]. */
int sim_png_write(FILE *f, const char *name, uint32_t width, uint32_t height, const uint8_t *rgb);

/* The same into a file, whole or not at all; and from RGB565. */
int sim_png_save(const char *path, uint32_t width, uint32_t height, const uint8_t *rgb);
int sim_png_save_565(const char *path, uint32_t width, uint32_t height, const uint16_t *px);

/* Binary PGM, maxval 65535, most significant byte first; and uint32 least significant byte first.
 * Errors show in ferror(f). */
void sim_pgm_write(FILE *f, uint32_t width, uint32_t height, const uint16_t *value);
void sim_u32_write(FILE *f, const uint32_t *value, size_t n);

/* The first two return SIM_OK or, having said why about `name` or `path`, SIM_REFUSED. */

#endif
