/* Pictures and raw buffers into streams, and pictures out of files.
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

/* The same into a file, whole or not at all. */
int sim_png_save(const char *path, uint32_t width, uint32_t height, const uint8_t *rgb);

/* What is seen, and the values that it is made of. */
struct sim_picture {
    uint32_t width, height; /* px */
    uint8_t *rgb;           /* [height][width][3]; malloc'ed, and so is raw */
    uint16_t *raw;          /* [height][width]: RGB565, grey levels or bits */
    uint8_t raw_bytes;      /* that one of them takes in a file: 2, or 1 for levels and bits */
};

/* From RGB565, copied. */
void sim_picture_565(struct sim_picture *p, uint32_t width, uint32_t height, const uint16_t *px);
void sim_picture_free(struct sim_picture *p);

/* Into a PNG, and its values, row by row, most significant byte first, into a second file (NULL: not wanted); both
 * whole, or none. */
int sim_picture_save(const struct sim_picture *p, const char *png, const char *raw);

/* Binary PGM, maxval 65535, most significant byte first; and uint32 least significant byte first.
 * Errors show in ferror(f). */
void sim_pgm_write(FILE *f, uint32_t width, uint32_t height, const uint16_t *value);
void sim_u32_write(FILE *f, const uint32_t *value, size_t n);

/* Values of 1 or 2 bytes, most significant first. Errors likewise. */
void sim_values_write(FILE *f, const uint16_t *value, size_t n, int n_bytes);

/* A picture from a file. */
struct sim_image {
    uint32_t width, height; /* px, 1 .. SIM_IMAGE_MAX */
    uint8_t (*rgb)[3];      /* [height][width], rows from the top; malloc'ed */
    uint8_t *alpha;         /* [height][width], likewise; NULL: 255 everywhere */
};

#define SIM_IMAGE_MAX 16384 /* px each way; and no more than 2^27 in all */

/* Decode a PNG (any kind; 16-bit channels are rounded; colours stay as they are where an alpha
 * channel hides them) or a JPEG (not CMYK; its orientation tag is not followed). Bytes
 * that are cut off or broken are refused whole.
 * name      for messages.
 * as_it_is  flag: what a PNG says of its gamma and profile is passed over, as glTF wants it.
 * Return    SIM_OK; SIM_REFUSED, said why, *out empty. sim_image_free in either case. */
int sim_image_decode(struct sim_image *out, const char *name, const void *bytes, size_t n, int as_it_is);

/* The same from a file. */
int sim_image_load(struct sim_image *out, const char *path, int as_it_is);
void sim_image_free(struct sim_image *image);

/* sim_png_write, sim_png_save and sim_picture_save return SIM_OK or, having said why about the file, SIM_REFUSED. */

#endif
