/* A small town of flat-shaded boxes with bands of windows, parks between them, and a car.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#include "../town.h"

#define HOUSE 1700  /* half the width of a building's plot, steps */
#define FLOOR 800   /* height of a floor */

static const struct gen_rgb grass = { 96, 164, 84 }, leaf = { 40, 120, 62 };
static const struct gen_rgb street = { 74, 78, 90 }, pavement = { 168, 168, 164 };

/* The four sides of a box, between two rings of corners. Rings run x-z-, x+z-, x+z+, x-z+. */
static void sides(struct gen_mesh *m, uint32_t low, uint32_t high, struct gen_rgb rgb)
{
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t j = (i + 1) % 4;
        gen_quad(m, low + j, low + i, high + i, high + j, rgb);
    }
}

static uint32_t ring(struct gen_mesh *m, int64_t x, int64_t y, int64_t z, int64_t half_x,
                     int64_t half_z)
{
    const uint32_t first = gen_vert(m, x - half_x, y, z - half_z);
    gen_vert(m, x + half_x, y, z - half_z);
    gen_vert(m, x + half_x, y, z + half_z);
    gen_vert(m, x - half_x, y, z + half_z);
    return first;
}

static void top(struct gen_mesh *m, uint32_t r, struct gen_rgb rgb)
{
    gen_quad(m, r + 3, r + 2, r + 1, r, rgb);
}

/* A closed box but for its floor, which nobody sees. */
static uint32_t box(struct gen_mesh *m, int64_t x, int64_t z, int64_t half_x, int64_t half_z,
                    int64_t y0, int64_t y1, struct gen_rgb wall, struct gen_rgb roof)
{
    const uint32_t low = ring(m, x, y0, z, half_x, half_z);
    const uint32_t high = ring(m, x, y1, z, half_x, half_z);
    sides(m, low, high, wall);
    top(m, high, roof);
    return high;
}

/* extra: floors above what the dice give. */
static void building(struct gen_mesh *m, int64_t x, int64_t z, uint32_t dice, uint32_t extra)
{
    static const struct gen_rgb walls[6] = {
        { 236, 226, 206 }, { 214, 132, 96 }, { 240, 190, 110 },
        { 176, 196, 214 }, { 206, 94, 92 },  { 226, 214, 236 },
    };
    static const struct gen_rgb glass = { 66, 104, 150 }, lit = { 255, 226, 130 };
    const struct gen_rgb wall = walls[dice % 6u];
    const struct gen_rgb roof = gen_mix(wall, street, 2, 5);
    const int64_t half_x = HOUSE - 80 - (int64_t)(dice >> 4 & 3u) * 150;
    const int64_t half_z = HOUSE - 80 - (int64_t)(dice >> 6 & 3u) * 150;
    const uint32_t floors = 1u + (dice >> 8) % 4u + extra;

    uint32_t below = ring(m, x, TOWN_CURB, z, half_x, half_z);
    for (uint32_t i = 0; i < floors; i++) {
        const int64_t y = TOWN_CURB + FLOOR * (int64_t)i;
        const uint32_t sill = ring(m, x, y + 330, z, half_x, half_z);
        const uint32_t lintel = ring(m, x, y + 690, z, half_x, half_z);
        sides(m, below, sill, wall);
        sides(m, sill, lintel, (dice >> (14u + i)) % 3u == 0 ? lit : glass);
        below = lintel;
    }
    const int64_t y = TOWN_CURB + FLOOR * (int64_t)floors + 120;
    const uint32_t eaves = ring(m, x, y, z, half_x, half_z);
    sides(m, below, eaves, wall);
    if (floors < 3) { /* a hip roof */
        const struct gen_rgb tiles = { 190, 74, 58 };
        const uint32_t tip = gen_vert(m, x, y + 1100, z);
        for (uint32_t i = 0; i < 4; i++)
            gen_tri(m, eaves + (i + 1) % 4, eaves + i, tip, tiles);
    } else {
        top(m, eaves, roof);
        box(m, x + half_x / 3, z - half_z / 4, half_x / 3, half_z / 3, y, y + 420, pavement, wall);
    }
}

static void park(struct gen_mesh *m, int64_t x, int64_t z, uint32_t dice)
{
    for (uint32_t k = 0; k < 5; k++) {
        const int64_t out = k < 4 ? 800 : 0; /* four at the corners, one in the middle */
        const int64_t at_x = x + (k & 1u ? out : -out) + (int64_t)(dice >> k & 255u) - 128;
        const int64_t at_z = z + (k & 2u ? out : -out) + (int64_t)(dice >> (8 + k) & 255u) - 128;
        const int64_t wide = 330 + (int64_t)(dice >> (2 * k) & 3u) * 50;
        const uint32_t foot = ring(m, at_x, TOWN_CURB + 60, at_z, wide, wide);
        const uint32_t tip = gen_vert(m, at_x, TOWN_CURB + 4 * wide, at_z);
        for (uint32_t i = 0; i < 4; i++)
            gen_tri(m, foot + (i + 1) % 4, foot + i, tip, leaf);
    }
}

static void town(void)
{
    struct gen_mesh *m = gen_begin("city");
    const int64_t half = TOWN_BLOCKS * TOWN_PITCH / 2;
    box(m, 0, 0, half, half, -900, 0, pavement, street);
    for (int64_t j = 0; j < TOWN_BLOCKS; j++) {
        for (int64_t i = 0; i < TOWN_BLOCKS; i++) {
            const int64_t x = (2 * i + 1) * TOWN_PITCH / 2 - half;
            const int64_t z = (2 * j + 1) * TOWN_PITCH / 2 - half;
            const uint32_t dice = gen_hash((uint32_t)i, (uint32_t)j, 2026);
            /* high in the middle, low around it */
            const int64_t out = (x < 0 ? -x : x) + (z < 0 ? -z : z);
            const uint32_t extra = out <= TOWN_PITCH ? 5 : out <= 2 * TOWN_PITCH ? 2 : 0;
            const int green = !extra && dice % 3u == 0;
            box(m, x, z, HOUSE + 180, HOUSE + 180, 0, TOWN_CURB, pavement,
                green ? grass : pavement);
            if (green)
                park(m, x, z, dice);
            else
                building(m, x, z, dice, extra);
        }
    }
    gen_write(m, GEN_FACE_NORMAL | GEN_FACE_RGB, 65536);
}

static void car(void)
{
    static const struct gen_rgb white = { 255, 255, 255 }, glass = { 60, 80, 110 };
    struct gen_mesh *m = gen_begin("car");
    box(m, 0, 0, 200, 430, 90, 330, white, white);
    box(m, 0, 60, 170, 230, 330, 540, glass, white);
    gen_write(m, GEN_FACE_NORMAL, 65536);
}

void gen_city(void)
{
    town();
    car();
}
