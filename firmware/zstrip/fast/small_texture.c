/* Small triangles with a texture that is repeated, affine by their keys alone: set up in one go (small.h), and drawn by their
 * texel format, unlit or lit. What is found here is what shade_texture.c would find, bit for bit.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade/texture.h"
#include "fast/small.h"

#if ZS_LEAN
#elif ZS_DIVIDES

/* v * rcp + more, rcp >= 2^31: one signed product, whose sum begins with what it lacks. */
static inline int64_t times_rcp(int32_t v, uint32_t rcp, uint32_t more)
{
    return zs_mul_ss(v, (int32_t)(rcp - 0x80000000u) - 0x7fffffff - 1) + ((int64_t)v * ((int64_t)1 << 32) + more);
}

/* zs_texture_gradient, its usual case in line. *bad: not 0 where it is too steep. */
ZS_ALWAYS_INLINE uint32_t gradient(uint32_t rcp, int32_t n, int32_t shift, int32_t *bad)
{
    if (shift > 31) {
        int ok = 1;
        const uint32_t g = zs_texture_gradient(rcp, n, shift, &ok);
        *bad |= !ok;
        return g;
    }
    const int64_t q = times_rcp(n, rcp, 1u << (shift - 1));
    const int32_t hi = (int32_t)(q >> 32);
    const uint32_t low = (uint32_t)hi << (32 - shift) | (uint32_t)q >> shift;
    *bad |= hi >> shift ^ (int32_t)low >> 31;
    return low;
}

/* A coordinate: of the first corner, 2^-uv_bits repeats, unsigned; what the others have more; the largest above the least. */
struct coordinate {
    int32_t a, d1, d2;
    uint32_t range;
};

ZS_ALWAYS_INLINE void coordinate(struct coordinate *out, int32_t a, int32_t b, int32_t c)
{
    const int32_t d1 = b - a, d2 = c - a;
    out->a = a;
    out->d1 = d1;
    out->d2 = d2;
    out->range = (uint32_t)(zs_max32(zs_max32(d1, d2), 0) - zs_min32(zs_min32(d1, d2), 0));
}

/* Its plane: at column 0 of the first row, a pixel, a row. Modulo one repeat: the 32768 that make coordinates unsigned are
 * whole repeats. Return not 0: too steep. */
ZS_ALWAYS_INLINE int32_t plane(const struct zs_small *s, const struct coordinate *c, int32_t shift, uint32_t uv_bits, uint32_t log2,
                           struct zs_texel_rows *w, int k)
{
    int32_t bad = 0;
    const uint32_t gx = gradient(s->rcp, c->d1 * s->dy2 - c->d2 * s->dy1, shift, &bad);
    const uint32_t gy = gradient(s->rcp, c->d2 * s->dx1 - c->d1 * s->dx2, shift, &bad);
    const int64_t from = zs_mul_ss((int32_t)gy, s->off) - zs_mul_ss((int32_t)gx, s->x) + 128; /* |.| < 2^46.2 */
    w->right[k] = gx;
    w->down[k] = gy;
    w->at[k] = ((uint32_t)c->a << 1 << (31u - uv_bits)) + (1u << (32u - ZS_TEXTURE_BIAS_LOG2 - log2)) + (uint32_t)(from >> 8);
    return bad;
}

/* The light: the face's, or the plane of the corners'. Return 0: it is not for this way. */
static ZS_NOINLINE int light(const struct zs_job *job, const struct zs_small *s, uint32_t change, const uint16_t *a, const uint16_t *b,
                             const uint16_t *c, struct zs_texel_rows *w)
{
    if (job->shader->n_attrs == 2) {
        w->light = ((uint32_t)job->tri->paint << 16) + ZS_TEXTURE_LIGHT_HALF;
        w->light_right = w->light_down = 0;
        return 1;
    }
    const int32_t d1 = b[2] - a[2], d2 = c[2] - a[2]; /* |.| < 2^16 */
    const uint32_t range = (uint32_t)(zs_max32(zs_max32(d1, d2), 0) - zs_min32(zs_min32(d1, d2), 0));
    if (!zs_texture_light_affine(range, change, job->r->view.key_slow))
        return 0;
    const int64_t nx = zs_mul_ss(d1, s->dy2) - zs_mul_ss(d2, s->dy1), ny = zs_mul_ss(d1, s->dx2) - zs_mul_ss(d2, s->dx1);
    const int32_t gx = zs_plane_quotient(nx * 32768, s->rcp, s->shift, ZS_PLANE_WIDE); /* n: |.| < 2^31 */
    const int32_t up = zs_plane_quotient(ny * 32768, s->rcp, s->shift, ZS_PLANE_WIDE);
    if (gx == ZS_TOO_STEEP || up == ZS_TOO_STEEP)
        return 0;
    const int64_t from = zs_mul_ss(gx, s->x) + zs_mul_ss(up, s->off) - 128; /* |.| < 2^46.1 */
    w->light = (((uint32_t)a[2] << 15) + (uint32_t)(-from >> 8)) * 2u + ZS_TEXTURE_LIGHT_HALF;
    w->light_right = (uint32_t)gx * 2u;
    w->light_down = 0u - (uint32_t)up * 2u;
    return 1;
}

ZS_ALWAYS_INLINE int draw(struct zs_job *job, int may_be_lit)
{
    struct zs_small s;
    struct zs_texel_rows w;
    const enum zs_small_fate fate = zs_small_look(job, &s);
    if (fate != ZS_SMALL_ROWS)
        return (int)fate;

    const struct zs_renderer *r = job->r;
    const struct zs_view *view = &r->view;
    const uint32_t nearest = zs_maxu32(zs_maxu32(s.key_a, s.key_b), s.key_c), farthest = zs_minu32(zs_minu32(s.key_a, s.key_b), s.key_c);
    const uint32_t change = nearest - farthest; /* of d = piece_base - key */
    if (view->piece_base - farthest > view->key_known || change > view->key_slow)
        return 0;
    const struct zs_instance *in = &r->scene->instance[job->tri->instance];
    const struct zs_texture *t = in->material->texture;
    const uint32_t log2_w = t->log2_w, log2_h = t->log2_h, uv_bits = in->mesh->uv_bits, attrs = r->config.attrs;
    if (t->clamp || !log2_w || !log2_h)
        return 0;
    const uint16_t *const attr = r->attr, *v = job->tri->v;
    const uint16_t *const a = attr + v[0] * attrs, *const b = attr + v[1] * attrs, *const c = attr + v[2] * attrs;
    struct coordinate cu, cv;
    coordinate(&cu, a[0], b[0], c[0]);
    coordinate(&cv, a[1], b[1], c[1]);
    if ((cu.range | cv.range) >> 14)
        return 0;
    const int32_t texels = zs_max32((int32_t)zs_maxu32(log2_w, ZS_TEXTURE_FLOOR_LOG2) - zs_clz32(cu.range | 1u),
                                    (int32_t)zs_maxu32(log2_h, ZS_TEXTURE_FLOOR_LOG2) - zs_clz32(cv.range | 1u));
    if (!zs_texture_affine(texels + 32 - (int32_t)uv_bits, change, view->key_slow))
        return 0;
    if (!zs_small_keys(&s, &w.sides))
        return 0;
    const int32_t shift = 23 + (int32_t)uv_bits - s.shift;
    if (shift < 1 || (plane(&s, &cu, shift, uv_bits, log2_w, &w, 1) | plane(&s, &cv, shift, uv_bits, log2_h, &w, 2)))
        return 0;
    w.at[0] = w.sides.key;
    w.down[0] = w.sides.down[1];
    w.right[0] = w.sides.gx;
    w.width = 1u << log2_w;
    w.column = 32u - log2_w;
    w.row = 32u - log2_h;
    const struct zs_texel *texel = t->format;
    if (may_be_lit) {
        t = zs_texture_lit(job, t); /* of the same format */
        if (!job->sampler.unlit) {
            if (!light(job, &s, change, a, b, c, &w))
                return 0;
            zs_small_sides(job, &s, &w.sides);
            texel->small_lit(job, t, &w);
            return 1;
        }
    }
    zs_small_sides(job, &s, &w.sides);
    texel->small(job, t, &w);
    return 1;
}

ZS_IN_ORDER int zs_small_texture(struct zs_job *job)
{
    return draw(job, 0);
}

ZS_IN_ORDER int zs_small_texture_lit(struct zs_job *job)
{
    return draw(job, 1);
}

#else

int zs_small_texture(struct zs_job *job) /* not called, nor is the other */
{
    (void)job;
    return 0;
}

int zs_small_texture_lit(struct zs_job *job)
{
    (void)job;
    return 0;
}

#endif
