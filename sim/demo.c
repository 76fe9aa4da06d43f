/* `zsim demo`: every demo scene through zs_render, strip by strip; frames and a contact sheet as PNG, a table
 * of what the pipeline did, and how far the pictures are from the double-precision reference.
 *
 * SPDX-License-Identifier: MIT
 */
#include "demo.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "frame.h"
#include "image.h"
#include "reference.h"
#include "scenes.h"
#include "sim.h"
#include "texels.h"
#include "truth.h"

#define STRIP_ROWS 24
#define SHEET_COLUMNS 4

struct request {
    const char *out, *scenes; /* folder; names with commas between, or NULL for all */
    long frames;             /* at most so many of each scene; 0: all */
};

static const char usage[] =
    "zsim demo [--out DIR=build/demo] [--scene NAME[,NAME...]] [--frames N]\n"
    "  Draws the demo scenes strip by strip as a board would: numbered PNG frames and a contact sheet in\n"
    "  DIR, and a table with the error against the double-precision reference.\n";

/* Sums over the frames of a scene. */
struct tally {
    struct zs_stats stats; /* of frame 0 */
    uint32_t arena, passes_max, frames;
    struct ref_diff diff;  /* counts summed, worst values kept */
    uint64_t off_by_one;
    double z_sum;
};

/* ---- One frame --------------------------------------------------------------------------------------- */

static void configure(struct zs_config *config, const struct demo *demo)
{
    sim_frame_config(config, demo->width, demo->height, (uint8_t)demo->attrs);
    config->strip_h = STRIP_ROWS;
    config->depth = demo->depth;
}

/* Pools for one pass and nothing more, as a firmware author would size them: from a first frame with
 * pools as large as can be. */
static int fit_pools(struct zs_config *config, const struct demo *demo, uint32_t frames)
{
    uint32_t tris = 1, verts = 3;
    for (uint32_t t = 0; t < frames; t++) {
        struct demo_frame f;
        struct sim_frame frame;
        demo->pose(&f, t, demo->width, demo->height);
        const int err = sim_frame_render(&frame, &f.scene, &f.camera, config, NULL);
        if (err)
            return sim_refuse(demo->name, 0, "%s", zs_strerror(err));
        if (tris < frame.stats.max_tris_used)
            tris = frame.stats.max_tris_used;
        if (verts < frame.stats.max_verts_used)
            verts = frame.stats.max_verts_used;
        sim_frame_free(&frame);
    }
    config->max_tris = (uint16_t)tris;
    config->max_verts = (uint16_t)verts;
    return SIM_OK;
}

static void add_diff(struct tally *sum, const struct ref_diff *d)
{
    struct ref_diff *s = &sum->diff;
    s->pixels += d->pixels;
    s->ref_drawn += d->ref_drawn;
    s->id_differ += d->id_differ;
    s->missing += d->missing;
    s->extra += d->extra;
    s->channels += d->channels;
    s->channel_off += d->channel_off;
    s->channel_off_one += d->channel_off_one;
    s->z_compared += d->z_compared;
    sum->z_sum += d->z_mean_rel * (double)d->z_compared;
}

static int compare(struct tally *sum, const struct demo_frame *f, const struct demo *demo,
                   const struct zs_config *config, const struct sim_frame *frame)
{
    const size_t n = (size_t)demo->width * demo->height;
    struct ref_image ours = { frame->rgb565, frame->key, sim_alloc(n, sizeof(uint32_t)), 0, 0, 0 };
    struct ref_image truth = { sim_alloc(n, 2), sim_alloc(n, 2), sim_alloc(n, sizeof(uint32_t)),
                               sim_alloc(n, sizeof(double)), 0, 0 };
    struct ref_camera camera;
    struct ref_light light;
    struct ref_diff diff;
    const struct ref_depth depth = { sim_truth_mapping(demo->depth, &f->camera), config->depth_bits };
    size_t n_tris;
    struct ref_triangle *tris = sim_truth_triangles(&f->scene, &f->camera, &n_tris);
    sim_truth_camera(&camera, &f->camera);
    sim_truth_light(&light, &f->scene.light);
    ours.texel = sim_alloc(n, sizeof *ours.texel); /* colours are compared where texels are the same */
    truth.texel = sim_alloc(n, sizeof *truth.texel);
    int err = sim_frame_ids(ours.id, &f->scene, &f->camera, config);
    if (!err)
        err = sim_frame_texels(ours.texel, &f->scene, &f->camera, config);
    if (!err)
        err = ref_render(tris, n_tris, &camera, &light, &depth, f->scene.background, demo->width,
                         demo->height, &truth, NULL, NULL);
    if (!err)
        err = ref_compare(&ours, &truth, &depth, &camera, demo->width, demo->height, &diff);
    if (!err)
        add_diff(sum, &diff);
    free(tris);
    free(ours.id);
    free(ours.texel);
    free(truth.texel);
    free(truth.rgb565);
    free(truth.key);
    free(truth.id);
    free(truth.z);
    return err ? sim_refuse(demo->name, 0, "the reference could not draw it (%d)", err) : SIM_OK;
}

/* ---- Contact sheet ------------------------------------------------------------------------------------ */

struct sheet {
    uint8_t *rgb; /* [rows * cell_h][SHEET_COLUMNS * cell_w][3] */
    uint32_t cell_w, cell_h, rows, next;
};

static void sheet_add(struct sheet *s, const struct demo *demo, const uint16_t *px)
{
    const uint32_t width = SHEET_COLUMNS * s->cell_w;
    const uint32_t x0 = s->next % SHEET_COLUMNS * s->cell_w + (s->cell_w - demo->width) / 2u;
    const uint32_t y0 = s->next / SHEET_COLUMNS * s->cell_h + (s->cell_h - demo->height) / 2u;
    s->next++;
    for (uint32_t y = 0; y < demo->height; y++)
        for (uint32_t x = 0; x < demo->width; x++)
            sim_rgb565_expand(s->rgb + ((size_t)(y0 + y) * width + x0 + x) * 3u,
                              px[(size_t)y * demo->width + x]);
}

/* ---- Scenes -------------------------------------------------------------------------------------------- */

static int draw_scene(const struct demo *demo, const struct request *rq, struct tally *sum,
                      struct sheet *sheet)
{
    const uint32_t frames = rq->frames && rq->frames < demo->frames ? (uint32_t)rq->frames
                                                                    : demo->frames;
    struct zs_config config;
    configure(&config, demo);
    int err = fit_pools(&config, demo, frames);
    for (uint32_t t = 0; !err && t < frames; t++) {
        struct demo_frame f;
        struct sim_frame frame;
        char path[4096];
        demo->pose(&f, t, demo->width, demo->height);
        err = sim_frame_render(&frame, &f.scene, &f.camera, &config, NULL);
        if (err)
            return sim_refuse(demo->name, 0, "%s", zs_strerror(err));
        if (t == 0) {
            sum->stats = frame.stats;
            sheet_add(sheet, demo, frame.rgb565);
        }
        sum->arena = frame.arena_bytes;
        if (sum->passes_max < frame.stats.passes)
            sum->passes_max = frame.stats.passes;
        (void)snprintf(path, sizeof path, "%s/%s_%03u.png", rq->out, demo->name, (unsigned)t);
        err = sim_png_save_565(path, demo->width, demo->height, frame.rgb565);
        if (!err)
            err = compare(sum, &f, demo, &config, &frame);
        sim_frame_free(&frame);
        sum->frames++;
        sim_progress(demo->name, t + 1u, frames);
    }
    sim_progress_end();
    return err;
}

static void table_head(void)
{
    puts("Triangles and pixels: frame 0. Error against the double-precision reference: all frames.\n");
    printf("%-13s %6s %6s | %6s %5s %5s %5s %5s %5s %5s | %7s %7s | %7s %6s %6s | %7s %7s %7s %6s %7s\n",
           "scene", "in", "drawn", "view", "near", "far", "side", "back", "zero", "empty", "tested",
           "written", "arena", "passes", "frames", "wrong", "cover", "depth", "colour", "by one");
}

static double percent(size_t part, size_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0.0;
}

static void table_row(const struct demo *demo, const struct tally *t)
{
    const struct zs_stats *s = &t->stats;
    const struct ref_diff *d = &t->diff;
    printf("%-13s %6u %6u | %6u %5u %5u %5u %5u %5u %5u | %7u %7u | %7u %6u %6u |", demo->name,
           s->tris_in, s->tris_drawn, s->tris_frustum, s->tris_near, s->tris_far, s->tris_offscreen,
           s->tris_facing, s->tris_zero, s->tris_empty, s->pixels_tested, s->pixels_written,
           t->arena, t->passes_max, t->frames);
    printf(" %6.3f%% %6.3f%% %7.1e %6zu %6.2f%%\n", percent(d->id_differ, d->ref_drawn),
           percent(d->missing + d->extra, d->ref_drawn),
           d->z_compared ? t->z_sum / (double)d->z_compared : 0.0, d->channel_off,
           percent(d->channel_off_one, d->channels));
}

static void table_foot(void)
{
    puts("\nin, drawn: triangles. Rejected because: view - the instance's sphere is out of view; near, far;\n"
         "side - beside the frame; back - the culled face; zero - no area after snapping; empty - no sample\n"
         "in the box. tested, written: pixels. arena: bytes, all of the renderer's RAM but its own struct.\n"
         "wrong: drawn pixels that show another triangle than the reference does. cover: pixels missing or\n"
         "too many. depth: mean relative error of the distances that 16-bit keys stand for. colour: channel\n"
         "values more than one RGB565 code off, where triangle and texel are the same. by one: those one code\n"
         "off.");
}

/* ---- Command line ---------------------------------------------------------------------------------- */

static int parse(struct request *rq, int argc, char **argv)
{
    for (int i = 0; i < argc; i++) {
        char *end;
        const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(name, "--out") && strcmp(name, "--scene") && strcmp(name, "--frames"))
            return sim_usage("demo: unknown option '%s'", name);
        if (!value)
            return sim_usage("demo: %s needs a value", name);
        i++;
        if (!strcmp(name, "--out")) {
            rq->out = value;
        } else if (!strcmp(name, "--scene")) {
            rq->scenes = value;
        } else {
            rq->frames = strtol(value, &end, 10);
            if (*end || end == value || rq->frames < 1)
                return sim_usage("demo: --frames takes a whole number from 1, not '%s'", value);
        }
    }
    return SIM_OK;
}

static int make_folder(const char *path)
{
    char part[4096];
    if (strlen(path) + 64u > sizeof part)
        return sim_refuse(NULL, 0, "--out: the path is too long");
    for (size_t i = 1; i <= strlen(path); i++)
        if (path[i] == '/' || path[i] == '\0') {
            memcpy(part, path, i);
            part[i] = '\0';
            if (mkdir(part, 0777) && errno != EEXIST)
                return sim_refuse(part, 0, "cannot make this folder: %s", strerror(errno));
        }
    return SIM_OK;
}

static int wanted(const struct request *rq, const struct demo *demo)
{
    const size_t length = strlen(demo->name);
    for (const char *at = rq->scenes; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        if (strcspn(at, ",") == length && !strncmp(at, demo->name, length))
            return 1;
    return !rq->scenes;
}

/* A sheet for the wanted scenes. Return SIM_REFUSED where a name is no scene's. */
static int sheet_begin(struct sheet *sheet, const struct request *rq)
{
    uint32_t found = 0, asked = 1;
    memset(sheet, 0, sizeof *sheet);
    for (uint32_t i = 0; i < n_demos; i++)
        if (wanted(rq, demos[i])) {
            found++;
            if (sheet->cell_w < demos[i]->width)
                sheet->cell_w = demos[i]->width;
            if (sheet->cell_h < demos[i]->height)
                sheet->cell_h = demos[i]->height;
        }
    for (const char *at = rq->scenes; at && (at = strchr(at, ',')) != NULL; at++)
        asked++;
    if (rq->scenes && asked != found)
        return sim_refuse(rq->scenes, 0, "--scene: not every name here is a scene's");
    sheet->rows = (found + SHEET_COLUMNS - 1u) / SHEET_COLUMNS;
    sheet->rgb = sim_alloc((size_t)sheet->rows * sheet->cell_h * SHEET_COLUMNS * sheet->cell_w, 3);
    return SIM_OK;
}

int sim_demo(int argc, char **argv)
{
    struct request rq = { "build/demo", NULL, 0 };
    if (argc > 0 && !strcmp(argv[0], "--help")) {
        fputs(usage, stdout);
        return SIM_OK;
    }
    int err = parse(&rq, argc, argv);
    if (!err)
        err = make_folder(rq.out);
    if (err)
        return err;
    struct sheet sheet;
    err = sheet_begin(&sheet, &rq);
    if (err)
        return err;
    table_head();
    for (uint32_t i = 0; !err && i < n_demos; i++) {
        struct tally sum;
        memset(&sum, 0, sizeof sum);
        if (!wanted(&rq, demos[i]))
            continue;
        err = draw_scene(demos[i], &rq, &sum, &sheet);
        if (!err)
            table_row(demos[i], &sum);
        (void)fflush(stdout);
    }
    if (!err) {
        char path[4096];
        (void)snprintf(path, sizeof path, "%s/contact.png", rq.out);
        err = sim_png_save(path, SHEET_COLUMNS * sheet.cell_w, sheet.rows * sheet.cell_h,
                           sheet.rgb);
        if (!err) {
            table_foot();
            printf("\n%s and %s/SCENE_NNN.png\n", path, rq.out);
        }
    }
    free(sheet.rgb);
    return err;
}
