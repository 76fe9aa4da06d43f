/* The texture builder: an image, what is drawn into it, and its formats as C.
 *
 * SPDX-License-Identifier: MIT
 */
#include "font.h"
#include "gen.h"
#include "out.h"

#include <string.h>

#define COLORS_MAX 256u

static struct gen_image image;

/* ---- Drawing --------------------------------------------------------------------------------- */

static int is_size(int64_t n)
{
    return n >= 2 && n <= GEN_IMAGE_MAX && (n & (n - 1)) == 0;
}

struct gen_image *gen_image(const char *name, int64_t w, int64_t h)
{
    if (!is_size(w) || !is_size(h))
        out_die("a size that is no power of two, or too large", name);
    memset(&image, 0, sizeof image);
    image.name = name;
    image.w = w;
    image.h = h;
    return &image;
}

void gen_dot(struct gen_image *im, int64_t x, int64_t y, struct gen_rgb rgb)
{
    im->px[y & (im->h - 1)][x & (im->w - 1)] = rgb;
}

void gen_box(struct gen_image *im, int64_t x, int64_t y, int64_t w, int64_t h, struct gen_rgb rgb)
{
    for (int64_t j = 0; j < h; j++)
        for (int64_t i = 0; i < w; i++)
            gen_dot(im, x + i, y + j, rgb);
}

void gen_paint(struct gen_image *im, struct gen_rgb (*at)(int64_t x, int64_t y))
{
    for (int64_t y = 0; y < im->h; y++)
        for (int64_t x = 0; x < im->w; x++)
            gen_dot(im, x, y, at(x, y));
}

void gen_text(struct gen_image *im, int64_t x, int64_t y, int64_t wide, int64_t high,
              const char *text, struct gen_rgb rgb)
{
    for (; *text; text++, x += (FONT_W + 1) * wide) {
        const uint8_t *rows = font_rows(*text);
        if (!rows)
            out_die("a letter that the font does not have", im->name);
        for (int64_t j = 0; j < FONT_H; j++)
            for (int64_t i = 0; i < FONT_W; i++)
                if (rows[j] >> (FONT_W - 1 - i) & 1)
                    gen_box(im, x + i * wide, y + j * high, wide, high, rgb);
    }
}

/* ---- Output ---------------------------------------------------------------------------------- */

struct palette {
    uint16_t color[2 * COLORS_MAX]; /* RGB565, in the order of their first texel */
    uint8_t alpha[COLORS_MAX];
    uint32_t n;
};

static uint32_t palette_index(struct palette *p, uint16_t color, uint8_t alpha, uint32_t most, const char *name)
{
    for (uint32_t i = 0; i < p->n; i++)
        if (p->color[i] == color && p->alpha[i] == alpha)
            return i;
    if (p->n == most)
        out_die("more colours than its format's palette holds", name);
    p->color[p->n] = color;
    p->alpha[p->n] = alpha;
    return p->n++;
}

static void write_words(FILE *f, const char *name, const uint16_t *words, uint32_t n)
{
    struct out_rows r = out_array(f, "uint16_t", name, n, "");
    char text[16];
    for (uint32_t i = 0; i < n; i++) {
        snprintf(text, sizeof text, "0x%04x,", words[i]);
        out_row(&r, text);
    }
    out_array_end(&r);
}

static uint16_t texel(const struct gen_image *im, int64_t i)
{
    return out_rgb565(im->px[i / im->w][i % im->w]);
}

/* 0 where the format has no alpha. */
static uint8_t texel_alpha(const struct gen_image *im, int64_t i, enum gen_format format)
{
    return format == GEN_PAL8A ? im->alpha[i / im->w][i % im->w] : 0;
}

/* The mean of the square of 4^level texels whose left top corner in its level is column x, row y. */
static struct gen_rgb mean(const struct gen_image *im, int64_t x, int64_t y, uint32_t level)
{
    const int64_t side = (int64_t)1 << level;
    int64_t r = 0, g = 0, b = 0;
    for (int64_t j = 0; j < side; j++)
        for (int64_t i = 0; i < side; i++) {
            const struct gen_rgb *px = &im->px[y * side + j][x * side + i];
            r += px->r;
            g += px->g;
            b += px->b;
        }
    const struct gen_rgb out = { (uint8_t)gen_div(r, side * side), (uint8_t)gen_div(g, side * side),
                                 (uint8_t)gen_div(b, side * side) };
    return out;
}

/* All levels, one behind the other. Return how many texels. */
static uint32_t write_direct(FILE *f, const struct gen_image *im)
{
    static uint16_t words[GEN_IMAGE_MAX * GEN_IMAGE_MAX * 4 / 3 + 1];
    uint32_t n = 0;
    for (uint32_t level = 0; level == 0 || level < im->n_levels; level++)
        for (int64_t y = 0; y < im->h >> level; y++)
            for (int64_t x = 0; x < im->w >> level; x++)
                words[n++] = out_rgb565(mean(im, x, y, level));
    write_words(f, "texel", words, n);
    return n;
}

/* Indices of `bits` bits, the left one in the low bits of a byte. */
static void write_indices(FILE *f, const struct gen_image *im, struct palette *p, uint32_t bits, enum gen_format format)
{
    const uint32_t in_byte = 8u / bits, n = (uint32_t)(im->w * im->h) / in_byte;
    struct out_rows r = out_array(f, "uint8_t", "texel", n, "");
    char text[16];
    for (uint32_t i = 0; i < n; i++) {
        uint32_t byte = 0;
        for (uint32_t k = 0; k < in_byte; k++)
            byte |= palette_index(p, texel(im, (int64_t)i * in_byte + k),
                                  texel_alpha(im, (int64_t)i * in_byte + k, format), 1u << bits, im->name)
                    << (k * bits);
        snprintf(text, sizeof text, "%lu,", (unsigned long)byte);
        out_row(&r, text);
    }
    out_array_end(&r);
}

static unsigned long log2_of(int64_t v)
{
    unsigned long log2 = 0;
    while (v >> log2 > 1)
        log2++;
    return log2;
}

void gen_texture(const struct gen_image *im, enum gen_format format, enum gen_clamp clamp)
{
    static const char *const names[] = { "565", "pal8", "pal4", "pal8a" };
    const uint32_t bits = format == GEN_565 ? 16u : format == GEN_PAL4 ? 4u : 8u;
    struct palette p = { { 0 }, { 0 }, 0 };
    char name[64], size[64];
    snprintf(name, sizeof name, "texture_%s", im->name);
    FILE *f = out_begin(name);
    uint32_t words = 0; /* of the palette; alphas follow the colours */
    uint32_t n = (uint32_t)(im->w * im->h);
    if (format == GEN_565) {
        n = write_direct(f, im);
    } else {
        write_indices(f, im, &p, bits, format);
        words = format == GEN_PAL8A ? 2u * p.n : p.n;
        for (uint32_t i = p.n; i < words; i++)
            p.color[i] = p.alpha[i - p.n];
        write_words(f, "palette", p.color, words);
    }
    const uint32_t bytes = n * bits / 8u + 2u * words;
    fprintf(f, "\n/* %lu bytes of flash. */\nconst struct zs_texture %s = {\n",
            (unsigned long)bytes, name);
    fprintf(f, "    .format = &zs_texel_%s,\n", names[format]);
    out_field(f, "texel");
    if (p.n) {
        out_field(f, "palette");
        fprintf(f, "    .n_colors = %lu,\n", (unsigned long)p.n);
    }
    if (im->n_levels)
        fprintf(f, "    .n_levels = %lu,\n", (unsigned long)im->n_levels);
    fprintf(f, "    .log2_w = %lu,\n    .log2_h = %lu,\n    .clamp = %d,\n};\n", log2_of(im->w),
            log2_of(im->h), (int)clamp);
    snprintf(size, sizeof size, "%ld x %ld texels, %s", (long)im->w, (long)im->h, names[format]);
    out_declare("zs_texture", "texture", im->name, size, bytes);
}
