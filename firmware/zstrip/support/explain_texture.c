/* What is wrong with the data of an instance: its texture, and where it lies on the mesh.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "support/explain.h"
#include "zs_check.h"
#include "zs_shader.h"

#define REPEATS 1024 /* of a texture over a mesh, above which it is noise */

/* Texture coordinates that span less than a texel, or far more than a texture. */
static void say_uv(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    const struct zs_texture *const x = e->scene->instance[i].material->texture;
    int32_t span[2] = { 0, 0 };
    if (!m->uv || m->uv_bits > 15u || x->log2_w > ZS_TEXTURE_LOG2_MAX ||
        x->log2_h > ZS_TEXTURE_LOG2_MAX)
        return; /* say_texture says it */
    for (int k = 0; k < 2; k++) {
        int32_t least = 32767, most = -32768;
        for (uint32_t v = 0; v < m->n_verts; v++) {
            least = zs_min32(least, m->uv[v][k]);
            most = zs_max32(most, m->uv[v][k]);
        }
        span[k] = most - least; /* < 2^16; below 0 without vertices */
    }
    const int32_t most = zs_max32(span[0], span[1]);
    if (most == 0)
        ZS_SAY(e, "instance %: all of mesh.uv is the same: one texel is all that is seen.", i);
    if (most <= 0)
        return;
    if (!(x->log2_w | x->log2_h)) {
        ZS_SAY(e, "instance %: its texture is one texel: log2_w and log2_h are 0; of 64, it is 6.",
               i);
        return;
    }
    if (!(x->log2_w && x->log2_h) && span[x->log2_w != 0] >> m->uv_bits) {
        ZS_SAY(e,
               x->log2_w ? "instance %: its texture is one texel high, and mesh.uv runs across it: "
                           "log2_h is 0; of 64, it is 6."
                         : "instance %: its texture is one texel wide, and mesh.uv runs across it: "
                           "log2_w is 0; of 64, it is 6.",
               i);
        return;
    }
    if ((span[0] << x->log2_w) >> m->uv_bits == 0 && (span[1] << x->log2_h) >> m->uv_bits == 0)
        ZS_SAY(e,
               "instance %: mesh.uv spans less than a texel: % is all of the texture with "
               "uv_bits %.",
               i, 1 << m->uv_bits, m->uv_bits);
    else if (most >> m->uv_bits >= REPEATS)
        ZS_SAY(e, "instance %: mesh.uv repeats the texture % times: uv_bits is %.", i,
               most >> m->uv_bits, m->uv_bits);
}

/* A texture that the shader does not need: the library's shaders check that it is there. */
static void say_unread(struct zs_explainer *e, uint32_t i)
{
    const struct zs_material *const m = e->scene->instance[i].material;
    const struct {
        struct zs_material material;
        uint32_t rest[16]; /* for shaders that read more of their material: it is not set */
    } plain = { { .shader = m->shader, .cull = m->cull }, { 0 } };
    struct zs_instance in = e->scene->instance[i];
    in.material = &plain.material;
    if (!m->shader->by_fragment &&
        (!m->shader->check || m->shader->check(&in, &e->r->config) == ZS_OK))
        ZS_SAY(e,
               "instance % has a texture, and its shader reads none: zs_shade_texture does, and "
               "those whose names hold _texture.",
               i);
}

/* Return 1 if there is no flaw in it, nor alpha. */
static int say_texture(struct zs_explainer *e, uint32_t i)
{
    const struct zs_texture *const x = e->scene->instance[i].material->texture;
    uint32_t at;
    if (x->format != &zs_texel_565 && x->format != &zs_texel_pal8 && x->format != &zs_texel_pal4)
        return 0; /* one with alpha (zs_filter.h) */
    const enum zs_flaw flaw = zs_texture_check(x, &at);
    if (flaw == ZS_FLAW_NONE)
        return 1;
    ZS_PIECE(e, "instance %: its texture has ", i);
    ZS_PIECE(e, zs_flaw_string(flaw));
    ZS_SAY(e, " (number %).", at);
    return 0;
}

/* Channels of a texel, 0 .. 31 each, in bits 0 .. 4, 10 .. 14 and 20 .. 24. */
static uint32_t texel_at(const struct zs_texture *x, uint32_t i)
{
    const uint8_t *const byte = x->texel;
    const uint16_t *const color = x->format == &zs_texel_565 ? x->texel : x->palette;
    if (x->format == &zs_texel_pal8)
        i = byte[i];
    else if (x->format == &zs_texel_pal4)
        i = byte[i / 2u] >> i % 2u * 4u & 15u;
    return (color[i] & 31u) | (color[i] >> 6 & 31u) << 10 | (uint32_t)color[i] >> 11 << 20;
}

/* How far texels `from`, `from + every`, ... of n are from those `lag` behind them: the mean of up
 * to 256 to 511 of them, in 1/16 of a channel's level. */
static uint32_t differ(const struct zs_texture *x, uint32_t n, uint32_t from, uint32_t every,
                       uint32_t lag)
{
    const uint32_t all = n > from + lag ? (n - from - lag - 1u) / every + 1u : 0u;
    const uint32_t step = (all / 256u | 1u) * every; /* odd: all columns and rows in turn */
    uint32_t sum = 0, count = 0;
    for (uint32_t i = from; i + lag < n; i += step, count++) {
        const uint32_t a = texel_at(x, i), b = texel_at(x, i + lag);
        for (uint32_t k = 0; k < 30u; k += 10u)
            sum += zs_size32((int32_t)(a >> k & 31u) - (int32_t)(b >> k & 31u));
    }
    return count ? sum * 16u / count : 0u;
}

/* Is a row as long as log2_w says? In a picture, neighbours are alike, beside and below each other.
 * If its rows are two or four times as long, then those of the given length are not alike, every
 * second or fourth one is, and the end of the first goes on in the next. If they are half as long,
 * then the left half of a row is like the right one, and does not go on in it. */
static void say_rows(struct zs_explainer *e, uint32_t i)
{
    const struct zs_texture *const x = e->scene->instance[i].material->texture;
    const uint32_t w = UINT32_C(1) << x->log2_w, n = w << x->log2_h;
    if (w < 4u || x->log2_h < 3u)
        return;
    const uint32_t beside = differ(x, n, 0, 1, 1), below = differ(x, n, 0, 1, w);
    uint32_t rows = 0;
    for (uint32_t s = 2; s <= 4u && 3u * beside < below; s *= 2u)
        if (3u * differ(x, n, 0, 1, s * w) < below && 3u * differ(x, n, w - 1u, s * w, 1) < below)
            rows = rows ? rows : s * w;
    const uint32_t half = differ(x, n, 0, w, w / 2u), on = differ(x, n, w / 2u, w, w / 2u);
    const uint32_t middle = differ(x, n, w / 2u - 1u, w, 1);
    if (!rows && middle > 3u * beside && 3u * half < middle && 3u * on < middle && 2u * half > on)
        rows = w / 2u;
    if (rows)
        ZS_SAY(e,
               "instance %: the rows of its texture look % texels long, and log2_w is %, which is "
               "%: are log2_w and log2_h right?",
               i, rows, x->log2_w, w);
}

void zs_explain_texture(struct zs_explainer *e, uint32_t i, int mesh, int texture)
{
    const uint32_t before = e->said;
    const int right = texture && say_texture(e, i);
    if (texture)
        say_unread(e, i);
    if (mesh || texture)
        say_uv(e, i);
    if (right && e->said == before)
        say_rows(e, i);
}
