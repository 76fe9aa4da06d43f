/* What is drawn: number formats, colours, meshes, textures, materials, instances, lights, scene and
 * camera. Plain data, which the renderer reads and never writes; all of it may lie in flash.
 * zstrip.h includes this header and has the conventions.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SCENE_H
#define ZS_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "zs_config.h"

ZS_C_BEGIN

/* ---- Formats ------------------------------------------------------------------------------ */

/* A cast that draws no warning in C or C++, for the macros here. */
#ifdef __cplusplus
#define ZS_CAST(type, value) static_cast<type>(value)
#else
#define ZS_CAST(type, value) ((type)(value))
#endif
#define ZS_U32(value) ZS_CAST(uint32_t, value)

typedef int32_t zs_q2_30;    /* -2 .. 2 - 2^-30; rotations and unit vectors */
typedef int16_t zs_q1_15;    /* -1 .. 1 - 2^-15; normals */
typedef uint32_t zs_uq16_16; /* 0 .. 65536 - 2^-16; scales and light */
typedef int64_t zs_q48_16;   /* lengths finer than a world unit */
typedef uint64_t zs_uq32_32; /* focal lengths */
typedef uint16_t zs_turn;    /* angles, 65536 to the turn */

#define ZS_Q30_ONE (ZS_CAST(zs_q2_30, 1) << 30)
#define ZS_Q16_ONE (ZS_CAST(zs_uq16_16, 1) << 16)
#define ZS_WORLD_MAX (ZS_CAST(int32_t, 1) << 29) /* world units; also of an instance */
#define ZS_FAR_MAX (ZS_CAST(int64_t, 1) << 44)   /* world units; far may lie beyond the world */
#define ZS_FOCAL_MIN (ZS_CAST(zs_uq32_32, 1) << 16)
#define ZS_FOCAL_MAX (ZS_CAST(zs_uq32_32, 1) << 55)
#define ZS_HEIGHT_MIN ZS_CAST(zs_q48_16, 8)
#define ZS_DEPTH_CLEAR 65535u /* the key of a pixel on which nothing was drawn */

/* Degrees as a zs_turn, rounded to nearest, at compile time: ZS_DEGREES(45), ZS_DEGREES(-22.5).
 * degrees  a literal, or an expression of literals, with or without a fraction; |.| < 1,000,000.
 *          With GCC and Clang a variable does not compile, as it could need floating point at run
 *          time. Write (zs_turn)(degrees * 65536 / 360) for it.
 * The number added is 4096 * 65536 * 360, whole turns, and 180, half of the divisor. */
#define ZS_DEGREES(degrees)                                                                        \
    ZS_CAST(zs_turn,                                                                               \
            ZS_U32(((degrees) * INT64_C(65536) + INT64_C(96636764340)) / 360) + ZS_LITERAL(degrees))
/* The same as a signed angle, -180 .. below 180 degrees, for an int16_t: ZS_PITCH(-15). */
#define ZS_PITCH(degrees) ZS_CAST(int16_t, (ZS_DEGREES(degrees) ^ 32768) - 32768)
/* 0 for a constant; for a variable, a bit-field or an array of negative size. */
#if defined(__GNUC__) && !defined(__cplusplus)
#define ZS_LITERAL(value)                                                                          \
    ZS_U32(0u * sizeof(struct { int literal : __builtin_constant_p(value) ? 1 : -1; }))
#elif defined(__GNUC__)
#define ZS_LITERAL(value) ZS_U32(0u * sizeof(char[__builtin_constant_p(value) ? 1 : -1]))
#else
#define ZS_LITERAL(value) 0u
#endif

struct zs_rgb {
    uint8_t r, g, b; /* 255 is full; not gamma-corrected on the way */
};

/* Channels of a number 0xRRGGBB. */
#define ZS_RGB_R(rrggbb) ZS_CAST(uint8_t, ZS_U32(rrggbb) >> 16 & 255u)
#define ZS_RGB_G(rrggbb) ZS_CAST(uint8_t, ZS_U32(rrggbb) >> 8 & 255u)
#define ZS_RGB_B(rrggbb) ZS_CAST(uint8_t, ZS_U32(rrggbb) & 255u)
/* An initialiser of a struct zs_rgb: .rgb = ZS_RGB(0xffc040). */
#define ZS_RGB(rrggbb)                                                                             \
    {                                                                                              \
        ZS_RGB_R(rrggbb), ZS_RGB_G(rrggbb), ZS_RGB_B(rrggbb)                                       \
    }
/* The RGB565 value nearest to 0xRRGGBB, as a constant expression; equal to zs_rgb565. */
#define ZS_RGB565(rrggbb)                                                                          \
    ZS_CAST(uint16_t, ((ZS_RGB_R(rrggbb) * 31u + 127u) / 255u) << 11 |                             \
                          ((ZS_RGB_G(rrggbb) * 63u + 127u) / 255u) << 5 |                          \
                          ((ZS_RGB_B(rrggbb) * 31u + 127u) / 255u))

/* The RGB565 value nearest to three 8-bit channels. */
static inline uint16_t zs_rgb565(uint8_t r, uint8_t g, uint8_t b)
{
    return ZS_RGB565(ZS_U32(r) << 16 | ZS_U32(g) << 8 | b);
}

/* A value so that its most significant byte is first in memory, or back from there. */
static inline uint16_t zs_wire16(uint16_t v)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return v;
#else
    return ZS_CAST(uint16_t, v << 8 | v >> 8);
#endif
}

/* An RGB565 value as it lies in memory. Frames consist of these. */
static inline uint16_t zs_wire565(uint8_t r, uint8_t g, uint8_t b)
{
    return zs_wire16(zs_rgb565(r, g, b));
}

/* ---- Textures ----------------------------------------------------------------------------- */

/* A texel format: one of these, or one with alpha (zs_filter.h). */
struct zs_texel;
extern const struct zs_texel zs_texel_565;  /* uint16_t [height][width], RGB565 values */
extern const struct zs_texel zs_texel_pal8; /* uint8_t [height][width], palette numbers */
extern const struct zs_texel zs_texel_pal4; /* uint8_t [height][width / 2], palette numbers, the
                                               left texel in the low four bits; width >= 2 */

/* Or-ed; a direction that is not clamped repeats. */
enum zs_clamp {
    ZS_CLAMP_U = 1, /* the first column continues to the left, the last one to the right */
    ZS_CLAMP_V = 2  /* the first row continues upwards, the last one downwards */
};

#define ZS_TEXTURE_LOG2_MAX 10u

/* An image whose width and height are powers of two. */
struct zs_texture {
    const struct zs_texel *format;
    const void *texel;       /* rows from the top; aligned as its elements */
    const uint16_t *palette; /* [n_colors], RGB565 values; NULL with zs_texel_565 */
    uint16_t n_colors;       /* 1 .. 256, pal4: 1 .. 16. No texel may be >= n_colors; the renderer
                                does not look, zs_texture_check (zs_check.h) does */
    uint8_t log2_w, log2_h;  /* 0 .. ZS_TEXTURE_LOG2_MAX */
    uint8_t clamp;           /* enum zs_clamp; 0 repeats in both directions */
    uint8_t n_levels, alpha_least; /* levels of mipmaps, 0: one; alpha test: the least alpha that is
                                      drawn, 0: 128. zs_filter.h explains them */
};

/* ---- Meshes ------------------------------------------------------------------------------- */

/* A range of a mesh's triangles that lie close together. `zsim convert` writes clusters. */
struct zs_cluster {
    uint32_t first;    /* the first triangle */
    uint16_t n_tris;   /* >= 1 */
    int16_t center[3]; /* of a sphere around their vertices, steps */
    uint16_t radius;   /* of that sphere, steps, rounded up */
    int8_t axis[3];    /* of a cone that holds their normals, 127 is 1 */
    int8_t cutoff;     /* 0 .. 127, 127 is 1. Every triangle is back-facing for an eye with
                          (center - eye) . axis >= cutoff * |center - eye| + radius; 127: never */
    uint16_t height;   /* 1/16 step, rounded down: a triangle's height on its longest side, the
                          least of all. Triangles with two corners in one place do not count. 0:
                          not known; the cone is not used then */
};

/* Triangles over shared vertices. In world units, before the pose of its instance, a vertex is at
 * pos * scale, or (pos + pos_lo / 256) * scale where pos_lo is given. */
struct zs_mesh {
    const int16_t (*pos)[3];          /* [n_verts], mesh steps */
    const uint8_t (*pos_lo)[3];       /* [n_verts], 1/256 step added to pos; NULL: all zero */
    const uint16_t (*tri)[3];         /* [n_tris], vertex numbers; one >= n_verts: not drawn */
    const zs_q1_15 (*normal)[3];      /* [n_verts], unit; NULL unless smooth shading reads it */
    const zs_q1_15 (*face_normal)[3]; /* [n_tris], unit; NULL: flat shading computes its own */
    const struct zs_rgb *vertex_rgb;  /* [n_verts], smooth shading; NULL: the material's colour */
    const struct zs_rgb *face_rgb;    /* [n_tris], flat shading; NULL: the material's colour */
    const uint16_t *face_raw;         /* [n_tris], RGB565, raw shading; NULL: the material's */
    uint32_t n_verts;                 /* 0 .. 65535 */
    uint32_t n_tris;                  /* any */
    zs_uq16_16 scale;                 /* world units to a step; 0: one. Times pose.scale at most
                                         32768; (radius + 1) times both at most 2^29 */
    int16_t center[3];                /* of a sphere around all vertices, steps */
    uint16_t radius;                  /* of that sphere, steps, rounded up; one that is too small
                                         makes parts disappear */
    const int16_t (*uv)[2];           /* [n_verts], textured shading, in 2^-uv_bits of the texture's
                                         width and height; NULL unless a shader reads it */
    uint8_t uv_bits;                  /* 0 .. 15. 12 holds eight repeats each way, to 1/16 texel of
                                         256. Clipping (near plane, guard band) rounds to a step:
                                         take log2 of the texture's size + 3 or more, or texels
                                         there move about */
    const struct zs_cluster *cluster; /* [n_clusters], all triangles in order; NULL: none */
    uint32_t n_clusters;
    const struct zs_bvh_node *bvh; /* zs_method.h; used only with clusters. NULL: none */
};

/* ---- Materials ---------------------------------------------------------------------------- */

/* How a triangle gets its colour: one of these six, or yours (zs_shader.h). */
struct zs_shader;
extern const struct zs_shader zs_shade_raw;    /* one colour a face, unlit */
extern const struct zs_shader zs_shade_flat;   /* one colour a face, lit once for the face */
extern const struct zs_shader zs_shade_smooth; /* lit at the vertices and interpolated (Gouraud),
                                                  perspective-correct; needs mesh.normal */
/* Textured, perspective-correct, to 1/4 of a texel's width (NUMERICS.md lists what is added:
 * uv_bits, depth bits, triangles a million times as far as near). They need mesh.uv and
 * material.texture. Light multiplies the texture's colour, not material.rgb. */
extern const struct zs_shader zs_shade_texture;        /* unlit */
extern const struct zs_shader zs_shade_texture_flat;   /* lit once for the face */
extern const struct zs_shader zs_shade_texture_smooth; /* lit at the vertices; needs mesh.normal */

/* 16-bit values a vertex that a shader needs: config.varyings is at least the largest in use. */
#define ZS_VARYINGS_FLAT 0u /* raw and flat */
#define ZS_VARYINGS_SMOOTH 3u
#define ZS_VARYINGS_TEXTURE 2u /* texture and texture_flat */
#define ZS_VARYINGS_TEXTURE_SMOOTH 3u

enum zs_cull {
    ZS_CULL_BACK = 0,  /* triangles that turn clockwise on the screen are not drawn */
    ZS_CULL_FRONT = 1, /* those that turn counter-clockwise are not drawn */
    ZS_CULL_NONE = 2
};

/* Lines or points: the first member of a struct that says which (zs_lines.h). */
struct zs_primitive {
    const struct zs_primitive_ops *ops; /* set by that header's macros */
    uint32_t n;                         /* how many */
};

struct zs_material {
    const struct zs_shader *shader;
    struct zs_rgb rgb;                /* where the mesh gives no colour */
    uint8_t cull;                     /* enum zs_cull */
    const struct zs_texture *texture; /* textured shading; else NULL */
    const struct zs_primitive *primitive; /* drawn in place of the mesh's triangles; NULL: those */
};

/* ---- Instances ---------------------------------------------------------------------------- */

/* Where something stands: x_world = rot * (s * x) + pos, where x is in mesh steps and s is
 * mesh.scale * scale. All fields 0: at the origin, not rotated, at the mesh's own scale. */
struct zs_pose {
    /* Row-major; all 0: no rotation. A rotation: products of its rows are within 2^-20 of 1 and 0,
     * it is right-handed; else ZS_ERR_RANGE. zs_math.h sets it, and turns it further: products that
     * a program computes by itself drift out of this. */
    zs_q2_30 rot[9];
    int32_t pos[3];   /* world units, |.| <= ZS_WORLD_MAX */
    zs_uq16_16 scale; /* ZS_Q16_ONE or 0: the mesh's own scale */
};

/* When a pixel is drawn over what is there. */
enum zs_depth_func {
    ZS_DEPTH_LESS = 0,       /* its key is less: on equal keys the earlier one stays */
    ZS_DEPTH_LESS_EQUAL = 1, /* less or equal: on equal keys the later one wins */
    ZS_DEPTH_ALWAYS = 2      /* always: nothing is tested */
};

/* How an instance is tested against the depth buffer. All fields 0: as without a state. */
struct zs_depth_state {
    uint8_t func;       /* enum zs_depth_func */
    uint8_t read_only;  /* 1: keys are tested and not written */
    int16_t bias;       /* buckets added to every key; < 0: towards the eye */
    int16_t slope_bias; /* q8_8, times the slope, rounded to whole buckets (halves up), and added
                           too. The slope is the larger change of the key by one pixel, to the right
                           or down, on the plane through the snapped vertices; each piece of a
                           clipped triangle has its own. Meant for zs_depth_recip, and for
                           zs_depth_linear with orthographic cameras: their keys are planes. Keys
                           stop at 0 and at 2^bits - 2 */
};

struct zs_instance {
    const struct zs_mesh *mesh;
    const struct zs_material *material;
    struct zs_pose pose;
    const struct zs_depth_state *depth_state; /* NULL: nearer wins, and writes its key */
};

/* ---- Light, background, overlays ---------------------------------------------------------- */

/* One directional light. A channel becomes channel * (ambient + diffuse * max(0, normal . dir)), at
 * most full. All fields 0: the usual light. It is white and comes over the camera's left shoulder,
 * from (-1, 2, 2) / 3 in the camera's right, up and back, with ambient 1/4 and diffuse 3/4. As
 * soon as one field is not 0, all three count. For darkness, give ambient 1. */
struct zs_light {
    zs_q2_30 dir[3]; /* unit, world axes, from the surface towards the light; a shorter one dims
                        diffuse */
    zs_uq16_16 ambient, diffuse; /* 0 .. ZS_Q16_ONE */
};

struct zs_rect {
    uint16_t x, y, w, h; /* px in the frame; may reach beyond it */
};

/* A function that colours the pixels on which nothing is drawn. */
struct zs_background {
    /* Colour pixels (x, y) .. (x + n - 1, y) of the frame: out[n], RGB565, most significant byte
     * first (zs_wire565); n >= 1. A pixel's colour must not depend on how a row is cut into calls.
     */
    void (*fill)(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n);
    void *ctx;
};

/* A finished strip of the frame that may still be drawn on. */
struct zs_target {
    uint16_t *color;       /* pixel (x, y) of the frame is color[(y - y0) * pitch + x]: RGB565, most
                              significant byte first */
    const uint16_t *depth; /* the keys, in the same places; NULL: there is no depth memory */
    uint16_t y0, y1;       /* rows [y0, y1) of the frame */
    uint16_t x0, x1;       /* columns [x0, x1); those beside them are not given out */
    uint32_t pitch;        /* pixels from a row to the next */
};

/* A resolve hook: it draws over each strip when the scene has been drawn, before the strip is
 * compared and given out. */
struct zs_resolve {
    void (*draw)(void *ctx, const struct zs_target *target);
    /* Under zs_damage_track, once a frame. Return 1 and a rectangle that holds all that draw
     * changes since the frame before (where something was and where it is now), or 0: nothing
     * changes. NULL: always 0. Strips that are dirty for other reasons are drawn all the same. */
    int (*changes)(void *ctx, struct zs_rect *rect);
    void *ctx;
};

struct zs_scene {
    const struct zs_instance *instance; /* [n_instances], in scene order */
    uint32_t n_instances;               /* 0 .. 65535 */
    struct zs_light light;              /* all 0: over the camera's left shoulder */
    uint16_t background;                /* RGB565 */
    const struct zs_background *sky;    /* in place of background; NULL: background. When what it
                                           draws changes: zs_invalidate (zs_damage.h) */
    const struct zs_resolve *resolve;   /* [n_resolves], in their order; NULL: none */
    uint32_t n_resolves;
};

/* ---- Camera ------------------------------------------------------------------------------- */

enum zs_projection { ZS_PERSPECTIVE = 0, ZS_ORTHOGRAPHIC = 1 };

/* zs_camera_* (zs_math.h) set cameras from angles and points. */
struct zs_camera {
    zs_q2_30 rot[9]; /* world to camera, row-major: rows are right, up, back; a rotation as in
                        struct zs_pose, else ZS_ERR_CAMERA; all 0: it looks down -z */
    int32_t pos[3];  /* the eye, world units, |.| <= ZS_WORLD_MAX */
    uint8_t projection; /* enum zs_projection */
    zs_uq32_32 focal;   /* perspective: focal length in pixels, 2^-16 .. 2^23 */
    zs_q48_16 height;   /* orthographic: world units that the frame's height spans, 2^-13 .. 2^30;
                           refused with ZS_ERR_RANGE where a sub-pixel is smaller than 2^-29 of
                           the farthest coordinate in view */
    zs_q48_16 z_near, z_far; /* world units along the view axis, |near| <= ZS_WORLD_MAX, near < far
                                <= ZS_FAR_MAX; perspective: near > 0, far - near >= far / 65536 */
};

/* What the vertex and face stages of a shader get to know of an instance (zs_shader.h). */
struct zs_shading {
    const struct zs_instance *instance;
    const struct zs_light *light; /* the scene's, or the usual one in its place */
    zs_q2_30 dir[3];              /* its direction in mesh space */
    const struct zs_camera *camera;
};

ZS_C_END

#endif
