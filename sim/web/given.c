/* From what the page gave to a model, as sim/load makes one from a file.
 *
 * SPDX-License-Identifier: MIT
 */
#include "given.h"
#include "mirrored.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model_shape.h"
#include "sim.h"
#include "simplify.h"
#include "vec.h"

#define COORD_MAX 1e30

const struct web_given *web_given_now;

void web_given_free(struct web_given *g)
{
    for (uint32_t i = 0; g->paint_name != NULL && i < g->n_paints; i++)
        free(g->paint_name[i]);
    for (uint32_t i = 0; g->image != NULL && i < g->n_images; i++)
        SIM_FREE(g->image[i].rgba, g->image[i].name);
    SIM_FREE(g->name, g->point, g->uv, g->normal, g->rgb, g->tri, g->tri_material, g->paint,
             g->paint_name, g->image);
    memset(g, 0, sizeof *g);
}

static uint8_t to_byte(double v)
{
    return v >= 1.0 ? 255 : v > 0.0 ? (uint8_t)(v * 255.0 + 0.5) : 0; /* NaN: 0 */
}

static struct zs_rgb to_rgb(const double v[3])
{
    return (struct zs_rgb){ to_byte(v[0]), to_byte(v[1]), to_byte(v[2]) };
}

static int is_black(struct zs_rgb c)
{
    return c.r == 0 && c.g == 0 && c.b == 0;
}

static char *copy(const char *text)
{
    return strcpy(sim_alloc(strlen(text) + 1, 1), text);
}

/* ---- Materials ---------------------------------------------------------------------------------- */

static int has_flag(const struct web_paint *p, enum web_paint_flag flag)
{
    return (int)p->flags / flag % 2;
}

static void set_highlights(struct sim_material *to, const double rgb[3], double power)
{
    to->specular = to_rgb(rgb);
    to->power = is_black(to->specular) || !(power >= 1.0) ? 0 : (uint8_t)fmin(power, 128.0);
    if (to->power == 0)
        to->specular = (struct zs_rgb){ 0, 0, 0 };
}

static void take_paint(struct sim_material *to, const struct web_paint *p, const char *name,
                       const struct sim_want *want)
{
    to->name = copy(name);
    to->rgb = want->color != NULL ? *want->color
              : p->rgb[0] < 0.0   ? (struct zs_rgb){ 204, 204, 204 }
                                  : to_rgb(p->rgb);
    to->emission = to_rgb(p->emission);
    to->alpha = to_byte(p->opacity);
    to->alpha_mode = p->alpha_mode == SIM_ALPHA_MASK    ? SIM_ALPHA_MASK
                     : p->alpha_mode == SIM_ALPHA_BLEND ? SIM_ALPHA_BLEND
                                                        : SIM_ALPHA_OPAQUE;
    to->alpha_least = to_byte(p->alpha_least);
    to->alpha_least = to->alpha_least > 0 ? to->alpha_least : 1;
    to->two_sided = (uint8_t)has_flag(p, WEB_TWO_SIDED);
    to->unlit = (uint8_t)has_flag(p, WEB_UNLIT);
    set_highlights(to, p->specular, p->power);
    to->texture = SIM_NO_TEXTURE;
    if (want->color == NULL && is_black(to->rgb) &&
        !is_black(to->emission)) { /* it shines, and that is all */
        to->rgb = to->emission;
        to->emission = (struct zs_rgb){ 0, 0, 0 };
        to->unlit = 1;
    }
}

/* A picture of its own for a material's texture. */
static int add_texture(struct sim_model *model, const struct web_image *from,
                        const struct web_paint *p, const struct sim_material *material,
                        enum sim_wrap wrap, unsigned mirrored)
{
    const size_t n = (size_t)from->width * from->height;
    struct sim_image image = { from->width, from->height, sim_alloc(n, 3), NULL };
    int clear = 0;
    for (size_t i = 0; i < n; i++) {
        memcpy(image.rgb[i], from->rgba + 4 * i, 3);
        clear |= from->rgba[4 * i + 3] != 255;
    }
    if (clear) {
        image.alpha = sim_alloc(n, 1);
        for (size_t i = 0; i < n; i++)
            image.alpha[i] = from->rgba[4 * i + 3];
    }
    if (sim_mirror_picture(&image, mirrored, from->name) != SIM_OK) {
        sim_image_free(&image);
        return SIM_REFUSED;
    }
    model->texture = sim_grow(model->texture, (size_t)model->n_textures + 1,
                              sizeof *model->texture);
    struct sim_texture *t = &model->texture[model->n_textures++];
    sim_texture_make(t, &image, from->name, p->factor);
    t->clamp = wrap == SIM_WRAP_CLAMP    ? ZS_CLAMP_U | ZS_CLAMP_V
               : wrap == SIM_WRAP_REPEAT ? 0
                                         : (uint8_t)((has_flag(p, WEB_CLAMP_U) ? ZS_CLAMP_U : 0) |
                                                     (has_flag(p, WEB_CLAMP_V) ? ZS_CLAMP_V : 0));
    t->alpha_mode = t->image.alpha != NULL ? material->alpha_mode : SIM_ALPHA_OPAQUE;
    t->alpha_least = material->alpha_least;
    if (t->alpha_mode != SIM_ALPHA_OPAQUE || t->image.alpha == NULL)
        return SIM_OK;
    if (!has_flag(p, WEB_SAYS_ALPHA))
        sim_lose(model->lost, SIM_LOST_TEXEL_ALPHA, t->name);
    free(t->image.alpha);
    t->image.alpha = NULL;
    return SIM_OK;
}

static int same_texture(const struct web_paint *a, const struct web_paint *b)
{
    const int clamps = WEB_CLAMP_U | WEB_CLAMP_V | WEB_MIRROR_U | WEB_MIRROR_V;
    return a->texture == b->texture && memcmp(a->factor, b->factor, sizeof a->factor) == 0 &&
           a->alpha_mode == b->alpha_mode && a->alpha_least == b->alpha_least &&
           ((int)a->flags & clamps) == ((int)b->flags & clamps);
}

/* The axes along which a texture is doubled (mirrored.h), for materials from `first` on that share it; and halve their
 * texture coordinates. */
static unsigned double_texture(struct sim_model *model, const struct web_given *g, const uint8_t *used,
                               uint32_t first)
{
    const struct web_paint *p = &g->paint[first];
    const unsigned mirrored = (has_flag(p, WEB_MIRROR_U) ? SIM_AXIS_U : 0u) |
                              (has_flag(p, WEB_MIRROR_V) ? SIM_AXIS_V : 0u);
    unsigned axes = 0;
    for (int halve = 0; halve < 2; halve++)
        for (uint32_t i = first; i < model->n_materials; i++)
            if (used[i] && same_texture(p, &g->paint[i])) {
                if (halve)
                    sim_mirror_uv(model, i, axes);
                else
                    axes |= sim_mirror_leaves(model, i, mirrored);
            }
    return axes;
}

/* Of materials of faces with uv. */
static int add_textures(struct sim_model *model, const struct web_given *g, enum sim_wrap wrap)
{
    int status = SIM_OK;
    uint8_t *used = sim_alloc(model->n_materials, 1);
    for (uint32_t t = 0; t < model->n_tris; t++)
        used[model->tri_material[t]] |= model->has_uv[t];
    for (uint32_t i = 0; status == SIM_OK && i < model->n_materials; i++) {
        const struct web_paint *p = &g->paint[i];
        uint32_t same = 0;
        if (!used[i] || !(p->texture >= 0.0 && p->texture < g->n_images))
            continue;
        while (same < i && !(used[same] && same_texture(&g->paint[same], p)))
            same++;
        if (same == i)
            status = add_texture(model, &g->image[(uint32_t)p->texture], p, &model->material[i], wrap,
                                 wrap == SIM_WRAP_FILE ? double_texture(model, g, used, i) : 0u);
        model->material[i].texture = same < i ? model->material[same].texture
                                              : model->n_textures - 1;
        if (p->textured[3] >= 0.0)
            set_highlights(&model->material[i], p->textured, p->textured[3]);
    }
    free(used);
    return status;
}

/* ---- Triangles ---------------------------------------------------------------------------------- */

static int check(const struct web_given *g)
{
    for (uint32_t i = 0; i < g->n_verts; i++)
        for (int k = 0; k < 3; k++) {
            const double c = g->point[i][k];
            if (!isfinite(c))
                return sim_refuse(
                    g->name, 0,
                    "vertex %u has a coordinate that is not finite; export the model again",
                    (unsigned)i + 1);
            if (fabs(c) > COORD_MAX)
                return sim_refuse(g->name, 0, "coordinate %g is beyond %g; scale the model down", c,
                                  COORD_MAX);
        }
    for (uint32_t t = 0; t < g->n_tris; t++)
        for (int k = 0; k < 3; k++)
            if (g->tri[t][k] >= g->n_verts)
                return sim_refuse(g->name, 0,
                                  "vertex index %u of face %u is out of range: %u exist",
                                  (unsigned)g->tri[t][k], (unsigned)t + 1, (unsigned)g->n_verts);
    if (g->n_tris == 0)
        return sim_refuse(g->name, 0, "no faces in it; zsim draws polygons");
    return SIM_OK;
}

static void take_normal(float out[3], const float from[3])
{
    double n[3] = { (double)from[0], (double)from[1], (double)from[2] };
    if (!isfinite(n[0]) || !isfinite(n[1]) || !isfinite(n[2]) || !(sim_unit(n) > 0.0))
        return; /* 0 0 0: found from the faces later */
    for (int k = 0; k < 3; k++)
        out[k] = (float)n[k];
}

static int take_uv(struct sim_model *model, uint32_t t, const struct web_given *g)
{
    const uint32_t *v = g->tri[t];
    for (int k = 0; k < 3; k++)
        if (isnan(g->uv[v[k]][0]) || isnan(g->uv[v[k]][1]))
            return SIM_OK;
    for (int k = 0; k < 3; k++) {
        const double *uv = g->uv[v[k]];
        if (!(fabs(uv[0]) <= SIM_UV_MAX && fabs(uv[1]) <= SIM_UV_MAX))
            return sim_refuse(g->name, 0,
                              "vertex %u has the texture coordinates %g, %g; the picture is 0 to "
                              "1, and zsim takes up "
                              "to %g",
                              (unsigned)v[k] + 1, uv[0], uv[1], SIM_UV_MAX);
        memcpy(model->uv[t][k], uv, sizeof model->uv[t][k]);
    }
    model->has_uv[t] = 1;
    return SIM_OK;
}

static int take_triangles(struct sim_model *model, const struct web_given *g,
                          const struct sim_want *want)
{
    struct sim_weld weld;
    int status = SIM_OK;
    sim_weld_begin(&weld, 3 * (size_t)g->n_tris);
    for (uint32_t t = 0; status == SIM_OK && t < g->n_tris; t++) {
        const uint32_t material = g->tri_material != NULL && g->tri_material[t] < g->n_paints
                                      ? g->tri_material[t]
                                      : 0;
        model->tri_material[t] = material;
        for (int k = 0; k < 3; k++) {
            const uint32_t v = g->tri[t][k];
            model->tri[t][k] = sim_weld_point(&weld, model, g->point[v]);
            model->rgb[t][k] = model->material[material].rgb;
            if (g->rgb != NULL && want->color == NULL && !isnan(g->rgb[v][0]))
                model->rgb[t][k] = to_rgb((const double[3]){
                    (double)g->rgb[v][0], (double)g->rgb[v][1], (double)g->rgb[v][2] });
            if (model->normal != NULL && g->normal != NULL)
                take_normal(model->normal[t][k], g->normal[v]);
        }
        if (model->uv != NULL && g->uv != NULL)
            status = take_uv(model, t, g);
    }
    sim_weld_end(&weld);
    return status;
}

static void make_room(struct sim_model *model, const struct web_given *g,
                      const struct sim_want *want)
{
    const size_t n = g->n_tris;
    model->n_tris = g->n_tris;
    model->single = g->single;
    model->file_normals = want->normals && g->normal != NULL;
    model->point = sim_alloc(3 * n, sizeof *model->point);
    model->tri = sim_alloc(n, sizeof *model->tri);
    model->rgb = sim_alloc(n, sizeof *model->rgb);
    model->normal = want->normals ? sim_alloc(n, sizeof *model->normal) : NULL;
    model->uv = want->textures ? sim_alloc(n, sizeof *model->uv) : NULL;
    model->has_uv = want->textures ? sim_alloc(n, 1) : NULL;
    model->tri_material = sim_alloc(n, sizeof *model->tri_material);
    model->n_materials = g->n_paints;
    model->material = sim_alloc(g->n_paints, sizeof *model->material);
    for (uint32_t i = 0; i < g->n_paints; i++)
        take_paint(&model->material[i], &g->paint[i], g->paint_name[i], want);
}

int sim_model_load(struct sim_model *model, const char *file, const struct sim_want *want)
{
    const struct web_given *g = web_given_now;
    memset(model, 0, sizeof *model);
    if (g == NULL)
        return sim_refuse(file, 0, "there is no such model");
    int status = check(g);
    if (status != SIM_OK)
        return status;
    model->file = g->name;
    make_room(model, g, want);
    status = take_triangles(model, g, want);
    if (status == SIM_OK)
        status = sim_model_fill_bounds(model);
    if (status == SIM_OK && want->normals)
        sim_model_fill_normals(model, g->flat);
    if (status == SIM_OK && want->simplify != NULL) {
        sim_simplify(model, want->simplify);
        status = sim_model_fill_bounds(model);
    }
    if (status == SIM_OK && want->textures)
        status = add_textures(model, g, want->wrap);
    if (status != SIM_OK)
        sim_model_free(model);
    return status;
}
