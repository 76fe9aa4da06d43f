/* Planes over the screen: gradients of a snapped triangle, exact where they must be.
 *
 * value(x, y) = v0 + (Nx (x - x0) + Ny (y - y0)) / A with
 *   A  = dx1 dy2 - dx2 dy1 > 0,  Nx = dv1 dy2 - dv2 dy1,  Ny = dv2 dx1 - dv1 dx2.
 *
 * Sums are kept modulo 2^32. That is exact wherever the true value fits, and it does on covered
 * pixels: they lie inside the triangle, so the value lies between the vertices' (near and far are
 * clipped before), give or take the errors below, which are far less than the half bucket added.
 * base + gx * i + gy * j equals repeated addition bit for bit: strips cannot differ.
 *
 * Two ways, chosen by the triangle alone:
 *
 * small   width + height <= 256 px, value differences below 2^31, gradients below 2^27: one
 *         reciprocal of the area, a multiplication a gradient. Relative error of a gradient
 *         2^-30 (reciprocal) + 2^-31 + 2^-31 (mantissas cut) + 2^-30 (product cut) < 2^-28.4, so below
 *         2^-1.4 ulp, and rounded: e <= 0.88 ulp. The anchor is the first vertex's own pixel, at most
 *         half a pixel away each way: 0.88 + 0.5. Anywhere in the triangle, 256 steps at the most:
 *         <= 0.88 * 256 + 1.4 < 227 ulp of 2^-16 bucket = 0.0035 bucket.
 *         Values of 31 significant bits (ZS_PLANE_WIDE: w, colour times w) take gradients up to 2^30 this
 *         way: e <= 2^1.6 + 1/2 ulp of 2^-31, 2^-21 over 256 steps.
 * large   64-bit division with remainder, gradients rounded to nearest: e <= 1/2 ulp. The anchor is
 *         the pixel of the frame next to the first vertex, computed from N / A with 32 fraction bits
 *         (error < 2^-32 * 2^22 * 2 + 1/2). Anywhere in the frame: <= (W + H - 2) / 2 + 0.51 ulp
 *         < (W + H + 1) / 2 * 2^-16 bucket = 0.0049 for W + H = 640.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pipeline.h"

#define SMALL_EXTENT (256 * ZS_SUBPX_ONE)

int zs_plane_sides(struct zs_job *job, const struct zs_vertex *const v[3])
{
    struct zs_geom *g = &job->geom;
    const int32_t mx = v[1]->x - v[0]->x, my = v[1]->y - v[0]->y, bx = v[2]->x - v[0]->x,
                  by = v[2]->y - v[0]->y; /* |.| < 2^22 */
    int64_t cross;
    g->tiny = !(((uint32_t)(mx + ZS_TINY) | (uint32_t)(bx + ZS_TINY) | (uint32_t)by * 2u) / (2u * ZS_TINY));
    if (g->tiny)
        cross = mx * by - bx * my; /* each below 2^29 */
    else
        cross = zs_mul_ss(mx, by) - zs_mul_ss(bx, my); /* |.| < 2^45 */
    if (cross == 0)
        return 0;
    job->mid_right = cross > 0;
    job->v[0] = v[0]; /* planes want a positive area */
    job->v[1] = cross > 0 ? v[1] : v[2];
    job->v[2] = cross > 0 ? v[2] : v[1];
    g->dx1 = cross > 0 ? mx : bx;
    g->dy1 = cross > 0 ? my : by;
    g->dx2 = cross > 0 ? bx : mx;
    g->dy2 = cross > 0 ? by : my;
    g->area = cross > 0 ? cross : -cross;
    return 1;
}

/* Width + height <= 256 px. */
static int is_small(const struct zs_geom *g)
{
    const int32_t width = zs_max32(zs_max32(g->dx1, g->dx2), 0) - zs_min32(zs_min32(g->dx1, g->dx2), 0);
    return width + zs_max32(g->dy1, g->dy2) <= SMALL_EXTENT; /* the first vertex is the top one */
}

void zs_plane_geom(struct zs_job *job)
{
    struct zs_geom *g = &job->geom;
    const struct zs_vertex *a = job->v[0];
    ZS_ASSERT(g->dx1 == job->v[1]->x - a->x && g->dy1 == job->v[1]->y - a->y);
    ZS_ASSERT(g->dx2 == job->v[2]->x - a->x && g->dy2 == job->v[2]->y - a->y);
    ZS_ASSERT(g->area == (int64_t)g->dx1 * g->dy2 - (int64_t)g->dx2 * g->dy1 && g->area > 0);
    g->ia = a->x >> ZS_SUBPX_BITS;
    g->ja = a->y >> ZS_SUBPX_BITS;
    if (g->tiny || is_small(g)) {
        const int lz = zs_clz32((uint32_t)g->area); /* area <= width * height <= 2^30 */
        g->rcp = zs_recip((uint32_t)g->area << lz);
        g->exp = -lz;
    } else {
        g->rcp = 0;
        g->ia = zs_min32(zs_max32(g->ia, 0), job->width - 1);
        g->ja = zs_min32(zs_max32(g->ja, 0), job->r->config.height - 1);
    }
    g->ax = g->ia * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->x; /* small: -127 .. 128; large: < 2^22.1 */
    g->ay = g->ja * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;
}

#define TOO_STEEP INT32_MIN

/* 256 * n / area of a small triangle, nearly nearest; TOO_STEEP where it is 2^(32 - least_shift) or more. */
static int32_t small_gradient(const struct zs_geom *g, int64_t n, int32_t least_shift)
{
    const uint64_t mag = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    const uint32_t hi = (uint32_t)(mag >> 32);
    uint32_t m = (uint32_t)mag; /* mag = m 2^(32 - lz) ... */
    int lz = 32;
    if (hi) {
        lz = zs_clz32(hi);
        m = hi << lz | m >> 1 >> (31 - lz);
    } else if (g->exp < 9 - 32 + 5) { /* else even the largest m is not too steep, and its leading zeros change nothing */
        if (m == 0)
            return 0;
        const int up = zs_clz32(m);
        m <<= up;
        lz += up;
    }
    /* ... and area = a 2^exp: 256 mag / area = p 2^(32 + 8 + 32 - lz - 63 - exp) with p = m 2^63 / a / 2^32 */
    const int32_t shift = lz + g->exp - 9;
    if (shift < least_shift)
        return TOO_STEEP;
    const uint32_t p = zs_umulh(m, g->rcp);
    const uint32_t q = shift > 32 ? 0u : ((p >> (shift - 1)) + 1u) >> 1;
    return n < 0 ? -(int32_t)q : (int32_t)q; /* q <= 2^30 */
}

/* n / d with 32 fraction bits: floor in *whole, fraction returned. d < 2^45. */
static uint32_t divide(int64_t n, int64_t d, int64_t *whole)
{
    int64_t q = n / d, rest = n - q * d;
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

/* 256 * n / area modulo 2^32, nearest, and the step to the anchor added to *base. */
static uint32_t large_gradient(const struct zs_geom *g, int64_t n, int32_t to_anchor, uint64_t *base)
{
    int64_t whole;
    const uint32_t part = divide(n, g->area, &whole);
    /* *base has 24 fraction bits below the ulp, modulo 2^64: 40 bits of whole ulp are enough */
    *base += (uint64_t)whole * (uint64_t)(int64_t)to_anchor << 24;
    *base += (uint64_t)((int64_t)part * to_anchor >> 8); /* |.| < 2^54.1 */
    return (uint32_t)((uint64_t)whole << 8) + (uint32_t)(((uint64_t)part + (1u << 23)) >> 24);
}

static void large_plane(const struct zs_geom *g, uint32_t v0, int64_t dv1, int64_t dv2,
                        struct zs_plane *out)
{
    const int64_t nx = dv1 * g->dy2 - dv2 * g->dy1; /* |dv| < 2^32: < 2^55 */
    const int64_t ny = dv2 * g->dx1 - dv1 * g->dx2;
    uint64_t base = ((uint64_t)v0 << 24) + (1u << 23);
    out->gx = large_gradient(g, nx, g->ax, &base);
    out->gy = large_gradient(g, ny, g->ay, &base);
    out->base = (uint32_t)(base >> 24);
}

/* The small way. Return 0 where the triangle or its values are not for it. */
static int small_plane(const struct zs_geom *g, uint32_t v0, int32_t dv1, int32_t dv2,
                       enum zs_plane_kind kind, struct zs_plane *out)
{
    const int32_t least = kind == ZS_PLANE_WIDE ? 2 : 5;
    int64_t nx, ny; /* |dv| <= 2^31, |d| <= 2^16: |.| <= 2^48 */
    if (g->tiny) {
        nx = zs_cross_short(dv1, g->dy2, dv2, g->dy1);
        ny = zs_cross_short(dv2, g->dx1, dv1, g->dx2);
    } else {
        nx = zs_mul_ss(dv1, g->dy2) - zs_mul_ss(dv2, g->dy1);
        ny = zs_mul_ss(dv2, g->dx1) - zs_mul_ss(dv1, g->dx2);
    }
    const int32_t gx = small_gradient(g, nx, least), gy = small_gradient(g, ny, least);
    if (gx == TOO_STEEP || gy == TOO_STEEP)
        return 0;
    /* (gx ax + gy ay + 128) / 256, floor: the low 8 bits of the gradients apart. |g| <= 2^30, |a| <= 2^7 */
    const int32_t low = (gx & 255) * g->ax + (gy & 255) * g->ay + 128;
    const int32_t step = (gx >> 8) * g->ax + (gy >> 8) * g->ay + (low >> 8); /* |.| < 2^31 */
    out->gx = (uint32_t)gx;
    out->gy = (uint32_t)gy;
    out->base = v0 + (uint32_t)step;
    return 1;
}

void zs_plane32(const struct zs_geom *g, uint32_t v0, uint32_t v1, uint32_t v2,
                enum zs_plane_kind kind, struct zs_plane *out)
{
    if (v0 == v1 && v0 == v2) {
        out->base = v0;
        out->gx = out->gy = 0;
        return;
    }
    /* differences that fit 32 bits: the borrow and the sign bit agree */
    const int32_t dv1 = (int32_t)(v1 - v0), dv2 = (int32_t)(v2 - v0);
    if (g->rcp == 0 || (dv1 < 0) != (v1 < v0) || (dv2 < 0) != (v2 < v0) ||
        !small_plane(g, v0, dv1, dv2, kind, out))
        large_plane(g, v0, (int64_t)v1 - v0, (int64_t)v2 - v0, out);
}

void zs_plane64(const struct zs_geom *g, uint64_t v0, uint64_t v1, uint64_t v2,
                struct zs_plane64 *out)
{
    const int64_t dv1 = (int64_t)(v1 - v0), dv2 = (int64_t)(v2 - v0); /* |.| <= 2^40 */
    int64_t whole;
    uint32_t part;
    out->base = v0 << 24;
    part = divide(dv1 * g->dy2 - dv2 * g->dy1, g->area, &whole); /* |.| < 2^63 */
    out->gx = ((uint64_t)whole << 32) + part;
    out->base += ((uint64_t)whole * (uint64_t)(int64_t)g->ax << 24) +
                 (uint64_t)((int64_t)part * g->ax >> 8);
    part = divide(dv2 * g->dx1 - dv1 * g->dx2, g->area, &whole);
    out->gy = ((uint64_t)whole << 32) + part;
    out->base += ((uint64_t)whole * (uint64_t)(int64_t)g->ay << 24) +
                 (uint64_t)((int64_t)part * g->ay >> 8);
}
