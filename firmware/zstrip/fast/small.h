/* The small-triangle fast path: triangles of up to 64 pixels in each direction are set up and drawn
 * by one function. For them, a call for each stage of the core would cost more than the pixels. The
 * picture is the same, bit for bit. It is for cores with a divide instruction; on others, stepping
 * by remainders is faster (core/edges.c). fast/fast_solid.c uses it for triangles of one colour,
 * fast/fast_texture.c for textured ones. Internal.
 *
 * The columns of an edge are computed as in core/edges.c, but count from ZS_TINY_SIDE left of the
 * top vertex, so that the numerator is positive. Extents are at most ZS_TINY = 2^14 sub-pixels, and
 * so are the offsets of rows from the upper end of an edge; so each product is below 2^29.1. In the
 * rows of an edge 0 <= off < dy, so x dy + off dx is between x dy and (x + dx) dy, its values at
 * the ends. So no column lies outside those of the vertices, which zs_small_look has tested against
 * the viewport.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SMALL_H
#define ZS_SMALL_H

#include "core/plane.h"
#include "shade/texture.h"
#include <stddef.h>

/* A small triangle in its strip, for set-up. Positions and differences are q24_8. */
struct zs_small {
    const struct zs_vertex *a; /* the top vertex. Its fields are loaded again where they are needed:
                                  registers are short in between */
    int32_t dx1, dx2, dy1, dy2, dd1, dd2; /* differences of the others from it; dd: of keys */
    int32_t area;
    int32_t column, row,
        n;         /* column of the top vertex's pixel; first row in the strip; number of rows */
    uint32_t rcp;  /* reciprocal of area << shift */
    int32_t shift; /* leading zeros of the area, 2 .. 18 */
    int32_t gx, gy;
    uint32_t key;  /* gradients of keys; the key at column 0 of the first row, a half added */
    int32_t x,
        off; /* distance of the top vertex right of the sample in column 0; distance of the first
                row's samples below the top vertex */
};

/* The state of the walk over scanlines; separate from set-up, because both need all registers.
 * Sides are the left one, then the right one. The column of a side in the next row is sum / span.
 * Column 0 is ZS_TINY_SIDE left of the top vertex. */
struct zs_sides {
    uint32_t side[4]; /* span, step; span, step */
    uint32_t down[2]; /* added for each row: bytes to the depth pointer; to the key */
    uint32_t sum[2];
    uint32_t key, gx; /* key at column 0 of the next row; added for each pixel */
    int32_t row, mid,
        end; /* rows of the frame: the first; the first below the middle vertex; one beyond the
                last */
    uintptr_t left; /* bytes from a row's first depth key to one left of column 0 */
    uint32_t turn;  /* the side that bends at the middle vertex: 0 left, 1 right; below it ... */
    uint32_t next[2], next_sum; /* ... that side's span, step and sum */
};

#if ZS_64

/* The same for a textured triangle, on cores whose registers hold 64 bits. at, down and right: two
 * words at column 0 of the next row; added for each row; added for each pixel. The first word is u
 * (uq0_32) 2^32 + key; no carry of the key reaches u where a pixel is covered, as the key is not
 * modulo 2^32. The second is v, shifted so that its row of the texture, times the width, begins at
 * bit 32. */
struct zs_texel_rows {
    struct zs_sides sides; /* without down[1], key and gx */
    uint64_t at[2], down[2], right[2];
    uint32_t column, scale, mask; /* shifts from u to its column, to v's word; of v's row */
    uint32_t tested;              /* number of pixels so far */
    uint32_t light, light_right,
        light_down; /* uq1_31, half of 2^-10 added, in the same way; only for lit triangles */
};

#else

/* The same for a textured triangle. at, down and right are the key, u and v (uq0_32): at column 0
 * of the next row; added for each row; added for each pixel. */
struct zs_texel_rows {
    struct zs_sides sides;    /* without down[1], key and gx */
    uint32_t at[4], down[3];  /* at[3]: number of pixels tested so far */
    uint32_t right[3], width; /* width: of the texture */
    uint32_t column, row;     /* shifts from u and v to column and row of the texture */
    uint32_t light, light_right,
        light_down; /* uq1_31, half of 2^-10 added, in the same way; only for lit triangles */
};

#endif

/* Set the light of a face. Return 0 if the shader has light at the vertices. */
ZS_ALWAYS_INLINE int zs_small_face_light(const struct zs_job *job, struct zs_texel_rows *w)
{
    if (job->shader->n_varyings != 2)
        return 0;
    w->light = ((uint32_t)job->tri->paint << 16) + ZS_TEXTURE_LIGHT_HALF;
    w->light_right = w->light_down = 0;
    return 1;
}

enum zs_small_outcome {
    ZS_SMALL_NOT = 0,  /* declined */
    ZS_SMALL_DONE = 1, /* no row in the strip */
    ZS_SMALL_ROWS = 2
};

#define ZS_SMALL_SAFE 0x20000u /* a bound for piece_base - d, which is 0xffff for the key B - 1 */

/* Fetch the vertices of job->tri. Return 0 if the triangle is not small, or its keys are not in one
 * linear piece of the mapping, or may reach B - 1 when rounded. piece_base is 2^n - 1, so that keys
 * differ in the bits in which their distances from it do. */
ZS_ALWAYS_INLINE int zs_small_look(const struct zs_job *job, struct zs_small *s)
{
    const struct zs_renderer *r = job->r;
    const struct zs_vertex *pool = r->vert;
    const uint16_t *v = job->tri->v;
    const struct zs_vertex *a = &pool[v[0]], *b = &pool[v[1]], *c = &pool[v[2]];
    const int32_t ax = a->x, ay = a->y;
    s->a = a;
    s->dx1 = b->x - ax;
    s->dx2 = c->x - ax;
    s->dy1 = b->y - ay;
    s->dy2 = c->y - ay;
    if (!zs_tiny(s->dx1, s->dx2, s->dy1, s->dy2)) /* |.| < 2^22, 0 <= dy */
        return 0;
    s->area = s->dx1 * s->dy2 - s->dx2 * s->dy1; /* <= 2^29 */
    if (s->area < ZS_TINY_AREA)
        return 0;
    const uint32_t d = a->d, db = b->d, dc = c->d, shift = r->view.piece_shift,
                   key = r->view.piece_base - d;
    if (((d ^ db) | (d ^ dc)) >> shift)
        return 0;
    /* keys near B - 1 are in the last piece, because a piece is 2^19 or more */
    if (!(key >> shift) && r->view.piece_base - zs_maxu32(zs_maxu32(d, db), dc) < ZS_SMALL_SAFE)
        return 0;
    s->dd1 = (int32_t)(db - d); /* in one piece, so |.| < 2^31 */
    s->dd2 = (int32_t)(dc - d);
    ZS_ANEW(s->dy1); /* so that the rows of the other vertices are not kept to compare them */
    ZS_ANEW(s->dy2);
    return 1;
}

/* Compute the gradients of the keys. Return 0 if they are too steep for this path. */
ZS_ALWAYS_INLINE int zs_small_keys(struct zs_small *s)
{
    const int shift = s->shift = zs_clz32((uint32_t)s->area); /* 2 .. 18 */
    const uint32_t rcp = s->rcp = zs_recip_inline((uint32_t)s->area << shift);
    const int32_t gx = zs_quotient(zs_mul_ss(s->dd1, s->dy2) - zs_mul_ss(s->dd2, s->dy1), rcp,
                                   shift, ZS_PLANE_KEY, 1);
    const int32_t up = zs_quotient(zs_mul_ss(s->dd1, s->dx2) - zs_mul_ss(s->dd2, s->dx1), rcp,
                                   shift, ZS_PLANE_KEY, 1);
    if (gx == ZS_TOO_STEEP || up == ZS_TOO_STEEP)
        return 0;
    s->gx = gx;
    s->gy = -up;
    return 1;
}

/* Return 1 if a triangle has samples beside the viewport. ax: its top vertex; dx1, dx2: the others
 * less it. */
ZS_ALWAYS_INLINE int zs_small_is_cut(int32_t ax, int32_t dx1, int32_t dx2, int32_t width)
{
    const int32_t least = zs_min32(dx1, dx2), most = zs_max32(dx1, dx2);
    return zs_first_sample(ax + (least & least >> 31)) < 0 ||
           zs_first_sample(ax + (most & ~(most >> 31))) > width;
}

/* Set job->tri_end, and *row to a triangle's first row in [y0, y1). Return how many it has there;
 * none: 0 or less. ay: its top vertex; dy: the lowest less that. */
ZS_ALWAYS_INLINE int32_t zs_small_rows(struct zs_job *job, int32_t ay, int32_t dy, int32_t y0,
                                       int32_t y1, int32_t *row)
{
    job->tri_end = zs_first_sample(ay + dy);
    *row = zs_max32(zs_first_sample(ay), y0);
    return zs_min32(job->tri_end, y1) - *row;
}

/* Find the triangle's rows in the strip, and the key at column 0 of the first one. Decline it if it
 * reaches beyond a side of the viewport. Sets job->tri_end unless it declines. */
ZS_ALWAYS_INLINE enum zs_small_outcome zs_small_place(struct zs_job *job, struct zs_small *s)
{
    ZS_ANEW(s->a);
    const int32_t ax = s->a->x, ay = s->a->y, column = ax >> ZS_SUBPX_BITS;
    if ((column < ZS_TINY_SIDE || column > job->width - ZS_TINY_SIDE) &&
        zs_small_is_cut(ax, s->dx1, s->dx2, job->width))
        return ZS_SMALL_NOT;
    s->n = zs_small_rows(job, ay, zs_max32(s->dy1, s->dy2), job->y0, job->y1, &s->row);
    if (s->n <= 0)
        return ZS_SMALL_DONE;
    s->column = column;
    /* |gx|, |up| <= 2^27; x is 2^14 .. 2^14.1, 0 <= off < 2^14: from is below 2^42.1 */
    s->x = (ax & (ZS_SUBPX_ONE - 1)) + ZS_TINY_SIDE * ZS_SUBPX_ONE - ZS_SUBPX_HALF;
    s->off = s->row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - ay;
    /* to column 0 and row, negative, a half added */
    const int64_t from = zs_mul_ss(s->gx, s->x) - zs_mul_ss(s->gy, s->off) - 128;
    s->key = s->a->d + 0x8000u + (uint32_t)(-from >> 8);
    return ZS_SMALL_ROWS;
}

/* Set up rows and sides. From here on the triangle is drawn, and it is counted. */
ZS_ALWAYS_INLINE void zs_small_sides(struct zs_job *job, const struct zs_small *s,
                                     struct zs_sides *w)
{
    job->r->stats.tris_setup++;
    w->down[0] = (uint32_t)job->pitch * 2u;
    const int32_t x = s->x, off = s->off, dx1 = s->dx1, dx2 = s->dx2, dy1 = s->dy1, dy2 = s->dy2,
                  row = s->row;
    w->row = row;
    w->end = row + s->n;
    w->left = (uintptr_t)(intptr_t)((s->column - ZS_TINY_SIDE - 1) * 2);
    w->side[0] = (uint32_t)dy2 * ZS_SUBPX_ONE;
    w->side[1] = (uint32_t)dx2 * ZS_SUBPX_ONE;
    w->side[2] = (uint32_t)dy1 * ZS_SUBPX_ONE;
    w->side[3] = (uint32_t)dx1 * ZS_SUBPX_ONE;
    w->sum[0] = (uint32_t)(x * dy2 + off * dx2) + w->side[0] - 1u;
    w->sum[1] = (uint32_t)(x * dy1 + off * dx1) + w->side[2] - 1u;
    w->turn = dy1 < dy2;
    const int32_t mid_dx = w->turn ? dx1 : dx2, mid_dy = w->turn ? dy1 : dy2,
                  dx = w->turn ? dx2 : dx1, dy = w->turn ? dy2 : dy1;
    w->mid = zs_max32(zs_min32(zs_first_sample(s->a->y + mid_dy), w->end), row);
    if (w->mid < w->end) { /* x + mid_dx is 2^7 .. 2^15.1, its offset 0 .. to_dy: both products
                              below 2^29.1 */
        const int32_t to_dx = dx - mid_dx, to_dy = dy - mid_dy; /* |.| < 2^15; 0 < to_dy < 2^14 */
        w->next[0] = (uint32_t)to_dy * ZS_SUBPX_ONE;
        w->next[1] = (uint32_t)to_dx * ZS_SUBPX_ONE;
        w->next_sum = (uint32_t)((x + mid_dx) * to_dy +
                                 (off + (w->mid - row) * ZS_SUBPX_ONE - mid_dy) * to_dx) +
                      w->next[0] - 1u;
    }
}

/* Find the pixels [x0, x1) of the next row, counted from column 0, and step to the row below. */
ZS_ALWAYS_INLINE void zs_small_columns(struct zs_sides *w, uint32_t *x0, uint32_t *x1)
{
    const uint32_t *const word = (const uint32_t *)(const void *)w; /* side[] comes first */
    uint32_t span, step, left, right;
    zs_two(word, (int)(offsetof(struct zs_sides, sum) / 4u), &left, &right);
    zs_two(word, 0, &span, &step);
    *x0 = left / span; /* 1 .. 2 ZS_TINY_SIDE; span is 256 .. 2^22 */
    left += step;
    zs_two(word, 2, &span, &step);
    *x1 = right / span;
    right += step;
    w->sum[0] = left;
    w->sum[1] = right;
}

/* At the middle vertex, replace the side that bends there. */
static inline void zs_small_turn(struct zs_sides *w)
{
    const uint32_t turn = w->turn;
    w->side[2 * turn] = w->next[0];
    w->side[2 * turn + 1] = w->next[1];
    w->sum[turn] = w->next_sum;
}

#if ZS_CHAIN_KEEPS
/* Decline job->tri, after those up to `drawn`, which are kept for the strips below; NULL: it is the
 * first. */
ZS_ALWAYS_INLINE int zs_small_declined(struct zs_job *job, const struct zs_tri *drawn)
{
    if (!drawn)
        return 0;
    job->tri = drawn;
    job->tri_end = job->y1;
    return 1;
}
#endif

#endif
