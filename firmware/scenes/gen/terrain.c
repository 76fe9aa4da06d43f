/* A square of land that repeats itself seamlessly in x and z, with a river along z. The scene lays
 * copies side by side: the period and the river's course are in ../land.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#include "../land.h"

#define CELLS 26
#define WATER 260 /* steps above 0, the river's level; land below it is drawn flat */

/* Smooth noise of a lattice with `cells` cells to the period, 0 .. 65535; x, z in 0 .. PERIOD. */
static int64_t noise(int64_t x, int64_t z, int64_t cells, uint32_t seed)
{
    const int64_t size = LAND_PERIOD / cells;
    int64_t corner[2][2], t[2];
    const int64_t at[2] = { x, z };
    for (int i = 0; i < 2; i++) {
        const int64_t f = gen_div(at[i] % size * 1024, size); /* 3 t^2 - 2 t^3 in q10 */
        t[i] = gen_div(f * f * (3 * 1024 - 2 * f), 1024 * 1024);
    }
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++)
            corner[j][i] = gen_hash((uint32_t)((x / size + i) % cells),
                                    (uint32_t)((z / size + j) % cells), seed) & 65535;
    const int64_t near = corner[0][0] * (1024 - t[0]) + corner[0][1] * t[0];
    const int64_t far = corner[1][0] * (1024 - t[0]) + corner[1][1] * t[0];
    return gen_div(near * (1024 - t[1]) + far * t[1], 1024 * 1024);
}

static int64_t height(int64_t x, int64_t z)
{
    const int64_t sum = 5 * noise(x, z, 4, 11) + 3 * noise(x, z, 8, 23) + noise(x, z, 16, 37);
    int64_t h = gen_div(sum * sum, (int64_t)9 * 65536 * 9) * 9800 / 65536;

    /* A valley around the river: 0 in the bed, all of it from 5/16 of the period on. */
    const int64_t course = gen_div(LAND_RIVER * gen_sin(gen_div(z * 65536, LAND_PERIOD)), GEN_Q30);
    int64_t off = x - LAND_PERIOD / 2 - course;
    off = off < 0 ? -off : off;
    const int64_t from = LAND_PERIOD / 26, to = LAND_PERIOD * 5 / 16;
    const int64_t t = off <= from ? 0 : off >= to ? 1024 : (off - from) * 1024 / (to - from);
    h = gen_div(h * t * t * (3 * 1024 - 2 * t), (int64_t)1024 * 1024 * 1024) + (t ? 100 : 0);
    return h < WATER ? WATER : h;
}

static struct gen_rgb ground(int64_t h, int64_t slope, uint32_t dice)
{
    static const struct gen_rgb water = { 38, 110, 190 }, sand = { 222, 196, 128 };
    static const struct gen_rgb meadow = { 116, 176, 66 }, forest = { 52, 122, 56 };
    static const struct gen_rgb rock = { 132, 116, 102 }, snow = { 245, 248, 255 };
    struct gen_rgb c;
    if (h <= WATER && slope == 0)
        c = water;
    else if (h < WATER + 190)
        c = sand;
    else if (h < 1500)
        c = gen_mix(meadow, forest, h, 1500);
    else if (h < 3300)
        c = gen_mix(forest, rock, h - 1500, 1800);
    else
        c = h < 3900 ? rock : snow;
    const struct gen_rgb black = { 0, 0, 0 };
    return gen_mix(c, black, (int64_t)(dice & 15u), 160); /* a little unevenness */
}

static void land(const char *name, int64_t cells, unsigned parts)
{
    struct gen_mesh *m = gen_begin(name);
    const int64_t half = LAND_PERIOD / 2, cell = LAND_PERIOD / cells;
    for (int64_t j = 0; j <= cells; j++) {
        for (int64_t i = 0; i <= cells; i++) {
            int64_t x = i % cells * cell, z = j % cells * cell;
            const int64_t h = height(x, z);
            /* inner vertices leave the grid a little; the border stays where its copy is */
            const uint32_t dice = gen_hash((uint32_t)i, (uint32_t)j, 5);
            const int inside = i > 0 && i < cells && j > 0 && j < cells;
            const int64_t dx = inside ? (int64_t)(dice & 255u) - 128 : 0;
            const int64_t dz = inside ? (int64_t)(dice >> 8 & 255u) - 128 : 0;
            x = i * cell - half + gen_div(dx * cell, 640);
            z = j * cell - half + gen_div(dz * cell, 640);
            gen_vert(m, x, h, z);
        }
    }
    for (uint32_t j = 0; j < (uint32_t)cells; j++) {
        for (uint32_t i = 0; i < (uint32_t)cells; i++) {
            const uint32_t a = j * ((uint32_t)cells + 1) + i, b = a + 1, c = a + (uint32_t)cells + 1, d = c + 1;
            const uint32_t tris[2][2][3] = { { { a, c, d }, { a, d, b } },
                                             { { a, c, b }, { b, c, d } } };
            for (uint32_t k = 0; k < 2; k++) {
                const uint32_t *v = tris[(i + j) & 1u][k];
                int64_t sum = 0, least = INT16_MAX, most = 0;
                for (int n = 0; n < 3; n++) {
                    const int64_t y = m->pos[v[n]][1];
                    sum += y;
                    least = y < least ? y : least;
                    most = y > most ? y : most;
                }
                gen_tri(m, v[0], v[1], v[2],
                        ground(sum / 3, most - least, gen_hash(i + 100 * k, j, 9)));
            }
        }
    }
    gen_write(m, GEN_FACE_NORMAL | GEN_FACE_RGB | parts, 65536);
}

void gen_terrain(void)
{
    land("terrain", CELLS, GEN_CLUSTERS);
    land("terrain_low", CELLS / 2, 0);
}
