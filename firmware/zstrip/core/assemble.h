/* Triangles of the current instance: corners, facing, box. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ASSEMBLE_H
#define ZS_ASSEMBLE_H

#include "core/bin.h"
#include "core/xform.h"

/* What became of a triangle. */
/* clang-format off: a table */
enum zs_fate {
    ZS_FATE_DRAWN, ZS_FATE_OFFSCREEN, ZS_FATE_FACING, ZS_FATE_ZERO, ZS_FATE_EMPTY,
    ZS_FATE_NEAR, ZS_FATE_FAR, ZS_FATE_INDEX, ZS_FATES,
    ZS_FATE_OPEN = ZS_FATES, /* nothing yet */
    ZS_FATE_FULL /* a pool is full: nothing was done, or pieces of a clipped triangle are binned */
};
/* clang-format on */

/* A candidate: the places of its corners, clockwise; once it has been looked at, the top one first
 * (of two the left one), and its rows [y0, y1). */
struct zs_candidate {
    uint32_t slot[3];
    int32_t y0, y1;
};

/* Why a triangle cannot be seen whose corners have these outcodes in common. */
static inline enum zs_fate zs_fate_outside(uint32_t all)
{
    return all & ZS_OUT_NEAR ? ZS_FATE_NEAR : all & ZS_OUT_FAR ? ZS_FATE_FAR : ZS_FATE_OFFSCREEN;
}

/* Twice the area, q_16 px^2; positive clockwise on the screen (y down). |.| < 2^45 */
int64_t zs_assemble_area(const struct zs_vertex *a, const struct zs_vertex *b,
                         const struct zs_vertex *c);
/* Whether a triangle of that area is culled. */
int zs_assemble_culled(int64_t area, uint32_t cull);
/* Whether the box of a projected triangle holds a sample of the columns that are drawn; slots are
 * numbers in `pool`. */
enum zs_fate zs_assemble_box(const struct zs_renderer *r, const struct zs_vertex *pool,
                             struct zs_candidate *at);
/* Bin triangle t. *piece: of a clipped one, the next piece of its fan; 0 before and after. */
enum zs_fate zs_assemble_tri(struct zs_renderer *r, uint32_t t, uint32_t *piece);

/* ---- fan.c: a triangle that is cut at near, far or the guard band, in pieces ----------------- */

enum zs_fate zs_fan_bin(struct zs_renderer *r, uint32_t t, uint32_t *piece);

#endif
