/* Small textured triangles on Armv7-M (fast/texture_v7m.c). Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_TEXTURE_V7M_H
#define ZS_TEXTURE_V7M_H

#include "core/job.h"

#if ZS_V7M

#include "fast/small.h"

struct zs_texture_hand;

/* Called for each triangle that is about to be drawn. Return 0: it is declined; 1: it has been
 * drawn; 2: draw it with h->of.palette and without light. */
typedef int zs_texture_lit_fn(struct zs_job *job, struct zs_texture_hand *h);

/* The stack frame of the function in assembler. */
struct zs_texture_hand {
    struct zs_texel_rows w;        /* sides.row is an address; mid and end count from it */
    int32_t dx1, dy1, dx2, dy2;    /* as in struct zs_small */
    uint32_t rcp;                  /* the same */
    int32_t down;                  /* 22 less the leading zeros of the area */
    int32_t x, off;                /* as in struct zs_small */
    uint32_t change, a[2];         /* of depth; u and v of the top vertex */
    uint32_t limit;                /* rows to the middle vertex, or all */
    const struct zs_tri *tri;      /* the triangle */
    const struct zs_tri *drawn;    /* the last that was drawn */
    int32_t row_last;              /* of tri */
    uint32_t tested, set_up;       /* number of pixels, of triangles */
    zs_texture_lit_fn *lit;        /* NULL: all texels are drawn as they are */
    struct zs_job *job;
    struct zs_kept of;             /* a copy of job->kept */
};

/* Draw job->tri, and those after it as long as none is declined, as zs_fast.draw. */
int zs_texture_v7m(struct zs_job *job, zs_texture_lit_fn *lit);

#endif

#endif
