/* Small textured triangles on cores whose registers hold 64 bits: set-up, one triangle of the list
 * after the other. What is small, and affine, is as in fast/small.h and fast/fast_texture.c. What
 * it is worth: fast/small64.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/pass.h"
#include "fast/small64.h"
#include "fast/texture64.h"
#include "shade/texture.h"

#if ZS_64

/* What is the same for the triangles of an instance in a strip. */
struct set {
    struct zs_small64_of small;
    const uint16_t *attr;
    uint32_t varyings, slow; /* slow: view.key_slow */
    uint32_t uv_bits, up[2]; /* up: log2 of the size that counts for the error */
    uint32_t bias[2];
    uint64_t bound; /* of the change of depth, times the size in texels 2^uv_bits */
    int32_t lit; /* 0: all texels are drawn as they are */
};

/* Return 0 if no triangle of the instance can be drawn here. */
static int begin(const struct zs_job *job, struct set *set, struct zs_texel_rows *w, int may_be_lit)
{
    const struct zs_renderer *r = job->r;
    const struct zs_texture *t = job->texture;
    if (!job->texel || t->clamp || !t->log2_w || !t->log2_h)
        return 0;
    zs_small64_begin(job, &set->small, &w->sides);
    set->small.limit = zs_minu32(set->small.limit, r->view.key_known);
    set->slow = r->view.key_slow;
    set->attr = r->attr;
    set->varyings = r->config.varyings;
    set->uv_bits = zs_instance_of(r, job->tri->instance)->mesh->uv_bits;
    set->bound = (uint64_t)(set->slow >> (ZS_SPAN_BOUND_LOG2 - 2)) << set->uv_bits;
    set->up[0] = zs_maxu32(t->log2_w, ZS_TEXTURE_FLOOR_LOG2);
    set->up[1] = zs_maxu32(t->log2_h, ZS_TEXTURE_FLOOR_LOG2);
    set->bias[0] = 1u << (32u - ZS_TEXTURE_BIAS_LOG2 - t->log2_w);
    set->bias[1] = 1u << (32u - ZS_TEXTURE_BIAS_LOG2 - t->log2_h);
    set->lit = may_be_lit;
    w->column = 64u - t->log2_w;
    w->scale = (uint32_t)t->log2_w + t->log2_h;
    w->mask = ((1u << t->log2_h) - 1u) << t->log2_w;
    return 1;
}

/* A coordinate at the vertices: of the top one, and differences from it. */
struct coordinate {
    int64_t a, d1, d2;
};

/* Return the greatest of the three less the least. */
ZS_ALWAYS_INLINE uint32_t coordinate(struct coordinate *out, uint32_t a, uint32_t b, uint32_t c)
{
    out->a = a;
    out->d1 = (int64_t)b - a;
    out->d2 = (int64_t)c - a;
    return zs_maxu32(zs_maxu32(a, b), c) - zs_minu32(zs_minu32(a, b), c);
}

/* Compute a coordinate's value at column 0 of the first row, and its gradients down and to the
 * right, 2^-32 repeats, the value modulo 2^32: as zs_texture_plane. Return not 0 if it is too
 * steep. */
ZS_ALWAYS_INLINE uint64_t plane(const struct zs_small64 *s, const struct coordinate *c,
                                int32_t shift, uint32_t uv_bits, uint32_t bias, uint64_t out[3])
{
    const int64_t half = (int64_t)1 << shift >> 1, rcp = s->rcp, most = (int64_t)1 << 31;
    /* |.| < 2^29.1, 2^61.1 */
    const int64_t gx = ((c->d1 * s->dy2 - c->d2 * s->dy1) * rcp + half) >> shift,
                  gy = ((c->d2 * s->dx1 - c->d1 * s->dx2) * rcp + half) >> shift;
    out[0] = ((uint64_t)c->a << (32u - uv_bits)) + bias +
             (uint64_t)((gy * s->off - gx * s->x + 128) >> 8);
    out[1] = (uint64_t)gy;
    out[2] = (uint64_t)gx;
    return ((uint64_t)(gx + most) | (uint64_t)(gy + most)) >> 32;
}

/* Set the light: that of the face, or gradients from the vertices. Return 0 if this path cannot
 * draw it. */
static ZS_NOINLINE int light(const struct zs_job *job, const struct zs_small64 *s,
                             const uint16_t *a, const uint16_t *b, const uint16_t *c,
                             struct zs_texel_rows *w)
{
    if (zs_small_face_light(job, w))
        return 1;
    const int32_t d1 = b[2] - a[2], d2 = c[2] - a[2]; /* |.| < 2^16 */
    if (!zs_texture_light_affine(zs_range32(d1, d2), s->change, job->r->view.key_slow))
        return 0;
    const int64_t nx = d1 * s->dy2 - d2 * s->dy1, ny = d1 * s->dx2 - d2 * s->dx1; /* |.| < 2^31 */
    const int64_t gx = zs_plane_quotient(nx * 32768, s->rcp, s->lz, ZS_PLANE_WIDE),
                  up = zs_plane_quotient(ny * 32768, s->rcp, s->lz, ZS_PLANE_WIDE);
    if (gx == ZS_TOO_STEEP || up == ZS_TOO_STEEP)
        return 0;
    const int64_t from = gx * s->x + up * s->off - 128; /* |.| < 2^46.1 */
    w->light = (((uint32_t)a[2] << 15) + (uint32_t)(-from >> 8)) * 2u + ZS_TEXTURE_LIGHT_HALF;
    w->light_right = (uint32_t)gx * 2u;
    w->light_down = 0u - (uint32_t)up * 2u;
    return 1;
}

/* Set up job->tri. */
ZS_ALWAYS_INLINE enum zs_small_outcome set_up(struct zs_job *job, const struct set *set,
                                              struct zs_small64 *s, struct zs_texel_rows *w)
{
    if (!zs_small64_look(&set->small, job->tri, s) || s->change > set->slow)
        return ZS_SMALL_NOT;
    const uint16_t *const v = job->tri->v;
    const uint16_t *const a = set->attr + v[0] * set->varyings,
                          *const b = set->attr + v[1] * set->varyings,
                          *const c = set->attr + v[2] * set->varyings;
    struct coordinate cu, cv;
    ZS_FORGET; /* from part to part *s is in memory */
    const uint32_t u = coordinate(&cu, a[0], b[0], c[0]), v_ = coordinate(&cv, a[1], b[1], c[1]);
    /* zs_texture_most, and zs_texture_affine but for where both sides are the same */
    const uint32_t both = (u | 1u) << set->up[0] | (v_ | 1u) << set->up[1];
    if ((u | v_) >> 14 || (uint64_t)s->change << (32 - zs_clz32(both)) >= set->bound ||
        !zs_small64_keys(s))
        return ZS_SMALL_NOT;
    ZS_FORGET;
    const enum zs_small_outcome outcome = zs_small64_place(job, &set->small, s);
    if (outcome != ZS_SMALL_ROWS)
        return outcome;
    const int32_t shift = 23 + (int32_t)set->uv_bits - s->lz; /* 5 .. */
    const uint64_t key[3] = { (uint64_t)zs_small64_key(s), 0u - (uint64_t)s->up, (uint64_t)s->gx };
    ZS_FORGET;
    uint64_t pu[3], pv[3], bad = plane(s, &cu, shift, set->uv_bits, set->bias[0], pu);
    w->at[0] = (pu[0] << 32) + key[0];
    w->down[0] = (pu[1] << 32) + key[1];
    w->right[0] = (pu[2] << 32) + key[2];
    ZS_FORGET;
    bad |= plane(s, &cv, shift, set->uv_bits, set->bias[1], pv);
    if (bad)
        return ZS_SMALL_NOT;
    w->at[1] = pv[0] << w->scale;
    w->down[1] = pv[1] << w->scale;
    w->right[1] = pv[2] << w->scale;
    if (set->lit && !light(job, s, a, b, c, w))
        return ZS_SMALL_NOT;
    ZS_FORGET;
    zs_small64_sides(job, s, &w->sides);
    return ZS_SMALL_ROWS;
}

ZS_ALWAYS_INLINE int draw(struct zs_job *job, int may_be_lit)
{
    struct set set;
    struct zs_small64 s;
    struct zs_texel_rows w;
    const struct zs_tri *drawn = 0;
    if (!begin(job, &set, &w, may_be_lit))
        return 0;
    ZS_IN_MEMORY(&s);
    do {
        const struct zs_texture *t = job->texture;
        if (may_be_lit) {
            job->sampler.unlit = job->shader->n_varyings == 2 &&
                                 job->tri->paint == ZS_TEXTURE_FULL_LIGHT;
            if (!job->sampler.unlit && job->fast->lit)
                t = job->fast->lit(job, t); /* of the same format */
            set.lit = !job->sampler.unlit;
        }
        const enum zs_small_outcome outcome = set_up(job, &set, &s, &w);
        if (outcome == ZS_SMALL_NOT)
            return zs_small_declined(job, drawn);
        if (outcome == ZS_SMALL_ROWS)
            (may_be_lit && set.lit ? job->texel->small_lit : job->texel->small)(job, t, &w);
        drawn = job->tri;
    } while (zs_small64_next(job));
    return 1;
}

int zs_texture64_draw(struct zs_job *job)
{
    return draw(job, 0);
}

int zs_texture64_draw_lit(struct zs_job *job)
{
    return draw(job, 1);
}

#endif
