/* Demo scenes.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "demo_frame.h"
#include "engine.h"
#include "explanation.h"
#include "method_names.h"
#include "sim.h"
#include "reference_frame.h"

WEB_EXPORT(scenes) const char *web_scenes(void)
{
    FILE *f = answer_begin();
    for (uint32_t i = 0; i < sim_demo_count(); i++) {
        const struct demo *scene = sim_demo_at(i);
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
                      scene->bench ? "true" : "false", sim_demo_piece(scene) != NULL ? "true" : "false");
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
    config->depth = o->depth == SIM_DEPTH_DEFAULT ? scene->depth : sim_depths[o->depth].depth;
    sim_demo_method(config, scene, o->method);
}

int web_has_levels(const struct sim_options *o)
{
    struct pm_glass glass;
    return o->panel.name != NULL && sim_panel_glass(&o->panel, NULL, &glass) == SIM_OK &&
           pm_glass_format(&glass) != PM_RGB565;
}

/* The frame against the reference's. */
static int compare(struct sim_rendered *out, const struct demo *scene, const struct demo_frame *at)
{
    struct sim_reference_frame truth;
    if (sim_demo_piece(scene) != NULL)
        return sim_refuse(scene->name, 0, "effects have no reference; choose a scene without");
    if (out->frame.no_keys) {
        uint32_t *id = sim_alloc((size_t)out->config.width * out->config.height, sizeof *id);
        if (sim_frame_ids(id, &at->scene, &at->camera, &out->config) == ZS_OK)
            sim_frame_cover(&out->frame, id);
        free(id);
    }
    const int err = sim_reference_frame_draw(&truth, &at->scene, &at->camera, &out->config);
    if (err == SIM_OK)
        web_wrong_draw(&out->shown, &web.wrong, &out->frame, &truth.image);
    sim_reference_frame_free(&truth);
    return err == SIM_OK ? SIM_OK
                         : sim_refuse(scene->name, 0, "the reference could not draw it (%d)", err);
}

int web_scene_draw(struct sim_rendered *out, const struct demo *scene, const struct sim_options *o)
{
    const int piece = sim_demo_piece(scene) != NULL,
              levels = o->show == SIM_SHOW_FRAME && !o->compare && web_has_levels(o);
    static struct demo_frame at;
    struct sim_panel_frame panel = { 0 };
    const struct zs_sink sink = sim_panel_sink(&panel);
    memset(out, 0, sizeof *out);
    web_scene_config(&out->config, scene, o);
    sim_demo_pose(&at, scene, web.time % scene->frames, out->config.width, out->config.height, &web.orbit);
    int status = levels ? sim_panel_begin(&panel, &o->panel, scene->name, out->config.strip_h) : SIM_OK, err = ZS_OK;
    if (status == SIM_OK)
        err = sim_demo_render(&out->frame, scene, &at, &out->config, NULL, levels ? &sink : NULL);
    if (status == SIM_OK && levels)
        status = sim_panel_check(&panel, &o->panel, scene->name);
    if (status == SIM_OK && levels && err == ZS_OK)
        sim_panel_picture(&out->shown, panel.model, &panel.glass, o->panel.turns);
    if (err == ZS_OK && o->show != SIM_SHOW_FRAME)
        err = sim_show_draw(&out->shown, NULL, o->show, &at.scene, &at.camera, &out->config, 1.0);
    if (o->explain && !piece)
        (void)sim_explain(scene->name, &at.scene, &at.camera, &out->config, 1.0);
    if (status == SIM_OK && err != ZS_OK)
        status = sim_refuse(scene->name, 0, "%s",
                            err == SIM_FRAME_BROKEN ? "its frame could not be drawn" : zs_error_string(err));
    if (status == SIM_OK && o->compare)
        status = compare(out, scene, &at);
    sim_panel_free(&panel);
    if (status != SIM_OK)
        sim_render_free(out);
    return status;
}

int web_scene_scene(int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx)
{
    static struct demo_frame at;
    struct sim_drawn_scene drawn = { .scene = &at.scene, .camera = &at.camera, .passes = 1, .samples = 1 };
    web_scene_config(&drawn.config, web.scene, &web.chosen);
    sim_demo_pose(&at, web.scene, web.time % web.scene->frames, drawn.config.width, drawn.config.height, &web.orbit);
    return use(ctx, &drawn);
}
