/* zsim study time: what a setting costs and what it is wrong by. A run is frame 0 of a bench scene, with strips of 24
 * rows and pools that take it in one pass, against the double-precision reference. What is compiled in (reciprocals,
 * sub-spans) is varied by --full, whose runs of another build are measured by that build's zsim:
 * BUILD/study/VARIANT/zsim beside this one, which make study-variants makes.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "frame.h"
#include "method_names.h"
#include "scenes.h"
#include "sim.h"
#include "study_measure.h"

static const struct {
    const struct demo *demo;
    const char *shading;
} scenes[] = { { &demo_mesh, "raw" },
               { &demo_corridor, "raw" },
               { &demo_floor_tex, "texture" },
               { &demo_mesh_lit, "flat" },
               { &demo_teapot, "smooth" },
               { &demo_mesh_tex, "texture" },
               { &demo_mesh_tex_lit, "texture flat" },
               { &demo_mesh_tex_smooth, "texture smooth" } };
#define N_SCENES (sizeof scenes / sizeof scenes[0])

static const struct build {
    const char *name; /* of its folder */
    int steps, coarse, bound;
} builds[] = { { "", 1, 10, 2 },        { "bound3", 1, 10, 3 },  { "bound5", 1, 10, 5 },
               { "recip16", 0, 10, 2 }, { "texels30", 1, 0, 2 }, { "texels15", 1, 31, 2 } };
#define N_BUILDS (sizeof builds / sizeof builds[0])

static struct run {
    int scene, subpixel, mapping, bits, build;
    int method; /* of sim_methods */
} *runs;
static size_t n_runs;
static enum study_effort planned;

static void add(int scene, int subpixel, int mapping, int bits, int build)
{
    runs = sim_grow(runs, n_runs + 1, sizeof *runs);
    runs[n_runs++] = (struct run){ scene, subpixel, mapping, bits, build, 0 };
}

/* The default settings by another method of hidden-surface removal. */
static void add_method(int scene, int method)
{
    add(scene, 8, STUDY_MAPPINGS - 1, 16, 0);
    runs[n_runs - 1].method = method;
}

static size_t plan(enum study_effort effort)
{
    n_runs = 0;
    planned = effort;
    for (int s = 0; s < (effort == STUDY_QUICK ? 3 : (int)N_SCENES); s++)
        for (int m = 0; m < STUDY_MAPPINGS; m++) {
            if (effort == STUDY_QUICK && m != 0 && m != 5)
                continue;
            if (m == 1) {
                add(s, 8, m, 16, 0); /* slow: once */
                continue;
            }
            for (int bits = 16; bits >= 8; bits -= 4)
                for (int subpixel = 8; subpixel >= 4 && (effort != STUDY_QUICK || bits == 16); subpixel -= 4)
                    add(s, subpixel, m, bits, 0);
        }
    for (int s = 0; s < (effort == STUDY_QUICK ? 3 : (int)N_SCENES); s++)
        for (int m = 1; m < SIM_METHODS; m++)
            add_method(s, m);
    for (int b = 1; effort == STUDY_FULL && b < (int)N_BUILDS; b++)
        for (int s = 0; s < (int)N_SCENES; s++)
            add(s, 8, 5, 16, b);
    return n_runs;
}

/* The mapping of a run; "none" or "order" of methods that have one of their own. */
static const char *mapping_name(const struct run *r)
{
    const struct zs_depth *own = sim_methods[r->method].depth;
    return own == &zs_depth_none ? "none" : own == &zs_depth_order ? "order" : study_mapping[r->mapping].name;
}

static void describe(size_t i, struct study_text *row)
{
    const struct run *r = &runs[i];
    const struct build *b = &builds[r->build];
    study_put(row, "%s", scenes[r->scene].demo->name);
    study_put(row, "%s", scenes[r->scene].shading);
    study_put(row, "%d", r->subpixel);
    study_put(row, "%s", mapping_name(r));
    study_put(row, "%d", r->bits);
    study_put(row, "%d", b->steps ? 30 : 16);
    study_put(row, "%s", b->coarse == 0 ? "30" : b->coarse == 31 ? "15" : "15 or 30");
    study_put(row, "1/%d", 1 << b->bound);
    study_put(row, "%s", sim_methods[r->method].name);
    study_put(row, "%s", study_cores());
}

/* ---- One run ----------------------------------------------------------------------------------------------------- */

static void configure(struct zs_config *config, const struct run *r)
{
    const struct demo *d = scenes[r->scene].demo;
    sim_frame_config(config, d->width, d->height, (uint8_t)d->varyings);
    config->strip_h = 24;
    config->buffers = 1;
    config->subpixel_bits = (uint8_t)r->subpixel;
    config->depth_bits = (uint8_t)r->bits;
    config->depth = study_mapping[r->mapping].depth;
    sim_method_apply(config, &sim_methods[r->method]);
}

static int is_own(const struct build *b)
{
    return b->steps == ZS_RECIP_STEPS && b->coarse == ZS_TEXEL_COARSE_LOG2 && b->bound == ZS_SPAN_BOUND_LOG2;
}

/* Instructions of a core into the row; refused where it drew another frame. */
static int put_count(size_t i, const char *core, uint64_t checksum, struct study_text *row)
{
    unsigned long long sum = 0;
    const unsigned long long n = study_counted(core, i, &sum);
    if (n && sum != checksum)
        return sim_refuse(NULL, 0,
                          "run %zu: the frame that was counted on %s (%016llx) is not this zsim's (%016llx); count "
                          "again with its --settings",
                          i, core, sum, (unsigned long long)checksum);
    if (n)
        study_put(row, "%llu", n);
    else
        study_skip(row, 1);
    return SIM_OK;
}

/* What the zsim of another build measures. */
static int ask_build(size_t i, struct study_text *row)
{
    static const char *const effort[] = { " --quick", "", " --full" };
    char self[3000], command[4096], line[1024] = "";
    const ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    if (n < 0)
        return sim_refuse(NULL, 0,
                          "study time: where this zsim lies cannot be told, so neither where those of other builds do");
    self[n] = '\0';
    *strrchr(self, '/') = '\0';
    (void)snprintf(command, sizeof command, "%s/study/%s/zsim", self, builds[runs[i].build].name);
    if (access(command, X_OK))
        return sim_refuse(command, 0, "is not there: make study-variants makes it");
    (void)snprintf(command, sizeof command, "'%s/study/%s/zsim' study time%s --run %zu", self,
                   builds[runs[i].build].name, effort[planned], i);
    FILE *f = popen(command, "r");
    const int got = f && fgets(line, sizeof line, f) != NULL;
    if (!f || pclose(f) || !got || !strchr(line, '\n'))
        return sim_refuse(NULL, 0, "%s: it failed; make study-variants makes it anew", command);
    *strchr(line, '\n') = '\0';
    study_put(row, "%s", line);
    return SIM_OK;
}

static double percent(size_t part, size_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0.0;
}

/* What study_frame_open says of a run's first frame. */
static int draw(struct study_frame *f, const struct run *r)
{
    const struct demo *d = scenes[r->scene].demo;
    struct demo_frame scene;
    struct zs_config config;
    configure(&config, r);
    d->pose(&scene, 0, d->width, d->height);
    return study_frame_open(f, &scene.scene, &scene.camera, &config);
}

static int measure_own(size_t i, struct study_text *row)
{
    struct study_frame f;
    const int err = draw(&f, &runs[i]);
    if (err)
        return sim_refuse(scenes[runs[i].scene].demo->name, 0, "could not be drawn: %s", zs_error_string(err));
    const struct ref_diff *e = &f.diff;
    study_put(row, "%zu", e->ref_drawn);
    study_put(row, "%.4g", percent(e->id_differ, e->ref_drawn));
    study_put(row, "%.4g", percent(e->missing + e->extra, e->ref_drawn));
    study_put(row, "%.4g", percent(f.surface, e->ref_drawn));
    if (!sim_methods[runs[i].method].keys) {
        study_skip(row, 2); /* no keys of depth */
    } else {
        study_put(row, "%.4g", e->z_mean_rel);
        study_put(row, "%.4g", f.key_beyond);
    }
    study_put(row, "%.4g", percent(e->texel_differ, e->texels));
    study_put(row, "%.4g", e->texel_max_distance);
    study_put(row, "%zu", e->channel_off);
    study_put(row, "%.4g", percent(e->channel_off_one, e->channels));
    study_put(row, "%.2f", fmin(e->psnr_db, 99.99));
    study_put(row, "%016llx", (unsigned long long)f.checksum);
    study_frame_free(&f);
    return SIM_OK;
}

static int measure(size_t i, struct study_text *row)
{
    const size_t before = row->n;
    int status = is_own(&builds[runs[i].build]) ? measure_own(i, row) : ask_build(i, row);
    if (status != SIM_OK || before == 0)
        return status; /* another zsim has asked */
    const uint64_t checksum = strtoull(strrchr(row->text, ',') + 1, NULL, 16);
    status = put_count(i, "m3", checksum, row);
    if (status == SIM_OK)
        status = put_count(i, "m0", checksum, row);
    if (status == SIM_OK)
        status = put_count(i, "pico", checksum, row);
    return status == SIM_OK ? put_count(i, "host", checksum, row) : status;
}

static void settings(size_t i, FILE *out)
{
    const struct run *r = &runs[i];
    const struct demo *d = scenes[r->scene].demo;
    const struct build *b = &builds[r->build];
    struct demo_frame scene;
    struct zs_config config;
    struct sim_frame frame;
    configure(&config, r);
    d->pose(&scene, 0, d->width, d->height);
    if (sim_frame_render(&frame, &scene.scene, &scene.camera, &config, NULL) != ZS_OK)
        return; /* the board would not draw it either; measure says so */
    const struct sim_method *method = &sim_methods[r->method];
    (void)fprintf(out, "{ %zu, &demo_%s, 24, %u, %u, 1, %d, %d, &zs_depth_%s, %s%s, %d, %d, %d },\n", i, d->name,
                  r->method ? sim_method_pool(method, frame.stats.max_tris_used) : frame.stats.max_tris_used,
                  frame.stats.max_verts_used + 8, r->subpixel, r->bits, mapping_name(r),
                  r->method ? "&zs_method_" : "0", r->method ? method->name : "", b->steps, b->coarse, b->bound);
    sim_frame_free(&frame);
}

/* ---- What follows ------------------------------------------------------------------------------------------------ */

#define TIE 0.001 /* times that differ by less are equal: the choice of a mapping, a tick of the counter */
enum { ERRORS = 6 };
static const char *const error_name[ERRORS] = { "wrong or missing pixels, %", "wrong surface, %",
                                                "depth, mean relative error", "wrong texel, %",
                                                "texels, worst distance",     "colour, mean square error of 255^2" };

/* A setting: over all its scenes, or in one. Less is better. */
struct point {
    size_t row; /* its first */
    size_t scenes, textured;
    double m3, m0, rp2040, host; /* millions of instructions, or cycles, a frame; mean */
    double error[ERRORS];
    double buckets, codes; /* worst key, snapping taken off; part of channels that are off by a code, percent, mean */
    const char *method; /* NULL: the depth buffer */
    int dominated;
    size_t by; /* whom */
};

static int same_setting(const struct study_table *t, size_t a, size_t b)
{
    static const char *const column[] = { "subpixel", "mapping", "bits", "recip_bits", "texel_recip", "span_bound",
                                         "method" };
    for (size_t k = 0; k < sizeof column / sizeof column[0]; k++)
        if (strcmp(study_cell(t, a, column[k]), study_cell(t, b, column[k])))
            return 0;
    return 1;
}

static int is_default(const struct study_table *t, size_t r)
{
    return study_is(t, r, "subpixel", "8") && study_is(t, r, "mapping", "float") && study_is(t, r, "bits", "16") &&
           study_is(t, r, "recip_bits", "30") && study_is(t, r, "texel_recip", "15 or 30") &&
           study_is(t, r, "span_bound", "1/4") && study_is(t, r, "method", "zbuffer");
}

static void point_add(struct point *p, const struct study_table *t, size_t r)
{
    p->scenes++;
    p->m3 += study_number(t, r, "m3") / 1e6;
    p->m0 += study_number(t, r, "m0") / 1e6;
    p->rp2040 += study_number(t, r, "rp2040") / 1e6;
    p->host += study_number(t, r, "host") / 1e6;
    if (!study_is(t, r, "method", "zbuffer"))
        p->method = study_cell(t, r, "method");
    p->buckets = fmax(p->buckets, study_number(t, r, "depth_worst"));
    p->codes += study_number(t, r, "colour_by_one");
    p->error[0] += study_number(t, r, "wrong") + study_number(t, r, "cover");
    p->error[1] += study_number(t, r, "surface");
    p->error[2] += study_number(t, r, "depth_mean");
    p->error[3] += study_number(t, r, "texels_off");
    p->error[4] = fmax(p->error[4], study_number(t, r, "texel_worst"));
    p->error[5] += pow(10, study_number(t, r, "psnr") / -10);
}

/* a is as good as b in everything and better in something. Depth is not compared where a method has no keys (NAN). */
static int dominates(const struct point *a, const struct point *b)
{
    int better = a->m3 < b->m3 * (1 - TIE), worse = a->m3 > b->m3 * (1 + TIE);
    for (int e = 0; e < ERRORS; e++) {
        better |= a->error[e] < b->error[e];
        worse |= a->error[e] > b->error[e];
    }
    return better && !worse;
}

/* Settings of a scene, or of all that were measured in each scene. Return how many; point[] is malloc'ed. */
static size_t gather(struct point **point, const struct study_table *t, const char *scene)
{
    size_t n = 0, most = 0, kept = 0;
    struct point *p = sim_alloc(t->n_rows, sizeof *p);
    for (size_t r = 0; r < t->n_rows; r++) {
        size_t k = 0;
        if (scene && !study_is(t, r, "scene", scene))
            continue;
        while (k < n && !same_setting(t, p[k].row, r))
            k++;
        if (k == n)
            p[n++].row = r;
        point_add(&p[k], t, r);
        most = p[k].scenes > most ? p[k].scenes : most;
    }
    for (size_t k = 0; k < n; k++) {
        if (p[k].scenes < most)
            continue;
        p[kept] = p[k];
        p[kept].m3 /= (double)most;
        p[kept].m0 /= (double)most;
        p[kept].rp2040 /= (double)most;
        p[kept].host /= (double)most;
        p[kept].codes /= (double)most;
        for (int e = 0; e < ERRORS; e++)
            p[kept].error[e] /= e == 4 ? 1 : (double)most;
        kept++;
    }
    for (size_t k = 0; k < kept; k++)
        for (size_t j = 0; j < kept && !p[k].dominated; j++)
            if (dominates(&p[j], &p[k])) {
                p[k].dominated = 1;
                p[k].by = j;
            }
    *point = p;
    return kept;
}

/* A setting in words. Static storage, four at a time. */
static const char *words(const struct study_table *t, size_t r)
{
    static char text[4][160];
    static unsigned at;
    char *out = text[at++ % 4];
    size_t n = (size_t)snprintf(out, sizeof text[0], "%s %s, S %s", study_cell(t, r, "mapping"),
                                study_cell(t, r, "bits"), study_cell(t, r, "subpixel"));
    if (!study_is(t, r, "recip_bits", "30"))
        n += (size_t)snprintf(out + n, sizeof text[0] - n, ", reciprocals of %s bits", study_cell(t, r, "recip_bits"));
    if (!study_is(t, r, "texel_recip", "15 or 30"))
        n += (size_t)snprintf(out + n, sizeof text[0] - n, ", pixels' of %s", study_cell(t, r, "texel_recip"));
    if (!study_is(t, r, "span_bound", "1/4"))
        (void)snprintf(out + n, sizeof text[0] - n, ", spans to %s", study_cell(t, r, "span_bound"));
    if (!study_is(t, r, "method", "zbuffer"))
        (void)snprintf(out, sizeof text[0], "method %s", study_cell(t, r, "method"));
    return out;
}

/* Points of a mapping with the depth buffer, m = STUDY_MAPPINGS: of all; group 0: dominated by none, 1: dominated, 2:
 * the default. */
static void block(FILE *f, const struct study_table *t, const struct point *p, size_t n, int e, int m, int group)
{
    (void)fprintf(f, "$p%d_%d_%d << EOD\n-1\t-1\n", e, m, group);
    for (size_t k = 0; k < n; k++)
        if ((m == STUDY_MAPPINGS || (!p[k].method && study_is(t, p[k].row, "mapping", study_mapping[m].name))) &&
            (group == 2 ? is_default(t, p[k].row) : p[k].dominated == group))
            (void)fprintf(f, "%.6g\t%.6g\n", p[k].m3, p[k].error[e]);
    (void)fputs("EOD\n", f);
}

/* Filled where dominated by none, hollow where dominated, a ring about the default. */
static void plot_points(FILE *f, int e)
{
    (void)fputs("plot ", f);
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        (void)fprintf(
            f,
            "$p%d_%d_1 with points pt 6 ps 0.6 lc rgb '%s' notitle, $p%d_%d_0 with points pt 7 ps 0.7 lc rgb '%s' "
            "title '%s', ",
            e, m, study_mapping[m].color, e, m, study_mapping[m].color, study_mapping[m].name);
    (void)fprintf(f, "$p%d_%d_2 with points pt 6 ps 1.6 lw 2 lc rgb '#ff7f0e' title 'default'", e, STUDY_MAPPINGS);
}

static void point_blocks(FILE *f, const struct study_table *t, const struct point *p, size_t n, int e)
{
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        for (int group = 0; group < 2; group++)
            block(f, t, p, n, e, m, group);
    block(f, t, p, n, e, STUDY_MAPPINGS, 2);
}

/* Time against each error, a panel each; *lo, *hi: where most settings lie, millions of instructions. */
static int plot_front(struct study_page *page, const struct study_table *t, const struct point *p, size_t n, double lo,
                      double hi)
{
    FILE *f = study_plot_open(page, "front", 960, 1000);
    if (!f)
        return SIM_REFUSED;
    (void)fprintf(
        f,
        "set multiplot layout 3,2\nset xrange [%g:%g]\nset format y '%%g'\nset xlabel 'M instructions a frame, "
        "Cortex-M3'\n",
        lo, hi);
    for (int e = 0; e < ERRORS; e++) {
        double least = INFINITY, most = 0;
        for (size_t k = 0; k < n; k++)
            if (p[k].error[e] > 0) {
                least = fmin(least, p[k].error[e]);
                most = fmax(most, p[k].error[e]);
            }
        point_blocks(f, t, p, n, e);
        if (most > 0)
            (void)fprintf(f, "set logscale y\nset yrange [%g:%g]\n", least / 1.6, most * 1.6);
        else
            (void)fputs("unset logscale y\nset yrange [0:1]\n", f);
        (void)fprintf(f, "set title '%s'\nset key %s\n", error_name[e], e == 1 ? "inside top right samplen 1" : "off");
        plot_points(f, e);
        (void)fputs("\n", f);
    }
    (void)fputs("unset multiplot\n", f);
    return study_plot_close(
        page, "Time against error, means over all scenes (texels: the worst). Filled: dominated by no setting; "
              "hollow: dominated; orange ring: the default.");
}

/* Methods of hidden-surface removal with the default settings: time against wrong pixels, both logarithmic. */
static int plot_methods(struct study_page *page, const struct study_table *t, const struct point *p, size_t n)
{
    FILE *f = study_plot_open(page, "methods", 860, 460);
    if (!f)
        return SIM_REFUSED;
    (void)fputs("$methods << EOD\n", f);
    for (size_t k = 0; k < n; k++)
        if (p[k].method || is_default(t, p[k].row))
            (void)fprintf(f, "%.6g\t%.6g\t%s\n", p[k].m3, fmax(p[k].error[0], 1e-3),
                          p[k].method ? p[k].method : "zbuffer");
    (void)fputs("EOD\nset logscale xy\nset xlabel 'M instructions a frame, Cortex-M3'\n"
                "set ylabel 'wrong or missing pixels, %'\nset yrange [0.0005:100]\n"
                "set offsets graph 0.1, graph 0.2, 0, 0\n"
                "plot $methods with points pt 7 ps 1.2 lc rgb '#1f77b4' notitle, $methods using 1:2:3 with labels left "
                "rotate by 40 offset 0.5,0.8 notitle\n",
                f);
    return study_plot_close(page,
        "Methods of hidden-surface removal, means over all scenes, with the default settings. "
                                  "Below a thousandth of a per cent: drawn there.");
}

/* Measured once with the same scenes at 320x240: instructions in millions on the M3, wrong triangles in percent. */
static const struct {
    const char *name;
    double flat, textured, wrong; /* wrong < 0: not measured; -1: a line in the plot */
} peers[] = { { "small3dlib", 3.77, 4.98, 33 },
              { "TGX", 26.4, 44.1, 0.42 },
              { "TinyGL", 21.5, 35.9, -1 },
              { "Pico3D", 3.88, 4.72, -2 } };
#define N_PEERS (sizeof peers / sizeof peers[0])

static int plot_peers(struct study_page *page, const struct study_table *t)
{
    struct point *p;
    const size_t n = gather(&p, t, "mesh");
    FILE *f = study_plot_open(page, "peers", 860, 460);
    if (!f) {
        free(p);
        return SIM_REFUSED;
    }
    point_blocks(f, t, p, n, 0);
    (void)fputs("$peers << EOD\n", f);
    for (size_t k = 0; k < N_PEERS; k++)
        if (peers[k].wrong >= 0)
            (void)fprintf(f, "%g\t%g\t%s\n", peers[k].flat, peers[k].wrong, peers[k].name);
    (void)fputs("EOD\nset logscale xy\nset xrange [1:60]\nset yrange [0.002:100]\nset xlabel 'M instructions a frame, "
                "Cortex-M3'\n"
                "set ylabel 'wrong or missing pixels, %'\n",
                f);
    for (size_t k = 0; k < N_PEERS; k++)
        if (peers[k].wrong == -1)
            (void)fprintf(
                f,
                "set arrow from %g,0.002 to %g,100 nohead dt 3 lc rgb '#888888'\n"
                "set label '%s (error not measured)' at %g,30 rotate by 90 right tc rgb '#888888'\n",
                peers[k].flat, peers[k].flat, peers[k].name, 0.94 * peers[k].flat);
    plot_points(f, 0);
    (void)fputs(", $peers with points pt 9 ps 1.2 lc rgb '#8c564b' title 'others', $peers using 1:2:3 with labels left "
                "offset 1,0 "
                "notitle\n",
                f);
    free(p);
    return study_plot_close(
        page, "Scene mesh, 320x240, flat colours: 2,520 triangles. The others were measured once with the same "
              "scene; TinyGL's wrong triangles were not.");
}

/* A count, or nothing where it was not counted. Static storage, four at a time. */
static const char *millions(double m)
{
    static char text[4][32];
    static unsigned at;
    char *out = text[at++ % 4];
    out[0] = '\0';
    if (!isnan(m))
        (void)snprintf(out, sizeof text[0], "%.3f", m);
    return out;
}

static void table_peers(struct study_page *page, const struct study_table *t)
{
    double flat = NAN, textured = NAN, wrong = NAN;
    for (size_t r = 0; r < t->n_rows; r++) {
        if (is_default(t, r) && study_is(t, r, "scene", "mesh")) {
            flat = study_number(t, r, "m3") / 1e6;
            wrong = study_number(t, r, "wrong");
        }
        if (is_default(t, r) && study_is(t, r, "scene", "mesh_tex"))
            textured = study_number(t, r, "m3") / 1e6;
    }
    study_table_open(page, "Cortex-M3, M instructions|mesh|mesh_tex|wrong triangles in mesh, %");
    study_table_row(page, "zstrip, default|%s|%s|%.3f", millions(flat), millions(textured), wrong);
    for (size_t k = 0; k < N_PEERS; k++)
        if (peers[k].wrong >= 0)
            study_table_row(page, "%s|%.2f|%.2f|%.2f", peers[k].name, peers[k].flat, peers[k].textured, peers[k].wrong);
        else
            study_table_row(page, "%s|%.2f|%.2f|not measured", peers[k].name, peers[k].flat, peers[k].textured);
    study_table_close(page, "The others: measured once, the same shapes at 320x240, draw and clear, textures affine; "
                            "zstrip's are perspective-correct.");
}

static void table_front(struct study_page *page, const struct study_table *t, const struct point *p, size_t n)
{
    char *done = sim_alloc(n, 1);
    study_table_open(page, "setting||M3, M|M0, M|RP2040, M cycles|host, M|wrong %|surface %|depth|buckets|texel %|"
                           "texels|code %|PSNR, dB");
    for (size_t k = 0; k < n; k++) {
        size_t next = n;
        for (size_t j = 0; j < n; j++)
            if (!done[j] && (next == n || p[j].m3 < p[next].m3))
                next = j;
        done[next] = 1;
        const struct point *q = &p[next];
        char depth[48] = "|";
        if (!isnan(q->error[2]))
            (void)snprintf(depth, sizeof depth, "%.2e|%.3f", q->error[2], q->buckets);
        study_table_row(page, "%s|%s%s|%s|%s|%s|%s|%.4f|%.4f|%s|%.3f|%.3f|%.3f|%.2f", words(t, q->row),
                        is_default(t, q->row) ? "default, " : "", q->dominated ? "dominated" : "front", millions(q->m3),
                        millions(q->m0), millions(q->rp2040), millions(q->host), q->error[0], q->error[1], depth,
                        q->error[3], q->error[4], q->codes, fmin(-10 * log10(q->error[5]), 99.99));
    }
    free(done);
    study_table_close(
        page, "Means over the scenes, quickest first. S: sub-pixel bits. M3, M0: millions of instructions a frame as "
              "QEMU counts them, not cycles; RP2040: cycles as rp2040js counts them, host: instructions of this "
              "machine as callgrind counts them, both of some settings. wrong: pixels of another triangle, missing or "
              "too many; "
              "surface: of another plane; depth: mean relative error; buckets: the worst key, what snapping explains "
              "taken off; texel: another than the reference's; texels: how far coordinates are off at worst; code: "
              "channels off by one of 31 or 63. "
              "dominated: another setting is as good in time (to 0.1 %) and all errors, and better in one.");
}

/* The frame with the most wrong surfaces and pixels, its wrong surfaces in magenta. */
static int picture(struct study_page *page, const struct study_table *t)
{
    const size_t worst = study_most(t, "surface");
    char caption[512];
    const struct demo *d = scenes[runs[worst].scene].demo;
    struct study_frame f;
    if (draw(&f, &runs[worst]) != ZS_OK)
        return sim_refuse(d->name, 0, "could not be drawn");
    uint8_t *rgb = sim_alloc((size_t)2 * d->width * d->height, 3);
    study_sheet_put(rgb, 2u * d->width, 0, 0, f.rgb565, NULL, d->width, d->height);
    study_sheet_put(rgb, 2u * d->width, d->width, 0, f.rgb565, f.wrong, d->width, d->height);
    study_frame_free(&f);
    (void)snprintf(caption, sizeof caption,
                   "The worst case: %s with %s, %s %% of the pixels show a wrong surface (right, magenta).", d->name,
                   words(t, worst), study_cell(t, worst, "surface"));
    const int status = study_picture(page, "worst", 2u * d->width, d->height, rgb, caption);
    free(rgb);
    return status;
}

static void say_default(struct study_page *page, const struct study_table *t, const struct point *p, size_t n)
{
    size_t front = 0, at = n, quick = 0;
    for (size_t k = 0; k < n; k++) {
        front += !p[k].dominated;
        at = is_default(t, p[k].row) ? k : at;
        quick = p[k].m3 < p[quick].m3 ? k : quick;
    }
    if (at == n)
        return;
    printf("default: %s%s\n", p[at].dominated ? "dominated by " : "on the front",
           p[at].dominated ? words(t, p[p[at].by].row) : "");
    study_say(
        page,
        "Of %zu settings, %zu are dominated by none. The default (%s) is %s%s: %.3f million instructions a frame, "
        "%.4f %% wrong pixels. The quickest (%s) saves %.1f %% of the time, and has %.4f %%.",
        n, front, words(t, p[at].row), p[at].dominated ? "dominated by " : "one of them",
        p[at].dominated ? words(t, p[p[at].by].row) : "", p[at].m3, p[at].error[0], words(t, p[quick].row),
        100 * (1 - p[quick].m3 / p[at].m3), p[quick].error[0]);
}

/* Where the plot ends: 5 % about the default, and which settings lie beyond. */
static void range(struct study_page *page, const struct study_table *t, const struct point *p, size_t n, double *lo,
                  double *hi)
{
    char beyond[1024] = "";
    size_t at = 0, length = 0;
    for (size_t k = 0; k < n; k++)
        at = is_default(t, p[k].row) ? k : at;
    *lo = 0.95 * p[at].m3;
    *hi = 1.05 * p[at].m3;
    for (size_t k = 0; k < n && length < sizeof beyond - 200; k++)
        if (!p[k].method && (p[k].m3 < *lo || p[k].m3 > *hi))
            length += (size_t)snprintf(beyond + length, sizeof beyond - length, "%s%s: %.3f", length ? "; " : "",
                                       words(t, p[k].row), p[k].m3);
    if (length)
        study_say(page, "Beyond the plots' edges, in millions of instructions: %s.", beyond);
}

static int report(struct study_page *page, const struct study_table *t)
{
    struct point *p;
    study_say(
        page,
        "Varied: sub-pixel bits, depth mapping and its bits, the method of hidden-surface removal, and, in the full "
        "sweep, the bits of reciprocals and how "
        "far from the truth a span may be affine; each in bench scenes of every kind of shading, one pass, strips of "
        "24 rows.");
    int status = picture(page, t);
    if (status != SIM_OK)
        return status;
    const size_t n = gather(&p, t, NULL);
    if (n && isnan(p[0].m3)) {
        study_say(
            page,
            "Instructions were not counted: make report runs the same frames on emulated cores, and draws time against "
            "error here.");
        free(p);
        return SIM_OK;
    }
    double lo, hi;
    range(page, t, p, n, &lo, &hi);
    status = plot_front(page, t, p, n, lo, hi);
    if (status == SIM_OK)
        status = plot_methods(page, t, p, n);
    if (status == SIM_OK) {
        say_default(page, t, p, n);
        table_front(page, t, p, n);
        status = plot_peers(page, t);
        table_peers(page, t);
    }
    free(p);
    if (status != SIM_OK)
        return status;
    study_table_open(page, "scene|shading|default: M3, M|M0, M|RP2040, M cycles|host, M|wrong %|on the front");
    for (size_t s = 0; s < N_SCENES; s++) {
        const size_t k_n = gather(&p, t, scenes[s].demo->name);
        for (size_t k = 0; k < k_n; k++)
            if (is_default(t, p[k].row))
                study_table_row(page, "%s|%s|%s|%s|%s|%s|%.4f|%s%s", scenes[s].demo->name, scenes[s].shading,
                                millions(p[k].m3), millions(p[k].m0), millions(p[k].rp2040), millions(p[k].host),
                                p[k].error[0], p[k].dominated ? "no: " : "yes",
                                p[k].dominated ? words(t, p[p[k].by].row) : "");
        free(p);
    }
    study_table_close(page, "The default scene by scene, and what dominates it there.");
    return SIM_OK;
}

const struct study study_time = {
    .name = "time", .what = "run time against error",
    .params = "scene,shading,subpixel,mapping,bits,recip_bits,texel_recip,span_bound,method,counted",
    .results = "pixels,wrong,cover,surface,depth_mean,depth_worst,texels_off,texel_worst,colour_off,colour_by_one,psnr,"
               "checksum,"
               "m3,m0,rp2040,host",
    .runs = plan, .describe = describe, .measure = measure, .report = report,
    .settings = settings,
};
