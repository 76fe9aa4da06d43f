/* The rasterizer alone, on snapped triangles: coverage, depth and order against the oracle.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "oracle.h"
#include "easel.h"
#include "good.h"
#include "grid.h"
#include "internals.h"
#include "picture.h"

#define GUARD (8188 * 256)

static uint64_t pixels_compared; /* of the current test */
static uint64_t at_once, setups; /* triangles in strips: drawn before they were set up, all */
static double worst_error;       /* in buckets; of frames of at most 640 px width + height ... */
static double worst_big;         /* ... and of larger ones */

/* ---- Random triangles ------------------------------------------------------------------------ */

enum kind {
    KIND_ANY,       /* around the frame */
    KIND_TINY,      /* a few pixels */
    KIND_SLIVER,    /* at most a sub-pixel or two wide */
    KIND_HUGE,      /* up to the guard band */
    KIND_CENTERS,   /* corners on samples */
    KIND_BESIDE,    /* a sub-pixel beside samples */
    KIND_STRAIGHT,  /* horizontal and vertical edges */
    KIND_FLAT,      /* long, a few rows high */
    KIND_STEEP,     /* a huge triangle of no width, at any angle */
    KIND_SMALL,     /* up to 256 px, width and height together: the short way of planes */
    KIND_BORDER,    /* corners on the frame's border and on the guard band's */
    KIND_DEGENERATE,
    KINDS
};

struct frame_size {
    int32_t w, h;
};

static const struct frame_size sizes[] = {
    { 1, 1 }, { 64, 48 }, { 240, 240 }, { 320, 240 }, { 37, 61 }, { 127, 3 }, { 1024, 8 },
    { 8, 1024 }, { 96, 96 }, { 200, 120 }, { 2, 5 }, { 255, 65 }
};
#define N_SIZES (sizeof sizes / sizeof sizes[0])

static int64_t between(int64_t v, int64_t lo, int64_t hi)
{
    return v < lo ? lo : v > hi ? hi : v;
}

static int32_t clamp(int64_t v, int64_t lo, int64_t hi)
{
    return (int32_t)between(v, lo, hi);
}

static int kind_small_way; /* 0 short, 1 long, 2 half */

static void random_corner(struct prng *p, enum kind kind, int k, int32_t size, int32_t reach,
                          int32_t c[3])
{
    const int32_t px = size * 256, middle = size * 128;
    const int32_t sample = prng_range(p, -2, size + 1) * 256 + 128;
    switch (kind) {
    case KIND_TINY:
        c[k] = k ? c[0] + prng_range(p, -900, 900) : prng_range(p, -512, px + 512);
        break;
    case KIND_SMALL: { /* one way or the other long, or both half */
        static const int32_t reach_of[3] = { 1000, 31000, 16000 };
        const int32_t far_off = reach_of[kind_small_way % 3];
        c[k] = k ? c[0] + prng_range(p, 0, far_off) : prng_range(p, -8000, px + 8000);
        break;
    }
    case KIND_HUGE:
        c[k] = middle + prng_range(p, -reach, reach);
        break;
    case KIND_CENTERS:
        c[k] = sample;
        break;
    case KIND_BESIDE:
        c[k] = sample + prng_range(p, -1, 1);
        break;
    case KIND_BORDER:
        switch (prng_pick(p, 6)) {
        case 0: c[k] = 0; break;
        case 1: c[k] = px; break;
        case 2: c[k] = middle - reach; break;
        case 3: c[k] = middle + reach; break;
        case 4: c[k] = 128; break;
        default: c[k] = px - 128; break;
        }
        break;
    default:
        c[k] = prng_range(p, -px / 2 - 300, px + px / 2 + 300);
        break;
    }
}

static void bend(struct prng *p, enum kind kind, struct easel_tri *t)
{
    const int a = (int)prng_pick(p, 3), b = (a + 1) % 3, c = (a + 2) % 3;
    switch (kind) {
    case KIND_SLIVER: /* c close to the line from a to b */
    case KIND_STEEP: {
        const int64_t s = prng_range(p, 0, 65536);
        t->x[c] = t->x[a] + (int32_t)((t->x[b] - t->x[a]) * s / 65536) + prng_range(p, -1, 1);
        t->y[c] = t->y[a] + (int32_t)((t->y[b] - t->y[a]) * s / 65536) + prng_range(p, -1, 1);
        break;
    }
    case KIND_STRAIGHT:
        t->x[b] = t->x[a];
        if (prng_pick(p, 2))
            t->y[c] = t->y[a];
        break;
    case KIND_FLAT:
        t->y[b] = t->y[a] + prng_range(p, -400, 400);
        t->y[c] = t->y[a] + prng_range(p, -400, 400);
        break;
    case KIND_DEGENERATE:
        switch (prng_pick(p, 3)) {
        case 0: /* a point twice */
            t->x[b] = t->x[a];
            t->y[b] = t->y[a];
            break;
        case 1: /* all on a line */
            t->x[c] = 2 * t->x[b] - t->x[a];
            t->y[c] = 2 * t->y[b] - t->y[a];
            break;
        default: /* one point */
            t->x[b] = t->x[c] = t->x[a];
            t->y[b] = t->y[c] = t->y[a];
            break;
        }
        break;
    default:
        break;
    }
}

static void random_tri(struct prng *p, enum kind kind, const struct easel *s, struct easel_tri *t)
{
    const enum kind corner = kind == KIND_STEEP ? KIND_HUGE : kind;
    const int32_t reach = prng_pick(p, 2) ? GUARD : 256 << prng_pick(p, 13);
    const int small_way = (int)prng_pick(p, 3);
    for (int k = 0; k < 3; k++) {
        kind_small_way = small_way;
        random_corner(p, corner, k, s->width, reach, t->x);
        kind_small_way = small_way == 2 ? 2 : 1 - small_way;
        random_corner(p, corner, k, s->height, reach, t->y);
    }
    bend(p, kind, t);
    for (int k = 0; k < 3; k++) {
        t->x[k] = clamp(t->x[k], s->width * 128 - GUARD, s->width * 128 + GUARD);
        t->y[k] = clamp(t->y[k], s->height * 128 - GUARD, s->height * 128 + GUARD);
        memset(t->rgb[k], 0, sizeof t->rgb[k]);
    }
}

/* Keys of three corners, uq16_16, at most B - 1. */
static void random_keys(struct prng *p, uint32_t top, uint32_t d[3])
{
    const uint32_t how = prng_pick(p, 6);
    for (int k = 0; k < 3; k++)
        switch (how) {
        case 0: /* the ends */
            d[k] = prng_pick(p, 2) ? top : 0;
            break;
        case 1: /* beside the ends */
            d[k] = prng_pick(p, 2) ? top - prng_pick(p, 200000) : prng_pick(p, 200000);
            break;
        case 2: /* nearly flat */
            d[k] = k ? (uint32_t)between((int64_t)d[0] + prng_range(p, -70000, 70000), 0, top)
                     : prng_pick(p, top);
            break;
        case 3: /* flat */
            d[k] = k ? d[0] : prng_pick(p, top + 1u);
            break;
        default:
            d[k] = prng_pick(p, top);
            break;
        }
}

static int wrong_at(const struct easel *s, const struct easel_tri *t, int i, int j,
                    const char *what, double value)
{
    return case_wrong("%s %g at (%d, %d) of %dx%d, strips of %d, %d bits: (%d %d %u) (%d %d %u) "
                      "(%d %d %u)", what, value, i, j, s->width, s->height, s->strip_h,
                      s->depth_bits, t->x[0], t->y[0], t->d[0], t->x[1], t->y[1], t->d[1], t->x[2],
                      t->y[2], t->d[2]);
}

/* ---- One triangle: every pixel of the frame, its coverage and its key ------------------------ */

typedef int pixel_fn(const struct easel *s, const struct easel_tri *t, const struct easel_frame *f,
                     int i, int j, uint32_t key);

static int frame_right(const struct easel *s, const struct easel_tri *t,
                       const struct easel_frame *f, pixel_fn *pixel)
{
    const struct oracle_tri o = easel_oracle(t);
    uint32_t covered = 0;
    for (int j = 0; j < s->height; j++)
        for (int i = 0; i < s->width; i++) {
            const size_t at = (size_t)j * (size_t)s->width + (size_t)i;
            const int want = oracle_covers(&o, i, j), got = f->color[at] == 1;
            if (want != got)
                return wrong_at(s, t, i, j, "coverage", got);
            covered += (uint32_t)want;
            if (!want && f->key[at] != 65535)
                return wrong_at(s, t, i, j, "key where nothing is", f->key[at]);
            if (want && !pixel(s, t, f, i, j, f->key[at]))
                return 0;
        }
    pixels_compared += (uint64_t)s->width * (uint64_t)s->height;
    if (f->tested != covered || f->written != covered)
        return wrong_at(s, t, 0, 0, "pixels counted", f->tested);
    return 1;
}

/* Draw one triangle and compare its frame; then the same by the core alone, and without zs_fast_touch, beside which a
 * first triangle is not drawn in one go. */
static int draws_right(const struct easel *s, const struct easel_tri *t, pixel_fn *pixel)
{
    const size_t bytes = (size_t)s->width * (size_t)s->height * 2;
    const struct zs_fast *const *const lists[2] = { NULL, fast_of(FAST_ALL & ~FAST_TOUCH) };
    struct easel_frame f;
    easel_draw(s, t, 1, &f);
    int ok = frame_right(s, t, &f, pixel);
    for (int k = 0; k < 2 && ok; k++) {
        struct easel other = *s;
        struct easel_frame g;
        other.fast = lists[k];
        easel_draw(&other, t, 1, &g);
        at_once += g.at_once;
        setups += k ? g.setups : 0;
        if (memcmp(f.color, g.color, bytes) || memcmp(f.key, g.key, bytes) || f.tested != g.tested ||
            f.written != g.written || f.setups != g.setups)
            ok = wrong_at(s, t, 0, 0, k ? "another frame without touch, set-ups" : "another frame by the core, set-ups",
                          g.setups);
        easel_free(&g);
    }
    easel_free(&f);
    return ok;
}

static int32_t spread(const int32_t v[3])
{
    const int32_t lo = v[0] < v[1] ? v[0] : v[1], hi = v[0] < v[1] ? v[1] : v[0];
    return (v[2] > hi ? v[2] : hi) - (v[2] < lo ? v[2] : lo);
}

/* The promise: 0.505 bucket for width + height <= 640, else 0.5 + (W + H + 1) / 2^17. Triangles of
 * at most 256 px, width and height together, keep to 0.5035 everywhere (plane.c). */
static double key_bound(const struct easel *s, const struct easel_tri *t)
{
    const int32_t extent = s->width + s->height;
    if (spread(t->x) + spread(t->y) <= 65536 && s->depth == &zs_depth_recip)
        return 0.5035;
    return extent <= 640 ? 0.505 : 0.5 + (extent + 1) / 131072.0;
}

static void note_error(const struct easel *s, double error)
{
    double *worst = s->width + s->height <= 640 ? &worst_error : &worst_big;
    *worst = error > *worst ? error : *worst;
}

static int plane_pixel(const struct easel *s, const struct easel_tri *t,
                       const struct easel_frame *f, int i, int j, uint32_t key)
{
    (void)f;
    const struct oracle_tri o = easel_oracle(t);
    const uint32_t most = (1u << s->depth_bits) - 2u;
    const double error = fabs(oracle_key_error(&o, t->d, i, j, key, most));
    note_error(s, error);
    if (error > key_bound(s, t) || key > most)
        return wrong_at(s, t, i, j, "key", key) + case_wrong("off by %.6f buckets", error);
    return 1;
}

static struct easel random_easel(struct prng *p, size_t size)
{
    struct easel s = easel_default(sizes[size].w, sizes[size].h);
    const int32_t strips[] = { 1, 2, 3, 5, 8, 16, 24, s.height };
    s.strip_h = strips[prng_pick(p, 8)];
    s.depth_bits = prng_pick(p, 2) ? 16 : prng_range(p, 8, 16);
    return s;
}

static int one_triangle(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed % N_SIZES);
    struct easel_tri t;
    random_tri(&p, (enum kind)(seed / N_SIZES % KINDS), &s, &t);
    random_keys(&p, ((1u << s.depth_bits) - 1u) << 16, t.d);
    return draws_right(&s, &t, plane_pixel);
}

static void coverage_and_keys_of_single_triangles(void **state)
{
    pixels_compared = at_once = setups = 0;
    worst_error = worst_big = 0;
    CASES(one_triangle, 4000);
    assert_true(!cases_all() || at_once > 1000);
    print_message("single triangles: %llu pixels compared, keys off by at most %.5f buckets, "
                  "%.5f in frames of 1032 px width + height\n",
                  (unsigned long long)pixels_compared, worst_error, worst_big);
    print_message("single triangles: %llu of %llu in strips in one go\n", (unsigned long long)at_once,
                  (unsigned long long)setups);
}

/* Frames up to the library's limit: the key's bound grows with them. */
static int big_frame(uint64_t seed)
{
    static const struct frame_size big[] = {
        { 4096, 2 }, { 3, 4096 }, { 640, 480 }, { 1000, 1000 }
    };
    struct prng p = { seed };
    struct easel s = easel_default(big[seed % 4].w, big[seed % 4].h);
    s.strip_h = prng_range(&p, 1, 64);
    struct easel_tri t;
    random_tri(&p, seed % 3 ? KIND_HUGE : KIND_BORDER, &s, &t);
    random_keys(&p, 65535u << 16, t.d);
    return draws_right(&s, &t, plane_pixel);
}

static void coverage_and_keys_in_big_frames(void **state)
{
    worst_big = 0;
    CASES(big_frame, 32);
    print_message("frames up to 4096 px: keys off by at most %.5f buckets\n", worst_big);
}

/* ---- Gradients ---------------------------------------------------------------------------- */

/* |g - 256 n / area| in ulps, modulo 2^32 ulps. */
static double gradient_error(uint32_t g, __int128 n, int64_t area)
{
    __int128 off = ((__int128)g * area - n * 256) % ((__int128)area << 32);
    if (off < 0)
        off += (__int128)area << 32;
    if (off > (__int128)area << 31)
        off -= (__int128)area << 32;
    return fabs((double)off / (double)area);
}

/* a / b, floor. */
static __int128 floored(__int128 a, int64_t b)
{
    return a / b - (a % b < 0);
}

/* Gradients of 40.24 bits are floors, to the last bit, whichever way they are found. */
static int planes64_exact(struct prng *p, const struct zs_geom *g, int64_t area)
{
    for (int n = 0; n < 8; n++) {
        uint64_t v[3];
        struct zs_plane64 plane;
        for (int k = 0; k < 3; k++)
            v[k] = n == 0 ? (uint64_t)(k & 1) : (prng_next(p) & (((uint64_t)1 << 40) - 1u)) >> prng_range(p, 0, 40);
        const __int128 d1 = (int64_t)(v[1] - v[0]), d2 = (int64_t)(v[2] - v[0]);
        const __int128 one = (__int128)1 << 32;
        const __int128 gx = floored((d1 * g->dy2 - d2 * g->dy1) * one, area);
        const __int128 gy = floored((d2 * g->dx1 - d1 * g->dx2) * one, area);
        zs_plane64(g, v[0], v[1], v[2], &plane);
        CASE_CHECK(plane.gx == (uint64_t)gx && plane.gy == (uint64_t)gy);
        const __int128 x = floored(gx * g->ax, 256), y = floored(gy * g->ay, 256); /* each part's low 8 bits fall */
        CASE_CHECK(plane.base == (v[0] << 24) + (uint64_t)x + (uint64_t)y);
    }
    return 1;
}

/* The narrow way of tiny triangles gives what the one for small ones does. */
static int tiny_is_small(const struct zs_geom *g, const struct easel_tri *t)
{
    static const enum zs_plane_kind kinds[2] = { ZS_PLANE_KEY, ZS_PLANE_WIDE };
    struct zs_geom small = *g;
    small.tiny = 0;
    for (int k = 0; k < 2; k++)
        for (int cut = 0; cut < 32; cut += 5) {
            struct zs_plane a, b;
            const uint32_t d[3] = { t->d[0] >> cut, t->d[1] >> cut, t->d[2] >> cut };
            zs_plane32(g, d[0], d[1], d[2], kinds[k], &a);
            zs_plane32(&small, d[0], d[1], d[2], kinds[k], &b);
            CASE_CHECK(a.base == b.base && a.gx == b.gx && a.gy == b.gy);
            const __int128 step = (__int128)(int32_t)a.gx * g->ax + (__int128)(int32_t)a.gy * g->ay; /* to the anchor */
            CASE_CHECK(!g->tiny || cut < 20 ||
                       a.base == d[0] + (uint32_t)floored(step + 128, 256)); /* never too steep */
        }
    return 1;
}

/* Of a snapped triangle: nearest where it is large, within 0.88 ulp where it is small (plane.c). */
static int gradients_right(struct prng *p, const struct easel *s, const struct easel_tri *t)
{
    struct oracle_tri o = easel_oracle(t);
    struct zs_vertex v[3];
    const struct zs_vertex *down[3] = { &v[0], &v[1], &v[2] };
    for (int k = 0; k < 3; k++)
        v[k] = (struct zs_vertex){ t->x[k], t->y[k], t->d[k] };
    for (int k = 0; k < 3; k++) /* by y, then x */
        for (int m = 0; m < 2; m++)
            if (down[m]->y > down[m + 1]->y || (down[m]->y == down[m + 1]->y && down[m]->x > down[m + 1]->x)) {
                const struct zs_vertex *const swap = down[m];
                down[m] = down[m + 1];
                down[m + 1] = swap;
            }
    struct zs_renderer r;
    struct zs_job job;
    memset(&r, 0, sizeof r);
    memset(&job, 0, sizeof job);
    r.config.width = 320;
    r.config.height = 240;
    job.r = &r;
    job.width = 320;
    job.bottom = 240;
    const int64_t area = llabs(oracle_area(&o));
    if (area == 0)
        return 1;
    const int turns = ((int64_t)down[1]->x - down[0]->x) * ((int64_t)down[2]->y - down[0]->y) <
                      ((int64_t)down[2]->x - down[0]->x) * ((int64_t)down[1]->y - down[0]->y);
    zs_plane_sides(&job, down[0], down[1 + turns], down[2 - turns]);
    const struct zs_vertex *const a = job.v[0], *const b = job.v[1], *const c = job.v[2];
    CASE_CHECK(job.geom.area == area && (job.mid_right ? b : c) == down[1] && (job.mid_right ? c : b) == down[2]);
    zs_plane_geom(&job);
    zs_plane32(&job.geom, a->d, b->d, c->d, ZS_PLANE_KEY, &job.key);
    const int64_t dv1 = (int64_t)b->d - a->d, dv2 = (int64_t)c->d - a->d;
    const __int128 nx = (__int128)dv1 * (c->y - a->y) - (__int128)dv2 * (b->y - a->y);
    const __int128 ny = (__int128)dv2 * (b->x - a->x) - (__int128)dv1 * (c->x - a->x);
    CASE_CHECK(planes64_exact(p, &job.geom, area) && tiny_is_small(&job.geom, t));
    const double bound = spread(t->x) + spread(t->y) <= 65536 ? 0.88 : 0.5;
    const double error = fmax(gradient_error(job.key.gx, nx, area),
                              gradient_error(job.key.gy, ny, area));
    worst_error = fmax(worst_error, bound < 0.6 ? 0 : error);
    if (error > bound)
        return wrong_at(s, t, 0, 0, "gradient, ulps", error);
    return 1;
}

static int gradient_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct easel s = easel_default(320, 240);
    struct easel_tri t;
    random_tri(&p, seed % 3 ? KIND_SMALL : KIND_HUGE, &s, &t);
    random_keys(&p, 65535u << 16, t.d);
    return gradients_right(&p, &s, &t);
}

/* Areas of a few sub-pixels squared, keys that differ by a few 2^-16 buckets. */
static int least_gradient_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct easel s = easel_default(320, 240);
    struct easel_tri t;
    const int32_t width = 1 << prng_pick(&p, 11), height = 1 << prng_pick(&p, 11);
    memset(&t, 0, sizeof t);
    for (int k = 0; k < 3; k++) {
        t.x[k] = 20000 + prng_range(&p, 0, width);
        t.y[k] = 20000 + prng_range(&p, 0, height);
        t.d[k] = 0x30000000u + prng_pick(&p, 1u + (1u << prng_pick(&p, 6)));
    }
    return gradients_right(&p, &s, &t);
}

static void gradients_to_the_last_bit(void **state)
{
    worst_error = 0;
    CASES(gradient_case, 200000);
    CASES(least_gradient_case, 20000);
    print_message("gradients of small triangles: off by at most %.4f ulp\n", worst_error);
}

/* ---- Keys that are linear in distance, under perspective ------------------------------------- */

/* (z - n) / (f - n) * (B - 1) where 1/z is the plane through the corners' stored z. 64-bit
 * mantissas: good to 1e-12 bucket. */
static long double linear_exact(const struct easel *s, const struct easel_tri *t,
                                const struct easel_frame *f, int i, int j)
{
    const struct oracle_tri o = easel_oracle(t);
    int64_t w[3];
    oracle_weights(&o, i, j, w);
    long double inverse = 0, area = fabsl((long double)oracle_area(&o));
    for (int k = 0; k < 3; k++)
        inverse += (long double)w[k] / t->d[k];
    const long double z = area / inverse;
    const long double range = ldexpl((long double)s->z_far - s->z_near, f->shift);
    return (z - f->unit_near) / range * ((1 << s->depth_bits) - 1);
}

static int linear_pixel(const struct easel *s, const struct easel_tri *t,
                        const struct easel_frame *f, int i, int j, uint32_t key)
{
    const uint32_t most = (1u << s->depth_bits) - 2u;
    long double want = linear_exact(s, t, f, i, j);
    want = want > most ? most : want;
    const double error = (double)fabsl(key - want);
    note_error(s, error);
    if (error > key_bound(s, t) || key > most)
        return wrong_at(s, t, i, j, "linear key", key) + case_wrong("off by %.6f buckets", error);
    return 1;
}

static int linear_triangle(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, 1 + seed % (N_SIZES - 1));
    s.depth = &zs_depth_linear;
    s.z_near = 1 + (int32_t)prng_pick(&p, 1u << prng_pick(&p, 14));
    s.z_far = clamp((int64_t)s.z_near * prng_range(&p, 2, 1 << prng_range(&p, 2, 14)), 0, 1 << 28);
    struct easel_tri t;
    random_tri(&p, (enum kind)(seed / N_SIZES % KINDS), &s, &t);
    /* the camera unit is not known before the frame is begun: an empty one tells it */
    struct easel_frame f;
    easel_draw(&s, &t, 0, &f);
    easel_free(&f);
    const int32_t z0 = f.unit_near;
    const int32_t z1 = (int32_t)ldexp(s.z_far, f.shift);
    const uint32_t how = prng_pick(&p, 3);
    for (int k = 0; k < 3; k++) {
        const double along = (double)prng_pick(&p, 65537) / 65536;
        t.d[k] = (uint32_t)(how == 0   ? (prng_pick(&p, 2) ? z1 : z0)
                            : how == 1 ? prng_range(&p, z0, z1)
                                       : (int32_t)(z0 * pow((double)z1 / z0, along)));
    }
    easel_draw(&s, &t, 1, &f);
    const int ok = frame_right(&s, &t, &f, linear_pixel);
    easel_free(&f);
    return ok;
}

static void linear_keys_under_perspective(void **state)
{
    worst_error = worst_big = 0;
    CASES(linear_triangle, 700);
    print_message("linear keys, far / near 2 to 16384: off by at most %.5f buckets\n",
                  worst_error > worst_big ? worst_error : worst_big);
}

/* ---- Many triangles: the least (key, order) -------------------------------------------------- */

#define CROWD 60

static unsigned crowd_pixels; /* under triangles */

static int crowd_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, 1 + seed % (N_SIZES - 1));
    struct easel_tri t[CROWD];
    struct oracle_tri o[CROWD];
    uint32_t key[CROWD];
    const uint32_t most = (1u << s.depth_bits) - 2u, levels = 1u << prng_pick(&p, 5);
    for (int k = 0; k < CROWD; k++) { /* flat: exactly known keys, and many ties */
        random_tri(&p, (enum kind)prng_pick(&p, KINDS), &s, &t[k]);
        const uint32_t d = prng_pick(&p, levels) * (most / levels) * 65536u + prng_pick(&p, 0x8000);
        t[k].d[0] = t[k].d[1] = t[k].d[2] = d;
        o[k] = easel_oracle(&t[k]);
        key[k] = (d + 0x8000u) >> 16;
    }
    struct easel_frame f;
    easel_draw(&s, t, CROWD, &f);
    uint32_t tested = 0;
    int ok = 1;
    for (int j = 0; j < s.height && ok; j++)
        for (int i = 0; i < s.width && ok; i++) {
            uint32_t least = 65535, owner = 0;
            for (int k = 0; k < CROWD; k++) {
                if (!oracle_covers(&o[k], i, j))
                    continue;
                tested++;
                if (key[k] < least) {
                    least = key[k];
                    owner = (uint32_t)k + 1u;
                }
            }
            const size_t at = (size_t)j * (size_t)s.width + (size_t)i;
            if (f.color[at] != owner || f.key[at] != least)
                ok = wrong_at(&s, &t[owner ? owner - 1 : 0], i, j, "owner", f.color[at]);
        }
    crowd_pixels += tested;
    if (ok && f.tested != tested)
        ok = case_wrong("%u pixels tested, %u covered", f.tested, tested);
    easel_free(&f);
    return ok;
}

/* ---- Shared edges ---------------------------------------------------------------------------- */

#define MESH_MAX 4000

struct partition { /* triangles that fill a rectangle exactly */
    struct easel_tri t[MESH_MAX];
    uint32_t n;
};

static void partition_add(struct partition *m, const int32_t a[2], const int32_t b[2],
                          const int32_t c[2])
{
    struct easel_tri *t = &m->t[m->n++];
    memset(t, 0, sizeof *t);
    const int32_t *v[3] = { a, b, c };
    for (int k = 0; k < 3; k++) {
        t->x[k] = v[k][0];
        t->y[k] = v[k][1];
    }
}

static void grid(struct prng *p, struct partition *m, const int32_t box[4], int nx, int ny)
{
    static struct grid g;
    grid_make(&g, p, box, nx, ny);
    for (uint32_t t = 0; t < g.n_tris; t++)
        partition_add(m, g.at[g.tri[t][0]], g.at[g.tri[t][1]], g.at[g.tri[t][2]]);
}

/* Two triangles, then points dropped into them one after another: slivers without end. */
static void dropped_points(struct prng *p, struct partition *m, const int32_t box[4], int n)
{
    const int32_t a[2] = { box[0], box[1] }, b[2] = { box[2], box[1] }, c[2] = { box[2], box[3] },
                  d[2] = { box[0], box[3] };
    partition_add(m, a, b, c);
    partition_add(m, a, c, d);
    while (n-- > 0) {
        const uint32_t at = prng_pick(p, m->n);
        const struct easel_tri t = m->t[at];
        int32_t u = prng_range(p, 0, 65536), v = prng_range(p, 0, 65536);
        if (u + v > 65536) {
            u = 65536 - u;
            v = 65536 - v;
        }
        const int32_t q[2] = {
            t.x[0] + (int32_t)(((int64_t)(t.x[1] - t.x[0]) * u + (int64_t)(t.x[2] - t.x[0]) * v) /
                               65536),
            t.y[0] +
                (int32_t)(((int64_t)(t.y[1] - t.y[0]) * u + (int64_t)(t.y[2] - t.y[0]) * v) / 65536)
        };
        /* rounded outside? then not here */
        const struct oracle_tri whole = easel_oracle(&t);
        int64_t parts = 0;
        for (int k = 0; k < 3; k++) {
            struct oracle_tri o = whole;
            o.x[k] = q[0];
            o.y[k] = q[1];
            const int64_t area = oracle_area(&o);
            parts += area < 0 ? -area : area;
        }
        const int64_t area = oracle_area(&whole);
        if (parts != (area < 0 ? -area : area))
            continue;
        const int32_t v0[2] = { t.x[0], t.y[0] }, v1[2] = { t.x[1], t.y[1] },
                      v2[2] = { t.x[2], t.y[2] };
        m->t[at] = m->t[--m->n];
        partition_add(m, v0, v1, q);
        partition_add(m, v1, v2, q);
        partition_add(m, v2, v0, q);
    }
}

/* A fan around any point, its rim far outside or on the box. */
static void fan(struct prng *p, struct partition *m, const int32_t box[4], int n)
{
    const int32_t hub[2] = { prng_range(p, box[0], box[2]), prng_range(p, box[1], box[3]) };
    int32_t last[2] = { box[0], box[1] };
    const int32_t corner[4][2] = { { box[2], box[1] }, { box[2], box[3] }, { box[0], box[3] },
                                   { box[0], box[1] } };
    for (int s = 0; s < 4; s++) { /* along each side in steps */
        const int32_t from[2] = { last[0], last[1] };
        for (int k = 1; k <= n; k++) {
            int32_t q[2];
            for (int c = 0; c < 2; c++)
                q[c] = k == n ? corner[s][c]
                              : from[c] + (int32_t)((int64_t)(corner[s][c] - from[c]) * k / n);
            partition_add(m, hub, last, q);
            last[0] = q[0];
            last[1] = q[1];
        }
    }
}

static int shared_case(uint64_t seed)
{
    static struct partition m;
    struct prng p = { seed };
    struct easel s = easel_default(320, 240);
    s.strip_h = prng_range(&p, 1, 240);
    int32_t box[4] = { prng_range(&p, -3000, 20000), prng_range(&p, -3000, 20000),
                       prng_range(&p, 60000, 320 * 256 + 3000), prng_range(&p, 40000, 64000) };
    if (prng_pick(&p, 4) == 0) {
        box[0] = 320 * 128 - GUARD;
        box[1] = 240 * 128 - GUARD;
        box[2] = 320 * 128 + GUARD;
        box[3] = 240 * 128 + GUARD;
    }
    m.n = 0;
    switch (seed % 3) {
    case 0: grid(&p, &m, box, prng_range(&p, 1, 32), prng_range(&p, 1, 32)); break;
    case 1: dropped_points(&p, &m, box, prng_range(&p, 1, 1000)); break;
    default: fan(&p, &m, box, prng_range(&p, 1, 200)); break;
    }
    struct easel_frame f;
    easel_draw(&s, m.t, m.n, &f);
    uint32_t inside = 0;
    int ok = 1;
    for (int j = 0; j < s.height && ok; j++)
        for (int i = 0; i < s.width && ok; i++) {
            const int32_t x = i * 256 + 128, y = j * 256 + 128;
            const int want = x >= box[0] && x < box[2] && y >= box[1] && y < box[3];
            inside += (uint32_t)want;
            if (want != (f.key[j * s.width + i] == 0))
                ok = case_wrong("%s at (%d, %d)", want ? "a crack" : "a pixel outside", i, j);
        }
    /* all keys are equal: a second hit shows */
    if (ok && (f.tested != inside || f.written != inside))
        ok = case_wrong("%u pixels inside, %u hits", inside, f.tested);
    pixels_compared += inside;
    easel_free(&f);
    return ok;
}

static void shared_edges_hit_every_pixel_once(void **state)
{
    pixels_compared = 0;
    CASES(shared_case, 150);
    print_message("shared edges: %llu pixels inside, each hit once\n",
                  (unsigned long long)pixels_compared);
}

/* ---- Drawn by hand --------------------------------------------------------------------------- */

struct drawing {
    int32_t x[3], y[3]; /* 1/256 px */
    const char *rows[6];
};

#define PX(n) ((n) * 256)
#define MID(n) ((n) * 256 + 128)

static const struct drawing drawings[] = {
    { { PX(1), PX(6), PX(1) }, { PX(1), PX(1), PX(6) }, /* samples on the slope are out */
      { "........",
        ".####...",
        ".###....",
        ".##.....",
        ".#......",
        "........" } },
    { { PX(6), PX(6), PX(1) }, { PX(1), PX(6), PX(6) }, /* ... and belong to the other half */
      { "........",
        ".....#..",
        "....##..",
        "...###..",
        "..####..",
        ".#####.." } },
    { { MID(1), MID(5), MID(1) }, { MID(1), MID(1), MID(5) }, /* corners on samples: top, left in */
      { "........",
        ".####...",
        ".###....",
        ".##.....",
        ".#......",
        "........" } },
    { { MID(1) + 1, MID(5) + 1, MID(1) + 1 }, { MID(1), MID(1), MID(5) }, /* a sub-pixel right */
      { "........",
        "..####..",
        "..###...",
        "..##....",
        "..#.....",
        "........" } },
    { { MID(1), MID(5), MID(1) }, { MID(1) + 1, MID(1) + 1, MID(5) + 1 }, /* and down */
      { "........",
        "........",
        ".####...",
        ".###....",
        ".##.....",
        ".#......" } },
    { { PX(0), PX(8), PX(0) }, { MID(2), MID(2) + 1, MID(2) + 1 }, /* a sliver between two rows */
      { "........",
        "........",
        "........",
        "........",
        "........",
        "........" } },
    { { PX(0), PX(8), PX(8) }, { MID(2), MID(2) - 1, MID(2) + 1 }, /* a sliver on a row */
      { "........",
        "........",
        "########",
        "........",
        "........",
        "........" } },
    { { MID(4), MID(7), MID(1) }, { MID(0), MID(5), MID(5) }, /* tip and bottom are out */
      { "........",
        "....#...",
        "...###..",
        "...###..",
        "..#####.",
        "........" } },
    { { MID(3), MID(3), MID(3) + 256 }, { MID(1), MID(4), MID(3) }, /* vertical left edge */
      { "........",
        "........",
        "...#....",
        "...#....",
        "........",
        "........" } },
    { { MID(3), MID(3), MID(2) }, { MID(1), MID(4), MID(3) }, /* vertical right edge */
      { "........",
        "........",
        "........",
        "..#.....",
        "........",
        "........" } }
};

static void triangles_drawn_by_hand(void **state)
{
    for (size_t n = 0; n < sizeof drawings / sizeof drawings[0]; n++)
        for (int turn = 0; turn < 6; turn++) { /* every order of the corners */
            const struct drawing *d = &drawings[n];
            static const int order[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                             { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } };
            struct easel_tri t = { .d = { 5 << 16, 5 << 16, 5 << 16 } };
            for (int k = 0; k < 3; k++) {
                t.x[k] = d->x[order[turn][k]];
                t.y[k] = d->y[order[turn][k]];
            }
            struct easel s = easel_default(8, 6);
            s.strip_h = 1 + turn;
            struct easel_frame f;
            easel_draw(&s, &t, 1, &f);
            for (int j = 0; j < 6; j++) {
                char row[9] = "........";
                for (int i = 0; i < 8; i++)
                    if (f.color[j * 8 + i])
                        row[i] = '#';
                if (strcmp(row, d->rows[j]))
                    print_error("drawing %zu, row %d: drawn and expected\n", n, j);
                assert_string_equal(row, d->rows[j]);
            }
            easel_free(&f);
        }
}

/* ---- The ends of the keys -------------------------------------------------------------------- */

static void keys_saturate_and_never_wrap(void **state)
{
    for (int bits = 8; bits <= 16; bits++) {
        struct easel s = easel_default(320, 240);
        s.depth_bits = bits;
        const uint32_t top = ((1u << bits) - 1u) << 16;
        struct easel_tri t = { { -GUARD + 320 * 128, GUARD + 320 * 128, 320 * 128 },
                               { 240 * 128 - 4000, 240 * 128, GUARD + 240 * 128 },
                               { 0 },
                               { { 0 } } };
        for (int k = 0; k < 8; k++) { /* all ways of near and far corners */
            for (int v = 0; v < 3; v++)
                t.d[v] = k >> v & 1 ? top : 0;
            struct easel_frame f;
            easel_draw(&s, &t, 1, &f);
            assert_true(frame_right(&s, &t, &f, plane_pixel));
            for (int i = 0; i < 320 * 240; i++) {
                assert_true(f.key[i] == ZS_DEPTH_CLEAR || f.key[i] <= (1u << bits) - 2u);
                if (k == 0 || k == 7)
                    assert_true(!f.color[i] || f.key[i] == (k ? (1u << bits) - 2u : 0u));
            }
            easel_free(&f);
        }
    }
}

/* ---- Failures that other renderers shipped --------------------------------------------------------- */

/* An x beyond 16.16: an edge of a pixel's width or less from one end of the guard band to the other, thousands of
 * pixels beside the frame, where its reciprocal slope times its height, or its x, leaves 32 bits. */
static int far_steep_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed % N_SIZES);
    struct easel_tri t;
    memset(&t, 0, sizeof t);
    const int32_t cx = s.width * 128, cy = s.height * 128, side = prng_pick(&p, 2) ? 1 : -1;
    const int32_t beside = side * prng_range(&p, cx, GUARD), lean = prng_range(&p, -300, 300) >> prng_pick(&p, 8);
    const int32_t third = prng_pick(&p, 3) ? -side * prng_range(&p, 0, GUARD) : beside + prng_range(&p, -600, 600);
    const int32_t x[3] = { beside, beside + lean, third };
    const int32_t y[3] = { -GUARD + prng_range(&p, 0, 600), GUARD - prng_range(&p, 0, 600),
                           prng_range(&p, -GUARD, GUARD) >> prng_pick(&p, 14) };
    for (int k = 0; k < 3; k++) {
        t.x[k] = cx + clamp(x[k], -GUARD, GUARD);
        t.y[k] = cy + y[k];
    }
    random_keys(&p, ((1u << s.depth_bits) - 1u) << 16, t.d);
    return draws_right(&s, &t, plane_pixel);
}

/* Spans that run backwards: two edges of a triangle that is nowhere a sub-pixel wide, rounded, cross each other. Every
 * slope, the corner between anywhere on the long edge, in all orders. */
static int crossed_edges_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed % N_SIZES);
    const int32_t reach = 256 << prng_pick(&p, 14);
    struct easel_tri t, turned;
    memset(&t, 0, sizeof t);
    const int32_t middle[2] = { s.width * 128, s.height * 128 };
    int32_t c[3][2];
    for (int k = 0; k < 2; k++) {
        c[0][k] = clamp(middle[k] + prng_range(&p, -reach, reach), middle[k] - GUARD, middle[k] + GUARD);
        c[1][k] = clamp(middle[k] + prng_range(&p, -reach, reach), middle[k] - GUARD, middle[k] + GUARD);
    }
    const int64_t along = prng_range(&p, 0, 65536);
    for (int k = 0; k < 2; k++)
        c[2][k] = c[0][k] + (int32_t)((c[1][k] - c[0][k]) * along / 65536);
    c[2][prng_pick(&p, 2)] += prng_range(&p, -1, 1);
    const uint32_t first = prng_pick(&p, 3), step = 1 + prng_pick(&p, 2);
    for (uint32_t k = 0; k < 3; k++) {
        t.x[k] = clamp(c[(first + k * step) % 3][0], middle[0] - GUARD, middle[0] + GUARD);
        t.y[k] = clamp(c[(first + k * step) % 3][1], middle[1] - GUARD, middle[1] + GUARD);
    }
    random_keys(&p, ((1u << s.depth_bits) - 1u) << 16, t.d);
    turned = t;
    turned.x[0] = t.x[1];
    turned.y[0] = t.y[1];
    turned.x[1] = t.x[0];
    turned.y[1] = t.y[0];
    return draws_right(&s, &t, plane_pixel) && draws_right(&s, &turned, plane_pixel);
}

/* A division by the area, where that is 0, 1 or 2 sub-pixels squared: every triangle whose corners lie within one
 * sub-pixel of a sample, or of a sample and its neighbours, in all orders. */
static void others_division_by_a_tiny_area(void **state)
{
    struct prng p = { 1 };
    struct easel s = easel_default(3, 2);
    uint32_t n_zero = 0, n_one = 0, drawn = 0;
    for (uint32_t n = 0; n < 9 * 9 * 9 * 2; n++) {
        const uint32_t at[3] = { n % 9, n / 9 % 9, n / 81 % 9 };
        struct easel_tri t;
        memset(&t, 0, sizeof t);
        for (uint32_t k = 0; k < 3; k++) {
            const int32_t next = n >= 729 ? (int32_t)k * 256 : 0; /* on the middle of its own pixel */
            t.x[k] = 128 + next + (int32_t)(at[k] % 3) - 1;
            t.y[k] = 128 + (int32_t)(at[k] / 3) - 1;
        }
        const struct oracle_tri o = easel_oracle(&t);
        const int64_t area = oracle_area(&o);
        n_zero += area == 0;
        n_one += area == 1 || area == -1;
        random_keys(&p, 65535u << 16, t.d);
        struct easel_frame f;
        easel_draw(&s, &t, 1, &f);
        assert_true(frame_right(&s, &t, &f, plane_pixel));
        drawn += f.written != 0;
        easel_free(&f);
    }
    assert_true(n_zero > 100 && n_one > 100 && drawn > 100);
    print_message("tiny areas: %u of 0, %u of 2^-17 px^2, %u triangles with pixels\n", n_zero, n_one, drawn);
}

static int declines(struct zs_job *job)
{
    (void)job;
    return 0;
}

/* The core draws what an accelerator declines, with the bias of its depth state, once. */
static void a_biased_triangle_is_declined(void **state)
{
    static const struct zs_fast fast = { .shader = &zs_shade_flat, .rows = declines };
    static const struct zs_fast *const list[] = { &fast, NULL };
    static const struct zs_depth_state biased = { .bias = 50 };
    struct good g = good_scene();
    struct zs_instance in = g.instance;
    in.material = &g.material;
    g.scene.instance = &in;
    g.config.fast = NULL;
    struct picture plain = picture_draw(&g.config, &g.scene, &g.camera);
    in.depth_state = &biased;
    struct picture core = picture_draw(&g.config, &g.scene, &g.camera);
    g.config.fast = list;
    struct picture is = picture_draw(&g.config, &g.scene, &g.camera);
    assert_true(picture_shows(&core, 100));
    assert_true(picture_same(&core, &is, "declined"));
    assert_false(memcmp(plain.key, core.key, 40 * 30 * sizeof *core.key) == 0);
    PICTURES_FREE(&plain, &core, &is);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(triangles_drawn_by_hand),
    cmocka_unit_test(a_biased_triangle_is_declined),
    cmocka_unit_test(coverage_and_keys_of_single_triangles),
    cmocka_unit_test(coverage_and_keys_in_big_frames),
    cmocka_unit_test(gradients_to_the_last_bit),
    cmocka_unit_test(linear_keys_under_perspective),
    cmocka_unit_test(keys_saturate_and_never_wrap),
    CASES_COUNT(least_key_then_scene_order, crowd_case, 60, &crowd_pixels, 100000, "pixels tested"),
    cmocka_unit_test(shared_edges_hit_every_pixel_once),
    CASES_TEST(others_16_16_overflow_of_a_far_steep_edge, far_steep_case, 400),
    CASES_TEST(others_spans_that_run_backwards, crossed_edges_case, 1200),
    cmocka_unit_test(others_division_by_a_tiny_area)
};

CASES_MAIN(tests)
