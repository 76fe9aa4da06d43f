/* Demo scenes.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "engine.h"
#include "explanation.h"
#include "method_names.h"
#include "piece_frame.h"
#include "pieces.h"
#include "sim.h"
#include "truth.h"

static const struct demo *scene_at(uint32_t i)
{
    return i < n_demos ? demos[i] : &pieces[i - n_demos]->demo;
}

static const struct piece *piece_of(const struct demo *scene)
{
    for (uint32_t i = 0; i < n_pieces; i++)
        if (scene == &pieces[i]->demo)
            return pieces[i];
    return NULL;
}

int web_scene_is_piece(const struct demo *scene)
{
    return piece_of(scene) != NULL;
}

const struct demo *web_scene_named(const char *name)
{
    for (uint32_t i = 0; i < n_demos + n_pieces; i++)
        if (strcmp(scene_at(i)->name, name) == 0)
            return scene_at(i);
    return NULL;
}

WEB_EXPORT(scenes) const char *web_scenes(void)
{
    FILE *f = answer_begin();
    for (uint32_t i = 0; i < n_demos + n_pieces; i++) {
        const struct demo *scene = scene_at(i);
        static struct demo_frame at;
        uint64_t tris = 0;
        int textured = 0;
        scene->pose(&at, 0, scene->width, scene->height);
        for (uint32_t k = 0; k < at.scene.n_instances; k++) {
            tris += at.scene.instance[k].mesh->n_tris;
            textured |= at.scene.instance[k].material->texture != NULL;
        }
        (void)fprintf(f, "%s{\"name\":", i > 0 ? "," : "[");
        answer_text(f, scene->name);
        (void)fputs(",\"text\":", f);
        answer_text(f, scene->what);
        (void)fprintf(f,
                      ",\"width\":%u,\"height\":%u,\"frames\":%u,\"triangles\":%u,\"textured\":%s,"
                      "\"moving\":%s,"
                      "\"bench\":%s,\"effects\":%s}",
                      scene->width, scene->height, scene->frames, (unsigned)tris,
                      textured ? "true" : "false", scene->frames > 1 ? "true" : "false",
                      scene->bench ? "true" : "false", piece_of(scene) != NULL ? "true" : "false");
    }
    (void)fputs("]", f);
    return answer_end();
}

static uint16_t pool(long wanted)
{
    return (uint16_t)(wanted > 0 && wanted < ZS_POOL_MAX ? wanted : ZS_POOL_MAX);
}

void web_scene_config(struct zs_config *config, const struct demo *scene,
                      const struct sim_options *o)
{
    static const struct zs_depth *const depths[] = {
        [SIM_DEPTH_RECIP] = &zs_depth_recip, [SIM_DEPTH_LINEAR] = &zs_depth_linear,
        [SIM_DEPTH_E3M13] = &zs_depth_e3m13, [SIM_DEPTH_E4M12] = &zs_depth_e4m12,
        [SIM_DEPTH_E5M11] = &zs_depth_e5m11, [SIM_DEPTH_FLOAT] = &zs_depth_float,
    };
    const int own = !o->has_size && o->panel.name == NULL;
    const uint16_t width = own ? scene->width : (uint16_t)o->size[0],
                   height = own ? scene->height : (uint16_t)o->size[1];
    sim_frame_config(config, width, height, (uint8_t)scene->varyings);
    config->strip_h = (uint16_t)(o->strip < height ? o->strip : height);
    config->max_tris = pool(o->tris);
    config->max_verts = pool(o->verts);
    config->buffers = (uint8_t)o->buffers;
    config->subpixel_bits = (uint8_t)o->subpixel;
    config->depth_bits = (uint8_t)o->depth_bits;
    config->fast = o->fast.list;
    config->depth = o->depth == SIM_DEPTH_DEFAULT ? scene->depth : depths[o->depth];
    sim_method_apply(config, &sim_methods[o->method]);
    const struct piece *piece = piece_of(scene);
    if (piece != NULL && piece->method != NULL)
        config->method = piece->method;
}

/* What the glass of a panel shows of a frame, where its levels are fewer than the frame's. */
static int through_panel(struct sim_rendered *out, const struct demo *scene,
                         const struct sim_options *o)
{
    struct sim_panel_frame panel;
    const struct zs_config *c = &out->config;
    const size_t row = (size_t)c->width * 2u;
    int status = sim_panel_begin(&panel, &o->panel, scene->name, c->strip_h);
    const struct zs_sink sink = sim_panel_sink(&panel);
    uint8_t *px = sim_alloc(row * c->strip_h, 1);
    for (uint32_t y = 0; status == SIM_OK && y < c->height; y += c->strip_h) {
        const uint16_t h = (uint16_t)(c->height - y < c->strip_h ? c->height - y : c->strip_h);
        const uint16_t *from = out->frame.rgb565 + (size_t)y * c->width;
        for (size_t i = 0; i < row / 2u * h; i++) {
            px[2 * i] = (uint8_t)(from[i] >> 8);
            px[2 * i + 1] = (uint8_t)from[i];
        }
        const struct zs_strip strip = { .y = (uint16_t)y,
                                        .w = c->width,
                                        .h = h,
                                        .px = px,
                                        .n_bytes = (uint32_t)row * h,
                                        .dirty_w = c->width };
        if (sink.submit(sink.ctx, &strip) || sink.wait(sink.ctx))
            break;
    }
    if (status == SIM_OK)
        status = sim_panel_check(&panel, &o->panel, scene->name);
    if (status == SIM_OK)
        sim_panel_picture(&out->shown, panel.model, &panel.glass, o->panel.turns);
    sim_panel_free(&panel);
    free(px);
    return status;
}

static int has_levels(const struct sim_options *o)
{
    struct pm_glass glass;
    return o->panel.name != NULL && sim_panel_glass(&o->panel, NULL, &glass) == SIM_OK &&
           pm_glass_format(&glass) != PM_RGB565;
}

/* The frame against the reference's. */
static int compare(struct sim_rendered *out, const struct demo *scene, const struct demo_frame *at)
{
    struct sim_truth truth;
    if (piece_of(scene) != NULL)
        return sim_refuse(scene->name, 0, "effects have no reference; choose a scene without");
    if (out->frame.no_keys) {
        uint32_t *id = sim_alloc((size_t)out->config.width * out->config.height, sizeof *id);
        if (sim_frame_ids(id, &at->scene, &at->camera, &out->config) == ZS_OK)
            sim_frame_cover(&out->frame, id);
        free(id);
    }
    const int err = sim_truth_draw(&truth, &at->scene, &at->camera, &out->config);
    if (err == SIM_OK)
        web_wrong_draw(&out->shown, &web.wrong, &out->frame, &truth.image);
    sim_truth_free(&truth);
    return err == SIM_OK ? SIM_OK
                         : sim_refuse(scene->name, 0, "the reference could not draw it (%d)", err);
}

int web_scene_draw(struct sim_rendered *out, const struct demo *scene, const struct sim_options *o)
{
    const struct piece *piece = piece_of(scene);
    static struct demo_frame at;
    memset(out, 0, sizeof *out);
    web_scene_config(&out->config, scene, o);
    scene->pose(&at, web.time % scene->frames, out->config.width, out->config.height);
    if (piece == NULL)
        web_scene_orbit(&at, &web.orbit);
    int err = piece != NULL
                  ? sim_piece_render(&out->frame, piece, &at, &out->config, NULL, NULL)
                  : sim_frame_render(&out->frame, &at.scene, &at.camera, &out->config, NULL);
    if (err == ZS_OK && o->show != SIM_SHOW_FRAME)
        err = sim_show_draw(&out->shown, NULL, o->show, &at.scene, &at.camera, &out->config, 1.0);
    if (o->explain && piece == NULL)
        (void)sim_explain(scene->name, &at.scene, &at.camera, &out->config, 1.0);
    const int wrong = err == ZS_OK && o->compare && compare(out, scene, &at) != SIM_OK;
    if (err == ZS_OK && !wrong &&
        (o->compare || !has_levels(o) || through_panel(out, scene, o) == SIM_OK))
        return SIM_OK;
    sim_render_free(out);
    return err == ZS_OK ? SIM_REFUSED
                        : sim_refuse(scene->name, 0, "%s",
                                     err == SIM_FRAME_BROKEN ? "its frame could not be drawn"
                                                             : zs_error_string(err));
}
