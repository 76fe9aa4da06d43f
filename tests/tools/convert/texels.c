/* A program around a converted picture, NAME m, of a formula in paint.h: is it that picture?
 *
 *     texels KIND W H     KIND as in make png; W, H: its size
 *
 * Prints "exact" where every texel is the picture's RGB565 value, else "near"; PSNR and worst
 * channel error against the picture at the texture's size; and the same of the means of blocks of 8
 * x 8 texels; the number of levels, and the least PSNR of one.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>

#include "m.h"
#include "paint.h"
#include "zs_check.h"

static uint16_t texel(const struct zs_texture *t, uint32_t x, uint32_t y)
{
    const uint32_t at = (y << t->log2_w) + x;
    const uint8_t *index = t->texel;
    if (t->format == &zs_texel_565)
        return ((const uint16_t *)t->texel)[at];
    return t->palette[t->format == &zs_texel_pal8 ? index[at] : index[at / 2] >> at % 2 * 4 & 15];
}

/* A channel of the picture, where a texel covers whole pixels: their mean. */
static double wanted(const char *kind, uint32_t w, uint32_t h, const struct zs_texture *t,
                     uint32_t x, uint32_t y, int c)
{
    const uint32_t across = w >> t->log2_w, down = h >> t->log2_h;
    double sum = 0.0;
    for (uint32_t i = 0; i < across * down; i++) {
        uint8_t rgb[3];
        paint(kind, x * across + i % across, y * down + i / across, w, h, rgb);
        sum += rgb[c];
    }
    return floor(sum / (across * down) + 0.5);
}

static double have(uint16_t v, int c)
{
    return c == 0   ? (v >> 11) * 255.0 / 31.0
           : c == 1 ? (v >> 5 & 63) * 255.0 / 63.0
                    : (v & 31) * 255.0 / 31.0;
}

/* The least PSNR of a coarser level against means of the picture's pixels, dB; 99 without levels. */
static double of_levels(const char *kind, uint32_t w, uint32_t h, struct zs_texture t)
{
    double least = 99.0;
    for (uint32_t level = 1; level < t.n_levels; level++) {
        const uint32_t n = 1u << (t.log2_w + t.log2_h);
        const uint32_t bytes = t.format == &zs_texel_565 ? 2 * n : t.format == &zs_texel_pal8 ? n : n / 2;
        t.texel = (const uint8_t *)t.texel + bytes;
        t.log2_w--;
        t.log2_h--;
        double squared = 0.0;
        for (uint32_t i = 0; i < n / 4; i++)
            for (int k = 0; k < 3; k++) {
                const uint32_t x = i & ((1u << t.log2_w) - 1u), y = i >> t.log2_w;
                const double off = wanted(kind, w, h, &t, x, y, k) - have(texel(&t, x, y), k);
                squared += off * off;
            }
        least = fmin(least, 10.0 * log10(65025.0 * 3.0 * n / 4.0 / fmax(squared, 1e-9)));
    }
    return least;
}

int main(int argc, char **argv)
{
    const struct zs_texture *t = &m_texture[0];
    const uint32_t w = argc > 3 ? (uint32_t)atoi(argv[2]) : 1,
                   h = argc > 3 ? (uint32_t)atoi(argv[3]) : 1;
    const uint32_t tw = 1u << t->log2_w, th = 1u << t->log2_h;
    uint32_t at = 0;
    int exact = 1;
    double squared = 0.0, worst = 0.0, block = 0.0;
    if (argc != 4 || zs_texture_check(t, &at) != ZS_FLAW_NONE || tw > w || th > h) {
        printf("wrong: flaw %s, %u\n", zs_flaw_string(zs_texture_check(t, &at)), at);
        return 1;
    }
    for (uint32_t y = 0; y < th; y++)
        for (uint32_t x = 0; x < tw; x++) {
            double c[3];
            for (int k = 0; k < 3; k++) {
                c[k] = wanted(argv[1], w, h, t, x, y, k);
                const double off = fabs(c[k] - have(texel(t, x, y), k));
                squared += off * off;
                worst = fmax(worst, off);
            }
            exact =
                exact && texel(t, x, y) == zs_rgb565((uint8_t)c[0], (uint8_t)c[1], (uint8_t)c[2]);
        }
    for (uint32_t y = 0; y + 8 <= th; y += 8)
        for (uint32_t x = 0; x + 8 <= tw; x += 8)
            for (int k = 0; k < 3; k++) {
                double sum = 0.0;
                for (uint32_t i = 0; i < 64; i++)
                    sum += wanted(argv[1], w, h, t, x + i % 8, y + i / 8, k) -
                           have(texel(t, x + i % 8, y + i / 8), k);
                block += sum / 64.0 * (sum / 64.0);
            }
    printf("%s %.1f %.0f %.1f %u %.1f\n", exact ? "exact" : "near",
           10.0 * log10(65025.0 * 3.0 * tw * th / squared), ceil(worst),
           10.0 * log10(65025.0 * 3.0 * (tw / 8) * (th / 8) / block), t->n_levels,
           of_levels(argv[1], w, h, *t));
    return 0;
}
