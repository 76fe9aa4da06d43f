/* `zsim demo`: demo scenes through zs_render, strip by strip, and through a panel's driver and the model of its
 * controller where one is named; frames and a contact sheet as PNG, and a table of what they took (demo_table.c).
 *
 * SPDX-License-Identifier: MIT
 */
#include "demo.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "demo_frame.h"
#include "demo_options.h"
#include "demo_table.h"
#include "false_colors.h"
#include "frame.h"
#include "image.h"
#include "moving_picture.h"
#include "output_file.h"
#include "panel_frame.h"
#include "scenes.h"
#include "shader_table.h"
#include "sim.h"

#define SHEET_COLUMNS 4

/* ---- One frame --------------------------------------------------------------------------------------- */

static void configure(struct zs_config *config, const struct demo *demo, const struct sim_demo_request *rq)
{
    const struct sim_demo_size size = sim_demo_size_of(rq, demo);
    sim_frame_config(config, size.width, size.height, (uint8_t)demo->varyings);
    config->strip_h = (uint16_t)(rq->strip < size.height ? rq->strip : size.height);
    config->subpixel_bits = (uint8_t)rq->subpixel;
    config->fast = rq->fast.list;
    config->depth = demo->depth;
    sim_demo_method(config, demo, rq->method);
}

static void pose(struct demo_frame *f, const struct demo *demo, uint32_t t, const struct zs_config *config,
                 const struct sim_demo_request *rq)
{
    const struct sim_orbit orbit = sim_demo_orbit(rq);
    sim_demo_pose(f, demo, t, config->width, config->height, &orbit);
}

/* Pools for one pass and nothing more, as a firmware author would size them: from a first drawing of all frames with
 * pools as large as can be. */
static int fit_pools(struct zs_config *config, const struct demo *demo, const struct sim_demo_request *rq)
{
    uint32_t tris = 1, verts = 3;
    for (uint32_t k = 0; k < sim_demo_frames(rq, demo); k++) {
        struct demo_frame f = { 0 };
        struct sim_frame frame;
        pose(&f, demo, sim_demo_frame_number(rq, k), config, rq);
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
                const struct demo_frame *f, const struct zs_config *config, const struct sim_demo_request *rq,
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

static int save(const struct sim_picture *seen, const struct sim_demo_request *rq, const char *scene, uint32_t t)
{
    char png[4096], raw[4096];
    (void)snprintf(png, sizeof png, "%s/%s_%03u.png", rq->out, scene, (unsigned)t);
    (void)snprintf(raw, sizeof raw, "%s/%s_%03u.bin", rq->out, scene, (unsigned)t);
    return sim_picture_save(seen, png, rq->raw ? raw : NULL);
}

/* Is there a shader that the reference does not know: an effect, or one of the scene's own? */
static int has_effects(const struct zs_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const struct sim_shader_row *const row = sim_shader_row_of(scene->instance[i].material->shader);
        if (row == NULL || row->effect != NULL)
            return 1;
    }
    return 0;
}

/* Frame t into its files, the table's sums and the sheet. */
static int draw_frame(const struct demo *demo, uint32_t t, const struct zs_config *config,
                      const struct sim_demo_request *rq, struct sim_panel_frame *panel, struct sim_demo_tally *sum,
                      struct sheet *sheet)
{
    struct demo_frame f = { 0 };
    struct sim_frame frame;
    struct sim_picture seen = { 0 };
    pose(&f, demo, t, config, rq);
    int err = draw(&frame, &seen, panel, &f, config, rq, demo);
    if (!err && sum->frames == 0)
        sum->stats = frame.stats;
    if (!err)
        sheet_add(sheet, &seen, sum->frames, sim_demo_frames(rq, demo));
    sum->arena = frame.arena_bytes;
    if (sum->passes_max < frame.stats.passes)
        sum->passes_max = frame.stats.passes;
    if (!err)
        err = save(&seen, rq, demo->name, t);
    sum->not_compared |= sim_demo_piece(demo) != NULL || has_effects(&f.scene);
    if (!err && !sum->not_compared)
        err = sim_demo_compare(sum, &f, demo, config, &frame);
    sim_picture_free(&seen);
    sim_frame_free(&frame);
    sum->frames++;
    return err;
}

static int draw_scene(const struct demo *demo, const struct sim_demo_request *rq, struct sim_demo_tally *sum,
                      struct sheet *sheet)
{
    const uint32_t frames = sim_demo_frames(rq, demo);
    struct sim_panel_frame panel = { 0 };
    struct zs_config config;
    configure(&config, demo, rq);
    int err = fit_pools(&config, demo, rq);
    if (!err && rq->panel.name != NULL)
        err = sim_panel_begin(&panel, &rq->panel, demo->name, config.strip_h);
    for (uint32_t k = 0; !err && k < frames; k++) {
        err = draw_frame(demo, sim_demo_frame_number(rq, k), &config, rq, &panel, sum, sheet);
        sim_progress(demo->name, k + 1u, frames);
    }
    sim_panel_free(&panel);
    sim_progress_end();
    return err;
}

/* ---- All of it ------------------------------------------------------------------------------------- */

/* What a picture of it takes. */
static struct sim_demo_size picture_size(const struct sim_demo_request *rq, const struct demo *demo)
{
    const struct sim_demo_size size = sim_demo_size_of(rq, demo);
    if (rq->show == SIM_SHOW_FRAME)
        return size;
    return (struct sim_demo_size){ (uint16_t)sim_show_width(size.width), (uint16_t)sim_show_height(size.height) };
}

/* Sheets for the wanted scenes: one, or for a moving picture as many as the longest of them has frames. */
static void sheet_begin(struct sheet *sheet, const struct sim_demo_request *rq)
{
    uint32_t found = 0;
    *sheet = (struct sheet){ .n_pages = 1 };
    for (uint32_t i = 0; i < sim_demo_count(); i++)
        if (sim_demo_wanted(rq, sim_demo_at(i))) {
            const struct sim_demo_size size = picture_size(rq, sim_demo_at(i));
            const uint32_t frames = rq->moving != NULL ? sim_demo_frames(rq, sim_demo_at(i)) : 1u;
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

static int sheet_save(const struct sheet *sheet, const struct sim_demo_request *rq)
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
        sim_demo_table_foot();
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

int sim_demo_seen(struct sim_rendered *seen, uint32_t *n_frames, int argc, char **argv)
{
    struct sim_demo_request rq = sim_demo_usual;
    struct zs_config *config = &seen->config;
    memset(seen, 0, sizeof *seen);
    int err = sim_demo_parse(&rq, argc, argv);
    if (err)
        return err;
    const struct demo *demo = sim_demo_named(rq.scenes);
    if (demo == NULL)
        return sim_usage("--scene %s: one scene is wanted", rq.scenes);
    struct sim_panel_frame panel = { 0 };
    struct demo_frame f = { 0 };
    configure(config, demo, &rq);
    pose(&f, demo, sim_demo_frame_number(&rq, 0), config, &rq);
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

int sim_demo(int argc, char **argv)
{
    struct sim_demo_request rq = sim_demo_usual;
    int err = sim_demo_parse(&rq, argc, argv);
    if (!err && rq.help) {
        sim_demo_help();
        return SIM_OK;
    }
    if (!err)
        err = sim_output_folder(rq.out, 4096 - 64);
    if (err)
        return err;
    struct sheet sheet;
    sheet_begin(&sheet, &rq);
    sim_demo_table_head(rq.start);
    for (uint32_t i = 0; !err && i < sim_demo_count(); i++) {
        const struct demo *demo = sim_demo_at(i);
        struct sim_demo_tally sum;
        memset(&sum, 0, sizeof sum);
        if (!sim_demo_wanted(&rq, demo))
            continue;
        err = draw_scene(demo, &rq, &sum, &sheet);
        if (!err)
            sim_demo_table_row(demo, &sum);
        sheet.next++;
        (void)fflush(stdout);
    }
    if (!err)
        err = sheet_save(&sheet, &rq);
    sheet_end(&sheet);
    return err;
}
