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

#ifdef __cplusplus
}
#endif

#endif
