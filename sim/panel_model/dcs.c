/* The MIPI display command set as these controllers have it. Source: MIPI Alliance Specification for Display Command
 * Set; ST7789V datasheet V1.3, chapters 8 (address control) and 9; ILI9341 datasheet V1.11, chapter 8.
 *
 * Addresses count columns and pages as the host sees them; MADCTL's MY, MX and MV say where in the RAM that is, when
 * a pixel is written. Its BGR bit, inversion, scrolling, partial and idle mode work between RAM and glass.
 *
 * SPDX-License-Identifier: MIT
 */
#include "dcs.h"

#include <string.h>

enum {
    NOP = 0x00,
    SWRESET = 0x01,
    SLPIN = 0x10,
    SLPOUT = 0x11,
    PTLON = 0x12,
    NORON = 0x13,
    INVOFF = 0x20,
    INVON = 0x21,
    DISPOFF = 0x28,
    DISPON = 0x29,
    CASET = 0x2a,
    RASET = 0x2b,
    RAMWR = 0x2c,
    PTLAR = 0x30,
    VSCRDEF = 0x33,
    MADCTL = 0x36,
    VSCSAD = 0x37,
    IDMOFF = 0x38,
    IDMON = 0x39,
    COLMOD = 0x3a,
    RAMWRC = 0x3c,
    WRDISBV = 0x51,
    WRCTRLD = 0x53
};
enum { MY = 0x80, MX = 0x40, MV = 0x20, BGR = 0x08 };

/* What all three have. */
static const struct dcs_command common[] = {
    { NOP, "NOP", 0, 0 }, { SLPIN, "SLPIN", 0, 0 }, { SLPOUT, "SLPOUT", 0, 0 }, { PTLON, "PTLON", 0, 0 },
    { NORON, "NORON", 0, 0 }, { INVOFF, "INVOFF", 0, 0 }, { INVON, "INVON", 0, 0 },
    { DISPOFF, "DISPOFF", 0, 0 }, { DISPON, "DISPON", 0, 0 }, { CASET, "CASET", 4, 4 },
    { RASET, "RASET", 4, 4 }, { RAMWR, "RAMWR", 0, 0 }, { PTLAR, "PTLAR", 4, 4 }, { VSCRDEF, "VSCRDEF", 6, 6 },
    { 0x34, "TEOFF", 0, 0 }, { 0x35, "TEON", 1, 1 }, { MADCTL, "MADCTL", 1, 1 }, { VSCSAD, "VSCSAD", 2, 2 },
    { IDMOFF, "IDMOFF", 0, 0 }, { IDMON, "IDMON", 0, 0 }, { COLMOD, "COLMOD", 1, 1 },
    { RAMWRC, "RAMWRC", 0, 0 }, { 0x44, "TESCAN", 2, 2 }, { WRDISBV, "WRDISBV", 1, 1 },
    { WRCTRLD, "WRCTRLD", 1, 1 },
    /* read out over another line; on this one they are commands without arguments */
    { 0x04, "RDDID", 0, 0 }, { 0x09, "RDDST", 0, 0 }, { 0x0a, "RDDPM", 0, 0 }, { 0x0b, "RDDMADCTL", 0, 0 },
    { 0x0c, "RDDCOLMOD", 0, 0 }, { 0x0d, "RDDIM", 0, 0 }, { 0x0e, "RDDSM", 0, 0 }, { 0x0f, "RDDSDR", 0, 0 },
    { 0x45, "RDTESCAN", 0, 0 }, { 0xda, "RDID1", 0, 0 }, { 0xdb, "RDID2", 0, 0 }, { 0xdc, "RDID3", 0, 0 },
};

static const struct dcs_command *find_in(const struct dcs_command *list, size_t n, uint8_t code)
{
    for (size_t i = 0; i < n; i++)
        if (list[i].code == code)
            return &list[i];
    return NULL;
}

static const struct dcs_command *find(const struct dcs_type *type, uint8_t code)
{
    const struct dcs_command *own = find_in(type->command, type->n_commands, code);
    return own != NULL ? own : find_in(common, sizeof common / sizeof common[0], code);
}

static int word(const uint8_t *two)
{
    return two[0] << 8 | two[1];
}

static void set_word(uint8_t *two, int value)
{
    two[0] = (uint8_t)(value >> 8);
    two[1] = (uint8_t)value;
}

static uint8_t madctl(const struct dcs *d)
{
    return d->type->madctl != NULL ? d->type->madctl(d->reg) : d->reg[MADCTL][0];
}

/* Columns and pages that the host can address. */
static int n_columns(const struct pm_model *m)
{
    const struct dcs *d = m->state;
    return madctl(d) & MV ? m->type->ram_h : m->type->ram_w;
}

static int n_pages(const struct pm_model *m)
{
    const struct dcs *d = m->state;
    return madctl(d) & MV ? m->type->ram_w : m->type->ram_h;
}

/* ---- Resets -------------------------------------------------------------------------------------------- */

/* Both resets: everything but MADCTL and COLMOD, which SWRESET leaves as they are. */
static void defaults(struct pm_model *m)
{
    struct dcs *d = m->state;
    const struct dcs_type *type = d->type;
    const uint8_t kept_madctl = d->reg[MADCTL][0], kept_colmod = d->reg[COLMOD][0];
    memset(d, 0, sizeof *d);
    d->type = type;
    if (type->defaults != NULL)
        type->defaults(d->reg);
    d->reg[MADCTL][0] = kept_madctl;
    d->reg[COLMOD][0] = kept_colmod;
    set_word(d->reg[CASET] + 2, n_columns(m) - 1);
    set_word(d->reg[RASET] + 2, n_pages(m) - 1);
    set_word(d->reg[PTLAR] + 2, m->type->ram_h - 1);
    set_word(d->reg[VSCRDEF] + 2, m->type->ram_h);
}

void dcs_reset(struct pm_model *m)
{
    struct dcs *d = m->state;
    d->type = m->type->of;
    d->reg[COLMOD][0] = 0x66;
    d->reg[MADCTL][0] = 0;
    defaults(m);
}

/* ---- Pixels -------------------------------------------------------------------------------------------- */

/* The next pixel's place, and one step on: along the row, then down, then back to the start. */
static void write_pixel(struct pm_model *m, uint32_t value)
{
    struct dcs *d = m->state;
    const int xs = word(d->reg[CASET]), xe = word(d->reg[CASET] + 2);
    const int ys = word(d->reg[RASET]), ye = word(d->reg[RASET] + 2);
    if (d->full)
        return;
    if (d->column < n_columns(m) && d->page < n_pages(m)) {
        const uint8_t mode = madctl(d);
        int x = mode & MV ? d->page : d->column, y = mode & MV ? d->column : d->page;
        x = mode & MX ? m->type->ram_w - 1 - x : x;
        y = mode & MY ? m->type->ram_h - 1 - y : y;
        *pm_ram_at(m, x, y) = value;
        m->counts.pixels++;
    } else if (!d->told) {
        d->told = 1;
        pm_note(m, PM_WINDOW, m->at, "a pixel at column %d, page %d is outside of the RAM of %dx%d and is lost",
                d->column, d->page, n_columns(m), n_pages(m));
    }
    if (d->column != xe) {
        d->column++;
        return;
    }
    d->column = xs;
    d->page = d->page == ye ? ys : d->page + 1;
    if (d->page == ys && d->type->drops_excess != NULL && d->type->drops_excess(d->reg))
        d->full = 1;
}

static uint32_t from_5(unsigned v)
{
    return v << 3 | v >> 2;
}

static uint32_t from_6(unsigned v)
{
    return v << 2 | v >> 4;
}

static void take_16(struct pm_model *m)
{
    struct dcs *d = m->state;
    const int swap = d->type->little_endian != NULL && d->type->little_endian(d->reg);
    const unsigned v = (unsigned)(swap ? d->part[1] << 8 | d->part[0] : d->part[0] << 8 | d->part[1]);
    d->n_part = 0;
    write_pixel(m, from_5(v >> 11) << 16 | from_6(v >> 5 & 63u) << 8 | from_5(v & 31u));
}

static void take_18(struct pm_model *m)
{
    struct dcs *d = m->state;
    d->n_part = 0;
    write_pixel(m, from_6(d->part[0] >> 2) << 16 | from_6(d->part[1] >> 2) << 8 | from_6(d->part[2] >> 2));
}

/* Two pixels in three bytes: after two there is one, and half of a byte is left. */
static void take_12(struct pm_model *m)
{
    struct dcs *d = m->state;
    const uint8_t *p = d->part;
    const unsigned r = d->nibble ? p[0] & 15u : p[0] >> 4;
    const unsigned g = d->nibble ? p[1] >> 4 : p[0] & 15u;
    const unsigned b = d->nibble ? p[1] & 15u : p[1] >> 4;
    d->part[0] = p[1];
    d->n_part = d->nibble ? 0 : 1;
    d->nibble = !d->nibble;
    write_pixel(m, r * 0x110000u | g * 0x1100u | b * 0x11u);
}

static void take_pixel_byte(struct pm_model *m, uint8_t byte)
{
    struct dcs *d = m->state;
    const unsigned mode = d->reg[COLMOD][0] & 7u;
    m->counts.pixel_bytes++;
    d->part[d->n_part++] = byte;
    if (mode == 5 && d->n_part == 2)
        take_16(m);
    else if (mode == 6 && d->n_part == 3)
        take_18(m);
    else if (mode == 3 && d->n_part == 2)
        take_12(m);
    else if (d->n_part == 3)
        d->n_part = 0; /* no format: COLMOD was told off */
}

/* Does the memory write end inside a pixel? */
static void close_pixels(struct pm_model *m)
{
    struct dcs *d = m->state;
    if (d->writing && d->n_part > 0 && !d->nibble)
        pm_note(m, PM_ODD, m->at - 1, "%u byte%s of a pixel at the end of a memory write, the rest is missing",
                d->n_part, d->n_part > 1 ? "s" : "");
    d->writing = 0;
    d->n_part = 0;
    d->nibble = 0;
}

/* ---- Commands ------------------------------------------------------------------------------------------ */

static void check_window(struct pm_model *m, uint8_t code)
{
    struct dcs *d = m->state;
    const int start = word(d->reg[code]), end = word(d->reg[code] + 2);
    const int n = code == CASET ? n_columns(m) : n_pages(m);
    d->moved = 1;
    pm_check_window(m, d->now_at, d->now->name, start, end, n);
}

static void check_scroll(struct pm_model *m)
{
    const struct dcs *d = m->state;
    const int top = word(d->reg[VSCRDEF]), lines = word(d->reg[VSCRDEF] + 2), bottom = word(d->reg[VSCRDEF] + 4);
    if (top + lines + bottom != m->type->ram_h)
        pm_note(m, PM_VALUE, d->now_at, "VSCRDEF of %d + %d + %d lines is not the RAM's %d", top, lines, bottom,
                m->type->ram_h);
}

static void check_scroll_start(struct pm_model *m)
{
    const struct dcs *d = m->state;
    const int top = word(d->reg[VSCRDEF]), lines = word(d->reg[VSCRDEF] + 2), start = word(d->reg[VSCSAD]);
    if (start < top || start >= top + lines)
        pm_note(m, PM_VALUE, d->now_at, "VSCSAD %d is outside of the scrolling area, %d to %d", start, top,
                top + lines - 1);
}

static void check_colmod(struct pm_model *m)
{
    const struct dcs *d = m->state;
    const unsigned mode = d->reg[COLMOD][0] & 7u, rgb = d->reg[COLMOD][0] >> 4 & 7u;
    if ((d->reg[COLMOD][0] & 0x88u) != 0 || (rgb != 0 && rgb != 5 && rgb != 6) ||
        !(mode == 5 || mode == 6 || (mode == 3 && d->type->bits_12)))
        pm_note(m, PM_VALUE, d->now_at, "COLMOD 0x%02X is no pixel format of this controller", d->reg[COLMOD][0]);
}

/* Bits of a command's only argument that are 0 in the datasheets. */
static void check_unused(struct pm_model *m, unsigned unused)
{
    const struct dcs *d = m->state;
    const uint8_t value = d->reg[d->now->code][0];
    if ((value & unused) != 0)
        pm_note(m, PM_VALUE, d->now_at, "%s 0x%02X sets bits that are not used", d->now->name, value);
}

/* All arguments are there. */
static void complete(struct pm_model *m)
{
    struct dcs *d = m->state;
    switch (d->now->code) {
    case CASET:
    case RASET:
        check_window(m, d->now->code);
        break;
    case VSCRDEF:
        check_scroll(m);
        break;
    case VSCSAD:
        d->scrolling = 1;
        check_scroll_start(m);
        break;
    case COLMOD:
        check_colmod(m);
        break;
    case MADCTL:
        check_unused(m, 0x03);
        break;
    case WRCTRLD:
        check_unused(m, 0xd3);
        break;
    default:
        break;
    }
    const char *wrong = d->type->wrong != NULL ? d->type->wrong(d->now->code, d->reg) : NULL;
    if (wrong != NULL)
        pm_note(m, PM_VALUE, d->now_at, "%s: %s", d->now->name, wrong);
}

static void begin_write(struct pm_model *m, int from_start)
{
    struct dcs *d = m->state;
    d->writing = 1;
    d->full = 0;
    m->counts.windows += d->moved;
    d->moved = 0;
    if (from_start) {
        d->column = word(d->reg[CASET]);
        d->page = word(d->reg[RASET]);
    }
}

/* Commands that do something without arguments. */
static void act(struct pm_model *m, uint8_t code)
{
    struct dcs *d = m->state;
    switch (code) {
    case SWRESET:
        m->sleep_owed_us = d->awake ? 120000 : 5000;
        m->owed_us = 5000;
        defaults(m);
        break;
    case SLPIN:
    case SLPOUT:
        if (m->timed && m->sleep_owed_us > 0)
            pm_note(m, PM_STATE, m->at, "%s comes %lu us too early after a reset, SLPIN or SLPOUT",
                    code == SLPIN ? "SLPIN" : "SLPOUT", (unsigned long)m->sleep_owed_us);
        m->sleep_owed_us = 120000;
        m->owed_us = 5000;
        d->awake = code == SLPOUT;
        break;
    case PTLON:
    case NORON:
        d->partial = code == PTLON;
        d->scrolling = 0;
        break;
    case INVOFF:
    case INVON:
        d->inverse = code == INVON;
        break;
    case DISPOFF:
    case DISPON:
        d->on = code == DISPON;
        break;
    case IDMOFF:
    case IDMON:
        d->idle = code == IDMON;
        break;
    case RAMWR:
    case RAMWRC:
        begin_write(m, code == RAMWR);
        break;
    default:
        break;
    }
}

/* The command before is over: had it its arguments? */
static void close_command(struct pm_model *m)
{
    struct dcs *d = m->state;
    close_pixels(m);
    if (d->now != NULL && d->n_args < d->now->least)
        pm_note(m, PM_COUNT, d->now_at, "%s (0x%02X) takes %u argument%s, not %u", d->now->name, d->now->code,
                d->now->most, d->now->most > 1 ? "s" : "", d->n_args);
    d->now = NULL;
}

static void take_command(struct pm_model *m, uint8_t code)
{
    struct dcs *d = m->state;
    close_command(m);
    const struct dcs_command *c = find(d->type, code);
    pm_command_begins(m, c != NULL ? c->name : "a command");
    if (c == NULL)
        pm_note(m, PM_UNKNOWN, m->at, "0x%02X is not a command of this controller", code);
    else if (c->most == 0)
        act(m, code);
    d->now = c;
    d->now_at = m->at;
    d->n_args = 0;
    d->told = 0;
    d->any = 1;
}

static void take_argument(struct pm_model *m, uint8_t byte)
{
    struct dcs *d = m->state;
    if (d->now != NULL && d->n_args < d->now->most) {
        if (d->n_args < DCS_KEPT)
            d->reg[d->now->code][d->n_args] = byte;
        if (++d->n_args == d->now->most)
            complete(m);
        return;
    }
    if (d->told)
        return;
    d->told = 1;
    if (d->now != NULL && d->now->most > 0)
        pm_note(m, PM_COUNT, m->at, "%s (0x%02X) takes %u argument%s, and one more came", d->now->name, d->now->code,
                d->now->most, d->now->most > 1 ? "s" : "");
    else if (d->now != NULL)
        pm_note(m, PM_OUTSIDE, m->at, "data after %s (0x%02X), which takes none", d->now->name, d->now->code);
    else if (!d->any)
        pm_note(m, PM_OUTSIDE, m->at, "data before any command");
}

void dcs_byte(struct pm_model *m, uint8_t byte, int data)
{
    const struct dcs *d = m->state;
    if (!data)
        take_command(m, byte);
    else if (d->writing)
        take_pixel_byte(m, byte);
    else
        take_argument(m, byte);
}

void dcs_end(struct pm_model *m, const char *how)
{
    struct dcs *d = m->state;
    if (d->now != NULL && d->n_args < d->now->least) {
        pm_note(m, PM_TRUNCATED, m->at,
                "%s inside %s (0x%02X) of byte %llu, which has %u of its %u arguments", how, d->now->name,
                d->now->code, (unsigned long long)d->now_at, d->n_args, d->now->least);
        d->now = NULL;
    }
    close_command(m);
}

/* ---- Glass --------------------------------------------------------------------------------------------- */

int dcs_lit(const struct pm_model *m)
{
    const struct dcs *d = m->state;
    return d->awake && d->on;
}

struct pm_light dcs_light(const struct pm_model *m)
{
    const struct dcs *d = m->state;
    const int controlled = (d->reg[WRCTRLD][0] & 0x24) == 0x24; /* brightness block and backlight on */
    return (struct pm_light){ { controlled ? d->reg[WRDISBV][0] : 0, 0, 0, 0 } };
}

static int in_partial_area(const struct dcs *d, int line)
{
    const int start = word(d->reg[PTLAR]), end = word(d->reg[PTLAR] + 2);
    return start <= end ? line >= start && line <= end : line >= start || line <= end;
}

static int scrolled(const struct dcs *d, int line)
{
    const int top = word(d->reg[VSCRDEF]), lines = word(d->reg[VSCRDEF] + 2), start = word(d->reg[VSCSAD]);
    if (!d->scrolling || line < top || line >= top + lines || start < top)
        return line;
    return top + (line - top + start - top) % lines;
}

static uint32_t swap_red_and_blue(uint32_t c)
{
    return c >> 16 | (c & 0xff00u) | (c & 255u) << 16;
}

/* Each channel all or nothing. */
static uint32_t eight_colours(uint32_t c)
{
    return (c >> 7 & 0x10101u) * 255u;
}

uint32_t dcs_seen(const struct pm_model *m, int x, int y)
{
    const struct dcs *d = m->state;
    const int w = m->type->ram_w, h = m->type->ram_h;
    int column = m->glass.x0 + (m->glass.mirrored ? m->glass.width - 1 - x : x), line = m->glass.y0 + y;
    column = d->type->column != NULL ? d->type->column(d->reg, column, w) : column;
    line = d->type->line != NULL ? d->type->line(d->reg, line, h) : line;
    if (line < 0 || (d->partial && !in_partial_area(d, line)))
        return 0;
    line = scrolled(d, line);
    uint32_t c = line < h ? pm_ram_get(m, column, line) : 0;
    if (d->idle)
        c = eight_colours(c);
    if (((madctl(d) & BGR) != 0) != (m->glass.bgr != 0))
        c = swap_red_and_blue(c);
    const int swapped = d->type->inverts != NULL && d->type->inverts(d->reg);
    return (d->inverse ^ swapped ^ m->glass.inverted) & 1 ? c ^ 0xffffffu : c;
}
