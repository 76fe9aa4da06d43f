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

#define gather gather_vertices
#pragma weak zs_fast_batch /* the name is that of a struct as well */
#define zs_batch_bin batch_bin_in_c
#define zs_batch_room batch_room_in_c
#define zs_batch_verts batch_verts_in_c
#include "fast/batch.c"

uint32_t sweep_in_c(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3]);
uint32_t sweep_in_c(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3])
{
    return zs_sweep_each(s, t, end, tri);
}

extern const struct zs_fast *const textured_in_c[3], *const texels_in_c[3];
const struct zs_fast *const textured_in_c[3] = { &unlit_in_c, &flat_in_c, &smooth_in_c };
const struct zs_fast *const texels_in_c[3] = { &texels_565_in_c, &texels_pal8_in_c, &texels_pal4_in_c };
