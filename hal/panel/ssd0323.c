/* SSD0323: OLEDs of 128x64 with 16 grey levels (OSRAM Pictiva and its like).
 *
 * Rotate 0 is A0h 52h with the offset (A2h) that its glass needs: scan reversed, commons split into odd and even, and
 * nibbles swapped, so that the left pixel is the upper one. The picture is turned in convert, at 180 degrees too: by
 * A0h, the offset would have to change with it. Brightness is the contrast (81h), 128 steps, in the half current
 * range. Arguments go with D/C low.
 * Set-up values for supply and timing are those of the 128x64 Pictiva, fed by the controller's DC-DC converter. The
 * grey scale (B8h) stays as reset leaves it.
 *
 * Source  Solomon Systech, SSD0323 datasheet, revision 1.3 (Oct 2004), command table and descriptions: 15h, 75h, 81h,
 *         84h to 86h, A0h to A2h, A4h to A8h, ADh to AFh, B1h to B3h, BCh, BEh, BFh, E3h.
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

#include <stddef.h>

static const uint8_t setup[] = {
    1, 0xe3, /* NOPs, see panel_type.h */
    1, 0xe3,
    1, 0x85,       /* half current range */
    2, 0xa0, 0x52, /* rows before columns; the rest above */
    2, 0xa1, 0x00, /* start line */
    2, 0xa2, 0x4c, /* offset */
    2, 0xa8, 0x3f, /* 64 lines */
    2, 0xb1, 0x22, /* phases */
    2, 0xb2, 0x46, /* row period */
    2, 0xb3, 0xf1, /* oscillator, divided by 2 */
    2, 0xbc, 0x10, /* pre-charge */
    2, 0xbe, 0x02, /* VCOMH */
    2, 0xbf, 0x0d, /* VSL */
    0
};
static const uint8_t wake[] = { 2, 0xad, 0x03, 0 }, sleep[] = { 2, 0xad, 0x02, 0 }; /* DC-DC converter on, off */

static const struct panel_glass glass[] = { { 128, 64, 0, 0, NULL } };

const struct panel_type panel_ssd0323 = {
    .name = "ssd0323", .format = PANEL_GREY4, .grain = { 2, 1 },
    .ram_width = 128, .ram_height = 80, .glass = glass, .n_glass = sizeof glass / sizeof *glass,
    .strict = 1, .setup = setup, .wake = wake, .sleep = sleep,
    .on = 0xaf, .off = 0xae, .args_low = 1, .columns = 0x15, .rows = 0x75,
    .invert = { 0xa4, 0xa7 }, .level = 0x81, .level_shift = 1,
    .convert = panel_convert_grey4
};
