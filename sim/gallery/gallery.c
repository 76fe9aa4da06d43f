/* `zsim gallery`: the same scenes by every method, counted, compared with the reference, and put on a page.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gallery.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "costs.h"
#include "false_colors.h"
#include "frame.h"
#include "gallery_page.h"
#include "option_help.h"
#include "option_table.h"
#include "output_file.h"
#include "scenes.h"
#include "sim.h"
#include "reference_frame.h"
#include "write_counts.h"

struct request {
    const char *out, *counts;
    int help;
};

#define AT(field) offsetof(struct request, field)

static const struct sim_option table[] = {
    { "--out", SIM_OPTION_TEXT, AT(out), .value = "DIR", .help = "the folder, made if there is none (build/gallery)" },
    { "--m3", SIM_OPTION_FILE, AT(counts),
      .help = "lines of METHOD,SCENE,INSTRUCTIONS on a Cortex-M3, in place of estimates; make gallery counts them" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim gallery [options]",
    "Draws four scenes by every method of hidden-surface removal and writes one page, DIR/index.html, that needs no "
    "other file: pictures, overdraw in false colours, RAM, fragments, writes, pixels that differ from the "
    "double-precision reference, and when to take which method; lines, points and effects of zsim render.",
    "Exit status: 0 done; 1 refused; 2 the command line makes no sense.",
};

static const struct demo *const scenes[GALLERY_SCENES] = { &demo_cubes, &demo_city, &demo_corridor, &demo_layers_btf };

/* Pixels that do not show the triangle that the reference shows. */
static int count_wrong(uint32_t *wrong, const uint32_t *id, const struct demo_frame *f, const struct zs_config *config)
{
    const struct ref_image ours = { .id = (uint32_t *)id };
    struct sim_reference_frame truth;
    struct ref_diff diff = { 0 };
    int err = sim_reference_frame_draw(&truth, &f->scene, &f->camera, config);
    if (!err)
        err = ref_compare(&ours, &truth.image, &truth.depth, &truth.camera, config->width, config->height, &diff);
    sim_reference_frame_free(&truth);
    *wrong = (uint32_t)(diff.missing + diff.extra + diff.id_differ);
    return err;
}

static int shoot(struct gallery_shot *shot, const struct demo *demo, const struct sim_method *method)
{
    struct demo_frame f;
    struct sim_frame frame;
    struct zs_config config;
    struct sim_counted counted;
    uint32_t *id = sim_alloc((size_t)demo->width * demo->height, sizeof *id);
    uint32_t *written = sim_alloc((size_t)demo->width * demo->height, sizeof *written);
    demo->pose(&f, 0, demo->width, demo->height);
    sim_frame_config(&config, demo->width, demo->height, (uint8_t)demo->varyings);
    config.strip_h = 24;
    config.buffers = 1;
    config.depth = demo->depth;
    config.fast = demo->fast;
    sim_method_apply(&config, method);
    int err = sim_frame_render(&frame, &f.scene, &f.camera, &config, NULL);
    if (!err) { /* pools for one set, as a firmware author would size them */
        config.max_tris = sim_method_pool(method, frame.stats.max_tris_used);
        config.max_verts = (uint16_t)(frame.stats.max_verts_used > 3u ? frame.stats.max_verts_used : 3u);
        sim_frame_free(&frame);
        sim_method_apply(&config, method);
        err = sim_frame_render(&frame, &f.scene, &f.camera, &config, NULL);
    }
    err = err ? err : sim_frame_ids(id, &f.scene, &f.camera, &config);
    err = err ? err : sim_writes_count(written, NULL, &f.scene, &f.camera, &config);
    err = err ? err : count_wrong(&shot->wrong, id, &f, &config);
    err = err ? err : sim_costs_count(&counted, &f.scene, &f.camera, &config);
    if (!err) {
        if (shot->estimated)
            shot->instructions = sim_costs_sum(SIM_CORE_M3, &counted);
        shot->pixels = (uint32_t)demo->width * demo->height;
        for (uint32_t i = 0; i < shot->pixels; i++) {
            shot->visible += id[i] != 0;
            shot->written += written[i];
        }
        shot->stats = frame.stats;
        shot->arena_bytes = frame.arena_bytes;
        shot->depth_bytes = frame.no_depth ? 0 : ZS_DEPTH_BYTES(config.width, config.strip_h);
        sim_picture_565(&shot->picture, config.width, config.height, frame.rgb565);
        err = sim_show_draw(&shot->overdraw, NULL, SIM_SHOW_OVERDRAW, &f.scene, &f.camera, &config, 1.0);
    }
    sim_frame_free(&frame);
    SIM_FREE(id, written);
    return err ? sim_refuse(demo->name, 0, "--method %s: %s", method->name, zs_error_string(err)) : SIM_OK;
}

/* Instructions from lines of METHOD,SCENE,INSTRUCTIONS. */
static int read_counts(struct gallery_shot (*shot)[GALLERY_SCENES], const char *name)
{
    char line[256], method[32], scene[32];
    double instructions;
    unsigned long found = 0;
    FILE *f = fopen(name, "r");
    if (f == NULL)
        return sim_refuse(name, 0, "cannot be read");
    while (fgets(line, sizeof line, f) != NULL) {
        if (sscanf(line, "%31[^,],%31[^,],%lf", method, scene, &instructions) != 3)
            continue;
        for (size_t m = 0; m < SIM_METHODS; m++)
            for (size_t i = 0; i < GALLERY_SCENES; i++)
                if (strcmp(sim_methods[m].name, method) == 0 && strcmp(scenes[i]->name, scene) == 0) {
                    shot[m][i].instructions = instructions;
                    shot[m][i].estimated = 0;
                    found++;
                }
    }
    (void)fclose(f);
    return found ? SIM_OK
                 : sim_refuse(name, 0, "has no line METHOD,SCENE,INSTRUCTIONS of a method and scene of the gallery");
}

static int draw_all(struct gallery_shot (*shot)[GALLERY_SCENES])
{
    int status = SIM_OK;
    for (size_t m = 0; m < SIM_METHODS; m++)
        for (size_t i = 0; status == SIM_OK && i < GALLERY_SCENES; i++) {
            sim_progress("gallery", m * GALLERY_SCENES + i, SIM_METHODS * GALLERY_SCENES);
            status = shoot(&shot[m][i], scenes[i], &sim_methods[m]);
        }
    sim_progress_end();
    return status;
}

static int write_page(struct gallery_shot (*shot)[GALLERY_SCENES], const struct sim_picture *effect,
                      const struct request *rq)
{
    char path[4096];
    struct sim_output out;
    const char *names[GALLERY_SCENES];
    for (size_t i = 0; i < GALLERY_SCENES; i++)
        names[i] = scenes[i]->name;
    (void)snprintf(path, sizeof path, "%s/index.html", rq->out);
    int status = sim_output_open(&out, path);
    if (status != SIM_OK)
        return status;
    gallery_page_write(out.file, shot, names, effect);
    status = sim_output_commit(&out, 1);
    if (status == SIM_OK)
        (void)printf("%s\n", path);
    return status;
}

static void print_table(struct gallery_shot (*shot)[GALLERY_SCENES])
{
    (void)printf("%-12s %-11s %8s %7s %12s %9s %9s %8s %7s %7s %7s %6s\n", "scene", "method", "arena", "depth",
                 "M3 instr.", "fragments", "writes", "visible", "sorted", "splits", "rays", "wrong");
    for (size_t i = 0; i < GALLERY_SCENES; i++)
        for (size_t m = 0; m < SIM_METHODS; m++) {
            const struct gallery_shot *s = &shot[m][i];
            char instructions[32];
            (void)snprintf(instructions, sizeof instructions, "%s%.0f", s->estimated ? "~" : "", s->instructions);
            (void)printf("%-12s %-11s %8u %7u %12s %9u %9u %8u %7u %7u %7u %6u\n", scenes[i]->name,
                         sim_methods[m].name, s->arena_bytes, s->depth_bytes, instructions, s->stats.pixels_tested,
                         s->written, s->visible, s->stats.sorted, s->stats.splits, s->stats.rays, s->wrong);
        }
}

int sim_gallery(int argc, char **argv)
{
    struct request rq = { .out = "build/gallery" };
    struct gallery_shot(*shot)[GALLERY_SCENES];
    struct sim_picture effect[GALLERY_EFFECTS] = { { 0 } };
    char seen[N_TABLE] = { 0 };
    int status = sim_options_take(table, N_TABLE, &rq, seen, argc, argv, 0);
    if (status == SIM_OK && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (status != SIM_OK)
        return status;
    shot = sim_alloc(SIM_METHODS, sizeof *shot);
    for (size_t m = 0; m < SIM_METHODS; m++)
        for (size_t i = 0; i < GALLERY_SCENES; i++)
            shot[m][i].estimated = 1;
    if (rq.counts != NULL)
        status = read_counts(shot, rq.counts);
    if (status == SIM_OK)
        status = sim_output_folder(rq.out, 4096 - 64);
    if (status == SIM_OK)
        status = draw_all(shot);
    for (size_t k = 0; status == SIM_OK && k < GALLERY_EFFECTS; k++)
        status = gallery_effect_draw(&effect[k], &gallery_effects[k]);
    if (status == SIM_OK) {
        print_table(shot);
        status = write_page(shot, effect, &rq);
    }
    for (size_t k = 0; k < GALLERY_EFFECTS; k++)
        sim_picture_free(&effect[k]);
    for (size_t m = 0; m < SIM_METHODS; m++)
        for (size_t i = 0; i < GALLERY_SCENES; i++) {
            sim_picture_free(&shot[m][i].picture);
            sim_picture_free(&shot[m][i].overdraw);
        }
    free(shot);
    return status;
}
