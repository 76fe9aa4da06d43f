/* ST7789V. Source: Sitronix, ST7789V datasheet V1.3 (2014): chapter 9, both command tables, RAMCTRL, LCMCTRL and
 * GATECTRL.
 *
 * SPDX-License-Identifier: MIT
 */
#include "dcs.h"

enum { SWRESET = 0x01, MADCTL = 0x36, RAMCTRL = 0xb0, LCMCTRL = 0xc0, GATECTRL = 0xe4 };

/* LCMCTRL's bits turn over what MADCTL and INVON say; modules are built for its default. */
enum { LCM_DEFAULT = 0x2c, XMY = 0x40, XBGR = 0x20, XREV = 0x10, XMX = 0x08, XMV = 0x02 };

static const struct dcs_command commands[] = {
    { SWRESET, "SWRESET", 0, 0 }, { 0x26, "GAMSET", 1, 1 }, { 0x2e, "RAMRD", 0, 0 }, { 0x3e, "RAMRDC", 0, 0 },
    { 0x52, "RDDISBV", 0, 0 }, { 0x54, "RDCTRLD", 0, 0 }, { 0x55, "WRCACE", 1, 1 }, { 0x56, "RDCABC", 0, 0 },
    { 0x5e, "WRCABCMB", 1, 1 }, { 0x5f, "RDCABCMB", 0, 0 }, { 0x68, "RDABCSDR", 0, 0 },
    { RAMCTRL, "RAMCTRL", 2, 2 }, { 0xb1, "RGBCTRL", 3, 3 }, { 0xb2, "PORCTRL", 5, 5 },
    { 0xb3, "FRCTRL1", 3, 3 }, { 0xb5, "PARCTRL", 1, 1 }, { 0xb7, "GCTRL", 1, 1 }, { 0xb8, "GTADJ", 4, 4 },
    { 0xba, "DGMEN", 1, 1 }, { 0xbb, "VCOMS", 1, 1 }, { 0xbc, "POWSAVE", 1, 1 }, { 0xbd, "DLPOFFSAVE", 1, 1 },
    { LCMCTRL, "LCMCTRL", 1, 1 }, { 0xc1, "IDSET", 3, 3 },
    { 0xc2, "VDVVRHEN", 1, 2 }, /* the second is a constant that few send */
    { 0xc3, "VRHS", 1, 1 }, { 0xc4, "VDVS", 1, 1 }, { 0xc5, "VCMOFSET", 1, 1 }, { 0xc6, "FRCTRL2", 1, 1 },
    { 0xc7, "CABCCTRL", 1, 1 }, { 0xc8, "REGSEL1", 1, 1 }, { 0xca, "REGSEL2", 1, 1 },
    { 0xcc, "PWMFRSEL", 1, 1 }, { 0xd0, "PWCTRL1", 2, 2 }, { 0xd2, "VAPVANEN", 1, 1 }, { 0xdf, "CMD2EN", 4, 4 },
    { 0xe0, "PVGAMCTRL", 14, 14 }, { 0xe1, "NVGAMCTRL", 14, 14 }, { 0xe2, "DGMLUTR", 64, 64 },
    { 0xe3, "DGMLUTB", 64, 64 }, { GATECTRL, "GATECTRL", 3, 3 }, { 0xe7, "SPI2EN", 1, 1 },
    { 0xe8, "PWCTRL2", 1, 1 }, { 0xe9, "EQCTRL", 3, 3 }, { 0xec, "PROMCTRL", 1, 1 }, { 0xfa, "PROMEN", 4, 4 },
    { 0xfc, "NVMSET", 2, 2 }, { 0xfe, "PROMACT", 2, 2 },
};

static void defaults(uint8_t reg[256][DCS_KEPT])
{
    reg[RAMCTRL][1] = 0xf0;
    reg[LCMCTRL][0] = LCM_DEFAULT;
    reg[GATECTRL][0] = 0x27; /* 320 lines */
    reg[GATECTRL][2] = 0x10;
}

static uint8_t madctl(const uint8_t reg[256][DCS_KEPT])
{
    const unsigned x = reg[LCMCTRL][0] ^ LCM_DEFAULT;
    const unsigned turned = (x & XMY ? 0x80u : 0u) | (x & XMX ? 0x40u : 0u) | (x & XMV ? 0x20u : 0u) |
                            (x & XBGR ? 0x08u : 0u);
    return (uint8_t)(reg[MADCTL][0] ^ turned);
}

static int inverts(const uint8_t reg[256][DCS_KEPT])
{
    return (reg[LCMCTRL][0] & XREV) != 0;
}

/* Gates are scanned from 8 * SCN on, 8 * (NL + 1) of them; with GS from the other end. */
static int line(const uint8_t reg[256][DCS_KEPT], int row, int rows)
{
    const int lines = 8 * ((reg[GATECTRL][0] & 63) + 1), first = 8 * (reg[GATECTRL][1] & 63);
    const int n = (reg[GATECTRL][2] & 1 ? rows - 1 - row : row) - first;
    return n < 0 || n >= lines ? -1 : n;
}

static int little_endian(const uint8_t reg[256][DCS_KEPT])
{
    return reg[RAMCTRL][1] >> 3 & 1;
}

static const char *wrong(uint8_t code, const uint8_t reg[256][DCS_KEPT])
{
    if (code == RAMCTRL && (reg[RAMCTRL][0] & 0x13) != 0)
        return "the RAM is given to the RGB or VSYNC interface";
    if (code == RAMCTRL && (reg[RAMCTRL][1] & 0xc0) != 0xc0)
        return "the two highest bits of the second argument are 1 in the datasheet";
    if (code == GATECTRL && (reg[GATECTRL][2] & 4) != 0)
        return "interlaced gates are not those of any module here";
    return NULL;
}

static const struct dcs_type st7789 = {
    .command = commands, .n_commands = sizeof commands / sizeof commands[0], .bits_12 = 1,
    .defaults = defaults, .madctl = madctl, .inverts = inverts, .line = line, .little_endian = little_endian,
    .wrong = wrong,
};

const struct pm_type pm_type_st7789 = { "st7789", 240, 320, PM_RGB565, 5000, DCS_MODEL(st7789) };
