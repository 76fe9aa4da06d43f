/* Textures beyond the nearest texel: filters, mipmaps, texels with alpha, the alpha test.
 *
 * Shaders are named in zs_material.shader as those of zs_scene.h are, and need what
 * zs_shade_texture needs: mesh.uv, material.texture, config.varyings >= ZS_VARYINGS_TEXTURE (_smooth:
 * ZS_VARYINGS_TEXTURE_SMOOTH, and mesh.normal). Names that end in _flat are lit once for the face,
 * those in _smooth at the vertices. Coordinates are those of zs_shade_texture, bit for bit, with its
 * error (NUMERICS.md); so is the light. Accelerators of zs_fast.h do nothing for them, but `touch`,
 * `tiles`, `batch`, `clusters` and `edges`. All methods of zs_method.h take them, but for the alpha
 * test. Texels and palettes are not read by zs_damage_track: zs_invalidate after a change.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FILTER_H
#define ZS_FILTER_H

#include "zs_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Filters -------------------------------------------------------------------------------- */

/* Bilinear: the mean of the four texels around a pixel's coordinates, by their distances. Weights
 * have 11 bits. Colours of RGB565, from texels in any format, are within 0.65 codes of the exact
 * mean at the coordinates of zs_shade_texture. Clamped textures continue their border texels; others wrap around. */
extern const struct zs_shader zs_shade_bilinear;
extern const struct zs_shader zs_shade_bilinear_flat;
extern const struct zs_shader zs_shade_bilinear_smooth;

/* Mipmaps: texture.n_levels levels follow each other at texture.texel, each half as wide and high
 * as the one before (so a quarter of its bytes), in one format with one palette. n_levels <= 1 + the
 * lesser of log2_w and log2_h, with 4-bit texels of log2_w - 1 and log2_h; else ZS_ERR_TEXTURE.
 * `zsim convert --mipmap` writes them. A texture of 0 or 1 levels is drawn without.
 * The level is chosen by triangle where it is affine, else by pixel, from the distance alone: the
 * largest change of u or v to the next pixel, in texels, is rounded to a power of two. */
extern const struct zs_shader zs_shade_mipmap; /* the nearest texel of the level */
extern const struct zs_shader zs_shade_mipmap_flat;
extern const struct zs_shader zs_shade_mipmap_smooth;
extern const struct zs_shader zs_shade_mipmap_bilinear; /* bilinear in the level */
extern const struct zs_shader zs_shade_mipmap_bilinear_flat;
extern const struct zs_shader zs_shade_mipmap_bilinear_smooth;

/* ---- Alpha ---------------------------------------------------------------------------------- */

/* Alpha test (cut-outs: leaves, fences): a texel whose alpha is below texture.alpha_least, 1 .. 255
 * (0: 128), leaves the colour and the depth key alone. Texels are nearest. All depth states; any
 * order of drawing. Formats without alpha are drawn whole. Not opaque: the frame is drawn without
 * the accelerator `tiles`.
 * Methods: the depth buffer, zs_depth_none and zs_method_painter; with others, which take a
 * triangle for a wall, ZS_ERR_DEPTH. */
extern const struct zs_shader zs_shade_cutout;
extern const struct zs_shader zs_shade_cutout_flat;
extern const struct zs_shader zs_shade_cutout_smooth;

/* ---- Texels with alpha ---------------------------------------------------------------------- */

/* Formats for zs_texture.format. Shaders that do not know alpha draw their colours alone.
 * Palettes keep colours of 16 bits and alphas of 8 in one array of 16-bit values: so one pointer
 * does, and a palette that had no alpha stays what it was, with a second half. */
extern const struct zs_texel zs_texel_4444;  /* uint16_t [height][width], RGBA4444: red in the top
                                                four bits, alpha in the lowest. A channel's bits are
                                                repeated to widen it, alpha is times 17 */
extern const struct zs_texel zs_texel_pal8a; /* as zs_texel_pal8, palette [2 * n_colors]: RGB565
                                                values, then as many alphas, 0 .. 255 */
extern const struct zs_texel zs_texel_pal4a; /* as zs_texel_pal4, with such a palette */

#ifdef __cplusplus
}
#endif

#endif
