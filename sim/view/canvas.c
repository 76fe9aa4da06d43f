/* One overlay item at a time, on one strip that is the whole window.
 *
 * SPDX-License-Identifier: MIT
 */
#include "canvas.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

#define LINE_MAX_CELLS 512

void view_canvas_size(struct view_canvas *c, int w, int h)
{
    if (c->px != NULL && c->w == w && c->h == h)
        return;
    free(c->px);
    c->px = sim_alloc((size_t)w * (size_t)h, sizeof *c->px);
    c->w = w;
    c->h = h;
}

void view_canvas_free(struct view_canvas *c)
{
    free(c->px);
    c->px = NULL;
}

static void draw(struct view_canvas *c, const struct zs_item *item)
{
    struct zs_overlay overlay = { .item = item, .n = 1 };
    const struct zs_target target = { .color = c->px,
                                      .y1 = (uint16_t)c->h,
                                      .x1 = (uint16_t)c->w,
                                      .pitch = (uint32_t)c->w };
    zs_overlay_draw(&overlay, &target);
}

void view_canvas_fill(struct view_canvas *c, int x, int y, int w, int h, uint16_t color)
{
    const struct zs_item item = { .kind = &zs_item_fill, .x = (int16_t)x, .y = (int16_t)y,
                                  .w = (int16_t)w, .h = (int16_t)h, .color = color };
    draw(c, &item);
}

void view_canvas_text(struct view_canvas *c, int x, int y, uint16_t color, int flags, int n, const char *text)
{
    char cut[LINE_MAX_CELLS];
    const int room = n < (int)sizeof cut - 1 ? n : (int)sizeof cut - 1;
    if (room < 3)
        return;
    if ((int)strlen(text) > room)
        (void)snprintf(cut, sizeof cut, "%.*s..", room - 2, text);
    else
        (void)snprintf(cut, sizeof cut, "%s", text);
    const struct zs_item item = { .kind = &zs_item_text, .x = (int16_t)x, .y = (int16_t)y, .color = color,
                                  .size = VIEW_TEXT, .flags = (uint8_t)flags, .text = cut };
    draw(c, &item);
}

int view_canvas_lines(struct view_canvas *c, int x, int y, uint16_t color, int n, int most, int pitch,
                      const char *text)
{
    int lines = 0;
    for (; n > 2 && *text != '\0' && lines < most; lines++) {
        char line[LINE_MAX_CELLS];
        int length = (int)strcspn(text, "\n");
        const int whole = length <= n || lines + 1 == most; /* the last line is cut */
        if (!whole) {
            length = n;
            while (length > n / 2 && text[length] != ' ')
                length--;
            length = text[length] == ' ' ? length : n;
        }
        (void)snprintf(line, sizeof line, "%.*s", length, text);
        view_canvas_text(c, x, y + lines * pitch, color, 0, n, line);
        text += length;
        text += *text == ' ' || *text == '\n';
    }
    return lines;
}

void view_canvas_show(const struct view_canvas *c, uint32_t *to, int pitch)
{
    for (int y = 0; y < c->h; y++)
        for (int x = 0; x < c->w; x++) {
            const uint16_t wire = c->px[(size_t)y * (size_t)c->w + (size_t)x];
            const uint8_t *byte = (const uint8_t *)&wire;
            uint8_t rgb[3];
            sim_rgb565_expand(rgb, (uint16_t)(byte[0] << 8 | byte[1]));
            to[(size_t)y * (size_t)pitch + (size_t)x] = (uint32_t)(rgb[0] << 16 | rgb[1] << 8 | rgb[2]);
        }
}

void view_canvas_picture(uint32_t *to, int pitch, int x, int y, int scale, const struct sim_picture *picture,
                         uint32_t w, uint32_t h)
{
    for (uint32_t row = 0; row < h; row++) {
        uint32_t *first = to + ((size_t)y + row * (size_t)scale) * (size_t)pitch + (size_t)x, *at = first;
        const uint8_t *rgb = picture->rgb + (size_t)row * picture->width * 3u;
        for (uint32_t k = 0; k < w; k++, rgb += 3)
            for (int i = 0; i < scale; i++)
                *at++ = (uint32_t)(rgb[0] << 16 | rgb[1] << 8 | rgb[2]);
        for (int i = 1; i < scale; i++)
            memcpy(first + (size_t)i * (size_t)pitch, first, (size_t)w * (size_t)scale * sizeof *first);
    }
}
