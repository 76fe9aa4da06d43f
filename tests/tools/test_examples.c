/* The programs of firmware/examples: their pictures, as rows of characters, and what they send.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cases.h"

#include <string.h>

#include "examples.h"

/* What arrives at a panel: changed columns alone. */
struct panel {
    uint8_t px[EXAMPLE_H][EXAMPLE_W][2];
    uint32_t pixels; /* that were sent */
};

static int take(void *ctx, const struct zs_strip *s)
{
    struct panel *p = ctx;
    for (uint16_t y = 0; y < s->h; y++)
        memcpy(p->px[s->y + y][s->dirty_x], s->px + 2u * ((uint32_t)y * s->w + s->dirty_x), 2u * s->dirty_w);
    p->pixels += (uint32_t)s->dirty_w * s->h;
    return 0;
}

static struct panel drawn_by(int example(uint32_t frame, const struct zs_sink *sink))
{
    static struct panel p;
    const struct zs_sink sink = { .submit = take, .ctx = &p };
    memset(&p, 0, sizeof p);
    assert_int_equal(example(0, &sink), ZS_OK);
    return p;
}

static void assert_rows(const struct panel *p, int y, int n, const char *const *rows, char (*letter)(uint32_t rgb565))
{
    for (int row = 0; row < n; row++) {
        char got[EXAMPLE_W + 1] = { 0 };
        for (int x = 0; x < EXAMPLE_W; x++)
            got[x] = letter((uint32_t)p->px[y + row][x][0] << 8 | p->px[y + row][x][1]);
        assert_string_equal(got, rows[row]);
    }
}

static char sky_or_hill(uint32_t c)
{
    return (c & 31u) == 31u ? "0123456789abcdefghijklmnopqrstuv"[c >> 11] : '#';
}

static void a_sky_is_a_function_of_the_row(void **state)
{
    static const char *const rows[] = {
        "dddddddddddddddddd############dddddddddddddddddd", "eeeeeeeeeeeeeeeee##############eeeeeeeeeeeeeeeee",
    };
    const struct panel p = drawn_by(example_gradient_sky);
    for (int y = 0; y < EXAMPLE_H; y++)
        for (int x = 0; x < EXAMPLE_W; x++) {
            const char c = sky_or_hill((uint32_t)p.px[y][x][0] << 8 | p.px[y][x][1]);
            const uint32_t level = (uint32_t)y * 255u / EXAMPLE_H;
            if (c != '#')
                assert_int_equal(c, "0123456789abcdefghijklmnopqrstuv"[(level * 31u + 127u) / 255u]);
        }
    assert_rows(&p, 14, 2, rows, sky_or_hill);
}

static char digit_or_not(uint32_t c)
{
    return c == 0xffffu ? '#' : '.';
}

static void a_counter_costs_its_rectangle(void **state)
{
    static const char *const rows[] = {
        "................................................", "...................................###..#..###..",
        "...................................#.#.##....#..", "...................................#.#..#..###..",
        "...................................#.#..#..#....", "...................................###.###.###..",
        "................................................",
    };
    static struct panel p;
    const struct zs_sink sink = { .submit = take, .ctx = &p };
    assert_int_equal(example_frame_counter(0, &sink), ZS_OK);
    assert_int_equal(p.pixels, EXAMPLE_W * EXAMPLE_H);
    p.pixels = 0;
    assert_int_equal(example_frame_counter(12, &sink), ZS_OK);
    assert_in_range(p.pixels, 1, 24 * 8); /* one strip, its columns widened to multiples of ZS_DAMAGE_GRAIN */
    assert_rows(&p, 0, 7, rows, digit_or_not);
    p.pixels = 0;
    assert_int_equal(example_frame_counter(12, &sink), ZS_OK);
    assert_int_equal(p.pixels, 0);
}

static char ring_or_not(uint32_t c)
{
    return c == 0x000au ? '.' : '#';
}

static void a_shader_of_the_users(void **state)
{
    static const char *const rows[] = {
        "........##..####......####......####..##........",
        "........#..###.....##########.....###..#........",
        "...........##....##############....##...........",
        "..........###...################...###..........",
        ".........###...######......######...###.........",
        ".........##...#####..........#####...##.........",
        ".........##...####............####...##.........",
        "........###..####..............####...##........",
        "........##...####..............####...##........",
        "........##...###................###...##........",
        "........##...###................####..##........",
        "........##..####................####..##........",
    };
    const struct panel p = drawn_by(example_user_shader);
    assert_rows(&p, 4, 12, rows, ring_or_not);
}

static char color_of(uint32_t c)
{
    static const char letter[] = ".bgcrmyw"; /* red, green, blue: a bit each */
    return letter[(c >> 15 & 1u) << 2 | (c >> 10 & 1u) << 1 | (c >> 4 & 1u)];
}

static void two_pictures_in_one_frame(void **state)
{
    static const char *const rows[] = {
        "bbrrrrrrrrrrrrrrrr...bbb......wwwwwwwwwwwwwwww..",
        "brrrrrrrrrrrrrrrrr...bbb......wwwwwwwwwwwwwwwww.",
        "brrrrrrrrrrrrrrrrr....bb......wwwwwwwwwwwwwwwww.",
        "brrrrrrrrrrrrrrrrr....bb......wwwwwwwwwwwwwwwww.",
        "rrrrrrrrrrrrrrrrrr....bb......wwwwwwwwwwwwwwwwww",
        "rrrrrrrrrrrrrrrrrr....bb......wwwwwwwwwwwwwwwwww",
        "rrrrrrrrrrrrrrrrr.....bb.......wwwwwwwwwwwwwwwww",
        "rrrrrrrrrrrrrrrrr.....bb.......wwwwwwwwwwwwwwwww",
    };
    const struct panel p = drawn_by(example_split_screen);
    assert_int_equal(p.pixels, EXAMPLE_W * EXAMPLE_H);
    assert_rows(&p, 16, 8, rows, color_of);
}

static void without_depth_memory(void **state)
{
    static const char *const rows[] = {
        ".........rrrrrrrrrrrrr..........................",
        ".........rrrrrrrrgggggggggggggg.................",
        ".........rrrrrrrrgggggggggbbbbbbbbbbbbbbbb......",
        ".........rrrrrrrrgggggggggbbbbbbbbbbbbbbbb......",
    };
    const struct panel p = drawn_by(example_no_depth);
    assert_rows(&p, 4, 4, rows, color_of);
}

static void hidden_lines(void **state)
{
    static const char *const rows[] = {
        "................#.............#.#...............", "...............#..............#.#...............",
        "...............#..............#.####............", "..............##..............###...###.........",
        ".............#.#.............#..#....#..........", "............#.#..............#..#....#..........",
        "...........#..#..............#.#.....#..........", ".........##...#..............#.#.....#..........",
        "........#.....#..............##.....#...........", ".......#......##............##......#...........",
        "......##........###.........##......#...........", "........###........###......#......#............",
    };
    const struct panel p = drawn_by(example_hidden_line);
    assert_rows(&p, 13, 12, rows, digit_or_not);
}

static char leaf_or_not(uint32_t c)
{
    return c == ZS_RGB565(0x30a020)   ? 'g'
           : c == ZS_RGB565(0x90d040) ? 'l'
           : c == ZS_RGB565(0x704020) ? 't'
           : c == ZS_RGB565(0xc0a060) ? '.'
                                      : ' ';
}

static void leaves_are_cut_out(void **state)
{
    static const char *const rows[] = {
        "                  ggglllllggg                   ",
        "               ggg  ggggggglggg                 ",
        "               ggg  ggggggllggg                 ",
        "               ggg g gggggllgg gg               ",
        "               ggg gggllllgggg gg               ",
        "            ggglllggggllllggll gg               ",
        "............ggglllggg.glllggllggg...............",
        "............ggglllggggggggggllggg...............",
        "............ggggggg.gggggg..llggg...............",
        "............ggggggg.ggggggggggggg...............",
    };
    const struct panel p = drawn_by(example_cutout);
    assert_rows(&p, 8, 10, rows, leaf_or_not);
}

static char green_of(uint32_t c)
{
    return c == ZS_RGB565(0x80b0f0) ? '-' : "0123456789abcdefghijklmnopqrstuv"[c >> 6 & 31u];
}

/* Noise, then less of it, then a level whose texels are of one colour at the horizon. */
static void three_filters(void **state)
{
    static const char *const rows[] = {
        "uu44uu44uu44uu44uu44uu44uu44uu44hhhhhhhhhhhhhhhh",
        "uu444uuu444uuu44uuf44nuq84buuj44hhhhhhhhhhhhhhhh",
        "u444uuuu4444uuu4k966issnb66gsspeifcehlmigcdhkmjg",
        "uuuu4444uuuu4444uuuj644bnuusg444lnkhebcfjmnkhebd",
        "uuu44444uuuuu444iihhggghhiiihhggiihhggghhiiihhgg",
        "44uuuuuu444444uu4dluuuuld4444dlu4dluuuuld4444dlu",
    };
    const struct panel p = drawn_by(example_filters);
    assert_rows(&p, 18, 6, rows, green_of);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(leaves_are_cut_out),
    cmocka_unit_test(three_filters),
    cmocka_unit_test(two_pictures_in_one_frame),
    cmocka_unit_test(without_depth_memory),
    cmocka_unit_test(a_shader_of_the_users),
    cmocka_unit_test(hidden_lines),
    cmocka_unit_test(a_sky_is_a_function_of_the_row),
    cmocka_unit_test(a_counter_costs_its_rectangle),
};
CASES_MAIN(tests)
