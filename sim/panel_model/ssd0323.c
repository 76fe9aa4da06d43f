/* SSD0323. Source: Solomon Systech, SSD0323 datasheet: command table, GDDRAM map. How the remapped scan
 * counts with an offset and fewer than 80 lines it leaves open; taken from settings in use. Glass on COM12 .. COM75
 * is upright with 52 and 4C (arguments of A0 and A2), glass on COM0 .. COM63 with 52 and 40, and turned with 41 and
 * 50: the reversed scan counts from COM79.
 *
 * A column address is a byte, two pixels. Columns and nibbles are remapped when they are written.
 *
 * SPDX-License-Identifier: MIT
 */
#include "solomon.h"

enum { COLUMNS = 64, ROWS = 80 };

static const struct solomon_command commands[] = {
    { 0x15, 0x15, "set column address", 2 }, { 0x23, 0x23, "graphic acceleration options", 1 },
    { 0x24, 0x24, "draw rectangle", 5 }, { 0x25, 0x25, "copy", 6 }, { 0x26, 0x26, "horizontal scroll", 4 },
    { 0x2e, 0x2e, "stop moving", 0 }, { 0x2f, 0x2f, "start moving", 0 }, { 0x75, 0x75, "set row address", 2 },
    { 0x81, 0x81, "set contrast", 1 }, { 0x84, 0x86, "set current range", 0 }, { 0xa0, 0xa0, "set remap", 1 },
    { 0xa1, 0xa1, "set display start line", 1 }, { 0xa2, 0xa2, "set display offset", 1 },
    { 0xa4, 0xa7, "set display mode", 0 }, { 0xa8, 0xa8, "set multiplex ratio", 1 },
    { 0xad, 0xad, "set master configuration", 1 }, { 0xae, 0xaf, "set display on or off", 0 },
    { 0xb0, 0xb0, "set precharge compensation enable", 1 }, { 0xb1, 0xb1, "set phase length", 1 },
    { 0xb2, 0xb2, "set row period", 1 }, { 0xb3, 0xb3, "set clock", 1 },
    { 0xb4, 0xb4, "set precharge compensation level", 1 }, { 0xb8, 0xb8, "set grey scale table", 8 },
    { 0xbc, 0xbc, "set precharge voltage", 1 }, { 0xbe, 0xbe, "set VCOMH", 1 },
    { 0xbf, 0xbf, "set segment low voltage", 1 }, { 0xe3, 0xe3, "NOP", 0 },
};

static void set_remap(struct pm_model *m, uint8_t remap)
{
    struct solomon *s = m->state;
    s->remap = remap;
    s->downwards = remap >> 2 & 1;
    s->reversed = remap >> 4 & 1;
    s->split = remap >> 6 & 1;
    if (remap & 0xa8)
        solomon_wrong(m, "sets a bit that is not used", remap);
}

static void set_rows(struct pm_model *m, uint8_t code, uint8_t n)
{
    struct solomon *s = m->state;
    if (n > ROWS || (code == 0xa8 && (n < 15 || n >= ROWS)))
        solomon_wrong(m, "is out of range", n);
    if (code == 0xa8)
        s->rows = (uint8_t)(n % ROWS + 1);
    else if (code == 0xa1)
        s->start = n % ROWS;
    else
        s->offset = n % ROWS;
}

/* Two pixels at a column and row of the RAM. */
static void put(struct pm_model *m, int column, int row, uint8_t byte)
{
    const struct solomon *s = m->state;
    const uint32_t high = byte >> 4, low = byte & 15;
    const int left_high = s->remap & 2;
    const int x = 2 * (s->remap & 1 ? COLUMNS - 1 - column : column);
    if (column >= COLUMNS || row >= ROWS)
        return;
    *pm_ram_at(m, x, row) = left_high ? high : low;
    *pm_ram_at(m, x + 1, row) = left_high ? low : high;
    m->counts.pixels += 2;
}

static void rectangle(struct pm_model *m, const uint8_t *a)
{
    const struct solomon *s = m->state;
    if (a[0] > a[2] || a[1] > a[3] || a[2] >= COLUMNS || a[3] >= ROWS)
        pm_note(m, PM_WINDOW, s->now_at, "draw rectangle from %d,%d to %d,%d is not inside of the RAM", a[0], a[1],
                a[2], a[3]);
    for (int y = a[1]; y <= a[3]; y++)
        for (int x = a[0]; x <= a[2]; x++)
            if (s->fill || y == a[1] || y == a[3] || x == a[0] || x == a[2])
                put(m, x, y, a[4]);
}

static const enum solomon_show shows[4] = { SHOW_RAM, SHOW_ALL, SHOW_NONE, SHOW_NEGATIVE };

static void run(struct pm_model *m, uint8_t code, const uint8_t *args)
{
    struct solomon *s = m->state;
    if (solomon_switch(s, code, shows))
        return;
    if (code == 0x15 || code == 0x75)
        solomon_window(m, code == 0x75, args[0], args[1], code == 0x75 ? ROWS : COLUMNS);
    else if (code == 0x23)
        s->fill = args[0] & 1;
    else if (code == 0x24)
        rectangle(m, args);
    else if (code == 0x81)
        s->light.level[0] = args[0];
    else if (code == 0xa0)
        set_remap(m, args[0]);
    else if (code == 0xa1 || code == 0xa2 || code == 0xa8)
        set_rows(m, code, args[0]);
    else if (code == 0x25 || code == 0x2f)
        pm_note(m, PM_VALUE, s->now_at, "%s is not followed by this model", s->now->name);
}

static void data(struct pm_model *m, uint8_t byte)
{
    struct solomon *s = m->state;
    put(m, s->x, s->y, byte);
    solomon_step(s);
}

static const struct solomon_type type = { commands, sizeof commands / sizeof commands[0], 1, ROWS, 1, run, data };

static void reset(struct pm_model *m)
{
    struct solomon *s = m->state;
    solomon_reset(m, COLUMNS, ROWS);
    s->light.level[0] = 0x40;
}

static uint32_t seen(const struct pm_model *m, int x, int y)
{
    const int row = solomon_ram_row(m, y, 1);
    return row < 0 ? 0 : solomon_shown(m, pm_ram_get(m, m->glass.x0 + x, row), 15);
}

const struct pm_type pm_type_ssd0323 = {
    "ssd0323", 2 * COLUMNS, ROWS, PM_GREY4, 3, sizeof(struct solomon), reset, solomon_byte, solomon_end,
    solomon_lit, seen, solomon_light, &type
};
