/* Materials and textures of a model as it is (--mesh file).
 *
 * SPDX-License-Identifier: MIT
 */
#include "quantise_parts.h"

#include <stdlib.h>

#include "sim.h"
#include "zs_shader.h"

/* Palette and indices; pal4 takes two columns and more, a single one is stored as pal8. */
static void build_indices(struct zs_texture *out, uint16_t palette[2 * SIM_PALETTE_MAX],
                          const struct sim_pixels *from, enum sim_texel texel)
{
    const size_t n = (size_t)from->w * from->h;
    const int halves = texel == SIM_TEXEL_PAL4 && from->w > 1;
    uint8_t *index = sim_alloc(n, 1);
    out->format = halves ? &zs_texel_pal4 : &zs_texel_pal8;
    out->palette = palette;
    out->n_colors = (uint16_t)sim_palette_build(palette, texel == SIM_TEXEL_PAL4 ? 16u : 256u, from);
    sim_palette_map(index, from, palette, out->n_colors, 0);
    for (size_t i = 0; halves && i < n / 2; i++)
        index[i] = (uint8_t)(index[2 * i] | index[2 * i + 1] << 4);
    out->texel = index;
}

static uint16_t texel_code(const struct zs_texture *t, size_t i)
{
    const uint8_t *index = t->texel;
    if (t->format == &zs_texel_565)
        return ((const uint16_t *)t->texel)[i];
    return t->palette[t->format == &zs_texel_pal8 ? index[i] : index[i / 2] >> i % 2 * 4 & 15];
}

static double loss_db(const struct zs_texture *t, const struct sim_pixels *from)
{
    const size_t n = (size_t)from->w * from->h;
    uint16_t *code = sim_alloc(n, sizeof *code);
    for (size_t i = 0; i < n; i++)
        code[i] = texel_code(t, i);
    const double psnr_db = sim_rgb565_loss(from, code).psnr_db;
    free(code);
    return psnr_db;
}

static void build_texture(struct sim_scene *s, uint32_t i, const struct sim_texture *from,
                          enum sim_texel texel)
{
    const struct sim_pixels pixels = { from->image.width, from->image.height,
                                       (const uint8_t(*)[3])from->image.rgb };
    struct zs_texture *out = &s->texture[i];
    *out = (struct zs_texture){ .format = &zs_texel_565,
                                .log2_w = sim_texture_log2(pixels.w),
                                .log2_h = sim_texture_log2(pixels.h),
                                .clamp = from->clamp };
    if (texel == SIM_TEXEL_565)
        out->texel = sim_texture_565(from);
    else
        build_indices(out, s->palette[i], &pixels, texel);
    s->psnr_db = fmin(s->psnr_db, loss_db(out, &pixels));
    sim_progress("textures", i, s->n_textures);
}

void sim_scene_materials(struct sim_scene *s, const struct sim_model *model, const struct sim_options *o)
{
    const struct zs_shader *const plain = o->shade == SIM_SHADE_ID || o->shade == SIM_SHADE_UNLIT
                                              ? &zs_shade_raw
                                          : sim_options_smooth(o) ? &zs_shade_smooth
                                                                  : &zs_shade_flat;
    const struct zs_shader *const textured = o->shade == SIM_SHADE_UNLIT ? &zs_shade_texture
                                             : sim_options_smooth(o) ? &zs_shade_texture_smooth
                                                                     : &zs_shade_texture_flat;
    s->n_textures = sim_options_textured(o) ? model->n_textures : 0;
    s->texture = sim_alloc(s->n_textures, sizeof *s->texture);
    s->palette = sim_alloc(s->n_textures, sizeof *s->palette);
    s->psnr_db = INFINITY;
    s->material = sim_alloc((size_t)s->n_textures + 1, sizeof *s->material);
    for (uint32_t i = 0; i <= s->n_textures; i++) {
        s->material[i] = (struct zs_material){ .shader = i > 0 ? textured : plain,
                                               .rgb = { 204, 204, 204 },
                                               .cull = (uint8_t)o->cull };
        if (i > 0) {
            build_texture(s, i - 1, &model->texture[i - 1], o->texel);
            s->material[i].texture = &s->texture[i - 1];
        }
    }
}
