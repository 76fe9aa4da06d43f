/* Panels: rectangles of RGB565 pixels to the bytes that a display controller takes, over one bus.
 *
 *   struct hal_bus *bus = hal_bus();
 *   static const struct panel_config config = { .type = &panel_st7789, .width = 240, .height = 240,
 *                                               .rotate = 1, .invert = 1 };
 *   err = panel_init(&panel, &config, bus, NULL, 0);
 *   err = panel_send(&panel, &rect, px, 0);   begins; then, before px is written again:
 *   err = panel_wait(&panel);
 *
 * A controller is one const struct panel_type: what is not named is not linked. Offsets, rotation, granularity and
 * set-up are data in it. All functions return HAL_ERR_NONE or a negative enum hal_err or panel_err.
 *
 * Picture   x to the right, y down, as a person sees it who turned the glass: rotate counts quarter turns by which
 *           the picture stands clockwise on the glass. With rotate 1 the glass's right column is the picture's top
 *           row. The glass at rotate 0 stands as its modules are mounted, upright and not mirrored with these bits:
 *           ST7789 36 00; GC9A01 36 00 after B6 00 20; ILI9341 36 40; SSD1351 A0 74; SSD0323 A0 52; SSD1306 A1 C8.
 * Pixels    RGB565, rows from the top. Colour panels: as given. Grey: grey = (77 R + 150 G + 29 B + 128) >> 8 over
 *           8-bit channels (R = r5 << 3 | r5 >> 2 and so on), then level = (grey * 15 + 127) / 255. One bit: on where
 *           grey > threshold, threshold = 255 * (2 * bayer[y & 7][x & 7] + 1) / 128 (floor), x and y in the
 *           picture, bayer the 8 x 8 matrix that starts 0 32 8 40 2 34 10 42.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PANEL_H
#define PANEL_H

#include <stdint.h>

#include "hal.h"

#ifdef __cplusplus
extern "C" {
#endif

enum panel_err {
    PANEL_ERR_SIZE = -121,    /* width, height or offset: not this controller's */
    PANEL_ERR_ROTATE = -122,  /* rotate is not 0 .. 3 */
    PANEL_ERR_RECT = -123,    /* empty, or reaches beyond the picture */
    PANEL_ERR_GRAIN = -124,   /* a page or byte of the controller would be cut: see panel_grain */
    PANEL_ERR_SCRATCH = -125, /* scratch is smaller than panel_scratch_bytes, or not 4-byte aligned */
    PANEL_ERR_STATE = -126    /* panel_init missing or failed, or asleep */
};

/* One English clause for an enum panel_err or hal_err, without a full stop; never NULL. Static storage. */
const char *panel_strerror(int err);

struct panel_type; /* a controller */
extern const struct panel_type panel_st7789;  /* RGB565; RAM 240x320. 240x240, 240x320, 135x240, 240x280, 172x320 and
                                                 170x320 have their offsets */
extern const struct panel_type panel_ili9341; /* RGB565; 240x320 */
extern const struct panel_type panel_gc9a01;  /* RGB565; 240x240, round */
extern const struct panel_type panel_ssd1351; /* RGB565; 128x128, 128x96 */
extern const struct panel_type panel_ssd0323; /* 4-bit grey; 128x64 */
extern const struct panel_type panel_ssd1306; /* 1 bit, pages of 8 rows; 128x64, 128x32, 64x48, 72x40 */

enum panel_format { PANEL_RGB565, PANEL_GREY4, PANEL_MONO };

struct panel_config {
    const struct panel_type *type;
    uint16_t width, height; /* px of the glass at rotate 0 */
    int16_t x0, y0;         /* the glass's left top pixel, as the controller counts at rotate 0; both 0: the type's own
                               table, or 0 where that has no glass of this size. SSD1351, SSD0323 and SSD1306
                               show the rows of their table alone, and take no other y0 */
    uint8_t rotate;         /* 0 .. 3 quarter turns clockwise */
    uint8_t invert;         /* 1: send the controller's inversion command (most IPS glass needs it to look right) */
    uint8_t bgr;            /* 1: the glass has blue where the controller has red (most ILI9341 and GC9A01 modules) */
    uint8_t lsb_first;      /* 1: pixels are given least significant byte first (another library's); zstrip's are not.
                               ST7789 is told; for the other colour controllers bytes are swapped through scratch
                               (ILI9341 has the command, but not for its serial interface) */
    uint8_t dim;            /* 255 - brightness or contrast, so that 0 is full */
    uint8_t te;             /* 1: TFTs: the controller puts a pulse on its TE pin between two pictures */
};

struct panel_rect {
    uint16_t x, y, w, h; /* px in the picture */
};

/* What rectangles must be multiples of, in the picture, edges and sizes alike. Every picture's size is one. */
struct panel_grain {
    uint8_t x, y; /* px, 1 or more */
};

struct panel {
    struct panel_config config;
    struct hal_bus *bus;
    uint8_t *scratch;
    uint32_t n_scratch;
    int16_t x0, y0;  /* offset of the picture's window, in the controller's coordinates */
    uint8_t state;   /* internal; 0: not set up, so a struct of zeros is refused */
    uint8_t broken;  /* 1: a transfer failed: set-up commands and waking are sent again before the next one */
    uint8_t locked;  /* 1: the bus is held until panel_wait */
};

/* Name of a controller as users write it ("st7789"). Static storage. */
const char *panel_name(const struct panel_type *type);

/* All controllers, to find one by its name. Naming panel_types links all of them. */
extern const struct panel_type *const panel_types[];
extern const uint32_t n_panel_types;

enum panel_format panel_format(const struct panel_type *type);

/* Bytes of scratch for rectangles of up to n_px pixels at a time (a strip: w * h); 0 where pixels travel as given.
 * Grey: n_px / 2; one bit: n_px / 8, both rounded up, turning included; a byte swap: 2 n_px. */
uint32_t panel_scratch_bytes(const struct panel_config *config, uint32_t n_px);

/* Granularity at the config's rotation. Grey: 2 x 1 at rotate 0; one bit: 1 x 8; colour: 1 x 1. */
struct panel_grain panel_grain(const struct panel_config *config);

/* Reset the panel and set it up; its glass stays dark until it has been cleared to black, then it is on.
 *
 * panel    not between panel_send and panel_wait: what it was is forgotten.
 * config   copied. scratch: at least panel_scratch_bytes of the largest rectangle to come, 4-byte aligned, kept;
 *          NULL with 0 where that is 0 (clearing needs none; larger ones let it send more at a time).
 * Blocks   as long as the controller wants (up to 0.3 s) and the clearing takes. The bus is held all that time.
 * Return   HAL_ERR_NONE; _ARG (NULL), PANEL_ERR_SIZE, _ROTATE, _SCRATCH, HAL_ERR_BUSY before anything was sent; the
 *          bus's errors. After any of them the panel cannot be used until panel_init returns HAL_ERR_NONE. */
int panel_init(struct panel *panel, const struct panel_config *config, struct hal_bus *bus, void *scratch,
               uint32_t n_scratch);

/* Size of the picture: the glass's, turned. */
uint16_t panel_width(const struct panel *panel);
uint16_t panel_height(const struct panel *panel);

/* Set the window to rect and begin to send its pixels.
 *
 * px       row-major, 2-byte aligned; borrowed until panel_wait returns, not on a negative return.
 * stride   bytes from row to row, even, at least rect->w * 2; 0 means dense (rect->w * 2). Not dense: rows go out
 *          one by one, and all but the last are waited for here; where px is converted, nothing is waited for.
 * Bus      hooks.lock before the window, hooks.unlock at the end of panel_wait, or here on a negative return.
 * Blocks   for the window's commands, after a failure for those of the set-up and for waking (up to 0.12 s); where
 *          px is converted, for that; never for dense pixels of a bus with DMA.
 * Cost     of conversion, on a Cortex-M3: 37 instructions a pixel to grey, 49 to one bit, at any rotation. Stack: at
 *          most 288 bytes, the bus's and the hooks' aside.
 * Return   HAL_ERR_NONE; _ARG, PANEL_ERR_STATE, _RECT, _GRAIN, _SCRATCH, HAL_ERR_BUSY: nothing was sent; HAL_ERR_STATE:
 *          the rectangle before was not waited for, and is still out; the bus's errors: the glass may show any part
 *          of it; the next send begins with the set-up commands, also where the controller was reset meanwhile. */
int panel_send(struct panel *panel, const struct panel_rect *rect, const uint8_t *px, uint32_t stride);

/* Wait until what panel_send began is out. Nothing is: HAL_ERR_NONE. Blocks for the rest. Return as the bus's wait. */
int panel_wait(struct panel *panel);

/* All of the following block for a few bytes on the wire (panel_rotate: for a picture's), and hold the bus as long;
 * after a failure also for the set-up and for waking, 0.12 s more. Between send and wait:
 * HAL_ERR_STATE; asleep: PANEL_ERR_STATE. They keep on a later set-up, so that what the bus failed to tell the
 * panel is told with the next send. Only where the bus was not given (HAL_ERR_BUSY), or failed in the set-up after an
 * earlier failure, has nothing changed: call again. */
int panel_rotate(struct panel *panel, uint8_t rotate); /* the glass is cleared; send all of the picture again */
int panel_invert(struct panel *panel, uint8_t invert);
/* 255 is full. WRDISBV, contrast or master current; where the glass does not follow (its type's file says):
 * hal_backlight. HAL_ERR_NONE where the controller has no such command. */
int panel_brightness(struct panel *panel, uint8_t level);

/* Dark, little current; panel_send is refused. Blocks up to 0.12 s, after a failure 0.24 s, so that panel_wake may
 * follow at once. After a failure, too, only panel_wake leads on; but after HAL_ERR_BUSY nothing has changed. */
int panel_sleep(struct panel *panel);

/* On again. Blocks up to 0.12 s. What was sent before sleep may be gone: send all again. After a failure the panel
 * still counts as asleep: call it again. */
int panel_wake(struct panel *panel);

#ifdef __cplusplus
}
#endif

#endif
