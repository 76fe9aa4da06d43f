/* Textured shading: nearest texel, perspective-correct, unlit or times light.
 *
 * Coordinates. A vertex carries u and v as in the mesh, biased to be unsigned. A triangle brings each to
 * un = (u - least u) * 2^s, s as large as 16 bits allow, so that small differences keep their bits, and carries
 * U = un * 2^15 (affine) or U / 2^31 * w over the screen (persp.h): 31 bits either way. A run turns U into
 * 2^-32 repeats of the texture: base + U * 2^shift.
 *
 * Sub-spans. The error of affine interpolation is held below 1/8 texel of the texture, or of one of 128 where it
 * is smaller: T (rho - 1) / 4 <= 1/8, with T the texels that the triangle spans, rho its ratio of w. Over L pixels
 * T is at most L * |dU/dx| and rho - 1 is L * |dw/dx| / least w. With W = w, C = U w / 2^31 and both linear on the
 * screen, dU/dx = (C' - U W') / w, whose largest is at U = 0 or 1: max(|C'|, |C' - W'|) / least w.
 *
 * Errors of a coordinate beyond that, in texels: planes 2^-21 of the triangle's span times rho (plane.c,
 * ZS_PLANE_WIDE), reciprocal 2^-29 of the span, vertices at the near plane half a step of the mesh's.
 *
 * A sample exactly between two texels belongs to the right, lower one: 1/512 texel is added, more than the
 * planes' error in common triangles.
 *
 * SPDX-License-Identifier: MIT
 */
#include "persp.h"

#define BIAS_LOG2 9 /* 2^-9 texel */
#define FLOOR_LOG2 7u /* smaller textures are held to 1/8 texel of one of 128 */
#define LIGHT_MAX 65504u /* uq1_15, just below 2: light() adds a half */
#define LIGHT_ONE 1024u  /* light at a pixel, uq1_10 */

/* ---- Vertices and faces ---------------------------------------------------------------------------- */

static void texture_vertex(const struct zs_renderer *r, uint32_t v, uint16_t *out)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    out[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    out[1] = (uint16_t)(mesh->uv[v][1] + 32768);
}

/* uq1_15 of an intensity. */
static uint16_t light_word(const struct zs_renderer *r, const zs_q1_15 normal[3])
{
    const uint32_t light = (zs_light_intensity(r, normal) + 1u) >> 1;
    return (uint16_t)(light > LIGHT_MAX ? LIGHT_MAX : light);
}

static void smooth_vertex(const struct zs_renderer *r, uint32_t v, uint16_t *out)
{
    texture_vertex(r, v, out);
    out[2] = light_word(r, r->xform.instance->mesh->normal[v]);
}

static uint16_t no_face(const struct zs_renderer *r, uint32_t t)
{
    (void)r;
    (void)t;
    return 0; /* the vertices carry everything */
}

static uint16_t flat_face(const struct zs_renderer *r, uint32_t t)
{
    zs_q1_15 n[3];
    zs_light_face_normal(n, r->xform.instance->mesh, t);
    return light_word(r, n);
}

static int texture_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_texture *t = in->material->texture;
    (void)config;
    if (!t || !t->format || !t->texel || (t->format->colors_max && !t->palette))
        return ZS_ERR_NULL;
    if (t->log2_w > ZS_TEXTURE_LOG2_MAX || t->log2_h > ZS_TEXTURE_LOG2_MAX ||
        t->log2_w < t->format->log2_w_min || t->clamp > (ZS_CLAMP_U | ZS_CLAMP_V))
        return ZS_ERR_TEXTURE;
    return in->mesh->uv && in->mesh->uv_bits <= 15 ? ZS_OK : ZS_ERR_MESH;
}

static int smooth_check(const struct zs_instance *in, const struct zs_config *config)
{
    return in->mesh->normal ? texture_check(in, config) : ZS_ERR_MESH;
}

/* ---- Set-up ------------------------------------------------------------------------------------------ */

/* v * 2^shift modulo 2^64, floor; v may be negative. |shift| <= 48 */
static inline uint64_t shifted(int64_t v, int32_t shift)
{
    return shift >= 0 ? (uint64_t)v << shift : (uint64_t)(v >> -shift);
}

/* Values of one coordinate at the vertices, un, and the sampler's way back. Return log2 of the texels (of 128
 * or more to a repeat) that un's 16 bits stand for. */
static int32_t coordinate(struct zs_job *job, const uint16_t *const a[3], int c, uint32_t un[3])
{
    struct zs_sampler *s = &job->sampler;
    const uint32_t uv_bits = job->r->scene->instance[job->tri->instance].mesh->uv_bits;
    const uint32_t log2 = c ? s->texture->log2_h : s->texture->log2_w;
    const int32_t least = zs_min32(zs_min32(a[0][c], a[1][c]), a[2][c]);
    const int32_t most = zs_max32(zs_max32(a[0][c], a[1][c]), a[2][c]);
    const int32_t up = most > least ? zs_clz32((uint32_t)(most - least)) - 16 : 0; /* 0 .. 15 */
    for (int k = 0; k < 3; k++)
        un[k] = (uint32_t)(a[k][c] - least) << up; /* < 2^16 */
    s->shift[c] = 17 - up - (int32_t)uv_bits;
    s->base[c] = shifted(least - 32768, 32 - (int32_t)uv_bits) +
                 ((uint64_t)1 << (32 - BIAS_LOG2 - (int32_t)log2));
    return 16 - up - (int32_t)uv_bits + (int32_t)(log2 > FLOOR_LOG2 ? log2 : FLOOR_LOG2);
}

/* a * b * 2^shift <= c * d for factors below 2^32. */
static int product_within(uint32_t a, uint32_t b, int32_t shift, uint32_t c, uint32_t d)
{
    const uint64_t p = (uint64_t)a * b, limit = (uint64_t)c * d;
    if (shift >= 64)
        return p == 0;
    if (shift >= 0)
        return p <= limit >> shift;
    return shift <= -64 || p >> -shift <= limit;
}

/* Plain affine: 2^texels * range / 2^16 * change / least / 4 <= 1/8. */
static int affine_enough(const uint32_t un[3], int32_t texels, uint32_t change, uint32_t least)
{
    const uint32_t range = un[0] | un[1] | un[2]; /* below twice the largest, at least it */
    return product_within(range, change, texels - 15, least, 1u);
}

static inline uint32_t size_of(uint32_t gradient)
{
    return gradient >> 31 ? 0u - gradient : gradient;
}

/* 2^texels * du * 2^k * dw * 2^k / 4 <= 1/8 with du = steep / least, dw = slope / least. */
static int sub_span_enough(const struct zs_plane *c, const struct zs_plane *w, int32_t texels,
                           uint32_t least, int32_t k)
{
    const uint32_t slope = size_of(w->gx);
    const int64_t c_gx = (int32_t)c->gx, w_gx = (int32_t)w->gx;
    const int64_t at0 = c_gx < 0 ? -c_gx : c_gx;
    const int64_t at1 = c_gx - w_gx < 0 ? w_gx - c_gx : c_gx - w_gx;
    const int64_t steep = at0 > at1 ? at0 : at1; /* <= 2^32 */
    return product_within(steep > UINT32_MAX ? UINT32_MAX : (uint32_t)steep, slope, texels + 2 * k + 1, least, least);
}

/* The light's words: range * 2^-15 * 64 codes * change / least / 4 <= 1/8. */
static int light_enough(uint32_t range, uint32_t change, uint32_t least)
{
    return product_within(range, change, 0, least, 256u);
}

static void texture_start(struct zs_job *job)
{
    const uint16_t *a[3];
    uint32_t w[3], value[3][3] = { { 0 } }, light_range = 0;
    int32_t texels[2];
    const int n = job->shader->n_attrs, lit = n == 3;
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    const struct zs_texture *t = job->r->scene->instance[job->tri->instance].material->texture;
    job->sampler.texture = t;
    job->sampler.wide = t->clamp || !t->log2_w || !t->log2_h;
    for (int c = 0; c < 2; c++)
        texels[c] = coordinate(job, a, c, value[c]);
    uint32_t most = w[0], least = w[0];
    for (int k = 0; k < 3; k++) {
        most = w[k] > most ? w[k] : most;
        least = w[k] < least ? w[k] : least;
        if (lit)
            value[2][k] = a[k][2];
    }
    if (lit) {
        const int32_t lo = zs_min32(zs_min32(a[0][2], a[1][2]), a[2][2]);
        light_range = (uint32_t)(zs_max32(zs_max32(a[0][2], a[1][2]), a[2][2]) - lo);
    }
    const uint32_t change = most - least;
    if (affine_enough(value[0], texels[0], change, least) &&
        affine_enough(value[1], texels[1], change, least) && light_enough(light_range, change, least)) {
        job->sub_log2 = ZS_AFFINE;
        for (int c = 0; c < n; c++)
            zs_plane32(&job->geom, value[c][0] << 15, value[c][1] << 15, value[c][2] << 15,
                       ZS_PLANE_WIDE, &job->c[c]);
        return;
    }
    zs_plane32(&job->geom, w[0], w[1], w[2], ZS_PLANE_WIDE, &job->w);
    for (int c = 0; c < n; c++)
        zs_plane32(&job->geom, zs_umulh(value[c][0] << 16, w[0]), zs_umulh(value[c][1] << 16, w[1]),
                   zs_umulh(value[c][2] << 16, w[2]), ZS_PLANE_WIDE, &job->c[c]);
    const uint32_t slope = size_of(job->w.gx);
    int32_t k = (int32_t)ZS_SUB_LOG2_MAX;
    while (k > 0 && (!sub_span_enough(&job->c[0], &job->w, texels[0], least, k) ||
                     !sub_span_enough(&job->c[1], &job->w, texels[1], least, k) ||
                     (lit && (slope >> (31 - k) || !light_enough(light_range, slope << k, least)))))
        k--;
    job->sub_log2 = (uint32_t)k;
}

/* ---- Runs ------------------------------------------------------------------------------------------- */

/* A coordinate held to [0, 1) in q32_32. */
static uint32_t held(uint64_t t)
{
    return (int64_t)t < 0 ? 0u : t >> 32 ? UINT32_MAX : (uint32_t)t;
}

/* Textures that are clamped: q32_32, because what lies beyond [0, 1) counts. Runs that stay within are
 * fetched whole, others pixel by pixel. */
static ZS_NOINLINE void fetch_wide(const struct zs_sampler *s, uint16_t *out, int32_t n,
                                   const uint32_t c[2], const int32_t step[2])
{
    const struct zs_texture *t = s->texture;
    const struct zs_texel *texel = t->format;
    uint64_t at[2], by[2], beyond = 0;
    for (int k = 0; k < 2; k++) {
        at[k] = s->base[k] + shifted((int32_t)c[k], s->shift[k]);
        by[k] = shifted(step[k], s->shift[k]);
        if (t->clamp >> k & 1)
            beyond |= (at[k] | (at[k] + by[k] * (uint64_t)(uint32_t)(n - 1))) >> 32;
    }
    const int single = beyond || t->log2_w == 0 || t->log2_h == 0;
    struct zs_walk walk = { (uint32_t)at[0], (uint32_t)at[1], (uint32_t)by[0], (uint32_t)by[1] };
    if (!single)
        texel->fetch(t, out, n, &walk);
    for (; single && n > 0; n--, out++) {
        walk.u = t->log2_w == 0 ? 0u : t->clamp & ZS_CLAMP_U ? held(at[0]) : (uint32_t)at[0];
        walk.v = t->log2_h == 0 ? 0u : t->clamp & ZS_CLAMP_V ? held(at[1]) : (uint32_t)at[1];
        texel->fetch(t, out, 1, &walk);
        at[0] += by[0];
        at[1] += by[1];
    }
}

static inline uint32_t turned(uint32_t c, int32_t shift)
{
    return shift >= 0 ? c << shift : (uint32_t)((int32_t)c >> -shift);
}

/* n texels from coordinates c on, changing by step: in 2^-31 of the triangle's span. */
static inline void fetch(const struct zs_job *job, uint16_t *out, int32_t n, const uint32_t c[2],
                         const int32_t step[2])
{
    const struct zs_sampler *s = &job->sampler;
    if (s->wide) {
        fetch_wide(s, out, n, c, step);
        return;
    }
    const struct zs_texel *texel = s->texture->format;
    const struct zs_walk walk = { /* modulo one repeat */
        (uint32_t)s->base[0] + turned(c[0], s->shift[0]), (uint32_t)s->base[1] + turned(c[1], s->shift[1]),
        turned((uint32_t)step[0], s->shift[0]), turned((uint32_t)step[1], s->shift[1])
    };
    texel->fetch(s->texture, out, n, &walk);
}

/* n pixels times light, which is uq1_15 with 16 more fraction bits and changes by step. */
static void light(uint16_t *out, int32_t n, uint32_t l, uint32_t step)
{
    l += 1u << 20; /* half of 2^-10 */
    for (uint16_t *const end = out + n; out != end; out++, l += step) {
        const uint32_t c = zs_wire16(*out), level = l >> 21;           /* 0 .. 2047 */
        const uint32_t rb = (((c & 0xf800u) << 5) | (c & 31u)) * level + 0x02000200u; /* 2 x 16 bits */
        const uint32_t g = ((c >> 5) & 63u) * level + 0x200u;          /* < 2^17.1 */
        uint32_t red = rb >> 26, green = g >> 10, blue = (rb >> 10) & 63u;
        if (level > LIGHT_ONE) {
            red = red > 31u ? 31u : red;
            green = green > 63u ? 63u : green;
            blue = blue > 31u ? 31u : blue;
        }
        *out = zs_wire16((uint16_t)(red << 11 | green << 5 | blue));
    }
}

/* Attributes at a covered pixel by division: 2^-31 of their span. */
static void divide_at(const struct zs_job *job, int32_t i, int32_t row, int n, uint32_t out[3])
{
    uint32_t w;
    int32_t lz;
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    for (int c = 0; c < n; c++)
        out[c] = zs_persp_over(zs_plane_at(job, &job->c[c], i, row), w, rcp, lz);
}

/* n pixels from attributes c on, changing by step. */
static inline void emit(const struct zs_job *job, uint16_t *out, int32_t n, const uint32_t c[3],
                        const int32_t step[3])
{
    const struct zs_shader *shader = job->shader;
    fetch(job, out, n, c, step);
    if (!shader->light)
        return;
    if (shader->n_attrs == 3)
        shader->light(out, n, c[2] << 1, (uint32_t)step[2] << 1);
    else if (job->tri->paint != 32768u)
        shader->light(out, n, (uint32_t)job->tri->paint << 16, 0);
}

static void texture_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    uint16_t *color = job->color + row->at;
    const int n = job->shader->n_attrs;
    uint32_t c[3], next[3];
    int32_t step[3];
    if (job->sub_log2 == ZS_AFFINE) {
        for (int k = 0; k < n; k++) {
            c[k] = zs_plane_at(job, &job->c[k], r0, row->y);
            step[k] = (int32_t)job->c[k].gx; /* beyond 31 bits only where a run is one pixel */
        }
        emit(job, color + r0, r1 - r0, c, step);
        return;
    }
    const int32_t length = (int32_t)1 << job->sub_log2;
    int32_t from = row->x0 + ((r0 - row->x0) & -length);
    divide_at(job, from, row->y, n, next);
    for (; from < r1; from += length) {
        const int32_t to = zs_min32(from + length, row->x1 - 1); /* its far end, covered */
        const uint32_t part = to > from ? zs_one_over[to - from] : 0u;
        const int32_t i0 = zs_max32(from, r0), i1 = zs_min32(from + length, r1);
        for (int k = 0; k < n; k++)
            c[k] = next[k];
        if (to > from)
            divide_at(job, to, row->y, n, next);
        for (int k = 0; k < n; k++) {
            step[k] = (int32_t)(((int64_t)next[k] - c[k]) * part >> 16); /* product < 2^48 */
            c[k] += zs_wrap_mul((uint32_t)step[k], i0 - from);
        }
        emit(job, color + i0, i1 - i0, c, step);
    }
}

const struct zs_shader zs_shade_texture = { texture_vertex, no_face, zs_persp_rows, texture_start, zs_persp_span, texture_run,
                                            texture_check, 0, ZS_ATTRS_TEXTURE };
const struct zs_shader zs_shade_texture_flat = { texture_vertex, flat_face, zs_persp_rows, texture_start,
                                                 zs_persp_span, texture_run, texture_check, light, ZS_ATTRS_TEXTURE };
const struct zs_shader zs_shade_texture_smooth = { smooth_vertex, no_face, zs_persp_rows, texture_start,
                                                   zs_persp_span, texture_run, smooth_check, light,
                                                   ZS_ATTRS_TEXTURE_SMOOTH };
