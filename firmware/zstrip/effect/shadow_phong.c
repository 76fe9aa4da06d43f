/* Surfaces lit at each pixel by several lamps, each with a shadow map of its own or none: coloured
 * or textured.
 *
 * Varyings are those of Phong shading with positions (lit_normals.c), as in lit_gloss_pixel.c. A
 * pixel's place in the world is looked up in each map.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/gloss.h"
#include "effect/shadow.h"

#if ZS_VARYINGS_MAX >= 6
/* What a pixel is lit by: one lamp at a time. */
struct light {
    const struct zs_shadowed_phong *of;
    struct zs_lit_material one;
    struct zs_lighting lamp;
    struct zs_lit_at at;
    uint32_t ambient[3];
};

static const struct zs_shadowed_phong *material_of(const struct zs_instance *in)
{
    return (const struct zs_shadowed_phong *)(const void *)in->material;
}

static void light_begin(struct light *l, const struct zs_job *job, const struct zs_instance *in)
{
    const struct zs_rgb ambient = material_of(in)->lit.lighting->ambient;
    l->of = material_of(in);
    l->one = l->of->lit;
    l->one.lighting = &l->lamp;
    l->lamp = (struct zs_lighting){ .n_lamps = 1 };
    l->ambient[0] = zs_lit_part(ambient.r, ZS_Q16_ONE);
    l->ambient[1] = zs_lit_part(ambient.g, ZS_Q16_ONE);
    l->ambient[2] = zs_lit_part(ambient.b, ZS_Q16_ONE);
    zs_lit_view(&l->at, &job->r->camera, 0);
}

/* Set l->at to a covered pixel. first: of the varyings normal and position. */
static void point_at(struct light *l, const struct zs_job *job, const struct zs_instance *in,
                     int32_t i, int32_t row, int first)
{
    zs_gloss_point(job, in, i, row, first, 1, &l->at);
    if (l->one.flags & ZS_LIT_NEAR_VIEWER)
        zs_lit_view(&l->at, &job->r->camera, 1);
}

/* Sum the light of all lamps, each times what its map lets through. */
static void light_sum(struct light *l, struct zs_lit_sum *sum)
{
    const struct zs_lighting *const all = l->of->lit.lighting;
    for (int k = 0; k < 3; k++) {
        sum->diffuse[k] = l->ambient[k];
        sum->shine[k] = 0;
    }
    for (uint32_t i = 0; i < all->n_lamps; i++) {
        const struct zs_shadow_map *const map = l->of->map[i];
        struct zs_lit_sum part;
        l->lamp.lamp = &all->lamp[i];
        zs_lit_add(&l->one, &l->at, &part);
        if (!(part.diffuse[0] | part.diffuse[1] | part.diffuse[2]))
            continue;
        const uint32_t share = map ? zs_shadow_at(map, l->at.pos) : 256u;
        for (int k = 0; k < 3; k++) { /* < 2^21.1 */
            sum->diffuse[k] += part.diffuse[k] * share >> 8;
            sum->shine[k] += part.shine[k] * share >> 8;
        }
    }
}

/* ---- Checks ---------------------------------------------------------------------------------- */

static int maps_check(const struct zs_instance *in)
{
    const struct zs_shadowed_phong *const m = material_of(in);
    for (uint32_t i = 0; i < m->lit.lighting->n_lamps; i++)
        if (m->map[i] && (!m->map[i]->key || !m->map[i]->drawn))
            return ZS_ERR_NULL;
    return ZS_OK;
}

static int color_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_phong_near_check(in, config);
    return err ? err : maps_check(in);
}

/* ---- Colours --------------------------------------------------------------------------------- */

static void color_start(struct zs_job *job)
{
    job->sub_log2 = ZS_AFFINE; /* w is not there yet */
    zs_gloss_planes(job, 0, 6);
}

static void color_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_rgb rgb = zs_phong_color(in, job->tri->paint);
    struct light l;
    light_begin(&l, job, in);
    for (int32_t i = from; i < to; i++) {
        struct zs_lit_sum sum;
        uint16_t c[3];
        point_at(&l, job, in, i, row->y, 0);
        light_sum(&l, &sum);
        zs_lit_mix(&l.one, rgb, &sum, c);
        job->color[row->at + i] = zs_lit_pack(c);
    }
}

const struct zs_shader zs_shade_shadowed_phong = {
    .vertex = zs_phong_near_vertex, .face = zs_phong_face, .start = color_start, .run = color_run,
    .check = color_check, .n_varyings = ZS_VARYINGS_SHADOWED_PHONG, .opaque = 1
};
#else
const struct zs_shader zs_shade_shadowed_phong = ZS_GLOSS_REFUSED(ZS_VARYINGS_SHADOWED_PHONG);
#endif

/* ---- Textures -------------------------------------------------------------------------------- */

#if ZS_VARYINGS_MAX >= 8
static const struct zs_shader as_unlit = { .n_varyings = 2 };

static void texture_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_rgb s = material_of(in)->lit.specular, e = material_of(in)->lit.emission;
    struct light l;
    zs_gloss_run_as(job, &as_unlit, row, from, to);
    light_begin(&l, job, in);
    for (int32_t i = from; i < to; i++) {
        struct zs_lit_sum sum;
        point_at(&l, job, in, i, row->y, 2);
        light_sum(&l, &sum);
        const uint32_t more[3] = { zs_lit_part(s.r, sum.shine[0]) + e.r * 257u,
                                   zs_lit_part(s.g, sum.shine[1]) + e.g * 257u,
                                   zs_lit_part(s.b, sum.shine[2]) + e.b * 257u };
        zs_gloss_pixel(job->color + row->at + i, sum.diffuse, more);
    }
}

static int texture_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_lit_texture_check(in, config);
    return err ? err : maps_check(in);
}

const struct zs_shader zs_shade_shadowed_texture_phong = {
    .vertex = zs_gloss_phong_vertex, .face = zs_phong_face, .start = zs_gloss_phong_start,
    .run = texture_run, .check = texture_check, .n_varyings = ZS_VARYINGS_SHADOWED_TEXTURE_PHONG,
    .opaque = ZS_TEXTURED
};
#else
const struct zs_shader zs_shade_shadowed_texture_phong =
    ZS_GLOSS_REFUSED(ZS_VARYINGS_SHADOWED_TEXTURE_PHONG);
#endif
