/* RGB565 to what a controller takes: grey levels, bits, or the other order of bytes. The formulas are panel.h's.
 *
 * Grey and one-bit pictures are turned here: bytes are made in the order of the glass at rotate 0, while a spot walks
 * over the picture, to whichever side a step to the right or down on the glass leads there. Nothing is written twice,
 * and no second copy is needed. About 37 and 49 instructions a pixel on a Cortex-M3, at any rotation.
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

/* A pixel of the picture, or a step between two: a difference may be negative, and wraps. */
struct spot {
    uint32_t at;   /* byte from part->px */
    uint32_t x, y; /* px in the picture */
};

static void go(struct spot *spot, const struct spot *step)
{
    spot->at += step->at;
    spot->x += step->x;
    spot->y += step->y;
}

/* How the part lies on the glass at rotate 0. */
struct lie {
    uint32_t width, height;
    struct spot row;         /* its left top pixel there; then the left one of a row */
    struct spot right, down; /* steps */
};

static void lie_down(const struct panel_part *part, struct lie *lie)
{
    const struct panel_rect *r = part->rect;
    const uint32_t stride = part->stride, odd = part->rotate & 1u;
    const uint32_t from_right = part->rotate >= 2, from_below = part->rotate == 1 || part->rotate == 2;
    const uint32_t x = from_right ? r->w - 1u : 0, y = from_below ? r->h - 1u : 0;
    struct spot *along = odd ? &lie->down : &lie->right, *below = odd ? &lie->right : &lie->down;
    lie->width = odd ? r->h : r->w;
    lie->height = odd ? r->w : r->h;
    lie->row = (struct spot){ x * 2u + y * stride, r->x + x, r->y + y };
    *along = (struct spot){ from_right ? 0u - 2u : 2u, from_right ? 0u - 1u : 1u, 0 };
    *below = (struct spot){ from_below ? 0u - stride : stride, 0, from_below ? 0u - 1u : 1u };
}

/* 0 .. 255 */
static uint32_t grey(const struct panel_part *part, const struct spot *spot)
{
    const uint8_t *px = part->px + spot->at;
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
    struct lie lie;
    lie_down(part, &lie);
    for (uint32_t y = 0; y < lie.height; y++, go(&lie.row, &lie.down)) {
        struct spot spot = lie.row;
        for (uint32_t x = 0; x < lie.width; x += 2) {
            const uint8_t left = level(grey(part, &spot));
            go(&spot, &lie.right);
            *to++ = (uint8_t)(left << 4 | level(grey(part, &spot)));
            go(&spot, &lie.right);
        }
    }
}

static const uint8_t bayer[8][8] = {
    { 0, 32, 8, 40, 2, 34, 10, 42 },  { 48, 16, 56, 24, 50, 18, 58, 26 }, { 12, 44, 4, 36, 14, 46, 6, 38 },
    { 60, 28, 52, 20, 62, 30, 54, 22 }, { 3, 35, 11, 43, 1, 33, 9, 41 },  { 51, 19, 59, 27, 49, 17, 57, 25 },
    { 15, 47, 7, 39, 13, 45, 5, 37 }, { 63, 31, 55, 23, 61, 29, 53, 21 }
};

static uint32_t is_on(const struct panel_part *part, const struct spot *spot)
{
    const uint32_t cell = bayer[spot->y & 7u][spot->x & 7u];
    return grey(part, spot) > 255u * (2u * cell + 1u) >> 7;
}

void panel_convert_mono(const struct panel_part *part, uint8_t *to)
{
    struct lie lie;
    lie_down(part, &lie);
    for (uint32_t y = 0; y < lie.height; y += 8) {
        struct spot column = lie.row;
        for (uint32_t x = 0; x < lie.width; x++, go(&column, &lie.right)) {
            struct spot spot = column;
            uint32_t bits = 0;
            for (uint32_t bit = 0; bit < 8; bit++, go(&spot, &lie.down))
                bits |= is_on(part, &spot) << bit;
            *to++ = (uint8_t)bits;
        }
        for (uint32_t row = 0; row < 8; row++)
            go(&lie.row, &lie.down);
    }
}
