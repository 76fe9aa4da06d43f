/* Columns of a triangle's rows: core/edges.c, and fast/fast_edges.c where it takes one, against exact ones.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "core/edges.h"
#include "core/fast.h"
#include "core/plane.h"
#include "zs_fast.h"

#define GUARD (8188 * 256)
#define SIDE 4096 /* rows and columns of the frame */

static uint64_t rows_compared, cut_fast; /* of those, by fast/fast_edges.c */

/* ---- Exact ----------------------------------------------------------------------------------- */

/* First column whose sample is at or right of the edge between two corners, in a row whose samples are between them. */
static int32_t column_of(const struct zs_vertex *a, const struct zs_vertex *b, int32_t row)
{
    const int64_t dy = (int64_t)b->y - a->y, off = (int64_t)row * 256 + 128 - a->y;
    const int64_t above = ((int64_t)a->x - 128) * dy + off * ((int64_t)b->x - a->x), below = 256 * dy;
    return (int32_t)(above / below + (above % below > 0)); /* dy > 0; rounded up */
}

/* The span of a row of a triangle whose corners come from the top down. */
static void exact(int32_t out[2], const struct zs_vertex *const v[3], int32_t row)
{
    const int lower = row * 256 + 128 >= v[1]->y;
    const int32_t along = column_of(v[0], v[2], row), other = column_of(v[lower], v[1 + lower], row);
    out[0] = along < other ? along : other;
    out[1] = along < other ? other : along;
}

/* ---- Triangles ------------------------------------------------------------------------------- */

static int64_t area_of(const struct zs_vertex v[3])
{
    return ((int64_t)v[1].x - v[0].x) * ((int64_t)v[2].y - v[0].y) -
           ((int64_t)v[2].x - v[0].x) * ((int64_t)v[1].y - v[0].y);
}

static int32_t held(int64_t c)
{
    const int64_t middle = SIDE * 128;
    return (int32_t)(c < middle - GUARD ? middle - GUARD : c > middle + GUARD ? middle + GUARD : c);
}

/* Of all sizes; corners on samples, level edges, slivers. */
static void triangle(struct prng *p, struct zs_vertex v[3])
{
    const int32_t reach = 16 << prng_pick(p, 18), x = prng_range(p, 0, SIDE * 256), y = prng_range(p, 0, SIDE * 256);
    const uint32_t kind = prng_pick(p, 6);
    for (int k = 0; k < 3; k++) {
        v[k].x = held((int64_t)x + prng_range(p, -reach, reach));
        v[k].y = held((int64_t)y + prng_range(p, -reach, reach));
        v[k].d = 0;
        if (kind == 0) {
            v[k].x = (v[k].x & ~255) + 128;
            v[k].y = (v[k].y & ~255) + 128;
        }
    }
    if (kind == 1)
        v[1].y = v[prng_pick(p, 2) * 2].y;
    if (kind == 2)
        v[1].x = v[0].x;
    if (kind == 3) { /* beside the line between the other two */
        const int64_t t = prng_range(p, 0, 65536);
        v[2].x = held(v[0].x + (v[1].x - v[0].x) * t / 65536 + prng_range(p, -1, 1));
        v[2].y = held(v[0].y + (v[1].y - v[0].y) * t / 65536 + prng_range(p, -1, 1));
    }
    if (area_of(v) < 0) {
        const struct zs_vertex keep = v[1];
        v[1] = v[2];
        v[2] = keep;
    }
}

static int above(const struct zs_vertex *a, const struct zs_vertex *b)
{
    return a->y < b->y || (a->y == b->y && a->x < b->x);
}

/* ---- Rows ------------------------------------------------------------------------------------ */

static int rows_right(const struct zs_job *job, const struct zs_vertex *const down[3], const char *what)
{
    for (int32_t row = job->row; row < job->cut_end; row++) {
        const struct zs_cut *cut = &job->cut[row - job->row];
        int32_t want[2];
        exact(want, down, row);
        if (cut->x0 != want[0] || cut->x1 != want[1])
            return case_wrong("%s: row %d is [%d, %d), not [%d, %d): (%d %d) (%d %d) (%d %d)", what, row, cut->x0,
                              cut->x1, want[0], want[1], down[0]->x, down[0]->y, down[1]->x, down[1]->y, down[2]->x,
                              down[2]->y);
    }
    return 1;
}

/* Rows [y0, y1) of a triangle, some at a time. */
static int edges_right(struct zs_job *job, const struct zs_vertex *const down[3], int32_t y0, int32_t y1)
{
    const int32_t first = zs_first_sample(down[0]->y), last = zs_first_sample(down[2]->y);
    job->row_mid = zs_first_sample(down[1]->y);
    job->tri_end = last;
    job->row_end = last < y1 ? last : y1;
    for (int32_t row = first > y0 ? first : y0; row < job->row_end; row = job->cut_end) {
        struct zs_renderer *r = job->r;
        r->edges = NULL;
        zs_edges_cut(job, row);
        CASE_CHECK(job->row == row && job->cut_end > row);
        CASE_CHECK(job->cut_end <= row + ZS_CUT_ROWS && job->cut_end <= job->row_end);
        if (!rows_right(job, down, "core/edges.c"))
            return 0;
        rows_compared += (uint64_t)(job->cut_end - row);
        memset(job->cut, 0x55, sizeof job->cut);
        const int taken = zs_fast_edges.edges && zs_fast_edges.edges(job, row);
        CASE_CHECK(taken == (ZS_DIVIDES && job->geom.tiny));
        if (taken && !rows_right(job, down, "fast/fast_edges.c"))
            return 0;
        cut_fast += taken ? (uint64_t)(job->cut_end - row) : 0;
        r->edges = zs_fast_edges.edges; /* the one, or the other where it declines */
        zs_edges_cut(job, row);
        if (!rows_right(job, down, "either"))
            return 0;
    }
    return 1;
}

static int edges_case(uint64_t seed)
{
    static struct zs_renderer r;
    static struct zs_job job;
    struct prng p = { seed };
    struct zs_vertex v[3];
    const struct zs_vertex *down[3] = { &v[0], &v[1], &v[2] };
    triangle(&p, v);
    if (area_of(v) == 0)
        return 1;
    int top = 0;
    for (int k = 1; k < 3; k++)
        top = above(&v[k], &v[top]) ? k : top;
    for (int k = 0; k < 3; k++)
        for (int m = 0; m < 2; m++)
            if (above(down[m + 1], down[m])) {
                const struct zs_vertex *const keep = down[m];
                down[m] = down[m + 1];
                down[m + 1] = keep;
            }
    memset(&job, 0, sizeof job);
    job.r = &r;
    zs_plane_sides(&job, &v[top], &v[(top + 1) % 3], &v[(top + 2) % 3]);
    const int32_t y0 = prng_pick(&p, 2) ? 0 : prng_range(&p, 0, SIDE - 1);
    return edges_right(&job, down, y0, prng_pick(&p, 2) ? SIDE : prng_range(&p, y0 + 1, SIDE));
}

static void columns_are_exact(void **state)
{
    rows_compared = cut_fast = 0;
    CASES(edges_case, 60000);
    print_message("%llu rows, %llu by divisions\n", (unsigned long long)rows_compared, (unsigned long long)cut_fast);
    assert_true(!cases_all() || (rows_compared > 1000000 && cut_fast > 100000));
}

static const struct CMUnitTest tests[] = { cmocka_unit_test(columns_are_exact) };

CASES_MAIN(tests)
