/* What the proofs take as given, tried: every argument where that can be done, else every combination of the edges of
 * the ranges and as many drawn at random as COUNT says. Built with UBSan and with ZS_FACT and ZS_ASSERT trapping, so
 * each call tries the facts that stand in what it calls.
 *
 * SPDX-License-Identifier: MIT
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/edges.c"
#include "core/raster.c"

#include "core/plane.c"

#include "../../../sim/reference/prng.h"
#include "facts.h"

static int failed;

void tell(const char *name, uint64_t n, int good, const char *what)
{
    printf(good ? "ok fact_%s: %" PRIu64 " %s\n" : "FAILED fact_%s: %" PRIu64 " %s\n", name, n, what);
    failed |= !good;
}

/* zs_recip in 64 bits, step by step: what must fit 32 bits does. Its own arithmetic is under UBSan besides. */
static void recip_all(void)
{
    int good = 1;
    uint64_t n = 0;
    for (uint64_t a = (uint64_t)1 << 31; a >> 32 == 0; a++, n++)
        good &= zs_recip((uint32_t)a) >> 31;
    tell("recip", n, good, "arguments, every one: no overflow, a result of 32 bits");
}

static void clz_all(void)
{
    int good = 1;
    for (uint32_t v = 1; v; v++)
        good &= v << zs_clz32(v) >> 31;
    tell("normalised", UINT32_MAX, good, "numbers, every one: v << leading zeros is at least 2^31");
}

static struct prng prng;

static int32_t in(int32_t lo, int32_t hi)
{
    return prng_range(&prng, lo, hi);
}

/* Near the ends of a range, near a power of two, or anywhere. */
static int32_t drawn(int32_t lo, int32_t hi)
{
    const uint32_t how = (uint32_t)prng_next(&prng) & 7u;
    int64_t v = in(lo, hi);
    if (how == 0)
        v = (int64_t)lo + in(0, 3);
    else if (how == 1)
        v = (int64_t)hi - in(0, 3);
    else if (how < 5)
        v = ((int64_t)1 << in(0, 22)) * (how == 2 && lo < 0 ? -1 : 1) + in(-2, 2);
    return v < lo ? lo : v > hi ? hi : (int32_t)v;
}

/* Remainders of edges below their divisors: edge_columns against the columns found one by one in 64 bits. */
static void edges_drawn(uint64_t count)
{
    int good = 1;
    for (uint64_t i = 0; i < count; i++) {
        const int32_t most = (1 << ZS_EXTENT_BITS) - 1;
        const int32_t y = drawn(-(int32_t)ZS_GUARD_SUBPX, (int32_t)ZS_GUARD_SUBPX);
        struct zs_vertex a = { drawn(-(int32_t)ZS_GUARD_SUBPX, (int32_t)ZS_GUARD_SUBPX), y, 0 };
        struct zs_vertex b = { zs_min32(zs_max32(a.x + drawn(-most, most), -(int32_t)ZS_GUARD_SUBPX),
                                        (int32_t)ZS_GUARD_SUBPX),
                               y + drawn(1, most), 0 };
        const int32_t first = zs_first_sample(a.y), last = zs_first_sample(b.y);
        if (first >= last)
            continue;
        const int32_t row = drawn(first, last - 1), n = zs_min32(last - row, ZS_CUT_ROWS);
        int16_t out[2 * ZS_CUT_ROWS];
        edge_columns(out, n, &a, &b, row);
        const int64_t dx = (int64_t)b.x - a.x, dy = (int64_t)b.y - a.y;
        for (int32_t k = 0; k < n; k++) {
            const int64_t right = (int64_t)(a.x - 128) * dy + ((int64_t)(row + k) * 256 + 128 - a.y) * dx,
                          span = 256 * dy;
            const int64_t column = right / span + (right % span > 0);
            good &= out[2 * k] == column;
        }
    }
    tell("edges", count, good, "edges drawn: columns as in 64 bits, remainders below their divisors");
}

/* Planes of triangles: sides, geometry and gradients; tiny's high word, a small one's area, gradients of 2^30. */
static void planes_drawn(uint64_t count)
{
    static struct zs_renderer r;
    static struct zs_job job;
    uint64_t n = 0;
    int good = 1;
    r.config.width = 320;
    r.config.height = 240;
    job.r = &r;
    job.width = job.pitch = 320;
    job.bottom = 240;
    for (uint64_t i = 0; i < count; i++) {
        const int32_t reach = (int32_t)1 << in(4, 21);
        struct zs_vertex v[3];
        for (int k = 0; k < 3; k++) {
            v[k].x = drawn(-reach, reach);
            v[k].y = drawn(-reach, reach);
            v[k].d = (uint32_t)drawn(0, INT32_MAX) * 2u + ((uint32_t)prng_next(&prng) & 1u);
        }
        int top = 0; /* of two the left one */
        for (int k = 1; k < 3; k++)
            if (v[k].y < v[top].y || (v[k].y == v[top].y && v[k].x < v[top].x))
                top = k;
        const struct zs_vertex *const a = &v[top], *b = &v[(top + 1) % 3], *c = &v[(top + 2) % 3];
        const int64_t area = ((int64_t)b->x - a->x) * ((int64_t)c->y - a->y) -
                             ((int64_t)c->x - a->x) * ((int64_t)b->y - a->y);
        if (area == 0)
            continue;
        if (area < 0) { /* clockwise */
            const struct zs_vertex *const other = b;
            b = c;
            c = other;
        }
        zs_plane_sides(&job, a, b, c);
        good &= job.geom.area == (area < 0 ? -area : area);
        struct zs_plane plane;
        struct zs_plane64 wide;
        zs_plane_geom(&job);
        zs_plane32(&job.geom, v[0].d, v[1].d, v[2].d, i & 1 ? ZS_PLANE_KEY : ZS_PLANE_WIDE, &plane);
        zs_plane64(&job.geom, v[0].d, v[1].d, v[2].d, &wide);
        n++;
    }
    tell("planes", n, good && n > count / 2, "triangles drawn: area, high word and gradients within their bounds");
}

/* Products and quotients of 128 bits against the compiler's. */
static void wide_drawn(uint64_t count)
{
    int good = 1;
    for (uint64_t i = 0; i < count; i++) {
        const int down = in(0, 63);
        const uint64_t a = ((uint64_t)(uint32_t)prng_next(&prng) << 32 | (uint32_t)prng_next(&prng)) >> down;
        const uint64_t b = ((uint64_t)(uint32_t)prng_next(&prng) << 32 | (uint32_t)prng_next(&prng)) >> in(0, 63);
        const uint64_t d = (((uint64_t)(uint32_t)prng_next(&prng) << 32 | (uint32_t)prng_next(&prng)) >> in(0, 63)) |
                           1u;
        const unsigned __int128 product = (unsigned __int128)a * b;
        if (product / d <= UINT64_MAX)
            good &= zs_muldiv_u64(a, b, d) == (uint64_t)(product / d);
        const int n = in(0, 127);
        if (a <= INT64_MAX && product >> n <= INT64_MAX) {
            good &= zs_mulshift_s64((int64_t)a, b, n) == (int64_t)(product >> n);
            good &= zs_mulshift_s64(-(int64_t)a, b, n) == -(int64_t)(product >> n);
        }
        const int32_t p[6] = { drawn(-70000, 70000), drawn(-70000, 70000), drawn(-70000, 70000), drawn(-70000, 70000),
                               drawn(-70000, 70000), drawn(-70000, 70000) };
        uint32_t too_wide;
        int32_t at[6];
        const int32_t area = zs_area_short(at, p, p + 2, p + 4, &too_wide);
        if (!too_wide)
            good &= area == (int64_t)(p[2] - p[0]) * (p[5] - p[1]) - (int64_t)(p[4] - p[0]) * (p[3] - p[1]);
    }
    tell("wide", count, good, "quotients, shifted products and areas as in 128 bits");
}

int main(int argc, char **argv)
{
    const uint64_t count = argc > 1 ? strtoull(argv[1], 0, 0) : 10000000u;
    recip_all();
    clz_all();
    prng.state = 1;
    edges_drawn(count);
    planes_drawn(count);
    wide_drawn(count);
    facts_more(count);
    facts_drawn(count);
    return failed;
}
