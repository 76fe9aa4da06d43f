/* Spans of tiny triangles, both sides in one loop, with a division for each side and row, for cores
 * with a divide instruction (compare core/edges.c), and for an RP2040, whose divider takes eight
 * cycles: 31 cycles a row in place of 100, 0.3 of 8 million in scene teapot.
 *
 * SPDX-License-Identifier: MIT
 */
#include "arch/lanes.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "zs_fast.h"

/* A side of a tiny triangle. Its column is sum / span, counted from ZS_TINY_SIDE left of the top
 * vertex, so that sum is positive. Each product is below 2^29.1. */
struct side {
    uint32_t sum, span, step;
};

/* Set up a side along an edge (dx, dy) whose upper end is x right of the sample in column 0 and off
 * above the samples of the first row. */
static inline struct side side_of(int32_t x, int32_t off, int32_t dx, int32_t dy)
{
    const uint32_t span = (uint32_t)dy * ZS_SUBPX_ONE;
    const struct side s = { (uint32_t)(x * dy + off * dx) + span - 1u, span,
                            (uint32_t)dx * ZS_SUBPX_ONE };
    return s;
}

#if ZS_RP2040

#define FROM_SIO(at) "[%[sio], #" #at "]\n\t"
#define DIVIDE(side)                                                                               \
    "str %[" #side "], " FROM_SIO(0x60) "str %[" #side "_span], " FROM_SIO(0x64) /* operands */    \
        "add %[" #side "], %[" #side "_step]\n\t"

/* Find the spans of the next n > 0 rows by SIO's divider, whose quotient can be read after eight
 * cycles: 31 cycles a row. */
static inline struct zs_cut *sides_cut(struct zs_cut *cut, int32_t n, int32_t from,
                                       struct side *left, struct side *right)
{
    struct zs_cut *const end = cut + n;
    uint32_t column;
    __asm__ volatile(
        ".syntax unified\n"
        "1:\n\t" DIVIDE(left) "b 2f\n2:\tb 2f\n2:\tb 2f\n2:\tnop\n\t" /* seven cycles */
                              "ldr %[column], " FROM_SIO(0x70)
                                  DIVIDE(right) "add %[column], %[from]\n\t"
                                                "strh %[column], [%[cut]]\n\t"
                                                "b 2f\n2:\tb 2f\n2:\t"
                                                "ldr %[column], " FROM_SIO(
                                                    0x70) "add %[column], %[from]\n\t"
                                                          "strh %[column], [%[cut], #2]\n\t"
                                                          "adds %[cut], #4\n\t"
                                                          "cmp %[cut], %[end]\n\t"
                                                          "bne 1b"
        : [cut] "+l"(cut), [left] "+l"(left->sum), [right] "+l"(right->sum), [column] "=&l"(column)
        : [sio] "l"(0xd0000000u), [left_span] "l"(left->span), [right_span] "l"(right->span),
          [left_step] "h"(left->step), [right_step] "h"(right->step), [from] "h"(from),
          [end] "h"(end)
        : "cc", "memory");
    return cut;
}

#else

/* Find the spans of the next n rows. */
static inline struct zs_cut *sides_cut(struct zs_cut *cut, int32_t n, int32_t from,
                                       struct side *left, struct side *right)
{
    for (struct zs_cut *const end = cut + n; cut != end; cut++) {
        /* a horizontal edge has no rows */
        ZS_FACT(left->span >= ZS_SUBPX_ONE && right->span >= ZS_SUBPX_ONE);
        cut->x0 = (int16_t)(from + (int32_t)(left->sum / left->span));
        cut->x1 = (int16_t)(from + (int32_t)(right->sum / right->span));
        left->sum += left->step;
        right->sum += right->step;
    }
    return cut;
}

#endif

ZS_IN_ORDER static ZS_NOINLINE int tiny_cuts(struct zs_job *job, int32_t row)
{
    const struct zs_geom *g = &job->geom;
    const int32_t end = job->cut_end;
    if (!g->tiny)
        return 0;
    const int32_t ax = job->v[0]->x, ay = job->v[0]->y, from = (ax >> ZS_SUBPX_BITS) - ZS_TINY_SIDE;
    const int32_t x = ax - ZS_SUBPX_HALF - from * ZS_SUBPX_ONE,
                  off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - ay;
    const int32_t upper = zs_max32(zs_min32(job->row_mid, end) - row,
                                   0); /* rows above the middle vertex */
    struct side left = side_of(x, off, g->dx2, g->dy2), right = side_of(x, off, g->dx1, g->dy1);
    struct zs_cut *const cut = ZS_RP2040 && upper <= 0
                                   ? job->cut
                                   : sides_cut(job->cut, upper, from, &left, &right);
    const int32_t lower = end - row - upper, down = off + upper * ZS_SUBPX_ONE;
    if (lower <= 0)
        return 1;
    if (job->mid_right)
        right = side_of(x + g->dx1, down - g->dy1, g->dx2 - g->dx1, g->dy2 - g->dy1);
    else
        left = side_of(x + g->dx2, down - g->dy2, g->dx1 - g->dx2, g->dy1 - g->dy2);
    (void)sides_cut(cut, lower, from, &left, &right);
    return 1;
}

const struct zs_fast zs_fast_edges = { .edges = ZS_DIVIDES || ZS_RP2040 ? tiny_cuts : 0 };
