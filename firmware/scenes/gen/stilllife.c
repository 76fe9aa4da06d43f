/* A still life: fruit, a bowl, a vase, a glass, a mirror on its stand, and the table that they stand on. Units are
 * tenths of a millimetre.
 *
 * SPDX-License-Identifier: MIT
 */
#include "lathe.h"

static const struct gen_rgb white = { 255, 255, 255 };

/* ---- Turned things ------------------------------------------------------------------------------------------ */

#define PEEL { 255, 255, 255 }
static const struct lathe_point orange[] = {
    { 0, 690, 1, PEEL },   { 200, 715, 2, PEEL }, { 390, 560, 2, PEEL }, { 430, 360, 2, PEEL },
    { 340, 115, 1, PEEL }, { 150, 12, 1, PEEL },  { 0, 0, 0, PEEL },
};
static const struct lathe_point apple[] = {
    { 0, 590, 1, PEEL },   { 90, 680, 2, PEEL }, { 270, 745, 2, PEEL }, { 425, 610, 2, PEEL }, { 450, 420, 2, PEEL },
    { 360, 140, 1, PEEL }, { 200, 12, 1, PEEL }, { 90, 30, 1, PEEL },   { 0, 70, 0, PEEL },
};
static const struct lathe_point pear[] = {
    { 0, 1130, 1, PEEL },  { 110, 1150, 1, PEEL }, { 205, 1010, 2, PEEL },
    { 255, 790, 2, PEEL }, { 420, 500, 2, PEEL },  { 455, 310, 2, PEEL },
    { 350, 90, 1, PEEL },  { 160, 5, 1, PEEL },    { 0, 40, 0, PEEL },
};
static const struct lathe_point lemon[] = {
    { 0, 960, 1, PEEL },   { 70, 915, 1, PEEL },  { 190, 840, 2, PEEL }, { 330, 660, 2, PEEL },
    { 345, 440, 2, PEEL }, { 250, 200, 1, PEEL }, { 90, 70, 1, PEEL },   { 0, 0, 0, PEEL },
};
static const struct lathe_point stem[] = {
    { 0, 250, 1, PEEL },
    { 34, 245, 1, PEEL },
    { 24, 120, 1, PEEL },
    { 30, -40, 1, PEEL },
};

/* Dark glaze with two pale bands. */
#define BLUE { 24, 78, 120 }
#define PALE { 232, 224, 200 }
static const struct lathe_point vase[] = {
    { 215, 2240, 1, BLUE }, { 285, 2300, 1, PALE }, { 345, 2330, 1, PALE }, { 330, 2270, 1, BLUE },
    { 205, 2040, 1, BLUE }, { 215, 1830, 1, BLUE }, { 320, 1660, 1, PALE }, { 370, 1600, 1, BLUE },
    { 415, 1545, 1, PALE }, { 455, 1490, 2, BLUE }, { 590, 1130, 2, BLUE }, { 540, 700, 2, BLUE },
    { 370, 290, 1, BLUE },  { 290, 90, 1, PALE },   { 310, 30, 1, PALE },   { 300, 0, 0, PALE },
};

/* Inside from the bottom up, round the rim, and down to the foot. */
#define CLAY { 196, 104, 66 }
#define CREAM { 240, 226, 196 }
static const struct lathe_point bowl[] = {
    { 0, 130, 1, CREAM },    { 420, 160, 2, CREAM }, { 860, 330, 2, CREAM }, { 1090, 620, 1, CREAM },
    { 1125, 655, 1, CREAM }, { 1155, 640, 1, CLAY }, { 1130, 590, 2, CLAY }, { 900, 260, 2, CLAY },
    { 520, 70, 1, CLAY },    { 500, 20, 1, CLAY },   { 490, 0, 0, CLAY },
};

/* A glass: outside alone; its front and back are drawn by one mesh each way. */
static const struct lathe_point goblet[] = {
    { 352, 1860, 1, PEEL }, { 395, 1640, 1, PEEL }, { 425, 1340, 2, PEEL }, { 370, 1060, 2, PEEL },
    { 200, 870, 1, PEEL },  { 62, 760, 1, PEEL },   { 42, 560, 1, PEEL },   { 46, 260, 1, PEEL },
    { 130, 75, 1, PEEL },   { 400, 22, 1, PEEL },   { 410, 0, 0, PEEL },
};
static const struct lathe_point wine[] = {
    { 0, 1380, 1, PEEL },   { 404, 1380, 1, PEEL }, { 405, 1340, 2, PEEL },
    { 350, 1070, 2, PEEL }, { 180, 890, 1, PEEL },  { 0, 850, 0, PEEL },
};

/* The mirror's foot and its pole. */
#define BRASS { 226, 172, 74 }
static const struct lathe_point stand[] = {
    { 0, 460, 1, BRASS },  { 95, 430, 1, BRASS }, { 60, 330, 1, BRASS }, { 130, 250, 1, BRASS }, { 70, 170, 1, BRASS },
    { 210, 95, 2, BRASS }, { 480, 55, 1, BRASS }, { 505, 20, 1, BRASS }, { 495, 0, 0, BRASS },
};

static void turn(const char *name, const struct lathe_point *point, int n_points, int64_t sides, unsigned parts)
{
    struct gen_mesh *m = gen_begin(name);
    lathe(m, point, n_points, sides);
    gen_write(m, parts, LATHE_SCALE);
}

/* The same form with less of it: what the mirror shows, and what throws a shadow. */
static void turn_low(const char *name, const struct lathe_point *point, int n_points, int64_t sides, unsigned parts)
{
    struct lathe_point low[32];
    for (int i = 0; i < n_points; i++) {
        low[i] = point[i];
        low[i].rows = point[i].rows ? 1 : 0;
    }
    turn(name, low, n_points, sides, parts);
}

/* ---- The mirror: an oval plate that faces +z, and a ring around it ------------------------------------------- */

#define OVAL_SIDES 32
#define OVAL_X 900
#define OVAL_Y 1180
#define RING_SIDES 5

static void oval(int64_t out[3], int64_t i, int64_t wider)
{
    out[0] = gen_div((OVAL_X + wider) * LATHE_STEPS * gen_cos(i * 65536 / OVAL_SIDES), GEN_Q30);
    out[1] = gen_div((OVAL_Y + wider) * LATHE_STEPS * gen_sin(i * 65536 / OVAL_SIDES), GEN_Q30);
    out[2] = 0;
}

static void plate(void)
{
    struct gen_mesh *m = gen_begin("still_plate");
    for (int64_t i = 0; i < OVAL_SIDES; i++) {
        int64_t at[3];
        oval(at, i, 0);
        gen_vert(m, at[0], at[1], at[2]);
    }
    for (uint32_t lo = 0, hi = OVAL_SIDES - 1; lo + 1 < hi; lo++, hi--) {
        gen_tri(m, lo, lo + 1, hi, white);
        if (lo + 2 < hi)
            gen_tri(m, lo + 1, hi - 1, hi, white);
    }
    gen_write(m, 0, LATHE_SCALE);
}

/* Half round to the front, and a back that is plane. */
static void frame(void)
{
    static const struct gen_rgb brass = BRASS;
    struct gen_mesh *m = gen_begin("still_frame");
    for (int64_t i = 0; i < OVAL_SIDES; i++) {
        for (int64_t k = 0; k < RING_SIDES; k++) {
            const int64_t a = k * 65536 / RING_SIDES, across = gen_cos(a), to_front = gen_sin(a);
            int64_t pos[3], normal[3];
            oval(pos, i, 40 + gen_div(75 * across, GEN_Q30));
            pos[2] = gen_div(75 * LATHE_STEPS * to_front, GEN_Q30);
            const int64_t out[2] = { OVAL_Y * gen_cos(i * 65536 / OVAL_SIDES),
                                     OVAL_X * gen_sin(i * 65536 / OVAL_SIDES) };
            normal[0] = out[0];
            normal[1] = out[1];
            normal[2] = 0;
            gen_unit(normal, (int64_t)1 << 15);
            normal[0] *= across;
            normal[1] *= across;
            normal[2] = to_front << 15;
            gen_vert_normal(m, pos, normal, brass);
        }
    }
    for (uint32_t i = 0; i < OVAL_SIDES; i++)
        for (uint32_t k = 0; k < RING_SIDES; k++) {
            const uint32_t now = i * RING_SIDES, next = (i + 1) % OVAL_SIDES * RING_SIDES, j = (k + 1) % RING_SIDES;
            gen_quad(m, now + k, next + k, next + j, now + j, brass);
        }
    gen_write(m, GEN_NORMAL | GEN_VERTEX_RGB, LATHE_SCALE);
}

/* ---- The table --------------------------------------------------------------------------------------------- */

#define TABLE 3600 /* half its width, units; it is round */
#define TABLE_SIDES 32
#define TABLE_RINGS 1
#define UV_BITS 14

static void table(void)
{
    struct gen_mesh *m = gen_begin("still_table");
    const int64_t up[3] = { 0, 1, 0 }, one = (int64_t)1 << UV_BITS;
    m->uv_bits = UV_BITS;
    for (int64_t k = 0; k <= TABLE_RINGS; k++)
        for (int64_t i = 0; i < (k ? TABLE_SIDES : 1); i++) {
            const int64_t r = gen_div(TABLE * LATHE_STEPS * k / 2, TABLE_RINGS); /* half: 2^15 steps are not enough */
            const int64_t c = gen_cos(i * 65536 / TABLE_SIDES), s = gen_sin(i * 65536 / TABLE_SIDES);
            const int64_t pos[3] = { gen_div(r * c, GEN_Q30), 0, gen_div(r * s, GEN_Q30) };
            const uint32_t v = gen_vert_normal(m, pos, up, white);
            gen_uv(m, v, one / 2 + pos[0] * one / (TABLE * LATHE_STEPS),
                   one / 2 + pos[2] * one / (TABLE * LATHE_STEPS));
        }
    for (uint32_t k = 0; k < TABLE_RINGS; k++)
        for (uint32_t i = 0; i < TABLE_SIDES; i++) {
            const uint32_t j = (i + 1) % TABLE_SIDES, out = 1 + k * TABLE_SIDES, in = out - TABLE_SIDES;
            if (k == 0)
                gen_tri(m, 0, out + j, out + i, white);
            else
                gen_quad(m, in + i, in + j, out + j, out + i, white);
        }
    gen_write(m, GEN_NORMAL | GEN_UV, LATHE_SCALE * 2);
}

static int64_t held(int64_t v, int64_t most)
{
    return v < 0 ? 0 : v > most ? most : v;
}

/* Walnut boards, light in the middle, and dark to the edge. */
static void wood(void)
{
    static const struct gen_rgb light = { 196, 132, 80 }, dark = { 116, 66, 38 }, black = { 10, 6, 8 };
    struct gen_image *im = gen_image("still_wood", 256, 256);
    for (int64_t y = 0; y < im->h; y++)
        for (int64_t x = 0; x < im->w; x++) {
            const int64_t board = y / 43, dx = 2 * x - im->w + 1, dy = 2 * y - im->h + 1;
            const int64_t from_middle = (int64_t)gen_sqrt((uint64_t)(dx * dx + dy * dy)); /* 256: the edge */
            const int64_t along = x + board * 97, at[3] = { along * 65536 / 48, y * 65536 / 6, 0 };
            const int64_t bend = gen_fractal(at, 4096, 3, 90 + (uint32_t)board);
            const int64_t ring = gen_sin(bend * 7 + y * 900) / 2 + GEN_Q30 / 2;
            struct gen_rgb c = gen_mix(
                dark, light, gen_div(ring * 60, GEN_Q30) + (int64_t)(gen_hash((uint32_t)board, 3, 8) % 40u), 110);
            const int64_t fine[3] = { along * 65536 / 20, y * 65536, 0 };
            c = gen_mix(c, dark, gen_noise(fine, 4096, 31) >> 12, 30);
            if (y % 43 == 0)
                c = gen_mix(c, black, 3, 5);
            gen_dot(im, x, y, gen_mix(c, black, held(from_middle - 90, 170), 210));
        }
    gen_texture(im, GEN_565, GEN_CLAMP);
}

void gen_stilllife(void)
{
    turn("still_orange", LATHE_OF(orange), 18, GEN_NORMAL);
    turn("still_apple", LATHE_OF(apple), 18, GEN_NORMAL);
    turn("still_pear", LATHE_OF(pear), 18, GEN_NORMAL);
    turn("still_lemon", LATHE_OF(lemon), 16, GEN_NORMAL);
    turn("still_stem", LATHE_OF(stem), 5, GEN_NORMAL);
    turn("still_vase", LATHE_OF(vase), 18, GEN_NORMAL | GEN_VERTEX_RGB);
    turn("still_bowl", LATHE_OF(bowl), 24, GEN_NORMAL | GEN_VERTEX_RGB);
    turn("still_glass", LATHE_OF(goblet), 16, GEN_NORMAL);
    turn("still_wine", LATHE_OF(wine), 18, GEN_NORMAL);
    turn("still_stand", LATHE_OF(stand), 10, GEN_NORMAL);
    turn_low("still_orange_low", LATHE_OF(orange), 12, GEN_NORMAL);
    turn_low("still_apple_low", LATHE_OF(apple), 14, GEN_NORMAL);
    turn_low("still_pear_low", LATHE_OF(pear), 12, GEN_NORMAL);
    turn_low("still_lemon_low", LATHE_OF(lemon), 10, GEN_NORMAL);
    turn_low("still_bowl_low", LATHE_OF(bowl), 14, GEN_NORMAL | GEN_VERTEX_RGB);
    turn_low("still_vase_low", LATHE_OF(vase), 10, GEN_NORMAL | GEN_VERTEX_RGB);
    turn_low("still_glass_low", LATHE_OF(goblet), 10, GEN_NORMAL);
    turn_low("still_wine_low", LATHE_OF(wine), 12, GEN_NORMAL);
    plate();
    frame();
    table();
    wood();
}
