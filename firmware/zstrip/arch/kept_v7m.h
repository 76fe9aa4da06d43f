/* What fast/texture_v7m.c keeps in the job from one triangle of an instance to the next, on
 * Armv7-M. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_KEPT_V7M_H
#define ZS_KEPT_V7M_H

#include "arch/wide.h"

#if ZS_V7M

struct zs_tri;
struct zs_vertex;

struct zs_kept {
    /* shifts from v and u to row and column, 256 subtracted from the first; the texture's width */
    uint32_t row, column, width;
    const void *texel;                 /* the texture's, like palette */
    const uint16_t *palette;
    uint32_t pixel;                    /* which loop of pixels; on the stack: its address */
    uint32_t up[2];                    /* log2 of the size that counts for the error */
    uint32_t bits, slow, bias[2];      /* 32 - uv_bits; for zs_texture_affine; 2^-9 texels */
    uint32_t shift, last;              /* log2 of a linear piece; the least depth declined */
    const uint16_t *attr;              /* r->attr, and bytes of a vertex there */
    uint32_t attr_bytes;
    const struct zs_vertex *pool;      /* r->vert */
    uint32_t edge;                     /* as in fast/solid_v7m.c, like base and beside */
    int32_t width_px, y0, y1;          /* the job's width */
    uint32_t pitch;                    /* bytes from row to row */
    uintptr_t base, beside;
    const struct zs_tri *all;          /* r->tri */
    uint16_t **keep;                   /* the job's */
    uint32_t chain;                    /* the instance whose triangles it goes on to; 65536: none */
    uint32_t of;                       /* the instance's number; ZS_NIL: none */
};

/* Forget what is kept: the viewport may be another one. */
#define zs_kept_forget(job) ((void)((job)->kept.of = ZS_NIL))

#else
#define zs_kept_forget(job) ((void)(job))
#endif

#endif
