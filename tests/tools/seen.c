/* Is a picture what a panel shows of a frame, and does a file hold its values? For panels.sh, demo.sh.
 *
 *   seen P.png F.png colour|grey|mono [P.bin]    "WIDTH HEIGHT COLOURS" of P
 *
 * Exit 0; 1 with a sentence on standard output. Shares no code with zsim.
 *
 * SPDX-License-Identifier: MIT
 */
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lib/glass_level.h"

static png_image load(const char *name, uint8_t **rgb)
{
    png_image image = { .version = PNG_IMAGE_VERSION };
    if (png_image_begin_read_from_file(&image, name)) {
        image.format = PNG_FORMAT_RGB;
        *rgb = malloc(PNG_IMAGE_SIZE(image));
        if (png_image_finish_read(&image, NULL, *rgb, 0, NULL))
            return image;
    }
    printf("%s: %s\n", name, image.message);
    exit(1);
}

/* What a pixel of the frame should look like. */
static void wanted(const char *how, const uint8_t *f, unsigned x, unsigned y, uint8_t out[3])
{
    memcpy(out, f, 3);
    if (strcmp(how, "grey") == 0)
        memset(out, (int)(17 * quantise_level(f[0], f[1], f[2])), 3);
    if (strcmp(how, "mono") == 0)
        memset(out, (int)(255 * quantise_bit(f[0], f[1], f[2], x, y)), 3);
}

/* Does a file hold the picture's values, RGB565 or a byte for each level or bit, and nothing else? */
static void check_values(const char *name, const char *how, const uint8_t *p, size_t n)
{
    FILE *in = fopen(name, "rb");
    for (size_t i = 0; in != NULL && i < n; i++) {
        const uint8_t *px = p + 3 * i;
        int want = strcmp(how, "grey") == 0 ? px[0] / 17 : px[0] / 255;
        int have = getc(in);
        if (strcmp(how, "colour") == 0) {
            want = px[0] >> 3 << 11 | px[1] >> 2 << 5 | px[2] >> 3;
            have = have << 8 | getc(in);
        }
        if (have != want) {
            printf("value %zu of %s is %x instead of %x\n", i, name, (unsigned)have, (unsigned)want);
            exit(1);
        }
    }
    if (in == NULL || getc(in) != EOF) {
        printf("%s is %s\n", name, in == NULL ? "missing" : "too long");
        exit(1);
    }
    fclose(in);
}

int main(int argc, char **argv)
{
    uint8_t *p, *f, want[3], colour[65536 / 8] = { 0 };
    if (argc != 4 && argc != 5)
        return 2;
    const png_image seen = load(argv[1], &p), frame = load(argv[2], &f);
    if (seen.width != frame.width || seen.height != frame.height) {
        printf("%s is %ux%u, %s %ux%u\n", argv[1], seen.width, seen.height, argv[2], frame.width, frame.height);
        return 1;
    }
    unsigned colours = 0;
    for (unsigned y = 0, i = 0; y < seen.height; y++)
        for (unsigned x = 0; x < seen.width; x++, i += 3) {
            wanted(argv[3], f + i, x, y, want);
            if (memcmp(p + i, want, 3) != 0) {
                printf("%s at %u,%u is %02x%02x%02x instead of %02x%02x%02x\n", argv[1], x, y, p[i], p[i + 1],
                       p[i + 2], want[0], want[1], want[2]);
                return 1;
            }
            const unsigned key = (unsigned)(p[i] >> 3 << 11 | p[i + 1] >> 2 << 5 | p[i + 2] >> 3);
            colours += !(colour[key / 8] >> key % 8 & 1);
            colour[key / 8] |= (uint8_t)(1 << key % 8);
        }
    if (argc == 5)
        check_values(argv[4], argv[3], p, (size_t)seen.width * seen.height);
    printf("%u %u %u\n", seen.width, seen.height, colours);
    return 0;
}
