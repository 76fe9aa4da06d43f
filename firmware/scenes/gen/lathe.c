/* Turned forms: Catmull-Rom profiles, exact over small denominators.
 *
 * SPDX-License-Identifier: MIT
 */
#include "lathe.h"

#include <string.h>

struct at_row {
    int64_t r, y;   /* steps */
    int64_t nr, ny; /* the normal, any length */
};

/* The point a / n of the way between p[1] and p[2]: twice n^3 times the polynomial; below, n^2 times twice its
 * derivative. Beyond an end of the profile the end itself is taken; n <= 255, |p| < 2^15: sums below 2^45. */
static int64_t curve(const int64_t p[4], int64_t a, int64_t n)
{
    const int64_t c3 = -p[0] + 3 * p[1] - 3 * p[2] + p[3], c2 = 2 * p[0] - 5 * p[1] + 4 * p[2] - p[3];
    return c3 * a * a * a + c2 * a * a * n + (p[2] - p[0]) * a * n * n + 2 * p[1] * n * n * n;
}

static int64_t slope(const int64_t p[4], int64_t a, int64_t n)
{
    const int64_t c3 = -p[0] + 3 * p[1] - 3 * p[2] + p[3], c2 = 2 * p[0] - 5 * p[1] + 4 * p[2] - p[3];
    return 3 * c3 * a * a + 2 * c2 * a * n + (p[2] - p[0]) * n * n;
}

static struct at_row row_at(const struct lathe_point *point, int n_points, int k, int64_t a, int64_t n)
{
    int64_t r[4], y[4];
    for (int i = 0; i < 4; i++) {
        const int at = k + i - 1;
        const struct lathe_point *p = &point[at < 0 ? 0 : at >= n_points ? n_points - 1 : at];
        r[i] = p->r;
        y[i] = p->y;
    }
    const int64_t den = 2 * n * n * n;
    struct at_row out = { gen_div(curve(r, a, n) * LATHE_STEPS, den), gen_div(curve(y, a, n) * LATHE_STEPS, den),
                          -slope(y, a, n), slope(r, a, n) };
    if (out.r <= 0) /* a pole, where the curve leaves or meets the axis */
        out.r = out.nr = 0;
    return out;
}

static uint32_t ring(struct gen_mesh *m, const struct at_row *row, int64_t sides, const int64_t at[3],
                     struct gen_rgb rgb)
{
    const uint32_t first = m->n_verts;
    for (int64_t i = 0; i < sides; i++) {
        const int64_t c = gen_cos(i * 65536 / sides), s = gen_sin(i * 65536 / sides);
        const int64_t pos[3] = { at[0] * LATHE_STEPS + gen_div(row->r * c, GEN_Q30), at[1] * LATHE_STEPS + row->y,
                                 at[2] * LATHE_STEPS + gen_div(row->r * s, GEN_Q30) };
        int64_t normal[3] = { row->nr, row->ny, 0 };
        gen_unit(normal, (int64_t)1 << 15);
        normal[2] = normal[0] * s;
        normal[0] *= c;
        normal[1] *= GEN_Q30;
        gen_vert_normal(m, pos, normal, rgb);
        if (row->r == 0)
            break;
    }
    return first;
}

/* Faces between a ring and the one below it; a ring of one vertex is a pole. */
static void band(struct gen_mesh *m, uint32_t upper, uint32_t lower, uint32_t end, uint32_t sides, struct gen_rgb rgb)
{
    for (uint32_t i = 0; i < sides; i++) {
        const uint32_t j = (i + 1) % sides;
        if (lower - upper > 1)
            gen_tri(m, upper + i, upper + j, end - lower > 1 ? lower + i : lower, rgb);
        if (end - lower > 1)
            gen_tri(m, lower + i, lower - upper > 1 ? upper + j : upper, lower + j, rgb);
    }
}

void lathe_at(struct gen_mesh *m, const struct lathe_point *point, int n_points, int64_t sides, const int64_t at[3])
{
    uint32_t upper = 0;
    for (int k = 0; k + 1 < n_points; k++) {
        const int another = k == 0 || memcmp(&point[k].color, &point[k - 1].color, sizeof point[k].color);
        for (int64_t a = another ? 0 : 1; a <= point[k].rows;
             a++) { /* another colour: a ring of its own, in the same place */
            const struct at_row row = row_at(point, n_points, k, a, point[k].rows);
            const uint32_t lower = ring(m, &row, sides, at, point[k].color);
            if (a)
                band(m, upper, lower, m->n_verts, (uint32_t)sides, point[k].color);
            upper = lower;
        }
    }
}

void lathe(struct gen_mesh *m, const struct lathe_point *point, int n_points, int64_t sides)
{
    static const int64_t origin[3] = { 0, 0, 0 };
    lathe_at(m, point, n_points, sides, origin);
}
