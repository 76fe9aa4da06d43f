/* Filters of textures: bilinear means against doubles, the levels of mipmaps against exact changes of coordinates,
 * texels with alpha, the alpha test against pictures put together pixel by pixel; the same for any strips, pools,
 * accelerators.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "../lab/fuzz/world.h"
#include "fast_lists.h"
#include "picture.h"
#include "effect/alpha_texels.h"
#include "effect/filter.h"
#include "zs_check.h"
#include "zs_filter.h"
#include "zs_method.h"

static const struct zs_texel *const formats[] = { &zs_texel_565,  &zs_texel_pal8,  &zs_texel_pal4,
                                                  &zs_texel_4444, &zs_texel_pal8a, &zs_texel_pal4a };
#define FORMATS 6u

/* A texture of any format with any texels, and its colours and alphas decoded by hand. */
#define SIDE_LOG2 6u
struct image {
    struct zs_texture texture;
    uint16_t texel[2 << 2 * SIDE_LOG2], palette[512];
};

static void image_any(struct prng *p, struct image *m, const struct zs_texel *format, uint32_t log2_w, uint32_t log2_h)
{
    const int paletted = format != &zs_texel_565 && format != &zs_texel_4444;
    const int four = format == &zs_texel_pal4 || format == &zs_texel_pal4a;
    const uint32_t n = four ? 16 : 1u + prng_pick(p, 256);
    uint8_t *bytes = (uint8_t *)m->texel;
    memset(&m->texture, 0, sizeof m->texture);
    m->texture.format = format;
    m->texture.texel = m->texel;
    m->texture.palette = paletted ? m->palette : NULL;
    m->texture.n_colors = (uint16_t)(paletted ? n : 0);
    m->texture.log2_w = (uint8_t)(four && log2_w == 0 ? 1 : log2_w);
    m->texture.log2_h = (uint8_t)log2_h;
    m->texture.clamp = (uint8_t)prng_pick(p, 4);
    for (uint32_t i = 0; i < 2 * n; i++)
        m->palette[i] = (uint16_t)(i < n ? prng_next(p) : prng_pick(p, 256));
    for (uint32_t i = 0; i < 2u << 2 * SIDE_LOG2; i++)
        m->texel[i] = (uint16_t)(prng_pick(p, 4) ? prng_next(p) : prng_pick(p, 2) ? 0 : 0xffff);
    for (uint32_t i = 0; paletted && i < sizeof m->texel; i++)
        bytes[i] = (uint8_t)(four ? prng_next(p) : prng_pick(p, n));
}

/* Channels of texel (x, y), as RGB565 has them, and its alpha, 0 .. 255. */
static void decode(const struct zs_texture *t, uint32_t x, uint32_t y, double rgb[3], uint32_t *alpha)
{
    const uint32_t at = (y << t->log2_w) + x;
    const uint8_t *bytes = t->texel;
    uint16_t c = ((const uint16_t *)t->texel)[at];
    uint32_t k = 0;
    *alpha = 255;
    if (t->format == &zs_texel_4444) {
        static const uint8_t wide5[16] = { 0, 2, 4, 6, 8, 10, 12, 14, 17, 19, 21, 23, 25, 27, 29, 31 };
        static const uint8_t wide6[16] = { 0, 4, 8, 12, 17, 21, 25, 29, 34, 38, 42, 46, 51, 55, 59, 63 };
        *alpha = (uint32_t)(c & 15) * 17u;
        c = (uint16_t)(wide5[c >> 12] << 11 | wide6[c >> 8 & 15] << 5 | wide5[c >> 4 & 15]);
    } else if (t->format != &zs_texel_565) {
        const int four = t->format == &zs_texel_pal4 || t->format == &zs_texel_pal4a;
        k = four ? (uint32_t)(bytes[at / 2] >> (at % 2 * 4)) & 15u : bytes[at];
        c = t->palette[k];
        if (t->format == &zs_texel_pal8a || t->format == &zs_texel_pal4a)
            *alpha = t->palette[t->n_colors + k];
    }
    rgb[0] = c >> 11;
    rgb[1] = c >> 5 & 63;
    rgb[2] = c & 31;
}

/* The exact bilinear mean at coordinates in texels; texel k's middle is at k + 1/2. */
static void mean(const struct zs_texture *t, double u, double v, double rgb[3])
{
    const double at[2] = { u - 0.5, v - 0.5 };
    const int32_t size[2] = { 1 << t->log2_w, 1 << t->log2_h };
    int32_t x[2][2];
    double part[2];
    for (int k = 0; k < 2; k++) {
        part[k] = at[k] - floor(at[k]);
        for (int i = 0; i < 2; i++) {
            const double whole = floor(at[k]) + i;
            if (t->clamp >> k & 1)
                x[k][i] = whole < 0 ? 0 : whole >= size[k] ? size[k] - 1 : (int32_t)whole;
            else
                x[k][i] = (int32_t)(whole - size[k] * floor(whole / size[k]));
        }
    }
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int i = 0; i < 4; i++) {
        double c[3];
        uint32_t alpha;
        decode(t, (uint32_t)x[0][i & 1], (uint32_t)x[1][i >> 1], c, &alpha);
        const double weight = (i & 1 ? part[0] : 1 - part[0]) * (i >> 1 ? part[1] : 1 - part[1]);
        for (int k = 0; k < 3; k++)
            rgb[k] += weight * c[k];
    }
}

static double off_by(uint16_t wire, const double rgb[3])
{
    const uint16_t c = zs_wire16(wire);
    return fmax(fabs((c >> 11) - rgb[0]), fmax(fabs((c >> 5 & 63) - rgb[1]), fabs((c & 31) - rgb[2])));
}

/* ---- The bilinear loop ------------------------------------------------------------------------ */

#define RUN 64
static double worst_code, worst_exact;
static unsigned in_cells, own_cells;

/* Any walk over any texture, which counts from the first texel's middle: within a code of the mean at the walk's own
 * coordinates, rounded to 1/32 texel; and the same pixels by parts, and gathered. */
static int kernel_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct image m;
    struct zs_lit lit = { .of = &m.texture };
    uint16_t out[RUN], part[RUN];
    image_any(&p, &m, formats[prng_pick(&p, FORMATS)], prng_pick(&p, SIDE_LOG2 + 1), prng_pick(&p, SIDE_LOG2 + 1));
    lit.texture = m.texture;
    lit.texture.format = &zs_filter_bilinear;
    lit.texture.log2_w = (uint8_t)(m.texture.log2_w + ZS_BILINEAR_LOG2);
    lit.texture.log2_h = (uint8_t)(m.texture.log2_h + ZS_BILINEAR_LOG2);
    const uint32_t right = 32u - lit.texture.log2_w, down = 32u - lit.texture.log2_h;
    const uint32_t cut = prng_pick(&p, prng_pick(&p, 2) ? 32 : 6);
    struct zs_walk w = { (uint32_t)prng_next(&p), (uint32_t)prng_next(&p), (uint32_t)((int32_t)prng_next(&p) >> cut),
                         (uint32_t)((int32_t)prng_next(&p) >> prng_pick(&p, 32)) };
    int32_t n = prng_pick(&p, 4) ? prng_range(&p, 1, RUN) : 2;
    for (int k = 0; k < 2; k++) { /* a clamped direction is walked inside the texture only */
        uint32_t *at = k ? &w.v : &w.u, *by = k ? &w.dv : &w.du;
        if (prng_pick(&p, 8) == 0)
            *(prng_pick(&p, 2) ? by : at) = 0;
        if (m.texture.clamp >> k & 1 && n == 2)
            *by = (uint32_t)prng_next(&p) - *at; /* of two pixels, anywhere: from one border to the other, too */
        else if (m.texture.clamp >> k & 1)
            while ((int64_t)*at + (int64_t)(int32_t)*by * (n - 1) < 0 ||
                   ((int64_t)*at + (int64_t)(int32_t)*by * (n - 1)) >> 32)
                *by = (uint32_t)((int32_t)*by / 2);
    }
    zs_filter_bilinear.fetch(&lit.texture, out, n, &w);
    for (int32_t i = 0; i < n;) {
        const int32_t some = prng_range(&p, 1, n - i);
        const struct zs_walk on = { w.u + w.du * (uint32_t)i, w.v + w.dv * (uint32_t)i, w.du, w.dv };
        zs_filter_bilinear.fetch(&lit.texture, part + i, some, &on);
        i += some;
    }
    CASE_CHECK(!memcmp(out, part, (size_t)n * 2));
    for (int32_t i = 0; i < n; i++) {
        double rgb[3];
        const uint32_t u = w.u + w.du * (uint32_t)i, v = w.v + w.dv * (uint32_t)i;
        const uint32_t place = (v >> down << lit.texture.log2_w) + (u >> right);
        const double at[2] = { ldexp(u, -32) * (1 << m.texture.log2_w) + 0.5 - 1.0 / 64,
                               ldexp(v, -32) * (1 << m.texture.log2_h) + 0.5 - 1.0 / 64 };
        zs_filter_bilinear.gather(&lit.texture, part, 1, &place);
        CASE_CHECK(part[0] == out[i]);
        mean(&m.texture, at[0], at[1], rgb);
        worst_exact = fmax(worst_exact, off_by(out[i], rgb));
        mean(&m.texture, floor(at[0] * 32 + 0.5) / 32, floor(at[1] * 32 + 0.5) / 32, rgb);
        const double off = off_by(out[i], rgb);
        worst_code = fmax(worst_code, off);
        if (off > 1 + 1e-9)
            return case_wrong("pixel %d of %d: %g codes off; %u x %u, clamp %u", i, n, off, 1u << m.texture.log2_w,
                              1u << m.texture.log2_h, m.texture.clamp);
    }
    ++*((uint64_t)zs_size32((int32_t)w.du) << m.texture.log2_w >> 32 ? &own_cells : &in_cells);
    return 1;
}

static void kernel_right(void **state)
{
    CASES(kernel_case, 20000);
    printf("bilinear: at most %.3f codes off, %.3f at coordinates that are not rounded; %u runs of large cells, %u of "
           "small ones\n",
           worst_code, worst_exact, in_cells, own_cells);
    assert_true(!cases_all() || (in_cells > 1000 && own_cells > 1000 && worst_code > 0.5 && worst_exact < 3));
}

/* ---- Texels with alpha ------------------------------------------------------------------------ */

static int alpha_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct image m;
    uint16_t out[2 * ZS_ALPHA_RUN], plain[ZS_ALPHA_RUN];
    image_any(&p, &m, formats[3 + prng_pick(&p, 3)], prng_pick(&p, SIDE_LOG2 + 1), prng_pick(&p, SIDE_LOG2 + 1));
    const struct zs_texture *t = &m.texture;
    const struct zs_walk w = { (uint32_t)prng_next(&p) & -(uint32_t)(t->log2_w > 0),
                               (uint32_t)prng_next(&p) & -(uint32_t)(t->log2_h > 0),
                               (uint32_t)prng_next(&p) & -(uint32_t)(t->log2_w > 0),
                               (uint32_t)prng_next(&p) & -(uint32_t)(t->log2_h > 0) };
    const int32_t n = prng_range(&p, 1, ZS_ALPHA_RUN);
    memset(out, 0x5a, sizeof out);
    t->format->both(t, out, n, &w);
    t->format->fetch(t, plain, n, &w);
    CASE_CHECK(!memcmp(out, plain, (size_t)n * 2));
    for (int32_t i = 0; i < ZS_ALPHA_RUN; i++) {
        double rgb[3];
        uint32_t alpha;
        const uint64_t u = (uint32_t)(w.u + w.du * (uint32_t)i), v = (uint32_t)(w.v + w.dv * (uint32_t)i);
        decode(t, (uint32_t)(u << t->log2_w >> 32), (uint32_t)(v << t->log2_h >> 32), rgb, &alpha);
        if (i < n)
            CASE_CHECK(off_by(out[i], rgb) == 0 && out[ZS_ALPHA_RUN + i] == alpha);
        else
            CASE_CHECK(out[i] == 0x5a5a && out[ZS_ALPHA_RUN + i] == 0x5a5a);
    }
    return 1;
}

/* ---- A card in space -------------------------------------------------------------------------- */

/* A parallelogram seen from the origin, towards -z, with 90 degrees of view. */
#define W 96
#define H 64
struct card {
    int16_t pos[4][3], uv[4][2];
    zs_q1_15 normal[4][3], face_normal[2][3];
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance instance;
    double corner[3], side[2][3], at[2], by[2][2]; /* uv in repeats */
};

static const uint16_t card_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

static void card_set(struct card *c, const int32_t corner[3], const int32_t a[3], const int32_t b[3],
                     const int32_t uv[3][2], uint8_t uv_bits, const struct zs_shader *shader,
                     const struct zs_texture *texture)
{
    memset(c, 0, sizeof *c);
    for (int v = 0; v < 4; v++)
        for (int k = 0; k < 3; k++) {
            const int i = v == 1 || v == 2, j = v >= 2;
            c->pos[v][k] = (int16_t)(corner[k] + i * a[k] + j * b[k]);
            if (k < 2)
                c->uv[v][k] = (int16_t)(uv[0][k] + i * uv[1][k] + j * uv[2][k]);
            c->normal[v][k] = (zs_q1_15)(k == 2 ? 32767 : 3000 * v);
            c->face_normal[j][k] = (zs_q1_15)(k == 2 ? 20000 : 9000);
        }
    for (int k = 0; k < 3; k++) {
        c->corner[k] = corner[k];
        c->side[0][k] = a[k];
        c->side[1][k] = b[k];
    }
    for (int k = 0; k < 2; k++) {
        c->at[k] = ldexp(uv[0][k], -uv_bits);
        c->by[0][k] = ldexp(uv[1][k], -uv_bits);
        c->by[1][k] = ldexp(uv[2][k], -uv_bits);
    }
    c->mesh = (struct zs_mesh){
        .pos = c->pos, .tri = card_tri, .normal = c->normal, .face_normal = c->face_normal, .uv = c->uv,
        .uv_bits = uv_bits, .n_verts = 4, .n_tris = 2, .radius = 65535
    };
    c->material = (struct zs_material){ .shader = shader, .cull = ZS_CULL_NONE, .texture = texture };
    c->instance = (struct zs_instance){ .mesh = &c->mesh, .material = &c->material };
}

/* Coordinates, in repeats, where the ray through a point of the screen (px) meets the card's plane. Return 0 beside
 * it. */
static int card_at(const struct card *c, double x, double y, double uv[2])
{
    const double ray[3] = { (x - W / 2.0) / (H / 2.0), (H / 2.0 - y) / (H / 2.0), -1 };
    const double *const m[3] = { c->side[0], c->side[1], ray }; /* corner + s a + t b = l ray */
    double minor[3];
    const double *o = c->corner;
#define DET(p, q, r)                                                                                                  \
    ((p)[0] * ((q)[1] * (r)[2] - (q)[2] * (r)[1]) - (p)[1] * ((q)[0] * (r)[2] - (q)[2] * (r)[0]) +                    \
     (p)[2] * ((q)[0] * (r)[1] - (q)[1] * (r)[0]))
    const double det = DET(m[0], m[1], ray);
    minor[0] = -DET(o, m[1], ray) / det;
    minor[1] = -DET(m[0], o, ray) / det;
    for (int k = 0; k < 2; k++)
        uv[k] = c->at[k] + minor[0] * c->by[0][k] + minor[1] * c->by[1][k];
    const double e = 1e-9;
    return minor[0] >= -e && minor[0] <= 1 + e && minor[1] >= -e && minor[1] <= 1 + e;
}

static const struct zs_depth *depth_used = &zs_depth_recip;

static struct picture card_draw(const struct card *const *card, uint32_t n, struct zs_config *config)
{
    static struct zs_config usual;
    struct zs_instance instance[4];
    const struct zs_scene scene = { .instance = instance, .n_instances = n, .background = 0x1234 };
    struct zs_camera camera;
    for (uint32_t i = 0; i < n; i++)
        instance[i] = card[i]->instance;
    if (zs_camera_perspective(&camera, ZS_DEGREES(90), H, 8, 32767))
        abort();
    if (!config) {
        usual = picture_config(W, H, depth_used);
        config = &usual;
    }
    return picture_draw(config, &scene, &camera);
}

/* ---- Bilinear frames -------------------------------------------------------------------------- */

/* A texture whose texels change slowly, so that an error of coordinates is a small one of colours: green 4 codes. */
static void slope_texture(struct image *m, uint32_t clamp)
{
    memset(m, 0, sizeof *m);
    m->texture = (struct zs_texture){
        .format = &zs_texel_565, .texel = m->texel, .log2_w = 5, .log2_h = 5, .clamp = (uint8_t)clamp
    };
    for (int i = 0; i < 1024; i++) {
        const int x = i & 31, y = i >> 5, a = x < 16 ? x : 31 - x, b = y < 16 ? y : 31 - y;
        m->texel[i] = (uint16_t)(a << 11 | (a + 3 * b) << 5 | b);
    }
}

static double worst_frame;

static int frame_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct image m;
    static struct card c;
    const uint32_t clamp = prng_pick(&p, 4);
    const int32_t z = -prng_range(&p, 20, 400);
    const int32_t corner[3] = { prng_range(&p, -300, 0), prng_range(&p, -300, 0), z };
    const int32_t a[3] = { prng_range(&p, 50, 400), prng_range(&p, -50, 50), -prng_range(&p, 0, 600) };
    const int32_t b[3] = { prng_range(&p, -50, 50), prng_range(&p, 50, 400), -prng_range(&p, 0, 600) };
    const int32_t uv[3][2] = { { prng_range(&p, -5000, 5000), prng_range(&p, -5000, 5000) },
                               { prng_range(&p, -9000, 9000), prng_range(&p, -3000, 3000) },
                               { prng_range(&p, -3000, 3000), prng_range(&p, -9000, 9000) } };
    slope_texture(&m, clamp);
    card_set(&c, corner, a, b, uv, 12, &zs_shade_bilinear, &m.texture);
    const struct card *const one = &c;
    struct picture q = card_draw(&one, 1, NULL);
    CASE_CHECK(q.err == ZS_OK);
    for (int32_t i = 0; i < W * H; i++) {
        double at[2], rgb[3], slope = 0;
        if (q.key[i] == ZS_DEPTH_CLEAR)
            continue;
        (void)card_at(&c, i % W + 0.5, i / W + 0.5, at);
        for (int k = 0; k < 4; k++) { /* a vertex is snapped to 1/512 px: so far in texels here */
            double beside[2];
            (void)card_at(&c, i % W + 0.5 + (k == 0) - (k == 1), i / W + 0.5 + (k == 2) - (k == 3), beside);
            slope = fmax(slope, 32 * fmax(fabs(beside[0] - at[0]), fabs(beside[1] - at[1])));
        }
        if (slope > 8)
            continue;
        mean(&m.texture, at[0] * 32, at[1] * 32, rgb);
        /* texels / 8 of one of 128, which is 1/32 here, each way; 4 codes a texel in all */
        const double off = off_by(zs_wire16(q.color[i]), rgb), most = 1 + 4 * (1 / 32. + slope / 64);
        worst_frame = fmax(worst_frame, off);
        if (off > most)
            return case_wrong("pixel %d, %d: %g codes off, %g allowed, clamp %u", i % W, i / W, off, most, clamp);
    }
    picture_free(&q);
    return 1;
}

/* ---- Levels ----------------------------------------------------------------------------------- */

/* A chain whose texels are their level's number. */
#define LEVELS 9u
static uint16_t chain[0x20000];

static struct zs_texture chain_texture(uint32_t log2_w, uint32_t log2_h)
{
    const uint32_t n = 1u + (log2_w < log2_h ? log2_w : log2_h);
    uint16_t *at = chain;
    for (uint32_t k = 0; k < n; k++)
        for (uint32_t i = 0; i < 1u << (log2_w + log2_h - 2 * k); i++)
            *at++ = (uint16_t)(k + 1u);
    return (struct zs_texture){
        .format = &zs_texel_565, .texel = chain, .log2_w = (uint8_t)log2_w, .log2_h = (uint8_t)log2_h,
        .n_levels = (uint8_t)n
    };
}

/* The largest change of a coordinate to the next pixel, in texels: by differences of 1/64 px. */
static double change(const struct card *c, const struct zs_texture *t, double x, double y)
{
    double most = 0;
    for (int d = 0; d < 2; d++) {
        double one[2], two[2];
        (void)card_at(c, x - (d == 0) / 128., y - (d == 1) / 128., one);
        (void)card_at(c, x + (d == 0) / 128., y + (d == 1) / 128., two);
        for (int k = 0; k < 2; k++)
            most = fmax(most, 64 * fabs(two[k] - one[k]) * (1 << (k ? t->log2_h : t->log2_w)));
    }
    return most;
}

static uint64_t levels_seen, levels_right, levels_above;

static int level_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct card c;
    const struct zs_texture t = chain_texture(prng_pick(&p, LEVELS), prng_pick(&p, LEVELS));
    const int flat = prng_pick(&p, 3) == 0, bits = prng_range(&p, 8, 15);
    const int32_t corner[3] = { prng_range(&p, -300, 0), prng_range(&p, -300, 0), -prng_range(&p, 20, 400) };
    const int32_t a[3] = { prng_range(&p, 50, 400), prng_range(&p, -50, 50), flat ? 0 : -prng_range(&p, 0, 5000) };
    const int32_t b[3] = { prng_range(&p, -50, 50), prng_range(&p, 50, 400), flat ? 0 : -prng_range(&p, 0, 5000) };
    const int32_t uv[3][2] = { { 0, 0 }, { prng_range(&p, -9000, 9000), 0 }, { 0, prng_range(&p, -9000, 9000) } };
    depth_used = prng_pick(&p, 2) ? &zs_depth_recip : &zs_depth_float;
    card_set(&c, corner, a, b, uv, (uint8_t)bits, prng_pick(&p, 2) ? &zs_shade_mipmap : &zs_shade_mipmap_bilinear, &t);
    const struct card *const one = &c;
    struct picture q = card_draw(&one, 1, NULL);
    depth_used = &zs_depth_recip;
    CASE_CHECK(q.err == ZS_OK);
    const int32_t most = t.n_levels - 1;
    for (int32_t i = 0; i < W * H; i++) {
        if (q.key[i] == ZS_DEPTH_CLEAR)
            continue;
        const double lod = log2(change(&c, &t, i % W + 0.5, i / W + 0.5));
        const int32_t got = q.color[i] - 1;
        const int32_t least = (int32_t)fmin(most, fmax(0, floor(lod + 0.5 - 0.15)));
        const int32_t right = (int32_t)fmin(most, fmax(0, floor(lod + 0.5 + 0.15)));
        levels_seen++;
        levels_right += got >= least && got <= right;
        levels_above += got > right + 1;
        if (got < least || got > most || (flat && got > right))
            return case_wrong("pixel %d, %d: level %d, log2 of the change is %g, of %d levels", i % W, i / W, got, lod,
                              most + 1);
    }
    picture_free(&q);
    return 1;
}

static void levels_close(void **state)
{
    CASES(level_case, 600);
    printf("levels of %u pixels: %.2f %% are the nearest one, %.2f %% more than one above\n", (unsigned)levels_seen,
           100. * (double)levels_right / (double)levels_seen, 100. * (double)levels_above / (double)levels_seen);
    assert_true(!cases_all() || (levels_seen > 200000 && levels_right > levels_seen / 100 * 85));
}

/* Cards that reach far behind the eye: at no pixel of the pieces that are left is the level too fine, though the eye
 * sees them where w is a thousandth of its largest value. */
static void levels_of_cut_cards(void **state)
{
    static const int32_t at[4][9] = { { 2609, -445, -6300, -655, -8122, 6311, -5950, 11961, 3907 },
                                      { 2919, 6390, 186, 2275, 11677, -2411, -1008, -11226, -10335 },
                                      { -7827, 6496, 1769, 3976, -9155, -9959, -5749, 7228, -3814 },
                                      { 1309, 469, -4515, -11616, 1872, 3025, 6738, 270, 3649 } };
    static const int32_t uv[4][3][2] = { { { 0, 0 }, { 1863, -14085 }, { -2929, -6305 } },
                                         { { 0, 0 }, { -1870, 12463 }, { 4449, 15763 } },
                                         { { 0, 0 }, { 14139, 1465 }, { 11627, 9419 } },
                                         { { 0, 0 }, { -5782, 13832 }, { -14637, -9196 } } };
    static const uint32_t pixels[4] = { 3804, 352, 518, 2355 };
    static struct card c;
    const struct zs_texture t = chain_texture(6, 6);
    for (int k = 0; k < 4; k++) {
        card_set(&c, at[k], at[k] + 3, at[k] + 6, uv[k], 14, &zs_shade_mipmap, &t);
        const struct card *const one = &c;
        struct picture q = card_draw(&one, 1, NULL);
        uint32_t seen = 0, fine = 0;
        for (int32_t i = 0; i < W * H; i++) {
            if (q.key[i] == ZS_DEPTH_CLEAR)
                continue;
            const double lod = log2(change(&c, &t, i % W + 0.5, i / W + 0.5));
            seen++;
            fine += q.color[i] - 1 < (int32_t)fmin(6, fmax(0, floor(lod + 0.5 - 0.1)));
        }
        assert_int_equal(q.err, ZS_OK);
        assert_int_equal(seen, pixels[k]);
        assert_int_equal(fine, 0);
        picture_free(&q);
    }
}

/* Along each row of each triangle the level goes one way with the distance, to the horizon: a floor of 2^-21 of w. */
static void stress_36_levels_to_the_horizon(void **state)
{
    static struct card c;
    const struct zs_texture t = chain_texture(8, 8);
    const int32_t corner[3] = { -16000, -16, -8 }, a[3] = { 32000, 0, 0 }, b[3] = { 0, 0, -32000 };
    const int32_t uv[3][2] = { { -32768, -32768 }, { 65535, 0 }, { 0, 65535 } };
    card_set(&c, corner, a, b, uv, 6, &zs_shade_mipmap, &t);
    const struct card *const one = &c;
    struct picture q = card_draw(&one, 1, NULL);
    assert_int_equal(q.err, ZS_OK);
    uint32_t seen = 0, coarse = 0;
    for (int32_t x = 0; x < W; x++) {
        int32_t before = 100; /* from the horizon down */
        for (int32_t y = 0; y < H; y++) {
            if (q.key[y * W + x] == ZS_DEPTH_CLEAR)
                continue;
            const int32_t level = q.color[y * W + x] - 1;
            assert_true(level >= 0 && level <= 8 && level <= before);
            before = level;
            seen++;
            coarse += level == 8;
        }
    }
    assert_true(seen > W * H / 3 && coarse > W);
    picture_free(&q);
}

/* ---- The alpha test --------------------------------------------------------------------------- */

static int below(const struct zs_depth_state *s, uint16_t key, uint16_t there)
{
    return !s || s->func == ZS_DEPTH_LESS ? key < there : s->func == ZS_DEPTH_ALWAYS || key <= there;
}

static uint32_t cut_out, cut_in, cut_lost;

/* A card in front of, behind and through another one: each pixel is what it was, or has the card's colour and key: what
 * the card alone shows there with its colours, with its alphas, and with keys. */
static int cutout_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct image m, alphas;
    static struct card c, back;
    static const struct zs_shader *const cuts[3] = { &zs_shade_cutout, &zs_shade_cutout_flat,
                                                     &zs_shade_cutout_smooth };
    static const struct zs_shader *const plain[3] = { &zs_shade_texture, &zs_shade_texture_flat,
                                                      &zs_shade_texture_smooth };
    static const struct zs_depth *const mappings[4] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_float,
                                                        &zs_depth_none };
    const uint32_t kind = prng_pick(&p, 3), map = prng_pick(&p, 4);
    const struct zs_depth_state state = { .func = (uint8_t)prng_pick(&p, 3),
                                          .read_only = (uint8_t)prng_pick(&p, 2),
                                          .bias = (int16_t)(prng_pick(&p, 2) ? 0 : prng_range(&p, -32768, 32767)),
                                          .slope_bias = (int16_t)(prng_pick(&p, 2) ? 0 : prng_range(&p, -512, 512)) };
    const int stated = (int)prng_pick(&p, 2);
    const int32_t corner[3] = { prng_range(&p, -300, 0), prng_range(&p, -300, 0), -prng_range(&p, 20, 400) };
    const int32_t a[3] = { prng_range(&p, 50, 400), prng_range(&p, -50, 50), -prng_range(&p, 0, 600) };
    const int32_t b[3] = { prng_range(&p, -50, 50), prng_range(&p, 50, 400), -prng_range(&p, 0, 600) };
    const int32_t uv[3][2] = { { prng_range(&p, -5000, 5000), prng_range(&p, -5000, 5000) },
                               { prng_range(&p, -9000, 9000), prng_range(&p, -3000, 3000) },
                               { prng_range(&p, -3000, 3000), prng_range(&p, -9000, 9000) } };
    const int32_t wall[3] = { -1000, -1000, -prng_range(&p, 20, 900) },
                  right[3] = { 2000, 0, prng_range(&p, -10, 10) }, up[3] = { 0, 2000, 0 }, none[3][2] = { { 0, 0 } };
    depth_used = mappings[map];
    image_any(&p, &m, formats[prng_pick(&p, FORMATS)], prng_pick(&p, SIDE_LOG2 + 1), prng_pick(&p, SIDE_LOG2 + 1));
    m.texture.alpha_least = (uint8_t)(prng_pick(&p, 2) ? 0 : prng_pick(&p, 256));
    const uint32_t least = m.texture.alpha_least ? m.texture.alpha_least : 128;
    alphas.texture = m.texture;
    alphas.texture.format = &zs_texel_565;
    alphas.texture.texel = alphas.texel;
    alphas.texture.palette = NULL;
    for (uint32_t i = 0; i < 1u << (m.texture.log2_w + m.texture.log2_h); i++) {
        double rgb[3];
        uint32_t alpha;
        decode(&m.texture, i & ((1u << m.texture.log2_w) - 1u), i >> m.texture.log2_w, rgb, &alpha);
        alphas.texel[i] = (uint16_t)(alpha >= least ? 1 : 2);
    }
    card_set(&back, wall, right, up, none, 12, &zs_shade_raw, NULL);
    card_set(&c, corner, a, b, uv, 12, cuts[kind], &m.texture);
    const struct card *const both[2] = { &back, &c }, *const alone = &c;
    const struct zs_depth_state *of = stated ? &state : NULL,
                                bias = { .bias = state.bias, .slope_bias = state.slope_bias };
    struct zs_config any = picture_config(W, H, depth_used);
    c.instance.depth_state = of;
    struct picture got = card_draw(both, 2, NULL);
    picture_any_way(&p, &any, 2, 6);
    struct picture again = card_draw(both, 2, &any);
    struct picture was = card_draw(both, 1, NULL);
    c.instance.depth_state = stated ? &bias : NULL;
    c.material.shader = plain[kind];
    struct picture color = card_draw(&alone, 1, NULL); /* key and colour of each pixel of the card */
    c.material.shader = &zs_shade_texture;
    c.material.texture = &alphas.texture;
    struct picture mask = card_draw(&alone, 1, NULL);
    depth_used = &zs_depth_recip;
    CASE_CHECK(!got.err && !again.err && !was.err && !color.err && !mask.err);
    CASE_CHECK(picture_same(&got, &again, "another way"));
    for (int32_t i = 0; i < W * H; i++) {
        const int drawn = mask.color[i] == 1, in = drawn && (map == 3 || below(of, color.key[i], was.key[i]));
        const uint16_t want = in ? color.color[i] : was.color[i];
        const uint16_t key = in && !(of && of->read_only) ? color.key[i] : was.key[i];
        if (got.color[i] != want || got.key[i] != key)
            return case_wrong("pixel %d, %d: %04x, key %u; %04x, key %u expected", i % W, i / W, got.color[i],
                              got.key[i], want, key);
        cut_out += mask.color[i] == 2;
        cut_in += (uint32_t)in;
        cut_lost += drawn && !in;
    }
    PICTURES_FREE(&got, &again, &was, &color, &mask);
    return 1;
}

/* ---- The same in any way ---------------------------------------------------------------------- */

static const struct zs_shader *const shaders[] = {
    &zs_shade_bilinear,        &zs_shade_bilinear_flat,        &zs_shade_bilinear_smooth,
    &zs_shade_mipmap,          &zs_shade_mipmap_flat,          &zs_shade_mipmap_smooth,
    &zs_shade_mipmap_bilinear, &zs_shade_mipmap_bilinear_flat, &zs_shade_mipmap_bilinear_smooth,
    &zs_shade_cutout,          &zs_shade_cutout_flat,          &zs_shade_cutout_smooth,
    &zs_shade_texture,         &zs_shade_texture_flat,         &zs_shade_texture_smooth
};

static int any_way_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct image m[4];
    static struct card c[4];
    const struct card *const all[4] = { &c[0], &c[1], &c[2], &c[3] };
    int cut = 0;
    for (int k = 0; k < 4; k++) {
        const int32_t corner[3] = { prng_range(&p, -900, 300), prng_range(&p, -900, 300), -prng_range(&p, 4, 400) };
        const int32_t a[3] = { prng_range(&p, 50, 900), prng_range(&p, -50, 50), -prng_range(&p, 0, 900) };
        const int32_t b[3] = { prng_range(&p, -50, 50), prng_range(&p, 50, 900), -prng_range(&p, 0, 900) };
        const int32_t far = prng_pick(&p, 3) ? 4000 : 10000;
        const uint32_t of = prng_pick(&p, 15);
        const int32_t uv[3][2] = { { prng_range(&p, -far, far), prng_range(&p, -far, far) },
                                   { prng_range(&p, -far, far), prng_range(&p, -far, far) },
                                   { prng_range(&p, -far, far), prng_range(&p, -far, far) } };
        image_any(&p, &m[k], formats[prng_pick(&p, FORMATS)], prng_pick(&p, SIDE_LOG2 + 1),
                  prng_pick(&p, SIDE_LOG2 + 1));
        const uint32_t w = m[k].texture.log2_w - (m[k].texture.format->log2_bits == 2u), h = m[k].texture.log2_h;
        m[k].texture.n_levels = (uint8_t)prng_pick(&p, 2 + (w < h ? w : h));
        card_set(&c[k], corner, a, b, uv, (uint8_t)prng_range(&p, 5, 15), shaders[of], &m[k].texture);
        cut |= of >= 9 && of < 12;
    }
    struct zs_config any = picture_config(W, H, &zs_depth_float);
    depth_used = &zs_depth_float;
    struct picture one = card_draw(all, 4, NULL);
    depth_used = &zs_depth_recip;
    picture_any_way(&p, &any, 2, 6);
    struct picture other = card_draw(all, 4, &any);
    CASE_CHECK(!one.err && !other.err && picture_same(&one, &other, "another way"));
    picture_free(&other);
    any.method = &zs_method_raycast;
    any.max_tris = 64;
    any.max_verts = 64;
    other = card_draw(all, 4, &any);
    CASE_CHECK(other.err == (cut ? ZS_ERR_DEPTH : ZS_OK));
    CASE_CHECK(cut || !memcmp(one.color, other.color, W * H * 2));
    PICTURES_FREE(&one, &other);
    return 1;
}

static unsigned worlds_drawn, worlds_hiz;

/* Random worlds, their textured materials with these shaders: any way to draw them, and by the hierarchical depth
 * buffer where no texel is cut out. Each frame is what it was. */
static int world_case(uint64_t seed)
{
    struct prng p = { seed };
    static const struct zs_depth *const mappings[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_float };
    static const struct zs_method *const methods[] = { NULL, &zs_method_hiz };
    static struct image m[WORLD_TEXTURES];
    struct world w;
    int cut = 0, textured = 0;
    world_make(&w, &p, 0);
    for (int k = 0; k < WORLD_TEXTURES; k++)
        if (prng_pick(&p, 2)) {
            image_any(&p, &m[k], formats[prng_pick(&p, FORMATS)], prng_pick(&p, 7), prng_pick(&p, 7));
            const uint32_t across = m[k].texture.log2_w + (m[k].texture.format->log2_bits != 2u);
            const uint32_t down = m[k].texture.log2_h + 1u;
            m[k].texture.n_levels = (uint8_t)prng_pick(&p, 1u + (across < down ? across : down));
            w.texture[k] = m[k].texture;
        }
    for (int k = 0; k < WORLD_MATERIALS; k++) {
        const struct zs_shader *const was = w.material[k].shader;
        const uint32_t kind = was == &zs_shade_texture          ? 0
                              : was == &zs_shade_texture_flat   ? 1
                              : was == &zs_shade_texture_smooth ? 2
                                                                : 3;
        if (kind == 3)
            continue;
        const uint32_t of = prng_pick(&p, 5); /* 4: it stays */
        w.material[k].shader = shaders[3 * of + kind];
        cut |= of == 3;
        textured = 1;
    }
    struct zs_config c = picture_config(prng_range(&p, 1, 80), prng_range(&p, 1, 60), mappings[prng_pick(&p, 3)]);
    c.varyings = ZS_VARYINGS_MAX;
    struct picture want = picture_draw(&c, &w.scene, &w.camera);
    int right = 1;
    if (!want.err) {
        picture_any_way(&p, &c, 4, 6);
        c.method = cut ? NULL : methods[prng_pick(&p, 2)];
        struct picture is = picture_draw(&c, &w.scene, &w.camera);
        right = !is.err && picture_same(&want, &is, "a world");
        worlds_drawn += textured && right;
        worlds_hiz += textured && c.method == &zs_method_hiz;
        picture_free(&is);
    }
    picture_free(&want);
    world_free(&w);
    return right;
}

/* ---- Stress ----------------------------------------------------------------------------------- */

/* One texel: the picture is that of the nearest texel, whatever the filter. */
static void stress_37_one_texel(void **state)
{
    static const uint16_t texel = 0xa5c7;
    static struct card c;
    const struct card *const one = &c;
    const int32_t corner[3] = { -200, -100, -30 }, a[3] = { 400, 0, -300 }, b[3] = { 0, 200, -10 };
    const int32_t uv[3][2] = { { -32768, -32768 }, { 65535, 0 }, { 0, 65535 } };
    for (uint32_t clamp = 0; clamp < 4; clamp++) {
        const struct zs_texture t = {
            .format = &zs_texel_565, .texel = &texel, .n_levels = 1, .clamp = (uint8_t)clamp
        };
        card_set(&c, corner, a, b, uv, (uint8_t)(5 * clamp), &zs_shade_texture, &t);
        struct picture want = card_draw(&one, 1, NULL);
        for (int k = 0; k < 12; k += 3) {
            c.material.shader = shaders[k];
            struct picture got = card_draw(&one, 1, NULL);
            assert_true(!got.err && picture_same(&want, &got, "one texel"));
            picture_free(&got);
        }
        picture_free(&want);
    }
}

/* A card of a thousandth of a texel to each pixel: from pixel to pixel a colour changes by no more than a weight of
 * 1/32 does, two codes of green, also where the texture wraps. */
static void stress_38_magnified(void **state)
{
    static const uint16_t texel[4] = { 0x0000, 0xffff, 0xf81f, 0x07e0 };
    static struct card c;
    const struct card *const one = &c;
    const struct zs_texture t = { .format = &zs_texel_565, .texel = texel, .log2_w = 1, .log2_h = 1 };
    const int32_t corner[3] = { -96, -64, -64 }, a[3] = { 192, 0, 0 }, b[3] = { 0, 128, 0 };
    for (int32_t from = -32768; from < 32760; from += 2048) {
        const int32_t uv[3][2] = { { from, from }, { 1600, 0 }, { 0, 1000 } };
        card_set(&c, corner, a, b, uv, 15, &zs_shade_bilinear, &t);
        struct picture q = card_draw(&one, 1, NULL);
        assert_int_equal(q.err, ZS_OK);
        for (int32_t i = 1; i < W * H; i++)
            for (int32_t shift = 0; shift < 16 && i % W; shift += shift ? 6 : 5) {
                const int32_t mask = shift == 5 ? 63 : 31;
                assert_true(abs((q.color[i] >> shift & mask) - (q.color[i - 1] >> shift & mask)) <= 2);
            }
        picture_free(&q);
    }
}

/* Coordinates at the ends of int16, clamped: beyond the border, the corner's texel. */
static void stress_39_ends_of_range(void **state)
{
    static struct image m;
    static struct card c;
    const struct card *const one = &c;
    const int32_t corner[3] = { -96, -64, -64 }, a[3] = { 192, 0, 0 }, b[3] = { 0, 128, 0 };
    const int32_t uv[3][2] = { { -32768, -32768 }, { 65535, 0 }, { 0, 65535 } };
    slope_texture(&m, ZS_CLAMP_U | ZS_CLAMP_V);
    m.texel[0] = 1;
    m.texel[31] = 2;
    m.texel[31 * 32] = 3;
    m.texel[1023] = 4;
    for (uint8_t bits = 4; bits < 15; bits++) {
        card_set(&c, corner, a, b, uv, bits, &zs_shade_bilinear, &m.texture);
        struct picture q = card_draw(&one, 1, NULL);
        assert_int_equal(q.err, ZS_OK);
        assert_int_equal(q.color[(H - 1) * W], 1); /* v grows upwards here */
        assert_int_equal(q.color[H * W - 1], 2);
        assert_int_equal(q.color[0], 3);
        assert_int_equal(q.color[W - 1], 4);
        picture_free(&q);
    }
}

/* A texture that is lit as a palette, filtered, then lit again: accelerators do not take one for the other. */
static void stress_40_one_texture_in_turns(void **state)
{
    struct prng p = { 1 };
    static struct image m;
    static struct card c[3];
    const struct card *const all[3] = { &c[0], &c[1], &c[2] };
    struct zs_config plain = picture_config(W, H, &zs_depth_recip);
    image_any(&p, &m, &zs_texel_pal4, 4, 4);
    for (int32_t k = 0; k < 3; k++) {
        const int32_t corner[3] = { -96 + 64 * k, -64, -64 }, a[3] = { 60, 0, 0 }, b[3] = { 0, 128, 0 };
        const int32_t uv[3][2] = { { 0, 0 }, { 4096, 0 }, { 0, 4096 } };
        card_set(&c[k], corner, a, b, uv, 12, k == 1 ? &zs_shade_bilinear_flat : &zs_shade_texture_flat, &m.texture);
    }
    plain.fast = NULL;
    struct picture fast = card_draw(all, 3, NULL), slow = card_draw(all, 3, &plain);
    assert_true(!fast.err && picture_same(&slow, &fast, "in turns"));
    PICTURES_FREE(&fast, &slow);
}

/* ---- Refused ---------------------------------------------------------------------------------- */

static int error_of(const struct zs_shader *shader, const struct zs_texture *t, const struct zs_depth *depth,
                    const struct zs_method *method)
{
    static struct card c;
    const struct card *const one = &c;
    const int32_t corner[3] = { -96, -64, -64 }, a[3] = { 192, 0, 0 }, b[3] = { 0, 128, 0 }, uv[3][2] = { { 0, 0 } };
    struct zs_config config = picture_config(W, H, depth);
    config.method = method;
    card_set(&c, corner, a, b, uv, 12, shader, t);
    struct picture q = card_draw(&one, 1, &config);
    const int err = q.err;
    picture_free(&q);
    return err;
}

static void refused(void **state)
{
    static uint16_t palette[16];
    static uint8_t two[64];
    struct zs_texture t = chain_texture(5, 3);
    for (int k = 0; k < 12; k++) {
        assert_int_equal(error_of(shaders[k], NULL, &zs_depth_recip, NULL), ZS_ERR_NULL);
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_recip, NULL), ZS_OK);
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_none, &zs_method_painter), ZS_OK);
    }
    for (int k = 0; k < 12; k++) {
        t.n_levels = 5; /* its least is 4 x 1 */
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_recip, NULL), k >= 3 && k < 9 ? ZS_ERR_TEXTURE : ZS_OK);
        t.n_levels = 4;
        const int wall = k >= 9 ? ZS_ERR_DEPTH : ZS_OK;
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_recip, &zs_method_hiz), wall);
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_recip, &zs_method_raycast), wall);
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_order, &zs_method_coverage), wall);
        assert_int_equal(error_of(shaders[k], &t, &zs_depth_order, &zs_method_depthsort), wall);
    }
    struct zs_texture four = {
        .format = &zs_texel_pal4, .texel = two, .palette = palette, .n_colors = 16, .log2_w = 2, .log2_h = 2,
        .n_levels = 2
    };
    assert_int_equal(error_of(&zs_shade_mipmap, &four, &zs_depth_recip, NULL), ZS_OK);
    four.n_levels = 3; /* one texel is half a byte */
    assert_int_equal(error_of(&zs_shade_mipmap, &four, &zs_depth_recip, NULL), ZS_ERR_TEXTURE);
    four.palette = NULL;
    four.format = &zs_texel_pal4a;
    assert_int_equal(error_of(&zs_shade_cutout, &four, &zs_depth_recip, NULL), ZS_ERR_NULL);
}

/* As zs_texture_check has it, for all formats, levels too. */
static void checked(void **state)
{
    static uint16_t palette[32];
    static uint8_t two[129] __attribute__((aligned(2)));
    uint32_t at;
    for (uint32_t f = 0; f < FORMATS; f++) {
        const int paletted = f % 3 != 0, four = f % 3 == 2;
        struct zs_texture t = {
            .format = formats[f], .texel = two, .palette = paletted ? palette : NULL,
            .n_colors = (uint16_t)(paletted ? 15 : 0), .log2_w = 3, .log2_h = 2, .n_levels = 3
        };
        memset(two, 0, sizeof two);
        assert_int_equal(zs_alpha_texture_check(&t, NULL), ZS_FLAW_NONE);
        assert_int_equal(zs_texture_check(&t, NULL), f < 3 ? ZS_FLAW_NONE : ZS_FLAW_NULL);
        t.n_levels = 4;
        assert_int_equal(zs_alpha_texture_check(&t, &at), ZS_FLAW_LEVELS);
        assert_int_equal(at, 4);
        t.log2_h = 3;
        assert_int_equal(zs_alpha_texture_check(&t, &at), four ? ZS_FLAW_LEVELS : ZS_FLAW_NONE);
        t.n_levels = 3;
        two[four ? 32 + 8 : 64 + 16] = 15; /* the first texel of level 2 */
        assert_int_equal(zs_alpha_texture_check(&t, &at), paletted ? ZS_FLAW_TEXEL : ZS_FLAW_NONE);
        assert_int_equal(at, paletted ? 80 : 0);
        t.n_levels = 2;
        assert_int_equal(zs_alpha_texture_check(&t, &at), ZS_FLAW_NONE);
        memset(two, 0, sizeof two);
        t.texel = two + 1;
        assert_int_equal(zs_alpha_texture_check(&t, &at), paletted ? ZS_FLAW_NONE : ZS_FLAW_ALIGN);
        t.texel = NULL;
        assert_int_equal(zs_alpha_texture_check(&t, &at), ZS_FLAW_NULL);
    }
    assert_int_equal(zs_alpha_texture_check(NULL, &at), ZS_FLAW_NULL);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernel_right),
        CASES_TEST(alpha, alpha_case, 5000),
        CASES_TEST(frames, frame_case, 200),
        cmocka_unit_test(levels_close),
        cmocka_unit_test(levels_of_cut_cards),
        cmocka_unit_test(stress_36_levels_to_the_horizon),
        CASES_COUNTS(cutouts, cutout_case, 300,
                     { "pixels that a texture cuts out", &cut_out, 20000 },
                     { "pixels that it leaves", &cut_in, 20000 },
                     { "pixels that the other rule would draw", &cut_lost, 20000 }),
        CASES_TEST(any_way, any_way_case, 150),
        CASES_COUNTS(worlds, world_case, 250, { "worlds", &worlds_drawn, 60 }, { "worlds of hiz", &worlds_hiz, 12 }),
        cmocka_unit_test(stress_37_one_texel),
        cmocka_unit_test(stress_38_magnified),
        cmocka_unit_test(stress_39_ends_of_range),
        cmocka_unit_test(stress_40_one_texture_in_turns),
        cmocka_unit_test(refused),
        cmocka_unit_test(checked),
    };
    cases_program = argv[0];
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
