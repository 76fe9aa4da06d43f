/* Textures times the light of several lamps.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/lights.h"
#include "shade/texture.h"
#include "shade/stages.h"

int zs_lit_texture_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_texture_usable(in, config);
    if (err)
        return err;
    return in->mesh->normal ? zs_lit_check(in, config) : ZS_ERR_MESH;
}

static void vertex_light(const struct zs_shading *s, uint32_t v, struct zs_rgb rgb, uint16_t out[3])
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    int32_t p[3];
    zs_mesh_place(mesh, v, p);
    zs_lit_color(s, rgb, p, mesh->normal[v], out);
}

/* ---- Luminance ------------------------------------------------------------------------------- */

static void lit_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    static const struct zs_rgb white = { 255, 255, 255 };
    const struct zs_mesh *const mesh = s->instance->mesh;
    uint16_t c[3];
    vertex_light(s, v, white, c);
    out[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    out[1] = (uint16_t)(mesh->uv[v][1] + 32768);
    /* Rec. 601: 77, 150 and 29 of 256; a full channel is 1 */
    out[2] = (uint16_t)((c[0] * 77u + c[1] * 150u + c[2] * 29u + 256u) >> 9);
}

const struct zs_shader zs_shade_texture_lit = {
    .vertex = lit_vertex, .start = zs_texture_start, .run = zs_texture_run, .opaque = ZS_TEXTURED,
    .check = zs_lit_texture_check, .light = zs_texture_light, .n_varyings = ZS_VARYINGS_LIT
};

/* ---- Colours --------------------------------------------------------------------------------- */

static void tinted_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    static const struct zs_rgb white = { 255, 255, 255 };
    const struct zs_mesh *const mesh = s->instance->mesh;
    out[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    out[1] = (uint16_t)(mesh->uv[v][1] + 32768);
    vertex_light(s, v, mesh->vertex_rgb ? mesh->vertex_rgb[v] : white, out + 2);
}

/* A coordinate in repeats, uq0_32, at the centre of its step; held where the texture is clamped. */
static uint32_t place(uint16_t v, uint32_t uv_bits, uint32_t log2, int clamped)
{
    const int32_t at = (int32_t)v - 32768, one = 1 << uv_bits;
    if (!log2)
        return 0;
    if (clamped && at < 0)
        return 0;
    if (clamped && at >= one)
        return UINT32_MAX;
    return (uv_bits ? (uint32_t)at << (32u - uv_bits) : 0u) + (1u << (23u - log2)); /* 1/512 */
}

static void tinted_fragment(const struct zs_instance *in, struct zs_fragment *f)
{
#if ZS_VARYINGS_MAX >= 5
    const struct zs_texture *const t = in->material->texture;
    const uint32_t bits = in->mesh->uv_bits;
    const struct zs_walk walk = { place(f->v[0], bits, t->log2_w, t->clamp & ZS_CLAMP_U),
                                  place(f->v[1], bits, t->log2_h, t->clamp & ZS_CLAMP_V), 0, 0 };
    uint16_t texel;
    t->format->fetch(t, &texel, 1, &walk);
    const uint32_t c = zs_wire16(texel);
    *f->color = zs_wire16((uint16_t)(zs_lit_code(f->v[2], c >> 11) << 11 |
                                     zs_lit_code(f->v[3], c >> 5 & 63u) << 5 |
                                     zs_lit_code(f->v[4], c & 31u)));
#else
    (void)in;
    (void)f;
    (void)place;
#endif
}

const struct zs_shader zs_shade_texture_tinted = { .vertex = tinted_vertex,
                                                   .fragment = tinted_fragment,
                                                   ZS_FRAGMENTS,
                                                   .check = zs_lit_texture_check,
                                                   .n_varyings = ZS_VARYINGS_TEXTURE_TINTED,
                                                   .opaque = 1 };
