/* The row loop that every kernel shares: edges walked by quotient and remainder, a span a row.
 *
 * Each kernel passes its span function as a constant, so that the compiler builds one loop a kernel.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ROWS_H
#define ZS_ROWS_H

#include "pipeline.h"

#if defined(__GNUC__)
#define ZS_ALWAYS_INLINE static inline __attribute__((always_inline))
#else
#define ZS_ALWAYS_INLINE static inline
#endif

/* Pixels [x0, x1) of a row, x0 < x1, may reach beyond the frame's sides; some of them are in it. */
typedef void zs_span_fn(void *ctx, int32_t row, int32_t x0, int32_t x1);

ZS_ALWAYS_INLINE void zs_edge_step(struct zs_edge *e)
{
    e->i += e->q;     /* |.| <= 2^14 + 1 in rows of the triangle */
    e->e -= e->s;     /* (-span, span) */
    if (e->e < 0) {
        e->e += e->span;
        e->i++;
    }
}

ZS_ALWAYS_INLINE void zs_rows_part(const struct zs_job *job, struct zs_edge *left,
                                   struct zs_edge *right, int32_t row, int32_t end,
                                   zs_span_fn *span, void *ctx)
{
    struct zs_edge l = *left, r = *right;
    const int32_t width = job->width;
    for (; row < end; row++) {
        if (l.i < r.i && l.i < width && r.i > 0)
            span(ctx, row, l.i, r.i);
        zs_edge_step(&l);
        zs_edge_step(&r);
    }
    *left = l;
    *right = r;
}

ZS_ALWAYS_INLINE void zs_rows_walk(struct zs_job *job, zs_span_fn *span, void *ctx)
{
    struct zs_edge *whole = &job->edge[0];
    for (int part = 0; part < 2; part++) {
        struct zs_edge *piece = &job->edge[1 + part];
        const int32_t from = part ? job->row_mid : job->row, to = part ? job->row_end : job->row_mid;
        if (from >= to)
            continue;
        zs_rows_part(job, job->mid_right ? whole : piece, job->mid_right ? piece : whole, from, to,
                     span, ctx);
    }
}

ZS_ALWAYS_INLINE void zs_rows_tested(struct zs_job *job, int32_t n)
{
    job->r->stats.pixels_tested += (uint32_t)n;
}

ZS_ALWAYS_INLINE void zs_rows_written(struct zs_job *job, int32_t n)
{
    if (ZS_STATS)
        job->r->stats.pixels_written += (uint32_t)n;
}

/* 1: a rounded key of the triangle might reach B - 1, which saturates at B - 2. Half a bucket and the
 * error of the plane (plane.c) below it, no key can. */
ZS_ALWAYS_INLINE int zs_keys_may_saturate(const struct zs_job *job)
{
    const uint32_t limit = job->r->view.key_top - 0x10000u;
    return job->v[0]->d >= limit || job->v[1]->d >= limit || job->v[2]->d >= limit;
}

/* Colour a run of pixels that the depth test let through. */
ZS_ALWAYS_INLINE void zs_rows_run(struct zs_job *job, const struct zs_shader *shader, int32_t row,
                                  int32_t x0, int32_t x1, int32_t r0, int32_t r1)
{
    zs_rows_written(job, r1 - r0);
    shader->run(job, row, x0, x1, r0, r1);
}

#endif
