/* ILI9341. Source: Ilitek, ILI9341 datasheet V1.11: chapter 8, the lists of commands, DISCTRL and IFCTL; EFh and D9h,
 * which no datasheet has, as the maker's own set-up code and everybody's after it sends them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "dcs.h"

enum { SWRESET = 0x01, MADCTL = 0x36, DISCTRL = 0xb6, IFCTL = 0xf6 };

static const struct dcs_command commands[] = {
    { SWRESET, "SWRESET", 0, 0 }, { 0x26, "GAMSET", 1, 1 }, { 0x2d, "RGBSET", 128, 128 },
    { 0x2e, "RAMRD", 0, 0 }, { 0x3e, "RAMRDC", 0, 0 }, { 0x52, "RDDISBV", 0, 0 }, { 0x54, "RDCTRLD", 0, 0 },
    { 0x55, "WRCABC", 1, 1 }, { 0x56, "RDCABC", 0, 0 }, { 0x5e, "WRCABCMB", 1, 1 }, { 0x5f, "RDCABCMB", 0, 0 },
    { 0xb0, "IFMODE", 1, 1 }, { 0xb1, "FRMCTR1", 2, 2 }, { 0xb2, "FRMCTR2", 2, 2 }, { 0xb3, "FRMCTR3", 2, 2 },
    { 0xb4, "INVTR", 1, 1 }, { 0xb5, "PRCTR", 4, 4 },
    { DISCTRL, "DISCTRL", 3, 4 }, /* the fourth is for an external clock */
    { 0xb7, "ETMOD", 1, 1 }, { 0xb8, "BLCTRL1", 1, 1 }, { 0xb9, "BLCTRL2", 1, 1 }, { 0xba, "BLCTRL3", 1, 1 },
    { 0xbb, "BLCTRL4", 1, 1 }, { 0xbc, "BLCTRL5", 1, 1 }, { 0xbe, "BLCTRL7", 1, 1 }, { 0xbf, "BLCTRL8", 1, 1 },
    { 0xc0, "PWCTRL1", 1, 1 }, { 0xc1, "PWCTRL2", 1, 1 }, { 0xc5, "VMCTRL1", 2, 2 }, { 0xc7, "VMCTRL2", 1, 1 },
    { 0xcb, "PWCTRA", 5, 5 }, { 0xcf, "PWCTRB", 3, 3 }, { 0xd0, "NVMWR", 2, 2 }, { 0xd1, "NVMPKEY", 3, 3 },
    { 0xd2, "RDNVM", 0, 0 }, { 0xd3, "RDID4", 0, 0 }, { 0xd9, "SPI register index", 1, 1 },
    { 0xe0, "PGAMCTRL", 15, 15 }, { 0xe1, "NGAMCTRL", 15, 15 }, { 0xe2, "DGAMCTRL1", 16, 16 },
    { 0xe3, "DGAMCTRL2", 64, 64 }, { 0xe8, "DRVTIMCTLA1", 3, 3 }, { 0xe9, "DRVTIMCTLA2", 3, 3 },
    { 0xea, "DRVTIMCTLB", 2, 2 }, { 0xed, "PWONSEQ", 4, 4 }, { 0xef, "0xEF of the maker's code", 3, 3 },
    { 0xf2, "EN3GAMMA", 1, 1 }, { IFCTL, "IFCTL", 3, 3 }, { 0xf7, "PUMPCTL", 1, 1 },
};

static void defaults(uint8_t reg[256][DCS_KEPT])
{
    reg[DISCTRL][0] = 0x0a;
    reg[DISCTRL][1] = 0x82;
    reg[DISCTRL][2] = 0x27;
    reg[IFCTL][0] = 0x01;
}

/* IFCTL's upper bits turn over those of MADCTL at the same places. */
static uint8_t madctl(const uint8_t reg[256][DCS_KEPT])
{
    return (uint8_t)(reg[MADCTL][0] ^ (reg[IFCTL][0] & 0xe8));
}

/* REV: 1 for glass that is white without a voltage, as modules have. */
static int inverts(const uint8_t reg[256][DCS_KEPT])
{
    return !(reg[DISCTRL][1] & 0x80);
}

/* GS: gates from the other end; NL: 8 * (NL + 1) lines. */
static int line(const uint8_t reg[256][DCS_KEPT], int row, int rows)
{
    const int n = reg[DISCTRL][1] & 0x40 ? rows - 1 - row : row;
    return n < 8 * ((reg[DISCTRL][2] & 63) + 1) ? n : -1;
}

/* SS: sources from the other end. */
static int column(const uint8_t reg[256][DCS_KEPT], int x, int columns)
{
    return reg[DISCTRL][1] & 0x20 ? columns - 1 - x : x;
}

/* WEMODE 0 */
static int drops_excess(const uint8_t reg[256][DCS_KEPT])
{
    return !(reg[IFCTL][0] & 1);
}

static const char *wrong(uint8_t code, const uint8_t reg[256][DCS_KEPT])
{
    if (code == IFCTL && (reg[IFCTL][2] & 0x0e) != 0)
        return "the RAM is given to the RGB or VSYNC interface";
    return NULL;
}

static const struct dcs_type ili9341 = {
    .command = commands, .n_commands = sizeof commands / sizeof commands[0], .defaults = defaults,
    .madctl = madctl, .inverts = inverts, .line = line, .column = column, .drops_excess = drops_excess,
    .wrong = wrong,
};

const struct pm_type pm_type_ili9341 = { "ili9341", 240, 320, PM_RGB565, 5000, DCS_MODEL(ili9341) };
