/* The accelerators that there are, and lists of them for zs_config.fast.
 *
 *     static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };
 *     config.fast = fast;
 *
 * Each override part of the renderer where that is quicker; the frame is the same, bit for bit, with any of them or none.
 * Only those that are named are linked. `make bench` prints what each is worth, in instructions and in bytes.
 * A list is kept for as long as the renderer is used. With ZS_NO_FAST = 1 all lists are empty, and fast/ need not be there.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_H
#define ZS_FAST_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const struct zs_fast zs_fast_touch;        /* no clearing and no test where nothing was drawn before */
extern const struct zs_fast zs_fast_tiles;        /* what large triangles hide is not set up */
extern const struct zs_fast zs_fast_batch;        /* vertices and facing of a mesh in one go, where the pools hold it */
extern const struct zs_fast zs_fast_clusters;     /* clusters that cannot be seen are left out, and vertices that only they use */
extern const struct zs_fast zs_fast_edges;        /* columns of small triangles; nothing on a core that cannot divide */
extern const struct zs_fast zs_fast_raw;          /* raw shading: test and store in one loop, small triangles in one go */
extern const struct zs_fast zs_fast_flat;         /* flat shading: the same */
extern const struct zs_fast zs_fast_smooth;       /* smooth shading: test and colours in one loop */
extern const struct zs_fast zs_fast_texture;      /* textures: set-up of small triangles, several divided pixels at a time */
extern const struct zs_fast zs_fast_texture_flat; /* the same, and palettes lit at once */
extern const struct zs_fast zs_fast_texture_smooth;
extern const struct zs_fast zs_fast_565, zs_fast_pal8, zs_fast_pal4; /* loops of a texel format, besides one of the last three */

/* Each of them by its name, for tables: X(batch) X(touch) ... */
#define ZS_FAST_EACH(X)                                                                                       \
    X(batch) X(touch) X(tiles) X(clusters) X(edges) X(raw) X(flat) X(smooth) X(texture) X(texture_flat)           \
    X(texture_smooth) X(565) X(pal8) X(pal4)

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
#define ZS_FAST_ALL                                                                                               \
    ZS_FAST_FRAME, ZS_FAST_CLUSTERS, ZS_FAST_RAW, ZS_FAST_FLAT, ZS_FAST_SMOOTH, ZS_FAST_TEXTURE, ZS_FAST_TEXTURE_FLAT,              \
        ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_565, ZS_FAST_PAL8, ZS_FAST_PAL4
#endif

#ifdef __cplusplus
}
#endif

#endif
