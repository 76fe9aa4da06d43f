/* Makes pictures for tests/tools/cli_texture.sh. Shares no code with zsim.
 *
 *   fixture png KIND F.png W H COLOUR...   rows from the top, colours RRGGBB (RRGGBBAA: rgba), from
 *                                          the first again where there are too few; KIND: rgb,
 *                                          rgba, gray, gray16, rgb16, pal, bit, adam7
 *   fixture jpg F.jpg W H COLOUR...        quality 100, colours not subsampled
 *   fixture cmyk F.jpg W H
 *   fixture numbers F.png                  64 x 64: red 5 bits and blue say the column, green 6 the row
 *
 * SPDX-License-Identifier: MIT
 */
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

static const struct kind {
    const char *name;
    int depth, type, interlace, bytes; /* bytes a pixel; 0: one bit */
} kinds[] = {
    { "rgb", 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, 3 },
    { "rgba", 8, PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, 4 },
    { "gray", 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, 1 },
    { "gray16", 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, 2 },
    { "rgb16", 16, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, 6 },
    { "pal", 8, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, 1 },
    { "bit", 1, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, 0 },
    { "adam7", 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7, 3 },
};

/* One pixel of a row; i: which colour of the list it is. */
static void put(uint8_t *row, const struct kind *k, uint32_t x, const uint8_t rgba[4], uint32_t i)
{
    uint8_t *to = row + (size_t)x * (size_t)k->bytes;
    if (k->bytes == 0)
        row[x / 8] |= (uint8_t)(rgba[0] >> 7 << (7 - x % 8));
    else if (k->type == PNG_COLOR_TYPE_PALETTE)
        to[0] = (uint8_t)i;
    else
        for (int b = 0; b < k->bytes; b++)
            to[b] = rgba[k->depth == 16 ? b / 2 : b]; /* 16 bits: the byte twice */
}

static void parse(uint8_t rgba[4], const char *hex)
{
    const unsigned long long v = strtoull(hex, NULL, 16) << (strlen(hex) == 8 ? 0 : 8);
    for (int c = 0; c < 4; c++)
        rgba[c] = (uint8_t)(v >> (24 - 8 * c));
}

static const struct kind *find(const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return &kinds[i];
    exit(1);
}

static int write_png(const struct kind *k, const char *file, uint32_t w, uint32_t h, char **color,
                     int n)
{
    FILE *f = fopen(file, "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    if (f == NULL || png == NULL || setjmp(png_jmpbuf(png)) != 0)
        return 1;
    png_init_io(png, f);
    png_set_IHDR(png, info, w, h, k->depth, k->type, k->interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (k->type == PNG_COLOR_TYPE_PALETTE) {
        png_color palette[256] = { { 0 } };
        for (int i = 0; i < n; i++) {
            uint8_t c[4];
            parse(c, color[i]);
            palette[i] = (png_color){ c[0], c[1], c[2] };
        }
        png_set_PLTE(png, info, palette, n);
    }
    uint8_t **row = calloc(h, sizeof *row);
    for (uint32_t y = 0; y < h; y++) {
        row[y] = calloc(w + 1, 8);
        for (uint32_t x = 0; x < w; x++) {
            const uint32_t i = (y * w + x) % (uint32_t)n;
            uint8_t c[4];
            parse(c, color[i]);
            put(row[y], k, x, c, i);
        }
    }
    png_write_info(png, info);
    png_write_image(png, row);
    png_write_end(png, NULL);
    return fclose(f);
}

static int write_jpeg(const char *file, int w, int h, char **color, int n)
{
    const int cmyk = n == 0;
    unsigned char *pixel = calloc((size_t)w * (size_t)h, 4), *out = NULL;
    unsigned long bytes = 0;
    for (int i = 0; i < w * h && !cmyk; i++) {
        uint8_t c[4];
        parse(c, color[i % n]);
        memcpy(pixel + 3 * i, c, 3);
    }
    tjhandle jpeg = tjInitCompress();
    FILE *f = fopen(file, "wb");
    if (f == NULL || tjCompress2(jpeg, pixel, w, 0, h, cmyk ? TJPF_CMYK : TJPF_RGB, &out, &bytes,
                                 TJSAMP_444, 100, 0) != 0)
        return 1;
    (void)fwrite(out, 1, bytes, f);
    return fclose(f);
}

static int write_numbers(const char *file)
{
    char text[64 * 64][8], *color[64 * 64];
    for (unsigned i = 0; i < 64 * 64; i++) {
        const unsigned x = i % 64, y = i / 64, red = x >> 1, blue = x & 1 ? 31 : 0;
        (void)snprintf(text[i], sizeof text[i], "%02x%02x%02x", red << 3 | red >> 2,
                       y << 2 | y >> 4, blue << 3 | blue >> 2);
        color[i] = text[i];
    }
    return write_png(find("rgb"), file, 64, 64, color, 64 * 64);
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (strcmp(what, "png") == 0 && argc > 6)
        return write_png(find(argv[2]), argv[3], (uint32_t)atoi(argv[4]), (uint32_t)atoi(argv[5]),
                         argv + 6, argc - 6);
    if (strcmp(what, "jpg") == 0 && argc > 5)
        return write_jpeg(argv[2], atoi(argv[3]), atoi(argv[4]), argv + 5, argc - 5);
    if (strcmp(what, "cmyk") == 0 && argc == 5)
        return write_jpeg(argv[2], atoi(argv[3]), atoi(argv[4]), NULL, 0);
    if (strcmp(what, "numbers") == 0 && argc == 3)
        return write_numbers(argv[2]);
    return 1;
}
