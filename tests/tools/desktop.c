/* An X server's windows from outside, by Xlib alone: for tests of `zsim view`.
 *
 *   desktop shot WINDOW                  its pixels as binary PPM on standard output
 *   desktop find WINDOW PICTURE.png      where the picture is in it, each pixel a square: "SCALE X Y"
 *   desktop count WINDOW RRGGBB X Y W H  how many pixels of a rectangle have that colour; W or H 0: up to the border
 *   desktop text WINDOW                  what is written in it, line by line, read from its pixels by the shapes of the
 *                                        renderer's font at twice its size; a blank for each cell that is empty
 *   desktop close WINDOW                 what a window manager sends when the window's button is pressed
 *
 * Exit status 1 where it is not so, or there is no such window.
 *
 * SPDX-License-Identifier: MIT
 */
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "overlay/items.h"

struct picture {
    int w, h;
    uint32_t *px; /* 0x00rrggbb */
};

static int quiet(Display *display, XErrorEvent *event)
{
    (void)display, (void)event;
    return 0;
}

static int take(struct picture *p, Display *display, Window window)
{
    XWindowAttributes a;
    if (!XGetWindowAttributes(display, window, &a))
        return 0;
    XImage *image = XGetImage(display, window, 0, 0, (unsigned)a.width, (unsigned)a.height, AllPlanes, ZPixmap);
    if (image == NULL)
        return 0;
    p->w = a.width;
    p->h = a.height;
    if (image->bits_per_pixel == 32 && image->bytes_per_line == 4 * p->w) { /* as screens have them: in their place */
        p->px = (uint32_t *)(void *)image->data;
        for (size_t i = 0; i < (size_t)p->w * (size_t)p->h; i++)
            p->px[i] &= 0xffffff;
        return 1;
    }
    p->px = malloc(sizeof *p->px * (size_t)p->w * (size_t)p->h);
    for (int y = 0; y < p->h; y++)
        for (int x = 0; x < p->w; x++)
            p->px[(size_t)y * (size_t)p->w + (size_t)x] = 0xffffff & (uint32_t)XGetPixel(image, x, y);
    XDestroyImage(image);
    return 1;
}

static int read_png(struct picture *p, const char *name)
{
    png_image image = { .version = PNG_IMAGE_VERSION };
    if (!png_image_begin_read_from_file(&image, name))
        return 0;
    image.format = PNG_FORMAT_RGB;
    uint8_t *rgb = malloc(PNG_IMAGE_SIZE(image));
    if (!png_image_finish_read(&image, NULL, rgb, 0, NULL))
        return 0;
    p->w = (int)image.width;
    p->h = (int)image.height;
    p->px = malloc(sizeof *p->px * image.width * image.height);
    for (size_t i = 0; i < (size_t)p->w * (size_t)p->h; i++)
        p->px[i] = (uint32_t)(rgb[3 * i] << 16 | rgb[3 * i + 1] << 8 | rgb[3 * i + 2]);
    free(rgb);
    return 1;
}

/* From that pixel on first, and one of each square first: where it is not there, that is mostly seen at once. */
static int is_at(const struct picture *in, const struct picture *p, int scale, int x, int y, int probe)
{
    for (int i = probe; i < p->w * p->h; i++)
        if (in->px[(size_t)(y + i / p->w * scale) * (size_t)in->w + (size_t)(x + i % p->w * scale)] != p->px[i])
            return 0;
    for (int k = 0; k < p->h * scale; k++)
        for (int i = 0; i < p->w * scale; i++)
            if (in->px[(size_t)(y + k) * (size_t)in->w + (size_t)(x + i)] !=
                p->px[(size_t)(k / scale) * (size_t)p->w + (size_t)(i / scale)])
                return 0;
    return 1;
}

/* The largest scale first, since a plain picture is in a larger one of it, too. A pixel that is not as the first one is
 * looked at before all others. */
static int find(const struct picture *in, const struct picture *p)
{
    int probe = 0;
    while (probe + 1 < p->w * p->h && p->px[probe] == p->px[0])
        probe++;
    for (int scale = 16; scale >= 1; scale--)
        for (int y = 0; y + p->h * scale <= in->h; y++)
            for (int x = 0; x + p->w * scale <= in->w; x++)
                if (in->px[(size_t)(y + probe / p->w * scale) * (size_t)in->w + (size_t)(x + probe % p->w * scale)] ==
                        p->px[probe] && is_at(in, p, scale, x, y, probe)) {
                    printf("%d %d %d\n", scale, x, y);
                    return 0;
                }
    return 1;
}

static int count(const struct picture *in, char **argv)
{
    const uint32_t color = (uint32_t)strtoul(argv[0], NULL, 16);
    const int x0 = atoi(argv[1]), y0 = atoi(argv[2]), w = atoi(argv[3]), h = atoi(argv[4]);
    int n = 0;
    for (int y = y0; y < in->h && (h == 0 || y < y0 + h); y++)
        for (int x = x0; x < in->w && (w == 0 || x < x0 + w); x++)
            n += in->px[(size_t)y * (size_t)in->w + (size_t)x] == color;
    printf("%d\n", n);
    return 0;
}

/* ---- Text ---------------------------------------------------------------------------------------- */

#define SCALE 2
#define CELL_W (SCALE * ZS_GLYPH_W)
#define CELL_H (SCALE * ZS_GLYPH_H)

static const uint32_t inks[] = { 0x8c929c, 0xdedbde, 0xffb252 }; /* canvas.h's, of 8 bits a channel */
static uint8_t shapes[128][ZS_GLYPH_H]; /* of ASCII, a row's leftmost dot is 16 */

/* The letter whose cell has its left top corner there, all of it and nothing else, in one ink; 0: none. */
static int letter_at(const struct picture *in, const uint8_t *used, int x, int y, uint32_t ink)
{
    uint8_t rows[ZS_GLYPH_H] = { 0 };
    int any = 0;
    for (int k = 0; k < CELL_H; k++)
        for (int i = -SCALE; i < CELL_W; i++) { /* the dot before it, too, is empty */
            const size_t at = (size_t)(y + k) * (size_t)in->w + (size_t)(x + i);
            const int on = !used[at] && in->px[at] == ink, dot = i / SCALE;
            if (on && (i < 0 || dot >= ZS_GLYPH_W - 1))
                return 0;
            if (i < 0 || dot >= ZS_GLYPH_W - 1)
                continue;
            if (i % SCALE == 0 && k % SCALE == 0)
                rows[k / SCALE] |= (uint8_t)(on ? 16 >> dot : 0);
            else if (on != !!(rows[k / SCALE] & 16 >> dot))
                return 0;
            any |= on;
        }
    for (int code = '!'; any && code <= '~'; code++)
        if (memcmp(rows, shapes[code], sizeof rows) == 0)
            return code;
    return 0;
}

struct letter {
    int x, code;
};

/* The letters whose cells begin in row y, from left to right. Return how many. */
static int line_at(const struct picture *in, const uint8_t *used, int y, struct letter *to)
{
    int n = 0, code = 0, before[4096] = { 0 }; /* pixels of text in the columns of these rows left of x */
    for (int x = 0; x < in->w && x < 4095; x++) {
        before[x + 1] = before[x];
        for (int k = 0; k < CELL_H; k++) {
            const size_t at = (size_t)(y + k) * (size_t)in->w + (size_t)x;
            before[x + 1] += !used[at] && (in->px[at] == inks[0] || in->px[at] == inks[1] || in->px[at] == inks[2]);
        }
    }
    for (int x = SCALE; x + CELL_W <= in->w && x + CELL_W < 4095; x += code != 0 ? CELL_W : 1) {
        code = 0;
        if (before[x - SCALE] != before[x] || before[x] == before[x + CELL_W] ||
            before[x + CELL_W - SCALE] != before[x + CELL_W])
            continue;
        for (size_t k = 0; code == 0 && k < sizeof inks / sizeof inks[0]; k++)
            code = letter_at(in, used, x, y, inks[k]);
        if (code != 0)
            to[n++] = (struct letter){ x, code };
    }
    return n;
}

/* A row that begins no line may show some letter by accident, but never as many as the line there. So the row with most
 * letters is a line; its pixels are then out of the way, and so on. */
static int text(const struct picture *in)
{
    uint8_t *used = calloc((size_t)in->w, (size_t)in->h);
    struct letter *line = calloc((size_t)in->w, sizeof *line);
    char **found = calloc((size_t)in->h, sizeof *found);
    int *n = calloc((size_t)in->h, sizeof *n);
    for (int code = ' '; code <= '~'; code++)
        zs_font_glyph(shapes[code], (uint32_t)code);
    for (int y = 0; y + CELL_H <= in->h; y++)
        n[y] = line_at(in, used, y, line);
    for (;;) {
        int best = 0;
        for (int y = 1; y + CELL_H <= in->h; y++)
            best = n[y] > n[best] ? y : best;
        if (n[best] == 0)
            break;
        const int count = line_at(in, used, best, line);
        char *to = found[best] = calloc((size_t)in->w, 1);
        int at = 0;
        for (int i = 0; i < count; i++) {
            for (int gap = i > 0 ? line[i].x - line[i - 1].x - CELL_W : 0; gap >= CELL_W / 2; gap -= CELL_W)
                to[at++] = ' ';
            to[at++] = (char)line[i].code;
            for (int k = 0; k < CELL_H; k++)
                memset(used + (size_t)(best + k) * (size_t)in->w + (size_t)line[i].x, 1, CELL_W);
        }
        n[best] = 0;
        for (int y = best - CELL_H < 0 ? 0 : best - CELL_H; y < best + CELL_H && y + CELL_H <= in->h; y++)
            n[y] = y == best ? 0 : line_at(in, used, y, line);
    }
    for (int y = 0; y < in->h; y++)
        if (found[y] != NULL)
            puts(found[y]);
    return 0;
}

static int close_window(Display *display, Window window)
{
    XEvent e = { .xclient = { .type = ClientMessage, .window = window, .format = 32,
                              .message_type = XInternAtom(display, "WM_PROTOCOLS", False),
                              .data.l = { (long)XInternAtom(display, "WM_DELETE_WINDOW", False), CurrentTime } } };
    const int sent = XSendEvent(display, window, False, NoEventMask, &e) != 0;
    XCloseDisplay(display);
    return !sent;
}

int main(int argc, char **argv)
{
    struct picture in = { 0 }, p = { 0 };
    Display *display = XOpenDisplay(NULL);
    if (argc < 3 || display == NULL)
        return 1;
    XSetErrorHandler(quiet);
    const Window window = strtoul(argv[2], NULL, 0);
    if (strcmp(argv[1], "close") == 0)
        return close_window(display, window);
    if (!take(&in, display, window))
        return 1;
    if (strcmp(argv[1], "shot") == 0) {
        printf("P6\n%d %d\n255\n", in.w, in.h);
        for (size_t i = 0; i < (size_t)in.w * (size_t)in.h; i++) {
            const uint8_t rgb[3] = { (uint8_t)(in.px[i] >> 16), (uint8_t)(in.px[i] >> 8), (uint8_t)in.px[i] };
            fwrite(rgb, 1, 3, stdout);
        }
        return 0;
    }
    if (strcmp(argv[1], "find") == 0 && argc == 4 && read_png(&p, argv[3]))
        return find(&in, &p);
    if (strcmp(argv[1], "text") == 0)
        return text(&in);
    return strcmp(argv[1], "count") == 0 && argc == 8 ? count(&in, argv + 3) : 1;
}
