/* Transparency: blending shaders, screen-door patterns, and a method that sorts layers.
 *
 *     static const struct zs_blend glass = { .material = { .shader = &zs_blend_flat,
 *                                                          .rgb = ZS_RGB(0x40a0ff) },
 *                                            .alpha = 96 };
 *     ...
 *     struct zs_instance pane = { .mesh = &card, .material = &glass.material };
 *     screen_config.method = &zs_method_transparent;
 *
 * effect/README.md says which kind to take.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_BLEND_H
#define ZS_BLEND_H

#include "zs_shader.h"

ZS_C_BEGIN

/* The material of all shaders below. A plain struct zs_material with one of them is wrong: it has
 * no alpha, and the renderer cannot see that. zs_damage_track does not see a change of alpha or
 * phase: call zs_invalidate after it. */
struct zs_blend {
    struct zs_material material;
    uint8_t alpha; /* 0 .. 255. 0: nothing is seen; 255: all of it */
    uint8_t phase; /* stipple: moves the pattern by phase % 8 columns and phase / 8 rows, modulo 8,
                      so that faces behind each other do not leave out the same pixels */
};

/* Alpha blending: a channel becomes source * alpha / 255 + old * (1 - alpha / 255). The source is
 * what the opaque shader of that name draws, as RGB565, the old colour the pixel's.
 *
 * Texels   of a format with alpha (zs_filter.h): alpha is the product of the texel's and the
 *          material's. For a decal, the material's is 255.
 * Exact    within one code of RGB565 of that, in each channel; alpha 0 leaves a pixel as it is, 255
 *          draws the source, and a source equal to the old colour changes nothing.
 * Depth    pixels are tested, with the instance's depth state, and keys are never written. What is
 *          behind has to be drawn before: order the instances, or take zs_method_transparent. With
 *          zs_depth_none, and by zs_method_painter and zs_method_depthsort: in drawing order.
 *          zs_method_raycast and zs_method_coverage colour each pixel once: not for blending.
 * Cost     on a Cortex-M3, a pixel of one colour takes 9 instructions, 14 with the depth test and
 *          20 with a depth state; a texel or a smooth colour 26 more than opaque, 20 with the depth
 *          test (effect/README.md). Blending has no accelerators; `tiles` is not used from the
 *          first such instance on.
 * Needs    what the opaque shader needs, with its errors. */
extern const struct zs_shader zs_blend_raw, zs_blend_flat, zs_blend_smooth, zs_blend_texture,
    zs_blend_texture_flat, zs_blend_texture_smooth;

/* Additive blending, for light: a channel becomes old + source * alpha / 255, at most full. Within
 * one code of that. Otherwise as above, but the order of additive faces does not matter. */
extern const struct zs_shader zs_add_raw, zs_add_flat, zs_add_smooth, zs_add_texture,
    zs_add_texture_flat, zs_add_texture_smooth;

/* Screen-door transparency: round(alpha * 64 / 255) of 64 pixels are drawn, in an ordered pattern
 * (Bayer, 8x8) by their place in the frame; the others keep colour and key. No order is needed, as
 * a pixel that is drawn is opaque, and writes its key unless the depth state is read-only. Needs
 * what the opaque shader needs, with its errors. */
extern const struct zs_shader zs_stipple_raw, zs_stipple_flat, zs_stipple_smooth,
    zs_stipple_texture, zs_stipple_texture_flat, zs_stipple_texture_smooth;

/* For a shader of yours that mixes in its fragment stage: pixels are tested, keys never written,
 * and zs_method_transparent sorts its triangles:
 *
 *     static const struct zs_shader mine = { .fragment = my_fragment, ZS_FRAGMENTS, ZS_LAYER };
 */
#define ZS_LAYER .layer = 1, .span = zs_layer_span
void zs_layer_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                   uint32_t sum, uint32_t step);

/* ---- Any shader as a layer ------------------------------------------------------------------- */

/* A shader in place of another one: what that one draws is mixed with what is there. It takes any
 * shader with its own material: lamps, highlights, filters, matcaps, shadow maps, a fragment stage
 * of yours.
 *
 *     static struct zs_layered glass;
 *     static struct zs_lit_material m = { .lighting = &lights, .shine = &gloss, ... };
 *     err = zs_layered_set(&glass, &zs_shade_lit, &zs_layer_mix, 96);
 *     m.material.shader = &glass.shader;
 *
 * Exact, depth, methods: as the shaders above. */
struct zs_fog;
struct zs_layer_kind;                            /* how; its fields belong to the library */
extern const struct zs_layer_kind zs_layer_mix;  /* as zs_blend_smooth */
extern const struct zs_layer_kind zs_layer_add;  /* as zs_add_smooth */
extern const struct zs_layer_kind zs_layer_door; /* as zs_stipple_smooth: keys are written */
struct zs_layered {
    struct zs_shader shader; /* for zs_material.shader; set by zs_layered_set, as are: */
    const struct zs_shader *of;
    const struct zs_layer_kind *kind;
    uint8_t alpha, phase; /* as in struct zs_blend; may be changed between frames */
    /* Set by zs_layered_fog (zs_fog.h); NULL: no fog. */
    void (*fogged)(const struct zs_fog *fog, uint16_t *px, int32_t n, uint32_t sum, uint32_t step,
                   int dark);
    const struct zs_fog *fog;
};

/* Set a layer.
 *
 * layer   kept by the caller, not moved while it is drawn; without fog, phase 0.
 * of      what is drawn; may be of a struct zs_filtered (zs_filter.h). Kept.
 * kind    &zs_layer_mix, &zs_layer_add or &zs_layer_door. Each is linked only when named.
 * alpha   0: nothing is seen; 255: all of it.
 * Cost    of a pixel on a Cortex-M3: what `of` takes, and 25 (M0: 44), in fog 32 (48) more; door
 *         11.
 * Return  ZS_OK; ZS_ERR_NULL; ZS_ERR_RANGE: `of` leaves pixels out or mixes by itself (cut-outs,
 *         windows, flat shadows, other layers): layer is untouched. */
ZS_NODISCARD int zs_layered_set(struct zs_layered *layer, const struct zs_shader *of,
                                const struct zs_layer_kind *kind, uint8_t alpha);

/* ---- The method ------------------------------------------------------------------------------ */

/* Sorted layers, a method (zs_config.method): the depth buffer for all other instances, in scene
 * order; then the triangles of instances whose shader is a blending one, or has ZS_LAYER, from far
 * to near: tested, not written. In a frame of several passes: the same for each pass.
 *
 * Right   where every layer lies wholly behind or in front of those that it overlaps. The order is
 *         that of farthest vertices, after clipping; of equally far ones, the first in scene order
 *         is drawn first. The frame does not depend on the pools.
 * Wrong   where layers cross, or overlap in a cycle, or where a large one has its farthest vertex
 *         behind a small one that it covers: zs_method_depthsort with the same shaders splits them.
 * Needs   depth memory, else ZS_ERR_DEPTH; max_tris >= 2 and max_verts >= 6, else ZS_ERR_SIZE.
 * Cost    a sort of the layers of each strip, n log n. Where a strip alone fills a pool, opaque
 *         triangles are drawn as they come, and layers that the pool does not hold cost walks over
 *         the scene: each draws the farthest that are left. */
extern const struct zs_method zs_method_transparent;

ZS_C_END

#endif
