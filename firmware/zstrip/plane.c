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

void zs_plane_geom(struct zs_job *job)
{
    struct zs_geom *g = &job->geom;
    const struct zs_vertex *a = job->v[0];
    g->dx1 = job->v[1]->x - a->x; /* |.| < 2^22, as all four */
    g->dy1 = job->v[1]->y - a->y;
    g->dx2 = job->v[2]->x - a->x;
    g->dy2 = job->v[2]->y - a->y;
    ZS_ASSERT(g->area == (int64_t)g->dx1 * g->dy2 - (int64_t)g->dx2 * g->dy1 && g->area > 0);
    const int32_t width = zs_max32(zs_max32(g->dx1, g->dx2), 0) -
                          zs_min32(zs_min32(g->dx1, g->dx2), 0);
    const int32_t height = zs_max32(zs_abs32(g->dy1), zs_abs32(g->dy2)); /* a is the top */
    g->ia = a->x >> ZS_SUBPX_BITS;
    g->ja = a->y >> ZS_SUBPX_BITS;
    g->rcp = 0;
    if (width + height <= SMALL_EXTENT) {
        const int lz = zs_clz64((uint64_t)g->area);
        g->rcp = zs_recip((uint32_t)((uint64_t)g->area << lz >> 32));
        g->exp = 32 - lz;
    } else {
        g->ia = zs_min32(zs_max32(g->ia, 0), job->width - 1);
        g->ja = zs_min32(zs_max32(g->ja, 0), job->r->config.height - 1);
    }
    g->ax = g->ia * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->x; /* small: -127 .. 128; large: < 2^22.1 */
    g->ay = g->ja * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;
}

/* 256 * n / area of a small triangle, nearly nearest; 0 in *ok where it is 2^(32 - least_shift) or more. */
static int32_t small_gradient(const struct zs_geom *g, int64_t n, int32_t least_shift, int *ok)
{
    if (n == 0)
        return 0;
    const uint64_t mag = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    const int lz = zs_clz64(mag);
    const uint32_t m = (uint32_t)(mag << lz >> 32);
    const uint32_t p = zs_umulh(m, g->rcp); /* [2^30, 2^32): m * 2^63 / area mantissa / 2^32 */
    /* n = m 2^(32 - lz), area = a 2^exp: 256 n / area = p 2^(32 + 8 + 32 - lz - 63 - exp) */
    const int32_t shift = lz + g->exp - 9;
    if (shift < least_shift) {
        *ok = 0;
        return 0;
    }
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
    int ok = 1;
    /* |dv| <= 2^31, |d| <= 2^16: |.| <= 2^48 */
    const int32_t gx = small_gradient(g, (int64_t)dv1 * g->dy2 - (int64_t)dv2 * g->dy1, least, &ok);
    const int32_t gy = small_gradient(g, (int64_t)dv2 * g->dx1 - (int64_t)dv1 * g->dx2, least, &ok);
    const int64_t step = (int64_t)gx * g->ax + (int64_t)gy * g->ay; /* |.| <= 2^38 */
    out->gx = (uint32_t)gx;
    out->gy = (uint32_t)gy;
    out->base = v0 + (uint32_t)zs_round_shift(step, 8);
    return ok;
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
