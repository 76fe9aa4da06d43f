/* Write a shader: how triangles get their colours.
 *
 * The vertex stage computes up to ZS_VARYINGS_MAX varyings of 16 bits for each vertex (3, or up
 * to 8 where library and program are compiled for more). The face stage computes one value for
 * each triangle. Varyings are interpolated perspective-correctly over the triangle. The fragment
 * stage colours one visible pixel at a time:
 *
 *     static const struct zs_shader mine = { .vertex = my_vertex, .fragment = my_fragment,
 *                                            ZS_FRAGMENTS, .n_varyings = 2 };
 *
 * Of struct zs_shader, `vertex`, `face`, `fragment`, `position`, `check`, `n_varyings` and `opaque`
 * are yours. All other fields are the library's: its macros set them, or leave them 0. C++ wants
 * initialisers in the order of the fields: vertex, face, fragment, ZS_FRAGMENTS, n_varyings,
 * opaque, ZS_LAYER, check, position, ZS_POSITIONS.
 *
 * Uniforms: define your own material struct whose first member is a struct zs_material. A stage
 * reads it through instance->material. zs_damage_track does not see that uniforms change: call
 * zs_invalidate after a change.
 *
 * Rules: the order of the calls is not defined. A stage may be called more than once for a vertex
 * or a face, and is called only for those that may be visible. Its result must depend on its
 * arguments alone; otherwise the frame would depend on strip height and pool sizes. No stage may
 * call the renderer. Use integers only. firmware/examples/user_shader.c is a shader in twenty
 * lines.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADER_H
#define ZS_SHADER_H

#include "zstrip.h"

ZS_C_BEGIN

struct zs_job; /* a triangle while one strip is rasterised; its fields belong to the library */
struct zs_row; /* one scanline of that triangle; its fields belong to the library */
struct zs_xform; /* an instance while its vertices are transformed; the same */
struct zs_point; /* a transformed vertex; the same */

/* A visible pixel. */
struct zs_fragment {
    uint16_t x, y;   /* px in the frame */
    uint16_t *color; /* in: the colour drawn there so far; out: the new colour. RGB565, most
                        significant byte first (zs_wire565) */
    uint16_t paint;  /* the value of the face stage for this triangle */
    uint16_t v[ZS_VARYINGS_MAX ? ZS_VARYINGS_MAX : 1]; /* varyings: within 1 of the exact
                                                          interpolated value */
};

struct zs_shader {
    /* Compute the varyings of vertex v of the instance's mesh: out[n_varyings], 0 .. 65535. NULL:
     * the shader has no varyings. */
    void (*vertex)(const struct zs_shading *s, uint32_t v, uint16_t *out);
    /* Return the value of face t of the instance's mesh (zs_fragment.paint). NULL: 0. */
    uint16_t (*face)(const struct zs_shading *s, uint32_t t);
    /* Colour a pixel that has passed the depth test. Needs ZS_FRAGMENTS. */
    void (*fragment)(const struct zs_instance *instance, struct zs_fragment *f);
    /* The two internal stages that call `fragment`; ZS_FRAGMENTS sets them, and the library's
     * shaders have their own. start computes the gradients of a triangle; NULL: nothing to
     * compute. run colours the visible pixels [from, to) of a scanline. */
    void (*start)(struct zs_job *job);
    void (*run)(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
    uint8_t by_fragment; /* set by ZS_FRAGMENTS */
    uint8_t n_varyings; /* 0 .. ZS_VARYINGS_MAX, at most config.varyings; with `vertex` 1 or more */
    /* 1: the shader colours every pixel that has passed the depth test, and does not read its old
     * colour; accelerators may leave out what it covers. 0 is right for every shader: from the
     * first such instance on, the frame is drawn without the accelerator `tiles`. Bits 1 and 2 are
     * the library's: zs_filtered_set (zs_filter.h) takes shaders that have bit 1; bit 2 is
     * zs_shade_raw's. */
    uint8_t opaque;
    uint8_t layer; /* set by ZS_LAYER (zs_blend.h): drawn last by zs_method_transparent */
    /* The library's shaders that test depth in their own way, because they leave pixels out or
     * never write keys: takes the place of zs_rows_test (core/rows.h), with its arguments, under
     * the depth buffer, zs_method_hiz and zs_method_transparent. Other methods ignore it and call
     * run. NULL: the usual test. A shader with a span shares no accelerator with others; its
     * .opaque is 0. */
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step);
    /* Return ZS_OK, or the error with which zs_frame_begin refuses this instance. NULL: ZS_OK. */
    int (*check)(const struct zs_instance *instance, const struct zs_config *config);
    /* The library's textured shaders: multiply n pixels by the light level, uq1_31, which changes
     * by step from pixel to pixel. NULL: unlit. */
    void (*light)(uint16_t *out, int32_t n, uint32_t level, uint32_t step);
    /* Compute where vertex v of the mesh is, in mesh steps, in place of mesh.pos and pos_lo: a flag
     * that waves. Needs ZS_POSITIONS. All positions lie in the mesh's sphere; s is as in `vertex`.
     * zs_light_face_normal still has the normals of mesh.pos. NULL: mesh.pos. */
    void (*position)(const struct zs_shading *s, uint32_t v, int16_t out[3]);
    /* The internal stage that calls `position`; ZS_POSITIONS sets it. Vertices are transformed one
     * by one then, and clusters are not culled. */
    void (*place)(const struct zs_xform *xf, uint32_t v, struct zs_point *out);
};

#define ZS_FRAGMENTS .start = zs_fragments_start, .run = zs_fragments_run, .by_fragment = 1
void zs_fragments_start(struct zs_job *job);
void zs_fragments_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

#define ZS_POSITIONS .place = zs_positions_place
void zs_positions_place(const struct zs_xform *xf, uint32_t v, struct zs_point *out);

/* Return the light intensity at a unit normal in mesh space: ambient + diffuse * max(0, normal .
 * light), uq16_16, below 3. The result is exact but for one rounding. */
uint32_t zs_light_intensity(const struct zs_shading *s, const zs_q1_15 n[3]);
/* Compute the unit normal of face t in mesh space: mesh->face_normal if it is given, else the cross
 * product of two edges, normalised. A face without area has the normal 0 0 0. */
void zs_light_face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t);
/* Set out to vertex v of a mesh, 1/256 steps, |.| <= 2^23: pos, with pos_lo if there is one. */
static inline void zs_mesh_place(const struct zs_mesh *mesh, uint32_t v, int32_t out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = mesh->pos[v][k] * 256 + (mesh->pos_lo ? mesh->pos_lo[v][k] : 0);
}
/* Multiply a colour channel by an intensity (uq16_16): c * 257 * intensity / 2^16, rounded to
 * nearest, clamped to 65535, which is the full channel. */
static inline uint32_t zs_light_channel(uint8_t c, uint32_t intensity)
{
    const uint32_t part = c * intensity;                        /* < 2^25.6 */
    const uint32_t lit = (part + ((part + 0x8000u) >> 8)) >> 8; /* 257 part / 2^16, < 2^18 */
    return lit > 65535u ? 65535u : lit;
}

ZS_C_END

#endif
