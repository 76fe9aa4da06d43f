/* ILI9341: TFTs of 240x320.
 *
 * Rotate 0 is MADCTL MX: on the glass that is sold with it the first source line is on the right. That glass mostly
 * wants config.bgr = 1 (MADCTL's BGR bit) too. Brightness is WRDISBV, which drives the controller's own
 * backlight pin; modules that do not wire it need hal_backlight. Interface control's ENDIAN bit is for the 8-bit and
 * 9-bit parallel interfaces only: pixels least significant byte first are swapped.
 * The set-up values for supply, timing and gamma are those of common modules.
 *
 * Source  ILI Technology, ILI9341 specification, version 1.11 (2011/06), chapter 8: software reset 01h (5 ms, 120 ms
 *         before sleep out), sleep 10h and 11h (120 ms between them), 20h, 21h, 2Ah to 2Ch, MADCTL 36h, COLMOD 3Ah,
 *         WRDISBV 51h, WRCTRLD 53h, frame control B1h, B6h, power and VCOM C0h to C7h, CBh, CFh, gamma 26h, E0h, E1h,
 *         timing E8h, EAh, EDh, interface control F6h, pump F7h.
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

#include <stddef.h>

static const uint8_t reset[] = { 1, 0x01, 0 };
static const uint8_t setup[] = {
    6, 0xcb, 0x39, 0x2c, 0x00, 0x34, 0x02, /* power control A */
    4, 0xcf, 0x00, 0xc1, 0x30,             /* power control B */
    4, 0xe8, 0x85, 0x00, 0x78,             /* driver timing A */
    3, 0xea, 0x00, 0x00,                   /* driver timing B */
    5, 0xed, 0x64, 0x03, 0x12, 0x81,       /* power on sequence */
    2, 0xf7, 0x20,                         /* pump ratio 2 */
    2, 0xc0, 0x23,                         /* 4.6 V for grey levels */
    2, 0xc1, 0x10,
    3, 0xc5, 0x3e, 0x28,                   /* VCOM */
    2, 0xc7, 0x86,
    2, 0x3a, 0x55,                         /* 16 bits a pixel */
    3, 0xb1, 0x00, 0x18,                   /* 79 frames a second */
    4, 0xb6, 0x08, 0x82, 0x27,             /* 320 lines, source and gate direction as reset leaves them */
    2, 0x26, 0x01,                         /* gamma curve 1, and what it is */
    16, 0xe0, 0x0f, 0x31, 0x2b, 0x0c, 0x0e, 0x08, 0x4e, 0xf1, 0x37, 0x07, 0x10, 0x03, 0x0e, 0x09, 0x00,
    16, 0xe1, 0x00, 0x0e, 0x14, 0x03, 0x11, 0x07, 0x31, 0xc1, 0x48, 0x08, 0x0f, 0x0c, 0x31, 0x36, 0x0f,
    1, 0x13,                               /* normal mode: no part of the RAM left out */
    2, 0x53, 0x24,                         /* brightness control and backlight on, without dimming */
    0
};

static const struct panel_glass glass[] = { { 240, 320, 0, 0, NULL } };

const struct panel_type panel_ili9341 = {
    PANEL_DCS,
    .name = "ili9341",
    .ram_width = 240, .ram_height = 320, .glass = glass, .n_glass = sizeof glass / sizeof *glass,
    .reset = reset, .setup = setup,
    .rotation = { 0x40, 0x20, 0x80, 0xe0 }, /* MX; MV; MY; MX MY MV */
    .convert = panel_convert_swap
};
