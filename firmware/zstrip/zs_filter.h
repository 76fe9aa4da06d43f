/* Textures beyond the nearest texel: filters, mipmaps, texels with alpha, the alpha test.
 *
 * Shaders are named in zs_material.shader as those of zs_scene.h are, and need what
 * zs_shade_texture needs: mesh.uv, material.texture, config.varyings >= ZS_VARYINGS_TEXTURE
 * (_smooth: ZS_VARYINGS_TEXTURE_SMOOTH, and mesh.normal). Names that end in _flat are lit once for
 * the face, those in _smooth at the vertices. Coordinates are those of zs_shade_texture, bit for
 * bit, with its error (NUMERICS.md); so is the light. All methods of zs_method.h take them, but for
 * the alpha test. Texels and palettes are not read by zs_damage_track: zs_invalidate after a
 * change.
 *
 * Accelerators of the frame help. Name zs_fast_texture too (or _flat, _smooth): it divides for up
 * to 16 pixels at a time where a floor or wall is close. With it a room of bilinear textures takes
 * half, on a Cortex-M3 and an M0. Mipmaps need the accelerator of their format for it as well.
 *
 * Instructions a pixel on a Cortex-M3, without depth test and stores of zs_shade_raw (QEMU,
 * tests/lab/filters/filters.c), for pixels of 1/16, 1/8, 1/4 and 1 texel; on a card that faces the
 * camera, and with perspective:
 *                         facing                  perspective
 *     texture 565         11   11   11   11       23   23   23   23
 *     bilinear 565        25   30   40   55       43   48   57   70
 *     bilinear pal8       25   31   42   58       43   49   59   73
 *     mipmap 565          11   11   11   11       24   24   24   24
 *     cutout pal8a        47   47   47   47       58   58   58   58
 *     cutout 4444         53   52   52   52       64   63   63   63
 * Closer to a floor or wall each pixel is divided (shade/texture.c): bilinear takes 240 a pixel
 * there, and 115 with the accelerator.
 * Light adds 26 (_flat and _smooth), as it does to zs_shade_texture without accelerators.
 * Flash on a Cortex-M3 (-O2, -Os), beyond zs_shade_texture: bilinear 4.2 and 1.7 KB, mipmaps 2.3
 * and 2.1 KB, the alpha test 0.7 and 0.6 KB, a format with alpha 0.3 KB.
 *
 * RMS difference to 16 x 16 samples a pixel, of 255, 160x120 (make t T=aliasing, then
 * build/test/test_aliasing):              nearest  bilinear  mipmap  mipmap_bilinear
 *     checker floor to the horizon           52.0      48.3    34.7             20.3
 *     brick floor to the horizon             31.7      27.1    16.9             12.2
 *     checker card that turns, far           43.9      35.5    42.6             13.2
 *     brick card that turns, far             32.8      26.6    17.2             12.9
 *     brick card that turns, near            13.7       7.1    13.2              7.9
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FILTER_H
#define ZS_FILTER_H

#include "zs_check.h"
#include "zs_shader.h"

ZS_C_BEGIN

/* ---- Filters -------------------------------------------------------------------------------- */

/* Bilinear: the mean of the four texels around a pixel's coordinates, by their distances.
 * Coordinates are rounded to 1/32 texel (weights have 5 bits); the colour is within one code of
 * RGB565 of the exact mean there, for texels in any format, and 2.3 codes of that at coordinates
 * that are not rounded, where white and black texels meet. Clamped textures continue their border
 * texels; others wrap around. */
extern const struct zs_shader zs_shade_bilinear;
extern const struct zs_shader zs_shade_bilinear_flat;
extern const struct zs_shader zs_shade_bilinear_smooth;

/* Mipmaps: texture.n_levels levels follow each other at texture.texel, each half as wide and high
 * as the one before (so a quarter of its bytes), in one format with one palette. n_levels <= 1 +
 * the lesser of log2_w and log2_h, with 4-bit texels of log2_w - 1 and log2_h; else ZS_ERR_TEXTURE.
 * `zsim convert --mipmap` writes them. A texture of 0 or 1 levels is drawn without.
 * The level is chosen by triangle where it is affine, else by pixel, from the distance alone: the
 * largest change of u or v to the next pixel, in texels, is rounded to a power of two. */
extern const struct zs_shader zs_shade_mipmap; /* the nearest texel of the level */
extern const struct zs_shader zs_shade_mipmap_flat;
extern const struct zs_shader zs_shade_mipmap_smooth;
extern const struct zs_shader zs_shade_mipmap_bilinear; /* bilinear in the level */
extern const struct zs_shader zs_shade_mipmap_bilinear_flat;
extern const struct zs_shader zs_shade_mipmap_bilinear_smooth;

/* Filters for other textured shaders: those of lamps and highlights, of shadow maps, matcaps.
 *
 *     static struct zs_filtered soft;
 *     err = zs_filtered_set(&soft, &zs_shade_texture_gloss, &zs_filter_linear);
 *     m.material.shader = &soft.shader;                // a struct zs_lit_material's
 */
struct zs_filter_kind; /* its fields belong to the library */
extern const struct zs_filter_kind zs_filter_linear; /* as zs_shade_bilinear */
extern const struct zs_filter_kind zs_filter_levels; /* as zs_shade_mipmap */
extern const struct zs_filter_kind zs_filter_levels_linear; /* as zs_shade_mipmap_bilinear */
struct zs_filtered {
    struct zs_shader shader; /* for zs_material.shader; set by zs_filtered_set, as are: */
    const struct zs_shader *of;
    const struct zs_filter_kind *kind;
};

/* Set a filtered shader.
 *
 * filtered  kept by the caller, not moved while it is drawn.
 * of        what it is: zs_shade_texture, _flat, _smooth, _lit, _gloss, _gloss_tinted, _phong,
 *           zs_shade_shadowed_texture, _phong, zs_shade_matcap, or a copy of one.
 * kind      one of those above. Each is linked only when named.
 * Cost      of a pixel: what `of` takes, and what the filter takes more than zs_shade_texture.
 * Return    ZS_OK; ZS_ERR_NULL; ZS_ERR_RANGE: `of` is another: one without a texture, or one that
 *           reads texels in its own way (this header's filters and cut-outs, a filtered shader,
 *           zs_blend_ and zs_stipple_, for which there is struct zs_layered, tinted): filtered is
 *           untouched. What is drawn with it is refused, ZS_ERR_TEXTURE, where a texture has levels
 *           that it cannot have. */
ZS_NODISCARD int zs_filtered_set(struct zs_filtered *filtered, const struct zs_shader *of,
                                 const struct zs_filter_kind *kind);

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

/* zs_texture_check (zs_check.h) for textures in these formats as well. */
enum zs_flaw zs_alpha_texture_check(const struct zs_texture *texture, uint32_t *index);

ZS_C_END

#endif
