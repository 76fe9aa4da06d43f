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
 *         max_tris, 3/7 are triangles, the others boxes.
 *         Resolve hooks find keys in zs_target.depth, at the cost of a second ray for each pixel.
 *         Without hooks zs_strip.depth holds no keys.
 * Cost    for each ray, tests of boxes by the logarithm of the triangles in its strip: 5 to 25
 *         times a frame of the depth buffer. Pools that do not hold a strip's triangles cost walks
 *         over the scene, one for each part of the strip; meshes with a hierarchy (bvh) are then
 *         walked only where the part is. zs_fast_clusters is not used. */
extern const struct zs_method zs_method_raycast;

#ifdef __cplusplus
}
#endif

#endif
