/* The model of panel controllers, against byte streams written by hand from the datasheets' rules: where pixels land,
 * what is seen, what is counted, and that everything a controller would not understand is told of with its byte.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "panel_model.h"

/* ---- Streams as text ----------------------------------------------------------------------------------- */

/* Bytes in hexadecimal: "36 60" a command and its argument with D/C high; "!" resets, "|" lifts chip select, and
 * "*N " repeats the byte after it N times. The first byte is a command, and each after ";" and "!". */
static void feed(struct pm_model *m, const char *text)
{
    int data = 0;
    unsigned long repeat = 1;
    for (const char *p = text; *p != '\0';) {
        char *end;
        if (*p == ' ') {
            p++;
        } else if (*p == ';') {
            data = 0;
            p++;
        } else if (*p == '!') {
            pm_reset(m);
            data = 0;
            p++;
        } else if (*p == '|') {
            pm_deselect(m);
            p++;
        } else if (*p == '*') {
            repeat = strtoul(p + 1, &end, 10);
            p = end;
        } else {
            const unsigned long byte = strtoul(p, &end, 16);
            assert_true(end == p + 2 && byte < 256);
            for (; repeat > 0; repeat--)
                pm_byte(m, (uint8_t)byte, data);
            repeat = 1;
            data = 1;
            p = end;
        }
    }
}

/* The same with D/C low throughout, but for what stands in brackets. */
static void feed_low(struct pm_model *m, const char *text)
{
    int data = 0;
    for (const char *p = text; *p != '\0';) {
        char *end;
        if (strchr(" ;[]!|", *p) != NULL) {
            if (*p == '[' || *p == ']')
                data = *p == '[';
            if (*p == '!')
                pm_reset(m);
            p++;
            continue;
        }
        const unsigned long byte = strtoul(p, &end, 16);
        assert_true(end == p + 2 && byte < 256);
        pm_byte(m, (uint8_t)byte, data);
        p = end;
    }
}

struct view {
    struct pm_glass glass;
    struct pm_model *m;
    uint8_t *rgb;
    uint16_t *raw;
};

static void look(struct view *v)
{
    pm_picture(v->m, v->rgb, v->raw);
}

static struct view open_glass(const struct pm_glass *glass)
{
    struct view v = { .glass = *glass, .m = pm_new(glass) };
    assert_non_null(v.m);
    v.rgb = calloc((size_t)glass->width * glass->height, 3);
    v.raw = calloc((size_t)glass->width * glass->height, 2);
    return v;
}

static struct view open_named(const char *name)
{
    struct pm_glass glass;
    assert_true(pm_glass_named(&glass, name));
    return open_glass(&glass);
}

static void close_view(struct view *v)
{
    pm_free(v->m);
    free(v->rgb);
    free(v->raw);
}

static unsigned raw_at(const struct view *v, int x, int y)
{
    return v->raw[(size_t)y * v->glass.width + (size_t)x];
}

static unsigned rgb_at(const struct view *v, int x, int y)
{
    const uint8_t *c = v->rgb + ((size_t)y * v->glass.width + (size_t)x) * 3;
    return (unsigned)c[0] << 16 | (unsigned)c[1] << 8 | c[2];
}

/* The problems of a model: this many; and the nth is of a kind, at a byte, with these words. */
static void expect_problems(const struct pm_model *m, size_t n)
{
    const struct pm_problem *p;
    const size_t have = pm_problems(m, &p);
    for (size_t i = 0; have != n && i < have; i++)
        print_message("%s\n", p[i].text);
    assert_int_equal(have, n);
}

static void expect_problem(const struct pm_model *m, size_t nth, enum pm_problem_kind kind, uint64_t at,
                           const char *words)
{
    const struct pm_problem *p;
    char start[32];
    assert_true(pm_problems(m, &p) > nth);
    (void)snprintf(start, sizeof start, "byte %llu: ", (unsigned long long)at);
    if (p[nth].kind != kind || p[nth].at != at || strstr(p[nth].text, words) == NULL)
        print_message("%s\n", p[nth].text);
    assert_int_equal(p[nth].kind, kind);
    assert_int_equal(p[nth].at, at);
    assert_memory_equal(p[nth].text, start, strlen(start));
    assert_non_null(strstr(p[nth].text, words));
}

struct problem {
    const char *text; /* for feed or feed_low */
    enum pm_problem_kind kind;
    uint64_t at;
    const char *words;
};

/* Each of n texts, to a panel of its own, brings the one problem that it says. */
static void expect_each(const char *panel, void (*feed_it)(struct pm_model *, const char *),
                        const struct problem *cases, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        struct view v = open_named(panel);
        feed_it(v.m, cases[i].text);
        pm_end(v.m);
        expect_problem(v.m, 0, cases[i].kind, cases[i].at, cases[i].words);
        expect_problems(v.m, 1);
        close_view(&v);
    }
}

/* ---- MIPI DCS: all three ------------------------------------------------------------------------------- */

#define AWAKE "! 11; 3A 55; 29; " /* three commands, four bytes */

static void dark_until_awake_and_on(void **state)
{
    struct view v = open_named("st7789:240x240");
    feed(v.m, "! 3A 55; 2A 00 00 00 00; 2B 00 00 00 00; 2C FF FF;");
    assert_false(pm_lit(v.m));
    feed(v.m, "29;");
    assert_false(pm_lit(v.m)); /* on, asleep */
    feed(v.m, "11;");
    assert_true(pm_lit(v.m));
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0xffff);
    feed(v.m, "28;");
    assert_false(pm_lit(v.m));
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0);
    feed(v.m, "29; 10;");
    assert_false(pm_lit(v.m));
    feed(v.m, "11;");
    assert_true(pm_lit(v.m));
    feed(v.m, "!");
    assert_false(pm_lit(v.m));
    feed(v.m, AWAKE);
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0xffff); /* RAM outlives a reset */
    assert_int_not_equal(raw_at(&v, 1, 0), raw_at(&v, 2, 0)); /* and is noise where nothing was written */
    expect_problems(v.m, 0);
    close_view(&v);
}

/* Where the first and the second pixel of a window land on 240x320, by MADCTL (datasheet: data access control). */
static void madctl_places(void **state)
{
    static const struct {
        const char *madctl;
        int x0, y0, x1, y1; /* of address (5, 7) and (6, 7) */
    } cases[] = {
        { "00", 5, 7, 6, 7 },         { "40", 234, 7, 233, 7 },     { "80", 5, 312, 6, 312 },
        { "C0", 234, 312, 233, 312 }, { "20", 7, 5, 7, 6 },         { "60", 232, 5, 232, 6 },
        { "A0", 7, 314, 7, 313 },     { "E0", 232, 314, 232, 313 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct view v = open_named("st7789:240x320");
        char text[80];
        feed(v.m, AWAKE "2A 00 00 00 EF; 2B 00 00 00 EF; 2C *115200 00");
        (void)snprintf(text, sizeof text, "; 36 %s; 2A 00 05 00 06; 2B 00 07 00 07; 2C 12 34 56 78", cases[i].madctl);
        feed(v.m, text);
        look(&v);
        assert_int_equal(raw_at(&v, cases[i].x0, cases[i].y0), 0x1234);
        assert_int_equal(raw_at(&v, cases[i].x1, cases[i].y1), 0x5678);
        expect_problems(v.m, 0);
        close_view(&v);
    }
}

static void window_wraps_and_goes_on(void **state)
{
    struct view v = open_named("st7789:240x240");
    feed(v.m, AWAKE "2A 00 0A 00 0B; 2B 00 14 00 15; 2C 00 01 00 02 00 03; 3C 00 04 00 05");
    look(&v);
    assert_int_equal(raw_at(&v, 10, 20), 5); /* round to the start */
    assert_int_equal(raw_at(&v, 11, 20), 2);
    assert_int_equal(raw_at(&v, 10, 21), 3);
    assert_int_equal(raw_at(&v, 11, 21), 4);
    feed(v.m, "; 2C 00 06"); /* from the start again */
    look(&v);
    assert_int_equal(raw_at(&v, 10, 20), 6);
    expect_problems(v.m, 0);
    assert_int_equal(pm_counts(v.m)->pixels, 6);
    assert_int_equal(pm_counts(v.m)->windows, 1);
    close_view(&v);
}

static void pixel_formats(void **state)
{
    struct view v = open_named("st7789:240x240");
    feed(v.m, AWAKE "2A 00 00 00 EF; 2B 00 00 00 00;"
                    "3A 05; 2C F8 00 07 E0;"                     /* red, green */
                    "3A 66; 3C FC 00 00 04 08 0C;"               /* red, 1 2 3 of 63 */
                    "3A 53; 3C F0 01 23;"                        /* F00 and 123 */
                    "3A 55; B0 00 F8; 3C 1F 00;"                 /* blue, low byte first */
                    "B0 00 F0; 3C 00 1F");
    look(&v);
    static const unsigned want[] = { 0xff0000, 0x00ff00, 0xff0000, 0x04080c, 0xff0000, 0x112233, 0x0000ff, 0x0000ff };
    for (int i = 0; i < 8; i++)
        assert_int_equal(rgb_at(&v, i, 0), want[i]);
    assert_int_equal(raw_at(&v, 3, 0), 0x0041); /* 1 2 3 of 63 cut to 5, 6 and 5 bits: 0, 2, 1 */
    pm_end(v.m);
    expect_problems(v.m, 0);
    close_view(&v);
}

static void colours_of_the_glass(void **state)
{
    static const struct {
        uint8_t inverted, bgr;
        const char *text;
        unsigned want;
    } cases[] = {
        { 0, 0, "", 0x8410e7 },   { 0, 0, "; 21", 0x7bef18 },        { 1, 0, "", 0x7bef18 },
        { 1, 0, "; 21", 0x8410e7 }, { 1, 0, "; 21; 20", 0x7bef18 },  { 0, 0, "; 36 08", 0xe71084 },
        { 0, 1, "", 0xe71084 },   { 0, 1, "; 36 08", 0x8410e7 },     { 0, 0, "; 39", 0xff00ff },
        { 0, 0, "; 39; 38", 0x8410e7 }, { 0, 0, "; C0 0C", 0xe71084 }, { 0, 0, "; C0 3C", 0x7bef18 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pm_glass glass;
        assert_true(pm_glass_named(&glass, "st7789:240x240"));
        glass.inverted = cases[i].inverted;
        glass.bgr = cases[i].bgr;
        struct view v = open_glass(&glass);
        feed(v.m, AWAKE "2A 00 00 00 00; 2B 00 00 00 00; 2C 80 9C"); /* 16 4 28 */
        feed(v.m, cases[i].text);
        look(&v);
        assert_int_equal(rgb_at(&v, 0, 0), cases[i].want);
        expect_problems(v.m, 0);
        close_view(&v);
    }
}

/* A glass that shows a part of the RAM: its first pixel is at 52, 40; turned over, at 53, 40. */
static void glass_in_the_ram(void **state)
{
    struct view v = open_named("st7789:135x240");
    feed(v.m, AWAKE "2A 00 34 00 34; 2B 00 28 00 28; 2C 11 11; 2A 00 BA 00 BA; 2B 01 17 01 17; 2C 22 22;"
                    "36 C0; 2A 00 36 00 36; 2B 00 29 00 29; 2C 33 33");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0x1111);
    assert_int_equal(raw_at(&v, 134, 239), 0x2222);
    assert_int_equal(raw_at(&v, 239 - 0x36 - 52, 319 - 0x29 - 40), 0x3333);
    expect_problems(v.m, 0);
    close_view(&v);
}

/* Rows of 1, 2, 3 ... in the RAM's first column. */
static void number_rows(struct view *v)
{
    char text[16];
    feed(v->m, AWAKE "2A 00 00 00 00; 2B 00 00 01 3F; 2C");
    for (unsigned y = 0; y < 320; y++) {
        (void)snprintf(text, sizeof text, " %02X %02X", (y + 1) >> 8, (y + 1) & 255);
        for (const char *p = text; *p != '\0'; p += 3)
            pm_byte(v->m, (uint8_t)strtoul(p, NULL, 16), 1);
    }
}

static void scrolling_and_parts(void **state)
{
    struct view v = open_named("st7789:240x320");
    number_rows(&v);
    feed(v.m, "; 33 00 0A 01 22 00 14; 37 00 0D"); /* 10 rows stay, 290 scroll by 3, 20 stay */
    look(&v);
    assert_int_equal(raw_at(&v, 0, 9), 10);
    assert_int_equal(raw_at(&v, 0, 10), 14);
    assert_int_equal(raw_at(&v, 0, 296), 300);
    assert_int_equal(raw_at(&v, 0, 297), 11);
    assert_int_equal(raw_at(&v, 0, 299), 13);
    assert_int_equal(raw_at(&v, 0, 300), 301);
    feed(v.m, "; 30 00 64 00 6D; 12"); /* rows 100 to 109 alone; scrolling ends */
    look(&v);
    assert_int_equal(raw_at(&v, 0, 99), 0);
    assert_int_equal(raw_at(&v, 0, 100), 101);
    assert_int_equal(raw_at(&v, 0, 109), 110);
    assert_int_equal(raw_at(&v, 0, 110), 0);
    feed(v.m, "; 13");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 10), 11);
    feed(v.m, "; E4 25 01 10"); /* 304 lines from gate 8 on */
    look(&v);
    assert_int_equal(raw_at(&v, 0, 7), 0);
    assert_int_equal(raw_at(&v, 0, 8), 1);
    assert_int_equal(raw_at(&v, 0, 311), 304);
    assert_int_equal(raw_at(&v, 0, 312), 0);
    feed(v.m, "; E4 27 00 11"); /* gates from the other end */
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 320);
    expect_problems(v.m, 0);
    close_view(&v);
}

static void resets(void **state)
{
    struct view v = open_named("st7789:240x320");
    const char *odd = "! 11; 29; 36 60; 3A 55; 21; 39; 2A 00 05 00 06; 2B 00 07 00 08; B0 00 F8; 37 00 05; 53 24;"
                      "51 80;";
    feed(v.m, odd);
    assert_int_equal(pm_light(v.m).level[0], 0x80);
    feed(v.m, "01; 11; 29; 2C 12 34");  /* SWRESET: MADCTL and COLMOD stay, windows are all of the RAM */
    look(&v);
    assert_int_equal(raw_at(&v, 239, 0), 0x1234); /* MX and MV: the first pixel goes into the right column */
    assert_int_equal(pm_light(v.m).level[0], 0);
    feed(v.m, ";");
    feed(v.m, odd);
    feed(v.m, "! 11; 29; 2C FC 00 00"); /* RESET: 18 bits, no rotation */
    look(&v);
    assert_int_equal(rgb_at(&v, 0, 0), 0xff0000);
    expect_problems(v.m, 0);
    assert_int_equal(pm_counts(v.m)->resets, 3);
    close_view(&v);
}

static void counts(void **state)
{
    struct view v = open_named("st7789:240x240");
    feed(v.m, "! 11;| 3A 55;| 2A 00 00 00 01;| 2B 00 00 00 00;| 2C;|");
    pm_byte(v.m, 1, 1);
    pm_deselect(v.m);
    feed(v.m, "2C 00 01 00 02");
    const struct pm_counts *c = pm_counts(v.m);
    assert_int_equal(c->bytes, 20);
    assert_int_equal(c->command_bytes, 6);
    assert_int_equal(c->data_bytes, 14);
    assert_int_equal(c->commands, 6);
    /* 11 | 3A / 55 | 2A / 4 | 2B / 4 | 2C | 01 | 2C / 4 */
    assert_int_equal(c->transactions, 11);
    assert_int_equal(c->pixel_bytes, 5);
    assert_int_equal(c->pixels, 2);
    assert_int_equal(c->windows, 1);
    close_view(&v);
}

static void views(void **state)
{
    const struct pm_glass glass = { .controller = PM_ST7789, .width = 2, .height = 3 };
    static const uint16_t on_glass[6] = { 1, 2, 3, 4, 5, 6 }; /* 12 / 34 / 56 */
    static const uint16_t want[4][6] = { { 1, 2, 3, 4, 5, 6 }, { 2, 4, 6, 1, 3, 5 }, { 6, 5, 4, 3, 2, 1 },
                                         { 5, 3, 1, 6, 4, 2 } };
    for (int turns = 0; turns < 4; turns++) {
        uint16_t seen[6];
        pm_view(&glass, turns, on_glass, seen, sizeof *seen);
        assert_memory_equal(seen, want[turns], sizeof seen);
    }
}

/* ---- Junk, for all that speak DCS ---------------------------------------------------------------------- */

static void dcs_problems(void **state)
{
    static const struct problem cases[] = {
        { "! 11; 99 01 02; 29", PM_UNKNOWN, 1, "0x99 is not a command" },
        { "! 11; 36; 29", PM_COUNT, 1, "MADCTL (0x36) takes 1 argument, not 0" },
        { "! 11; 2A 00 00 00; 29", PM_COUNT, 1, "CASET (0x2A) takes 4 arguments, not 3" },
        { "! 11; 36 00 00 00; 29", PM_COUNT, 3, "takes 1 argument, and one more" },
        { "! 11; 29 05 06; 20", PM_OUTSIDE, 2, "data after DISPON (0x29)" },
        { "! 2A 00 10 00 0F; 20", PM_WINDOW, 0, "CASET from 16 to 15 ends before it starts" },
        { "! 2A 00 10 00 F0; 20", PM_WINDOW, 0, "from 16 to 240 reaches out of the RAM, which ends at 239" },
        { "! 36 20; 2B 00 10 00 F0; 20", PM_WINDOW, 2, "from 16 to 240 reaches out" },
        { "! 3A 55; 2C 12 34 56; 29", PM_ODD, 5, "1 byte of a pixel" },
        { "! 3A 66; 2C 12 34 56 78 9A; 29", PM_ODD, 7, "2 bytes of a pixel" },
        { "! 3A 04; 20", PM_VALUE, 0, "COLMOD 0x04" },
        { "! 36 01; 20", PM_VALUE, 0, "MADCTL 0x01" },
        { "! 33 00 00 01 40 00 01; 20", PM_VALUE, 0, "VSCRDEF of 0 + 320 + 1" },
        { "! 37 01 40; 20", PM_VALUE, 0, "VSCSAD 320 is outside" },
        { "! 11; 2A 00 01", PM_TRUNCATED, 4, "ends inside CASET (0x2A) of byte 1, which has 2 of its 4" },
        { "! 3A 55; 2C 12", PM_ODD, 3, "1 byte of a pixel" },
        { "! 11; 2A 00 01! 29", PM_TRUNCATED, 4, "RESET comes inside CASET (0x2A) of byte 1" },
    };
    static const char *const glass[] = { "st7789:240x320", "ili9341:240x320" };
    for (size_t g = 0; g < 2; g++)
        expect_each(glass[g], feed, cases, sizeof cases / sizeof cases[0]);
}

static void data_before_any_command(void **state)
{
    struct view v = open_named("st7789:240x240");
    pm_reset(v.m);
    pm_byte(v.m, 0x12, 1);
    pm_byte(v.m, 0x13, 1);
    feed(v.m, "11; 29");
    expect_problem(v.m, 0, PM_OUTSIDE, 0, "data before any command");
    expect_problems(v.m, 1);
    assert_true(pm_lit(v.m)); /* decoding goes on */
    close_view(&v);
}

/* Some libraries set windows one column too wide: told of, and the pixels beyond are lost. */
static void pixels_out_of_the_ram(void **state)
{
    struct view v = open_named("st7789:240x240");
    feed(v.m, AWAKE "2A 00 EF 00 F0; 2B 00 00 00 01; 2C 00 01 00 02 00 03 00 04;");
    look(&v);
    assert_int_equal(raw_at(&v, 239, 0), 1);
    assert_int_equal(raw_at(&v, 239, 1), 3);
    expect_problem(v.m, 0, PM_WINDOW, 4, "reaches out");
    expect_problem(v.m, 1, PM_WINDOW, 18, "column 240, page 0 is outside");
    expect_problems(v.m, 2);
    close_view(&v);
}

/* Arguments that did arrive count, the others stay (datasheet: data transfer recovery). */
static void broken_off_arguments(void **state)
{
    struct view v = open_named("st7789:240x240");
    feed(v.m, AWAKE "2A 00 05 00 08; 2B 00 00 00 00; 2A 00 07; 2C 12 34;");
    look(&v);
    assert_int_equal(raw_at(&v, 7, 0), 0x1234);
    expect_problem(v.m, 0, PM_COUNT, 14, "takes 4 arguments, not 2");
    expect_problems(v.m, 1);
    close_view(&v);
}

static void too_early(void **state)
{
    struct view v = open_named("st7789:240x240");
    pm_elapsed(v.m, 0);
    feed(v.m, "!");
    pm_elapsed(v.m, 4999);
    feed(v.m, "11;");
    expect_problem(v.m, 0, PM_STATE, 0, "SLPOUT comes 1 us too early");
    expect_problems(v.m, 1);
    pm_elapsed(v.m, 5000);
    feed(v.m, "29;");
    expect_problems(v.m, 1);
    pm_elapsed(v.m, 100000);
    feed(v.m, "10;");
    expect_problem(v.m, 1, PM_STATE, 2, "SLPIN comes 15000 us too early");
    pm_elapsed(v.m, 120000);
    feed(v.m, "11;");
    pm_elapsed(v.m, 120000);
    feed(v.m, "01;");
    pm_elapsed(v.m, 5000);
    feed(v.m, "20; 11;");
    expect_problem(v.m, 2, PM_STATE, 6, "SLPOUT comes 115000 us too early");
    expect_problems(v.m, 3);
    close_view(&v);
}

/* ---- ILI9341, GC9A01: what is their own ---------------------------------------------------------------- */

static void ili9341_rules(void **state)
{
    struct view v = open_named("ili9341:240x320");
    /* mounted for MX: its first column is on the right of the glass */
    feed(v.m, AWAKE "2A 00 05 00 05; 2B 00 07 00 07; 2C 12 34; 36 40; 2C 56 78");
    look(&v);
    assert_int_equal(raw_at(&v, 234, 7), 0x1234);
    assert_int_equal(raw_at(&v, 5, 7), 0x5678);
    feed(v.m, "; B6 0A A2 27"); /* sources from the other end */
    look(&v);
    assert_int_equal(raw_at(&v, 5, 7), 0x1234);
    feed(v.m, "; B6 0A C2 27 04"); /* gates from the other end */
    look(&v);
    assert_int_equal(raw_at(&v, 234, 312), 0x1234);
    feed(v.m, "; B6 0A 02 27"); /* glass that is black without a voltage */
    look(&v);
    assert_int_equal(raw_at(&v, 234, 7), 0xedcb);
    /* excess is dropped with WEMODE 0, and wraps with 1 */
    feed(v.m, "; B6 0A 82 27; F6 00 00 00; 2A 00 00 00 01; 2B 00 00 00 00; 2C 00 01 00 02 00 03");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 1);
    feed(v.m, "; F6 01 00 00; 2C 00 01 00 02 00 03; F6 41 00 00; 2C 00 04 00 05");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 3);
    assert_int_equal(raw_at(&v, 239, 0), 4); /* MX turned over once more */
    expect_problems(v.m, 0);
    /* no 12 bits, 18-bit default, and the well-known slip of scroll starts with one argument */
    feed(v.m, "; 3A 53; 37 00; 29");
    expect_problems(v.m, 2);
    close_view(&v);
}

static void gc9a01_rules(void **state)
{
    struct view v = open_named("gc9a01:240x240");
    feed(v.m, "! EF; EB 14; FE; EF; B6 00 20; 90 08 08 08 08; 62 18 0D 71 ED 70 70 18 0F 71 EF 70 70; E8 34; 36 08;"
              "3A 05; 35; 35 00; 11; 29; 2A 00 05 00 06; 2B 00 EF 00 EF; 2C F8 00 00 1F");
    look(&v);
    assert_int_equal(raw_at(&v, 5, 239), 0x001f);
    assert_int_equal(raw_at(&v, 6, 239), 0xf800);
    expect_problems(v.m, 0);
    feed(v.m, "; 2B 00 00 00 F0; 90 08; 01; 35 00 00; 29");
    expect_problem(v.m, 0, PM_WINDOW, 52, "ends at 239");
    expect_problem(v.m, 1, PM_COUNT, 57, "takes 4 arguments, not 1");
    expect_problem(v.m, 2, PM_UNKNOWN, 59, "0x01 is not a command"); /* its datasheet has no software reset */
    expect_problem(v.m, 3, PM_COUNT, 62, "TEON (0x35) takes 1 argument, and one more came");
    expect_problems(v.m, 4);
    close_view(&v);
}

/* LCMCTRL turns over what MADCTL says; its default of 2C is what modules are built for. */
static void st7789_lcmctrl(void **state)
{
    static const struct {
        const char *text;
        int x, y;
    } cases[] = { { "C0 2C", 5, 7 }, { "C0 24", 234, 7 }, { "C0 6C", 5, 312 }, { "C0 2E", 7, 5 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct view v = open_named("st7789:240x320");
        feed(v.m, AWAKE);
        feed(v.m, cases[i].text);
        feed(v.m, "; 2A 00 05 00 05; 2B 00 07 00 07; 2C 12 34");
        look(&v);
        assert_int_equal(raw_at(&v, cases[i].x, cases[i].y), 0x1234);
        expect_problems(v.m, 0);
        close_view(&v);
    }
}

/* Set-up sequences as other libraries send them: the shape of the widespread one for ILI9341. */
static void ili9341_set_up_of_others(void **state)
{
    struct view v = open_named("ili9341:240x320");
    feed(v.m, "! EF 03 80 02; CF 00 C1 30; ED 64 03 12 81; E8 85 00 78; CB 39 2C 00 34 02; F7 20; EA 00 00; C0 23;"
              "C1 10;"
              "C5 3E 28; C7 86; 36 48; 37 00 00; 3A 55; B1 00 18; B6 08 82 27; F2 00; 26 01;"
              "E0 0F 31 2B 0C 0E 08 4E F1 37 07 10 03 0E 09 00; E1 00 0E 14 03 11 07 31 C1 48 08 0F 0C 31 36 0F;"
              "11; 29; 2A 00 00 00 00; 2B 00 00 00 00; 2C F8 00");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0x001f); /* this glass is not BGR */
    expect_problems(v.m, 0);
    close_view(&v);
}

/* ---- SSD1351 ------------------------------------------------------------------------------------------- */

#define UP_1351 "! FD 12; FD B1; A2 00; A0 74; AF; "

static void ssd1351_rules(void **state)
{
    struct view v = open_named("ssd1351:128x128");
    feed(v.m, "! FD 12; FD B1; A2 00; A0 74; 15 05 06; 75 07 08; 5C F8 00 00 1F 07 E0;");
    assert_false(pm_lit(v.m));
    feed(v.m, "AF;");
    look(&v);
    assert_int_equal(raw_at(&v, 5, 7), 0xf800);
    assert_int_equal(raw_at(&v, 6, 7), 0x001f);
    assert_int_equal(raw_at(&v, 5, 8), 0x07e0);
    static const struct {
        const char *text;
        int x, y;
        unsigned want;
    } cases[] = {
        { "A1 03;", 5, 4, 0xf800 },           /* start line: rows move up */
        { "A1 00; A2 03;", 5, 4, 0xf800 },    /* so do they with an offset */
        { "A2 00; A0 64;", 5, 120, 0xf800 },  /* scan the other way */
        { "A0 54;", 5, 14, 0xf800 },          /* COMs in order: 120 is on the pin where the glass has its 113th */
        { "A0 74; A7;", 5, 7, 0x07ff },       /* inverse */
        { "A5;", 0, 0, 0xffff },              /* all on */
        { "A4;", 5, 7, 0 },                   /* all off */
        { "A6;", 5, 7, 0xf800 },
        { "CA 5F;", 5, 39, 0xf800 },          /* 96 rows: the reversed scan begins at COM95, 32 rows further down */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        feed(v.m, cases[i].text);
        look(&v);
        assert_int_equal(raw_at(&v, cases[i].x, cases[i].y), cases[i].want);
    }
    assert_int_equal(raw_at(&v, 5, 20), 0); /* and 32 rows are dark */
    expect_problems(v.m, 0);
    close_view(&v);
}

/* Columns, colours and the direction of steps are settled when pixels are written. */
static void ssd1351_writing(void **state)
{
    struct view v = open_named("ssd1351:128x128");
    feed(v.m, UP_1351 "15 00 01; 75 00 01; 5C 00 01 00 02 00 03 00 04 00 05; A0 76; 15 00 01; 75 02 02;"
                      "5C 00 06 00 07;"
                      "A0 75; 15 00 01; 75 03 04; 5C 00 08 00 09 00 0A; A0 70; 15 00 00; 75 05 05; 5C F8 00;"
                      "A0 34; 15 00 00; 75 06 06; 5C E3; A0 B4; 15 00 00; 75 07 07; 5C 3F 00 01; A0 74");
    look(&v);
    static const struct {
        int x, y;
        unsigned want;
    } want[] = {
        { 0, 0, 5 },   { 1, 0, 2 }, { 0, 1, 3 }, { 1, 1, 4 },      /* wraps in its window */
        { 127, 2, 6 }, { 126, 2, 7 },                              /* columns remapped */
        { 0, 3, 8 },   { 0, 4, 9 }, { 1, 3, 10 },                  /* down before right */
        { 0, 5, 0x001f },                                          /* A B C: the last field is red */
        { 0, 6, 0xf81f },                                          /* 256 colours */
        { 0, 7, 0xf800 },                                          /* 262k: six bits a byte, blue cut away */
    };
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++)
        assert_int_equal(raw_at(&v, want[i].x, want[i].y), want[i].want);
    expect_problems(v.m, 0);
    close_view(&v);
}

/* As a widespread library turns it by 180 degrees; and the start line of 128 that it sends, one too many, is 0. */
static void ssd1351_as_others_turn_it(void **state)
{
    struct view v = open_named("ssd1351:128x128");
    feed(v.m, UP_1351 "A1 80; 15 00 00; 75 00 00; 5C 11 11; A0 66; A1 00; 15 00 00; 75 01 01; 5C 22 22");
    look(&v);
    assert_int_equal(raw_at(&v, 127, 126), 0x2222);
    feed(v.m, "; A0 74");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0x1111);
    expect_problem(v.m, 0, PM_VALUE, 9, "set display start line 0x80 is out of range");
    expect_problems(v.m, 1);
    close_view(&v);
}

/* 96 rows on COM0 to COM95: with 96 lines multiplexed its row 0 is the RAM's, with 128 it is 32. */
static void ssd1351_96_rows(void **state)
{
    struct view v = open_named("ssd1351:128x96");
    feed(v.m, UP_1351 "CA 5F; 15 00 00; 75 00 00; 5C 11 11; 75 5F 5F; 15 00 00; 5C 22 22; 75 20 20; 15 00 00;"
                      "5C 33 33");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0x1111);
    assert_int_equal(raw_at(&v, 0, 95), 0x2222);
    feed(v.m, "; CA 7F");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0x3333);
    expect_problems(v.m, 0);
    close_view(&v);
}

static void ssd1351_problems(void **state)
{
    static const struct problem cases[] = {
        { "! FD 12; A2 00", PM_STATE, 2, "set display offset (0xA2) is locked until 0xFD 0xB1" },
        { "! FD 16; AF", PM_STATE, 2, "is locked until 0xFD 0x12" },
        { "! FD 55", PM_VALUE, 0, "none of the four keys" },
        { "! 15 05 80", PM_WINDOW, 0, "from 5 to 128 reaches out of the RAM, which ends at 127" },
        { "! 75 06 05", PM_WINDOW, 0, "from 6 to 5 ends before it starts" },
        { "! AF 00", PM_OUTSIDE, 1, "data after set sleep mode (0xAF)" },
        { "! A0 74 00", PM_COUNT, 2, "takes 1 argument, and one more came" },
        { "! C1 01 02; AF", PM_COUNT, 0, "set contrast (0xC1) takes 3 arguments, not 2" },
        { "! C1 01", PM_TRUNCATED, 2, "ends inside set contrast" },
        { "! 5C 12 34 56; AF", PM_ODD, 3, "1 byte of a pixel" },
        { "! 37 01", PM_UNKNOWN, 0, "0x37 is not a command" },
        { "! CA 05", PM_VALUE, 0, "out of range" },
        { "! C7 10", PM_VALUE, 0, "out of range" },
        { "! A0 7C", PM_VALUE, 0, "a bit that is not used" },
    };
    expect_each("ssd1351:128x128", feed, cases, sizeof cases / sizeof cases[0]);
}

static void ssd1351_light(void **state)
{
    struct view v = open_named("ssd1351:128x128");
    feed(v.m, UP_1351 "C1 C8 80 C9; C7 07");
    static const uint8_t want[4] = { 0xc8, 0x80, 0xc9, 0x07 };
    assert_memory_equal(pm_light(v.m).level, want, 4);
    feed(v.m, "!");
    static const uint8_t reset[4] = { 0x8a, 0x51, 0x8a, 0x0f };
    assert_memory_equal(pm_light(v.m).level, reset, 4);
    feed(v.m, "A0 74; 15 00 00; 75 07 07; 5C 12 34; AF"); /* the offset is 96 after a reset */
    look(&v);
    assert_int_equal(raw_at(&v, 0, 39), 0x1234);
    close_view(&v);
}

/* ---- SSD0323 ------------------------------------------------------------------------------------------- */

#define UP_0323 "! A0 52 A2 4C A8 3F AF "

static void ssd0323_rules(void **state)
{
    struct view v = open_named("ssd0323:128x64");
    feed_low(v.m, UP_0323 "15 02 03 75 05 06 [12 34 56 78 9A]");
    look(&v);
    static const struct {
        int x, y;
        unsigned want;
    } want[] = { { 4, 5, 9 }, { 5, 5, 10 }, { 6, 5, 3 }, { 7, 5, 4 }, { 4, 6, 5 }, { 5, 6, 6 }, { 7, 6, 8 } };
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++)
        assert_int_equal(raw_at(&v, want[i].x, want[i].y), want[i].want);
    assert_int_equal(rgb_at(&v, 4, 5), 0x999999);
    assert_int_equal(pm_counts(v.m)->pixels, 10);
    assert_int_equal(pm_counts(v.m)->windows, 1);
    feed_low(v.m, "A1 02");
    look(&v);
    assert_int_equal(raw_at(&v, 4, 3), 9); /* start line */
    feed_low(v.m, "A1 00 A2 4D");
    look(&v);
    assert_int_equal(raw_at(&v, 4, 4), 9); /* offset */
    feed_low(v.m, "A2 4C A7");
    look(&v);
    assert_int_equal(raw_at(&v, 4, 5), 6);
    feed_low(v.m, "A5");
    look(&v);
    assert_int_equal(raw_at(&v, 100, 60), 15);
    feed_low(v.m, "A6");
    look(&v);
    assert_int_equal(raw_at(&v, 4, 5), 0);
    /* down before right, columns remapped, nibbles not: the left pixel is the low one */
    feed_low(v.m, "A4 A0 55 A0 51 15 00 00 75 00 00 [12] A0 56 15 08 09 75 08 09 [11 22 33] A0 52");
    look(&v);
    assert_int_equal(raw_at(&v, 126, 0), 2);
    assert_int_equal(raw_at(&v, 127, 0), 1);
    assert_int_equal(raw_at(&v, 16, 9), 2);
    assert_int_equal(raw_at(&v, 18, 8), 3);
    /* a rectangle by itself, filled */
    feed_low(v.m, "23 01 24 00 14 01 16 BB E3");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 20), 11);
    assert_int_equal(raw_at(&v, 3, 22), 11);
    expect_problems(v.m, 0);
    close_view(&v);
}

static void ssd0323_problems(void **state)
{
    static const struct problem cases[] = {
        { "! 15 00 [12] AF", PM_COUNT, 0, "set column address (0x15) takes 2 arguments, not 1" },
        { "! 15 00", PM_TRUNCATED, 2, "ends inside set column address" },
        { "! 15 00 40", PM_WINDOW, 0, "from 0 to 64 reaches out of the RAM, which ends at 63" },
        { "! 75 00 50", PM_WINDOW, 0, "ends at 79" },
        { "! A0 08", PM_VALUE, 0, "a bit that is not used" },
        { "! C7", PM_UNKNOWN, 0, "0xC7 is not a command" },
        { "! 2F", PM_VALUE, 0, "is not followed" },
    };
    expect_each("ssd0323:128x64", feed_low, cases, sizeof cases / sizeof cases[0]);
}

/* ---- SSD1306 ------------------------------------------------------------------------------------------- */

#define UP_1306 "! 8D 14 A1 C8 AF "

static void clear_1306(struct view *v)
{
    feed_low(v->m, "20 00 21 00 7F 22 00 07");
    for (int i = 0; i < 1024; i++)
        pm_byte(v->m, 0, 1);
}

static void ssd1306_addressing(void **state)
{
    struct view v = open_named("ssd1306:128x64");
    feed_low(v.m, UP_1306);
    clear_1306(&v);
    feed_low(v.m, "21 05 06 22 01 02 [01 02 04 08 10]"); /* along the columns, then the next page, then round */
    look(&v);
    assert_int_equal(raw_at(&v, 5, 8), 0);
    assert_int_equal(raw_at(&v, 5, 12), 1);
    assert_int_equal(raw_at(&v, 6, 9), 1);
    assert_int_equal(raw_at(&v, 5, 18), 1);
    assert_int_equal(raw_at(&v, 6, 19), 1);
    assert_int_equal(rgb_at(&v, 6, 19), 0xffffff);
    feed_low(v.m, "20 01 21 10 11 22 03 04 [01 02 04]"); /* down the pages first */
    look(&v);
    assert_int_equal(raw_at(&v, 16, 24), 1);
    assert_int_equal(raw_at(&v, 16, 33), 1);
    assert_int_equal(raw_at(&v, 17, 26), 1);
    feed_low(v.m, "20 02 B6 0E 17 [01 02 04]"); /* a page; from column 126 round to 0 */
    look(&v);
    assert_int_equal(raw_at(&v, 126, 48), 1);
    assert_int_equal(raw_at(&v, 127, 49), 1);
    assert_int_equal(raw_at(&v, 0, 50), 1);
    expect_problems(v.m, 0);
    assert_int_equal(pm_counts(v.m)->pixels, 8 * (1024 + 11));
    assert_int_equal(pm_counts(v.m)->windows, 4);
    close_view(&v);
}

/* Widespread: all pages as 0 to FF. The register has three bits, so that is told of and works. */
static void ssd1306_pages_to_ff(void **state)
{
    struct view v = open_named("ssd1306:128x64");
    feed_low(v.m, UP_1306);
    clear_1306(&v);
    feed_low(v.m, "22 00 FF 21 00 7F");
    for (int i = 0; i < 1024; i++)
        pm_byte(v.m, i == 1023 ? 0x80 : 0, 1);
    feed_low(v.m, "[01]"); /* round */
    look(&v);
    assert_int_equal(raw_at(&v, 127, 63), 1);
    assert_int_equal(raw_at(&v, 0, 0), 1);
    expect_problem(v.m, 0, PM_WINDOW, 1037, "from 0 to 255 reaches out of the RAM, which ends at 7");
    expect_problems(v.m, 1);
    close_view(&v);
}

/* One pixel at column 5, row 12 of the RAM; where it is seen, by what the commands do. */
static void ssd1306_scan(void **state)
{
    static const struct {
        const char *glass, *text;
        int x, y; /* -1: nowhere */
    } cases[] = {
        { "ssd1306:128x64", "", 5, 12 },
        { "ssd1306:128x64", "C0", 5, 51 },
        { "ssd1306:128x64", "41", 5, 11 },
        { "ssd1306:128x64", "7F", 5, 13 },
        { "ssd1306:128x64", "D3 04", 5, 8 },
        { "ssd1306:128x64", "C0 D3 04", 5, 55 },
        { "ssd1306:128x64", "A8 2F", 5, 28 },        /* 48 lines: COM47 first; the 16 rows on top are dark */
        { "ssd1306:128x64", "DA 32", 5, 13 },        /* sides changed over: even and odd rows */
        { "ssd1306:128x64", "DA 02", 5, 24 },        /* in order: COM51 is on the pin where COM39 should be */
        { "ssd1306:128x64", "DA 22", 5, 25 },
        { "ssd1306:128x32", "A8 1F DA 02", 5, 12 },
        { "ssd1306:128x32", "A8 1F DA 12", 5, -1 },  /* COM19 is on the other side of this glass */
        { "ssd1306:128x32", "A8 3F DA 02", 5, -1 },  /* row 12 is scanned where this glass has no rows */
        { "ssd1306:128x64", "A4 A6", 5, 12 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct view v = open_named(cases[i].glass);
        feed_low(v.m, UP_1306);
        clear_1306(&v);
        feed_low(v.m, "21 05 05 22 01 01 [10]");
        feed_low(v.m, cases[i].text);
        look(&v);
        int found = 0;
        for (int y = 0; y < v.glass.height; y++)
            for (int x = 0; x < v.glass.width; x++)
                if (raw_at(&v, x, y) != 0) {
                    found++;
                    if (x != cases[i].x || y != cases[i].y)
                        print_message("case %zu: seen at %d, %d\n", i, x, y);
                    assert_true(x == cases[i].x && y == cases[i].y);
                }
        assert_int_equal(found, cases[i].y >= 0);
        expect_problems(v.m, 0);
        close_view(&v);
    }
}

static void ssd1306_glass_and_light(void **state)
{
    struct view v = open_named("ssd1306:64x48");
    feed_low(v.m, UP_1306 "A8 2F");
    clear_1306(&v);
    feed_low(v.m, "21 20 20 22 00 00 [01] A0 21 20 20 22 00 00 [02] A1"); /* remapping works on what comes after it */
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 1);
    assert_int_equal(raw_at(&v, 63, 1), 1);
    assert_int_equal(raw_at(&v, 63, 0), 0);
    feed_low(v.m, "A7");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 0);
    assert_int_equal(raw_at(&v, 1, 0), 1);
    feed_low(v.m, "A5");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 1); /* all on goes before inverse */
    feed_low(v.m, "A4 A6 81 33");
    assert_int_equal(pm_light(v.m).level[0], 0x33);
    feed_low(v.m, "8D 10");
    assert_false(pm_lit(v.m)); /* no pump, no light */
    feed_low(v.m, "8D 14 AE");
    assert_false(pm_lit(v.m));
    feed_low(v.m, "AF");
    assert_true(pm_lit(v.m));
    expect_problems(v.m, 0);
    close_view(&v);

    v = open_named("ssd1306:72x40");
    feed_low(v.m, UP_1306 "A8 27 AD 30");
    clear_1306(&v);
    feed_low(v.m, "21 1C 1C 22 00 00 [01] 21 63 63 22 04 04 [80]");
    look(&v);
    assert_int_equal(raw_at(&v, 0, 0), 1);
    assert_int_equal(raw_at(&v, 71, 39), 1);
    expect_problems(v.m, 0);
    close_view(&v);
}

static void ssd1306_problems(void **state)
{
    static const struct problem cases[] = {
        { "! AF", PM_STATE, 0, "without its charge pump" },
        { "! D3 [12]", PM_COUNT, 0, "set display offset (0xD3) takes 1 argument, not 0" },
        { "! E3 D3", PM_TRUNCATED, 2, "ends inside set display offset (0xD3) of byte 1" },
        { "! 21 00 80", PM_WINDOW, 0, "from 0 to 128 reaches out of the RAM, which ends at 127" },
        { "! 22 03 02", PM_WINDOW, 0, "from 3 to 2 ends before it starts" },
        { "! 20 03", PM_VALUE, 0, "is no addressing mode" },
        { "! DA 11", PM_VALUE, 0, "bits" },
        { "! 8D 04", PM_VALUE, 0, "bits" },
        { "! A8 05", PM_VALUE, 0, "out of range" },
        { "! D3 40", PM_VALUE, 0, "out of range" },
        { "! 2F", PM_VALUE, 0, "scrolls with time" },
        { "! C1", PM_UNKNOWN, 0, "0xC1 is not a command" },
        { "! F5", PM_UNKNOWN, 0, "0xF5 is not a command" },
    };
    expect_each("ssd1306:128x64", feed_low, cases, sizeof cases / sizeof cases[0]);
}

/* ---- All: names, glass that does not fit, and junk ----------------------------------------------------- */

static void names(void **state)
{
    struct pm_glass glass = { .controller = PM_SSD1306, .width = 7 };
    assert_false(pm_glass_named(&glass, "st7789:241x240"));
    assert_false(pm_glass_named(&glass, "st7789"));
    assert_int_equal(glass.width, 7);
    assert_non_null(strstr(pm_glass_list(), "ssd1351:128x96"));
    glass = (struct pm_glass){ .controller = PM_ST7789, .width = 135, .height = 240, .x0 = 106, .y0 = 0 };
    assert_null(pm_new(&glass));
    glass.x0 = 105;
    struct pm_model *m = pm_new(&glass);
    assert_non_null(m);
    pm_free(m);
    pm_free(NULL);
}

/* ---- The command sets: code and number of arguments ----------------------------------------------------------- */

static const char dcs_set[] =
    "00:0 04:0 09:0 0A:0 0B:0 0C:0 0D:0 0E:0 0F:0 10:0 11:0 12:0 13:0 20:0 21:0 28:0 29:0 2A:4 2B:4 30:4 34:0 "
    "36:1 37:2 38:0 39:0 3A:1 44:2 45:0 51:1 53:1 DA:0 DB:0 DC:0 ";
static const char st7789_set[] =
    "01:0 26:1 2E:0 33:6 35:1 3E:0 52:0 54:0 55:1 56:0 5E:1 5F:0 68:0 B0:2 B1:3 B2:5 B3:3 B5:1 B7:1 B8:4 BA:1 BB:1 "
    "BC:1 BD:1 C0:1 C1:3 C3:1 C4:1 C5:1 C6:1 C7:1 C8:1 CA:1 CC:1 D0:2 D2:1 DF:4 E0:14 E1:14 E2:64 E3:64 E4:3 "
    "E7:1 E8:1 E9:3 EC:1 FA:4 FC:2 FE:2 ";
static const char ili9341_set[] =
    "01:0 26:1 2D:128 2E:0 33:6 35:1 3E:0 52:0 54:0 55:1 56:0 5E:1 5F:0 B0:1 B1:2 B2:2 B3:2 B4:1 B5:4 B7:1 B8:1 "
    "B9:1 BA:1 BB:1 BC:1 BE:1 BF:1 C0:1 C1:1 C5:2 C7:1 CB:5 CF:3 D0:2 D1:3 D2:0 D3:0 D9:1 E0:15 E1:15 E2:16 "
    "E3:64 E8:3 E9:3 EA:2 ED:4 EF:3 F2:1 F6:3 F7:1 ";
static const char gc9a01_set[] =
    "A7:1 B0:1 B6:2 BA:1 C1:1 C3:1 C4:1 C9:1 E8:1 E9:1 EC:1 EF:0 F0:6 F1:6 F2:6 F3:6 F6:1 FE:0 62:12 63:12 "
    "64:7 66:10 67:10 70:9 74:7 84:1 85:1 86:1 87:1 88:1 89:1 8A:1 8B:1 8C:1 8D:1 8E:1 8F:1 90:4 98:2 99:2 "
    "AE:1 BC:1 BD:1 BE:1 CD:1 DF:3 E1:2 EB:1 ED:2 FF:3 ";
static const char ssd1351_set[] =
    "15:2 5D:0 75:2 96:5 9E:0 9F:0 A0:1 A1:1 A2:1 A4:0 A5:0 A6:0 A7:0 AB:1 AD:0 AE:0 AF:0 B0:0 B1:1 B2:3 B3:1 "
    "B4:3 B5:1 B6:1 B8:63 B9:0 BB:1 BE:1 C1:3 C7:1 CA:1 D1:0 E3:0 FD:1 ";
static const char ssd0323_set[] =
    "15:2 23:1 24:5 25:6 26:4 2E:0 2F:0 75:2 81:1 84:0 85:0 86:0 A0:1 A1:1 A2:1 A4:0 A5:0 A6:0 A7:0 A8:1 AD:1 "
    "AE:0 AF:0 B0:1 B1:1 B2:1 B3:1 B4:1 B8:8 BC:1 BE:1 BF:1 E3:0 ";
static const char ssd1306_set[] =
    "00:0 0F:0 10:0 1F:0 20:1 21:2 22:2 23:1 26:6 27:6 29:5 2A:5 2E:0 2F:0 40:0 7F:0 81:1 8D:1 A0:0 A1:0 A3:2 "
    "A4:0 A5:0 A6:0 A7:0 A8:1 AD:1 AE:0 AF:0 B0:0 B7:0 C0:0 C8:0 D3:1 D5:1 D6:1 D9:1 DA:1 DB:1 E3:0 ";

/* Problems of a command with n arguments of 0 that are about its code or its count. */
static int miscounted(const char *name, int low, unsigned code, unsigned n)
{
    const struct pm_problem *p;
    struct pm_glass glass;
    assert_true(pm_glass_named(&glass, name));
    struct pm_model *m = pm_new(&glass);
    pm_reset(m);
    pm_byte(m, (uint8_t)code, 0);
    for (unsigned i = 0; i < n; i++)
        pm_byte(m, 0, !low);
    if (!low)
        pm_byte(m, 0xe3, 0); /* the next command, known or not */
    pm_end(m);
    int found = 0;
    for (size_t i = 0, all = pm_problems(m, &p); i < all; i++)
        found += p[i].at <= n && (p[i].kind == PM_COUNT || p[i].kind == PM_OUTSIDE || p[i].kind == PM_UNKNOWN);
    found += pm_counts(m)->commands != (low ? 1u : 2u); /* a byte too many with D/C low is another command */
    for (size_t i = 0, all = pm_problems(m, &p); low && i < all; i++)
        found += p[i].kind == PM_TRUNCATED;
    pm_free(m);
    return found;
}

static void check_set(const char *name, int low, const char *set, uint8_t known[256])
{
    for (const char *at = set; *at != '\0'; at += strcspn(at, " ") + 1) {
        const unsigned code = (unsigned)strtoul(at, NULL, 16), n = (unsigned)strtoul(at + 3, NULL, 10);
        known[code] = 1;
        if (miscounted(name, low, code, n) || !miscounted(name, low, code, n + 1) ||
            (n > 0 && !miscounted(name, low, code, n - 1))) {
            print_message("%s: 0x%02X does not take %u arguments, and no other number\n", name, code, n);
            fail();
        }
    }
}

/* Counts of the sets, and no code that is in none of them; more: codes whose arguments may be left out, RAM writes,
 * and those between the two ends of a range. */
static void command_sets(void **state)
{
    static const struct {
        const char *name, *set[2], *more;
        int low;
    } all[] = {
        { "st7789:240x240", { dcs_set, st7789_set }, "2C 3C C2", 0 },
        { "ili9341:240x320", { dcs_set, ili9341_set }, "2C 3C B6", 0 },
        { "gc9a01:240x240", { dcs_set, gc9a01_set }, "2C 3C 33 35 B5", 0 },
        { "ssd1351:128x128", { ssd1351_set, "" }, "5C", 0 },
        { "ssd0323:128x64", { ssd0323_set, "" }, "", 1 },
        { "ssd1306:128x64", { ssd1306_set, "" }, NULL, 1 },
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        uint8_t known[256] = { 0 };
        check_set(all[i].name, all[i].low, all[i].set[0], known);
        check_set(all[i].name, all[i].low, all[i].set[1], known);
        for (const char *at = all[i].more; at != NULL && *at != '\0'; at += 2 + (at[2] == ' '))
            known[strtoul(at, NULL, 16)] = 1;
        for (unsigned code = 0; all[i].more == NULL && code < 256; code++)
            known[code] |= code < 0x20 || (code >= 0x40 && code < 0x80) || (code >= 0xb0 && code < 0xb8);
        for (unsigned code = 0; code < 256; code++)
            assert_true(known[code] || miscounted(all[i].name, all[i].low, code, 0));
    }
}

/* Any bytes at all: no step outside of anything (the sanitizer looks on), and looking is always possible. */
static void junk(void **state)
{
    char list[1024];
    uint32_t seed = 1;
    (void)snprintf(list, sizeof list, "%s", pm_glass_list());
    for (char *name = strtok(list, ", "); name != NULL; name = strtok(NULL, ", ")) {
        struct view v = open_named(name);
        for (int i = 0; i < 60000; i++) {
            seed = seed * 1664525u + 1013904223u;
            pm_byte(v.m, (uint8_t)(seed >> 24), (seed >> 20 & 7u) > 1);
            if ((seed & 0xfff00u) == 0)
                pm_reset(v.m);
            if (i % 3000 == 0)
                look(&v);
        }
        pm_end(v.m);
        look(&v);
        const struct pm_problem *p;
        assert_true(pm_problems(v.m, &p) > 100);
        close_view(&v);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dark_until_awake_and_on),
        cmocka_unit_test(madctl_places),
        cmocka_unit_test(window_wraps_and_goes_on),
        cmocka_unit_test(pixel_formats),
        cmocka_unit_test(colours_of_the_glass),
        cmocka_unit_test(glass_in_the_ram),
        cmocka_unit_test(scrolling_and_parts),
        cmocka_unit_test(resets),
        cmocka_unit_test(counts),
        cmocka_unit_test(views),
        cmocka_unit_test(dcs_problems),
        cmocka_unit_test(data_before_any_command),
        cmocka_unit_test(pixels_out_of_the_ram),
        cmocka_unit_test(broken_off_arguments),
        cmocka_unit_test(too_early),
        cmocka_unit_test(st7789_lcmctrl),
        cmocka_unit_test(ili9341_rules),
        cmocka_unit_test(gc9a01_rules),
        cmocka_unit_test(ili9341_set_up_of_others),
        cmocka_unit_test(ssd1351_rules),
        cmocka_unit_test(ssd1351_writing),
        cmocka_unit_test(ssd1351_as_others_turn_it),
        cmocka_unit_test(ssd1351_96_rows),
        cmocka_unit_test(ssd1351_problems),
        cmocka_unit_test(ssd1351_light),
        cmocka_unit_test(ssd0323_rules),
        cmocka_unit_test(ssd0323_problems),
        cmocka_unit_test(ssd1306_addressing),
        cmocka_unit_test(ssd1306_pages_to_ff),
        cmocka_unit_test(ssd1306_scan),
        cmocka_unit_test(ssd1306_glass_and_light),
        cmocka_unit_test(ssd1306_problems),
        cmocka_unit_test(command_sets),
        cmocka_unit_test(names),
        cmocka_unit_test(junk),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
