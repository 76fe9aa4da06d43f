/* Where vertices and instances are in a shadow map's view.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/rotation.h"
#include "core/usual.h"
#include "effect/shadow.h"

#define STEP_MAX ((int64_t)1 << 30)     /* a quarter of a texel, q32 */
#define KEY_STEP_MAX ((int64_t)1 << 22) /* 64 keys, q16 */
#define TEXEL_FAR ((int64_t)1 << 30)    /* 2^14 texels, q16: beyond, no quarter texel brings back */
#define KEY_FAR ((int64_t)1 << 30)      /* 2^22 keys, q8: the same */

void zs_shadow_vertex(const struct zs_shading *s, const struct zs_shadow_map *map, uint32_t v,
                      uint16_t out[3])
{
    const struct zs_instance *in = s->instance;
    const struct zs_mesh *mesh = in->mesh;
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    const int64_t fine = 1 << (17 - zs_shadow_cube_log2(mesh));
    int32_t d[3], e[3];
    zs_mesh_place(mesh, v, d);
    for (int k = 0; k < 3; k++) /* beside the middle, 2^-25 of half the cube; the rest is held */
        d[k] = (int32_t)zs_held64((d[k] - mesh->center[k] * 256) * fine, 1 << 25);
    for (int k = 0; k < 3; k++)
        e[k] = (int32_t)zs_round_shift(zs_dot(rot + 3 * k, d), 30);
    for (int k = 0; k < 3; k++) {
        const int64_t at = zs_round_shift(zs_dot(map->rot + 3 * k, e), 40) + 32768; /* q15 */
        out[k] = (uint16_t)(at < 0 ? 0 : at > 65535 ? 65535 : at);
    }
}

/* The middle of an instance's sphere from the map's eye: right, down, distance, q48_16: < 2^49. */
static void center(int64_t c[3], const struct zs_instance *in, const struct zs_shadow_map *map)
{
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    const uint64_t scale = zs_usual_scale(in);
    zs_q2_30 both[9];
    int32_t from[3], center[3];
    zs_rotation_mul(both, map->rot, rot);
    for (int k = 0; k < 3; k++) {
        from[k] = in->pose.pos[k] - map->pos[k];
        center[k] = in->mesh->center[k];
    }
    for (int k = 0; k < 3; k++)
        c[k] = zs_round_shift(zs_dot(map->rot + 3 * k, from), 14) +
               zs_mulshift_s64(zs_dot(both + 3 * k, center), scale, 46);
}

/* v * factor / 2^shift, held to +-2^40. |v| < 2^50, factor < 2^62, 0 <= shift <= 127. */
static int64_t scaled(int64_t v, uint64_t factor, int32_t shift)
{
    const uint64_t size = (uint64_t)zs_size64(v);
    if (128 - zs_clz64(size | 1u) - zs_clz64(factor | 1u) - shift > 40)
        return v < 0 ? -((int64_t)1 << 40) : (int64_t)1 << 40;
    return zs_mulshift_s64(v, factor, shift);
}

/* ---- Perspective ----------------------------------------------------------------------------- */

/* q48_16 world units in units of the map: far is in [2^27, 2^28) of them. Held to +-2^30. */
static int32_t cone_unit(const struct zs_shadow_map *map, int64_t v)
{
    const int32_t up = map->texels_shift - 32;
    if (zs_size64(v) >> (up > 0 ? 30 - up : 30 + zs_min32(-up, 33)))
        return v < 0 ? -(1 << 30) : 1 << 30;
    return (int32_t)(up >= 0 ? v * ((int64_t)1 << up) : zs_round_shift(v, -up));
}

/* A step of a varying, in q16 units, and near in units. */
static int cone_steps(struct zs_shadow_place *at, const struct zs_instance *in,
                      const struct zs_shadow_map *map)
{
    const uint64_t scale = zs_usual_scale(in); /* q32; a step is 2^(m - 15) mesh steps */
    const int32_t up = zs_shadow_cube_log2(in->mesh) - 15 + map->texels_shift - 32;
    const int32_t near = cone_unit(map, map->z_near);
    if (scale >> 48 || near < 1 || (up > 0 && scale >> (30 - zs_min32(up, 30))))
        return 0;
    const uint64_t step = up >= 0 ? scale << up : scale >> zs_min32(-up, 63);
    /* texels at near: step * focal / near, q32; keys there, q24 */
    if (step > (1u << 30) || step * map->texels > (uint64_t)(uint32_t)near << 30 ||
        step * map->keys / (uint32_t)near >> 24 > 64u)
        return 0;
    at->step = (int32_t)step;
    at->key_step = near;
    return 1;
}

/* ---- Steps and places ------------------------------------------------------------------------ */

/* Set the steps of a varying. Return 0 if they are too coarse. */
int zs_shadow_steps(struct zs_shadow_place *at, const struct zs_instance *in,
                    const struct zs_shadow_map *map)
{
    if (map->drawn == ZS_SHADOW_PERSPECTIVE)
        return cone_steps(at, in, map);
    const uint64_t scale = zs_usual_scale(in);   /* q32 */
    const int32_t up = 31 - zs_shadow_cube_log2(in->mesh); /* a step is 2^(m - 15) mesh steps */
    if (scale >> 48)
        return 0; /* zs_frame_begin refuses it later */
    const int64_t step = scaled((int64_t)scale, map->texels, map->texels_shift + up);
    const int64_t key_step = scaled((int64_t)scale, map->keys, map->keys_shift + up);
    if (step > STEP_MAX || key_step > KEY_STEP_MAX)
        return 0;
    at->step = (int32_t)step;
    at->key_step = (int32_t)key_step;
    return 1;
}

/* Find a cube's middle in the map. */
void zs_shadow_middle(struct zs_shadow_place *at, const struct zs_instance *in,
                      const struct zs_shadow_map *map)
{
    int64_t c[3];
    center(c, in, map);
    if (map->drawn == ZS_SHADOW_PERSPECTIVE) {
        at->u = cone_unit(map, c[0]);
        at->v = cone_unit(map, c[1]);
        at->z = cone_unit(map, c[2]);
        return;
    }
    const int32_t shift = map->texels_shift + 16;
    at->u = (int32_t)zs_held64(scaled(c[0], map->texels, shift) + map->w * 32768, TEXEL_FAR);
    at->v = (int32_t)zs_held64(scaled(c[1], map->texels, shift) + map->h * 32768, TEXEL_FAR);
    at->z = (int32_t)zs_held64(scaled(c[2] - map->z_near, map->keys, map->keys_shift + 8), KEY_FAR);
}

uint32_t zs_shadow_at(const struct zs_shadow_map *map, const int64_t pos[3])
{
    int64_t c[3];
    int32_t whole[3], part[3];
    for (int k = 0; k < 3; k++) {
        const int64_t d = pos[k] - map->pos[k] * (int64_t)65536; /* |.| < 2^47 */
        whole[k] = (int32_t)zs_held64(d >> 16, INT32_MAX / 2);
        part[k] = (int32_t)(d & 65535);
    }
    for (int k = 0; k < 3; k++)
        c[k] = zs_round_shift(zs_dot(map->rot + 3 * k, whole), 14) +
               zs_round_shift(zs_dot(map->rot + 3 * k, part), 30);
    if (map->drawn == ZS_SHADOW_PERSPECTIVE)
        return zs_shadow_cone_share(map, cone_unit(map, c[0]), cone_unit(map, c[1]),
                                    cone_unit(map, c[2]), cone_unit(map, map->z_near));
    const int32_t shift = map->texels_shift + 16;
    const int64_t u = scaled(c[0], map->texels, shift) + map->w * 32768;
    const int64_t v = scaled(c[1], map->texels, shift) + map->h * 32768;
    const int64_t z = scaled(c[2] - map->z_near, map->keys, map->keys_shift + 8);
    return zs_shadow_share(map, (int32_t)zs_held64(u, TEXEL_FAR), (int32_t)zs_held64(v, TEXEL_FAR),
                           (int32_t)((zs_held64(z, KEY_FAR) + 128) >> 8));
}
