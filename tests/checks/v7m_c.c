/* For tests/checks/v7m.c: small triangles by the functions in C, on a core that has them by hand.
 *
 * SPDX-License-Identifier: MIT
 */
#define ZS_V7M 0
#define zs_fast_raw solid_in_c
#define zs_fast_flat solid_flat_in_c
#include "fast/fast_solid.c"
#define zs_fast_texture unlit_in_c
#define zs_fast_texture_flat flat_in_c
#define zs_fast_texture_smooth smooth_in_c
#include "fast/fast_texture.c"
#undef TEXEL
#define zs_fast_565 texels_565_in_c
#define zs_fast_pal8 texels_pal8_in_c
#define zs_fast_pal4 texels_pal4_in_c
#include "fast/fast_texels.c"

extern const struct zs_fast *const textured_in_c[3], *const texels_in_c[3];
const struct zs_fast *const textured_in_c[3] = { &unlit_in_c, &flat_in_c, &smooth_in_c };
const struct zs_fast *const texels_in_c[3] = { &texels_565_in_c, &texels_pal8_in_c, &texels_pal4_in_c };
