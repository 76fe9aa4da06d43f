/* PNG by libpng's simplified interface; PGM and raw by hand.
 *
 * SPDX-License-Identifier: MIT
 */
#include "image.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "output.h"
#include "sim.h"

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

int sim_png_write(FILE *f, const char *name, uint32_t width, uint32_t height, const uint8_t *rgb)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_stdio(&image, f, 0, rgb, 0, NULL))
        return SIM_OK;
    const int status = sim_refuse(name, 0, "cannot be written: %s", image.message);
    png_image_free(&image);
    return status;
}

int sim_png_save(const char *path, uint32_t width, uint32_t height, const uint8_t *rgb)
{
    struct sim_output out;
    int status = sim_output_open(&out, path);
    if (status != SIM_OK)
        return status;
    status = sim_png_write(out.file, path, width, height, rgb);
    if (status == SIM_OK)
        return sim_output_commit(&out, 1);
    sim_output_abort(&out);
    return status;
}

int sim_png_save_565(const char *path, uint32_t width, uint32_t height, const uint16_t *px)
{
    uint8_t *rgb = sim_rgb565_to_rgb8(px, (size_t)width * height);
    const int status = sim_png_save(path, width, height, rgb);
    free(rgb);
    return status;
}

void sim_pgm_write(FILE *f, uint32_t width, uint32_t height, const uint16_t *value)
{
    (void)fprintf(f, "P5\n%lu %lu\n65535\n", (unsigned long)width, (unsigned long)height);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        (void)putc(value[i] >> 8, f);
        (void)putc(value[i] & 255, f);
    }
}

void sim_u32_write(FILE *f, const uint32_t *value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (int shift = 0; shift < 32; shift += 8)
            (void)putc((int)(value[i] >> shift & 255u), f);
}
