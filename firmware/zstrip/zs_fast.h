/* The accelerators, and lists of them for zs_config.fast.
 *
 *     static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };
 *     config.fast = fast;
 *
 * An accelerator overrides a part of the renderer where a special case is faster. The frame is the
 * same, bit for bit, with all of them, some, or none. Only accelerators that a program names are
 * linked.
 *
 * The caller keeps the list alive while the renderer is in use; a name may stand in it twice. With
 * ZS_NO_FAST = 1 all lists are empty, and the folder fast/ can be left out.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_H
#define ZS_FAST_H

#include "zstrip.h"

ZS_C_BEGIN

/* "Worth 1.2": without it a frame takes 1.2 times the instructions, on a Cortex-M3. Then its bytes
 * of flash there, -O2. tests/records/ACCELERATORS.txt has each scene. */

/* Of the frame. */
/* First touch: a pixel that is still uncleared is drawn without a clear and a depth test. Worth 1.9
 * for layers, 1.2 for a floor, else up to 1.1; 1,048 bytes. */
extern const struct zs_fast zs_fast_touch;
/* Occlusion culling: triangles and instances behind large triangles are rejected before set-up.
 * Worth 13 for eight layers; where nothing is hidden a frame takes up to 2 % more with it, scene
 * city of many boxes 7 %; 2,656 bytes. */
extern const struct zs_fast zs_fast_tiles;
/* Transforms and assembles a whole mesh at a time, or some 40 triangles where the vertex pool does
 * not hold it. Worth 1.1 to 2.1 where there are many triangles; 5,352 bytes. */
extern const struct zs_fast zs_fast_batch;
/* Culls clusters, and transforms no vertices that only culled clusters use. Worth 1.16 in flyover,
 * the demo scene whose meshes have clusters; 4,736 bytes. */
extern const struct zs_fast zs_fast_clusters;
/* Spans of small triangles, where the core divides; their set-up on a Cortex-M0 or M0+. Worth 1.01
 * to 1.04; 460 bytes. */
extern const struct zs_fast zs_fast_edges;

/* Of one shader. */
/* Depth test and store in one loop; a path for small triangles. Worth 1.6 to 2.4; 1,924
 * bytes. */
extern const struct zs_fast zs_fast_raw;
/* The same for flat shading, points, lines and faces under lamps. Worth 1.3 to 2; 1,924 bytes. */
extern const struct zs_fast zs_fast_flat;
/* Depth test and colours in one loop. Worth 1.1 to 1.2; 1,016 bytes. */
extern const struct zs_fast zs_fast_smooth;
/* Set-up of small triangles; several pixels with a perspective division at a time, of filters and
 * of all other textured shaders too. Worth 2 for small triangles, nothing for large ones; 4,048
 * bytes. */
extern const struct zs_fast zs_fast_texture;
/* The same, and lights a whole palette at once. Worth 1.2 to 1.5; 4,760 bytes. */
extern const struct zs_fast zs_fast_texture_flat;
/* As zs_fast_texture. Worth 1.1 to 1.5; 4,760 bytes. */
extern const struct zs_fast zs_fast_texture_smooth;

/* Of one texel format: its inner loops. Each is named together with one of the last three. Worth
 * 1.1 to 2; 968, 996 and 1,044 bytes. */
extern const struct zs_fast zs_fast_565, zs_fast_pal8, zs_fast_pal4;

/* The names of all accelerators, for tables: X(batch) X(touch) ... */
#define ZS_FAST_EACH(X)                                                                            \
    X(batch) X(touch) X(tiles) X(clusters) X(edges) X(raw) X(flat) X(smooth) X(texture)            \
    X(texture_flat) X(texture_smooth) X(565) X(pal8) X(pal4)

#if ZS_NO_FAST
#define ZS_FAST_END 0
#define ZS_FAST_FRAME 0
#define ZS_FAST_CLUSTERS 0
#define ZS_FAST_RAW 0
#define ZS_FAST_FLAT 0
#define ZS_FAST_SMOOTH 0
#define ZS_FAST_TEXTURE 0
#define ZS_FAST_TEXTURE_FLAT 0
#define ZS_FAST_TEXTURE_SMOOTH 0
#define ZS_FAST_565 0
#define ZS_FAST_PAL8 0
#define ZS_FAST_PAL4 0
#define ZS_FAST_ALL 0
#else
#define ZS_FAST_END 0
#define ZS_FAST_FRAME &zs_fast_batch, &zs_fast_touch, &zs_fast_tiles, &zs_fast_edges
#define ZS_FAST_CLUSTERS &zs_fast_clusters
#define ZS_FAST_RAW &zs_fast_raw
#define ZS_FAST_FLAT &zs_fast_flat
#define ZS_FAST_SMOOTH &zs_fast_smooth
#define ZS_FAST_TEXTURE &zs_fast_texture
#define ZS_FAST_TEXTURE_FLAT &zs_fast_texture_flat
#define ZS_FAST_TEXTURE_SMOOTH &zs_fast_texture_smooth
#define ZS_FAST_565 &zs_fast_565
#define ZS_FAST_PAL8 &zs_fast_pal8
#define ZS_FAST_PAL4 &zs_fast_pal4
#define ZS_FAST_ALL                                                                                \
    ZS_FAST_FRAME, ZS_FAST_CLUSTERS, ZS_FAST_RAW, ZS_FAST_FLAT, ZS_FAST_SMOOTH, ZS_FAST_TEXTURE,   \
        ZS_FAST_TEXTURE_FLAT, ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_565, ZS_FAST_PAL8, ZS_FAST_PAL4
#endif

ZS_C_END

#endif
