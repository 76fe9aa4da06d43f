/* Pictures in memory; PGM and raw values by hand.
 *
 * SPDX-License-Identifier: MIT
 */
#include "image.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

void sim_image_free(struct sim_image *image)
{
    free(image->rgb);
    free(image->alpha);
    memset(image, 0, sizeof *image);
}

void sim_rgb565_expand(uint8_t rgb[3], uint16_t c)
{
    const unsigned r = c >> 11, g = c >> 5 & 63u, b = c & 31u;
    rgb[0] = (uint8_t)(r << 3 | r >> 2);
    rgb[1] = (uint8_t)(g << 2 | g >> 4);
    rgb[2] = (uint8_t)(b << 3 | b >> 2);
}

uint8_t *sim_rgb565_to_rgb8(const uint16_t *px, size_t n)
{
    uint8_t *rgb = sim_alloc(n, 3);
    for (size_t i = 0; i < n; i++)
        sim_rgb565_expand(rgb + 3 * i, px[i]);
    return rgb;
}

void sim_picture_565(struct sim_picture *p, uint32_t width, uint32_t height, const uint16_t *px)
{
    const size_t n = (size_t)width * height;
    *p = (struct sim_picture){ width, height, sim_rgb565_to_rgb8(px, n), sim_alloc(n, sizeof *px), 2 };
    memcpy(p->raw, px, n * sizeof *px);
}

void sim_picture_free(struct sim_picture *p)
{
    free(p->rgb);
    free(p->raw);
    memset(p, 0, sizeof *p);
}

/* Values of 1 or 2 bytes, most significant first. */
void sim_values_write(FILE *f, const uint16_t *value, size_t n, int n_bytes)
{
    for (size_t i = 0; i < n; i++) {
        if (n_bytes == 2)
            (void)putc(value[i] >> 8, f);
        (void)putc(value[i] & 255, f);
    }
}

void sim_pgm_write(FILE *f, uint32_t width, uint32_t height, const uint16_t *value)
{
    (void)fprintf(f, "P5\n%lu %lu\n65535\n", (unsigned long)width, (unsigned long)height);
    sim_values_write(f, value, (size_t)width * height, 2);
}

void sim_u32_write(FILE *f, const uint32_t *value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (int shift = 0; shift < 32; shift += 8)
            (void)putc((int)(value[i] >> shift & 255u), f);
}
