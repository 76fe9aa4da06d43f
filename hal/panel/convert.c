/* RGB565 to what a controller takes: grey levels, bits, or the other order of bytes. The formulas are panel.h's.
 *
 * Grey and one-bit pictures are turned here: bytes are made in the order of the glass at rotate 0, and for each pixel
 * of the glass its place in the picture is asked for. Nothing is written twice, and no second copy is needed.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

void panel_convert_swap(const struct panel_part *part, uint8_t *to)
{
    for (uint32_t y = 0; y < part->rect->h; y++) {
        const uint8_t *from = part->px + y * part->stride;
        for (uint32_t x = 0; x < part->rect->w; x++, from += 2, to += 2) {
            to[0] = from[1];
            to[1] = from[0];
        }
    }
}

struct spot {
    uint32_t x, y; /* in the part */
};

/* The pixel of the picture at (x, y) of the part as it lies on the glass. */
static struct spot turned(const struct panel_part *part, uint32_t x, uint32_t y)
{
    const uint32_t far_x = part->rect->w - 1u, far_y = part->rect->h - 1u;
    switch (part->rotate) {
    case 1: return (struct spot){ y, far_y - x };
    case 2: return (struct spot){ far_x - x, far_y - y };
    case 3: return (struct spot){ far_x - y, x };
    default: return (struct spot){ x, y };
    }
}

/* 0 .. 255 */
static uint32_t grey(const struct panel_part *part, struct spot at)
{
    const uint8_t *px = part->px + at.y * part->stride + at.x * 2u;
    const uint32_t v = part->lsb_first ? (uint32_t)px[1] << 8 | px[0] : (uint32_t)px[0] << 8 | px[1];
    const uint32_t r5 = v >> 11, g6 = v >> 5 & 63u, b5 = v & 31u;
    const uint32_t r = r5 << 3 | r5 >> 2, g = g6 << 2 | g6 >> 4, b = b5 << 3 | b5 >> 2;
    return (77u * r + 150u * g + 29u * b + 128u) >> 8; /* 77 + 150 + 29 = 256 */
}

/* 0 .. 15: (grey * 15 + 127) / 255, without the division that small cores lack; exact for v < 65535. */
static uint8_t level(uint32_t of_255)
{
    const uint32_t v = of_255 * 15u + 127u; /* <= 3952 */
    return (uint8_t)((v + 1u + (v >> 8)) >> 8);
}

void panel_convert_grey4(const struct panel_part *part, uint8_t *to)
{
    const struct panel_rect *r = part->rect;
    const uint32_t w = part->rotate & 1 ? r->h : r->w, h = part->rotate & 1 ? r->w : r->h; /* on the glass */
    for (uint32_t y = 0; y < h; y++)
        for (uint32_t x = 0; x < w; x += 2) {
            const uint8_t left = level(grey(part, turned(part, x, y)));
            *to++ = (uint8_t)(left << 4 | level(grey(part, turned(part, x + 1u, y))));
        }
}

static const uint8_t bayer[8][8] = {
    { 0, 32, 8, 40, 2, 34, 10, 42 },  { 48, 16, 56, 24, 50, 18, 58, 26 }, { 12, 44, 4, 36, 14, 46, 6, 38 },
    { 60, 28, 52, 20, 62, 30, 54, 22 }, { 3, 35, 11, 43, 1, 33, 9, 41 },  { 51, 19, 59, 27, 49, 17, 57, 25 },
    { 15, 47, 7, 39, 13, 45, 5, 37 }, { 63, 31, 55, 23, 61, 29, 53, 21 }
};

static uint32_t is_on(const struct panel_part *part, struct spot at)
{
    const uint32_t cell = bayer[(part->rect->y + at.y) & 7u][(part->rect->x + at.x) & 7u];
    return grey(part, at) > 255u * (2u * cell + 1u) >> 7;
}

void panel_convert_mono(const struct panel_part *part, uint8_t *to)
{
    const struct panel_rect *r = part->rect;
    const uint32_t w = part->rotate & 1 ? r->h : r->w, h = part->rotate & 1 ? r->w : r->h; /* on the glass */
    for (uint32_t y = 0; y < h; y += 8)
        for (uint32_t x = 0; x < w; x++) {
            uint32_t bits = 0;
            for (uint32_t bit = 0; bit < 8; bit++)
                bits |= is_on(part, turned(part, x, y + bit)) << bit;
            *to++ = (uint8_t)bits;
        }
}
