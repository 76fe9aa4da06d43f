/* The table.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shader_table.h"

#include "effect/filter.h"
#include "effect/layered.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_lights.h"
#include "zs_shadow.h"

#define ROW(name_, effect_, material_, vertex_, ...)                                                              \
    { &name_, #name_, effect_, SIM_MATERIAL_##material_, 0, vertex_, { __VA_ARGS__ } }
#define FLAT(name_, effect_, material_, vertex_, ...)                                                             \
    { &name_, #name_, effect_, SIM_MATERIAL_##material_, 1, vertex_, { __VA_ARGS__ } }
#define PLAIN(name_, vertex_, ...) ROW(name_, NULL, PLAIN, vertex_, __VA_ARGS__)
#define TRANSPARENT(family, one, smooth, texture, more, less)                                                      \
    ROW(zs_##family##_raw, "transparency", BLEND, NULL, one, "", ""),                                             \
        FLAT(zs_##family##_flat, "transparency", BLEND, NULL, one, "", ""),                                       \
        ROW(zs_##family##_smooth, "transparency", BLEND, "a vertex: smooth", smooth, more, less),                 \
        ROW(zs_##family##_texture, "transparency", BLEND, "a vertex: texture", texture, more, less),              \
        FLAT(zs_##family##_texture_flat, "transparency", BLEND, "a vertex: texture", texture, more, less)

static const struct sim_shader_row rows[] = {
    PLAIN(zs_shade_raw, NULL, "raw", "", ""),
    PLAIN(zs_shade_flat, NULL, "raw", "", ""),
    PLAIN(zs_shade_smooth, "a vertex: smooth", "smooth", "", ""),
    PLAIN(zs_shade_texture, "a vertex: texture", "texture", "", ""),
    PLAIN(zs_shade_texture_flat, "a vertex: texture", "texture_lit", "", ""),
    PLAIN(zs_shade_texture_smooth, "a vertex: texture_smooth", "texture_smooth", "", ""),
    TRANSPARENT(blend, "blend", "blend_smooth", "blend_texture", "", ""),
    ROW(zs_blend_texture_smooth, "transparency", BLEND, "a vertex: texture", "blend_texture", "texture_lit",
        "texture"),
    TRANSPARENT(add, "add", "blend_smooth", "blend_texture", "add", "blend"),
    ROW(zs_add_texture_smooth, "transparency", BLEND, "a vertex: texture", "blend_texture", "add", "blend"),
    TRANSPARENT(stipple, "screen-door", "smooth", "texture", "screen-door of lit", "lit"),
    ROW(zs_stipple_texture_smooth, "transparency", BLEND, "a vertex: texture", "texture_smooth", "screen-door of lit",
        "lit"),
    ROW(zs_shade_lit, "lamps or highlights", LIT, "a vertex: lit", "lit", "", ""),
    FLAT(zs_shade_lit_face, "lamps or highlights", LIT, "a vertex: lit", "raw", "", ""),
    ROW(zs_shade_texture_lit, "lamps on a texture", LIT, "a vertex: texture_lit", "texture_lit", "", ""),
    ROW(zs_shade_texture_gloss, "highlights on a texture", LIT, "a vertex: gloss, no highlight", "texture_lit", "", ""),
    ROW(zs_shade_texture_tinted, "coloured lamps on a texture", LIT, "a vertex: texture_gloss_tinted",
        "texture_gloss_tinted", "texture_gloss, no highlight", "texture_gloss"),
    ROW(zs_shade_texture_gloss_tinted, "coloured lamps on a texture", LIT, "a vertex: texture_gloss_tinted",
        "texture_gloss_tinted", "", ""),
    ROW(zs_shade_phong, "light at each pixel", LIT, "a vertex: phong, matt", "phong, matt", "", ""),
    ROW(zs_shade_phong_near, "light at each pixel", LIT, "a vertex: phong, matt", "phong_near, point", "", ""),
    ROW(zs_shade_texture_phong, "light at each pixel of a texture", LIT, "a vertex: texture_phong", "texture_phong", "",
        ""),
    ROW(zs_shade_bilinear, "a texture filter", PLAIN, "a vertex: bilinear", "bilinear, 8 px a texel", "", ""),
    FLAT(zs_shade_bilinear_flat, "a texture filter", PLAIN, "a vertex: bilinear", "bilinear, 8 px a texel", "", ""),
    ROW(zs_shade_bilinear_smooth, "a texture filter", PLAIN, "a vertex: bilinear", "bilinear, 8 px a texel",
        "texture_lit", "texture"),
    ROW(zs_shade_mipmap, "mipmaps", PLAIN, "a vertex: bilinear", "1 px a texel: mipmap", "", ""),
    FLAT(zs_shade_mipmap_flat, "mipmaps", PLAIN, "a vertex: bilinear", "1 px a texel: mipmap", "", ""),
    ROW(zs_shade_mipmap_smooth, "mipmaps", PLAIN, "a vertex: bilinear", "1 px a texel: mipmap", "texture_lit",
        "texture"),
    ROW(zs_shade_mipmap_bilinear, "mipmaps", PLAIN, "a vertex: bilinear", "1 px a texel: mipmap_bilinear", "", ""),
    FLAT(zs_shade_mipmap_bilinear_flat, "mipmaps", PLAIN, "a vertex: bilinear", "1 px a texel: mipmap_bilinear", "",
         ""),
    ROW(zs_shade_mipmap_bilinear_smooth, "mipmaps", PLAIN, "a vertex: bilinear", "1 px a texel: mipmap_bilinear",
        "texture_lit", "texture"),
    ROW(zs_shade_cutout, "cut-outs", PLAIN, "a vertex: texture", "cutout, 4444", "", ""),
    FLAT(zs_shade_cutout_flat, "cut-outs", PLAIN, "a vertex: texture", "cutout, 4444", "", ""),
    ROW(zs_shade_cutout_smooth, "cut-outs", PLAIN, "a vertex: texture", "cutout, 4444", "texture_lit", "texture"),
    ROW(zs_shade_matcap, "an environment", PLAIN, "a vertex: matcap", "matcap", "", ""),
    ROW(zs_shade_smooth_ordered, "dithering", PLAIN, "a vertex: smooth_ordered", "smooth_ordered", "", ""),
    ROW(zs_shade_smooth_blue, "dithering", PLAIN, "a vertex: smooth_ordered", "smooth_ordered", "", ""),
    FLAT(zs_shade_shadowed_flat, "a shadow map", SHADOWED, "a vertex: shadowed_smooth", "shadowed_flat", "", ""),
    ROW(zs_shade_shadowed_smooth, "a shadow map", SHADOWED, "a vertex: shadowed_smooth", "shadowed_smooth", "", ""),
    ROW(zs_shade_shadowed_lit, "a lamp's shadow map", SHADOWED_LIT, "a vertex: shadowed_smooth", "shadowed_lit", "",
        ""),
    ROW(zs_shade_shadowed_texture, "a lamp's shadow map on a texture", SHADOWED_LIT, "a vertex: shadowed_smooth",
        "shadowed_texture, soft", "", ""),
    ROW(zs_shade_shadowed_phong, "shadow maps with light at each pixel", SHADOWED_PHONG, "a vertex: phong, matt",
        "shadowed_phong", "", ""),
    ROW(zs_shade_shadowed_texture_phong, "shadow maps with light at each pixel", SHADOWED_PHONG,
        "a vertex: texture_phong", "shadowed_texture_phong", "", ""),
    ROW(zs_shade_shadow, "flat shadows", PLAIN, NULL, "blend", "raw", ""),
    ROW(zs_shade_window, "a mirror", PLAIN, NULL, "window", "", ""),
};

const struct sim_shader_row *sim_shader_row_of(const struct zs_shader *shader)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].shader == shader)
            return &rows[i];
    return NULL;
}

/* The layer that a shader is; NULL: it is none. */
static const struct zs_layered *layer_of(const struct zs_shader *shader)
{
    return shader->run == zs_layer_mix.run || shader->run == zs_layer_add.run || shader->run == zs_layer_door.run
               ? (const struct zs_layered *)(const void *)shader
               : NULL;
}

/* The same of a filter. The filters' own shaders, which have a row, share its runs. */
static const struct zs_filtered *filter_of(const struct zs_shader *shader)
{
    return shader->run == zs_filter_linear.run || shader->run == zs_filter_levels.run ||
                   shader->run == zs_filter_levels_linear.run
               ? (const struct zs_filtered *)(const void *)shader
               : NULL;
}

void sim_shader_made(struct sim_shader_made *out, const struct zs_shader *shader)
{
    const struct zs_layered *layer;
    const struct zs_filtered *filter;
    *out = (struct sim_shader_made){ .of = shader };
    while ((out->row = sim_shader_row_of(out->of)) == NULL) {
        if ((layer = layer_of(out->of)) != NULL) {
            out->layer = layer->kind == &zs_layer_mix   ? SIM_LAYER_MIX
                         : layer->kind == &zs_layer_add ? SIM_LAYER_ADD
                                                        : SIM_LAYER_DOOR;
            out->is_fogged = layer->fogged != NULL;
            out->of = layer->of;
        } else if ((filter = filter_of(out->of)) != NULL) {
            out->filter = filter->kind == &zs_filter_linear   ? SIM_KIND_LINEAR
                          : filter->kind == &zs_filter_levels ? SIM_KIND_LEVELS
                                                              : SIM_KIND_LEVELS_LINEAR;
            out->of = filter->of;
        } else if (out->of->run == zs_shade_smooth_ordered.run || out->of->run == zs_shade_smooth_blue.run) {
            out->is_dithered = 1; /* of colours at the vertices: lit ones, as the smooth ones have a row */
            out->of = &zs_shade_lit;
        } else {
            return;
        }
        out->is_made = 1;
    }
}

size_t sim_shader_material_bytes(enum sim_shader_material material)
{
    switch (material) {
    case SIM_MATERIAL_BLEND:
        return sizeof(struct zs_blend);
    case SIM_MATERIAL_LIT:
        return sizeof(struct zs_lit_material);
    case SIM_MATERIAL_SHADOWED:
        return sizeof(struct zs_shadowed_material);
    case SIM_MATERIAL_SHADOWED_LIT:
        return sizeof(struct zs_shadowed_lit);
    case SIM_MATERIAL_SHADOWED_PHONG:
        return sizeof(struct zs_shadowed_phong);
    default:
        return sizeof(struct zs_material);
    }
}
