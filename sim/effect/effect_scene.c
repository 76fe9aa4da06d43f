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

static int set_fog(struct sim_effect_scene *out, const struct sim_scene *from, const struct sim_options *o)
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
    return SIM_OK;
}

static struct zs_scene *scene_of(struct sim_effect_scene *out, uint32_t pass)
{
    return pass > 0 ? &out->later[pass - 1] : &out->scene;
}

static struct zs_resolve *next_hook(struct sim_effect_scene *out, uint32_t pass)
{
    struct zs_scene *scene = scene_of(out, pass);
    scene->resolve = out->hooks->of_pass[pass];
    return &out->hooks->of_pass[pass][scene->n_resolves++];
}

static void add_fog(struct sim_effect_scene *out, uint32_t pass, struct zs_fog *fog)
{
    *next_hook(out, pass) = (struct zs_resolve){ .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = fog };
    out->pass[pass].early = pass + 1u < out->n_passes;
}

/* To the levels of a panel: the last hook of all. */
static void add_levels(struct sim_effect_scene *out, const struct sim_effect_options *e)
{
    struct zs_dither *d = &out->hooks->dither;
    d->format = e->levels == SIM_LEVELS_MONO ? &zs_dither_mono : &zs_dither_grey4;
    d->pattern = e->dither == SIM_DITHER_ORDERED ? &zs_dither_ordered : &zs_dither_blue;
    *next_hook(out, out->n_passes - 1u) = (struct zs_resolve){ .draw = zs_dither_draw, .ctx = d };
}

/* Layers have fog of their own; that of what is behind them comes before them, and that of a mirror's picture when the
 * picture is drawn. */
static void add_hooks(struct sim_effect_scene *out, const struct sim_effect_options *e)
{
    struct zs_fog *fog = &out->hooks->fog;
    const int layers = sim_effect_layered(e);
    if (e->fog != SIM_FOG_NONE && e->mirror) {
        out->hooks->mirrored = *fog;
        out->hooks->mirrored.sky = ZS_FOG_MASKED;
        fog->sky = ZS_FOG_WINDOWS;
        add_fog(out, 0, fog);
        if (!layers)
            add_fog(out, 1, &out->hooks->mirrored);
    } else if (e->fog != SIM_FOG_NONE && (!layers || out->n_passes > 1)) {
        add_fog(out, 0, fog);
    }
    if (e->dither != SIM_DITHER_NONE && e->levels != SIM_LEVELS_565)
        add_levels(out, e);
}

/* ---- Passes ---------------------------------------------------------------------------------------------------- */

/* The instances that are given out to passes. */
struct dealer {
    struct sim_effect_scene *out;
    struct zs_scene *to;
    uint32_t n, ghosts;
};

static void begin(struct dealer *d, uint32_t pass)
{
    d->to = scene_of(d->out, pass);
    if (pass > 0)
        *d->to = d->out->scene;
    d->to->instance = d->out->instance + d->n;
    d->to->n_instances = 0;
    d->out->pass[pass] = (struct zs_pass){ .scene = d->to, .camera = &d->out->camera };
    d->out->n_passes = pass + 1u;
}

static void deal(struct dealer *d, const struct zs_instance *in, uint32_t n)
{
    if (n > 0)
        memcpy(d->out->instance + d->n, in, n * sizeof *in);
    d->n += n;
    d->to->n_instances += n;
}

/* Passes that share keys have to reach equally far. */
static void deal_ghosts(struct dealer *d, const struct zs_instance *in, uint32_t n)
{
    static const struct zs_material none = { .shader = &zs_shade_raw };
    for (uint32_t i = 0; i < n; i++) {
        struct zs_instance ghost = in[i];
        struct zs_mesh *mesh = &d->out->ghost[d->ghosts++];
        *mesh = *in[i].mesh;
        mesh->n_tris = 0;
        mesh->n_clusters = 0;
        ghost.mesh = mesh;
        ghost.material = &none;
        ghost.depth_state = NULL;
        deal(d, &ghost, 1);
    }
}

/* Windows come last; after them what the mirror shows, and in front of it what is transparent. The floor hides nothing
 * of the model from an eye that sees the mirror. */
static void deal_mirror(struct dealer *d, uint32_t n, const struct sim_options *o)
{
    struct sim_effect_scene *out = d->out;
    struct sim_effect_ground *g = out->ground;
    const int layers = sim_effect_layered(&o->effects), shadows = o->effects.shadow != SIM_SHADOW_NONE;
    const struct zs_rgb b = o->background; /* a third of the way to grey, so that the glass is seen */
    if (shadows)
        deal(d, &g->matt.instance, 1);
    if (!layers)
        deal(d, out->model, n);
    deal(d, g->shade, g->n_shadows);
    deal(d, shadows ? &g->window.instance : &g->floor.instance, 1);
    begin(d, 1);
    d->to->background = zs_rgb565((uint8_t)((2 * b.r + 112) / 3), (uint8_t)((2 * b.g + 120) / 3),
                                  (uint8_t)((2 * b.b + 128) / 3));
    out->pass[1].mirror = &g->mirror;
    out->pass[1].mask = &zs_mask_window;
    deal(d, out->model, n);
    if (!layers)
        return;
    begin(d, 2);
    out->pass[2].keep = ZS_KEEP_COLOR;
    deal(d, out->model, n);
}

void sim_effect_passes(struct sim_effect_scene *out, uint32_t n, const struct sim_options *o)
{
    struct dealer d = { .out = out };
    const struct sim_effect_ground *g = out->ground;
    begin(&d, 0);
    if (o->effects.mirror) {
        deal_mirror(&d, n, o);
        return;
    }
    if (g != NULL)
        deal(&d, &g->floor.instance, 1);
    if (g == NULL || o->effects.fog == SIM_FOG_NONE || !sim_effect_layered(&o->effects)) {
        deal(&d, out->model, n);
        if (g != NULL)
            deal(&d, g->shade, g->n_shadows);
        return;
    }
    deal(&d, g->shade, g->n_shadows);
    deal_ghosts(&d, out->model, n);
    begin(&d, 1);
    out->pass[1].keep = ZS_KEEP_COLOR | ZS_KEEP_DEPTH;
    deal_ghosts(&d, &g->floor.instance, 1);
    deal_ghosts(&d, g->shade, g->n_shadows);
    deal(&d, out->model, n);
}

/* ---- A scene --------------------------------------------------------------------------------------------------- */

int sim_effect_make(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                    const struct sim_view *view, const struct sim_options *o)
{
    const uint32_t n = from->scene.n_instances;
    memset(out, 0, sizeof *out);
    out->scene = from->scene;
    out->camera = from->camera;
    out->samples = o->effects.samples;
    out->method = sim_scene_method(&from->scene);
    out->n_passes = 1;
    out->model = sim_alloc((size_t)n + 1, sizeof *out->model);
    out->instance = sim_alloc(5 * (size_t)n + 4, sizeof *out->instance); /* of the model 3 times, shadows twice */
    out->ghost = sim_alloc(2 * (size_t)n + 1, sizeof *out->ghost);
    memcpy(out->model, from->scene.instance, n * sizeof *out->model);
    out->hooks = sim_alloc(1, sizeof *out->hooks);
    int status = sim_effect_surfaces(out, n, from, view, o);
    if (status == SIM_OK && o->effects.fog != SIM_FOG_NONE)
        status = set_fog(out, from, o);
    status = status == SIM_OK ? sim_effect_ground(out, model, from, view, o) : status;
    status = status == SIM_OK ? sim_effect_coat(out, n, o) : status;
    if (status != SIM_OK)
        return status;
    sim_effect_passes(out, n, o);
    add_hooks(out, &o->effects);
    for (uint32_t p = 0; p < out->n_passes; p++)
        out->varyings = (uint8_t)fmax(out->varyings, sim_scene_varyings(out->pass[p].scene));
    return SIM_OK;
}

void sim_effect_free(struct sim_effect_scene *s)
{
    sim_effect_surfaces_free(s->surface);
    sim_effect_ground_free(s->ground);
    SIM_FREE(s->instance, s->model, s->ghost, s->hooks);
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

/* Is it the floor's, or a shadow's? */
static int is_beside(const struct sim_effect_ground *g, const struct zs_mesh *mesh)
{
    return mesh == &g->floor.mesh || mesh == &g->window.mesh || mesh == &g->matt.mesh ||
           (mesh >= g->shadow && mesh < g->shadow + g->n_shadows);
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
    const int clips[2] = { sim_view_clips(&seen, model->center, model->radius),
                           g != NULL && sim_view_clips(&seen, image, model->radius) };
    for (uint32_t p = 0; p < s->n_passes; p++)
        for (uint32_t i = 0; i < s->pass[p].scene->n_instances; i++) {
            const struct zs_instance *in = &s->pass[p].scene->instance[i];
            const int beside = g != NULL && is_beside(g, in->mesh);
            const struct sim_pools one = sim_pools_of(in->mesh->n_tris, in->mesh->n_tris > 0 ? in->mesh->n_verts : 0,
                                                      beside ? may_clip(in, from, &seen)
                                                             : clips[s->pass[p].mirror != NULL]);
            all.tris += one.tris;
            all.verts += one.verts;
        }
    return all;
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
    if (s->n_passes == 1)
        return zs_render(r, &s->scene, &s->camera, sink);
    struct zs_pass_memory memory[SIM_PASSES_MAX];
    struct zs_pass pass[SIM_PASSES_MAX];
    for (uint32_t p = 0; p < s->n_passes; p++) {
        pass[p] = s->pass[p];
        pass[p].camera = &s->camera;
    }
    return zs_render_passes(r, pass, memory, s->n_passes, sink);
}

int sim_effect_config(struct sim_effect_scene *s, struct zs_config *c)
{
    struct zs_fog *const fog[] = { &s->hooks->fog, &s->hooks->mirrored };
    for (int k = 0; k < 2; k++) {
        const int err = fog[k]->end > 0 ? zs_fog_set(fog[k], c, &s->camera) : ZS_OK;
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
