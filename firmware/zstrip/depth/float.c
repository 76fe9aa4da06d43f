/* Keys whose step is a fixed fraction of the distance: r = near / z as an unsigned float with e
 * exponent and m = b - e mantissa bits, subtracted from 2^b, so that near has the key 0.
 *
 * With 2^-(k+1) <= r <= 2^-k and k at most 2^e - 2, octave o = 2^e - 1 - k in 1 .. 2^e - 1 (the
 * last one, 1, goes on to r = 0 with the same step):
 *   code(r) = (o - 1) 2^m + r 2^(k+1+m),   key = 2^b - code
 * The key is continuous in r, and linear in r within each octave; r is linear on the screen. So
 *
 * - if the vertices of a triangle are in one octave, its keys are linear on the screen. It is drawn
 *   by the same code, at the same cost for each pixel, as reciprocal keys;
 * - for any other triangle, r is interpolated over the screen in 64 bits. A scanline is split where
 *   an octave ends, and within each part keys are linear again. The extra work for a scanline is a
 *   count of leading zeros at each end and, if it does cross an octave, a bisection. No pixel is
 *   encoded by itself, on cores with a CLZ instruction and on those without;
 * - if that triangle is tiny (core/job.h) and its vertices are in two adjacent octaves, 32 bits
 *   suffice for r.
 *
 * zs_vertex.d is the key in uq16_16. That is a float with m + 16 mantissa bits (27 to 29 in 16-bit
 * keys), and r is computed from it exactly.
 *
 * view.key_slow: an octave has 2^m steps. If two keys differ by D <= 2^m, w changes by at most D /
 * 2^m of the least w. Within one octave that is direct. Otherwise let the farther key be s below
 * the border to the nearer one's octave, s <= D: the change is (s + 2 (D - s)) / (2^(m+1) - s).
 *
 * Errors of a key, as parts of a bucket:
 *   vertex        r from 32-bit mantissas and a reciprocal of 2^-30: below 2^-29 of r, at most
 *                 2^-15; stored to 2^-17
 *   one octave    plane.c: at most the larger of 0.0035 and (W + H + 1) / 2^17
 *   more octaves  w = r scaled to below 2^39, rounded: 2^-39 of the nearest vertex's r; with rho
 *                 the ratio of the farthest vertex to the nearest that is rho 2^-39 of the
 *                 farthest's, or rho 2^(m-38) buckets: below 2^-5 at m = 13 for rho < 2^20, and
 *                 for e3m13, e4m12 never above 2^-17, because beyond 2^7 or 2^15 times near a
 *                 bucket's width in r stays. Steps of w are 2^-24 ulp: nothing. The key of a
 *                 piece's first pixel and its step are rounded to 2^-16: (W + 1) / 2^17 at the
 *                 most
 *   two, tiny     w = r scaled so that the nearer octave ends at 2^31: the vertices' are exact. A
 *                 bucket of it is 2^17 ulp or more, of the farther one 2^16; plane.c, 128 steps:
 *                 0.88 * 128 + 1.4 = 114 ulp. Rounding of a piece's first pixel and its steps, in
 *                 the nearer one: 129 / 2^17. At the most 0.0019
 *
 * SPDX-License-Identifier: MIT
 */
#include "arch/screen_v7m.h"
#include "core/depth.h"
#include "core/fx.h"
#include "core/plane.h"
#include "core/rows.h"

static ZS_RARE int float_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits,
                               uint32_t exponent_bits)
{
    if (!view->perspective)
        return ZS_ERR_DEPTH; /* with an orthographic camera, near / z is not linear on the screen */
    view->screen_linear = view->pixelwise = 0;
    view->key_top = ((1u << bits) - 1u) << 16;
    view->key_octaves = (uint8_t)((1u << exponent_bits) - 1u);
    /* near = key_mul / 2^key_shift camera units */
    const int lz = zs_clz64((uint64_t)camera->z_near);
    view->key_mul = (uint32_t)((uint64_t)camera->z_near << lz >> 32);
    view->key_shift = lz - 16 - view->shift;
    view->key_lz = view->key_octaves - 1 - view->key_shift;
    view->key_fraction = (uint8_t)(bits - exponent_bits + 16u);
    view->key_common = (uint8_t)(view->key_octaves - 1u);
    view->key_code = view->key_top + 0x10000u - (1u << view->key_fraction);
    view->piece_base = view->key_top + 0xffffu;
    view->piece_shift = view->key_fraction;
    view->key_far = 0;
    view->key_slow = (1u << view->key_fraction) - 1u;
    /* all but the last octave */
    view->key_known = view->key_top + 0xffffu - (2u << view->key_fraction);
    return ZS_OK;
}

/* Return 1 if far <= near * 2^log2. */
static int within(const struct zs_camera *camera, int log2)
{
    return (camera->z_far - 1) >> log2 < camera->z_near;
}

/* Choose the finest of the three formats that keeps its step up to far. */
static int any_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    return float_setup(view, camera, bits, within(camera, 7) ? 3u : within(camera, 15) ? 4u : 5u);
}

static int e3_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    return float_setup(view, camera, bits, 3);
}

static int e4_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    return float_setup(view, camera, bits, 4);
}

static int e5_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    return float_setup(view, camera, bits, 5);
}

/* Return the code minus 2^-16, uq16_16. The code itself is 2^16 at near in 16-bit keys, and would
 * need one more bit. */
static inline uint32_t below_code(const struct zs_view *view, uint32_t key)
{
    return view->key_top + 0xffffu - key;
}

/* Return the key of r = p / 2^32 * 2^(octave - last), p >= 2^31, in the special cases: nearer than
 * near, and the farthest octaves. */
static ZS_RARE ZS_NOINLINE uint32_t last_vertex(const struct zs_view *view, uint32_t p,
                                                int32_t octave)
{
    const int32_t m = view->key_fraction, last = view->key_octaves; /* m: 19 .. 29 */
    if (octave > last)
        return 0; /* at near, up to the rounding of z */
    const int32_t shift = 31 - m + (octave < 1 ? 1 - octave : 0);
    /* 16 bits: no room */
    const uint32_t last_key = view->key_top + (view->key_top < 0xffff0000u ? 0xffffu : 0u);
    if (shift > 31)
        return last_key;
    const uint32_t code = ((p >> (shift - 1)) + 1u) >> 1; /* 2 <= shift */
    /* the right side is modulo 2^32: 1 or 2^16 */
    if (code <= view->key_top + 0x10000u - last_key && octave < last)
        return last_key;
    return view->key_top + 0x10000u - code; /* modulo 2^32: 0 where code came to 2^32 */
}

uint32_t zs_float_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    (void)z;
    uint32_t p = zs_umulh(view->key_mul, rcp); /* [2^30, 2^32): r = p / 2^(key_shift + 31 - lz) */
    int32_t above = view->key_lz + lz;         /* octave 2 */
    if (!(p >> 31)) {
        p <<= 1;
        above--;
    }
    if ((uint32_t)above >= view->key_common)
        return last_vertex(view, p, above + 2);
    const uint32_t m = view->key_fraction;
    return view->key_code - ((uint32_t)above << m) - (((p >> (30u - m)) + 1u) >> 1);
}

/* Return the octave of a key, 1 .. 2^e - 1. A key on a border counts to the farther octave; r is
 * the same. */
static inline int32_t octave_of(const struct zs_view *view, uint32_t key)
{
    const int32_t o = (int32_t)(below_code(view, key) >> view->key_fraction);
    return o < 1 ? 1 : o;
}

/* Return the mantissa of a key, in (0, 2^(m+1)]; r is proportional to mantissa * 2^octave. */
static inline uint32_t mantissa_of(const struct zs_view *view, uint32_t key, int32_t octave)
{
    /* <= 2^30 */
    return below_code(view, key) - ((uint32_t)(octave - 1) << view->key_fraction) + 1u;
}

/* float_inverses for vertices in several octaves. */
static ZS_NOINLINE void octaves_inverses(const struct zs_view *view, const uint32_t d[3],
                                         int32_t nearest, uint32_t w[3])
{
    int32_t down[3];
    uint32_t any = 0;
    for (int k = 0; k < 3; k++) {
        const int32_t o = octave_of(view, d[k]);
        w[k] = mantissa_of(view, d[k], o);
        down[k] = nearest - o;
        any |= w[k] >> down[k]; /* <= 30 */
    }
    const int32_t up = zs_clz32(any) - 1;
    for (int k = 0; k < 3; k++) {
        const int32_t by = down[k] - up; /* -30 .. 30 */
        w[k] = by > 0 ? (w[k] + (1u << by >> 1)) >> by : w[k] << -by;
    }
}

static void float_inverses(const struct zs_view *view, const struct zs_vertex *const v[3],
                           uint32_t w[3])
{
    const uint32_t d[3] = { v[0]->d, v[1]->d, v[2]->d };
    const uint32_t nearest = zs_minu32(zs_minu32(d[0], d[1]), d[2]);
    const uint32_t farthest = zs_maxu32(zs_maxu32(d[0], d[1]), d[2]);
    const int32_t o = octave_of(view, nearest);
    if (o != octave_of(view, farthest)) {
        octaves_inverses(view, d, o, w);
        return;
    }
    /* 1 .. 2^30; less for the others, as d is more */
    const uint32_t mantissa = mantissa_of(view, nearest, o);
    const int32_t up = zs_clz32(mantissa) - 1;
    for (int k = 0; k < 3; k++)
        w[k] = (mantissa - (d[k] - nearest)) << up;
}

#define W_BITS 39 /* so differences times 2^23 fit 63 bits (core/plane.c) */
#define PAIR_END                                                                                   \
    (1 << 30) /* two octaves: w at the near end of the farther one; the nearer ends at twice it */
#define PAIR_LEAST                                                                                 \
    4096u /* two octaves: the least w of a vertex; w with its error of up to 114 must be > 0 */

/* Compute the gradients of w for a tiny triangle in two octaves, into job->key. Return 0 if a
 * vertex is too far away. */
static int pair_planes(struct zs_job *job, const int32_t octave[3], int32_t nearest)
{
    const struct zs_view *view = &job->r->view;
    const int32_t shift = 30 - view->key_fraction; /* 1 .. 11 */
    uint32_t w[3];
    for (int k = 0; k < 3; k++) {
        w[k] = mantissa_of(view, job->v[k]->d, octave[k])
               << (shift - (nearest - octave[k])); /* exact, <= 2^31 */
        if (w[k] < PAIR_LEAST)
            return 0;
    }
    zs_plane32(&job->geom, w[0], w[1], w[2], ZS_PLANE_KEY, &job->key);
    return 1;
}

/* Compute the gradients of r, for a triangle whose keys are not linear. Return 1 if they are linear
 * after all. job->w64_scale becomes the nearest vertex's octave. The result is job->w64, w = r
 * scaled so that this octave ends at 2^39; for a tiny triangle in two octaves it is job->key,
 * scaled so that the octave ends at 2^31. */
ZS_IN_ORDER static ZS_NOINLINE int crossing_planes(struct zs_job *job)
{
    const struct zs_view *view = &job->r->view;
    int32_t octave[3], nearest = 0, farthest = 32;
    uint64_t w[3];
    for (int k = 0; k < 3; k++) {
        octave[k] = octave_of(view, job->v[k]->d);
        nearest = zs_max32(nearest, octave[k]);
        farthest = zs_min32(farthest, octave[k]);
    }
    if (nearest == farthest) /* octave 1 has the codes of two octaves */
        return 1;
    job->w64_scale = nearest;
    job->two_octaves = job->geom.tiny && nearest - farthest == 1 &&
                       pair_planes(job, octave, nearest);
    if (job->two_octaves)
        return 0;
    for (int k = 0; k < 3; k++) {
        /* -19 .. 19 */
        const int32_t up = W_BITS - 1 - view->key_fraction - (nearest - octave[k]);
        w[k] = (uint64_t)zs_scale2((int64_t)mantissa_of(view, job->v[k]->d, octave[k]),
                                   up); /* <= 2^39 */
    }
    zs_plane64(&job->geom, w[0], w[1], w[2], &job->w64);
    return 0;
}

/* ---- Two octaves ----------------------------------------------------------------------------- */

/* Draw pixels [i, i + n) of a scanline, which are all in the nearer octave or all in the farther
 * one: code = (o - 1) 2^m + w / 2^shift. */
ZS_IN_ORDER static ZS_NOINLINE void pair_piece(struct zs_job *job, const struct zs_row *row,
                                               int32_t i, int32_t n, uint32_t w, int32_t farther)
{
    const struct zs_view *view = &job->r->view;
    const int32_t m = view->key_fraction,
                  shift = 30 - m - farther; /* m is 19 .. 29: 0 .. 11 */
    const uint32_t start = view->key_top + 0x18000u -
                           ((uint32_t)(job->w64_scale - 1 - farther) << m);
    uint32_t code = w;
    int32_t step = (int32_t)job->key.gx;
    if (shift > 0) {
        code = ((code >> (shift - 1)) + 1u) >> 1;
        step = (int32_t)((uint32_t)(step >> (shift - 1)) + 1u) >> 1;
    }
    job->piece(job, row, i, i + n, start - code, 0u - (uint32_t)step);
}

/* Draw a scanline in two octaves. The sign of w - PAIR_END tells the octave: 0 <= w < 2^32 - 2^30.
 */
ZS_ALWAYS_INLINE void pair_span(struct zs_job *job, const struct zs_row *row)
{
    const int32_t gx = (int32_t)job->key.gx,
                  n = row->i1 - row->i0; /* gx may be any where n is 1, else |gx| < 2^31 */
    const uint32_t w = row->key + zs_wrap_mul((uint32_t)gx, row->i0);
    const int32_t above = (int32_t)(w - PAIR_END),
                  above_end = (int32_t)((uint32_t)above + zs_wrap_mul((uint32_t)gx, n - 1));
    if ((above ^ above_end) >= 0) {
        pair_piece(job, row, row->i0, n, w, above < 0);
        return;
    }
    /* first: number of pixels before the border, 1 .. n - 1; gx is not 0, and the dividend is below
     * n |gx| */
    const int32_t first = above < 0
                              ? (int32_t)(((uint32_t)gx - 1u - (uint32_t)above) / (uint32_t)gx)
                              : (int32_t)((uint32_t)above / (0u - (uint32_t)gx)) + 1;
    pair_piece(job, row, row->i0, first, w, above < 0);
    pair_piece(job, row, row->i0 + first, n - first, w + zs_wrap_mul((uint32_t)gx, first),
               above >= 0);
}

/* ---- More octaves ---------------------------------------------------------------------------- */

/* Return the leading zeros of w in 39.24 bits, clamped to 1 .. last: 1 + the number of octaves
 * between w's octave and the nearest vertex's. */
static inline int32_t octaves_down(uint64_t w, int32_t last)
{
    const int32_t lz = w ? zs_clz64(w) : 64; /* 0 only by rounding errors */
    return lz < 1 ? 1 : lz > last ? last : lz;
}

/* Return how many of n pixels, beginning with one with this w, are in the same octave. The n-th is
 * not. */
static ZS_NOINLINE int32_t pixels_within(uint64_t w, uint64_t gx, int32_t n, int32_t down,
                                         int32_t last)
{
    int32_t in = 0, out = n - 1; /* pixel `in` does, pixel `out` does not */
    while (out - in > 1) {
        const int32_t mid = (in + out) / 2;
        if (octaves_down(w + zs_times(gx, mid), last) == down)
            in = mid;
        else
            out = mid;
    }
    return out;
}

/* Return the low 32 bits of (v + 2^(shift - 1)) / 2^shift, floor. 2 <= shift <= 63. is_signed: a
 * constant. */
ZS_ALWAYS_INLINE uint32_t rounded(uint64_t v, int32_t shift, int is_signed)
{
    const uint32_t hi = (uint32_t)(v >> 32);
    if (shift <= 32)
        return (hi << (32 - shift)) + ((((uint32_t)v >> (shift - 1)) + 1u) >> 1);
    const uint32_t more = hi + (1u << (shift - 33));
    return is_signed ? (uint32_t)((int32_t)more >> (shift - 32)) : more >> (shift - 32);
}

/* Draw pixels [i, i + n) of a scanline, all in one octave: code = (o - 1) 2^m + w / 2^shift with o
 * = last + 1 - down. */
ZS_IN_ORDER static ZS_NOINLINE void float_piece(struct zs_job *job, const struct zs_row *row,
                                                uint64_t w, int32_t down, int32_t i, int32_t n)
{
    const struct zs_view *view = &job->r->view;
    const int32_t m = view->key_fraction, shift = 63 - m - down; /* 5 .. 43 */
    const uint32_t code = ((uint32_t)(job->w64_scale - down) << m) + rounded(w, shift, 0);
    const uint32_t sum = view->key_top + 0x10000u - code + 0x8000u; /* modulo 2^32 */
    const uint32_t step = 0u - rounded(job->w64.gx, shift, 1);      /* gx may be any where n is 1 */
    job->piece(job, row, i, i + n, sum, step);
}

/* Draw a scanline that may cross octaves. down_end: octaves_down() of its last pixel. */
static ZS_NOINLINE void crossing_row(struct zs_job *job, const struct zs_row *row, uint64_t w,
                                     int32_t down_end)
{
    const int32_t last = job->w64_scale;
    const uint64_t gx = job->w64.gx;
    int32_t i = row->i0,
            left = row->i1 -
                   i; /* at the last pixel, w is that of the row's end, modulo 2^64: no bisection */
    for (;;) {
        const int32_t down = octaves_down(w, last);
        const int32_t n = down == down_end ? left : pixels_within(w, gx, left, down, last);
        float_piece(job, row, w, down, i, n);
        i += n;
        left -= n;
        if (left <= 0)
            return;
        w += zs_times(gx, n);
    }
}

/* Draw a scanline whose first pixel has this w. */
static ZS_NOINLINE void float_row(struct zs_job *job, const struct zs_row *row, uint64_t w)
{
    const int32_t n = row->i1 - row->i0;
    const uint64_t end = w + zs_times(job->w64.gx, n - 1);
    const int32_t down = octaves_down(end, job->w64_scale);
    const uint32_t hi = (uint32_t)(w >> 32), hi_end = (uint32_t)(end >> 32);
    if ((hi ^ hi_end) < (hi & hi_end)) /* equal leading zeros */
        float_piece(job, row, w, down, row->i0, n);
    else
        crossing_row(job, row, w, down);
}

/* Not inlined, which would take stack from rays. */
static ZS_NOINLINE void pair_row(struct zs_job *job, const struct zs_row *row)
{
    pair_span(job, row);
}

/* Draw a scanline: of a tiny triangle in two octaves, for which job->w64 is not set, or of any
 * other.
 */
ZS_IN_ORDER static void any_row(struct zs_job *job, const struct zs_row *row)
{
    if (ZS_SET_UP && job->two_octaves)
        pair_row(job, row); /* of a ray; float_walk has the others */
    else if (job->two_octaves)
        pair_span(job, row);
    else
        float_row(job, row, row->w + zs_times(job->w64.gx, row->i0));
}

static ZS_NOINLINE void pair_walk(struct zs_job *job)
{
    zs_rows_walk(job, pair_span, 0);
}

/* zs_depth_walk where w of two octaves is not stepped with 64 bits: 0.08 of 6.5 million cycles in
 * scene teapot on an RP2040. A triangle in two octaves is tiny; first touch takes wide ones. */
static void float_walk(struct zs_job *job)
{
    if (job->two_octaves)
        pair_walk(job);
    else
        zs_depth_walk(job);
}

static int float_planes(struct zs_job *job)
{
    const struct zs_view *view = &job->r->view;
    const uint32_t code = below_code(view, job->v[0]->d);
    const uint32_t differ = (code ^ below_code(view, job->v[1]->d)) |
                            (code ^ below_code(view, job->v[2]->d));
    return !(differ >> view->key_fraction) || crossing_planes(job);
}

#define WALK (ZS_SET_UP ? float_walk : zs_depth_walk)
#define FLOAT_DEPTH(setup_)                                                                        \
    {                                                                                              \
        .setup = setup_, .vertex = zs_float_vertex, .vertices = ZS_V7M ? zs_screen_v7m : 0,        \
        .planes = float_planes, .walk = WALK, .row = any_row, .inverses = float_inverses           \
    }

const struct zs_depth zs_depth_float = FLOAT_DEPTH(any_setup);
const struct zs_depth zs_depth_e3m13 = FLOAT_DEPTH(e3_setup);
const struct zs_depth zs_depth_e4m12 = FLOAT_DEPTH(e4_setup);
const struct zs_depth zs_depth_e5m11 = FLOAT_DEPTH(e5_setup);
