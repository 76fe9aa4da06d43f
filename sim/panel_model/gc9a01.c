/* GC9A01A. Source: GalaxyCore, GC9A01A datasheet V1.0 (2019): chapter 6. It leaves out most of what the maker's own
 * set-up code sends, and everybody's after it; those commands are here by number, with that code's argument counts.
 *
 * SPDX-License-Identifier: MIT
 */
#include "dcs.h"

enum { DFUNCTR = 0xb6 };

static const struct dcs_command commands[] = {
    { 0x33, "VSCRDEF", 4, 6 }, /* the lines below the scrolling area may be left out */
    { 0x35, "TEON", 0, 1 },    /* and so is its argument in the maker's code */
    { 0xa7, "VCORE", 1, 1 }, { 0xb0, "RGBCTRL", 1, 1 }, { 0xb5, "PRCTR", 3, 4 }, { DFUNCTR, "DFUNCTR", 2, 2 },
    { 0xba, "TECTRL", 1, 1 }, { 0xc1, "PWCTRL1", 1, 1 }, { 0xc3, "VREG1A", 1, 1 }, { 0xc4, "VREG1B", 1, 1 },
    { 0xc9, "VREG2A", 1, 1 }, { 0xe8, "FRAMERATE", 1, 1 }, { 0xe9, "SPI2DATA", 1, 1 },
    { 0xec, "CHARGEPUMP", 1, 1 }, { 0xef, "INREGEN2", 0, 0 }, { 0xf0, "GAMMA1", 6, 6 },
    { 0xf1, "GAMMA2", 6, 6 }, { 0xf2, "GAMMA3", 6, 6 }, { 0xf3, "GAMMA4", 6, 6 }, { 0xf6, "IFCTL", 1, 1 },
    { 0xfe, "INREGEN1", 0, 0 }, { 0x62, "0x62 of the maker's code", 12, 12 },
    { 0x63, "0x63 of the maker's code", 12, 12 }, { 0x64, "0x64 of the maker's code", 7, 7 },
    { 0x66, "0x66 of the maker's code", 10, 10 }, { 0x67, "0x67 of the maker's code", 10, 10 },
    { 0x70, "0x70 of the maker's code", 9, 9 }, { 0x74, "0x74 of the maker's code", 7, 7 },
    { 0x84, "0x84 of the maker's code", 1, 1 }, { 0x85, "0x85 of the maker's code", 1, 1 },
    { 0x86, "0x86 of the maker's code", 1, 1 }, { 0x87, "0x87 of the maker's code", 1, 1 },
    { 0x88, "0x88 of the maker's code", 1, 1 }, { 0x89, "0x89 of the maker's code", 1, 1 },
    { 0x8a, "0x8A of the maker's code", 1, 1 }, { 0x8b, "0x8B of the maker's code", 1, 1 },
    { 0x8c, "0x8C of the maker's code", 1, 1 }, { 0x8d, "0x8D of the maker's code", 1, 1 },
    { 0x8e, "0x8E of the maker's code", 1, 1 }, { 0x8f, "0x8F of the maker's code", 1, 1 },
    { 0x90, "0x90 of the maker's code", 4, 4 }, { 0x98, "0x98 of the maker's code", 2, 2 },
    { 0x99, "0x99 of the maker's code", 2, 2 }, { 0xae, "0xAE of the maker's code", 1, 1 },
    { 0xbc, "0xBC of the maker's code", 1, 1 }, { 0xbd, "0xBD of the maker's code", 1, 1 },
    { 0xbe, "0xBE of the maker's code", 1, 1 }, { 0xcd, "0xCD of the maker's code", 1, 1 },
    { 0xdf, "0xDF of the maker's code", 3, 3 }, { 0xe1, "0xE1 of the maker's code", 2, 2 },
    { 0xeb, "0xEB of the maker's code", 1, 1 }, { 0xed, "0xED of the maker's code", 2, 2 },
    { 0xff, "0xFF of the maker's code", 3, 3 },
};

/* GS: gates from the other end. */
static int line(const uint8_t reg[256][DCS_KEPT], int row, int rows)
{
    return reg[DFUNCTR][1] & 0x40 ? rows - 1 - row : row;
}

/* SS: sources from the other end. */
static int column(const uint8_t reg[256][DCS_KEPT], int x, int columns)
{
    return reg[DFUNCTR][1] & 0x20 ? columns - 1 - x : x;
}

static const struct dcs_type gc9a01 = {
    .command = commands, .n_commands = sizeof commands / sizeof commands[0], .bits_12 = 1, .line = line,
    .column = column,
};

const struct pm_type pm_type_gc9a01 = { "gc9a01", 240, 240, PM_RGB565, 5000, DCS_MODEL(gc9a01) };
