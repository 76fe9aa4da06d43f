/* The renderer's memory. Its size is public, so that it can be a static object; its fields belong to
 * the library. zstrip.h includes this header.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_RENDERER_H
#define ZS_RENDERER_H

#include "zs_setup.h"

/* A transformed vertex, in the vertex pool. 12 bytes on every machine. */
struct zs_vertex {
    int32_t x, y; /* q24_8 px, right and down; |. - the frame's middle| <= guard */
    uint32_t d;   /* depth: a key in uq16_16, or the distance z where the mapping says so;
                     >= 0xffffff00: not projected, its triangles are clipped */
};

/* A triangle that waits for its strip, in the triangle pool; the pool's order is that of the walk. */
struct zs_tri {
    uint16_t v[3];     /* in the vertex pool: the top one, of two the left one, then clockwise */
    uint16_t next;     /* the next one in its strip's list, or ZS_NIL */
    uint16_t paint;    /* what the shader's face function gave: for solid colours RGB565, wire order */
    uint16_t instance; /* in the frame: of all passes, one after the other */
};

/* The camera of a pass, brought to camera units: 2^shift to a world unit, so that everything that
 * can be seen is below 2^30. */
struct zs_view {
    int32_t rot[9];        /* q2_30: world to camera; rows x * ratio, -y * ratio, distance */
    int32_t pos[3];        /* world units */
    int32_t z_near, z_far; /* camera units */
    int32_t cx, cy;        /* q24_8, the viewport's middle: from its left side, from the frame's top */
    int32_t shift;         /* log2 of camera units to a world unit */
    int32_t scale_bits;    /* screen q24_8 = x' * 2^scale_bits / z; orthographic: x' / 2^scale_bits */
    int32_t snap;          /* 8 - sub-pixel bits */
    int32_t ratio;         /* q2_30, (0, 1]: focal length over 2^scale_bits */
    int32_t side[2][2];   /* q2_30: unit normal of the side planes, (x or y, z) */
    const struct zs_depth *depth; /* the mapping */
    uint16_t width, height; /* px, of the viewport ... */
    uint16_t x, y;          /* ... and where in the frame it begins: columns count from there, rows from the
                               frame's top */
    uint64_t guard;        /* |x'| << scale_bits beyond guard * z is outside the guard band */
    uint32_t key_mul;      /* the mapping's factor, 31 or 32 bits ... */
    int32_t key_shift;     /* ... and its shift */
    uint64_t key_far;      /* recip: (B - 1) f / (f - n) in uq_16, the key of z at infinity */
    uint32_t key_top;      /* (B - 1) in uq16_16 */
    uint32_t key_slow, key_known; /* vertices with keys up to key_known, at most key_slow apart: 1/z changes by at most
                              that part of the least; both 0: not known without division */
    uint32_t piece_base;   /* keys are linear on a triangle whose vertices' (piece_base - d) >> piece_shift agree; ... */
    uint8_t piece_shift;   /* ... 0: not known */
    uint8_t perspective, screen_linear; /* flags: keys are linear on the screen; ... */
    uint8_t pixelwise;     /* ... each is found by itself */
    uint8_t key_mantissa, key_octaves; /* float: mantissa bits, and 2^exponent bits - 1 */
    uint8_t key_fraction;  /* float: key_mantissa + 16; ... */
    uint8_t key_common;    /* ... octaves from 2 on, to near's (depth_float.c); ... */
    int32_t key_lz;        /* ... what a vertex's has above 2, less the leading zeros of z, or 1 less ... */
    uint32_t key_code;     /* ... and the key where octave 2 begins */
};

/* One instance's way to camera units, c = (m . p + t) / 2^shift, floor, in the order in which zs_row (wide.h) reads it:
 * whole, or a row of m and its t cut where 32 bits carry every sum, m = high 2^s + low, t = t_high 2^shift + t_low
 * (xform.c). */
enum zs_row_word {
    ZS_ROW_LOW = 0,     /* [3]: |.| <= 2^14 */
    ZS_ROW_T_LOW = 3,   /* |.| <= 2^28 */
    ZS_ROW_S = 4,       /* 0 .. 15 */
    ZS_ROW_HIGH = 5,    /* [3] */
    ZS_ROW_S2 = 8,      /* shift - s, 0 .. 14 */
    ZS_ROW_T_HIGH = 9   /* camera units */
};

/* A plane through the eye and a row's or column's edge: its unit normal, camera axes, pointing to where is drawn. */
struct zs_edge {
    int32_t lateral, z; /* q2_30: y or x, and z */
    int64_t at;    /* q48_16 world units, added */
};

/* What clusters of the current instance are tested by (cluster.c); mesh steps. */
struct zs_clusters {
    int16_t plane[6][3];   /* q4_12: normals, pointing inwards ... */
    int32_t at[6];         /* ... q12, added: n . center + at < -radius is outside */
    int32_t sure;          /* q12: n . center + at > sure + radius is inside */
    int32_t eye[3];        /* from it to the mesh's centre, 2^eye_shift steps */
    uint32_t margin, thin; /* 2^eye_shift steps: of the cone: margin + thin / height */
    uint32_t next, from, end; /* the cluster, and the triangles [from, end), that are next */
    uint8_t n_planes, n_whole; /* of the planes, the first n_whole cut; a cluster they cut has no cone */
    uint8_t eye_shift;
    int8_t cone;           /* not 0: the cone is used; -1: of front faces */
    uint8_t counted;       /* 1: statistics hold them */
    uint8_t known;         /* 1: a flag a cluster lies behind the marks in vert_map (while `direct` is set) */
};

struct zs_xform {
    const struct zs_instance *instance;
    uint32_t number;    /* in the frame */
    uint8_t clip_depth; /* 1: vertices may be before near or beyond far */
    uint8_t clip_guard; /* 1: vertices may be outside the guard band */
    int32_t row[3 * ZS_ROW_WORDS_MAX]; /* three, ZS_ROW_WORDS each; one size on all cores */
};

#define ZS_LIT_COLORS 64 /* palettes up to here are lit once for triangles of one light, not texel by texel */

/* A texture whose palette is lit. */
struct zs_lit {
    const struct zs_texture *of; /* NULL: none in this strip yet */
    uint16_t level;              /* its light, uq1_15 */
    struct zs_texture texture;   /* the same with .palette = color */
    uint16_t color[ZS_LIT_COLORS];
};

/* A large triangle, as its bounds need it (fast/tiles.c). */
struct zs_cover {
    struct zs_vertex v[3];  /* from the top */
    int32_t slope[3];       /* of its edges, 2^-shift ... */
    uint8_t shift[3];
    uint8_t mid_right;      /* the middle vertex is to the right of the long edge */
    int32_t row_mid;        /* first row below the middle vertex */
    int32_t done[2];        /* rows [0] .. [1] - 1: bounds are known there, from it and another */
    uint32_t farthest;      /* at least the farthest vertex's key */
};

struct zs_job;
struct zs_pass;
struct zs_pass_memory;
struct zs_pass_kernel;

struct zs_renderer { /* what is used most comes first: a Cortex-M0 reaches 31 bytes, 31 half-words, 31 words at once */
    struct zs_config config; /* strip_h <= height */
    int (*edges)(struct zs_job *job, int32_t row); /* accelerators; NULL: the core does it */
    const struct zs_fast_touch *touch;
    const struct zs_fast_tiles *tiles;
    const struct zs_fast_batch *batch;
    const struct zs_fast_clusters *clusters_hooks;
    uint8_t strip_shift;        /* row / strip_h = row * strip_mul >> strip_shift */
    uint8_t direct;             /* 1: vertex v of the current instance has place vert_base + v */
    uint8_t counting;           /* 1 in the frame's first walk: triangles are counted once */
    uint8_t ready;              /* zs_init succeeded */
    uint8_t large;              /* 1: the frame has triangles that may hide others: two tiles wide */
    uint8_t untouched;          /* of the strip in hand, what holds no colours and keys yet: nothing, all, some (zs_fast_touch) */
    uint16_t n_strips, strip;   /* strip: the next to be drawn */
    uint16_t band_end;          /* bins are complete for strips below it */
    uint16_t walk_x, walk_end;  /* columns of the viewport that the current instance is drawn in; ... */
    uint16_t walk_y, walk_y_end; /* rows of the frame that the pass in hand is drawn in */
    uint16_t walk_least, walk_most; /* ... that any in the pools is */
    uint16_t active;            /* list of triangles that went on from the strip before */
    uint32_t n_tris, n_verts;   /* used of the pools */
    uint32_t vert_base;         /* pool vertices below it belong to earlier instances */
    uint32_t vert_packed;       /* those below it were held by binned triangles when last looked at */
    uint32_t strip_mul;
    uint16_t *color[2];      /* [strip_h][width], wire order: the next strip's, and the one given out last; one buffer: the same */
    uint16_t *depth;         /* [strip_h][width] */
    uint16_t *bound;         /* [n_strips][ZS_TILES(width)]: no key of a strip's tile stays farther (fast/tiles.c) */
    uint16_t *bin;           /* [n_strips]: newest triangle that begins in the strip, or ZS_NIL */
    struct zs_tri *tri;      /* [max_tris] */
    struct zs_vertex *vert;  /* [max_verts] */
    uint16_t *vert_src;      /* [max_verts]: the vertex's number in the current mesh */
    uint16_t *vert_map;      /* [max_verts]: number modulo max_verts -> pool, unless stale */
    uint16_t *attr;          /* [max_verts][varyings] */

    const struct zs_scene *scene; /* borrowed from begin to end; NULL: no frame is open; of the pass in hand */
    const struct zs_pass_kernel *passes; /* NULL: one pass, the whole frame */
    struct zs_pass_memory *pass_memory;  /* of all passes, the caller's; the first one holds their list */
    uint16_t n_instances; /* of all passes */
    uint16_t first;       /* of the pass in hand: its first instance's number */
    uint8_t refit;        /* 1: the frame left out accelerators that the next one may have */
    struct zs_xform xform;
    struct zs_shading shading; /* of the current instance */
    struct zs_view view;
    struct zs_camera camera;   /* its rotation is never all 0: no rotation is written out */
    struct zs_light light;     /* the scene's, or the usual one */
    struct zs_stats stats;
    const struct zs_watch_kernel *watch; /* NULL: everything counts as changed */
    struct zs_strip_hashes *sums;         /* [n_strips][columns], the panel's; 0: not known */
    uint16_t draw_end;            /* strips from it on need not be drawn */
    const struct zs_track_kernel *track; /* NULL: all strips are drawn */
    uint32_t *track_memory;       /* the caller's: sum of the frame, records of instances ... */
    uint32_t *track_due;          /* ... [n_strips]: columns to be drawn, first + end * 2^16; 0: none */
    uint16_t track_instances;     /* that there are records for */
    uint16_t window[2];           /* columns [0] .. [1] - 1 of the strip in hand are drawn */
    uint8_t track_columns;        /* 0: all columns of a strip that is due */
    int16_t (*drawn)[2];          /* [strip_h]: columns [0] .. [1] - 1 of a row hold colours and keys (fast/first_touch.c) */
    int16_t was[2];               /* the same of a row, before the triangle in hand */
    uint32_t untouched_left;      /* how many pixels hold none, where some do */
    uint16_t edge_of[4];          /* what edge[] holds: rows [0] .. [1] - 1 are drawn, and columns [2] .. [3] - 1 */
    struct zs_edge edge[4];
    uint8_t by_clusters;          /* 1: of the current instance, only some are drawn */
    struct zs_clusters clusters;
    struct zs_cover cover[2];     /* the last two large triangles: cover[!cover_next] is known if cover_known */
    uint16_t bound_most;          /* no bound is farther ... */
    uint16_t bound_strip;         /* ... and none of the strip in hand */
    uint8_t cover_next, cover_known, cover_waits; /* its own bounds are still to be found */
    struct zs_lit lit;
};

#endif
