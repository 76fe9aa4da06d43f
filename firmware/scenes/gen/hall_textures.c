/* What the hall is covered with.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

static const struct gen_rgb black = { 0, 0, 0 }, white = { 255, 255, 255 };

/* 0 .. n - 1 for a place. */
static int64_t dice(int64_t x, int64_t y, uint32_t seed, uint32_t n)
{
    return gen_hash((uint32_t)x, (uint32_t)y, seed) % n;
}

/* A texture that repeats, square, of n texels each way. */
static void repeated(const char *name, int64_t n, struct gen_rgb (*at)(int64_t x, int64_t y), enum gen_format format)
{
    struct gen_image *im = gen_image(name, n, n);
    gen_paint(im, at);
    gen_texture(im, format, GEN_REPEAT);
}

/* Four tiles in two colours, with joints. */
static struct gen_rgb tiles_at(int64_t x, int64_t y)
{
    static const struct gen_rgb light = { 226, 214, 190 }, dark = { 128, 58, 50 };
    static const struct gen_rgb joint = { 92, 88, 84 };
    const int64_t tile = 32, i = x % tile, j = y % tile;
    const struct gen_rgb base = (x / tile + y / tile) & 1 ? dark : light;
    if (i == 0 || j == 0)
        return joint;
    if (i == 1 || j == 1)
        return gen_mix(base, white, 1, 4); /* a bevel */
    return gen_mix(base, black, dice(x / 2, y / 2, 3, 4), 28);
}

/* Boards along v. */
static struct gen_rgb planks_at(int64_t x, int64_t y)
{
    static const struct gen_rgb wood = { 150, 108, 66 }, dark = { 92, 60, 36 };
    const int64_t board = 16, n = x / board;
    const int64_t at[3] = { x * 65536 / 2, y * 65536 / 16, 0 };
    const int64_t grain = gen_noise(at, 4 * 8, 21 + (uint32_t)n) >> 13; /* 0 .. 7 */
    if (x % board == 0 || (y + n * 24) % 64 == 0)
        return gen_mix(dark, black, 1, 2);
    return gen_mix(wood, dark, grain + n % 2 * 3, 14);
}

#define BRICKS 128 /* texels each way */

/* Stretchers, half a brick further in every other row. */
static struct gen_rgb bricks_at(int64_t x, int64_t y)
{
    static const struct gen_rgb fired[4] = {
        { 176, 82, 58 }, { 160, 70, 52 }, { 190, 96, 66 }, { 148, 76, 64 },
    };
    static const struct gen_rgb mortar = { 172, 166, 154 };
    const int64_t wide = 32, high = 16;
    const int64_t row = y / high, along = (x + (row & 1) * wide / 2) % BRICKS;
    const int64_t i = along % wide, j = y % high, shade = dice(x, y, 8, 5);
    const struct gen_rgb base = fired[dice(along / wide, row, 12, 4)];
    if (i < 2 || j < 2)
        return gen_mix(mortar, black, shade, 24);
    if (i == wide - 1 || j == high - 1)
        return gen_mix(base, black, 1, 3);
    return i == 2 || j == 2 ? gen_mix(base, white, 1, 5) : gen_mix(base, black, shade, 30);
}

/* Veins: a wave across, bent by noise; it repeats both ways. */
static struct gen_rgb marble_at(int64_t x, int64_t y)
{
    static const struct gen_rgb stone = { 236, 232, 224 }, vein = { 148, 156, 158 };
    const int64_t at[3] = { x * 65536 / 16, y * 65536 / 16, 0 };
    const int64_t bent = gen_fractal(at, 4, 4, 5);
    const int64_t wave = gen_sin((x + y) * 1024 + 3 * bent); /* once across */
    const int64_t near = gen_div(31 * (wave < 0 ? -wave : wave), GEN_Q30);
    return gen_mix(vein, stone, near > 20 ? 20 : near, 20);
}

static void nail(struct gen_image *im, int64_t x, int64_t y)
{
    static const struct gen_rgb head = { 70, 66, 64 }, shine = { 190, 186, 180 };
    gen_box(im, x, y, 3, 3, head);
    gen_dot(im, x, y, shine);
}

#define CRATE 128 /* texels each way */
#define EDGE 16   /* width of the frame */
#define BRACE 14  /* half the width of the brace */

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static struct gen_rgb crate_at(int64_t x, int64_t y)
{
    static const struct gen_rgb board = { 196, 146, 86 }, frame = { 168, 116, 60 };
    const int64_t in_x = least(x, CRATE - 1 - x), in_y = least(y, CRATE - 1 - y); /* from edges */
    const int64_t off = x + y - (CRATE - 1); /* from the brace's middle */
    const int level = in_y < EDGE && in_y < in_x; /* a board of the frame, above or below ... */
    const int upright = in_x < EDGE && !level;    /* ... and at a side */
    const int brace = off > -BRACE && off < BRACE, inside = !level && !upright;
    const int64_t at[3] = { (level ? y : x) * 65536 / 2, (level ? x : y) * 65536 / 24, 0 };
    const int64_t grain = gen_fractal(at, 4096, 2, 60) >> 12; /* 0 .. 15 */
    if (in_x == 0 || in_y == 0)
        return gen_mix(frame, black, 1, 3);
    if (least(in_x, in_y) == EDGE)
        return gen_mix(frame, black, 3, 5);
    if (inside && (off == -BRACE || off == BRACE))
        return gen_mix(frame, black, 1, 2);
    if (inside && !brace && x % 24 == 8)
        return gen_mix(board, black, 3, 5); /* a gap between boards */
    return gen_mix(inside && !brace ? board : frame, black, grain, 44);
}

/* A face of a crate: boards in a frame with a brace, and stencilled letters. */
static void crate(void)
{
    static const struct gen_rgb ink = { 60, 40, 30 };
    struct gen_image *im = gen_image("crate", CRATE, CRATE);
    gen_paint(im, crate_at);
    for (int i = 0; i < 4; i++)
        nail(im, i & 1 ? CRATE - 10 : 7, i & 2 ? CRATE - 10 : 7);
    gen_text(im, 26, 28, 3, 3, "ZS", ink);
    gen_text(im, 72, 82, 2, 3, "NO7", ink);
    gen_texture(im, GEN_565, GEN_REPEAT);
}

/* A poster in a frame of one colour, which clamping makes as wide as the mesh is larger than it. */
static void poster(void)
{
    static const struct gen_rgb frame = { 52, 34, 24 }, paper = { 246, 240, 222 };
    static const struct gen_rgb high = { 40, 92, 170 }, low = { 250, 190, 120 };
    static const struct gen_rgb sun = { 255, 236, 130 }, hill = { 60, 92, 84 };
    static const struct gen_rgb ink = { 196, 40, 44 };
    const int64_t n = 128;
    struct gen_image *im = gen_image("poster", n, n);
    gen_box(im, 0, 0, n, n, frame);
    gen_box(im, 3, 3, n - 6, n - 6, paper);
    for (int64_t y = 8; y < 88; y++) {
        for (int64_t x = 8; x < n - 8; x++) {
            const int64_t ridge = 62 + gen_div(14 * gen_sin(x * 900), GEN_Q30) -
                                  gen_div(7 * gen_sin(x * 2300 + 9000), GEN_Q30);
            const int64_t dx = x - 84, dy = y - 36;
            struct gen_rgb c = gen_mix(high, low, (y - 8) / 4, 20);
            if (dx * dx + dy * dy < 15 * 15)
                c = sun;
            if (y > ridge)
                c = gen_mix(hill, black, (y - ridge) / 4, 16);
            gen_dot(im, x, y, c);
        }
    }
    gen_text(im, 12, 93, 3, 3, "ZSTRIP", ink);
    gen_text(im, 26, 116, 1, 1, "INTEGERS ONLY", black);
    gen_texture(im, GEN_PAL8, GEN_CLAMP);
}

/* The way out. */
static void sign(void)
{
    static const struct gen_rgb green = { 20, 130, 74 };
    struct gen_image *im = gen_image("sign", 64, 32);
    gen_box(im, 0, 0, 64, 32, white);
    gen_box(im, 1, 1, 62, 30, green);
    gen_text(im, 4, 9, 2, 2, "EXIT", white);
    for (int64_t i = 0; i < 6; i++) /* an arrow to the right */
        gen_box(im, 53 + i, 10 + i, 1, 12 - 2 * i, white);
    gen_texture(im, GEN_PAL4, GEN_CLAMP);
}

void gen_hall_textures(void)
{
    repeated("tiles", 64, tiles_at, GEN_PAL4);
    repeated("planks", 64, planks_at, GEN_PAL4);
    repeated("bricks", BRICKS, bricks_at, GEN_PAL8);
    repeated("marble", 64, marble_at, GEN_PAL8);
    crate();
    poster();
    sign();
}
