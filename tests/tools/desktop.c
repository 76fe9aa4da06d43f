/* An X server's windows from outside, by Xlib alone: for tests of `zsim view`.
 *
 *   desktop shot WINDOW                  its pixels as binary PPM on standard output
 *   desktop find WINDOW PICTURE.png      where the picture is in it, each pixel a square: "SCALE X Y"
 *   desktop count WINDOW RRGGBB X Y W H  how many pixels of a rectangle have that colour; W or H 0: up to the border
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
    p->px = malloc(sizeof *p->px * (size_t)p->w * (size_t)p->h);
    for (int y = 0; y < p->h; y++)
        for (int x = 0; x < p->w; x++)
            p->px[(size_t)y * (size_t)p->w + (size_t)x] = (uint32_t)XGetPixel(image, x, y) & 0xffffff;
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

static int is_at(const struct picture *in, const struct picture *p, int scale, int x, int y)
{
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
                        p->px[probe] && is_at(in, p, scale, x, y)) {
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
    return strcmp(argv[1], "count") == 0 && argc == 8 ? count(&in, argv + 3) : 1;
}
