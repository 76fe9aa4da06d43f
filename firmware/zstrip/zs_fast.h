/* The accelerators, and lists of them for zs_config.fast.
 *
 *     static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };
 *     config.fast = fast;
 *
 * An accelerator overrides a part of the renderer where a special case is faster. The frame is the
 * same, bit for bit, with all of them, some, or none. Only accelerators that a program names are
 * linked. `make bench` prints what each one saves in instructions and costs in bytes.
 *
 * The caller keeps the list alive while the renderer is in use. With ZS_NO_FAST = 1 all lists are
 * empty, and the folder fast/ can be left out.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_H
#define ZS_FAST_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of the frame. */
extern const struct zs_fast zs_fast_touch;    /* first touch: a pixel that is still uncleared is
                                                 drawn without a clear and a depth test */
extern const struct zs_fast zs_fast_tiles;    /* occlusion culling: triangles and instances behind
                                                 large triangles are rejected before set-up */
extern const struct zs_fast zs_fast_batch;    /* transforms and assembles a whole mesh at a time, if
                                                 the vertex pool holds it */
extern const struct zs_fast zs_fast_clusters; /* culls clusters, and transforms no vertices that
                                                 only culled clusters use */
extern const struct zs_fast zs_fast_edges;    /* spans of small triangles; does nothing on a core
                                                 without a divide instruction */

/* Of one shader. */
extern const struct zs_fast zs_fast_raw;          /* depth test and store in one loop; a path for
                                                     small triangles */
extern const struct zs_fast zs_fast_flat;         /* the same for flat shading */
extern const struct zs_fast zs_fast_smooth;       /* depth test and colours in one loop */
extern const struct zs_fast zs_fast_texture;      /* set-up of small triangles; several pixels with
                                                     a perspective division at a time */
extern const struct zs_fast zs_fast_texture_flat; /* the same, and lights a whole palette at once */
extern const struct zs_fast zs_fast_texture_smooth; /* as zs_fast_texture */

/* Of one texel format: its inner loops. Each is named together with one of the last three. */
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

#ifdef __cplusplus
}
#endif

#endif
