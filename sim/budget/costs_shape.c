/* A triangle's rows and spans in a strip, found from its corners, whatever way it is drawn; their pixels must be as
 * many as the renderer says.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "core/job.h"
#include "costs_look.h"

/* The first sample at or beyond an edge from a to b, at the middle of a row; exact. */
static int32_t column(const struct zs_vertex *a, const struct zs_vertex *b, int32_t row)
{
    const int64_t dy = b->y - a->y, at = (int64_t)row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;
    const int64_t top = (int64_t)(b->x - a->x) * at + (int64_t)(a->x - ZS_SUBPX_HALF) * dy, by = dy * ZS_SUBPX_ONE;
    return (int32_t)(top >= 0 ? (top + by - 1) / by : -(-top / by));
}

/* Rows of the edge from a down to b in [row, end), cut ZS_CUT_ROWS at a time from `first` on, as zs_edges_cut does
 * it. */
static void look_edge(struct shape *s, const struct zs_vertex *a, const struct zs_vertex *b, int32_t first, int32_t row,
                      int32_t end)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    while (row < end) {
        const int below = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y >= ZS_SUBPX_ONE, wide = dy >= 128 * ZS_SUBPX_ONE;
        s->edges++;
        s->divided += (zs_abs32(dx) > dy) + (below && !wide);
        s->divided64 += below && wide;
        row += ZS_CUT_ROWS - (row - first) % ZS_CUT_ROWS;
    }
}

void sim_look_shape(struct shape *s, const struct zs_job *job)
{
    const struct zs_vertex *v[3];
    int32_t lo[2] = { INT32_MAX, INT32_MAX }, hi[2] = { INT32_MIN, INT32_MIN };
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 3; k++) {
        v[k] = &job->r->vert[job->tri->v[k]];
        lo[0] = zs_min32(lo[0], v[k]->x);
        lo[1] = zs_min32(lo[1], v[k]->y);
        hi[0] = zs_max32(hi[0], v[k]->x);
        hi[1] = zs_max32(hi[1], v[k]->y);
    }
    s->tilted = v[0]->d != v[1]->d || v[0]->d != v[2]->d;
    const int32_t first = zs_max32(zs_first_sample(lo[1]), job->y0);
    const int32_t end = zs_min32(zs_first_sample(hi[1]), job->y1);
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *a = v[k], *b = v[(k + 1) % 3];
        const int down = a->y <= b->y;
        look_edge(s, down ? a : b, down ? b : a, first, zs_max32(first, zs_first_sample(down ? a->y : b->y)),
                  zs_min32(end, zs_first_sample(down ? b->y : a->y)));
    }
    for (int32_t row = first; row < end; row++) {
        int32_t x[2], n = 0;
        for (int k = 0; k < 3 && n < 2; k++) {
            const struct zs_vertex *a = v[k], *b = v[(k + 1) % 3];
            if (a->y > b->y) {
                const struct zs_vertex *t = a;
                a = b;
                b = t;
            }
            if (zs_first_sample(a->y) <= row && row < zs_first_sample(b->y))
                x[n++] = column(a, b, row);
        }
        s->rows++;
        if (n < 2)
            continue;
        const int32_t from = zs_max32(zs_min32(x[0], x[1]), 0), to = zs_min32(zs_max32(x[0], x[1]), job->width);
        if (from < to) {
            s->spans++;
            s->px += to - from;
        }
    }
}
