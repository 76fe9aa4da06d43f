/* Small triangles of one colour, set up and drawn in one go (small.h).
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade/solid.h"
#include "fast/small.h"

#if ZS_LEAN
#elif ZS_DIVIDES

/* The pixels right of `at` up to `end`, as zs_solid_pixels. */
ZS_ALWAYS_INLINE int32_t pixels(uint16_t *at, uint16_t *const end, uintptr_t beside, uint32_t sum, uint32_t gx, uint16_t paint)
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

static ZS_NOINLINE void small_rows(struct zs_job *job, struct zs_sides *w)
{
    const uint32_t pitch = w->down[0];
    const uintptr_t beside = zs_solid_beside(job);
    const uint16_t paint = job->tri->paint;
    uintptr_t depth = (uintptr_t)job->depth + (uint32_t)(w->row - job->y0) * pitch + w->left;
    uintptr_t end = depth + (uint32_t)(w->mid - w->row) * pitch;
    const uintptr_t last = depth + (uint32_t)(w->end - w->row) * pitch;
    uint32_t tested = 0, key = w->key; /* modulo 2^32, as sums are: below 2^29.2 in rows that are drawn */
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
                written += pixels((uint16_t *)depth + x0, (uint16_t *)depth + x1, beside, key + w->gx * x0, w->gx, paint);
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
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

int zs_small_draw(struct zs_job *job)
{
    struct zs_small s;
    struct zs_sides w;
    const enum zs_small_fate fate = zs_small_look(job, &s);
    if (fate != ZS_SMALL_ROWS)
        return (int)fate;
    if (!zs_small_keys(&s, &w))
        return 0;
    zs_small_sides(job, &s, &w);
    small_rows(job, &w);
    return 1;
}

#else

int zs_small_draw(struct zs_job *job) /* not called */
{
    (void)job;
    return 0;
}

#endif
