/* SSD1351. Source: Solomon Systech, SSD1351 datasheet rev 1.5 (2011): command table in chapter 9, chapter 10, pixel
 * formats in chapter 8.
 *
 * Columns and colours are remapped when they are written; the scan of rows when they are shown.
 *
 * SPDX-License-Identifier: MIT
 */
#include "solomon.h"

static const struct solomon_command commands[] = {
    { 0x15, 0x15, "set column address", 2 }, { 0x5c, 0x5c, "write RAM", 0 }, { 0x5d, 0x5d, "read RAM", 0 },
    { 0x75, 0x75, "set row address", 2 }, { 0x96, 0x96, "horizontal scroll", 5 },
    { 0x9e, 0x9e, "stop moving", 0 }, { 0x9f, 0x9f, "start moving", 0 }, { 0xa0, 0xa0, "set remap", 1 },
    { 0xa1, 0xa1, "set display start line", 1 }, { 0xa2, 0xa2, "set display offset", 1 },
    { 0xa4, 0xa7, "set display mode", 0 }, { 0xab, 0xab, "function selection", 1 }, { 0xad, 0xad, "NOP", 0 },
    { 0xae, 0xaf, "set sleep mode", 0 }, { 0xb0, 0xb0, "NOP", 0 }, { 0xb1, 0xb1, "set phase length", 1 },
    { 0xb2, 0xb2, "display enhancement", 3 }, { 0xb3, 0xb3, "set clock", 1 },
    { 0xb4, 0xb4, "set segment low voltage", 3 }, { 0xb5, 0xb5, "set GPIO", 1 },
    { 0xb6, 0xb6, "set second precharge", 1 }, { 0xb8, 0xb8, "look-up table", 63 },
    { 0xb9, 0xb9, "linear look-up table", 0 }, { 0xbb, 0xbb, "set precharge voltage", 1 },
    { 0xbe, 0xbe, "set VCOMH", 1 }, { 0xc1, 0xc1, "set contrast", 3 }, { 0xc7, 0xc7, "master contrast", 1 },
    { 0xca, 0xca, "set multiplex ratio", 1 }, { 0xd1, 0xd1, "NOP", 0 }, { 0xe3, 0xe3, "NOP", 0 },
    { 0xfd, 0xfd, "set command lock", 1 },
};

static void set_remap(struct pm_model *m, uint8_t remap)
{
    struct solomon *s = m->state;
    s->remap = remap;
    s->downwards = remap & 1;
    s->reversed = remap >> 4 & 1;
    s->split = remap >> 5 & 1;
    if (remap & 0x08)
        solomon_wrong(m, "sets a bit that is not used", remap);
    if (remap >> 6 == 3)
        solomon_wrong(m, "is a format of the 16-bit bus", remap);
}

static void set_lock(struct pm_model *m, uint8_t key)
{
    struct solomon *s = m->state;
    if (key == 0x12)
        s->locked &= 1;
    else if (key == 0x16)
        s->locked |= 2;
    else if (key == 0xb0)
        s->locked |= 1;
    else if (key == 0xb1)
        s->locked &= 2;
    else
        solomon_wrong(m, "is none of the four keys", key);
}

static int is_locked(const struct solomon *s, uint8_t code)
{
    const int special = code == 0xa2 || code == 0xb1 || code == 0xb3 || code == 0xbb || code == 0xbe || code == 0xc1;
    return code != 0xfd && ((s->locked & 2) != 0 || (special && (s->locked & 1) != 0));
}

static void set_rows(struct pm_model *m, uint8_t code, uint8_t n)
{
    struct solomon *s = m->state;
    if (n > 127 || (code == 0xca && n < 15)) {
        solomon_wrong(m, "is out of range", n);
        n &= 127;
    }
    if (code == 0xca)
        s->rows = (uint8_t)(n + 1);
    else if (code == 0xa1)
        s->start = n;
    else
        s->offset = n;
}

static void set_contrast(struct pm_model *m, uint8_t code, const uint8_t *args)
{
    struct solomon *s = m->state;
    if (code == 0xc7 && args[0] > 15)
        solomon_wrong(m, "is out of range", args[0]);
    for (int i = 0; i < (code == 0xc1 ? 3 : 1); i++)
        s->light.level[code == 0xc1 ? i : 3] = code == 0xc1 ? args[i] : args[0] & 15;
}

static const enum solomon_show shows[4] = { SHOW_NONE, SHOW_ALL, SHOW_RAM, SHOW_NEGATIVE };

static void run(struct pm_model *m, uint8_t code, const uint8_t *args)
{
    struct solomon *s = m->state;
    if (is_locked(s, code)) {
        pm_note(m, PM_STATE, s->now_at, "%s (0x%02X) is locked until 0xFD 0x%02X", s->now->name, code,
                s->locked & 2 ? 0x12 : 0xb1);
        return;
    }
    if (solomon_switch(s, code, shows))
        return;
    if (code == 0x15 || code == 0x75)
        solomon_window(m, code == 0x75, args[0], args[1], 128);
    else if (code == 0x5c)
        s->writing = 1;
    else if (code == 0xa0)
        set_remap(m, args[0]);
    else if (code == 0xa1 || code == 0xa2 || code == 0xca)
        set_rows(m, code, args[0]);
    else if (code == 0xc1 || code == 0xc7)
        set_contrast(m, code, args);
    else if (code == 0xfd)
        set_lock(m, args[0]);
    else if (code == 0x9f)
        pm_note(m, PM_VALUE, s->now_at, "the picture moves with time, which this model does not follow");
}

/* A pixel's three fields, the one that comes first on top, as eight bits each. */
static uint32_t fields(const struct solomon *s)
{
    const unsigned depth = s->remap >> 6;
    const unsigned v = depth == 0 ? s->part[0] : (unsigned)s->part[0] << 8 | s->part[1];
    unsigned c, b, a;
    if (depth == 0) { /* 3, 3 and 2 bits */
        c = v >> 5;
        b = v >> 2 & 7u;
        a = v & 3u;
        return (c << 5 | c << 2 | c >> 1) << 16 | (b << 5 | b << 2 | b >> 1) << 8 | a * 85u;
    }
    if (depth == 1) { /* 5, 6 and 5 */
        c = v >> 11;
        b = v >> 5 & 63u;
        a = v & 31u;
        return (c << 3 | c >> 2) << 16 | (b << 2 | b >> 4) << 8 | (a << 3 | a >> 2);
    }
    c = s->part[0] & 63u;
    b = s->part[1] & 63u;
    a = s->part[2] & 63u;
    return (c << 2 | c >> 4) << 16 | (b << 2 | b >> 4) << 8 | (a << 2 | a >> 4);
}

static void data(struct pm_model *m, uint8_t byte)
{
    struct solomon *s = m->state;
    const unsigned depth = s->remap >> 6, want = depth == 0 ? 1 : depth == 1 ? 2 : 3;
    s->part[s->n_part++] = byte;
    if (s->n_part < want)
        return;
    s->n_part = 0;
    uint32_t c = fields(s);
    if (!(s->remap & 4)) /* A B C: the last field is the first colour, red */
        c = c >> 16 | (c & 0xff00u) | (c & 255u) << 16;
    if (s->x < 128 && s->y < 128) {
        *pm_ram_at(m, s->remap & 2 ? 127 - s->x : s->x, s->y) = c;
        m->counts.pixels++;
    }
    solomon_step(s);
}

static const struct solomon_type type = { commands, sizeof commands / sizeof commands[0], 0, 128, 0, run, data };

static void reset(struct pm_model *m)
{
    struct solomon *s = m->state;
    solomon_reset(m, 128, 128);
    s->remap = 0x40;
    s->offset = 0x60;
    s->locked = 1;
    s->light = (struct pm_light){ { 0x8a, 0x51, 0x8a, 0x0f } };
}

static uint32_t seen(const struct pm_model *m, int x, int y)
{
    const int row = solomon_ram_row(m, y, 1);
    uint32_t c = row < 0 ? 0 : solomon_shown(m, pm_ram_get(m, m->glass.x0 + x, row), 0xffffff);
    return m->glass.bgr ? c >> 16 | (c & 0xff00u) | (c & 255u) << 16 : c;
}

const struct pm_type pm_type_ssd1351 = {
    "ssd1351", 128, 128, PM_RGB565, 3, sizeof(struct solomon), reset, solomon_byte, solomon_end,
    solomon_lit, seen, solomon_light, &type
};
