/* zstrip: 3D scenes on microcontroller displays. Integers only, no heap, one strip at a time.
 *
 *     zstrip.h     the first picture: errors, renderer, frames; it includes
 *       zs_scene.h   meshes, textures, materials, instances, scene, camera, colours, angles
 *       zs_setup.h   depth mappings, the configuration, bytes of arena, counts
 *       zs_math.h    sine, vectors, poses, cameras from angles and points
 *     zs_pass.h    several scenes or cameras in one frame
 *     zs_share.h   one frame by two cores
 *     zs_fast.h    accelerators: the same picture in less time
 *     zs_method.h  other ways to remove hidden surfaces than the depth buffer
 *     zs_shader.h  write a shader
 *     zs_damage.h  send and draw only what changed
 *     zs_lights.h  several coloured lights, highlights, light at each pixel
 *     zs_blend.h   transparency            zs_filter.h  filters, mipmaps, cut-outs
 *     zs_shadow.h  shadows                 zs_environment.h  mirrors, skies, environment maps
 *     zs_lines.h   lines, edges and points  zs_supersample.h  four samples a pixel
 *     zs_check.h   check meshes and textures that cannot be trusted
 *     zs_explain.h what is wrong with a black, dark or slow picture, in sentences
 *     zs_overlay.h sprites, text, lines, bars and dials over the picture
 *     zs_fog.h     fog by the distance
 *     zs_dither.h  fewer colours without bands
 *
 * SPDX-License-Identifier: MIT
 *
 * CONVENTIONS
 *
 * World     right-handed, +y up, column vectors; the camera looks down its own -z. Lengths are
 *           int32 "world units" of the user's choice; take a unit small enough to be precise.
 *           |coordinate| <= ZS_WORLD_MAX.
 * Winding   counter-clockwise, seen from outside, is the front.
 * Angles    16-bit turns: 65536 is one full turn, 16384 a right angle; ZS_DEGREES(90); signed:
 *           ZS_PITCH(-15).
 * Screen    x to the right, y down, pixel (i, j) is sampled at (i + 1/2, j + 1/2).
 * Coverage  vertices are snapped to 8 sub-pixel bits (4 on request). Of the snapped triangle,
 *           exactly the pixels of the top-left rule are drawn. Ranges are half-open: [y0, y1).
 * Depth     unsigned 16-bit keys, 0 nearest. Keys saturate at 2^bits - 2; no triangle writes
 *           ZS_DEPTH_CLEAR. The least (key, scene order) wins: on equal keys the earlier triangle
 *           of the earlier instance stays. Instances can ask for another test (struct
 *           zs_depth_state); they are drawn as if triangles were drawn one after another, in scene
 *           order.
 * Textures  u to the right, v down. The texel in some column and row, counted from the top left,
 *           covers u in [column, column + 1) / width; the texel that holds the sample is taken
 *           (nearest).
 * Colour    light is linear in the given RGB values. The frame leaves as RGB565, most significant
 *           byte first.
 * Numbers   qI_F is signed and uqI_F unsigned fixed point: I integer bits (sign included), F
 *           fraction bits, I + F the storage width.
 * Zero      0 in a field means the usual value, where there is one: the field's comment says
 *           which. Initialise structs by the names of their fields; the others are 0 then.
 * Promise   the frame is a function of scene, camera and profile (frame size, sub-pixel bits, depth
 *           mapping and bits). Strip height, pool sizes, buffers, accelerators, compiler and
 *           machine do not change a bit of it.
 * Not here  shadow maps all around a point light, non-uniform or negative scale, more than one
 *           thread in one renderer.
 *
 * A renderer holds no global state: two renderers can be used side by side. While a function works
 * on a renderer, no interrupt may call another one for it.
 *
 * THE SHORTEST PROGRAM, with a mesh and a function that sends a strip to a display
 *
 *     int send(void *ctx, const struct zs_strip *strip);     yours; returns 0 if it was sent
 *     ZS_RENDERER(screen, 240, 240, 16, 600, 400, ZS_VARYINGS_FLAT);
 *     ...
 *     const struct zs_material red = { .shader = &zs_shade_flat, .rgb = ZS_RGB(0xe63c28) };
 *     const struct zs_instance thing = { .mesh = &mesh, .material = &red };
 *     const struct zs_scene scene = { .instance = &thing, .n_instances = 1 };
 *     const struct zs_sink sink = { .submit = send };
 *     struct zs_camera camera;
 *     screen_config.depth = &zs_depth_float;
 *     int err = ZS_INIT(screen);
 *     err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), 240, 100, 20000);
 *     err = err ? err : zs_camera_orbit(&camera, thing.pose.pos, 5000, 0, 0);
 *     err = err ? err : zs_render(&screen, &scene, &camera, &sink);
 */
#ifndef ZSTRIP_H
#define ZSTRIP_H

#include "zs_math.h"
#include "zs_renderer.h"
#include "zs_scene.h"
#include "zs_setup.h"

ZS_C_BEGIN

#define ZS_VERSION 0x000900 /* 0.9.0: major, minor and patch, a byte each */
#define ZS_VERSION_STRING "0.9.0"

/* ---- Errors ------------------------------------------------------------------------------- */

enum zs_err {
    ZS_OK = 0,
    ZS_ERR_NULL = -1,     /* a pointer that must be given is NULL */
    ZS_ERR_SIZE = -2,     /* frame, strip, pool or buffer count outside its range */
    ZS_ERR_ARENA = -3,    /* the arena is smaller than zs_arena_bytes() or not 4-byte aligned */
    ZS_ERR_DEPTH = -4,    /* depth bits outside 8..16, or a mapping that this camera, a method or a
                             shader cannot take */
    ZS_ERR_CAMERA = -5,   /* near, far, focal length, height or rotation outside its range */
    ZS_ERR_RANGE = -6,    /* a position, scale, extent or light that the integers cannot hold; a
                             pose's matrix that is no rotation; an unknown depth function */
    ZS_ERR_MESH = -7,     /* a mesh lacks what its shader reads, or has too many vertices; an
                             unknown `cull` */
    ZS_ERR_SEQUENCE = -8, /* begin, strip and end called out of order */
    ZS_ERR_VARYINGS = -9, /* the shader needs more values a vertex than config.varyings */
    ZS_ERR_VECTOR = -10,  /* a direction of length 0, or two directions that are parallel */
    ZS_ERR_NEAR = -11, /* the near plane is too close: the farthest point of the instances in view
                          is more than 2^21 to 2^22 times as far away; orthographic: near and far
                          are nearer to each other than 2^-29 of it */
    ZS_ERR_TEXTURE = -12, /* a texture's size or clamp is out of range: zs_texture_check */
    ZS_ERR_BUILD = -13,   /* the program was compiled with other headers, or another
                             ZS_VARYINGS_MAX or ZS_SIZE_MAX, than the library */
    ZS_ERR_PASS = -14     /* a pass's viewport is not inside the frame; what it keeps is of another
                             mapping; some passes have depth memory and some have none; the
                             configuration names a method without passes */
};

/* One English clause for an enum zs_err, without a full stop; never NULL. Static storage. */
const char *zs_error_string(int err);

/* ---- Strips and sinks --------------------------------------------------------------------- */

/* A finished strip. The renderer owns the memory. It stays unchanged until the next strip is asked
 * for; with two buffers, until the one after that is. */
struct zs_strip {
    uint16_t x, y, w, h;   /* px in the frame; x is 0 and w the frame's width */
    const uint8_t *px;     /* w * h pixels, row-major, dense: RGB565, most significant byte first.
                              Under zs_damage_track, px and depth are undefined if dirty_w is 0, and
                              under zs_damage_columns beside the columns that were drawn */
    uint32_t n_bytes;      /* w * h * 2 */
    const uint16_t *depth; /* w * h keys, until the next strip is asked for */
    uint16_t dirty_x, dirty_w; /* px: the columns that the panel does not show yet; dirty_w 0: it
                                  shows all. Without damage tracking 0 and w */
};

/* Where zs_render sends strips. The functions may block. A return other than 0 is an error: it ends
 * the frame, and zs_render returns it. Take values below -100, apart from enum zs_err. */
struct zs_sink {
    int (*submit)(void *ctx, const struct zs_strip *strip); /* send it; strip->px is borrowed until
                                                               wait returns, *strip is not */
    int (*wait)(void *ctx); /* block until the submitted strip has been sent. Called once after each
                               submit that returned 0. NULL: submit returns when it has been sent */
    int (*end)(void *ctx); /* the frame is over. Called once for every frame that zs_frame_begin has
                              accepted, after the last wait: also if no strip was submitted because
                              nothing changed, and if submit or wait failed. If nothing failed
                              before, its error is returned, and the whole frame counts as not sent.
                              NULL: nothing to do */
    void *ctx;
};

/* ---- Set-up ------------------------------------------------------------------------------- */

/* Define a static renderer `name`, its configuration `name_config` and its arena `name_arena`, at
 * file or block scope, in C and C++. The arguments are constants that cost RAM (struct zs_config
 * has their ranges); strip_h <= height.
 *
 * The configuration can be changed before ZS_INIT(name). .depth must be: it has no usual value,
 * because a value in this macro would link zs_depth_float, 2.3 KB, into every program that takes
 * another. */
#define ZS_RENDERER(name, width, height, strip_h, max_tris, max_verts, varyings)                   \
    ZS_RENDERER_BUFFERS(name, width, height, strip_h, max_tris, max_verts, varyings, 1)

/* The same with 1 or 2 strip buffers. With two, a strip is drawn while the one before it is sent.
 */
#define ZS_RENDERER_BUFFERS(name, width, height, strip_h, max_tris, max_verts, varyings, buffers)  \
    ZS_ARENA(name##_arena,                                                                         \
             ZS_ARENA_BYTES(width, height, strip_h, max_tris, max_verts, varyings, buffers));      \
    static struct zs_config name##_config = ZS_CONFIG_OF(width, height, strip_h, max_tris,         \
                                                         max_verts, varyings, buffers, 0);         \
    static struct zs_renderer name

/* A renderer without depth memory: ZS_DEPTH_BYTES less. Its mapping is zs_depth_none. */
#define ZS_RENDERER_NO_DEPTH(name, width, height, strip_h, max_tris, max_verts, varyings)          \
    ZS_ARENA(name##_arena,                                                                         \
             ZS_ARENA_BYTES(width, height, strip_h, max_tris, max_verts, varyings, 1) -            \
                 ZS_DEPTH_BYTES(width, strip_h));                                                  \
    static struct zs_config name##_config = ZS_CONFIG_OF(                                          \
        width, height, strip_h, max_tris, max_verts, varyings, 1, &zs_depth_none);                 \
    static struct zs_renderer name

#ifdef __cplusplus
#define ZS_CONFIG_OF(width, height, strip_h, max_tris, max_verts, varyings, buffers, depth)        \
    {                                                                                              \
        width, height, strip_h, max_tris, max_verts, varyings, buffers, 0, 0, depth, nullptr,      \
            nullptr                                                                                \
    }
#else
#define ZS_CONFIG_OF(w, h, rows, tris, verts, vars, bufs, mapping)                                 \
    {                                                                                              \
        .width = (w), .height = (h), .strip_h = (rows), .max_tris = (tris), .max_verts = (verts),  \
        .varyings = (vars), .buffers = (bufs), .subpixel_bits = 0, .depth_bits = 0,                \
        .depth = (mapping), .fast = 0, .method = 0                                                 \
    }
#endif

/* zs_init for a ZS_RENDERER. */
#define ZS_INIT(name) zs_init(&(name), &name##_config, name##_arena, sizeof name##_arena)

/* What a program and the library must agree on: for a version, the layout of structs. */
#define ZS_BUILD                                                                                   \
    (ZS_U32(sizeof(struct zs_renderer)) + (ZS_U32(ZS_VARYINGS_MAX) << 14) +                        \
     (ZS_U32(ZS_SIZE_MAX) << 18) + ZS_VERSION * 0x9e3779b1u)
int zs_init_build(struct zs_renderer *r, const struct zs_config *config, void *arena, size_t bytes,
                  uint32_t build);

/* Set a renderer up over the caller's memory.
 *
 * r       any state; its former arena is forgotten.
 * config  copied.
 * arena   4-byte aligned (ZS_ARENA aligns it for DMA), at least zs_arena_bytes(config) bytes. The
 *         caller keeps it alive and untouched while r is in use. Its contents do not matter.
 * Return  ZS_OK; ZS_ERR_NULL, _SIZE, _DEPTH, _ARENA: r cannot be used, the arena is untouched;
 *         ZS_ERR_BUILD: r is untouched too, as its size is not agreed on. */
static inline int zs_init(struct zs_renderer *r, const struct zs_config *config, void *arena,
                          size_t bytes)
{
    return zs_init_build(r, config, arena, bytes, ZS_BUILD);
}

/* ZS_ARENA_BYTES of a configuration, with strip_h at most the height; without depth memory where
 * the mapping has none. Return 0 if a field other than depth_bits is out of range. */
uint32_t zs_arena_bytes(const struct zs_config *config);

/* ---- Frames ------------------------------------------------------------------------------- */

/* Draw a frame and send it, strip by strip from the top, through a sink. With two buffers, a strip
 * is drawn while the sink sends the one before it.
 *
 * scene, camera  borrowed until the return; constant data is read many times.
 * Return  ZS_OK; an error of zs_frame_begin, before anything was submitted; or the sink's own. On
 *         every return, each submitted strip has been waited for. */
int zs_render(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera,
              const struct zs_sink *sink);

/* The same loop for programs that own it (watchdogs, an RTOS, a GUI's flush callback):
 * zs_frame_begin, then zs_frame_strip until it returns 0, then zs_frame_end.
 *
 * zs_frame_begin makes every check that can refuse a frame, and draws nothing. scene and camera
 * stay borrowed, and unchanged, until zs_frame_end. A begin in the middle of a frame drops that
 * frame.
 *
 * Return  ZS_OK; ZS_ERR_NULL, _SEQUENCE (r is not set up), _SIZE, _CAMERA, _DEPTH, _RANGE, _NEAR,
 *         _MESH, _VARYINGS, _TEXTURE, _VECTOR (a lamp's direction), _PASS (zs_mask_window): no
 *         frame is open. */
int zs_frame_begin(struct zs_renderer *r, const struct zs_scene *scene,
                   const struct zs_camera *camera);

/* Draw the next strip. It overwrites the buffer of the strip that was given out config.buffers
 * calls ago, which must have been sent.
 *
 * out     filled if the return is 1.
 * Cost    one strip; if the pools are smaller than the scene, a walk over the scene as well.
 * Return  1; 0 when all strips have been given out; ZS_ERR_NULL, ZS_ERR_SEQUENCE. */
int zs_frame_strip(struct zs_renderer *r, struct zs_strip *out);

/* Leave out the next strip: it counts as given out, but is not drawn. Several renderers, each with
 * its own arena, can so draw a frame together on as many cores, each its share of the strips. The
 * picture is the same, bit for bit. Under zs_damage_compare the strip's hash stays.
 *
 * Cost    the strip's list of triangles is read; nothing before the first strip that is drawn.
 * Return  1; 0 when all strips have been given out; ZS_ERR_NULL; ZS_ERR_SEQUENCE, also under
 *         zs_damage_track, which chooses the strips itself. */
int zs_frame_skip(struct zs_renderer *r);

/* Close the frame, whether or not all strips were drawn.
 * Return ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE: no frame is open. */
int zs_frame_end(struct zs_renderer *r);

/* Counts of the frame that was begun last; never NULL. Valid as long as r. */
const struct zs_stats *zs_frame_stats(const struct zs_renderer *r);

ZS_C_END

#endif
