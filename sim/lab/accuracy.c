/* `zlab accuracy`: see accuracy.h. One row of the table after another: what is exactly known
 * (exact_cases.h), the bench scenes, rotations, random scenes (random_scenes.h, error_bound.h).
 *
 * SPDX-License-Identifier: MIT
 */
#include "accuracy.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "exact_cases.h"
#include "frame.h"
#include "error_bound.h"
#include "prng.h"
#include "random_scenes.h"
#include "rotation_drift.h"
#include "scenes.h"
#include "sim.h"
#include "texel_numbers.h"
#include "reference_frame.h"

#define KEY_BOUND 0.505 /* buckets, for width + height <= 640 */

#define MOVES 32 /* of a bench scene, by parts of a pixel */

static const char usage[] =
    "zlab accuracy [--scenes N=1000] [--seed S=1] [--quick]\n"
    "  Measures coverage, order, depth, texels, colours and rotations against whole numbers and the\n"
    "  double-precision reference, on the bench scenes and on N random ones, and prints a table.\n"
    "  Ends with status 1 where a row fails. --quick: less of everything, 40 scenes unless told.\n";

struct request {
    unsigned long scenes; /* 0: as many as usual */
    unsigned long long seed;
    int quick;
};

/* ---- The table ------------------------------------------------------------------------------ */

static unsigned rows_failed;

static void section(const char *name)
{
    (void)printf("\n%s\n", name);
}

/* A row: what, over how much, measured, allowed. The three texts are formatted by the caller. */
static void row(int ok, const char *what, const char *measured, const char *allowed,
                const char *format, ...) __attribute__((format(printf, 5, 6)));

static void row(int ok, const char *what, const char *measured, const char *allowed,
                const char *format, ...)
{
    va_list args;
    (void)printf("  %-4s  %-46s  %-16s  %-15s  ", ok ? "ok" : "FAIL", what, measured, allowed);
    va_start(args, format);
    (void)vprintf(format, args);
    va_end(args);
    (void)puts("");
    rows_failed += !ok;
}

/* The same for one number. */
static void row_count(const char *what, uint64_t n, const char *over)
{
    char measured[32];
    (void)snprintf(measured, sizeof measured, "%llu", (unsigned long long)n);
    row(n == 0, what, measured, "0", "%s", over);
}

static void row_value(const char *what, double value, double most, const char *unit,
                      const char *over)
{
    char measured[64], allowed[64];
    (void)snprintf(measured, sizeof measured, "%.4g%s", value, unit);
    (void)snprintf(allowed, sizeof allowed, "<= %g%s", most, unit);
    row(value <= most, what, measured, allowed, "%s", over);
}

/* A text that is good until the next call but seven. */
static const char *text(const char *format, ...) __attribute__((format(printf, 1, 2)));

static const char *text(const char *format, ...)
{
    static char texts[8][200];
    static unsigned at;
    char *out = texts[at++ % 8];
    va_list args;
    va_start(args, format);
    (void)vsnprintf(out, sizeof texts[0], format, args);
    va_end(args);
    return out;
}

static double percent(uint64_t part, uint64_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0.0;
}

/* ---- A frame beside the reference's --------------------------------------------------------- */

struct look {
    struct sim_frame frame;
    struct ref_image ours;
    struct sim_reference_frame truth;
    struct ref_diff diff;
};

/* Sums over frames. A pixel differs where another triangle, or none, is seen than in the reference.
 */
struct sums {
    uint64_t frames, drawn; /* drawn: in the reference */
    uint64_t differ, edges, ties, wrong;
    uint64_t surfaces, surfaces_wrong; /* those where it is not a triangle of the same plane */
    uint64_t uncovered,
        cracks; /* drawn in one alone; and missing though the reference draws all around */
    uint64_t keys;
    double key_beyond; /* worst |key - exact|, less what snapping explains */
    uint64_t colors, colors_far,
        colors_wrong; /* channels; more than one code off; and not explained */
    uint64_t texels, texels_differ, texels_far, texels_wrong;
    double texel_worst;   /* how far outside of its texel a true coordinate lies */
    double wrong_percent; /* the worst frame's differing pixels */
};

static void look_close(struct look *l)
{
    sim_frame_free(&l->frame);
    SIM_FREE(l->ours.id, l->ours.texel);
    sim_reference_frame_free(&l->truth);
}

static int look_draw(struct look *l, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config, int textured)
{
    int err = sim_frame_render(&l->frame, scene, camera, config, NULL);
    if (!err) {
        l->ours.rgb565 = l->frame.rgb565;
        l->ours.key = l->frame.key;
        err = sim_frame_ids(l->ours.id, scene, camera, config);
    }
    if (!err && textured)
        err = sim_frame_texels(l->ours.texel, scene, camera, config);
    if (err)
        return sim_refuse(NULL, 0, "a scene of the accuracy checks could not be drawn: %s",
                          zs_error_string(err));
    err = sim_reference_frame_draw(&l->truth, scene, camera, config);
    if (!err)
        err = ref_compare(&l->ours, &l->truth.image, &l->truth.depth, &l->truth.camera, config->width,
                          config->height, &l->diff);
    return err ? sim_refuse(NULL, 0, "the reference could not draw a scene (%d)", err) : SIM_OK;
}

/* Fill *l; look_close frees it. SIM_OK; SIM_REFUSED: nothing to free. */
static int look_open(struct look *l, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config, int textured)
{
    const size_t n = (size_t)config->width * config->height;
    memset(l, 0, sizeof *l);
    l->ours.id = sim_alloc(n, sizeof(uint32_t));
    l->ours.texel = textured ? sim_alloc(n, sizeof(uint32_t)) : NULL;
    const int status = look_draw(l, scene, camera, config, textured);
    if (status != SIM_OK)
        look_close(l);
    return status;
}

/* ---- Pixels --------------------------------------------------------------------------------- */

static void sum_visible(struct sums *s, const struct look *l, int x, int y)
{
    const size_t at = (size_t)y * (size_t)l->truth.judge.width + (size_t)x;
    const uint32_t ours = l->ours.id[at], truth = l->truth.image.id[at];
    const enum sim_verdict verdict = sim_judge_pixel(&l->truth.judge, ours, truth, x, y);
    const int surface = !ours || !truth ||
                        !sim_judge_same_plane(&l->truth.tri[ours - 1], &l->truth.tri[truth - 1]);
    if (verdict == SIM_SAME)
        return;
    s->differ++;
    s->edges += verdict == SIM_EDGE;
    s->ties += verdict == SIM_TIE;
    s->wrong += verdict == SIM_WRONG;
    s->surfaces += (uint64_t)surface;
    s->surfaces_wrong += surface && verdict == SIM_WRONG;
    s->uncovered += !ours || !truth;
    if (ours || x == 0 || y == 0 || x == l->truth.judge.width - 1 || y == l->truth.judge.height - 1)
        return;
    for (int k = 0; k < 9; k++)
        if (!l->truth.image.id[at + (size_t)(k / 3) * (size_t)l->truth.judge.width + (size_t)(k % 3) -
                         (size_t)l->truth.judge.width - 1])
            return;
    s->cracks++;
}

static void sum_key(struct sums *s, const struct look *l, int x, int y)
{
    const size_t at = (size_t)y * (size_t)l->truth.judge.width + (size_t)x;
    const double top = ldexp(1, l->truth.depth.bits) - 2;
    double off = fabs(l->ours.key[at] - fmin(fmax(l->truth.image.exact_key[at], 0), top));
    s->keys++;
    if (off > 0.5) /* speed: or nothing needs explaining */
        off -= sim_judge_key_slack(&l->truth.judge, l->ours.id[at], x, y);
    s->key_beyond = fmax(s->key_beyond, off);
}

static void split(uint16_t code, int out[3])
{
    out[0] = code >> 11;
    out[1] = code >> 5 & 63;
    out[2] = code & 31;
}

/* How far the range lo .. hi of a coordinate is from the texel that was taken, texels. */
static double outside(double lo, double hi, uint32_t taken, int size, int clamped)
{
    if (clamped) {
        lo = fmin(fmax(lo, 0), size);
        hi = fmin(fmax(hi, 0), size);
    } else { /* the repeat that is nearest */
        const double turns = size * floor(((lo + hi) / 2 - taken - 0.5) / size + 0.5);
        lo -= turns;
        hi -= turns;
    }
    return fmax(0, fmax(taken - hi, lo - (taken + 1.0)));
}

/* What an error of a coordinate may be beyond snapping, texels: 1/4 by interpolation, 1/512 on
 * purpose, half a step of uv (2^-12) where near cut it, and what arithmetic adds: 2^-21 of the span
 * times the ratio of w. */
static double texel_bound(const struct ref_triangle *t, int axis, double ratio)
{
    const int size = axis ? t->texture->height : t->texture->width;
    const double span = fmax(fmax(t->uv[0][axis], t->uv[1][axis]), t->uv[2][axis]) -
                        fmin(fmin(t->uv[0][axis], t->uv[1][axis]), t->uv[2][axis]);
    return 0.25 + 0x1p-9 + size * 0x1p-13 + span * size * ratio * 0x1p-21;
}

/* The texel of one axis: 0 u, 1 v. */
static void sum_axis(struct sums *s, const struct look *l, int x, int y, int axis, uint32_t ours,
                     uint32_t truth)
{
    const size_t at = (size_t)y * (size_t)l->truth.judge.width + (size_t)x;
    const struct ref_texture *t = l->truth.image.texture[at];
    const int size = axis ? t->height : t->width, clamped = axis ? t->clamp_v : t->clamp_u;
    const double exact = (axis ? l->truth.image.v : l->truth.image.u)[at] * size;
    const uint32_t apart = ours > truth ? ours - truth : truth - ours;
    const double off = outside(exact, exact, ours, size, clamped);
    double light[2], lo[2], hi[2];
    s->texels++;
    if (ours == truth)
        return;
    s->texels_differ++;
    s->texels_far += apart > 1 && (clamped || (int)apart < size - 1);
    s->texel_worst = fmax(s->texel_worst, off);
    const double ratio = sim_judge_texture(&l->truth.judge, l->ours.id[at], x, y, light, lo, hi);
    s->texels_wrong += outside(lo[axis], hi[axis], ours, size, clamped) >
                       texel_bound(&l->truth.tri[l->ours.id[at] - 1], axis, ratio);
}

static void sum_texel(struct sums *s, const struct look *l, int x, int y, size_t at)
{
    const uint32_t ours = l->ours.texel[at] - 1, truth = l->truth.image.texel[at] - 1;
    const uint32_t width = (uint32_t)l->truth.image.texture[at]->width;
    sum_axis(s, l, x, y, 0, ours % width, truth % width);
    sum_axis(s, l, x, y, 1, ours / width, truth / width);
}

/* A code within one of what a range of codes rounds to. */
static int code_right(int code, double lo, double hi)
{
    return code >= floor(lo + 0.5) - 1 && code <= floor(hi + 0.5) + 1;
}

static const int most_code[3] = { 31, 63, 31 };

/* The reference's texel, under light from as far around as snapping may reach. */
static int texture_explains(const struct look *l, int x, int y, size_t at, const int code[3])
{
    const struct ref_texture *t = l->truth.image.texture[at];
    double light[2], lo[2], hi[2];
    int base[3], right = 1;
    (void)sim_judge_texture(&l->truth.judge, l->ours.id[at], x, y, light, lo, hi);
    split(t->rgb565[l->truth.image.texel[at] - 1], base);
    for (int c = 0; c < 3; c++)
        right &= code_right(code[c], fmin(base[c] * light[0], most_code[c]),
                            fmin(base[c] * light[1], most_code[c]));
    return right;
}

static void sum_color(struct sums *s, const struct look *l, int x, int y, size_t at)
{
    int ours[3], truth[3], far = 0, right = 1;
    double lo[3], hi[3];
    split(l->ours.rgb565[at], ours);
    split(l->truth.image.rgb565[at], truth);
    for (int c = 0; c < 3; c++)
        far += abs(ours[c] - truth[c]) > 1;
    s->colors += 3;
    s->colors_far += (uint64_t)far;
    if (!far)
        return;
    if (l->truth.image.texture[at]) {
        right = texture_explains(l, x, y, at, ours);
    } else {
        sim_judge_color(&l->truth.judge, l->ours.id[at], x, y, lo, hi);
        for (int c = 0; c < 3; c++)
            right &= code_right(ours[c], lo[c], hi[c]);
    }
    s->colors_wrong += right ? 0 : (uint64_t)far;
}

static void sum_up(struct sums *s, const struct look *l)
{
    const uint64_t before = s->differ;
    for (int y = 0; y < l->truth.judge.height; y++)
        for (int x = 0; x < l->truth.judge.width; x++) {
            const size_t at = (size_t)y * (size_t)l->truth.judge.width + (size_t)x;
            if (l->ours.id[at] != l->truth.image.id[at]) {
                sum_visible(s, l, x, y);
            } else if (l->ours.id[at]) {
                /* texels under too little light cannot be told */
                const uint32_t texel = l->ours.texel ? l->ours.texel[at] : 0;
                sum_key(s, l, x, y);
                if (texel)
                    sum_texel(s, l, x, y, at);
                if (texel == l->truth.image.texel[at])
                    sum_color(s, l, x, y, at);
            }
        }
    s->frames++;
    s->drawn += l->diff.ref_drawn;
    s->wrong_percent = fmax(s->wrong_percent, percent(s->differ - before, l->diff.ref_drawn));
}

/* ---- What is exactly known ------------------------------------------------------------------ */

static int exact_rows(const struct request *rq)
{
    const uint32_t n = rq->quick ? 120 : 13100;
    struct sim_exact_triangles t;
    struct sim_exact_edges e;
    struct sim_exact_layers near, nearer;
    int status = sim_exact_triangles(&t, rq->seed, n);
    if (status == SIM_OK)
        status = sim_exact_edges(&e, rq->seed, n / 5);
    if (status == SIM_OK)
        status = sim_exact_layers(&near, rq->seed, n, 1.01);
    if (status == SIM_OK)
        status = sim_exact_layers(&nearer, rq->seed, n, 0.5);
    if (status != SIM_OK)
        return status;
    section("Triangles whose corners lie on sub-pixels, against whole numbers");
    row_count("coverage: pixels wrong", t.wrong,
              text("%llu pixels, %llu triangles", (unsigned long long)t.pixels,
                   (unsigned long long)t.triangles));
    for (int k = 0; k < SIM_EXACT_MAPPINGS; k++)
        row_value(text("depth, worst: %s", sim_exact_mapping[k]), t.key_worst[k], KEY_BOUND,
                  " bucket", text("%llu keys of 8 to 16 bits", (unsigned long long)t.keys[k]));
    const char *meshes = text("%llu pixels inside %llu meshes, half of them cut at near",
                              (unsigned long long)e.pixels, (unsigned long long)e.meshes);
    row_count("shared edges: cracks", e.cracks, meshes);
    row_count("shared edges: double hits", e.double_hits, meshes);
    row_count("shared edges: pixels beyond the outline", e.beyond, meshes);
    row_count("layers 1.01 buckets apart: swapped", near.swapped,
              text("%llu pixels, five mappings", (unsigned long long)near.pixels));
    row_count("layers 0.5 buckets apart: swapped, keys differ", nearer.unequal,
              text("%llu pixels, %.1f %% swapped", (unsigned long long)nearer.pixels,
                   percent(nearer.swapped, nearer.pixels)));
    for (uint32_t ratio = 1; ratio <= 16; ratio *= 2) {
        struct sim_exact_texels x;
        status = sim_exact_texels(&x, rq->seed, n / 20, ratio);
        if (status != SIM_OK)
            return status;
        const char *over = text("%llu coordinates, 256 x 256", (unsigned long long)x.coordinates);
        row_value(text("texels, ratio of w %u: worst", ratio), x.worst, 0.5, " texel", over);
        row_value(text("texels, ratio of w %u: mean", ratio),
                  (double)(x.differ + x.far) / fmax(1, (double)x.coordinates), 0.05, " texel",
                  over);
        row_count(text("texels, ratio of w %u: off by more than one", ratio), x.far, over);
    }
    return SIM_OK;
}

/* ---- Bench scenes --------------------------------------------------------------------------- */

/* A frame of a scene, with another mapping unless that is NULL. Add it to *s; *diff may be NULL. */
static int bench_frame(struct sums *s, struct ref_diff *diff, const struct demo *demo,
                       const struct demo_frame *f, const struct zs_depth *mapping)
{
    struct zs_config config;
    struct look l;
    int textured = 0;
    for (uint32_t k = 0; k < f->scene.n_instances; k++)
        textured |= f->scene.instance[k].material->texture != NULL;
    sim_frame_config(&config, demo->width, demo->height, (uint8_t)demo->varyings);
    config.depth = mapping ? mapping : demo->depth;
    const int status = look_open(&l, &f->scene, &f->camera, &config, textured);
    if (status != SIM_OK)
        return status;
    sum_up(s, &l);
    if (diff)
        *diff = l.diff;
    look_close(&l);
    return SIM_OK;
}

static int bench(struct sums *s, struct ref_diff *diff, const struct demo *demo, uint32_t t,
                 const struct zs_depth *mapping)
{
    struct demo_frame f;
    demo->pose(&f, t, demo->width, demo->height);
    return bench_frame(s, diff, demo, &f, mapping);
}

static void row_explained(const char *name, const struct sums *s)
{
    row_count(text("%s: pixels that nothing explains", name), s->wrong,
              text("%llu pixels; %llu differ: %llu at an edge, %llu ties",
                   (unsigned long long)s->drawn, (unsigned long long)s->differ,
                   (unsigned long long)s->edges, (unsigned long long)s->ties));
}

struct moved { /* a scene as it stands, and moved by parts of a pixel */
    struct sums sums;
    uint64_t id_differ, uncovered, twice;
    struct ref_diff still;
};

static int moved_draw(struct moved *m, const struct request *rq, const struct demo *demo, int flat)
{
    const uint32_t n = rq->quick ? 4 : MOVES;
    struct prng r = { rq->seed };
    int status = SIM_OK;
    memset(m, 0, sizeof *m);
    for (uint32_t k = 0; k < n && status == SIM_OK; k++) {
        struct demo_frame f;
        struct ref_diff d = { 0 };
        uint64_t twice = 0;
        demo->pose(&f, 0, demo->width, demo->height);
        for (int c = 0; c < 2 && k; c++) /* the eye is at the origin; focal length: the width */
            f.instance[0].pose.pos[c] += (int32_t)(prng_real(&r, -0.5, 0.5) *
                                                   -f.instance[0].pose.pos[2] / demo->width);
        status = bench_frame(&m->sums, &d, demo, &f, NULL);
        if (status == SIM_OK && flat)
            status = sim_exact_double_hits(&twice, &f.scene, &f.camera, demo->width, demo->height);
        m->id_differ += d.id_differ;
        m->uncovered += d.missing + d.extra;
        m->twice += twice;
        if (k == 0)
            m->still = d;
        sim_progress(demo->name, k, n);
    }
    sim_progress_end();
    return status;
}

static int visible_rows(const struct request *rq)
{
    static const struct {
        const struct demo *demo;
        double most; /* percent of pixels with another triangle */
        int flat;    /* no part hides another: pixels hit twice can be told */
    } scenes[] = { { &demo_relief, 0.15, 0 }, { &demo_mesh, 0.15, 0 }, { &demo_sheet, 0.5, 1 },
                   { &demo_slivers, 0.15, 1 } };
    section("Bench scenes, 320 x 240, as they stand and moved by parts of a pixel, against the "
            "reference");
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
        const struct demo *demo = scenes[k].demo;
        struct moved m;
        const int status = moved_draw(&m, rq, demo, scenes[k].flat);
        if (status != SIM_OK)
            return status;
        const struct ref_diff *d = &m.still;
        const char *over = text("%llu pixels of %llu frames", (unsigned long long)m.sums.drawn,
                                (unsigned long long)m.sums.frames);
        row_value(text("%s: wrong triangle", demo->name), percent(m.id_differ, m.sums.drawn),
                  scenes[k].most, " %",
                  text("%s; as it stands %zu of %zu", over, d->id_differ, d->ref_drawn));
        if (demo == &demo_mesh || demo == &demo_relief)
            row_value(
                text("%s: missing and extra coverage", demo->name), percent(m.uncovered, m.sums.drawn), 0.01, " %",
                text("%s; as it stands %zu of %zu", over, d->missing + d->extra, d->ref_drawn));
        row_count(text("%s: cracks", demo->name), m.sums.cracks, over);
        if (scenes[k].flat)
            row_count(text("%s: double hits", demo->name), m.twice, over);
        row_explained(demo->name, &m.sums);
    }
    return SIM_OK;
}

static int corridor_rows(void)
{
    static const struct zs_depth *const mappings[] = { NULL, &zs_depth_recip, &zs_depth_e4m12 };
    static const char *const names[] = { "default mapping", "recip", "e4m12" };
    static const struct demo *const layers[] = { &demo_layers_ftb, &demo_layers_btf,
                                                 &demo_layers_mixed };
    for (size_t k = 0; k < sizeof mappings / sizeof mappings[0]; k++) {
        struct sums s = { 0 };
        const int status = bench(&s, NULL, &demo_corridor, 0, mappings[k]);
        if (status != SIM_OK)
            return status;
        row_count(text("corridor, %s: wrong surface", names[k]), s.surfaces_wrong,
                  text("%llu pixels; %llu show another surface: at an edge, or within 1.01 bucket",
                       (unsigned long long)s.drawn, (unsigned long long)s.surfaces));
        row_explained("corridor", &s);
    }
    struct sums s = { 0 };
    for (size_t k = 0; k < sizeof layers / sizeof layers[0]; k++) {
        const int status = bench(&s, NULL, layers[k], 0, NULL);
        if (status != SIM_OK)
            return status;
    }
    row_explained("layers", &s);
    return SIM_OK;
}

static int depth_rows(void)
{
    struct sums s = { 0 };
    struct ref_diff d, recip;
    int status = bench(&s, &d, &demo_relief, 0, &zs_depth_e3m13);
    if (status == SIM_OK)
        status = bench(&s, &recip, &demo_relief, 0, &zs_depth_recip);
    if (status != SIM_OK)
        return status;
    row_value("relief: depth, mean relative error, e3m13", d.z_mean_rel, 3e-5, "",
              text("%zu pixels; recip %.3g", d.z_compared, recip.z_mean_rel));
    row_value("relief: depth, worst beyond snapping", s.key_beyond, KEY_BOUND, " bucket",
              text("%llu pixels, e3m13 and recip", (unsigned long long)s.keys));
    return SIM_OK;
}

static int color_rows(const struct request *rq)
{
    static const struct demo *const scenes[] = { &demo_mesh_lit, &demo_teapot, &demo_knot };
    static const char *const names[] = { "flat, mesh", "smooth, teapot", "smooth, knot" };
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
        struct sums s = { 0 };
        double psnr = (double)INFINITY;
        uint64_t one = 0;
        const uint32_t frames = rq->quick ? 1 : scenes[k]->frames < 8 ? scenes[k]->frames : 8;
        for (uint32_t t = 0; t < frames; t++) {
            struct ref_diff d;
            const int status = bench(&s, &d, scenes[k], t * scenes[k]->frames / frames, NULL);
            if (status != SIM_OK)
                return status;
            psnr = fmin(psnr, d.psnr_db);
            one += d.channel_off_one;
            sim_progress(names[k], t, frames);
        }
        sim_progress_end();
        row_count(text("colour, %s: more than one code off", names[k]), s.colors_far,
                  text("%llu values, %.2f %% one code off", (unsigned long long)s.colors,
                       percent(one, s.colors)));
        row(psnr >= 50, text("colour, %s: whole frame", names[k]), text("%.1f dB", psnr),
            ">= 50 dB", "the worst of %u frames, wrong triangles and outlines included", frames);
    }
    return SIM_OK;
}

static int texture_rows(void)
{
    static const struct {
        const struct demo *demo;
        int measured; /* against 0.5 and 0.05 texel; the floor goes to the horizon */
    } scenes[] = { { &demo_relief_tex, 1 },
                   { &demo_mesh_tex, 1 },
                   { &demo_mesh_tex_lit, 0 },
                   { &demo_mesh_tex_smooth, 0 },
                   { &demo_floor_tex, 0 } };
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
        const char *name = scenes[k].demo->name;
        struct sums s = { 0 };
        const int status = bench(&s, NULL, scenes[k].demo, 0, NULL);
        if (status != SIM_OK)
            return status;
        const char *over = text("%llu coordinates, 256 x 256", (unsigned long long)s.texels);
        if (scenes[k].measured) {
            row_value(text("%s: texels, worst", name), s.texel_worst, 0.5, " texel", over);
            row_value(text("%s: texels, mean", name),
                      (double)(s.texels_differ + s.texels_far) / fmax(1, (double)s.texels), 0.05,
                      " texel", over);
            row_count(text("%s: texels off by more than one", name), s.texels_far, over);
        }
        row_count(text("%s: texels that nothing explains", name), s.texels_wrong,
                  text("%s; %.2f %% another than the reference's", over,
                       percent(s.texels_differ, s.texels)));
        row_count(text("%s: more than one code off", name), s.colors_far,
                  text("%llu values of the same texel", (unsigned long long)s.colors));
    }
    return SIM_OK;
}

/* ---- Rotations ------------------------------------------------------------------------------ */

static void rotation_rows(const struct request *rq)
{
    const uint32_t n = rq->quick ? 65536 : 1000000;
    section("zs_pose_rotate, composed, against long double");
    const char *over = text("%u rotations; sub-pixels of 1/256 at %d px from the middle", n, SIM_ROTATION_LEVER);
    row_value("drift, the same step again and again", sim_rotation_drift(rq->seed, n, 0), 1, " sub-pixel", over);
    row_value("drift, a random step each time", sim_rotation_drift(rq->seed, n, 1), 1, " sub-pixel", over);
}

/* ---- Random scenes -------------------------------------------------------------------------- */

static int random_rows(const struct request *rq)
{
    const unsigned long n = rq->scenes ? rq->scenes : rq->quick ? 40 : 1000;
    struct sim_scatter scatter;
    struct sums s = { 0 };
    int status = SIM_OK;
    sim_scatter_alloc(&scatter);
    for (unsigned long k = 0; k < n && status == SIM_OK; k++) {
        struct look l;
        sim_scatter_make(&scatter, rq->seed + k, 160, 120);
        const uint64_t bad = s.wrong + s.colors_wrong + s.texels_wrong;
        const double worst = s.key_beyond;
        status = look_open(&l, &scatter.scene, &scatter.camera, &scatter.config, scatter.textured);
        if (status == SIM_OK) {
            sum_up(&s, &l);
            look_close(&l);
        }
        if (s.wrong + s.colors_wrong + s.texels_wrong > bad ||
            (s.key_beyond > worst && s.key_beyond > KEY_BOUND))
            (void)printf("  wrong: zlab accuracy --quick --scenes 1 --seed %llu\n", rq->seed + k);
        sim_progress("random scenes", k, n);
    }
    sim_progress_end();
    sim_scatter_free(&scatter);
    if (status != SIM_OK)
        return status;
    section(text("%lu random scenes, 160 x 120, against the reference", n));
    row_explained("visible", &s);
    row_value("depth, worst beyond snapping", s.key_beyond, KEY_BOUND, " bucket",
              text("%llu keys, five mappings, 8 to 16 bits", (unsigned long long)s.keys));
    row_count("colours that nothing explains", s.colors_wrong,
              text("%llu values; %llu more than one code off", (unsigned long long)s.colors,
                   (unsigned long long)s.colors_far));
    row_count("texels that nothing explains", s.texels_wrong,
              text("%llu coordinates; %.3f %% in another texel", (unsigned long long)s.texels,
                   percent(s.texels_differ, s.texels)));
    (void)printf(
        "       pixels that differ: %.4f %% of those drawn, %.3f %% in the worst scene; drawn in one "
        "alone %.4f %%\n",
        percent(s.differ, s.drawn), s.wrong_percent, percent(s.uncovered, s.drawn));
    return SIM_OK;
}

/* ---- The command ---------------------------------------------------------------------------- */

static void explain(void)
{
    (void)puts(
        "\nA pixel that shows another triangle than the reference is explained where its sample lies\n"
        "within a sub-pixel (1/256 px) of an outline, cut at near and far, of the triangle that either\n"
        "shows; or where both cover it and their true keys there are within 1.01 bucket and what their\n"
        "slopes make of half a sub-pixel. Camera units come on top: three for a corner. A wrong surface\n"
        "is a pixel that shows a triangle of another plane and is not explained. Beyond snapping: less\n"
        "what the slope makes of half a sub-pixel each way. A texel's error is how far the true\n"
        "coordinate lies outside of the texel taken; its mean is how often that is not the right one,\n"
        "which for coordinates that lie evenly over texels is the same.");
}

static int parse(struct request *rq, int argc, char **argv)
{
    for (int i = 0; i < argc; i++) {
        char *end;
        if (!strcmp(argv[i], "--quick")) {
            rq->quick = 1;
            continue;
        }
        const int scenes = !strcmp(argv[i], "--scenes");
        if (!scenes && strcmp(argv[i], "--seed"))
            return sim_usage("accuracy: unknown option '%s'", argv[i]);
        if (i + 1 == argc)
            return sim_usage("accuracy: %s needs a value", argv[i]);
        const char *value = argv[++i];
        errno = 0;
        const unsigned long long n = strtoull(value, &end, 10);
        if (*end || end == value || *value == '-' || errno || (scenes && (n < 1 || n > 1000000)))
            return sim_usage("accuracy: %s takes a whole number from %d%s, not '%s'",
                             scenes ? "--scenes" : "--seed", scenes, scenes ? " to 1000000" : "",
                             value);
        if (scenes)
            rq->scenes = (unsigned long)n;
        else
            rq->seed = n;
    }
    return SIM_OK;
}

int sim_accuracy(int argc, char **argv)
{
    struct request rq = { 0, 1, 0 };
    if (argc == 1 && (!strcmp(argv[0], "--help") || !strcmp(argv[0], "-h"))) {
        (void)fputs(usage, stdout);
        return SIM_OK;
    }
    int status = parse(&rq, argc, argv);
    if (status != SIM_OK)
        return status;
    (void)puts("Accuracy of the renderer: 8 sub-pixel bits, 16-bit depth unless said");
    (void)printf("        %-46s  %-16s  %-15s  %s\n", "what", "measured", "allowed", "over");
    status = exact_rows(&rq);
    if (status == SIM_OK)
        status = visible_rows(&rq);
    if (status == SIM_OK)
        status = corridor_rows();
    if (status == SIM_OK)
        status = depth_rows();
    if (status == SIM_OK)
        status = color_rows(&rq);
    if (status == SIM_OK)
        status = texture_rows();
    if (status != SIM_OK)
        return status;
    rotation_rows(&rq);
    status = random_rows(&rq);
    if (status != SIM_OK)
        return status;
    explain();
    (void)fflush(stdout);
    return rows_failed ? sim_refuse(NULL, 0, "accuracy: %u rows fail", rows_failed) : SIM_OK;
}
