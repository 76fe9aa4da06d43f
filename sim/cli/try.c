/* Load, choose, draw all around, count, write. Files come last.
 *
 * SPDX-License-Identifier: MIT
 */
#include "try.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "budget.h"
#include "image.h"
#include "load_options.h"
#include "moving_picture.h"
#include "option_help.h"
#include "option_table.h"
#include "output_file.h"
#include "render.h"
#include "scene_parts.h"
#include "sim.h"
#include "simplify.h"
#include "turntable.h"

#define SHEET_COLUMNS 4u
#define SHEET_VIEWS 8u
#define N_FILES 3 /* the third with --gif */
#define PROBES 4u /* views by which culling is chosen and time is counted */
#define OPEN_SHARE                                                                                 \
    0.005 /* of the pixels covered: as many that only back sides cover are not missed */

struct request {
    struct sim_options o; /* model, size, up, texture, limits; the rest is chosen */
    const char *out;
    long frames;
    int has_up, gif, help;
};

#define AT(field) offsetof(struct request, field)

static const struct sim_option table[] = {
    { "--out", SIM_OPTION_PATH, AT(out), .value = "DIR",
      .help = "the folder of turntable.png and sheet.png, made if there is none (build/try)" },
    { "--gif", SIM_OPTION_FLAG, AT(gif), .help = "turntable.gif, too, in 256 colours" },
    { "--size", SIM_OPTION_SIZE, AT(o.size), AT(o.has_size), 16, 1024,
      .help = "px of a view, {range} (240x240)" },
    { "--frames", SIM_OPTION_COUNT, AT(frames), 0, 1, SIM_TURNTABLE_MAX,
      .help = "views of a turn, {range} (36)" },
    { "--up", SIM_OPTION_VECTOR, AT(o.up), AT(has_up), .help = "what is up (0,1,0; of STL 0,0,1)" },
    { "--texture", SIM_OPTION_FILE, AT(o.texture), .value = "T.png",
      .help = "this picture for all faces, in place of the model's own" },
    SIM_SIMPLIFY_OPTION(struct request, o.simplify, 0),
    SIM_LOAD_OPTIONS(struct request, o.limits),
    { "Else", SIM_OPTION_HEADING },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim try MODEL [options]",
    "Shows a model (OBJ, PLY, STL, glTF and what else assimp reads) as a board would draw it, all "
    "the way around: "
    "DIR/turntable.png, an animated PNG, and DIR/sheet.png, eight views. Camera, shading, sides, "
    "light, background and "
    "memory are chosen. Prints what it takes on a few boards.",
    "Exit status: 0 done; 1 refused, nothing written; 2 the command line makes no sense.",
};

/* ---- Choices --------------------------------------------------------------------------------- */

static int is_stl(const char *file)
{
    const size_t n = strlen(file);
    return n >= 4 && strcasecmp(file + n - 4, ".stl") == 0;
}

static const char *shade_name(enum sim_shade shade)
{
    return shade == SIM_SHADE_TEXTURED        ? "textured"
           : shade == SIM_SHADE_TEXTURED_FLAT ? "textured-flat"
           : shade == SIM_SHADE_SMOOTH        ? "smooth"
                                              : "flat";
}

/* What is seen from PROBES sides by one choice of culling, before black. */
static int probe(struct sim_moving *m, const struct sim_options *o, const struct sim_model *model,
                 enum zs_cull cull)
{
    struct sim_options with = *o;
    with.cull = cull;
    with.background = (struct zs_rgb){ 0, 0, 0 };
    return sim_turntable_draw(m, NULL, &with, model, PROBES);
}

static double luminance(const uint8_t *rgb)
{
    return 0.3 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2];
}

/* Both sides, where front sides alone leave holes; and a background that the model stands out from. */
static int choose_look(struct sim_options *o, const struct sim_model *model)
{
    struct sim_moving all = { 0 }, front = { 0 };
    size_t covered = 0, differ = 0;
    double sum = 0.0;
    int status = probe(&all, o, model, ZS_CULL_NONE);
    if (status == SIM_OK)
        status = probe(&front, o, model, ZS_CULL_BACK);
    for (uint32_t k = 0; status == SIM_OK && k < PROBES; k++)
        for (size_t i = 0; i < (size_t)all.width * all.height; i++) {
            const uint8_t *a = all.frame[k] + 3 * i;
            covered += (a[0] | a[1] | a[2]) != 0;
            differ += memcmp(a, front.frame[k] + 3 * i, 3) != 0;
            sum += luminance(a);
        }
    o->cull = (double)differ > OPEN_SHARE * (double)covered ? ZS_CULL_NONE : ZS_CULL_BACK;
    o->background = sum < 105.0 * (double)covered ? (struct zs_rgb){ 222, 227, 233 }
                                                  : (struct zs_rgb){ 38, 49, 66 };
    sim_turntable_free(&all);
    sim_turntable_free(&front);
    return status;
}

/* ---- Figures --------------------------------------------------------------------------------- */

struct figures {
    struct budget worst;    /* of the view that takes the most pools */
    double cycles[BUDGET_USUAL_PARTS]; /* of the slowest view */
    uint32_t ram;
    uint32_t left_out; /* triangles without an area */
};

static int count(struct figures *f, const struct sim_options *o, const struct sim_model *model)
{
    static struct budget_request rq;
    struct sim_kept_scene kept = { 0 };
    int status = SIM_OK;
    memset(f, 0, sizeof *f);
    budget_defaults(&rq);
    rq.kept = &kept;
    rq.quiet = 1;
    for (uint32_t k = 0; status == SIM_OK && k < PROBES; k++) {
        struct budget b;
        status = sim_turntable_view(&rq.o, o, model, k, PROBES);
        if (status == SIM_OK)
            status = budget_model(&b, &rq, model);
        if (status == SIM_OK)
            status = budget_take(&b, &rq);
        if (status != SIM_OK)
            break;
        for (size_t i = 0; i < BUDGET_USUAL_PARTS; i++)
            f->cycles[i] = fmax(f->cycles[i],
                                budget_cycles(&rq, &b, budget_part_named(budget_usual_parts[i])->core));
        if (b.ram.total[BUDGET_M3] > f->ram) {
            f->ram = b.ram.total[BUDGET_M3];
            f->worst = b;
        }
        sim_progress("counting", k, PROBES);
    }
    f->left_out = model->n_tris;
    for (uint32_t i = 0; status == SIM_OK && i < kept.scene.n_parts; i++)
        f->left_out -= kept.scene.instance[i].mesh->n_tris;
    sim_kept_free(&kept);
    return status;
}

static const char *plural(uint32_t n)
{
    return n == 1 ? "" : "s";
}

/* The materials that triangles name: a file may have more, and its loader adds one. */
static uint32_t materials_used(const struct sim_model *model)
{
    uint8_t *used = sim_alloc(model->n_materials, 1);
    uint32_t n = 0;
    for (uint32_t t = 0; t < model->n_tris; t++) {
        n += !used[model->tri_material[t]];
        used[model->tri_material[t]] = 1;
    }
    free(used);
    return n;
}

static void print(const struct request *rq, const struct sim_model *model, const struct figures *f,
                  const struct sim_lost *lost)
{
    const struct budget *b = &f->worst;
    const struct zs_config *c = &b->config;
    const uint32_t materials = materials_used(model);
    printf("%s: %u triangle%s, %u point%s, %u material%s, %u texture%s\n", rq->o.model,
           model->n_tris, plural(model->n_tris), model->n_points, plural(model->n_points), materials,
           plural(materials), model->n_textures, plural(model->n_textures));
    sim_simplify_print(stdout, "  ", model);
    if (model->lost_materials != NULL)
        printf("  not used: material file %s, which cannot be read\n", model->lost_materials);
    if (f->left_out > 0)
        printf("  not used: %u triangle%s without an area\n", f->left_out, plural(f->left_out));
    sim_losses_print(stdout, "  ", lost);
    printf("  shading        %s, %s\n", shade_name(rq->o.shade),
           rq->o.cull == ZS_CULL_NONE ? "both sides of faces, since some are seen from behind"
                                      : "front sides of faces");
    printf("  frame          %ux%u in strips of %u rows, two buffers, up to %u triangles and %u "
           "vertices at a time\n",
           c->width, c->height, c->strip_h, c->max_tris, c->max_verts);
    printf("  RAM            %9u bytes\n", f->ram);
    printf("  flash          %9u bytes of scene data, %u of renderer (Cortex-M3)\n", b->data,
           b->flash[BUDGET_M3].zstrip + b->flash[BUDGET_M3].library);
    for (size_t i = 0; i < BUDGET_USUAL_PARTS; i++) {
        const struct budget_part *p = budget_part_named(budget_usual_parts[i]);
        const enum budget_cpu cpu = budget_cpu_of(p->core);
        const int ram = budget_ram_on(&b->ram, p->core) > p->ram, flash = b->flash[cpu].total > p->flash;
        printf("  %-14s %9.1f frames a second at %.0f MHz, estimated%s%s%s%s\n", p->name,
               1e6 * p->mhz / f->cycles[i], p->mhz, ram || flash ? "; it has too little " : "",
               ram ? "RAM" : "", ram && flash ? " and " : "", flash ? "flash" : "");
    }
    printf("  (drawing the slowest of %u views, without the wire; zsim budget tells more)\n",
           PROBES);
}

/* ---- Files ----------------------------------------------------------------------------------- */

/* Views next to each other. */
static int write_sheet(const struct sim_output *out, const struct sim_moving *m)
{
    const uint32_t rows = (m->n_frames + SHEET_COLUMNS - 1) / SHEET_COLUMNS,
                   width = SHEET_COLUMNS * m->width;
    uint8_t *rgb = sim_alloc((size_t)width * rows * m->height, 3);
    for (uint32_t k = 0; k < m->n_frames; k++)
        for (uint32_t y = 0; y < m->height; y++)
            memcpy(rgb + 3 * ((size_t)(k / SHEET_COLUMNS * m->height + y) * width +
                              k % SHEET_COLUMNS * m->width),
                   m->frame[k] + 3 * (size_t)y * m->width, 3 * (size_t)m->width);
    const int status = sim_png_write(out->file, out->name, width, rows * m->height, rgb);
    free(rgb);
    return status;
}

/* All of them, or none. */
static int save(const struct request *rq, const struct sim_moving *turn,
                const struct sim_moving *sheet)
{
    static const char *const names[N_FILES] = { "turntable.png", "sheet.png", "turntable.gif" };
    const size_t n_files = N_FILES - !rq->gif;
    const int made = access(rq->out, F_OK) != 0;
    char paths[N_FILES][4096];
    struct sim_output out[N_FILES];
    size_t n = 0;
    int status = sim_output_folder(rq->out, 4096 - 64);
    for (size_t i = 0; status == SIM_OK && i < n_files; i++) { /* before the first is written */
        (void)snprintf(paths[i], sizeof paths[i], "%s/%s", rq->out, names[i]);
        status = sim_output_check(paths[i], rq->o.model);
    }
    for (size_t i = 0; status == SIM_OK && i < n_files; i++) {
        status = sim_output_open(&out[n], paths[i]);
        if (status == SIM_OK)
            n++;
        if (status == SIM_OK)
            status = i == 1 ? write_sheet(&out[i], sheet) : sim_moving_write(&out[i], turn);
    }
    status = sim_output_end(status, out, n);
    for (size_t i = 0; status == SIM_OK && i < n_files; i++)
        printf("%s%s", paths[i], i + 1 < n_files ? ", " : "\n");
    if (status != SIM_OK && made)
        (void)rmdir(rq->out);
    return status;
}

/* ---- Command --------------------------------------------------------------------------------- */

static int parse(struct request *rq, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    int only_names = 0, status = SIM_OK;
    sim_options_defaults(&rq->o);
    rq->out = "build/try";
    rq->frames = 36;
    for (int i = 0; status == SIM_OK && i < argc; i++)
        status = !only_names && sim_is_option(argv[i])
                     ? sim_option_take(table, N_TABLE, rq, seen, argc, argv, &i)
                     : sim_model_take(&rq->o.model, argv[i], &only_names);
    if (status != SIM_OK || rq->help)
        return status;
    if (rq->o.model == NULL || rq->o.model[0] == '\0')
        return sim_usage("a model is missing: zsim try MODEL");
    status = sim_simplify_check(rq->o.simplify);
    if (status == SIM_OK)
        status = sim_options_in_range(table, N_TABLE, rq, seen, rq->o.model);
    if (status == SIM_OK && rq->has_up && rq->o.up[0] == 0.0 && rq->o.up[1] == 0.0 &&
        rq->o.up[2] == 0.0)
        status = sim_refuse(rq->o.model, 0, "--up 0,0,0 has no direction; try 0,1,0");
    if (!rq->has_up && is_stl(rq->o.model)) {
        rq->o.up[1] = 0.0;
        rq->o.up[2] = 1.0;
    }
    return status;
}

int sim_try(int argc, char **argv)
{
    struct request rq = { 0 };
    struct sim_model model = { 0 };
    struct sim_moving turn = { 0 }, sheet = { 0 };
    static struct figures figures;
    static struct sim_lost lost[SIM_LOST_KINDS];
    int status = parse(&rq, argc, argv);
    if (status == SIM_OK && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (status == SIM_OK)
        status = sim_scene_load(&model, &rq.o);
    if (status == SIM_OK) {
        sim_turntable_frame(&rq.o, &model);
        status = choose_look(&rq.o, &model);
    }
    if (status == SIM_OK)
        status = sim_turntable_draw(&turn, lost, &rq.o, &model, (uint32_t)rq.frames);
    if (status == SIM_OK)
        status = sim_turntable_draw(&sheet, NULL, &rq.o, &model, SHEET_VIEWS);
    if (status == SIM_OK)
        status = count(&figures, &rq.o, &model);
    sim_progress_end();
    if (status == SIM_OK)
        status = save(&rq, &turn, &sheet);
    if (status == SIM_OK)
        print(&rq, &model, &figures, lost);
    sim_turntable_free(&turn);
    sim_turntable_free(&sheet);
    sim_model_free(&model);
    return status;
}
