/* Pieces of triangles, and which of two is nearer.
 *
 * A triangle's depth at a pixel is that of its plane, with gradients rounded to whole numbers, in
 * 64 bits. It is a function of the triangle's vertices alone, so it is the same in every strip, set
 * and piece. The winner of a pixel is the least (depth, scene order). All that is decided here is
 * decided for the pixels' centres, and exactly: by values of linear functions, or by bounds that
 * hold for all points of a convex set.
 *
 * Bounds. Coordinates of vertices are below 2^22 (q24_8), pixels of the frame below 2^12.
 *   edge      at < 2^45, gradients < 2^30
 *   plane     gradients <= 2^44. A triangle that is steeper is so thin, 2^-12 px, that it hardly
 *             ever covers a pixel; its plane is level at its first vertex's depth, so that order
 *             still is the same everywhere. at < 2^32 + 2 * (2^44 * 2^14 + 2^44) < 2^60
 *   sums      a difference of planes at a pixel: |.| < 2^61 + 2 * 2^45 * 2^12 < 2^62
 * Error of a plane at a covered pixel: half a unit for each column and row between the pixel and
 * the first vertex, which both lie in the triangle: at most 2^14, and one for `at`.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method/pieces.h"

#define STEEP ((int64_t)1 << 44)
#define FLAT_ENOUGH ((int64_t)1 << 36) /* gradients up to this can be taken times 2^22 + 2^8 */

/* ---- Linear functions ------------------------------------------------------------------------ */

/* Return 256 n / area, nearest. |n| < 2^55 - 2^43, as the guard band is 2 * 8188 px wide; area <
 * 2^45 */
static ZS_NOINLINE int64_t slope(int64_t n, int64_t area)
{
    return (n * 256 + (n < 0 ? -area : area) / 2) / area;
}

/* Return g times a distance in sub-pixels, whole pixels apart. |g| <= 2^44 */
static int64_t along(int64_t g, int32_t off, int64_t *rest)
{
    *rest += g * (off & (ZS_SUBPX_ONE - 1));
    return g * (off >> ZS_SUBPX_BITS);
}

static void plane_of(const struct zs_vertex *const v[3], struct zs_linear *plane)
{
    const struct zs_vertex *a = v[0], *b = v[1], *c = v[2];
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    const int64_t d0 = a->d, dv1 = b->d - d0, dv2 = c->d - d0; /* |.| < 2^32 */
    const int64_t area = zs_mul_ss(dx1, dy2) - zs_mul_ss(dx2, dy1);
    int64_t rest = 128;
    ZS_FACT(area > 0);
    plane->gx = plane->gy = 0;
    if (dv1 | dv2) {
        plane->gx = slope(dv1 * dy2 - dv2 * dy1, area);
        plane->gy = slope(dv2 * dx1 - dv1 * dx2, area);
    }
    if (zs_size64(plane->gx) > STEEP || zs_size64(plane->gy) > STEEP)
        plane->gx = plane->gy = 0;
    plane->at = d0 + along(plane->gx, ZS_SUBPX_HALF - a->x, &rest) +
                along(plane->gy, ZS_SUBPX_HALF - a->y, &rest);
    plane->at += rest >> ZS_SUBPX_BITS;
}

/* Compute the function that is < 0 at samples right of the edge from a to b, as the top-left rule
 * counts them: a sample on the edge is moved right, and by far less down. */
static void edge_of(const struct zs_vertex *a, const struct zs_vertex *b, struct zs_linear *edge)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    const int owns = dy < 0 || (dy == 0 && dx > 0);
    edge->gx = (int64_t)dy * ZS_SUBPX_ONE;
    edge->gy = (int64_t)dx * -ZS_SUBPX_ONE;
    edge->at = zs_mul_ss(dy, ZS_SUBPX_HALF - a->x) - zs_mul_ss(dx, ZS_SUBPX_HALF - a->y) - owns;
}

static void corners(const struct zs_renderer *r, uint32_t t, const struct zs_vertex *v[3])
{
    for (int k = 0; k < 3; k++)
        v[k] = &r->vert[r->tri[t].v[k]];
}

/* Compute the function that is < 0 where triangle p's plane is nearer than triangle q's. */
static void nearer_of(uint32_t p, const struct zs_linear *pp, uint32_t q,
                      const struct zs_linear *qq, struct zs_linear *out)
{
    out->at = pp->at - qq->at - (p < q); /* equally near: the first in scene order is nearer */
    out->gx = pp->gx - qq->gx;
    out->gy = pp->gy - qq->gy;
}

int zs_piece_beside(const struct zs_renderer *r, uint32_t t, int32_t x0, int32_t x1, int32_t y0,
                    int32_t y1)
{
    const struct zs_vertex *v[3];
    struct zs_linear edge;
    corners(r, t, v);
    for (int k = 0; k < 3; k++) {
        edge_of(v[k], v[(k + 1) % 3], &edge);
        if (zs_linear_at(&edge, edge.gx < 0 ? x1 - 1 : x0, edge.gy < 0 ? y1 - 1 : y0) >= 0)
            return 1;
    }
    return 0;
}

int zs_linear_clip(const struct zs_linear *f, int32_t j, int32_t *i0, int32_t *i1)
{
    int32_t in = *i0, out = *i1 - 1;
    const int first = zs_linear_at(f, in, j) < 0, last = zs_linear_at(f, out, j) < 0;
    if (first == last)
        return first;
    if (last) {
        in = out;
        out = *i0;
    }
    while (in - out > 1 || out - in > 1) {
        const int32_t mid = (in + out) / 2;
        if (zs_linear_at(f, mid, j) < 0)
            in = mid;
        else
            out = mid;
    }
    if (first)
        *i1 = out;
    else
        *i0 = in;
    return 1;
}

/* ---- Pieces ---------------------------------------------------------------------------------- */

int32_t zs_piece_depth(const struct zs_renderer *r, uint32_t t)
{
    int32_t n = 0;
    for (; t != ZS_NIL && t >= r->n_tris; t = r->tri[t + 1u].ZS_PIECE_PARENT)
        n++;
    return n;
}

int32_t zs_piece_cuts(const struct zs_renderer *r, uint32_t t, struct zs_linear *line)
{
    const uint32_t source = zs_piece_source(r, t);
    const struct zs_vertex *v[3];
    struct zs_linear own, other;
    int32_t n = 0;
    corners(r, source, v);
    plane_of(v, &own);
    for (; t != ZS_NIL && t >= r->n_tris; t = r->tri[t + 1u].ZS_PIECE_PARENT, n++) {
        const struct zs_tri *cut = &r->tri[t + 1u];
        corners(r, cut->ZS_PIECE_OTHER, v);
        plane_of(v, &other);
        nearer_of(source, &own, cut->ZS_PIECE_OTHER, &other, &line[n]);
        if (cut->ZS_PIECE_NEARER)
            continue;
        line[n].at = -1 - line[n].at; /* f >= 0 */
        line[n].gx = -line[n].gx;
        line[n].gy = -line[n].gy;
    }
    return n;
}

void zs_piece_load(const struct zs_renderer *r, uint32_t t, struct zs_piece *p)
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN;
    corners(r, t, p->v);
    p->source = zs_piece_source(r, t);
    p->near = UINT32_MAX;
    p->n = p->flat = 0;
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *v = p->v[k];
        x0 = zs_min32(x0, v->x);
        x1 = zs_max32(x1, v->x);
        y0 = zs_min32(y0, v->y);
        y1 = zs_max32(y1, v->y);
        p->near = zs_minu32(p->near, v->d);
    }
    p->x0 = zs_first_sample(x0);
    p->x1 = zs_first_sample(x1);
    p->y0 = zs_first_sample(y0);
    p->y1 = zs_first_sample(y1);
}

void zs_piece_plane(struct zs_piece *p)
{
    if (!p->flat)
        plane_of(p->v, &p->plane);
    p->flat = 1;
}

void zs_piece_lines(const struct zs_renderer *r, uint32_t t, struct zs_piece *p)
{
    if (p->n)
        return;
    for (int k = 0; k < 3; k++)
        edge_of(p->v[k], p->v[(k + 1) % 3], &p->line[k]);
    p->n = 3 + zs_piece_cuts(r, t, p->line + 3);
}

/* ---- Which of two is nearer ------------------------------------------------------------------ */

/* Return 1 if all vertices of q lie on the outer side of an edge of p, or on it. Then no sample is
 * in both: one on the common line belongs to the side to which the top-left rule moves it. */
static int apart(const struct zs_piece *p, const struct zs_piece *q)
{
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *a = p->v[k], *b = p->v[(k + 1) % 3];
        const int32_t dx = b->x - a->x, dy = b->y - a->y;
        int out = 0;
        while (out < 3 &&
               zs_mul_ss(dx, q->v[out]->y - a->y) <= zs_mul_ss(dy, q->v[out]->x - a->x))
            out++;
        if (out == 3)
            return 1;
    }
    return 0;
}

/* Return 1 if f >= 0 at all vertices of a triangle, and so at all its pixels. f is flat enough: at
 * < 2^33 + 2 * 2^36 * 2^15 < 2^53, and all terms below are less than 2^61 */
static int beyond(const struct zs_linear *f, const struct zs_vertex *const v[3])
{
    for (int k = 0; k < 3; k++)
        if (f->at * ZS_SUBPX_ONE + f->gx * (v[k]->x - ZS_SUBPX_HALF) +
                f->gy * (v[k]->y - ZS_SUBPX_HALF) < 0)
            return 0;
    return 1;
}

int zs_piece_clear(struct zs_piece *p, struct zs_piece *q, struct zs_linear *nearer)
{
    if (p->x1 <= q->x0 || q->x1 <= p->x0 || p->y1 <= q->y0 || q->y1 <= p->y0)
        return 1;
    if (p->source == q->source || apart(p, q) || apart(q, p))
        return 1;
    zs_piece_plane(p);
    zs_piece_plane(q);
    nearer_of(p->source, &p->plane, q->source, &q->plane, nearer);
    return zs_size64(nearer->gx) <= FLAT_ENOUGH && zs_size64(nearer->gy) <= FLAT_ENOUGH &&
           (beyond(nearer, p->v) || beyond(nearer, q->v));
}

uint32_t zs_piece_meet(const struct zs_piece *p, const struct zs_piece *q,
                       const struct zs_linear *f)
{
    const int32_t x0 = q ? zs_max32(p->x0, q->x0) : p->x0, x1 = q ? zs_min32(p->x1, q->x1) : p->x1;
    const int32_t y1 = q ? zs_min32(p->y1, q->y1) : p->y1;
    uint32_t found = 0;
    for (int32_t j = q ? zs_max32(p->y0, q->y0) : p->y0; j < y1 && found != 3; j++) {
        int32_t i0 = x0, i1 = x1, in = i0 < i1;
        for (int32_t k = 0; in && k < p->n; k++)
            in = zs_linear_clip(&p->line[k], j, &i0, &i1);
        for (int32_t k = 0; in && q && k < q->n; k++)
            in = zs_linear_clip(&q->line[k], j, &i0, &i1);
        if (!in)
            continue;
        found |= zs_linear_at(f, i0, j) < 0 ? ZS_PIECE_NEAR : ZS_PIECE_FAR;
        found |= zs_linear_at(f, i1 - 1, j) < 0 ? ZS_PIECE_NEAR : ZS_PIECE_FAR;
    }
    return found;
}
