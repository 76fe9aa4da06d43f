/* zsim study memory: strip height, pools and formats against bytes, passes and time. A run is frame 0 of a demo scene.
 * Pools are in percent of what the scene fills when it is taken in one pass. Time is instructions from boards
 * (--counts); without them plots have the vertices that were transformed in their place.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "scenes.h"
#include "sim.h"
#include "study_measure.h"

static const struct {
    const struct demo *demo;
    const char *format; /* what its attributes are for */
} scenes[] = {
    { &demo_teapot, "smooth" }, { &demo_city, "flat" }, { &demo_hall, "texture smooth" }, { &demo_mesh_tex, "texture" }
};
#define N_SCENES (sizeof scenes / sizeof scenes[0])

static struct run {
    int scene, rows, percent, buffers;
} *runs;
static size_t n_runs;
static struct {
    uint32_t tris, verts; /* for one pass */
} whole[N_SCENES];

static void add(int scene, int rows, int percent, int buffers)
{
    runs = sim_grow(runs, n_runs + 1, sizeof *runs);
    runs[n_runs++] = (struct run){ scene, rows, percent, buffers };
}

static void find_whole(int s)
{
    const struct demo *d = scenes[s].demo;
    struct demo_frame scene;
    struct zs_config config;
    struct sim_frame frame;
    sim_frame_config(&config, d->width, d->height, (uint8_t)d->varyings);
    config.depth = d->depth;
    d->pose(&scene, 0, d->width, d->height);
    if (sim_frame_render(&frame, &scene.scene, &scene.camera, &config, NULL) != ZS_OK)
        return; /* measure says so */
    whole[s].tris = frame.stats.max_tris_used;
    whole[s].verts = frame.stats.max_verts_used + 8;
    sim_frame_free(&frame);
}

static size_t plan(enum study_effort effort)
{
    static const int rows[] = { 1, 2, 4, 8, 16, 24, 40, 60, 120, 240 }, percent[] = { 100, 75, 50, 35, 25, 15, 10, 5 };
    const int scenes_n = effort == STUDY_QUICK ? 1 : effort == STUDY_USUAL ? 3 : (int)N_SCENES;
    n_runs = 0;
    for (int s = 0; s < scenes_n; s++) {
        find_whole(s);
        for (size_t r = effort == STUDY_FULL ? 0 : 2; r < sizeof rows / sizeof rows[0]; r++) {
            if (effort == STUDY_QUICK && r % 3)
                continue;
            for (size_t p = 0; p < sizeof percent / sizeof percent[0]; p++)
                if (effort == STUDY_FULL || (effort == STUDY_QUICK ? p % 4 == 0 : p % 2 == 0 || p == 7))
                    add(s, rows[r], percent[p], 1);
            add(s, rows[r], 100, 2);
        }
    }
    return n_runs;
}

static void configure(struct zs_config *config, const struct run *r)
{
    const struct demo *d = scenes[r->scene].demo;
    const uint32_t tris = whole[r->scene].tris * (uint32_t)r->percent / 100;
    const uint32_t verts = whole[r->scene].verts * (uint32_t)r->percent / 100;
    sim_frame_config(config, d->width, d->height, (uint8_t)d->varyings);
    config->strip_h = (uint16_t)r->rows;
    config->max_tris = (uint16_t)(tris < 1 ? 1 : tris);
    config->max_verts = (uint16_t)(verts < 3 ? 3 : verts);
    config->buffers = (uint8_t)r->buffers;
    config->depth = d->depth;
}

static void describe(size_t i, struct study_text *row)
{
    const struct run *r = &runs[i];
    struct zs_config config;
    configure(&config, r);
    study_put(row, "%s", scenes[r->scene].demo->name);
    study_put(row, "%s", scenes[r->scene].format);
    study_put(row, "%d", config.varyings);
    study_put(row, "%d", r->rows);
    study_put(row, "%d", r->percent);
    study_put(row, "%u", config.max_tris);
    study_put(row, "%u", config.max_verts);
    study_put(row, "%d", r->buffers);
    study_put(row, "%s", study_cores());
}

static int measure(size_t i, struct study_text *row)
{
    const struct run *r = &runs[i];
    const struct demo *d = scenes[r->scene].demo;
    struct demo_frame scene;
    struct zs_config c;
    struct sim_frame f;
    unsigned long long counted = 0;
    configure(&c, r);
    d->pose(&scene, 0, d->width, d->height);
    const int err = sim_frame_render(&f, &scene.scene, &scene.camera, &c, NULL);
    if (err)
        return sim_refuse(d->name, 0, "could not be drawn: %s", zs_error_string(err));
    const uint64_t checksum = study_checksum(f.rgb565, (size_t)c.width * c.height);
    study_put(row, "%u", f.arena_bytes);
    study_put(row, "%u", (unsigned)ZS_COLOR_BYTES(c.width, c.strip_h, c.buffers));
    study_put(row, "%u", (unsigned)(ZS_DEPTH_BYTES(c.width, c.strip_h) + ZS_DRAWN_BYTES(c.strip_h) +
                                    ZS_BOUND_BYTES(c.width, c.height, c.strip_h)));
    study_put(row, "%u", (unsigned)(ZS_TRI_BYTES(c.max_tris) + ZS_BIN_BYTES(c.height, c.strip_h)));
    study_put(row, "%u", (unsigned)ZS_VERT_BYTES(c.max_verts, c.varyings));
    study_put(row, "%u", f.stats.passes);
    study_put(row, "%u", f.stats.verts_transformed);
    study_put(row, "%u", f.stats.tris_setup);
    study_put(row, "%u", f.stats.pixels_tested);
    study_put(row, "%016llx", (unsigned long long)checksum);
    sim_frame_free(&f);
    static const char *const core[] = { "m3", "m0" };
    for (int k = 0; k < 2; k++) {
        const unsigned long long n = study_counted(core[k], i, &counted);
        if (n && counted != checksum)
            return sim_refuse(NULL, 0,
                              "run %zu: the frame that was counted on %s (%016llx) is not this zsim's (%016llx); "
                              "count again with its --settings",
                              i, core[k], counted, (unsigned long long)checksum);
        if (n)
            study_put(row, "%llu", n);
        else
            study_skip(row, 1);
    }
    return SIM_OK;
}

static void settings(size_t i, FILE *out)
{
    const struct run *r = &runs[i];
    struct zs_config c;
    configure(&c, r);
    const char *mapping = "float";
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        if (study_mapping[m].depth == c.depth)
            mapping = study_mapping[m].name;
    (void)fprintf(out, "{ %zu, &demo_%s, %u, %u, %u, %u, 8, 16, &zs_depth_%s, 0, 1, 10, 2 },\n", i,
                  scenes[r->scene].demo->name, c.strip_h, c.max_tris, c.max_verts, c.buffers, mapping);
}

/* ---- What follows ------------------------------------------------------------------------------------------------ */

/* Millions of instructions on the M3, or thousands of vertices where they were not counted. */
static double time_of(const struct study_table *t, size_t r)
{
    const double m3 = study_number(t, r, "m3");
    return isnan(m3) ? study_number(t, r, "verts") / 1e3 : m3 / 1e6;
}

static const char *time_name(const struct study_table *t)
{
    return isnan(study_number(t, 0, "m3")) ? "thousand vertices transformed a frame"
                                           : "M instructions a frame, Cortex-M3";
}

/* The least arena of a scene whose time is within 10 % of its quickest run's. n_rows: the scene was not run. */
static size_t knee(const struct study_table *t, const char *scene)
{
    double quickest = INFINITY;
    size_t best = t->n_rows;
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "scene", scene) && study_is(t, r, "buffers", "1"))
            quickest = fmin(quickest, time_of(t, r));
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "scene", scene) && study_is(t, r, "buffers", "1") && time_of(t, r) <= 1.1 * quickest &&
            (best == t->n_rows || study_number(t, r, "arena") < study_number(t, best, "arena")))
            best = r;
    return best;
}

/* A line for each strip height, a point for each size of the pools. */
static int plot_scene(struct study_page *page, const struct study_table *t, const char *scene)
{
    double last = -1;
    int n = 0;
    const size_t at = knee(t, scene);
    FILE *f = study_plot_open(page, scene, 860, 440);
    char caption[256];
    if (!f)
        return SIM_REFUSED;
    for (size_t r = 0; r < t->n_rows; r++) {
        if (!study_is(t, r, "scene", scene) || !study_is(t, r, "buffers", "1"))
            continue;
        const double rows = study_number(t, r, "strip_h");
        if (rows != last)
            (void)fprintf(f, "%s$rows%d << EOD\n", n ? "EOD\n" : "", n), n++;
        last = rows;
        (void)fprintf(f, "%.6g\t%.6g\t%g\n", study_number(t, r, "arena") / 1024, time_of(t, r), rows);
    }
    (void)fprintf(
        f,
        "EOD\nset logscale xy\nset xlabel 'arena, KB'\nset ylabel '%s'\nset key title 'rows of a strip'\n"
        "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#d0c000')\nunset colorbox\n"
        "set xtics (4,8,16,32,64,128,256)\nset ytics (1,2,3,5,10,20,30,50,100,200,500,1000)\nplot ",
        time_name(t));
    for (int k = 0; k < n; k++)
        (void)fprintf(f,
                      "$rows%d with linespoints pt 7 ps 0.5 lw 1.5 lc palette frac %g title sprintf('%%d', "
                      "word($rows%d[1], 3) + 0), ",
                      k, n > 1 ? k / (n - 1.0) : 0, k);
    (void)fprintf(f, "'-' with points pt 6 ps 2 lw 2 lc rgb '#d62728' title 'knee'\n%.6g\t%.6g\ne\n",
                  study_number(t, at, "arena") / 1024, time_of(t, at));
    (void)snprintf(caption, sizeof caption,
                   "Scene %s: a line for each strip height; along it, pools from 5 to 100 %% of one pass. "
                   "Ring: the least arena within 10 %% of the quickest.",
                   scene);
    return study_plot_close(page, caption);
}

/* Pools of all sizes at the knee's strip height. */
static void table_pools(struct study_page *page, const struct study_table *t)
{
    study_table_open(page, "scene|rows|pools, %|triangles|vertices|arena|passes|vertices transformed|set-ups|time");
    for (size_t s = 0; s < N_SCENES; s++) {
        const size_t at = knee(t, scenes[s].demo->name);
        for (size_t r = 0; at < t->n_rows && r < t->n_rows; r++)
            if (study_is(t, r, "scene", scenes[s].demo->name) && study_is(t, r, "buffers", "1") &&
                study_is(t, r, "strip_h", study_cell(t, at, "strip_h")))
                study_table_row(page, "%s|%s|%s|%s|%s|%s|%s|%s|%s|%.3f%s", scenes[s].demo->name,
                                study_cell(t, r, "strip_h"), study_cell(t, r, "pools"), study_cell(t, r, "max_tris"),
                                study_cell(t, r, "max_verts"), study_cell(t, r, "arena"), study_cell(t, r, "passes"),
                                study_cell(t, r, "verts"), study_cell(t, r, "setups"), time_of(t, r),
                                r == at ? " knee" : "");
    }
    study_table_close(page, "What smaller pools cost: passes, and in them vertices that are transformed again.");
}

static int picture(struct study_page *page, const struct study_table *t)
{
    const size_t worst = study_most(t, "passes");
    char caption[256];
    const struct demo *d = scenes[runs[worst].scene].demo;
    struct demo_frame scene;
    struct zs_config config;
    struct sim_frame f;
    configure(&config, &runs[worst]);
    d->pose(&scene, 0, d->width, d->height);
    if (sim_frame_render(&f, &scene.scene, &scene.camera, &config, NULL) != ZS_OK)
        return sim_refuse(d->name, 0, "could not be drawn");
    uint8_t *rgb = sim_alloc((size_t)d->width * d->height, 3);
    study_sheet_put(rgb, d->width, 0, 0, f.rgb565, NULL, d->width, d->height);
    sim_frame_free(&f);
    (void)snprintf(caption, sizeof caption,
                   "The worst case: %s in strips of %s rows and %s %% of the pools, %s passes, %s bytes. Less "
                   "memory costs time, and no pixel.",
                   d->name, study_cell(t, worst, "strip_h"), study_cell(t, worst, "pools"),
                   study_cell(t, worst, "passes"), study_cell(t, worst, "arena"));
    const int status = study_picture(page, "worst", d->width, d->height, rgb, caption);
    free(rgb);
    return status;
}

/* Rows whose frame is not their scene's first row's. */
static size_t count_other_frames(const struct study_table *t)
{
    size_t other = 0;
    for (size_t r = 0; r < t->n_rows; r++)
        for (size_t k = 0; k < r; k++)
            if (study_is(t, k, "scene", study_cell(t, r, "scene"))) {
                other += !study_is(t, k, "checksum", study_cell(t, r, "checksum"));
                break;
            }
    return other;
}

static int report(struct study_page *page, const struct study_table *t)
{
    int status = SIM_OK;
    study_say(page,
              "Varied: rows of a strip, the pools of triangles and vertices in percent of what one pass takes, vertex "
              "formats "
              "(a scene for each) and strip buffers. Of %zu frames, %zu differ from the others of their scene.",
              t->n_rows, count_other_frames(t));
    for (size_t s = 0; s < N_SCENES && status == SIM_OK; s++)
        if (knee(t, scenes[s].demo->name) < t->n_rows)
            status = plot_scene(page, t, scenes[s].demo->name);
    if (status != SIM_OK)
        return status;
    study_table_open(
        page, "scene, knee|rows|pools, %|triangles|vertices|words a vertex|arena|of it colour|depth|triangles|vertices|"
              "passes|time");
    for (size_t s = 0; s < N_SCENES; s++) {
        const size_t r = knee(t, scenes[s].demo->name);
        if (r == t->n_rows)
            continue;
        study_table_row(page, "%s (%s)|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s|%.3f", scenes[s].demo->name, scenes[s].format,
                        study_cell(t, r, "strip_h"), study_cell(t, r, "pools"), study_cell(t, r, "max_tris"),
                        study_cell(t, r, "max_verts"), study_cell(t, r, "attrs"), study_cell(t, r, "arena"),
                        study_cell(t, r, "colour"), study_cell(t, r, "depth"), study_cell(t, r, "triangles"),
                        study_cell(t, r, "vertices"), study_cell(t, r, "passes"), time_of(t, r));
    }
    char caption[256];
    (void)snprintf(caption, sizeof caption,
                   "The least arena within 10 %% of the quickest run, one buffer; bytes, and %s. A second "
                   "buffer adds width x rows x 2 bytes.",
                   time_name(t));
    study_table_close(page, caption);
    for (size_t s = 0; s < N_SCENES; s++) {
        const size_t k = knee(t, scenes[s].demo->name);
        size_t most = k;
        for (size_t r = 0; k < t->n_rows && r < t->n_rows; r++)
            if (study_is(t, r, "scene", scenes[s].demo->name) && study_is(t, r, "buffers", "1") &&
                study_number(t, r, "arena") < study_number(t, most, "arena"))
                most = r;
        if (k < t->n_rows)
            study_say(
                page,
                "%s: %s bytes are within 10 %% of the quickest; the least tried, %s bytes, take %.1f times as long and "
                "%s passes.",
                scenes[s].demo->name, study_cell(t, k, "arena"), study_cell(t, most, "arena"),
                time_of(t, most) / time_of(t, k), study_cell(t, most, "passes"));
    }
    table_pools(page, t);
    return picture(page, t);
}

const struct study study_memory = {
    .name = "memory", .what = "strip height, pools and formats: bytes, passes, time",
    .params = "scene,format,attrs,strip_h,pools,max_tris,max_verts,buffers,counted",
    .results = "arena,colour,depth,triangles,vertices,passes,verts,setups,tested,checksum,m3,m0",
    .runs = plan, .describe = describe, .measure = measure, .report = report,
    .settings = settings,
};
