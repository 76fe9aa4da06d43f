/* SSD1306: one-bit OLEDs of 128x64, 128x32, 64x48 and 72x40.
 *
 * Rotate 0 is A1h C8h: segments and scan reversed, as modules are mounted. The picture is turned in convert, at 180
 * degrees too: its bytes are made anew in any case. Brightness is the contrast (81h). Arguments go with D/C low.
 * The light comes from the controller's own charge pump, which sleeps with it.
 * Glass of 72x40 has no resistor at IREF: the controller's later revision (SSD1306B) makes its own with ADh 30h.
 *
 * Source  Solomon Systech, SSD1306 datasheet, revision 1.1 (Apr 2008): 8.7 RAM, 8.9 power sequence, chapters 9 and
 *         10, commands 20h to 22h, 2Eh, 40h, 81h, A1h, A4h, A6h to A8h, AEh, AFh, C8h, D3h, D5h, D9h to DBh, E3h; its
 *         application note on the charge pump, 8Dh.
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

static const uint8_t setup[] = {
    1, 0xe3, /* NOPs, see panel_type.h */
    1, 0xe3,
    2, 0xd5, 0x80, /* oscillator, undivided */
    2, 0xd3, 0x00, /* offset */
    1, 0x40,       /* start line 0 */
    2, 0x20, 0x00, /* addresses step along the columns, then to the next page */
    1, 0xa1,       /* segments reversed */
    1, 0xc8,       /* scan reversed */
    2, 0xd9, 0xf1, /* phases */
    2, 0xdb, 0x20, /* VCOMH */
    1, 0xa4,       /* show the RAM */
    1, 0x2e,       /* no scrolling */
    0
};
static const uint8_t wake[] = { 2, 0x8d, 0x14, 0 }, sleep[] = { 2, 0x8d, 0x10, 0 }; /* charge pump on, off */

/* Lines and how the glass's commons are wired */
static const uint8_t lines_64[] = { 2, 0xa8, 63, 2, 0xda, 0x12, 0 };
static const uint8_t lines_48[] = { 2, 0xa8, 47, 2, 0xda, 0x12, 0 };
static const uint8_t lines_40[] = { 2, 0xa8, 39, 2, 0xda, 0x12, 2, 0xad, 0x30, 0 };
static const uint8_t lines_32[] = { 2, 0xa8, 31, 2, 0xda, 0x02, 0 };

static const struct panel_glass glass[] = { { 128, 64, 0, 0, lines_64 }, { 128, 32, 0, 0, lines_32 },
                                            { 64, 48, 32, 0, lines_48 }, { 72, 40, 28, 0, lines_40 } };

const struct panel_type panel_ssd1306 = {
    .name = "ssd1306", .format = PANEL_MONO, .grain = { 1, 8 },
    .ram_width = 128, .ram_height = 64, .glass = glass, .n_glass = sizeof glass / sizeof *glass,
    .strict = 1, .setup = setup, .wake = wake, .sleep = sleep,
    .on = 0xaf, .off = 0xae, .args_low = 1, .columns = 0x21, .rows = 0x22,
    .invert = { 0xa6, 0xa7 }, .level = 0x81,
    .convert = panel_convert_mono
};
