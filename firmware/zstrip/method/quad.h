/* Quadrilaterals on the screen, which lines and points are drawn as. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_METHOD_QUAD_H
#define ZS_METHOD_QUAD_H

#include "core/assemble.h"
#include "core/clip.h"

struct zs_bounds;

#define ZS_WIDTH_MAX 64 /* px, of lines and points */
/* Sub-pixels: corners are no further from the ends than 33 px. Ends are held this much inside the
 * guard band, so that corners stay in it too. */
#define ZS_QUAD_GUARD ((int32_t)ZS_GUARD_SUBPX - 40 * ZS_SUBPX_ONE)
_Static_assert(ZS_GUARD_PX - 80 >= ZS_SIZE_MAX / 2, "what is beyond ZS_QUAD_GUARD is not seen");

/* A line's end, or a point. */
struct zs_end {
    struct zs_vertex v;
    int32_t z; /* camera units; not always set */
    uint16_t attr[ZS_VARYINGS_MAX ? ZS_VARYINGS_MAX : 1];
};

struct zs_quad {
    struct zs_vertex v[4];        /* clockwise */
    const struct zs_end *from[4]; /* whose varyings a corner has */
};

/* Bin a quadrilateral of primitive t as two triangles, 0 1 2 and 0 2 3, which are pieces `first`
 * and first + 1 of it; those before *piece are binned already. Return the outcome. ZS_OUTCOME_FULL:
 * a pool is full, *piece is the piece that is next. */
enum zs_outcome zs_quad_bin(struct zs_renderer *r, const struct zs_quad *quad, uint32_t t,
                            uint32_t first, uint32_t *piece);

/* Enlarge a bounding sphere by the reach of a line or point of a width in px. Check what all
 * primitives need of an instance. Return ZS_OK, ZS_ERR_RANGE or ZS_ERR_MESH. */
int zs_quad_widen(const struct zs_renderer *r, const struct zs_instance *in, uint32_t width,
                  struct zs_bounds *b);

/* Return the width in px that a field of 0 .. ZS_WIDTH_MAX stands for. */
static inline int32_t zs_quad_width(uint32_t field)
{
    return field ? (int32_t)field : 1;
}

#endif
