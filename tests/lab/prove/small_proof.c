/* solid.c, small.h: set-up, then rows. That columns lie where the set-up has looked is a fact (facts_drawn.c).
 *
 * SPDX-License-Identifier: MIT
 */
#undef ZS_STATS
#define ZS_STATS 0 /* a count of what was written would keep apart all ways to write */
#include "prove.h"

#define zs_recip_inline recip_in_line /* fx.c, which is here for its tables, has one too */
/* As zs_recip (prove.h). */
/*@ assigns \result \from a;
    ensures bound: 0x80000000 <= \result; */
static inline uint32_t zs_recip_inline(uint32_t a);
#include "../../lib/internals.h"

/* Proved by quotients (plane_proof.c). */
/*@ requires 2 <= lz <= 18 && least_shift == 5;
    requires -0x400000000000 <= n <= 0x400000000000;
    assigns \result \from n, rcp, lz, least_shift;
    ensures bound: \result == -2147483648 || -134217728 <= \result <= 134217728; */
int32_t zs_plane_quotient(int64_t n, uint32_t rcp, int32_t lz, int32_t least_shift);
/* What rows are given: struct zs_sides in words: span, step, span, step; two a row; two sums; key, gx; row, mid,
 * end. */
struct zs_sides;
/*@ requires spans: ((unsigned int *)w)[0] < 0x400000 && ((unsigned int *)w)[2] < 0x400000;
    requires rows: ((int *)w)[10] < ((int *)w)[12] <= ((int *)w)[10] + 65;
    requires middle: ((int *)w)[10] <= ((int *)w)[11] <= ((int *)w)[10] + 65;
    assigns \nothing; */
static ZS_NOINLINE void small_rows(struct zs_job *job, struct zs_sides *w);
#include "fast/fast_solid.c"

#include "any_tiny.h"

static void any_small(int32_t x, int32_t y, int32_t from)
{
    any_tiny(x, y);
    renderer.vert = pool;
    renderer.view.piece_base = any_u32(0x00ffffffu, UINT32_MAX);
    renderer.view.piece_shift = (uint8_t)any_u32(19, 31);
    renderer.stats.tris_setup = 0;
    job.r = &renderer;
    job.tri = &tri;
    job.width = job.pitch = any_i32(1, ZS_SIZE_MAX);
    job.y0 = zs_first_sample(y) + from;
    job.y1 = job.y0 + any_i32(1, ZS_SIZE_MAX);
    (void)small_draw(&job);
}

/* PROVE small_setups -eva-split-return-function=zs_small_look:0:1,zs_small_keys:0:1,zs_small_place:0:1:2
 * -eva-use-spec=recip_in_line,zs_plane_quotient,small_rows: every triangle of up to 2^14 sub-pixels each way, any keys
 * and pieces of 2^19 .. 2^31, its top corner at both ends of its range and at 0, there on a pixel's border, on a sample
 * and a sub-pixel beside it, strips from above it and from each of its 65 rows on, any width and height */
void small_setups(void)
{
    static const int32_t at[3] = { COORD_LO + 1, 0, COORD_HI - 1 - 255 }, part[5] = { 0, 127, 128, 129, 255 };
    for (int i = 0; i < 15; i++)
        for (int32_t from = -1; from <= 64; from++)
            any_small(at[i / 5] + part[i % 5], at[i / 5] + part[i % 5], from);
}

#define WIDTH 4 /* of the strip in which rows are walked; its column 0 stays out: Eva does not wrap addresses */
#define COLUMN (ZS_TINY_SIDE + 1) /* of the top corner: the least for which walk.left is not negative */
#define ROWS 2

static struct zs_sides walk;

/* Columns of a side in rows from the n-th on: at and `by` more a row; as set-up has them, of an edge of one row. */
static uint32_t side_sum(int32_t at)
{
    return (uint32_t)(ZS_TINY_SIDE - COLUMN + at) * ZS_SUBPX_ONE + any_u32(0, ZS_SUBPX_ONE - 1);
}

static int within(int32_t at, int32_t by, int32_t n)
{
    return at >= 1 && at <= WIDTH && at + by * n >= 1 && at + by * n <= WIDTH;
}

/* Depths of what lies in spans alone are initialised: a look at any other is an alarm, and so is a write beyond
 * the strip. */
static void walked(int32_t first, int32_t mid, int32_t n, const int32_t at[2], const int32_t by[2], int turn,
                   int32_t next, int32_t next_by)
{
    uint16_t cells[2][ROWS * WIDTH];
    int32_t x[2] = { at[0], at[1] };
    for (int32_t k = 0; k < n; k++) {
        if (k == mid)
            x[turn] = next;
        for (int32_t i = x[0]; i < x[1]; i++)
            cells[0][(first + k) * WIDTH + i] = (uint16_t)any_u32(0, 65535);
        x[0] += k >= mid && turn == 0 ? next_by : by[0];
        x[1] += k >= mid && turn == 1 ? next_by : by[1];
    }
    job.r = &renderer;
    job.tri = &tri;
    job.depth = cells[0];
    job.color = cells[1];
    job.width = job.pitch = WIDTH;
    job.y0 = 40;
    for (int k = 0; k < 2; k++) {
        walk.side[2 * k] = ZS_SUBPX_ONE;
        walk.side[2 * k + 1] = (uint32_t)by[k] * ZS_SUBPX_ONE;
        walk.sum[k] = side_sum(at[k]);
    }
    walk.down[0] = 2 * WIDTH;
    walk.down[1] = any_u32(0, UINT32_MAX);
    walk.key = any_u32(0, UINT32_MAX);
    walk.gx = any_u32(0, UINT32_MAX);
    walk.row = job.y0 + first;
    walk.mid = walk.row + mid;
    walk.end = walk.row + n;
    walk.left = (uintptr_t)(intptr_t)((COLUMN - ZS_TINY_SIDE - 1) * 2);
    walk.turn = (uint32_t)turn;
    walk.next[0] = ZS_SUBPX_ONE;
    walk.next[1] = (uint32_t)next_by * ZS_SUBPX_ONE;
    walk.next_sum = side_sum(next);
    renderer.stats.pixels_tested = renderer.stats.pixels_written = 0;
    small_rows(&job, &walk);
}

/* Both sides' columns, what they change by and those of the one that begins at the middle corner. */
static void walks_of(int32_t n, int32_t mid, int turn)
{
    static const int8_t change[5][2] = { { 0, 0 }, { 1, 1 }, { -1, 0 }, { 0, 1 }, { 1, -1 } };
    const int32_t end[2] = { turn == 0 ? (mid > 0 ? mid - 1 : 0) : n - 1, turn == 1 ? (mid > 0 ? mid - 1 : 0) : n - 1 };
    for (int i = 0; i < 16 * 5; i++) {
        const int32_t at[2] = { i % 4 + 1, i / 4 % 4 + 1 }, by[2] = { change[i / 16][0], change[i / 16][1] };
        if (within(at[0], by[0], end[0]) && within(at[1], by[1], end[1]))
            for (int k = 0; k < (mid < n ? 4 : 1); k++)
                walked(ROWS - n, mid, n, at, by, turn, k + 1, 0);
    }
}

/* PROVE small_walks -eva-use-spec=recip_in_line -eva-min-loop-unroll=8 -eva-slevel-function=pixels:0: strips of 2
 * rows, triangles of 1 and 2 rows, of 0 .. 3 columns, any pair of columns at first and any below the middle
 * corner, which is above any row and on either side, sides that go a column left or right a row or stay, any keys:
 * what is read and written lies in the spans */
void small_walks(void)
{
    for (int32_t n = 1; n <= ROWS; n++)
        for (int32_t mid = 0; mid <= n; mid++)
            for (int turn = 0; turn < 2; turn++)
                walks_of(n, mid, turn);
}
