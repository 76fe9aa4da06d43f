/* Texel formats: the innermost loops of textured shading, one each.
 *
 * u and v are fractions of the texture in 32 bits: their top log2 bits are column and row, and repeating is
 * what unsigned sums do.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pipeline.h"

/* Shifts that leave column and row. A texture of one column or row: 31, and u or v is 0 (shade_texture.c). */
static inline uint32_t index_shift(uint32_t log2)
{
    return log2 ? 32u - log2 : 31u;
}

static void fetch_565(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    const uint16_t *texel = t->texel;
    const uint32_t right = index_shift(t->log2_w), down = index_shift(t->log2_h), row = t->log2_w;
    const uint32_t du = walk->du, dv = walk->dv;
    uint32_t u = walk->u, v = walk->v;
    for (uint16_t *const end = out + n; out != end; out++, u += du, v += dv)
        *out = zs_wire16(texel[((v >> down) << row) + (u >> right)]);
}

static void fetch_pal8(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    const uint8_t *texel = t->texel;
    const uint16_t *palette = t->palette;
    const uint32_t right = index_shift(t->log2_w), down = index_shift(t->log2_h), row = t->log2_w;
    const uint32_t du = walk->du, dv = walk->dv;
    uint32_t u = walk->u, v = walk->v;
    for (uint16_t *const end = out + n; out != end; out++, u += du, v += dv)
        *out = zs_wire16(palette[texel[((v >> down) << row) + (u >> right)]]);
}

static void fetch_pal4(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    const uint8_t *texel = t->texel;
    const uint16_t *palette = t->palette;
    const uint32_t right = index_shift(t->log2_w), down = index_shift(t->log2_h), row = t->log2_w;
    const uint32_t du = walk->du, dv = walk->dv;
    uint32_t u = walk->u, v = walk->v;
    for (uint16_t *const end = out + n; out != end; out++, u += du, v += dv) {
        const uint32_t at = ((v >> down) << row) + (u >> right);
        *out = zs_wire16(palette[(uint32_t)texel[at >> 1] >> ((at & 1u) << 2) & 15u]);
    }
}

const struct zs_texel zs_texel_565 = { fetch_565, 0, 0 };
const struct zs_texel zs_texel_pal8 = { fetch_pal8, 256, 0 };
const struct zs_texel zs_texel_pal4 = { fetch_pal4, 16, 1 };
