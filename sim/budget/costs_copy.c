/* Copies of what instances name, which look on; and which of shade/'s shaders an effect's is counted as.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "costs_look.h"
#include "sim.h"
#include "zs_filter.h"

static int is_added(const struct zs_shader *of)
{
    return of == &zs_add_smooth || of == &zs_add_texture || of == &zs_add_texture_flat || of == &zs_add_texture_smooth;
}

/* The opaque shader of a blending one with varyings; NULL: it is none. */
static const struct zs_shader *opaque(const struct zs_shader *of)
{
    return of == &zs_blend_smooth || of == &zs_add_smooth                     ? &zs_shade_smooth
           : of == &zs_blend_texture || of == &zs_add_texture                 ? &zs_shade_texture
           : of == &zs_blend_texture_flat || of == &zs_add_texture_flat       ? &zs_shade_texture_flat
           : of == &zs_blend_texture_smooth || of == &zs_add_texture_smooth ? &zs_shade_texture_smooth
                                                                                : NULL;
}

/* The shader that an effect's is made of; NULL: it is none that is known. */
static const struct zs_shader *like(const struct zs_shader *of)
{
    return of == &zs_shade_lit_face                                             ? &zs_shade_flat
           : of == &zs_shade_lit                                                ? &zs_shade_smooth
           : of == &zs_shade_cutout                                             ? &zs_shade_texture
           : of == &zs_shade_cutout_flat                                        ? &zs_shade_texture_flat
           : of == &zs_shade_cutout_smooth || of == &zs_shade_texture_gloss ? &zs_shade_texture_smooth
                                                                                : opaque(of);
}

const struct zs_shader *sim_costs_plain(const struct zs_shader *of)
{
    return like(of);
}

static int is_lit(const struct zs_shader *of)
{
    return of == &zs_shade_lit_face || of == &zs_shade_lit || of == &zs_shade_texture_gloss;
}

static void copy_shader(struct our_shader *s, const struct zs_shader *of, const struct zs_texture *texture)
{
    const struct sim_shader_row *row = sim_shader_row_of(of);
    sim_shader_made(&s->made, of);
    s->blends = opaque(of) != NULL;
    s->adds = is_added(of);
    s->lit = is_lit(of);
    s->like = like(of);
    const struct zs_shader *plain = s->like ? s->like : of;
    const int is_texture = plain == &zs_shade_texture || plain == &zs_shade_texture_flat ||
                           plain == &zs_shade_texture_smooth;
    s->effect = !s->like && (row == NULL || row->effect != NULL);
    s->shader = *of;
    s->of = of;
    s->kind = is_texture ? KIND_TEXTURE : plain == &zs_shade_smooth ? KIND_SMOOTH : KIND_SOLID;
    s->vertex = of == &zs_shade_lit                 ? SIM_COST_lit_vertex
                : of == &zs_shade_texture_gloss     ? SIM_COST_gloss_vertex
                : plain == &zs_shade_smooth         ? SIM_COST_light_smooth
                : plain == &zs_shade_texture_smooth ? SIM_COST_light_texture
                                                    : SIM_COST_attr_texture;
    s->face = of == &zs_shade_lit_face                                         ? SIM_COST_lit_face
              : plain == &zs_shade_flat || plain == &zs_shade_texture_flat ? SIM_COST_face_flat
                                                                               : SIM_COST_N;
    s->shader.vertex = of->vertex ? sim_look_shader.vertex : NULL;
    s->shader.face = sim_look_shader.face;
    s->shader.start = of->start ? sim_look_shader.start : NULL;
    s->shader.run = sim_look_shader.run;
    s->shader.light = of->light ? sim_look_shader.light : NULL;
    s->shader.span = of->span;
    if (s->effect)
        sim_look_copy_effect(s, texture);
}

static void copy_texel(struct our_texel *x, const struct zs_texel *of)
{
    x->texel = *of;
    x->of = of;
    x->fetch = of == &zs_texel_565 ? SIM_COST_fetch_565_px : of == &zs_texel_pal8 ? SIM_COST_fetch_pal8_px :
        SIM_COST_fetch_pal4_px;
    x->won = of == &zs_texel_565 ? SIM_COST_won_565 : of == &zs_texel_pal8 ? SIM_COST_won_pal8 : SIM_COST_won_pal4;
    x->texel.fetch = sim_look_texel.fetch;
}

/* The accelerator of a shader, or of a texel format; NULL: the list has none. */
static const struct zs_fast *listed(const struct zs_fast *const *list, const struct zs_shader *shader,
                                    const struct zs_texel *format)
{
    for (; list && *list; list++)
        if ((shader && (*list)->shader == shader) || (format && (*list)->format == format))
            return *list;
    return NULL;
}

static void copy_fast(struct thing *t, const struct zs_fast *const *list)
{
    const struct zs_fast *of = listed(list, t->shader.of, NULL);
    if (of)
        t->fast.fast = *of;
    t->fast.of = of;
    t->fast.fast.shader = &t->shader.shader;
    t->fast.fast.draw = of && of->draw ? sim_look_fast.draw : NULL;
    t->fast.fast.rows = sim_look_fast.rows;
    t->fast.fast.span = sim_look_fast.span;
}

static void copy_fast_texel(struct thing *t, const struct zs_fast *const *list)
{
    const struct zs_fast *const of = t->texel.of ? listed(list, NULL, t->texel.of) : NULL;
    if (!of)
        return;
    t->texel.fast_of = of->texel;
    t->texel_hooks = *of->texel;
    t->texel_hooks.gather = sim_look_fast_texel.gather;
    t->texel_hooks.small_lit = sim_look_fast_texel.small_lit;
    t->texel_fast.format = &t->texel.texel;
    t->texel_fast.texel = &t->texel_hooks;
}

void sim_look_copy(struct zs_instance *in, struct thing *t, const struct zs_fast *const *list)
{
    const struct zs_texture *texture = in->material->texture;
    struct sim_shader_made made;
    sim_shader_made(&made, in->material->shader);
    memcpy(&t->as, in->material, sim_shader_material_bytes(made.row != NULL ? made.row->material : SIM_MATERIAL_PLAIN));
    copy_shader(&t->shader, in->material->shader, texture);
    if (made.row == NULL) { /* its stages get all of its material */
        t->shader.whole = in->material;
        t->shader.shader.check = NULL; /* the frame was drawn before */
        if (t->shader.of->position != NULL)
            t->shader.shader.position = sim_look_shader.position;
    }
    t->shader.shines = is_lit(in->material->shader) && t->as.lit.shine;
    t->as.material.shader = &t->shader.shader;
    in->material = &t->as.material;
    if (t->shader.effect && !t->shader.work.fetched)
        return;
    if (texture && texture->format) {
        t->texture = *texture;
        copy_texel(&t->texel, texture->format);
        t->texture.format = &t->texel.texel;
        t->as.material.texture = &t->texture;
    }
    if (!t->shader.effect)
        copy_fast(t, list);
    copy_fast_texel(t, list);
}

const struct zs_fast **sim_look_list(const struct zs_fast *const *list, const struct thing *things, size_t n)
{
    size_t room = 2u * n + 3u, k = 0;
    for (const struct zs_fast *const *at = list; at && *at; at++)
        room++;
    const struct zs_fast **out = sim_alloc(room, sizeof *out);
    if (sim_now.batch_of)
        out[k++] = &sim_now.batch_fast; /* in place of the list's: the first is used */
    sim_now.divides.divided = NULL;
    for (; list && *list; list++)
        if (!(*list)->shader && !(*list)->format)
            out[k++] = *list;
        else if (!sim_now.divides.divided)
            sim_now.divides.divided = (*list)->divided;
    out[k++] = &sim_now.divides; /* of all textured shaders */
    for (size_t i = 0; i < n; i++) {
        if (!things[i].shader.effect)
            out[k++] = &things[i].fast.fast;
        if (things[i].texel.fast_of)
            out[k++] = &things[i].texel_fast;
    }
    return out;
}
