/* Textures beyond the nearest texel: filters, mipmaps, texels with alpha, the alpha test.
 *
 * Shaders are named in zs_material.shader as those of zs_scene.h are, and need what zs_shade_texture
 * needs: mesh.uv, material.texture, config.varyings >= ZS_VARYINGS_TEXTURE (_smooth:
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
