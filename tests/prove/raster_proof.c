/* edges.c, those of the core and of fast/; raster.c: windows.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../internals.h"

#include "core/edges.c"
#include "fast/edges.c"
#include "core/raster.c"

#define COORD_LO (-ZS_GUARD_SUBPX - 1)
#define COORD_HI (ZS_GUARD_SUBPX + 1 + ZS_SIZE_MAX * ZS_SUBPX_HALF)

/* PROVE edge_below_first_row: fractions of 8 bits, every dy below 2^22 by octave, 0 <= off, part <= dy */
void edge_below_first_row(void)
{
    for (int k = 0; k < ZS_EXTENT_BITS; k++) {
        const int32_t most = (int32_t)OCTAVE_HI(k);
        const int32_t n = edge_below(any_i32(0, 255), any_i32((int32_t)OCTAVE_LO(k), most), any_i32(0, most), any_i32(0, most));
        ASSERT(n >= 0 && n <= 1 << (k > 6 ? k - 5 : 1));
    }
}

static void edges_of(int32_t lo, int32_t hi)
{
    static const int32_t at[3] = { COORD_LO, 0, COORD_HI };
    int16_t out[2 * ZS_CUT_ROWS];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < ZS_EXTENT_BITS; k++) {
            const int32_t dy = any_i32((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k));
            const struct zs_vertex a = { at[i], at[i], 0 }, b = { at[i] + any_i32(lo, hi), at[i] + dy, 0 };
            const int32_t first = zs_first_sample(at[i]);
            for (int32_t n = 1; n <= ZS_CUT_ROWS; n += ZS_CUT_ROWS - 1)
                edge_columns(out, n, &a, &b, first + any_i32(0, (int32_t)(OCTAVE_HI(k) >> ZS_SUBPX_BITS)));
        }
}

/* PROVE edges -eva-min-loop-unroll=17: |dx| < 2^22, every dy below 2^22 by octave, the upper end at
 * both ends of its range and at 0, 1 and 16 rows by their distance from it, 0 .. dy and up to a sample more; remainders below
 * their divisors: taken as given */
void edges(void)
{
    const int32_t most = ((int32_t)1 << ZS_EXTENT_BITS) - 1;
    edges_of(-most, most);
}

/* PROVE tiny_edges -eva-min-loop-unroll=17: every triangle of up to 2^14 sub-pixels each way, its top corner at both ends of
 * its range and at 0, rows from its first, 17th, 49th and 65th on, 1, 2, 15 and 16 of them, the middle corner above all, below
 * one, below all; on either side; that no row lies beside a level edge: taken as given */
void tiny_edges(void)
{
    static const int32_t at[3] = { COORD_LO, 0, COORD_HI };
    static const int32_t from[4] = { 0, 16, 48, 64 }, number[4] = { 1, 2, 15, 16 };
    static struct zs_job job;
    static struct zs_vertex a;
    job.v[0] = &a;
    for (int i = 0; i < 96; i++)
        for (int mid = 0; mid < 3; mid++) {
            const int32_t n = number[i & 3], row = zs_first_sample(at[i >> 5]) + from[i >> 2 & 3];
            a.x = a.y = at[i >> 5];
            job.mid_right = (uint8_t)(i >> 4 & 1);
            job.row_mid = row + (mid == 2 ? n : mid);
            job.cut_end = row + n;
            job.geom.tiny = 1;
            for (int k = 0; k < 2; k++) {
                job.geom.dx[k] = any_i32(-ZS_TINY, ZS_TINY);
                job.geom.dy[k] = any_i32(0, ZS_TINY);
            }
            ASSERT(tiny_cuts(&job, row) == 1);
        }
}

#define WINDOW 6 /* columns of the frame */

static struct zs_renderer renderer;
static struct zs_job drawn;
static struct zs_row of_piece;
static int32_t piece_from, piece_to, pieces;

static void a_piece(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t step)
{
    ASSERT(job == &drawn && row == &of_piece && i0 == piece_from && i1 == piece_to && i0 < i1);
    ASSERT(sum == (uint32_t)i0 * 3u + 100u && step == 3u);
    pieces++;
}

/* PROVE window_pieces -eva-min-loop-unroll=24: frames of 6 columns, every window and every piece, handed on to first touch or to the
 * test: what of it lies in the window, with its own key, and nothing where none does; the others are not counted as tested */
void window_pieces(void)
{
    static const struct zs_fast_touch touch = { .piece = a_piece };
    drawn.r = &renderer;
    renderer.touch = &touch;
    for (int32_t w0 = 0; w0 < WINDOW; w0++)
        for (int32_t w1 = w0 + 1; w1 <= WINDOW; w1++)
            for (int32_t i0 = 0; i0 < WINDOW; i0++)
                for (int32_t i1 = i0 + 1; i1 <= WINDOW; i1++)
                    for (int touches = 0; touches < 2; touches++) {
                        renderer.window[0] = (uint16_t)w0;
                        renderer.window[1] = (uint16_t)w1;
                        renderer.stats.pixels_tested = 100;
                        drawn.split = (uint8_t)(touches ? ZS_SPLIT_WINDOW | ZS_SPLIT_TOUCH : ZS_SPLIT_WINDOW);
                        drawn.span = touches ? 0 : a_piece;
                        piece_from = zs_max32(i0, w0);
                        piece_to = zs_min32(i1, w1);
                        pieces = 0;
                        window_piece(&drawn, &of_piece, i0, i1, (uint32_t)i0 * 3u + 100u, 3u);
                        ASSERT(pieces == (piece_from < piece_to));
                        ASSERT(renderer.stats.pixels_tested == 100u - (uint32_t)(i1 - i0 - zs_max32(piece_to - piece_from, 0)));
                    }
}
