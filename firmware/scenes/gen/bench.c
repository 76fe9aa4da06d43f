/* The meshes of the bench scenes. Lengths are given for a picture of 320 x 240 px with a focal
 * length of 320 px; ../bench.h says how many steps that is.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#include "../bench.h"

static const struct gen_rgb black = { 0, 0, 0 }, white = { 255, 255, 255 };

/* Uniform, -n .. n. */
static int64_t jitter(uint32_t a, uint32_t b, uint32_t seed, int64_t n)
{
    return (int64_t)(gen_hash(a, b, seed) % (uint32_t)(2 * n + 1)) - n;
}

static struct gen_rgb random_rgb(uint32_t a, uint32_t b, uint32_t seed)
{
    const uint32_t h = gen_hash(a, b, seed);
    const struct gen_rgb c = { (uint8_t)(64u + (h & 127u)), (uint8_t)(64u + (h >> 8 & 127u)),
                               (uint8_t)(64u + (h >> 16 & 127u)) };
    return c;
}

/* Two triangles to each cell of a grid of vertices, row by row; their colours by seeds `seed` and the next. */
static void two_to_a_cell(struct gen_mesh *m, uint32_t columns, uint32_t rows, uint32_t seed)
{
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns; i++) {
            const uint32_t a = j * (columns + 1) + i, c = a + columns + 1;
            gen_tri(m, a, c, c + 1, random_rgb(i, j, seed));
            gen_tri(m, a, c + 1, a + 1, random_rgb(i, j, seed + 1));
        }
}

#define RELIEF_COLUMNS 42
#define RELIEF_ROWS 30

#define BALL 36 /* cells each way */
#define BALL_UV_BITS 14

/* The ball's surface at column i of row j from the top. */
static void bumpy_point(int64_t out[3], uint32_t i, uint32_t j)
{
    const int64_t polar = (int64_t)j * 32768 / BALL, a = (int64_t)i * 65536 / BALL;
    const int64_t s = gen_sin(polar), c = gen_cos(polar);
    const int64_t wave = gen_div(gen_sin(5 * a) * gen_sin(4 * polar), GEN_Q30);
    const int64_t r = 28000 + gen_div(gen_div(wave * s, GEN_Q30) * 2800, GEN_Q30);
    const int64_t flat = gen_div(r * s, GEN_Q30);
    out[0] = gen_div(flat * gen_sin(a), GEN_Q30);
    out[1] = gen_div(r * c, GEN_Q30);
    out[2] = gen_div(flat * gen_cos(a), GEN_Q30);
}

/* A bumpy ball: 36 x 36 cells, 2520 triangles. */
static void bumpy(void)
{
    const uint32_t n = BALL;
    struct gen_mesh *m = gen_begin("bumpy");
    for (uint32_t j = 0; j <= n; j++) {
        for (uint32_t i = 0; i < n; i++) {
            int64_t p[3];
            bumpy_point(p, i, j);
            gen_vert(m, p[0], p[1], p[2]);
            if (j == 0 || j == n)
                break;
        }
    }
    for (uint32_t j = 0; j < n; j++) {
        const uint32_t up = j ? 1 + (j - 1) * n : 0, low = 1 + j * n;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t k = (i + 1) % n;
            const struct gen_rgb even = { 70, 160, 235 }, odd = { 250, 236, 210 };
            const struct gen_rgb rgb = (i / 3 + j / 3) & 1u ? odd : even;
            if (j == 0) {
                gen_tri(m, up, low + i, low + k, rgb);
            } else {
                if (j < n - 1)
                    gen_tri(m, up + i, low + i, low + k, rgb);
                gen_tri(m, up + i, j < n - 1 ? low + k : low, up + k, rgb);
            }
        }
    }
    const int64_t light[3] = { -3, 4, 5 };
    gen_bake(m, light, 56);
    gen_write(m, GEN_FACE_NORMAL | GEN_FACE_RGB | GEN_FACE_RAW, BENCH_BUMPY_SCALE);
}

/* The same triangles in the same order under a texture, once around and from pole to pole: a column
 * more where it begins again, and a vertex a triangle at the poles, in its middle. */
static void bumpy_uv(void)
{
    const uint32_t n = BALL, row = BALL + 1;
    const int64_t one = (int64_t)1 << BALL_UV_BITS;
    struct gen_mesh *m = gen_begin("bumpy_uv");
    m->uv_bits = BALL_UV_BITS;
    for (uint32_t j = 0; j <= n; j++) {
        const uint32_t at_pole = j == 0 || j == n;
        for (uint32_t i = 0; i < row; i++) {
            int64_t p[3];
            bumpy_point(p, i % n, j);
            const int64_t u = gen_div((2 * (int64_t)i + at_pole) * one, 2 * n);
            gen_uv(m, gen_vert(m, p[0], p[1], p[2]), u, gen_div((int64_t)j * one, n));
            if (at_pole && i == n - 1)
                break;
        }
    }
    for (uint32_t j = 0; j < n; j++) {
        const uint32_t up = j ? n + (j - 1) * row : 0, low = n + j * row;
        for (uint32_t i = 0; i < n; i++) {
            if (j == 0) {
                gen_tri(m, up + i, low + i, low + i + 1, white);
            } else {
                if (j < n - 1)
                    gen_tri(m, up + i, low + i, low + i + 1, white);
                gen_tri(m, up + i, j < n - 1 ? low + i + 1 : low + i, up + i + 1, white);
            }
        }
    }
    gen_smooth(m);
    gen_write(m, GEN_NORMAL | GEN_FACE_NORMAL | GEN_UV, BENCH_BUMPY_SCALE);
}

/* Return one at 0, falling to 0 at |at| = width and beyond; q30. */
static int64_t bump(int64_t at, int64_t width)
{
    const int64_t d = at < 0 ? -at : at;
    return d < width ? gen_div(GEN_Q30 + gen_cos(d * 32768 / width), 2) : 0;
}

/* The relief at column i of row j from the top: a head from ear to ear, open behind. */
static void relief_point(int64_t out[3], uint32_t i, uint32_t j)
{
    const int64_t degree = 182; /* of 65536 to the turn */
    const int64_t a = ((int64_t)i * 2 - RELIEF_COLUMNS) * 103 * degree / RELIEF_COLUMNS;
    const int64_t polar = (12 + 154 * (int64_t)j / RELIEF_ROWS) * degree, side = a < 0 ? -a : a;
    int64_t r = 20000 * GEN_Q30;
    r -= 2600 * gen_div(bump(side - 26 * degree, 24 * degree) * bump(polar - 80 * degree, 16 * degree), GEN_Q30);
    r += 1500 * bump(polar - 66 * degree, 12 * degree);
    r += 2200 * gen_div(bump(a, 46 * degree) * bump(polar - 138 * degree, 18 * degree), GEN_Q30);
    r -= 1500 * gen_div(bump(a, 40 * degree) * bump(polar - 117 * degree, 9 * degree), GEN_Q30);
    if (polar > 70 * degree && polar < 107 * degree) /* the nose; it ends in an overhang */
        r += 8200 * gen_div(bump(a, 20 * degree) * ((polar - 70 * degree) * 2048 / (37 * degree)), 2048);
    if (polar > 72 * degree && polar < 112 * degree) /* ears of two columns */
        r += 7600 * gen_div(bump(side - 92 * degree, 9 * degree) *
                                gen_sin((polar - 72 * degree) * 32768 / (40 * degree)),
                            GEN_Q30);
    r += 420 * gen_div(gen_sin(14 * a) * bump(polar - 20 * degree, 50 * degree), GEN_Q30); /* hair in strands */
    r = gen_div(r, GEN_Q30);
    const int64_t flat = gen_div(r * gen_sin(polar), GEN_Q30);
    out[0] = gen_div(flat * gen_sin(a) * 7, GEN_Q30 * 8);
    out[1] = gen_div(r * gen_cos(polar) * 5, GEN_Q30 * 4);
    out[2] = gen_div(flat * gen_cos(a), GEN_Q30);
}

/* A head as a scanner leaves it: an open surface of 42 x 30 cells, 2520 triangles, with folds and thin parts. */
static void relief(void)
{
    struct gen_mesh *m = gen_begin("relief");
    const int64_t light[3] = { -3, 4, 5 };
    m->uv_bits = BALL_UV_BITS;
    for (uint32_t j = 0; j <= RELIEF_ROWS; j++)
        for (uint32_t i = 0; i <= RELIEF_COLUMNS; i++) {
            const int64_t one = (int64_t)1 << BALL_UV_BITS;
            int64_t p[3];
            relief_point(p, i, j);
            gen_uv(m, gen_vert(m, p[0], p[1], p[2]), (int64_t)i * one / RELIEF_COLUMNS, (int64_t)j * one / RELIEF_ROWS);
        }
    for (uint32_t j = 0; j < RELIEF_ROWS; j++)
        for (uint32_t i = 0; i < RELIEF_COLUMNS; i++) {
            static const struct gen_rgb skin = { 236, 196, 160 }, hair = { 96, 62, 40 };
            const uint32_t a = j * (RELIEF_COLUMNS + 1) + i, c = a + RELIEF_COLUMNS + 1;
            gen_quad(m, a, c, c + 1, a + 1, j < 8 || i < 4 || i >= RELIEF_COLUMNS - 4 ? hair : skin);
        }
    gen_smooth(m);
    gen_bake(m, light, 56);
    gen_write(m, GEN_NORMAL | GEN_FACE_NORMAL | GEN_FACE_RAW | GEN_UV, BENCH_RELIEF_SCALE);
}

/* 8 x 8 fields with their names, A1 at the top left: which texel is where can be read. */
#define FIELD 32

static struct gen_rgb map_at(int64_t x, int64_t y)
{
    const int64_t i = x / FIELD, j = y / FIELD;
    if (x % FIELD == 0 || y % FIELD == 0)
        return black;
    const struct gen_rgb c = gen_mix(gen_hue(i * 8192 + j * 1500), (i + j) & 1 ? white : black, 1, 3);
    return gen_mix(c, black, (x / 4 + y / 4) & 1, 8); /* a fine check in each */
}

static void map(void)
{
    struct gen_image *im = gen_image("map", 256, 256);
    gen_paint(im, map_at);
    for (int64_t j = 0; j < 8; j++) {
        for (int64_t i = 0; i < 8; i++) {
            const char name[3] = { (char)('A' + j), (char)('1' + i), '\0' };
            gen_text(im, i * FIELD + 6, j * FIELD + 10, 2, 2, name, (i + j) & 1 ? black : white);
        }
    }
    gen_texture(im, GEN_565, GEN_REPEAT);
}

/* The plane y = BENCH_PLAIN_Y around the eye out to beyond far, 16 x 16 repeats of its texture. */
static void plain(void)
{
    const int64_t half = BENCH_FAR, uv = 8 << 11;
    const int64_t corner[3] = { -half, BENCH_PLAIN_Y, -half };
    const int64_t right[3] = { 2 * half, 0, 0 }, down[3] = { 0, 0, 2 * half };
    const int64_t coordinates[2][2] = { { -uv, -uv }, { uv, uv } };
    struct gen_mesh *m = gen_begin("plain");
    m->uv_bits = 11;
    gen_panel(m, corner, right, down, coordinates);
    gen_write(m, GEN_UV, BENCH_UNIT * 65536u);
}

/* One layer at z = BENCH_LAYER_Z steps: 5 % over the frame on every side, z from -8 % at its left
 * to +8 % at its right. The eye is at the origin, so that a larger scale only moves it away. */
static void layer(void)
{
    struct gen_mesh *m = gen_begin("layer");
    for (int64_t side = -1; side <= 1; side += 2) {
        const int64_t z = BENCH_LAYER_Z * (100 + 8 * side) / 100;
        const int64_t x = side * gen_div(z * 105, 200), y = gen_div(z * 105 * 3, 800);
        gen_vert(m, x, -y, -z);
        gen_vert(m, x, y, -z);
    }
    gen_tri(m, 0, 2, 3, white);
    gen_tri(m, 0, 3, 1, white);
    gen_write(m, 0, 65536);
}

/* 100 x 100 cells over 310 x 232 px: 20,000 triangles that cover 71,920 samples. Moved about on the
 * screen, then in depth along the rays, so that no cell turns over. The mesh's z is relative. */
static void sheet(void)
{
    const uint32_t n = 100;
    const int64_t w = 310 * BENCH_STEPS_PX, h = 232 * BENCH_STEPS_PX;
    struct gen_mesh *m = gen_begin("sheet");
    for (uint32_t j = 0; j <= n; j++) {
        for (uint32_t i = 0; i <= n; i++) {
            const int64_t dx = i % n ? jitter(i, j, 1, w / 500) : 0;
            const int64_t dy = j % n ? jitter(i, j, 2, h / 500) : 0;
            const int64_t dz = jitter(i, j, 3, BENCH_SHEET_Z / 200);
            const int64_t x = gen_div((int64_t)i * w, n) - w / 2 + dx;
            const int64_t y = h / 2 - gen_div((int64_t)j * h, n) + dy;
            gen_vert(m, gen_div(x * (BENCH_SHEET_Z + dz), BENCH_SHEET_Z),
                     gen_div(y * (BENCH_SHEET_Z + dz), BENCH_SHEET_Z), -dz);
        }
    }
    two_to_a_cell(m, n, n, 4);
    gen_write(m, GEN_FACE_RAW, BENCH_SHEET_SCALE);
}

/* Five faces, seen from within; the open end is behind the eye. */
static void corridor(void)
{
    static const struct gen_rgb floor = { 130, 120, 104 }, ceiling = { 210, 214, 220 };
    static const struct gen_rgb left = { 176, 82, 74 }, right = { 72, 128, 168 };
    static const struct gen_rgb end = { 226, 196, 110 };
    const int64_t x = 1200, y = 800, z0 = 1000, z1 = -7000;
    struct gen_mesh *m = gen_begin("corridor");
    for (uint32_t i = 0; i < 8; i++)
        gen_vert(m, i & 1u ? x : -x, i & 2u ? y : -y, i & 4u ? z0 : z1);
    gen_quad(m, 4, 5, 1, 0, floor);
    gen_quad(m, 2, 3, 7, 6, ceiling);
    gen_quad(m, 4, 0, 2, 6, left);
    gen_quad(m, 1, 5, 7, 3, right);
    gen_quad(m, 0, 1, 3, 2, end);
    gen_write(m, GEN_FACE_NORMAL | GEN_FACE_RGB, BENCH_UNIT * 65536u);
}

/* 40 x 30 cells in the plane z = 0, columns and rows from 0.05 to 2.5 px: the least and the
 * greatest occur, the others are spread evenly. */
static void slivers(void)
{
    enum { COLUMNS = 40, ROWS = 30 };
    const int64_t least = BENCH_SLIVER_PX / 20, most = BENCH_SLIVER_PX * 5 / 2;
    int64_t x[COLUMNS + 1] = { 0 }, y[ROWS + 1] = { 0 };
    for (uint32_t i = 0; i < COLUMNS; i++)
        x[i + 1] = x[i] + least + (most - least) * (i * 23 % COLUMNS) / (COLUMNS - 1);
    for (uint32_t j = 0; j < ROWS; j++)
        y[j + 1] = y[j] + least + (most - least) * (j * 17 % ROWS) / (ROWS - 1);

    struct gen_mesh *m = gen_begin("slivers");
    for (uint32_t j = 0; j <= ROWS; j++)
        for (uint32_t i = 0; i <= COLUMNS; i++)
            gen_vert(m, x[i] - x[COLUMNS] / 2, y[ROWS] / 2 - y[j], 0);
    two_to_a_cell(m, COLUMNS, ROWS, 6);
    gen_write(m, GEN_FACE_RAW, BENCH_SLIVER_SCALE);
}

void gen_bench(void)
{
    bumpy();
    bumpy_uv();
    relief();
    layer();
    sheet();
    corridor();
    slivers();
    plain();
    map();
}
