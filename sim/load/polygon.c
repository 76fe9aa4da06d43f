/* Polygons to triangles. The page has a twin of this file (sim/web/page/polygon.js): what one of them computes, the
 * other one does in the same order, so that both give the same triangles.
 *
 * SPDX-License-Identifier: MIT
 */
#include "polygon.h"

#include <math.h>
#include <stdlib.h>

#include "sim.h"

/* The polygon on a plane, counter-clockwise: a ring of the corners that are left. */
struct ring {
    double (*at)[2];
    uint32_t *next, *last; /* the corner after and before each one */
    uint8_t *known;        /* enum ear of each */
};

/* Whether a corner is an ear. It is found out once, and anew when a corner beside it has gone: a triangle that holds a
 * corner goes on to hold one that turns inwards (Eberly, Triangulation by ear clipping). */
enum ear { EAR_UNKNOWN, EAR_IS, EAR_NOT };

/* Twice the area of a triangle, > 0 where a, b, c turn left. */
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* Twice the vector of the polygon's area, by the corners' distances from the first one. */
static void area_of(const double (*point)[3], uint32_t n, double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    for (uint32_t i = 1; i + 1 < n; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = point[i][k] - point[0][k];
            b[k] = point[i + 1][k] - point[0][k];
        }
        for (int k = 0; k < 3; k++)
            out[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

/* Leave out the axis along which the area is largest. */
static void flatten(const double (*point)[3], uint32_t n, double (*out)[2])
{
    double area[3];
    area_of(point, n, area);
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(area[k]) > fabs(area[axis]))
            axis = k;
    const int x = (axis + 1) % 3, y = (axis + 2) % 3, mirrored = area[axis] < 0.0;
    for (uint32_t i = 0; i < n; i++) {
        out[i][0] = point[i][mirrored ? y : x] - point[0][mirrored ? y : x];
        out[i][1] = point[i][mirrored ? x : y] - point[0][mirrored ? x : y];
    }
}

static int same(const double a[2], const double b[2])
{
    return a[0] == b[0] && a[1] == b[1];
}

/* 1: the corner is convex, and no corner that turns inwards lies in its triangle, or on its sides. */
static int is_ear(const struct ring *r, const uint32_t *inward, uint32_t n_inward, uint32_t corner)
{
    const double *a = r->at[r->last[corner]], *b = r->at[corner], *c = r->at[r->next[corner]];
    if (!(turn(a, b, c) > 0.0))
        return 0;
    for (uint32_t i = 0; i < n_inward; i++) {
        const double *p = r->at[inward[i]];
        if (!same(p, a) && !same(p, b) && !same(p, c) && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
            turn(c, a, p) >= 0.0)
            return 0;
    }
    return 1;
}

/* Or straight on: an ear with such a corner on a side would leave it out of that side, and a gap there. */
static int is_inward(const struct ring *r, uint32_t corner)
{
    return turn(r->at[r->last[corner]], r->at[corner], r->at[r->next[corner]]) <= 0.0;
}

/* Leave a corner out of a list. Returns how many it has then. */
static uint32_t drop(uint32_t *list, uint32_t n, uint32_t corner)
{
    for (uint32_t i = 0; i < n; i++)
        if (list[i] == corner) {
            list[i] = list[n - 1u];
            return n - 1u;
        }
    return n;
}

/* The next ear from a corner on; where there is none, as in polygons that cross themselves, that corner. */
static uint32_t find_ear(const struct ring *r, const uint32_t *inward, uint32_t n_inward, uint32_t from, uint32_t left)
{
    uint32_t at = from;
    for (uint32_t i = 0; i < left; i++, at = r->next[at]) {
        if (r->known[at] == EAR_UNKNOWN)
            r->known[at] = is_ear(r, inward, n_inward, at) ? EAR_IS : EAR_NOT;
        if (r->known[at] == EAR_IS)
            return at;
    }
    return from;
}

/* inward: memory for n. An ear that is cut off makes the corners beside it turn more to the left. */
static void clip_ears(struct ring *r, uint32_t n, uint32_t *inward, uint32_t (*out)[3])
{
    uint32_t at = 1, n_inward = 0;
    for (uint32_t i = 0; i < n; i++)
        if (is_inward(r, i))
            inward[n_inward++] = i;
    for (uint32_t left = n, t = 0; left > 2; left--, t++) {
        if (n_inward > 0)
            at = find_ear(r, inward, n_inward, at, left);
        const uint32_t before = r->last[at], after = r->next[at];
        out[t][0] = before;
        out[t][1] = at;
        out[t][2] = after;
        r->next[before] = after;
        r->last[after] = before;
        r->known[before] = r->known[after] = EAR_UNKNOWN;
        n_inward = drop(inward, n_inward, at);
        n_inward = is_inward(r, before) ? n_inward : drop(inward, n_inward, before);
        n_inward = is_inward(r, after) ? n_inward : drop(inward, n_inward, after);
        at = n_inward > 0 ? r->next[after] : after; /* by turns, so that triangles are not all thin */
    }
}

/* No corner turns inwards, and no triangle of a fan is without an area, as beside a corner on a straight side. */
static int is_fan(double (*const at)[2], uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        if (turn(at[i], at[(i + 1) % n], at[(i + 2) % n]) < 0.0 ||
            (i + 2 < n && turn(at[0], at[i + 1], at[i + 2]) == 0.0))
            return 0;
    return 1;
}

void sim_polygon_cut(const double (*point)[3], uint32_t n, uint32_t (*out)[3])
{
    double (*const at)[2] = sim_alloc(n, sizeof *at);
    flatten(point, n, at);
    if (is_fan(at, n)) {
        for (uint32_t t = 0; t + 2 < n; t++) {
            out[t][0] = 0;
            out[t][1] = t + 1;
            out[t][2] = t + 2;
        }
    } else {
        struct ring r = { at, sim_alloc(n, sizeof *r.next), sim_alloc(n, sizeof *r.last), sim_alloc(n, 1) };
        uint32_t *inward = sim_alloc(n, sizeof *inward);
        for (uint32_t i = 0; i < n; i++) {
            r.next[i] = (i + 1) % n;
            r.last[i] = (i + n - 1) % n;
        }
        clip_ears(&r, n, inward, out);
        free(r.next);
        free(r.last);
        free(r.known);
        free(inward);
    }
    free(at);
}
