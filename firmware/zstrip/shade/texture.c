/* Textured shading: nearest texel, perspective-correct, unlit or multiplied by light.
 *
 * Coordinates. A vertex has u and v as in the mesh, biased to be unsigned. A triangle takes the
 * least u (v) of its vertices as its base, and interpolates the differences from it. Affine: in
 * 2^-32 repeats, or in 2^s of them if that would need more than 29 bits. They are then shifted left
 * at once, modulo one repeat, which a shift to the left preserves. With perspective: normalised to
 * un, 16 bits, so that small differences keep their bits, times w (shade/persp.h).
 *
 * The error of affine interpolation is kept below 1/4 texel of the texture, or of one with 128
 * texels if the texture is smaller. For a whole triangle the error is T (rho - 1) / 4, where T is
 * the number of texels that it spans, and rho its ratio of w. For groups of L = 32 pixels of a
 * scanline, let W = w and C = U w; both are linear along the scanline. Then u1 - u0 = (C' W0 - C0
 * W') L / (W0 W1) and rho - 1 = W' L / W0, so the error is K |W'| L^2 / (4 W0^2 W1) with K = |C' W
 * - C W'|. K is constant along a scanline and linear from one to the next, so its maximum is at a
 * vertex: |C' - U W'| W. So a group may be affine if W^3 >= T K |W'| L^2, with W the lesser of
 * its two ends.
 *
 * In other groups, each pixel is divided. If the triangle has at most 2^COARSE_LOG2 texels, a
 * reciprocal of 15 bits is used (NUMERICS.md: 2^-13.4 of its span). One or two pixels are divided
 * one by one, more of them in pieces in which w keeps its leading zeros, so that no shift depends
 * on the pixel. Clamped textures use 64 bits. Groups start at multiples of 32 from the scanline's
 * first covered pixel; the last ends at its last covered pixel. Light is interpolated in the same
 * way, with 128 codes for its whole range.
 *
 * Further errors of a coordinate, in texels: gradients, the larger of 2^-21 and (W + H + 1) / 2^32
 * of the triangle's span, times rho (core/plane.c, ZS_PLANE_WIDE); reciprocal, 2^-29 of the span;
 * vertices made at the near plane, half a step of the mesh's coordinates.
 *
 * A sample exactly between two texels belongs to the right or lower one. For that, 1/512 texel is
 * added, which is more than the error of gradients in common triangles.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "core/pass.h"
#include "core/plane.h"
#include "zs_shader.h"
#include "shade/texture.h"
#include "shade/stages.h"

#define COARSE_LOG2 ZS_TEXEL_COARSE_LOG2 /* texels for which a reciprocal of 15 bits is enough */
#define LIGHT_MAX 65504u                 /* uq1_15, just below 2, because light() adds a half */
#define LIGHT_LOG2 7                     /* log2 of the codes that 16 bits of light span: 126 */

/* ---- Vertices and faces ---------------------------------------------------------------------- */

void zs_texture_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const struct zs_mesh *mesh = s->instance->mesh;
    out[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    out[1] = (uint16_t)(mesh->uv[v][1] + 32768);
}

/* Return the light intensity at a normal as uq1_15. */
static uint16_t light_word(const struct zs_shading *s, const zs_q1_15 normal[3])
{
    const uint32_t light = (zs_light_intensity(s, normal) + 1u) >> 1;
    return (uint16_t)(light > LIGHT_MAX ? LIGHT_MAX : light);
}

void zs_texture_lit_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_texture_vertex(s, v, out);
    out[2] = light_word(s, s->instance->mesh->normal[v]);
}

uint16_t zs_texture_lit_face(const struct zs_shading *s, uint32_t t)
{
    zs_q1_15 n[3];
    zs_light_face_normal(n, s->instance->mesh, t);
    return light_word(s, n);
}

int zs_texture_usable(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_texture_error(in->material->texture);
    (void)config;
    if (err)
        return err;
    return in->mesh->uv && in->mesh->uv_bits <= 15 ? ZS_OK : ZS_ERR_MESH;
}

int zs_texture_lit_usable(const struct zs_instance *in, const struct zs_config *config)
{
    return in->mesh->normal ? zs_texture_usable(in, config) : ZS_ERR_MESH;
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* Convert v * 2^-uv_bits to 32 fraction bits. */
static inline uint64_t repeats(int32_t v, uint32_t uv_bits)
{
    return (uint64_t)(uint32_t)(v >> uv_bits) << 32 |
           (uv_bits ? (uint32_t)v << (32 - uv_bits) : 0u);
}

ZS_RARE uint64_t zs_texture_gentle(int32_t n, uint32_t rcp, int32_t shift)
{
    const int64_t q = zs_round_shift(zs_mul_su(n, rcp), shift);
    return (uint64_t)(q != (int32_t)q) << 32 | (uint32_t)q;
}

/* A coordinate relative to the least of the three. */
struct relative {
    uint32_t above[3]; /* 2^-uv_bits repeats */
    int32_t up;        /* the largest above * 2^up is in [2^15, 2^16), or all are 0 */
};

static void relative(struct zs_job *job, const struct zs_coordinate *c, int k, uint32_t uv_bits,
                     struct relative *out)
{
    struct zs_sampler *s = &job->sampler;
    const uint32_t log2 = k ? s->texture->log2_h : s->texture->log2_w;
    const int32_t least = zs_min32(zs_min32(c->d1, c->d2), 0);
    out->above[0] = (uint32_t)-least;
    out->above[1] = (uint32_t)(c->d1 - least);
    out->above[2] = (uint32_t)(c->d2 - least);
    out->up = zs_clz32(c->range | 1u) - 16; /* 0 .. 15 */
    s->shift[k] = (int8_t)(17 - out->up - (int32_t)uv_bits);
    s->base[k] = repeats(c->a + least - 32768, uv_bits) +
                 (1u << (32u - ZS_TEXTURE_BIAS_LOG2 - log2));
}

/* Compute coordinate k's plane where zs_texture_plane does not: for large triangles, steep
 * gradients, and sampler.wide, where it is relative to the least coordinate. */
static ZS_NOINLINE void other_plane(struct zs_job *job, const struct zs_coordinate *c, int k,
                                    uint32_t uv_bits)
{
    const int wide = job->sampler.wide;
    struct zs_plane *out = &job->c[k];
    struct relative r;
    relative(job, c, k, uv_bits, &r);
    const int32_t whole = 32 - (int32_t)uv_bits, most = 13 + r.up; /* 29 bits */
    const int32_t up = wide ? 15 + r.up : zs_min32(whole, most), later = wide ? 0 : whole - up;
    zs_plane32(&job->geom, r.above[0] << up, r.above[1] << up, r.above[2] << up, ZS_PLANE_WIDE,
               out);
    out->base = (out->base << later) + (wide ? 0u : (uint32_t)job->sampler.base[k]);
    out->gx <<= later;
    out->gy <<= later;
    zs_plane_origin(&job->geom, out);
}

/* Compute the gradients of both coordinates in 2^-32 repeats, modulo one repeat, and their values
 * at column 0 of row 0. */
static ZS_NOINLINE void affine_planes(struct zs_job *job, const struct zs_coordinate c[2],
                                      uint32_t uv_bits)
{
    const struct zs_geom *g = &job->geom;
    const struct zs_texture *t = job->sampler.texture;
    const int32_t x = ZS_SUBPX_HALF - job->v[0]->x, y = ZS_SUBPX_HALF - job->v[0]->y,
                  shift = g->exp + 23 +
                          (int32_t)uv_bits; /* 2^8 * 2^(32 - uv_bits) / (2^63 * 2^exp) */
    const int direct = !job->sampler.wide && g->rcp && shift >= 1; /* small: |d| <= 2^16 */
    for (int k = 0; k < 2; k++)
        if (!direct || c[k].range >> 14 ||
            zs_texture_plane(&job->c[k], &c[k], g, shift, x, y, uv_bits, k ? t->log2_h : t->log2_w))
            other_plane(job, &c[k], k, uv_bits);
}

/* Return 1 if a triangle may be affine, when w changes by `change`, its least value is `least`, and
 * light changes by range. */
ZS_ALWAYS_INLINE int affine_enough(int32_t texels, uint32_t range, uint32_t change, uint32_t least)
{
    return zs_texture_affine(texels, change, least) &&
           (!range || zs_texture_light_affine(range, change, least));
}

/* Return ceil(log2(2^texels K |W'|)) for an attribute; -128 if the product is 0. */
static int32_t bend_log2(const struct zs_plane *c, const struct zs_plane *w_plane,
                         const uint32_t un[3], const uint32_t w[3], int32_t texels)
{
    const int32_t c_gx = (int32_t)c->gx, w_gx = (int32_t)w_plane->gx;
    uint64_t most = 0;
    for (int k = 0; k < 3; k++) {
        const int64_t d = c_gx -
                          (zs_mul_ss(w_gx, (int32_t)un[k]) >> 16); /* |.| <= 2^32; half fits 32 bits
                                                                    */
        const uint64_t size = zs_mul_uu((uint32_t)(((d < 0 ? -d : d) + 1) >> 1), w[k]);
        if (most < size)
            most = size;
    }
    if (most == 0 || w_gx == 0)
        return -128;
    const int32_t cut = zs_max32(33 - zs_clz64(most), 0);
    const uint64_t product = zs_mul_uu((uint32_t)(most >> cut) + 1u,
                                       zs_size32(w_gx)); /* > most |W'| / 2^cut */
    return texels + ZS_SPAN_BOUND_LOG2 - 1 + cut + 64 - zs_clz64(product);
}

/* Return ceil(2^(n / 3)), clamped to 32 bits. */
static uint32_t third_power(int32_t n)
{
    static const uint32_t part[3] = { 0x80000000u, 0xa14517ccu,
                                      0xcb2ff52au }; /* 2^31 * 2^(i / 3), rounded up */
    if (n < 0)
        return 1;
    return n >= 96 ? UINT32_MAX : ((part[n % 3] - 1u) >> (31 - n / 3)) + 1u;
}

ZS_IN_ORDER static ZS_NOINLINE void start_groups(struct zs_job *job, const uint16_t *const a[3],
                                                 const struct zs_coordinate c[2], uint32_t uv_bits,
                                                 int32_t most, const uint32_t w[3])
{
    const struct zs_texture *t = job->sampler.texture;
    const int n = job->shader->n_varyings;
    int32_t need = -128;
    zs_persp_plane(&job->geom, w, ZS_PLANE_WIDE, &job->w);
    for (int i = 0; i < n; i++) {
        uint32_t un[3], v[3];
        struct relative r;
        int32_t texels = LIGHT_LOG2;
        if (i < 2) {
            relative(job, &c[i], i, uv_bits, &r);
            texels = 16 - r.up - (int32_t)uv_bits +
                     (int32_t)zs_maxu32(i ? t->log2_h : t->log2_w, ZS_TEXTURE_FLOOR_LOG2);
        }
        for (int k = 0; k < 3; k++) {
            un[k] = i < 2 ? r.above[k] << r.up : a[k][2]; /* < 2^16 */
            v[k] = zs_umulh(un[k] << 16, w[k]);
        }
        zs_persp_plane(&job->geom, v, ZS_PLANE_WIDE, &job->c[i]);
        need = zs_max32(need, bend_log2(&job->c[i], &job->w, un, w, texels));
    }
    job->sampler.least_w = third_power(need + 2 * ZS_TEXTURE_GROUP_LOG2);
    job->sampler.fine = most > COARSE_LOG2;
    job->sub_log2 = ZS_TEXTURE_GROUP_LOG2;
}

/* Return the texture to draw job->tri with: t, or a copy whose palette an accelerator has lit. */
static const struct zs_texture *lit_texture(struct zs_job *job, const struct zs_texture *t)
{
    const struct zs_shader *shader = job->shader;
    job->sampler.unlit = !shader->light ||
                         (shader->n_varyings == 2 && job->tri->paint == ZS_TEXTURE_FULL_LIGHT);
    return !job->sampler.unlit && ZS_IF_FAST(job->fast) && job->fast->lit ? job->fast->lit(job, t)
                                                                          : t;
}

void zs_texture_start(struct zs_job *job)
{
    const struct zs_instance *in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_texture *t = lit_texture(job, in->material->texture);
    const uint32_t uv_bits = in->mesh->uv_bits;
    const int lit = job->shader->n_varyings == 3;
    const uint16_t *a[3];
    uint32_t change, least, light_range = 0, light[3];
    struct zs_coordinate c[2];
    zs_persp_attrs(job, a);
    job->sampler.texture = t;
    job->sampler.direct = 0;
    job->sampler.wide = t->clamp || !t->log2_w || !t->log2_h;
    for (int i = 0; i < 2; i++)
        zs_texture_coordinate(&c[i], a[0][i], a[1][i], a[2][i]);
    const int32_t texels = zs_texture_most(t, &c[0], &c[1], uv_bits);
    if (lit)
        light_range = zs_range32(a[1][2] - a[0][2], a[2][2] - a[0][2]);
    if (!zs_persp_slow(job, &change) ||
        !affine_enough(texels, light_range, change, job->r->view.key_slow)) {
        uint32_t w[3];
        zs_persp_w(job, w);
        change = zs_persp_change(w, &least);
        if (!affine_enough(texels, light_range, change, least)) {
            start_groups(job, a, c, uv_bits, texels, w);
            return;
        }
    }
    job->sub_log2 = ZS_AFFINE;
    job->sampler.direct = !job->sampler.wide;
    affine_planes(job, c, uv_bits);
    if (!lit)
        return;
    for (int k = 0; k < 3; k++)
        light[k] = (uint32_t)a[k][2] << 15;
    zs_persp_plane(&job->geom, light, ZS_PLANE_WIDE, &job->c[2]);
}

#define TEXTURE(vertex_, face_, check_, light_, n)                                                 \
    {                                                                                              \
        .vertex = vertex_, .face = face_, .start = zs_texture_start, .run = zs_texture_run,        \
        .check = check_, .light = light_, .n_varyings = n, .opaque = ZS_TEXTURED                   \
    }

const struct zs_shader zs_shade_texture = TEXTURE(zs_texture_vertex, 0, zs_texture_usable, 0,
                                                  ZS_VARYINGS_TEXTURE);
const struct zs_shader zs_shade_texture_flat = TEXTURE(zs_texture_vertex, zs_texture_lit_face,
                                                       zs_texture_usable, zs_texture_light,
                                                       ZS_VARYINGS_TEXTURE);
const struct zs_shader zs_shade_texture_smooth = TEXTURE(
    zs_texture_lit_vertex, 0, zs_texture_lit_usable, zs_texture_light, ZS_VARYINGS_TEXTURE_SMOOTH);
