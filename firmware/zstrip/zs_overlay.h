/* 2D over the 3D picture: sprites, frames, text, lines, bars and dials.
 *
 *     static struct zs_item items[] = {
 *         { .kind = &zs_item_fill, .x = 4, .y = 4, .w = 60, .h = 12, .color = 0, .clear = 128 },
 *         { .kind = &zs_item_text, .x = 6, .y = 6, .color = 0xffff, .text = "21 \xc2\xb0" "C" } };
 *     static uint32_t memory[ZS_OVERLAY_WORDS(2)];
 *     static struct zs_overlay overlay = { .item = items, .n = 2, .memory = memory, .room = 2 };
 *     static const struct zs_resolve hook = { .draw = zs_overlay_draw,
 *                                             .changes = zs_overlay_changes, .ctx = &overlay };
 *     ...
 *     err = zs_overlay_check(&overlay);
 *     scene.resolve = &hook, scene.n_resolves = 1;
 *
 * Items are drawn in their order over each finished strip. They may be changed between frames, not
 * within one. Under zs_damage_track only the rectangle around what changed is drawn again: items,
 * their text and the fields of their sprites are compared with the frame before. Several overlays
 * (a hook each) keep rectangles that lie far apart apart. Each renderer with zs_damage_track has
 * overlays of its own.
 *
 * Places are px of the frame, x to the right, y down. What reaches beyond the frame is clipped.
 * Only the kinds that a program names are linked.
 *
 * Cost on a Cortex-M3, instructions: a pixel of a fill 0.5, mixed 16; of a sprite 11 to 29, with
 * alpha 36 to 63; of a line 26; of an arc 57; a letter 600, of double size 1,100, with a mark
 * 1,200; a needle of 30 px 29,000; a tick 680; 200 a frame to see that an item stands still. On the
 * stack 240 bytes at most (Cortex-M0+). Flash at -O2: 1.3 KB; with rectangles, bars and lines 3 KB,
 * sprites 1.3 KB, text 3.7 KB, dials 2.2 KB.
 *
 * Colours are mixed to less than one code of the exact mix: alpha is rounded to 64ths, and the sum
 * to the nearest code.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_OVERLAY_H
#define ZS_OVERLAY_H

#include "zstrip.h"

ZS_C_BEGIN

/* ---- Sprites ------------------------------------------------------------------------------ */

enum zs_sprite_format {
    ZS_SPRITE_565 = 0,  /* uint16_t [h][w], RGB565 values */
    ZS_SPRITE_PAL8 = 1, /* uint8_t [h][w], palette numbers */
    ZS_SPRITE_PAL4 = 2  /* uint8_t [h][(w + 1) / 2], palette numbers, the left pixel in the low four
                           bits */
};

enum zs_sprite_alpha {
    ZS_ALPHA_NONE = 0, /* every pixel covers */
    ZS_ALPHA_KEY = 1,  /* pixels of value `key` are not drawn: an RGB565 value or palette number */
    ZS_ALPHA_MASK = 2, /* alpha is [h][(w + 7) / 8] bits, the leftmost the highest; 1: drawn */
    ZS_ALPHA_4 = 3,    /* alpha is [h][(w + 1) / 2], 0 .. 15, the left pixel in the low four bits */
    ZS_ALPHA_8 = 4     /* alpha is [h][w], 0 .. 255 */
};

/* An image of any size. All of it may lie in flash. Bytes behind its pointers are not compared:
 * zs_invalidate (zs_damage.h) after a change of them. */
struct zs_sprite {
    const void *pixel;       /* rows from the top; aligned as its elements */
    const uint16_t *palette; /* [n_colors], RGB565 values; not read with ZS_SPRITE_565 */
    const uint8_t *alpha;    /* rows from the top; NULL with ZS_ALPHA_NONE and ZS_ALPHA_KEY */
    uint16_t w, h;           /* px, 1 .. ZS_SIZE_MAX */
    uint16_t n_colors;       /* no pixel may be >= n_colors; nobody looks */
    uint16_t key;            /* ZS_ALPHA_KEY */
    uint8_t format;          /* enum zs_sprite_format */
    uint8_t alpha_kind;      /* enum zs_sprite_alpha */
    uint8_t left, top, right, bottom; /* px: where an item is larger or smaller than the sprite,
                                         these columns and rows stay at its sides, and those
                                         between them are repeated (a nine-slice frame); left +
                                         right <= w, top + bottom <= h */
};

/* ---- Items -------------------------------------------------------------------------------- */

struct zs_item;
/* What an item is: one of these, or yours. */
struct zs_item_kind {
    /* Draw on a strip, clipped to the target's rows and columns. The same pixels in every strip. */
    void (*draw)(const struct zs_item *item, const struct zs_target *target);
    /* Compute a rectangle that holds all that draw may change: left, top, right, bottom, the last
     * two exclusive; |.| < 2^30. */
    void (*bounds)(const struct zs_item *item, int32_t box[4]);
    /* Return ZS_OK, or what is wrong with the item; such an item is not drawn. NULL: ZS_OK. */
    int (*check)(const struct zs_item *item);
};
/* Rectangle x, y, w, h. One with w or h of 0 or less is empty. */
extern const struct zs_item_kind zs_item_fill;
/* The border of that rectangle, inside it, `size` px wide (0: 1). */
extern const struct zs_item_kind zs_item_outline;
/* A line from pixel (x, y) to pixel (x + w, y + h), both drawn, one px wide: in each column (where
 * |w| >= |h|; else in each row) the pixel that is nearest to the straight line. */
extern const struct zs_item_kind zs_item_line;
/* `sprite` at x, y; w and h: its size, or larger or smaller (struct zs_sprite has how); 0: the
 * sprite's own. */
extern const struct zs_item_kind zs_item_sprite;
/* `text`, UTF-8 up to its 0; a line feed begins the next line. Cells of 6x8 px times `size` (1 ..
 * 4; 0: 1), the first with its left top corner at x, y, or centred on x, or ending there (flags).
 * The font has ASCII, the Latin letters of European languages and some signs (overlay/font.c). For
 * what it has not, and for what is no UTF-8, a box is drawn. */
extern const struct zs_item_kind zs_item_text;
/* A bar in rectangle x, y, w, h: value / 65535 of it in `color`, the rest in `back`. It grows to
 * the right, or upwards (ZS_ITEM_UP). */
extern const struct zs_item_kind zs_item_bar;
/* A ring around pixel (x, y): radius w, 0 .. 2047, h px wide (0: filled to the centre), from angle
 * `from` on clockwise over `sweep` (0: all around); 0 points upwards. The first value / 65535 of it
 * in `color`, the rest in `back`. A pixel belongs to it if its centre does. */
extern const struct zs_item_kind zs_item_arc;
/* The needle of a dial, a long triangle: from h px behind pixel (x, y), where it is `size` px wide,
 * to a point w px before it; w, h: 0 .. 2047. It points to value / 65535 of the way from angle
 * `from` over `sweep` (0: all around). */
extern const struct zs_item_kind zs_item_needle;
/* The scale of a dial: value + 1 lines, evenly from angle `from` over `sweep` (0: all around, and
 * `value` lines), from radius w inwards, h px long; w, h: 0 .. 2047, value <= 1000. */
extern const struct zs_item_kind zs_item_ticks;

enum zs_item_flags {
    ZS_ITEM_CENTER = 1, /* text */
    ZS_ITEM_RIGHT = 2,  /* text */
    ZS_ITEM_UP = 4      /* bar */
};

struct zs_item {
    const struct zs_item_kind *kind; /* NULL: nothing is drawn */
    int16_t x, y, w, h;              /* px, by the kind */
    uint16_t color;                  /* RGB565 */
    uint16_t back;                   /* RGB565: the rest of a bar or arc */
    uint8_t clear;      /* transparency: 0 covers, 255 cannot be seen; also of a sprite */
    uint8_t back_clear; /* that of back */
    uint8_t size;       /* by the kind */
    uint8_t flags;      /* enum zs_item_flags, or-ed */
    uint16_t value;     /* of bars, arcs and needles; 65535 is full */
    zs_turn from, sweep;
    const struct zs_sprite *sprite;
    const char *text;
};

#define ZS_GLYPH_W 6 /* px of a cell of text at size 1 */
#define ZS_GLYPH_H 8

/* ---- The hook ----------------------------------------------------------------------------- */

/* A list of items. `before` belongs to the library and is 0 at first. */
struct zs_overlay {
    const struct zs_item *item; /* [n], the caller's; may change between frames */
    uint32_t n;
    uint32_t *memory; /* [ZS_OVERLAY_WORDS(room)], what was drawn before; its contents do not
                         matter. NULL: without zs_damage_track, or all is drawn in each frame */
    uint32_t room;    /* with memory: n is never more */
    uint32_t before;
};
#define ZS_OVERLAY_WORDS(room) (4u * ZS_U32(room))

/* Check a list. Items that are wrong are not drawn, so that no check is needed for safety.
 * Return  ZS_OK; ZS_ERR_NULL (a sprite, its pixels, palette or alpha, or a text); ZS_ERR_RANGE (a
 *         size, radius or number of ticks); ZS_ERR_TEXTURE (a sprite's size, format or borders);
 *         ZS_ERR_SIZE (more items than room): the first that is found. */
int zs_overlay_check(const struct zs_overlay *overlay);

/* The functions of a struct zs_resolve; ctx is the struct zs_overlay. */
void zs_overlay_draw(void *ctx, const struct zs_target *target);
int zs_overlay_changes(void *ctx, struct zs_rect *rect);

/* Return the width in px of a text's longest line at size 1. */
uint32_t zs_overlay_text_width(const char *text);

ZS_C_END

#endif
