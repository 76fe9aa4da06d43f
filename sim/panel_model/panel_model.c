/* The part that all controllers share: wire, counts, problems, RAM, and the glass in front of it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_model.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "inside.h"

#define PROBLEMS_MAX 1000u /* kept; junk makes no more */

static const struct pm_type *const types[] = {
    [PM_ST7789] = &pm_type_st7789,   [PM_ILI9341] = &pm_type_ili9341, [PM_GC9A01] = &pm_type_gc9a01,
    [PM_SSD1351] = &pm_type_ssd1351, [PM_SSD0323] = &pm_type_ssd0323, [PM_SSD1306] = &pm_type_ssd1306,
};

/* Modules that are sold. Offsets: where their makers join glass and controller. */
static const struct {
    const char *name;
    struct pm_glass glass;
} modules[] = {
    { "st7789:240x240", { .controller = PM_ST7789, 240, 240, 0, 0 } },
    { "st7789:240x320", { .controller = PM_ST7789, 240, 320, 0, 0 } },
    { "st7789:135x240", { .controller = PM_ST7789, 135, 240, 52, 40 } },
    { "st7789:240x280", { .controller = PM_ST7789, 240, 280, 0, 20 } },
    { "st7789:172x320", { .controller = PM_ST7789, 172, 320, 34, 0 } },
    { "st7789:170x320", { .controller = PM_ST7789, 170, 320, 35, 0 } },
    { "ili9341:240x320", { .controller = PM_ILI9341, 240, 320, 0, 0, .mirrored = 1 } },
    { "gc9a01:240x240", { .controller = PM_GC9A01, 240, 240, 0, 0, .mirrored = 1 } },
    { "ssd1351:128x128", { .controller = PM_SSD1351, 128, 128, 0, 0 } },
    { "ssd1351:128x96", { .controller = PM_SSD1351, 128, 96, 0, 0 } },
    { "ssd0323:128x64", { .controller = PM_SSD0323, 128, 64, 0, 12 } },
    { "ssd1306:128x64", { .controller = PM_SSD1306, 128, 64, 0, 0 } },
    { "ssd1306:128x32", { .controller = PM_SSD1306, 128, 32, 0, 0, .sequential = 1 } },
    { "ssd1306:64x48", { .controller = PM_SSD1306, 64, 48, 32, 0 } },
    { "ssd1306:72x40", { .controller = PM_SSD1306, 72, 40, 28, 0 } },
};

#define N_MODULES (sizeof modules / sizeof modules[0])

/* ---- Glass --------------------------------------------------------------------------------------------- */

int pm_glass_named(struct pm_glass *glass, const char *name)
{
    for (size_t i = 0; i < N_MODULES; i++)
        if (strcmp(name, modules[i].name) == 0) {
            *glass = modules[i].glass;
            return 1;
        }
    return 0;
}

const char *pm_glass_list(void)
{
    static char list[32 * N_MODULES];
    list[0] = '\0';
    for (size_t i = 0; i < N_MODULES; i++) {
        strcat(list, i > 0 ? ", " : "");
        strcat(list, modules[i].name);
    }
    return list;
}

enum pm_format pm_glass_format(const struct pm_glass *glass)
{
    return types[glass->controller]->format;
}

static int fits(const struct pm_glass *g)
{
    const struct pm_type *t = types[g->controller];
    return g->width > 0 && g->height > 0 && g->x0 >= 0 && g->y0 >= 0 && g->x0 + g->width <= t->ram_w &&
           g->y0 + g->height <= t->ram_h;
}

void pm_view(const struct pm_glass *glass, int rotate, const void *from, void *to, size_t n_bytes)
{
    const int w = glass->width, h = glass->height;
    const int wide = rotate & 1 ? h : w, high = rotate & 1 ? w : h;
    for (int y = 0; y < high; y++)
        for (int x = 0; x < wide; x++) {
            /* the glass's pixel that is at x, y for the viewer */
            const int gx = rotate == 0 ? x : rotate == 1 ? w - 1 - y : rotate == 2 ? w - 1 - x : y;
            const int gy = rotate == 0 ? y : rotate == 1 ? x : rotate == 2 ? h - 1 - y : h - 1 - x;
            memcpy((char *)to + ((size_t)y * (size_t)wide + (size_t)x) * n_bytes,
                   (const char *)from + ((size_t)gy * (size_t)w + (size_t)gx) * n_bytes, n_bytes);
        }
}

/* ---- Power --------------------------------------------------------------------------------------------- */

/* What RAM holds when power comes on: noise, the same at each start. */
static void fill_with_noise(struct pm_model *m)
{
    const struct pm_type *t = m->type;
    const uint32_t mask = t->format == PM_RGB565 ? 0xffffffu : t->format == PM_GREY4 ? 15u : 1u;
    uint32_t s = 2463534242u;
    for (size_t i = 0; i < (size_t)t->ram_w * t->ram_h; i++) {
        s ^= s << 13;
        s ^= s >> 17;
        s ^= s << 5;
        m->ram[i] = s >> 8 & mask;
    }
}

static size_t ram_pixels(const struct pm_model *m)
{
    return (size_t)m->type->ram_w * m->type->ram_h;
}

/* The memory of the model that was freed last, for the next one like it: new pages take longer than most of what is
 * done to a model. */
static struct spare {
    uint32_t *ram;
    size_t n;
} spare;

struct pm_model *pm_new(const struct pm_glass *glass)
{
    struct pm_model *m = fits(glass) ? calloc(1, sizeof *m) : NULL;
    if (m == NULL)
        return NULL;
    m->glass = *glass;
    m->type = types[glass->controller];
    m->state = calloc(1, m->type->state_bytes);
    m->ram = spare.n == ram_pixels(m) ? spare.ram : calloc(ram_pixels(m), sizeof *m->ram);
    if (m->ram == spare.ram)
        spare = (struct spare){ NULL, 0 };
    if (m->state == NULL || m->ram == NULL) {
        pm_free(m);
        return NULL;
    }
    fill_with_noise(m);
    m->level = -1;
    m->type->reset(m);
    return m;
}

void pm_free(struct pm_model *model)
{
    if (model == NULL)
        return;
    free(model->state);
    if (model->ram != NULL) {
        free(spare.ram);
        spare = (struct spare){ model->ram, ram_pixels(model) };
    }
    free(model->problem);
    free(model);
}

/* ---- Wire ---------------------------------------------------------------------------------------------- */

void pm_byte(struct pm_model *model, uint8_t byte, int data)
{
    struct pm_counts *c = &model->counts;
    if (model->level != (data != 0))
        c->transactions++;
    model->level = data != 0;
    model->at = c->bytes;
    c->bytes++;
    if (data)
        c->data_bytes++;
    else
        c->command_bytes++;
    model->type->byte(model, byte, data != 0);
}

void pm_deselect(struct pm_model *model)
{
    model->level = -1; /* a pause between bytes; what was begun goes on */
}

void pm_reset(struct pm_model *model)
{
    model->at = model->counts.bytes;
    model->type->end(model, "RESET comes");
    model->counts.resets++;
    model->level = -1;
    memset(model->state, 0, model->type->state_bytes);
    model->type->reset(model);
    model->owed_us = model->type->reset_us;
}

void pm_elapsed(struct pm_model *model, uint32_t us)
{
    model->timed = 1;
    model->owed_us -= us < model->owed_us ? us : model->owed_us;
    model->sleep_owed_us -= us < model->sleep_owed_us ? us : model->sleep_owed_us;
}

void pm_end(struct pm_model *model)
{
    model->at = model->counts.bytes;
    model->type->end(model, "the stream ends");
}

void pm_check_window(struct pm_model *m, uint64_t at, const char *what, int start, int end, int n)
{
    if (start > end)
        pm_note(m, PM_WINDOW, at, "%s from %d to %d ends before it starts", what, start, end);
    else if (end >= n)
        pm_note(m, PM_WINDOW, at, "%s from %d to %d reaches out of the RAM, which ends at %d", what, start, end, n - 1);
}

void pm_command_begins(struct pm_model *m, const char *name)
{
    m->counts.commands++;
    if (m->timed && m->owed_us > 0)
        pm_note(m, PM_STATE, m->at, "%s comes %lu us too early after a reset or waking", name,
                (unsigned long)m->owed_us);
    m->owed_us = 0;
}

/* ---- Problems and counts ------------------------------------------------------------------------------- */

void pm_note(struct pm_model *m, enum pm_problem_kind kind, uint64_t at, const char *format, ...)
{
    if (m->n_problems == PROBLEMS_MAX)
        return;
    if (m->n_problems == m->room) {
        const size_t room = m->room * 2 + 16;
        struct pm_problem *more = realloc(m->problem, room * sizeof *more);
        if (more == NULL)
            return;
        m->problem = more;
        m->room = room;
    }
    struct pm_problem *p = &m->problem[m->n_problems++];
    p->kind = kind;
    p->at = at;
    const int n = snprintf(p->text, sizeof p->text, "byte %llu: ", (unsigned long long)at);
    va_list args;
    va_start(args, format);
    (void)vsnprintf(p->text + n, sizeof p->text - (size_t)n, format, args);
    va_end(args);
}

size_t pm_problems(const struct pm_model *model, const struct pm_problem **problems)
{
    *problems = model->problem;
    return model->n_problems;
}

const struct pm_counts *pm_counts(const struct pm_model *model)
{
    return &model->counts;
}

/* ---- Picture ------------------------------------------------------------------------------------------- */

uint32_t *pm_ram_at(struct pm_model *m, int x, int y)
{
    return &m->ram[(size_t)y * m->type->ram_w + (size_t)x];
}

uint32_t pm_ram_get(const struct pm_model *m, int x, int y)
{
    return m->ram[(size_t)y * m->type->ram_w + (size_t)x];
}

int pm_lit(const struct pm_model *model)
{
    return model->type->lit(model);
}

struct pm_light pm_light(const struct pm_model *model)
{
    return model->type->light(model);
}

/* Eight-bit channels of a value. */
static uint32_t channels(enum pm_format format, uint32_t value)
{
    return format == PM_RGB565 ? value : format == PM_GREY4 ? value * 0x111111u : value * 0xffffffu;
}

static uint16_t raw_of(enum pm_format format, uint32_t value)
{
    if (format != PM_RGB565)
        return (uint16_t)value;
    return (uint16_t)((value >> 8 & 0xf800u) | (value >> 5 & 0x07e0u) | (value >> 3 & 0x001fu));
}

void pm_picture(const struct pm_model *model, uint8_t *rgb, uint16_t *raw)
{
    const enum pm_format format = model->type->format;
    const int lit = pm_lit(model);
    size_t i = 0;
    for (int y = 0; y < model->glass.height; y++)
        for (int x = 0; x < model->glass.width; x++, i++) {
            const uint32_t value = lit ? model->type->seen(model, x, y) : 0u;
            const uint32_t c = channels(format, value);
            if (rgb != NULL) {
                rgb[3 * i] = (uint8_t)(c >> 16);
                rgb[3 * i + 1] = (uint8_t)(c >> 8);
                rgb[3 * i + 2] = (uint8_t)c;
            }
            if (raw != NULL)
                raw[i] = raw_of(format, value);
        }
}
