/* Lights and shading: several coloured lights, directional, from a point or in a cone; Lambert's
 * diffuse light, highlights by Blinn-Phong or Phong; lit once for a face, at the vertices
 * (Gouraud), or at each pixel (Phong shading).
 *
 *     static struct zs_shine gloss;
 *     static const struct zs_lamp lamp[2] = {
 *         { .dir = { 0, ZS_Q30_ONE, 0 } },
 *         { .kind = ZS_LAMP_POINT, .rgb = ZS_RGB(0xff8000), .pos = { 0, 50, 90 }, .range = 300 } };
 *     static const struct zs_lighting lights = { .lamp = lamp, .n_lamps = 2,
 *                                                .ambient = ZS_RGB(0x303030) };
 *     static const struct zs_lit_material red = {
 *         .material = { .shader = &zs_shade_lit, .rgb = ZS_RGB(0xc02010) },
 *         .lighting = &lights, .shine = &gloss, .specular = ZS_RGB(0xffffff) };
 *     zs_shine_set(&gloss, 32);
 *     ... { .mesh = &ball, .material = &red.material } ...
 *
 * A channel of a lit colour is, with sums over all lamps, and at most full,
 *     rgb * (ambient + sum(lamp * max(0, N . L))) + specular * sum(lamp * highlight) + emission
 * where `lamp` is its colour * strength * attenuation, and `highlight`, where N . L > 0, is
 * max(0, N . H)^power with H = (L + V) / |L + V|, or with ZS_LIT_REFLECT max(0, R . V)^power with
 * R = 2 (N . L) N - L. N is the normal, L points to the lamp, V to the viewer: all of length 1.
 * The scene's own light (zs_scene.light) is not used by these shaders.
 *
 * Positions and directions are those of the world. zs_damage_track does not read behind pointers:
 * where lighting, lamps, shine or a material change between frames, call zs_invalidate.
 *
 * Exact  to two codes of RGB565 of the formula in doubles, three at the very most
 *        (tests/unit/test_lights.c), where a lamp is 1/8 world unit or more from the surface, and
 *        no mesh step is longer than 64 times that distance. A position is rounded to 2^-16 world
 *        unit and to 2^-31 of the mesh's extent.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_LIGHTS_H
#define ZS_LIGHTS_H

#include "zs_shader.h"

ZS_C_BEGIN

#ifndef ZS_LIGHTS_MAX
#define ZS_LIGHTS_MAX 4 /* lamps of a lighting, 0 .. 16; the same for library and program, which
                           zs_init cannot see. A library with fewer refuses more (ZS_ERR_RANGE);
                           one with more reads beyond the program's zs_shadowed_phong.map */
#endif

enum zs_lamp_kind {
    ZS_LAMP_DIRECTIONAL = 0, /* parallel light, as the sun's */
    ZS_LAMP_POINT = 1,       /* from a point, all around */
    ZS_LAMP_SPOT = 2         /* from a point, in a cone */
};

struct zs_lamp {
    uint8_t kind;          /* enum zs_lamp_kind */
    struct zs_rgb rgb;     /* all 0: white */
    zs_uq16_16 strength;   /* times the colour, up to 4 * ZS_Q16_ONE; 0: ZS_Q16_ONE */
    zs_q2_30 dir[3];       /* directional: unit, from the surface towards the lamp; spot: unit, the
                            way in which it shines; length within 2^-12 of 1. Point: not read */
    int32_t pos[3];        /* point and spot: world units, |.| <= ZS_WORLD_MAX. A lamp nearer than
                            2^-8 world unit to a point does not light it */
    uint32_t range;        /* point and spot: the distance, in world units up to 2^30, at which the
                            light has faded to nothing: times (1 - (d / range)^2)^2; 0: no limit */
    uint32_t half;         /* point and spot: the distance at which half of the light is left: times
                            1 / (1 + (d / half)^2), up to 2^30; 0: does not fall off */
    zs_q2_30 inner, outer; /* spot: cosines, -1 .. 1, of the angles from the axis up to which it is
                              full, and from which on it is dark; smooth between them:
                              t^2 (3 - 2 t). inner - outer >= ZS_Q30_ONE / 256 */
};

struct zs_lighting {
    const struct zs_lamp *lamp; /* [n_lamps], kept by the caller; NULL if there are none */
    uint32_t n_lamps;           /* 0 .. ZS_LIGHTS_MAX */
    struct zs_rgb ambient;      /* from everywhere; 0: none */
};

/* A power of cosines as a table, made by zs_shine_set. The fields belong to the library. 272 bytes;
 * materials may share it. */
struct zs_shine {
    uint32_t scale; /* entries to a cosine, q_31 of 2^-16 */
    uint16_t least; /* the cosine, uq0_16, of entry 0: its power is 1/256 */
    uint8_t level[266]; /* at 1/256 of the way from `least` to 1: 255 is 1; some more for
                           rounding */
};

/* Set a table for max(0, cosine)^power; what is below 1/256 becomes 0.
 * power   1 .. 255: the larger, the smaller the highlight
 * Return  ZS_OK; ZS_ERR_NULL; ZS_ERR_RANGE: power */
ZS_NODISCARD int zs_shine_set(struct zs_shine *shine, uint32_t power);

/* Or-ed. */
enum zs_lit_flags {
    ZS_LIT_REFLECT = 1,   /* highlights by Phong's reflected ray, not by Blinn's half-way vector */
    ZS_LIT_TWO_SIDED = 2, /* a normal that points away from the eye is turned round: take it with
                             ZS_CULL_NONE. zs_shade_phong looks at the face's normal for that */
    ZS_LIT_NEAR_VIEWER = 4 /* V points to the eye from where the light falls; else V is the view
                              axis everywhere, which costs less. Orthographic cameras: the axis */
};

/* The material of the shaders below: an instance's `material` points to the first member. A plain
 * struct zs_material with one of them is wrong: it has no lighting, and the renderer cannot see
 * that. */
struct zs_lit_material {
    struct zs_material material;
    const struct zs_lighting *lighting; /* must be given */
    const struct zs_shine *shine;       /* NULL: no highlights */
    struct zs_rgb specular;             /* colour of the highlights; 0: none */
    struct zs_rgb emission;             /* light of its own */
    uint8_t flags;                      /* enum zs_lit_flags */
};

/* All shaders below refuse a frame (zs_frame_begin) with ZS_ERR_NULL: no lighting; ZS_ERR_RANGE or
 * ZS_ERR_VECTOR: as zs_lighting_check, an unknown flag, or a shine that zs_shine_set has not set;
 * ZS_ERR_MESH: no normals, where they are needed.
 *
 * Costs are instructions on a Cortex-M3 (M0 in brackets), of one directional lamp. A face or vertex
 * takes 550 (1,030) without highlights, 660 (1,270) with them, 590 (1,080) with ZS_LIT_REFLECT,
 * 1,140 (2,470) with ZS_LIT_NEAR_VIEWER; of these, 475 (910) for no lamp at all. A point or spot
 * lamp takes 500 to 750 (1,400 to 1,700) in place of 80 (120); each further directional lamp with
 * highlights some 180. Flash, M3 -O2: 3.1 KB, and 0.7 for faces and vertices, 3.3 for pixels, 0.7
 * for textures, beside the shaders of shade/ that they are made of. */

/* Lit once for a face, at its centre; face_rgb or the material's colour. No varyings, no normals of
 * vertices. */
extern const struct zs_shader zs_shade_lit_face;
/* Lit at the vertices and interpolated (Gouraud); needs mesh.normal; vertex_rgb or the material's
 * colour. Normals need not have length 1; one that is 0 gets ambient light and emission. */
extern const struct zs_shader zs_shade_lit;
/* Lit at each pixel, by normals that are interpolated and given length 1 (Phong shading); needs
 * mesh.normal; face_rgb, rounded to five bits a channel, or the material's colour. Directional
 * lamps only, without ZS_LIT_NEAR_VIEWER, else ZS_ERR_RANGE: take the next one.
 * Cost   one lamp, no ZS_LIT_REFLECT: a pixel 28, with highlights 36, in them 45 (M0: some 80, 110,
 *        130); a block of up to 32 pixels of a run 210. Four adds, a root from a table, a product
 *        for light, two channels' words, packing and the store are 26 of these: the floor. Else,
 *        or where a channel's sum may exceed four times full (without highlights twice), each
 *        pixel is lit as a vertex is: from 525 on. */
extern const struct zs_shader zs_shade_phong;
/* The same for all lamps and flags, with six varyings: compile with ZS_VARYINGS_MAX at least 6.
 * Positions are those of mesh.pos, without pos_lo. Cost of a pixel: 690; near viewer 1,330; three
 * lamps of all kinds and a near viewer 2,370. */
extern const struct zs_shader zs_shade_phong_near;
/* A texture times light at the vertices: the luminance (Rec. 601) of what zs_shade_lit gives a
 * white surface of this material, at most 1. Needs mesh.normal, mesh.uv, a texture. */
extern const struct zs_shader zs_shade_texture_lit;
/* A texture times the coloured light of zs_shade_lit on a white surface, or one of vertex_rgb,
 * pixel by pixel; five varyings: compile with ZS_VARYINGS_MAX at least 5. A texel's place is exact
 * to a step of mesh.uv. Cost of a pixel: 305. */
extern const struct zs_shader zs_shade_texture_tinted;

/* A texture times light, and highlights and emission on top, which it does not tint. Need
 * mesh.normal, mesh.uv, a texture; vertex_rgb and face_rgb are not read. A channel, at most full:
 *     texel * (ambient + sum(lamp * max(0, N . L))) + specular * sum(lamp * highlight) + emission
 *
 * Lit at the vertices; light is taken by its luminance (Rec. 601), so that it is exact for lamps
 * and ambient light without colour; it is at most twice full, and highlights full. Four varyings:
 * compile with ZS_VARYINGS_MAX at least 4. Cost of a pixel 54 (M0: 79), as of
 * zs_shade_texture_smooth without accelerators; in triangles with a highlight, where each is
 * divided, 175 (311). A vertex takes 980 (1,800) more than by zs_shade_texture_smooth. Flash, M3
 * -O2, of this and the next two: 3 KB. */
extern const struct zs_shader zs_shade_texture_gloss;
/* The same by channel, for coloured lamps; eight varyings, divided at each pixel: 252 (467). */
extern const struct zs_shader zs_shade_texture_gloss_tinted;
/* The same at each pixel, by normals that are interpolated and given length 1 (Phong shading), for
 * all lamps and flags; eight varyings. Positions are those of mesh.pos, without pos_lo. Each
 * pixel is lit as a vertex is, as by zs_shade_phong_near: 732 (1,492) by one directional lamp. */
extern const struct zs_shader zs_shade_texture_phong;

#define ZS_VARYINGS_LIT 3u /* zs_shade_lit, zs_shade_phong, zs_shade_texture_lit */
#define ZS_VARYINGS_PHONG_NEAR 6u
#define ZS_VARYINGS_TEXTURE_TINTED 5u
#define ZS_VARYINGS_TEXTURE_GLOSS 4u
#define ZS_VARYINGS_TEXTURE_GLOSS_TINTED 8u
#define ZS_VARYINGS_TEXTURE_PHONG 8u

/* Return ZS_OK; ZS_ERR_NULL: no lighting, or lamps that are not given; ZS_ERR_RANGE: n_lamps, a
 * kind, strength, position, range or cone out of range; ZS_ERR_VECTOR: a direction whose length is
 * not 1 to 2^-12. The shaders' checks call it each frame. */
int zs_lighting_check(const struct zs_lighting *lighting);

/* For shaders of your own: the light at a point, as zs_shade_lit has it. out[3]: red, green, blue,
 * 65535 is full, of a surface of colour rgb.
 * s       the argument of a vertex or face stage, whose material is a struct zs_lit_material
 * p       the point, 1/256 mesh steps, |.| < 2^24; of a vertex: zs_mesh_place (zs_shader.h)
 * n       the normal there, mesh axes; any length */
void zs_lit_color(const struct zs_shading *s, struct zs_rgb rgb, const int32_t p[3],
                  const zs_q1_15 n[3], uint16_t out[3]);

ZS_C_END

#endif
