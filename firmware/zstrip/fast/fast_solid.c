/* Triangles of one colour: depth test and store in one loop, without a call for each row or run.
 * Small triangles have a path of their own (fast/small.h).
 *
 * For each pixel: key = sum >> 16, compare, store key and colour, add. There is no division and no
 * 64-bit arithmetic in the loop. The walk over rows (`rows`) declines triangles whose keys may
 * saturate: the core then walks, and calls `span`. What it is worth: zs_fast.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "core/rows.h"
#include "fast/small64.h"
#include "fast/solid_v7m.h"
#include "zs_fast.h"

/* The distance in bytes from a pixel's key to its colour, for loops that step one pointer only. */
static inline uintptr_t beside_of(const struct zs_job *job)
{
    return (uintptr_t)job->color - (uintptr_t)job->depth;
}

/* Test and draw n > 0 pixels. sum is modulo 2^32; at covered pixels it is the key + 1/2 bucket, in
 * [0, 2^32) (plane.c). Return the number of pixels written, if ZS_STATS is 1. */
ZS_ALWAYS_INLINE int32_t pixels(uint16_t *depth, uintptr_t beside, int32_t n, uint32_t sum,
                                uint32_t gx, uint16_t paint, uint32_t top, int clamp)
{
    const uint16_t *const end = depth + n;
    int32_t written = 0;
    do {
        uint32_t key = sum >> 16;
        if (clamp && key > top)
            key = top;
        if (key < *depth) {
            *depth = (uint16_t)key;
            *(uint16_t *)((uintptr_t)depth + beside) = paint;
            if (ZS_STATS)
                written++;
        }
        sum += gx;
    } while (++depth != end);
    return written;
}

/* ---- Rows ------------------------------------------------------------------------------------ */

/* Draw a triangle whose keys do not saturate. Does the work of zs_rows_walk, with fewer values in
 * registers. */
static ZS_NOINLINE void solid_walk(struct zs_job *job)
{
    const int32_t width = job->width, pitch = job->pitch;
    const uint32_t gx = job->key.gx;
    const uint16_t paint = job->tri->paint;
    uint32_t tested = 0;
    int32_t written = 0, y = job->row;
    const uintptr_t beside = beside_of(job);
    uint16_t *depth = job->depth + (y - job->y0) * pitch;
    uint32_t key = job->key.base - zs_wrap_mul(gx, job->geom.ia) +
                   zs_wrap_mul(job->key.gy, y - job->geom.ja);
    for (;;) {
        const struct zs_cut *cut = job->cut, *const end = cut + (job->cut_end - y);
        for (; cut != end; cut++) {
            const int32_t i0 = zs_max32(cut->x0, 0), n = zs_min32(cut->x1, width) - i0;
            if (n > 0) {
                tested += (uint32_t)n;
                written += pixels(depth + i0, beside, n, key + zs_wrap_mul(gx, i0), gx, paint, 0,
                                  0);
            }
            depth += pitch;
            key += job->key.gy;
        }
        y = job->cut_end;
        if (y >= job->row_end)
            break;
        zs_edges_cut(job, y);
    }
    zs_rows_counted(job, tested, written);
}

static void solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                       uint32_t sum, uint32_t gx)
{
    const uintptr_t beside = beside_of(job);
    uint16_t *depth = job->depth + row->at + i0;
    const uint16_t paint = job->tri->paint;
    int32_t written;
    if (job->saturates)
        written = pixels(depth, beside, i1 - i0, sum, gx, paint, (job->r->view.key_top >> 16) - 1u,
                         1);
    else
        written = pixels(depth, beside, i1 - i0, sum, gx, paint, 0, 0);
    zs_rows_written(job, written);
}

static int solid_rows(struct zs_job *job)
{
    if (job->saturates)
        return 0;
    solid_walk(job);
    return 1;
}

/* ---- Small triangles ------------------------------------------------------------------------- */

/* The same as pixels() for the pixels after `at`, up to and including `end`; no key saturates. */
ZS_ALWAYS_INLINE int32_t small_pixels(uint16_t *at, uint16_t *const end, uintptr_t beside,
                                      uint32_t sum, uint32_t gx, uint16_t paint)
{
    int32_t written = 0;
    do {
        if ((uint16_t)(sum >> 16) < *++at) {
            *at = (uint16_t)zs_high(sum);
            *(uint16_t *)((uintptr_t)at + beside) = paint;
            if (ZS_STATS)
                written++;
        }
        sum += gx;
    } while (at != end);
    return written;
}

#if ZS_64

/* Test and draw the rows of a small triangle. ZS_FORGET: what a row needs once is loaded there. The
 * rows of other cores take 4.7 % more of scene relief on x86-64, 5.3 % of sheet. */
ZS_ALWAYS_INLINE void small_rows(struct zs_job *job, struct zs_sides *w)
{
    const uintptr_t pitch = w->down[0], beside = beside_of(job);
    const uint16_t paint = job->tri->paint;
    uintptr_t row = (uintptr_t)job->depth + (uint32_t)(w->row - job->y0) * pitch + w->left + 2u;
    uintptr_t end = row + (uint32_t)(w->mid - w->row) * pitch;
    const uintptr_t last = row + (uint32_t)(w->end - w->row) * pitch;
    uint32_t tested = 0, key = w->key;
    int32_t written = 0;
    for (;;) {
        uint32_t left = w->sum[0], right = w->sum[1];
        for (; row != end; row += pitch) {
            ZS_FORGET;
            const uint32_t x0 = left / w->side[0], x1 = right / w->side[2];
            left += w->side[1];
            ZS_ANEW(left);
            right += w->side[3];
            if (x0 < x1) {
                tested += x1 - x0;
                written += small_pixels((uint16_t *)row + x0 - 1, (uint16_t *)row + x1 - 1, beside,
                                        key + w->gx * x0, w->gx, paint);
            }
            key += w->down[1];
        }
        end = last;
        if (row == end)
            break;
        w->sum[0] = left;
        w->sum[1] = right;
        zs_small_turn(w);
    }
    zs_rows_counted(job, tested, written);
}

/* Draw job->tri, and those after it as long as none is declined. */
static int small_draw(struct zs_job *job)
{
    struct zs_small64_of of;
    struct zs_small64 s;
    struct zs_sides w;
    const struct zs_tri *drawn = 0;
    zs_small64_begin(job, &of, &w);
    do {
        enum zs_small_outcome outcome = ZS_SMALL_NOT;
        if (zs_small64_look(&of, job->tri, &s) && zs_small64_keys(&s))
            outcome = zs_small64_place(job, &of, &s);
        if (outcome == ZS_SMALL_NOT)
            return zs_small_declined(job, drawn);
        if (outcome == ZS_SMALL_ROWS) {
            w.key = (uint32_t)zs_small64_key(&s);
            w.gx = (uint32_t)s.gx;
            w.down[1] = 0u - (uint32_t)s.up;
            zs_small64_sides(job, &s, &w);
            small_rows(job, &w);
        }
        drawn = job->tri;
    } while (zs_small64_next(job));
    return 1;
}

#elif ZS_V7M

#define small_draw zs_solid_v7m

#else

static ZS_NOINLINE void small_rows(struct zs_job *job, struct zs_sides *w)
{
    const uint32_t pitch = w->down[0];
    const uintptr_t beside = beside_of(job);
    const uint16_t paint = job->tri->paint;
    uintptr_t depth = (uintptr_t)job->depth + (uint32_t)(w->row - job->y0) * pitch + w->left;
    uintptr_t end = depth + (uint32_t)(w->mid - w->row) * pitch;
    const uintptr_t last = depth + (uint32_t)(w->end - w->row) * pitch;
    uint32_t tested = 0,
             key = w->key; /* modulo 2^32, like left and right, which are below 2^29.2 in rows that
                              are drawn */
    int32_t written = 0;
    for (;;) {
        uint32_t left = w->sum[0], right = w->sum[1];
        while (depth != end) {
            uint32_t span, step, down, by;
            zs_two(w->side, 0, &span, &step);
            const uint32_t x0 = left / span; /* 1 .. 2 ZS_TINY_SIDE; span is 256 .. 2^22 */
            left += step;
            zs_two(w->side, 2, &span, &step);
            const uint32_t x1 = right / span;
            right += step;
            if (x0 < x1) {
                tested += x1 - x0;
                written += small_pixels((uint16_t *)depth + x0, (uint16_t *)depth + x1, beside,
                                        key + w->gx * x0, w->gx, paint);
            }
            zs_two(w->side, 4, &down, &by);
            depth += down;
            key += by;
        }
        end = last;
        if (depth == end)
            break;
        w->sum[0] = left;
        w->sum[1] = right;
        zs_small_turn(w);
    }
    zs_rows_counted(job, tested, written);
}

static int small_draw(struct zs_job *job)
{
    struct zs_small s;
    struct zs_sides w;
    if (!zs_small_look(job, &s) || !zs_small_keys(&s))
        return 0;
    const enum zs_small_outcome outcome = zs_small_place(job, &s);
    if (outcome != ZS_SMALL_ROWS)
        return (int)outcome;
    w.key = s.key;
    w.gx = (uint32_t)s.gx;
    w.down[1] = (uint32_t)s.gy;
    zs_small_sides(job, &s, &w);
    small_rows(job, &w);
    return 1;
}

#endif

#define SOLID(of)                                                                                  \
    {                                                                                              \
        .shader = of, .draw = ZS_DIVIDES ? small_draw : 0, .rows = solid_rows, .span = solid_span  \
    }

const struct zs_fast zs_fast_raw = SOLID(&zs_shade_raw);
const struct zs_fast zs_fast_flat = SOLID(&zs_shade_flat);
