/* ST7789: TFTs of up to 240x320, on glass of 240x240, 240x320, 135x240, 240x280, 172x320, 170x320 and others (give x0,
 * y0).
 *
 * Rotate 0 is MADCTL 0. Most modules are IPS glass: config.invert = 1. bgr: MADCTL's RGB bit. Brightness is WRDISBV,
 * which drives the controller's own backlight pin; modules that do not wire it need hal_backlight. RAMCTRL's ENDIAN
 * takes pixels least significant byte first (over SPI too, as drivers in use show; the datasheet only says 8 bits).
 * Voltages and gamma stay as reset leaves them: they belong to the glass, and the defaults show a right picture.
 *
 * Source  Sitronix, ST7789V datasheet, version 1.3 (2014/03), chapter 9: SWRESET 01h (5 ms, 120 ms before SLPOUT),
 *         SLPIN 10h and SLPOUT 11h (120 ms between them), INVOFF 20h, INVON 21h, CASET 2Ah, RASET 2Bh, RAMWR 2Ch,
 *         MADCTL 36h, COLMOD 3Ah, WRDISBV 51h, WRCTRLD 53h, RAMCTRL B0h; chapter 8, MADCTL's figures.
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

#include <stddef.h>

static const uint8_t reset[] = { 1, 0x01, 0 };
static const uint8_t setup[] = {
    2, 0x3a, 0x55, /* 16 bits a pixel */
    1, 0x13,       /* normal mode: no part of the RAM left out */
    2, 0x53, 0x24, /* brightness control and backlight on, without dimming */
    0
};
static const uint8_t lsb_first[] = { 3, 0xb0, 0x00, 0xf8, 0 };

static const struct panel_glass glass[] = { { 240, 320, 0, 0, NULL }, { 240, 240, 0, 0, NULL },
                                            { 135, 240, 52, 40, NULL }, { 240, 280, 0, 20, NULL },
                                            { 172, 320, 34, 0, NULL }, { 170, 320, 35, 0, NULL } };

const struct panel_type panel_st7789 = {
    PANEL_DCS,
    .name = "st7789",
    .ram_width = 240, .ram_height = 320, .glass = glass, .n_glass = sizeof glass / sizeof *glass,
    .reset = reset, .setup = setup, .lsb_first = lsb_first,
    .rotation = { 0x00, 0x60, 0xc0, 0xa0 }, /* none; MX MV; MX MY; MY MV */
};
