/* Is every byte of a driver's stream looked at? A tape records what ST7789's and SSD1306's drivers send for set-up, a
 * frame in strips and a rectangle; then it is played to the model again and again, each time with one bit of it
 * changed, the level of D/C being the ninth. The change must show: in what the glass shows, its light, when it is
 * lit, or in the model's problems. What may stay invisible is listed here by command, with the reason; nothing else
 * may.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fnv1a.h"
#include "panel.h"
#include "panel_model.h"

/* ---- The tape ------------------------------------------------------------------------------------------ */

enum { DATA = 0x100, RESET = 0x200, LOOK = 0x400, DESELECT = 0x800, PAUSE = 0x80000000u };

struct tape {
    struct hal_bus bus;
    uint32_t *word; /* a byte and its D/C level; a mark; PAUSE | microseconds */
    uint32_t n, room;
};

static void put(struct tape *t, uint32_t word)
{
    if (t->n == t->room) {
        t->room = 2 * t->room + 64;
        t->word = realloc(t->word, t->room * sizeof *t->word);
        assert_non_null(t->word);
    }
    t->word[t->n++] = word;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    struct tape *t = (struct tape *)(void *)bus;
    put(t, code);
    for (uint32_t i = 0; i < n; i++)
        put(t, args[i] | DATA);
    put(t, DESELECT);
    return HAL_ERR_NONE;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    struct tape *t = (struct tape *)(void *)bus;
    for (uint32_t i = 0; i < n; i++)
        put(t, bytes[i] | DATA);
    put(t, DESELECT);
    return HAL_ERR_NONE;
}

static int wait(struct hal_bus *bus)
{
    return HAL_ERR_NONE;
}

static int reset(struct hal_bus *bus)
{
    put((struct tape *)(void *)bus, RESET);
    return HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    put((struct tape *)(void *)bus, PAUSE | us);
}

/* Set-up, a frame of random pixels in strips of `rows`, a rectangle in its middle. */
static struct tape record(const struct panel_config *config, uint16_t rows, const struct panel_rect *part)
{
    struct tape t = { .bus = { command, data, wait, reset, delay, { 0 } } };
    struct panel panel;
    static _Alignas(4) uint8_t px[8192], scratch[8192];
    uint32_t seed = 7;
    for (size_t i = 0; i < sizeof px; i++)
        px[i] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
    assert_int_equal(panel_init(&panel, config, &t.bus, scratch, panel_scratch_bytes(config, 4096)), HAL_ERR_NONE);
    put(&t, LOOK);
    const uint16_t w = panel_width(&panel), h = panel_height(&panel);
    for (uint16_t y = 0; y < h; y = (uint16_t)(y + rows)) {
        const struct panel_rect strip = { 0, y, w, (uint16_t)(h - y < rows ? h - y : rows) };
        assert_int_equal(panel_send(&panel, &strip, px + 2 * y * w, 0), HAL_ERR_NONE);
        assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    }
    put(&t, LOOK);
    assert_int_equal(panel_send(&panel, part, px + 1024, 0), HAL_ERR_NONE);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    put(&t, LOOK);
    return t;
}

/* ---- Playing it ---------------------------------------------------------------------------------------- */

static uint64_t mix_picture(uint64_t sum, const struct pm_model *m, const struct pm_glass *glass)
{
    static uint8_t rgb[64 * 1024];
    const size_t n = (size_t)glass->width * glass->height * 3;
    assert_true(n <= sizeof rgb);
    pm_picture(m, rgb, NULL);
    const struct pm_light light = pm_light(m);
    return fnv1a(fnv1a(sum, rgb, n), &light, sizeof light);
}

/* All that can be noticed of a tape: one number. */
static uint64_t play(const struct tape *t, const struct pm_glass *glass)
{
    struct pm_model *m = pm_new(glass);
    uint64_t sum = 14695981039346656037u;
    const struct pm_problem *problem;
    assert_non_null(m);
    pm_elapsed(m, 0);
    for (uint32_t i = 0; i < t->n; i++) {
        const uint32_t word = t->word[i];
        if (word & PAUSE)
            pm_elapsed(m, word & ~PAUSE);
        else if (word == RESET)
            pm_reset(m);
        else if (word == DESELECT)
            pm_deselect(m);
        else if (word == LOOK)
            sum = mix_picture(sum, m, glass);
        else
            pm_byte(m, (uint8_t)word, (word & DATA) != 0);
        const int lit = pm_lit(m);
        sum = fnv1a(sum, &lit, sizeof lit);
    }
    pm_end(m);
    const size_t n = pm_problems(m, &problem);
    for (size_t i = 0; i < n; i++)
        sum = fnv1a(sum, problem[i].text, strlen(problem[i].text));
    pm_free(m);
    return sum;
}

/* ---- What may be invisible ----------------------------------------------------------------------------- */

struct silent {
    uint8_t code;   /* a command, as the driver sends it */
    uint8_t arg;    /* 0 the command byte itself, 1 its first argument, and so on */
    uint16_t bits;  /* whose change does not show; 0x100: D/C */
    const char *why;
};

/* Command and argument number of each word; data is {0, 0}. */
static void label(const struct tape *t, int args_low, const uint8_t *n_args, uint16_t *at)
{
    uint8_t code = 0, arg = 0;
    int left = 0;
    for (uint32_t i = 0; i < t->n; i++) {
        const uint32_t word = t->word[i];
        at[i] = 0;
        if (word & PAUSE || word >= RESET)
            continue;
        const int is_arg = args_low ? !(word & DATA) && left > 0 : (word & DATA) && code != 0x2c;
        if (is_arg) {
            arg++;
            left--;
        } else if (!(word & DATA)) {
            code = (uint8_t)word;
            arg = 0;
            left = args_low ? n_args[code] : 0;
        }
        if (is_arg || !(word & DATA))
            at[i] = (uint16_t)(code << 8 | (arg + 1));
    }
}

static uint16_t expected(const struct silent *list, size_t n, uint16_t at)
{
    for (size_t i = 0; i < n; i++)
        if (at == (uint16_t)(list[i].code << 8 | (list[i].arg + 1)))
            return list[i].bits;
    return 0;
}

/* Change every bit; what stays unseen must be on the list, and all that is on it must stay unseen somewhere. */
static void expect_seen(struct tape *t, const struct pm_glass *glass, int args_low, const uint8_t *n_args,
                        const struct silent *list, size_t n)
{
    uint16_t *at = calloc(t->n, sizeof *at), unseen[64] = { 0 };
    uint32_t changed = 0, silent = 0;
    int wrong = 0;
    assert_true(n <= 64);
    label(t, args_low, n_args, at);
    const uint64_t right = play(t, glass);
    for (uint32_t i = 0; i < t->n; i++)
        for (uint32_t bit = 1; !(t->word[i] & PAUSE) && t->word[i] < RESET && bit <= DATA; bit <<= 1) {
            t->word[i] ^= bit;
            const int same = play(t, glass) == right;
            t->word[i] ^= bit;
            changed++;
            silent += (uint32_t)same;
            if (same && !(expected(list, n, at[i]) & bit)) {
                wrong++;
                print_message("word %u, 0x%02X: bit 0x%03X of byte %u of command 0x%02X changes nothing\n",
                              (unsigned)i, (unsigned)t->word[i], (unsigned)bit, (at[i] & 255u) - 1u, at[i] >> 8);
            }
            for (size_t k = 0; k < n; k++)
                if (same && at[i] == (uint16_t)(list[k].code << 8 | (list[k].arg + 1)))
                    unseen[k] |= (uint16_t)bit;
        }
    for (size_t k = 0; k < n; k++)
        if (unseen[k] != list[k].bits) {
            wrong++;
            print_message("0x%02X, byte %u (%s): invisible are 0x%03X, listed 0x%03X\n", list[k].code, list[k].arg,
                          list[k].why, unseen[k], list[k].bits);
        }
    print_message("%u bits changed one at a time: %u seen, %u rightly not\n", (unsigned)changed,
                  (unsigned)(changed - silent), (unsigned)silent);
    free(at);
    assert_int_equal(wrong, 0);
}

static void st7789_bytes_are_seen(void **state)
{
    static const struct silent list[] = {
        { 0x01, 0, 0x039, "NOP, RDDST, SLPOUT, INVON in place of a software reset: RESET was pulled before" },
        { 0x13, 0, 0x001, "PTLON: the partial area is all of the RAM" },
        { 0x28, 0, 0x05c, "RAMWR, INVOFF, IDMOFF, RDABCSDR in place of DISPOFF: it is off after a reset" },
        { 0x2a, 0, 0x001, "RASET, before the right RASET: strips leave the columns as they were" },
        { 0x2b, 4, 0x00c, "a window that goes on below what is written" },
        { 0x2c, 0, 0x010, "RAMWRC: the window before ended where this one begins" },
        { 0x36, 1, 0x014, "refresh order" },
        { 0x53, 1, 0x008, "dimming takes time" },
    };
    const struct panel_config config = { &panel_st7789, 12, 10, 52, 40, .rotate = 1, .invert = 1, .dim = 0x5a };
    const struct pm_glass glass = { .controller = PM_ST7789, .width = 12, .height = 10, .x0 = 52, .y0 = 40,
                                    .inverted = 1 };
    const struct panel_rect part = { 3, 5, 4, 3 };
    struct tape t = record(&config, 4, &part);
    expect_seen(&t, &glass, 0, NULL, list, sizeof list / sizeof list[0]);
    free(t.word);
}

static void ssd1306_bytes_are_seen(void **state)
{
    static const uint8_t n_args[256] = { [0x20] = 1, [0x21] = 2, [0x22] = 2, [0x81] = 1, [0x8d] = 1, [0xa8] = 1,
                                         [0xad] = 1, [0xd3] = 1, [0xd5] = 1, [0xd9] = 1, [0xda] = 1, [0xdb] = 1 };
    static const struct silent list[] = {
        { 0xae, 0, 0x188, "A6, 2E, data before the RAM is cleared: it is off after a reset" },
        { 0xe3, 0, 0x180, "a start line, before the right one; data before the RAM is cleared" },
        { 0xd5, 1, 0x0ff, "frame rate" },
        { 0xd3, 0, 0x188, "DB, start line and column, data and column: the offset is 0 after a reset" },
        { 0x40, 0, 0x1c0, "column, C0 before C8, data: the start line is 0 after a reset" },
        { 0xd9, 1, 0x0fe, "precharge" },
        { 0xdb, 1, 0x070, "voltage" },
        { 0xa4, 0, 0x112, "A6, B4, data: RAM is shown after a reset" },
        { 0x2e, 0, 0x1a0, "column, AE, data: nothing scrolls" },
        { 0xda, 0, 0x100, "data and column: 12 is what reset leaves" },
        { 0xa6, 0, 0x11a, "A4, AE, B6, data: not inverse after a reset" },
        { 0x8d, 1, 0x0c0, "bits that are not used" },
        { 0x22, 2, 0x007, "a window that goes on below what is written" },
    };
    const struct panel_config config = { &panel_ssd1306, 64, 48, .rotate = 1, .dim = 0x5a };
    struct pm_glass glass;
    assert_true(pm_glass_named(&glass, "ssd1306:64x48"));
    const struct panel_rect part = { 8, 5, 16, 7 };
    struct tape t = record(&config, 16, &part);
    expect_seen(&t, &glass, 1, n_args, list, sizeof list / sizeof list[0]);
    free(t.word);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(st7789_bytes_are_seen),
        cmocka_unit_test(ssd1306_bytes_are_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
