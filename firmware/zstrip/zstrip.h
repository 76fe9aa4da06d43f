/* zstrip: 3D scenes on microcontroller displays. Integers only, no heap, one strip at a time.
 *
 * SPDX-License-Identifier: MIT
 *
 * CONVENTIONS
 *
 * World     right-handed, +y up, column vectors; the camera looks down its own -z. Lengths are
 *           int32 "world units" of the user's choice; take a unit small enough to be precise.
 *           |coordinate| <= ZS_WORLD_MAX.
 * Winding   counter-clockwise, seen from outside, is the front.
 * Angles    16-bit turns: 65536 is one full turn, 16384 a right angle.
 * Screen    x to the right, y down, pixel (i, j) is sampled at (i + 1/2, j + 1/2).
 * Coverage  vertices are snapped to 8 sub-pixel bits (4 on request); of the snapped triangle
 *           exactly the pixels of the top-left rule are drawn. Ends are half-open [y0, y1).
 * Depth     unsigned 16-bit keys, 0 nearest. Keys saturate at 2^bits - 2; ZS_DEPTH_CLEAR is what
 *           nothing writes. The least (key, scene order) wins: on equal keys the earlier triangle
 *           of the earlier instance stays. Instances can ask for something else (struct zs_depth_state);
 *           then what counts is scene order, as if triangles were drawn one after another.
 * Textures  u to the right, v down, texel (column, row) from the top left covers u in
 *           [column, column + 1) / width; the texel that holds the sample is taken (nearest).
 * Colour    light is linear in the given RGB values; the frame leaves as RGB565, most significant
 *           byte first.
 * Numbers   qI_F signed and uqI_F unsigned fixed point: I integer bits (sign included), F
 *           fraction bits, I + F the storage width.
 * Promise   the frame is a function of scene, camera and profile (frame size, sub-pixel bits, depth
 *           mapping and bits). Strip height, pool sizes, buffers, skips, compiler and machine do
 *           not change a bit of it.
 * Not here  texture filtering and mipmaps, blending, anti-aliasing, perspective shadows, more than one light, lighting of
 *           back sides (a side that is turned away from the light gets ambient light alone),
 *           non-uniform or negative scale, more than one thread in one renderer.
 *
 * A renderer holds no global state: two renderers can be used side by side. No function here may be
 * called from an interrupt for a renderer that another function is working on.
 */
#ifndef ZSTRIP_H
#define ZSTRIP_H

#include <stddef.h>
#include <stdint.h>

#include "config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Errors ------------------------------------------------------------------------------- */

enum zs_err {
    ZS_OK = 0,
    ZS_ERR_NULL = -1,   /* a pointer that must be given is NULL */
    ZS_ERR_SIZE = -2,   /* frame, strip, pool or buffer count outside its range */
    ZS_ERR_ARENA = -3,  /* the arena is smaller than zs_arena_bytes() or not 4-byte aligned */
    ZS_ERR_DEPTH = -4,  /* depth bits outside 8..16, or a mapping that this camera cannot take */
    ZS_ERR_CAMERA = -5, /* near, far, focal length, height or rotation outside its range */
    ZS_ERR_RANGE = -6,  /* a position, scale, extent or light that the integers cannot hold */
    ZS_ERR_MESH = -7,   /* a mesh lacks what its shader reads, or has a zero scale or too many
                           vertices */
    ZS_ERR_SEQUENCE = -8,  /* begin, strip and end called out of order */
    ZS_ERR_VARYINGS = -9,  /* the shader needs more attributes a vertex than the arena was sized for */
    ZS_ERR_VECTOR = -10, /* a direction of length 0, or two directions that are parallel */
    ZS_ERR_NEAR = -11,  /* the near plane is too close beside what can be seen: the farthest point of
                           the instances in view is more than 2^21 to 2^22 times as far away */
    ZS_ERR_TEXTURE = -12 /* a texture's size or clamping is out of range (zs_texture_check says which) */
};

/* One English clause for an enum zs_err, without a full stop; never NULL. Static storage. */
const char *zs_error_string(int err);

/* ---- Formats ------------------------------------------------------------------------------ */

/* A cast that neither C nor C++ warns of, for the macros here. */
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
#define ZS_WORLD_MAX (ZS_CAST(int32_t, 1) << 29) /* world units; also the largest extent of an instance */
#define ZS_FAR_MAX (ZS_CAST(int64_t, 1) << 44)   /* world units; a far plane may lie beyond the world */
#define ZS_FOCAL_MIN (ZS_CAST(zs_uq32_32, 1) << 16)
#define ZS_FOCAL_MAX (ZS_CAST(zs_uq32_32, 1) << 55)
#define ZS_HEIGHT_MIN ZS_CAST(zs_q48_16, 8)
#define ZS_DEPTH_CLEAR 65535u

struct zs_rgb {
    uint8_t r, g, b; /* 255 is full; not gamma-corrected on the way */
};

/* The RGB565 value nearest to three 8-bit channels. */
static inline uint16_t zs_rgb565(uint8_t r, uint8_t g, uint8_t b)
{
    return ZS_CAST(uint16_t, ((ZS_U32(r) * 31u + 127u) / 255u) << 11 | ((ZS_U32(g) * 63u + 127u) / 255u) << 5 |
                                 ((ZS_U32(b) * 31u + 127u) / 255u));
}

/* The same as it lies in memory, most significant byte first: what frames consist of. */
static inline uint16_t zs_wire565(uint8_t r, uint8_t g, uint8_t b)
{
    const uint16_t v = zs_rgb565(r, g, b);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return v;
#else
    return ZS_CAST(uint16_t, ZS_U32(v) << 8 | ZS_U32(v) >> 8);
#endif
}

/* ---- Scene: all of it const, all of it may lie in flash ------------------------------------- */

struct zs_texel; /* how texels are stored: one of the three below */
extern const struct zs_texel zs_texel_565;  /* uint16_t [height][width], RGB565 values */
extern const struct zs_texel zs_texel_pal8; /* uint8_t [height][width], into the palette */
extern const struct zs_texel zs_texel_pal4; /* uint8_t [height][width / 2], the left texel in the low
                                               four bits; width >= 2 */

enum zs_clamp { /* or-ed; what is not clamped is repeated */
    ZS_CLAMP_U = 1, /* left of the texture its first column goes on, right of it its last */
    ZS_CLAMP_V = 2
};

#define ZS_TEXTURE_LOG2_MAX 10u

/* An image of a power of two each way. All of it may lie in flash. */
struct zs_texture {
    const struct zs_texel *format;
    const void *texel;       /* rows from the top; aligned as its elements */
    const uint16_t *palette; /* [n_colors], RGB565 values; NULL with zs_texel_565 */
    uint16_t n_colors;       /* 1 .. 256, or .. 16; no texel may be >= n_colors (zs_texture_check) */
    uint8_t log2_w, log2_h;  /* 0 .. ZS_TEXTURE_LOG2_MAX */
    uint8_t clamp;           /* enum zs_clamp; 0 repeats both ways */
};

/* A run of a mesh's triangles that lie close together. */
struct zs_cluster {
    uint32_t first;    /* triangle */
    uint16_t n_tris;   /* >= 1 */
    int16_t center[3]; /* of a sphere around their vertices, steps */
    uint16_t radius;   /* of that sphere, steps, rounded up */
    int8_t axis[3];    /* of the cone around their normals, 127 is 1 */
    int8_t cutoff;     /* 0 .. 127, 127 is 1. All of them turn their backs to an eye for which
                          (center - eye) . axis >= cutoff * |center - eye| + radius; 127: never */
    uint16_t height;   /* of the flattest of them, over its longest side, 1/16 step, rounded down; those with two
                          corners in one place do not count. 0: not known, and the cone is not used */
};

/* Triangles over shared vertices. World position of a vertex before its instance's pose:
 * pos * scale, or (pos + pos_lo / 256) * scale where pos_lo is given. */
struct zs_mesh {
    const int16_t (*pos)[3];         /* [n_verts], mesh steps */
    const uint8_t (*pos_lo)[3];      /* [n_verts], 1/256 step added to pos; NULL: all zero */
    const uint16_t (*tri)[3];        /* [n_tris], vertex numbers; one >= n_verts: not drawn */
    const zs_q1_15 (*normal)[3];     /* [n_verts], unit; NULL unless smooth shading reads it */
    const zs_q1_15 (*face_normal)[3]; /* [n_tris], unit; NULL: flat shading computes its own */
    const struct zs_rgb *vertex_rgb; /* [n_verts], smooth shading; NULL: the material's colour */
    const struct zs_rgb *face_rgb;   /* [n_tris], flat shading; NULL: the material's colour */
    const uint16_t *face_raw;        /* [n_tris], RGB565 for raw shading; NULL: the material's */
    uint32_t n_verts;                /* 0 .. 65535 */
    uint32_t n_tris;                 /* any */
    zs_uq16_16 scale;                /* world units to a step, > 0 */
    int16_t center[3];               /* of a sphere around all vertices, steps */
    uint16_t radius;                 /* of that sphere, steps, rounded up: too small loses parts */
    const int16_t (*uv)[2];          /* [n_verts], textured shading: 2^-uv_bits of the texture's width
                                        and height; NULL unless that reads it */
    uint8_t uv_bits;                 /* 0 .. 15; 12 holds eight repeats each way to 1/16 texel of 256. A cut at
                                        the near plane rounds to a step: take log2 of the texture's
                                        size + 3 or more, or texels there swim */
    const struct zs_cluster *cluster; /* [n_clusters], all triangles in order; NULL: not known */
    uint32_t n_clusters;
};

struct zs_shader; /* how a triangle gets its colour: one of the six below */
extern const struct zs_shader zs_shade_raw;    /* a colour a face, unlit */
extern const struct zs_shader zs_shade_flat;   /* a colour a face, lit once for the face */
extern const struct zs_shader zs_shade_smooth; /* lit at the vertices, interpolated (Gouraud),
                                                  perspective-correct; needs mesh.normal and
                                                  config.varyings >= ZS_VARYINGS_SMOOTH */
/* Textured, perspective-correct: texels within 1/8 of a texel's width of where they belong (NUMERICS.md has
 * what comes on top: uv_bits, depth bits, triangles a million times as far as near);
 * need mesh.uv and material.texture. The texture's colour is multiplied by light, not by material.rgb. */
extern const struct zs_shader zs_shade_texture;        /* unlit; config.varyings >= ZS_VARYINGS_TEXTURE */
extern const struct zs_shader zs_shade_texture_flat;   /* lit once for the face; the same */
extern const struct zs_shader zs_shade_texture_smooth; /* lit at the vertices; needs mesh.normal and
                                                          config.varyings >= ZS_VARYINGS_TEXTURE_SMOOTH */
#define ZS_VARYINGS_FLAT 0u   /* 16-bit words a vertex that raw and flat shading need */
#define ZS_VARYINGS_SMOOTH 3u /* the same for smooth shading */
#define ZS_VARYINGS_TEXTURE 2u
#define ZS_VARYINGS_TEXTURE_SMOOTH 3u

enum zs_cull {
    ZS_CULL_BACK = 0,  /* triangles that turn clockwise on the screen are not drawn */
    ZS_CULL_FRONT = 1, /* those that turn counter-clockwise are not drawn */
    ZS_CULL_NONE = 2
};

struct zs_material {
    const struct zs_shader *shader;
    struct zs_rgb rgb; /* where the mesh gives no colour */
    uint8_t cull;      /* enum zs_cull */
    const struct zs_texture *texture; /* textured shading; else NULL */
};

/* Where something stands: x_world = rot * (scale * x) + pos. */
struct zs_pose {
    zs_q2_30 rot[9];  /* row-major, orthonormal; see zs_pose_* */
    int32_t pos[3];   /* world units, |.| <= ZS_WORLD_MAX */
    zs_uq16_16 scale; /* > 0; ZS_Q16_ONE leaves the mesh at its own scale */
};

enum zs_depth_func { /* when a pixel is drawn over what is there */
    ZS_DEPTH_LESS = 0,       /* its key is less: on equal keys the earlier stays */
    ZS_DEPTH_LESS_EQUAL = 1, /* less or equal: on equal keys the later wins */
    ZS_DEPTH_ALWAYS = 2      /* always: nothing is tested */
};

/* How an instance is tested against the depth buffer. All fields 0: as an instance without one. */
struct zs_depth_state {
    uint8_t func;       /* enum zs_depth_func */
    uint8_t read_only;  /* 1: tested, but keys are not written */
    int16_t bias;       /* buckets added to every key; < 0: towards the eye */
    int16_t slope_bias; /* q8_8: times the larger of the changes of the key by one pixel right and one down (of the plane
                           through the snapped vertices; of each piece of a clipped triangle for itself), rounded to whole
                           buckets, halves up, and added too. Meant for recip, and for linear under orthographic cameras,
                           whose keys are planes. Keys stop at 0 and 2^bits - 2 */
};

struct zs_instance {
    const struct zs_mesh *mesh;
    const struct zs_material *material;
    struct zs_pose pose;
    const struct zs_depth_state *depth_state; /* NULL: nearer wins and writes its key */
};

/* A colour channel becomes channel * (ambient + diffuse * max(0, normal . dir)), at most full. */
struct zs_light {
    zs_q2_30 dir[3]; /* unit, world, from the surface towards the light; a shorter one dims diffuse */
    zs_uq16_16 ambient, diffuse; /* 0 .. ZS_Q16_ONE */
};

struct zs_rect {
    uint16_t x, y, w, h; /* px in the frame; may reach beyond it */
};

/* What is seen where nothing is drawn, pixel by pixel. */
struct zs_background {
    /* Colour pixels (x, y) .. (x + n - 1, y) of the frame: out[n], RGB565, most significant byte first (zs_wire565). The same
     * pixel gets the same colour however a row is cut into calls. n >= 1. */
    void (*fill)(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n);
    void *ctx;
};

/* A finished strip of the frame that may still be drawn on. */
struct zs_target {
    uint16_t *color;       /* pixel (x, y) of the frame is color[(y - y0) * pitch + x]: RGB565, most significant byte first */
    const uint16_t *depth; /* the keys, in the same places */
    uint16_t y0, y1;       /* rows [y0, y1) of the frame */
    uint16_t x0, x1;       /* columns [x0, x1); what lies beside them is not given out */
    uint32_t pitch;        /* pixels from a row to the next */
};

/* A resolve hook: draws over each strip when the scene has been drawn, before the strip is compared and given out. */
struct zs_resolve {
    void (*draw)(void *ctx, const struct zs_target *target);
    /* Under zs_damage_track, once a frame: 1, and in *rect all that draw makes other than in the frame before (where it was and where it
     * is), may reach beyond the frame; 0: nothing. NULL: always 0. Strips that are due for other reasons are drawn all the same. */
    int (*changes)(void *ctx, struct zs_rect *rect);
    void *ctx;
};

struct zs_scene {
    const struct zs_instance *instance; /* [n_instances], in scene order */
    uint32_t n_instances;               /* 0 .. 65535 */
    struct zs_light light;
    uint16_t background;                /* RGB565 */
    const struct zs_background *sky;    /* in place of background; NULL: background. After a change of what it fills:
                                           zs_invalidate */
    const struct zs_resolve *resolve;   /* [n_resolves], in their order; NULL: none */
    uint32_t n_resolves;
};

enum zs_projection { ZS_PERSPECTIVE = 0, ZS_ORTHOGRAPHIC = 1 };

struct zs_camera {
    zs_q2_30 rot[9];     /* world to camera, row-major: rows are right, up, back; orthonormal */
    int32_t pos[3];      /* the eye, world units, |.| <= ZS_WORLD_MAX */
    uint8_t projection;  /* enum zs_projection */
    zs_uq32_32 focal;    /* perspective: focal length in pixels, 2^-16 .. 2^23 */
    zs_q48_16 height;    /* orthographic: world units that the frame's height spans, 2^-13 .. 2^30; refused
                            with ZS_ERR_RANGE where a sub-pixel is below 2^-29 of what is in view */
    zs_q48_16 z_near, z_far; /* world units along the view axis, |near| <= ZS_WORLD_MAX, near < far <=
                                ZS_FAR_MAX, and perspective: near > 0, far - near >= far / 65536 */
};

/* What a shader's vertex and face stages see of the instance in hand (zs_shader.h). */
struct zs_shading {
    const struct zs_instance *instance;
    const struct zs_light *light; /* the scene's */
    zs_q2_30 dir[3];              /* its direction in mesh space */
};

/* ---- Renderer ----------------------------------------------------------------------------- */

struct zs_depth; /* how a distance becomes a key, b bits, B = 2^b */
extern const struct zs_depth zs_depth_recip;  /* (1/n - 1/z) / (1/n - 1/f) * (B - 1), perspective */
extern const struct zs_depth zs_depth_linear; /* (z - n) / (f - n) * (B - 1), any camera; under
                                                 perspective it takes a reciprocal a pixel */

/* near / z as an unsigned float of e exponent and b - e mantissa bits (e3m13 in 16 bits), taken from 2^b:
 * with 2^-(k+1) <= r = near / z <= 2^-k, k at most 2^e - 2 (then from 0), and m = b - e,
 *   key = 2^b - ((2^e - 2 - k) 2^m + r 2^(k+1+m))
 * 0 at near; a bucket is 2^-(m+1) .. 2^-m of the distance while z < near * 2^(2^e - 1); beyond that, its
 * width in r stays. Perspective. */
extern const struct zs_depth zs_depth_e3m13; /* to z = 128 near; finest */
extern const struct zs_depth zs_depth_e4m12; /* to z = 32,768 near */
extern const struct zs_depth zs_depth_e5m11; /* to all distances */
/* The first of the three that keeps its step to far, by far / near: what to take when in doubt, but for
 * orthographic cameras, which take zs_depth_linear alone (else ZS_ERR_DEPTH). NUMERICS.md has the measurements. */
extern const struct zs_depth zs_depth_float;
/* No depth memory: triangles cover each other in scene order, and the arena is ZS_DEPTH_BYTES smaller
 * (zs_arena_bytes). For scenes that are flat, convex or sorted far to near. Any camera. Depth states
 * have no effect; strips and targets have depth NULL. */
extern const struct zs_depth zs_depth_none;

struct zs_fast;

struct zs_config {
    uint16_t width, height; /* px, 1 .. ZS_SIZE_MAX */
    uint16_t strip_h;       /* rows to a strip, >= 1; more than height means height */
    uint16_t max_tris;      /* binned triangles, 1 .. ZS_POOL_MAX */
    uint16_t max_verts;     /* transformed vertices, 3 .. ZS_POOL_MAX */
    uint8_t varyings;       /* 16-bit values a vertex, 0 .. ZS_VARYINGS_MAX: the largest ZS_VARYINGS_* of its shaders */
    uint8_t buffers;        /* strip buffers, 1 or 2 */
    uint8_t subpixel_bits;  /* 8 or 4 */
    uint8_t depth_bits;     /* 8 .. 16 */
    const struct zs_depth *depth;
    const struct zs_fast *const *fast; /* accelerators, the last one NULL (zs_fast.h); kept by the caller; NULL: none */
};

/* Bytes of arena for a configuration: the sum of its pools. The same number on every machine:
 * indices and not pointers live in the arena. All arguments are constants or variables without side
 * effects; strip_h <= height. */
#define ZS_ROUND4(n) ((ZS_U32(n) + 3u) & ~ZS_U32(3))
#define ZS_COLOR_BYTES(width, strip_h, buffers) \
    (ZS_U32(buffers) * ZS_ROUND4(ZS_U32(width) * ZS_U32(strip_h) * 2u))
#define ZS_DEPTH_BYTES(width, strip_h) ZS_ROUND4(ZS_U32(width) * ZS_U32(strip_h) * 2u)
#define ZS_STRIPS(height, strip_h) ((ZS_U32(height) + ZS_U32(strip_h) - 1u) / ZS_U32(strip_h))
#define ZS_DRAWN_BYTES(strip_h) (ZS_U32(strip_h) * 4u)
#define ZS_TILE_LOG2 5
#define ZS_TILES(width) ((ZS_U32(width) + 31u) >> ZS_TILE_LOG2)
#define ZS_BOUND_BYTES(width, height, strip_h) ZS_ROUND4(2u * ZS_TILES(width) * ZS_STRIPS(height, strip_h))
#define ZS_BIN_BYTES(height, strip_h) ZS_ROUND4(ZS_STRIPS(height, strip_h) * 2u)
#define ZS_TRI_BYTES(max_tris) (ZS_U32(max_tris) * 12u)
#define ZS_VERT_BYTES(max_verts, varyings) \
    (ZS_U32(max_verts) * 12u + 2u * ZS_ROUND4(ZS_U32(max_verts) * 2u) + \
     ZS_ROUND4(ZS_U32(max_verts) * ZS_U32(varyings) * 2u))
#define ZS_ARENA_BYTES(width, height, strip_h, max_tris, max_verts, varyings, buffers) \
    (ZS_COLOR_BYTES(width, strip_h, buffers) + ZS_DEPTH_BYTES(width, strip_h) + \
     ZS_DRAWN_BYTES(strip_h) + ZS_BOUND_BYTES(width, height, strip_h) + \
     ZS_BIN_BYTES(height, strip_h) + ZS_TRI_BYTES(max_tris) + ZS_VERT_BYTES(max_verts, varyings))

/* An arena as a static array, aligned for DMA and caches. */
#define ZS_ARENA(name, bytes) static uint32_t name[((bytes) + 3u) / 4u] ZS_ALIGNED

/* What a frame took. Counts of the frame that zs_frame_begin started, complete after
 * zs_frame_end. Triangles are counted once, vertices and pixels as often as they are worked on.
 * tris_in = tris_drawn + all tris_* below it but tris_clipped. */
struct zs_stats {
    uint32_t instances_in, instances_culled; /* culled: the sphere is outside the view, or ... */
    uint32_t instances_hidden; /* ... these of them: behind large triangles of instances drawn before them */
    uint32_t clusters_in, clusters_culled; /* of the instances that were not culled; culled: outside or turned away */
    uint32_t tris_in;         /* in all instances */
    uint32_t tris_drawn;      /* binned, whole or in clipped pieces */
    uint32_t tris_frustum;    /* in culled instances */
    uint32_t tris_cluster;    /* in culled clusters */
    uint32_t tris_near;       /* wholly before near, or nothing left of them by it */
    uint32_t tris_far;        /* wholly beyond far */
    uint32_t tris_offscreen;  /* beside the frame or the columns that are drawn, or beyond the guard band */
    uint32_t tris_facing;     /* the culled face */
    uint32_t tris_zero;       /* no area after snapping, or one vertex three times */
    uint32_t tris_empty;      /* no sample in the bounding box */
    uint32_t tris_index;      /* a vertex number out of range */
    uint32_t tris_clipped;    /* cut at near, far or guard; also in drawn or in a reject */
    uint32_t verts_transformed;
    uint32_t tris_setup;      /* wide set-ups: a triangle in a strip */
    uint32_t tris_hidden;     /* set-ups that were saved: a triangle in a strip, behind what covers it there, or beside the
                                 columns that are drawn of it (zs_damage_columns) */
    uint32_t pixels_tested;   /* of triangles that are drawn: compared with the depth buffer ... */
    uint32_t pixels_untested; /* ... but for these of them, on which nothing was drawn before */
    uint32_t pixels_written;  /* and nearer; 0 unless built with ZS_STATS = 1 */
    uint32_t strips;          /* given out so far */
    uint32_t strips_clean; /* of these: dirty_w is 0; always 0 without zs_damage_compare and zs_damage_track */
    uint32_t strips_skipped;  /* of these: not drawn (zs_damage_track, zs_frame_skip). What is in no other strip is not counted above, or as culled */
    uint32_t passes;          /* sets of triangles that the pools took the scene in */
    uint32_t max_tris_used, max_verts_used; /* high-water marks of the pools */
};

/* One finished strip. The renderer owns the memory; it stays unchanged until the strip after it
 * (with two buffers: the one after that) is asked for. */
struct zs_strip {
    uint16_t x, y, w, h;   /* px in the frame; x is 0 and w the frame's width */
    uint16_t last;         /* 1 in the frame's last strip */
    const uint8_t *px;     /* w * h pixels, row-major, dense: RGB565, most significant byte first. With zs_damage_track and
                              dirty_w 0, and beside the drawn columns of zs_damage_columns: neither px nor depth
                              holds anything of use */
    uint32_t n_bytes;      /* w * h * 2 */
    const uint16_t *depth; /* w * h keys of this strip, until the next strip is asked for */
    uint16_t dirty_x, dirty_w; /* px: columns that are not on the glass yet (zs_damage_compare, zs_damage_track); dirty_w 0:
                                      none is. Without either 0 and w */
};

/* Where zs_render sends strips. Either function may block. A return other than 0 ends the frame and
 * is passed on; take values below -100 to tell them from enum zs_err. */
struct zs_sink {
    int (*submit)(void *ctx, const struct zs_strip *strip); /* borrows strip->px until wait */
    int (*wait)(void *ctx); /* until the submitted strip is free again; not called where submit
                               failed. NULL: submit is done with the strip when it returns */
    void *ctx;
};

#include "renderer.h" /* struct zs_renderer: its size is public, its fields are not */

/* Set a renderer up over the caller's memory.
 *
 * r       any state; its former arena, if any, is simply forgotten.
 * config  copied.
 * arena   4-byte aligned (ZS_ARENA aligns it for DMA), at least zs_arena_bytes(config); the caller
 *         keeps it alive and untouched while r is used. Its contents on entry do not matter.
 * Return  ZS_OK; ZS_ERR_NULL, _SIZE, _DEPTH, _ARENA: r cannot be used then, the arena is untouched. */
int zs_init(struct zs_renderer *r, const struct zs_config *config, void *arena, size_t bytes);

/* ZS_ARENA_BYTES of a configuration, strip_h cut to the height; 0 where a field is out of range. */
uint32_t zs_arena_bytes(const struct zs_config *config);

/* Draw a frame and send it, strip by strip from the top, through the sink. With two buffers a strip
 * is drawn while the one before it is in the sink's hands.
 *
 * scene, camera  borrowed until the return; const data is read many times.
 * Return  ZS_OK; a zs_frame_begin error, before anything was submitted; or the sink's own. Every
 *         submitted strip has been waited for on every return. */
int zs_render(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera,
              const struct zs_sink *sink);

/* The same loop for callers that own it (watchdogs, an RTOS, a GUI's flush callback):
 * zs_frame_begin, then zs_frame_strip until it returns 0, then zs_frame_end.
 *
 * begin checks everything that a frame can be refused for, and draws nothing. scene and camera stay
 * borrowed, and unchanged, until end. A begin in the middle of a frame drops that frame.
 * Return  ZS_OK; ZS_ERR_NULL, _STATE (r is not set up), _SIZE, _CAMERA, _DEPTH, _RANGE, _NEAR, _MESH,
 *         _VARYINGS, _TEXTURE: no frame is open then. */
int zs_frame_begin(struct zs_renderer *r, const struct zs_scene *scene,
                   const struct zs_camera *camera);

/* Draw the next strip. *out is filled on 1. The strip that was given out config.buffers calls ago
 * is overwritten: it must be free.
 * Cost    one strip; where the pools are smaller than the scene, a walk of the scene as well.
 * Return  1; 0 when all strips have been given out; ZS_ERR_NULL, ZS_ERR_SEQUENCE. */
int zs_frame_strip(struct zs_renderer *r, struct zs_strip *out);

/* Leave the next strip out: it counts as given out, but nothing is drawn. So several renderers, each with an arena of its
 * own, draw a frame together on as many cores, each its share of the strips, bit for bit as one does. With zs_damage_compare it
 * stays as it was given out last.
 * Cost    a look at the strip's triangles; before the first strip that is drawn, nothing.
 * Return  1; 0 when there is none left; ZS_ERR_NULL; ZS_ERR_SEQUENCE, also where zs_damage_track chooses the strips. */
int zs_frame_skip(struct zs_renderer *r);

/* Close the frame, drawn to its end or not. Return ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE: none open. */
int zs_frame_end(struct zs_renderer *r);

/* Counts of the frame begun last; never NULL. Valid as long as r. */
const struct zs_stats *zs_frame_stats(const struct zs_renderer *r);

/* ---- What is on the glass already ------------------------------------------------------------ */

/* What a panel shows: sums of its strips, by columns. One for each panel, shared by all renderers that draw for it: one that
 * had sums of its own would not know what another has drawn over its strips. The fields are the library's. */
struct zs_strip_hashes {
    uint64_t *sum;
    uint16_t width, height, strip_h, columns;
};

/* Begin: nothing is known of what the panel shows.
 *
 * memory   [ZS_STRIPS(height, strip_h) * columns], caller's, kept; its contents do not matter.
 * width, height, strip_h  as in the configuration of the renderers. columns  1 .. width, equally wide but for the last ones.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_SIZE: a number out of range, *sums as before. */
int zs_strip_hashes_init(struct zs_strip_hashes *sums, uint64_t *memory, uint32_t width, uint32_t height, uint32_t strip_h, uint32_t columns);

/* Send only what has changed: from now on each strip is compared, by columns, with what the panel shows. zs_render does
 * not submit a strip without a change; a sink may send dirty_x and dirty_w alone. Pictures are drawn as before, and
 * zs_damage_track begins with all strips.
 *
 * sums     the panel's, kept by the caller; NULL: compare no more. Renderers on several cores may share it: each writes the
 *          sums of the strips that it draws.
 * Exact    a change within one word of two pixels is always seen; others are missed with odds of 2^-64: sums are
 *          compared, not pixels. The one thing here that is not exact; who must have it exact does without.
 * Cost     about ten instructions for two pixels.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (r is not set up, or a frame is open); ZS_ERR_SIZE (the sums are for another
 *          frame size or strip height): as before. zs_init ends it. */
int zs_damage_compare(struct zs_renderer *r, struct zs_strip_hashes *sums);

/* Draw only what may have changed: from now on zs_frame_begin compares what every instance is drawn from (pose; fields of mesh,
 * material, texture and state, not the arrays) with the frame begun before, and a strip that no instance which differs could
 * reach, then or now, is not drawn: zs_frame_strip gives it out with dirty_w 0. All strips are drawn where camera, light,
 * background or the number of instances differ, where an instance on its way changes how far the farthest in view is by a
 * power of two, and after a frame that was refused. Strips that are drawn are what they always are, bit for
 * bit. A strip once due stays so until it has been drawn, in whichever frame. Together with zs_damage_compare: of what is drawn, the
 * columns that have changed.
 *
 * memory       [ZS_DAMAGE_WORDS(n_instances, height, strip_h)], caller's, kept, its contents do not matter; NULL: draw
 *              everything.
 * n_instances  0 .. 65535: what a scene may have at most; zs_frame_begin refuses one with more by ZS_ERR_SIZE.
 * Yours        after a change of bytes that meshes, textures or palettes point at: zs_invalidate. A mesh's sphere must hold it.
 * Exact        a change of one field of a pose is always seen; others are missed with odds of 2^-64 each: 64-bit sums are
 *              compared. The picture stays wrong there until the instance changes again. Who must have it exact does without.
 * Cost         zs_frame_begin, where nothing differs: 400 instructions for an instance, instead of its checks; else on top of
 *              those, and 3,000 for an instance that differs. Each strip that is not drawn: 100. What a frame draws is
 *              walked as always: of an instance that reaches one strip all is transformed, but for clusters that do
 *              not. Every instance is read.
 * Return       ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (r is not set up, or a frame is open); ZS_ERR_SIZE: as before.
 *              zs_init ends it. */
#define ZS_DAMAGE_WORDS(n_instances, height, strip_h) \
    (2u + 4u * ZS_U32(n_instances) + ZS_STRIPS(height, strip_h))
int zs_damage_track(struct zs_renderer *r, uint32_t *memory, uint32_t n_instances);

/* The same by columns as well: of a strip that zs_damage_track has drawn, only the columns that an instance which differs could reach
 * are sure to be drawn. So one moving thing costs its own rectangle, and of others what lies in it: of wide triangles that part
 * alone; small ones, those with a state, and all under zs_depth_linear in perspective are drawn whole.
 *
 * on       0: whole strips again, as after zs_damage_track.
 * Yours    a sink that sends dirty_x and dirty_w alone: px and depth hold something else beside them. Only so much is
 *          drawn besides that the range can be widened to multiples of ZS_DAMAGE_GRAIN, or the frame's end; of drawn
 *          columns zs_damage_compare compares those of its own that lie in them wholly.
 * Exact    as zs_damage_track: the columns given out are those of a full frame, bit for bit.
 * Cost     as zs_damage_track, and 2,000 instructions more for an instance that differs, 25 to 80 for a triangle in a strip that is
 *          drawn in part. Where things that move fill most of the frame, whole strips are a little cheaper.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (zs_damage_track is not on, or a frame is open). zs_damage_track and zs_init end it. */
#define ZS_DAMAGE_GRAIN 8u /* px: a byte or page of any panel's RAM */
int zs_damage_columns(struct zs_renderer *r, int on);

/* The glass does not show there what was given out: it was reset, asleep, turned, or something else drew on it; or the
 * strip could not be sent by a caller that owns the loop (zs_render sees to that by itself). Strips and columns
 * that touch rect (NULL: all) count as changed the next time. At any time, in a frame too, which then walks the scene
 * again.
 * Return ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE: r is not set up. Without zs_damage_compare and zs_damage_track: no effect. */
int zs_invalidate(struct zs_renderer *r, const struct zs_rect *rect);

/* ---- Data that cannot be trusted: a mesh from a card, a texture from a file ------------------ */

enum zs_flaw {
    ZS_FLAW_NONE = 0,
    ZS_FLAW_NULL,        /* pos, tri, cluster, texel, palette or format missing; a format of another kind */
    ZS_FLAW_ALIGN,       /* an array at an address that its elements cannot have */
    ZS_FLAW_COUNT,       /* more than 65535 vertices; index: how many */
    ZS_FLAW_SCALE,       /* scale is 0 */
    ZS_FLAW_INDEX,       /* index: a triangle with a vertex number >= n_verts */
    ZS_FLAW_SPHERE,      /* index: a vertex outside the mesh's sphere */
    ZS_FLAW_NORMAL,      /* index: a vertex whose normal is not of length 1 (0.98 .. 1.02, or 0) */
    ZS_FLAW_FACE_NORMAL, /* index: a face, the same */
    ZS_FLAW_UV_BITS,     /* uv given and uv_bits above 15; index: what they are */
    ZS_FLAW_CLUSTERS,    /* index: a cluster that does not go on where the one before ended, is empty or goes
                            beyond n_tris; n_clusters: triangles are left over */
    ZS_FLAW_CLUSTER_SPHERE, /* index: a cluster with a vertex outside its sphere */
    ZS_FLAW_CLUSTER_CONE, /* index: a cluster with a triangle that its cone does not hold (check.c says
                             when), a cutoff below 0 or an axis longer than 128 */
    ZS_FLAW_CLUSTER_HEIGHT, /* index: a cluster with a triangle that is flatter than its height */
    ZS_FLAW_SIZE,        /* texture: log2_w or log2_h out of range; index: the one that is */
    ZS_FLAW_COLORS,      /* texture with a palette: n_colors out of range; index: n_colors */
    ZS_FLAW_CLAMP,       /* texture: not an enum zs_clamp; index: what it is */
    ZS_FLAW_TEXEL        /* texture: index: row * width + column of a texel >= n_colors */
};

/* What is wrong first: everything that a renderer could read out of bounds or draw wrongly. Reads all of
 * the mesh (texture) and nothing beyond its counts; draws nothing. What passes is drawn without a read out
 * of bounds by every shader that zs_frame_begin accepts for it.
 * index   where: which triangle, vertex, cluster or texel; 0 where nothing is named. NULL: not wanted.
 * Return  ZS_FLAW_NONE or the flaw. mesh, texture NULL: ZS_FLAW_NULL.
 * Cost    linear; once after loading. */
enum zs_flaw zs_mesh_check(const struct zs_mesh *mesh, uint32_t *index);
enum zs_flaw zs_texture_check(const struct zs_texture *texture, uint32_t *index);
/* One English clause for a flaw, without a full stop; never NULL. Static storage. */
const char *zs_flaw_string(enum zs_flaw flaw);

/* ---- Integer helpers: angles, poses, cameras ------------------------------------------------- */

/* sin and cos of an angle. Error <= 2^-28. No table. */
zs_q2_30 zs_sin(zs_turn a);
zs_q2_30 zs_cos(zs_turn a);

/* v scaled to length 1. v any but 0. Error <= 2^-28 a component. v and out may be the same.
 * Return ZS_OK; ZS_ERR_VECTOR (0 0 0: out untouched). */
int zs_unit(zs_q2_30 out[3], const int32_t v[3]);

/* No rotation, no shift, scale 1. */
void zs_pose_identity(struct zs_pose *pose);

/* Set pose->rot to Ry(yaw) * Rx(pitch) * Rz(roll): roll is applied first. pos and scale stay.
 * Error <= 2^-27 an element. */
void zs_pose_turn(struct zs_pose *pose, zs_turn yaw, zs_turn pitch, zs_turn roll);

/* Turn an existing rotation further by a small or large turn about a world axis. Composed any number of
 * times, about any axes, it stays a rotation to 2^-27; after a million turns a point 160 px from the
 * middle is less than a sub-pixel (1/256 px) away from where exact turns would bring it. Quarter turns of
 * what lies along the axes are exact. What is no rotation to 2^-20 is made one first (Gram-Schmidt;
 * where its first two rows are parallel or 0, any).
 * axis  any length but 0. Error <= 2^-28 an element, once.
 * Cost  4,700 instructions on a Cortex-M3, 30,000 on a Cortex-M0+.
 * Return ZS_OK; ZS_ERR_VECTOR (pose untouched). */
int zs_pose_rotate(struct zs_pose *pose, const int32_t axis[3], zs_turn angle);

/* A perspective camera at the origin that looks down -z. fov_y is the vertical angle over height
 * px, 1 .. 32767 turns. near and far in world units.
 * Return ZS_OK; ZS_ERR_CAMERA (fov, near, far or the focal length out of range: camera untouched). */
int zs_camera_perspective(struct zs_camera *camera, zs_turn fov_y, uint16_t height_px,
                          int32_t z_near, int32_t z_far);

/* An orthographic one: height world units fill the frame's height. */
int zs_camera_orthographic(struct zs_camera *camera, int32_t height, int32_t z_near, int32_t z_far);

/* Stand at eye and look at a point, or along a direction of any length but 0; up is the way that
 * is upwards on the screen, any length, not parallel to the view. Only rot and pos change.
 * |coordinate| <= ZS_WORLD_MAX. Error <= 2^-27 an element of rot.
 * Return ZS_OK; ZS_ERR_RANGE; ZS_ERR_VECTOR (eye is at; up parallel to the view): untouched. */
int zs_camera_look_at(struct zs_camera *camera, const int32_t eye[3], const int32_t at[3],
                      const int32_t up[3]);
int zs_camera_look_along(struct zs_camera *camera, const int32_t eye[3], const int32_t dir[3],
                         const int32_t up[3]);

/* Look at a point from a distance: yaw 0 stands on its +z side, yaw 16384 on its +x side; pitch
 * -16383 .. 16383 (as a signed 16-bit turn) raises the eye. Errors as zs_camera_look_at. */
int zs_camera_orbit(struct zs_camera *camera, const int32_t at[3], int32_t distance, zs_turn yaw,
                    int16_t pitch);

#ifdef __cplusplus
}
#endif

#endif
