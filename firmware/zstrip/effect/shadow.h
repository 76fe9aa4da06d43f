/* Shadow maps: what the shaders that look one up share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_SHADOW_H
#define ZS_EFFECT_SHADOW_H

#include "core/fx.h"
#include "shade/persp.h"
#include "zs_shadow.h"

/* Of zs_shadow_map.drawn: by which camera. */
#define ZS_SHADOW_ORTHOGRAPHIC 1
#define ZS_SHADOW_PERSPECTIVE 2

/* log2 of half the cube's side in mesh steps: 2 .. 17. */
static inline int32_t zs_shadow_cube_log2(const struct zs_mesh *mesh)
{
    return 32 - zs_clz32(mesh->radius + 2u);
}

/* Varyings of a vertex: its place in the cube around the instance's sphere, along the map's axes */
void zs_shadow_vertex(const struct zs_shading *s, const struct zs_shadow_map *map, uint32_t v,
                      uint16_t out[3]);

/* A cube's place in the map; a point is at its middle + (varying - 32768) * step. */
struct zs_shadow_place {
    int32_t u, v;     /* q16 texels ... */
    int32_t z;        /* ... and q8 keys; perspective: right, down, distance, in units of the map */
    int32_t step;     /* of a varying: q32 texels ...; perspective: q16 units ... */
    int32_t key_step; /* ... and q16 keys; perspective: near, units */
};
/* Set step and key_step. Return 0 if they are too coarse. */
int zs_shadow_steps(struct zs_shadow_place *at, const struct zs_instance *in,
                    const struct zs_shadow_map *map);
/* Set the rest. */
void zs_shadow_middle(struct zs_shadow_place *at, const struct zs_instance *in,
                      const struct zs_shadow_map *map);

/* Return 1 if a key is lit in column i, row j of the map. Outside the map all are. */
static inline int zs_shadow_sees(const struct zs_shadow_map *map, int32_t i, int32_t j, int32_t key)
{
    if ((uint32_t)i >= map->w || (uint32_t)j >= map->h)
        return 1;
    const int32_t first = map->key[(uint32_t)j * map->w + (uint32_t)i];
    return key <= first || first == (int32_t)ZS_DEPTH_CLEAR;
}

/* What of the light arrives, 0 .. 256. u, v: q16 texels. */
static inline uint32_t zs_shadow_share(const struct zs_shadow_map *map, int32_t u, int32_t v,
                                       int32_t key)
{
    if (!map->soft)
        return zs_shadow_sees(map, u >> 16, v >> 16, key) ? 256u : 0u;
    const int32_t left = u - 32768, above = v - 32768; /* of the middles of four texels */
    const int32_t i = left >> 16, j = above >> 16;
    const uint32_t x = (uint32_t)left >> 12 & 15u, y = (uint32_t)above >> 12 & 15u;
    uint32_t sum = 0;
    if (zs_shadow_sees(map, i, j, key))
        sum += (16u - x) * (16u - y);
    if (zs_shadow_sees(map, i + 1, j, key))
        sum += x * (16u - y);
    if (zs_shadow_sees(map, i, j + 1, key))
        sum += (16u - x) * y;
    if (zs_shadow_sees(map, i + 1, j + 1, key))
        sum += x * y;
    return sum;
}

/* over / z as texels beside the middle of the map, q16. */
static inline int32_t zs_shadow_texels(const struct zs_shadow_map *map, int32_t over, uint32_t z,
                                       uint32_t rcp, int32_t lz, uint32_t size)
{
    const uint32_t far = zs_size32(over) >> 1; /* |over| < 2 z, else beside the map */
    const int32_t by =
        (int32_t)(zs_mul_uu(zs_persp_over(far, z, rcp, lz), (uint32_t)map->texels) >> 30);
    return (int32_t)(size << 15) + (over < 0 ? -by : by);
}

/* What of the light arrives at a point of a perspective map, 0 .. 256: right, down, distance, and
 * the map's near, in units of the map. |.| <= 2^31 - 1 */
static inline uint32_t zs_shadow_cone_share(const struct zs_shadow_map *map, int32_t x, int32_t y,
                                            int32_t z, int32_t near)
{
    if (z <= near || ((uint32_t)z | zs_size32(x) | zs_size32(y)) >> 29) /* or one may be held */
        return 256u;
    const int32_t lz = zs_clz32((uint32_t)z);
    const uint32_t rcp = zs_recip_inline((uint32_t)z << lz);
    if (zs_size32(x) >> 1 >= (uint32_t)z || zs_size32(y) >> 1 >= (uint32_t)z)
        return 256u;
    const uint32_t past = 0x80000000u - zs_persp_over((uint32_t)near, (uint32_t)z, rcp, lz);
    const uint32_t key = (uint32_t)(zs_mul_uu(past, (uint32_t)map->keys) >> 31) + 128u; /* q8 */
    return zs_shadow_share(map, zs_shadow_texels(map, x, (uint32_t)z, rcp, lz, map->w),
                           zs_shadow_texels(map, y, (uint32_t)z, rcp, lz, map->h),
                           (int32_t)(key >> 8));
}

/* The same at a point of the world, q48_16, of either map. */
uint32_t zs_shadow_at(const struct zs_shadow_map *map, const int64_t pos[3]);

#endif
