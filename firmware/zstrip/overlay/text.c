/* Text: UTF-8 to glyphs, and glyphs to pixels.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

#define REPLACEMENT 0xfffdu /* what is no UTF-8; the font has it not, and so draws a box */

static int text_check(const struct zs_item *item)
{
    if (!item->text)
        return ZS_ERR_NULL;
    return item->size > 4u ? ZS_ERR_RANGE : ZS_OK;
}

/* Return the next code point and move *at behind it. Nothing behind a 0 is read, as a 0 continues
 * no sequence. A sequence that ends too early, is longer than needed, or stands for a surrogate or
 * for more than U+10FFFF is one REPLACEMENT, as is a byte that begins none. */
static uint32_t next_code(const char **at)
{
    const uint8_t *s = (const uint8_t *)*at;
    uint32_t code = *s++, more = 0, least = 0;
    if (code >= 0xf0u && code < 0xf8u)
        more = 3, least = 0x10000u, code &= 7u;
    else if (code >= 0xe0u && code < 0xf0u)
        more = 2, least = 0x800u, code &= 15u;
    else if (code >= 0xc0u && code < 0xe0u)
        more = 1, least = 0x80u, code &= 31u;
    else if (code >= 0x80u)
        code = REPLACEMENT;
    for (; more && (*s & 0xc0u) == 0x80u; more--)
        code = code << 6 | (*s++ & 63u);
    *at = (const char *)s;
    return more || code < least || code > 0x10ffffu || (code >= 0xd800u && code < 0xe000u)
               ? REPLACEMENT
               : code;
}

#define GLYPHS_MAX (1u << 20) /* of a line, and lines: more are beyond every frame */

/* Count the glyphs of a line, up to GLYPHS_MAX. */
static uint32_t glyphs_in(const char *at)
{
    uint32_t n = 0;
    while (*at && *at != '\n') {
        (void)next_code(&at);
        n += n < GLYPHS_MAX;
    }
    return n;
}

static const char *line_after(const char *at)
{
    while (*at && *at != '\n')
        at++;
    return *at ? at + 1 : 0;
}

/* Return the left side of a line, px. */
static int32_t line_left(const struct zs_item *item, int32_t width)
{
    return item->flags & ZS_ITEM_RIGHT    ? item->x - width
           : item->flags & ZS_ITEM_CENTER ? item->x - width / 2
                                          : item->x;
}

static int32_t scale_of(const struct zs_item *item)
{
    return item->size ? item->size : 1;
}

uint32_t zs_overlay_text_width(const char *text)
{
    uint32_t most = 0;
    for (; text; text = line_after(text))
        most = zs_maxu32(most, glyphs_in(text));
    return most * ZS_GLYPH_W;
}

static void text_bounds(const struct zs_item *item, int32_t box[4])
{
    const int32_t scale = scale_of(item); /* widths < 2^20 * 6 * 4 */
    const int32_t width = (int32_t)zs_overlay_text_width(item->text) * scale;
    uint32_t lines = 0;
    for (const char *at = item->text; at; at = line_after(at))
        lines += lines < GLYPHS_MAX;
    box[0] = line_left(item, width);
    box[1] = item->y;
    box[2] = box[0] + width;
    box[3] = item->y + (int32_t)lines * ZS_GLYPH_H * scale;
}

/* Draw a glyph whose cell has its left top corner at (x, y). */
static void glyph_draw(const struct zs_target *t, int32_t x, int32_t y, int32_t scale,
                       const uint8_t *rows, const struct zs_paint *paint)
{
    struct zs_box box = { x, y, x + 5 * scale, y + ZS_GLYPH_H * scale };
    if (!zs_box_clip(&box, t))
        return;
    int32_t part = (box.y0 - y) % scale;
    const uint8_t *row = rows + (box.y0 - y) / scale;
    for (int32_t at_y = box.y0; at_y < box.y1; at_y++) {
        uint16_t *const out = zs_pixel(t, 0, at_y);
        uint32_t bits = *row;
        for (int32_t left = x; bits; left += scale, bits = bits << 1 & 31u) {
            if (!(bits & 16u))
                continue;
            const int32_t end = zs_min32(left + scale, box.x1);
            for (int32_t at_x = zs_max32(left, box.x0); at_x < end; at_x++)
                out[at_x] = paint->rest ? zs_paint_over(paint, out[at_x]) : paint->wire;
        }
        if (++part == scale) {
            part = 0;
            row++;
        }
    }
}

static void line_draw(const struct zs_item *item, const struct zs_target *t, const char *at,
                      int32_t y, const struct zs_paint *paint)
{
    const int32_t scale = scale_of(item), step = ZS_GLYPH_W * scale;
    const int aligned = item->flags & (ZS_ITEM_RIGHT | ZS_ITEM_CENTER);
    int32_t x = line_left(item, aligned ? (int32_t)glyphs_in(at) * step : 0);
    uint8_t rows[ZS_GLYPH_H];
    for (; *at && *at != '\n' && x < t->x1; x += step) {
        const uint32_t code = next_code(&at);
        if (x + step <= t->x0 || code == ' ')
            continue;
        zs_font_glyph(rows, code);
        glyph_draw(t, x, y, scale, rows, paint);
    }
}

static void text_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint paint = zs_paint_of(item->color, zs_alpha_of(item->clear));
    const int32_t height = ZS_GLYPH_H * scale_of(item);
    int32_t y = item->y;
    if (paint.rest == 64u)
        return;
    for (const char *at = item->text; at && y < t->y1; at = line_after(at), y += height)
        if (y + height > t->y0)
            line_draw(item, t, at, y, &paint);
}

const struct zs_item_kind zs_item_text = { .draw = text_draw,
                                           .bounds = text_bounds,
                                           .check = text_check };
