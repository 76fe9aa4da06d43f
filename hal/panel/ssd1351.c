/* SSD1351: colour OLEDs of 128x128 and 128x96.
 *
 * Rotate 0 is A0h with its bit 4 set: the scan goes from the last common line to the first, and modules have the
 * last one on top. With N lines multiplexed (CAh) it begins at line N - 1, so the start line (A1h) and the offset
 * (A2h) are 0 for both sizes at all rotations. Bit 1 turns columns over, bit 0 lets addresses step down before they
 * step right: windows stay in columns and rows. Bit 2 puts the upper bits of a pixel on the first of its three
 * segments, which is red on modules; config.bgr clears it. Brightness is the master current (C7h), 16 steps.
 * There is no order of bytes to set: pixels least significant byte first are swapped.
 * Set-up values for supply and timing are those of common modules.
 *
 * Source  Solomon Systech, SSD1351 datasheet, revision 1.5 (Jan 2011): 8.9 power sequence, chapters 9 and 10: 15h,
 *         75h, 5Ch, A0h to A2h, A6h, A7h, ABh, AEh, AFh, B1h, B3h to B6h, BBh, BEh, C1h, C7h, CAh, FDh.
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

static const uint8_t setup[] = {
    2, 0xfd, 0x12, /* commands unlocked */
    2, 0xfd, 0xb1, /* A2, B1, B3, BB, BE, C1 too */
    2, 0xb3, 0xf1, /* oscillator, divided by 2 */
    2, 0xa1, 0x00, /* start line */
    2, 0xa2, 0x00, /* offset */
    2, 0xb5, 0x00, /* no GPIO */
    2, 0xab, 0x01, /* own VDD regulator */
    2, 0xb1, 0x32, /* phases */
    2, 0xbb, 0x17, /* pre-charge */
    2, 0xbe, 0x05, /* VCOMH */
    4, 0xc1, 0xc8, 0x80, 0xc8, /* current of the three colours */
    4, 0xb4, 0xa0, 0xb5, 0x55, /* external VSL */
    2, 0xb6, 0x01, /* second pre-charge */
    0
};
static const uint8_t lines_128[] = { 2, 0xca, 127, 0 }, lines_96[] = { 2, 0xca, 95, 0 };

static const struct panel_glass glass[] = { { 128, 128, 0, 0, lines_128 }, { 128, 96, 0, 0, lines_96 } };

const struct panel_type panel_ssd1351 = {
    .name = "ssd1351", .format = PANEL_RGB565, .grain = { 1, 1 },
    .ram_width = 128, .ram_height = 128, .glass = glass, .n_glass = sizeof glass / sizeof *glass,
    .strict = 1, .setup = setup,
    .on = 0xaf, .off = 0xae, .columns = 0x15, .rows = 0x75, .write = 0x5c,
    .rotate = 0xa0,
    .rotation = { 0x74, 0x77, 0x66, 0x65 }, /* 65k colours and commons split throughout */
    .bgr = 0x04,
    .by_scan = 1,
    .invert = { 0xa6, 0xa7 }, .level = 0xc7, .level_shift = 4,
    .convert = panel_convert_swap
};
