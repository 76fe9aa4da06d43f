/* Small textured triangles on Armv7-M (fast/texture_v7m.c). Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_TEXTURE_V7M_H
#define ZS_TEXTURE_V7M_H

#include "core/job.h"

#if ZS_V7M

#include "fast/small.h"

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
    int32_t tri_end;               /* of tri */
    uint32_t tested, set_up;       /* number of pixels, of triangles */
    uint32_t lit;                  /* not 0: job->fast->shine is called for each triangle */
    struct zs_job *job;
    struct zs_kept of;             /* a copy of job->kept */
};

/* Draw job->tri, and those after it as long as none is declined, as zs_fast.draw. */
int zs_texture_v7m(struct zs_job *job);

#endif

#endif
