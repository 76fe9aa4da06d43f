/* SSD1306. Source: Solomon Systech, SSD1306 datasheet rev 1.1 (with the charge pump's application note): command
 * table in chapter 9, chapter 10 with tables 10-1 to 10-3, GDDRAM in chapter 8; ADh, 23h and D6h: SSD1306B datasheet.
 *
 * Columns are remapped when they are written: the RAM here is by segment pins.
 *
 * SPDX-License-Identifier: MIT
 */
#include "solomon.h"

enum { COLUMNS = 128, PAGES = 8, ROWS = 64 };

static const struct solomon_command commands[] = {
    { 0x00, 0x0f, "set lower column start", 0 }, { 0x10, 0x1f, "set higher column start", 0 },
    { 0x20, 0x20, "set memory addressing mode", 1 }, { 0x21, 0x21, "set column address", 2 },
    { 0x22, 0x22, "set page address", 2 }, { 0x23, 0x23, "set fade out and blinking", 1 },
    { 0x26, 0x27, "horizontal scroll", 6 }, { 0x29, 0x2a, "vertical and horizontal scroll", 5 },
    { 0x2e, 0x2e, "deactivate scroll", 0 }, { 0x2f, 0x2f, "activate scroll", 0 },
    { 0x40, 0x7f, "set display start line", 0 }, { 0x81, 0x81, "set contrast", 1 },
    { 0x8d, 0x8d, "charge pump setting", 1 }, { 0xa0, 0xa1, "set segment remap", 0 },
    { 0xa3, 0xa3, "set vertical scroll area", 2 }, { 0xa4, 0xa5, "entire display on", 0 },
    { 0xa6, 0xa7, "set inverse display", 0 }, { 0xa8, 0xa8, "set multiplex ratio", 1 },
    { 0xad, 0xad, "set current reference", 1 }, { 0xae, 0xaf, "set display on or off", 0 },
    { 0xb0, 0xb7, "set page start", 0 }, { 0xc0, 0xc0, "set COM scan direction", 0 },
    { 0xc8, 0xc8, "set COM scan direction", 0 }, { 0xd3, 0xd3, "set display offset", 1 },
    { 0xd5, 0xd5, "set clock", 1 }, { 0xd6, 0xd6, "set zoom in", 1 }, { 0xd9, 0xd9, "set precharge period", 1 },
    { 0xda, 0xda, "set COM pins", 1 }, { 0xdb, 0xdb, "set VCOMH", 1 }, { 0xe3, 0xe3, "NOP", 0 },
};

static void set_mode(struct pm_model *m, uint8_t mode)
{
    struct solomon *s = m->state;
    if (mode > 2)
        solomon_wrong(m, "is no addressing mode", mode);
    s->paged = (mode & 3) >= 2;
    s->downwards = (mode & 3) == 1;
}

static void set_pins(struct pm_model *m, uint8_t pins)
{
    struct solomon *s = m->state;
    if ((pins & 0xcf) != 0x02)
        solomon_wrong(m, "has bits that are 0 or 1 in the datasheet the other way", pins);
    s->split = pins >> 4 & 1;
    s->sides = pins >> 5 & 1;
}

static void set_rows(struct pm_model *m, uint8_t n)
{
    struct solomon *s = m->state;
    if (n < 15 || n > 63)
        solomon_wrong(m, "is out of range, 15 to 63", n);
    s->rows = (uint8_t)((n & 63) + 1);
}

static void set_offset(struct pm_model *m, uint8_t n)
{
    struct solomon *s = m->state;
    if (n > 63)
        solomon_wrong(m, "is out of range, 0 to 63", n);
    s->offset = n & 63;
}

static void set_on(struct pm_model *m, int on)
{
    struct solomon *s = m->state;
    s->on = on != 0;
    if (on && !s->pump)
        pm_note(m, PM_STATE, s->now_at, "the display is switched on without its charge pump and stays dark");
}

/* Commands whose code holds their value. */
static void run_short(struct pm_model *m, uint8_t code)
{
    struct solomon *s = m->state;
    if (code <= 0x0f) {
        s->x = (s->x & 0xf0) | code;
        s->moved = 1;
    } else if (code <= 0x1f) {
        s->x = (s->x & 0x0f) | (code & 7) << 4;
        s->moved = 1;
        if (code & 8)
            solomon_wrong(m, "is a column out of the RAM", code);
    } else if (code >= 0x40 && code <= 0x7f) {
        s->start = code & 63;
    } else if (code >= 0xb0 && code <= 0xb7) {
        s->y = code & 7;
        s->moved = 1;
    } else if (code == 0x2f) {
        pm_note(m, PM_VALUE, s->now_at, "the picture scrolls with time, which this model does not follow");
    }
}

/* Switches: the lowest bit, or for C0 and C8 the fourth. */
static void run_switch(struct pm_model *m, uint8_t code)
{
    struct solomon *s = m->state;
    switch (code & 0xfe) {
    case 0xa0:
        s->remap = code & 1;
        break;
    case 0xa4: /* goes before A6 and A7 */
        s->fill = code & 1;
        break;
    case 0xa6:
        s->show = code & 1 ? SHOW_NEGATIVE : SHOW_RAM;
        break;
    case 0xae:
        set_on(m, code & 1);
        break;
    case 0xc0:
    case 0xc8:
        s->reversed = code >> 3 & 1;
        break;
    default:
        run_short(m, code);
        break;
    }
}

/* Arguments that change nothing that is seen, but may be wrong. */
static void check(struct pm_model *m, uint8_t code, const uint8_t *args)
{
    if (code == 0x8d && (args[0] & 0x3b) != 0x10)
        solomon_wrong(m, "has bits that are 0 or 1 in the datasheet the other way", args[0]);
    else if (code == 0xa3 && ((args[0] & 0xc0) != 0 || (args[1] & 0x80) != 0))
        solomon_wrong(m, "sets bits that are not used", args[0]);
    else if (code == 0xd9 && ((args[0] & 0x0f) == 0 || (args[0] & 0xf0) == 0))
        solomon_wrong(m, "has a phase of 0 clocks", args[0]);
    else if (code == 0xdb && (args[0] & 0x8f) != 0)
        solomon_wrong(m, "sets bits that are not used", args[0]);
}

static void run(struct pm_model *m, uint8_t code, const uint8_t *args)
{
    struct solomon *s = m->state;
    switch (code) {
    case 0x20:
        set_mode(m, args[0]);
        break;
    case 0x21:
        solomon_window(m, 0, args[0], args[1], COLUMNS);
        break;
    case 0x22:
        solomon_window(m, 1, args[0], args[1], PAGES);
        break;
    case 0x81:
        s->light.level[0] = args[0];
        break;
    case 0x8d:
        s->pump = args[0] >> 2 & 1;
        check(m, code, args);
        break;
    case 0xa8:
        set_rows(m, args[0]);
        break;
    case 0xd3:
        set_offset(m, args[0]);
        break;
    case 0xda:
        set_pins(m, args[0]);
        break;
    case 0xa3:
    case 0xd9:
    case 0xdb:
        check(m, code, args);
        break;
    default:
        run_switch(m, code);
        break;
    }
}

static void data(struct pm_model *m, uint8_t byte)
{
    struct solomon *s = m->state;
    if (s->x < COLUMNS && s->y < PAGES) {
        const int x = s->remap ? COLUMNS - 1 - s->x : s->x;
        for (int i = 0; i < 8; i++)
            *pm_ram_at(m, x, s->y * 8 + i) = byte >> i & 1u;
        m->counts.pixels += 8;
    }
    if (s->paged)
        s->x = (s->x + 1) % COLUMNS;
    else
        solomon_step(s);
}

static const struct solomon_type type = { commands, sizeof commands / sizeof commands[0], 1, ROWS, 0, run, data };

static void reset(struct pm_model *m)
{
    struct solomon *s = m->state;
    solomon_reset(m, COLUMNS, PAGES);
    s->paged = 1;
    s->split = 1;
    s->light.level[0] = 0x7f;
}

static int lit(const struct pm_model *m)
{
    const struct solomon *s = m->state;
    return s->on && s->pump;
}

static uint32_t seen(const struct pm_model *m, int x, int y)
{
    const struct solomon *s = m->state;
    const int row = solomon_ram_row(m, y, !m->glass.sequential);
    if (row < 0)
        return 0;
    if (s->fill)
        return 1;
    return solomon_shown(m, pm_ram_get(m, COLUMNS - 1 - m->glass.x0 - x, row), 1);
}

const struct pm_type pm_type_ssd1306 = {
    "ssd1306", COLUMNS, ROWS, PM_MONO, 3, sizeof(struct solomon), reset, solomon_byte, solomon_end, lit,
    seen, solomon_light, &type
};
