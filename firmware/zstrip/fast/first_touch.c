/* Pixels of a strip that nothing was drawn on yet: no clear before them, and no depth test.
 *
 * A strip begins as it was left: nothing is cleared. While wide triangles come first, each row
 * keeps the columns that hold colours and keys, one range a row; all others are untouched. A span's
 * untouched pixels are drawn without a test, since every key is nearer than ZS_DEPTH_CLEAR; the
 * others as always. A gap between a span and the row's range is cleared, so that it stays one
 * range. With the first triangle for which this does not pay (narrow, with a depth state, keys
 * found pixel by pixel), or when the strip is done, what is still untouched is cleared. So each
 * pixel is cleared or drawn first, never both, and what is read was written before, but beside the
 * columns that are drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "core/raster.h"
#include "core/rows.h"
#include "zs_shader.h"
#include "zs_fast.h"

#define WIDE                                                                                       \
    128 /* columns; a triangle's rows cost some 40 instructions more here, an untouched pixel 6    \
           less and no clear */

enum {
    NONE,
    ALL,
    SOME
}; /* zs_renderer.untouched: of the strip's columns that are drawn; SOME: outside r->drawn */

static uint32_t rows_of(const struct zs_renderer *r)
{
    const uint32_t y0 = (uint32_t)r->strip * r->config.strip_h, left = r->config.height - y0;
    return left < r->config.strip_h ? left : r->config.strip_h;
}

static void touch_begin(struct zs_renderer *r)
{
    r->untouched = ALL;
}

static ZS_NOINLINE void touch_end(struct zs_renderer *r)
{
    const int32_t width = r->config.width, n = (int32_t)rows_of(r);
    const int left = r->untouched;
    r->untouched = NONE;
    const int32_t x = r->window[0], end = r->window[1];
    if (left == ALL && (end - x) * 2 > width) { /* in one go */
        zs_raster_clear_all(r);
        return;
    }
    if (left == NONE || (left == SOME && r->untouched_left == 0))
        return;
    for (int32_t y = 0; y < n; y++) {
        const int32_t from = left == ALL ? x : r->drawn[y][0],
                      to = left == ALL ? x : r->drawn[y][1]; /* x <= from <= to <= end */
        zs_raster_clear(r, y, x, from - x);
        zs_raster_clear(r, y, to, end - to);
    }
}

static void touch_row(struct zs_job *job, const struct zs_row *row)
{
    struct zs_renderer *r = job->r;
    const int32_t y = row->y - job->y0;
    int16_t *const drawn = r->drawn[y];
    int32_t x0 = drawn[0], x1 = drawn[1], i0 = row->i0, i1 = row->i1;
    r->was[0] = drawn[0];
    r->was[1] = drawn[1];
    i0 = zs_max32(i0, r->window[0]);
    i1 = zs_min32(i1, r->window[1]);
    if (i0 >= i1)
        return;
    if (x0 == x1)
        x0 = x1 = i0;
    const int32_t before = x1 - x0; /* window[0] <= x0 <= x1 <= window[1] */
    if (i1 < x0)
        zs_raster_clear(r, y, i1, x0 - i1);
    if (i0 > x1)
        zs_raster_clear(r, y, x1, i0 - x1);
    x0 = zs_min32(x0, i0);
    x1 = zs_max32(x1, i1);
    drawn[0] = (int16_t)x0;
    drawn[1] = (int16_t)x1;
    r->untouched_left -= (uint32_t)(x1 - x0 - before);
}

/* n > 0 keys: sum / 65536, changing by gx. */
static void keys(uint16_t *at, int32_t n, uint32_t sum, uint32_t gx)
{
    uint16_t *const end = at + n;
    if ((uintptr_t)at & 2u) {
        *at++ = (uint16_t)(sum >> 16);
        sum += gx;
    }
    const uint32_t many = (uint32_t)(end - at) & ~7u; /* <= n */
    zs_high_halves(at, many, sum, gx);
    at += many;
    sum += many * gx;
    for (; at < end; at++, sum += gx)
        *at = (uint16_t)(sum >> 16);
}

/* The same where keys may saturate. */
static void keys_held(uint16_t *at, int32_t n, uint32_t sum, uint32_t gx, uint32_t top)
{
    for (uint16_t *const end = at + n; at < end; at++, sum += gx)
        *at = (uint16_t)zs_minu32(sum >> 16, top);
}

/* Keys of n fresh pixels. */
static ZS_NOINLINE void untested(struct zs_job *job, uint16_t *depth, int32_t n, uint32_t sum,
                                 uint32_t gx)
{
    struct zs_renderer *r = job->r;
    r->stats.pixels_untested += (uint32_t)n;
    if (job->saturates)
        keys_held(depth, n, sum, gx, (r->view.key_top >> 16) - 1u);
    else
        keys(depth, n, sum, gx);
}

/* Untouched pixels before and behind those that were drawn on. */
ZS_IN_ORDER static void touch_piece(struct zs_job *job, const struct zs_row *row, int32_t i,
                                    int32_t end, uint32_t sum, uint32_t step)
{
    const struct zs_renderer *r = job->r;
    const struct zs_shader *shader = job->shader;
    const int32_t x0 = r->was[0], x1 = r->was[1];
    for (int32_t to; i < end; sum += zs_wrap_mul(step, to - i), i = to) {
        if (i >= x0 && i < x1) {
            to = zs_min32(end, x1);
            job->span(job, row, i, to, sum, step);
            continue;
        }
        to = i < x0 ? zs_min32(end, x0) : end;
        untested(job, job->depth + row->at + i, to - i, sum, step);
        zs_rows_written(job, to - i);
        shader->run(job, row, i, to);
    }
}

/* Is it wide in the frame, or nearly? */
static int wide(const struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const int32_t a = pool[job->tri->v[0]].x, b = pool[job->tri->v[1]].x,
                  c = pool[job->tri->v[2]].x;
    return zs_max32(zs_max32(a, b), c) - zs_min32(zs_min32(a, b), c) >= WIDE * ZS_SUBPX_ONE;
}

static int touch_takes(struct zs_job *job)
{
    struct zs_renderer *r = job->r;
    const int32_t drawn = r->window[1] - r->window[0];
    if (job->depth_state || r->view.pixelwise || !wide(job) ||
        (r->untouched == SOME && r->untouched_left == 0)) {
        job->split = 0;
        touch_end(r);
        return 0;
    }
    if (r->untouched == ALL) {
        const uint32_t n = rows_of(r);
        for (uint32_t y = 0; y < n; y++)
            r->drawn[y][0] = r->drawn[y][1] = (int16_t)r->window[0];
        r->untouched_left = n * (uint32_t)drawn;
        r->untouched = SOME;
    }
    job->split = drawn < r->config.width ? ZS_SPLIT_TOUCH | ZS_SPLIT_WINDOW : ZS_SPLIT_TOUCH;
    return 1;
}

static const struct zs_fast_touch touch = { .begin = touch_begin,
                                            .end = touch_end,
                                            .takes = touch_takes,
                                            .row = touch_row,
                                            .piece = touch_piece };
const struct zs_fast zs_fast_touch = { .touch = &touch };
