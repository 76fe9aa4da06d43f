/* A scene with effects, and how it becomes a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"
#include "zs_supersample.h"

/* ---- Hooks ----------------------------------------------------------------------------------------------------- */

static struct zs_resolve *next_hook(struct sim_effect_scene *out)
{
    out->scene.resolve = out->hooks->hook;
    return &out->hooks->hook[out->scene.n_resolves++];
}

static int make_fog(struct sim_effect_scene *out, const struct sim_scene *from, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    struct zs_fog *fog = &out->hooks->fog;
    const double unit = from->unit;
    if (e->fog_end / unit > INT32_MAX - 1)
        return sim_refuse(o->model, 0, "--fog %s ends too far away beside the model; at most at %.3g", e->fog_text,
                          unit * (INT32_MAX - 1));
    fog->color = zs_rgb565(e->fog_rgb.r, e->fog_rgb.g, e->fog_rgb.b);
    if (e->fog == SIM_FOG_LINEAR) {
        fog->start = (int32_t)lrint(e->fog_start / unit);
        fog->end = (int32_t)lrint(e->fog_end / unit);
        fog->end = fog->end > fog->start ? fog->end : fog->start + 1;
    } else {
        const double end = 1.0 / (e->fog_density * unit);
        if (end > INT32_MAX - 1)
            return sim_refuse(o->model, 0, "--fog %s is too thin beside the model; its density can be %.3g or more",
                              e->fog_text, 1.0 / (unit * (INT32_MAX - 1)));
        fog->curve = ZS_FOG_EXPONENTIAL;
        fog->end = end < 1.0 ? 1 : (int32_t)lrint(end);
    }
    *next_hook(out) = (struct zs_resolve){ .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = fog };
    return SIM_OK;
}

static void make_levels(struct sim_effect_scene *out, const struct sim_effect_options *e)
{
    struct zs_dither *d = &out->hooks->dither;
    d->format = e->levels == SIM_LEVELS_MONO ? &zs_dither_mono : &zs_dither_grey4;
    d->pattern = e->dither == SIM_DITHER_ORDERED ? &zs_dither_ordered : &zs_dither_blue;
    *next_hook(out) = (struct zs_resolve){ .draw = zs_dither_draw, .ctx = d };
}

/* ---- A scene --------------------------------------------------------------------------------------------------- */
int sim_effect_make(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                    const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const uint32_t n = from->scene.n_instances;
    memset(out, 0, sizeof *out);
    out->scene = from->scene;
    out->camera = from->camera;
    out->samples = e->samples;
    out->method = sim_scene_method(&from->scene);
    out->varyings = sim_scene_varyings(&from->scene);
    out->instance = sim_alloc(2 * (size_t)n + 2, sizeof *out->instance); /* the model, a floor, shadows */
    memcpy(out->instance, from->scene.instance, n * sizeof *out->instance);
    out->scene.instance = out->instance;
    out->hooks = sim_alloc(1, sizeof *out->hooks);
    int status = sim_effect_surfaces(out, n, from, view, o);
    if (status == SIM_OK && e->fog != SIM_FOG_NONE)
        status = make_fog(out, from, o);
    if (e->dither != SIM_DITHER_NONE && e->levels != SIM_LEVELS_565)
        make_levels(out, e);
    return status == SIM_OK ? sim_effect_ground(out, model, from, view, o) : status;
}

void sim_effect_free(struct sim_effect_scene *s)
{
    sim_effect_surfaces_free(s->surface);
    sim_effect_ground_free(s->ground);
    SIM_FREE(s->instance, s->hooks);
    memset(s, 0, sizeof *s);
}

/* ---- Pools ----------------------------------------------------------------------------------------------------- */

/* Could any triangle of an instance beside the model be clipped? By its sphere; view: as the camera sees. */
static int may_clip(const struct zs_instance *in, const struct sim_scene *from, const struct sim_view *view)
{
    const struct zs_mesh *mesh = in->mesh;
    const double step = (mesh->scale ? mesh->scale / 65536.0 : 1.0) * (in->pose.scale ? in->pose.scale / 65536.0 : 1.0);
    const double far = sqrt(1.0 * mesh->center[0] * mesh->center[0] + 1.0 * mesh->center[1] * mesh->center[1] +
                            1.0 * mesh->center[2] * mesh->center[2]);
    double center[3];
    for (int k = 0; k < 3; k++)
        center[k] = from->origin[k] + from->unit * in->pose.pos[k];
    return sim_view_clips(view, center, (mesh->radius + far) * step * from->unit);
}

struct sim_pools sim_effect_pools(const struct sim_effect_scene *s, const struct sim_model *model,
                                  const struct sim_scene *from, const struct sim_view *view)
{
    const struct sim_effect_ground *g = s->ground;
    struct sim_view seen = *view;
    struct sim_pools all = { 0, 0 };
    seen.near_z = (double)s->camera.z_near / 65536.0 * from->unit;
    seen.far_z = (double)s->camera.z_far / 65536.0 * from->unit;
    if (s->samples > 1) {
        seen.focal *= 2.0;
        seen.height *= 2;
    }
    double image[3] = { 0 }; /* of the model's middle in the floor */
    if (g != NULL) {
        double to[3];
        sim_sub(to, model->center, g->floor.point);
        for (int k = 0; k < 3; k++)
            image[k] = model->center[k] - 2.0 * sim_dot(to, g->floor.up) * g->floor.up[k];
    }
    const int mirrored = g != NULL && g->mirror.ops != NULL;
    const int clips[2] = { sim_view_clips(&seen, model->center, model->radius),
                           mirrored && sim_view_clips(&seen, image, model->radius) };
    for (uint32_t i = 0; i < s->scene.n_instances; i++) {
        const struct zs_instance *in = &s->instance[i];
        const int beside = g != NULL && (in->mesh == &g->floor.mesh || (in->mesh >= g->shadow && in->mesh <
                                                                        g->shadow + g->n_shadows));
        for (int k = 0; k <= (mirrored && !beside); k++) {
            const struct sim_pools one = sim_pools_of(in->mesh->n_tris, in->mesh->n_verts,
                                                      beside ? may_clip(in, from, &seen) : clips[k]);
            all.tris += one.tris;
            all.verts += one.verts;
        }
    }
    return all;
}

const struct zs_scene *sim_effect_mirrored(const struct sim_effect_scene *s)
{
    return s->ground != NULL && s->ground->mirror.ops != NULL ? &s->ground->seen : NULL;
}

/* ---- Frames ---------------------------------------------------------------------------------------------------- */

static int draw(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    const struct sim_effect_scene *s = ctx;
    struct zs_supersample samples;
    if (s->samples > 1) {
        const int err = zs_supersample_init(&samples, r, sink);
        if (err != ZS_OK)
            return err;
        sink = &samples.sink;
    }
    if (s->ground == NULL || s->ground->mirror.ops == NULL)
        return zs_render(r, &s->scene, &s->camera, sink);
    struct zs_pass_memory memory[2];
    const struct zs_pass pass[2] = {
        { .scene = &s->scene, .camera = &s->camera },
        { .scene = &s->ground->seen, .camera = &s->camera, .mirror = &s->ground->mirror, .mask = &zs_mask_window }
    };
    return zs_render_passes(r, pass, memory, 2, sink);
}

int sim_effect_config(struct sim_effect_scene *s, struct zs_config *c)
{
    if (s->hooks->hook[0].draw == zs_fog_draw) {
        const int err = zs_fog_set(&s->hooks->fog, c, &s->camera);
        if (err != ZS_OK)
            return err;
    }
    if (c->varyings < s->varyings)
        c->varyings = s->varyings;
    c->method = s->method;
    if (s->method != NULL) { /* least pools of zs_method_transparent */
        c->max_tris = c->max_tris < 2 ? 2 : c->max_tris;
        c->max_verts = c->max_verts < 6 ? 6 : c->max_verts;
    }
    if (s->samples > 1) {
        c->width = (uint16_t)(2 * c->width);
        c->height = (uint16_t)(2 * c->height);
        c->strip_h = (uint16_t)(2 * c->strip_h);
        s->camera.focal *= 2;
    }
    return ZS_OK;
}

int sim_effect_draw(const struct sim_effect_scene *scene, struct sim_frame *frame, const struct zs_config *config,
                    const char *what, const struct zs_sink *to)
{
    struct sim_effect_scene s = *scene;
    struct zs_config c = *config;
    const struct sim_drawing drawing = { draw, &s, config->width, config->height, s.samples > 1 };
    const int err = sim_effect_config(&s, &c);
    return err != ZS_OK ? err : sim_frame_render_by(frame, &drawing, &c, what, to);
}
