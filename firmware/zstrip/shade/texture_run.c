/* Textured shading: colours of visible pixels. shade/texture.c explains how coordinates are
 * interpolated.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "zs_shader.h"
#include "shade/texture.h"

#define GROUP (1 << ZS_TEXTURE_GROUP_LOG2) /* pixels */
#define FEW 2 /* so few pixels are drawn one by one, even if an accelerator has a loop for more */

/* Return v * 2^shift in 64 bits, floor. |shift| < 32 */
static inline uint64_t shifted(int32_t v, int32_t shift)
{
    if (shift <= 0)
        return (uint64_t)(int64_t)(v >> -shift);
    return (uint64_t)(uint32_t)(v >> (32 - shift)) << 32 | (uint32_t)v << shift;
}

/* ---- Runs ------------------------------------------------------------------------------------ */

/* Clamp a coordinate, q32_32, to [0, 1). */
static uint32_t held(uint64_t t)
{
    const int32_t beyond = (int32_t)(t >> 32);
    return beyond ? ~(uint32_t)(beyond >> 31) : (uint32_t)t;
}

/* Return u (k = 0) or v (k = 1) as zs_walk takes it, from q32_32, for a texture that is clamped, or
 * one texel wide or high. */
static uint32_t place_in(const struct zs_texture *t, int k, uint64_t at)
{
    if ((k ? t->log2_h : t->log2_w) == 0)
        return 0;
    return t->clamp >> k & 1 ? held(at) : (uint32_t)at;
}

/* fetch() for clamped textures. Coordinates are q32_32, because values outside [0, 1) matter. A run
 * that stays inside is fetched as a whole, others pixel by pixel. As in fetch(), c is the
 * coordinate at the begin of a group or scanline, and the run begins `skip` pixels right of it:
 * shifts discard bits, and the discarded bits must not depend on where a run begins. A step loses
 * 2^-32 repeats, 12,000 steps 2^-18. */
ZS_IN_ORDER static ZS_NOINLINE void fetch_wide(const struct zs_sampler *s, uint16_t *out, int32_t n,
                                               const uint32_t c[2], const int32_t step[2],
                                               int32_t skip)
{
    const struct zs_texture *t = s->texture;
    const struct zs_texel *texel = t->format;
    uint64_t at[2], by[2], beyond = 0;
    for (int k = 0; k < 2; k++) {
        by[k] = shifted(step[k], s->shift[k]);
        at[k] = s->base[k] + shifted((int32_t)c[k], s->shift[k]) + by[k] * (uint64_t)(uint32_t)skip;
        if (t->clamp >> k & 1)
            beyond |= (at[k] | (at[k] + by[k] * (uint64_t)(uint32_t)(n - 1))) >> 32;
    }
    const int single = beyond || t->log2_w == 0 || t->log2_h == 0;
    struct zs_walk walk = { (uint32_t)at[0], (uint32_t)at[1], (uint32_t)by[0], (uint32_t)by[1] };
    if (!single)
        texel->fetch(t, out, n, &walk);
    for (; single && n > 0; n--, out++) {
        walk.u = place_in(t, 0, at[0]);
        walk.v = place_in(t, 1, at[1]);
        texel->fetch(t, out, 1, &walk);
        at[0] += by[0];
        at[1] += by[1];
    }
}

/* Shift left, or right if shift is negative. */
static inline uint32_t turned(uint32_t c, int32_t shift)
{
    return shift >= 0 ? c << shift : (uint32_t)((int32_t)c >> -shift);
}

/* Fetch n texels, beginning `skip` pixels right of the pixel with coordinates c. c and step are in
 * 2^-31 of the triangle's span. */
static inline void fetch(const struct zs_job *job, uint16_t *out, int32_t n, const uint32_t c[2],
                         const int32_t step[2], int32_t skip)
{
    const struct zs_sampler *s = &job->sampler;
    if (ZS_FOR_SIZE || s->wide) { /* in 64 bits; modulo one repeat it is the same */
        fetch_wide(s, out, n, c, step, skip);
        return;
    }
    const struct zs_texel *texel = s->texture->format;
    const uint32_t du = turned((uint32_t)step[0], s->shift[0]),
                   dv = turned((uint32_t)step[1], s->shift[1]);
    const struct zs_walk walk = {
        /* modulo one repeat */
        (uint32_t)s->base[0] + turned(c[0], s->shift[0]) + zs_wrap_mul(du, skip),
        (uint32_t)s->base[1] + turned(c[1], s->shift[1]) + zs_wrap_mul(dv, skip), du, dv
    };
    texel->fetch(s->texture, out, n, &walk);
}

/* Multiply n pixels by light, uq1_31, which changes by step from pixel to pixel. */
void zs_texture_light(uint16_t *out, int32_t n, uint32_t l, uint32_t step)
{
    l += ZS_TEXTURE_LIGHT_HALF;
    for (uint16_t *const end = out + n; out != end; out++, l += step)
        *out = zs_wire16((uint16_t)zs_texture_shine(zs_wire16(*out), l >> ZS_TEXTURE_LIGHT_SHIFT));
}

/* Compute the attributes at a covered pixel by division, in 2^-31 of their span. Return its w. */
ZS_IN_ORDER static uint32_t divide_at(const struct zs_job *job, int32_t i, int32_t row, int n,
                                      uint32_t out[3])
{
    uint32_t w;
    int32_t lz;
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    out[0] = zs_persp_over(zs_plane_at(&job->c[0], i, row), w, rcp, lz);
    out[1] = zs_persp_over(zs_plane_at(&job->c[1], i, row), w, rcp, lz);
    if (n == 3)
        out[2] = zs_persp_over(zs_plane_at(&job->c[2], i, row), w, rcp, lz);
    return w;
}

static void run_affine(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t n)
{
    const struct zs_texture *t = job->sampler.texture;
    const struct zs_texel *texel = t->format;
    uint16_t *out = job->color + row->at + r0;
    const int32_t from = job->sampler.direct ? r0 : row->x0;
    const uint32_t u = zs_plane_at(&job->c[0], from, row->y),
                   v = zs_plane_at(&job->c[1], from, row->y);
    const uint32_t du = job->c[0].gx,
                   dv = job->c[1].gx; /* exceeds 31 bits only if a run is a single pixel */
    if (!job->sampler.direct) {
        const uint32_t c[2] = { u, v };
        const int32_t step[2] = { (int32_t)du, (int32_t)dv };
        fetch_wide(&job->sampler, out, n, c, step, r0 - from);
    } else {
        const struct zs_walk walk = { u, v, du, dv };
        texel->fetch(t, out, n, &walk);
    }
    if (job->shader->n_varyings == 3)
        zs_texture_lighten(job, out, n, zs_plane_at(&job->c[2], r0, row->y), (int32_t)job->c[2].gx);
    else
        zs_texture_lighten(job, out, n, 0, 0);
}

/* ---- Pixel by pixel -------------------------------------------------------------------------- */

/* Compute attribute k at a pixel. `up` is the shift that normalises w; rcp is the reciprocal, 15
 * bits, of w shifted like that. */
static uint32_t coarse_at(const struct zs_job *job, int k, int32_t i, int32_t row, int32_t up,
                          uint32_t rcp)
{
    return zs_texture_coarse((zs_plane_at(&job->c[k], i, row) << up) + 0x8000u, rcp);
}

ZS_ALWAYS_INLINE uint32_t place_at(const struct zs_sampler *s, int k, uint32_t over)
{
    if (s->wide)
        return place_in(s->texture, k, s->base[k] + shifted((int32_t)over, s->shift[k] + 1));
    return (uint32_t)s->base[k] + turned(over, s->shift[k] + 1);
}

/* ---- Groups ---------------------------------------------------------------------------------- */

/* Return the change for each pixel, all / n, where n is the length of a part. |all| < 2^31 */
static inline int32_t step_of(int32_t all, int32_t n)
{
    return n == GROUP ? all >> ZS_TEXTURE_GROUP_LOG2
                      : (int32_t)(zs_mul_su(all, zs_one_over(n)) >> 32);
}

/* Draw pixels [i0, i1) of an affine part of the scanline, which goes from the pixel `from` to the
 * covered pixel `to`. */
ZS_IN_ORDER static ZS_NOINLINE void run_group(struct zs_job *job, const struct zs_row *row,
                                              int32_t from, int32_t to, int32_t i0, int32_t i1)
{
    const int n = job->shader->n_varyings;
    uint16_t *out = job->color + row->at + i0;
    uint32_t c[3] = { 0 }, next[3];
    int32_t step[3] = { 0 };
    divide_at(job, from, row->y, n, c);
    if (to > from) {
        divide_at(job, to, row->y, n, next);
        for (int k = 0; k < n; k++)
            step[k] = step_of((int32_t)(next[k] - c[k]), to - from);
    }
    fetch(job, out, i1 - i0, c, step, i0 - from);
    zs_texture_lighten(job, out, i1 - i0, c[2] + zs_wrap_mul((uint32_t)step[2], i0 - from),
                       step[2]);
}

ZS_IN_ORDER ZS_NOINLINE void zs_texture_pixel(struct zs_job *job, const struct zs_row *of,
                                              int32_t i)
{
    const uint32_t w = zs_plane_at(&job->w, i, of->y);
    if (w == 0 || w >> 31 || job->sampler.fine) {
        run_group(job, of, i, i, i, i + 1);
        return;
    }
    uint16_t *const out = job->color + of->at + i;
    const int32_t row = of->y;
    const struct zs_sampler *s = &job->sampler;
    const struct zs_texture *t = s->texture;
    const struct zs_shader *shader = job->shader;
    const int32_t up = zs_clz32(w) - 1;
    const uint32_t rcp = zs_recip15(w << up);
    const uint32_t u = place_at(s, 0, coarse_at(job, 0, i, row, up, rcp)),
                   v = place_at(s, 1, coarse_at(job, 1, i, row, up, rcp));
    if (ZS_IF_FAST(job->gather)) {
        const uint32_t at = (v >> zs_texture_cut(t->log2_h) << t->log2_w) +
                            (u >> zs_texture_cut(t->log2_w));
        job->gather(t, out, 1, &at);
    } else {
        const struct zs_walk walk = { u, v, 0, 0 };
        t->format->fetch(t, out, 1, &walk);
    }
    if (shader->n_varyings == 3) { /* < 2^32: light is below LIGHT_MAX */
        const int32_t level = (int32_t)coarse_at(job, 2, i, row, up, rcp);
        shader->light(out, 1, level < 0 ? 0u : (uint32_t)level << 2, 0);
    } else if (!s->unlit) {
        shader->light(out, 1, (uint32_t)job->tri->paint << 16, 0);
    }
}

static void run_groups(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    const struct zs_texture *const t = job->sampler.texture;
    const int down = (int32_t)job->w.gx < 0;
    int32_t from = row->x0 + ((r0 - row->x0) & -GROUP);
    zs_divided_fn *const divided =
        ZS_IF_FAST(job->gather) && !job->sampler.fine && t->log2_w && t->log2_h ? job->r->divided
                                                                                : 0;
    for (; from < r1; from += GROUP) {
        const int32_t to = zs_min32(from + GROUP, row->x1 - 1); /* covered */
        int32_t i0 = zs_max32(from, r0);
        const int32_t i1 = zs_min32(from + GROUP, r1);
        if (zs_persp_w_at(job, down ? to : from, row->y) >= job->sampler.least_w)
            run_group(job, row, from, to, i0, i1);
        else if (divided && i1 - i0 > FEW)
            divided(job, row, i0, i1);
        else
            for (; i0 < i1; i0++)
                zs_texture_pixel(job, row, i0);
    }
}

void zs_texture_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    if (job->sub_log2 == ZS_AFFINE)
        run_affine(job, row, r0, r1 - r0);
    else
        run_groups(job, row, r0, r1);
}
