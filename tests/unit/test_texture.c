/* Textured shading: which texel is taken, against exact arithmetic; formats, sizes, borders, light.
 *
 * The texels of most textures here are their own numbers, so that a picture tells which were taken.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "oracle.h"
#include "picture.h"
#include "shapes.h"
#include "easel.h"
#include "shade/texture.h"

#define GUARD (8188 * 256)

static const struct zs_depth *const mappings[] = { &zs_depth_recip, &zs_depth_linear,
                                                   &zs_depth_e3m13, &zs_depth_e4m12,
                                                   &zs_depth_e5m11 };
#define MAPPINGS 5u

/* ---- Textures that tell --------------------------------------------------------------------- */

static uint16_t numbers[65536];       /* texel n is n: textures of at most 2^16 texels */
static uint16_t columns[1024 * 1024]; /* texel is its column: for larger ones, drawn twice */
static uint16_t rows[1024 * 1024];

static struct zs_texture texture_of(const void *texel, uint32_t log2_w, uint32_t log2_h,
                                    uint32_t clamp)
{
    const struct zs_texture t = { .format = &zs_texel_565, .texel = texel, .log2_w = (uint8_t)log2_w,
                                  .log2_h = (uint8_t)log2_h, .clamp = (uint8_t)clamp };
    return t;
}

/* A frame of an easel, and which texel each pixel shows. */
struct taken {
    struct easel_frame frame;
    uint16_t *column, *row;
};

static void taken_free(struct taken *t)
{
    easel_free(&t->frame);
    free(t->column);
    free(t->row);
}

static int both_freed(struct taken t[2], int ok)
{
    taken_free(&t[0]);
    taken_free(&t[1]);
    return ok;
}

static void taken_draw(struct easel s, uint32_t log2_w, uint32_t log2_h, uint32_t clamp,
                       const struct easel_tri *t, uint32_t n, struct taken *out)
{
    const size_t n_px = (size_t)s.width * (size_t)s.height;
    const int small = log2_w + log2_h <= 16;
    out->column = calloc(n_px, 2);
    out->row = calloc(n_px, 2);
    if (small) {
        for (uint32_t i = 0; i < 65536; i++)
            numbers[i] = (uint16_t)i;
        const struct zs_texture texture = texture_of(numbers, log2_w, log2_h, clamp);
        s.texture = &texture;
        easel_draw(&s, t, n, &out->frame);
        for (size_t i = 0; i < n_px; i++) {
            out->column[i] = (uint16_t)(out->frame.color[i] & ((1u << log2_w) - 1u));
            out->row[i] = (uint16_t)(out->frame.color[i] >> log2_w);
        }
        return;
    }
    for (uint32_t i = 0; i < 1u << (log2_w + log2_h); i++) {
        columns[i] = (uint16_t)(i & ((1u << log2_w) - 1u));
        rows[i] = (uint16_t)(i >> log2_w);
    }
    for (int axis = 0; axis < 2; axis++) {
        const struct zs_texture texture = texture_of(axis ? rows : columns, log2_w, log2_h, clamp);
        s.texture = &texture;
        if (axis)
            easel_free(&out->frame);
        easel_draw(&s, t, n, &out->frame);
        memcpy(axis ? out->row : out->column, out->frame.color, n_px * 2);
    }
}

/* ---- Exact coordinates ---------------------------------------------------------------------- */

/* A coordinate (0 u, 1 v) at a sample, in texels of a texture of `size`: exact but for the last
 * conversion, 64 bits. uv of the corners in 2^-uv_bits. */
static long double exact_texel(const struct easel *s, const struct easel_frame *unit,
                               const struct easel_tri *t, int i, int j, int axis, uint32_t size)
{
    const struct oracle_tri o = { { t->x[0], t->x[1], t->x[2] }, { t->y[0], t->y[1], t->y[2] } };
    int64_t share[3];
    __int128 sum = 0, weight = 0; /* < 2^45 * 2^60 * 2^16 */
    oracle_weights(&o, i, j, share);
    for (int k = 0; k < 3; k++) {
        const __int128 w = (__int128)share[k] * easel_inverse(s, unit, t->d, k);
        sum += w * ((int32_t)t->rgb[k][axis] - 32768);
        weight += w;
    }
    return (long double)sum / (long double)weight * size / (long double)(1 << s->uv_bits);
}

/* How far a coordinate lies outside the texel that was taken, in texels. */
static double outside(long double at, uint32_t taken, uint32_t size, int clamped)
{
    if (clamped) {
        at = at < 0 ? 0 : at > size ? size : at;
        const long double off = fmaxl(taken - at, at - (taken + 1));
        return off > 0 ? (double)off : 0;
    }
    long double from_middle = at - (taken + 0.5L);
    from_middle -= size * floorl(from_middle / size + 0.5L); /* the nearest repeat */
    return fmax(0, (double)fabsl(from_middle) - 0.5);
}

/* How many texels the one taken is from the right one. */
static uint32_t texels_apart(long double at, uint32_t taken, uint32_t size, int clamped)
{
    const long double whole = floorl(at);
    if (clamped) {
        const uint32_t right = whole < 0 ? 0 : whole >= size ? size - 1 : (uint32_t)whole;
        return right > taken ? right - taken : taken - right;
    }
    const uint32_t right = (uint32_t)(whole - size * floorl(whole / size)) % size;
    const uint32_t off = (right - taken) & (size - 1u);
    return off > size / 2 ? size - off : off;
}

struct tally {
    uint64_t coordinates, one_off,
        more_off;        /* coordinates whose texel is the one beside, and others */
    double worst;        /* outside the texel taken */
    double worst_beyond; /* of the part that the spans explain */
};

static struct tally tally; /* of the cases that TALLIED runs */

static void tallied(const char *test, case_fn *fn, uint64_t n)
{
    memset(&tally, 0, sizeof tally);
    cases_run(test, fn, n);
}
#define TALLIED(fn, n) tallied(__func__, fn, n)

/* Of a coordinate that lies evenly over a texel, |error| is on average how often the next one is
 * taken. */
static double tally_mean(void)
{
    return (double)(tally.one_off + 2 * tally.more_off) / fmax((double)tally.coordinates, 1);
}

static void tally_print(const char *what)
{
    print_message(
        "%s: %llu coordinates, %.3f %% one texel off, %llu more; error at most %.4f texel, on "
        "average %.5f\n",
        what, (unsigned long long)tally.coordinates,
        100.0 * (double)tally.one_off / fmax((double)tally.coordinates, 1),
        (unsigned long long)tally.more_off, tally.worst, tally_mean());
}

/* ---- Random triangles ----------------------------------------------------------------------- */

static struct easel_frame unit_of(const struct easel *s)
{
    struct easel_frame f;
    easel_draw(s, NULL, 0, &f);
    easel_free(&f);
    return f;
}

/* What a mapping stores of a distance in world units. */
static uint32_t depth_of(const struct easel *s, const struct easel_frame *unit, double z)
{
    const struct oracle_float f = { easel_float_bits(s->depth), s->depth_bits };
    const double n = s->z_near, far = s->z_far, top = (ldexp(1, s->depth_bits) - 1) * 65536;
    if (f.e)
        return oracle_float_d(&f, n / z);
    if (s->depth == &zs_depth_linear)
        return (uint32_t)ldexp(z, unit->shift);
    return (uint32_t)floor((1 / n - 1 / z) / (1 / n - 1 / far) * top);
}

enum uv_kind {
    UV_ONE,   /* within one repeat */
    UV_ANY,   /* all that the mesh can hold */
    UV_FEW,   /* a few texels of 256 */
    UV_SPAN,  /* a span of any size, for affine and long sub-spans */
    UV_LINE,  /* u constant */
    UV_EXACT, /* corners on borders between texels */
    UV_KINDS
};

static int32_t random_uv(struct prng *p, enum uv_kind kind, int32_t uv_bits, int axis,
                         int32_t first)
{
    const int32_t one = 1 << uv_bits, texel = one >= 256 ? one / 256 : 1;
    int32_t v;
    switch (kind) {
    case UV_ONE: v = prng_range(p, 0, one); break;
    case UV_FEW: v = first + prng_range(p, -5 * texel, 5 * texel); break;
    case UV_SPAN: v = first + (prng_range(p, -32768, 32767) >> prng_range(p, 0, 12)); break;
    case UV_LINE: v = axis ? prng_range(p, -one, one) : first; break;
    case UV_EXACT: v = prng_range(p, -300, 300) * texel; break;
    default: v = prng_range(p, -32768, 32767); break;
    }
    return v < -32768 ? -32768 : v > 32767 ? 32767 : v;
}

static void random_tri(struct prng *p, const struct easel *s, const struct easel_frame *unit,
                       enum uv_kind kind, double ratio, struct easel_tri *t)
{
    const int huge = prng_pick(p, 6) == 0, small = prng_pick(p, 3) == 0;
    const double most = s->z_far / ratio / s->z_near;
    const double nearest = s->z_near * pow(most, prng_pick(p, 1025) / 2048.0);
    memset(t, 0, sizeof *t);
    for (int k = 0; k < 3; k++) {
        const int32_t reach_x = huge ? GUARD : small ? 3000 : s->width * 200;
        const int32_t reach_y = huge ? GUARD : small ? 3000 : s->height * 200;
        t->x[k] = (small && k ? t->x[0] : s->width * 128) + prng_range(p, -reach_x, reach_x);
        t->y[k] = (small && k ? t->y[0] : s->height * 128) + prng_range(p, -reach_y, reach_y);
        for (int axis = 0; axis < 2; axis++)
            t->rgb[k][axis] = EASEL_UV(
                random_uv(p, kind, s->uv_bits, axis, (int32_t)t->rgb[0][axis] - 32768));
        t->rgb[k][2] = (uint16_t)prng_pick(p, 65505);
        /* the whole ratio between two of them, the third anywhere */
        const double part = k == 2 ? prng_pick(p, 1025) / 1024.0 : k;
        t->d[k] = depth_of(s, unit, nearest * pow(ratio, part));
    }
    const int turn = (int)prng_pick(p, 3);
    const uint32_t d[3] = { t->d[0], t->d[1], t->d[2] };
    for (int k = 0; k < 3; k++)
        t->d[k] = d[(k + turn) % 3];
}

/* The error that NUMERICS.md allows: 1/4 texel of interpolation, 1/512 added on purpose, and what a
 * triangle's span of texels and its ratio of w do to 31-bit planes. */
static double bound_of(const struct easel *s, const struct easel_frame *unit,
                       const struct easel_tri *t, int axis, uint32_t size)
{
    double least_w = 1e300, most_w = 0;
    int32_t lo = 65535, hi = 0;
    for (int k = 0; k < 3; k++) {
        const double w = (double)easel_inverse(s, unit, t->d, k);
        least_w = fmin(least_w, w);
        most_w = fmax(most_w, w);
        lo = t->rgb[k][axis] < lo ? t->rgb[k][axis] : lo;
        hi = t->rgb[k][axis] > hi ? t->rgb[k][axis] : hi;
    }
    const double span = (double)(hi - lo) / (1 << s->uv_bits) * size;
    return 0.25 + 0x1p-9 + span * most_w / least_w * 0x1p-21;
}

static int wrong_at(const struct easel *s, const struct easel_tri *t, int i, int j,
                    const char *what, double value)
{
    return case_wrong(
        "%s %g at (%d, %d) of %dx%d, strips of %d, uv bits %d, float of %d: (%d %d %u: %d %d) "
        "(%d %d %u: %d %d) (%d %d %u: %d %d)",
        what, value, i, j, s->width, s->height, s->strip_h, s->uv_bits, easel_float_bits(s->depth),
        t->x[0], t->y[0], t->d[0], t->rgb[0][0] - 32768, t->rgb[0][1] - 32768, t->x[1], t->y[1],
        t->d[1], t->rgb[1][0] - 32768, t->rgb[1][1] - 32768, t->x[2], t->y[2], t->d[2],
        t->rgb[2][0] - 32768, t->rgb[2][1] - 32768);
}

/* Draw one triangle; every pixel's texel within the bound, or within `limit` texels where that is
 * not 0. */
static int texels_right(const struct easel *s, uint32_t log2_w, uint32_t log2_h, uint32_t clamp,
                        const struct easel_tri *t, double limit)
{
    const uint32_t size[2] = { 1u << log2_w, 1u << log2_h };
    const struct easel_frame unit = unit_of(s);
    struct taken f;
    int ok = 1;
    taken_draw(*s, log2_w, log2_h, clamp, t, 1, &f);
    for (int i = 0; i < s->width * s->height && ok; i++) {
        const int x = i % s->width, y = i / s->width;
        for (int axis = 0; axis < 2 && ok && f.frame.key[i] != ZS_DEPTH_CLEAR; axis++) {
            const uint32_t taken = axis ? f.row[i] : f.column[i];
            const int clamped = (int)(clamp >> axis & 1u);
            const long double at = exact_texel(s, &unit, t, x, y, axis, size[axis]);
            const double off = outside(at, taken, size[axis], clamped);
            const double bound = bound_of(s, &unit, t, axis, size[axis]);
            const uint32_t apart = texels_apart(at, taken, size[axis], clamped);
            tally.coordinates++;
            tally.one_off += apart == 1;
            tally.more_off += apart > 1;
            tally.worst = fmax(tally.worst, off);
            tally.worst_beyond = fmax(tally.worst_beyond, off - bound);
            if (off > bound || (limit > 0 && (off > limit || apart > 1)) || taken >= size[axis])
                ok = wrong_at(s, t, x, y, axis ? "texel row" : "texel column", taken) +
                     case_wrong(
                         "exact %.6Lf, outside the texel by %.5f of %ux%u, clamped %u, bound %.5f",
                         at, off, size[0], size[1], clamp, bound);
        }
    }
    taken_free(&f);
    return ok;
}

static struct easel random_easel(struct prng *p, uint64_t seed)
{
    struct easel s = easel_default(96, 72);
    s.strip_h = prng_range(p, 1, 72);
    s.depth = mappings[seed % MAPPINGS];
    s.uv_bits = prng_pick(p, 2) ? 12 : prng_range(p, 0, 15);
    if (s.depth != &zs_depth_linear && s.depth != &zs_depth_recip)
        s.z_far = 1 << 19;
    return s;
}

static int ratio_case(uint64_t seed, double ratio)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t;
    s.uv_bits = prng_range(&p, 8, 15); /* up to 256 repeats */
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), ratio, &t);
    return texels_right(&s, 8, 8, prng_pick(&p, 4), &t, 0);
}

static int ratio_1(uint64_t seed) { return ratio_case(seed, 1); }
static int ratio_2(uint64_t seed) { return ratio_case(seed, 2); }
static int ratio_4(uint64_t seed) { return ratio_case(seed, 4); }
static int ratio_8(uint64_t seed) { return ratio_case(seed, 8); }
static int ratio_16(uint64_t seed) { return ratio_case(seed, 16); }
static int ratio_1000(uint64_t seed) { return ratio_case(seed, 1000); }

/* Less than a texel of 1024 from corner to corner, across a border. */
static int border_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t;
    s.uv_bits = 15; /* 32 steps a texel */
    random_tri(&p, &s, &unit, UV_ONE, 4 << prng_pick(&p, 9), &t);
    const int32_t border = 32 * prng_range(&p, -1000, 1000), below = prng_range(&p, 0, 31);
    for (int k = 0; k < 3; k++)
        for (int axis = 0; axis < 2; axis++)
            t.rgb[k][axis] = EASEL_UV(border - below + prng_range(&p, 0, 31));
    return texels_right(&s, 10, 10, prng_pick(&p, 4), &t, 0);
}

static void less_than_a_texel(void **state)
{
    TALLIED(border_case, 300);
    tally_print("less than a texel");
}

static void texels_by_ratio_of_w(void **state)
{
    static const struct {
        case_fn *fn;
        const char *name;
    } ratios[] = { { ratio_1, "w ratio 1" },   { ratio_2, "w ratio 2" },
                   { ratio_4, "w ratio 4" },   { ratio_8, "w ratio 8" },
                   { ratio_16, "w ratio 16" }, { ratio_1000, "w ratio 1000" } };
    for (size_t n = 0; n < sizeof ratios / sizeof ratios[0]; n++) {
        TALLIED(ratios[n].fn, 300);
        tally_print(ratios[n].name);
    }
}

/* Any span of texels of 256, up to sixteen repeats: none is more than one off, all within half a
 * texel, on average within a twentieth. */
static int half_texel_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t;
    if (seed % 8 == 0) { /* sub-spans of all lengths */
        s.width = 320;
        s.height = 240;
    }
    s.uv_bits = 12;
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), 16, &t);
    return texels_right(&s, 8, 8, 0, &t, 0.5);
}

static void stress_27_uv_at_a_w_ratio_of_16(void **state)
{
    TALLIED(half_texel_case, 800);
    tally_print("stress 27, w ratio 16");
    assert_true(tally.worst <= 0.5);
    assert_true(tally_mean() <= 0.05);
    assert_int_equal(tally.more_off, 0);
}

static int size_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t;
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), prng_pick(&p, 2) ? 1.2 : 16,
               &t);
    return texels_right(&s, (uint32_t)(seed % 11), (uint32_t)(seed / 11 % 11), prng_pick(&p, 4), &t,
                        0);
}

static void sizes_from_1_to_1024(void **state)
{
    TALLIED(size_case, 121 * 3);
    tally_print("all sizes");
}

/* ---- Borders, exactly ----------------------------------------------------------------------- */

/* Two triangles that face the camera, a whole number of texels or parts of one to the pixel. Their
 * coordinates are exact at every sample, those on a border between two texels too. */
static int aligned_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = easel_default(64, 48);
    const uint32_t log2_w = prng_pick(&p, 9), log2_h = prng_pick(&p, 9), clamp = prng_pick(&p, 4);
    const int32_t texel[2] = { 4096 >> log2_w, 4096 >> log2_h }; /* in 2^-12 repeats: 16 or more */
    s.uv_bits = 12;
    s.strip_h = prng_range(&p, 1, 48);
    s.depth = mappings[seed % MAPPINGS];
    const struct easel_frame unit = unit_of(&s);
    /* uv = from + step * (pixel - x0), step a power of two of parts of a texel, negative for
     * mirrors */
    int32_t step[2], from[2], x[2], y[2], sign[2];
    for (int k = 0; k < 2; k++) {
        sign[k] = prng_pick(&p, 2) ? 1 : -1;
        step[k] = sign[k] * (texel[k] * 2 >> prng_pick(&p, 4)) * (prng_pick(&p, 8) ? 1 : 0);
        if (abs(step[k]) > 256)
            step[k] = 256 * sign[k];
        from[k] = prng_range(&p, -3, 3) * 4096 + prng_range(&p, -4, 4) * texel[k] +
                  (prng_pick(&p, 2) ? 0 : texel[k] / 2);
    }
    x[0] = prng_range(&p, -2, 8);
    x[1] = x[0] + 48; /* powers of two and three: the planes' gradients are exact */
    y[0] = prng_range(&p, -2, 8);
    y[1] = y[0] + 24;
    const uint32_t d = depth_of(&s, &unit, prng_range(&p, 1000, 100000));
    struct easel_tri t[2];
    memset(t, 0, sizeof t);
    for (int n = 0; n < 2; n++)
        for (int k = 0; k < 3; k++) {
            const int right = n ? k != 1 : k == 1 /* (0 0) (1 0) (0 1) and (1 1) (0 1) (1 0) */;
            const int below = n ? k == 0 || k == 1 : k == 2;
            const int right_2 = n ? k == 0 || k == 2 : right;
            t[n].x[k] = x[right_2] * 256 + 128; /* corners on samples */
            t[n].y[k] = y[below] * 256 + 128;
            t[n].d[k] = d;
            t[n].rgb[k][0] = EASEL_UV(from[0] + step[0] * (right_2 ? 48 : 0));
            t[n].rgb[k][1] = EASEL_UV(from[1] + step[1] * (below ? 24 : 0));
        }
    for (int n = 0; n < 2; n++)
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 2; axis++)
                if (labs((long)from[axis] + step[axis] * 48) > 32000)
                    return 1;
    struct taken f;
    taken_draw(s, log2_w, log2_h, clamp, t, 2, &f);
    int ok = 1;
    for (int i = 0; i < 64 * 48 && ok; i++) {
        const int at[2] = { i % 64 - x[0], i / 64 - y[0] };
        if (f.frame.key[i] == ZS_DEPTH_CLEAR)
            continue;
        for (int axis = 0; axis < 2 && ok; axis++) {
            const int32_t size = 1 << (axis ? log2_h : log2_w);
            const int32_t uv = from[axis] + step[axis] * at[axis];
            int32_t want = (uv >= 0 ? uv : uv - texel[axis] + 1) / texel[axis];
            want = clamp >> axis & 1u ? (want < 0       ? 0
                                         : want >= size ? size - 1
                                                        : want)
                                      : want & (size - 1);
            const int32_t got = axis ? f.row[i] : f.column[i];
            if (got != want)
                ok = wrong_at(&s, &t[0], i % 64, i / 64, axis ? "row" : "column", got) +
                     case_wrong("not %d: coordinate %d / 4096 of %d texels, clamped %u", want, uv,
                                size, clamp >> axis & 1u);
        }
        tally.coordinates += 2;
    }
    taken_free(&f);
    return ok;
}

static void repeat_and_clamp_to_the_texel(void **state)
{
    TALLIED(aligned_case, 1500);
    print_message("aligned: %llu coordinates, all in the right texel\n",
                  (unsigned long long)tally.coordinates);
}

/* ---- Light ---------------------------------------------------------------------------------- */

static const int most_code[3] = { 31, 63, 31 };

static int code_of(uint16_t color, int channel)
{
    return channel == 0 ? color >> 11 : channel == 1 ? color >> 5 & 63 : color & 31;
}

static struct {
    uint64_t values, one_off;
    double squares; /* of differences in parts of 255 */
    double worst;   /* codes from the unrounded value */
} colors;

static int channel_right(uint16_t color, int channel, double exact, double slack)
{
    const int code = code_of(color, channel), want = (int)floor(exact + 0.5);
    const double step = (code - want) * 255.0 / most_code[channel];
    colors.values++;
    colors.one_off += code != want;
    colors.squares += step * step;
    colors.worst = fmax(colors.worst, fabs(code - exact) - slack);
    return abs(code - want) <= 1 || fabs(code - exact) <= 0.5 + slack;
}

static double psnr(void)
{
    return 10 * log10(255.0 * 255.0 * (double)colors.values / fmax(colors.squares, 1e-12));
}

static void colors_print(const char *what)
{
    print_message(
        "%s: %llu values, %.3f %% one code off, %.4f codes from the unrounded value at most, "
        "%.1f dB\n",
        what, (unsigned long long)colors.values,
        100.0 * (double)colors.one_off / fmax((double)colors.values, 1), colors.worst, psnr());
}

/* A row of tests: cases whose colours are those of doubles, as far as 50 dB tell. */
struct colors_cases {
    const char *test;
    case_fn *fn;
    uint64_t n;
    const char *what;
};

static void colors_test(void **state)
{
    const struct colors_cases *const c = *state;
    memset(&colors, 0, sizeof colors);
    cases_run(c->test, c->fn, c->n);
    colors_print(c->what);
    assert_true(psnr() >= 50);
}

#define COLORS_TEST(name_, ...) \
    { .name = #name_, .test_func = colors_test, .initial_state = &(struct colors_cases){ #name_, __VA_ARGS__ } }

/* Smooth light over a texture: texel times light, of exactly known geometry. Constant texels, so
 * that light alone counts; then the texel that unlit shading takes. */
static int smooth_light_case(uint64_t seed)
{
    static uint16_t texel[256 * 256];
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    const double ratio[] = { 1, 1.3, 16, 1000 };
    struct easel_tri t;
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), ratio[prng_pick(&p, 4)], &t);
    const int alone = seed % 4 ==
                      1; /* nothing but the light changes, and that at one corner, where it is less or more */
    const int constant = prng_pick(&p, 3) == 0 || alone;
    const uint16_t level[2] = { (uint16_t)prng_pick(&p, 65505), (uint16_t)prng_pick(&p, 65505) };
    for (int k = 0; k < 3 && alone; k++) {
        t.rgb[k][0] = t.rgb[0][0];
        t.rgb[k][1] = t.rgb[0][1];
        t.rgb[k][2] = level[seed / 4 % 3 == (uint64_t)k];
    }
    for (int i = 0; i < 256 * 256; i++)
        texel[i] = (uint16_t)(i && constant ? texel[0] : prng_next(&p));
    const struct zs_texture texture = texture_of(texel, 8, 8, prng_pick(&p, 4));
    s.texture = &texture;
    struct easel_frame lit, plain;
    s.smooth = 1;
    easel_draw(&s, &t, 1, &lit);
    /* lit by 1 everywhere is the texel; the sub-spans are those of the light */
    struct easel_tri full = t;
    s.smooth = 0;
    easel_draw(&s, &full, 1, &plain);
    const struct oracle_tri o = { { t.x[0], t.x[1], t.x[2] }, { t.y[0], t.y[1], t.y[2] } };
    int ok = 1;
    for (int i = 0; i < s.width * s.height && ok; i++) {
        if (lit.key[i] == ZS_DEPTH_CLEAR)
            continue;
        int64_t share[3];
        long double sum = 0, weight = 0;
        oracle_weights(&o, i % s.width, i / s.width, share);
        for (int k = 0; k < 3; k++) {
            const long double w = (long double)share[k] * easel_inverse(&s, &unit, t.d, k);
            sum += w * t.rgb[k][2];
            weight += w;
        }
        const double intensity = (double)(sum / weight / EASEL_LIGHT_ONE);
        for (int c = 0; c < 3 && ok; c++) {
            const double exact = fmin(code_of(constant ? texel[0] : plain.color[i], c) * intensity,
                                      most_code[c]);
            if (constant && !channel_right(lit.color[i], c, exact, 0))
                ok = wrong_at(&s, &t, i % s.width, i / s.width, "lit channel",
                              code_of(lit.color[i], c)) +
                     case_wrong("not %.4f, channel %d, light %.5f", exact, c, intensity);
        }
    }
    easel_free(&lit);
    easel_free(&plain);
    return ok;
}

/* Lit by exactly 1 it is the texel, exactly. */
static int full_light_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t;
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), prng_pick(&p, 2) ? 1.1 : 16,
               &t);
    for (int k = 0; k < 3; k++)
        t.rgb[k][2] = EASEL_LIGHT_ONE;
    for (uint32_t i = 0; i < 65536; i++)
        numbers[i] = (uint16_t)i;
    const struct zs_texture texture = texture_of(numbers, 8, 8, prng_pick(&p, 4));
    s.texture = &texture;
    struct easel_frame lit, plain;
    easel_draw(&s, &t, 1, &plain);
    s.smooth = 1;
    easel_draw(&s, &t, 1, &lit);
    const int ok = memcmp(lit.color, plain.color, (size_t)(s.width * s.height) * 2) == 0;
    easel_free(&lit);
    easel_free(&plain);
    return ok ? 1 : wrong_at(&s, &t, 0, 0, "light of 1 changes a texel", 0);
}

/* ---- Moved, mirrored, hidden ---------------------------------------------------------------- */

static int moved_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t[2];
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), prng_pick(&p, 2) ? 1.2 : 16,
               &t[0]);
    for (int k = 0; k < 3; k++) { /* a small one: large ones are anchored in the frame */
        t[0].x[k] = (k ? t[0].x[0] : 8000) + prng_range(&p, -7000, 7000);
        t[0].y[k] = (k ? t[0].y[0] : 8000) + prng_range(&p, -7000, 7000);
    }
    const int dx = prng_range(&p, -60, 60), dy = prng_range(&p, -40, 40);
    t[1] = t[0];
    for (int k = 0; k < 3; k++) {
        t[1].x[k] += dx * 256;
        t[1].y[k] += dy * 256;
    }
    const uint32_t clamp = prng_pick(&p, 4);
    struct taken f[2];
    for (int n = 0; n < 2; n++)
        taken_draw(s, 8, 8, clamp, &t[n], 1, &f[n]);
    int ok = 1;
    for (int y = 0; y < s.height && ok; y++)
        for (int x = 0; x < s.width && ok; x++) {
            const int to_x = x + dx, to_y = y + dy;
            if (to_x < 0 || to_y < 0 || to_x >= s.width || to_y >= s.height)
                continue;
            const int a = y * s.width + x, b = to_y * s.width + to_x;
            if (f[0].frame.color[a] != f[1].frame.color[b] ||
                f[0].frame.key[a] != f[1].frame.key[b])
                ok = wrong_at(&s, &t[0], x, y, "moved by whole pixels: texel", f[1].frame.color[b]);
            tally.coordinates += f[0].frame.key[a] != ZS_DEPTH_CLEAR;
        }
    return both_freed(f, ok);
}

static void moved_by_whole_pixels_the_same_texels(void **state)
{
    TALLIED(moved_case, 600);
    print_message("moved: %llu pixels, all of the same texel\n",
                  (unsigned long long)tally.coordinates);
    assert_true(!cases_all() || tally.coordinates > 30000);
}

/* From right to left, from bottom to top: the texels of the mirrored pixel, or the one beside where
 * an error of an eighth tips it over. */
static int mirrored_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t[2];
    s.uv_bits = 12;
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), 4, &t[0]);
    const int upside = (int)prng_pick(&p, 2);
    t[1] = t[0];
    for (int k = 0; k < 3; k++)
        if (upside)
            t[1].y[k] = s.height * 256 - t[0].y[k];
        else
            t[1].x[k] = s.width * 256 - t[0].x[k];
    const struct oracle_tri o = { { t[0].x[0], t[0].x[1], t[0].x[2] },
                                  { t[0].y[0], t[0].y[1], t[0].y[2] } };
    struct taken f[2];
    for (int n = 0; n < 2; n++)
        taken_draw(s, 8, 8, 0, &t[n], 1, &f[n]);
    int ok = 1;
    for (int y = 0; y < s.height && ok; y++)
        for (int x = 0; x < s.width && ok; x++) {
            const int a = y * s.width + x;
            const int b = upside ? (s.height - 1 - y) * s.width + x : y * s.width + s.width - 1 - x;
            if (oracle_on_edge(&o, x, y))
                continue;
            if ((f[0].frame.key[a] == ZS_DEPTH_CLEAR) != (f[1].frame.key[b] == ZS_DEPTH_CLEAR))
                ok = wrong_at(&s, &t[0], x, y, "mirrored: coverage", 0);
            if (f[0].frame.key[a] == ZS_DEPTH_CLEAR)
                continue;
            for (int axis = 0; axis < 2 && ok; axis++) {
                const uint32_t one = axis ? f[0].row[a] : f[0].column[a];
                const uint32_t other = axis ? f[1].row[b] : f[1].column[b];
                const uint32_t off = (one - other + 1u) & 255u;
                tally.coordinates++;
                tally.one_off += one != other;
                if (off > 2)
                    ok = wrong_at(&s, &t[0], x, y, "mirrored: texel", other);
            }
        }
    return both_freed(f, ok);
}

static void mirrored_the_same_texels(void **state)
{
    TALLIED(mirrored_case, 400);
    print_message("mirrored: %llu coordinates, %.3f %% in the texel beside\n",
                  (unsigned long long)tally.coordinates,
                  100.0 * (double)tally.one_off / fmax((double)tally.coordinates, 1));
    assert_true(tally.one_off < tally.coordinates / 20);
}

/* What lies before a triangle moves no texel of what is still seen of it. */
static int hidden_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t[9];
    const double ratio = prng_pick(&p, 2) ? 1.2 : 16;
    enum uv_kind kind = (enum uv_kind)prng_pick(&p, UV_KINDS);
    random_tri(&p, &s, &unit, kind, ratio, &t[8]);
    for (int n = 0; n < 8; n++) {
        random_tri(&p, &s, &unit, kind, ratio, &t[n]);
        for (int k = 0; k < 3; k++)
            t[n].d[k] = depth_of(&s, &unit, s.z_near);
    }
    struct taken all, alone, before;
    const uint32_t clamp = prng_pick(&p, 4);
    taken_draw(s, 8, 8, clamp, &t[8], 1, &alone);
    taken_draw(s, 8, 8, clamp, t, 8, &before);
    taken_draw(s, 8, 8, clamp, t, 9, &all);
    int ok = 1;
    for (int i = 0; i < s.width * s.height && ok; i++)
        if (before.frame.key[i] == ZS_DEPTH_CLEAR && all.frame.color[i] != alone.frame.color[i])
            ok = wrong_at(&s, &t[8], i % s.width, i / s.width, "half hidden: texel",
                          all.frame.color[i]);
    taken_free(&all);
    taken_free(&alone);
    taken_free(&before);
    return ok;
}

/* ---- Formats -------------------------------------------------------------------------------- */

/* Sixteen colours in all three formats. */
static int format_case(uint64_t seed)
{
    static uint16_t direct[1 << 16];
    static uint8_t bytes[1 << 16], nibbles[1 << 15];
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    const uint32_t log2_w = 1u + prng_pick(&p, 8), log2_h = prng_pick(&p, 9),
                   clamp = prng_pick(&p, 4);
    uint16_t palette[256];
    for (int n = 0; n < 256; n++)
        palette[n] = (uint16_t)prng_next(&p);
    memset(nibbles, 0, sizeof nibbles);
    for (uint32_t n = 0; n < 1u << (log2_w + log2_h); n++) {
        const uint32_t color = prng_pick(&p, 16);
        direct[n] = palette[color];
        bytes[n] = (uint8_t)color;
        nibbles[n / 2] |= (uint8_t)(color << (n & 1u) * 4u);
    }
    const struct zs_texture textures[3] = {
        { .format = &zs_texel_565, .texel = direct, .log2_w = (uint8_t)log2_w, .log2_h = (uint8_t)log2_h,
          .clamp = (uint8_t)clamp },
        { .format = &zs_texel_pal8, .texel = bytes, .palette = palette, .n_colors = 256, .log2_w = (uint8_t)log2_w,
          .log2_h = (uint8_t)log2_h, .clamp = (uint8_t)clamp },
        { .format = &zs_texel_pal4, .texel = nibbles, .palette = palette, .n_colors = 16, .log2_w = (uint8_t)log2_w,
          .log2_h = (uint8_t)log2_h, .clamp = (uint8_t)clamp }
    };
    struct easel_tri t;
    struct easel_frame f[3];
    random_tri(&p, &s, &unit, (enum uv_kind)prng_pick(&p, UV_KINDS), prng_pick(&p, 2) ? 1.2 : 16,
               &t);
    s.smooth = (int)prng_pick(&p, 2);
    int ok = 1;
    for (int n = 0; n < 3; n++) {
        s.texture = &textures[n];
        easel_draw(&s, &t, 1, &f[n]);
        if (memcmp(f[n].color, f[0].color, (size_t)(s.width * s.height) * 2))
            ok = wrong_at(&s, &t, 0, 0, "another picture from format", n);
    }
    for (int n = 0; n < 3; n++)
        easel_free(&f[n]);
    return ok;
}

/* Gradients of coordinates are products rounded once, and those that do not fit are refused. */
static void texel_gradients_are_rounded_once(void **state)
{
    struct prng p = { 3 };
    uint32_t refused = 0;
    for (int i = 0; i < 200000; i++) {
        const uint32_t rcp = (uint32_t)prng_next(&p) | 0x80000000u;
        const int32_t n = (int32_t)((uint32_t)prng_next(&p) & 0x7fffffffu) >> prng_pick(&p, 31),
                      shift = prng_range(&p, 1, 36);
        const int32_t signed_n = prng_pick(&p, 2) ? n : -n;
        const __int128 one = 1, exact = ((__int128)signed_n * rcp + (one << (shift - 1))) >> shift;
        const uint64_t got = zs_texture_gradient(signed_n, rcp, shift);
        const int fits = exact >= INT32_MIN && exact <= INT32_MAX;
        assert_int_equal(got >> 32 == 0, fits);
        if (fits)
            assert_int_equal((int32_t)got, (int32_t)exact);
        refused += !fits;
    }
    assert_true(refused > 1000);
}

/* ---- Small triangles -------------------------------------------------------------------------- */

#define SMALL_TRIS 60u
static uint64_t small_at_once, small_setups;

/* Triangles of 1 to 64 pixels, many of them affine, some beside the frame: in one go or stage by stage, the same. */
static int small_case(uint64_t seed)
{
    static const struct zs_texel *const formats[] = { &zs_texel_565, &zs_texel_pal8, &zs_texel_pal4 };
    static uint16_t palette[256];
    struct prng p = { seed };
    struct easel s = random_easel(&p, seed);
    const struct easel_frame unit = unit_of(&s);
    const struct zs_texel *format = formats[prng_pick(&p, 3)];
    const uint32_t log2_w = 1u + prng_pick(&p, prng_pick(&p, 16) ? 8 : 10),
                   log2_h = prng_pick(&p, prng_pick(&p, 16) ? 9 : 11);
    const size_t texels = (size_t)1 << (log2_w + log2_h);
    uint8_t *const texel = malloc(texels * 2); /* exactly as many as there are, below */
    const uint32_t bits_of = format == &zs_texel_565 ? 16 : format == &zs_texel_pal8 ? 8 : 4;
    const uint16_t n_colors = prng_pick(&p, 2) || bits_of == 4 ? 16 : 100;
    void *const exact = malloc(texels * bits_of / 8);
    const struct zs_texture texture = { .format = format, .texel = exact, .palette = palette, .n_colors = n_colors,
                                        .log2_w = (uint8_t)log2_w, .log2_h = (uint8_t)log2_h,
                                        .clamp = prng_pick(&p, 8) ? 0u : (uint8_t)prng_pick(&p, 4) };
    struct easel_tri t[SMALL_TRIS];
    struct easel_frame f[3];
    for (size_t k = 0; k < texels * bits_of / 8; k++) {
        const uint32_t any = (uint32_t)(k * 2654435761u + seed) >> 13;
        texel[k] = (uint8_t)(bits_of == 8 ? any % n_colors : any);
    }
    memcpy(exact, texel, texels * bits_of / 8);
    free(texel);
    s.width = prng_range(&p, 1, 150);
    s.strip_h = prng_range(&p, 1, s.height);
    s.depth_bits = prng_range(&p, 8, 16);
    for (int k = 0; k < 256; k++)
        palette[k] = (uint16_t)prng_next(&p);
    for (uint32_t n = 0; n < SMALL_TRIS; n++) {
        const enum uv_kind kind = prng_pick(&p, 2) ? UV_FEW : (enum uv_kind)prng_pick(&p, UV_KINDS);
        const int32_t size = 256 << prng_pick(&p, 7), tilt = prng_range(&p, 2, 24); /* px; of depth: 2^-tilt */
        const int32_t x = prng_range(&p, -1000, s.width * 256), y = prng_range(&p, -1000, s.height * 256);
        const double most = s.z_far / 2.0 / s.z_near, z = s.z_near * pow(most, prng_pick(&p, 1025) / 1024.0);
        const int wide = prng_pick(&p, 12) == 0; /* one coordinate goes over many repeats */
        memset(&t[n], 0, sizeof t[n]);
        for (int k = 0; k < 3; k++) {
            t[n].x[k] = x + prng_range(&p, 0, size);
            t[n].y[k] = y + prng_range(&p, 0, size);
            t[n].d[k] = depth_of(&s, &unit, z * (1 + ldexp(prng_pick(&p, 1025) / 1024.0, -tilt)));
            for (int axis = 0; axis < 2; axis++)
                t[n].rgb[k][axis] = EASEL_UV(random_uv(&p, kind, s.uv_bits, axis, (int32_t)t[n].rgb[0][axis] - 32768));
            if (wide) {
                t[n].rgb[k][n % 2] = (uint16_t)(k == 1 ? 65535 : prng_pick(&p, 65536));
                t[n].d[k] = t[n].d[0];
                t[n].x[k] = x + (k == 1 ? 64 * 256 - 1 : prng_range(&p, 0, 2000));
                t[n].y[k] = y + (k == 2 ? 64 * 256 - 1 : prng_range(&p, 0, 2000));
            }
            t[n].rgb[k][2] = (uint16_t)prng_pick(&p, 65505);
            if (tilt % 2 && k)
                t[n].rgb[k][2] = (uint16_t)(t[n].rgb[0][2] / 2 + 16000 + prng_range(&p, -300, 300));
            if (k == 2 && tilt % 4 == 2)
                t[n].rgb[0][2] = t[n].rgb[1][2] = t[n].rgb[2][2] = EASEL_LIGHT_ONE;
        }
    }
    s.texture = &texture;
    s.smooth = (int)prng_pick(&p, 2);
    s.lit = !s.smooth && prng_pick(&p, 2);
    const struct zs_fast *const *const lists[3] = { fast_all, NULL, fast_any(&p) };
    const size_t bytes_of = (size_t)(s.width * s.height) * 2;
    int ok = 1;
    for (int k = 0; k < 3; k++) {
        s.fast = lists[k];
        easel_draw(&s, t, SMALL_TRIS, &f[k]);
        if (memcmp(f[0].color, f[k].color, bytes_of) || memcmp(f[0].key, f[k].key, bytes_of))
            ok = case_wrong("another picture in one go: %u x %u texels, smooth %d, lit %d, list %d", 1u << log2_w,
                            1u << log2_h, s.smooth, s.lit, k);
        if (f[0].tested != f[k].tested || f[0].written != f[k].written || f[0].setups != f[k].setups)
            ok = case_wrong("other counts in one go: %u %u, %u %u, %u %u; list %d", f[0].tested, f[k].tested,
                            f[0].written, f[k].written, f[0].setups, f[k].setups, k);
    }
    small_at_once += f[0].at_once;
    small_setups += f[0].setups;
    for (int k = 0; k < 3; k++)
        easel_free(&f[k]);
    free(exact);
    return ok;
}

static void small_ones_in_one_go_the_same(void **state)
{
    CASES(small_case, 1500);
    print_message("%llu of %llu in one go\n", (unsigned long long)small_at_once, (unsigned long long)small_setups);
    assert_true(!cases_all() || small_at_once > small_setups / 10);
}

/* ---- The whole pipeline --------------------------------------------------------------------- */

#define GROUND_W 96
#define GROUND_H 72

static unsigned ground_coordinates;

/* A square of ground that runs from behind the eye to far away: at each pixel the true u and v, by
 * the ray through it. Corners are off by half a sub-pixel and camera units; new corners at near by
 * half a step of the mesh's uv. */
static int ground_case(uint64_t seed)
{
    static struct lone l;
    static int16_t uv[4][2];
    struct prng p = { seed };
    const int32_t half = 16000, scale = prng_range(&p, 1, 8), near = prng_range(&p, 50, 400);
    const double eye = prng_range(&p, 200, 3000); /* above the ground */
    const int16_t pos[4][3] = {
        { -16000, 0, -16000 }, { -16000, 0, 16000 }, { 16000, 0, 16000 }, { 16000, 0, -16000 }
    };
    lone_set(&l, (const int16_t(*)[3])pos, 4, (zs_uq16_16)(scale * 65536));
    const int32_t repeat = prng_range(&p, 256, 8 * 4096);
    for (int k = 0; k < 4; k++)
        for (int axis = 0; axis < 2; axis++) {
            const int32_t far_end = pos[k][axis ? 2 : 0] > 0;
            const int32_t v = far_end ? repeat : -repeat;
            uv[k][axis] = (int16_t)(v > 32767 ? 32767 : v);
        }
    l.mesh.uv = (const int16_t(*)[2])uv;
    l.mesh.uv_bits = 12;
    for (uint32_t i = 0; i < 65536; i++)
        numbers[i] = (uint16_t)i;
    const struct zs_texture texture = texture_of(numbers, 8, 8, 0);
    l.material.shader = &zs_shade_texture;
    l.material.texture = &texture;
    const zs_turn yaw = (zs_turn)prng_next(&p);
    zs_pose_turn(&l.instance.pose, yaw, 0, 0);
    l.instance.pose.pos[1] = -(int32_t)eye;
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 12000, GROUND_H, near, 16000 * 12);
    struct zs_config config = lone_config(GROUND_W, GROUND_H, mappings[seed % MAPPINGS]);
    config.strip_h = (uint16_t)prng_range(&p, 1, GROUND_H);
    struct picture f = picture_draw(&config, &l.scene, &camera);
    int ok = f.err ? case_wrong("%s", zs_error_string(f.err)) : f.stats.tris_clipped > 0;
    const double focal = ldexp((double)camera.focal, -32);
    double r[9];
    for (int k = 0; k < 9; k++)
        r[k] = ldexp(l.instance.pose.rot[k], -30);
    const double unit = 57000.0 * scale * 1.05 / 0x1p28;
    const double px = 0x1p-9 + 3 * unit * focal / near; /* how far corners are off */
    for (int j = 0; j < GROUND_H && ok; j++)
        for (int i = 0; i < GROUND_W && ok; i++) {
            const int at = j * GROUND_W + i;
            if (f.key[at] == ZS_DEPTH_CLEAR)
                continue;
            double exact[2], slack = 0;
            for (int side = 0; side < 3;
                 side++) { /* the sample; to the right; towards the horizon */
                const double dx = (i + 0.5 - GROUND_W / 2.0 + (side == 1 ? px : 0)) / focal;
                const double dy = (GROUND_H / 2.0 - j - 0.5 + (side == 2 ? px : 0)) / focal;
                const double z = -eye / dy, x = dx * z;
                /* mesh = transpose(rot) (world), world = (x, -eye, -z) */
                const double mesh[2] = { (r[0] * x + r[6] * -z) / scale,
                                         (r[2] * x + r[8] * -z) / scale };
                for (int axis = 0; axis < 2; axis++) {
                    const double span = (uv[2][axis] - uv[0][axis]) / 4096.0 * 256;
                    const double first = uv[0][axis] / 4096.0 * 256;
                    const double texel = first + (mesh[axis] + half) / (2.0 * half) * span;
                    if (side == 0)
                        exact[axis] = texel;
                    else
                        slack += fabs(texel - exact[axis]);
                }
            }
            const double z = eye * focal / (j + 0.5 - GROUND_H / 2.0);
            const double reach = repeat / 4096.0 * 256 * 2; /* texels over the square */
            const double bound = 0.125 + 0x1p-9 + 0.5 / 16 + slack +
                                 reach * 3 * unit / (16000.0 * scale) * z / near;
            for (int axis = 0; axis < 2 && ok; axis++) {
                const uint32_t taken = axis ? f.color[at] >> 8 : f.color[at] & 255u;
                const double off = outside(exact[axis], taken, 256, 0);
                ground_coordinates++;
                if (off > bound)
                    ok = case_wrong(
                        "pixel (%d, %d), %s: texel %u, not %.4f; off %.4f, bound %.4f; yaw %u "
                        "scale %d eye %.0f near %d",
                        i, j, axis ? "v" : "u", taken, exact[axis] - 256 * floor(exact[axis] / 256),
                        off, bound, yaw, scale, eye, near);
            }
        }
    picture_free(&f);
    return ok;
}

/* Flat light: the face's, over the texel. */
static int flat_light_case(uint64_t seed)
{
    static struct lone l;
    static int16_t uv[3][2];
    static uint16_t texel[64 * 64];
    struct prng p = { seed };
    int16_t pos[3][3];
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++)
            pos[k][c] = (int16_t)prng_range(&p, -9000, 9000);
        for (int axis = 0; axis < 2; axis++)
            uv[k][axis] = (int16_t)prng_range(&p, -4096, 4096);
    }
    for (int i = 0; i < 64 * 64; i++)
        texel[i] = (uint16_t)prng_next(&p);
    const struct zs_texture texture = texture_of(texel, 6, 6, prng_pick(&p, 4));
    lone_set(&l, (const int16_t(*)[3])pos, 3, ZS_Q16_ONE);
    l.mesh.uv = (const int16_t(*)[2])uv;
    l.mesh.uv_bits = 12;
    l.mesh.face_raw = NULL;
    l.material.texture = &texture;
    l.material.shader = &zs_shade_texture;
    zs_pose_turn(&l.instance.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), 0);
    l.instance.pose.pos[2] = -24000;
    const int32_t dir[3] = { prng_range(&p, -99, 99), prng_range(&p, -99, 99),
                             prng_range(&p, 1, 99) };
    (void)zs_unit(l.scene.light.dir, dir);
    l.scene.light.ambient = prng_pick(&p, 65537);
    l.scene.light.diffuse = prng_pick(&p, 65537);
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 8192, 48, 1000, 60000);
    const struct zs_config config = lone_config(64, 48, mappings[seed % MAPPINGS]);
    struct picture plain = picture_draw(&config, &l.scene, &camera);
    l.material.shader = &zs_shade_texture_flat;
    struct picture lit = picture_draw(&config, &l.scene, &camera);
    double normal[3], length = 0, cosine = 0;
    for (int c = 0; c < 3; c++) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        normal[c] = ((double)pos[1][a] - pos[0][a]) * (pos[2][b] - pos[0][b]) -
                    ((double)pos[1][b] - pos[0][b]) * (pos[2][a] - pos[0][a]);
        length += normal[c] * normal[c];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            cosine += ldexp(l.instance.pose.rot[3 * i + j], -30) * normal[j] / sqrt(length) *
                      ldexp(l.scene.light.dir[i], -30);
    const double intensity = (l.scene.light.ambient + l.scene.light.diffuse * fmax(0, cosine)) /
                             65536;
    int ok = !plain.err && !lit.err;
    for (int i = 0; i < 64 * 48 && ok; i++)
        for (int c = 0; c < 3 && ok && plain.key[i] != ZS_DEPTH_CLEAR; c++) {
            const double exact = fmin(code_of(plain.color[i], c) * intensity, most_code[c]);
            /* face normals of 15 bits */
            if (!channel_right(lit.color[i], c, exact, 63 * 2e-4))
                ok = case_wrong("channel %d is %d, not %.4f: light %.5f", c,
                                code_of(lit.color[i], c), exact, intensity);
        }
    PICTURES_FREE(&plain, &lit);
    return ok;
}

/* One picture whatever strips, buffers, pools and skips. */
static int invariance_case(uint64_t seed)
{
    static struct shape shape[2];
    static int16_t uv[2][SHAPE_VERTS][2];
    static uint8_t bytes[128 * 64];
    static const struct zs_shader *const shaders[] = { &zs_shade_texture, &zs_shade_texture_flat,
                                                       &zs_shade_texture_smooth };
    struct prng p = { seed };
    uint16_t palette[16];
    for (int n = 0; n < 16; n++)
        palette[n] = (uint16_t)prng_next(&p);
    for (int i = 0; i < 128 * 64; i++)
        bytes[i] = (uint8_t)prng_next(&p);
    const struct zs_texture texture = { .format = &zs_texel_pal4, .texel = bytes, .palette = palette, .n_colors = 16,
                                        .log2_w = 7, .log2_h = 6, .clamp = (uint8_t)prng_pick(&p, 4) };
    if (seed % 2)
        shape_soup(&shape[0], 120, 9000, seed);
    else
        shape_torus(&shape[0], 14, 10, 8000, 3500);
    shape_ground(&shape[1], 6, 30000, 400, seed);
    struct zs_material material[2];
    struct zs_instance in[2] = { 0 };
    for (uint32_t n = 0; n < 2; n++) {
        shape_uv(&shape[n], uv[n], &p, 12000, (uint8_t)prng_range(&p, 8, 15));
        const struct zs_material m = {
            .shader = shaders[prng_pick(&p, 3)], .cull = (uint8_t)prng_pick(&p, 3), .texture = &texture
        };
        material[n] = m;
        in[n].mesh = &shape[n].mesh;
        in[n].material = &material[n];
        zs_pose_identity(&in[n].pose);
        zs_pose_turn(&in[n].pose, (zs_turn)prng_next(&p), 0, 0);
        in[n].pose.pos[1] = n ? -9000 : 0;
        in[n].pose.pos[2] = n ? -9000 : -20000;
    }
    const struct zs_scene scene = { .instance = in, .n_instances = 2,
                                    .light = { .dir = { 0, ZS_Q30_ONE, 0 }, .ambient = 20000, .diffuse = 40000 } };
    const int ortho = seed % 6 == 5;
    struct zs_camera camera;
    if (ortho)
        (void)zs_camera_orthographic(&camera, 30000, -9000, 60000);
    else
        (void)zs_camera_perspective(&camera, 10000, 60, 200, 60000);
    const struct zs_config config = picture_config(80, 60,
                                                   ortho ? &zs_depth_linear : mappings[seed % 6]);
    struct picture plain = picture_draw(&config, &scene, &camera);
    int ok = picture_shows(&plain, 100);
    for (int way = 0; way < 5 && ok; way++) {
        struct zs_config c = config;
        c.strip_h = (uint16_t)prng_range(&p, 1, 60);
        c.buffers = (uint8_t)prng_range(&p, 1, 2);
        c.fast = way ? fast_any(&p) : NULL;
        if (way > 1) {
            c.max_tris = (uint16_t)prng_range(&p, 1, 40);
            c.max_verts = (uint16_t)prng_range(&p, 3, 60);
        }
        ok = picture_again(&plain, &c, &scene, &camera, "textured");
    }
    picture_free(&plain);
    return ok;
}

/* Floors seen level: w hardly changes along a row, so that blocks are as long as they may be and a row's last
 * one, of any length, carries much of the change of u. */
static int level_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = easel_default(96, 24);
    s.depth = mappings[seed % MAPPINGS];
    s.z_far = 1 << 19;
    s.uv_bits = prng_range(&p, 8, 13);
    const struct easel_frame unit = unit_of(&s);
    const double near = s.z_near * 2.0, far = near * (2 + prng_pick(&p, 14));
    struct easel_tri t;
    memset(&t, 0, sizeof t);
    const int32_t horizon = prng_range(&p, -2560, 0), bottom = 24 * 256 + prng_range(&p, 0, 24 * 2560);
    for (int k = 0; k < 3; k++) {
        t.x[k] = prng_range(&p, -96 * 256, 192 * 256);
        t.y[k] = k ? horizon : bottom;
        t.d[k] = depth_of(&s, &unit, k ? far : near);
        for (int c = 0; c < 2; c++)
            t.rgb[k][c] = EASEL_UV(prng_range(&p, -32768, 32767));
    }
    return texels_right(&s, 8, 8, 0, &t, 0);
}

/* A plane to the horizon, a million times as far as near, so that rounding takes its w below 0 at the far end;
 * a wall before it, so that a run begins inside a block. Nothing but its pixels may be written. */
static void far_end_of_a_plane(void **state)
{
    static const int16_t pos[3][3] = { { -3711, 0, -14787 }, { 8024, 0, -32000 }, { 0, 0, 0 } };
    static const int16_t uv[3][2] = { { -27777, 8224 }, { -7647, -73 }, { 12764, 27919 } };
    static const uint16_t tri[1][3] = { { 0, 2, 1 } }, wall_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    static const int16_t wall_pos[4][3] = { { -2000, -2000, 0 }, { 0, -2000, 0 }, { 0, 2000, 0 },
                                            { -2000, 2000, 0 } };
    const struct zs_texture texture = texture_of(numbers, 8, 8, 0);
    for (int32_t column = 1; column < 1024; column += 7) { /* of the wall's right edge */
        const int32_t width = column % 2 ? 640 : 1024;
        struct zs_config config = picture_config(width, 481, &zs_depth_float);
        struct zs_mesh ground = { .pos = pos, .tri = tri, .n_verts = 3, .n_tris = 1, .scale = 960 * ZS_Q16_ONE,
                                  .center = { 0, 0, -16000 }, .radius = 18300, .uv = uv, .uv_bits = 10 };
        const struct zs_mesh wall = { .pos = wall_pos, .tri = wall_tri, .n_verts = 4, .n_tris = 2,
                                      .scale = ZS_Q16_ONE, .radius = 3000 };
        const struct zs_material textured = { .shader = &zs_shade_texture, .cull = ZS_CULL_NONE,
                                              .texture = &texture };
        const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = { 255, 0, 0 }, .cull = ZS_CULL_NONE };
        struct zs_instance in[2] = { { .mesh = &wall, .material = &raw },
                                     { .mesh = &ground, .material = &textured } };
        const struct zs_scene scene = { .instance = in, .n_instances = 2 };
        struct zs_camera camera;
        config.varyings = ZS_VARYINGS_TEXTURE;
        assert_int_equal(zs_camera_perspective(&camera, 8192, 481, 8, 1 << 25), ZS_OK);
        camera.focal = (zs_uq32_32)(2 * width) << 32;
        camera.z_far = (zs_q48_16)40000000 * 65536;
        zs_pose_identity(&in[0].pose);
        zs_pose_identity(&in[1].pose);
        in[0].pose.pos[0] = column % width - width / 2;
        in[0].pose.pos[2] = -2 * width;
        in[1].pose.pos[1] = -10;
        struct picture f = picture_draw(&config, &scene, &camera);
        assert_int_equal(f.err, ZS_OK);
        assert_true(f.covered > 1000);
        picture_free(&f);
    }
}

/* Two walls of 1024 texels that cross, of few texels a pixel: where a run begins depends on what was drawn before, on
 * accelerators and on strips; which texel a pixel has must not. The numbers are those of 12,000 such pairs in which it
 * did. */
static void runs_do_not_tell_where_they_begin(void **state)
{
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 2, 1, 3 } };
    static const uint16_t known[] = { 284, 516, 1194, 1722, 1796, 2384, 2998, 4392, 4504, 6066, 7458, 8598, 9980, 10138,
                                      10377, 11024, 11038 };
    static const int32_t eye[3] = { 0, 0, 0 }, at[3] = { 0, 0, -1000 }, up[3] = { 0, 1, 0 };
    static uint16_t texel[1024 * 1024];
    struct prng random = { 99 };
    for (size_t i = 0; i < sizeof texel / sizeof *texel; i++)
        texel[i] = (uint16_t)prng_next(&random);
    for (size_t n = 0; n < 2 * sizeof known / sizeof *known; n++) {
        const uint32_t number = known[n / 2];
        struct prng p = { (uint64_t)number * 7919 + 13 };
        int16_t pos[2][4][3], uv[2][4][2];
        struct zs_mesh mesh[2] = { { 0 }, { 0 } };
        struct zs_instance wall[2] = { { 0 }, { 0 } };
        const struct zs_texture texture = { .format = &zs_texel_565, .texel = texel, .log2_w = 10, .log2_h = 10,
                                            .clamp = n & 1 ? ZS_CLAMP_U | ZS_CLAMP_V : 0 };
        const struct zs_material paper = { .shader = &zs_shade_texture, .cull = ZS_CULL_NONE, .texture = &texture };
        for (int s = 0; s < 2; s++) {
            for (int k = 0; k < 4; k++) {
                pos[s][k][0] = (int16_t)((k & 2 ? 1 : -1) * prng_range(&p, 500, 6000));
                pos[s][k][1] = (int16_t)((k & 1 ? -1 : 1) * prng_range(&p, 500, 6000));
                pos[s][k][2] = (int16_t)-prng_range(&p, 1200, number & 1 ? 12000 : 2400);
                for (int j = 0; j < 2; j++)
                    uv[s][k][j] = (int16_t)prng_range(&p, 0, 90);
            }
            mesh[s] = (struct zs_mesh){ .pos = (const int16_t (*)[3])pos[s], .tri = tri, .n_verts = 4, .n_tris = 2,
                                        .scale = ZS_Q16_ONE, .radius = 20000, .uv = (const int16_t (*)[2])uv[s],
                                        .uv_bits = 12 };
            wall[s].mesh = &mesh[s];
            wall[s].material = &paper;
            zs_pose_identity(&wall[s].pose);
        }
        const struct zs_scene scene = { .instance = wall, .n_instances = 2,
                                        .light = { .dir = { 0, 0, ZS_Q30_ONE }, .ambient = ZS_Q16_ONE } };
        struct zs_camera camera;
        assert_int_equal(zs_camera_perspective(&camera, 12000, 96, 1000, 20000), ZS_OK);
        assert_int_equal(zs_camera_look_at(&camera, eye, at, up), ZS_OK);
        struct zs_config config = picture_config(320, 96, &zs_depth_float);
        config.varyings = 2;
        struct picture one = picture_draw(&config, &scene, &camera);
        for (int how = 0; how < 3; how++) {
            config.fast = how == 0 ? fast_of(FAST_ALL & ~FAST_TOUCH) : how == 1 ? NULL : fast_all;
            config.strip_h = how ? (uint16_t)(1 + number % 16) : config.strip_h;
            struct picture other = picture_draw(&config, &scene, &camera);
            assert_int_equal(one.err | other.err, ZS_OK);
            assert_memory_equal(one.color, other.color, 320 * 96 * sizeof *one.color);
            picture_free(&other);
        }
        picture_free(&one);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(texels_by_ratio_of_w),
    cmocka_unit_test(less_than_a_texel),
    cmocka_unit_test(stress_27_uv_at_a_w_ratio_of_16),
    cmocka_unit_test(sizes_from_1_to_1024),
    cmocka_unit_test(repeat_and_clamp_to_the_texel),
    COLORS_TEST(light_over_a_texture_against_doubles, smooth_light_case, 900, "smooth light over texels"),
    CASES_TEST(full_light_is_no_light, full_light_case, 200),
    cmocka_unit_test(moved_by_whole_pixels_the_same_texels),
    cmocka_unit_test(mirrored_the_same_texels),
    CASES_TEST(what_is_hidden_moves_no_texel, hidden_case, 200),
    CASES_TEST(three_formats_one_picture, format_case, 400),
    cmocka_unit_test(texel_gradients_are_rounded_once),
    cmocka_unit_test(small_ones_in_one_go_the_same),
    CASES_COUNT(clipped_at_near_u_and_v_stay, ground_case, 250, &ground_coordinates, 100000,
                "coordinates of ground through the eye"),
    COLORS_TEST(flat_light_over_a_texture_against_doubles, flat_light_case, 500, "flat light over texels"),
    CASES_TEST(textured_whatever_strips_and_pools, invariance_case, 120),
    CASES_TEST(level_floors, level_case, 900),
    cmocka_unit_test(runs_do_not_tell_where_they_begin),
    cmocka_unit_test(far_end_of_a_plane),
};

CASES_MAIN(tests)
