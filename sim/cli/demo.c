/* `zsim demo`: demo scenes through zs_render, strip by strip, and through a panel's driver and the model of its
 * controller where one is named; frames and a contact sheet as PNG, a table of what the pipeline did, and how far the
 * frames are from the double-precision reference.
 *
 * SPDX-License-Identifier: MIT
 */
#include "demo.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accelerator_names.h"
#include "frame.h"
#include "image.h"
#include "method_names.h"
#include "moving_picture.h"
#include "option_help.h"
#include "option_table.h"
#include "output_file.h"
#include "panel_frame.h"
#include "demo_frame.h"
#include "reference.h"
#include "scene_file.h"
#include "scenes.h"
#include "false_colors.h"
#include "sim.h"
#include "texel_numbers.h"
#include "truth.h"

#define SHEET_COLUMNS 4
#define FRAMES_MAX 65535 /* of a scene, uint16_t */

struct request {
    const char *out, *scenes;           /* folder; names with commas between, or NULL for all */
    long size[2], strip, subpixel;      /* size: a panel's picture's; without has_size, the scene's own */
    long start, step, frames;           /* frames start, start + step ...; at most so many of each scene, 0: all */
    const char *fast_names;             /* NULL: all */
    const char *moving;                 /* NULL: no moving picture */
    long delay;                         /* of its frames, ms */
    struct sim_fast fast;               /* accelerators, which it names */
    enum sim_show show;
    int method;                         /* of sim_methods */
    struct sim_panel_wish panel;
    int has_size, raw, help;            /* flags */
};

#define AT(field) offsetof(struct request, field)

/* The names of all scenes. Static storage. */
static const char *scene_list(void)
{
    static char text[1024];
    size_t n = 0;
    for (uint32_t i = 0; i < sim_demo_count() && n + 64u < sizeof text; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", i == 0 ? "" : ", ", sim_demo_at(i)->name);
    return text;
}

static const struct sim_option table[] = {
    { "--out", SIM_OPTION_TEXT, AT(out), .value = "DIR", .help = "the folder, made if there is none (build/demo)" },
    { "--scene", SIM_OPTION_TEXT, AT(scenes), .value = "NAME,...",
      .help = "these alone (all), or a scene's own file, which is compiled: my_scene.c. There are:",
      .list = scene_list },
    { "--size", SIM_OPTION_SIZE, AT(size), AT(has_size), 1, ZS_SIZE_MAX,
      .help = "px (what each scene was composed for)" },
    { "--strip", SIM_OPTION_COUNT, AT(strip), 0, 1, ZS_SIZE_MAX, .value = "ROWS", .help = "rows to a strip (24)" },
    { "--subpixel", SIM_OPTION_COUNT, AT(subpixel), .words = "4|8", .help = "sub-pixel bits (8)" },
    { "--start", SIM_OPTION_COUNT, AT(start), 0, 0, FRAMES_MAX, .value = "T",
      .help = "the first frame of the animation to be drawn (0)" },
    { "--step", SIM_OPTION_COUNT, AT(step), 0, 1, FRAMES_MAX,
      .help = "frames T, T + N, T + 2 N ... to the animation's end, N {range} (1)" },
    { "--frames", SIM_OPTION_COUNT, AT(frames), 0, 1, FRAMES_MAX, .help = "at most so many of each scene (all)" },
    { "--fast", SIM_OPTION_TEXT, AT(fast_names), .value = "LIST", .list = sim_fast_list,
      .help = "accelerators to draw with, the same frames: all, none, names with commas between, or all but some, as "
              "all-tiles-touch (all). There are:" },
    { "--method", SIM_OPTION_CHOICE, AT(method), .words = SIM_METHOD_WORDS,
      .help = "how hidden surfaces are removed (zbuffer), as of zsim render" },
    { "--show", SIM_OPTION_CHOICE, AT(show), .words = SIM_SHOW_WORDS,
      .help = "pictures are false colours with a legend, as of zsim render (frame)" },
    SIM_PANEL_OPTIONS(struct request, panel,
                      "frames go through this panel's driver and the model of its controller: pictures are what its "
                      "viewer sees, of its size. There are:"),
    { "--moving", SIM_OPTION_FILE, AT(moving), .value = "F.png",
      .help = "contact sheets of the first frames, the second ones and so on as an animated PNG, too, or a GIF "
              "or MP4 where the name ends so; a scene with fewer frames begins again" },
    { "--delay", SIM_OPTION_COUNT, AT(delay), 0, 10, 65535, .value = "MS", .help = "of a frame in it, {range} (80)" },
    { "--raw", SIM_OPTION_FLAG, AT(raw),
      .help = "DIR/SCENE_NNN.bin too: RGB565, most significant byte first, row by row; of grey and one-bit panels a "
              "byte for each level or bit" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim demo [options]",
    "Draws demo scenes, with and without effects, and bench scenes strip by strip as a board would: DIR/SCENE_NNN.png, "
    "where NNN is the frame of the animation, a contact sheet DIR/contact.png of their first frames, and a table of "
    "what they took and of how far the frames, before any panel, are from the double-precision reference.",
    "Exit status: 0 done; 1 refused; 2 the command line makes no sense.",
};

/* Sums over the frames of a scene. */
struct tally {
    struct zs_stats stats; /* of the first frame */
    uint32_t arena, passes_max, frames;
    struct ref_diff diff; /* counts summed, worst values kept */
    uint64_t off_by_one;
    double z_sum;
};

/* ---- One frame --------------------------------------------------------------------------------------- */

struct size {
    uint16_t width, height;
};

static struct size size_of(const struct request *rq, const struct demo *demo)
{
    if (!rq->has_size)
        return (struct size){ demo->width, demo->height };
    return (struct size){ (uint16_t)rq->size[0], (uint16_t)rq->size[1] };
}

static void configure(struct zs_config *config, const struct demo *demo, const struct request *rq)
{
    const struct size size = size_of(rq, demo);
    sim_frame_config(config, size.width, size.height, (uint8_t)demo->varyings);
    config->strip_h = (uint16_t)(rq->strip < size.height ? rq->strip : size.height);
    config->subpixel_bits = (uint8_t)rq->subpixel;
    config->fast = rq->fast.list;
    config->depth = demo->depth;
    sim_demo_method(config, demo, rq->method);
}

static uint32_t count_frames(const struct request *rq, const struct demo *demo)
{
    const long all = (demo->frames - rq->start + rq->step - 1) / rq->step;
    return (uint32_t)(rq->frames > 0 && rq->frames < all ? rq->frames : all);
}

/* The frame of the animation that is the k-th to be drawn. */
static uint32_t frame_number(const struct request *rq, uint32_t k)
{
    return (uint32_t)rq->start + k * (uint32_t)rq->step;
}

/* Pools for one pass and nothing more, as a firmware author would size them: from a first drawing of all frames with
 * pools as large as can be. */
static int fit_pools(struct zs_config *config, const struct demo *demo, const struct request *rq)
{
    uint32_t tris = 1, verts = 3;
    for (uint32_t k = 0; k < count_frames(rq, demo); k++) {
        struct demo_frame f = { 0 };
        struct sim_frame frame;
        demo->pose(&f, frame_number(rq, k), config->width, config->height);
        const int err = sim_demo_render(&frame, demo, &f, config, NULL, NULL);
        if (err)
            return sim_refuse(demo->name, 0, "%s", zs_error_string(err));
        if (tris < frame.stats.max_tris_used)
            tris = frame.stats.max_tris_used;
        if (verts < frame.stats.max_verts_used)
            verts = frame.stats.max_verts_used;
        sim_frame_free(&frame);
    }
    config->max_tris = sim_method_pool(&sim_methods[rq->method], tris);
    config->max_verts = (uint16_t)verts;
    if (!sim_demo_piece(demo))
        sim_method_apply(config, &sim_methods[rq->method]);
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
    const size_t n = (size_t)config->width * config->height;
    struct ref_image ours = { .rgb565 = frame->rgb565,
                              .key = frame->no_keys ? NULL : frame->key,
                              .id = sim_alloc(n, sizeof(uint32_t)),
                              .texel = sim_alloc(n, sizeof(uint32_t)) }; /* colours are compared where it is the same */
    struct sim_truth truth;
    struct ref_diff diff;
    int err = sim_frame_ids(ours.id, &f->scene, &f->camera, config);
    if (!err)
        err = sim_frame_texels(ours.texel, &f->scene, &f->camera, config);
    if (!err) {
        err = sim_truth_draw(&truth, &f->scene, &f->camera, config);
        if (!err)
            err = ref_compare(&ours, &truth.image, &truth.depth, &truth.camera, config->width, config->height, &diff);
        sim_truth_free(&truth);
    }
    if (!err)
        add_diff(sum, &diff);
    SIM_FREE(ours.id, ours.texel);
    return err ? sim_refuse(demo->name, 0, "the reference could not draw it (%d)", err) : SIM_OK;
}

/* ---- Contact sheet ------------------------------------------------------------------------------------ */

struct sheet {
    uint8_t **page; /* [n_pages], each [rows * cell_h][columns * cell_w][3]; page 0 is contact.png */
    uint32_t n_pages, columns, rows, cell_w, cell_h;
    uint32_t next; /* place of the scene that is drawn */
};

/* The k-th of n pictures of the current scene: on page k, and where the scene begins again. */
static void sheet_add(struct sheet *s, const struct sim_picture *p, uint32_t k, uint32_t n)
{
    const uint32_t width = s->columns * s->cell_w;
    const uint32_t x0 = s->next % s->columns * s->cell_w + (s->cell_w - p->width) / 2u;
    const uint32_t y0 = s->next / s->columns * s->cell_h + (s->cell_h - p->height) / 2u;
    for (; k < s->n_pages; k += n)
        for (uint32_t y = 0; y < p->height; y++)
            memcpy(s->page[k] + ((size_t)(y0 + y) * width + x0) * 3u, p->rgb + (size_t)y * p->width * 3u,
                   p->width * 3u);
}

/* ---- Scenes -------------------------------------------------------------------------------------------- */

/* The frame, and what is seen of it: through the panel, if there is one. */
static int draw(struct sim_frame *frame, struct sim_picture *seen, struct sim_panel_frame *panel,
                const struct demo_frame *f, const struct zs_config *config, const struct request *rq,
                const struct demo *demo)
{
    const char *scene = demo->name;
    const struct zs_sink sink = sim_panel_sink(panel);
    int err = sim_demo_render(frame, demo, f, config, NULL, rq->panel.name ? &sink : NULL);
    if (!err && rq->show != SIM_SHOW_FRAME)
        err = sim_show_draw(seen, NULL, rq->show, &f->scene, &f->camera, config, 1.0);
    if (err && panel->err == HAL_ERR_NONE)
        return sim_refuse(scene, 0, "%s", zs_error_string(err));
    if (rq->show != SIM_SHOW_FRAME)
        return SIM_OK;
    if (rq->panel.name == NULL) {
        sim_picture_565(seen, config->width, config->height, frame->rgb565);
        return SIM_OK;
    }
    const int status = sim_panel_check(panel, &rq->panel, scene);
    if (status == SIM_OK)
        sim_panel_picture(seen, panel->model, &panel->glass, rq->panel.turns);
    return status;
}

static int save(const struct sim_picture *seen, const struct request *rq, const char *scene, uint32_t t)
{
    char png[4096], raw[4096];
    (void)snprintf(png, sizeof png, "%s/%s_%03u.png", rq->out, scene, (unsigned)t);
    (void)snprintf(raw, sizeof raw, "%s/%s_%03u.bin", rq->out, scene, (unsigned)t);
    return sim_picture_save(seen, png, rq->raw ? raw : NULL);
}

/* Frame t into its files, the table's sums and the sheet. */
static int draw_frame(const struct demo *demo, uint32_t t, const struct zs_config *config, const struct request *rq,
                      struct sim_panel_frame *panel, struct tally *sum, struct sheet *sheet)
{
    struct demo_frame f = { 0 };
    struct sim_frame frame;
    struct sim_picture seen = { 0 };
    demo->pose(&f, t, config->width, config->height);
    int err = draw(&frame, &seen, panel, &f, config, rq, demo);
    if (!err && sum->frames == 0)
        sum->stats = frame.stats;
    if (!err)
        sheet_add(sheet, &seen, sum->frames, count_frames(rq, demo));
    sum->arena = frame.arena_bytes;
    if (sum->passes_max < frame.stats.passes)
        sum->passes_max = frame.stats.passes;
    if (!err)
        err = save(&seen, rq, demo->name, t);
    if (!err && !sim_demo_piece(demo)) /* the reference knows no effects */
        err = compare(sum, &f, demo, config, &frame);
    sim_picture_free(&seen);
    sim_frame_free(&frame);
    sum->frames++;
    return err;
}

static int draw_scene(const struct demo *demo, const struct request *rq, struct tally *sum,
                      struct sheet *sheet)
{
    const uint32_t frames = count_frames(rq, demo);
    struct sim_panel_frame panel = { 0 };
    struct zs_config config;
    configure(&config, demo, rq);
    int err = fit_pools(&config, demo, rq);
    if (!err && rq->panel.name != NULL)
        err = sim_panel_begin(&panel, &rq->panel, demo->name, config.strip_h);
    for (uint32_t k = 0; !err && k < frames; k++) {
        err = draw_frame(demo, frame_number(rq, k), &config, rq, &panel, sum, sheet);
        sim_progress(demo->name, k + 1u, frames);
    }
    sim_panel_free(&panel);
    sim_progress_end();
    return err;
}

static void table_head(const struct request *rq)
{
    printf("Triangles and pixels: frame %ld. Error against the double-precision reference: all frames.\n\n", rq->start);
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
    if (sim_demo_piece(demo)) {
        printf(" %7s %7s %7s %6s %7s\n", "-", "-", "-", "-", "-");
        return;
    }
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
         "off. Scenes with effects are not compared (-).");
}

/* ---- Command line ---------------------------------------------------------------------------------- */

static int is_name(const struct demo *demo, const char *text, size_t length)
{
    const char *name = sim_demo_name(demo);
    return strlen(name) == length && !memcmp(name, text, length);
}

/* The name behind that at `at`; NULL: it was the last. */
static const char *next_name(const char *at)
{
    const char *comma = strchr(at, ',');
    return comma ? comma + 1 : NULL;
}

/* Asked for are pictures or methods that scenes with effects do not have. */
static int plain(const struct request *rq)
{
    return rq->show != SIM_SHOW_FRAME || rq->method;
}

static int wanted(const struct request *rq, const struct demo *demo)
{
    for (const char *at = rq->scenes; at; at = next_name(at))
        if (is_name(demo, at, strcspn(at, ",")))
            return 1;
    return !rq->scenes && !(sim_demo_piece(demo) && plain(rq));
}

/* Scenes' own files among the names. */
static int load_scenes(const struct request *rq)
{
    const char *own = NULL;
    for (const char *at = rq->scenes; at; at = next_name(at)) {
        const size_t length = strcspn(at, ",");
        char *name = sim_alloc(length + 1, 1);
        memcpy(name, at, length);
        int status = SIM_OK;
        if (sim_scene_file_is(name)) {
            status = own ? sim_usage("--scene: one scene's own file at a time") : sim_scene_file_need(name);
            own = at;
        }
        free(name);
        if (status != SIM_OK)
            return status;
    }
    return SIM_OK;
}

/* Are names and frames such as there are? */
static int check_scenes(const struct request *rq)
{
    const int status = load_scenes(rq);
    if (status != SIM_OK)
        return status;
    for (const char *at = rq->scenes; at; at = next_name(at)) {
        const size_t length = strcspn(at, ",");
        uint32_t i = 0;
        while (i < sim_demo_count() && !is_name(sim_demo_at(i), at, length))
            i++;
        if (i == sim_demo_count())
            return sim_refuse(NULL, 0, "--scene %.*s: there is no such scene; there are %s", (int)length, at,
                              scene_list());
        if (sim_demo_piece(sim_demo_at(i)) && plain(rq))
            return sim_usage("--scene %s: it has effects, so that there are no false colours and no other methods",
                             sim_demo_at(i)->name);
    }
    for (uint32_t i = 0; i < sim_demo_count(); i++)
        if (wanted(rq, sim_demo_at(i)) && rq->start >= sim_demo_at(i)->frames)
            return sim_refuse(NULL, 0, "--start %ld: frames of %s are 0 to %u; start at one of them%s", rq->start,
                              sim_demo_at(i)->name, sim_demo_at(i)->frames - 1u,
                              rq->scenes ? "" : ", or name scenes by --scene");
    return SIM_OK;
}

static int parse(struct request *rq, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    struct pm_glass glass;
    int status = SIM_OK;
    for (int i = 0; status == SIM_OK && i < argc; i++)
        status = sim_option_take(table, N_TABLE, rq, seen, argc, argv, &i);
    if (status != SIM_OK || rq->help)
        return status;
    status = sim_fast_take(&rq->fast, rq->fast_names);
    if (status == SIM_OK)
        status = sim_options_in_range(table, N_TABLE, rq, seen, NULL);
    if (status == SIM_OK)
        status = sim_panel_take(&rq->panel, NULL, rq->has_size, rq->size, rq->strip, &glass);
    if (status == SIM_OK && rq->show != SIM_SHOW_FRAME && rq->panel.name != NULL)
        return sim_usage("--show does not go through a panel: leave --panel out");
    if (status == SIM_OK && rq->method && rq->show != SIM_SHOW_FRAME && rq->show != SIM_SHOW_OVERDRAW)
        return sim_usage("--method %s: of --show there is overdraw", sim_methods[rq->method].name);
    rq->has_size |= rq->panel.name != NULL;
    return status == SIM_OK ? check_scenes(rq) : status;
}

/* What a picture of it takes. */
static struct size picture_size(const struct request *rq, const struct demo *demo)
{
    const struct size size = size_of(rq, demo);
    if (rq->show == SIM_SHOW_FRAME)
        return size;
    return (struct size){ (uint16_t)sim_show_width(size.width), (uint16_t)sim_show_height(size.height) };
}

/* Sheets for the wanted scenes: one, or for a moving picture as many as the longest of them has frames. */
static void sheet_begin(struct sheet *sheet, const struct request *rq)
{
    uint32_t found = 0;
    *sheet = (struct sheet){ .n_pages = 1 };
    for (uint32_t i = 0; i < sim_demo_count(); i++)
        if (wanted(rq, sim_demo_at(i))) {
            const struct size size = picture_size(rq, sim_demo_at(i));
            const uint32_t frames = rq->moving != NULL ? count_frames(rq, sim_demo_at(i)) : 1u;
            found++;
            sheet->cell_w = sheet->cell_w < size.width ? size.width : sheet->cell_w;
            sheet->cell_h = sheet->cell_h < size.height ? size.height : sheet->cell_h;
            sheet->n_pages = sheet->n_pages < frames ? frames : sheet->n_pages;
        }
    sheet->columns = rq->moving != NULL && found < SHEET_COLUMNS ? found : SHEET_COLUMNS;
    sheet->rows = (found + sheet->columns - 1u) / sheet->columns;
    sheet->page = sim_alloc(sheet->n_pages, sizeof *sheet->page);
    for (uint32_t k = 0; k < sheet->n_pages; k++)
        sheet->page[k] = sim_alloc((size_t)sheet->rows * sheet->cell_h * sheet->columns * sheet->cell_w, 3);
}

static int sheet_save(const struct sheet *sheet, const struct request *rq)
{
    char path[4096];
    const uint32_t width = sheet->columns * sheet->cell_w, height = sheet->rows * sheet->cell_h;
    (void)snprintf(path, sizeof path, "%s/contact.png", rq->out);
    int err = sim_png_save(path, width, height, sheet->page[0]);
    if (!err && rq->moving != NULL) {
        const struct sim_moving moving = { width, height, sheet->n_pages, (uint32_t)rq->delay, sheet->page };
        err = sim_moving_save(rq->moving, &moving);
    }
    if (!err) {
        table_foot();
        printf("\n%s and %s/SCENE_NNN.png\n", path, rq->out);
    }
    return err;
}

static void sheet_end(struct sheet *sheet)
{
    for (uint32_t k = 0; k < sheet->n_pages; k++)
        free(sheet->page[k]);
    free(sheet->page);
}

static const struct request usual = { .out = "build/demo", .strip = 24, .subpixel = 8, .step = 1, .delay = 80 };

int sim_demo_seen(struct sim_rendered *seen, uint32_t *n_frames, int argc, char **argv)
{
    struct request rq = usual;
    struct zs_config *config = &seen->config;
    memset(seen, 0, sizeof *seen);
    int err = parse(&rq, argc, argv);
    if (err)
        return err;
    const struct demo *demo = sim_demo_named(rq.scenes);
    if (demo == NULL)
        return sim_usage("--scene %s: one scene is wanted", rq.scenes);
    struct sim_panel_frame panel = { 0 };
    struct demo_frame f = { 0 };
    configure(config, demo, &rq);
    demo->pose(&f, frame_number(&rq, 0), config->width, config->height);
    err = fit_pools(config, demo, &rq);
    if (!err && rq.panel.name != NULL)
        err = sim_panel_begin(&panel, &rq.panel, demo->name, config->strip_h);
    if (!err)
        err = draw(&seen->frame, &seen->shown, &panel, &f, config, &rq, demo);
    if (err)
        sim_render_free(seen);
    *n_frames = demo->frames;
    sim_panel_free(&panel);
    return err;
}

const struct sim_option *sim_demo_rows(size_t *n)
{
    *n = N_TABLE;
    return table;
}

int sim_demo(int argc, char **argv)
{
    struct request rq = usual;
    int err = parse(&rq, argc, argv);
    if (!err && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (!err)
        err = sim_output_folder(rq.out, 4096 - 64);
    if (err)
        return err;
    struct sheet sheet;
    sheet_begin(&sheet, &rq);
    table_head(&rq);
    for (uint32_t i = 0; !err && i < sim_demo_count(); i++) {
        const struct demo *demo = sim_demo_at(i);
        struct tally sum;
        memset(&sum, 0, sizeof sum);
        if (!wanted(&rq, demo))
            continue;
        err = draw_scene(demo, &rq, &sum, &sheet);
        if (!err)
            table_row(demo, &sum);
        sheet.next++;
        (void)fflush(stdout);
    }
    if (!err)
        err = sheet_save(&sheet, &rq);
    sheet_end(&sheet);
    return err;
}
