/* Shadow maps: the light's keys, and what takes them to the picture.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "core/method.h"
#include "effect/shadow.h"

/* ---- What throws shadows --------------------------------------------------------------------- */

static void nothing_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)job;
    (void)row;
    (void)from;
    (void)to;
}

/* Nobody looks at the colours, so that `opaque` is no lie, and accelerators work. */
static const struct zs_shader nothing = { .run = nothing_run, .opaque = 1 };
const struct zs_material zs_shadow_caster[3] = { { .shader = &nothing, .cull = ZS_CULL_BACK },
                                                 { .shader = &nothing, .cull = ZS_CULL_FRONT },
                                                 { .shader = &nothing, .cull = ZS_CULL_NONE } };

uint32_t zs_shadow_casters(struct zs_instance *out, const struct zs_instance *in, uint32_t n,
                           const struct zs_depth_state *state)
{
    uint32_t casters = 0;
    for (uint32_t k = 0; k < n; k++) {
        const struct zs_material *material = in[k].material;
        if (!material || material->primitive || material->cull > ZS_CULL_NONE)
            continue;
        out[casters].mesh = in[k].mesh;
        out[casters].material = &zs_shadow_caster[material->cull];
        out[casters].pose = in[k].pose;
        out[casters].depth_state = state;
        casters++;
    }
    return casters;
}

/* ---- The map --------------------------------------------------------------------------------- */

/* Copy a strip's keys. The largest is dropped: it is that of all that is behind it, too, and what
 * has it would be in its own shadow. */
static ZS_NOINLINE void keys_copy(const struct zs_shadow_map *map, const struct zs_strip *s,
                                  uint32_t bits)
{
    uint16_t *const to = map->key + (uint32_t)s->y * s->w;
    for (uint32_t k = (uint32_t)s->w * s->h; k--;)
        to[k] = (s->depth[k] + 2u) >> bits ? (uint16_t)ZS_DEPTH_CLEAR : s->depth[k];
}

/* Copy the keys of a frame that has begun. */
static ZS_NOINLINE int keys_taken(const struct zs_shadow_map *map, struct zs_renderer *r)
{
    struct zs_strip strip;
    int got;
    while ((got = zs_frame_strip(r, &strip)) > 0)
        keys_copy(map, &strip, r->config.depth_bits);
    return got;
}

static int32_t bits_of(uint64_t v)
{
    return v ? 64 - zs_clz64(v) : 0;
}

/* Set a factor: num 2^up / den as *factor / 2^*shift. num < 2^16, den < 2^62, up <= 32. The factor
 * is below 2^62, with at least 17 bits. */
static void factor_set(uint64_t *factor, uint8_t *shift, uint32_t num, int32_t up, uint64_t den)
{
    int32_t k = 61 - up - bits_of(num) + bits_of(den);
    k = zs_max32(zs_min32(k, 63 - up), 0);
    *factor = zs_muldiv_u64(num, (uint64_t)1 << (up + k), den);
    *shift = (uint8_t)k;
}

/* The same of a perspective view: focal length, q16 px; far in [2^27, 2^28) units; the key of
 * infinity, q8. A key is that times 1 - near / distance. */
static void cone_set(struct zs_shadow_map *map, const struct zs_camera *light)
{
    const int32_t up = 28 - bits_of((uint64_t)light->z_far); /* -31 .. 27 */
    map->texels = light->focal >> 16;
    map->texels_shift = (uint8_t)(32 + up);
    map->keys = zs_muldiv_u64(65535u * 256u, (uint64_t)light->z_far,
                              (uint64_t)(light->z_far - light->z_near)); /* < 2^28.1 */
}

/* May a lamp have that view? Near and places are rounded to units of the map, which is at most a
 * key where near is 2^-12 of far. */
static ZS_NOINLINE int is_cone(const struct zs_camera *light, const struct zs_config *c)
{
    const uint64_t focal = light->focal >> 16; /* q16 */
    return light->z_far - light->z_near >= light->z_far >> 4 &&
           light->z_near >= light->z_far >> 12 && focal < (uint64_t)1 << 29 &&
           focal * 4u >= (uint64_t)c->width << 16 && focal * 4u >= (uint64_t)c->height << 16;
}

/* Set what takes world units to texels and keys. */
static ZS_NOINLINE void place_set(struct zs_shadow_map *map, const struct zs_renderer *r)
{
    const struct zs_camera *light = &r->camera;
    for (int k = 0; k < 3; k++) { /* rows: right, down, distance */
        map->pos[k] = light->pos[k];
        map->rot[k] = light->rot[k];
        map->rot[3 + k] = -light->rot[3 + k];
        map->rot[6 + k] = -light->rot[6 + k];
    }
    map->z_near = light->z_near;
    if (light->projection == ZS_PERSPECTIVE) {
        cone_set(map, light);
        return;
    }
    factor_set(&map->texels, &map->texels_shift, map->h, 32, (uint64_t)light->height);
    factor_set(&map->keys, &map->keys_shift, (1u << r->config.depth_bits) - 1u, 16,
               (uint64_t)(light->z_far - light->z_near));
}

int zs_shadow_map_draw(struct zs_shadow_map *map, struct zs_renderer *r,
                       const struct zs_scene *casters, const struct zs_camera *light)
{
    if (!map || !map->key || !r || !casters || !light)
        return ZS_ERR_NULL;
    map->drawn = 0;
    if (r->ready != 1 || r->strip_hash || r->track)
        return ZS_ERR_SEQUENCE;
    const struct zs_config *c = &r->config;
    if (map->w != c->width || map->h != c->height)
        return ZS_ERR_SIZE;
    const int cone = light->projection == ZS_PERSPECTIVE;
    if (c->depth != (cone ? &zs_depth_recip : &zs_depth_linear) || c->method != &zs_method_buffer)
        return ZS_ERR_DEPTH;
    if (cone && (!is_cone(light, c) || c->depth_bits != 16))
        return ZS_ERR_CAMERA;
    int err = zs_frame_begin(r, casters, light);
    if (err)
        return err;
    place_set(map, r);
    err = keys_taken(map, r);
    (void)zs_frame_end(r);
    map->drawn = err ? 0 : cone ? ZS_SHADOW_PERSPECTIVE : ZS_SHADOW_ORTHOGRAPHIC;
    return err;
}

void zs_shadow_map_light(const struct zs_shadow_map *map, struct zs_light *light)
{
    for (int k = 0; k < 3; k++)
        light->dir[k] = -map->rot[6 + k];
    if (!(light->ambient | light->diffuse)) {
        light->ambient = ZS_Q16_ONE / 4;
        light->diffuse = ZS_Q16_ONE / 4 * 3;
    }
}
