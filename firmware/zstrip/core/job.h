/* The job: one triangle while it is rasterised in one strip. Set-up, scanlines, depth test and
 * shaders share it. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_JOB_H
#define ZS_JOB_H

#include "arch/kept_v7m.h"
#include "arch/lanes.h"
#include "core/fast.h"
#include "core/fx.h"
#include "zstrip.h"

struct zs_row;

#define ZS_NIL 65535u
_Static_assert(ZS_POOL_MAX < ZS_NIL, "16-bit indices need a value for none");
_Static_assert(sizeof(struct zs_tri) == 12, "ZS_TRI_BYTES");
_Static_assert(sizeof(struct zs_vertex) == 12, "ZS_VERT_BYTES");

/* The span [x0, x1) of a scanline: x0 is the first sample at or right of the left edge, x1 the
 * first at or right of the right edge. */
struct zs_cut {
    int16_t x0, x1; /* |.| <= 2^14 + 1; may lie outside the frame, and x0 may exceed x1 */
};
#define ZS_CUT_ROWS 16 /* scanlines for which spans are found at a time */
_Static_assert(2 * ZS_GUARD_PX + 2 < 32768, "columns are 16 bits");

/* A plane over the screen: value(i, j) = base + gx * (i - ia) + gy * (j - ja) modulo 2^32. */
struct zs_plane {
    uint32_t base, gx, gy; /* uq16_16 */
};

/* The same with values in 40.24 bits, modulo 2^64. */
struct zs_plane64 {
    uint64_t base, gx, gy;
};

/* Two classes of size, which decide how gradients are computed (plane.c). */
/* small: width + height up to this; one reciprocal of the area is exact enough */
#define ZS_SMALL_EXTENT (256 * ZS_SUBPX_ONE)
/* tiny: |dx| and dy from the top vertex up to ZS_TINY, the area at least ZS_TINY_AREA: 32-bit
 * products suffice (zs_quotient, plane.h). Most triangles are tiny */
#define ZS_TINY (64 * ZS_SUBPX_ONE)
#define ZS_TINY_AREA (1 << 13)
/* pixels: the columns of a tiny triangle are no further from its top vertex */
#define ZS_TINY_SIDE (ZS_TINY / ZS_SUBPX_ONE + 1)

/* Return 1 if the differences from the top vertex are those of a tiny triangle. dy >= 0. One
 * comparison tests all bounds, as 2 ZS_TINY is a power of two. */
static inline int zs_tiny(int32_t dx1, int32_t dx2, int32_t dy1, int32_t dy2)
{
    return ((uint32_t)(dx1 + ZS_TINY) | (uint32_t)(dx2 + ZS_TINY) |
            ((uint32_t)dy1 | (uint32_t)dy2) * 2u) < 2u * ZS_TINY;
}

/* The snapped triangle as gradients need it; the order of the vertices makes the area positive. */
struct zs_geom {
    union { /* q24_8: differences of the second and third vertex from the first */
        struct {
            int32_t dx1, dx2, dy1, dy2;
        };
        struct {
            int32_t dx[2], dy[2];
        };
    };
    int64_t area;   /* twice the area, q_16 px^2, > 0 */
    int32_t ia, ja; /* the anchor pixel, to which bases of planes refer ... */
    int32_t ax, ay; /* ... and its sample minus the first vertex, q24_8 */
    uint32_t rcp;   /* 2^63 / mantissa of area of a small triangle; 0: others, by division */
    int32_t exp;    /* area ~ mantissa * 2^exp, mantissa in [2^31, 2^32) */
    int32_t tiny;   /* 1: the differences are at most ZS_TINY, the area is at least ZS_TINY_AREA */
};

/* Draw pixels [i0, i1) of a scanline, on which keys are linear: the key is sum / 65536, with half a
 * bucket already added for rounding, and sum changes by step from pixel to pixel. */
typedef void zs_piece_fn(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                         uint32_t sum, uint32_t step);

/* How the pieces of a scanline are split before they are drawn. */
enum zs_split {
    ZS_SPLIT_WINDOW = 1, /* only the pixels in r->window (the dirty columns) are drawn */
    ZS_SPLIT_TOUCH = 2   /* uncleared pixels are drawn without a depth test: zs_fast_touch */
};

/* How the texture coordinates of a triangle become fractions of the texture's size. */
struct zs_sampler {
    const struct zs_texture *texture;
    uint64_t base[2]; /* q32_32 repeats at coordinate 0, plus 1/512 texel (shade/texture.c) */
    int8_t shift[2];  /* coordinate * 2^shift is in 2^-32 repeats */
    uint8_t fine;     /* 1: the triangle spans so many texels that a reciprocal of 15 bits is too
                          coarse */
    uint8_t wide;     /* 1: the texture is clamped, or one texel wide or high */
    uint8_t direct;   /* 1: affine and not wide: job->c[0] and [1] are u and v, uq0_32 */
    uint8_t unlit;    /* 1: texels are drawn as they are in `texture` */
    uint32_t least_w; /* a group of pixels is affine if w at its ends is at least this */
};

#if ZS_SET_UP
/* What a texture is to a triangle. */
struct zs_texture_set {
    uint32_t log2[2]; /* of width and height, at least ZS_TEXTURE_FLOOR_LOG2 */
    uint32_t uv_bits, later; /* later: 31 - uv_bits */
    uint32_t bias[2]; /* 2^-ZS_TEXTURE_BIAS_LOG2 texels, 2^-32 repeats */
    uint32_t lit;     /* 1: light is the third value */
};
#endif
#if ZS_SET_UP && ZS_RP2040
/* What fast/texture_lanes.c keeps from one triangle of an instance to the next. */
struct zs_kept {
    uint32_t of; /* the instance's number; ZS_NIL: none */
    struct zs_texture_set set;
    struct zs_lanes_set lanes;
    struct zs_plane light; /* of the triangle, as lanes have it */
};
#endif

/* 1: zs_fast.draw may go on to the triangles that come next; ZS_CHAIN_KEEPS: also from those that
 * go on below the strip. */
#define ZS_CHAIN_KEEPS (ZS_HAS_64 || ZS_V7M)
#define ZS_CHAIN_USED (ZS_CHAIN_KEEPS || (ZS_SET_UP && ZS_RP2040))

/* What a triangle is drawn by. One job serves all triangles of a strip; what is the same for an
 * instance (shader, texture, accelerator) is kept from one to the next. The fields that scanlines,
 * spans and set-up need come first: a Cortex-M0 reaches 124 bytes behind a pointer at no extra
 * cost. */
struct zs_job {
    uint8_t saturates;   /* 1: a key may exceed 2^bits - 2 and has to be clamped */
    uint8_t split;       /* enum zs_split, or-ed. Under ray casting, where nothing is split: 1: keys
                            are not linear on the screen (method/rays.c) */
    uint8_t mid_right;   /* 1: the middle vertex is to the right of the long edge */
    uint8_t two_octaves; /* 1: a tiny triangle in two octaves; its w is in `key` (depth/float.c) */
    struct zs_renderer *r;
    const struct zs_tri *tri;
    const struct zs_shader *shader;
    int (*rows)(struct zs_job *job);          /* fast->rows, if it may be called; else NULL */
    const struct zs_depth_state *depth_state; /* the instance's; NULL: the usual test */
    zs_piece_fn *span;                        /* zs_rows_test, or a function in its place */
    zs_piece_fn *piece;                       /* span, or a function that splits pieces first */
    uint16_t *color, *depth; /* row y0 of the viewport, in the strip's buffers; depth may be NULL */
    int32_t y0, y1, width;   /* rows [y0, y1) of the frame: the viewport's part of the strip; width:
                                columns of the viewport */
    int32_t pitch;           /* pixels from a row of the strip to the next */
    int32_t row, cut_end, row_end; /* rows of the frame: `cut` holds the spans of [row, cut_end);
                                      the triangle's rows in this strip end at row_end */
    int32_t row_mid;              /* first row below the middle vertex, inside the strip or not */
    int32_t tri_end;              /* one beyond the triangle's last row, inside the strip or not */
    const struct zs_vertex *v[3]; /* the top one, then the others so that the area is positive */
    struct zs_plane key;          /* keys, if linear on the screen, half a bucket added */
    uint32_t key_limit;           /* if all vertices' keys are below it, no pixel's key saturates */
    struct zs_plane c[ZS_VARYINGS_MAX > 3 ? ZS_VARYINGS_MAX : 3], w; /* varyings, or varyings times
                                                                         w, and w (shade/persp.h) */
    uint32_t sub_log2;            /* log2 of a sub-span's pixels; ZS_AFFINE: plain affine */
    const struct zs_fast *fast;   /* the shader's accelerator; NULL: none */
    int32_t bias;                 /* with a depth_state: buckets added to every key */
    const struct zs_texture *texture;  /* the instance's material's */
    const struct zs_fast_texel *texel; /* loops of the texture's format; NULL: none */
    zs_gather_fn *gather; /* of sampler.texture; NULL: there is none */
    int32_t top, bottom;               /* rows [top, bottom) of the frame are the viewport's */
#if ZS_SET_UP
    uint32_t piece_shift, key_slow, key_known; /* of the view */
    enum zs_set_up (*set_up)(struct zs_job *); /* of an accelerator; NULL: none, or no keys */
#endif
    struct zs_geom geom;
    union {
        struct zs_sampler sampler;
        uint32_t own[12]; /* of a shader without a texture */
    };
    struct zs_cut cut[ZS_CUT_ROWS];
    struct zs_plane64 w64; /* if keys are not linear on the screen: 1/z ... */
    int32_t w64_scale;     /* ... and its scale */
#if ZS_CHAIN_USED
    struct zs_tri *chain; /* all triangles, where fast->draw may go on to the next; or NULL */
#if ZS_CHAIN_KEEPS
    uint16_t **keep; /* where the end of the list is that goes on below the strip; or NULL */
#endif
#endif
#if ZS_V7M || (ZS_SET_UP && ZS_RP2040)
    struct zs_kept kept;
#endif
};

#endif
