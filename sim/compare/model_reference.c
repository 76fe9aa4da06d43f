/* The reference's view of a model.
 *
 * SPDX-License-Identifier: MIT
 */
#include "model_reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene_parts.h"
#include "sim.h"

static void channels(double out[3], struct zs_rgb c)
{
    out[0] = c.r / 255.0;
    out[1] = c.g / 255.0;
    out[2] = c.b / 255.0;
}

static int plain_shade(const struct sim_options *o)
{
    return o->shade == SIM_SHADE_ID || o->shade == SIM_SHADE_UNLIT ? REF_SHADE_RAW
           : sim_options_smooth(o)                                 ? REF_SHADE_SMOOTH
                                                                   : REF_SHADE_FLAT;
}

static int texture_shade(const struct sim_options *o)
{
    return o->shade == SIM_SHADE_UNLIT           ? REF_SHADE_TEXTURE
           : o->shade == SIM_SHADE_TEXTURED_FLAT ? REF_SHADE_TEXTURE_FLAT
                                                 : REF_SHADE_TEXTURE_SMOOTH;
}

/* Highlights and emission: by the options, or the material's own. */
static void set_light(struct ref_triangle *to, const struct sim_material *material, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const double gloss = rint(e->specular_strength * 255.0) / 255.0;
    if (e->specular_text != NULL) {
        to->power = (double)e->specular_power;
        for (int k = 0; k < 3; k++)
            to->specular[k] = gloss;
    }
    if (sim_scene_is_plain(o))
        return;
    if (o->shade_chosen && material->unlit) {
        to->shade = to->texture != NULL ? REF_SHADE_TEXTURE : REF_SHADE_RAW;
        return;
    }
    if (!sim_material_lights(material, to->texture != NULL) || to->shade == REF_SHADE_RAW ||
        to->shade == REF_SHADE_TEXTURE || to->shade == REF_SHADE_TEXTURE_FLAT)
        return;
    to->power = material->power;
    to->two_sided = material->two_sided;
    channels(to->specular, material->specular);
    channels(to->emission, material->emission);
}

static void fill(struct ref_triangle *to, const struct sim_model *model, uint32_t t,
                 const struct sim_options *o, const struct ref_texture *textures)
{
    const struct sim_texture *texture =
        sim_options_textured(o) ? sim_model_texture(model, t) : NULL;
    const struct zs_rgb rgb = sim_model_face_rgb(model, t);
    to->id = t + 1u;
    to->raw = o->shade == SIM_SHADE_ID ? (uint16_t)(t + 1u) : zs_rgb565(rgb.r, rgb.g, rgb.b);
    to->shade = texture != NULL ? texture_shade(o) : plain_shade(o);
    to->texture = texture != NULL ? &textures[texture - model->texture] : NULL;
    set_light(to, &model->material[model->tri_material[t]], o);
    const int two_sided = o->mesh == SIM_MESH_CONVERT && model->material[model->tri_material[t]].two_sided;
    to->cull = o->cull == ZS_CULL_BACK    ? two_sided ? REF_CULL_NONE : REF_CULL_BACK
               : o->cull == ZS_CULL_FRONT ? REF_CULL_FRONT
                                          : REF_CULL_NONE;
    for (int k = 0; k < 3; k++) {
        memcpy(to->p[k], model->point[model->tri[t][k]], sizeof to->p[k]);
        channels(to->rgb[k], model->rgb[t][k]);
        for (int i = 0; i < 3 && sim_options_smooth(o); i++)
            to->n[k][i] = (double)model->normal[t][k][i];
        if (texture != NULL)
            memcpy(to->uv[k], model->uv[t][k], sizeof to->uv[k]);
    }
    if (to->shade == REF_SHADE_FLAT)
        channels(to->rgb[0], rgb);
}

#define LEVELS_MAX 16 /* of a texture, beside itself */

/* The picture at half its size: each texel the mean of four. */
static uint8_t *half_of(const struct ref_texture *t)
{
    const size_t w = (size_t)t->width / 2, h = (size_t)t->height / 2, row = 3 * (size_t)t->width;
    uint8_t *rgb = sim_alloc(w * h, 3);
    for (size_t i = 0; i < 3 * w * h; i++) {
        const uint8_t *at = t->rgb + i / (3 * w) * 2 * row + i % (3 * w) / 3 * 6 + i % 3;
        rgb[i] = (uint8_t)((at[0] + at[3] + at[row] + at[row + 3] + 2) / 4);
    }
    return rgb;
}

static void add_levels(struct sim_model_reference *out, struct ref_texture *t)
{
    while (t->width > 1 && t->height > 1) {
        struct ref_texture *half = &out->texture[out->n_textures + out->n_levels++];
        *half = *t;
        half->rgb = half_of(t);
        half->width /= 2;
        half->height /= 2;
        t->half = half;
        t = half;
    }
}

static void textures_of(struct sim_model_reference *out, const struct sim_model *model, const struct sim_options *o)
{
    struct ref_texture *all = sim_alloc((size_t)model->n_textures * (1 + LEVELS_MAX), sizeof *all);
    out->texture = all;
    out->n_textures = model->n_textures;
    for (uint32_t i = 0; i < model->n_textures; i++) {
        const struct sim_texture *t = &model->texture[i];
        all[i] = (struct ref_texture){
            .width = (int)t->image.width, .height = (int)t->image.height, .rgb = t->image.rgb[0],
            .clamp_u = (t->clamp & ZS_CLAMP_U) != 0, .clamp_v = (t->clamp & ZS_CLAMP_V) != 0,
            .bilinear = o->effects.filter != SIM_FILTER_NEAREST
        };
        if (o->effects.filter == SIM_FILTER_MIPMAP)
            add_levels(out, &all[i]);
    }
}

static void set_up(struct sim_model_reference *out, struct ref_light *light, const struct sim_view *view,
                   const struct sim_options *o)
{
    struct ref_camera *c = &out->camera;
    memcpy(c->eye, view->eye, sizeof c->eye);
    memcpy(c->right, view->right, sizeof c->right);
    memcpy(c->up, view->up, sizeof c->up);
    memcpy(c->back, view->back, sizeof c->back);
    c->orthographic = view->orthographic;
    c->focal = view->focal;
    c->height = view->span;
    c->near_z = view->near_z;
    c->far_z = view->far_z;
    memcpy(light->dir, view->light, sizeof light->dir);
    light->ambient = o->ambient;
    light->diffuse = o->diffuse;
    static const int mapping[] = {
        [SIM_DEPTH_recip] = REF_DEPTH_RECIP, [SIM_DEPTH_linear] = REF_DEPTH_LINEAR,
        [SIM_DEPTH_e3m13] = REF_DEPTH_E3M13, [SIM_DEPTH_e4m12] = REF_DEPTH_E4M12,
        [SIM_DEPTH_e5m11] = REF_DEPTH_E5M11,
    };
    out->depth.mapping = mapping[sim_depth_of(o, view)];
    out->depth.bits = (int)o->depth_bits;
}

static double cosine(double degrees)
{
    return cos(degrees * acos(-1.0) / 180.0);
}

static void set_lamp(struct ref_lamp *to, const struct sim_light *from, const struct sim_view *view,
                     const struct sim_options *o)
{
    static const int kinds[] = {
        [SIM_LIGHT_DIR] = REF_LAMP_DIR, [SIM_LIGHT_POINT] = REF_LAMP_POINT, [SIM_LIGHT_SPOT] = REF_LAMP_SPOT
    };
    *to = (struct ref_lamp){ .kind = kinds[from->kind], .range = from->range, .inner = cosine(SIM_SPOT_FULL),
                             .outer = cosine(SIM_SPOT_DARK) };
    channels(to->rgb, from->rgb);
    for (int k = 0; k < 3; k++) {
        to->at[k] = from->at[k];
        to->aim[k] = view->at[k] - from->at[k];
        to->rgb[k] *= o->diffuse;
    }
}

/* Lamps in place of the light, where an option or a material asks for what only those have. */
static void set_lamps(struct sim_model_reference *out, struct ref_light *light, const struct sim_model *model,
                      const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const struct sim_light plain = { .kind = SIM_LIGHT_DIR, .rgb = ZS_RGB(0xffffff),
                                     .at = { view->light[0], view->light[1], view->light[2] } };
    int wanted = e->n_lights > 0 || e->specular_text != NULL || e->per_pixel;
    for (uint32_t i = 0; !sim_scene_is_plain(o) && i < model->n_materials; i++)
        wanted |= sim_material_lights(&model->material[i], 0);
    if (!wanted)
        return;
    for (int k = 0; k < e->n_lights; k++)
        set_lamp(&out->lamp[k], &e->light[k], view, o);
    if (e->n_lights == 0)
        set_lamp(&out->lamp[0], &plain, view, o);
    light->lamp = out->lamp;
    light->n_lamps = e->n_lights > 0 ? e->n_lights : 1;
    light->per_pixel = e->per_pixel;
}

static void set_fog(struct sim_model_reference *out, struct ref_light *light, const struct sim_effect_options *e)
{
    if (e->fog == SIM_FOG_NONE)
        return;
    out->fog = (struct ref_fog){ .start = e->fog_start, .end = e->fog_end,
                                 .density = e->fog == SIM_FOG_EXP ? e->fog_density : 0.0 };
    channels(out->fog.rgb, e->fog_rgb);
    light->fog = &out->fog;
}

static void report(void *user, size_t done, size_t total)
{
    (void)user;
    sim_progress("reference", done, total);
}

int sim_model_reference_render(struct sim_model_reference *out, const struct sim_model *model,
                               const struct sim_view *view, const struct sim_options *o)
{
    struct ref_light light;
    memset(out, 0, sizeof *out);
    memset(&light, 0, sizeof light);
    set_up(out, &light, view, o);
    set_lamps(out, &light, model, view, o);
    set_fog(out, &light, &o->effects);
    if (o->effects.has_alpha) {
        light.layers = o->effects.blend == SIM_BLEND_ADD ? REF_ADD : REF_MIX;
        light.alpha = rint(o->effects.alpha * 255.0) / 255.0;
    }
    const size_t n = (size_t)view->width * (size_t)view->height;
    out->image.rgb565 = sim_alloc(n, sizeof *out->image.rgb565);
    out->image.key = sim_alloc(n, sizeof *out->image.key);
    out->image.id = sim_alloc(n, sizeof *out->image.id);
    out->image.z = sim_alloc(n, sizeof *out->image.z);
    out->image.exact_key = sim_alloc(n, sizeof *out->image.exact_key);
    if (sim_options_textured(o)) {
        out->image.u = sim_alloc(n, sizeof *out->image.u);
        out->image.v = sim_alloc(n, sizeof *out->image.v);
        out->image.texel = sim_alloc(n, sizeof *out->image.texel);
        out->image.texture = sim_alloc(n, sizeof(void *));
        textures_of(out, model, o);
    }
    struct ref_triangle *tris = sim_alloc(model->n_tris, sizeof *tris);
    for (uint32_t t = 0; t < model->n_tris; t++)
        fill(&tris[t], model, t, o, out->texture);
    const uint16_t background = zs_rgb565(o->background.r, o->background.g, o->background.b);
    const int err = ref_render(tris, model->n_tris, &out->camera, &light, &out->depth, background,
                               view->width, view->height, &out->image, report, NULL);
    free(tris);
    sim_progress_end();
    if (err == REF_OK)
        return SIM_OK;
    sim_model_reference_free(out);
    return sim_refuse(model->file, 0, "the reference cannot draw it: %s",
                      err == REF_NO_MEMORY ? "out of memory" : "a value is outside its range");
}

void sim_model_reference_free(struct sim_model_reference *original)
{
    const struct ref_image *i = &original->image;
    for (uint32_t k = 0; k < original->n_levels; k++)
        free((void *)(uintptr_t)original->texture[original->n_textures + k].rgb);
    SIM_FREE(i->rgb565, i->key, i->id, i->z, i->exact_key, i->u, i->v, i->texel, i->texture, original->texture);
    memset(original, 0, sizeof *original);
}
