/* Gradients: planes over the screen for a snapped triangle, with proved error bounds.
 *
 * value(x, y) = v0 + (Nx (x - x0) + Ny (y - y0)) / A with
 *   A  = dx1 dy2 - dx2 dy1 > 0,  Nx = dv1 dy2 - dv2 dy1,  Ny = dv2 dx1 - dv1 dx2.
 *
 * Sums wrap modulo 2^32. The result is exact where the true value fits 32 bits. It does so on
 * covered pixels: they are inside the triangle, so the value is between those of the vertices (near
 * and far are clipped before), up to the errors below, which are far less than the half bucket that
 * is added. base + gx * i + gy * j equals repeated addition bit for bit, so strips cannot differ.
 *
 * There are two methods, `small` and `division`; the triangle alone decides which one is used. Each
 * has a cheaper variant with the same bits: tiny triangles (core/job.h) use `small` with 32-bit
 * products, and small triangles whose values are too steep for `small` use `division` with the
 * reciprocal in place of a division, corrected by the remainder.
 *
 * small     For width + height <= 256 px, value differences below 2^31 and gradients below 2^27.
 *           One reciprocal of the area, then one multiplication for each gradient. The relative
 *           error of a gradient is 2^-30 (reciprocal) + 2^-31 + 2^-31 (truncated mantissas) + 2^-30
 *           (truncated product) < 2^-28.4, so below 2^-1.4 ulp, and with rounding e <= 0.88 ulp.
 *           The anchor is the pixel of the first vertex, at most half a pixel away in each
 *           direction: 0.88 + 0.5. Anywhere in the triangle, after at most 256 steps: <= 0.88 * 256
 *           + 1.4 < 227 ulp of 2^-16 bucket = 0.0035 bucket. Values of 31 significant bits
 *           (ZS_PLANE_WIDE: w, colour times w) may have gradients up to 2^30: e <= 2^1.6 + 1/2 ulp
 *           of 2^-31, 2^-21 over 256 steps.
 * division  For all others. A division with remainder to 24 more bits; gradients are rounded to
 *           nearest: e <= 1/2 ulp. The anchor is the viewport's pixel that is nearest to the first
 *           vertex; its value is computed from N / A with 32 fraction bits (error < 2^-32 * 2^22 *
 *           2 + 1/2). Anywhere in the frame: <= (W + H - 2) / 2 + 0.51 ulp < (W + H + 1) / 2 *
 *           2^-16 bucket = 0.0049 for W + H = 640.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/plane.h"

void zs_plane_sides(struct zs_job *job, const struct zs_vertex *a, const struct zs_vertex *b,
                    const struct zs_vertex *c)
{
    struct zs_geom *g = &job->geom;
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y,
                  dy2 = c->y - a->y; /* |.| < 2^22 */
    job->v[0] = a;
    job->v[1] = b;
    job->v[2] = c;
    job->mid_right = b->y < c->y || (b->y == c->y && b->x < c->x);
    g->dx1 = dx1;
    g->dx2 = dx2;
    g->dy1 = dy1;
    g->dy2 = dy2;
    const int tiny = zs_tiny(dx1, dx2, dy1, dy2);
    if (ZS_FOR_SIZE || !tiny)
        g->area = zs_mul_ss(dx1, dy2) - zs_mul_ss(dx2, dy1); /* < 2^45 */
    else
        g->area = dx1 * dy2 - dx2 * dy1; /* each below 2^28 */
    g->tiny = tiny && (int32_t)g->area >= ZS_TINY_AREA;
}

/* Return 1 if width + height <= 256 px. */
static int is_small(const struct zs_geom *g)
{
    /* the first vertex is the top one */
    return (int32_t)zs_range32(g->dx1, g->dx2) + zs_max32(g->dy1, g->dy2) <= ZS_SMALL_EXTENT;
}

void zs_plane_geom(struct zs_job *job)
{
    struct zs_geom *g = &job->geom;
    const struct zs_vertex *a = job->v[0];
    ZS_FACT(g->dx1 == job->v[1]->x - a->x && g->dy1 == job->v[1]->y - a->y);
    ZS_FACT(g->dx2 == job->v[2]->x - a->x && g->dy2 == job->v[2]->y - a->y);
    ZS_FACT(g->area == (int64_t)g->dx1 * g->dy2 - (int64_t)g->dx2 * g->dy1 && g->area > 0);
    const int32_t x = a->x, y = a->y;
    int32_t ia = x >> ZS_SUBPX_BITS, ja = y >> ZS_SUBPX_BITS;
    if (g->tiny || is_small(g)) {
        ZS_FACT(g->area <= (int64_t)1 << 30);
        const int lz = zs_clz32((uint32_t)g->area); /* 1 .. 31: area <= width * height <= 2^30 */
        g->exp = -lz;
        g->rcp = zs_recip((uint32_t)g->area << lz);
    } else {
        g->rcp = 0;
        ia = zs_min32(zs_max32(ia, 0), job->width - 1);
        ja = zs_min32(zs_max32(ja, job->top), job->bottom - 1);
    }
    g->ia = ia;
    g->ja = ja;
    g->ax = ia * ZS_SUBPX_ONE + ZS_SUBPX_HALF - x; /* small: -127 .. 128; others: < 2^22.1 */
    g->ay = ja * ZS_SUBPX_ONE + ZS_SUBPX_HALF - y;
}

/* One call for each gradient. On a core with few registers, gradient() is a function of its own,
 * with the quotient inlined; elsewhere gradient() is inlined and the quotient is the function. */
#if ZS_DIVIDES
#define ZS_GRADIENT ZS_ALWAYS_INLINE
#else
#define ZS_GRADIENT static ZS_NOINLINE
#endif

ZS_IN_ORDER ZS_NOINLINE int32_t zs_plane_quotient(int64_t n, uint32_t rcp, int32_t lz,
                                                  int32_t least_shift)
{
    return zs_quotient(n, rcp, lz, least_shift, 0);
}

/* Return 256 (dv1 d[1] - dv2 d[0]) / area. |dv| <= 2^31, |d| <= 2^16: |numerator| <= 2^48 */
ZS_GRADIENT int32_t gradient(const struct zs_geom *g, int32_t dv1, int32_t dv2, const int32_t d[2],
                             int32_t least)
{
    const int64_t n = zs_cross_short(dv1, d[1], dv2, d[0]);
    return ZS_DIVIDES ? zs_plane_quotient(n, g->rcp, -g->exp, least)
                      : zs_quotient(n, g->rcp, -g->exp, least, ZS_CROSS_SHORT);
}

/* The same for a triangle that is not tiny, where gradient() takes tiny ones only. */
static ZS_RARE ZS_NOINLINE int32_t small_gradient(const struct zs_geom *g, int32_t dv1, int32_t dv2,
                                                  const int32_t d[2], int32_t least)
{
    return zs_plane_quotient(zs_mul_ss(dv1, d[1]) - zs_mul_ss(dv2, d[0]), g->rcp, -g->exp, least);
}

/* Divide n / d to 32 fraction bits. Store the floor in *whole, return the fraction. d < 2^45. */
static ZS_RARE ZS_NOINLINE uint32_t divide(int64_t n, int64_t d, int64_t *whole)
{
    int64_t q = n / d, rest = n % d;
    if (rest < 0) {
        rest += d;
        q--;
    }
    *whole = q;
    const uint64_t high = (uint64_t)rest << 16; /* < 2^61 */
    const uint64_t f1 = high / (uint64_t)d;
    const uint64_t low = (high - f1 * (uint64_t)d) << 16;
    return (uint32_t)(f1 << 16 | low / (uint64_t)d);
}

/* Return the next 32 bits of a quotient, (*rest 2^32 + next) / d, and its remainder in *rest. *rest
 * < d, d >= 2^31. rcp is at most 2^63 / d, and less by at most 2^-28 of it, so that the first guess
 * is never too large, and too small by at most 18. */
static inline uint32_t digit(uint32_t *rest, uint32_t next, uint32_t d, uint32_t rcp)
{
    uint32_t q = zs_umulh(*rest, rcp) * 2u;
    uint64_t left = ((uint64_t)*rest << 32 | next) - zs_mul_uu(q, d);
    for (; left >= d; left -= d)
        q++;
    *rest = (uint32_t)left;
    return q;
}

/* divide(n, area) for a small triangle, with the reciprocal of its area. |n| < 2^57 */
static ZS_RARE ZS_NOINLINE uint32_t small_divide(const struct zs_geom *g, int64_t n, int64_t *whole)
{
    const uint64_t mag = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    const int32_t lz = -g->exp; /* 1 .. 31, as area <= 2^30 */
    const uint32_t d = (uint32_t)g->area << lz,
                   rcp = g->rcp - 3u; /* zs_recip is too large by at most 2^-31 */
    const uint32_t hi = (uint32_t)(mag >> 32), lo = (uint32_t)mag;
    uint32_t rest = hi >> (32 - lz); /* mag << lz in three words; < 2^24 */
    const uint32_t q1 = digit(&rest, hi << lz | lo >> (32 - lz), d, rcp);
    const uint32_t q0 = digit(&rest, lo << lz, d, rcp);
    uint32_t fraction = digit(&rest, 0, d, rcp);
    uint64_t q = (uint64_t)q1 << 32 | q0;
    if (n < 0) { /* floor: -q if the remainder is 0, else the complement of q */
        fraction = ~fraction;
        q = ~q;
        if (rest == 0 && ++fraction == 0)
            q++;
    }
    *whole = (int64_t)q;
    return fraction;
}

/* Return a gradient in 40.24 bits modulo 2^64, and add the step to the anchor to *base. */
static ZS_RARE uint64_t gradient64(const struct zs_geom *g, uint64_t n, int32_t to_anchor,
                                   uint64_t *base)
{
    int64_t whole;
    const uint32_t fraction = !ZS_FOR_SIZE && g->rcp ? small_divide(g, (int64_t)n, &whole)
                                                     : divide((int64_t)n, g->area, &whole);
    *base += (zs_times((uint64_t)whole, to_anchor) << 24) +
             (uint64_t)(zs_mul_su(to_anchor, fraction) >> 8);
    return ((uint64_t)whole << 32) + fraction;
}

uint64_t zs_plane_numerator(uint64_t dv1, uint64_t dv2, const int32_t d[2])
{
    return zs_times(dv1, d[1]) - zs_times(dv2, d[0]);
}

void zs_plane64(const struct zs_geom *g, uint64_t v0, uint64_t v1, uint64_t v2,
                struct zs_plane64 *out)
{
    const uint64_t dv1 = v1 - v0, dv2 = v2 - v0; /* |.| <= 2^40 */
    uint64_t base = v0 << 24;
    out->gx = gradient64(g, zs_plane_numerator(dv1, dv2, g->dy), g->ax, &base); /* |.| < 2^63 */
    out->gy = gradient64(g, 0u - zs_plane_numerator(dv1, dv2, g->dx), g->ay, &base);
    out->base = base;
}

/* The method `small`: move the base from the first vertex to the anchor. On entry out->base is the
 * first vertex's value, and the gradients are known. */
static inline void small_base(const struct zs_geom *g, struct zs_plane *out)
{
    const int32_t gx = (int32_t)out->gx, gy = (int32_t)out->gy; /* |.| <= 2^30 */
    ZS_FACT(gx >= -(1 << 30) && gx <= 1 << 30 && gy >= -(1 << 30) && gy <= 1 << 30);
    out->base += zs_plane_step(gx, g->ax, gy, g->ay); /* |a| <= 2^7 */
}

/* The method `division`, for any triangle and any values: compute with 24 more bits, then round. On
 * entry out->base is the first vertex's value. */
static ZS_NOINLINE void wide_plane(const struct zs_geom *g, uint32_t dv1, uint32_t dv2,
                                   struct zs_plane *out)
{
    const uint32_t v0 = out->base;
    struct zs_plane64 wide;
    zs_plane64(g, v0, v0 + dv1, v0 + dv2, &wide); /* modulo 2^32 */
    out->gx = (uint32_t)((wide.gx + (1u << 23)) >> 24);
    out->gy = (uint32_t)((wide.gy + (1u << 23)) >> 24);
    out->base = (uint32_t)((wide.base + (1u << 23)) >> 24);
}

void zs_plane32(const struct zs_geom *g, uint32_t v0, uint32_t v1, uint32_t v2,
                int32_t kind, struct zs_plane *out)
{
    const int32_t dv1 = (int32_t)(v1 - v0), dv2 = (int32_t)(v2 - v0);
    out->base = v0;
    if ((dv1 | dv2) == 0) {
        out->gx = out->gy = 0;
        return;
    }
    /* if the differences fit 32 bits; they do if all values are in the same half of the range */
    if (g->rcp && ((int32_t)((v1 ^ v0) | (v2 ^ v0)) >= 0 ||
                   ((dv1 < 0) == (v1 < v0) && (dv2 < 0) == (v2 < v0)))) {
        int32_t gx, up; /* up: -gy */
        if (!ZS_CROSS_SHORT || g->tiny) {
            gx = gradient(g, dv1, dv2, g->dy, kind);
            up = gradient(g, dv1, dv2, g->dx, kind);
        } else {
            gx = small_gradient(g, dv1, dv2, g->dy, kind);
            up = small_gradient(g, dv1, dv2, g->dx, kind);
        }
        if (gx != ZS_TOO_STEEP && up != ZS_TOO_STEEP) {
            out->gx = (uint32_t)gx;
            out->gy = 0u - (uint32_t)up;
            small_base(g, out);
            return;
        }
    }
    wide_plane(g, (uint32_t)dv1, (uint32_t)dv2, out);
}
