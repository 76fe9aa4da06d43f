/* Smooth (Gouraud) shading: colours are lit at the vertices and interpolated perspective-correctly.
 *
 * Colours are kept as codes, the values of RGB565 channels (0 .. 31, 0 .. 63), with 16 fraction
 * bits. shade/persp.h explains the interpolation. The error bound is 1/4 code; sub-spans have up to
 * 16 pixels.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/plane.h"
#include "zs_shader.h"
#include "shade/persp.h"
#include "shade/stages.h"

#define SUB_LOG2_MAX 4u

/* The factor from a channel, 0 .. 65535, to codes in uq16_16: 31 or 63 times 2^16 / 65535 * 2^16,
 * nearest. */
#define CODE_SCALE(most) ((most)*65537u)

#define UP5 11u /* shift that moves the top bit of a 5-bit code, uq16_16, to the top of a word */
#define UP6 10u /* the same for 6 bits */

static const uint32_t code_scale[3] = { CODE_SCALE(31u), CODE_SCALE(63u), CODE_SCALE(31u) };

void zs_smooth_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const struct zs_instance *in = s->instance;
    const struct zs_rgb *c = in->mesh->vertex_rgb ? &in->mesh->vertex_rgb[v] : &in->material->rgb;
    const uint32_t light = zs_light_intensity(s, in->mesh->normal[v]);
    out[0] = (uint16_t)zs_light_channel(c->r, light);
    out[1] = (uint16_t)zs_light_channel(c->g, light);
    out[2] = (uint16_t)zs_light_channel(c->b, light);
}

int zs_smooth_usable(const struct zs_instance *in, const struct zs_config *config)
{
    (void)config;
    return in->mesh->normal ? ZS_OK : ZS_ERR_MESH;
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* Return the largest change of a channel over the triangle, uq0_16. */
static uint32_t color_range(const uint16_t *const a[3])
{
    uint32_t range = 0;
    for (int c = 0; c < 3; c++) {
        const int32_t lo = zs_min32(zs_min32(a[0][c], a[1][c]), a[2][c]);
        const int32_t hi = zs_max32(zs_max32(a[0][c], a[1][c]), a[2][c]);
        if (range < (uint32_t)(hi - lo))
            range = (uint32_t)(hi - lo);
    }
    return range;
}

/* Return 1 if range / 65536 * 63 codes * (change / least) / 4 <= 1/4 code, with 64 in place of 63.
 */
static int affine_enough(uint32_t range, uint32_t change, uint32_t least)
{
    /* < 2^32; a cheaper, sufficient test */
    if (range * ((change >> 16) + 1u) <= least >> (ZS_SPAN_BOUND_LOG2 + 4))
        return 1;
    return zs_mul_uu(range, change) <= (uint64_t)least
                                           << (12 - ZS_SPAN_BOUND_LOG2); /* < 2^16 * 2^32 */
}

/* Return log2 of the longest sub-span for which the bound holds anywhere in the triangle. */
static uint32_t sub_span(const struct zs_plane *w, uint32_t range, uint32_t least)
{
    const uint32_t slope = (uint32_t)((int32_t)w->gx < 0 ? 0u - w->gx : w->gx);
    uint32_t log2 = SUB_LOG2_MAX;
    while (log2 > 0 && (slope >> (31 - log2) || !affine_enough(range, slope << log2, least)))
        log2--;
    return log2;
}

/* Convert a channel to codes, uq16_16: floor(v * CODE_SCALE / 2^16). v < 2^16 */
static inline uint32_t code_of(uint32_t v, uint32_t most)
{
    const uint32_t whole = v * most; /* < 2^22 */
    return whole + (whole >> 16);
}

/* The four differences of positions over the area, which all colours share. With d1 and d2, the
 * differences of a colour from the first vertex in 1/256 codes, gx = (d1 x1 - d2 x2) 2^-down in
 * uq16_16 codes. A channel's range in uq0_16 is below 2^n, so that |d| <= 2^(n - 2).
 *
 * Extents are below 2^E, E = 15 - up. A weight is (difference 2^up) times the upper 16 bits of
 * rcp, over 2^n: |.| <= 2^(31 - n), and its unit 2^(-8 - down) a pixel. Those 16 bits are off by
 * 2^-15 of rcp in all weights alike, so that a colour is off by 2^-15 of its change: 2^-9 codes.
 * Rounding is off by 1/2, so that a colour is off by at most 2^(n - 9) 2^(-9 - down) codes for each
 * step of x and y, of which there are up to 2^(E - 8) each: 2^(n + E - down - 25), at most 2^-7
 * here. Rounding d adds 2^-9, rounding gradients 2^-17 for each of 2^8 steps, the way to the anchor
 * 2^-13. In all: 0.014 codes. */
struct weights {
    int32_t x1, x2, y1, y2, down;
};

static inline int32_t weight(int32_t difference, int32_t up, uint32_t rcp, int32_t n)
{
    return (difference * (1 << up) * (int32_t)rcp + (1 << (n - 1))) >> n; /* |.| < 2^31 */
}

/* Leave w->down if the weights would be too coarse, or gradients 2^25 or more. */
static inline void weights(const struct zs_geom *g, uint32_t range, struct weights *w)
{
    const int32_t dx1 = g->dx1, dx2 = g->dx2, dy1 = g->dy1, dy2 = g->dy2;
    const int32_t extent = (dx1 ^ dx1 >> 31) | (dx2 ^ dx2 >> 31) | dy1 | dy2; /* at least 1 */
    const int32_t up = zs_clz32((uint32_t)extent) - 17, n = 32 - zs_clz32(range | 1u);
    const int32_t down = 31 + up + g->exp - n; /* at most 29, as area <= 2^(31 - 2 up) */
    if (g->rcp == 0 || up < 0 || down < 5 || n > 3 + up + down)
        return;
    const uint32_t rcp = g->rcp >> 16; /* [2^15, 2^16) */
    w->x1 = weight(dy2, up, rcp, n);
    w->x2 = weight(dy1, up, rcp, n);
    w->y1 = weight(dx2, up, rcp, n);
    w->y2 = weight(dx1, up, rcp, n);
    w->down = down;
}

/* Move a plane of codes to column 0 of row 0, add half a code, and shift it to the top of words. */
static inline void raise(const struct zs_geom *g, int c, struct zs_plane *out)
{
    const uint32_t up = c == 1 ? UP6 : UP5;
    zs_plane_origin(g, out);
    out->base = (out->base + 0x8000u) << up; /* <= 63.5 codes at covered pixels */
    out->gx <<= up;
    out->gy <<= up;
}

/* Compute the gradients of a colour by the weights. */
static inline void weighted_plane(const struct zs_geom *g, const struct weights *w,
                                  const uint16_t *const a[3], int c, struct zs_plane *out)
{
    const int32_t most = (int32_t)(code_scale[c] & 0xffffu), v0 = a[0][c], down = w->down;
    const int32_t d1 = ((a[1][c] - v0) * most + 128) >> 8, d2 = ((a[2][c] - v0) * most + 128) >> 8;
    const int32_t half = 1 << (down - 1); /* sums are at most 2^30 */
    const int32_t gx = (d1 * w->x1 - d2 * w->x2 + half) >> down;
    const int32_t gy = (d2 * w->y2 - d1 * w->y1 + half) >> down;
    out->gx = (uint32_t)gx;
    out->gy = (uint32_t)gy;
    out->base = code_of((uint32_t)v0, (uint32_t)most) +
                (uint32_t)(((gx >> 3) * g->ax + (gy >> 3) * g->ay + 16) >> 5); /* |a| <= 2^7 */
}

#if ZS_SET_UP
#define SELDOM ZS_RARE /* fast/smooth_start.c takes most triangles */
#else
#define SELDOM ZS_IN_ORDER
#endif

/* Compute the gradients of the colours: codes in the top bits of words, with half a code added. */
SELDOM static ZS_NOINLINE void affine_planes(struct zs_job *job, const uint16_t *const a[3],
                                                  uint32_t range)
{
    const struct zs_geom *g = &job->geom;
    struct weights w = { 0 };
    weights(g, range, &w);
    for (int c = 0; c < 3; c++) {
        const uint32_t most = code_scale[c] & 0xffffu;
        if (w.down)
            weighted_plane(g, &w, a, c, &job->c[c]);
        else
            zs_plane32(g, code_of(a[0][c], most), code_of(a[1][c], most), code_of(a[2][c], most),
                       ZS_PLANE_KEY, &job->c[c]);
        raise(g, c, &job->c[c]);
    }
}

/* Compute the gradients of colour times w. */
static void persp_planes(struct zs_job *job, const uint16_t *const a[3], const uint32_t w[3])
{
    for (int c = 0; c < 3; c++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = zs_umulh((uint32_t)a[k][c] << 16, w[k]);
        zs_persp_plane(&job->geom, v, ZS_PLANE_WIDE, &job->c[c]);
    }
}

/* Set-up if the keys alone do not show that colours may be affine: find out from w. */
static ZS_NOINLINE void start_by_w(struct zs_job *job, const uint16_t *const a[3], uint32_t range)
{
    uint32_t w[3], least;
    zs_persp_w(job, w);
    const uint32_t change = zs_persp_change(w, &least);
    if (affine_enough(range, change, least)) {
        affine_planes(job, a, range);
        return;
    }
    zs_persp_plane(&job->geom, w, ZS_PLANE_WIDE, &job->w);
    job->sub_log2 = sub_span(&job->w, range, least);
    persp_planes(job, a, w);
}

void zs_smooth_start(struct zs_job *job)
{
    const uint16_t *a[3];
    zs_persp_attrs(job, a);
    const uint32_t range = color_range(a);
    uint32_t change;
    job->sub_log2 = ZS_AFFINE;
    if (zs_persp_slow(job, &change) && affine_enough(range, change, job->r->view.key_slow))
        affine_planes(job, a, range);
    else
        start_by_w(job, a, range);
}

/* ---- Runs ------------------------------------------------------------------------------------ */

/* Fill n > 0 pixels with colours that change by by_red and so on. Values, not arrays: they stay in
 * registers. */
ZS_ALWAYS_INLINE void fill_linear(uint16_t *out, int32_t n, uint32_t red, uint32_t green,
                                  uint32_t blue, uint32_t by_red, uint32_t by_green,
                                  uint32_t by_blue)
{
    for (uint16_t *const end = out + n; out != end; out++) {
        *out = zs_smooth_pack(red, green, blue);
        red += by_red;
        green += by_green;
        blue += by_blue;
    }
}

/* Convert a level, uq1_31, to codes, uq16_16: floor(2 level scale / 2^32); scale: CODE_SCALE(most).
 * Armv6-M: P = 2 level most is high 2^16 + low, by products below 2^22: it is (P 2^16 + P) / 2^32.
 */
static inline uint32_t codes(uint32_t level, uint32_t scale)
{
    if (!ZS_CROSS_SHORT)
        return zs_umulh(level << 1, scale);
    const uint32_t most = scale & 0xffffu, low = (level << 1 & 0xffffu) * most;
    const uint32_t high = (level >> 15) * most + (low >> 16);
    return high + (((low & 0xffffu) + high) >> 16);
}

ZS_IN_ORDER ZS_NOINLINE void zs_smooth_at(const struct zs_job *job, int32_t i, int32_t row,
                                          uint32_t out[3])
{
    uint32_t w;
    int32_t lz;
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    for (int c = 0; c < 3; c++) {
        const uint32_t level = zs_persp_over(zs_plane_at(&job->c[c], i, row), w, rcp, lz);
        out[c] = codes(level, code_scale[c]) + 0x8000u; /* <= 63.5 codes */
    }
}

/* each() of a row's last sub-span, which is shorter. */
static ZS_NOINLINE __attribute__((unused)) uint32_t each_of_last(int32_t change, uint32_t over)
{
    return (uint32_t)(zs_mul_su(change, over) >> 32);
}

/* Return the change for each pixel of a sub-span: floor(change * over / 2^32), |change| < 2^22,
 * over: zs_one_over of its length. log2: 0, or that of its length; then over is 2^(32 - log2) - 1,
 * and this is floor((change - 1) / 2^log2) for change > 0, else floor(change / 2^log2). */
ZS_ALWAYS_INLINE uint32_t each(int32_t change, uint32_t over, uint32_t log2)
{
    if (!ZS_CROSS_SHORT)
        return (uint32_t)(zs_mul_su(change, over) >> 32);
    return log2 ? (uint32_t)((change + (-change >> 31)) >> log2) : each_of_last(change, over);
}

/* Fill the part of a sub-span that is in the run: n pixels, from the skip-th on. The colour changes
 * from c to next over `length` pixels; 0: the sub-span is a single pixel. log2: as in each(). */
ZS_ALWAYS_INLINE void fill_part(uint16_t *out, int32_t n, const uint32_t c[3],
                                const uint32_t next[3], int32_t length, uint32_t log2, int32_t skip)
{
    const uint32_t over = zs_one_over(length);
    const uint32_t by0 = each((int32_t)(next[0] - c[0]), over, log2), /* |.| < 2^22 */
                   by1 = each((int32_t)(next[1] - c[1]), over, log2),
                   by2 = each((int32_t)(next[2] - c[2]), over, log2);
    fill_linear(out, n, (c[0] + zs_wrap_mul(by0, skip)) << UP5,
                (c[1] + zs_wrap_mul(by1, skip)) << UP6, (c[2] + zs_wrap_mul(by2, skip)) << UP5,
                by0 << UP5, by1 << UP6, by2 << UP5);
}

void zs_smooth_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    uint16_t *color = job->color + row->at;
    if (job->sub_log2 == ZS_AFFINE) {
        const struct zs_plane *const c = job->c;
        fill_linear(color + r0, r1 - r0, zs_plane_at(&c[0], r0, row->y),
                    zs_plane_at(&c[1], r0, row->y), zs_plane_at(&c[2], r0, row->y), c[0].gx,
                    c[1].gx, c[2].gx);
        return;
    }
    uint32_t c[3], next[3];
    const int32_t length = 1 << job->sub_log2;
    int32_t from = row->x0 + ((r0 - row->x0) & -length);
    zs_smooth_at(job, from, row->y, next);
    for (; from < r1; from += length) {
        const int32_t to = zs_min32(from + length, row->x1 - 1); /* its far end: a covered pixel */
        for (int k = 0; k < 3; k++)
            c[k] = next[k];
        if (to > from)
            zs_smooth_at(job, to, row->y, next);
        const int32_t i0 = zs_max32(from, r0), i1 = zs_min32(from + length, r1);
        fill_part(color + i0, i1 - i0, c, next, to - from,
                  to - from == length ? job->sub_log2 : 0u, i0 - from);
    }
}

const struct zs_shader zs_shade_smooth = { .opaque = 1,
                                           .vertex = zs_smooth_vertex,
                                           .start = zs_smooth_start,
                                           .run = zs_smooth_run,
                                           .check = zs_smooth_usable,
                                           .n_varyings = ZS_VARYINGS_SMOOTH };
