/* Options, model, view, scene, frame, files, in this order. Files come last, so that whatever is
 * refused leaves none.
 *
 * SPDX-License-Identifier: MIT
 */
#include "render.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "effect_scene.h"
#include "explanation.h"
#include "frame.h"
#include "image.h"
#include "line_style.h"
#include "method_names.h"
#include "model.h"
#include "render_options.h"
#include "model_reference.h"
#include "output_file.h"
#include "panel_frame.h"
#include "scene_parts.h"
#include "false_colors.h"
#include "sim.h"
#include "simplify.h"
#include "stats.h"
#include "texel_numbers.h"
#include "turntable.h"
#include "vec.h"
#include "framing.h"

#define N_OUTPUTS 4

/* One command, from its options to its frame. Whatever is not set is all zero. */
struct job {
    struct sim_options options;
    struct sim_model model;
    struct sim_view view;
    struct sim_scene *scene; /* kept->scene */
    struct sim_kept_scene own, *kept;
    struct sim_lost turned[SIM_LOST_KINDS]; /* of a turntable, which keeps no scene */
    struct sim_styled styled; /* with --style */
    struct sim_effect_scene effect; /* with options of effects */
    const struct zs_scene *drawn; /* one of both */
    struct zs_config config;
    struct sim_frame frame;
    struct sim_panel_frame panel; /* with --panel */
    uint32_t *id;    /* of the frame; NULL: not wanted */
    uint32_t *texel; /* with --compare and textures; else NULL */
    struct sim_model_reference original;
    struct ref_diff diff; /* with --compare */
    struct sim_picture shown; /* with --show */
    struct sim_show_sum show_sum;
    struct sim_frame_time time; /* with --threads */
};

/* ---- Frame ----------------------------------------------------------------------------------- */

static uint16_t pool_size(long wanted, uint64_t ample, uint64_t least)
{
    const uint64_t n = wanted > 0 ? (uint64_t)wanted : ample < least ? least : ample;
    return (uint16_t)(n < ZS_POOL_MAX ? n : ZS_POOL_MAX);
}

static void set_config(struct job *job)
{
    const struct sim_options *o = &job->options;
    struct zs_config *c = &job->config;
    const int clips = sim_view_clips(&job->view, job->model.center, job->model.radius);
    struct sim_pools ample = sim_pools_of(job->model.n_tris, job->scene->n_verts, clips);
    if (sim_effects_any(&o->effects))
        ample = sim_effect_pools(&job->effect, &job->model, job->scene, &job->view);
    if (sim_methods[o->method].records && ample.tris < ZS_POOL_MAX)
        ample.tris = sim_method_pool(&sim_methods[o->method], (uint32_t)ample.tris);
    sim_frame_config(c, (uint16_t)o->size[0], (uint16_t)o->size[1], sim_scene_varyings(&job->scene->scene));
    c->strip_h = (uint16_t)(o->strip < o->size[1] ? o->strip : o->size[1]);
    c->max_tris = pool_size(o->tris, ample.tris, 1);
    c->max_verts = pool_size(o->verts, ample.verts, 3);
    c->buffers = (uint8_t)o->buffers;
    c->subpixel_bits = (uint8_t)o->subpixel;
    c->depth_bits = (uint8_t)o->depth_bits;
    c->fast = o->fast.list;
    c->depth = sim_depths[sim_depth_of(o, &job->view)].depth;
    sim_method_apply(c, &sim_methods[o->method]);
    if (sim_scene_method(&job->scene->scene) != NULL) {
        c->method = sim_scene_method(&job->scene->scene);
        c->max_tris = c->max_tris < 2 ? 2 : c->max_tris; /* its least pools */
        c->max_verts = c->max_verts < 6 ? 6 : c->max_verts;
    }
    if (o->style == SIM_STYLE_SOLID)
        return;
    /* a line or point is two triangles and four vertices; clipped, up to eight triangles of their own vertices */
    c->max_tris = pool_size(o->tris, (uint64_t)c->max_tris + (uint64_t)job->styled.n_lines * (clips ? 8u : 2u), 1);
    c->max_verts = pool_size(
        o->verts, (uint64_t)c->max_verts + job->scene->n_verts + (uint64_t)job->styled.n_lines * (clips ? 24u : 4u), 3);
    if (o->style == SIM_STYLE_HIDDEN_LINE && o->depth == SIM_DEPTH_DEFAULT && o->projection == ZS_PERSPECTIVE)
        c->depth = &zs_depth_recip; /* the bias of faces follows its slopes */
}

static int refuse_frame(const struct job *job, int err)
{
    const struct sim_view *v = &job->view;
    if (err == SIM_FRAME_BROKEN)
        return sim_refuse(job->model.file, 0, "the renderer broke its sink's contract");
    return sim_refuse(job->model.file, 0,
                      "the renderer cannot hold this view, near %.9g, far %.9g: %s", v->near_z,
                      v->far_z, zs_error_string(err));
}

/* The frame; with --panel its strips go there too. */
static int draw_strips(struct job *job)
{
    const struct sim_panel_wish *wish = &job->options.panel;
    const struct zs_sink sink = sim_panel_sink(&job->panel);
    if (wish->name != NULL) {
        const int status = sim_panel_begin(&job->panel, wish, job->options.model, job->config.strip_h);
        if (status != SIM_OK)
            return status;
    }
    const int err = sim_effects_any(&job->options.effects)
        ? sim_effect_draw(&job->effect, &job->frame, &job->config, "drawing", wish->name != NULL ? &sink : NULL)
        : job->options.threads > 0
        ? sim_frame_render_threads(&job->frame, job->drawn, &job->scene->camera, &job->config,
                                   (uint32_t)job->options.threads, &job->time)
        : sim_frame_render_to(&job->frame, job->drawn, &job->scene->camera, &job->config, "drawing",
                              wish->name != NULL ? &sink : NULL);
    if (err != ZS_OK && job->panel.err == HAL_ERR_NONE) {
        if (job->options.explain == 1)
            (void)sim_explain(job->options.model, job->drawn, &job->scene->camera, &job->config, job->scene->unit);
        return refuse_frame(job, err);
    }
    return wish->name != NULL ? sim_panel_check(&job->panel, wish, job->options.model) : SIM_OK;
}

/* Say what is wrong with the frame: if asked to; or if nothing is seen in it, to who looks on, as progress is said. */
static void explain(const struct job *job)
{
    const struct sim_frame *f = &job->frame;
    const size_t n = (size_t)f->width * f->height;
    const int asked = job->options.explain;
    size_t i = 0;
    while (i < n && f->rgb565[i] == job->drawn->background)
        i++;
    if (asked == 1 || (i == n && (asked == SIM_EXPLAIN_EMPTY || isatty(STDERR_FILENO))))
        (void)sim_explain(job->options.model, job->drawn, &job->scene->camera, &job->config, job->scene->unit);
}

/* All that a frame is drawn from. */
static int prepare(struct job *job)
{
    const struct sim_options *o = &job->options;
    struct sim_kept_scene *kept = job->kept != NULL ? job->kept : &job->own;
    int status = sim_kept_take(kept, &job->model, &job->view, o);
    job->scene = &kept->scene;
    if (status != SIM_OK)
        return status;
    job->drawn = &job->scene->scene;
    if (o->style != SIM_STYLE_SOLID) {
        static const struct zs_rgb white = ZS_RGB(0xffffff);
        struct sim_line_wish wish = o->lines;
        wish.style = (enum sim_style)o->style;
        wish.ink = o->has_color ? o->color : white;
        wish.width = (uint8_t)o->line_width;
        wish.crease = (zs_turn)(o->crease * 65536.0 / 360.0 + 0.5);
        status = sim_styled_make(&job->styled, job->drawn, &job->scene->camera, &wish);
        if (status != SIM_OK)
            return status;
        job->drawn = &job->styled.scene;
    }
    if (sim_effects_any(&o->effects)) {
        status = sim_effect_make(&job->effect, &job->model, job->scene, &job->view, o);
        if (status != SIM_OK)
            return status;
        job->drawn = &job->effect.scene;
    }
    set_config(job);
    return SIM_OK;
}

static int draw_frame(struct job *job)
{
    const struct sim_options *o = &job->options;
    const size_t pixels = (size_t)o->size[0] * (size_t)o->size[1];
    int status = prepare(job);
    if (status == SIM_OK)
        status = draw_strips(job);
    if (status != SIM_OK)
        return status;
    explain(job);
    int err = ZS_OK;
    if (o->id_out != NULL || o->compare || job->frame.no_keys) {
        job->id = sim_alloc(pixels, sizeof *job->id);
        err = sim_frame_ids(job->id, &job->scene->scene, &job->scene->camera, &job->config);
        sim_scene_file_ids(job->id, pixels, job->scene);
        if (err == ZS_OK && job->frame.no_keys)
            sim_frame_cover(&job->frame, job->id);
    }
    if (err == ZS_OK && o->compare && sim_options_textured(o) && o->effects.filter == SIM_FILTER_NEAREST) {
        job->texel = sim_alloc(pixels, sizeof *job->texel);
        err = sim_frame_texels(job->texel, &job->scene->scene, &job->scene->camera, &job->config);
    }
    if (err == ZS_OK && o->show != SIM_SHOW_FRAME)
        err = sim_show_draw(&job->shown, &job->show_sum, o->show, &job->scene->scene, &job->scene->camera, &job->config,
                            job->scene->unit);
    return err == ZS_OK ? SIM_OK : refuse_frame(job, err);
}

/* All around, into one file. */
static int draw_turn(struct job *job)
{
    const struct sim_options *o = &job->options;
    struct sim_moving turn = { 0 };
    int status = sim_scene_load(&job->model, &job->options);
    if (status == SIM_OK)
        status = sim_turntable_draw(&turn, job->turned, o, &job->model, (uint32_t)o->turntable);
    sim_progress_end();
    if (status == SIM_OK)
        status = sim_moving_save(o->out, &turn);
    sim_turntable_free(&turn);
    return status;
}

static int draw(struct job *job)
{
    const struct sim_options *o = &job->options;
    int status = sim_scene_load(&job->model, &job->options);
    if (status == SIM_OK)
        status = sim_view_plan(&job->view, o, &job->model);
    if (status == SIM_OK && !o->reference)
        status = draw_frame(job);
    if (status == SIM_OK && (o->reference || o->compare))
        status = sim_model_reference_render(&job->original, &job->model, &job->view, o);
    if (status == SIM_OK && o->compare) {
        const struct ref_image ours = { .rgb565 = job->frame.rgb565,
                                        .key = job->frame.no_keys || o->effects.has_alpha ? NULL : job->frame.key,
                                        .id = job->id, .texel = job->texel };
        if (ref_compare(&ours, &job->original.image, &job->original.depth, &job->original.camera,
                        job->view.width, job->view.height, &job->diff) != REF_OK)
            status = sim_refuse(o->model, 0, "the reference cannot compare these frames");
    }
    sim_progress_end();
    return status;
}

/* ---- Files ----------------------------------------------------------------------------------- */

static void stats_reference(struct sim_json *json, const struct job *job)
{
    const size_t n = (size_t)job->view.width * (size_t)job->view.height;
    double visible = 0.0;
    for (size_t i = 0; i < n; i++)
        visible += job->original.image.key[i] != ZS_DEPTH_CLEAR;
    sim_json_number(json, "triangles_in", (double)job->model.n_tris);
    sim_json_number(json, "pixels_visible", visible);
}

static void stats_view(struct sim_json *json, const struct job *job)
{
    const struct sim_view *v = &job->view;
    sim_json_number(json, "width", v->width);
    sim_json_number(json, "height", v->height);
    sim_json_vector(json, "eye", v->eye);
    sim_json_vector(json, "at", v->at);
    sim_json_vector(json, "up", v->up);
    sim_json_vector(json, "light", v->light);
    sim_json_number(json, "near", v->near_z);
    sim_json_number(json, "far", v->far_z);
    sim_json_number(json, "focal_px", v->orthographic ? 0.0 : v->focal);
    sim_json_number(json, "view_height", v->orthographic ? v->span : 0.0);
}

static void stats_diff(struct sim_json *json, const struct ref_diff *d)
{
    const double n = (double)d->pixels;
    sim_json_number(json, "compare_missing", (double)d->missing);
    sim_json_number(json, "compare_extra", (double)d->extra);
    sim_json_number(json, "compare_wrong_triangle", (double)d->id_differ);
    sim_json_number(json, "compare_wrong_fraction",
                    (double)(d->missing + d->extra + d->id_differ) / n);
    sim_json_number(json, "compare_key_max_diff", d->key_max_diff);
    sim_json_number(json, "compare_key_max_error", d->key_max_error);
    sim_json_number(json, "compare_key_off", (double)d->key_off);
    sim_json_number(json, "compare_z_mean_relative", d->z_mean_rel);
    sim_json_number(json, "compare_z_max_relative", d->z_max_rel);
    sim_json_number(json, "compare_channel_max_diff", d->channel_max_diff);
    sim_json_number(json, "compare_channel_off_one_fraction", d->off_one_fraction);
    sim_json_number(json, "compare_channel_off", (double)d->channel_off);
    sim_json_number(json, "compare_psnr_db", fmin(d->psnr_db, 999.0));
    sim_json_number(json, "compare_texels", (double)d->texels);
    sim_json_number(json, "compare_texel_differ", (double)d->texel_differ);
    sim_json_number(json, "compare_texel_far", (double)d->texel_far);
    sim_json_number(json, "compare_texel_max_distance", d->texel_max_distance);
}

static void stats_textures(struct sim_json *json, const struct sim_model *model)
{
    double texels = 0.0, resampled = 0.0;
    for (uint32_t i = 0; i < model->n_textures; i++) {
        const struct sim_texture *t = &model->texture[i];
        texels += (double)t->image.width * t->image.height;
        resampled += t->image.width != t->file_width || t->image.height != t->file_height;
    }
    sim_json_number(json, "textures", model->n_textures);
    sim_json_number(json, "texture_texels", texels);
    sim_json_number(json, "texture_resampled", resampled);
}

/* The frame's bytes, without those that set the panel up. */
static void stats_panel(struct sim_json *json, const struct job *job)
{
    const struct pm_counts *now = pm_counts(job->panel.model), *then = &job->panel.setup;
    const double bytes = (double)(now->bytes - then->bytes), hz = (double)job->options.spi_hz;
    sim_json_number(json, "panel_setup_bytes", (double)then->bytes);
    sim_json_number(json, "panel_bytes", bytes);
    sim_json_number(json, "panel_pixel_bytes", (double)(now->pixel_bytes - then->pixel_bytes));
    sim_json_number(json, "panel_transactions", (double)(now->transactions - then->transactions));
    sim_json_number(json, "panel_windows", (double)(now->windows - then->windows));
    sim_json_number(json, "panel_spi_hz", hz);
    sim_json_number(json, "panel_wire_us", 8e6 * bytes / hz);
}

static void write_stats(FILE *f, const struct job *job)
{
    const struct sim_options *o = &job->options;
    struct sim_json json;
    sim_json_begin(&json, f);
    sim_json_number(&json, "reference", o->reference);
    if (o->reference)
        stats_reference(&json, job);
    else
        sim_stats_frame(&json, &job->frame, &job->config);
    stats_view(&json, job);
    stats_textures(&json, &job->model);
    if (!o->reference) {
        sim_json_number(&json, "strip_rows", job->config.strip_h);
        sim_json_number(&json, "parts", (double)job->scene->n_parts);
        sim_json_number(&json, "vertices_in", (double)job->scene->n_verts);
        sim_json_number(&json, "quantisation_step", job->scene->step);
        sim_json_number(&json, "quantisation_error", job->scene->error);
        sim_json_number(&json, "world_unit", job->scene->unit);
        sim_json_number(&json, "uv_bits_least", job->scene->uv_bits_least);
        sim_json_number(&json, "uv_error_texels", job->scene->uv_error);
        sim_json_number(&json, "texture_psnr_db", fmin(job->scene->psnr_db, 999.0));
    }
    if (o->panel.name != NULL)
        stats_panel(&json, job);
    if (o->threads > 0) {
        sim_json_number(&json, "threads", (double)o->threads);
        sim_json_number(&json, "thread_parts", job->time.parts);
        sim_json_number(&json, "draw_us", 1e6 * job->time.wall);
        sim_json_number(&json, "draw_busiest_us", 1e6 * job->time.busiest);
    }
    if (o->show > SIM_SHOW_DEPTH) {
        sim_json_number(&json, "show_sum", job->show_sum.sum);
        sim_json_number(&json, "show_most", job->show_sum.most);
    }
    if (o->compare)
        stats_diff(&json, &job->diff);
    sim_json_end(&json);
}

static void names(const struct sim_options *o, const char *name[N_OUTPUTS])
{
    name[0] = o->out;
    name[1] = o->depth_out;
    name[2] = o->id_out;
    name[3] = o->stats;
}

/* What is seen of a frame that is drawn. */
static void picture_of(struct sim_picture *seen, const struct job *job)
{
    const uint32_t w = (uint32_t)job->view.width, h = (uint32_t)job->view.height;
    if (job->options.panel.name != NULL)
        sim_panel_picture(seen, job->panel.model, &job->panel.glass, job->options.panel.turns);
    else
        sim_picture_565(seen, w, h, job->options.reference ? job->original.image.rgb565 : job->frame.rgb565);
}

/* One file of the four. */
static int write_one(FILE *f, const struct job *job, int which, const char *name)
{
    const int is_reference = job->options.reference;
    const struct ref_image *ref = &job->original.image;
    const uint32_t w = (uint32_t)job->view.width, h = (uint32_t)job->view.height;
    const size_t n = (size_t)w * h;
    if (which == 0 && job->options.show != SIM_SHOW_FRAME)
        return sim_png_write(f, name, job->shown.width, job->shown.height, job->shown.rgb);
    if (which == 0) {
        struct sim_picture seen;
        picture_of(&seen, job);
        const int status = sim_png_write(f, name, seen.width, seen.height, seen.rgb);
        sim_picture_free(&seen);
        return status;
    }
    if (which == 1)
        sim_pgm_write(f, w, h, is_reference ? ref->key : job->frame.key);
    else if (which == 2)
        sim_u32_write(f, is_reference ? ref->id : job->id, n);
    else
        write_stats(f, job);
    return SIM_OK;
}

static int write_files(const struct job *job)
{
    const char *name[N_OUTPUTS];
    struct sim_output out[N_OUTPUTS];
    size_t n = 0;
    int status = SIM_OK;
    names(&job->options, name);
    for (int i = 0; status == SIM_OK && i < N_OUTPUTS; i++) {
        if (name[i] == NULL)
            continue;
        status = sim_output_open(&out[n], name[i]);
        if (status == SIM_OK)
            status = write_one(out[n++].file, job, i, name[i]);
    }
    return sim_output_end(status, out, n);
}

/* Before the work, what can be known about the files. */
static int check_files(const struct sim_options *o)
{
    const char *name[N_OUTPUTS];
    names(o, name);
    for (int i = 0; i < N_OUTPUTS; i++) {
        if (name[i] == NULL)
            continue;
        for (int k = 0; k < i; k++)
            if (name[k] != NULL && sim_output_same(name[i], name[k]))
                return sim_refuse(name[i], 0, "is named for two outputs; give each its own");
        const int status = sim_output_check(name[i], o->model);
        if (status != SIM_OK)
            return status;
    }
    return SIM_OK;
}

/* ---- Command --------------------------------------------------------------------------------- */

static void print_diff(const struct ref_diff *d)
{
    (void)printf(
        "%zu of %zu pixels drawn in the reference; missing %zu, extra %zu, another triangle "
        "%zu. Depth: at most %.3f keys from the exact one, %zu of %zu more than 1 apart, mean "
        "relative error of z %.2g. Colour: %.2f %% of channel values one code off, %zu more "
        "than one (at most %d), PSNR %.1f dB.\n",
        d->ref_drawn, d->pixels, d->missing, d->extra, d->id_differ, d->key_max_error, d->key_off,
        d->key_compared, d->z_mean_rel, 100.0 * d->off_one_fraction, d->channel_off,
        d->channel_max_diff, d->psnr_db);
    if (d->texels > 0)
        (void)printf("Texels: %zu of %zu are not the reference's, %zu of them more than 1/8 texel "
                     "from where they belong (at most %.3f). Colours are compared where they "
                     "are.\n",
                     d->texel_differ, d->texels, d->texel_far, d->texel_max_distance);
}

static void job_free(struct job *job)
{
    sim_picture_free(&job->shown);
    sim_model_reference_free(&job->original);
    free(job->id);
    free(job->texel);
    sim_frame_free(&job->frame);
    sim_panel_free(&job->panel);
    sim_styled_free(&job->styled);
    sim_effect_free(&job->effect);
    sim_kept_free(&job->own);
    sim_model_free(&job->model);
    free(job);
}

static void say_losses(const struct job *job)
{
    char lead[4200];
    (void)snprintf(lead, sizeof lead, "%s: %s: ", sim_program, job->options.model);
    sim_lost_materials_print(stderr, lead, job->model.lost_materials);
    sim_losses_print(stderr, lead, job->scene != NULL ? job->scene->lost : job->turned);
}

int sim_render(int argc, char **argv)
{
    struct job *job = sim_alloc(1, sizeof *job);
    int status = sim_options_parse(&job->options, argc, argv);
    if (status == SIM_OK && job->options.help) {
        sim_options_help();
    } else {
        if (status == SIM_OK)
            status = check_files(&job->options);
        if (status == SIM_OK)
            status = job->options.turntable != 0 ? draw_turn(job) : draw(job);
        if (status == SIM_OK && job->options.turntable == 0)
            status = write_files(job);
        if (status == SIM_OK)
            say_losses(job);
        if (status == SIM_OK)
            sim_simplify_print(stdout, "", &job->model);
        if (status == SIM_OK && job->options.compare)
            print_diff(&job->diff);
    }
    job_free(job);
    return status;
}

/* ---- A frame for other programs ---------------------------------------------------------------- */

int sim_render_all(struct sim_rendered *out, struct sim_kept_scene *kept, const struct sim_model *model,
                   const struct sim_options *o)
{
    static const struct sim_model none;
    struct job *job = sim_alloc(1, sizeof *job);
    memset(out, 0, sizeof *out);
    job->options = *o;
    job->model = *model;
    job->kept = kept;
    int status = sim_view_plan(&job->view, o, model);
    if (status == SIM_OK)
        status = draw_frame(job);
    if (status == SIM_OK) {
        if (o->panel.name != NULL && o->show == SIM_SHOW_FRAME)
            picture_of(&job->shown, job);
        *out = (struct sim_rendered){
            .view = job->view, .config = job->config, .frame = job->frame, .shown = job->shown,
            .parts = job->scene->n_parts, .verts = job->scene->n_verts
        };
        memcpy(out->lost, job->scene->lost, sizeof out->lost);
        memset(&job->frame, 0, sizeof job->frame); /* the caller's */
        memset(&job->shown, 0, sizeof job->shown);
    }
    job->model = none; /* the caller's */
    job_free(job);
    return status;
}

int sim_render_scene(struct sim_kept_scene *kept, const struct sim_model *model, const struct sim_options *o,
                     int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx)
{
    static const struct sim_model none;
    struct job *job = sim_alloc(1, sizeof *job);
    job->options = *o;
    job->model = *model;
    job->kept = kept;
    int status = sim_view_plan(&job->view, o, model), err = ZS_OK;
    if (status == SIM_OK)
        status = prepare(job);
    const int effects = sim_effects_any(&o->effects);
    if (status == SIM_OK && effects && (err = sim_effect_config(&job->effect, &job->config)) != ZS_OK)
        status = refuse_frame(job, err);
    if (status == SIM_OK) {
        const struct zs_pass whole = { .scene = job->drawn, .camera = &job->scene->camera };
        const struct sim_drawn_scene drawn = {
            .scene = job->drawn,
            .pass = effects ? job->effect.pass : &whole,
            .camera = effects ? &job->effect.camera : &job->scene->camera,
            .passes = effects ? job->effect.n_passes : 1u,
            .config = job->config,
            .samples = effects ? job->effect.samples : 1,
            .data_bytes = job->scene->data_bytes
        };
        status = use(ctx, &drawn);
    }
    job->model = none; /* the caller's */
    job_free(job);
    return status;
}

void sim_rendered_show(struct sim_rendered *r)
{
    if (r->shown.rgb == NULL)
        sim_picture_565(&r->shown, r->frame.width, r->frame.height, r->frame.rgb565);
}

int sim_render_model(struct sim_picture *seen, struct sim_kept_scene *kept, const struct sim_model *model,
                     const struct sim_options *o)
{
    static const struct sim_picture empty;
    struct sim_rendered r;
    const int status = sim_render_all(&r, kept, model, o);
    if (status == SIM_OK) {
        sim_rendered_show(&r);
        *seen = r.shown;
        r.shown = empty; /* the caller's */
    }
    sim_render_free(&r);
    return status;
}

void sim_render_free(struct sim_rendered *r)
{
    sim_frame_free(&r->frame);
    sim_picture_free(&r->shown);
    memset(r, 0, sizeof *r);
}
