/* first_touch.c: what is cleared, what is drawn without a test, and that nothing else is touched.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "core/raster.c"
#include "fast/first_touch.c"

#define WIDTH 5 /* of the strip in which rows are */
#define LONG 24 /* of the one in which keys are */
#define ROWS 3
#define BEFORE 7 /* what all cells hold */
#define BACKGROUND 0x1234

static struct zs_renderer renderer;
static struct zs_scene scene;
static struct zs_job job;
static struct zs_shader shader;
static int16_t drawn[ROWS][2];
static uint32_t color_pairs[ROWS * LONG / 2], depth_pairs[ROWS * LONG / 2];
static uint16_t *const color = (uint16_t *)color_pairs, *const depth = (uint16_t *)depth_pairs;

/* A sky: the background again, within the strip. */
static void sky_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    ASSERT(ctx == &scene && n > 0 && x + n <= renderer.config.width && y >= ROWS && y < 2 * ROWS);
    ASSERT(out == color + (y - ROWS) * renderer.config.width + x);
    for (int32_t k = 0; k < n; k++)
        out[k] = zs_wire16(BACKGROUND);
}
static const struct zs_background a_sky = { .fill = sky_fill, .ctx = &scene };

static int skies; /* 1: the scene has one */

static void strip(int32_t width)
{
    scene.sky = skies ? &a_sky : 0;
    renderer.config.width = (uint16_t)width;
    renderer.config.strip_h = ROWS;
    renderer.config.height = renderer.view.height = 2 * ROWS;
    renderer.window[0] = 0;
    renderer.window[1] = (uint16_t)width;
    renderer.strip = 1;
    renderer.color[0] = renderer.color[1] = color;
    renderer.depth = depth;
    renderer.drawn = drawn;
    renderer.scene = &scene;
    scene.background = BACKGROUND;
    job.r = &renderer;
    job.width = job.pitch = width;
    job.y0 = ROWS;
    job.y1 = 2 * ROWS;
    job.color = color;
    job.depth = depth;
    for (int k = 0; k < ROWS * LONG; k++)
        color[k] = depth[k] = BEFORE;
}

/* Cells [from, to) are cleared, those before are as they were. */
static void cells(int32_t from, int32_t to, int cleared)
{
    for (int32_t k = from; k < to; k++) {
        ASSERT(depth[k] == (cleared ? ZS_DEPTH_CLEAR : BEFORE));
        ASSERT(color[k] == (cleared ? zs_wire16(BACKGROUND) : BEFORE));
    }
}

static void row_of(int32_t y, int32_t x0, int32_t x1, int32_t i0, int32_t i1)
{
    const struct zs_row row = { ROWS + y, y * WIDTH, 0, i0, i1, i0, i1, 0 };
    const int32_t lo = x0 == x1 ? i0 : zs_min32(x0, i0), hi = x0 == x1 ? i1 : zs_max32(x1, i1);
    strip(WIDTH);
    drawn[y][0] = (int16_t)x0;
    drawn[y][1] = (int16_t)x1;
    renderer.untouched_left = ROWS * WIDTH;
    touch_row(&job, &row);
    ASSERT(renderer.was[0] == x0 && renderer.was[1] == x1);
    ASSERT(drawn[y][0] == lo && drawn[y][1] == hi);
    ASSERT(renderer.untouched_left == ROWS * WIDTH - (uint32_t)(hi - lo - (x1 - x0)));
    for (int32_t x = 0; x < WIDTH; x++)
        cells(y * WIDTH + x, y * WIDTH + x + 1, x0 < x1 && ((x >= x1 && x < i0) || (x >= i1 && x < x0)));
    cells(0, y * WIDTH, 0);
    cells((y + 1) * WIDTH, ROWS * LONG, 0);
}

static void every_row(void)
{
    for (int32_t x0 = 0; x0 <= WIDTH; x0++)
        for (int32_t x1 = x0; x1 <= WIDTH; x1++)
            for (int32_t i0 = 0; i0 < WIDTH; i0++)
                for (int32_t i1 = i0 + 1; i1 <= WIDTH; i1++)
                    row_of((x0 + i1) % ROWS, x0, x1, i0, i1);
}

/* PROVE first_touch_row_of -eva-min-loop-unroll=80: a row of 5 columns, every range of them drawn, none too, every
 * span: the gap between is cleared, by a colour or by a sky, nothing else; the range, and how many are untouched */
void first_touch_row_of(void)
{
    every_row();
    skies = 1;
    every_row();
}

static int32_t next_part, part_end;

/* Parts follow each other: those that were drawn on are tested, the others are drawn. */
static void a_part(struct zs_job *j, int32_t from, int32_t to, int tested)
{
    const int16_t *was = j->r->was;
    ASSERT(from == next_part && from < to && to <= part_end);
    for (int32_t x = from; x < to; x++)
        ASSERT(tested == (x >= was[0] && x < was[1]));
    next_part = to;
}

static void tested_part(struct zs_job *j, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t step)
{
    (void)row;
    ASSERT(sum == (uint32_t)i0 * 3u + 100u && step == 3u);
    a_part(j, i0, i1, 1);
}

static void drawn_part(struct zs_job *j, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)row;
    a_part(j, from, to, 0);
}

/* PROVE first_touch_parts -eva-min-loop-unroll=80: rows of 6 columns, every range that was drawn, every first pixel of
 * a piece and every end behind it: each pixel is in one part, from left to right, tested where it was drawn on and else
 * not, with its own key */
void first_touch_parts(void)
{
    strip(6);
    shader.run = drawn_part;
    job.shader = &shader;
    job.span = tested_part;
    job.saturates = 0;
    for (int32_t i = 0; i < 6; i++)
        for (int32_t end = i + 1; end <= 6; end++)
            for (int32_t x0 = 0; x0 <= 6; x0++)
                for (int32_t x1 = x0; x1 <= 6; x1++) {
                    const struct zs_row row = { ROWS, 0, 0, i, end, i, end, 0 };
                    renderer.was[0] = (int16_t)x0;
                    renderer.was[1] = (int16_t)x1;
                    renderer.stats.pixels_untested = renderer.stats.pixels_written = 0;
                    next_part = i;
                    part_end = end;
                    touch_piece(&job, &row, i, end, (uint32_t)i * 3u + 100u, 3u);
                    ASSERT(next_part == end);
                }
}

static int32_t run_from, run_to;

static void a_run(struct zs_job *j, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)j;
    (void)row;
    ASSERT(from == run_from && to == run_to);
}

static void piece_of(int32_t i, int32_t n, int saturates)
{
    const struct zs_row row = { ROWS + 1, LONG, 0, 0, LONG, 0, LONG, 0 };
    strip(LONG);
    shader.run = a_run;
    job.shader = &shader;
    job.saturates = (uint8_t)saturates;
    renderer.view.key_top = any_u32(0xff0000u, 0xffff0000u);
    renderer.stats.pixels_untested = renderer.stats.pixels_written = 0;
    run_from = i;
    run_to = i + n;
    renderer.was[0] = renderer.was[1] = 0;
    touch_piece(&job, &row, i, i + n, any_u32(0, UINT32_MAX), any_u32(0, UINT32_MAX));
    cells(0, LONG + i, 0);
    cells(LONG + i + n, ROWS * LONG, 0);
}

/* PROVE window_rows -eva-min-loop-unroll=80: a row of 5 columns of which a window is drawn, any; every range of it
 * drawn, every span: the same as a row of the window's own, if it lies in it; nothing beside the window */
void window_rows(void)
{
    for (int32_t w0 = 0; w0 < WIDTH; w0++)
        for (int32_t w1 = w0 + 1; w1 <= WIDTH; w1++)
            for (int32_t x0 = w0; x0 <= w1; x0++)
                for (int32_t x1 = x0; x1 <= w1; x1++)
                    for (int32_t i0 = 0; i0 < WIDTH; i0++)
                        for (int32_t i1 = i0 + 1; i1 <= WIDTH; i1++) {
                            const struct zs_row row = { ROWS + 1, WIDTH, 0, i0, i1, i0, i1, 0 };
                            const int32_t a = zs_max32(i0, w0), b = zs_min32(i1, w1);
                            const int32_t lo = x0 == x1 ? a : zs_min32(x0, a), hi = x0 == x1 ? b : zs_max32(x1, b);
                            const int moves = a < b;
                            strip(WIDTH);
                            renderer.window[0] = (uint16_t)w0;
                            renderer.window[1] = (uint16_t)w1;
                            drawn[1][0] = (int16_t)x0;
                            drawn[1][1] = (int16_t)x1;
                            renderer.untouched_left = ROWS * WIDTH;
                            touch_row(&job, &row);
                            ASSERT(drawn[1][0] == (moves ? lo : x0) && drawn[1][1] == (moves ? hi : x1));
                            for (int32_t x = 0; x < WIDTH; x++)
                                cells(WIDTH + x, WIDTH + x + 1,
                                      moves && x0 < x1 && ((x >= x1 && x < a) || (x >= b && x < x0)));
                            cells(0, WIDTH, 0);
                            cells(2 * WIDTH, ROWS * LONG, 0);
                        }
}

static void every_end(void)
{
    for (int32_t w0 = 0; w0 < WIDTH; w0++)
        for (int32_t w1 = w0 + 1; w1 <= WIDTH; w1++)
            for (int32_t x0 = w0; x0 <= w1; x0++)
                for (int32_t x1 = x0; x1 <= w1; x1++)
                    for (int left = ALL; left <= SOME; left++) {
                        strip(WIDTH);
                        renderer.window[0] = (uint16_t)w0;
                        renderer.window[1] = (uint16_t)w1;
                        for (int32_t k = 0; k < ROWS; k++) {
                            drawn[k][0] = (int16_t)(k == 1 ? x0 : w0);
                            drawn[k][1] = (int16_t)(k == 1 ? x1 : w0);
                        }
                        renderer.untouched = (uint8_t)left;
                        renderer.untouched_left = 1;
                        touch_end(&renderer);
                        for (int32_t k = 0; k < ROWS * WIDTH; k++) {
                            const int32_t x = k % WIDTH, y = k / WIDTH;
                            if (x >= w0 && x < w1)
                                cells(k, k + 1, left == ALL || y != 1 || x < x0 || x >= x1);
                        }
                        cells(ROWS * WIDTH, ROWS * LONG, 0);
                    }
}

/* PROVE window_ends -eva-min-loop-unroll=80: strips of 3 rows of 5 columns of which a window is drawn, any, and of it
 * any range of one row, or nothing: what is not drawn of the window is cleared, by a colour or by a sky; beside it
 * nothing that was drawn changes */
void window_ends(void)
{
    every_end();
    skies = 1;
    every_end();
}

/* PROVE first_touch_pieces -eva-min-loop-unroll=80: pieces of 1 .. 20 pixels at four places and at the row's end, any
 * keys, held or not: nothing beside them is written; a run of all of it */
void first_touch_pieces(void)
{
    for (int saturates = 0; saturates < 2; saturates++)
        for (int32_t n = 1; n <= 20; n++) {
            for (int32_t i = 0; i < 4; i++)
                piece_of(i, n, saturates);
            piece_of(LONG - n, n, saturates);
        }
}

/* PROVE first_touch_ends -eva-min-loop-unroll=80: strips of 3 rows of 5 columns of which one row has any range drawn,
 * the others none or all, and strips of which all is untouched or none: what is not drawn is cleared, the rest stays */
void first_touch_ends(void)
{
    for (int32_t x0 = 0; x0 <= WIDTH; x0++)
        for (int32_t x1 = x0; x1 <= WIDTH; x1++)
            for (int32_t y = 0; y < ROWS; y++)
                for (int all = 0; all < 2; all++) {
                    strip(WIDTH);
                    for (int32_t k = 0; k < ROWS; k++) {
                        drawn[k][0] = (int16_t)(k == y ? x0 : 0);
                        drawn[k][1] = (int16_t)(k == y ? x1 : all ? WIDTH : 0);
                    }
                    renderer.untouched = SOME;
                    renderer.untouched_left = any_u32(1, ROWS * WIDTH);
                    touch_end(&renderer);
                    for (int32_t k = 0; k < ROWS * WIDTH; k++) {
                        const int32_t x = k % WIDTH;
                        cells(k, k + 1, k / WIDTH == y ? x < x0 || x >= x1 : !all);
                    }
                    cells(ROWS * WIDTH, ROWS * LONG, 0);
                }
    for (int left = NONE; left <= ALL; left++) {
        strip(WIDTH);
        renderer.untouched = (uint8_t)left;
        touch_end(&renderer);
        ASSERT(renderer.untouched == NONE);
        cells(0, ROWS * WIDTH, left == ALL);
        cells(ROWS * WIDTH, ROWS * LONG, 0);
    }
}
