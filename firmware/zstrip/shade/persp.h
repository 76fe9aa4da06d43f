/* Perspective-correct interpolation of attributes. Internal.
 *
 * If a value changes by du over a span, and w = 1/z changes by the ratio rho, the error of affine
 * interpolation is at most du (sqrt rho - 1) / (sqrt rho + 1) <= du (rho - 1) / 4 (Heckbert). If
 * that is small enough over the whole triangle, attributes are interpolated affinely. Otherwise
 * attribute * w and w, which are linear on the screen, are interpolated, and divided at the ends of
 * parts of a scanline. Smooth colours use sub-spans of 2^k pixels; k is chosen for each triangle so
 * that the bound holds anywhere in it. Textures use groups of 32 pixels, each either affine or
 * divided pixel by pixel. Both count from the scanline's first covered pixel, on the screen or not,
 * and the last part ends at the last covered pixel. So the result does not depend on what is
 * hidden, clipped or in another strip, and w is never evaluated outside the triangle.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PERSP_H
#define ZS_PERSP_H

#include "core/depth.h"
#include "core/plane.h"
#include "core/rows.h"

#define ZS_AFFINE 31u /* job->sub_log2: plain affine */
#define ZS_SUB_LOG2_MAX 5u

/* Compute w of the three vertices, scaled so that the largest is in [2^30, 2^31). Orthographic: all
 * three are equal. */
void zs_persp_w(const struct zs_job *job, uint32_t w[3]);

/* Return the largest of three w minus the least. */
static inline uint32_t zs_persp_change(const uint32_t w[3], uint32_t *least)
{
    *least = zs_minu32(zs_minu32(w[0], w[1]), w[2]);
    return zs_maxu32(zs_maxu32(w[0], w[1]), w[2]) - *least;
}

/* Bound the change of w over a triangle from its keys alone. Return 1: w changes by at most *change
 * / view->key_slow of the least w. Return 0: the keys give no bound. If a test with this bound says
 * that a triangle may be affine, the same test with w itself says so too. */
static inline int zs_persp_slow(const struct zs_job *job, uint32_t *change)
{
    const struct zs_view *view = &job->r->view;
    const uint32_t a = job->v[0]->d, b = job->v[1]->d, c = job->v[2]->d;
    const uint32_t farthest = zs_maxu32(zs_maxu32(a, b), c);
    *change = farthest - zs_minu32(zs_minu32(a, b), c);
    return !ZS_FOR_SIZE && farthest <= view->key_known && *change <= view->key_slow;
}

/* Return (2^32 - 1) / n, 0 <= n <= 2^ZS_SUB_LOG2_MAX, for the last, shorter part of a scanline; 0
 * for n = 0. */
extern const uint32_t zs_over_table[(1 << ZS_SUB_LOG2_MAX) + 1];
static inline uint32_t zs_one_over(int32_t n)
{
    return !ZS_FOR_SIZE ? zs_over_table[n] : n ? UINT32_MAX / (uint32_t)n : 0u;
}

/* Move a plane's base to column 0 of row 0, for zs_plane_at. */
static inline void zs_plane_origin(const struct zs_geom *g, struct zs_plane *p)
{
    p->base -= zs_wrap_mul(p->gx, g->ia) + zs_wrap_mul(p->gy, g->ja);
}

/* Evaluate a plane whose base zs_plane_origin has moved. */
static inline uint32_t zs_plane_at(const struct zs_plane *p, int32_t i, int32_t row)
{
    return p->base + zs_wrap_mul(p->gx, i) + zs_wrap_mul(p->gy, row);
}

/* Clamp a value of w's plane to at least 1. True values are in (0, 2^31]. The plane's error is up
 * to (W + H) / 2 ulp (core/plane.c). If the far end of a triangle is a million times as far away as
 * its near end, the error may bring w below 0, which wraps to slightly below 2^32. With this clamp,
 * w stays monotonic along a scanline. */
static inline uint32_t zs_persp_held(uint32_t w)
{
    return w == 0 || w >> 30 == 3 ? 1u : w;
}

static inline uint32_t zs_persp_w_at(const struct zs_job *job, int32_t i, int32_t row)
{
    return zs_persp_held(zs_plane_at(&job->w, i, row));
}

/* Return the reciprocal of w at a covered pixel: 2^(63 - *lz) / w. */
static inline uint32_t zs_persp_rcp(const struct zs_job *job, int32_t i, int32_t row, uint32_t *w,
                                    int32_t *lz)
{
    *w = zs_persp_w_at(job, i, row);
    *lz = zs_clz32(*w);
    return zs_recip(*w << *lz);
}

/* Divide attribute * w by w: uq1_31, at most 2^31 - 1. */
static inline uint32_t zs_persp_over(uint32_t cw, uint32_t w, uint32_t rcp, int32_t lz)
{
    if ((int32_t)cw < 0)
        cw = 0; /* rounding made it negative */
    if (cw > w)
        cw = w;
    const uint32_t part = zs_umulh(cw << lz, rcp);
    return part > 0x7fffffffu ? 0x7fffffffu : part;
}

/* zs_plane32, with the base moved for zs_plane_at. */
static inline void zs_persp_plane(const struct zs_geom *g, const uint32_t v[3],
                                  enum zs_plane_kind kind, struct zs_plane *out)
{
    zs_plane32(g, v[0], v[1], v[2], kind, out);
    zs_plane_origin(g, out);
}

/* Pack a colour to RGB565: each word has a code (channel value of RGB565), with half a code added,
 * in its top bits; at most 63.5 codes. */
static inline uint16_t zs_smooth_pack(uint32_t red, uint32_t green, uint32_t blue)
{
    return zs_wire16((uint16_t)((red >> 27 << 6 | green >> 26) << 5 | blue >> 27));
}

/* Attributes of a job's three vertices in the pool, job->v[] in the order of job->tri->v[]. */
static inline void zs_persp_attrs(const struct zs_job *job, const uint16_t *a[3])
{
    const uint16_t *const attr = job->r->attr, *const v = job->tri->v;
    const uint32_t n = job->r->config.varyings;
    a[0] = attr + v[0] * n;
    a[1] = attr + v[1] * n;
    a[2] = attr + v[2] * n;
}

#endif
