/* What a renderer is set up with: depth mappings, the configuration, the bytes of its arena; and
 * what it counts. zstrip.h includes this header.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SETUP_H
#define ZS_SETUP_H

#include "zs_scene.h"

ZS_C_BEGIN

/* How a distance z between near n and far f becomes a key of b bits, B = 2^b. */
struct zs_depth;
extern const struct zs_depth zs_depth_recip;  /* (1/n - 1/z) / (1/n - 1/f) * (B - 1), perspective */
extern const struct zs_depth zs_depth_linear; /* (z - n) / (f - n) * (B - 1), any camera; with a
                                                 perspective one it costs a reciprocal a pixel */

/* n / z as an unsigned float of e exponent bits and m = b - e mantissa bits, subtracted from 2^b.
 * With 2^-(k+1) <= r = n / z <= 2^-k, k at most 2^e - 2 (the last octave reaches down to r = 0),
 *   key = 2^b - ((2^e - 2 - k) 2^m + r 2^(k+1+m))
 * 0 at near. A bucket is 2^-(m+1) .. 2^-m of the distance while z < n * 2^(2^e - 1); beyond that, a
 * bucket keeps its width in r. Perspective cameras. */
extern const struct zs_depth zs_depth_e3m13; /* to z = 128 n; finest */
extern const struct zs_depth zs_depth_e4m12; /* to z = 32,768 n */
extern const struct zs_depth zs_depth_e5m11; /* to all distances */
/* The first of the three that keeps its precision up to far. Take it when in doubt. Perspective
 * cameras only (else ZS_ERR_DEPTH); orthographic ones take zs_depth_linear or zs_depth_none.
 * NUMERICS.md has measurements. */
extern const struct zs_depth zs_depth_float;
/* No depth memory: a triangle covers what was drawn before it, in scene order. The arena is
 * ZS_DEPTH_BYTES smaller (ZS_RENDERER_NO_DEPTH). For one convex mesh whose back faces are culled,
 * or for instances and triangles that are listed from far to near. Any camera. Depth states have
 * no effect; strips and targets have depth NULL. */
extern const struct zs_depth zs_depth_none;

/* The mappings with depth memory, for tables: X(name, any_camera). any_camera  1: orthographic
 * cameras too; 0: perspective ones alone. */
#define ZS_DEPTH_EACH(X) X(recip, 0) X(linear, 1) X(e3m13, 0) X(e4m12, 0) X(e5m11, 0) X(float, 0)

struct zs_fast;
struct zs_method;

struct zs_config {
    uint16_t width, height;            /* px, 1 .. ZS_SIZE_MAX */
    uint16_t strip_h;                  /* rows of a strip, >= 1; more than height means height */
    uint16_t max_tris;                 /* binned triangles, 1 .. ZS_POOL_MAX */
    uint16_t max_verts;                /* transformed vertices, 3 .. ZS_POOL_MAX */
    uint8_t varyings;                  /* 16-bit values a vertex, 0 .. ZS_VARYINGS_MAX: the largest
                                          ZS_VARYINGS_* of the shaders in use */
    uint8_t buffers;                   /* strip buffers, 1 or 2; 0: 1 */
    uint8_t subpixel_bits;             /* 8 or 4; 0: 8 */
    uint8_t depth_bits;                /* 8 .. 16; 0: 16 */
    const struct zs_depth *depth;      /* the mapping; must be given */
    const struct zs_fast *const *fast; /* accelerators, the last one NULL (zs_fast.h); kept by the
                                          caller; NULL: none */
    const struct zs_method *method;    /* how hidden surfaces are removed (zs_method.h); NULL: by
                                          the depth buffer */
};

/* Bytes of arena for a configuration: the sum of its pools. The result is the same on every
 * machine, because the arena holds indices and no pointers. Arguments are constants, or variables
 * without side effects; strip_h <= height. */
#define ZS_ROUND4(n) ((ZS_U32(n) + 3u) & ~ZS_U32(3))
#define ZS_BUFFERS(buffers) ((buffers) == 0 ? 1u : ZS_U32(buffers))
#define ZS_COLOR_BYTES(width, strip_h, buffers)                                                    \
    (ZS_BUFFERS(buffers) * ZS_ROUND4(ZS_U32(width) * ZS_U32(strip_h) * 2u))
#define ZS_DEPTH_BYTES(width, strip_h) ZS_ROUND4(ZS_U32(width) * ZS_U32(strip_h) * 2u)
#define ZS_STRIPS(height, strip_h) ((ZS_U32(height) + ZS_U32(strip_h) - 1u) / ZS_U32(strip_h))
#define ZS_DRAWN_BYTES(strip_h) (ZS_U32(strip_h) * 4u)
#define ZS_TILE_LOG2 5
#define ZS_TILES(width) ((ZS_U32(width) + 31u) >> ZS_TILE_LOG2)
#define ZS_BOUND_BYTES(width, height, strip_h)                                                     \
    ZS_ROUND4(2u * ZS_TILES(width) * ZS_STRIPS(height, strip_h))
#define ZS_BIN_BYTES(height, strip_h) ZS_ROUND4(ZS_STRIPS(height, strip_h) * 2u)
#define ZS_TRI_BYTES(max_tris) (ZS_U32(max_tris) * 12u)
#define ZS_VERT_BYTES(max_verts, varyings)                                                         \
    (ZS_U32(max_verts) * 12u + 2u * ZS_ROUND4(ZS_U32(max_verts) * 2u) +                            \
     ZS_ROUND4(ZS_U32(max_verts) * ZS_U32(varyings) * 2u))
#define ZS_ARENA_BYTES(width, height, strip_h, max_tris, max_verts, varyings, buffers)             \
    (ZS_COLOR_BYTES(width, strip_h, buffers) + ZS_DEPTH_BYTES(width, strip_h) +                    \
     ZS_DRAWN_BYTES(strip_h) + ZS_BOUND_BYTES(width, height, strip_h) +                            \
     ZS_BIN_BYTES(height, strip_h) + ZS_TRI_BYTES(max_tris) + ZS_VERT_BYTES(max_verts, varyings))

/* An arena as a static array, aligned for DMA and caches. */
#define ZS_ARENA(name, bytes) static uint32_t name[((bytes) + 3u) / 4u] ZS_ALIGNED

/* Counts of the frame that zs_frame_begin started; complete after zs_frame_end. Triangles are
 * counted once, but tris_setup and tris_hidden in each strip; vertices and pixels as often as they
 * are worked on. tris_in is the sum of the ten counts from tris_frustum to tris_index. */
struct zs_stats {
    uint32_t instances_in;
    uint32_t instances_culled; /* the sphere is outside the view, or hidden: */
    uint32_t instances_hidden; /* behind large triangles of earlier instances; also in culled */
    uint32_t clusters_in;      /* of the instances that were not culled */
    uint32_t clusters_culled;  /* outside the view, or all back-facing */
    uint32_t tris_in;          /* in all instances */
    uint32_t tris_frustum;     /* in culled instances, hidden ones too */
    uint32_t tris_cluster;     /* in culled clusters */
    /* the outcomes of the others, in the order of enum zs_outcome (core/assemble.h) */
    uint32_t tris_drawn;       /* binned, whole or in clipped pieces */
    uint32_t tris_near;        /* wholly before near, or clipped away there */
    uint32_t tris_far;         /* wholly beyond far */
    uint32_t tris_offscreen;   /* beside the frame or the columns drawn, or beyond the guard band */
    uint32_t tris_facing;      /* the culled side */
    uint32_t tris_zero;        /* no area after snapping, or one vertex three times */
    uint32_t tris_empty;       /* no sample in the bounding box */
    uint32_t tris_index;       /* a vertex number out of range */
    uint32_t tris_clipped;     /* at near, far or guard; also in drawn or in a reject */
    uint32_t verts_transformed;
    uint32_t tris_setup;      /* set-ups: a triangle in a strip */
    uint32_t tris_hidden;     /* set-ups saved: a triangle that is covered in a strip, or beside the
                                 columns that are drawn of it (zs_damage_columns) */
    uint32_t pixels_tested;   /* covered by triangles that are drawn, tested or not */
    uint32_t pixels_untested; /* of these: drawn without a test, as nothing was drawn there yet */
    uint32_t pixels_written;  /* of these: coloured; 0 unless built with ZS_STATS = 1 */
    uint32_t strips;          /* given out so far */
    uint32_t strips_clean;    /* with dirty_w 0; 0 without damage tracking */
    uint32_t strips_skipped; /* not drawn (zs_damage_track, zs_frame_skip). Triangles that are in no
                                other strip count as culled, or not at all */
    uint32_t passes;         /* walks over the scene, and how often a walk stopped to draw what the
                                pools held and to make room (methods that drop triangles for a
                                later walk do not stop). 1: the pools held the frame. These are not
                                the passes of zs_pass.h */
    uint32_t max_tris_used, max_verts_used; /* high-water marks of the pools. Size pools by a frame
                                in which all strips are drawn: zs_damage_track bins less */
    uint32_t sorted;          /* triangles that a method sorted, summed over strips */
    uint32_t splits;          /* triangles that a method cut in two (zs_method_depthsort) */
    uint32_t pairs;           /* pairs of triangles that a method compared (zs_method_depthsort) */
    uint32_t rays;            /* rays that were cast (zs_method_raycast) */
    uint32_t pixels_hidden, tiles_tested; /* zs_method_hiz: of pixels_tested, those that a tile
                                 hides; pieces of scanlines that were compared with a tile */
};

ZS_C_END

#endif
