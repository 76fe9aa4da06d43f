/* Shaders that look a shadow map up.
 *
 * Three varyings of a vertex say where it is in the light's view, as uq0_16 of a cube around the
 * instance's sphere: 2^m mesh steps to each side of its middle. So nothing lies outside their
 * range, however large the instance is beside the map, and 16 bits are spent on the instance alone.
 * For each triangle, the cube's place in the map is found: the middle, in texels and keys, and what
 * a step of a varying is in texels and keys.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/pass.h"
#include "effect/shadow.h"
#include "shade/persp.h"

static const struct zs_shadow_map *map_of(const struct zs_instance *in)
{
    return ((const struct zs_shadowed_material *)(const void *)in->material)->map;
}

/* ---- Vertices and faces ---------------------------------------------------------------------- */

/* What the light adds to the ambient light at a normal, at most 65535. */
static uint16_t added(const struct zs_shading *s, const zs_q1_15 n[3])
{
    return (uint16_t)zs_minu32(zs_light_intensity(s, n) - s->light->ambient, 65535u);
}

static void place_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_shadow_vertex(s, map_of(s->instance), v, out);
}

static void smooth_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    place_vertex(s, v, out);
    out[3] = added(s, s->instance->mesh->normal[v]);
}

static uint16_t flat_face(const struct zs_shading *s, uint32_t t)
{
    zs_q1_15 n[3];
    zs_light_face_normal(n, s->instance->mesh, t);
    return added(s, n);
}

/* The colour of a face, RGB565, if the mesh has colours. */
static uint16_t smooth_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_rgb *const rgb = s->instance->mesh->face_rgb;
    return rgb ? zs_rgb565(rgb[t].r, rgb[t].g, rgb[t].b) : 0u;
}

/* ---- Pixels ---------------------------------------------------------------------------------- */

/* The sampler of a job belongs to textures; these shaders have none, and keep the place there. */
static void lit_start(struct zs_job *job)
{
    const struct zs_instance *in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_shadow_map *map = map_of(in);
    struct zs_shadow_place at = { 0 };
    zs_fragments_start(job);
    (void)zs_shadow_steps(&at, in, map); /* lit_check has tried them */
    zs_shadow_middle(&at, in, map);
    job->sampler.base[0] = (uint64_t)(uint32_t)at.u << 32 | (uint32_t)at.v;
    job->sampler.base[1] = (uint64_t)(uint32_t)at.z << 32 | (uint32_t)at.step;
    job->sampler.least_w = (uint32_t)at.key_step;
}

/* A lit channel as a code, 0 .. most, as zs_shade_flat rounds it. most <= 63 */
static uint32_t code(uint8_t channel, uint32_t light, uint32_t most)
{
    const uint32_t t = zs_light_channel(channel, light) * most + 0x8000u;
    return (t + (t >> 16)) >> 16;
}

static uint16_t color_of(const struct zs_rgb *c, uint32_t light)
{
    return zs_wire16((uint16_t)(code(c->r, light, 31) << 11 | code(c->g, light, 63) << 5 |
                                code(c->b, light, 31)));
}

/* The unlit colour of job's triangle; smooth is a constant. */
static inline struct zs_rgb own_color(const struct zs_job *job, const struct zs_instance *in,
                                      int smooth)
{
    const uint32_t c = job->tri->paint, red = c >> 11, green = c >> 5 & 63u, blue = c & 31u;
    const struct zs_rgb rgb = { (uint8_t)(red << 3 | red >> 2), (uint8_t)(green << 2 | green >> 4),
                                (uint8_t)(blue << 3 | blue >> 2) };
    return smooth && in->mesh->face_rgb ? rgb : in->material->rgb;
}

/* A varying at a pixel, rounded to a step: 0 .. 65536. */
static inline uint32_t divided(uint32_t cw, uint32_t w, uint32_t rcp, int32_t lz)
{
    return (zs_persp_over(cw, w, rcp, lz) + 0x4000u) >> 15;
}

/* base + varying * step / 2^shift, for a step < 2^31. */
static inline int32_t moved(int32_t base, uint32_t varying, uint32_t step, int shift)
{
    return base + (int32_t)(zs_mul_uu(varying, step) >> shift);
}

/* The planes of n varyings at a pixel, and their steps to the next one. */
struct walk {
    uint32_t w, c[4], w_step, c_step[4];
};

static inline void walk_set(struct walk *at, const struct zs_job *job, int32_t i, int32_t y, int n)
{
    at->w = zs_plane_at(&job->w, i, y);
    at->w_step = job->w.gx;
    for (int k = 0; k < n; k++) {
        at->c[k] = zs_plane_at(&job->c[k], i, y);
        at->c_step[k] = job->c[k].gx;
    }
}

/* Colour pixels [from, to). n is a constant: 3 varyings, or 4 with the light of the vertices. */
ZS_ALWAYS_INLINE void run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                          int n)
{
    const struct zs_instance *in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_shadow_map *const map = map_of(in);
    const uint64_t *const base = job->sampler.base;
    const uint32_t step = (uint32_t)base[1], key_step = job->sampler.least_w;
    /* for varyings of 0; half a key is added: |.| < 2^31 */
    const int32_t u = (int32_t)(base[0] >> 32) - (int32_t)(step >> 1);
    const int32_t v = (int32_t)(uint32_t)base[0] - (int32_t)(step >> 1);
    const int32_t z = (int32_t)(base[1] >> 32) - (int32_t)(key_step << 7) + 128;
    const uint32_t ambient = job->r->light.ambient;
    const struct zs_rgb rgb = own_color(job, in, n == 4);
    uint32_t now = UINT32_MAX, diffuse = job->tri->paint; /* now: the light that `color` is for */
    uint16_t color = 0, *out = job->color + row->at + from;
    struct walk at;
    walk_set(&at, job, from, row->y, n);
    for (uint16_t *const end = job->color + row->at + to; out != end; out++) {
        const uint32_t w = zs_persp_held(at.w);
        const int32_t lz = zs_clz32(w);
        const uint32_t rcp = zs_recip_inline(w << lz);
        const int32_t x = moved(u, divided(at.c[0], w, rcp, lz), step, 16);
        const int32_t y = moved(v, divided(at.c[1], w, rcp, lz), step, 16);
        const int32_t key = moved(z, divided(at.c[2], w, rcp, lz), key_step, 8) >> 8;
        if (n == 4)
            diffuse = divided(at.c[3], w, rcp, lz);
        const uint32_t light = ambient + (diffuse * zs_shadow_share(map, x, y, key) >> 8);
        if (light != now) {
            now = light;
            color = color_of(&rgb, light);
        }
        *out = color;
        at.w += at.w_step;
        for (int k = 0; k < n; k++)
            at.c[k] += at.c_step[k];
    }
}

static void flat_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run(job, row, from, to, 3);
}

static void smooth_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    run(job, row, from, to, ZS_VARYINGS_MAX < 4 ? 3 : 4); /* with 3 it is always refused */
}

/* ---- Shaders --------------------------------------------------------------------------------- */

static int lit_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_shadow_map *const map = map_of(in);
    struct zs_shadow_place at;
    (void)config;
    if (!map || !map->key || !map->drawn)
        return ZS_ERR_NULL;
    if (map->drawn == ZS_SHADOW_PERSPECTIVE)
        return ZS_ERR_CAMERA;
    return zs_shadow_steps(&at, in, map) ? ZS_OK : ZS_ERR_RANGE;
}

static int smooth_check(const struct zs_instance *in, const struct zs_config *config)
{
    return in->mesh->normal ? lit_check(in, config) : ZS_ERR_MESH;
}

#define SHADOWED(vertex_, face_, run_, check_, varyings_) \
    { .vertex = (vertex_), .face = (face_), .start = lit_start, .run = (run_), .check = (check_), \
      .n_varyings = (varyings_), .opaque = 1 }

const struct zs_shader zs_shade_shadowed_flat = SHADOWED(
    place_vertex, flat_face, flat_run, lit_check, ZS_VARYINGS_SHADOWED_FLAT);
const struct zs_shader zs_shade_shadowed_smooth = SHADOWED(
    smooth_vertex, smooth_face, smooth_run, smooth_check, ZS_VARYINGS_SHADOWED_SMOOTH);
