/* Surfaces in the light of one lamp, in the shadows of its map: coloured or textured.
 *
 * Varyings are those of shadow_lit.c, and the lamp's light at the vertices. In a perspective map a
 * point's place is divided by its distance from the lamp, at each pixel; all are in units of the
 * map, 2^-28 to 2^-27 of how far it reaches.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/gloss.h"
#include "effect/shadow.h"

#if ZS_VARYINGS_MAX >= 4
static const struct zs_shadowed_lit *material_of(const struct zs_instance *in)
{
    return (const struct zs_shadowed_lit *)(const void *)in->material;
}

/* The place is kept in memory that is a lit palette's otherwise, behind what mipmaps keep there. */
#define PLACE 32
static struct zs_shadow_place *place_of(const struct zs_job *job)
{
    return (struct zs_shadow_place *)(void *)(job->r->lit.color + PLACE);
}
_Static_assert(sizeof(struct zs_shadow_place) <= 2 * (ZS_LIT_COLORS - PLACE), "a place fits");

/* ---- Vertices -------------------------------------------------------------------------------- */

/* The lamp's colour: 0 0 0 stands for white. */
static void lamp_rgb(uint8_t c[3], const struct zs_lit_material *m)
{
    const struct zs_rgb rgb = m->lighting->lamp[0].rgb;
    const int none = !(rgb.r | rgb.g | rgb.b);
    c[0] = none ? 255 : rgb.r;
    c[1] = none ? 255 : rgb.g;
    c[2] = none ? 255 : rgb.b;
}

/* What arrives of the lamp's light at a vertex, uq1_15: by its strongest channel. */
static uint16_t lamp_light(const struct zs_lit_material *m, const struct zs_lit_sum *sum)
{
    const struct zs_rgb rgb = m->lighting->ambient;
    const uint8_t ambient[3] = { rgb.r, rgb.g, rgb.b };
    uint8_t c[3];
    int k = 0;
    lamp_rgb(c, m);
    for (int i = 1; i < 3; i++)
        k = c[i] > c[k] ? i : k;
    const uint32_t more = sum->diffuse[k] - zs_lit_part(ambient[k], ZS_Q16_ONE); /* < 2^19 */
    return (uint16_t)zs_minu32((more * 255u / c[k] + 1u) >> 1, 65535u);
}

/* Set out[0 .. 2] to the place, and out[3] to the light. */
static void vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    struct zs_lit_sum sum;
    int32_t p[3];
    zs_mesh_place(mesh, v, p);
    zs_lit_sum_at(s, p, mesh->normal[v], &sum);
    zs_shadow_vertex(s, material_of(s->instance)->map, v, out);
    out[3] = lamp_light(zs_lit_material_of(s->instance), &sum);
}

/* ---- Pixels ---------------------------------------------------------------------------------- */

/* The planes of varyings that are places, of w, and the job's place. */
static void start(struct zs_job *job)
{
    const struct zs_instance *in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_shadow_map *const map = material_of(in)->map;
    job->r->lit.of = 0; /* no palette is there now */
    (void)zs_shadow_steps(place_of(job), in, map); /* check has tried them */
    zs_shadow_middle(place_of(job), in, map);
}

/* middle + (varying - 32768) * step / 2^shift */
static inline int32_t moved(int32_t middle, uint32_t varying, int32_t step, int shift)
{
    const int32_t from = (int32_t)varying - 32768;
    const int32_t by = (int32_t)(zs_mul_uu(zs_size32(from), (uint32_t)step) >> shift);
    return from < 0 ? middle - by : middle + by; /* |.| <= 2^30 + 2^30 - 1 */
}

/* What of the lamp's light arrives, 0 .. 256. c: varyings, 0 .. 65536 */
static uint32_t arrives(const struct zs_shadow_map *map, const struct zs_shadow_place *at,
                        const uint32_t c[3])
{
    if (map->drawn != ZS_SHADOW_PERSPECTIVE)
        return zs_shadow_share(map, moved(at->u, c[0], at->step, 16),
                               moved(at->v, c[1], at->step, 16),
                               (moved(at->z, c[2], at->key_step, 8) + 128) >> 8);
    return zs_shadow_cone_share(map, moved(at->u, c[0], at->step, 16),
                                moved(at->v, c[1], at->step, 16), moved(at->z, c[2], at->step, 16),
                                at->key_step);
}

/* Light at a pixel by channel, uq16_16. first: of the four varyings. */
static void light_at(const struct zs_job *job, const struct zs_shadowed_lit *m, int32_t i,
                     int32_t y, int first, uint32_t light[3])
{
    const struct zs_rgb ambient = m->lit.lighting->ambient;
    uint32_t w, c[4];
    uint8_t rgb[3];
    int32_t lz;
    const uint32_t rcp = zs_persp_rcp(job, i, y, &w, &lz);
    for (int k = 0; k < 4; k++)
        c[k] = (zs_persp_over(zs_plane_at(&job->c[first + k], i, y), w, rcp, lz) + 0x4000u) >> 15;
    const uint32_t lamp = 2u * c[3] * arrives(m->map, place_of(job), c) >> 8; /* < 2^17 */
    lamp_rgb(rgb, &m->lit);
    light[0] = zs_lit_part(ambient.r, ZS_Q16_ONE) + zs_lit_part(rgb[0], lamp);
    light[1] = zs_lit_part(ambient.g, ZS_Q16_ONE) + zs_lit_part(rgb[1], lamp);
    light[2] = zs_lit_part(ambient.b, ZS_Q16_ONE) + zs_lit_part(rgb[2], lamp);
}

/* ---- Checks ---------------------------------------------------------------------------------- */

static int map_check(const struct zs_instance *in)
{
    const struct zs_shadowed_lit *const m = material_of(in);
    struct zs_shadow_place at;
    if (!m->map || !m->map->key || !m->map->drawn)
        return ZS_ERR_NULL;
    if (m->lit.lighting->n_lamps != 1)
        return ZS_ERR_RANGE;
    return zs_shadow_steps(&at, in, m->map) ? ZS_OK : ZS_ERR_RANGE;
}

static int color_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = in->mesh->normal ? zs_lit_check(in, config) : ZS_ERR_MESH;
    return err ? err : map_check(in);
}

/* ---- Colours --------------------------------------------------------------------------------- */

static uint16_t color_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_rgb *const rgb = s->instance->mesh->face_rgb;
    return rgb ? zs_rgb565(rgb[t].r, rgb[t].g, rgb[t].b) : 0u;
}

static void color_start(struct zs_job *job)
{
    start(job);
    zs_fragments_start(job);
}

static void color_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_shadowed_lit *const m = material_of(in);
    const struct zs_rgb e = m->lit.emission, own = in->material->rgb;
    const uint32_t p = job->tri->paint, red = p >> 11, green = p >> 5 & 63u, blue = p & 31u;
    const struct zs_rgb face = { (uint8_t)(red << 3 | red >> 2), (uint8_t)(green << 2 | green >> 4),
                                 (uint8_t)(blue << 3 | blue >> 2) };
    const struct zs_rgb rgb = in->mesh->face_rgb ? face : own;
    for (int32_t i = from; i < to; i++) {
        uint32_t light[3];
        light_at(job, m, i, row->y, 0, light);
        const uint16_t c[3] = {
            (uint16_t)zs_minu32(zs_lit_part(rgb.r, light[0]) + e.r * 257u, 65535u),
            (uint16_t)zs_minu32(zs_lit_part(rgb.g, light[1]) + e.g * 257u, 65535u),
            (uint16_t)zs_minu32(zs_lit_part(rgb.b, light[2]) + e.b * 257u, 65535u)
        };
        job->color[row->at + i] = zs_lit_pack(c);
    }
}

const struct zs_shader zs_shade_shadowed_lit = {
    .vertex = vertex, .face = color_face, .start = color_start, .run = color_run,
    .check = color_check, .n_varyings = ZS_VARYINGS_SHADOWED_LIT, .opaque = 1
};
#else /* refused, ZS_ERR_VARYINGS, wherever they are used */
const struct zs_shader zs_shade_shadowed_lit = {
    .run = zs_texture_run, .n_varyings = ZS_VARYINGS_SHADOWED_LIT
};
#endif

/* ---- Textures -------------------------------------------------------------------------------- */

#if ZS_VARYINGS_MAX >= 6
static const struct zs_shader as_unlit = { .n_varyings = 2 };

static void texture_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    vertex(s, v, out + 2);
    out[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    out[1] = (uint16_t)(mesh->uv[v][1] + 32768);
}

static int texture_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_lit_texture_check(in, config);
    return err ? err : map_check(in);
}

static void texture_start(struct zs_job *job)
{
    start(job);
    zs_gloss_start_as(job, &as_unlit);
    zs_gloss_planes(job, 2, 6);
}

static void texture_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_shadowed_lit *const m =
        material_of(zs_instance_of(job->r, job->tri->instance));
    const uint32_t more[3] = { m->lit.emission.r * 257u, m->lit.emission.g * 257u,
                               m->lit.emission.b * 257u };
    zs_gloss_run_as(job, &as_unlit, row, from, to);
    for (int32_t i = from; i < to; i++) {
        uint32_t light[3];
        light_at(job, m, i, row->y, 2, light);
        zs_gloss_pixel(job->color + row->at + i, light, more);
    }
}

const struct zs_shader zs_shade_shadowed_texture = {
    .vertex = texture_vertex, .start = texture_start, .run = texture_run, .check = texture_check,
    .n_varyings = ZS_VARYINGS_SHADOWED_TEXTURE, .opaque = ZS_TEXTURED
};
#else
const struct zs_shader zs_shade_shadowed_texture = {
    .run = zs_texture_run, .n_varyings = ZS_VARYINGS_SHADOWED_TEXTURE
};
#endif
