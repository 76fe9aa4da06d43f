/* Textured triangles: a path for small triangles, lighting of a whole palette at once, and a loop
 * for the perspective division of several pixels.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "core/pass.h"
#include "core/plane.h"
#include "zs_shader.h"
#include "fast/lanes.h"
#include "fast/less.h"
#include "fast/set_up.h"
#include "fast/small.h"
#include "fast/texture64.h"
#include "fast/texture_v7m.h"
#include "shade/texture.h"
#include "zs_fast.h"

/* ---- Palettes -------------------------------------------------------------------------------- */

/* Return a copy of t with a lit palette, if t has a palette that is small enough; else t. */
static ZS_NOINLINE const struct zs_texture *palette_lit(struct zs_job *job,
                                                        const struct zs_texture *t)
{
    const struct zs_shader *shader = job->shader;
    struct zs_lit *lit = &job->r->lit;
    const uint16_t level = job->tri->paint;
    if (shader->n_varyings == 3 || !t->format->colors_max || t->n_colors > ZS_LIT_COLORS)
        return t;
    job->sampler.unlit = 1;
    if (lit->of != t || lit->level != level) {
        lit->of = t;
        lit->level = level;
        lit->texture = *t;
        lit->texture.palette = lit->color;
        for (uint32_t i = 0; i < t->n_colors; i++)
            lit->color[i] = zs_wire16(t->palette[i]);
        shader->light(lit->color, t->n_colors, (uint32_t)level << 16, 0);
        for (uint32_t i = 0; i < t->n_colors; i++)
            lit->color[i] = zs_wire16(lit->color[i]);
    }
    return &lit->texture;
}

#if ZS_64

#define draw_unlit zs_texture64_draw
#define draw_lit zs_texture64_draw_lit

#else

/* ---- Small triangles -------------------------------------------------------------------------
 *
 * For repeated textures on triangles whose keys alone prove that affine coordinates are exact
 * enough. The results equal those of shade/texture.c, bit for bit. */

/* Compute coordinate k's plane from column 0 of the first row. Return not 0 if it is too steep. */
ZS_ALWAYS_INLINE int32_t plane(const struct zs_small *s, const struct zs_coordinate *c,
                               int32_t shift, uint32_t uv_bits, uint32_t log2,
                               struct zs_texel_rows *w, int k)
{
    struct zs_plane p;
    const struct zs_geom g = { .dx = { s->dx1, s->dx2 }, .dy = { s->dy1, s->dy2 }, .rcp = s->rcp };
    const int32_t bad = zs_texture_plane(&p, c, &g, shift, -s->x, s->off, uv_bits, log2);
    w->right[k] = p.gx;
    w->down[k] = p.gy;
    w->at[k] = p.base;
    return bad;
}

/* Set the light: that of the face, or gradients from the vertices. Return 0 if this path cannot
 * draw it. */
static ZS_NOINLINE int light(const struct zs_job *job, const struct zs_small *s, uint32_t change,
                             const uint16_t *a, const uint16_t *b, const uint16_t *c,
                             struct zs_texel_rows *w)
{
    if (zs_small_face_light(job, w))
        return 1;
    const int32_t d1 = b[2] - a[2], d2 = c[2] - a[2]; /* |.| < 2^16 */
    if (!zs_texture_light_affine(zs_range32(d1, d2), change, job->r->view.key_slow))
        return 0;
    const int64_t nx = zs_mul_ss(d1, s->dy2) - zs_mul_ss(d2, s->dy1),
                  ny = zs_mul_ss(d1, s->dx2) - zs_mul_ss(d2, s->dx1);
    const int32_t gx = zs_plane_quotient(nx * 32768, s->rcp, s->shift,
                                         ZS_PLANE_WIDE); /* n: |.| < 2^31 */
    const int32_t up = zs_plane_quotient(ny * 32768, s->rcp, s->shift, ZS_PLANE_WIDE);
    if (gx == ZS_TOO_STEEP || up == ZS_TOO_STEEP)
        return 0;
    const int64_t from = zs_mul_ss(gx, s->x) + zs_mul_ss(up, s->off) - 128; /* |.| < 2^46.1 */
    w->light = (((uint32_t)a[2] << 15) + (uint32_t)(-from >> 8)) * 2u + ZS_TEXTURE_LIGHT_HALF;
    w->light_right = (uint32_t)gx * 2u;
    w->light_down = 0u - (uint32_t)up * 2u;
    return 1;
}

#if ZS_V7M

/* zs_fast.shine */
static int shine(struct zs_job *job, struct zs_texture_hand *h)
{
    const struct zs_texture *t = job->texture;
    job->tri = h->tri;
    job->sampler.unlit = job->shader->n_varyings == 2 && job->tri->paint == ZS_TEXTURE_FULL_LIGHT;
    if (!job->sampler.unlit)
        t = palette_lit(job, t); /* of the same format */
    h->of.palette = t->palette;
    if (job->sampler.unlit)
        return 2;
    h->w.sides.down[0] = h->of.pitch;
    h->w.width = h->of.width;
    h->w.column = h->of.column;
    h->w.row = h->of.row & 255u;
    const struct zs_small s = { .dx1 = h->dx1,
                                .dx2 = h->dx2,
                                .dy1 = h->dy1,
                                .dy2 = h->dy2,
                                .rcp = h->rcp,
                                .shift = 22 - h->down,
                                .x = h->x,
                                .off = h->off };
    const uint16_t *const v = job->tri->v;
    const uint32_t varyings = job->r->config.varyings;
    if (!light(job, &s, h->change, h->of.attr + v[0] * varyings,
               h->of.attr + v[1] * varyings, h->of.attr + v[2] * varyings, &h->w))
        return 0;
    job->texel->small_lit(job, t, &h->w);
    return 1;
}

#define draw_unlit zs_texture_v7m
#define draw_lit zs_texture_v7m
#define SHINE .shine = shine,

#else

ZS_ALWAYS_INLINE int draw(struct zs_job *job, int may_be_lit)
{
    struct zs_small s;
    struct zs_texel_rows w;
    if (!job->texel || !zs_small_look(job, &s))
        return 0;
    const struct zs_renderer *r = job->r;
    const struct zs_view *view = &r->view;
    const int32_t beyond = zs_max32(zs_max32(s.dd1, s.dd2), 0);
    const uint32_t change = (uint32_t)beyond - (uint32_t)zs_min32(zs_min32(s.dd1, s.dd2), 0);
    if (s.a->d + (uint32_t)beyond > view->key_known || change > view->key_slow)
        return 0;
    const struct zs_instance *in = zs_instance_of(r, job->tri->instance);
    const struct zs_texture *t = job->texture;
    const uint32_t log2_w = t->log2_w, log2_h = t->log2_h, uv_bits = in->mesh->uv_bits,
                   varyings = r->config.varyings;
    if (t->clamp || !log2_w || !log2_h)
        return 0;
    const uint16_t *const attr = r->attr, *v = job->tri->v;
    const uint16_t *const a = attr + v[0] * varyings, *const b = attr + v[1] * varyings,
                          *const c = attr + v[2] * varyings;
    struct zs_coordinate cu, cv;
    zs_texture_coordinate(&cu, a[0], b[0], c[0]);
    zs_texture_coordinate(&cv, a[1], b[1], c[1]);
    if ((cu.range | cv.range) >> 14 ||
        !zs_texture_affine(zs_texture_most(t, &cu, &cv, uv_bits), change, view->key_slow) ||
        !zs_small_keys(&s))
        return 0;
    const enum zs_small_outcome outcome = zs_small_place(job, &s);
    if (outcome != ZS_SMALL_ROWS)
        return (int)outcome;
    const int32_t shift = 23 + (int32_t)uv_bits - s.shift;
    ZS_ANEW(s.x); /* so that -x is one instruction */
    if (shift < 1 || (plane(&s, &cu, shift, uv_bits, log2_w, &w, 1) |
                      plane(&s, &cv, shift, uv_bits, log2_h, &w, 2)))
        return 0;
    w.at[0] = s.key;
    w.down[0] = (uint32_t)s.gy;
    w.right[0] = (uint32_t)s.gx;
    w.width = 1u << log2_w;
    w.column = 32u - log2_w;
    w.row = 32u - log2_h;
    const struct zs_fast_texel *texel = job->texel;
    if (may_be_lit) {
        job->sampler.unlit = job->shader->n_varyings == 2 &&
                             job->tri->paint == ZS_TEXTURE_FULL_LIGHT;
        if (!job->sampler.unlit)
            t = palette_lit(job, t); /* of the same format */
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

ZS_IN_ORDER static int draw_unlit(struct zs_job *job)
{
    return draw(job, 0);
}

ZS_IN_ORDER static int draw_lit(struct zs_job *job)
{
    return draw(job, 1);
}

#endif
#endif

/* ---- Perspective division, several pixels at a time ------------------------------------------ */

#define PIECE 16 /* most pixels at a time */
#define FEW 2    /* so few pixels are faster one by one */

/* Compute n reciprocals, 15 bits, of w, which stays in [2^30, 2^31). */
static ZS_NOINLINE void reciprocals(uint32_t *at, int32_t n, uint32_t w, uint32_t step)
{
    for (uint32_t *end = at + n; at != end; at++, w += step) {
        ZS_HIGH_REGISTER(end);
        ZS_HIGH_REGISTER(step);
        *at = zs_recip15(w);
    }
}

/* A texture coordinate times w along a run, and its conversion to a column or row of the texture.
 */
struct places {
    uint32_t c, step;
    uint32_t base;      /* modulo one repeat */
    int32_t left, down; /* shifts that make 2^-32 repeats of 30 bits; one is 0 */
    uint32_t cut;       /* shift from uq0_32 repeats to the column or row */
};

/* Set up attribute k of a job from pixel i on. up: the shift that brings w to 31 bits. */
static void places_of(struct places *p, const struct zs_job *job, int k, int32_t i, int32_t row,
                      int32_t up)
{
    const struct zs_sampler *s = &job->sampler;
    const int32_t turn = s->shift[k] + 1;
    p->c = (zs_plane_at(&job->c[k], i, row) << up) + 0x8000u;
    p->step = job->c[k].gx << up;
    p->base = (uint32_t)s->base[k];
    p->left = zs_max32(turn, 0);
    p->down = zs_max32(-turn, 0);
    p->cut = 32u - (k ? s->texture->log2_h : s->texture->log2_w);
}

/* Replace the reciprocals in at[] by texel indices. Called twice: for v, with log2_w = 0, it stores
 * the row above the reciprocal's 16 bits; for u, it combines row and column to the index. */
ZS_IN_ORDER static ZS_NOINLINE void places(uint32_t *at, int32_t n, const struct places *p,
                                           uint32_t log2_w)
{
    const int32_t left = p->left, down = p->down;
    uint32_t c = p->c, base = p->base, step = p->step, cut = p->cut;
    for (uint32_t *end = at + n; at != end; at++, c += step) {
        ZS_HIGH_REGISTER(end);
        ZS_HIGH_REGISTER(step);
        ZS_HIGH_REGISTER(base);
        const uint32_t turned = (uint32_t)((int32_t)(zs_texture_coarse(c, *at & 65535u) << left) >>
                                           down);
        const uint32_t place = (base + turned) >> cut;
        *at = log2_w ? (*at >> 16 << log2_w) + place : place << 16 | *at;
    }
}

/* places() for a coordinate that is clamped: whole repeats, beyond those of its base, say on which
 * side of the texture it is. Rooms and boxes with such textures take 20 to 34 % less on the M3, 15
 * to 30 % on the M0; 240 bytes. */
ZS_IN_ORDER static ZS_NOINLINE void places_held(uint32_t *at, int32_t n, const struct places *p,
                                                uint32_t log2_w, int32_t beyond)
{
    const int32_t left = p->left, down = p->down, whole = zs_min32(32 - left, 31);
    uint32_t c = p->c, base = p->base, step = p->step, cut = p->cut;
    for (uint32_t *end = at + n; at != end; at++, c += step) {
        ZS_HIGH_REGISTER(end);
        ZS_HIGH_REGISTER(step);
        ZS_HIGH_REGISTER(base);
        const int32_t over = (int32_t)zs_texture_coarse(c, *at & 65535u);
        uint32_t place = base + (uint32_t)((int32_t)((uint32_t)over << left) >> down);
        const int32_t out = (over >> whole) + beyond + (place < base);
        if (out)
            place = ~(uint32_t)(out >> 31);
        place >>= cut;
        *at = log2_w ? (*at >> 16 << log2_w) + place : place << 16 | *at;
    }
}

/* Compute the light at n pixels, as zs_texture_shine takes it, which is interpolated from the
 * vertices. at[]: reciprocals. */
static ZS_NOINLINE void levels_of(uint16_t *level, const uint32_t *at, int32_t n, uint32_t c,
                                  uint32_t step)
{
    for (const uint32_t *const end = at + n; at != end; at++, level++, c += step) {
        const int32_t l = (int32_t)zs_texture_coarse(c, *at); /* < 2^30: below LIGHT_MAX */
        *level = l < 0 ? 0
                       : (uint16_t)(((uint32_t)l + (ZS_TEXTURE_LIGHT_HALF >> 2)) >>
                                    (ZS_TEXTURE_LIGHT_SHIFT - 2));
    }
}

/* Draw n <= PIECE pixels from i on, on all of which w has lz leading zeros, 1 .. 31. */
static ZS_NOINLINE void divide_octave(struct zs_job *job, uint16_t *out, int32_t i, int32_t n,
                                      int32_t row, int32_t lz)
{
    const struct zs_texture *t = job->sampler.texture;
    const int32_t up = lz - 1;
    const int lit = job->shader->n_varyings == 3;
    struct places p;
    uint32_t at[PIECE];
    uint16_t level[PIECE];
    reciprocals(at, n, zs_plane_at(&job->w, i, row) << up, job->w.gx << up);
    if (lit)
        levels_of(level, at, n, (zs_plane_at(&job->c[2], i, row) << up) + 0x8000u,
                  job->c[2].gx << up);
    for (int k = 1; k >= 0; k--) {
        const uint32_t log2_w = k ? 0 : t->log2_w;
        places_of(&p, job, k, i, row, up);
        if (ZS_SELDOM(t->clamp >> k & 1))
            places_held(at, n, &p, log2_w, (int32_t)(job->sampler.base[k] >> 32));
        else
            places(at, n, &p, log2_w);
    }
    job->gather(t, out, n, at);
    if (!lit) {
        zs_texture_lighten(job, out, n, 0, 0);
        return;
    }
    for (const uint16_t *l = level; n; n--, out++, l++)
        *out = zs_wire16((uint16_t)zs_texture_shine(zs_wire16(*out), *l));
}

/* Return how many of n pixels, beginning with one with this w, have the same number of leading
 * zeros in w. */
static int32_t same_octave(uint32_t w, int32_t gx, int32_t lz, int32_t n)
{
    const uint32_t low = 1u << (31 - lz);
    if (gx == 0)
        return n;
    const uint32_t more = gx < 0 ? (w - low) / (0u - (uint32_t)gx)
                                 : (low - 1u - (w - low)) / (uint32_t)gx;
    return more < (uint32_t)n ? (int32_t)more + 1 : n;
}

static void divided(struct zs_job *job, const struct zs_row *row, int32_t i, int32_t end)
{
    while (i < end) {
        const uint32_t w = zs_plane_at(&job->w, i, row->y);
        int32_t n = 1;
        if (w == 0 || w >> 31 || end - i <= FEW) {
            zs_texture_pixel(job, row, i);
        } else {
            const int32_t lz = zs_clz32(w);
            n = same_octave(w, (int32_t)job->w.gx, lz, zs_min32(end - i, PIECE));
            divide_octave(job, job->color + row->at + i, i, n, row->y, lz);
        }
        i += n;
    }
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

#if ZS_SET_UP

void zs_texture_set_of(const struct zs_job *job, struct zs_texture_set *set)
{
    const struct zs_texture *t = job->texture;
    const uint32_t log2_w = t->log2_w, log2_h = t->log2_h;
    const uint32_t bias = 1u << (32u - ZS_TEXTURE_BIAS_LOG2);
    set->log2[0] = zs_maxu32(log2_w, ZS_TEXTURE_FLOOR_LOG2);
    set->log2[1] = zs_maxu32(log2_h, ZS_TEXTURE_FLOOR_LOG2);
    set->uv_bits = zs_instance_of(job->r, job->tri->instance)->mesh->uv_bits;
    set->later = 31u - set->uv_bits;
    set->bias[0] = bias >> log2_w;
    set->bias[1] = bias >> log2_h;
    set->lit = job->shader->n_varyings == 3;
}

/* zs_fast.start, of triangles that are affine. */
static int texture_start(struct zs_job *job)
{
    const struct zs_texture *t = job->texture;
    struct zs_texture_set set;
    zs_texture_set_of(job, &set);
    if (t->clamp || !t->log2_w || !t->log2_h || !zs_set_up_texture(job, &set))
        return 0;
    job->sampler.wide = 0;
    job->sampler.direct = 1;
    job->sampler.unlit = !job->shader->light ||
                         (!set.lit && job->tri->paint == ZS_TEXTURE_FULL_LIGHT);
    job->sampler.texture = !job->sampler.unlit && job->fast->lit ? job->fast->lit(job, t) : t;
    return 1;
}
#define START .start = texture_start,

#else
#define START
#endif

/* ---- Rows ------------------------------------------------------------------------------------ */

static int texture_rows(struct zs_job *job)
{
    const int fits = job->texel && job->sampler.direct && !job->saturates;
    if (ZS_LANES_USED && fits && zs_lanes_texture_rows(job))
        return 1;
    if (!fits || !job->sampler.unlit)
        return zs_fast_less_rows(job);
    job->texel->rows(job);
    return 1;
}

#define BY_LANES (ZS_LANES_USED && ZS_SET_UP ? zs_lanes_texture_draw : 0)
#ifndef SHINE
#define SHINE
#endif
#define TEXTURE(shader_, draw_, shine_, lit_)                                                      \
    {                                                                                              \
        START shine_ .shader = shader_, .draw = ZS_DIVIDES ? draw_ : BY_LANES,                     \
        .rows = texture_rows, .span = zs_fast_less, .lit = lit_, .divided = divided                \
    }

const struct zs_fast zs_fast_texture = TEXTURE(&zs_shade_texture, draw_unlit, , 0);
const struct zs_fast zs_fast_texture_flat =
    TEXTURE(&zs_shade_texture_flat, draw_lit, SHINE, palette_lit);
const struct zs_fast zs_fast_texture_smooth =
    TEXTURE(&zs_shade_texture_smooth, draw_lit, SHINE, 0);
