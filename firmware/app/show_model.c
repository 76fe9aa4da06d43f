/* What show_model.h says.
 *
 * SPDX-License-Identifier: MIT
 */
#include "show_model.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_method.h"
#include "zs_shadow.h"

#ifndef SHOW_MODEL_ARENA
#define SHOW_MODEL_ARENA 148000 /* bytes: what RAM has left */
#endif

/* What a model may name: each is linked, and the page knows its address. */
#define PARTS(X)                                                                                              \
    X(zs_shade_raw) X(zs_shade_flat) X(zs_shade_smooth) X(zs_shade_texture) X(zs_shade_texture_flat)          \
    X(zs_shade_texture_smooth) X(zs_shade_lit) X(zs_shade_lit_face) X(zs_shade_phong) X(zs_shade_phong_near)  \
    X(zs_shade_texture_gloss) X(zs_shade_texture_gloss_tinted) X(zs_shade_texture_phong) X(zs_shade_matcap)   \
    X(zs_shade_cutout) X(zs_shade_cutout_flat) X(zs_shade_cutout_smooth) X(zs_shade_smooth_ordered)           \
    X(zs_shade_smooth_blue) X(zs_shade_bilinear) X(zs_shade_bilinear_flat) X(zs_shade_bilinear_smooth)        \
    X(zs_shade_mipmap_bilinear) X(zs_shade_mipmap_bilinear_flat) X(zs_shade_mipmap_bilinear_smooth)           \
    X(zs_shade_shadow) X(zs_shade_shadowed_smooth) X(zs_blend_raw) X(zs_blend_flat) X(zs_blend_smooth)        \
    X(zs_blend_texture) X(zs_blend_texture_flat) X(zs_blend_texture_smooth) X(zs_add_raw) X(zs_add_flat)      \
    X(zs_add_smooth) X(zs_add_texture) X(zs_add_texture_flat) X(zs_add_texture_smooth) X(zs_stipple_raw)      \
    X(zs_stipple_flat) X(zs_stipple_smooth) X(zs_stipple_texture) X(zs_stipple_texture_flat)                  \
    X(zs_stipple_texture_smooth) X(zs_texel_565) X(zs_texel_pal8) X(zs_texel_pal4) X(zs_texel_4444)           \
    X(zs_texel_pal8a) X(zs_texel_pal4a) X(zs_depth_float) X(zs_depth_recip) X(zs_depth_linear)                \
    X(zs_method_transparent)

extern const struct show_model show_model; /* the linker's, at SHOW_MODEL, where `show` is, too */
extern uint32_t show_model_arena[];
extern const void *const show_model_parts[];
extern const struct zs_fast *const show_model_fast[];
void show_model_pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h);

#define ADDRESS(name) &name,
const void *const show_model_parts[] = { PARTS(ADDRESS) (const void *)zs_fog_draw, show_model_fast, show_model_arena,
                                         (const void *)show_model_pose };
const struct zs_fast *const show_model_fast[] = { ZS_FAST_ALL, ZS_FAST_END };

uint32_t show_model_arena[SHOW_MODEL_ARENA / 4] ZS_ALIGNED;

void show_model_pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    (void)w;
    (void)h;
    const struct show_view *view = &show_model.view[t % show_model.piece.demo.frames];
    f->scene = show_model.scene;
    f->scene.light = view->light;
    f->scene.instance = view->instance;
    f->camera = view->camera;
}
