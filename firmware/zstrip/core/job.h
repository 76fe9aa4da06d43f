/* One triangle in one strip, while it is drawn: what set-up, rows, test and shaders share.
 * Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_JOB_H
#define ZS_JOB_H

#include "core/fx.h"
#include "zstrip.h"

struct zs_fast;
struct zs_fast_texel;
struct zs_row;
struct zs_job;

#define ZS_NIL 65535u
_Static_assert(ZS_POOL_MAX < ZS_NIL, "16-bit indices need a value for none");
_Static_assert(sizeof(struct zs_tri) == 12, "ZS_TRI_BYTES");
_Static_assert(sizeof(struct zs_vertex) == 12, "ZS_VERT_BYTES");

/* The span of a row: first sample at or right of its left edge, and of its right edge. */
struct zs_cut {
    int16_t x0, x1; /* |.| <= 2^14 + 1; may be beyond the frame, and x0 > x1 */
};
#define ZS_CUT_ROWS 16 /* rows that are cut at a time */
_Static_assert(2 * ZS_GUARD_PX + 2 < 32768, "columns are 16 bits");

/* A plane over the screen: value(i, j) = base + gx * (i - ia) + gy * (j - ja) modulo 2^32. */
struct zs_plane {
    uint32_t base, gx, gy; /* uq16_16 */
};

/* The same in 40.24 bits modulo 2^64. */
struct zs_plane64 {
    uint64_t base, gx, gy;
};

#define ZS_SMALL_EXTENT                                                                            \
    (256 * ZS_SUBPX_ONE) /* width + height of a triangle that is drawn the small way: plane.c */
#define ZS_TINY (64 * ZS_SUBPX_ONE) /* most triangles are not larger: 32-bit products do */
#define ZS_TINY_AREA (1 << 13)      /* ... and not smaller; see plane.c */
#define ZS_TINY_SIDE                                                                               \
    (ZS_TINY / ZS_SUBPX_ONE +                                                                      \
     1) /* pixels: no further from its top corner is any of a tiny triangle */

/* Whether differences from the top corner are a tiny triangle's: 0 <= dy, so that both bounds of dx
 * are one comparison. */
static inline int zs_tiny(int32_t dx1, int32_t dx2, int32_t dy1, int32_t dy2)
{
    return ((uint32_t)(dx1 + ZS_TINY) | (uint32_t)(dx2 + ZS_TINY) |
            ((uint32_t)dy1 | (uint32_t)dy2) * 2u) < 2u * ZS_TINY;
}

/* The snapped triangle as planes need it, area made positive. */
struct zs_geom {
    union { /* q24_8, of the second and third vertex from the first */
        struct {
            int32_t dx1, dx2, dy1, dy2;
        };
        struct {
            int32_t dx[2], dy[2];
        };
    };
    int64_t area;   /* q_16 px^2, twice the area, > 0 */
    int32_t ia, ja; /* anchor pixel ... */
    int32_t ax, ay; /* ... its sample minus the first vertex, q24_8 */
    uint32_t rcp;   /* 2^63 / mantissa of area; 0: large, divide */
    int32_t exp;    /* area ~ mantissa * 2^exp, mantissa in [2^31, 2^32) */
    int32_t
        tiny; /* 1: the four differences are at most ZS_TINY, the area is at least ZS_TINY_AREA */
};

/* Pixels [i0, i1) of a row, on which keys are linear: sum / 65536, half a bucket added, changing by
 * step. */
typedef void zs_piece_fn(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                         uint32_t sum, uint32_t step);

/* What splits a row's pieces. */
enum zs_split {
    ZS_SPLIT_WINDOW = 1, /* pixels beside r->window are left out */
    ZS_SPLIT_TOUCH = 2   /* pixels that nothing was drawn on yet: zs_fast_touch */
};

/* How a textured triangle's coordinates become fractions of the texture's size. */
struct zs_sampler {
    const struct zs_texture *texture;
    uint64_t base[2]; /* q32_32 repeats at coordinate 0, a little added: see shade_texture.c */
    int8_t shift[2];  /* coordinate * 2^shift is in 2^-32 repeats */
    uint8_t fine;     /* 1: of so many texels that 15 bits do not place them */
    uint8_t wide;     /* 1: the texture is clamped, or one texel wide or high */
    uint8_t direct;   /* 1: affine and not wide: job->c[0] and [1] are u and v, uq0_32 */
    uint8_t unlit;    /* 1: texels are drawn as they are in `texture` */
    uint32_t least_w; /* groups of pixels need at least this w to be affine */
};

/* One triangle in one strip: the wide record, alive only while it is drawn. What rows, spans and
 * set-up need comes first: a Cortex-M0 reaches 124 bytes beyond a pointer at no extra cost. */
struct zs_job {
    uint8_t saturates;   /* a key may reach 2^bits - 1 (rows.h) */
    uint8_t split;       /* enum zs_split, or-ed */
    uint8_t mid_right;   /* the middle vertex is to the right of the long edge */
    uint8_t two_octaves; /* depth/float.c: w is in `key` */
    struct zs_renderer *r;
    const struct zs_tri *tri;
    const struct zs_shader *shader;
    int (*rows)(struct zs_job *job);          /* of fast, where it may be asked; NULL: not */
    const struct zs_depth_state *depth_state; /* of the instance; NULL: the usual ... */
    zs_piece_fn *span;                        /* zs_rows_test, or what is in its place */
    zs_piece_fn *piece;                       /* the same, or what splits a row's pieces first */
    uint16_t *color, *depth;                  /* the viewport's part of the strip, row y0 first */
    int32_t y0, y1, width; /* the viewport's rows in the strip, counted in the frame; its columns */
    int32_t pitch;         /* pixels from a row of the strip to the next */
    int32_t row, cut_end, row_end; /* rows in the frame; spans of [row, cut_end) are in cut; to
                                      row_end in this strip */
    int32_t row_mid;               /* first row below the middle vertex, in the strip or not */
    int32_t row_last;             /* one beyond the triangle's last row, in the strip or below it */
    const struct zs_vertex *v[3]; /* the top one, then the others so that the area is positive */
    struct zs_plane key;          /* screen-linear mappings; half a bucket added */
    uint32_t key_limit;           /* no key of a vertex below it can saturate when rounded */
    struct zs_plane c[ZS_VARYINGS_MAX > 3 ? ZS_VARYINGS_MAX : 3], w; /* varyings, or varyings times
                                                                        w, and w (persp.h) */
    uint32_t sub_log2;            /* of the sub-span; ZS_AFFINE: plain affine */
    const struct zs_fast *fast;   /* of the shader; NULL: none */
    int32_t bias;                 /* ... else buckets added to every key */
    const struct zs_texture *texture;  /* of the instance's material */
    const struct zs_fast_texel *texel; /* of the texture's format; NULL: none */
    int32_t top, bottom;               /* rows [top, bottom) of the frame are the viewport's */
    struct zs_geom geom;
    struct zs_sampler sampler;
    struct zs_cut cut[ZS_CUT_ROWS];
    struct zs_plane64 w64; /* depth that is not linear on the screen: 1/z ... */
    int32_t w64_scale;     /* ... and its scale */
};

#endif
