/* Mipmaps: the level of a pixel, and the shaders that draw from it.
 *
 * rho is how many texels of the whole texture a pixel spans: the largest of the changes of u and v
 * to the next column and to the next row. The level is log2 rho, rounded to nearest: level L or a
 * coarser one where rho >= 2^(L - 1/2).
 *
 * On an affine triangle rho is constant. Else let W = w and C = U w, both linear on the screen;
 * then U changes by (C' W - C W') / W^2 to the next pixel. The numerator is linear on the screen:
 * its largest size, K, is at a corner of the box that holds what the viewport shows of the
 * triangle. rho is taken as K / W^2: exact where the numerator is the same everywhere, as it is in
 * the direction in which a plane recedes, and never too small. So the level depends on w alone,
 * never falls where w falls, and has thresholds: L or coarser where w <= sqrt(K 2^(1/2 - L)). A run
 * is cut at the pixels where w, which is linear along a scanline, passes one; they depend on
 * nothing else.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/pass.h"
#include "effect/filter.h"
#include "zs_filter.h"

#define QUARTER 0xd744fccbu        /* 2^(-1/4), uq0_32: from rho = 1 to rho = 2^(1/2), in w */
#define THREE_QUARTERS 0x9837f051u /* 2^(-3/4) */
#define ROOT_2 46341               /* uq1_15 */

static int levels_fit(const struct zs_texture *t)
{
    const uint32_t more = zs_minu32((uint32_t)t->log2_w - (t->format->log2_bits == 2), t->log2_h);
    return t->n_levels <= 1u + more;
}

static int mipmap_check(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_texture_usable(in, config);
    return err || levels_fit(in->material->texture) ? err : ZS_ERR_TEXTURE;
}

static int mipmap_check_lit(const struct zs_instance *in, const struct zs_config *config)
{
    const int err = zs_texture_lit_usable(in, config);
    return err || levels_fit(in->material->texture) ? err : ZS_ERR_TEXTURE;
}

/* ---- Levels ---------------------------------------------------------------------------------- */

/* The `fetch` of a level that is a texel wide or high: it was not so when coordinates were set
 * up. */
static void fetch_line(const struct zs_texture *t, uint16_t *out, int32_t n,
                       const struct zs_walk *walk)
{
    struct zs_walk in = *walk;
    if (t->log2_w == 0)
        in.u = in.du = 0;
    if (t->log2_h == 0)
        in.v = in.dv = 0;
    const struct zs_texel *const format = zs_texture_behind(t)->format;
    format->own(t, out, n, &in);
}

static const struct zs_texel line = { .fetch = fetch_line };

/* What a triangle keeps in memory that is a lit palette's otherwise: [0] ZS_BILINEAR_LOG2, or 0 for
 * nearest texels; from [2] on, the thresholds of w for levels 1 .. ZS_TEXTURE_LOG2_MAX, two halves
 * each, as it has words of 16 bits. */
static uint16_t *kept(const struct zs_job *job)
{
    return job->r->lit.color;
}
_Static_assert(2 * (ZS_TEXTURE_LOG2_MAX + 1) <= ZS_LIT_COLORS, "thresholds fit");

/* Draw the rest from a level of the instance's texture. */
static void level_use(struct zs_job *job, uint32_t level)
{
    const uint32_t more = kept(job)[0];
    struct zs_texture *const t = &job->r->lit.texture;
    const struct zs_texture *const whole = zs_texture_behind(t);
    const uint8_t *texel = whole->texel;
    const uint32_t log2_w = whole->log2_w - level, log2_h = whole->log2_h - level;
    uint32_t bytes = 1u << (whole->log2_w + whole->log2_h + whole->format->log2_bits) >> 3;
    for (uint32_t k = 0; k < level; k++, bytes >>= 2)
        texel += bytes;
    t->texel = texel;
    if (more) {
        zs_coordinate_less(job, 0, zs_bilinear_first(log2_w) - zs_bilinear_first(t->log2_w - more));
        zs_coordinate_less(job, 1, zs_bilinear_first(log2_h) - zs_bilinear_first(t->log2_h - more));
    } else {
        t->format = log2_w && log2_h ? whole->format : &line;
        job->gather = log2_w && log2_h && ZS_IF_FAST(job->texel) ? job->texel->gather : 0;
    }
    t->log2_w = (uint8_t)(log2_w + more);
    t->log2_h = (uint8_t)(log2_h + more);
}

static inline uint32_t threshold(const struct zs_job *job, uint32_t level)
{
    const uint16_t *const half = kept(job) + 2u * level;
    return (uint32_t)half[1] << 16 | half[0];
}

/* Set the thresholds for rho = k * 2^e / w^2. */
static void thresholds_set(struct zs_job *job, uint64_t k, int32_t e, uint32_t n_levels)
{
    const int32_t up = k ? zs_clz64(k) : 0;
    const int32_t odd = (e - up) & 1;                 /* so that the exponent of 2 is even */
    const int32_t half = (e - up + odd) >> 1;         /* floor; |.| < 64 */
    const uint32_t root = zs_isqrt64(k << up >> odd); /* rho = 1 where w = root * 2^half */
    for (uint32_t level = 1; level < n_levels; level++) {
        const uint32_t at = zs_umulh(root, level & 1u ? QUARTER : THREE_QUARTERS);
        const int32_t by = half - (int32_t)((level - 1u) >> 1);
        const uint32_t w = by <= -32                     ? 0u
                           : by <= 0                     ? at >> -by
                           : by >= 32 || at >> (32 - by) ? (at ? UINT32_MAX : 0u)
                                                         : at << by;
        kept(job)[2u * level] = (uint16_t)w;
        kept(job)[2u * level + 1u] = (uint16_t)(w >> 16);
    }
}

static uint32_t level_at(const struct zs_job *job, uint32_t n_levels, int32_t i, int32_t row)
{
    const uint32_t w = zs_persp_w_at(job, i, row);
    uint32_t level = 0;
    while (level + 1u < n_levels && w <= threshold(job, level + 1u))
        level++;
    return level;
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* The pixels of the viewport in which a triangle lies, counted from its first vertex: columns
 * at[0] .. at[1], rows at[2] .. at[3]. |.| < 2^15 */
static void box_of(const struct zs_job *job, int32_t at[4])
{
    const struct zs_geom *g = &job->geom;
    const int32_t x = job->v[0]->x >> ZS_SUBPX_BITS, y = job->v[0]->y >> ZS_SUBPX_BITS;
    const int32_t least = zs_min32(zs_min32(g->dx1, g->dx2), 0) >> ZS_SUBPX_BITS;
    const int32_t most = zs_max32(zs_max32(g->dx1, g->dx2), 0) >> ZS_SUBPX_BITS;
    at[0] = zs_max32(least, -x);
    at[1] = zs_min32(most, job->width - x);
    at[2] = zs_max32(0, job->top - y);
    at[3] = zs_min32(zs_max32(g->dy1, g->dy2) >> ZS_SUBPX_BITS, job->bottom - y);
}

/* The largest numerator K of a coordinate with perspective in that box, / 2^16. The numerator for
 * the next column is the same in a row, that for the next row in a column. w: of the vertices. */
static uint64_t numerator(const struct zs_job *job, int c, const uint16_t *const a[3],
                          const uint32_t w[3], const int32_t at[4], int32_t uv_bits)
{
    const int32_t least = zs_min32(zs_min32(a[0][c], a[1][c]), a[2][c]);
    const int32_t up = 17 - uv_bits - job->sampler.shift[c]; /* as in shade/texture.c */
    const uint32_t un = (uint32_t)(a[0][c] - least) << up;   /* < 2^16 */
    const int32_t c_g[2] = { (int32_t)job->c[c].gx, (int32_t)job->c[c].gy };
    const int32_t w_g[2] = { (int32_t)job->w.gx, (int32_t)job->w.gy };
    const int64_t turn = (zs_mul_ss(c_g[0], w_g[1]) - zs_mul_ss(c_g[1], w_g[0])) >>
                         16; /* |.| <= 2^47, as no difference reaches 2^63 */
    uint64_t most = 0;
    for (int k = 0; k < 4; k++) {
        const int down = k & 1;
        const int64_t g = c_g[down] - (zs_mul_su(w_g[down], un) >> 16); /* |.| < 2^32 */
        const int64_t first = zs_mul_su((int32_t)(g >> 1), w[0]) >> 15; /* |.| < 2^47 */
        const int64_t by = turn * at[(down ? 0 : 2) + (k >> 1)];        /* |.| < 2^62 */
        const uint64_t size = (uint64_t)zs_size64(first + (down ? -by : by));
        most = size > most ? size : most;
    }
    return most;
}

static void perspective(struct zs_job *job, const struct zs_texture *t, int32_t uv_bits)
{
    const uint16_t *a[3];
    uint32_t w[3];
    uint64_t k[2];
    int32_t e[2], at[4];
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    box_of(job, at);
    for (int c = 0; c < 2; c++) {
        k[c] = numerator(job, c, a, w, at, uv_bits);
        /* c / w is in 2^(shift - 1) repeats */
        e[c] = 16 + job->sampler.shift[c] - 1 + (c ? t->log2_h : t->log2_w); /* 2 .. 42 */
    }
    const int high = e[1] > e[0];
    const uint64_t other = k[!high] >> (e[high] - e[!high]);
    thresholds_set(job, k[high] > other ? k[high] : other, e[high], t->n_levels);
}

/* The level of an affine triangle. */
static uint32_t affine(const struct zs_job *job, const struct zs_texture *t, int32_t uv_bits)
{
    const struct zs_geom *g = &job->geom;
    const uint16_t *a[3];
    uint32_t level = 0;
    zs_persp_attrs(job, a);
    for (int c = 0; c < 2; c++) {
        const int64_t d1 = a[1][c] - a[0][c], d2 = a[2][c] - a[0][c]; /* |.| < 2^16 */
        const int64_t nx = zs_size64(
            (int64_t)zs_plane_numerator((uint64_t)d1, (uint64_t)d2, g->dy));
        const int64_t ny = zs_size64(
            (int64_t)zs_plane_numerator((uint64_t)d1, (uint64_t)d2, g->dx));
        /* < 2^39.5, 256 n / area are 2^-uv_bits repeats a pixel */
        uint64_t n = (uint64_t)(nx > ny ? nx : ny) * ROOT_2 >> 15;
        const int32_t up = 8 + (c ? t->log2_h : t->log2_w) - uv_bits; /* -7 .. 18 */
        uint64_t area = (uint64_t)g->area;                            /* < 2^45 */
        n = up > 0 ? n << up : n;                                     /* < 2^58 */
        area = up < 0 ? area << -up : area;                           /* < 2^52 */
        while (level + 1u < t->n_levels && n >= area << (level + 1u))
            level++;
    }
    return level;
}

/* Choose the levels of a triangle, whose texture is a copy already. more: as kept. */
static void levels_of(struct zs_job *job, uint16_t more)
{
    const struct zs_instance *in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_texture *const t = in->material->texture;
    kept(job)[0] = more;
    if (t->n_levels <= 1)
        level_use(job, 0);
    else if (job->sub_log2 == ZS_AFFINE)
        level_use(job, affine(job, t, in->mesh->uv_bits));
    else
        perspective(job, t, in->mesh->uv_bits);
}

static void levels(struct zs_job *job)
{
    zs_texture_instead(job);
    levels_of(job, 0);
}

static void levels_linear(struct zs_job *job)
{
    zs_bilinear_begin(job);
    levels_of(job, ZS_BILINEAR_LOG2);
}

static void mipmap_start(struct zs_job *job)
{
    zs_texture_start(job);
    levels(job);
}

static void mipmap_bilinear_start(struct zs_job *job)
{
    zs_texture_start(job);
    levels_linear(job);
}

/* ---- Runs ------------------------------------------------------------------------------------ */

typedef void run_fn(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

/* Draw pixels by `run`, a constant, each from its level. */
ZS_ALWAYS_INLINE void by_level(struct zs_job *job, const struct zs_row *row, int32_t from,
                               int32_t to, run_fn *run)
{
    const uint32_t n = job->sampler.texture->n_levels;
    if (job->sub_log2 == ZS_AFFINE || n <= 1) {
        run(job, row, from, to);
        return;
    }
    const uint32_t last = level_at(job, n, to - 1, row->y);
    while (from < to) {
        const uint32_t level = level_at(job, n, from, row->y);
        int32_t end = to, beyond = to - 1; /* `beyond` has another level, or is the last pixel */
        if (level != last) {
            for (end = from + 1; end < beyond;) {
                const int32_t middle = (end + beyond) >> 1;
                if (level_at(job, n, middle, row->y) == level)
                    end = middle + 1;
                else
                    beyond = middle;
            }
        }
        level_use(job, level);
        run(job, row, from, end);
        from = end;
    }
}

static void mipmap_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    by_level(job, row, from, to, zs_texture_run);
}

static void filtered_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    by_level(job, row, from, to, zs_filtered_run);
}

static int levels_check(const struct zs_texture *t)
{
    return levels_fit(t) ? ZS_OK : ZS_ERR_TEXTURE;
}

const struct zs_filter_kind zs_filter_levels = { .instead = levels, .run = filtered_run,
                                                 .check = levels_check };
const struct zs_filter_kind zs_filter_levels_linear = { .instead = levels_linear,
                                                        .run = filtered_run,
                                                        .check = levels_check };

ZS_FILTER_SHADERS(mipmap, mipmap_start, mipmap_run, mipmap_check, mipmap_check_lit, .opaque = 1);
ZS_FILTER_SHADERS(mipmap_bilinear, mipmap_bilinear_start, mipmap_run, mipmap_check,
                  mipmap_check_lit, .opaque = 1);
