/* Ways to remove hidden surfaces other than the depth buffer. A program names one in
 * zs_config.method, and only that one is linked. The picture never depends on strip height, pool
 * sizes, accelerators or machine.
 *
 *     ZS_RENDERER_NO_DEPTH(screen, 240, 240, 16, 600, 400, ZS_VARYINGS_FLAT);
 *     ...
 *     screen_config.method = &zs_method_painter;
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_METHOD_H
#define ZS_METHOD_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Painter's algorithm: triangles are drawn from far to near, by their farthest vertex; of two that
 * are equally far, the first in scene order is drawn first. No depth memory.
 *
 * Right   where every triangle lies wholly behind or in front of those that it overlaps.
 * Wrong   where triangles intersect or overlap in a cycle; and where a large triangle has its
 *         farthest vertex behind a small one that it covers (a floor below things).
 * Needs   zs_depth_none, else ZS_ERR_DEPTH; max_tris >= 2 and max_verts >= 6, else ZS_ERR_SIZE.
 *         Depth states have no effect.
 * Cost    a sort of the triangles of each strip, n log n. Pools that do not hold a strip's
 *         triangles cost walks over the scene: each draws the farthest that are left. */
extern const struct zs_method zs_method_painter;

/* The hierarchical depth buffer: the depth buffer's picture and keys, bit for bit. Each tile of a
 * strip (8 rows, 8 columns or more) has an upper bound of its keys, and so has each block of 4x4
 * tiles, and of 4x4 blocks. What lies behind is skipped: triangles before set-up; pieces of
 * scanlines before the depth test; instances in a walk that a full pool has cut (it bins one strip,
 * of which a part is drawn). A tile on which nothing was drawn is not cleared: the first triangle
 * that covers all of it is drawn without a test.
 *
 * Right   wherever the depth buffer is: all mappings with depth memory, else ZS_ERR_DEPTH; all
 *         depth states and shaders; damage tracking. Not frames in passes: ZS_ERR_PASS.
 * Memory  none of its own: it takes the place of the accelerators `touch` and `tiles`, and their
 *         part of the arena (ZS_DRAWN_BYTES + ZS_BOUND_BYTES), 3 bytes a tile, block ... Tiles are
 *         as wide as that allows. If zs_config.fast names the two, they are not used.
 * Cost    3 KB of flash (Cortex-M3, -O2); 96 bytes of stack for a strip, 120 more while a triangle
 *         is drawn. The fast paths for whole and small triangles are not used; those for spans are.
 *         A tile is looked at again after as many pixels as it has were drawn in it. */
extern const struct zs_method zs_method_hiz;
/* The same with weaker tests of a piece, to compare: zs_method_hiz takes the nearest key of the
 * piece's pixels. These take that of the triangle's plane at the tile's corners, where keys are
 * linear on the screen (else as the other), and that of the triangle's nearest vertex. */
extern const struct zs_method zs_method_hiz_corner;
extern const struct zs_method zs_method_hiz_vertex;

#ifdef __cplusplus
}
#endif

#endif
