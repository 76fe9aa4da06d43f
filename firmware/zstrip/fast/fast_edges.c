/* Spans of tiny triangles, both sides in one loop, with a division for each side and row, for cores
 * with a divide instruction (compare core/edges.c).
 *
 * SPDX-License-Identifier: MIT
 */
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

/* Find the spans of the next n rows. */
static inline struct zs_cut *sides_cut(struct zs_cut *cut, int32_t n, int32_t from,
                                       struct side *left, struct side *right)
{
    for (struct zs_cut *const end = cut + n; cut != end; cut++) {
        ZS_FACT(left->span >= ZS_SUBPX_ONE &&
                right->span >= ZS_SUBPX_ONE); /* a horizontal edge has no rows */
        cut->x0 = (int16_t)(from + (int32_t)(left->sum / left->span));
        cut->x1 = (int16_t)(from + (int32_t)(right->sum / right->span));
        left->sum += left->step;
        right->sum += right->step;
    }
    return cut;
}

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
    struct zs_cut *const cut = sides_cut(job->cut, upper, from, &left, &right);
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

const struct zs_fast zs_fast_edges = { .edges = ZS_DIVIDES ? tiny_cuts : 0 };
