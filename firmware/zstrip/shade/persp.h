/* Attributes that are linear in space, over the screen. Internal.
 *
 * Plain affine interpolation of a value that changes by du over a span in which w = 1/z changes by
 * the ratio rho is wrong by at most du (sqrt rho - 1) / (sqrt rho + 1) <= du (rho - 1) / 4
 * (Heckbert). Where that is little enough over the whole triangle, attributes are affine. Otherwise
 * attribute * w and w are linear on the screen, and are divided at the ends of parts of a row.
 * Smooth colours: sub-spans of 2^k pixels, one k a triangle, for which the bound holds anywhere in
 * it. Textures: groups of 32 pixels, affine or divided pixel by pixel. Both count from the row's
 * first covered pixel, on the screen or not, and the last part ends at the row's last covered
 * pixel: what is hidden, clipped or in another strip moves nothing, and w is never taken outside
 * the triangle.
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

/* w of the three vertices, the largest in [2^30, 2^31); orthographic: all alike. */
void zs_persp_w(const struct zs_job *job, uint32_t w[3]);

/* The largest of three w less the least. */
static inline uint32_t zs_persp_change(const uint32_t w[3], uint32_t *least)
{
    *least = zs_minu32(zs_minu32(w[0], w[1]), w[2]);
    return zs_maxu32(zs_maxu32(w[0], w[1]), w[2]) - *least;
}

/* 1: w changes over a triangle by at most *change / view->key_slow of the least w, found from keys
 * alone; 0: not known. What is asked of w itself then has the same answer. */
static inline int zs_persp_slow(const struct zs_job *job, uint32_t *change)
{
    const struct zs_view *view = &job->r->view;
    const uint32_t a = job->v[0]->d, b = job->v[1]->d, c = job->v[2]->d;
    const uint32_t farthest = zs_maxu32(zs_maxu32(a, b), c);
    *change = farthest - zs_minu32(zs_minu32(a, b), c);
    return farthest <= view->key_known && *change <= view->key_slow;
}

/* (2^32 - 1) / n of a last, shorter part of a row, n <= 2^ZS_SUB_LOG2_MAX; 0 of 0. */
extern const uint32_t zs_one_over[(1 << ZS_SUB_LOG2_MAX) + 1];

/* Move a plane's base to column 0 of row 0, for zs_plane_at. */
static inline void zs_plane_origin(const struct zs_geom *g, struct zs_plane *p)
{
    p->base -= zs_wrap_mul(p->gx, g->ia) + zs_wrap_mul(p->gy, g->ja);
}

/* Of a plane whose base was moved. */
static inline uint32_t zs_plane_at(const struct zs_plane *p, int32_t i, int32_t row)
{
    return p->base + zs_wrap_mul(p->gx, i) + zs_wrap_mul(p->gy, row);
}

/* A sum of w's plane, at least 1. True values lie in (0, 2^31]; the plane is off by up to (W + H) /
 * 2 ulp (plane.c), and where a triangle's far end is a million times as far as its near one that
 * may bring w below 0: around, to 2^32 less a little. Held like this, w stays monotonous along a
 * row. */
static inline uint32_t zs_persp_held(uint32_t w)
{
    return w == 0 || w >> 30 == 3 ? 1u : w;
}

static inline uint32_t zs_persp_w_at(const struct zs_job *job, int32_t i, int32_t row)
{
    return zs_persp_held(zs_plane_at(&job->w, i, row));
}

/* Reciprocal of w at a covered pixel: 2^(63 - *lz) / w. */
static inline uint32_t zs_persp_rcp(const struct zs_job *job, int32_t i, int32_t row, uint32_t *w,
                                    int32_t *lz)
{
    *w = zs_persp_w_at(job, i, row);
    *lz = zs_clz32(*w);
    return zs_recip(*w << *lz);
}

/* attribute * w over w: uq1_31, at most 2^31 - 1. */
static inline uint32_t zs_persp_over(uint32_t cw, uint32_t w, uint32_t rcp, int32_t lz)
{
    if ((int32_t)cw < 0)
        cw = 0; /* a rounded 0 that fell below it */
    if (cw > w)
        cw = w;
    const uint32_t part = zs_umulh(cw << lz, rcp);
    return part > 0x7fffffffu ? 0x7fffffffu : part;
}

/* zs_plane32 for zs_plane_at. */
static inline void zs_persp_plane(const struct zs_geom *g, const uint32_t v[3],
                                  enum zs_plane_kind kind, struct zs_plane *out)
{
    zs_plane32(g, v[0], v[1], v[2], kind, out);
    zs_plane_origin(g, out);
}

/* A smooth colour: codes with half a code added, at most 63.5, in their words' top bits. */
static inline uint16_t zs_smooth_pack(uint32_t red, uint32_t green, uint32_t blue)
{
    return zs_wire16((uint16_t)((red >> 27 << 6 | green >> 26) << 5 | blue >> 27));
}

/* Attributes of a job's three vertices in the pool, job->v[] in the order of job->tri->v[]. */
static inline void zs_persp_attrs(const struct zs_job *job, const uint16_t *a[3])
{
    const struct zs_renderer *r = job->r;
    const uint32_t n = r->config.varyings;
    for (int k = 0; k < 3; k++)
        a[k] = &r->attr[job->tri->v[k] * n];
}

#endif
