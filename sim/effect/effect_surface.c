/* The model's surface: transparent, filtered, lit by lamps, mirroring an environment, dithered.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_filter.h"

/* Shaders in place of the plain ones. */
struct shaders {
    const struct zs_shader *raw, *flat, *smooth, *texture, *texture_flat, *texture_smooth;
};
#define SHADERS(family)                                                                                               \
    {                                                                                                                 \
        &zs_##family##_raw, &zs_##family##_flat, &zs_##family##_smooth, &zs_##family##_texture,                       \
            &zs_##family##_texture_flat, &zs_##family##_texture_smooth                                                \
    }

static const struct zs_shader *in_place_of(const struct shaders *of, const struct zs_shader *plain)
{
    return plain == &zs_shade_raw            ? of->raw
           : plain == &zs_shade_flat         ? of->flat
           : plain == &zs_shade_smooth       ? of->smooth
           : plain == &zs_shade_texture      ? of->texture
           : plain == &zs_shade_texture_flat ? of->texture_flat
                                             : of->texture_smooth;
}

/* ---- Transparency */

static void make_transparent(struct sim_effect_scene *out, uint32_t n, const struct sim_effect_options *e)
{
    static const struct shaders families[] = { SHADERS(blend), SHADERS(add), SHADERS(stipple) };
    out->surface->blend = sim_alloc(n, sizeof *out->surface->blend);
    for (uint32_t i = 0; i < n; i++) {
        struct zs_blend *m = &out->surface->blend[i];
        *m = (struct zs_blend){ .material = *out->instance[i].material, .alpha = (uint8_t)lround(e->alpha * 255.0) };
        m->material.shader = in_place_of(&families[e->blend], m->material.shader);
        out->instance[i].material = &m->material;
    }
    if (e->blend != SIM_BLEND_SCREEN_DOOR)
        out->method = &zs_method_transparent;
}

static struct zs_material *plain_materials(struct sim_effect_scene *out, uint32_t n)
{
    out->surface->plain = sim_alloc((size_t)n + 1, sizeof *out->surface->plain);
    for (uint32_t i = 0; i < n; i++) {
        out->surface->plain[i] = *out->instance[i].material;
        out->instance[i].material = &out->surface->plain[i];
    }
    return out->surface->plain;
}

/* Append levels to a texture in RGB565, each texel the mean of four, by code, rounded to nearest. */
static void add_levels(struct zs_texture *t)
{
    const uint32_t levels = 1u + (t->log2_w < t->log2_h ? t->log2_w : t->log2_h);
    const uint16_t *from = t->texel;
    uint16_t *all = sim_alloc((size_t)2 << (t->log2_w + t->log2_h), sizeof *all), *to = all;
    memcpy(to, from, sizeof *to << (t->log2_w + t->log2_h));
    for (uint32_t k = 1; k < levels; k++) {
        const uint32_t w = 1u << (t->log2_w - k), h = 1u << (t->log2_h - k);
        const uint16_t *above = to;
        to += (size_t)4 * w * h;
        for (uint32_t i = 0; i < w * h; i++) {
            const uint16_t *at = above + i / w * 4u * w + i % w * 2u;
            const uint32_t of[4] = { at[0], at[1], at[2u * w], at[2u * w + 1u] };
            uint32_t red = 2, green = 2, blue = 2;
            for (int c = 0; c < 4; c++) {
                red += of[c] >> 11;
                green += of[c] >> 5 & 63u;
                blue += of[c] & 31u;
            }
            to[i] = (uint16_t)(red / 4u << 11 | green / 4u << 5 | blue / 4u);
        }
    }
    t->texel = all;
    t->n_levels = (uint8_t)levels;
}

/* Textures with levels in place of those of the materials: one for each part that has a texture. */
static void make_levels_of(struct sim_effect_surface *s, struct zs_material *m, uint32_t n)
{
    s->leveled = sim_alloc((size_t)n + 1, sizeof *s->leveled);
    s->n_leveled = n;
    for (uint32_t i = 0; i < n; i++)
        if (m[i].texture != NULL) {
            s->leveled[i] = *m[i].texture;
            add_levels(&s->leveled[i]);
            m[i].texture = &s->leveled[i];
        }
}

/* Parts without a texture stay as they are. */
static void make_filtered(struct sim_effect_scene *out, uint32_t n, int filter)
{
    static const struct shaders of[] = {
        [SIM_FILTER_BILINEAR] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_bilinear,
                                  &zs_shade_bilinear_flat, &zs_shade_bilinear_smooth },
        [SIM_FILTER_MIPMAP] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_mipmap_bilinear,
                                &zs_shade_mipmap_bilinear_flat, &zs_shade_mipmap_bilinear_smooth },
    };
    struct zs_material *m = plain_materials(out, n);
    for (uint32_t i = 0; i < n; i++)
        m[i].shader = in_place_of(&of[filter], m[i].shader);
    if (filter == SIM_FILTER_MIPMAP)
        make_levels_of(out->surface, m, n);
}

/* ---- Lights */

static void set_dir(zs_q2_30 out[3], const double of[3])
{
    const double length = sqrt(of[0] * of[0] + of[1] * of[1] + of[2] * of[2]);
    for (int k = 0; k < 3; k++)
        out[k] = (zs_q2_30)lrint(of[k] / length * 1073741824.0);
}

static zs_q2_30 cosine(double degrees)
{
    return (zs_q2_30)lrint(cos(degrees * acos(-1.0) / 180.0) * 1073741824.0);
}

static int make_lamp(struct zs_lamp *lamp, const struct sim_light *of, const struct sim_scene *from,
                     const struct sim_view *view, const struct sim_options *o)
{
    double aim[3];
    *lamp = (struct zs_lamp){ .kind = (uint8_t)of->kind,
                              .rgb = of->rgb,
                              .strength = (zs_uq16_16)lrint(fmax(o->diffuse, 1e-5) * 65536.0) };
    if (of->rgb.r == 0 && of->rgb.g == 0 && of->rgb.b == 0)
        lamp->rgb.b = 1; /* 0 would be white */
    if (of->kind == SIM_LIGHT_DIR) {
        set_dir(lamp->dir, of->at);
        return SIM_OK;
    }
    for (int k = 0; k < 3; k++) {
        const double at = (of->at[k] - from->origin[k]) / from->unit;
        if (fabs(at) > ZS_WORLD_MAX)
            return sim_refuse(o->model, 0, "--light %g,%g,%g is too far away beside the model", of->at[0], of->at[1],
                              of->at[2]);
        lamp->pos[k] = (int32_t)lrint(at);
        aim[k] = view->at[k] - of->at[k];
    }
    lamp->range = of->range > 0.0 ? (uint32_t)lrint(fmin(fmax(of->range / from->unit, 1.0), 1073741824.0)) : 0u;
    if (of->kind == SIM_LIGHT_SPOT) {
        if (aim[0] == 0.0 && aim[1] == 0.0 && aim[2] == 0.0)
            return sim_refuse(o->model, 0, "--light spot: it stands where it is aimed at; move it away from --at");
        set_dir(lamp->dir, aim);
        lamp->inner = cosine(SIM_SPOT_FULL);
        lamp->outer = cosine(SIM_SPOT_DARK);
    }
    return SIM_OK;
}

static uint8_t channel(double part)
{
    return (uint8_t)lrint(fmin(part, 1.0) * 255.0);
}

static int make_lighting(struct sim_effect_surface *s, const struct sim_scene *from, const struct sim_view *view,
                         const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const struct sim_light plain = { .kind = SIM_LIGHT_DIR,
                                     .at = { view->light[0], view->light[1], view->light[2] },
                                     .rgb = ZS_RGB(0xffffff) };
    const uint8_t ambient = channel(o->ambient);
    int status = SIM_OK;
    for (int k = 0; status == SIM_OK && k < e->n_lights; k++)
        status = make_lamp(&s->lamp[k], &e->light[k], from, view, o);
    if (e->n_lights == 0)
        status = make_lamp(&s->lamp[0], &plain, from, view, o);
    s->lighting = (struct zs_lighting){ .lamp = s->lamp,
                                        .n_lamps = e->n_lights > 0 ? (uint32_t)e->n_lights : 1u,
                                        .ambient = { ambient, ambient, ambient } };
    if (e->specular_text != NULL)
        (void)zs_shine_set(&s->shine, (uint32_t)e->specular_power);
    return status;
}

static int all_directional(const struct zs_lighting *lighting)
{
    for (uint32_t k = 0; k < lighting->n_lamps; k++)
        if (lighting->lamp[k].kind != ZS_LAMP_DIRECTIONAL)
            return 0;
    return 1;
}

/* Have lamps a colour? Ambient light is grey. */
static int colored(const struct zs_lighting *lighting)
{
    for (uint32_t k = 0; k < lighting->n_lamps; k++) {
        const struct zs_rgb c = lighting->lamp[k].rgb;
        if (c.r != c.g || c.g != c.b)
            return 1;
    }
    return 0;
}

static int make_lit(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                    const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    struct sim_effect_surface *s = out->surface;
    const int status = make_lighting(s, from, view, o);
    const int phong = e->per_pixel, near_lamps = !all_directional(&s->lighting);
    const struct zs_shader *shader = phong && near_lamps            ? &zs_shade_phong_near
                                     : phong                        ? &zs_shade_phong
                                     : sim_options_smooth(o)        ? &zs_shade_lit
                                                                    : &zs_shade_lit_face;
    const struct zs_shader *textured = phong                   ? &zs_shade_texture_phong
                                       : colored(&s->lighting) ? &zs_shade_texture_gloss_tinted
                                                               : &zs_shade_texture_gloss;
    s->lit = sim_alloc((size_t)n + 1, sizeof *s->lit);
    for (uint32_t i = 0; i < n; i++) {
        struct zs_lit_material *m = &s->lit[i];
        *m = (struct zs_lit_material){ .material = *out->instance[i].material, .lighting = &s->lighting };
        m->material.shader = m->material.texture != NULL ? textured : shader;
        out->varyings = (uint8_t)fmax(out->varyings, m->material.shader->n_varyings);
        if (e->specular_text != NULL) {
            const uint8_t white = channel(e->specular_strength);
            m->shine = &s->shine;
            m->specular = (struct zs_rgb){ white, white, white };
        }
        out->instance[i].material = &m->material;
    }
    return status;
}

/* ---- Environment */

static int make_environment(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o)
{
    struct sim_effect_surface *s = out->surface;
    struct sim_image image;
    struct sim_texture texture;
    const struct sim_image *given = o->effects.environment_image;
    if (given != NULL) {
        image = *given;
        image.rgb = sim_alloc((size_t)image.width * image.height, sizeof *image.rgb);
        memcpy(image.rgb, given->rgb, (size_t)image.width * image.height * sizeof *image.rgb);
    } else {
        const int status = sim_image_load(&image, o->effects.environment);
        if (status != SIM_OK)
            return status;
    }
    sim_texture_make(&texture, &image, o->effects.environment, NULL);
    s->environment = (struct zs_texture){
        .format = &zs_texel_565, .texel = sim_texture_565(&texture), .log2_w = sim_texture_log2(texture.image.width),
        .log2_h = sim_texture_log2(texture.image.height), .clamp = ZS_CLAMP_U | ZS_CLAMP_V
    };
    sim_texture_free(&texture);
    struct zs_material *m = plain_materials(out, n);
    s->mesh = sim_alloc((size_t)n + 1, sizeof *s->mesh);
    for (uint32_t i = 0; i < n; i++) {
        s->mesh[i] = *out->instance[i].mesh;
        s->mesh[i].uv_bits = 15;
        out->instance[i].mesh = &s->mesh[i];
        m[i].shader = &zs_shade_matcap;
        m[i].texture = &s->environment;
    }
    out->varyings = ZS_VARYINGS_MATCAP;
    return SIM_OK;
}

/* Colours of RGB565 are dithered as they are made, where there are more bits. */
static int make_dithered(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                         const struct sim_options *o)
{
    static const struct zs_shader *const of[] = {
        [SIM_DITHER_ORDERED] = &zs_shade_smooth_ordered, [SIM_DITHER_BLUE] = &zs_shade_smooth_blue
    };
    if (o->shade != SIM_SHADE_SMOOTH || out->instance[0].material != from->scene.instance[0].material)
        return sim_refuse(o->model, 0,
                          "--dither: RGB565 colours are dithered with --shade smooth alone; for fewer colours "
                          "name a grey or one-bit --panel");
    struct zs_material *m = plain_materials(out, n);
    for (uint32_t i = 0; i < n; i++)
        m[i].shader = of[o->effects.dither];
    return SIM_OK;
}

int sim_effect_surfaces(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                        const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    out->surface = sim_alloc(1, sizeof *out->surface);
    if (e->shadow == SIM_SHADOW_MAP && (e->n_lights > 0 || sim_options_textured(o)))
        return make_lighting(out->surface, from, view, o); /* the floor's surface is the model's, too */
    if (e->n_lights > 0 || e->specular_text != NULL || e->per_pixel)
        return make_lit(out, n, from, view, o);
    if (e->has_alpha)
        make_transparent(out, n, e);
    if (e->filter != SIM_FILTER_NEAREST)
        make_filtered(out, n, e->filter);
    if (e->environment != NULL)
        return make_environment(out, n, o);
    if (e->dither != SIM_DITHER_NONE && e->levels == SIM_LEVELS_565)
        return make_dithered(out, n, from, o);
    return SIM_OK;
}

void sim_effect_surfaces_free(struct sim_effect_surface *s)
{
    if (s == NULL)
        return;
    free((void *)(uintptr_t)s->environment.texel);
    for (uint32_t i = 0; i < s->n_leveled; i++)
        free((void *)(uintptr_t)s->leveled[i].texel);
    free(s->leveled);
    SIM_FREE(s->blend, s->plain, s->lit, s->mesh);
    free(s);
}
