/* What makes a controller: struct panel_type, for panel.c and the file of each controller. Programs include panel.h.
 *
 * How to add a controller
 *   1. A file named after it with one const struct panel_type, its tables static beside it. Name the datasheet
 *      (name, revision, section) in the file's first comment, and what its modules have soldered: which way
 *      up rotate 0 is, what config.bgr means, what brightness does.
 *   2. A line in panel.h (extern) and one in types.c (panel_types).
 *   3. Rows in the tables of tests/unit/test_panel.c (the glass and its window commands; rotation, inversion,
 *      brightness), read in the datasheet and not in the file of step 1.
 * A set-up script is bytes: n, then n bytes of which the first is the command, and so on; n = 0 ends it. It must
 * leave the controller the same when it is sent a second time, at any moment, with the glass on, and it
 * must contain no command that waits. Where arguments go with D/C low, begin it with as many NOPs as the longest
 * command has arguments: a controller that was cut off in the middle of a command takes them for those.
 * What a new controller needs and no field here can say is a field more; the only function is convert.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PANEL_TYPE_H
#define PANEL_TYPE_H

#include "panel.h"

/* A glass that is sold with the controller. */
struct panel_glass {
    uint16_t width, height; /* px at rotate 0 */
    uint8_t x0, y0;         /* its left top pixel in the RAM, px; multiples of the type's grain */
    const uint8_t *setup;   /* script, sent after the type's; NULL: none */
};

/* A rectangle's pixels on their way to the scratch. */
struct panel_part {
    const uint8_t *px;
    uint32_t stride;               /* bytes from row to row */
    const struct panel_rect *rect; /* in the picture; a multiple of the grain */
    uint8_t rotate;
    uint8_t lsb_first;
};

struct panel_type {
    char name[8];
    uint8_t format;                     /* enum panel_format */
    struct panel_grain grain;           /* px of the glass at rotate 0 in one address of its RAM */
    uint16_t ram_width, ram_height;     /* px */
    const struct panel_glass *glass;    /* n_glass of them: their offsets are known */
    uint8_t n_glass;
    uint8_t strict;                     /* 1: other sizes are refused */

    const uint8_t *reset;               /* script after the RESET line, for boards without one; NULL: none */
    const uint8_t *setup;               /* everything that rotation, inversion and brightness do not set */
    const uint8_t *lsb_first;           /* script: pixels least significant byte first; NULL: the chip cannot */
    const uint8_t *te;                  /* script: tearing effect on; NULL: there is no such pin */
    const uint8_t *wake, *sleep;        /* scripts; NULL: nothing but on and off is needed */
    uint8_t on, off;                    /* commands */
    uint8_t reset_ms, wake_ms;          /* after reset; after each of wake and sleep */
    uint8_t args_low;                   /* 1: arguments of commands go with D/C low, as commands */

    uint8_t columns, rows;              /* commands: first and last address of the window */
    uint8_t write;                      /* command before pixels; 0: none */
    uint8_t wide;                       /* 1: addresses take two bytes, the upper one first */

    uint8_t rotate;                     /* command; 0: pictures are turned by convert */
    uint8_t rotation[4];                /* its argument at each rotation */
    uint8_t bgr;                        /* toggled in it where config.bgr is set */
    uint8_t by_scan;                    /* 1: rows are turned over by the direction of the scan, so that their
                                           addresses stay, and columns stay columns at rotate 1 and 3. 0: MIPI DCS,
                                           where both commands count in the picture, mirrored in the whole RAM */
    uint8_t invert[2];                  /* commands: straight, inverted */
    uint8_t level, level_shift;         /* command of brightness, 0: none; its argument is 0 .. 255 >> shift */

    /* Bytes for the wire from a part. NULL: pixels always travel as given. */
    void (*convert)(const struct panel_part *part, uint8_t *to);
};

/* What the controllers of the MIPI Display Command Set (dcs.c) have in common; their own fields follow it. */
extern const uint8_t panel_dcs_wake[], panel_dcs_sleep[], panel_dcs_te[];
#define PANEL_DCS                                                                                       \
    .format = PANEL_RGB565, .grain = { 1, 1 }, .te = panel_dcs_te, .wake = panel_dcs_wake,              \
    .sleep = panel_dcs_sleep, .on = 0x29, .off = 0x28, .reset_ms = 120, .wake_ms = 120, .columns = 0x2a, \
    .rows = 0x2b, .write = 0x2c, .wide = 1, .rotate = 0x36, .bgr = 0x08, .invert = { 0x20, 0x21 }, .level = 0x51

/* convert.c: the formats of panel.h; each writes w * h pixels of the part, in the order in which an unturned window
 * takes them. swap does not turn. */
void panel_convert_swap(const struct panel_part *part, uint8_t *to);
void panel_convert_grey4(const struct panel_part *part, uint8_t *to); /* left pixel in the upper nibble */
void panel_convert_mono(const struct panel_part *part, uint8_t *to);  /* pages of 8 rows, the top one in bit 0 */

#endif
