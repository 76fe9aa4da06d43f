/* The stages and what they hand on. Internal to zstrip: one stage is one .c file, in the order of the
 * data: frame, view -> cull -> xform -> clip -> bin -> raster (plane) -> shade, depth.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PIPELINE_H
#define ZS_PIPELINE_H

#include "core/fast.h"
#include "core/fx.h"
#include "zstrip.h"

#define ZS_NIL 65535u
_Static_assert(ZS_POOL_MAX < ZS_NIL, "16-bit indices need a value for none");
_Static_assert(sizeof(struct zs_tri) == 12, "ZS_TRI_BYTES");
_Static_assert(sizeof(struct zs_vertex) == 12, "ZS_VERT_BYTES");

/* ---- Shaders and depth mappings ---------------------------------------------------------------- */

struct zs_job;
struct zs_row;
struct zs_bounds;

struct zs_shader {
    /* Attributes of a vertex: out[n_attrs]. NULL: none. */
    void (*vertex)(const struct zs_renderer *r, uint32_t v, uint16_t *out);
    /* What zs_tri.paint becomes for a face of the current instance; NULL: 0. */
    uint16_t (*face)(const struct zs_renderer *r, uint32_t t);
    /* Gradients of the triangle's colours, before run; NULL: none. */
    void (*start)(struct zs_job *job);
    /* Colour pixels [from, to) of a row, already found nearest. */
    void (*run)(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
    /* ZS_OK, or why this instance cannot be drawn with it. */
    int (*check)(const struct zs_instance *instance, const struct zs_config *config);
    /* Textures: n pixels times light, uq1_31, which changes by step; NULL: none. */
    void (*light)(uint16_t *out, int32_t n, uint32_t level, uint32_t step);
    uint8_t n_attrs;
};

/* What has changed since it was given out last: linked where zs_watch is named. */
struct zs_watch_kernel {
    void (*look)(struct zs_renderer *r, struct zs_strip *out);              /* fills changed_x, changed_w */
    void (*forget)(struct zs_renderer *r, const struct zs_rect *rect);      /* NULL: all */
};

/* A part of the frame: rows [y, y_end), columns [x, x_end). */
struct zs_part {
    uint16_t y, y_end, x, x_end;
};

/* Which strips, and columns of them, need not be drawn: linked where zs_track is named. */
struct zs_track_kernel {
    /* zs_frame_check, or less where nothing differs; finds the strips that are due; lowers draw_end. May set r->scene. */
    int (*check)(struct zs_renderer *r, const struct zs_scene *scene);
    int (*due)(struct zs_renderer *r);                  /* 0: r->strip need not be drawn; passes on. 1: sets r->window */
    void (*forget)(struct zs_renderer *r, const struct zs_rect *rect);      /* NULL: all */
    /* Rows and columns of the walk's strips that the instance may be in and that are due. 0: there are none. */
    int (*touches)(const struct zs_renderer *r, uint32_t number, struct zs_part *part);
    /* Of a strip of which only the columns of r->window are drawn. 1: job->tri lies beside them; job->row_last is set. */
    int (*beside)(struct zs_job *job);
    /* 1: so much of it lies beside them that its rows are split. */
    int (*reaches)(const struct zs_job *job);
    /* Draw the columns of a piece that lie in them; as zs_piece_fn. */
    void (*piece)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t step);
};

/* Texture coordinates walked along a run: fractions of the texture's size, modulo 1. */
struct zs_walk {
    uint32_t u, v, du, dv; /* uq0_32 */
};

struct zs_texel {
    /* n texels along a walk, RGB565 in wire order. */
    void (*fetch)(const struct zs_texture *texture, uint16_t *out, int32_t n,
                  const struct zs_walk *walk);
    uint16_t colors_max; /* of the palette; 0: there is none */
    uint8_t log2_w_min;
};

struct zs_depth {
    /* Constants of a frame into view->key_*. ZS_OK; ZS_ERR_DEPTH: not with this camera. */
    int (*setup)(struct zs_view *view, const struct zs_camera *camera, uint32_t bits);
    /* zs_vertex.d of a distance, near <= z <= far, camera units. Under perspective rcp is
     * 2^(63 - lz) / z with lz the leading zeros of z; orthographic: of no use. */
    uint32_t (*vertex)(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
    /* Where view.screen_linear is 0. 1: keys are linear on this triangle all the same. 0: they are not; row draws it then. */
    int (*planes)(struct zs_job *job);
    /* Draw a row by zs_rows_piece, where planes has returned 0. */
    void (*row)(struct zs_job *job, const struct zs_row *row);
    /* Under perspective, w ~ 1/z of a vertex for perspective-correct attributes, 1 .. 2^62, same scale for all. */
    uint64_t (*inverse)(const struct zs_view *view, uint32_t d);
    /* Or, where this is not NULL, of a triangle's vertices: the largest brought to [2^30, 2^31). */
    void (*inverses)(const struct zs_view *view, const struct zs_vertex *const v[3], uint32_t w[3]);
    /* The key of a vertex, uq16_16, where zs_vertex.d is something else; NULL: d is the key. */
    uint32_t (*key)(const struct zs_view *view, uint32_t d);
};

/* ---- cull.c: instances --------------------------------------------------------------------------- */

struct zs_bounds {
    int64_t c[3];    /* q48_16 world units, camera axes (right, down, distance), sphere's centre */
    int64_t r;       /* q48_16, rounded up */
    int64_t reach;   /* q48_16: no vertex, centre or origin lies further along an axis */
    int64_t slack;   /* q48_16: more than the error of c and r; in a walk, of a vertex as well */
};

/* The sphere of an instance in camera axes, unscaled. Return ZS_OK or ZS_ERR_RANGE. */
int zs_cull_bounds(struct zs_bounds *b, const struct zs_instance *in,
                   const struct zs_camera *camera);

/* 1: no part of the sphere can be seen. Conservative. */
int zs_cull_sphere(const struct zs_bounds *b, const struct zs_camera *camera,
                   const struct zs_view *view);

/* In a walk, when camera units are known: bounds of an instance of the scene, with room for what a vertex may be off by.
 * Return 1: no part of it can be seen. */
int zs_cull_walk(struct zs_bounds *b, const struct zs_renderer *r, uint32_t number);

/* An instance's axes in camera axes (right, down, distance), row-major. */
void zs_cull_axes(zs_q2_30 out[9], const struct zs_instance *in, const struct zs_camera *camera);

/* Half of what an orthographic frame holds from left to right, q48_16, at least. */
int64_t zs_cull_half_width(const struct zs_camera *camera, const struct zs_view *view);

/* ---- frame.c --------------------------------------------------------------------------------------- */

/* Everything that a frame of r->camera can be refused for; fills r->view. Return ZS_OK or an error. */
int zs_frame_check(struct zs_renderer *r, const struct zs_scene *scene);

/* ---- view.c: the camera of a frame -------------------------------------------------------------- */

/* Everything that does not depend on the scene. ZS_OK; ZS_ERR_CAMERA. */
int zs_view_camera(struct zs_view *view, const struct zs_config *config,
                   const struct zs_camera *camera);
/* Choose camera units for a reach in q48_16 world units, and fill the rest. ZS_OK; ZS_ERR_RANGE. */
int zs_view_units(struct zs_view *view, const struct zs_config *config,
                  const struct zs_camera *camera, int64_t reach);
/* A length in camera units, nearest, at most 2^30 either way. */
int32_t zs_view_length(const struct zs_view *view, zs_q48_16 length);
/* Unit normal of the plane through the eye and what is so many sub-pixels beside the middle: (x or y, z). */
void zs_view_side(int32_t out[2], uint64_t focal, uint32_t subpx);

/* ---- xform.c ---------------------------------------------------------------------------------------- */

/* One vertex in camera units: x' to the right, y' down, z the distance. |.| < 2^30 + 2. */
struct zs_point {
    int32_t c[3];
};

enum zs_outcode {
    ZS_OUT_NEAR = 1, ZS_OUT_FAR = 2, ZS_OUT_LEFT = 4, ZS_OUT_RIGHT = 8, ZS_OUT_TOP = 16,
    ZS_OUT_BOTTOM = 32
};
#define ZS_OUT_SIDES (ZS_OUT_LEFT | ZS_OUT_RIGHT | ZS_OUT_TOP | ZS_OUT_BOTTOM)
#define ZS_D_OUT 0xffffff00u /* zs_vertex.d at or above it: not projected, to be clipped; plus the outcode */

/* Fill r->xform for an instance. Return 0 where its vertices do not fit camera units (it cannot be
 * seen then), else 1. */
int zs_xform_instance(struct zs_renderer *r, uint32_t number, const struct zs_bounds *b);
void zs_xform_vertex(const struct zs_xform *xf, uint32_t v, struct zs_point *out);
/* enum zs_outcode, or-ed; 0: inside near, far and guard. */
uint32_t zs_xform_outcode(const struct zs_view *view, const struct zs_point *p);
/* Screen position and depth. Return 1; 0 where the point is before near, beyond far (*out is not of use
 * then) or beside the guard band (*out is then just beside it). The lean build does not say which. */
int zs_xform_project(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out);
/* The same in place: z is d. */
int zs_xform_project_at(const struct zs_renderer *r, struct zs_vertex *at);
/* All three for vertex v of the current instance. One that is not inside near, far and guard has d = ZS_D_OUT + outcode. */
void zs_xform_screen(const struct zs_renderer *r, uint32_t v, struct zs_vertex *out);
/* A row of the transform, of a position in 1/256 steps, |p| <= 2^23. */
int32_t zs_xform_fine(const int32_t row[ZS_ROW_WORDS], const int16_t pos[3], const uint8_t pos_lo[3]);

/* ---- clip.c ----------------------------------------------------------------------------------------- */

#define ZS_CLIP_MAX 9 /* a triangle and six planes */

struct zs_clip_vertex {
    struct zs_point p;
    uint16_t attr[ZS_ATTRS_MAX ? ZS_ATTRS_MAX : 1];
};

/* Clip a convex polygon of n vertices in place at the planes of the outcodes in `planes`.
 * v has room for ZS_CLIP_MAX. Return the number of vertices left, 0 or 3 .. ZS_CLIP_MAX. */
int zs_clip_polygon(const struct zs_view *view, struct zs_clip_vertex *v, int n, uint32_t planes,
                    uint32_t n_attrs);

/* ---- walk.c ----------------------------------------------------------------------------------------- */

/* Walk the scene and bin what lies in strips [r->strip, r->band_end); the band shrinks where the
 * pools are full, and a single strip's triangles are drawn in sets. */
void zs_walk(struct zs_renderer *r);

/* ---- raster.c --------------------------------------------------------------------------------------- */

/* Draw the strip r->strip's bin and the active list; leaves those that go on in r->active. */
void zs_raster_strip(struct zs_renderer *r);
/* Do not draw it, but pass its triangles on to the strip below. */
void zs_raster_pass(struct zs_renderer *r);
/* Background and ZS_DEPTH_CLEAR everywhere in the strip. */
void zs_raster_clear(struct zs_renderer *r);

/* ---- tiles.c ---------------------------------------------------------------------------------------- */

/* 1: nothing in columns [x0, x1) and rows [y0, y1) can win whose vertices' zs_vertex.d are `nearest` or more, in no strip
 * that is still to be drawn. Without a state. */
struct zs_box {
    int32_t x0, x1, y0, y1; /* px */
};
int zs_hidden_box(struct zs_renderer *r, const struct zs_box *box, uint32_t nearest);

/* ---- test.c ----------------------------------------------------------------------------------------- */

/* Buckets to be added to each key of a triangle with a depth state: offset and slope. */
int32_t zs_depth_state_bias(const struct zs_job *job);

/* ---- edges.c ---------------------------------------------------------------------------------------- */

/* Columns of rows [row, job->cut_end), by quotient and remainder. */
void zs_edges_columns(struct zs_job *job, int32_t row);

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

#define ZS_SMALL_EXTENT (256 * ZS_SUBPX_ONE) /* width + height of a triangle that is drawn the small way: plane.c */
#define ZS_TINY (64 * ZS_SUBPX_ONE) /* most triangles are not larger: 32-bit products do */
#define ZS_TINY_AREA (1 << 13)      /* ... and not smaller; see plane.c */
#define ZS_TINY_SIDE (ZS_TINY / ZS_SUBPX_ONE + 1) /* pixels: no further from its top corner is any of a tiny triangle */

/* Whether differences from the top corner are a tiny triangle's: 0 <= dy, so that both bounds of dx are one comparison. */
static inline int zs_tiny(int32_t dx1, int32_t dx2, int32_t dy1, int32_t dy2)
{
    return ((uint32_t)(dx1 + ZS_TINY) | (uint32_t)(dx2 + ZS_TINY) | ((uint32_t)dy1 | (uint32_t)dy2) * 2u) < 2u * ZS_TINY;
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
    int64_t area;               /* q_16 px^2, twice the area, > 0 */
    int32_t ia, ja;             /* anchor pixel ... */
    int32_t ax, ay;             /* ... its sample minus the first vertex, q24_8 */
    uint32_t rcp;               /* 2^63 / mantissa of area; 0: large, divide */
    int32_t exp;                /* area ~ mantissa * 2^exp, mantissa in [2^31, 2^32) */
    int32_t tiny;               /* 1: the four differences are at most ZS_TINY, the area is at least ZS_TINY_AREA */
};

/* Pixels [i0, i1) of a row, on which keys are linear: sum / 65536, half a bucket added, changing by step. */
typedef void zs_piece_fn(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t step);

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
    uint32_t least_w; /* groups of pixels need at least this w to be affine */
    uint8_t fine;     /* 1: of so many texels that 15 bits do not place them */
    uint8_t wide;     /* 1: the texture is clamped, or one texel wide or high */
    uint8_t direct;   /* 1: affine and not wide: job->c[0] and [1] are u and v, uq0_32 */
    uint8_t unlit;    /* 1: texels are drawn as they are in `texture` */
};

/* One triangle in one strip: the wide record, alive only while it is drawn. What rows, spans and set-up need comes first:
 * a Cortex-M0 reaches 124 bytes beyond a pointer at no extra cost. */
struct zs_job {
    uint8_t saturates;            /* a key may reach 2^bits - 1 (rows.h) */
    uint8_t split;                /* enum zs_split, or-ed */
    uint8_t mid_right;            /* the middle vertex is to the right of the long edge */
    uint8_t two_octaves;          /* depth/float.c: w is in `key` */
    struct zs_renderer *r;
    const struct zs_tri *tri;
    const struct zs_shader *shader;
    int (*rows)(struct zs_job *job); /* of fast, where it may be asked; NULL: not */
    const struct zs_state *state; /* of the instance; NULL: the usual ... */
    zs_piece_fn *span;            /* zs_rows_test, or what is in its place */
    zs_piece_fn *piece;           /* the same, or what splits a row's pieces first */
    uint16_t *color, *depth;      /* the strip; row 0 is row y0 of the frame */
    int32_t y0, y1, width;        /* the strip's rows [y0, y1) */
    int32_t row, cut_end, row_end; /* rows in the frame; spans of [row, cut_end) are in cut; to row_end in this strip */
    int32_t row_mid;              /* first row below the middle vertex, in the strip or not */
    int32_t row_last;             /* one beyond the triangle's last row, in the strip or below it */
    const struct zs_vertex *v[3]; /* the top one, then the others so that the area is positive */
    struct zs_plane key;          /* screen-linear mappings; half a bucket added */
    uint32_t key_limit;           /* no key of a vertex below it can saturate when rounded */
    struct zs_plane c[3], w;      /* attributes, or attributes times w, and w (persp.h) */
    uint32_t sub_log2;            /* of the sub-span; ZS_AFFINE: plain affine */
    const struct zs_fast *fast;   /* of the shader; NULL: none */
    int32_t bias;                 /* ... else buckets added to every key */
    const struct zs_texture *texture; /* of the instance's material */
    const struct zs_fast_texel *texel; /* of the texture's format; NULL: none */
    struct zs_geom geom;
    struct zs_sampler sampler;
    struct zs_cut cut[ZS_CUT_ROWS];
    struct zs_plane64 w64;        /* depth that is not linear on the screen: 1/z ... */
    int32_t w64_scale;            /* ... and its scale */
};

/* Find the spans of rows from `row` on: of ZS_CUT_ROWS, or up to job->row_end. */
static inline void zs_edges_cut(struct zs_job *job, int32_t row)
{
    const struct zs_renderer *r = job->r;
    job->row = row;
    job->cut_end = zs_min32(job->row_end, row + ZS_CUT_ROWS);
    if (!r->edges || !r->edges(job, row))
        zs_edges_columns(job, row);
}

/* ---- plane.c ---------------------------------------------------------------------------------------- */

/* From the corners, the top one first, clockwise: job->v, job->mid_right, job->geom's differences and area. */
void zs_plane_sides(struct zs_job *job, const struct zs_vertex *a, const struct zs_vertex *b, const struct zs_vertex *c);
/* Fill the rest of job->geom. */
void zs_plane_geom(struct zs_job *job);
enum zs_plane_kind { /* the numbers: gradients of 2^(32 - n) and more are found by division */
    ZS_PLANE_WIDE = 2, /* 31 significant bits: error below the larger of 2^-21 of the largest value
                          and (W + H + 1) / 2 * 2^-31 */
    ZS_PLANE_KEY = 5   /* buckets or codes, uq16_16: error below 0.005 of one */
};
#define ZS_TOO_STEEP INT32_MIN
/* 256 n / area, nearly nearest; ZS_TOO_STEEP where it is 2^(32 - least_shift) or more. |n| <= 2^48; rcp is 2^63 / (area 2^lz),
 * lz the leading zeros of the area, 1 .. 31. */
int32_t zs_plane_quotient(int64_t n, uint32_t rcp, int32_t lz, int32_t least_shift);
void zs_plane32(const struct zs_geom *g, uint32_t v0, uint32_t v1, uint32_t v2,
                enum zs_plane_kind kind, struct zs_plane *out);
void zs_plane64(const struct zs_geom *g, uint64_t v0, uint64_t v1, uint64_t v2,
                struct zs_plane64 *out);

/* ---- light.c ---------------------------------------------------------------------------------------- */

/* Intensity of a unit normal in mesh space, uq16_16, below 3. */
uint32_t zs_light_intensity(const struct zs_renderer *r, const zs_q1_15 n[3]);
/* The unit normal of a face in mesh space: the mesh's, or the product of two edges; 0 0 0 without area. */
void zs_light_face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t);
/* A channel under an intensity, saturated: uq0_16 where 65535 is full. c * 257 * intensity / 2^16, nearest. */
static inline uint32_t zs_light_channel(uint8_t c, uint32_t intensity)
{
    const uint32_t part = c * intensity;                          /* < 2^25.6 */
    const uint32_t lit = (part + ((part + 0x8000u) >> 8)) >> 8;   /* 256 part and part, < 2^18 */
    return lit > 65535u ? 65535u : lit;
}

#endif
