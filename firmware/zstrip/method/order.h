/* The triangles of a strip in order of depth, rectangle by rectangle. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_METHOD_ORDER_H
#define ZS_METHOD_ORDER_H

#include "method/pieces.h"

struct zs_row;

/* The least depth at a single pixel so far; or, of layers, the greatest before a limit. Equal ones
 * are told apart by scene order, counted among the triangles that cover the pixel. */
struct zs_layer {
    int64_t d;
    uint32_t number;
};

#define ZS_ORDER_LAYERS 8 /* most layers of a pixel that a walk finds */

/* A method's state while it draws a strip: r->method_state. NULL between strips. */
struct zs_order {
    int32_t x0, x1, y0, y1; /* the rectangle in hand: columns and rows of the frame */
    uint32_t used;          /* records of the triangle pool in use: triangles, then pieces */
    uint32_t end;           /* records that triangles and pieces may take in this rectangle */
    uint16_t list;          /* its triangles and pieces, in the order in which they are drawn */
    uint8_t partial;        /* 1: the pool holds this rectangle's triangles alone */
    uint8_t torn;           /* 1: r->active has to be made anew for the strip below */
    uint8_t near_first;     /* 1: draw from near to far, with a bit for each pixel: */
    uint32_t *bits;         /* 1: drawn already; rows of the rectangle; NULL: a single pixel */
    int32_t words;          /* words of a row of bits */
    /* A single pixel: */
    struct zs_layer limit;  /* layers from this one on are drawn */
    uint32_t most;          /* layers that the pools have room for */
    uint32_t met;           /* triangles that cover it, so far */
    uint32_t kept;          /* so many of `best` are the pool's first triangles, met already */
    uint32_t pair_boxes, pair_rows; /* counted if ZS_STATS is 1, and cleared by who reads them:
                               pairs whose boxes meet, and rows at which two were compared */
    /* Spans: */
    const struct zs_tri *cuts_of; /* line[] are the half-planes of this piece */
    int32_t n_cuts;
    union { /* a pixel has no pieces */
        struct zs_linear line[ZS_PIECE_CUTS];
        struct {
            struct zs_layer best[ZS_ORDER_LAYERS]; /* the farthest before `limit`, from far to
                                                      near; or best[0], the nearest of all */
            uint16_t pick[ZS_ORDER_LAYERS];        /* their triangles */
        };
    };
};

/* Check r->config. Return ZS_OK, ZS_ERR_DEPTH or ZS_ERR_SIZE. */
int zs_order_begin(struct zs_renderer *r);
/* Bin and draw r->strip: struct zs_method.strip with o->near_first set. spare: records of the pool
 * that binning leaves free. */
void zs_order_strip(struct zs_renderer *r, struct zs_order *o, uint32_t spare);
/* Bring a list of triangles in the order in which they are drawn: o->list. Return 0 if the
 * rectangle has to be halved. (newell.c) */
int zs_order_newell(struct zs_renderer *r, uint16_t list);
/* Load an element, its box clipped to the rectangle. */
void zs_order_load(const struct zs_renderer *r, uint32_t t, struct zs_piece *p);
/* Return 1 if the box of a triangle or piece has a sample in columns [x0, x1), rows [y0, y1). */
int zs_order_in_box(const struct zs_renderer *r, uint32_t t, int32_t x0, int32_t x1, int32_t y0,
                    int32_t y1);
/* struct zs_method.full and .list */
void zs_order_full(struct zs_renderer *r);
uint16_t zs_order_list(struct zs_renderer *r);
/* Clip columns [*i0, *i1) of a row of job->tri to the rectangle, and to the piece's half-planes.
 * Return 0 if none is left. */
int zs_order_clip(struct zs_job *job, int32_t y, int32_t *i0, int32_t *i1);

#endif
