/* Texel formats: how a run of texels is fetched.
 *
 * u and v are fractions of the texture's size in 32 bits. Their top log2 bits are column and row.
 * Unsigned sums wrap, so the texture repeats.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "shade/texels.h"

ZS_KERNEL_INLINE void fetch(const struct zs_texture *t, uint16_t *out, int32_t n,
                            const struct zs_walk *walk, zs_read_fn *read)
{
    const void *texel = t->texel;
    const uint16_t *palette = t->palette;
    const uint32_t right = zs_texture_cut(t->log2_w), down = zs_texture_cut(t->log2_h),
                   row = t->log2_w;
    uint32_t du = walk->du, dv = walk->dv, u = walk->u, v = walk->v;
    for (uint16_t *end = out + n; out != end; out++, u += du, v += dv) {
        ZS_HIGH_REGISTER(du);
        ZS_HIGH_REGISTER(dv);
        ZS_HIGH_REGISTER(end);
        *out = zs_wire16(read(texel, palette, ((v >> down) << row) + (u >> right)));
    }
}

static void fetch_565(const struct zs_texture *t, uint16_t *out, int32_t n,
                      const struct zs_walk *walk)
{
    fetch(t, out, n, walk, zs_read_565);
}

static void fetch_pal8(const struct zs_texture *t, uint16_t *out, int32_t n,
                       const struct zs_walk *walk)
{
    fetch(t, out, n, walk, zs_read_pal8);
}

static void fetch_pal4(const struct zs_texture *t, uint16_t *out, int32_t n,
                       const struct zs_walk *walk)
{
    fetch(t, out, n, walk, zs_read_pal4);
}

const struct zs_texel zs_texel_565 = { .fetch = fetch_565, .own = fetch_565, .log2_bits = 4 };
const struct zs_texel zs_texel_pal8 = {
    .fetch = fetch_pal8, .own = fetch_pal8, .colors_max = 256, .log2_bits = 3
};
const struct zs_texel zs_texel_pal4 = {
    .fetch = fetch_pal4, .own = fetch_pal4, .colors_max = 16, .log2_bits = 2
};
