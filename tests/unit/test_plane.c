/* Gradients (core/plane.c) against fractions of 128 bits: of any triangle and any values, each gradient within the
 * error that the head of plane.c proves, and each pixel inside within the sum of its steps.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "internals.h"

typedef __int128 wide;

static wide size_of(wide v)
{
    return v < 0 ? -v : v;
}

static wide floor_of(wide n, wide d)
{
    const wide q = n / d;
    return q - (n % d < 0);
}

static unsigned smalls, larges, tinies, pixels;

/* A triangle as assembly leaves it: the top vertex first, clockwise, of an area. */
static const struct zs_geom *triangle_make(struct zs_job *job, struct prng *p)
{
    static struct zs_vertex v[3];
    const int32_t side = 1 << prng_range(p, 4, 21); /* q24_8: up to 8192 px */
    memset(job, 0, sizeof *job);
    job->width = prng_range(p, 1, 640);
    job->bottom = prng_range(p, 1, 480);
    for (int k = 0; k < 3; k++)
        v[k] = (struct zs_vertex){ .x = prng_range(p, -side / 4, side), .y = prng_range(p, -side / 4, side) };
    const int first = v[1].y < v[0].y || (v[1].y == v[0].y && v[1].x < v[0].x) ? 1 : 0;
    const int top = v[2].y < v[first].y || (v[2].y == v[first].y && v[2].x < v[first].x) ? 2 : first;
    const struct zs_vertex *a = &v[top], *b = &v[(top + 1) % 3], *c = &v[(top + 2) % 3];
    const int64_t area = zs_assemble_area(a, b, c);
    if (area == 0)
        return triangle_make(job, p);
    zs_plane_sides(job, a, area > 0 ? b : c, area > 0 ? c : b);
    zs_plane_geom(job);
    if (job->geom.area != (area > 0 ? area : -area))
        fail_msg("an area of %lld, not %lld", (long long)job->geom.area, (long long)area);
    return &job->geom;
}

/* The values' numerators: what one sub-pixel to the right, and down, changes, times the area. */
static void slopes(wide out[2], const struct zs_job *job, const wide value[3])
{
    const struct zs_vertex *const *v = job->v;
    const wide d1 = value[1] - value[0], d2 = value[2] - value[0];
    out[0] = d1 * (v[2]->y - v[0]->y) - d2 * (v[1]->y - v[0]->y);
    out[1] = d2 * (v[1]->x - v[0]->x) - d1 * (v[2]->x - v[0]->x);
}

/* A pixel whose sample is inside, which the frame has. Return 0: none was found. */
static int pixel_inside(const struct zs_job *job, struct prng *p, int32_t at[2])
{
    const struct zs_vertex *const *v = job->v;
    wide s = prng_pick(p, 1 << 16), t = prng_pick(p, 1 << 16);
    if (s + t > 1 << 16) {
        s = (1 << 16) - s;
        t = (1 << 16) - t;
    }
    at[0] = (int32_t)((v[0]->x + ((v[1]->x - v[0]->x) * s + (v[2]->x - v[0]->x) * t) / 65536) >> 8);
    at[1] = (int32_t)((v[0]->y + ((v[1]->y - v[0]->y) * s + (v[2]->y - v[0]->y) * t) / 65536) >> 8);
    if (at[0] < 0 || at[0] >= job->width || at[1] < 0 || at[1] >= job->bottom)
        return 0;
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *a = v[k], *b = v[(k + 1) % 3];
        const int64_t x = at[0] * 256 + 128, y = at[1] * 256 + 128;
        if ((b->x - a->x) * (y - a->y) - (x - a->x) * (b->y - a->y) < 0)
            return 0;
    }
    return 1;
}

/* Keys and codes (least shift 5: below 2^27), and values of 31 bits. */
static int plane32_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int t = 0; t < 40; t++) {
        static struct zs_job job;
        const struct zs_geom *g = triangle_make(&job, &p);
        const int kind = prng_pick(&p, 2) ? ZS_PLANE_KEY : ZS_PLANE_WIDE;
        const int bits = kind == ZS_PLANE_KEY ? 32 : 31, shift = prng_range(&p, 0, bits - 1);
        const uint32_t at = (uint32_t)prng_next(&p) >> (32 - bits);
        uint32_t u[3];
        wide value[3], n[2], most = 0;
        for (int k = 0; k < 3; k++) { /* near each other, or anywhere */
            u[k] = prng_pick(&p, 2) ? at ^ (uint32_t)prng_next(&p) >> (32 - bits) >> shift : at;
            value[k] = u[k];
            most = value[k] > most ? value[k] : most;
        }
        struct zs_plane got;
        zs_plane32(g, u[0], u[1], u[2], kind, &got);
        slopes(n, &job, value);
        *(g->rcp ? &smalls : &larges) += 1;
        tinies += g->tiny != 0;
        /* ulp, in 1024ths: what plane.c proves; w + h of the frame count where the triangle is large */
        wide limit = g->rcp ? 227 * 1024 : (job.width + job.bottom + 1) * 512;
        if (kind == ZS_PLANE_WIDE && limit < most * 1024 >> 21)
            limit = most * 1024 >> 21;
        for (int k = 0; k < 30; k++) {
            int32_t px[2];
            if (!pixel_inside(&job, &p, px))
                continue;
            const uint32_t is = got.base + got.gx * (uint32_t)(px[0] - g->ia) + got.gy * (uint32_t)(px[1] - g->ja);
            const wide num = value[0] * g->area + n[0] * (px[0] * 256 + 128 - job.v[0]->x) +
                             n[1] * (px[1] * 256 + 128 - job.v[0]->y); /* the value, times the area */
            const wide low = floor_of(num, g->area);
            const wide off = low + (int32_t)(is - (uint32_t)low); /* modulo 2^32 */
            if (size_of(off * g->area - num) * 1024 > limit * g->area)
                return case_wrong("pixel %d, %d: %lld beside the value, of %lld 1024ths", px[0], px[1],
                                  (long long)(off - low), (long long)limit);
            pixels++;
        }
    }
    return 1;
}

/* Of 64 bits: floors of the quotient, to the last bit. */
static int plane64_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int t = 0; t < 60; t++) {
        static struct zs_job job;
        const struct zs_geom *g = triangle_make(&job, &p);
        wide value[3], n[2];
        uint64_t u[3];
        for (int k = 0; k < 3; k++) {
            u[k] = prng_next(&p) >> prng_range(&p, 24, 63);
            value[k] = (wide)u[k];
        }
        slopes(n, &job, value);
        if (size_of(n[0]) >> 63 || size_of(n[1]) >> 63)
            continue; /* wider than a triangle of the guard band and 1/z can be */
        if (g->rcp && (size_of(n[0]) >> 57 || size_of(n[1]) >> 57))
            continue;
        struct zs_plane64 got;
        zs_plane64(g, u[0], u[1], u[2], &got);
        const wide gx = floor_of(n[0] * ((wide)1 << 32), g->area), gy = floor_of(n[1] * ((wide)1 << 32), g->area);
        CASE_CHECK(got.gx == (uint64_t)gx && got.gy == (uint64_t)gy);
        /* the base: at the anchor, short by less than what two floors drop */
        const wide base = value[0] * (1 << 24) + floor_of(gx * g->ax, 256) + floor_of(gy * g->ay, 256);
        const int64_t off = (int64_t)(got.base - (uint64_t)base);
        CASE_CHECK(off >= -1 && off <= 1);
    }
    return 1;
}

static unsigned steep, flat;

/* 256 n / area: within half a unit and 2^-28.4 of it, or too steep to be asked of it. */
static int quotient_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int t = 0; t < 400; t++) {
        const uint32_t area = (1u << prng_range(&p, 0, 29)) + prng_pick(&p, 1u << prng_range(&p, 0, 29));
        const int lz = __builtin_clz(area), least = prng_pick(&p, 2) ? ZS_PLANE_KEY : ZS_PLANE_WIDE;
        const int64_t n = (prng_log(&p) >> 16) + prng_range(&p, -1, 1);
        if (area > 1u << 30 || n > (int64_t)1 << 48 || n < -((int64_t)1 << 48))
            continue;
        const int32_t got = zs_plane_quotient(n, zs_recip(area << lz), lz, least);
        const wide num = (wide)n * 256;
        if (got == ZS_TOO_STEEP)
            CASE_CHECK(size_of(num) * 2 >= ((wide)area << (32 - least)) - area);
        else if (size_of(num - (wide)got * area) * 100 > (wide)area * 50 + (size_of(num) * 76 >> 28))
            return case_wrong("256 * %lld / %u is not %d", (long long)n, area, got);
        CASE_CHECK(got == ZS_TOO_STEEP || size_of(num) < (wide)area << (32 - least));
        *(got == ZS_TOO_STEEP ? &steep : &flat) += 1;
    }
    return 1;
}

/* The middle vertex is to the right of the long edge, or to its left. */
static void sides_are_told_apart(void **state)
{
    static struct zs_job job;
    const struct zs_vertex top = { .x = 0, .y = 0 }, low = { .x = 100, .y = 900 };
    const struct zs_vertex right = { .x = 400, .y = 300 }, left = { .x = -400, .y = 300 };
    zs_plane_sides(&job, &top, &right, &low);
    assert_true(job.mid_right && job.geom.area == 400 * 900 - 100 * 300 && job.geom.tiny);
    zs_plane_sides(&job, &top, &low, &left);
    assert_true(!job.mid_right && job.geom.area == 100 * 300 + 400 * 900);
    const struct zs_vertex far = { .x = ZS_TINY + 1, .y = 300 };
    zs_plane_sides(&job, &top, &far, &low);
    assert_false(job.geom.tiny);
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(pixels_inside, plane32_case, 4000, { "small triangles", &smalls, 20000 },
                 { "large triangles", &larges, 20000 }, { "tiny triangles", &tinies, 10000 },
                 { "pixels", &pixels, 100000 }),
    CASES_TEST(floors_of_64_bits, plane64_case, 2000),
    CASES_COUNTS(quotients, quotient_case, 2000, { "steep ones", &steep, 10000 }, { "others", &flat, 100000 }),
    cmocka_unit_test(sides_are_told_apart),
};
CASES_MAIN(tests)
