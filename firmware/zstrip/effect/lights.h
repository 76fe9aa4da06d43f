/* Light at a point: what the lit shaders share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_LIGHTS_H
#define ZS_EFFECT_LIGHTS_H

#include "core/fx.h"
#include "zs_lights.h"

#define ZS_LIT_ONE 32768 /* length of a unit vector here: q1_15 in 32 bits */

/* A point on a surface. */
struct zs_lit_at {
    int64_t pos[3];  /* world, q48_16; set only where zs_lit_placed says so */
    int32_t n[3];    /* normal, world axes: unit, or 0 0 0 */
    int32_t view[3]; /* towards the viewer: unit */
};

/* The light that arrives, uq16_16 for red, green, blue: < 2^21 for 16 lamps. */
struct zs_lit_sum {
    uint32_t diffuse[3]; /* with the ambient light */
    uint32_t shine[3];
};

static inline const struct zs_lit_material *zs_lit_material_of(const struct zs_instance *in)
{
    return (const struct zs_lit_material *)(const void *)in->material;
}

/* 2^31 / sqrt(q / 2^32), below 2^32: within 2^-14.4 of it. q >= 2^30; q_less is q - 2^30. */
extern const uint32_t zs_lit_root[96];
static inline uint32_t zs_lit_rsqrt(uint32_t q_less)
{
    const uint32_t cell = zs_lit_root[q_less >> 25]; /* value, and slope in the low 12 bits */
    return cell - (cell & 4095u) * (q_less << 7 >> 17);
}

/* Scale v to length ZS_LIT_ONE. Return 0 if it is 0 0 0: out is 0 0 0 then. |v| < 2^31 each;
 * out may be v. *square is |v|^2 / 2^(2 *exp + 30), [2^28, 2^31.6). */
int zs_lit_unit(int32_t out[3], const int32_t v[3], uint32_t *square, int32_t *exp);
/* Return 1 if the light depends on where the surface is. */
int zs_lit_placed(const struct zs_lit_material *m, const struct zs_camera *camera);
/* Set at->pos for a point in 1/256 mesh steps. */
void zs_lit_place(struct zs_lit_at *at, const struct zs_instance *in, const int32_t p[3]);
/* Set at->view; from at->pos where `near`, or a side is asked for. */
void zs_lit_view(struct zs_lit_at *at, const struct zs_camera *camera, int near);
/* Set at->n from a normal in mesh axes, |.| <= 2^15. */
void zs_lit_normal(struct zs_lit_at *at, const struct zs_instance *in, const int32_t n[3]);
/* Set *sum to all light of the first lamp, a directional one, without attenuation. */
void zs_lit_lamp(const struct zs_lit_material *m, struct zs_lit_sum *sum);
/* Sum the light of all lamps. */
void zs_lit_add(const struct zs_lit_material *m, const struct zs_lit_at *at,
                struct zs_lit_sum *sum);
/* The light at a point of a face or vertex, as zs_lit_color takes it. */
void zs_lit_sum_at(const struct zs_shading *s, const int32_t p[3], const zs_q1_15 normal[3],
                   struct zs_lit_sum *sum);
/* The colour of a surface in that light, 0 .. 65535. */
void zs_lit_mix(const struct zs_lit_material *m, struct zs_rgb rgb, const struct zs_lit_sum *sum,
                uint16_t out[3]);
/* max(0, c / 65536)^power, uq0_16 up to 65536. */
uint32_t zs_lit_shine(const struct zs_shine *shine, int32_t c);

/* c / 255 * intensity, nearest: as zs_light_channel, but not clamped. intensity < 2^23 */
static inline uint32_t zs_lit_part(uint8_t c, uint32_t intensity)
{
    const uint32_t part = c * intensity;
    return (part + ((part + 0x8000u) >> 8)) >> 8;
}

static inline int32_t zs_lit_dot(const int32_t a[3], const int32_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; /* |a| |b| <= 2^30.1 */
}

/* Convert a channel to a code, 0 .. most, nearest. most <= 63 */
static inline uint32_t zs_lit_code(uint32_t channel, uint32_t most)
{
    const uint32_t t = channel * most + 0x8000u; /* t / 65535 by two shifts */
    return (t + (t >> 16)) >> 16;
}

static inline uint16_t zs_lit_pack(const uint16_t c[3])
{
    return zs_wire16((uint16_t)(zs_lit_code(c[0], 31) << 11 | zs_lit_code(c[1], 63) << 5 |
                                zs_lit_code(c[2], 31)));
}

/* The check of all lit shaders. */
int zs_lit_check(const struct zs_instance *in, const struct zs_config *config);

/* ---- Phong shading (effect/lit_normals.c) ---------------------------------------------------- */

/* A bit of zs_tri.paint: normals are turned round. The others are face_rgb, five bits a channel. */
#define ZS_PHONG_TURNED 1u

/* The checks of textured shaders that need normals and lamps. */
int zs_lit_texture_check(const struct zs_instance *in, const struct zs_config *config);

/* Varyings: three of the normal; and three of the position. */
void zs_phong_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
void zs_phong_near_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
uint16_t zs_phong_face(const struct zs_shading *s, uint32_t t); /* zs_tri.paint */
int zs_phong_check(const struct zs_instance *in, const struct zs_config *config);
int zs_phong_near_check(const struct zs_instance *in, const struct zs_config *config);
/* The colour of a face whose paint is given. */
struct zs_rgb zs_phong_color(const struct zs_instance *in, uint32_t paint);

#endif
