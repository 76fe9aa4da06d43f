/* A forest: the ground with a path, trunks, and cards of firs and ferns.
 *
 * SPDX-License-Identifier: MIT
 */
#include "lathe.h"

#include "../wood.h"

static const struct gen_rgb white = { 255, 255, 255 }, black = { 0, 0, 0 };

static int64_t held(int64_t v, int64_t most)
{
    return v < 0 ? 0 : v > most ? most : v;
}

/* ---- The ground ------------------------------------------------------------------------------------------------- */

#define ROWS 24
#define UV_BITS 12
#define WIDE 7000 /* half of the texture's width; it repeats, and another path would begin beyond the ground */
#define SIDE (((WIDE + WOOD_HALF) << UV_BITS) / (2 * WIDE))

static void ground(void)
{
    struct gen_mesh *m = gen_begin("forest_ground");
    m->uv_bits = UV_BITS;
    for (int64_t j = 0; j <= ROWS; j++) {
        const int64_t z = j * WOOD_PERIOD / ROWS - WOOD_PERIOD / 2;
        const int64_t middle = gen_div(WOOD_BEND * gen_sin(j * 65536 / ROWS), GEN_Q30);
        for (int64_t i = 0; i < 2; i++) {
            const uint32_t v = gen_vert(m, middle + (i ? WOOD_HALF : -WOOD_HALF), 0, z);
            gen_uv(m, v, i ? SIDE : (1 << UV_BITS) - SIDE, (j % 4 + (j && j % 4 == 0 ? 4 : 0)) * ((1 << UV_BITS) / 4));
        }
        if (j && j % 4 == 0 && j < ROWS) /* the texture begins anew: int16 holds eight of its lengths */
            for (int64_t i = 0; i < 2; i++) {
                const uint32_t v = gen_vert(m, middle + (i ? WOOD_HALF : -WOOD_HALF), 0, z);
                gen_uv(m, v, i ? SIDE : (1 << UV_BITS) - SIDE, 0);
            }
    }
    for (uint32_t v = 0; v + 3 < m->n_verts; v += 2)
        if (m->pos[v][2] != m->pos[v + 2][2])
            gen_quad(m, v, v + 2, v + 3, v + 1, white);
    gen_write(m, GEN_UV, 65536);
}

/* Moss and needles, and in the middle a path of earth with two ruts; 256 across are 14 m, 128 down 4 m. */
static void floor_texture(void)
{
    static const struct gen_rgb moss = { 92, 112, 52 }, needles = { 96, 74, 46 }, dark = { 40, 48, 26 };
    static const struct gen_rgb earth = { 164, 132, 94 }, rut = { 122, 94, 64 }, leaf = { 196, 138, 52 };
    struct gen_image *im = gen_image("forest_floor", 256, 128);
    im->n_levels = 7;
    for (int64_t y = 0; y < im->h; y++)
        for (int64_t x = 0; x < im->w; x++) {
            const int64_t at[3] = { x * 65536 / 8, y * 65536 / 16, 0 },
                          fine[3] = { x * 65536 / 2, y * 65536 / 4, 7 << 16 };
            const int64_t n = gen_fractal(at, 8, 3, 5), f = gen_noise(fine, 32, 9);
            struct gen_rgb c = gen_mix(moss, needles, held((n - 24000) / 900, 20), 20);
            c = gen_mix(c, dark, held((f - 30000) / 3000, 9), 14);
            const int64_t off = (x < 128 ? 127 - x : x - 128) * 1000 + (n - 32768) / 8 +
                                (f - 32768) / 14; /* 1/1000 texel */
            const struct gen_rgb way = gen_mix(gen_mix(earth, rut, off > 6500 && off < 14500 ? 2 : 0, 3), dark,
                                               f >> 13, 26);
            c = gen_mix(way, c, held((off - 17500) / 500, 12), 12);
            if (gen_hash((uint32_t)x, (uint32_t)y, 44) % 97u == 0)
                c = gen_mix(c, leaf, off > 16000 ? 3 : 1, 4);
            gen_dot(im, x, y, c);
        }
    gen_texture(im, GEN_565, GEN_REPEAT);
}

/* ---- Trunks ----------------------------------------------------------------------------------------------------- */

#define BARK(level)                                                                                                   \
    {                                                                                                                 \
        74 + level, 58 + level * 3 / 4, 44 + level / 2                                                                \
    }
static const struct lathe_point trunk[] = {
    /* units of 2 mm */
    { 55, 7000, 1, BARK(36) }, { 78, 4200, 1, BARK(26) }, { 90, 2200, 1, BARK(30) },
    { 98, 900, 1, BARK(12) },  { 112, 200, 1, BARK(4) },  { 175, 0, 0, BARK(0) },
};

static void trunks(void)
{
    struct gen_mesh *m = gen_begin("forest_trunk");
    lathe(m, LATHE_OF(trunk), 9);
    gen_write(m, GEN_NORMAL | GEN_VERTEX_RGB, LATHE_SCALE * 2);
}

/* ---- Firs ------------------------------------------------------------------------------------------------------- */

#define TIERS 15

/* A pixel of a fir: tiers of boughs that hang to their ends, the upper ones in front of the lower. */
static int fir_at(struct gen_image *im, int64_t x, int64_t y)
{
    static const struct gen_rgb deep = { 18, 40, 30 }, tip = { 98, 138, 74 }, trunk_rgb = { 62, 46, 34 };
    const int64_t dx = x < 64 ? 127 - 2 * x : 2 * x - 127; /* 1/2 texel from the middle */
    const int64_t side = x < 64 ? 1 : 0;
    for (int64_t k = 0; k < TIERS; k++) {
        const int64_t dice = gen_hash((uint32_t)k, (uint32_t)side, 12) % 16u;
        const int64_t half = 10 + k * 112 / TIERS + dice,
                      top = 2 + k * 13 + (int64_t)(gen_hash((uint32_t)k, 5, 3) % 5u);
        if (dx > half)
            continue;
        const int64_t at[3] = { x * 65536 / 3, y * 65536 / 5, k << 16 };
        const int64_t rough = gen_noise(at, 4096, 21) >> 12; /* 0 .. 15 */
        const int64_t hang = top + dx * 20 / 64;             /* the bough's upper edge */
        const int64_t thick = 9 + (half - dx) * 17 / 60 + rough - 8;
        if (y < hang + rough / 5 || y >= hang + thick)
            continue;
        const int64_t light = 15 - (y - hang) * 14 / (thick + 1) + rough / 3 - 3 + (x > 64 ? 2 : -1);
        gen_dot(im, x, y, gen_mix(deep, tip, held(light, 15), 15));
        return 1;
    }
    if (dx < 9 && y > 30) {
        gen_dot(im, x, y, gen_mix(trunk_rgb, black, dx > 4 ? 1 : 0, 3));
        return 1;
    }
    gen_dot(im, x, y, gen_mix(deep, tip, 4, 15));
    return 0;
}

static void card(const char *name, int64_t half, int64_t high)
{
    const int64_t corner[3] = { -half, high, 0 }, right[3] = { 2 * half, 0, 0 }, down[3] = { 0, -high, 0 };
    const int64_t uv[2][2] = { { 0, 0 }, { 1 << UV_BITS, 1 << UV_BITS } };
    struct gen_mesh *m = gen_begin(name);
    m->uv_bits = UV_BITS;
    gen_panel(m, corner, right, down, uv);
    gen_write(m, GEN_UV, 65536);
}

/* As the fir is: narrow above, so that less of nothing is drawn. */
static void fir_card(void)
{
    struct gen_mesh *m = gen_begin("forest_fir");
    static const int16_t corner[6][2] = { { 46, 0 }, { 82, 0 }, { 128, 200 }, { 128, 256 }, { 0, 256 }, { 0, 200 } };
    m->uv_bits = UV_BITS;
    for (int i = 0; i < 6; i++) {
        const int64_t across = (corner[i][0] - 64) * 1500 / 64, up = (256 - corner[i][1]) * 6200 / 256;
        gen_uv(m, gen_vert(m, across, up, 0), corner[i][0] * 32, corner[i][1] * 16);
    }
    gen_tri(m, 0, 2, 1, white);
    gen_tri(m, 0, 5, 2, white);
    gen_tri(m, 5, 3, 2, white);
    gen_tri(m, 5, 4, 3, white);
    gen_write(m, GEN_UV, 65536);
}

static void fir(void)
{
    struct gen_image *im = gen_image("forest_fir", 128, 256);
    for (int64_t y = 0; y < im->h; y++)
        for (int64_t x = 0; x < im->w; x++)
            im->alpha[y][x] = fir_at(im, x, y) ? 255 : 0;
    gen_texture(im, GEN_PAL8A, GEN_CLAMP);
    fir_card();
}

/* ---- Ferns: fronds that bend out from the root, with leaves along them ------------------------------------------ */

static void leaf_dot(struct gen_image *im, int64_t x, int64_t y, struct gen_rgb rgb)
{
    if (x < 0 || y < 0 || x >= im->w || y >= im->h)
        return;
    gen_dot(im, x, y, rgb);
    im->alpha[y][x] = 255;
}

static void fern(void)
{
    static const struct gen_rgb deep = { 34, 70, 30 }, tip = { 136, 176, 72 };
    struct gen_image *im = gen_image("forest_fern", 64, 32);
    gen_box(im, 0, 0, im->w, im->h, gen_mix(deep, tip, 1, 2));
    for (int64_t k = 0; k < 9; k++) {
        const int64_t to = (k * 5 % 9 - 4) * 8 + (int64_t)(gen_hash((uint32_t)k, 1, 6) % 3u),
                      high = 29 - (to * to) / 90;
        for (int64_t t = 0; t <= 128; t++) { /* along the frond: out, and up and over */
            const int64_t x = 32 * 64 + to * t / 2, rise = high * t * (280 - t) / 300; /* 1/64 texel */
            const int64_t y = 31 * 64 - rise + (t > 90 ? (t - 90) * 10 : 0), leaf = (t > 16 ? (140 - t) / 26 : 0);
            for (int64_t s = -leaf; s <= leaf; s++)
                if (t % 6 < 4 || s == 0)
                    leaf_dot(im, x / 64 + (to > 0 ? 1 : -1) * (s < 0 ? -s : s) / 2, y / 64 + s,
                             gen_mix(deep, tip,
                                     held(t / 14 + (s < 0 ? 3 : -2) + (int64_t)(gen_hash((uint32_t)k, 3, 3) % 3u), 11),
                                     11));
        }
    }
    gen_texture(im, GEN_PAL8A, GEN_CLAMP);
    card("forest_fern", 900, 850);
}

void gen_forest(void)
{
    ground();
    floor_texture();
    trunks();
    fir();
    fern();
}
