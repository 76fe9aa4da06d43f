/* Depth: float keys against exact arithmetic, separation under all five mappings, and what an
 * instance's state does to the depth test.
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
#include "two_layers.h"
#include "easel.h"

#define GUARD (8188 * 256)
#define MAPPINGS 5u

static const struct zs_depth *const mappings[MAPPINGS] = { &zs_depth_recip, &zs_depth_linear,
                                                           &zs_depth_e3m13, &zs_depth_e4m12,
                                                           &zs_depth_e5m11 };
static const char *const mapping_names[MAPPINGS] = { "recip", "linear", "e3m13", "e4m12", "e5m11" };

/* What oracle_key calls a mapping. */
static int oracle_mapping(const struct zs_depth *depth)
{
    return depth == &zs_depth_linear ? 1 : easel_float_bits(depth);
}

static int32_t clamp(int64_t v, int64_t lo, int64_t hi)
{
    return (int32_t)(v < lo ? lo : v > hi ? hi : v);
}

static double worst_small,
    worst_big; /* key errors: frames of at most 640 px width + height, others */
static uint64_t pixels_compared;

/* ---- Random triangles ----------------------------------------------------------------------- */

enum kind {
    KIND_ANY,     /* around the frame */
    KIND_TINY,    /* a few pixels */
    KIND_SMALL,   /* up to 256 px, width and height together */
    KIND_SLIVER,  /* a sub-pixel or two wide */
    KIND_HUGE,    /* up to the guard band */
    KIND_STEEP,   /* both */
    KIND_CENTERS, /* corners on samples */
    KIND_FLAT,    /* a few rows high */
    KINDS
};

static const int32_t sizes[][2] = { { 320, 240 }, { 64, 48 },  { 240, 240 }, { 37, 61 }, { 1, 1 },
                                    { 127, 3 },   { 1024, 8 }, { 8, 1024 },  { 96, 96 }, { 2, 5 } };
#define N_SIZES (sizeof sizes / sizeof sizes[0])

static int32_t random_corner(struct prng *p, enum kind kind, int32_t first, int32_t size, int k)
{
    const int32_t px = size * 256;
    switch (kind) {
    case KIND_TINY: return k ? first + prng_range(p, -900, 900) : prng_range(p, -512, px + 512);
    case KIND_SMALL: return k ? first + prng_range(p, 0, 32000) : prng_range(p, -16000, px);
    case KIND_HUGE:
    case KIND_STEEP: return size * 128 + prng_range(p, -GUARD, GUARD) / (1 << prng_pick(p, 8));
    case KIND_CENTERS: return prng_range(p, -2, size + 1) * 256 + 128;
    default: return prng_range(p, -px / 2 - 300, px + px / 2 + 300);
    }
}

static void random_tri(struct prng *p, enum kind kind, const struct easel *s, struct easel_tri *t)
{
    memset(t, 0, sizeof *t);
    for (int k = 0; k < 3; k++) {
        t->x[k] = random_corner(p, kind, t->x[0], s->width, k);
        t->y[k] = random_corner(p, kind, t->y[0], s->height, k);
    }
    if (kind == KIND_FLAT)
        for (int k = 1; k < 3; k++)
            t->y[k] = t->y[0] + prng_range(p, -500, 500);
    if (kind == KIND_SLIVER || kind == KIND_STEEP) {
        const int64_t along = prng_range(p, 0, 65536);
        t->x[2] = t->x[0] + (int32_t)((t->x[1] - t->x[0]) * along / 65536) + prng_range(p, -2, 2);
        t->y[2] = t->y[0] + (int32_t)((t->y[1] - t->y[0]) * along / 65536) + prng_range(p, -2, 2);
    }
    for (int k = 0; k < 3; k++) {
        t->x[k] = clamp(t->x[k], s->width * 128 - GUARD, s->width * 128 + GUARD);
        t->y[k] = clamp(t->y[k], s->height * 128 - GUARD, s->height * 128 + GUARD);
        for (int c = 0; c < 3; c++)
            t->rgb[k][c] = (uint16_t)prng_next(p);
    }
}

static int wrong_at(const struct easel *s, const struct easel_tri *t, int i, int j,
                    const char *what, double value)
{
    return case_wrong("%s %g at (%d, %d) of %dx%d, strips of %d, %d bits, float of %d: (%d %d %u) "
                      "(%d %d %u) (%d %d %u)",
                      what, value, i, j, s->width, s->height, s->strip_h, s->depth_bits,
                      easel_float_bits(s->depth), t->x[0], t->y[0], t->d[0], t->x[1], t->y[1],
                      t->d[1], t->x[2], t->y[2], t->d[2]);
}

/* The greatest key error of a frame: NUMERICS.md. */
static double key_bound(const struct easel *s)
{
    const int32_t extent = s->width + s->height;
    return extent <= 640 ? 0.505 : 0.5 + (extent + 1) / 131072.0;
}

/* ---- Float keys of single triangles --------------------------------------------------------- */

/* The farthest key there can be: the frame is refused where something in view is more than 2^22
 * times as far as near. */
static uint32_t farthest_key(const struct oracle_float *f)
{
    return oracle_float_d(f, 0x1p-22);
}

/* Stored keys of three corners whose near / z differ by up to 2^20. */
static void random_float_keys(struct prng *p, const struct oracle_float *f, uint32_t d[3])
{
    const int m = f->bits - f->e;
    const uint32_t top = farthest_key(f), how = prng_pick(p, 9);
    const double octaves = prng_pick(p, 2049) / 2048.0 * 20 / (1 << prng_pick(p, 4));
    const double most = prng_pick(p, 3) ? exp2(-(double)prng_pick(p, 2049) / 128) : 1;
    for (int k = 0; k < 3; k++) {
        const double r = most * exp2(-octaves * prng_pick(p, 1025) / 1024);
        const uint64_t octave_code = (uint64_t)prng_range(p, 1, 1 << f->e) << (m + 16);
        switch (how) {
        case 0: /* the ends */
            d[k] = prng_pick(p, 2) ? top : prng_pick(p, 2) ? 0 : prng_pick(p, 200000);
            break;
        case 1: /* nearly flat */
            d[k] = k ? (uint32_t)fmin(fmax((double)d[0] + prng_range(p, -90000, 90000), 0), top)
                     : prng_pick(p, top);
            break;
        case 2: /* flat */ d[k] = k ? d[0] : prng_pick(p, top + 1u); break;
        case 3:   /* on octave boundaries */
        case 4: { /* and beside them */
            int64_t code = (int64_t)octave_code + (how == 4 ? prng_range(p, -3, 3) : 0);
            const int64_t whole = (int64_t)1 << (f->bits + 16);
            code = code > whole ? whole : code;
            d[k] = whole - code > top ? top : (uint32_t)(whole - code);
            break;
        }
        case 5: { /* only in the range whose buckets stay as wide in r as they are, if there is one
                   */
            const uint32_t from = oracle_float_d(f, fmax(exp2(1 - (1 << f->e)), 0x1p-22));
            d[k] = from + prng_pick(p, top - from + 1u);
            break;
        }
        case 6: /* any key */ d[k] = prng_pick(p, top); break;
        default: d[k] = oracle_float_d(f, r); break;
        }
    }
}

/* Every pixel of the frame: its coverage, and its key within the bound. */
static int float_frame_right(const struct easel *s, const struct easel_tri *t,
                             const struct easel_frame *f)
{
    const struct oracle_float as_float = { easel_float_bits(s->depth), s->depth_bits };
    const struct oracle_tri o = easel_oracle(t);
    const double bound = key_bound(s);
    double *worst = s->width + s->height <= 640 ? &worst_small : &worst_big;
    for (int j = 0; j < s->height; j++)
        for (int i = 0; i < s->width; i++) {
            const uint32_t key = f->key[j * s->width + i];
            if (oracle_covers(&o, i, j) != (key != ZS_DEPTH_CLEAR))
                return wrong_at(s, t, i, j, "coverage, key", key);
            if (key == ZS_DEPTH_CLEAR)
                continue;
            pixels_compared++;
            const double error = fabs(oracle_float_error(&as_float, &o, t->d, i, j, key));
            if (error > bound || key > (1u << s->depth_bits) - 2u)
                return wrong_at(s, t, i, j, "key", key) +
                       case_wrong("not %.6Lf, off by %.6f buckets",
                                  oracle_float_plane(&as_float, &o, t->d, i, j), error);
            *worst = fmax(*worst, error);
        }
    return 1;
}

static int float_draws_right(const struct easel *s, const struct easel_tri *t)
{
    struct easel_frame f;
    easel_draw(s, t, 1, &f);
    const int ok = float_frame_right(s, t, &f);
    easel_free(&f);
    return ok;
}

static struct easel random_easel(struct prng *p, uint32_t mapping, const int32_t size[2])
{
    struct easel s = easel_default(size[0], size[1]);
    const int32_t strips[] = { 1, 2, 5, 8, 24, s.height };
    s.strip_h = strips[prng_pick(p, 6)];
    s.depth = mappings[mapping];
    s.depth_bits = prng_pick(p, 2) ? 16 : prng_range(p, 8, 16);
    return s;
}

static int float_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, 2 + (uint32_t)(seed % 3), sizes[seed / 3 % N_SIZES]);
    const struct oracle_float f = { easel_float_bits(s.depth), s.depth_bits };
    struct easel_tri t;
    s.smooth = prng_pick(&p, 5) == 0;
    random_tri(&p, (enum kind)prng_pick(&p, KINDS), &s, &t);
    random_float_keys(&p, &f, t.d);
    return float_draws_right(&s, &t);
}

static void float_keys_against_exact_arithmetic(void **state)
{
    pixels_compared = 0;
    worst_small = worst_big = 0;
    CASES(float_case, 3600);
    print_message("float keys: %llu pixels, off by at most %.5f buckets, %.5f in frames of 1032 px "
                  "width + height\n",
                  (unsigned long long)pixels_compared, worst_small, worst_big);
}

static int float_big_case(uint64_t seed)
{
    static const int32_t big[][2] = { { 1024, 768 }, { 4096, 2 }, { 3, 4096 }, { 640, 480 } };
    struct prng p = { seed };
    struct easel s = random_easel(&p, 2 + (uint32_t)(seed % 3), big[seed / 3 % 4]);
    const struct oracle_float f = { easel_float_bits(s.depth), s.depth_bits };
    struct easel_tri t;
    random_tri(&p, seed % 2 ? KIND_HUGE : KIND_ANY, &s, &t);
    random_float_keys(&p, &f, t.d);
    return float_draws_right(&s, &t);
}

static void float_keys_in_big_frames(void **state)
{
    worst_big = 0;
    CASES(float_big_case, 48);
    print_message("float keys in frames up to 4096 px: off by at most %.5f buckets\n", worst_big);
}

/* near / z falls from the left to the right and is a power of two exactly on samples: there the key
 * is a whole number, and beside them the slope doubles. */
static int boundary_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, 2 + (uint32_t)(seed % 3), sizes[0]);
    const struct oracle_float f = { easel_float_bits(s.depth), s.depth_bits };
    const int n = 1 << prng_range(&p, 1, 7), at = prng_range(&p, 0, n);
    const int octave = prng_range(&p, 1, 20);
    const double step = exp2(-octave - prng_range(&p, 8, 16));
    const double r[2] = { exp2(-octave) + at * step, exp2(-octave) - (n - at) * step };
    struct easel_tri t;
    memset(&t, 0, sizeof t);
    const int left = prng_range(&p, -20, 300), row = prng_range(&p, -20, 200);
    for (int k = 0; k < 3; k++) {
        t.x[k] = (left + (k == 1 ? n : 0)) * 256 + 128;
        t.y[k] = (row + (k == 2 ? 60 : 0)) * 256 + 128;
        t.d[k] = oracle_float_d(&f, r[k == 1]);
    }
    if (prng_pick(&p, 2)) /* downwards instead */
        for (int k = 0; k < 3; k++) {
            const int32_t x = t.x[k];
            t.x[k] = t.y[k];
            t.y[k] = x;
        }
    return float_draws_right(&s, &t);
}

static void octave_boundaries_on_samples(void **state)
{
    worst_small = 0;
    CASES(boundary_case, 600);
    print_message("octave boundaries on samples: off by at most %.5f buckets\n", worst_small);
}

/* Less than a pixel wide, from one octave to the next, with a step of w of 2^31 - 1 a pixel, which is rounded to half
 * as many bits although nothing asks for it (UBSan). */
static void the_steepest_step_of_a_pixel(void **state)
{
    struct easel s = easel_default(64, 48);
    struct easel_tri t = { { -100, 154, -100 }, { 100, 100, 2100 }, { 0xfeffffffu, 0xa0000000u, 0xa0000000u } };
    s.depth = &zs_depth_e3m13;
    assert_true(float_draws_right(&s, &t));
}

/* ---- The oracle itself ---------------------------------------------------------------------- */

static void the_float_oracle_agrees_with_the_definition(void **state)
{
    for (int e = 3; e <= 5; e++)
        for (int bits = 8; bits <= 16; bits++) {
            const struct oracle_float f = { e, bits };
            struct prng p = { (uint64_t)(e * 100 + bits) };
            const double most = ldexp(1, bits);
            assert_true(oracle_float_key(&f, 1) == 0);
            assert_true(oracle_float_r(&f, 0) == (uint64_t)1 << oracle_float_scale(&f));
            for (int n = 0; n < 3000; n++) {
                const uint32_t d = prng_pick(&p, ((1u << bits) - 1u) * 65536u + 1u);
                const double r = ldexp((double)oracle_float_r(&f, d), -oracle_float_scale(&f));
                assert_true(fabs(oracle_float_key(&f, r) * 65536 - d) < 1e-3);
                assert_int_equal(oracle_float_d(&f, r), d);
                /* the definition, word by word */
                double k = fmin(floor(log2(1 / r) + 1e-12), exp2(e) - 2);
                if (k < 0)
                    k = 0;
                const double m = bits - e;
                const double key = most - ((exp2(e) - 2 - k) * exp2(m) + r * exp2(k + 1 + m));
                assert_true(fabs(key * 65536 - d) < 1);
            }
        }
}

/* ---- Through the whole pipeline: clipped, unsnapped ----------------------------------------- */

#define CLIP_W 64
#define CLIP_H 48

static double worst_pipeline;

/* 23-bit positions: pos + pos_lo / 256 steps of `scale` world units. */
static int32_t place(double at, double scale, int16_t *pos, uint8_t *lo)
{
    const int32_t fine = clamp((int64_t)llround(at / scale * 256), -32767 * 256, 32767 * 256);
    *pos = (int16_t)(fine >> 8);
    *lo = (uint8_t)(fine & 255);
    return fine;
}

static int pipeline_case(uint64_t seed)
{
    static struct lone l;
    struct prng p = { seed };
    const struct zs_depth *depth = mappings[seed % MAPPINGS];
    const int mapping = oracle_mapping(depth), bits = prng_pick(&p, 2) ? 16 : prng_range(&p, 8, 16);
    const double far = 10 * exp2(prng_pick(&p, 1025) / 1024.0 * 13.3); /* of near: 10 .. 10^5 */
    const int32_t z_near = 1000, z_far = (int32_t)(z_near * far);
    /* float: a corner beyond the last key's distance is stored as if it were there */
    const int octaves = mapping > 1 ? (1 << mapping) - 1 + bits - mapping : 40;
    const double most = fmin(far * 1.2, exp2(octaves) - 2);
    const double reach = z_near * exp2(prng_pick(&p, 1025) / 1024.0 * log2(most)) + 2 * z_near;
    const uint32_t steps = (uint32_t)ceil(reach / 32000 * 65536);
    const double scale = steps / 65536.0;
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 8192, CLIP_H, z_near, z_far);
    int16_t pos[3][3];
    uint8_t lo[3][3];
    struct oracle_point corner[3];
    double nearest = z_far;
    const double focal = ldexp((double)camera.focal, -32), spread = CLIP_W / focal;
    for (int k = 0; k < 3; k++) {
        const double z = prng_pick(&p, 8)
                             ? z_near * pow(reach / z_near, prng_pick(&p, 1025) / 1024.0)
                             : z_near * prng_range(&p, -400, 999) / 1000.0;
        const double along = fabs(z) + z_near;
        const double at[3] = { along * spread * prng_range(&p, -1000, 1000) / 1000,
                               along * spread * prng_range(&p, -1000, 1000) / 1000, -z };
        double got[3];
        for (int c = 0; c < 3; c++)
            got[c] = place(at[c], scale, &pos[k][c], &lo[k][c]) / 256.0 * scale;
        corner[k] = (struct oracle_point){ got[0], got[1], -got[2] };
        nearest = fmin(nearest, fmax(-got[2], z_near));
    }
    lone_set(&l, (const int16_t(*)[3])pos, 3, steps);
    l.mesh.pos_lo = (const uint8_t(*)[3])lo;
    struct zs_config config = lone_config(CLIP_W, CLIP_H, depth);
    config.depth_bits = (uint8_t)bits;
    config.strip_h = (uint16_t)prng_range(&p, 1, CLIP_H);
    struct picture f = picture_draw(&config, &l.scene, &camera);
    const struct oracle_view v = { focal, 0, CLIP_W, CLIP_H, z_near, z_far };
    struct oracle_polygon o;
    oracle_project(&v, corner, 3, &o);
    const double unit = 57000.0 * scale * 1.05 / 0x1p28; /* lone_set's sphere is the reach */
    const double top = ldexp(1, bits) - 2;
    int ok = f.err ? case_wrong("%s", zs_error_string(f.err)) : 1;
    for (int j = 0; j < CLIP_H && ok; j++)
        for (int i = 0; i < CLIP_W && ok; i++) {
            const uint32_t key = f.key[j * CLIP_W + i];
            const double inside = oracle_inside(&o, i, j), z = oracle_z(&v, &o, i, j);
            if (key == ZS_DEPTH_CLEAR || inside < -1)
                continue; /* coverage is test_stress.c's */
            /* Corners are off by three camera units, in pixels u f / z each, and 1 / z of them by
             * u / z^2; the sample takes a mean of them whose mean of 1 / z is its own. Then half a
             * sub-pixel of snapping. Near is off by half a unit. */
            const double px = 0x1p-9 + 3 * unit * focal / fmax(z, z_near);
            const double off_z = 3 * unit * z / nearest + 0.5 * unit * z / z_near;
            const double slack = oracle_key_slack(&v, &o, i, j, mapping, bits, px) +
                                 fabs(oracle_key(&v, z + off_z, mapping, bits) -
                                      oracle_key(&v, z, mapping, bits));
            const double want = fmin(oracle_key(&v, z, mapping, bits), top);
            const double off = fabs(key - want) - slack;
            pixels_compared++;
            worst_pipeline = fmax(worst_pipeline, off);
            if (off > 0.506)
                ok = case_wrong("key at (%d, %d) is %u, not %.3f +- %.3f: %s, %d bits, far %d", i,
                                j, key, want, slack, mapping_names[seed % MAPPINGS], bits, z_far);
        }
    picture_free(&f);
    return ok;
}

static void keys_of_clipped_triangles_under_all_mappings(void **state)
{
    pixels_compared = 0;
    worst_pipeline = 0;
    CASES(pipeline_case, 3000);
    print_message("clipped, all mappings, far / near 10 to 10^5: %llu pixels, %.4f buckets beyond "
                  "what snapping explains\n",
                  (unsigned long long)pixels_compared, worst_pipeline);
}

/* ---- 19, 20: separation --------------------------------------------------------------------- */

/* How far one square must be before the other for their keys to differ by `buckets`. */
static int32_t gap_of(const struct oracle_view *v, int32_t z, double buckets, int mapping, int bits)
{
    int32_t lo = 0, hi = (int32_t)(z - v->z_near);
    const double at = oracle_key(v, z, mapping, bits);
    while (hi - lo > 1) {
        const int32_t mid = lo + (hi - lo) / 2;
        if (at - oracle_key(v, z - mid, mapping, bits) >= buckets)
            hi = mid;
        else
            lo = mid;
    }
    return hi;
}

static uint32_t pairs_swapped, pairs_drawn;

static int layers_case(uint64_t seed)
{
    static struct two_layers l;
    struct prng p = { seed };
    const uint32_t which = (uint32_t)(seed % MAPPINGS);
    const int mapping = oracle_mapping(mappings[which]), close = (int)(seed / MAPPINGS % 2);
    const int bits = prng_pick(&p, 2) ? 16 : prng_range(&p, 8, 16);
    const double ratio = pow(10, 1 + prng_pick(&p, 1025) / 256.0);
    const int32_t z = TWO_LAYERS_Z + (int32_t)prng_pick(&p, 1 << 20);
    /* anywhere from near to far */
    const int32_t near = (int32_t)fmax(64, z / pow(ratio, prng_pick(&p, 1025) / 1024.0));
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 8192, CLIP_H, 1, 2);
    camera.focal = (zs_uq32_32)CLIP_W << 32;
    camera.z_near = (zs_q48_16)near * 65536;
    camera.z_far = (zs_q48_16)((double)near * ratio * 1.001) * 65536;
    const struct oracle_view v = { CLIP_W, 0, CLIP_W, CLIP_H, near, (double)camera.z_far / 65536 };
    const double buckets = close ? 0.5 : 1.0101; /* camera units move a key by less than 0.0001 */
    const double key = oracle_key(&v, z, mapping, bits);
    if (key < buckets + 0.1 || key > ldexp(1, bits) - 2.6)
        return 1; /* before near, or saturated */
    two_layers_set(&l, z - gap_of(&v, z, buckets, mapping, bits), z);
    struct zs_config config = lone_config(CLIP_W, CLIP_H, mappings[which]);
    config.depth_bits = (uint8_t)bits;
    struct picture both = picture_draw(&config, &l.scene, &camera);
    int ok = both.err ? case_wrong("%s", zs_error_string(both.err)) : 1;
    struct picture alone[2];
    l.scene.n_instances = 1;
    for (int k = 0; k < 2; k++) {
        l.scene.instance = &l.in[k];
        alone[k] = picture_draw(&config, &l.scene, &camera);
    }
    for (int i = 0; i < CLIP_W * CLIP_H && ok; i++) {
        const int right = both.color[i] == zs_rgb565(0, 255, 0);
        if (both.key[i] == ZS_DEPTH_CLEAR)
            ok = case_wrong("a hole at (%d, %d)", i % CLIP_W, i / CLIP_W);
        else if (!right && (!close || alone[0].key[i] != alone[1].key[i]))
            ok = case_wrong(
                "%s, %d bits, near %d, far %.0f, z %d: keys %u and %u, %.2f buckets apart",
                mapping_names[which], bits, near, v.z_far, z, alone[1].key[i], alone[0].key[i],
                buckets);
        pairs_swapped += !right;
        pairs_drawn++;
    }
    for (int k = 0; k < 2; k++)
        picture_free(&alone[k]);
    picture_free(&both);
    return ok;
}

/* The exact key at a sample, unrounded, of any mapping. unit: of the easel's frames. */
static long double exact_key(const struct easel *s, const struct easel_frame *unit,
                             const struct oracle_tri *o, const uint32_t d[3], int i, int j)
{
    const struct oracle_float as_float = { easel_float_bits(s->depth), s->depth_bits };
    if (as_float.e)
        return oracle_float_plane(&as_float, o, d, i, j);
    int64_t w[3];
    long double sum = 0;
    const long double area = fabsl((long double)oracle_area(o));
    oracle_weights(o, i, j, w);
    for (int k = 0; k < 3; k++)
        sum += s->depth == &zs_depth_linear ? (long double)w[k] / d[k] : (long double)w[k] * d[k];
    if (s->depth != &zs_depth_linear)
        return sum / area / 65536;
    const long double range = ldexpl((long double)s->z_far - s->z_near, unit->shift);
    return (area / sum - unit->unit_near) / range * ((1 << s->depth_bits) - 1);
}

static struct easel_frame unit_of(const struct easel *s)
{
    struct easel_frame f;
    easel_draw(s, NULL, 0, &f);
    easel_free(&f);
    return f;
}

/* Keys, or for the linear mapping distances, of corners: any. */
static void random_depths(struct prng *p, const struct easel *s, const struct easel_frame *unit,
                          uint32_t d[3])
{
    const struct oracle_float f = { easel_float_bits(s->depth), s->depth_bits };
    const double far = ldexp(s->z_far, unit->shift), near = unit->unit_near;
    if (f.e) {
        random_float_keys(p, &f, d);
        return;
    }
    for (int k = 0; k < 3; k++)
        d[k] = s->depth == &zs_depth_linear
                   ? (uint32_t)(near * pow(far / near, prng_pick(p, 1025) / 1024.0))
                   : prng_pick(p, ((1u << s->depth_bits) - 1u) * 65536u + 1u);
}

/* d, moved by so many buckets. */
static uint32_t moved(const struct easel *s, const struct easel_frame *unit, uint32_t d,
                      double buckets)
{
    const double top = ldexp(1, s->depth_bits) - 1;
    if (s->depth == &zs_depth_linear) {
        const double step = ldexp((double)s->z_far - s->z_near, unit->shift) / top;
        return (uint32_t)fmin(fmax(d + step * buckets, unit->unit_near),
                              ldexp(s->z_far, unit->shift));
    }
    return (uint32_t)fmin(fmax(d + 65536 * buckets, 0), top * 65536);
}

static int pair_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t which = (uint32_t)(seed % MAPPINGS);
    struct easel s = random_easel(&p, which, sizes[seed / MAPPINGS % 3]);
    s.z_near = 1000;
    s.z_far = (int32_t)(1000 * pow(10, 1 + prng_pick(&p, 1025) / 256.0));
    if (s.depth == &zs_depth_linear && s.z_far > 20000000)
        s.z_far = 20000000; /* a triangle's farthest corner: 2^15 times its nearest */
    const struct easel_frame unit = unit_of(&s);
    struct easel_tri t[2];
    random_tri(&p, prng_pick(&p, 2) ? KIND_HUGE : KIND_ANY, &s, &t[0]);
    random_depths(&p, &s, &unit, t[0].d);
    t[1] = t[0];
    if (prng_pick(&p, 2))
        random_depths(&p, &s, &unit, t[1].d); /* crossing */
    else
        for (int k = 0; k < 3; k++)
            t[1].d[k] = moved(&s, &unit, t[0].d[k], prng_range(&p, 400, 1800) / 1000.0);
    if (prng_pick(&p, 2)) {
        const struct easel_tri swap = t[0];
        t[0] = t[1];
        t[1] = swap;
    }
    const struct oracle_tri o = easel_oracle(&t[0]);
    const long double top = (1 << s.depth_bits) - 2;
    struct easel_frame both, alone[2];
    easel_draw(&s, t, 2, &both);
    easel_draw(&s, &t[0], 1, &alone[0]);
    easel_draw(&s, &t[1], 1, &alone[1]);
    int ok = 1;
    for (int i = 0; i < s.width * s.height && ok; i++) {
        if (both.key[i] == ZS_DEPTH_CLEAR)
            continue;
        long double key[2];
        for (int k = 0; k < 2; k++) {
            key[k] = exact_key(&s, &unit, &o, t[k].d, i % s.width, i / s.width);
            key[k] = key[k] > top ? top : key[k];
        }
        const long double apart = key[1] - key[0]; /* > 0: the first is nearer */
        const int first = both.color[i] == 1, equal = alone[0].key[i] == alone[1].key[i];
        pairs_drawn++;
        pairs_swapped += first != (apart > 0) && apart != 0;
        if (fabsl(apart) >= 1.01L && first != (apart > 0))
            ok = wrong_at(&s, &t[0], i % s.width, i / s.width, "swapped, buckets apart",
                          (double)apart);
        else if (!equal && first != (apart > 0) && fabsl(apart) > 0.01L)
            ok = wrong_at(&s, &t[0], i % s.width, i / s.width, "swapped, and keys differ",
                          (double)apart);
    }
    easel_free(&both);
    easel_free(&alone[0]);
    easel_free(&alone[1]);
    return ok;
}

/* ---- States: one triangle after another ----------------------------------------------------- */

#define CROWD 40

static unsigned crowd_pixels; /* drawn */
#define N_STATES 12

static struct zs_depth_state random_state(struct prng *p, int32_t most, int slopes)
{
    static const int16_t ends[] = { 0, 1, -1, 2, -3, 32767, -32768 };
    struct zs_depth_state s = { .func = (uint8_t)prng_pick(p, 3), .read_only = (uint8_t)prng_pick(p, 2) };
    if (prng_pick(p, 2))
        s.bias = prng_pick(p, 3) ? ends[prng_pick(p, 7)]
                                   : (int16_t)prng_range(p, -(most < 32768 ? most : 32768),
                                                         most < 32767 ? most : 32767);
    if (slopes && prng_pick(p, 2))
        s.slope_bias = prng_pick(p, 4) ? (int16_t)prng_range(p, -1024, 1024)
                                  : (int16_t)prng_range(p, -32768, 32767);
    return s;
}

/* A d whose key is `key` without doubt, for a triangle that faces the camera. */
static uint32_t flat_depth(struct prng *p, const struct easel *s, const struct easel_frame *unit,
                           uint32_t key)
{
    const int32_t part = prng_range(p, -0x7000, 0x7000);
    if (s->depth != &zs_depth_linear)
        return key || part > 0 ? key * 65536u + (uint32_t)part : 0;
    const double range = ldexp((double)s->z_far - s->z_near, unit->shift);
    const double z = unit->unit_near +
                     range * (key + part / 65536.0) / (ldexp(1, s->depth_bits) - 1);
    return (uint32_t)fmax(z, unit->unit_near);
}

/* The depth buffer and the colours of one pixel, as the header has it. */
struct model {
    uint32_t key;
    uint16_t color;
};

static void model_draw(struct model *m, const struct zs_depth_state *s, int32_t key, int32_t offset,
                       int32_t most, uint16_t color)
{
    static const struct zs_depth_state none = { 0 };
    s = s ? s : &none;
    key = clamp((int64_t)key + offset, 0, most);
    if (s->func != ZS_DEPTH_ALWAYS && ((uint32_t)key > m->key || ((uint32_t)key == m->key && !s->func)))
        return;
    m->color = color;
    if (!s->read_only)
        m->key = (uint32_t)key;
}

static int state_crowd_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, (uint32_t)(seed % MAPPINGS), sizes[1 + seed / MAPPINGS % 4]);
    const struct easel_frame unit = unit_of(&s);
    const int32_t most = (1 << s.depth_bits) - 2;
    struct zs_depth_state state[N_STATES];
    struct easel_tri t[CROWD];
    struct oracle_tri o[CROWD];
    int32_t key[CROWD];
    const uint32_t levels = 1u + prng_pick(&p, 6);
    s.state = state;
    s.n_states = N_STATES;
    for (int k = 0; k < N_STATES; k++)
        state[k] = random_state(&p, most, 1); /* flat triangles: no slope, whatever the factor */
    for (int k = 0; k < CROWD; k++) {
        random_tri(&p, (enum kind)prng_pick(&p, KINDS), &s, &t[k]);
        key[k] = clamp((int64_t)most * prng_pick(&p, levels) / levels + prng_range(&p, -2, 2), 0,
                       most);
        t[k].d[0] = t[k].d[1] = t[k].d[2] = flat_depth(&p, &s, &unit, (uint32_t)key[k]);
        t[k].state = prng_pick(&p, N_STATES + 1);
        o[k] = easel_oracle(&t[k]);
    }
    struct easel_frame f;
    easel_draw(&s, t, CROWD, &f);
    int ok = 1;
    for (int j = 0; j < s.height && ok; j++)
        for (int i = 0; i < s.width && ok; i++) {
            struct model m = { ZS_DEPTH_CLEAR, 0 };
            for (int k = 0; k < CROWD; k++) {
                const struct zs_depth_state *own = t[k].state ? &state[t[k].state - 1] : NULL;
                if (oracle_covers(&o[k], i, j))
                    model_draw(&m, own, key[k], own ? own->bias : 0, most, (uint16_t)(k + 1));
            }
            const int at = j * s.width + i;
            crowd_pixels += m.color != 0;
            if (f.key[at] != m.key || f.color[at] != m.color)
                ok = case_wrong("%s, %d bits: (%d, %d) is colour %u key %u, not %u %u",
                                mapping_names[seed % MAPPINGS], s.depth_bits, i, j, f.color[at],
                                f.key[at], m.color, m.key);
        }
    easel_free(&f);
    return ok;
}

/* slope / 256 times the larger of the changes of the key by one pixel right and down, by the
 * corners' keys. */
static long double slope_offset(const struct easel *s, const struct easel_frame *unit,
                                const struct easel_tri *t, int32_t slope)
{
    const struct oracle_tri o = easel_oracle(t);
    long double key[3];
    for (int k = 0; k < 3; k++)
        if (s->depth == &zs_depth_linear) {
            const long double range = ldexpl((long double)s->z_far - s->z_near, unit->shift);
            key[k] = ((long double)t->d[k] - unit->unit_near) / range * ((1 << s->depth_bits) - 1);
        } else {
            key[k] = t->d[k] / 65536.0L;
        }
    const long double area = oracle_area(&o);
    long double gx = 0, gy = 0; /* a sub-pixel */
    for (int k = 0; k < 3; k++) {
        gx += key[k] * (t->y[(k + 1) % 3] - t->y[(k + 2) % 3]);
        gy += key[k] * (t->x[(k + 2) % 3] - t->x[(k + 1) % 3]);
    }
    return slope / 256.0L * fmaxl(fabsl(gx), fabsl(gy)) * 256 / fabsl(area);
}

static uint32_t slopes_seen;

static int slope_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = random_easel(&p, (uint32_t)(seed % MAPPINGS), sizes[seed / MAPPINGS % 4]);
    const struct easel_frame unit = unit_of(&s);
    const int32_t most = (1 << s.depth_bits) - 2;
    struct zs_depth_state state = random_state(&p, most, 1);
    struct easel_tri t;
    random_tri(&p, (enum kind)prng_pick(&p, KINDS), &s, &t);
    random_depths(&p, &s, &unit, t.d);
    s.state = &state;
    s.n_states = 1;
    state.read_only = 0;
    if (prng_pick(&p, 2)) /* flatter: so that it does not stop at the ends */
        for (int k = 1; k < 3; k++)
            t.d[k] = moved(&s, &unit, t.d[0], prng_range(&p, -3000, 3000) / 10.0);
    struct easel_frame plain, f;
    const struct oracle_tri o = easel_oracle(&t);
    if (oracle_area(&o) == 0)
        return 1;
    easel_draw(&s, &t, 1, &plain);
    t.state = 1;
    easel_draw(&s, &t, 1, &f);
    const long double exact = slope_offset(&s, &unit, &t, state.slope_bias);
    /* the gradient is known to an ulp of 2^-16 and the corners' keys to one each */
    const long double doubt = 1e-4L + fabsl((long double)state.slope_bias) / 256 * 4 / 65536 +
                              fabsl(exact) / 65536;
    int32_t offset = INT32_MIN;
    int ok = 1;
    for (int i = 0; i < s.width * s.height && ok; i++) {
        if ((f.key[i] == ZS_DEPTH_CLEAR) != (plain.key[i] == ZS_DEPTH_CLEAR))
            ok = wrong_at(&s, &t, i % s.width, i / s.width, "coverage, key", f.key[i]);
        if (!ok || plain.key[i] == ZS_DEPTH_CLEAR)
            continue;
        const int at_end = f.key[i] == 0 || f.key[i] == most || plain.key[i] == most;
        const int32_t change = f.key[i] - plain.key[i];
        const long double wanted = exact + state.bias; /* rounded: within half a bucket of it */
        if (!at_end && offset == INT32_MIN)
            offset = change;
        if (!at_end && change != offset)
            ok = wrong_at(&s, &t, i % s.width, i / s.width, "another offset than before", change);
        else if (!at_end && fabsl(change - wanted) > 0.5L + doubt)
            ok = wrong_at(&s, &t, i % s.width, i / s.width, "offset", change) +
                 case_wrong("not %.4Lf: state offset %d slope %d", wanted, state.bias,
                            state.slope_bias);
        else if (at_end && f.key[i] != plain.key[i] &&
                 (f.key[i] == 0      ? plain.key[i] + wanted > 0.5L + doubt
                  : f.key[i] == most ? plain.key[i] + wanted < most - 0.5L - doubt
                                     : fabsl(change - wanted) > 1.5L + doubt))
            ok = wrong_at(&s, &t, i % s.width, i / s.width, "stopped at an end, offset", change) +
                 case_wrong("not %.4Lf: key %u became %u", wanted, plain.key[i], f.key[i]);
        slopes_seen += !at_end && state.slope_bias;
    }
    easel_free(&plain);
    easel_free(&f);
    return ok;
}

/* ---- States through the whole pipeline ------------------------------------------------------ */

#define SCENE_N 12

struct state_scene {
    struct shape shape[SCENE_N];
    struct zs_material material[SCENE_N];
    struct zs_instance in[SCENE_N];
    struct zs_depth_state state[SCENE_N];
    struct zs_scene scene;
};

/* Instances of one triangle each, raw colours 1, 2, ..., around the same place. */
static void state_scene_set(struct state_scene *s, struct prng *p, int32_t most)
{
    memset(s, 0, sizeof *s);
    for (uint32_t n = 0; n < SCENE_N; n++) {
        shape_begin(&s->shape[n]);
        for (int v = 0; v < 3; v++) {
            const int32_t at[3] = { prng_range(p, -9000, 9000), prng_range(p, -9000, 9000),
                                    prng_range(p, -4000, 4000) };
            (void)shape_vertex(&s->shape[n], at, at);
        }
        shape_tri(&s->shape[n], 0, 1, 2);
        shape_end(&s->shape[n]);
        s->shape[n].face_raw[0] = (uint16_t)(n + 1);
        s->material[n].shader = &zs_shade_raw;
        s->material[n].cull = ZS_CULL_NONE;
        s->state[n] = random_state(p, most, 1);
        if (prng_pick(p, 2)) { /* of the size of what is there */
            s->state[n].bias = (int16_t)prng_range(p, -20, 20);
            s->state[n].slope_bias = (int16_t)prng_range(p, -600, 600);
        }
        s->in[n].mesh = &s->shape[n].mesh;
        s->in[n].material = &s->material[n];
        s->in[n].depth_state = prng_pick(p, 4) ? &s->state[n] : NULL;
        zs_pose_identity(&s->in[n].pose);
        s->in[n].pose.pos[2] = -16000;
    }
    s->scene.instance = s->in;
    s->scene.n_instances = SCENE_N;
}

/* A scene is what its instances are one after another, each with the keys that it has alone. */
static int state_scene_case(uint64_t seed)
{
    static struct state_scene s;
    struct prng p = { seed };
    const int ortho = seed % 6 == 5;
    const struct zs_depth *depth = ortho ? &zs_depth_linear : mappings[seed % 6];
    struct zs_config config = picture_config(80, 60, depth);
    config.depth_bits = (uint8_t)(prng_pick(&p, 2) ? 16 : prng_range(&p, 8, 16));
    state_scene_set(&s, &p, (1 << config.depth_bits) - 2);
    struct zs_camera camera;
    if (ortho)
        (void)zs_camera_orthographic(&camera, 14000, 10, 40000);
    else
        (void)zs_camera_perspective(&camera, 8192, 60, prng_pick(&p, 2) ? 100 : 13000, 40000);
    struct model m[80 * 60];
    for (int i = 0; i < 80 * 60; i++)
        m[i] = (struct model){ ZS_DEPTH_CLEAR, 0 };
    int ok = 1;
    struct zs_scene one = s.scene;
    one.n_instances = 1;
    for (uint32_t n = 0; n < SCENE_N && ok; n++) {
        struct zs_instance in = s.in[n];
        struct zs_depth_state writes = s.state[n];
        writes.read_only = 0; /* to see the keys it compares with */
        in.depth_state = in.depth_state ? &writes : NULL;
        one.instance = &in;
        struct picture f = picture_draw(&config, &one, &camera);
        ok = f.err ? case_wrong("%s", zs_error_string(f.err)) : 1;
        for (int i = 0; i < 80 * 60 && ok; i++)
            if (f.key[i] != ZS_DEPTH_CLEAR)
                model_draw(&m[i], s.in[n].depth_state, f.key[i], 0, 65535, (uint16_t)(n + 1));
        picture_free(&f);
    }
    for (int way = 0; way < 5 && ok; way++) {
        struct zs_config c = config;
        if (way) {
            c.strip_h = (uint16_t)prng_range(&p, 1, 60);
            c.buffers = (uint8_t)prng_range(&p, 1, 2);
            c.fast = way == 1 ? NULL : fast_any(&p);
        }
        if (way > 2) {
            c.max_tris = (uint16_t)prng_range(&p, 1, 8);
            c.max_verts = (uint16_t)prng_range(&p, 3, 12);
        }
        struct picture f = picture_draw(&c, &s.scene, &camera);
        ok = f.err ? case_wrong("%s", zs_error_string(f.err)) : 1;
        for (int i = 0; i < 80 * 60 && ok; i++)
            if (f.color[i] != m[i].color || f.key[i] != m[i].key)
                ok = case_wrong(
                    "%s, strips of %u, %u triangles, %u vertices: (%d, %d) is colour %u key "
                    "%u, not %u %u",
                    ortho ? "orthographic" : mapping_names[seed % 6], c.strip_h, c.max_tris,
                    c.max_verts, i % 80, i / 80, f.color[i], f.key[i], m[i].color, m[i].key);
        picture_free(&f);
    }
    return ok;
}

/* ---- The mapping that far / near asks for --------------------------------------------------- */

/* zs_depth_float draws the frame of e3m13 up to far = 2^7 near, of e4m12 up to 2^15 near, else of
 * e5m11: to the last bit of far. */
static int any_float_case(uint64_t seed)
{
    static struct shape s;
    struct prng p = { seed };
    const zs_q48_16 near = (zs_q48_16)prng_range(&p, 100 * 65536, 3000 * 65536);
    const int octaves = prng_pick(&p, 2) ? 7 : 15, beside = prng_range(&p, -1, 1);
    const int anywhere = prng_pick(&p, 3) == 0;
    const double ratio = exp2(prng_range(&p, 1000, 18000) / 1000.0);
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 8192, 60, 1, 2);
    camera.z_near = near;
    camera.z_far = anywhere ? (zs_q48_16)((double)near * ratio) : (near << octaves) + beside;
    const double found = (double)camera.z_far / (double)camera.z_near;
    const int e = found <= 128 ? 3 : found <= 32768 ? 4 : 5;
    shape_torus(&s, 12, 9, 8000, 3000);
    const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_BACK };
    struct zs_instance in = { .mesh = &s.mesh, .material = &material };
    zs_pose_identity(&in.pose);
    zs_pose_turn(&in.pose, (zs_turn)prng_next(&p), 3000, 0);
    in.pose.pos[2] = -(int32_t)(near >> 16) - 9000;
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_config config = picture_config(80, 60, &zs_depth_float);
    config.depth_bits = (uint8_t)prng_range(&p, 8, 16);
    struct picture f = picture_draw(&config, &scene, &camera);
    config.depth = mappings[e - 1];
    struct picture named = picture_draw(&config, &scene, &camera);
    /* the whole of it is in view unless far cuts it */
    const int ok = picture_same(&f, &named, mapping_names[e - 1]) &&
                   (f.covered > 20 || found < 128);
    if (!ok)
        (void)case_wrong("near %lld far %lld", (long long)camera.z_near, (long long)camera.z_far);
    PICTURES_FREE(&f, &named);
    return ok;
}

/* What keys alone say of 1/z, by which colours and texels are taken to be affine: never less than it changes. */
static void keys_bound_how_much_w_changes(void **state)
{
    static const struct zs_depth *const depths[] = { &zs_depth_e3m13, &zs_depth_e4m12, &zs_depth_e5m11 };
    static const struct zs_scene scene = { .light = { .dir = { 0, 0, ZS_Q30_ONE } } };
    static uint32_t arena[20000];
    for (int n = 0; n < 3 * 9; n++) {
        struct prng p = { (uint64_t)n + 1 };
        struct zs_renderer r;
        struct zs_camera camera;
        const struct oracle_float f = { 3 + n / 9, 8 + n % 9 };
        const struct zs_config config = { .width = 16, .height = 16, .strip_h = 16, .max_tris = 4, .max_verts = 4,
                                          .buffers = 1, .subpixel_bits = 8, .depth_bits = (uint8_t)f.bits,
                                          .depth = depths[n / 9] };
        assert_int_equal(zs_init(&r, &config, arena, sizeof arena), ZS_OK);
        assert_int_equal(zs_camera_perspective(&camera, 8192, 16, 256, 1 << 14), ZS_OK);
        assert_int_equal(zs_frame_begin(&r, &scene, &camera), ZS_OK);
        double most = 0;
        for (int i = 0; i < 20000; i++) {
            const uint32_t far_d = (uint32_t)(prng_next(&p) % ((uint64_t)r.view.key_known + 1u));
            const uint32_t most_change = far_d < r.view.key_slow ? far_d : r.view.key_slow;
            const uint32_t change = (uint32_t)(prng_next(&p) % ((uint64_t)most_change + 1u)) >> prng_pick(&p, 20);
            const uint64_t w = oracle_float_r(&f, far_d), nearer = oracle_float_r(&f, far_d - change);
            assert_true(nearer >= w);
            assert_true((__int128)(nearer - w) * r.view.key_slow <= (__int128)w * change);
            if (change > 1u << 12)
                most = fmax(most, (double)(nearer - w) / (double)w * r.view.key_slow / change);
        }
        assert_true(most > 0.9); /* nor much more */
        (void)zs_frame_end(&r);
    }
}

static void float_takes_the_bits_that_far_asks_for(void **state)
{
    CASES(any_float_case, 300);
    struct zs_scene none = { .n_instances = 0 };
    struct zs_camera ortho;
    (void)zs_camera_orthographic(&ortho, 100, 1, 1000);
    for (uint32_t k = 0; k < MAPPINGS; k++) {
        const struct zs_config config = picture_config(8, 8, mappings[k]);
        assert_int_equal(picture_error(&config, &none, &ortho),
                         mappings[k] == &zs_depth_linear ? ZS_OK : ZS_ERR_DEPTH);
    }
    const struct zs_config config = picture_config(8, 8, &zs_depth_float);
    assert_int_equal(picture_error(&config, &none, &ortho), ZS_ERR_DEPTH);
}

/* ---- All shaders under all mappings: a state that asks for nothing is none; nothing else shows  */

static int plain_state_case(uint64_t seed)
{
    static struct shape shape[3];
    static int16_t uv[3][SHAPE_VERTS][2];
    static uint16_t texel[64][64];
    static const struct zs_shader *const shaders[] = {
        &zs_shade_raw,     &zs_shade_flat,         &zs_shade_smooth,
        &zs_shade_texture, &zs_shade_texture_flat, &zs_shade_texture_smooth
    };
    static const struct zs_texture texture = { .format = &zs_texel_565, .texel = texel, .log2_w = 6, .log2_h = 6 };
    static const struct zs_depth_state nothing = { .func = ZS_DEPTH_LESS };
    struct prng p = { seed };
    const uint32_t which = (uint32_t)(seed % MAPPINGS);
    for (int i = 0; i < 64 * 64; i++)
        texel[i / 64][i % 64] = (uint16_t)prng_next(&p);
    shape_soup(&shape[0], 200, 9000, seed);
    shape_torus(&shape[1], 12, 9, 8000, 3000);
    shape_ground(&shape[2], 8, 30000, 500, seed);
    struct zs_material material[3];
    struct zs_instance in[3] = { 0 };
    for (uint32_t n = 0; n < 3; n++) {
        shape_uv(&shape[n], uv[n], &p, 8192, 12);
        const struct zs_material m = {
            .shader = shaders[prng_pick(&p, 6)], .rgb = { 200, 100, 50 }, .cull = (uint8_t)prng_pick(&p, 3),
            .texture = &texture
        };
        material[n] = m;
        in[n].mesh = &shape[n].mesh;
        in[n].material = &material[n];
        zs_pose_identity(&in[n].pose);
        zs_pose_turn(&in[n].pose, (zs_turn)prng_next(&p), (zs_turn)prng_pick(&p, 4000), 0);
        in[n].pose.pos[1] = n == 2 ? -9000 : 0;
        in[n].pose.pos[2] = n == 2 ? -10000 : -20000;
    }
    struct zs_scene scene = { .instance = in, .n_instances = 3,
                              .light = { .dir = { 0, ZS_Q30_ONE, 0 }, .ambient = 20000, .diffuse = 40000 },
                              .background = 0x1234 };
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 10000, 60, 200, 60000);
    struct zs_config config = picture_config(80, 60, mappings[which]);
    struct picture plain = picture_draw(&config, &scene, &camera);
    int ok = picture_shows(&plain, 100);
    for (int way = 0; way < 6 && ok; way++) {
        struct zs_config c = config;
        for (uint32_t n = 0; n < 3; n++)
            in[n].depth_state = prng_pick(&p, 3) ? &nothing : NULL;
        if (way) {
            c.strip_h = (uint16_t)prng_range(&p, 1, 60);
            c.fast = way == 1 ? NULL : fast_any(&p);
        }
        if (way > 2) {
            c.max_tris = (uint16_t)prng_range(&p, 1, 60);
            c.max_verts = (uint16_t)prng_range(&p, 3, 60);
        }
        ok = picture_again(&plain, &c, &scene, &camera, mapping_names[which]);
    }
    picture_free(&plain);
    return ok;
}

/* From near to 256 times near within 255/256 of a pixel: the gradient of 1/z uses all of its 64 bits. */
static void octaves_within_a_pixel(void **state)
{
    static const int16_t pos[3][3] = { { 0, 0, -64 }, { 0, 0, -16384 }, { 0, -3, -64 } };
    static const uint8_t lo[3][3] = { { 255, 0, 0 }, { 0, 0, 1 }, { 255, 0, 0 } };
    static const uint16_t tri[1][3] = { { 0, 1, 2 } };
    static const struct zs_mesh mesh = { .pos = pos, .pos_lo = lo, .tri = tri, .n_verts = 3, .n_tris = 1,
                                         .scale = 1024 * ZS_Q16_ONE, .center = { 0, 0, -8192 },
                                         .radius = 9000 };
    static const struct zs_material white = { .shader = &zs_shade_raw, .rgb = { 255, 255, 255 },
                                              .cull = ZS_CULL_NONE };
    static const struct zs_depth *const mapping[] = { &zs_depth_float, &zs_depth_e3m13, &zs_depth_e4m12,
                                                      &zs_depth_e5m11 };
    for (int m = 0; m < 4; m++) {
        const struct zs_config config = picture_config(64, 64, mapping[m]);
        struct zs_instance in = { .mesh = &mesh, .material = &white };
        const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
        struct zs_camera camera;
        zs_pose_identity(&in.pose);
        assert_int_equal(zs_camera_perspective(&camera, 8192, 64, 65536, 1 << 20), ZS_OK);
        camera.focal = (zs_uq32_32)64 << 32;
        camera.z_far = (zs_q48_16)65536 * 65536 * 60000;
        struct picture f = picture_draw(&config, &scene, &camera);
        assert_int_equal(f.err, ZS_OK);
        assert_true(f.covered >= 1);
        picture_free(&f);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_float_oracle_agrees_with_the_definition),
    cmocka_unit_test(float_keys_against_exact_arithmetic),
    cmocka_unit_test(float_keys_in_big_frames),
    cmocka_unit_test(octave_boundaries_on_samples),
    cmocka_unit_test(the_steepest_step_of_a_pixel),
    cmocka_unit_test(keys_of_clipped_triangles_under_all_mappings),
    CASES_COUNTS(stress_19_layers_at_1_01_buckets_under_all_mappings, layers_case, 4000,
                 { "pixels of two layers", &pairs_drawn, 10000000 },
                 { "the wrong way round at 0.5 buckets", &pairs_swapped, 1000000 }),
    CASES_COUNTS(stress_19_20_pairs_of_any_planes_under_all_mappings, pair_case, 500,
                 { "pixels of two planes", &pairs_drawn, 4000000 },
                 { "the wrong way round within 1.01 buckets", &pairs_swapped, 100000 }),
    CASES_COUNT(states_one_triangle_after_another, state_crowd_case, 120, &crowd_pixels, 100000, "pixels drawn"),
    CASES_COUNT(offsets_and_slopes_in_buckets, slope_case, 1500, &slopes_seen, 10000, "pixels of slopes"),
    CASES_TEST(states_in_scenes_whatever_the_pools, state_scene_case, 240),
    cmocka_unit_test(keys_bound_how_much_w_changes), cmocka_unit_test(float_takes_the_bits_that_far_asks_for),
    CASES_TEST(a_state_that_asks_for_nothing_is_none, plain_state_case, 100),
    cmocka_unit_test(octaves_within_a_pixel)
};

CASES_MAIN(tests)
