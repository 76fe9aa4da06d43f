/* One part for each mesh that is written, with the arrays that are written.
 *
 * SPDX-License-Identifier: MIT
 */
#include "scene_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_blend.h"
#include "zs_filter.h"
#include "zs_lights.h"

/* ---- Options --------------------------------------------------------------------------------- */

static const enum sim_look looks[] = {
    [SIM_SHADE_ID] = SIM_LOOK_RAW,
    [SIM_SHADE_FLAT] = SIM_LOOK_FLAT,
    [SIM_SHADE_SMOOTH] = SIM_LOOK_SMOOTH,
    [SIM_SHADE_TEXTURED] = SIM_LOOK_TEXTURED,
    [SIM_SHADE_TEXTURED_FLAT] = SIM_LOOK_TEXTURED_FLAT,
    [SIM_SHADE_UNLIT] = SIM_LOOK_UNLIT,
    [SIM_SHADE_DEFAULT] = SIM_LOOK_DEFAULT,
};

/* Options that draw all of a model their own way, or need to know what hides what. */
int sim_scene_is_plain(const struct sim_options *o)
{
    struct sim_effect_options e = o->effects;
    e.samples = 1; /* these go with everything */
    return o->opaque || o->mesh == SIM_MESH_FILE || o->shade == SIM_SHADE_ID || o->method != 0 ||
           o->style != 0 || o->show != SIM_SHOW_FRAME ||
           o->threads > 0 || sim_effects_any(&e);
}

void sim_scene_wish(struct sim_convert_options *c, const struct sim_options *o)
{
    static const enum sim_texels texels[] = { [SIM_TEXEL_565] = SIM_TEXELS_565,
                                              [SIM_TEXEL_PAL8] = SIM_TEXELS_PAL8,
                                              [SIM_TEXEL_PAL4] = SIM_TEXELS_PAL4 };
    sim_convert_defaults(c);
    c->input = o->model;
    c->limits = o->limits;
    c->simplify = o->simplify;
    c->texture = o->texture;
    c->look = looks[o->shade];
    c->wrap = !o->has_wrap ? SIM_WRAP_FILE : o->clamp ? SIM_WRAP_CLAMP : SIM_WRAP_REPEAT;
    c->cull = (int)o->cull;
    c->precise = o->precise;
    c->color = o->color;
    c->has_color = o->has_color;
    c->opaque = sim_scene_is_plain(o);
    c->no_alpha = c->opaque || o->compare || o->reference; /* of which the reference knows nothing */
    c->chosen = o->shade_chosen;
    c->by_material = c->chosen && !c->opaque;
    c->lit = o->effects.n_lights > 0 || o->effects.specular_text != NULL || o->effects.shadow == SIM_SHADOW_MAP;
    if (o->has_texel)
        c->texels = texels[o->texel];
    if (o->effects.filter == SIM_FILTER_MIPMAP)
        c->texels = SIM_TEXELS_565;
}

int sim_scene_load(struct sim_model *model, struct sim_options *o)
{
    struct sim_convert_options wish;
    sim_scene_wish(&wish, o);
    const int status = sim_convert_load(model, &wish);
    if (status != SIM_OK)
        return status;
    o->shade_chosen = wish.by_material;
    for (int shade = 0; o->shade == SIM_SHADE_DEFAULT && shade < SIM_SHADE_DEFAULT; shade++)
        if (looks[shade] == (enum sim_look)wish.look)
            o->shade = (enum sim_shade)shade;
    for (uint32_t i = 0; o->mesh == SIM_MESH_CONVERT && i < model->n_textures; i++)
        sim_texture_halve(&model->texture[i], wish.texture_size);
    return SIM_OK;
}

/* ---- Textures and materials ------------------------------------------------------------------ */

static void take_texture(struct sim_scene *s, uint32_t i, struct sim_packed_texels *packed)
{
    static const struct zs_texel *const formats[] = {
        [SIM_TEXELS_565] = &zs_texel_565,     [SIM_TEXELS_PAL8] = &zs_texel_pal8,
        [SIM_TEXELS_PAL4] = &zs_texel_pal4,   [SIM_TEXELS_4444] = &zs_texel_4444,
        [SIM_TEXELS_PAL8A] = &zs_texel_pal8a, [SIM_TEXELS_PAL4A] = &zs_texel_pal4a
    };
    memcpy(s->palette[i], packed->palette, sizeof s->palette[i]);
    s->texture[i] = (struct zs_texture){ .format = formats[packed->format],
                                         .texel = packed->texel != NULL ? (const void *)packed->texel
                                                                      : packed->index,
                                         .palette = packed->n_colors > 0 ? s->palette[i] : NULL,
                                         .n_colors = (uint16_t)packed->n_colors,
                                         .log2_w = sim_texture_log2(packed->w),
                                         .log2_h = sim_texture_log2(packed->h),
                                         .clamp = packed->clamp,
                                         .alpha_least = packed->alpha_least };
    s->psnr_db = fmin(s->psnr_db, packed->loss.psnr_db);
    packed->texel = NULL; /* the scene's now */
    packed->index = NULL;
}

/* The same as shader_name of convert_write.c writes. */
static const struct zs_shader *shader_of(const struct sim_paint *p)
{
    static const struct zs_shader *const of[3][SIM_SHADER_TEXTURE_SMOOTH + 1] = {
        [SIM_ALPHA_OPAQUE] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_texture,
                               &zs_shade_texture_flat, &zs_shade_texture_smooth },
        [SIM_ALPHA_MASK] = { NULL, NULL, NULL, &zs_shade_cutout, &zs_shade_cutout_flat,
                             &zs_shade_cutout_smooth },
        [SIM_ALPHA_BLEND] = { &zs_blend_raw, &zs_blend_flat, &zs_blend_smooth, &zs_blend_texture,
                              &zs_blend_texture_flat, &zs_blend_texture_smooth },
    };
    if (p->lit)
        return p->shader == SIM_SHADER_TEXTURE_SMOOTH ? &zs_shade_texture_gloss
               : p->shader == SIM_SHADER_SMOOTH       ? &zs_shade_lit
                                                      : &zs_shade_lit_face;
    return of[p->alpha_mode][p->shader];
}

static void take_materials(struct sim_scene *s, struct sim_converted *made)
{
    const struct sim_pieces *p = &made->pieces;
    s->n_textures = made->n_packed;
    s->texture = sim_alloc(s->n_textures, sizeof *s->texture);
    s->palette = sim_alloc(s->n_textures, sizeof *s->palette);
    s->psnr_db = INFINITY;
    for (uint32_t i = 0; i < s->n_textures; i++)
        take_texture(s, i, &made->packed[i]);
    s->material = sim_alloc(p->n_paints, sizeof *s->material);
    s->blend = sim_alloc(p->n_paints, sizeof *s->blend);
    s->lit = sim_alloc(p->n_paints, sizeof *s->lit);
    s->shine = sim_alloc(p->n_paints, sizeof *s->shine);
    for (uint32_t i = 0; i < p->n_paints; i++) {
        const struct sim_paint *paint = &p->paint[i];
        s->material[i] = (struct zs_material){ .shader = shader_of(paint),
                                               .rgb = paint->rgb,
                                               .cull = paint->cull,
                                               .texture = paint->texture != SIM_NO_TEXTURE
                                                              ? &s->texture[paint->texture]
                                                              : NULL };
        s->lit[i] = (struct zs_lit_material){
            .material = s->material[i], .lighting = &s->lighting, .shine = paint->power > 0 ? &s->shine[i] : NULL,
            .specular = paint->specular, .emission = paint->emission, .flags = paint->two_sided ? ZS_LIT_TWO_SIDED : 0
        };
        if (paint->power > 0)
            (void)zs_shine_set(&s->shine[i], paint->power);
        s->blend[i] = (struct zs_blend){ .material = s->material[i], .alpha = paint->alpha };
    }
}

/* ---- Parts ----------------------------------------------------------------------------------- */

static void take_positions(struct sim_part *part, const struct sim_piece *p, int fine)
{
    part->pos = sim_alloc(p->n_verts, sizeof *part->pos);
    part->pos_lo = fine ? sim_alloc(p->n_verts, sizeof *part->pos_lo) : NULL;
    for (uint32_t i = 0; i < p->n_verts; i++)
        for (int k = 0; k < 3; k++) {
            part->pos[i][k] = (int16_t)((p->fine[i][k] - (p->fine[i][k] & 255)) / 256);
            if (fine)
                part->pos_lo[i][k] = (uint8_t)(p->fine[i][k] & 255);
        }
}

/* The piece's arrays become the part's. */
static void take_arrays(struct sim_part *part, struct sim_piece *p)
{
    part->uv = p->uv;
    part->tri = p->tri;
    part->normal = p->normal;
    part->face_normal = p->face_normal;
    part->vertex_rgb = p->vertex_rgb;
    part->face_rgb = p->face_rgb;
    part->face_raw = p->face_raw;
    part->cluster = p->cluster;
    p->uv = NULL;
    p->tri = NULL;
    p->normal = p->face_normal = NULL;
    p->vertex_rgb = p->face_rgb = NULL;
    p->face_raw = NULL;
    p->cluster = NULL;
}

/* Triangles' numbers for colours. */
static void number_faces(struct sim_part *part, const struct sim_piece *p)
{
    part->face_raw = sim_grow(part->face_raw, p->n_tris, sizeof *part->face_raw);
    for (uint32_t t = 0; t < p->n_tris; t++)
        part->face_raw[t] = (uint16_t)(p->source[t] + 1u);
}

static void take_part(struct sim_scene *s, struct sim_part *part, struct sim_piece *p,
                      const struct sim_options *o, int fine)
{
    take_positions(part, p, fine);
    take_arrays(part, p);
    if (o->shade == SIM_SHADE_ID)
        number_faces(part, p);
    part->material = &s->material[p->paint];
    part->mesh = sim_part_mesh(part, p->n_verts, p->n_tris);
    memcpy(part->mesh.center, p->center, sizeof part->mesh.center);
    part->mesh.radius = p->radius;
    part->mesh.uv_bits = part->uv != NULL ? p->uv_bits : 0;
    part->mesh.n_clusters = part->cluster != NULL ? p->n_clusters : 0;
    if (part->uv != NULL && (s->uv_bits_least == 0 || s->uv_bits_least > p->uv_bits))
        s->uv_bits_least = p->uv_bits;
}

void sim_scene_parts(struct sim_scene *out, struct sim_converted *made, const struct sim_options *o)
{
    const struct sim_pieces *p = &made->pieces;
    struct sim_converted_bytes bytes;
    sim_converted_bytes(&bytes, made);
    out->data_bytes = bytes.total;
    take_materials(out, made);
    memcpy(out->lost, p->lost, sizeof out->lost);
    out->part = sim_alloc(p->n_pieces, sizeof *out->part);
    out->n_parts = p->n_pieces;
    out->source = sim_alloc(p->n_tris, sizeof *out->source);
    out->n_verts = p->n_verts;
    out->error = p->error_max;
    for (uint32_t i = 0; i < made->n_packed; i++)
        out->uv_error = fmax(out->uv_error, p->uv_error[i]);
    uint32_t at = 0;
    for (uint32_t i = 0; i < p->n_pieces; i++) {
        take_part(out, &out->part[i], &p->piece[i], o, made->steps.fine);
        const uint32_t paint = p->piece[i].paint;
        const enum sim_form form = sim_paint_form(&p->paint[paint]);
        out->part[i].material = form == SIM_FORM_LIT     ? &out->lit[paint].material
                                : form == SIM_FORM_BLEND ? &out->blend[paint].material
                                                         : &out->material[paint];
        memcpy(out->source + at, p->piece[i].source, p->piece[i].n_tris * sizeof *out->source);
        at += p->piece[i].n_tris;
    }
}
