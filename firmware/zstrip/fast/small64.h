/* Set-up of small triangles (fast/small.h) on cores whose registers hold 64 bits, x86-64 and
 * AArch64: the same bits by fewer instructions, one triangle of the list after the other.
 *
 * On x86-64 it saves, with the loops over rows for it (fast_solid.c, fast_texels.c), 7 % of scene
 * relief (0.15 of 2.06 million instructions), 8 % of sheet (1.2 of 15.7), 24 % of relief_tex (0.9
 * of 3.76), 14 % of mesh_tex_lit (0.5 of 3.47). These files take 17,900 bytes there, 18,800 without
 * it. Other cores have none of it. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SMALL64_H
#define ZS_SMALL64_H

#include "fast/small.h"

#if ZS_64

/* What is the same for the triangles of an instance in a strip. */
struct zs_small64_of {
    const struct zs_vertex *pool;
    uint32_t limit, shift; /* of depths: the greatest that is taken; log2 of a linear piece */
    int32_t side, y0, y1;  /* rows of the strip; side: columns of the viewport less both margins */
    int32_t width;
};

/* A small triangle in its strip. Positions and differences are q24_8. */
struct zs_small64 {
    int64_t dx1, dx2, dy1, dy2; /* differences of the others from the top vertex */
    int64_t dd1, dd2, d;        /* its depth, and differences of depths */
    uint32_t change;            /* the greatest depth less the least */
    int32_t ax, ay;
    uint32_t area, rcp; /* as in struct zs_small */
    int32_t lz;
    int64_t gx, up;     /* gradients of keys, to the right and upwards */
    int64_t x, off;
    int32_t row, n, column;
};

/* Not inlined, so that the compiler takes *w for set. */
static ZS_SHARED void zs_small64_begin(const struct zs_job *job, struct zs_small64_of *of,
                                       struct zs_sides *w)
{
    const struct zs_renderer *r = job->r;
    of->pool = r->vert;
    of->limit = r->view.piece_base - ZS_SMALL_SAFE;
    of->shift = r->view.piece_shift;
    of->side = job->width - 2 * ZS_TINY_SIDE;
    of->width = job->width;
    of->y0 = job->y0;
    of->y1 = job->y1;
    w->down[0] = (uint32_t)job->pitch * 2u;
}

/* zs_small_look. */
ZS_ALWAYS_INLINE int zs_small64_look(const struct zs_small64_of *of, const struct zs_tri *tri,
                                     struct zs_small64 *s)
{
    const struct zs_vertex *const a = of->pool + tri->v[0], *const b = of->pool + tri->v[1],
                                  *const c = of->pool + tri->v[2];
    const int32_t ax = a->x, ay = a->y, dx1 = b->x - ax, dx2 = c->x - ax, dy1 = b->y - ay,
                  dy2 = c->y - ay;
    if (!zs_tiny(dx1, dx2, dy1, dy2))
        return 0;
    const int32_t area = dx1 * dy2 - dx2 * dy1;
    if (area < ZS_TINY_AREA)
        return 0;
    const uint32_t da = a->d, db = b->d, dc = c->d, least = zs_minu32(zs_minu32(da, db), dc),
                   most = zs_maxu32(zs_maxu32(da, db), dc);
    if ((least ^ most) >> of->shift || most > of->limit)
        return 0;
    s->ax = ax;
    s->ay = ay;
    s->dx1 = dx1;
    s->dx2 = dx2;
    s->dy1 = dy1;
    s->dy2 = dy2;
    s->d = da;
    s->dd1 = (int64_t)db - da;
    s->dd2 = (int64_t)dc - da;
    s->change = most - least;
    s->area = (uint32_t)area;
    return 1;
}

/* zs_quotient of a tiny triangle's keys. */
ZS_ALWAYS_INLINE int32_t zs_small64_quotient(int64_t n, uint32_t rcp, int32_t lz)
{
    const int64_t sign = n >> 63;
    uint64_t m = (uint64_t)((n ^ sign) - sign); /* <= 2^46 */
    int32_t down = 23 - lz;
    if (m >> 32) {
        const int32_t less = 32 - zs_clz32((uint32_t)(m >> 32));
        m >>= less;
        down -= less;
        if (down < ZS_PLANE_KEY)
            return ZS_TOO_STEEP;
    }
    const int32_t size = (int32_t)(((m * rcp >> (31 + down)) + 1u) >> 1);
    return (size ^ (int32_t)sign) - (int32_t)sign;
}

/* zs_small_keys. */
ZS_ALWAYS_INLINE int zs_small64_keys(struct zs_small64 *s)
{
    const int lz = s->lz = zs_clz32(s->area);
    const uint32_t rcp = s->rcp = zs_recip_inline(s->area << lz);
    const int32_t gx = zs_small64_quotient(s->dd1 * s->dy2 - s->dd2 * s->dy1, rcp, lz),
                  up = zs_small64_quotient(s->dd1 * s->dx2 - s->dd2 * s->dx1, rcp, lz);
    s->gx = gx;
    s->up = up;
    return gx != ZS_TOO_STEEP && up != ZS_TOO_STEEP;
}

/* zs_small_place. */
ZS_ALWAYS_INLINE enum zs_small_outcome zs_small64_place(struct zs_job *job,
                                                        const struct zs_small64_of *of,
                                                        struct zs_small64 *s)
{
    const int32_t ax = s->ax, ay = s->ay, column = ax >> ZS_SUBPX_BITS;
    if ((column < ZS_TINY_SIDE || column - ZS_TINY_SIDE > of->side) &&
        zs_small_is_cut(ax, (int32_t)s->dx1, (int32_t)s->dx2, of->width))
        return ZS_SMALL_NOT;
    const int32_t dy = zs_max32((int32_t)s->dy1, (int32_t)s->dy2);
    s->n = zs_small_rows(job, ay, dy, of->y0, of->y1, &s->row);
    if (s->n <= 0)
        return ZS_SMALL_DONE;
    s->column = column;
    s->x = (ax & (ZS_SUBPX_ONE - 1)) + ZS_TINY_SIDE * ZS_SUBPX_ONE - ZS_SUBPX_HALF;
    s->off = s->row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - ay;
    return ZS_SMALL_ROWS;
}

/* The key at column 0 of the first row, a half added; not modulo 2^32. */
ZS_ALWAYS_INLINE int64_t zs_small64_key(const struct zs_small64 *s)
{
    return s->d + 0x8000 + ((128 - s->gx * s->x - s->up * s->off) >> 8);
}

/* zs_small_sides. */
ZS_ALWAYS_INLINE void zs_small64_sides(struct zs_job *job, const struct zs_small64 *s,
                                       struct zs_sides *w)
{
    const int64_t x = s->x, off = s->off, dx1 = s->dx1, dx2 = s->dx2, dy1 = s->dy1, dy2 = s->dy2;
    const int32_t row = s->row, end = row + s->n;
    job->r->stats.tris_setup++;
    w->row = row;
    w->end = end;
    w->left = (uintptr_t)(intptr_t)((s->column - ZS_TINY_SIDE - 1) * 2);
    const uint32_t span0 = (uint32_t)dy2 * ZS_SUBPX_ONE, span1 = (uint32_t)dy1 * ZS_SUBPX_ONE;
    w->side[0] = span0;
    w->side[1] = (uint32_t)dx2 * ZS_SUBPX_ONE;
    w->side[2] = span1;
    w->side[3] = (uint32_t)dx1 * ZS_SUBPX_ONE;
    w->sum[0] = (uint32_t)(x * dy2 + off * dx2) + span0 - 1u;
    w->sum[1] = (uint32_t)(x * dy1 + off * dx1) + span1 - 1u;
    w->turn = dy1 < dy2;
    const int64_t mid_dx = w->turn ? dx1 : dx2, mid_dy = w->turn ? dy1 : dy2;
    const int32_t mid = zs_first_sample(s->ay + (int32_t)mid_dy);
    w->mid = end;
    if (mid < end) {
        const int64_t to_dx = (w->turn ? dx2 : dx1) - mid_dx,
                      to_dy = (w->turn ? dy2 : dy1) - mid_dy;
        w->mid = zs_max32(mid, row);
        w->next[0] = (uint32_t)to_dy * ZS_SUBPX_ONE;
        w->next[1] = (uint32_t)to_dx * ZS_SUBPX_ONE;
        w->next_sum = (uint32_t)((x + mid_dx) * to_dy +
                                 (off + (w->mid - row) * ZS_SUBPX_ONE - mid_dy) * to_dx) +
                      w->next[0] - 1u;
    }
}

/* Go on to the triangle after job->tri, if both are of one instance. Return 0: no. */
ZS_ALWAYS_INLINE int zs_small64_next(struct zs_job *job)
{
    struct zs_tri *const all = job->chain;
    const struct zs_tri *const tri = job->tri;
    const uint32_t next = tri->next;
    if (!all || next == ZS_NIL || all[next].instance != tri->instance)
        return 0;
    if (job->tri_end > job->y1 && job->keep) { /* as zs_raster_strip does */
        const uint32_t number = (uint32_t)(tri - all);
        **job->keep = (uint16_t)number;
        *job->keep = &all[number].next;
    }
    job->tri = all + next;
    return 1;
}

#endif
#endif
