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

static char orange_or_not(uint32_t c)
{
    return c == 0x000au ? '.' : c == 0xfc00u ? '#' : '?';
}

static void one_triangle(void **state)
{
    static const char *const rows[] = {
        "................................................",
        ".......................##.......................",
        ".......................##.......................",
        "......................####......................",
        ".....................######.....................",
        ".....................######.....................",
        "....................########....................",
        "...................##########...................",
        "...................##########...................",
        "..................############..................",
        "..................############..................",
        ".................##############.................",
        "................################................",
        "................################................",
        "...............##################...............",
        "..............####################..............",
        "..............####################..............",
        ".............######################.............",
        ".............######################.............",
        "............########################............",
        "...........##########################...........",
        "...........##########################...........",
        "..........############################..........",
        ".........##############################.........",
        "................................................",
    };
    const struct panel p = drawn_by(example_first_triangle);
    assert_rows(&p, 4, 25, rows, orange_or_not);
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

static void a_mirror_shows_the_back(void **state)
{
    static const char *const rows[] = {
        "..................bbbbbbbbbbbbbbbbbbbbbwbbbbbbbb", "..................bbbbbbbbbbbbbbbbbbwwwwbbbbbbbb",
        "..................bbbbbbbbbbbbbbbbbbrwwwbbbbbbbb", "..................bbbbbbbbbbbbbbbbbrrwwwwbbbbbbb",
        "..................bbbbbbbbbbbbbbbbbrrrwwwbbbbbbb", "..................bbwwwwbbbbbbbbbbrrrrwwwwbbbbbb",
        "................wwwwwwwwbbbbbbbbbrrrrrwwwwbbbbbb", "............wwwwwwwwwwwwbbbbbbbbbrrrrrrwwwbbbbbb",
        "............gwwwwwwwwwwwwbbbbbbbrrrrrrrwwwbbbbbb", "............gwwwwwwwwwwwwbbbbbbbbbbbbrrrwbbbbbbb",
        "............gwwwwwwwwwwwwbbbbbbbbbbbbbbbbbbbbbbb", "...........gggwwwwwwwwwwwwbbbbbbbbbbbbbbbbbbbbbb",
    };
    const struct panel p = drawn_by(example_mirror);
    assert_rows(&p, 12, 12, rows, color_of);
}

static void chrome_has_a_window(void **state)
{
    static const char *const rows[] = {
        "...................bbbbbbbbbb...................", ".................bbbbbbbbbbbbbb.................",
        "................bwwwwbbbbbbbbbbb................", "...............bwwwwwbbbbbbbbbbbb...............",
        "..............bbwwwwwbbbbbbbbbbbbb..............", "..............bbwwwwwbwwwwbbbbbbbb..............",
        ".............wwwwwwwwwwwwwwwwwwwwww.............", "............wwwwwwwwwwwwwwwwwwwwwwww............",
        "............wwwwwwwwwwwwwwwwwwwwwwww............", "............wwwwwwwwwwwwwwwwwwwwwwww............",
        "............wwwwwwwwwwwwwwwwwwwwwwww............", "............wwwwwwwwwwwwwwwwwwwwwwww............",
    };
    const struct panel p = drawn_by(example_matcap);
    assert_rows(&p, 4, 12, rows, color_of);
}

static void trees_before_mountains(void **state)
{
    static const char *const rows[] = {
        "bbbbbbbbmmmbmmmmmmmmmmmmbbbbbbbbbbbbbbbbbbbbbbbb", "bbbbbbbbmmmmmmmmmmmmmmmmmmmmbbbbbbbbbbbbbbbbbbbb",
        "bbbmmmmmmmmmmmmmmmmmmmmmmmmmbbbbbbbbbbbbbgbbbmmm", "bbbmmmmmmmmmgmmmmmmmmmmmmmmmbbbbbbbbbbbbbggbbmmm",
        "mmmmmmmmmmmg.mmmmmmmmmmmmmmmbbbbbbbbbbbbgggmmmmm", "mmmmmmmmmmmg.gmmmmmmmmmmmmgmbbbbbbbbbbbbggggmmmm",
        "mmmmmmmmmmmg.gmmmmmmmmmmmmggbbbbbbbbbbbbggggmmmm", "mmmmmmmmmmgg.gmmmmmmmmmmmmggmmmmbbbbmmmggggggmmm",
        "mmmmmmmmmmgg.ggmmmmmmmmmmggggmmmbbbbmmmgg.gggmmm", "mmmmmmmmmggg.ggmmmmmmmmmmggggmmmmmmmmmggg.ggggmm",
        "mmmmmmmmmggg.gggmmmmmmmmmmmmmmmmmmmmmmggg.ggggmm", "mmmmmmmmmmmm.mmmmmmmmmmmmmmmmmmmmmmmmmmmm.mmmmmm",
        "mmmmmmmmmmmm.mmmmmmmmmmmmmmmmmmmmmmmmmmmm.mmmmmm", "yyyyyyyyyyyy.yyyyyyyyyyyyyyyyyyyyyyyyyyyy.yyyyyy",
    };
    const struct panel p = drawn_by(example_sky);
    assert_rows(&p, 6, 14, rows, color_of);
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

/* The mean of red and green: white is v, red f, and half of the ball's colour with each between. */
static char mean_of(uint32_t c)
{
    return "0123456789abcdefghijklmnopqrstuv"[((c >> 11) + (c >> 6 & 31u)) / 2u];
}

static void a_ball_of_glass_shines(void **state)
{
    static const char *const rows[] = {
        "vvvvvvvvvvvvvvlmnnopqrtumlkjhgffedffffffffffffff", "vvvvvvvvvvvvvvlmnnoqrtuvnnlkihffedffffffffffffff",
        "vvvvvvvvvvvvvvmmnnprsuvvnnnljigffeffffffffffffff", "vvvvvvvvvvvvvlmnnoqrtuvvnnnlkigffedfffffffffffff",
    };
    const struct panel p = drawn_by(example_layered);
    assert_rows(&p, 9, 4, rows, mean_of);
}

static char red_of(uint32_t c)
{
    return "0123456789abcdefghijklmnopqrstuv"[c >> 11];
}

static void two_cores_draw_one_picture(void **state)
{
    static const char *const rows[] = {
        "00000000000000uuuuuuuuuullllllllll00000000000000", "00000000000000uuuuuuuullffllllllll00000000000000",
        "0000000000000uuuuuuullllfffflllllll0000000000000", "0000000000000uuuuuulllllfffffllllll0000000000000",
    };
    static const char *const each[] = {
        "0000000000000000uuuttttttttttlll0000000000000000", "0000000000000uuuuuulllllfffffllllll0000000000000",
        "0000000000000008llllllllffffffff8000000000000000", "000000000000000000008lllfff800000000000000000000",
    };
    const struct panel p = drawn_by(example_two_cores);
    assert_rows(&p, 10, 4, rows, red_of);
    for (int strip = 0; strip < 4; strip++) /* a row of each */
        assert_rows(&p, (int[]){ 6, 13, 22, 26 }[strip], 1, &each[strip], red_of);
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

static void a_flag_waves(void **state)
{
    static const char *const rows[] = {
        "............rrrrrrrrrrrrrrrrr.....rrrrr.........", ".............rrrrrrrrrrrrrrrr....rrrrrr.........",
        ".............rrrrrrrrrrrrrrrr....rrrrrr.........", ".............rrrrrrrrrrrrrrrr....rrrrrr.........",
        ".............wwwwwwwwwwwwwwww....rrrrrr.........", ".............wwwwwwwwwwwwwwww....rrrrrr.........",
        ".............wwwwwwwwwwwwwwww....rrrrrr.........", ".............wwwwwwwwwwwwwww.....wrrrrr.........",
    };
    const struct panel p = drawn_by(example_waving_flag);
    assert_rows(&p, 8, 8, rows, color_of);
}

static void light_in_steps(void **state)
{
    static const char *const rows[] = {
        "................................................", "................................................",
        "................wwwrrrrrrrrrrrrr................", "................rwwwrrrrrrrrrrrr................",
        "...............rrrrwwrrrrrrrrrrrr...............", "...............rrrrrrwrrrrrrrrrrr...............",
        "..............rrrrrrrrrrrrrrrrrrr...............", "..............rrrrrrrrrrrrrrrrrrr...............",
        "..............rrrrrrrrrrrrrrrrrrr...............", ".............rrrrrrrrrrrrrrrrrrrr...............",
    };
    const struct panel p = drawn_by(example_toon);
    assert_rows(&p, 3, 10, rows, color_of);
}

static void veins_of_marble(void **state)
{
    static const char *const rows[] = {
        "............wwwwww..wwwwwwwwwwwwwwb.............", "............wwwwwww..wwwwwwwwwwwwww.............",
        "...........wwwwwwww...wwwwwwwwwwwww.............", "...........wwwwwwwww...wwwwwwwwwwwww............",
        "...........wwwwwwwww...bwwwwwwwwwwwwb...........", "............wwwwwwwwb..bwwwwwwwwwwww............",
        ".............wwwwwwww..bwwwwwwwwwww.............", "...............wwwwwww...bwwwwwwww..............",
        "...............bwwwwwww.......www...............", "................wwwwwwwwwwwwww.w................",
    };
    const struct panel p = drawn_by(example_marble);
    assert_rows(&p, 14, 10, rows, color_of);
}

static void what_dissolves_shows_what_is_behind(void **state)
{
    static const char *const rows[] = {
        ".........yr..yrrrrr..ryrrr..rrr....rrry..r......", ".........rrrrrrr..yrrr.rbbryrrrbbbbrbbrrr.......",
        ".........rryy.bbybbrrbbbbbbrrrrrbbrbbbrrr.......", ".........y.yy.bbybrbbbrrrrrrbbrrbbbrrrbrr.......",
        ".........rrrrrbrbbrbbbrrrrrbbbbrrrbbrrbrrr......", "..............rryrrrrbyrrrrbbbbrrrbbrbr..r......",
        "..........r..rrbybrbbbbybbrrrrrbbbyrbbr..r......", "..........rrr.bbbbrbbryrrrrybbrbrrrbrrryyr......",
        ".............rryyrbbbbbbrrbbbbbrrrbrrrrrrr......", ".............rryyrbbbbbbrrbbbbbrrrbrrrrrrr......",
    };
    const struct panel p = drawn_by(example_dissolve);
    assert_rows(&p, 6, 10, rows, color_of);
}

static void three_lights_on_a_ball(void **state)
{
    static const char *const rows[] = {
        "...............rrrrrrrrrggggggggg...............", "..............rrrrrrrrr..ggggggggg..............",
        "..............rrrrrrrrr..ggggggggg..............", "..............rrrrrrrr....gggggggg..............",
        ".............rrrrrrrrr....ggggggggg.............", ".............rrrmmmmmmbbbbccccccggg.............",
        "............rrrmmmmmmbbbbbbccccccggg............", "............rrmmmmmmmbbbbbbcccccccgg............",
        "...........rrmmmmmmmbbbbbbbbcccccccgg...........", "...........rmmmmmmmmbbbbbbbbccccccccg...........",
    };
    const struct panel p = drawn_by(example_three_lights);
    assert_rows(&p, 8, 10, rows, color_of);
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

static void a_shadow_map(void **state)
{
    static const char *const rows[] = {
        "..............++++......+++.....................", "..............:::..+++++:::.+...................",
        ".............+:::..+++++:::+++++++++++..........", "............++::::.+++++:::++++++++++++.........",
        "...........++++:::.+++++:::++++++++++++.........", "..........+++++:::.+++++:::++++++++++++.........",
        "..........+++++:::.++++.:::..........++.........", ".........++++++:::......:::...........++........",
        "........+++++++:::......:::........+++++........", ".......++++++++:::.+..++:::+..++++++++++........",
    };
    const struct panel p = drawn_by(example_shadow_map);
    assert_rows(&p, 10, 10, rows, level_of);
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

/* A picture and no sentence; then a sentence, and nothing in the picture or a dark thing. */
static void what_is_wrong_is_said(void **state)
{
    static const char *const said[5] = {
        "",
        "instance 0 is out of view: it begins * beyond far = 20000; move it, or raise far.\n",
        "instance 0: pose.scale is 1/65536: was 1 * ZS_Q16_ONE meant?\n",
        "the light's dir has length 0, and 1 is ZS_Q30_ONE: zs_unit makes it that long.\n",
        "scene.instance is NULL, and n_instances is 1.\n",
    };
    static const char *const rows[] = {
        "....................++++++++....................", "...................++++++++++...................",
    };
    static struct panel p;
    const struct zs_sink sink = { .submit = take, .ctx = &p };
    for (uint32_t t = 0; t < 5; t++) {
        char got[256];
        memset(&p, 0, sizeof p);
        assert_int_equal(example_explain(t, &sink), t == 4 ? ZS_ERR_NULL : ZS_OK);
        (void)snprintf(got, sizeof got, "%s", example_said);
        char *at = t == 1 ? strstr(got, "begins ") : NULL;
        if (at) { /* a number of some digits */
            const size_t digits = strspn(at + 7, "0123456789");
            assert_in_range(digits, 5, 5);
            at[7] = '*';
            memmove(at + 8, at + 7 + digits, strlen(at + 7 + digits) + 1);
        }
        assert_string_equal(got, said[t]);
        uint32_t colors = 0;
        for (int i = 0; i < EXAMPLE_W * EXAMPLE_H; i++)
            colors |= memcmp(p.px[i / EXAMPLE_W][i % EXAMPLE_W], p.px[0][0], 2) != 0;
        assert_int_equal(colors, t == 0 || t == 3);
        if (t == 0)
            assert_rows(&p, 13, 2, rows, level_of);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(one_triangle),
    cmocka_unit_test(what_is_wrong_is_said),
    cmocka_unit_test(panes_of_glass),
    cmocka_unit_test(a_ball_of_glass_shines),
    cmocka_unit_test(two_cores_draw_one_picture),
    cmocka_unit_test(gauges_over_a_picture),
    cmocka_unit_test(posts_in_fog),
    cmocka_unit_test(dithered_light),
    cmocka_unit_test(leaves_are_cut_out),
    cmocka_unit_test(three_filters),
    cmocka_unit_test(two_pictures_in_one_frame),
    cmocka_unit_test(a_mirror_shows_the_back),
    cmocka_unit_test(chrome_has_a_window),
    cmocka_unit_test(trees_before_mountains),
    cmocka_unit_test(without_depth_memory),
    cmocka_unit_test(a_shader_of_the_users),
    cmocka_unit_test(hidden_lines),
    cmocka_unit_test(four_samples_a_pixel),
    cmocka_unit_test(a_flat_shadow_and_a_disc),
    cmocka_unit_test(a_flag_waves),
    cmocka_unit_test(light_in_steps),
    cmocka_unit_test(veins_of_marble),
    cmocka_unit_test(what_dissolves_shows_what_is_behind),
    cmocka_unit_test(three_lights_on_a_ball),
    cmocka_unit_test(a_shadow_map),
    cmocka_unit_test(a_sky_is_a_function_of_the_row),
    cmocka_unit_test(a_counter_costs_its_rectangle),
};
CASES_MAIN(tests)
