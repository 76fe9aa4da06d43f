/* Write a shader: how triangles get their colours.
 *
 * A vertex stage gives each vertex up to ZS_VARYINGS_MAX (3, or 8 by -D) values of 16 bits (varyings), a face
 * stage one value a triangle. Varyings are interpolated perspective-correctly. A fragment stage
 * colours one visible pixel after another:
 *
 *     static const struct zs_shader mine = { .vertex = my_vertex, .fragment = my_fragment,
 *                                            ZS_FRAGMENTS, .n_varyings = 2 };
 *
 * Uniforms: a material of yours that begins with a struct zs_material; a stage finds it by
 * instance->material. zs_damage_track does not see uniforms change: call zs_invalidate then. Stages are called in no order that may be relied on, a vertex or face more
 * than once, only for what may be seen. They must depend on nothing but what they are given, or
 * frames depend on strips and pools. Integers only; no stage may call the renderer.
 * firmware/examples/user_shader.c is a shader in twenty lines.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADER_H
#define ZS_SHADER_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

struct zs_job; /* a triangle in its strip, and a row of it: the library's */
struct zs_row;

/* A visible pixel. */
struct zs_fragment {
    uint16_t x, y;   /* px in the frame */
    uint16_t *color; /* its colour so far; to be overwritten. RGB565, most significant byte first
                        (zs_wire565) */
    uint16_t paint;  /* of the face */
    uint16_t v[ZS_VARYINGS_MAX ? ZS_VARYINGS_MAX : 1]; /* varyings: within 1 of the exact value
                                                          between the vertices' */
};

struct zs_shader {
    /* Varyings of vertex v of the instance's mesh: out[n_varyings], 0 .. 65535. NULL: none. */
    void (*vertex)(const struct zs_shading *s, uint32_t v, uint16_t *out);
    /* A value for face t of its mesh. NULL: 0. */
    uint16_t (*face)(const struct zs_shading *s, uint32_t t);
    /* Colour a pixel that has won the depth test. Needs ZS_FRAGMENTS. */
    void (*fragment)(const struct zs_instance *instance, struct zs_fragment *f);
    /* The two stages behind fragment, or others of the library's: gradients of a triangle, NULL:
     * none; colours of visible pixels [from, to) of a row. */
    void (*start)(struct zs_job *job);
    void (*run)(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
    /* ZS_OK, or why this instance cannot be drawn with it: an error of zs_frame_begin. NULL: ZS_OK.
     */
    int (*check)(const struct zs_instance *instance, const struct zs_config *config);
    /* Textures of the library: n pixels times light, uq1_31, which changes by step; NULL: none. */
    void (*light)(uint16_t *out, int32_t n, uint32_t level, uint32_t step);
    uint8_t n_varyings; /* 0 .. ZS_VARYINGS_MAX, 1 or more with vertex; config.varyings must be as
                           many */
    uint8_t opaque; /* 1: every pixel that has won the test is coloured, and its old colour is not read.
                       Accelerators may then leave out what it hides. 0 is right for any shader; from
                       the first instance with 0 on, the frame goes without zs_fast_tiles */
    uint8_t by_fragment; /* set by ZS_FRAGMENTS */
};

#define ZS_FRAGMENTS .start = zs_fragments_start, .run = zs_fragments_run, .by_fragment = 1
void zs_fragments_start(struct zs_job *job);
void zs_fragments_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

/* Intensity of a unit normal in mesh space: ambient + diffuse * max(0, normal . light), uq16_16,
 * below 3. Exact, rounded once. */
uint32_t zs_light_intensity(const struct zs_shading *s, const zs_q1_15 n[3]);
/* The unit normal of a face in mesh space: the mesh's, or the product of two edges; 0 0 0 without
 * area. */
void zs_light_face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t);
/* A channel under an intensity: uq0_16 where 65535 is full, at most that. c * 257 * intensity /
 * 2^16, nearest. */
static inline uint32_t zs_light_channel(uint8_t c, uint32_t intensity)
{
    const uint32_t part = c * intensity;                        /* < 2^25.6 */
    const uint32_t lit = (part + ((part + 0x8000u) >> 8)) >> 8; /* 256 part and part, < 2^18 */
    return lit > 65535u ? 65535u : lit;
}

#ifdef __cplusplus
}
#endif

#endif
