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

static char gauge_letter(uint32_t c)
{
    const char other = c >> 11 > 20 ? 'o' : (c & 31u) == 8u ? '-' : '.';
    return c == 0xffffu ? '#' : c == 0xf800u ? 'r' : c == 0x07e0u ? 'g' : other;
}

static void gauges_over_a_picture(void **state)
{
    static const char *const rows[] = {
        "............-------.............................", ".........o------------..........................",
        ".......oooo-.......-----........................", "......oooo.....#.....----.......................",
        ".....ooo.......#.......---......................", "....ooo....rr..#........---.....................",
        "...ooo.#....r..........#.---....................", "...oo...#...r.........#...--....................",
        "..ooo....#...r.......#....---...................", "..oo.........r.............--...................",
        "..oo.........rr............--..........#...###..", ".oo..........rrr............--.ggg....##..#...#.",
        ".oo..........rrr............--.ggg...#.#......#.", ".oo...........rrr...........--.ggg..#..#....##..",
        ".oo.###.......rrr.......###.--.ggg..#####..#....", ".oo...........rrrr..........--.ggg.....#..#.....",
        ".oo...........rrrrr.........--.ggg.....#..#####.",
    };
    static struct panel p;
    const struct zs_sink sink = { .submit = take, .ctx = &p };
    assert_int_equal(example_cockpit_gauges(0, &sink), ZS_OK);
    assert_int_equal(p.pixels, EXAMPLE_W * EXAMPLE_H);
    assert_rows(&p, 2, 17, rows, gauge_letter);
    p.pixels = 0;
    assert_int_equal(example_cockpit_gauges(100, &sink), ZS_OK); /* the same values */
    assert_int_equal(p.pixels, 0);
}

/* Fog grows with the distance: black posts are the greyer the farther they are; the sky keeps its colour. */
static void posts_in_fog(void **state)
{
    const struct panel p = drawn_by(example_fog);
    uint32_t green[4];
    static const int at[4][2] = { { 5, 16 }, { 17, 16 }, { 20, 16 }, { 10, 2 } };
    for (int k = 0; k < 4; k++)
        green[k] = ((uint32_t)p.px[at[k][1]][at[k][0]][0] << 8 | p.px[at[k][1]][at[k][0]][1]) >> 5 & 63u;
    assert_true(green[0] < green[1] && green[1] < green[2] && green[2] < green[3]);
    assert_int_equal(green[3], ZS_RGB565(0xc0c8d0) >> 5 & 63u);
}

/* Four formats: the mean of eight columns grows from left to right; the last one is black and white. */
static void dithered_light(void **state)
{
    const struct panel p = drawn_by(example_dither);
    for (int strip = 0; strip < 4; strip++) {
        uint32_t before = 0;
        for (int part = 0; part < 3; part++) {
            uint32_t sum = 0;
            for (int k = 0; k < 8 * 16; k++) {
                const uint8_t *px = p.px[strip * 8 + k / 16][part * 16 + k % 16];
                const uint32_t c = (uint32_t)px[0] << 8 | px[1];
                sum += c >> 5 & 63u;
                assert_true(strip < 3 || c == 0 || c == 0xffffu);
            }
            assert_true(sum > before + 8 * 16 * 10 || part == 0);
            before = sum;
        }
    }
}

static char level_of(uint32_t c)
{
    return c == 0xffffu ? 'w' : ".:+x#"[(c >> 5 & 63u) * 4u / 63u];
}

static void four_samples_a_pixel(void **state)
{
    static const char *const rows[] = {
        "wwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwww", "....................++..........................",
        ".................:+##+..........................", ".................:####..........................",
        "..................+###..........................", "..................:###+.........................",
        "...................+##+.........................", "....................##+...........::............",
        "....................:##.........:+#+............", ".....................+#........+####............",
        ".....................:#+.....:######+...........", "......................++...:+######++...........",
    };
    const struct panel p = drawn_by(example_supersampled);
    assert_int_equal(p.pixels, EXAMPLE_W * EXAMPLE_H);
    assert_rows(&p, 2, 12, rows, level_of);
}

static char pane_of(uint32_t c)
{
    static const struct { uint16_t color; char letter; } of[] = {
        { 0x0000, '.' }, { 0x8410, '#' }, { 0x8000, 'r' }, { 0xc208, 'R' }, { 0x0010, 'b' }, { 0x8008, 'p' },
        { 0x0280, 'g' }, { 0x8690, 'G' }, { 0x0290, 'B' } };
    for (unsigned k = 0; k < sizeof of / sizeof of[0]; k++)
        if (of[k].color == c)
            return of[k].letter;
    return '?';
}

static void panes_of_glass(void **state)
{
    static const char *const rows[] = {
        "..rrrrrrrrrrrrrrrrRRRRRRR##############.........", "..rrrrrrrrrrrrrpppRRRRRRR##############.........",
        "..rrrrrrrrrrrrrpppRRRRRRR##############.........", "..rrrrrrrrrrrrrpppRRRRRRR##GGGGGGGGGGGGggggggggg",
    };
    static const char *const below[] = {
        "..rrrrrrrrrrrrrpppRRRRRRR##GGGGGGGGGGGGggggggggg", "...............bbb#########GGGGGGGGGGGGggggggggg",
        "...............bbb#########GGGGGGGGGGGGggggggggg", "...............bbb#########GGGGGGGGGGGGggggggggg",
        "...............bbbbbbbbbbbbBBBBBBggggggggggggggg", "...............bbbbbbbbbbbbBBBBBBggggggggggggggg",
        "...........................ggggggggggggggggggggg",
    };
    const struct panel p = drawn_by(example_glass);
    assert_rows(&p, 10, 4, rows, pane_of);
    assert_rows(&p, 21, 7, below, pane_of);
}

static void a_flat_shadow_and_a_disc(void **state)
{
    static const char *const rows[] = {
        ".wwwwwwwwwwwwwwwww..wwwwwwwwwwwxxxxxxxwwwwwwwww.", "wwwwwwwwwwwwwwwwww..wwwwwwwwwwx++::::+xxwwwwwwww",
        "wwwwwwwwwwwwwwwwww..wwwwwwwwwxx+:....:+xxwwwwwww", "wwwwwwwwwwwwwwwwwww:wwwwwwwwwwx+:....::+xwwwwwww",
        "wwwwwwwwwwwwwwwwwwww:wwwwwwwwwxx+:::::++xwwwwwww", "wwwwwwwwwwwwwwwwwwwww:wwwwwwwwwxx++++++xxwwwwwww",
        "wwwwwwwwwwwwwwwww:::::::::::wwwwwxxxxxxxwwwwwwww", "wwwwwwwwwwwwwwwwwwwwww::wwwwwwwwwwwwwwwwwwwwwwww",
        "wwwwwwwwwwwwwwwwwwwwwww::wwwwwwwwwwwwwwwwwwwwwww", "wwwwwwwwwwwwwwwwwwwwwwww::wwwwwwwwwwwwwwwwwwwwww",
    };
    const struct panel p = drawn_by(example_planar_shadow);
    assert_rows(&p, 15, 10, rows, level_of);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(gauges_over_a_picture),
    cmocka_unit_test(posts_in_fog),
    cmocka_unit_test(dithered_light),
    cmocka_unit_test(panes_of_glass),
    cmocka_unit_test(two_pictures_in_one_frame),
    cmocka_unit_test(without_depth_memory),
    cmocka_unit_test(a_shader_of_the_users),
    cmocka_unit_test(hidden_lines),
    cmocka_unit_test(four_samples_a_pixel),
    cmocka_unit_test(a_flat_shadow_and_a_disc),
    cmocka_unit_test(a_sky_is_a_function_of_the_row),
    cmocka_unit_test(a_counter_costs_its_rectangle),
};
CASES_MAIN(tests)
