/* Triangle assembly for the current instance: vertices, facing, bounding box. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ASSEMBLE_H
#define ZS_ASSEMBLE_H

#include "core/bin.h"
#include "core/xform.h"

/* The outcome of assembly: drawn, or the reason of the reject; in the order of the counts in struct
 * zs_stats. */
/* clang-format off: a table */
enum zs_outcome {
    ZS_OUTCOME_DRAWN, ZS_OUTCOME_NEAR, ZS_OUTCOME_FAR, ZS_OUTCOME_OFFSCREEN, ZS_OUTCOME_FACING,
    ZS_OUTCOME_ZERO, ZS_OUTCOME_EMPTY, ZS_OUTCOME_INDEX, ZS_OUTCOMES,
    ZS_OUTCOME_OPEN = ZS_OUTCOMES, /* not decided yet */
    ZS_OUTCOME_FULL /* a pool is full. Nothing was binned, or only the first pieces of a clipped
                    triangle */
};
/* clang-format on */

/* A candidate triangle. slot: its vertices in the pool, clockwise. zs_assemble_box rotates slot so
 * that the topmost vertex comes first (the left one, if two are level), and sets the rows [y0, y1).
 */
struct zs_candidate {
    uint32_t slot[3];
    int32_t y0, y1;
};

/* The reason why a triangle is outside the view, from the outcode bits that its vertices share. */
static inline enum zs_outcome zs_outcome_outside(uint32_t all)
{
    return all & ZS_OUT_NEAR  ? ZS_OUTCOME_NEAR
           : all & ZS_OUT_FAR ? ZS_OUTCOME_FAR
                              : ZS_OUTCOME_OFFSCREEN;
}

/* Return twice the signed area, q_16 px^2; positive if a, b, c are clockwise on the screen (y
 * down). |.| < 2^45 */
int64_t zs_assemble_area(const struct zs_vertex *a, const struct zs_vertex *b,
                         const struct zs_vertex *c);
/* Return 1 if a triangle with this signed area is culled by its facing. cull: zs_xform.cull */
int zs_assemble_culled(int64_t area, uint32_t cull);
/* Test the bounding box of a projected triangle against the rows and columns that are drawn; slots
 * index `pool`. Return ZS_OUTCOME_DRAWN if the box holds a sample, ZS_OUTCOME_OFFSCREEN or
 * ZS_OUTCOME_EMPTY if not. */
enum zs_outcome zs_assemble_box(const struct zs_renderer *r, const struct zs_vertex *pool,
                                struct zs_candidate *at);
/* Assemble and bin triangle t. *piece is the next piece of the fan of a clipped triangle; it is 0
 * before the first call and after the triangle is done. */
typedef enum zs_outcome zs_assemble_fn(struct zs_renderer *r, uint32_t t, uint32_t *piece);
zs_assemble_fn zs_assemble_tri;

/* ---- fan.c: a triangle that has to be clipped, in pieces ------------------------------------- */

/* As zs_assemble_tri, for a triangle that has to be clipped. */
enum zs_outcome zs_fan_bin(struct zs_renderer *r, uint32_t t, uint32_t *piece);

#endif
