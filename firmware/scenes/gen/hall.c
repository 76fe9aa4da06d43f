/* A hall: floor, ceiling and walls, columns, and what hangs on the walls, each of as many periods
 * as can be seen; and a crate.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#include "../hall.h"

#define UV_BITS 12
#define UV ((int64_t)1 << UV_BITS)
#define TILES 800   /* steps to a repeat */
#define BRICKS 1000
#define PLANKS 800
#define SIDES 10    /* of a column */
#define COLUMN_X 1290

static struct gen_mesh *begin(const char *name)
{
    struct gen_mesh *m = gen_begin(name);
    m->uv_bits = UV_BITS;
    return m;
}

/* A panel along the axes, `repeat` steps to a repeat of its texture. */
static void covered(struct gen_mesh *m, const int64_t corner[3], const int64_t right[3],
                    const int64_t down[3], int64_t repeat)
{
    int64_t wide = 0, high = 0;
    for (int k = 0; k < 3; k++) {
        wide += right[k] < 0 ? -right[k] : right[k];
        high += down[k] < 0 ? -down[k] : down[k];
    }
    const int64_t uv[2][2] = { { 0, 0 }, { wide * UV / repeat, high * UV / repeat } };
    gen_panel(m, corner, right, down, uv);
}

static void floor_and_ceiling(void)
{
    const int64_t across[3] = { 2 * HALL_HALF, 0, 0 };
    const int64_t back[3] = { 0, 0, HALL_PERIOD }, ahead[3] = { 0, 0, -HALL_PERIOD };
    struct gen_mesh *m = begin("hall_floor");
    for (int64_t k = HALL_BEHIND; k > -HALL_AHEAD; k--) {
        const int64_t corner[3] = { -HALL_HALF, 0, (k - 1) * HALL_PERIOD };
        covered(m, corner, across, back, TILES);
    }
    gen_write(m, GEN_FACE_NORMAL | GEN_UV, 65536);

    m = begin("hall_ceiling");
    for (int64_t k = HALL_BEHIND; k > -HALL_AHEAD; k--) {
        const int64_t corner[3] = { -HALL_HALF, HALL_HEIGHT, k * HALL_PERIOD };
        covered(m, corner, across, ahead, PLANKS);
    }
    gen_write(m, GEN_FACE_NORMAL | GEN_UV, 65536);
}

static void walls(void)
{
    const int64_t down[3] = { 0, -HALL_HEIGHT, 0 };
    const int64_t back[3] = { 0, 0, HALL_PERIOD }, ahead[3] = { 0, 0, -HALL_PERIOD };
    struct gen_mesh *m = begin("hall_walls");
    for (int64_t k = HALL_BEHIND; k > -HALL_AHEAD; k--) {
        const int64_t left[3] = { -HALL_HALF, HALL_HEIGHT, k * HALL_PERIOD };
        const int64_t right[3] = { HALL_HALF, HALL_HEIGHT, (k - 1) * HALL_PERIOD };
        covered(m, left, ahead, down, BRICKS);
        covered(m, right, back, down, BRICKS);
    }
    gen_write(m, GEN_FACE_NORMAL | GEN_UV, 65536);
}

/* A turned column around (x, z), its texture once around and three times upwards. */
static void column(struct gen_mesh *m, int64_t x, int64_t z)
{
    static const struct gen_rgb white = { 255, 255, 255 };
    static const struct {
        int64_t y, radius; /* from the top */
    } profile[] = {
        { HALL_HEIGHT, 270 }, { HALL_HEIGHT - 220, 250 }, { HALL_HEIGHT - 330, 180 },
        { 330, 200 },         { 200, 270 },               { 0, 280 },
    };
    const uint32_t n = sizeof profile / sizeof profile[0], row = SIDES + 1, first = m->n_verts;
    for (uint32_t j = 0; j < n; j++) {
        for (uint32_t i = 0; i < row; i++) {
            const int64_t a = (int64_t)(i % SIDES) * 65536 / SIDES, r = profile[j].radius;
            const uint32_t v = gen_vert(m, x + gen_div(r * gen_sin(a), GEN_Q30), profile[j].y,
                                        z + gen_div(r * gen_cos(a), GEN_Q30));
            gen_uv(m, v, (int64_t)i * UV / SIDES, (HALL_HEIGHT - profile[j].y) * UV / 1000);
        }
    }
    for (uint32_t j = 0; j + 1 < n; j++) {
        for (uint32_t i = 0; i < SIDES; i++) {
            const uint32_t up = first + j * row + i, low = up + row;
            gen_quad(m, up, low, low + 1, up + 1, white);
        }
    }
}

static void columns(void)
{
    struct gen_mesh *m = begin("hall_columns");
    for (int64_t k = HALL_BEHIND; k > -HALL_AHEAD; k--) {
        column(m, -COLUMN_X, (k - 1) * HALL_PERIOD);
        column(m, COLUMN_X, (k - 1) * HALL_PERIOD);
    }
    gen_smooth(m);
    gen_write(m, GEN_NORMAL | GEN_UV, 65536);
}

/* In the planes of the walls, in the middle of each period. Both reach beyond their textures. */
static void pictures(void)
{
    const int64_t poster_uv[2][2] = { { -UV / 24, -UV / 24 }, { UV + UV / 24, UV + UV / 24 } };
    const int64_t sign_uv[2][2] = { { -UV / 32, -UV / 16 }, { UV + UV / 32, UV + UV / 16 } };
    const int64_t poster_right[3] = { 0, 0, -1300 }, poster_down[3] = { 0, -1300, 0 };
    const int64_t sign_right[3] = { 0, 0, 1000 }, sign_down[3] = { 0, -500, 0 };
    struct gen_mesh *m = begin("poster");
    for (int64_t k = HALL_BEHIND; k > -HALL_AHEAD; k--) {
        const int64_t corner[3] = { -HALL_HALF, 2350, k * HALL_PERIOD - 1350 };
        gen_panel(m, corner, poster_right, poster_down, poster_uv);
    }
    gen_write(m, GEN_UV, 65536);
    m = begin("sign");
    for (int64_t k = HALL_BEHIND; k > -HALL_AHEAD; k--) {
        const int64_t corner[3] = { HALL_HALF, 2300, k * HALL_PERIOD - 2500 };
        gen_panel(m, corner, sign_right, sign_down, sign_uv);
    }
    gen_write(m, GEN_UV, 65536);
}

/* Six sides, the texture upright on four of them. */
static void crate(void)
{
    static const int8_t sides[6][2][3] = { /* right and down, as seen from outside */
        { { 1, 0, 0 }, { 0, -1, 0 } },  { { 0, 0, -1 }, { 0, -1, 0 } },
        { { -1, 0, 0 }, { 0, -1, 0 } }, { { 0, 0, 1 }, { 0, -1, 0 } },
        { { 1, 0, 0 }, { 0, 0, 1 } },   { { 1, 0, 0 }, { 0, 0, -1 } },
    };
    struct gen_mesh *m = begin("crate");
    for (int i = 0; i < 6; i++) {
        int64_t right[3], down[3], corner[3];
        gen_box_side(corner, right, down, (const int8_t(*)[3])sides[i], HALL_CRATE, 1);
        covered(m, corner, right, down, 2 * HALL_CRATE);
    }
    gen_write(m, GEN_FACE_NORMAL | GEN_UV, 65536);
}

void gen_hall(void)
{
    floor_and_ceiling();
    walls();
    columns();
    pictures();
    crate();
}
