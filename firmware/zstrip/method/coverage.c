/* Coverage: pieces of triangles, drawn from near to far; a bit for each pixel says what is drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/method.h"
#include "core/rows.h"
#include "method/order.h"
#include "zs_method.h"
#include "zs_shader.h"

/* The number of zeros below a word's lowest 1; 32: there is none. */
static int32_t zeros_below(uint32_t word)
{
    return word ? 31 - zs_clz32(word & (0u - word)) : 32;
}

/* Return the first column of a row of bits in [at, end) whose bit is 1, or 0 if `flip` is all ones;
 * end if there is none. Words without such a bit are skipped. */
static int32_t find(const uint32_t *bits, int32_t at, int32_t end, uint32_t flip)
{
    while (at < end) {
        const uint32_t word = (bits[at >> 5] ^ flip) >> (at & 31);
        if (word)
            return zs_min32(end, at + zeros_below(word));
        at = (at | 31) + 1;
    }
    return end;
}

static void mark(uint32_t *bits, int32_t at, int32_t end)
{
    while (at < end) {
        const int32_t n = zs_min32(end - at, 32 - (at & 31)); /* 1 .. 32 */
        bits[at >> 5] |= UINT32_MAX >> (32 - n) << (at & 31);
        at += n;
    }
}

static void uncovered_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                           uint32_t sum, uint32_t step)
{
    const struct zs_order *o = job->r->method_state;
    (void)sum;
    (void)step;
    if (!zs_order_clip(job, row->y, &i0, &i1))
        return;
    if (!o->bits) { /* a single pixel, of which the nearest triangle alone is drawn */
        zs_rows_written(job, i1 - i0);
        job->shader->run(job, row, i0, i1);
        return;
    }
    uint32_t *const bits = o->bits + (row->y - o->y0) * o->words;
    const int32_t left = o->x0, end = i1 - left;
    for (int32_t at = i0 - left, from; (from = find(bits, at, end, UINT32_MAX)) < end;) {
        at = find(bits, from, end, 0);
        mark(bits, from, at);
        zs_rows_written(job, at - from);
        job->shader->run(job, row, from + left, at + left);
    }
}

static int coverage_begin(struct zs_renderer *r)
{
    r->span = uncovered_span;
    return zs_order_begin(r);
}

static void coverage_strip(struct zs_renderer *r)
{
    struct zs_order o;
    const uint32_t tris = r->config.max_tris;
    const uint32_t bits = (uint32_t)r->config.strip_h * ((r->config.width + 31u) / 32u);
    o.near_first = 1;
    zs_order_strip(r, &o, tris / 4u + zs_minu32((bits + 2u) / 3u, tris / 4u));
}

const struct zs_method zs_method_coverage = { .begin = coverage_begin,
                                              .strip = coverage_strip,
                                              .full = zs_order_full,
                                              .list = zs_order_list,
                                              .once = 1,
                                              .records = 1 };
