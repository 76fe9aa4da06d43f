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

ZS_C_BEGIN

/* Painter's algorithm: triangles are drawn from far to near, by their farthest vertex; of two that
 * are equally far, the first in scene order is drawn first. No depth memory.
 *
 * Right   where every triangle lies wholly behind or in front of those that it overlaps.
 * Wrong   where triangles intersect or overlap in a cycle; and where a large triangle has its
 *         farthest vertex behind a small one that it covers (a floor below things).
 * Needs   zs_depth_none, else ZS_ERR_DEPTH; max_tris >= 2 and max_verts >= 6, else ZS_ERR_SIZE.
 *         Depth states have no effect. Passes are refused: ZS_ERR_PASS.
 * Cost    a sort of the triangles of each strip, n log n. Pools that do not hold a strip's
 *         triangles cost walks over the scene: each draws the farthest that are left. */
extern const struct zs_method zs_method_painter;

/* A node of a hierarchy of spheres over a mesh's triangles, for zs_method_raycast. Nodes are in
 * preorder: node 0 holds all triangles, a node's first child follows it, and the renderer passes by
 * a node's descendants by its skip. `zsim convert --bvh` writes them. The renderer does not check
 * them. */
struct zs_bvh_node {
    int16_t center[3]; /* of a sphere around the vertices of its triangles, steps */
    uint16_t radius;   /* of that sphere, steps, rounded up */
    uint32_t first;    /* its first triangle; its last is before node skip's first, or the mesh's */
    uint32_t skip;     /* the next node that is not below it. Its number plus 1: it is a leaf; node
                          0's: the number of nodes */
};

/* Ray casting: for each pixel, a ray through its sample finds what is seen there, by a hierarchy of
 * boxes. The frame is that of the depth buffer, bit for bit, with any depth mapping and depth
 * states; zs_stats.rays is its number of pixels.
 *
 * Wrong   where a shader is not opaque (zs_shader.h): each pixel is coloured once, by the triangle
 *         that drew there last, over the background.
 * Needs   depth memory, else ZS_ERR_DEPTH; max_tris >= 4 and max_verts >= 6, else ZS_ERR_SIZE. Of
 *         max_tris, 3/7 are triangles, the others boxes. Passes are refused: ZS_ERR_PASS.
 *         Resolve hooks find keys in zs_target.depth, at the cost of a second ray for each pixel.
 *         Without hooks zs_strip.depth holds no keys.
 * Cost    for each ray, tests of boxes by the logarithm of the triangles in its strip. Scenes of
 *         the bench take 7 to 150 times the instructions of the depth buffer on a Cortex-M3. Pools
 *         that do not hold a strip's triangles cost walks over the scene, one for each part of the
 *         strip; meshes with a hierarchy (bvh) are then walked only where the part is.
 *         zs_fast_clusters is not used. */
extern const struct zs_method zs_method_raycast;

/* The hierarchical depth buffer: the depth buffer's picture and keys, bit for bit. Each tile of a
 * strip (8 rows, 8 columns or more) has an upper bound of its keys, and so has each block of 4x4
 * tiles, and of 4x4 blocks. What lies behind is skipped: triangles before set-up; pieces of
 * scanlines before the depth test; instances in a walk that a full pool has cut (it bins one strip,
 * of which a part is drawn). A tile on which nothing was drawn is not cleared: the first triangle
 * that covers all of it is drawn without a test.
 *
 * Right   wherever the depth buffer is: all mappings with depth memory, else ZS_ERR_DEPTH; all
 *         depth states; damage tracking; all shaders but cut-outs (zs_filter.h), flat shadows
 *         (zs_shadow.h) and windows (zs_environment.h), which refuse it: ZS_ERR_DEPTH. Not frames
 *         in passes: ZS_ERR_PASS.
 * Memory  none of its own: it uses the part of the arena of the accelerators `touch` and `tiles`
 *         (ZS_DRAWN_BYTES + ZS_BOUND_BYTES), 3 bytes for each tile and for each block. Tiles are as
 *         narrow as that allows. If zs_config.fast names the two accelerators, they are not used.
 * Cost    3 KB of flash (Cortex-M3, -O2); 96 bytes of stack for a strip, 120 more while a triangle
 *         is drawn. The fast paths for whole and small triangles are not used; those for spans are.
 *         A tile is looked at again after as many pixels as it has were drawn in it. */
extern const struct zs_method zs_method_hiz;
/* The same with weaker tests of a piece, to compare: zs_method_hiz takes the nearest key of the
 * piece's pixels. These take that of the triangle's plane at the tile's corners, where keys are
 * linear on the screen (else as the other), and that of the triangle's nearest vertex. */
extern const struct zs_method zs_method_hiz_corner;
extern const struct zs_method zs_method_hiz_vertex;

/* No depth memory, as zs_depth_none, for the two methods below: a vertex has a depth that is linear
 * on the screen. Any camera. */
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
 *         Passes are refused: ZS_ERR_PASS.
 * Cost    n log n in a strip where depths do not overlap. Each pair that does is compared,
 *         zs_stats.pairs: at worst n^2. Triangles that intersect are split, zs_stats.splits: n^2
 *         again. A rectangle of a strip whose pieces find no room is halved, and sorted anew; so is
 *         one with more than 256 narrow triangles, and one whose pairs become more than its
 *         triangles times its pixels. The least is a pixel, for which all triangles are tried. So a
 *         strip takes at most pixels * triangles * log2(pixels). Where shaders mix colours and the
 *         pools do not hold the layers of a pixel, each eight layers of each pixel are a walk over
 *         the scene: give them more.
 *         Scenes of the bench take 1.3 to 8 times the instructions of the depth buffer on a
 *         Cortex-M3; 1,600 slivers 12, a sheet of 20,000 triangles 22 times. */
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

/* All methods, for tables: X(name, mapping, tris, verts, records).
 * mapping      what zs_config.depth has to be; 0: any mapping with depth memory.
 * tris, verts  the least max_tris and max_verts.
 * records      1: it keeps records of its own in the triangle pool. For one walk over the scene,
 *              the pool should then hold 5/2 times the triangles, and 64 more. */
#define ZS_METHOD_EACH(X)                                                                          \
    X(hiz, 0, 1, 3, 0)                                                                             \
    X(painter, &zs_depth_none, 2, 6, 0)                                                            \
    X(depthsort, &zs_depth_order, 2, 6, 1)                                                         \
    X(coverage, &zs_depth_order, 2, 6, 1)                                                          \
    X(raycast, 0, 4, 6, 1)

ZS_C_END

#endif
