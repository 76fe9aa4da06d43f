/* Pieces of triangles, and which of two is nearer. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_METHOD_PIECES_H
#define ZS_METHOD_PIECES_H

#include "core/bin.h"

/* A linear function of a pixel: at + gx * i + gy * j. */
struct zs_linear {
    int64_t at, gx, gy;
};

#define ZS_PIECE_CUTS 6 /* most half-planes that a piece adds to its triangle's edges */

/* A part of the screen, loaded from the pool: the pixels of a box at which all lines are < 0. */
struct zs_piece {
    uint32_t source;        /* its triangle */
    uint32_t near;          /* the least zs_vertex.d */
    int32_t x0, x1, y0, y1; /* box: columns and rows of the frame */
    int32_t flat;           /* 1: `plane` is set */
    int32_t n;              /* number of lines; 0: they are not set */
    struct zs_linear plane; /* d, with an error below ZS_PLANE_ERROR at covered pixels */
    struct zs_linear line[3 + ZS_PIECE_CUTS]; /* three edges, then half-planes */
    const struct zs_vertex *v[3];
};
#define ZS_PLANE_ERROR ((1u << 14) + 2u)

/* The value of a linear function. |value| < 2^61: see pieces.c. */
static inline int64_t zs_linear_at(const struct zs_linear *f, int32_t i, int32_t j)
{
    return f->at + f->gx * i + f->gy * j;
}

/* A piece takes two records of the triangle pool, behind the triangles: a copy of its triangle, and
 * struct zs_tri with other meanings: */
#define ZS_PIECE_SOURCE v[0] /* the triangle it is a piece of */
#define ZS_PIECE_OTHER v[1]  /* it is the part that is nearer than this triangle's plane, ... */
#define ZS_PIECE_PARENT v[2] /* ... of this piece; ZS_NIL: of the triangle */
#define ZS_PIECE_NEARER paint /* 1: nearer; 0: the part that is not */

/* Return the triangle that list element t is, or is a piece of. */
static inline uint32_t zs_piece_source(const struct zs_renderer *r, uint32_t t)
{
    return t < r->n_tris ? t : r->tri[t + 1u].ZS_PIECE_SOURCE;
}

/* Load element t, a triangle or a piece, without plane and lines. The box is not clipped. */
void zs_piece_load(const struct zs_renderer *r, uint32_t t, struct zs_piece *p);
/* Set p->plane, and the lines of element t; once. */
void zs_piece_plane(struct zs_piece *p);
void zs_piece_lines(const struct zs_renderer *r, uint32_t t, struct zs_piece *p);
/* Compute the half-planes of element t alone. Return their number. */
int32_t zs_piece_cuts(const struct zs_renderer *r, uint32_t t, struct zs_linear *line);
/* The number of half-planes of element t. */
int32_t zs_piece_depth(const struct zs_renderer *r, uint32_t t);
/* Return 1 if a triangle's edge has all samples of columns [x0, x1), rows [y0, y1) on its outer
 * side: the triangle covers none of them. */
int zs_piece_beside(const struct zs_renderer *r, uint32_t t, int32_t x0, int32_t x1, int32_t y0,
                    int32_t y1);
/* Clip columns [*i0, *i1) of row j to those where f < 0. Return 0 if none is left. */
int zs_linear_clip(const struct zs_linear *f, int32_t j, int32_t *i0, int32_t *i1);

/* At which pixels of a rectangle two pieces meet. */
enum zs_piece_order {
    ZS_PIECE_NEAR = 1, /* p is nearer at some pixel of both */
    ZS_PIECE_FAR = 2   /* q is nearer at some pixel of both */
};
/* Return 1 if it is clear, without a look at pixels, that p is nearer than q at no pixel of both:
 * Newell's five tests. If 0, *nearer is a function that is < 0 where p is nearer. */
int zs_piece_clear(struct zs_piece *p, struct zs_piece *q, struct zs_linear *nearer);
/* Return enum zs_piece_order, or-ed: exact, by a look at all rows that both have. q may be NULL:
 * the pixels are those of p alone. f is < 0 where p is nearer. Lines are set. */
uint32_t zs_piece_meet(const struct zs_piece *p, const struct zs_piece *q,
                       const struct zs_linear *f);

#endif
