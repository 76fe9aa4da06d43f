/* The renderer's state. The struct is public so that it can be a static object of known size; its
 * fields belong to the library. zstrip.h includes this header.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_RENDERER_H
#define ZS_RENDERER_H

#include "zs_setup.h"

/* A transformed vertex, in the vertex pool. 12 bytes on every machine. */
struct zs_vertex {
    int32_t x, y; /* screen position, q24_8 px, right and down, at most the guard band from the
                     viewport's centre */
    uint32_t d;   /* depth: the key in uq16_16, or the distance z for mappings that need it.
                     >= 0xffffff00: the vertex is not projected, and its triangles are clipped */
};

/* A binned triangle, in the triangle pool. The pool is in the order of the walk. */
struct zs_tri {
    uint16_t v[3];     /* indices in the vertex pool: the topmost vertex first (the left one, if two
                          are level), then clockwise */
    uint16_t next;     /* the next triangle in its strip's list, or ZS_NIL */
    uint16_t paint;    /* the result of the shader's face function; for solid colours RGB565, most
                          significant byte first */
    uint16_t instance; /* number in the frame: the instances of all passes are numbered in order */
};

struct zs_view;
struct zs_point;
struct zs_renderer;

/* What a pass that is seen in a mirror adds to its view (effect/mirror.c). Its picture is that of
 * an eye behind the mirror, mirrored left to right, without what lies behind the mirror's plane. */
struct zs_reflection {
    /* Move the current instance by `eye`, and exchange its facing. Return 1. */
    int (*move)(struct zs_renderer *r);
    /* Return the distance of a point from the mirror's plane, in camera units * q2_30 * ratio, >= 0
     * on the side that is drawn; |.| < 2^62. */
    int64_t (*inside)(const struct zs_view *view, const struct zs_point *p);
    /* Return an outcode, with a bit more for a point that is not on that side. */
    uint32_t (*outcode)(const struct zs_view *view, const struct zs_point *p, uint32_t code);
    int64_t at;     /* of the plane n . c + at >= 0, |.| <= 2^61 */
    int32_t n[3];   /* q2_30 */
    int32_t eye[3]; /* camera units: the rounded eye minus the exact one */
};

/* The camera of a pass in camera units, 2^shift for each world unit. The shift is chosen so that
 * everything in view is below 2^30. */
struct zs_view {
    uint8_t perspective, screen_linear; /* flags; screen_linear: keys are linear on the screen */
    uint8_t piece_shift;   /* a triangle whose three vertices have the same (piece_base - d) >>
                              piece_shift lies in one octave: its keys are linear. 0: there is no
                              such test */
    uint8_t pixelwise;     /* 1: the mapping computes every pixel's key by itself; 2: and may be
                              more than a margin of 0.13 bucket beside that of the vertices */
    uint8_t key_octaves;   /* float: 2^exponent bits - 1 */
    uint8_t key_fraction;  /* float: bits of an octave's codes, uq16_16: mantissa bits + 16 */
    uint8_t key_common;    /* float: number of octaves from octave 2 to the one that ends at near
                              (depth/float.c) */
    uint16_t width, height; /* px: size of the viewport */
    uint16_t x, y;         /* px: its corner in the frame. Columns count from the viewport's left
                              side, rows from the frame's top */
    const struct zs_depth *depth; /* the depth mapping */
    const struct zs_reflection *mirror; /* NULL: the picture is not one in a mirror */
    int32_t z_near, z_far; /* camera units */
    int32_t cx, cy;        /* q24_8 px, the viewport's centre: cx from the viewport's left side, cy
                              from the frame's top */
    int32_t shift;         /* log2 of camera units for each world unit, -3 .. 30 */
    int32_t scale_bits;    /* perspective: screen q24_8 = x' * 2^scale_bits / z; orthographic:
                              x' / 2^scale_bits */
    int32_t snap;          /* 8 - sub-pixel bits */
    int32_t ratio;         /* q2_30, (0, 1]: focal length / 2^scale_bits */
    uint32_t piece_base;
    uint32_t key_top;      /* (B - 1) in uq16_16 */
    uint32_t key_mul;      /* the mapping's factor, 31 or 32 bits, ... */
    int32_t key_shift;     /* ... and its shift */
    uint32_t key_slow, key_known; /* a bound without a division: if all keys of a triangle are at
                              most key_known and differ by D <= key_slow, 1/z varies by at most D /
                              key_slow of its least value. Both 0: the mapping has no such bound */
    uint64_t guard;        /* a vertex with |x'| << scale_bits above guard * z is outside the guard
                              band */
    uint64_t key_far;      /* recip: (B - 1) f / (f - n) in uq_16, the key at z = infinity */
    int32_t key_lz;        /* float: with lz leading zeros of z, a vertex is in octave 2 + key_lz +
                              lz, or one less */
    uint32_t key_code;     /* float: 2^b - 2^mantissa bits in uq16_16: octave 2's linear keys,
                              extrapolated to r = near / z = 0 */
    int32_t rot[9];        /* q2_30: world to camera; its rows: x * ratio, -y * ratio, distance */
    int32_t pos[3];        /* the eye, world units */
    int32_t side[2][2];    /* q2_30: unit normals of the side planes as (x, z), (y, z) */
};

/* The transform of an instance to camera units: c = (m . p + t) / 2^shift, floor. This is the
 * layout of one row of it, in the order in which zs_matrix_row (arch/wide.h) reads it. With
 * ZS_ROW_WIDE the row is stored whole. Else it is split so that 32 bits hold every sum: m = high
 * 2^s + low, t = t_high 2^shift + t_low (core/xform.c). */
enum zs_row_word {
    ZS_ROW_LOW = 0,     /* [3]: |.| <= 2^14 */
    ZS_ROW_T_LOW = 3,   /* |.| <= 2^28 */
    ZS_ROW_S = 4,       /* 0 .. 15 */
    ZS_ROW_HIGH = 5,    /* [3] */
    ZS_ROW_S2 = 8,      /* shift - s, 0 .. 14 */
    ZS_ROW_T_HIGH = 9   /* camera units */
};

/* A plane through the eye and one edge of the dirty rows or columns. A point c is inside if lateral
 * * (its y or x) + z * (its z) + at >= 0. */
struct zs_edge {
    int32_t lateral, z; /* q2_30: unit normal in camera axes, inwards: its y or x, and its z */
    int64_t at;         /* q48_16 world units */
};

/* Cluster culling of the current instance (fast/clusters.c). Lengths are in mesh steps. */
struct zs_clusters {
    int16_t plane[6][3];   /* q4_12: normals of the frustum's planes, inwards ... */
    int32_t at[6];         /* q12: ... and offsets: n . center + at < -radius is outside */
    int32_t sure;          /* q12: n . center + at > sure + radius is inside */
    int32_t eye[3];        /* vector from the eye to the mesh's centre, 2^eye_shift steps */
    uint32_t margin, thin; /* 2^eye_shift steps: the cone test's margin is margin + thin / height */
    uint32_t next, from, end; /* the next cluster, and the next run of triangles [from, end) */
    uint8_t n_planes, n_whole; /* planes in use. Triangles are clipped at the first n_whole of them;
                              a cluster that reaches one of those gets no cone test */
    uint8_t eye_shift;
    int8_t cone;           /* 1: cull back-facing clusters; -1: front-facing ones; 0: neither */
    uint8_t counted;       /* 1: these clusters are already in the statistics */
    uint8_t known;         /* 1: vert_map holds a flag for each cluster, after the marks for
                              vertices; only used while `direct` is set */
};

struct zs_xform {
    const struct zs_instance *instance;
    uint32_t number;    /* of the instance, in the frame */
    uint8_t clip_depth; /* 1: vertices may lie before the near or beyond the far plane */
    uint8_t clip_guard; /* 1: vertices may lie outside the guard band */
    uint8_t cull;       /* enum zs_cull of the material; in a mirror ^ 1: BACK and FRONT change
                           places, and NONE becomes 3, which means the same */
    int32_t row[3 * ZS_ROW_WORDS_MAX]; /* three rows of ZS_ROW_WORDS each; one size on all cores */
};

#define ZS_LIT_COLORS 64 /* a palette of at most this size is lit as a whole, once for all triangles
                            with the same light; larger ones are lit texel by texel */

/* Cache: a texture with a lit palette. */
struct zs_lit {
    const struct zs_texture *of; /* the unlit texture; NULL: the cache is empty in this strip */
    uint16_t level;              /* its light, uq1_15 */
    struct zs_texture texture;   /* the same texture with .palette = color */
    uint16_t color[ZS_LIT_COLORS];
};

/* A large triangle that occludes tiles (fast/tiles.c). */
struct zs_cover {
    struct zs_vertex v[3];  /* from top to bottom */
    int32_t slope[3];       /* dx / dy of its edges in 2^-shift ... */
    uint8_t shift[3];       /* ... and the shifts */
    uint8_t mid_right;      /* 1: the middle vertex is to the right of the long edge */
    int32_t row_mid;        /* first row below the middle vertex */
    int32_t done[2];        /* rows [done[0], done[1]): bounds there are known already, from this
                               triangle and its neighbour together */
    uint32_t farthest;      /* upper bound of its keys */
};

struct zs_job;
struct zs_row;
struct zs_strip;
struct zs_pass;
struct zs_pass_memory;
struct zs_pass_ops;
struct zs_share_part;

/* Draw pixels [i, end) of a scanline, each as zs_texture_pixel does (shade/texture.h). Called if
 * job->gather is set, the texture is larger than a texel each way, and a reciprocal of 15 bits is
 * precise enough for its texels. */
typedef void zs_divided_fn(struct zs_job *job, const struct zs_row *row, int32_t i, int32_t end);

/* The fields in frequent use come first: a Cortex-M0 reaches 31 bytes, 31 half-words and 31 words
 * behind a pointer with one instruction, any Cortex-M with one of 16 bits. Hooks of accelerators
 * are NULL where the core alone works. */
struct zs_renderer {
    struct zs_config config; /* a copy: strip_h <= height; buffers, subpixel_bits and depth_bits are
                                not 0 */
    uint8_t strip_shift;        /* row / strip_h = row * strip_mul >> strip_shift */
    uint8_t direct;             /* 1: vertex v of the current instance is vert[vert_base + v] */
    uint8_t counting;           /* 1: first walk of the frame; only it counts triangles */
    uint8_t untouched;          /* first touch: which pixels of the current strip are uncleared:
                                   none, all, or some (fast/first_touch.c) */
    uint16_t n_strips, strip;   /* strip: the next one to draw */
    uint16_t band_end;          /* bins 0 .. band_end - 1 are lists, and complete. Bins from
                                   band_end on are counts: how many triangles begin there, of
                                   those met so far */
    uint16_t band_begun;        /* band_end when this walk began: it counts no strip from there
                                   on */
    uint16_t walk_x, walk_end;  /* columns [walk_x, walk_end) of the viewport: where the current
                                   instance is drawn */
    uint16_t walk_y, walk_y_end; /* rows of the frame in which the current pass is drawn */
    uint16_t walk_least, walk_most; /* union of walk_x and walk_end of all binned instances */
    uint16_t n_instances;       /* of all passes */
    uint16_t first;             /* the number of the current pass's first instance */
    uint16_t active;            /* list of triangles that continue from the strip above */
    uint16_t window[2];         /* columns [0] .. [1] - 1 of the current strip are drawn */
    uint8_t ready;              /* 1: zs_init succeeded */
    uint8_t large;              /* 1: some triangle of the frame is at least two tiles wide, and
                                   bounds of tiles exist */
    uint32_t n_tris, n_verts;   /* records in use in the pools */
    uint32_t vert_base;         /* pool vertices below this belong to earlier instances */
    uint16_t *color[2];      /* [strip_h][width], most significant byte first: the framebuffers of
                                the next strip and of the one given out last; with one buffer they
                                are the same */
    uint16_t *depth;         /* [strip_h][width]: depth buffer; NULL: no depth memory */
    uint16_t *bin;           /* [n_strips]: newest triangle that begins in the strip, or ZS_NIL;
                                below the band: how many begin there, modulo 2^16, an estimate */
    struct zs_tri *tri;      /* [max_tris] */
    struct zs_vertex *vert;  /* [max_verts] */
    uint16_t *vert_src;      /* [max_verts]: the vertex's number in its mesh */
    uint16_t *attr;          /* [max_verts][varyings] */
    const struct zs_scene *scene; /* of the current pass, borrowed from begin to end; NULL: no frame
                                     is open */
    const struct zs_pass_ops *passes; /* functions for frames in passes; NULL: one pass that is
                                            the whole frame */
    const struct zs_track_ops *track; /* zs_damage_track; NULL: off, every strip is drawn */
    uint16_t *vert_map;      /* [max_verts]: vertex number modulo a power of two -> index in the
                                pool; an entry may be stale, so vert_src is compared */
    uint32_t strip_mul;
    int (*edges)(struct zs_job *job, int32_t row);
    const struct zs_fast_touch *touch;
    const struct zs_fast_tiles *tiles;
    const struct zs_fast_batch *batch;
    const struct zs_fast_clusters *clusters_hooks;
    zs_divided_fn *divided;
    uint32_t vert_packed;       /* pool vertices that remained after the last packing (zs_bin_pack):
                                   binned triangles use all of them ... */
    uint32_t tris_packed;       /* ... and triangles that there were then */
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step); /* the usual zs_job.span */
    uint16_t *bound;         /* [n_strips][ZS_TILES(width)]: upper bound of the final keys in a tile
                                (fast/tiles.c) */
    uint8_t batched;            /* 1: the current instance is binned in batches (fast/batch.c) */
    uint8_t part_log2, part_down; /* parts (fast/parts.c): log2 of their triangles, and of the rows
                                   in a unit of their rows */
    uint8_t slow_first;         /* 1: the next triangle is a slow case that filled a pool when its
                                   batch's vertices were gathered; it is tried by itself */
    uint8_t noting;             /* 1: a part's rows are noted after the first walk */
    uint8_t refit;              /* 1: this frame disabled an accelerator; the next one enables it
                                   again */
    uint16_t parts_tris;        /* records of the triangle pool that hold their rows; 0: none */
    uint16_t part, part_end;    /* of the current instance */
    void *method_state;         /* the method's, while it draws a strip */
    struct zs_pass_memory *pass_memory; /* of all passes, the caller's; [0] holds their list */
    struct zs_xform xform;
    struct zs_shading shading; /* of the current instance */
    struct zs_view view;
    struct zs_camera camera;   /* a copy; a rotation of zeros has been replaced by the identity */
    struct zs_light light;     /* the scene's, or the usual light */
    struct zs_stats stats;
    /* zs_damage_compare; NULL: off, every column counts as changed */
    const struct zs_strip_hash_ops *strip_hash;
    struct zs_strip_hashes *sums; /* hashes of what the panel shows, the caller's */
    uint32_t *track_memory;       /* the caller's: the frame's hash, the records of the instances,
                                     and then track_due */
    uint32_t *track_due;          /* [n_strips]: dirty columns [first, end) as first + end * 2^16;
                                     0: the strip is clean */
    uint16_t draw_end;            /* no strip from this one on is dirty */
    uint16_t track_instances;     /* number of records */
    uint8_t track_columns;        /* zs_damage_columns; 0: draw all columns of a dirty strip */
    uint8_t track_anew;           /* 1: after zs_invalidate, what is not hashed may have changed:
                                     instances are checked and their extents found once more */
    uint8_t by_clusters;          /* 1: clusters of the current instance may be culled; 2: those
                                     outside [share->from, share->to) are left to the other core */
    int16_t (*drawn)[2];          /* [strip_h]: columns [0] .. [1] - 1 of a row hold colours and
                                     keys; the others are uncleared (fast/first_touch.c) */
    int16_t was[2];               /* the same of the current row, before the current triangle */
    uint32_t untouched_left;      /* number of uncleared pixels, while `untouched` says some */
    uint16_t edge_of[4];          /* edge[] is for rows [edge_of[0], edge_of[1]) and columns
                                     [edge_of[2], edge_of[3]) */
    struct zs_share_part *share;  /* while a part of the scene is binned (zs_share.h) */
    struct zs_edge edge[4];
    struct zs_clusters clusters;
    struct zs_cover cover[2];     /* the last two large triangles. The last one is
                                     cover[!cover_next], if cover_known */
    uint16_t bound_most;          /* upper bound of bound[] in the strips still to be drawn, ... */
    uint16_t bound_strip;         /* ... and in the current strip */
    uint8_t cover_next, cover_known, cover_waits; /* cover_waits: the tiles that the last large
                                     triangle covers by itself are not in bound[] yet */
    struct zs_lit lit;
    /* Called when a sink has failed: `last` and the strip before it may not have reached the panel;
     * where last is NULL, any strip may not. The hook is NULL without damage tracking
     * (damage/changed.c). */
    void (*unsent)(struct zs_renderer *r, const struct zs_strip *last);
};

#endif
