/* All pictures of firmware/examples on one sheet, numbered as in its README, enlarged. For tests/tools/examples.sh.
 * Usage: sheet FILE.png
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>

#include "examples.h"
#include "image.h"
#include "core/fx.h"
#include "zs_overlay.h"

#define ZOOM 4
#define COLUMNS 5
#define GAP 12 /* px between pictures; the number stands in the one above */
#define CELL_W (EXAMPLE_W * ZOOM + GAP)
#define CELL_H (EXAMPLE_H * ZOOM + GAP)

#define EXAMPLE(name) example_##name,
static int (*const example[])(uint32_t, const struct zs_sink *) = { EXAMPLES(EXAMPLE) };
#define COUNT (sizeof example / sizeof example[0])
#define WIDTH (COLUMNS * CELL_W + GAP)
#define HEIGHT ((COUNT + COLUMNS - 1) / COLUMNS * CELL_H + GAP)

static uint16_t sheet[HEIGHT][WIDTH]; /* as it lies in strips */

/* ctx: the pixel of the sheet at which the picture begins. */
static int take(void *ctx, const struct zs_strip *s)
{
    uint16_t(*at)[WIDTH] = ctx;
    const uint16_t *px = (const uint16_t *)(const void *)s->px;
    for (int y = 0; y < s->h * ZOOM; y++)
        for (int x = s->dirty_x * ZOOM; x < (s->dirty_x + s->dirty_w) * ZOOM; x++)
            at[s->y * ZOOM + y][x] = px[y / ZOOM * s->w + x / ZOOM];
    return 0;
}

static void write_number(unsigned n, int16_t x, int16_t y)
{
    char text[4];
    (void)snprintf(text, sizeof text, "%u", n);
    struct zs_item item = { .kind = &zs_item_text, .x = x, .y = y, .color = 0xffff, .text = text };
    struct zs_overlay overlay = { .item = &item, .n = 1 };
    const struct zs_target all = { .color = &sheet[0][0], .y1 = HEIGHT, .x1 = WIDTH, .pitch = WIDTH };
    zs_overlay_draw(&overlay, &all);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    for (unsigned k = 0; k < COUNT; k++) {
        const unsigned x = k % COLUMNS * CELL_W + GAP, y = k / COLUMNS * CELL_H + GAP;
        const struct zs_sink sink = { .submit = take, .ctx = (void *)&sheet[y][x] };
        if (example[k](0, &sink) != ZS_OK)
            return 1;
        write_number(k + 1, (int16_t)x, (int16_t)(y - 10));
    }
    for (size_t y = 0; y < HEIGHT; y++)
        for (size_t x = 0; x < WIDTH; x++)
            sheet[y][x] = zs_wire16(sheet[y][x]);
    uint8_t *rgb = sim_rgb565_to_rgb8(&sheet[0][0], (size_t)WIDTH * HEIGHT);
    const int status = sim_png_save(argv[1], WIDTH, HEIGHT, rgb);
    free(rgb);
    return status;
}
