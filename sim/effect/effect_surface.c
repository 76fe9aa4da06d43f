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

/* Shaders in place of the plain ones; NULL: not of this one. */
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
           : plain == &zs_shade_texture_smooth ? of->texture_smooth
                                               : NULL;
}

/* The material of instance i of the model, to be changed. */
static struct sim_effect_part *part_of(struct sim_effect_scene *out, uint32_t i)
{
    return &out->surface->part[1u + i];
}

/* Give instances a plain material of their own. */
static void own_materials(struct sim_effect_scene *out, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        struct sim_effect_part *part = part_of(out, i);
        part->of.plain = *out->model[i].material;
        out->model[i].material = &part->of.plain;
    }
}

/* ---- Filters */

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

/* A texture with levels in place of a part's. */
static void make_levels_of(struct sim_effect_part *part)
{
    part->leveled = *part->of.plain.texture;
    add_levels(&part->leveled);
    part->of.plain.texture = &part->leveled;
}

/* Parts without a texture stay as they are. */
static int filter_part(struct sim_effect_part *part, int filter)
{
    static const struct shaders of[] = {
        [SIM_FILTER_BILINEAR] = { .texture = &zs_shade_bilinear, .texture_flat = &zs_shade_bilinear_flat,
                                  .texture_smooth = &zs_shade_bilinear_smooth },
        [SIM_FILTER_MIPMAP] = { .texture = &zs_shade_mipmap_bilinear, .texture_flat = &zs_shade_mipmap_bilinear_flat,
                                .texture_smooth = &zs_shade_mipmap_bilinear_smooth },
    };
    struct zs_material *m = &part->of.plain;
    if (m->texture == NULL)
        return ZS_OK;
    if (filter == SIM_FILTER_MIPMAP)
        make_levels_of(part);
    const struct zs_shader *with = in_place_of(&of[filter], m->shader);
    if (with != NULL) {
        m->shader = with;
        return ZS_OK;
    }
    const int err = zs_filtered_set(&part->filtered, m->shader,
                                    filter == SIM_FILTER_MIPMAP ? &zs_filter_levels_linear : &zs_filter_linear);
    m->shader = &part->filtered.shader;
    return err;
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

static void shine_of(struct zs_lit_material *m, struct sim_effect_surface *s, const struct sim_effect_options *e)
{
    const uint8_t white = channel(e->specular_strength);
    if (e->specular_text == NULL)
        return;
    m->shine = &s->shine;
    m->specular = (struct zs_rgb){ white, white, white };
}

static void make_lit(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    struct sim_effect_surface *s = out->surface;
    const int phong = e->per_pixel, near_lamps = !all_directional(&s->lighting);
    const struct zs_shader *shader = phong && near_lamps            ? &zs_shade_phong_near
                                     : phong                        ? &zs_shade_phong
                                     : sim_options_smooth(o)        ? &zs_shade_lit
                                                                    : &zs_shade_lit_face;
    const struct zs_shader *textured = phong                   ? &zs_shade_texture_phong
                                       : colored(&s->lighting) ? &zs_shade_texture_gloss_tinted
                                                               : &zs_shade_texture_gloss;
    for (uint32_t i = 0; i < n; i++) {
        struct zs_lit_material *m = &part_of(out, i)->of.lit;
        *m = (struct zs_lit_material){ .material = *out->model[i].material, .lighting = &s->lighting };
        m->material.shader = m->material.texture != NULL ? textured : shader;
        shine_of(m, s, e);
        out->model[i].material = &m->material;
    }
}

/* ---- Shadow maps */

/* Vertices that no two triangles share. */
struct sim_effect_corners {
    int16_t (*pos)[3];
    uint8_t (*lo)[3];
    zs_q1_15 (*normal)[3];
    uint16_t (*tri)[3];
};

/* A mesh without normals gets those of its faces, at vertices of their own: flat shading by a shader that lights
 * vertices. 0: it has too many triangles. */
static int make_corners(struct sim_effect_part *part, const struct zs_mesh *of)
{
    const uint32_t n = 3u * of->n_tris;
    if (n > 65535u)
        return 0;
    struct sim_effect_corners *c = part->corner = sim_alloc(1, sizeof *c);
    c->pos = sim_alloc((size_t)n + 1, sizeof *c->pos);
    c->lo = of->pos_lo != NULL ? sim_alloc((size_t)n + 1, sizeof *c->lo) : NULL;
    c->normal = sim_alloc((size_t)n + 1, sizeof *c->normal);
    c->tri = sim_alloc((size_t)of->n_tris + 1, sizeof *c->tri);
    for (uint32_t v = 0; v < n; v++) {
        const uint16_t from = of->tri[v / 3][v % 3];
        memcpy(c->pos[v], of->pos[from], sizeof c->pos[v]);
        if (c->lo != NULL)
            memcpy(c->lo[v], of->pos_lo[from], sizeof c->lo[v]);
        zs_light_face_normal(c->normal[v], of, v / 3);
        c->tri[v / 3][v % 3] = (uint16_t)v;
    }
    part->mesh = *of;
    part->mesh.n_verts = n;
    part->mesh.pos = (const int16_t(*)[3])c->pos;
    part->mesh.pos_lo = (const uint8_t(*)[3])c->lo;
    part->mesh.normal = (const zs_q1_15(*)[3])c->normal;
    part->mesh.tri = (const uint16_t(*)[3])c->tri;
    part->mesh.cluster = NULL;
    part->mesh.n_clusters = 0;
    return 1;
}

static void free_corners(struct sim_effect_corners *c)
{
    if (c != NULL)
        SIM_FREE(c->pos, c->lo, c->normal, c->tri);
    free(c);
}

/* One lamp, without highlights, at the vertices; several, or with highlights, at each pixel. */
static void shadow_part(struct sim_effect_scene *out, struct sim_effect_part *part, const struct zs_material *plain,
                        const struct sim_effect_options *e)
{
    struct sim_effect_surface *s = out->surface;
    struct sim_effect_ground *g = out->ground;
    const struct zs_lit_material lit = { .material = *plain, .lighting = &s->lighting };
    const int textured = plain->texture != NULL;
    if (s->lighting.n_lamps == 0) {
        part->of.shadowed = (struct zs_shadowed_material){ .material = *plain, .map = &g->map[0].map };
        part->of.plain.shader = &zs_shade_shadowed_smooth;
    } else if (s->lighting.n_lamps == 1 && e->specular_text == NULL && !e->per_pixel) {
        part->of.shadowed_lit = (struct zs_shadowed_lit){ .lit = lit, .map = &g->map[0].map };
        part->of.plain.shader = textured ? &zs_shade_shadowed_texture : &zs_shade_shadowed_lit;
    } else {
        part->of.shadowed_phong = (struct zs_shadowed_phong){ .lit = lit };
        part->of.plain.shader = textured ? &zs_shade_shadowed_texture_phong : &zs_shade_shadowed_phong;
        for (uint32_t k = 0; k < s->lighting.n_lamps; k++)
            part->of.shadowed_phong.map[k] = &g->map[k].map;
    }
}

int sim_effect_shadowed(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    struct sim_effect_surface *s = out->surface;
    struct zs_instance *const floor[] = { &out->ground->floor.instance, &out->ground->matt.instance };
    shadow_part(out, &s->part[0], floor[0]->material, e);
    for (int k = 0; k < 2; k++)
        floor[k]->material = &s->part[0].of.plain;
    for (uint32_t i = 0; i < n && e->environment == NULL; i++) {
        struct sim_effect_part *part = part_of(out, i);
        shadow_part(out, part, out->model[i].material, e);
        if (s->lighting.n_lamps > 0)
            shine_of(&part->of.lit, s, e);
        out->model[i].material = &part->of.plain;
        if (out->model[i].mesh->normal != NULL)
            continue;
        if (!make_corners(part, out->model[i].mesh))
            return sim_refuse(o->model, 0, "--shadow map: a part of flat faces has %u triangles, and may have %u; "
                                           "take --shade smooth, or textured where it has a texture",
                              out->model[i].mesh->n_tris, 65535u / 3u);
        out->model[i].mesh = &part->mesh;
    }
    return SIM_OK;
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
        const int status = sim_image_load(&image, o->effects.environment, 0);
        if (status != SIM_OK)
            return status;
    }
    sim_texture_make(&texture, &image, o->effects.environment, NULL);
    s->environment = (struct zs_texture){
        .format = &zs_texel_565, .texel = sim_texture_565(&texture), .log2_w = sim_texture_log2(texture.image.width),
        .log2_h = sim_texture_log2(texture.image.height), .clamp = ZS_CLAMP_U | ZS_CLAMP_V
    };
    sim_texture_free(&texture);
    own_materials(out, n);
    for (uint32_t i = 0; i < n; i++) {
        struct sim_effect_part *part = part_of(out, i);
        part->mesh = *out->model[i].mesh;
        part->mesh.uv_bits = 15;
        out->model[i].mesh = &part->mesh;
        part->of.plain.shader = &zs_shade_matcap;
        part->of.plain.texture = &s->environment;
    }
    return SIM_OK;
}

int sim_effect_surfaces(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                        const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const int lit = e->n_lights > 0 || e->specular_text != NULL || e->per_pixel, mapped = e->shadow == SIM_SHADOW_MAP;
    int status = SIM_OK;
    out->surface = sim_alloc(1, sizeof *out->surface);
    out->surface->n_parts = n + 1u;
    out->surface->part = sim_alloc((size_t)n + 1, sizeof *out->surface->part);
    if (lit || (mapped && sim_options_textured(o)))
        status = make_lighting(out->surface, from, view, o);
    if (status == SIM_OK && e->environment != NULL)
        return make_environment(out, n, o);
    if (lit && !mapped)
        make_lit(out, n, o);
    else
        own_materials(out, n);
    return status;
}

/* ---- On top ---------------------------------------------------------------------------------------------------- */

/* Colours of RGB565 are dithered as they are made, where there are more bits. Return 0 where there are none. */
static int dither_part(struct sim_effect_part *part, int dither)
{
    static const struct zs_shader *const of[] = {
        [SIM_DITHER_ORDERED] = &zs_shade_smooth_ordered, [SIM_DITHER_BLUE] = &zs_shade_smooth_blue
    };
    const struct zs_shader *plain = part->of.plain.shader;
    if (plain != &zs_shade_smooth && plain != &zs_shade_lit)
        return 0;
    part->dithered = *of[dither];
    part->dithered.vertex = plain->vertex; /* both have colours as varyings */
    part->dithered.check = plain->check;
    part->of.plain.shader = plain == &zs_shade_smooth ? of[dither] : &part->dithered;
    return 1;
}

static int layer_part(struct sim_effect_scene *out, struct sim_effect_part *part, const struct sim_effect_options *e)
{
    static const struct shaders families[] = { SHADERS(blend), SHADERS(add), SHADERS(stipple) };
    static const struct zs_layer_kind *const kinds[] = { &zs_layer_mix, &zs_layer_add, &zs_layer_door };
    const uint8_t alpha = (uint8_t)lround(e->alpha * 255.0);
    const int fogged = e->fog != SIM_FOG_NONE && sim_effect_layered(e);
    const struct zs_shader *with = fogged ? NULL : in_place_of(&families[e->blend], part->of.plain.shader);
    if (with != NULL) { /* its material is plain, too */
        part->of.blend.alpha = alpha;
        part->of.blend.phase = 0;
        part->of.plain.shader = with;
        return ZS_OK;
    }
    const int err = zs_layered_set(&part->layered, part->of.plain.shader, kinds[e->blend], alpha);
    if (fogged)
        zs_layered_fog(&part->layered, &out->hooks->fog);
    part->of.plain.shader = &part->layered.shader;
    return err;
}

int sim_effect_layered(const struct sim_effect_options *e)
{
    return e->has_alpha && e->blend != SIM_BLEND_SCREEN_DOOR;
}

int sim_effect_coat(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    int err = ZS_OK;
    for (uint32_t i = 0; err == ZS_OK && i < n; i++) {
        struct sim_effect_part *part = part_of(out, i);
        if (e->filter != SIM_FILTER_NEAREST)
            err = filter_part(part, e->filter);
        if (e->dither != SIM_DITHER_NONE && e->levels == SIM_LEVELS_565 && !dither_part(part, e->dither))
            return sim_refuse(o->model, 0,
                              "--dither: RGB565 colours are dithered with --shade smooth alone; for fewer colours "
                              "name a grey or one-bit --panel");
        if (err == ZS_OK && e->has_alpha)
            err = layer_part(out, part, e);
    }
    if (sim_effect_layered(e))
        out->method = &zs_method_transparent;
    return err == ZS_OK ? SIM_OK
                        : sim_refuse(o->model, 0, "these effects cannot be combined: %s", zs_error_string(err));
}

void sim_effect_surfaces_free(struct sim_effect_surface *s)
{
    if (s == NULL)
        return;
    free((void *)(uintptr_t)s->environment.texel);
    for (uint32_t i = 0; i < s->n_parts; i++) {
        free((void *)(uintptr_t)s->part[i].leveled.texel);
        free_corners(s->part[i].corner);
    }
    free(s->part);
    free(s);
}
