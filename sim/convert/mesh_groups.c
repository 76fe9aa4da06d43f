/* Groups of triangles that share a material: how each triangle is drawn, and what of its material is not.
 *
 * SPDX-License-Identifier: MIT
 */
#include "mesh_work.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"

#define COLORS_MAX 64u /* meshes by colour: not more */

static enum sim_shader shader_of(enum sim_look look, int textured)
{
    switch (look) {
    case SIM_LOOK_FLAT:
        return SIM_SHADER_FLAT;
    case SIM_LOOK_TEXTURED:
        return textured ? SIM_SHADER_TEXTURE_SMOOTH : SIM_SHADER_SMOOTH;
    case SIM_LOOK_TEXTURED_FLAT:
        return textured ? SIM_SHADER_TEXTURE_FLAT : SIM_SHADER_FLAT;
    case SIM_LOOK_UNLIT:
        return textured ? SIM_SHADER_TEXTURE : SIM_SHADER_RAW;
    case SIM_LOOK_RAW:
        return SIM_SHADER_RAW;
    case SIM_LOOK_SMOOTH:
    case SIM_LOOK_DEFAULT:
        break;
    }
    return SIM_SHADER_SMOOTH;
}

/* The texture that a triangle will have, or SIM_NO_TEXTURE. */
static uint32_t texture_of(const struct work *w, uint32_t t)
{
    const enum sim_look look = (enum sim_look)w->options->look;
    if (look != SIM_LOOK_TEXTURED && look != SIM_LOOK_TEXTURED_FLAT && look != SIM_LOOK_UNLIT)
        return SIM_NO_TEXTURE;
    return sim_model_texture(w->model, t) != NULL ? w->model->material[w->model->tri_material[t]].texture
                                                  : SIM_NO_TEXTURE;
}

/* The colour of a triangle where its shader knows one; *whole is cleared where its corners differ.
 * */
static struct zs_rgb color_of(const struct work *w, uint32_t t, enum sim_shader shader, int *whole)
{
    const struct zs_rgb *c = w->model->rgb[t];
    if (shader == SIM_SHADER_SMOOTH && !(same_rgb(c[0], c[1]) && same_rgb(c[0], c[2])))
        *whole = 0;
    return shader == SIM_SHADER_SMOOTH ? c[0] : sim_model_face_rgb(w->model, t);
}

static int same_light(const struct sim_paint *a, const struct sim_paint *b)
{
    return a->lit == b->lit && a->power == b->power && a->two_sided == b->two_sided &&
           same_rgb(a->specular, b->specular) && same_rgb(a->emission, b->emission);
}

static uint32_t find_group(struct groups *g, const struct sim_paint *paint, int by_color)
{
    for (uint32_t i = 0; i < g->n; i++)
        if (g->at[i].paint.texture == paint->texture && g->at[i].paint.shader == paint->shader &&
            g->at[i].paint.cull == paint->cull && g->at[i].paint.alpha_mode == paint->alpha_mode &&
            g->at[i].paint.alpha == paint->alpha && same_light(&g->at[i].paint, paint) &&
            (!by_color || is_textured(paint->shader) || same_rgb(g->at[i].paint.rgb, paint->rgb)))
            return i;
    g->at = sim_grow(g->at, (size_t)g->n + 1, sizeof *g->at);
    g->at[g->n] = (struct group){ .paint = *paint, .material = UINT32_MAX, .same_material = 1, .same_rgb = 1 };
    return g->n++;
}

/* No area on the grid: exact. */
static int is_flat(const struct work *w, const uint32_t tri[3])
{
    int64_t a[3], b[3]; /* < 2^24 */
    for (int k = 0; k < 3; k++) {
        a[k] = w->place[tri[1]][k] - w->place[tri[0]][k];
        b[k] = w->place[tri[2]][k] - w->place[tri[0]][k];
    }
    return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

/* Blending costs more than a test, and that more than neither: where a material does not need it, it has none. */
static void set_alpha(const struct work *w, struct sim_paint *paint, const struct sim_material *material)
{
    const int has = !w->options->opaque && !w->options->no_alpha;
    const int textured = paint->texture != SIM_NO_TEXTURE && has;
    const uint8_t texels = textured ? w->model->texture[paint->texture].alpha_mode : SIM_ALPHA_OPAQUE;
    paint->alpha = material->alpha_mode == SIM_ALPHA_BLEND && has ? material->alpha : 255;
    paint->alpha_mode = paint->alpha < 255 ? SIM_ALPHA_BLEND : texels;
}

static int most_of(struct zs_rgb c)
{
    return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b);
}

/* Does light on top of a texture show enough for what it costs? */
static int shows_on_texture(const struct sim_material *m)
{
    return (m->power > 0 && most_of(m->specular) >= SIM_TEXTURE_SPECULAR_LEAST) ||
           most_of(m->emission) >= SIM_TEXTURE_EMISSION_LEAST;
}

int sim_material_lights(const struct sim_material *m, int textured)
{
    const struct zs_rgb none = { 0, 0, 0 };
    return textured ? shows_on_texture(m) : m->power > 0 || !same_rgb(m->emission, none);
}

/* Highlights and emission, where there is a shader for them. */
static void set_light(const struct work *w, struct sim_paint *paint, const struct sim_material *material)
{
    const int smooth = paint->shader == SIM_SHADER_SMOOTH;
    const int flat = paint->shader == SIM_SHADER_FLAT && !w->options->no_face_normals;
    const int textured = paint->shader == SIM_SHADER_TEXTURE_SMOOTH;
    if (w->options->opaque || paint->alpha_mode != SIM_ALPHA_OPAQUE || !(smooth || flat || textured) ||
        !sim_material_lights(material, textured))
        return;
    paint->lit = 1;
    paint->two_sided = material->two_sided;
    paint->power = material->power;
    paint->specular = material->specular;
    paint->emission = material->emission;
}

/* How a triangle is drawn, but for its colour. */
static struct sim_paint paint_of(const struct work *w, uint32_t t)
{
    const uint32_t texture = texture_of(w, t);
    const struct sim_material *material = &w->model->material[w->model->tri_material[t]];
    const enum sim_look look = w->options->by_material && material->unlit ? SIM_LOOK_UNLIT
                                                                          : (enum sim_look)w->options->look;
    struct sim_paint paint = { .shader = shader_of(look, texture != SIM_NO_TEXTURE),
                               .texture = texture,
                               .rgb = { 255, 255, 255 } };
    paint.cull = (uint8_t)(material->two_sided && w->options->cull == ZS_CULL_BACK ? ZS_CULL_NONE : w->options->cull);
    set_alpha(w, &paint, material);
    set_light(w, &paint, material);
    return paint;
}

static void add_to_group(struct work *w, uint32_t t, int by_color, int *whole)
{
    struct sim_paint paint = paint_of(w, t);
    int triangle_whole = 1;
    if (!is_textured(paint.shader))
        paint.rgb = color_of(w, t, paint.shader, &triangle_whole);
    const uint32_t n = find_group(&w->groups, &paint, by_color);
    struct group *g = &w->groups.at[n];
    g->same_rgb = g->same_rgb && triangle_whole && same_rgb(g->paint.rgb, paint.rgb);
    g->same_material = g->same_material && (g->material == UINT32_MAX || g->material == w->model->tri_material[t]);
    g->material = w->model->tri_material[t];
    g->n_tris++;
    w->groups.of[t] = n;
    *whole = *whole && triangle_whole;
}

int sim_groups_make(struct work *w, int by_color)
{
    const struct sim_model *model = w->model;
    int whole = 1;
    w->groups = (struct groups){ .of = sim_alloc(model->n_tris, sizeof *w->groups.of) };
    w->out->n_flat = w->out->n_flat_before = 0;
    for (uint32_t t = 0; t < model->n_tris; t++) {
        w->groups.of[t] = UINT32_MAX;
        if (is_flat(w, model->tri[t])) {
            double n[3];
            sim_model_face_normal(model, t, n);
            w->out->n_flat++;
            w->out->n_flat_before += sim_dot(n, n) < 0.5;
            continue;
        }
        add_to_group(w, t, by_color, &whole);
        if (by_color && (!whole || w->groups.n > COLORS_MAX + model->n_textures))
            return 0;
    }
    for (uint32_t i = 0; i < w->groups.n; i++) {
        struct group *g = &w->groups.at[i];
        g->paint.name = g->same_material ? model->material[g->material].name : "";
    }
    return 1;
}

void sim_groups_free(struct groups *g)
{
    free(g->at);
    free(g->of);
    memset(g, 0, sizeof *g);
}

/* ---- Losses ---------------------------------------------------------------------------------- */

/* What of a triangle's material is not drawn, of that which the loader has read. */
static void lose_of(const struct work *w, const struct sim_material *m, const struct sim_paint *paint,
                    struct sim_lost *lost)
{
    const struct zs_rgb none = { 0, 0, 0 };
    if (m->two_sided && !paint->lit && paint->shader != SIM_SHADER_RAW && paint->shader != SIM_SHADER_TEXTURE)
        sim_lose(lost, SIM_LOST_TWO_SIDED, m->name);
    if (m->alpha_mode != SIM_ALPHA_OPAQUE && (w->options->opaque || w->options->no_alpha))
        sim_lose(lost, SIM_LOST_OPACITY, m->name);
    if (m->power > 0 && !paint->lit)
        sim_lose(lost,
                 (paint->shader == SIM_SHADER_TEXTURE_SMOOTH || paint->shader == SIM_SHADER_TEXTURE_FLAT) &&
                         !sim_material_lights(m, 1) && paint->alpha_mode == SIM_ALPHA_OPAQUE && !w->options->opaque
                     ? SIM_LOST_FAINT_SPECULAR
                     : SIM_LOST_SPECULAR,
                 m->name);
    if (!same_rgb(m->emission, none) && !paint->lit)
        sim_lose(lost, SIM_LOST_EMISSION, m->name);
}

/* By the first triangle of each material; vertex colours by all. Those left out for having no area count. */
void sim_groups_losses(struct work *w)
{
    const struct sim_model *model = w->model;
    struct sim_lost *lost = w->out->lost;
    uint8_t *seen = sim_alloc(model->n_materials, 1);
    memcpy(lost, model->lost, sizeof w->out->lost);
    for (uint32_t t = 0; t < model->n_tris; t++) {
        const uint32_t n = model->tri_material[t];
        const struct sim_material *m = &model->material[n];
        const struct sim_paint paint = paint_of(w, t);
        if (!(seen[n] & 2) && is_textured(paint.shader) &&
            !(same_rgb(model->rgb[t][0], m->rgb) && same_rgb(model->rgb[t][1], m->rgb) &&
              same_rgb(model->rgb[t][2], m->rgb))) {
            sim_lose(lost, SIM_LOST_VERTEX_COLOR, m->name);
            seen[n] |= 2;
        }
        if (!(seen[n] & 4) && w->options->chosen && paint.shader == SIM_SHADER_FLAT &&
            !(same_rgb(model->rgb[t][0], model->rgb[t][1]) && same_rgb(model->rgb[t][0], model->rgb[t][2]))) {
            sim_lose(lost, SIM_LOST_MEAN_COLOR, "");
            seen[n] |= 4;
        }
        if (!(seen[n] & 1))
            lose_of(w, m, &paint, lost);
        seen[n] |= 1;
    }
    free(seen);
}
