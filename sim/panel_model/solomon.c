/* What the Solomon controllers share: commands with their arguments, the window, and which row a COM shows.
 * Source: Solomon Systech, SSD1306 datasheet rev 1.1, chapter 10 with tables 10-1 to 10-3; SSD1351 datasheet
 * rev 1.5, chapter 10.
 *
 * SPDX-License-Identifier: MIT
 */
#include "solomon.h"

/* ---- Commands ------------------------------------------------------------------------------------------ */

static const struct solomon_type *type_of(const struct pm_model *m)
{
    return m->type->of;
}

static const struct solomon_command *find(const struct solomon_type *type, uint8_t code)
{
    for (size_t i = 0; i < type->n_commands; i++)
        if (code >= type->command[i].code && code <= type->command[i].last)
            return &type->command[i];
    return NULL;
}

static int wants_more(const struct solomon *s)
{
    return s->now != NULL && s->n_args < s->now->n_args;
}

void solomon_wrong(struct pm_model *m, const char *what, unsigned argument)
{
    const struct solomon *s = m->state;
    pm_note(m, PM_VALUE, s->now_at, "%s 0x%02X %s", s->now->name, argument, what);
}

/* Something else came where arguments belong. */
static void complain_of_missing(struct pm_model *m)
{
    struct solomon *s = m->state;
    if (wants_more(s))
        pm_note(m, PM_COUNT, s->now_at, "%s (0x%02X) takes %u argument%s, not %u", s->now->name, s->code,
                s->now->n_args, s->now->n_args > 1 ? "s" : "", s->n_args);
    s->now = NULL;
}

static void close_pixels(struct pm_model *m)
{
    struct solomon *s = m->state;
    if (s->n_part > 0)
        pm_note(m, PM_ODD, m->at - 1, "%u byte%s of a pixel at the end of a memory write, the rest is missing",
                s->n_part, s->n_part > 1 ? "s" : "");
    s->n_part = 0;
}

static void take_command(struct pm_model *m, uint8_t code)
{
    struct solomon *s = m->state;
    complain_of_missing(m);
    close_pixels(m);
    const struct solomon_command *c = find(type_of(m), code);
    pm_command_begins(m, c != NULL ? c->name : "a command");
    s->now = c;
    s->now_at = m->at;
    s->code = code;
    s->n_args = 0;
    s->any = 1;
    s->told = 0;
    s->writing = 0;
    if (c == NULL)
        pm_note(m, PM_UNKNOWN, m->at, "0x%02X is not a command of this controller", code);
    else if (c->n_args == 0)
        type_of(m)->run(m, code, s->arg);
}

static void take_argument(struct pm_model *m, uint8_t byte)
{
    struct solomon *s = m->state;
    s->arg[s->n_args++] = byte;
    if (!wants_more(s))
        type_of(m)->run(m, s->code, s->arg);
}

static void take_data(struct pm_model *m, uint8_t byte)
{
    struct solomon *s = m->state;
    m->counts.windows += s->moved;
    s->moved = 0;
    m->counts.pixel_bytes++;
    type_of(m)->data(m, byte);
}

/* Arguments with D/C high, too many or without a command. */
static void take_stray(struct pm_model *m)
{
    struct solomon *s = m->state;
    if (s->told)
        return;
    s->told = 1;
    if (s->now != NULL && s->now->n_args > 0)
        pm_note(m, PM_COUNT, m->at, "%s (0x%02X) takes %u argument%s, and one more came", s->now->name, s->code,
                s->now->n_args, s->now->n_args > 1 ? "s" : "");
    else if (s->now != NULL)
        pm_note(m, PM_OUTSIDE, m->at, "data after %s (0x%02X), which takes none", s->now->name, s->code);
    else if (!s->any)
        pm_note(m, PM_OUTSIDE, m->at, "data before any command");
}

void solomon_byte(struct pm_model *m, uint8_t byte, int data)
{
    struct solomon *s = m->state;
    if (type_of(m)->args_low && data) {
        complain_of_missing(m);
        take_data(m, byte);
    } else if (type_of(m)->args_low) {
        if (wants_more(s))
            take_argument(m, byte);
        else
            take_command(m, byte);
    } else if (!data) {
        take_command(m, byte);
    } else if (wants_more(s)) {
        take_argument(m, byte);
    } else if (s->writing) {
        take_data(m, byte);
    } else {
        take_stray(m);
    }
}

void solomon_end(struct pm_model *m, const char *how)
{
    struct solomon *s = m->state;
    if (wants_more(s)) {
        pm_note(m, PM_TRUNCATED, m->at,
                "%s inside %s (0x%02X) of byte %llu, which has %u of its %u arguments", how, s->now->name,
                s->code, (unsigned long long)s->now_at, s->n_args, s->now->n_args);
        s->now = NULL;
    }
    close_pixels(m);
}

/* ---- Addresses ----------------------------------------------------------------------------------------- */

void solomon_window(struct pm_model *m, int is_row, uint8_t from, uint8_t to, int limit)
{
    struct solomon *s = m->state;
    s->moved = 1;
    pm_check_window(m, s->now_at, s->now->name, from, to, limit);
    const uint8_t bits = (uint8_t)(limit <= 8 ? 7 : limit <= 64 ? 63 : 127); /* the registers have no more */
    if (is_row) {
        s->y0 = from & bits;
        s->y1 = to & bits;
        s->y = s->y0;
    } else {
        s->x0 = from & bits;
        s->x1 = to & bits;
        s->x = s->x0;
    }
}

/* One step of a coordinate in its window; 1 where it went round. */
static int step(int *at, int first, int last)
{
    if (*at != last) {
        *at = (*at + 1) & 255;
        return 0;
    }
    *at = first;
    return 1;
}

int solomon_switch(struct solomon *s, uint8_t code, const enum solomon_show shows[4])
{
    if (code >= 0xa4 && code <= 0xa7)
        s->show = shows[code & 3];
    else if (code == 0xae || code == 0xaf)
        s->on = code & 1;
    else
        return 0;
    return 1;
}

void solomon_step(struct solomon *s)
{
    if (s->downwards) {
        if (step(&s->y, s->y0, s->y1))
            (void)step(&s->x, s->x0, s->x1);
    } else if (step(&s->x, s->x0, s->x1)) {
        (void)step(&s->y, s->y0, s->y1);
    }
}

/* ---- Glass --------------------------------------------------------------------------------------------- */

int solomon_lit(const struct pm_model *m)
{
    const struct solomon *s = m->state;
    return s->on;
}

struct pm_light solomon_light(const struct pm_model *m)
{
    const struct solomon *s = m->state;
    return s->light;
}

uint32_t solomon_shown(const struct pm_model *m, uint32_t value, uint32_t all)
{
    const struct solomon *s = m->state;
    const enum solomon_show show = s->show;
    const uint32_t seen = show == SHOW_ALL    ? all
                          : show == SHOW_NONE ? 0u
                          : show == SHOW_RAM  ? value
                                              : all - value;
    return m->glass.inverted ? all - seen : seen;
}

/* Pins of one side come first. Which COM is on a pin: in order, or even ones on one side, odd ones on the other. */
static int pin_of(int com, int coms, int split)
{
    return split ? (com & 1) * (coms / 2) + com / 2 : com;
}

static int com_on(int pin, int coms, int split, int sides)
{
    const int half = coms / 2;
    const int p = sides ? (pin + half) % coms : pin;
    return split ? p % half * 2 + p / half : p;
}

int solomon_ram_row(const struct pm_model *m, int glass_row, int split_as_wired)
{
    const struct solomon *s = m->state;
    const int n = type_of(m)->coms, last = type_of(m)->turns_whole ? n - 1 : s->rows - 1;
    const int pin = pin_of(m->glass.y0 + m->glass.height - 1 - glass_row, n, split_as_wired);
    const int com = com_on(pin, n, s->split, s->sides);
    const int row = ((s->reversed ? last - com : com) + s->offset + 2 * n) % n;
    return row < s->rows ? (row + s->start) % n : -1;
}

void solomon_reset(struct pm_model *m, int columns, int rows)
{
    struct solomon *s = m->state;
    s->x1 = (uint8_t)(columns - 1);
    s->y1 = (uint8_t)(rows - 1);
    s->rows = type_of(m)->coms;
}
