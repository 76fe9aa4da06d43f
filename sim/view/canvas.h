/* All that a window shows, drawn by the renderer's own overlay (zs_overlay.h) in RGB565, and pictures beside it, whose
 * pixels become squares of whole pixels.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_CANVAS_H
#define SIM_VIEW_CANVAS_H

#include <stdint.h>

#include "image.h"
#include "zs_overlay.h"

#define VIEW_TEXT 2 /* size of text, in dots of the font */
#define VIEW_CELL_W (VIEW_TEXT * ZS_GLYPH_W)
#define VIEW_CELL_H (VIEW_TEXT * ZS_GLYPH_H)

/* Colours, RGB565: one accent, the rest greys with a little blue */
#define VIEW_BACK 0x0842   /* around the picture */
#define VIEW_SIDE 0x10c4   /* the panel beside it */
#define VIEW_LINE 0x2988
#define VIEW_DIM 0x8c93
#define VIEW_INK 0xdedb
#define VIEW_ACCENT 0xfd8a

struct view_canvas {
    uint16_t *px; /* [h][w], most significant byte first; malloc'ed */
    int w, h;     /* px */
};

/* Make it w x h. All zero before the first time. */
void view_canvas_size(struct view_canvas *c, int w, int h);
void view_canvas_free(struct view_canvas *c);

void view_canvas_fill(struct view_canvas *c, int x, int y, int w, int h, uint16_t color);
/* Text with its left top corner there; flags: ZS_ITEM_RIGHT: it ends there. At most n cells: what is longer ends in
 * two dots. */
void view_canvas_text(struct view_canvas *c, int x, int y, uint16_t color, int flags, int n, const char *text);
/* Lines of at most n cells, broken at blanks where there are some, at most `most` of them, each `pitch` px below the
 * one before. Return how many. */
int view_canvas_lines(struct view_canvas *c, int x, int y, uint16_t color, int n, int most, int pitch,
                      const char *text);

/* Into the window's pixels, `pitch` apart. */
void view_canvas_show(const struct view_canvas *c, uint32_t *to, int pitch);
/* The left top w x h pixels of a picture over them, each scale x scale. */
void view_canvas_picture(uint32_t *to, int pitch, int x, int y, int scale, const struct sim_picture *picture,
                         uint32_t w, uint32_t h);

#endif
