/* First touch: the first triangle at a pixel of a strip needs no clear before it and no depth test.
 *
 * A strip is not cleared before it is drawn. As long as its triangles are wide, each row records
 * the columns that hold colours and keys, as a single range; all other pixels are uncleared. The
 * pixels of a span that are uncleared are drawn without a test, because every key is less than
 * ZS_DEPTH_CLEAR; the others are drawn as usual. A gap between a span and the row's range is
 * cleared, so that there is still a single range. The first triangle for which this does not pay
 * (narrow, with a depth state, with keys that are computed pixel by pixel, or with a shader that
 * leaves pixels as they are or reads them) ends first touch, and so does the end of the strip: the
 * pixels that are still uncleared are then cleared. Frames in passes, and mappings and methods with
 * a depth test of their own, do without (core/frame.c). What it is worth: zs_fast.h.
 *
 * So each pixel is initialised once, by a clear or by a triangle, and nothing is read before it was
 * written, except outside the columns that are drawn (r->window).
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
    128 /* columns; here a scanline costs some 40 instructions more, and an uncleared pixel 6      \
           less and no clear */

enum {
    NONE,
    ALL,
    SOME
}; /* zs_renderer.untouched: which pixels in r->window are uncleared; SOME: those outside r->drawn
      */

static void touch_begin(struct zs_renderer *r)
{
    r->untouched = ALL;
}

static ZS_NOINLINE void touch_end(struct zs_renderer *r)
{
    const int32_t width = r->config.width, n = zs_strip_rows(r);
    const int left = r->untouched;
    r->untouched = NONE;
    const int32_t x = r->window[0], end = r->window[1];
    if (left == ALL && (end - x) * 2 > width) { /* faster than row by row */
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

/* Extend a row's range by a span, and clear the gap between them. r->was is the range before. */
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

/* Store n > 0 keys: sum / 65536, where sum changes by gx from pixel to pixel. */
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

/* The same, with keys clamped to `top`. */
static void keys_held(uint16_t *at, int32_t n, uint32_t sum, uint32_t gx, uint32_t top)
{
    for (uint16_t *const end = at + n; at < end; at++, sum += gx)
        *at = (uint16_t)zs_minu32(sum >> 16, top);
}

/* Store the keys of n uncleared pixels. */
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

/* Draw a piece: the pixels left and right of the row's earlier range are uncleared, those inside it
 * are tested. */
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

/* Return 1 if job->tri is at least WIDE columns wide. */
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
    if (job->depth_state || !job->shader->opaque || r->view.pixelwise || !wide(job) ||
        (r->untouched == SOME && r->untouched_left == 0)) {
        job->split = 0;
        touch_end(r);
        return 0;
    }
    if (r->untouched == ALL) {
        const uint32_t n = (uint32_t)zs_strip_rows(r);
        for (uint32_t y = 0; y < n; y++)
            r->drawn[y][0] = r->drawn[y][1] = (int16_t)r->window[0];
        r->untouched_left = n * (uint32_t)drawn;
        r->untouched = SOME;
    }
    job->split = drawn < r->config.width ? ZS_SPLIT_TOUCH | ZS_SPLIT_WINDOW : ZS_SPLIT_TOUCH;
    return 1;
}

static const struct zs_fast_touch touch = {
    .begin = touch_begin, .end = touch_end, .takes = touch_takes, .row = touch_row,
    .piece = touch_piece
};
const struct zs_fast zs_fast_touch = { .touch = &touch };
