/* Facts of what draws into a strip: solid.c, first_touch.c, float.c, against tests/lib/oracle.c, which shares no code
 * with the renderer. Keys and colours of a strip are allocations of their own, of the very size: AddressSanitizer sees
 * a step beside either; a write beside a span within it is seen by what is compared, every pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../lib/internals.h"
#include "core/method.h"
#include "core/rows.h"
#include "zs_fast.h"

#include "../../lib/oracle.h"
#include "../../../sim/reference/prng.h"
#include "facts.h"

#define BOUND 0.505 /* buckets a key is off by at most: NUMERICS.md */
#define TRIS 3
#define BACKGROUND 0x1234

static struct prng prng = { 11 };

static int32_t in(int32_t lo, int32_t hi)
{
    return prng_range(&prng, lo, hi);
}

/* ---- A strip ------------------------------------------------------------------------------------------- */

static struct zs_renderer r;
static struct zs_tri tri[TRIS];
static struct zs_vertex vert[3 * TRIS];
static struct zs_fast raw;                        /* rows and spans of one colour, no small triangles */
static const struct zs_fast *const fast[2] = { &raw };
static struct zs_material material;
static struct zs_instance instance;
static struct zs_scene scene;
static uint16_t bin[8];
static int16_t drawn_columns[16][2];
static uint16_t *old; /* keys before it was drawn */
static int32_t width, rows, y0;

static void new_strip(int32_t w, int32_t h, int32_t strip, int32_t cut)
{
    memset(&r, 0, sizeof r);
    width = w;
    rows = h - cut;
    y0 = strip * h;
    r.config.width = (uint16_t)w;
    r.window[1] = (uint16_t)w;
    r.config.strip_h = (uint16_t)h;
    r.config.height = (uint16_t)(y0 + rows);
    r.view.width = r.config.width;
    r.view.height = r.config.height;
    r.strip = (uint16_t)strip;
    r.band_end = (uint16_t)(strip + 1);
    r.active = ZS_NIL;
    r.tri = tri;
    r.vert = vert;
    r.bin = bin;
    r.drawn = drawn_columns;
    r.scene = &scene;
    scene.instance = &instance;
    scene.background = BACKGROUND;
    instance.material = &material;
    material.shader = &zs_shade_raw;
    raw = zs_fast_raw;
    raw.draw = 0;
    r.config.method = &zs_method_buffer;
    r.span = zs_rows_test;
    r.config.fast = in(0, 1) ? fast : 0;
    r.edges = in(0, 1) ? zs_fast_edges.edges : 0;
    const size_t n = (size_t)(w * rows);
    r.color[0] = r.color[1] = malloc(n * 2);
    r.depth = malloc(n * 2);
    old = malloc(n * 2);
    const int32_t how = in(0, 3);
    for (size_t k = 0; k < n; k++) {
        old[k] = r.depth[k] = how ? ZS_DEPTH_CLEAR : (uint16_t)prng_next(&prng);
        r.color[0][k] = 0;
    }
}

static void end_strip(void)
{
    free(r.color[0]);
    free(r.depth);
    free(old);
}

static void any_strip(void)
{
    const int32_t h = in(1, 12);
    new_strip(in(0, 9) ? in(1, 24) : in(25, 150), h, in(0, 7), in(0, 3) ? 0 : in(0, h - 1));
}

/* Corners as bins have them. Return 0: it has no area. */
static int corners(int k, struct oracle_tri *t, const int32_t x[3], const int32_t y[3], const uint32_t d[3],
                   uint32_t of[3])
{
    const int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    int top = 0;
    for (int v = 1; v < 3; v++)
        if (y[v] < y[top] || (y[v] == y[top] && x[v] < x[top]))
            top = v;
    for (int v = 0; v < 3; v++) {
        const int from = (top + (area > 0 ? v : 3 - v)) % 3;
        const struct zs_vertex one = { x[from], y[from], d[from] };
        vert[3 * k + v] = one;
        t->x[v] = x[from];
        t->y[v] = y[from];
        of[v] = d[from];
        tri[k].v[v] = (uint16_t)(3 * k + v);
    }
    tri[k].next = ZS_NIL;
    tri[k].instance = 0;
    tri[k].paint = (uint16_t)(k + 1);
    return area != 0;
}

static void any_corners(int32_t x[3], int32_t y[3], int32_t reach)
{
    const int32_t grid = in(0, 2) ? 1 : in(0, 1) ? 128 : 256, beside = in(-1, 1);
    const int32_t around = in(0, 3) ? 2 : 66;
    x[0] = in(-around * 256, (width + around) * 256);
    y[0] = in((y0 - around) * 256, (y0 + rows) * 256);
    for (int v = 1; v < 3; v++) {
        x[v] = x[0] + in(-reach, reach);
        y[v] = y[0] + in(-reach, reach);
    }
    for (int v = 0; v < 3 && grid > 1; v++) {
        x[v] = x[v] / grid * grid + (in(0, 1) ? beside : 0);
        y[v] = y[v] / grid * grid;
    }
}

/* ---- solid.c --------------------------------------------------------------------------------------------- */

/* Three depths of one piece; a key of it or near it, or any. */
static void any_piece(uint32_t d[3])
{
    const uint32_t bits = (uint32_t)in(8, 16), base = (((1u << bits) - 1u) << 16) + 0xffffu;
    const uint32_t shift = in(0, 1) ? 31u : bits - (uint32_t)in(3, 5) + 16u, how = (uint32_t)in(0, 2);
    r.view.key_top = base - 0xffffu;
    r.view.piece_base = base;
    r.view.piece_shift = (uint8_t)shift;
    const uint32_t piece = (uint32_t)(prng_next(&prng) % ((base >> shift) + 1u)) << shift;
    const uint32_t most = (uint32_t)zs_min32((int32_t)((base - piece) >> 1), (int32_t)(((1u << shift) - 1u) >> 1)) * 2u;
    for (int k = 0; k < 3; k++) {
        uint32_t code = (uint32_t)(prng_next(&prng) % ((uint64_t)most + 1u));
        if (how == 1 && k)
            code = (uint32_t)zs_min32(zs_max32((int32_t)((base - d[0] - piece) >> 1) + in(-40000, 40000), 0),
                                      (int32_t)(most >> 1)) * 2u;
        d[k] = base - piece - (how == 2 ? code >> in(0, 31) : code);
    }
}

/* Every pixel of the strip. */
static int small_right(const struct oracle_tri *t, const uint32_t d[3], int done)
{
    int good = 1;
    for (int32_t y = 0; y < rows; y++)
        for (int32_t x = 0; x < width; x++) {
            const int32_t at = y * width + x;
            const uint16_t key = r.depth[at], was = old[at];
            good &= r.color[0][at] == (key != was);
            if (!done || !oracle_covers(t, x, y0 + y)) {
                good &= key == was;
                continue;
            }
            const double error = oracle_key_error(t, d, x, y0 + y, key, r.view.key_top >> 16);
            good &= key <= was && (key < was ? fabs(error) <= BOUND : error <= BOUND);
        }
    return good;
}

static int small_drawn(const int32_t x[3], const int32_t y[3], const uint32_t d[3], uint64_t *n, int *good)
{
    struct oracle_tri t;
    struct zs_job job;
    uint32_t of[3];
    if (!corners(0, &t, x, y, d, of))
        return 0;
    memset(&job, 0, sizeof job);
    job.r = &r;
    job.tri = &tri[0];
    job.color = r.color[0];
    job.depth = r.depth;
    job.y0 = y0;
    job.y1 = y0 + rows;
    job.width = job.pitch = width;
    const int done = zs_fast_raw.draw(&job);
    *good &= small_right(&t, of, done);
    if (done)
        *good &= job.tri_end == (zs_max32(y[0], zs_max32(y[1], y[2])) + 127) >> 8;
    *n += (uint64_t)done;
    return done;
}

static void small_any(uint64_t count)
{
    int good = 1;
    uint64_t n = 0;
    for (uint64_t i = 0; i < count; i++) {
        int32_t x[3], y[3];
        uint32_t d[3];
        any_strip();
        any_corners(x, y, in(0, 9) ? 1 << in(6, 14) : in(1, 1 << 14));
        for (int v = 0; v < 3 && i % 8; v++) /* up to the ends of rows and a little beyond, which is left to others */
            x[v] = zs_min32(zs_max32(x[v], in(-160, 128)), width * 256 + in(-128, 160));
        any_piece(d);
        (void)small_drawn(x, y, d, &n, &good);
        end_strip();
    }
    tell("small", n, good && n > count / 3,
         "small triangles drawn: each pixel of the strip as exact arithmetic has it, others untouched");
}

/* Corners on samples and on the borders of pixels, and a sub-pixel beside: every triangle of them. */
static void small_grid(void)
{
    int good = 1;
    uint64_t n = 0;
    for (int32_t beside = -1; beside <= 1; beside++)
        for (int32_t a = 0; a < 49; a++)
            for (int32_t b = a + 1; b < 49; b++)
                for (int32_t c = a + 1; c < 49; c++) {
                    const int32_t x[3] = { a % 7 * 128, b % 7 * 128 + beside, c % 7 * 128 };
                    const int32_t y[3] = { a / 7 * 128, b / 7 * 128, c / 7 * 128 + beside };
                    uint32_t d[3];
                    if (b == c)
                        continue;
                    new_strip(3, 3, 0, 0);
                    any_piece(d);
                    (void)small_drawn(x, y, d, &n, &good);
                    end_strip();
                }
    tell("small_grid", n, good,
         "small triangles, all with corners on half pixels of 3 x 3, and two of them a sub-pixel beside: the same");
}

/* ---- Strips by raster.c: float.c, first_touch.c -------------------------------------------------------------- */

struct scene_of {
    struct oracle_tri t[TRIS];
    uint32_t d[TRIS][3];
    int n;
    struct oracle_float as; /* e: 0: keys are linear on the screen */
};

static double error_of(const struct scene_of *s, int k, int32_t x, int32_t y, uint32_t key)
{
    if (s->as.e)
        return oracle_float_error(&s->as, &s->t[k], s->d[k], x, y, key);
    return oracle_key_error(&s->t[k], s->d[k], x, y, key, (r.view.key_top >> 16) - 1u);
}

/* Every pixel: the colour of one that covers it, its key, and none that is nearer; or what was there, or cleared. */
static int strip_right(const struct scene_of *s, int untouched)
{
    int good = 1;
    for (int32_t y = 0; y < rows; y++)
        for (int32_t x = 0; x < width; x++) {
            const int32_t at = y * width + x, of = (int32_t)r.color[0][at] - 1;
            const uint16_t key = r.depth[at], was = untouched ? ZS_DEPTH_CLEAR : old[at];
            if (of < 0 || of >= s->n)
                good &= key == was && r.color[0][at] == (untouched ? zs_wire16(BACKGROUND) : 0);
            else
                good &= key < was && oracle_covers(&s->t[of], x, y0 + y) &&
                        fabs(error_of(s, of, x, y0 + y, key)) <= BOUND;
            for (int k = 0; k < s->n; k++)
                if (oracle_covers(&s->t[k], x, y0 + y))
                    good &= error_of(s, k, x, y0 + y, key) <= BOUND;
        }
    return good;
}

/* Float keys up to 2^20 apart, on borders of octaves too. */
static void any_float_keys(const struct oracle_float *f, uint32_t d[3])
{
    const uint32_t top = oracle_float_d(f, 0x1p-20), how = (uint32_t)in(0, 4);
    const double most = exp2(-in(0, 2048) / 128.0), reach = in(0, 2048) / 2048.0 * 20 / (1 << in(0, 4));
    for (int k = 0; k < 3; k++) {
        const int64_t whole = (int64_t)1 << (f->bits + 16);
        int64_t code = (int64_t)in(1, 1 << f->e) << (f->bits - f->e + 16);
        if (how == 1)
            code += in(-3, 3);
        d[k] = how < 2 ? (uint32_t)(code >= whole ? 0 : whole - code)
                       : how == 2 ? (uint32_t)(prng_next(&prng) % ((uint64_t)top + 1u))
                                  : oracle_float_d(f, most * exp2(-reach * in(0, 1024) / 1024));
        d[k] = d[k] > top ? top : d[k];
    }
}

static void any_mapping(struct scene_of *s)
{
    static const struct zs_depth *const mapping[3] = { &zs_depth_e3m13, &zs_depth_e4m12, &zs_depth_e5m11 };
    const struct zs_camera camera = { .z_near = 1 << 16, .z_far = (int64_t)1 << 36 };
    s->as.e = in(3, 5);
    s->as.bits = in(0, 1) ? 16 : in(8, 16);
    r.view.perspective = 1;
    r.view.depth = r.config.depth = mapping[s->as.e - 3];
    (void)r.config.depth->setup(&r.view, &camera, (uint32_t)s->as.bits);
}

static void any_scene(struct scene_of *s, int32_t least_log2, int32_t most_log2)
{
    s->n = in(1, TRIS);
    for (int k = 0; k < s->n; k++) {
        int32_t x[3], y[3];
        uint32_t d[3];
        any_corners(x, y, 1 << in(least_log2, most_log2));
        any_float_keys(&s->as, d);
        if (!corners(k, &s->t[k], x, y, d, s->d[k]) || vert[3 * k].y > (y0 + rows) * 256) {
            s->n = k;
            break;
        }
        tri[k].next = (uint16_t)(k - 1); /* ZS_NIL: none */
    }
    bin[r.strip] = (uint16_t)(s->n - 1); /* ZS_NIL: none */
}

/* 1: the strip has a pixel of it, and keys of its corners lie in several octaves; 2: in two next to each other, and it
 * is tiny. */
static int crosses(const struct scene_of *s, int k)
{
    const int m = s->as.bits - s->as.e + 16;
    int64_t lo[3] = { INT64_MAX, INT64_MAX, INT64_MAX }, hi[3] = { INT64_MIN, INT64_MIN, INT64_MIN };
    int covers = 0;
    for (int32_t at = 0; at < rows * width; at++)
        covers |= oracle_covers(&s->t[k], at % width, y0 + at / width);
    for (int v = 0; v < 3; v++) {
        const int64_t octave = ((((int64_t)1 << (s->as.bits + 16)) - 1 - s->d[k][v]) >> m);
        const int64_t of[3] = { octave < 1 ? 1 : octave, s->t[k].x[v], s->t[k].y[v] };
        for (int c = 0; c < 3; c++) {
            lo[c] = of[c] < lo[c] ? of[c] : lo[c];
            hi[c] = of[c] > hi[c] ? of[c] : hi[c];
        }
    }
    if (!covers || lo[0] == hi[0])
        return 0;
    return hi[0] == lo[0] + 1 && hi[1] - lo[1] < 1 << 14 && hi[2] - lo[2] < 1 << 14 ? 2 : 1;
}

static void float_any(uint64_t count)
{
    int good = 1;
    uint64_t n[3] = { 0, 0, 0 };
    for (uint64_t i = 0; i < count; i++) {
        struct scene_of s;
        any_strip();
        any_mapping(&s);
        any_scene(&s, 7, in(0, 3) ? 13 : 20);
        zs_raster_strip(&r);
        good &= strip_right(&s, 0);
        for (int k = 0; k < s.n; k++)
            n[crosses(&s, k)]++;
        end_strip();
    }
    tell("float_pairs", n[2], good && n[2] > count / 40, "tiny triangles drawn from one octave to the next: the same");
    tell("float", n[1], good && n[1] > count / 10, "other triangles drawn across octaves: the same");
}

static void first_touch_any(uint64_t count)
{
    int good = 1;
    uint64_t n = 0;
    for (uint64_t i = 0; i < count; i++) {
        struct scene_of s;
        any_strip();
        any_mapping(&s);
        any_scene(&s, in(0, 2) ? 15 : 7, in(0, 2) ? 16 : 20);
        if (in(0, 1)) { /* the same keys, linear on the screen */
            s.as.e = 0;
            r.view.screen_linear = 1;
        }
        r.touch = zs_fast_touch.touch;
        r.touch->begin(&r);
        memset(r.depth, in(0, 255), (size_t)(width * rows) * 2); /* as it was left */
        zs_raster_strip(&r);
        if (r.untouched)
            r.touch->end(&r);
        n += r.stats.pixels_untested > 0;
        good &= strip_right(&s, 1);
        end_strip();
    }
    tell("first_touch", n, good && n > count / 5,
         "strips of up to 3 triangles drawn without a clear: each pixel as exact arithmetic has it, or cleared");
}

/* A row with columns [x0, x1) drawn, and a span: parts, what is cleared, and what is untouched then. */
static int one_row(int32_t x0, int32_t x1, int32_t i0, int32_t i1)
{
    struct zs_job job;
    struct zs_row row;
    int good = 1;
    memset(&job, 0, sizeof job);
    job.r = &r;
    job.tri = &tri[0];
    job.shader = &zs_shade_raw;
    job.span = in(0, 1) ? zs_fast_raw.span : zs_rows_test;
    job.color = r.color[0];
    job.depth = r.depth;
    job.y0 = y0;
    job.y1 = y0 + rows;
    job.width = job.pitch = width;
    r.touch = zs_fast_touch.touch;
    row.y = y0 + 1;
    row.at = width;
    row.i0 = i0;
    row.i1 = i1;
    for (int32_t k = 0; k < 3 * width; k++) {
        r.depth[k] = (uint16_t)(k >= width + x0 && k < width + x1 ? 30000 : 5); /* what is untouched: as it was left */
        r.color[0][k] = 99;
    }
    r.untouched_left = 1000;
    r.drawn[1][0] = (int16_t)x0;
    r.drawn[1][1] = (int16_t)x1;
    tri[0].paint = 1;
    const uint32_t sum = (uint32_t)prng_next(&prng), gx = (uint32_t)prng_next(&prng);
    r.touch->row(&job, &row);
    r.touch->piece(&job, &row, i0, i1, sum, gx);
    const int32_t lo = x0 == x1 ? i0 : zs_min32(x0, i0), hi = x0 == x1 ? i1 : zs_max32(x1, i1);
    good &= r.drawn[1][0] == lo && r.drawn[1][1] == hi && r.untouched_left == 1000u - (uint32_t)(hi - lo - (x1 - x0));
    for (int32_t k = 0; k < 3 * width; k++) {
        const int32_t x = k - width, had = x >= x0 && x < x1, draws = x >= i0 && x < i1;
        const uint16_t key = (uint16_t)((uint32_t)(sum + (uint64_t)gx * (uint32_t)(x - i0)) >> 16);
        uint16_t depth = had ? 30000 : 5, color = 99;
        if (draws && (!had || key < 30000))
            depth = key, color = 1;
        else if (!had && !draws && x >= lo && x < hi)
            depth = ZS_DEPTH_CLEAR, color = zs_wire16(BACKGROUND);
        good &= r.depth[k] == depth && r.color[0][k] == color;
    }
    return good;
}

static void first_touch_rows(void)
{
    int good = 1;
    uint64_t n = 0;
    for (int32_t w = 1; w <= 20; w += w < 12 ? 1 : 4) {
        new_strip(w, 3, 2, 0);
        r.view.key_top = 0xffff0000u;
        for (int32_t x0 = 0; x0 <= w; x0++)
            for (int32_t x1 = x0; x1 <= w; x1++)
                for (int32_t i0 = 0; i0 < w; i0++)
                    for (int32_t i1 = i0 + 1; i1 <= w; i1++, n++)
                        good &= one_row(x0, x1, i0, i1);
        end_strip();
    }
    tell("first_touch_rows", n, good,
         "ranges drawn and spans, all of rows of 1 .. 12, 16 and 20 pixels: what is drawn, cleared and left alone");
}

void facts_drawn(uint64_t count)
{
    small_any(count / 2);
    small_grid();
    float_any(count / 8);
    first_touch_any(count / 8);
    first_touch_rows();
}
