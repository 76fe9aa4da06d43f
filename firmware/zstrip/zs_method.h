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

/* No depth memory, as zs_depth_none, for the two methods below: a vertex has a
 * depth that is linear on the screen. Any camera. */
extern const struct zs_depth zs_depth_order;

/* Depth sort (Newell, Newell and Sancha, 1972): triangles are drawn from far to near, and split
 * where no order is right. No depth memory. A split moves no pixel: a piece is drawn as its
 * triangle is, in fewer columns of a row.
 *
 * Right   on cycles and intersections, at every pixel: the triangle that is nearest there is drawn
 *         last; of equally near ones, the first in scene order. Depths are finer than 16-bit keys:
 *         the picture is that of zs_depth_recip (orthographic: zs_depth_linear) but where two
 *         surfaces are within a bucket. A triangle thinner than 2^-12 px may count as level.
 * Needs   zs_depth_order, else ZS_ERR_DEPTH; max_tris >= 2 and max_verts >= 6, else ZS_ERR_SIZE.
 *         A quarter of max_tris is kept for pieces, two records each. Depth states have no effect.
 *         Passes are refused.
 * Cost    n log n in a strip where depths do not overlap. Each pair that does is compared,
 *         zs_stats.pairs: at worst n^2. Triangles that intersect are split, zs_stats.splits: n^2
 *         again. A rectangle of a strip whose pieces find no room is halved, and sorted anew; so is
 *         one with more than 256 narrow triangles. The least is a pixel, for which all triangles
 *         are tried. Scenes of the bench take 1.3 to 8 times the instructions of the depth buffer
 *         on a Cortex-M3; 1,600 slivers 12, a sheet of 20,000 triangles 22 times. */
extern const struct zs_method zs_method_depthsort;

/* Coverage, a visibility buffer of one bit a pixel: the list of zs_method_depthsort from near to
 * far. Each pixel is coloured once, by the nearest triangle; covered pixels are skipped, 32 at a
 * time. No depth memory. For scenes with many layers and dear shaders.
 *
 * Right   as zs_method_depthsort, with the same picture. But a shader with .opaque 0 sees the
 *         background at every pixel, and what is behind its triangle is not drawn.
 * Needs   as zs_method_depthsort; of the triangle pool, width / 8 * strip_h bytes more (a quarter
 *         of max_tris at most; rectangles are smaller if they need more).
 * Cost    as zs_method_depthsort, less the pixels that are drawn over. */
extern const struct zs_method zs_method_coverage;

#ifdef __cplusplus
}
#endif

#endif
