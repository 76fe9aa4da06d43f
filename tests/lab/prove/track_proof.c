/* track.c: the columns of a piece that are drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "damage/track.c"

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

/* PROVE window_pieces -eva-min-loop-unroll=24: frames of 6 columns, every window and every piece, handed on to first
 * touch or to the test: what of it lies in the window, with its own key, and nothing where none does; the others are
 * not counted as tested */
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
                        ASSERT(renderer.stats.pixels_tested ==
                               100u - (uint32_t)(i1 - i0 - zs_max32(piece_to - piece_from, 0)));
                    }
}
