/* Polygons cut into triangles: as many as there should be, none turned over, every point of the inside in exactly one.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "polygon.h"

#define CORNERS_MAX 80

struct polygon {
    double p[CORNERS_MAX][2];
    uint32_t n, tri[CORNERS_MAX][3];
};

static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* On a plane of its own: two directions that are square to each other, and a distance. */
static void cut(struct polygon *g, const double u[3], const double v[3])
{
    double point[CORNERS_MAX][3];
    for (uint32_t i = 0; i < g->n; i++)
        for (int k = 0; k < 3; k++)
            point[i][k] = 7.0 * (k + 1) + g->p[i][0] * u[k] + g->p[i][1] * v[k];
    sim_polygon_cut((const double (*)[3])point, g->n, g->tri);
}

static double area(const struct polygon *g)
{
    double sum = 0.0;
    for (uint32_t i = 1; i + 1 < g->n; i++)
        sum += turn(g->p[0], g->p[i], g->p[i + 1]);
    return sum;
}

/* Whether a ray from a point crosses the outline an odd number of times. */
static int inside(const struct polygon *g, const double at[2])
{
    int odd = 0;
    for (uint32_t i = 0; i < g->n; i++) {
        const double *a = g->p[i], *b = g->p[(i + 1) % g->n];
        if ((a[1] > at[1]) != (b[1] > at[1]) &&
            at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
            odd = !odd;
    }
    return odd;
}

static int covered(const struct polygon *g, const double at[2])
{
    int times = 0;
    for (uint32_t t = 0; t + 2 < g->n; t++) {
        const double *a = g->p[g->tri[t][0]], *b = g->p[g->tri[t][1]], *c = g->p[g->tri[t][2]];
        times += turn(a, b, at) > 0.0 && turn(b, c, at) > 0.0 && turn(c, a, at) > 0.0;
    }
    return times;
}

/* Triangles that keep the polygon's sense and add up to its area, and points in as many of them as they should be. */
static int check(struct prng *rng, const struct polygon *g)
{
    double sum = 0.0;
    for (uint32_t t = 0; t + 2 < g->n; t++) {
        const double twice = turn(g->p[g->tri[t][0]], g->p[g->tri[t][1]], g->p[g->tri[t][2]]);
        CASE_CHECK(twice >= 0.0);
        sum += twice;
    }
    CASE_CHECK(fabs(sum - area(g)) < 1e-9 * area(g));
    for (int i = 0; i < 200; i++) {
        double at[2];
        for (int k = 0; k < 2; k++)
            at[k] = prng_range(rng, -1200, 1200) / 1000.0 + (k + 1) * 1.7e-5; /* on no diagonal */
        CASE_CHECK(covered(g, at) == inside(g, at));
    }
    return 1;
}

/* Around a point, at random distances: simple, with corners that turn inwards. */
static void star(struct prng *rng, struct polygon *g)
{
    g->n = (uint32_t)prng_range(rng, 4, CORNERS_MAX);
    for (uint32_t i = 0; i < g->n; i++) {
        const double angle = 6.283185307179586 * i / g->n, r = prng_range(rng, 50, 1000) / 1000.0;
        g->p[i][0] = r * cos(angle);
        g->p[i][1] = r * sin(angle);
    }
}

/* A ring: an outline, and a hole that a seam joins to it, whose two corners come twice. */
static void ring(struct prng *rng, struct polygon *g)
{
    const uint32_t half = (uint32_t)prng_range(rng, 3, CORNERS_MAX / 2 - 1);
    const double hole = prng_range(rng, 300, 450) / 1000.0; /* within the outline, a triangle too */
    g->n = 0;
    for (uint32_t i = 0; i <= half; i++) {
        const double angle = 6.283185307179586 * (i % half) / half;
        g->p[g->n][0] = cos(angle);
        g->p[g->n++][1] = sin(angle);
    }
    for (uint32_t i = 0; i <= half; i++) {
        const double angle = 6.283185307179586 * ((half - i) % half) / half;
        g->p[g->n][0] = hole * cos(angle);
        g->p[g->n++][1] = hole * sin(angle);
    }
}

static int cut_any(uint64_t seed, void (*make)(struct prng *rng, struct polygon *g))
{
    static const double planes[6][2][3] = { { { 1, 0, 0 }, { 0, 1, 0 } },  { { 0, 1, 0 }, { 1, 0, 0 } },
                                            { { 0, 1, 0 }, { 0, 0, 1 } },  { { 0, 0, 1 }, { 1, 0, 0 } },
                                            { { 0.6, 0.8, 0 }, { 0, 0, 1 } }, { { 0.6, 0, 0.8 }, { -0.8, 0, 0.6 } } };
    struct prng rng = { seed };
    struct polygon g;
    make(&rng, &g);
    const uint32_t plane = seed % 6;
    cut(&g, planes[plane][0], planes[plane][1]);
    return check(&rng, &g);
}

static int stars(uint64_t seed)
{
    return cut_any(seed, star);
}

static int rings(uint64_t seed)
{
    return cut_any(seed, ring);
}

/* What was cut right as a fan stays one: the files and numbers of triangles do not change. */
static void convex_is_a_fan(void **state)
{
    (void)state;
    const double u[3] = { 1, 0, 0 }, v[3] = { 0, 0, 1 };
    struct polygon g = { .n = 7 };
    for (uint32_t i = 0; i < g.n; i++) {
        g.p[i][0] = cos(6.283185307179586 * i / g.n);
        g.p[i][1] = sin(6.283185307179586 * i / g.n);
    }
    cut(&g, u, v);
    for (uint32_t t = 0; t + 2 < g.n; t++) {
        assert_int_equal(g.tri[t][0], 0);
        assert_int_equal(g.tri[t][1], t + 1);
        assert_int_equal(g.tri[t][2], t + 2);
    }
}

/* An arrow whose notch is at the corner that a fan does not begin at. */
static void quad_with_a_notch(void **state)
{
    (void)state;
    const double u[3] = { 1, 0, 0 }, v[3] = { 0, 1, 0 };
    struct polygon g = { .n = 4, .p = { { 0, 0 }, { 1, 0 }, { 0.2, 0.2 }, { 0, 1 } } };
    for (int turned = 0; turned < 4; turned++) {
        cut(&g, u, v);
        for (uint32_t t = 0; t < 2; t++)
            assert_true(turn(g.p[g.tri[t][0]], g.p[g.tri[t][1]], g.p[g.tri[t][2]]) > 0.0);
        const double first[2] = { g.p[0][0], g.p[0][1] };
        for (int i = 0; i < 3; i++)
            memcpy(g.p[i], g.p[i + 1], sizeof first);
        memcpy(g.p[3], first, sizeof first);
    }
}

/* Corners on straight sides, from each corner on: a triangle without an area would leave a gap where the neighbour has
 * that corner. */
static void straight_sides(void **state)
{
    (void)state;
    const double u[3] = { 1, 0, 0 }, v[3] = { 0, 1, 0 };
    static const struct polygon of[4] = {
        { .n = 4, .p = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 0, 0.5 } } },
        { .n = 8, .p = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 2, 2 }, { 1, 2 }, { 0, 2 }, { 0, 1 } } },
        { .n = 7, .p = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 3, 3 }, { 2, 2 }, { 1, 1 } } },
        { .n = 8, .p = { { 0, 0 }, { 2, 0 }, { 4, 0 }, { 4, 4 }, { 2, 4 }, { 2, 3 }, { 2, 2 }, { 0, 2 } } } };
    for (int i = 0; i < 4; i++)
        for (uint32_t first = 0; first < of[i].n; first++) {
            struct polygon g = { .n = of[i].n };
            for (uint32_t k = 0; k < g.n; k++)
                memcpy(g.p[k], of[i].p[(first + k) % g.n], sizeof g.p[k]);
            cut(&g, u, v);
            double sum = 0.0;
            for (uint32_t t = 0; t + 2 < g.n; t++) {
                const double twice = turn(g.p[g.tri[t][0]], g.p[g.tri[t][1]], g.p[g.tri[t][2]]);
                assert_true(twice > 0.0);
                sum += twice;
            }
            assert_true(sum == area(&g));
        }
}

/* A polygon that crosses itself, one without an area, one point: triangles of its corners, and an end. */
static void no_polygon(void **state)
{
    (void)state;
    const double u[3] = { 1, 0, 0 }, v[3] = { 0, 1, 0 };
    struct polygon of[3] = { { .n = 5, .p = { { 0, 1 }, { 0.6, -0.8 }, { -1, 0.3 }, { 1, 0.3 }, { -0.6, -0.8 } } },
                             { .n = 4, .p = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0.5, 0.5 } } },
                             { .n = 6 } };
    for (int i = 0; i < 3; i++) {
        cut(&of[i], u, v);
        for (uint32_t t = 0; t + 2 < of[i].n; t++)
            for (int k = 0; k < 3; k++)
                assert_true(of[i].tri[t][k] < of[i].n && of[i].tri[t][k] != of[i].tri[t][(k + 1) % 3]);
    }
}

static const struct CMUnitTest tests[] = {
    CASES_TEST(stars, stars, 400),
    CASES_TEST(rings, rings, 400),
    cmocka_unit_test(convex_is_a_fan),
    cmocka_unit_test(quad_with_a_notch),
    cmocka_unit_test(straight_sides),
    cmocka_unit_test(no_polygon),
};
CASES_MAIN(tests)
