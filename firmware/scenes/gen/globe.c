/* A planet, its moon and the sky behind them: one ball, one box, three textures. What is on a ball
 * is noise in space, taken where the texel lies, so that it has no seam and no pole.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#define UV_BITS 14
#define RINGS 18
#define COLUMNS 36
#define RADIUS 28000
#define SKY 30000 /* half an edge */

/* ---- Meshes ---------------------------------------------------------------------------------- */

/* Unit vector, q30: u once around in 65536, from the front (+z) to the right; v from the upper pole
 * to the lower in 32768. */
static void direction(int64_t out[3], int64_t u, int64_t v)
{
    const int64_t s = gen_sin(v);
    out[0] = gen_div(s * gen_sin(u), GEN_Q30);
    out[1] = gen_cos(v);
    out[2] = gen_div(s * gen_cos(u), GEN_Q30);
}

static void globe(void)
{
    static const struct gen_rgb white = { 255, 255, 255 };
    const int64_t one = (int64_t)1 << UV_BITS;
    struct gen_mesh *m = gen_begin("globe");
    m->uv_bits = UV_BITS;
    for (int64_t j = 0; j <= RINGS; j++) {
        const int64_t at_pole = j == 0 || j == RINGS; /* a vertex a triangle, in its middle */
        for (int64_t i = 0; i <= COLUMNS - at_pole; i++) {
            int64_t normal[3], pos[3];
            direction(normal, i % COLUMNS * 65536 / COLUMNS, j * 32768 / RINGS);
            for (int k = 0; k < 3; k++)
                pos[k] = gen_div(normal[k] * RADIUS, GEN_Q30);
            const uint32_t v = gen_vert_normal(m, pos, normal, white);
            gen_uv(m, v, gen_div((2 * i + at_pole) * one, 2 * COLUMNS), gen_div(j * one, RINGS));
        }
    }
    for (uint32_t j = 0; j < RINGS; j++) {
        const uint32_t up = j ? COLUMNS + (j - 1) * (COLUMNS + 1) : 0;
        const uint32_t low = COLUMNS + j * (COLUMNS + 1);
        for (uint32_t i = 0; i < COLUMNS; i++) {
            if (j < RINGS - 1)
                gen_tri(m, up + i, low + i, low + i + 1, white);
            if (j > 0)
                gen_tri(m, up + i, j < RINGS - 1 ? low + i + 1 : low + i, up + i + 1, white);
        }
    }
    gen_write(m, GEN_NORMAL | GEN_UV, 65536);
}

/* Six sides seen from within, two repeats of the texture to each. */
static void sky(void)
{
    static const int8_t sides[6][2][3] = { /* right and down, as seen from the middle */
        { { 1, 0, 0 }, { 0, -1, 0 } },  { { 0, 0, 1 }, { 0, -1, 0 } },
        { { -1, 0, 0 }, { 0, -1, 0 } }, { { 0, 0, -1 }, { 0, -1, 0 } },
        { { 1, 0, 0 }, { 0, 0, 1 } },   { { 1, 0, 0 }, { 0, 0, -1 } },
    };
    struct gen_mesh *m = gen_begin("sky");
    m->uv_bits = UV_BITS - 1;
    for (int i = 0; i < 6; i++) {
        int64_t right[3], down[3], corner[3];
        gen_box_side(corner, right, down, (const int8_t(*)[3])sides[i], SKY, 0);
        const int64_t uv[2][2] = { { 0, 0 }, { 2 << (UV_BITS - 1), 2 << (UV_BITS - 1) } };
        gen_panel(m, corner, right, down, uv);
    }
    gen_write(m, GEN_UV, 65536);
}

/* ---- Textures -------------------------------------------------------------------------------- */

/* Where the middle of a texel lies on the ball. */
static void texel_direction(int64_t out[3], const struct gen_image *im, int64_t x, int64_t y)
{
    direction(out, (2 * x + 1) * 32768 / im->w, (2 * y + 1) * 16384 / im->h);
}

/* Fractal noise at a unit vector, `cells` / 8 cells to the radius. */
static int64_t noise_at(const int64_t dir[3], int64_t cells, int octaves, uint32_t seed)
{
    int64_t at[3];
    for (int k = 0; k < 3; k++)
        at[k] = (dir[k] + GEN_Q30) * cells >> 17;
    return gen_fractal(at, 4096, octaves, seed);
}

/* v cut to 0 .. most. */
static int64_t held(int64_t v, int64_t most)
{
    return v < 0 ? 0 : v > most ? most : v;
}

static struct gen_rgb land(int64_t height, int64_t latitude, int64_t dry)
{
    static const struct gen_rgb meadow = { 70, 138, 52 }, desert = { 214, 182, 112 };
    static const struct gen_rgb rock = { 118, 96, 78 }, tundra = { 150, 150, 118 };
    struct gen_rgb c = gen_mix(meadow, desert, held(dry, 5), 5);
    if (latitude > 9500)
        c = gen_mix(c, tundra, 3, 4);
    return gen_mix(c, rock, held((height - 3000) / 1400, 5), 6);
}

/* Of latitude 0 .. 16384, height and dryness from the noise. */
static struct gen_rgb earth_at(const int64_t dir[3], int64_t latitude)
{
    static const struct gen_rgb deep = { 10, 34, 92 }, shallow = { 44, 132, 190 };
    static const struct gen_rgb ice = { 236, 244, 250 }, snow = { 222, 226, 232 };
    const int64_t height = noise_at(dir, 19, 6, 41) - 33600;
    const int64_t rough = noise_at(dir, 40, 2, 77) - 32768;
    const int64_t hot = latitude < 4600 ? 4600 - latitude : latitude - 4600; /* from the tropics */
    if (latitude > 12600 + rough / 8)
        return ice;
    if (height <= 0)
        return gen_mix(shallow, deep, held(-height / 500, 11), 11);
    if (height > 11500 + rough / 8)
        return snow;
    return land(height, latitude + rough / 16, 5 - (hot - rough / 6) / 700);
}

static void earth(void)
{
    static const struct gen_rgb white = { 255, 255, 255 };
    struct gen_image *im = gen_image("earth", 256, 256);
    for (int64_t y = 0; y < im->h; y++) {
        const int64_t from_top = (2 * y + 1) * 16384 / im->h;
        const int64_t latitude = from_top < 16384 ? 16384 - from_top : from_top - 16384;
        for (int64_t x = 0; x < im->w; x++) {
            int64_t dir[3];
            texel_direction(dir, im, x, y);
            const int64_t cloud = (noise_at(dir, 22, 5, 300) - 38000) / 2200;
            gen_dot(im, x, y, gen_mix(earth_at(dir, latitude), white, held(cloud, 2), 3));
        }
    }
    gen_texture(im, GEN_PAL8, GEN_REPEAT);
}

#define CRATERS 40u

/* What craters add to a level of grey: floors are dark, rims bright. */
static int64_t craters_at(const int64_t dir[3])
{
    int64_t sum = 0;
    for (uint32_t i = 0; i < CRATERS; i++) {
        const uint32_t dice = gen_hash(i, 17, 99);
        int64_t middle[3];
        direction(middle, dice & 65535, 4000 + (int64_t)((dice >> 16) * 24768u >> 16));
        int64_t apart = 0, size = 6 + (int64_t)(gen_hash(i, 3, 5) % 22u);
        for (int k = 0; k < 3; k++)
            apart += gen_div((dir[k] - middle[k]) * (dir[k] - middle[k]), GEN_Q30);
        apart = (int64_t)gen_sqrt((uint64_t)apart * 16); /* of the chord, 2^-17 */
        const int64_t part = apart * 100 / (size * 1200);
        sum += part < 75 ? -2 : part < 100 ? 3 : 0;
    }
    return sum;
}

static void moon(void)
{
    static const struct gen_rgb dark = { 74, 72, 76 }, bright = { 226, 222, 212 };
    struct gen_image *im = gen_image("moon", 128, 64);
    for (int64_t y = 0; y < im->h; y++) {
        for (int64_t x = 0; x < im->w; x++) {
            int64_t dir[3];
            texel_direction(dir, im, x, y);
            const int64_t level = (noise_at(dir, 24, 4, 7) - 20000) / 1800 + craters_at(dir);
            gen_dot(im, x, y, gen_mix(dark, bright, held(level, 15), 15));
        }
    }
    gen_texture(im, GEN_PAL4, GEN_REPEAT);
}

static void stars(void)
{
    static const struct gen_rgb night = { 4, 5, 16 }, white = { 255, 255, 255 };
    static const struct gen_rgb tints[3] = {
        { 255, 220, 180 }, { 190, 210, 255 }, { 255, 255, 240 },
    };
    struct gen_image *im = gen_image("stars", 128, 128);
    gen_box(im, 0, 0, im->w, im->h, night);
    for (uint32_t i = 0; i < 120; i++) {
        const uint32_t dice = gen_hash(i, 1, 2026);
        const int64_t x = dice & 127, y = dice >> 8 & 127, level = 1 + (dice >> 16 & 3);
        gen_dot(im, x, y, gen_mix(night, tints[i % 3u], level, 4));
        if (i % 30u)
            continue;
        gen_box(im, x - 1, y, 3, 1, gen_mix(night, tints[2], 2, 4));
        gen_box(im, x, y - 1, 1, 3, gen_mix(night, tints[2], 2, 4));
        gen_dot(im, x, y, white);
    }
    gen_texture(im, GEN_PAL4, GEN_REPEAT);
}

void gen_globe(void)
{
    globe();
    sky();
    earth();
    moon();
    stars();
}
