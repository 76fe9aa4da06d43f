/* What the kinds of overlay items share: boxes, colours that are mixed, hashes. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ITEMS_H
#define ZS_ITEMS_H

#include "core/fx.h"
#include "zs_overlay.h"

#define ZS_RADIUS_MAX 2047 /* px, of dials: overlay/dial.c */

/* Columns [x0, x1) of rows [y0, y1); |.| < 2^30. */
struct zs_box {
    int32_t x0, y0, x1, y1;
};

/* Clip a box to a strip. Return 0 if nothing is left. */
static inline int zs_box_clip(struct zs_box *box, const struct zs_target *t)
{
    box->x0 = zs_max32(box->x0, t->x0);
    box->x1 = zs_min32(box->x1, t->x1);
    box->y0 = zs_max32(box->y0, t->y0);
    box->y1 = zs_min32(box->y1, t->y1);
    return box->x0 < box->x1 && box->y0 < box->y1;
}

/* Return the address of a pixel inside the strip. */
static inline uint16_t *zs_pixel(const struct zs_target *t, int32_t x, int32_t y)
{
    return t->color + (uint32_t)(y - t->y0) * t->pitch + (uint32_t)x;
}

/* ---- Mixing ---------------------------------------------------------------------------------- */

/* Red and blue of an RGB565 value are mixed in one word, green in another: a field of n bits times
 * at most 64 needs n + 6 bits, and there are as many up to the next field. */
#define ZS_RED_BLUE 0xf81fu
#define ZS_GREEN 0x07e0u
#define ZS_HALF_RED_BLUE ((32u << 11) | 32u)
#define ZS_HALF_GREEN (32u << 5)

/* A colour with an alpha of 0 .. 64, times which it is stored, plus a half for rounding. */
struct zs_paint {
    uint32_t red_blue; /* <= (31 * 64 + 32) * 2^11 + ... < 2^22 */
    uint32_t green;    /* <= (63 * 64 + 32) * 2^5 < 2^17 */
    uint32_t rest;     /* 64 - alpha */
    uint16_t wire;     /* the colour, most significant byte first */
};

static inline struct zs_paint zs_paint_of(uint32_t color, uint32_t alpha)
{
    const struct zs_paint paint = { (color & ZS_RED_BLUE) * alpha + ZS_HALF_RED_BLUE,
                                    (color & ZS_GREEN) * alpha + ZS_HALF_GREEN, 64u - alpha,
                                    zs_wire16((uint16_t)color) };
    return paint;
}

/* Mix a pixel: (color * alpha + old * rest) / 64, nearest in each channel. */
static inline uint16_t zs_paint_over(const struct zs_paint *paint, uint16_t old)
{
    const uint32_t v = zs_wire16(old);
    const uint32_t red_blue = (v & ZS_RED_BLUE) * paint->rest + paint->red_blue; /* < 2^22 */
    const uint32_t green = (v & ZS_GREEN) * paint->rest + paint->green;          /* < 2^17 */
    return zs_wire16((uint16_t)((red_blue >> 6 & ZS_RED_BLUE) | (green >> 6 & ZS_GREEN)));
}

/* Return the alpha, 0 .. 64, of a transparency, 0 .. 255: nearest. */
static inline uint32_t zs_alpha_of(uint8_t clear)
{
    return ((255u - clear) * 64u + 127u) / 255u;
}

/* Paint n > 0 pixels. */
void zs_paint_run(uint16_t *out, int32_t n, const struct zs_paint *paint);
/* Paint a box, clipped to the strip. */
void zs_paint_box(const struct zs_target *t, struct zs_box box, const struct zs_paint *paint);
/* Paint the line of zs_item_line from (x, y) to (x_end, y_end); differences |.| <= 2^15. */
void zs_paint_line(const struct zs_target *t, int32_t x, int32_t y, int32_t x_end, int32_t y_end,
                   const struct zs_paint *paint);

/* ---- Hashes ---------------------------------------------------------------------------------- */

/* Add a value to a hash of two lanes. Each step is a bijection of the lane for a given value, and
 * of the value for a given lane: a change of one value is always seen. */
static inline void zs_item_mix(uint32_t lane[2], uint32_t v)
{
    const uint32_t a = lane[0] ^ v, b = lane[1] + v;
    lane[0] = (a << 13 | a >> 19) * 0x9e3779b1u;
    lane[1] = (b << 19 | b >> 13) * 0x85ebca77u;
}

/* The 8 rows of a code point's glyph; the leftmost of five pixels has the value 16. */
void zs_font_glyph(uint8_t rows[ZS_GLYPH_H], uint32_t code);

#endif
