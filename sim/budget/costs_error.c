/* How far the estimate is from what frames take: of scenes that the fit has not seen.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "costs.h"
#include "frame.h"
#include "method_names.h"
#include "scenes.h"
#include "sim.h"
#include "sizes.h"

#define LINES_MAX 512

struct line {
    enum sim_core core;
    const struct sim_method *method; /* of a line of methods.txt; NULL: of bench.txt */
    char scene[32];
    double taken, estimate;
};

static const struct demo *demo_named(const char *name)
{
    for (uint32_t i = 0; i < n_demos; i++)
        if (strcmp(demos[i]->name, name) == 0)
            return demos[i];
    return NULL;
}

static uint16_t pool(uint32_t n)
{
    return (uint16_t)(n < ZS_POOL_MAX ? n : ZS_POOL_MAX);
}

/* Pools of a one-pass frame, as firmware/app/bench.c and methods.c find them. */
static int one_pass(struct zs_config *c, const struct demo_frame *f)
{
    struct sim_frame frame;
    uint32_t tris = 256, verts = 256;
    for (uint32_t i = 0; i < f->scene.n_instances; i++) {
        tris += f->scene.instance[i].mesh->n_tris;
        verts += f->scene.instance[i].mesh->n_verts;
    }
    c->max_tris = pool(tris);
    c->max_verts = pool(verts);
    int err = sim_frame_render(&frame, &f->scene, &f->camera, c, NULL);
    struct zs_stats s = frame.stats;
    sim_frame_free(&frame);
    c->max_tris = pool(s.max_tris_used);
    for (uint32_t v = s.max_verts_used; !err && v < verts; v += v / 16u + 1u) {
        c->max_verts = pool(v < 3u ? 3u : v);
        err = sim_frame_render(&frame, &f->scene, &f->camera, c, NULL);
        s = frame.stats;
        sim_frame_free(&frame);
        if (err || s.passes == 1u)
            return err;
    }
    c->max_tris = pool(tris);
    c->max_verts = pool(verts);
    return err;
}

/* Frame 0 in strips of 24 rows and pools that just take it, as make bench draws it. */
static int count_bench(struct sim_counted *out, const struct demo *d)
{
    struct demo_frame *f = sim_alloc(1, sizeof *f);
    struct zs_config c;
    sim_frame_config(&c, d->width, d->height, (uint8_t)d->varyings);
    c.strip_h = 24;
    c.buffers = 1;
    c.depth = d->depth;
    d->pose(f, 0, d->width, d->height);
    int err = one_pass(&c, f);
    if (!err)
        err = sim_costs_count(out, &f->scene, &f->camera, &c);
    free(f);
    return err ? sim_refuse(d->name, 0, "cannot be counted (%d)", err) : SIM_OK;
}

#define PICO_ARENA 180000u /* bytes, of tests/lab/methods.sh on the RP2040; others have enough */

/* The largest pools up to these that an arena holds, as firmware/app/methods.c finds them. */
static void method_pools(struct zs_config *c, const struct sim_method *m, uint32_t tris, uint32_t verts, uint32_t bytes)
{
    do {
        c->max_tris = pool(tris);
        c->max_verts = pool(verts);
        sim_method_apply(c, m);
        tris = tris * 7u / 8u;
        verts = verts * 7u / 8u;
    } while (zs_arena_bytes(c) > bytes && tris > 4u);
}

/* Frame 0 by a method, as firmware/app/methods.c draws it. */
static int count_method(struct sim_counted *out, const struct demo *d, const struct sim_method *m, enum sim_core core)
{
    const uint32_t bytes = core == SIM_CORE_RP2040 ? PICO_ARENA : UINT32_MAX;
    struct demo_frame *f = sim_alloc(1, sizeof *f);
    struct zs_config c;
    struct sim_frame frame;
    sim_frame_config(&c, d->width, d->height, (uint8_t)d->varyings);
    c.strip_h = 24;
    c.buffers = 1;
    c.depth = d->depth;
    c.fast = d->fast;
    d->pose(f, 0, d->width, d->height);
    method_pools(&c, m, 10000, 30000, bytes);
    int err = sim_frame_render(&frame, &f->scene, &f->camera, &c, NULL);
    if (!err) {
        const struct zs_stats s = frame.stats;
        sim_frame_free(&frame);
        method_pools(&c, m, m->records ? s.max_tris_used * 5 / 2 + 64 : s.max_tris_used, s.max_verts_used, bytes);
        err = sim_costs_count(out, &f->scene, &f->camera, &c);
    }
    free(f);
    return err ? sim_refuse(d->name, 0, "cannot be counted by %s (%d)", m->name, err) : SIM_OK;
}

/* The mean of frames 26 and 39 as the Pico's image draws them, which tests/boards/pico.sh measures. */
static int count_pico(struct sim_counted *out, const struct demo *d)
{
#define SIZE(name) { #name, { SIZES_##name } }
    static const struct {
        const char *name;
        uint16_t size[5]; /* rate, rows, triangles, vertices, words */
    } sizes[] = { SIZE(teapot), SIZE(china), SIZE(cubes), SIZE(knot), SIZE(flyover), SIZE(city), SIZE(hall),
        SIZE(globe) };
    struct demo_frame *f = sim_alloc(1, sizeof *f);
    struct sim_counted one;
    struct zs_config c;
    int err = ZS_OK, known = 0;
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        if (strcmp(sizes[i].name, d->name) == 0) {
            sim_frame_config(&c, 240, 240, (uint8_t)sizes[i].size[4]);
            c.strip_h = sizes[i].size[1];
            c.max_tris = sizes[i].size[2];
            c.max_verts = sizes[i].size[3];
            known = 1;
        }
    c.depth = d->depth;
    for (uint32_t t = 26; known && !err && t <= 39; t += 13) {
        d->pose(f, t, 240, 240);
        err = sim_costs_count(&one, &f->scene, &f->camera, &c);
        for (int k = 0; k < SIM_COST_N; k++)
            out->n[k] += one.n[k] / 2.0;
    }
    free(f);
    return known && !err ? SIM_OK : sim_refuse(d->name, 0, "cannot be counted as the Pico draws it (%d)", err);
}

int sim_costs_scene(const char *name)
{
    static const char core_of[] = { SIM_CORE_M0, SIM_CORE_M3, SIM_CORE_RP2040 };
    const struct demo *d = demo_named(name);
    struct sim_counted counted;
    double sum[sizeof core_of] = { 0 };
    if (!d)
        return sim_refuse(name, 0, "is no demo or bench scene; zsim demo --help says which there are");
    const int status = count_bench(&counted, d);
    if (status != SIM_OK)
        return status;
    for (size_t c = 0; c < sizeof core_of; c++)
        sum[c] = sim_costs_sum((enum sim_core)core_of[c], &counted);
    printf("%-9s %9s", "stage", "how often");
    for (size_t c = 0; c < sizeof core_of; c++)
        printf(" %9s %5s", sim_core_names[(int)core_of[c]], "%");
    puts("  of one");
    for (int k = 0; k < SIM_COST_N; k++) {
        if (counted.n[k] == 0.0)
            continue;
        printf("%-9s %9.0f", sim_cost_names[k].stage, counted.n[k]);
        for (size_t c = 0; c < sizeof core_of; c++) {
            const double cost = counted.n[k] * sim_cost_of((enum sim_core)core_of[c], (enum sim_cost)k);
            printf(" %9.0f %5.1f", cost, 100.0 * cost / sum[c]);
        }
        printf("  %s\n", sim_cost_names[k].what);
    }
    printf("%-9s %9s", "together", "");
    for (size_t c = 0; c < sizeof core_of; c++)
        printf(" %9.0f %5s", sum[c], "");
    puts("");
    return SIM_OK;
}

static int core_named(const char *name)
{
    for (int c = 0; c < SIM_CORES; c++)
        if (strcmp(sim_core_names[c], name) == 0)
            return c;
    return -1;
}

static const struct sim_method *method_named(const char *name)
{
    for (size_t k = 0; k < SIM_METHODS; k++)
        if (strcmp(sim_methods[k].name, name) == 0)
            return &sim_methods[k];
    return NULL;
}

static int read_lines(struct line *lines, size_t *n, const char *file)
{
    char text[256], core[16], method[32], scene[32];
    double taken;
    FILE *f = fopen(file, "r");
    if (!f)
        return sim_refuse(file, 0,
                          "cannot be read; give tests/records/bench.txt, or lines of core, scene and number");
    *n = 0;
    while (fgets(text, sizeof text, f)) {
        const int by_method = sscanf(text, "%15s %31s %31s %lf", core, method, scene, &taken) == 4;
        if (text[0] == '#' || (!by_method && sscanf(text, "%15s %31s %lf", core, scene, &taken) != 3) ||
            core_named(core) < 0 || (by_method && !method_named(method)) || *n == LINES_MAX)
            continue;
        struct line *l = &lines[(*n)++];
        l->core = (enum sim_core)core_named(core);
        l->method = by_method ? method_named(method) : NULL;
        memcpy(l->scene, scene, sizeof scene);
        l->taken = taken;
    }
    (void)fclose(f);
    return *n ? SIM_OK : sim_refuse(file, 0, "holds no line of core, scene and what its frame took");
}

static const struct line *find(const struct line *lines, size_t n, enum sim_core core, const struct sim_method *method,
                               const char *scene)
{
    for (size_t i = 0; i < n; i++)
        if (lines[i].core == core && lines[i].method == method && strcmp(lines[i].scene, scene) == 0)
            return &lines[i];
    return NULL;
}

/* A row of the table, where a line of the scene is known. */
static void print_row(const struct line *lines, size_t n, const struct sim_method *method, const char *scene)
{
    int known = 0;
    for (int c = 0; c < SIM_CORES; c++)
        known |= find(lines, n, (enum sim_core)c, method, scene) != NULL;
    if (!known && method)
        return;
    printf("%-16s", scene);
    for (int c = 0; c < SIM_CORES; c++) {
        const struct line *l = find(lines, n, (enum sim_core)c, method, scene);
        if (l)
            printf(" %+8.1f", 100.0 * (l->estimate / l->taken - 1.0));
        else
            printf(" %8s", "-");
    }
    printf("%s%s\n", method ? "  " : "", method ? method->name : "");
}

static void print_table(const struct line *lines, size_t n, double bar)
{
    int plain = 0;
    for (size_t i = 0; i < n; i++)
        plain |= !lines[i].method;
    printf("%-16s", "scene");
    for (int c = 0; c < SIM_CORES; c++)
        printf(" %8s", sim_core_names[c]);
    puts("  estimate against what the frame took, %");
    for (uint32_t i = 0; i < n_demos; i++) {
        if (plain)
            print_row(lines, n, NULL, demos[i]->name);
        for (size_t k = 0; k < SIM_METHODS; k++)
            print_row(lines, n, &sim_methods[k], demos[i]->name);
    }
    for (int c = 0; c < SIM_CORES; c++) {
        double square = 0.0, worst = 0.0;
        size_t count = 0;
        for (size_t i = 0; i < n; i++)
            if (lines[i].core == (enum sim_core)c) {
                const double off = 100.0 * (lines[i].estimate / lines[i].taken - 1.0);
                square += off * off;
                worst = fabs(off) > fabs(worst) ? off : worst;
                count++;
            }
        if (count)
            printf("%-8s %2zu scenes, none of them in the fit: off by %.1f %% (root mean square), at most %+.1f %%%s\n",
                   sim_core_names[c], count, sqrt(square / (double)count), worst, fabs(worst) <= bar ? "" :
                       ": too far");
    }
}

/* Read the lines, and estimate each. */
static int estimate(struct line *lines, size_t *n, const char *file)
{
    struct sim_counted counted;
    int status = read_lines(lines, n, file);
    for (size_t i = 0; status == SIM_OK && i < *n; i++) {
        const struct demo *d = demo_named(lines[i].scene);
        sim_progress("counting", i, *n);
        if (!d) {
            status = sim_refuse(file, 0, "%s is no scene of this zsim", lines[i].scene);
            break;
        }
        status = lines[i].method                    ? count_method(&counted, d, lines[i].method, lines[i].core)
                 : lines[i].core == SIM_CORE_RP2040 ? count_pico(&counted, d)
                                                    : count_bench(&counted, d);
        if (status == SIM_OK)
            lines[i].estimate = sim_costs_sum(lines[i].core, &counted);
    }
    sim_progress_end();
    return status;
}

static double off_by(const struct line *l)
{
    return 100.0 * fabs(l->estimate / l->taken - 1.0);
}

int sim_costs_worst(const char *file, double worst[SIM_CORES], double *of_methods)
{
    struct line *lines = sim_alloc(LINES_MAX, sizeof *lines);
    char seen[SIM_CORES] = { 0 }, seen_method = 0;
    size_t n = 0;
    const int status = estimate(lines, &n, file);
    for (size_t i = 0; status == SIM_OK && i < n; i++) {
        const enum sim_core c = lines[i].core;
        if (lines[i].method) {
            if (lines[i].method->method) {
                *of_methods = seen_method ? fmax(*of_methods, off_by(&lines[i])) : off_by(&lines[i]);
                seen_method = 1;
            }
            continue;
        }
        worst[c] = seen[c] ? fmax(worst[c], off_by(&lines[i])) : off_by(&lines[i]);
        seen[c] = 1;
    }
    free(lines);
    return status;
}

int sim_costs_error(const char *file, double bar)
{
    struct line *lines = sim_alloc(LINES_MAX, sizeof *lines);
    size_t n = 0;
    int far = 0;
    const int status = estimate(lines, &n, file);
    for (size_t i = 0; status == SIM_OK && i < n; i++)
        far |= off_by(&lines[i]) > bar;
    if (status == SIM_OK)
        print_table(lines, n, bar);
    free(lines);
    return status == SIM_OK && far ? SIM_REFUSED : status;
}
