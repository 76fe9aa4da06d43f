/* Instances of the model with other materials; what is drawn beside it; how it becomes a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "floor.h"
#include "sim.h"
#include "vec.h"
#include "zs_dither.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_shadow.h"
#include "zs_blend.h"
#include "zs_supersample.h"

/* One material for each of the model's, in the form that its shader takes. */
struct sim_effect_surface {
    struct zs_blend *blend;
    struct zs_material *plain; /* with another shader */
    struct zs_lit_material *lit;
    struct zs_lamp lamp[SIM_LIGHTS_MAX];
    struct zs_lighting lighting;
    struct zs_shine shine;
};

/* What is drawn beside the model. */
struct sim_effect_ground {
    struct sim_floor floor;
    struct zs_mesh *shadow; /* of each of the model's parts */
    int16_t (**pos)[3];     /* its vertices */
    uint32_t n_shadows;
    struct zs_material shade;
};

/* Hooks over strips that are drawn, in this order. */
#define HOOKS_MAX 2
struct sim_effect_hooks {
    struct zs_resolve hook[HOOKS_MAX];
    struct zs_fog fog;
    struct zs_dither dither;
};

/* Shaders in place of the plain ones. */
struct shaders {
    const struct zs_shader *raw, *flat, *smooth, *texture, *texture_flat, *texture_smooth;
};
#define SHADERS(family)                                                                                                \
    {                                                                                                                  \
        &zs_##family##_raw, &zs_##family##_flat, &zs_##family##_smooth, &zs_##family##_texture,                        \
            &zs_##family##_texture_flat, &zs_##family##_texture_smooth                                                 \
    }

static const struct zs_shader *in_place_of(const struct shaders *of, const struct zs_shader *plain)
{
    return plain == &zs_shade_raw            ? of->raw
           : plain == &zs_shade_flat         ? of->flat
           : plain == &zs_shade_smooth       ? of->smooth
           : plain == &zs_shade_texture      ? of->texture
           : plain == &zs_shade_texture_flat ? of->texture_flat
                                             : of->texture_smooth;
}

/* ---- Surfaces -------------------------------------------------------------------------------------------------- */

static void make_transparent(struct sim_effect_scene *out, uint32_t n, const struct sim_effect_options *e)
{
    static const struct shaders families[] = { SHADERS(blend), SHADERS(add), SHADERS(stipple) };
    out->surface->blend = sim_alloc(n, sizeof *out->surface->blend);
    for (uint32_t i = 0; i < n; i++) {
        struct zs_blend *m = &out->surface->blend[i];
        *m = (struct zs_blend){ .material = *out->instance[i].material, .alpha = (uint8_t)lround(e->alpha * 255.0) };
        m->material.shader = in_place_of(&families[e->blend], m->material.shader);
        out->instance[i].material = &m->material;
    }
    if (e->blend != SIM_BLEND_SCREEN_DOOR)
        out->method = &zs_method_transparent;
}

static struct zs_material *plain_materials(struct sim_effect_scene *out, uint32_t n)
{
    out->surface->plain = sim_alloc((size_t)n + 1, sizeof *out->surface->plain);
    for (uint32_t i = 0; i < n; i++) {
        out->surface->plain[i] = *out->instance[i].material;
        out->instance[i].material = &out->surface->plain[i];
    }
    return out->surface->plain;
}

/* Parts without a texture stay as they are. */
static void make_filtered(struct sim_effect_scene *out, uint32_t n, int filter)
{
    static const struct shaders of[] = {
        [SIM_FILTER_BILINEAR] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_bilinear,
                                  &zs_shade_bilinear_flat, &zs_shade_bilinear_smooth },
        [SIM_FILTER_MIPMAP] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_mipmap_bilinear,
                                &zs_shade_mipmap_bilinear_flat, &zs_shade_mipmap_bilinear_smooth },
    };
    struct zs_material *m = plain_materials(out, n);
    for (uint32_t i = 0; i < n; i++)
        m[i].shader = in_place_of(&of[filter], m[i].shader);
}

/* ---- Lights */

#define SPOT_FULL 18.0 /* degrees from a spot's axis up to which it is full, ... */
#define SPOT_DARK 28.0 /* ... and from which on it is dark */

static void set_dir(zs_q2_30 out[3], const double of[3])
{
    const double length = sqrt(of[0] * of[0] + of[1] * of[1] + of[2] * of[2]);
    for (int k = 0; k < 3; k++)
        out[k] = (zs_q2_30)lrint(of[k] / length * 1073741824.0);
}

static zs_q2_30 cosine(double degrees)
{
    return (zs_q2_30)lrint(cos(degrees * acos(-1.0) / 180.0) * 1073741824.0);
}

static int make_lamp(struct zs_lamp *lamp, const struct sim_light *of, const struct sim_scene *from,
                     const struct sim_view *view, const struct sim_options *o)
{
    double aim[3];
    *lamp = (struct zs_lamp){ .kind = (uint8_t)of->kind, .rgb = of->rgb,
                              .strength = (zs_uq16_16)lrint(fmax(o->diffuse, 1e-5) * 65536.0) };
    if (of->rgb.r == 0 && of->rgb.g == 0 && of->rgb.b == 0)
        lamp->rgb.b = 1; /* 0 would be white */
    if (of->kind == SIM_LIGHT_DIR) {
        set_dir(lamp->dir, of->at);
        return SIM_OK;
    }
    for (int k = 0; k < 3; k++) {
        const double at = (of->at[k] - from->origin[k]) / from->unit;
        if (fabs(at) > ZS_WORLD_MAX)
            return sim_refuse(o->model, 0, "--light %g,%g,%g is too far away beside the model", of->at[0], of->at[1],
                              of->at[2]);
        lamp->pos[k] = (int32_t)lrint(at);
        aim[k] = view->at[k] - of->at[k];
    }
    lamp->range = of->range > 0.0 ? (uint32_t)lrint(fmin(fmax(of->range / from->unit, 1.0), 1073741824.0)) : 0u;
    if (of->kind == SIM_LIGHT_SPOT) {
        if (aim[0] == 0.0 && aim[1] == 0.0 && aim[2] == 0.0)
            return sim_refuse(o->model, 0, "--light spot: it stands where it is aimed at; move it away from --at");
        set_dir(lamp->dir, aim);
        lamp->inner = cosine(SPOT_FULL);
        lamp->outer = cosine(SPOT_DARK);
    }
    return SIM_OK;
}

static uint8_t channel(double part)
{
    return (uint8_t)lrint(fmin(part, 1.0) * 255.0);
}

static int make_lighting(struct sim_effect_surface *s, const struct sim_scene *from, const struct sim_view *view,
                         const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const struct sim_light plain = { .kind = SIM_LIGHT_DIR, .at = { view->light[0], view->light[1], view->light[2] },
                                     .rgb = ZS_RGB(0xffffff) };
    const uint8_t ambient = channel(o->ambient);
    int status = SIM_OK;
    for (int k = 0; status == SIM_OK && k < e->n_lights; k++)
        status = make_lamp(&s->lamp[k], &e->light[k], from, view, o);
    if (e->n_lights == 0)
        status = make_lamp(&s->lamp[0], &plain, from, view, o);
    s->lighting = (struct zs_lighting){ .lamp = s->lamp, .n_lamps = e->n_lights > 0 ? (uint32_t)e->n_lights : 1u,
                                        .ambient = { ambient, ambient, ambient } };
    if (e->specular_text != NULL)
        (void)zs_shine_set(&s->shine, (uint32_t)e->specular_power);
    return status;
}

static int all_directional(const struct zs_lighting *lighting)
{
    for (uint32_t k = 0; k < lighting->n_lamps; k++)
        if (lighting->lamp[k].kind != ZS_LAMP_DIRECTIONAL)
            return 0;
    return 1;
}

static int make_lit(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from, const struct sim_view *view,
                    const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    struct sim_effect_surface *s = out->surface;
    const int status = make_lighting(s, from, view, o);
    const int phong = e->per_pixel, near_lamps = !all_directional(&s->lighting);
    const struct zs_shader *shader = phong && near_lamps               ? &zs_shade_phong_near
                                     : phong                           ? &zs_shade_phong
                                     : o->shade == SIM_SHADE_SMOOTH ? &zs_shade_lit
                                                                       : &zs_shade_lit_face;
    s->lit = sim_alloc((size_t)n + 1, sizeof *s->lit);
    for (uint32_t i = 0; i < n; i++) {
        struct zs_lit_material *m = &s->lit[i];
        *m = (struct zs_lit_material){ .material = *out->instance[i].material, .lighting = &s->lighting };
        m->material.shader = shader;
        if (e->specular_text != NULL) {
            const uint8_t white = channel(e->specular_strength);
            m->shine = &s->shine;
            m->specular = (struct zs_rgb){ white, white, white };
        }
        out->instance[i].material = &m->material;
    }
    out->varyings = shader->n_varyings;
    return status;
}

/* Colours of RGB565 are dithered as they are made, where there are more bits. */
static int make_dithered(struct sim_effect_scene *out, uint32_t n, const struct sim_scene *from,
                         const struct sim_options *o)
{
    static const struct zs_shader *const of[] = { [SIM_DITHER_ORDERED] = &zs_shade_smooth_ordered,
                                                  [SIM_DITHER_BLUE] = &zs_shade_smooth_blue };
    if (o->shade != SIM_SHADE_SMOOTH || out->instance[0].material != from->scene.instance[0].material)
        return sim_refuse(o->model, 0, "--dither: RGB565 colours are dithered with --shade smooth alone; for fewer colours "
                                       "name a grey or one-bit --panel");
    struct zs_material *m = plain_materials(out, n);
    for (uint32_t i = 0; i < n; i++)
        m[i].shader = of[o->effects.dither];
    return SIM_OK;
}

/* ---- The ground ------------------------------------------------------------------------------------------------ */

/* The camera's planes hold the floor, too, where they were not given. */
static void widen_planes(struct zs_camera *c, const struct sim_scene *from, const struct sim_view *view,
                         const struct sim_floor *floor, const struct sim_options *o)
{
    double to[3];
    sim_sub(to, floor->point, view->eye);
    const double z = -sim_dot(to, view->back), r = 1.42 * floor->half, scale = 65536.0 / from->unit;
    if (!o->has_far && c->z_far < llrint((z + r) * scale))
        c->z_far = llrint((z + r) * scale);
    if (!o->has_near && c->z_near > c->z_far / 400)
        c->z_near = c->z_far / 400;
}

/* The floor becomes the first instance. */
static void add_floor(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                      const struct sim_view *view, const struct sim_options *o)
{
    out->ground = sim_alloc(1, sizeof *out->ground);
    sim_floor_lay(&out->ground->floor, model, from, o->up);
    memmove(out->instance + 1, out->instance, out->scene.n_instances * sizeof *out->instance);
    out->instance[0] = out->ground->floor.instance;
    out->scene.n_instances++;
    widen_planes(&out->camera, from, view, &out->ground->floor, o);
}

static struct zs_shadow_light shadow_light(const struct sim_effect_scene *out, const struct sim_scene *from)
{
    struct zs_shadow_light light = { .point = 0 };
    const struct zs_lamp *lamp = out->surface->lamp;
    memcpy(light.dir, from->scene.light.dir, sizeof light.dir);
    if (out->surface->lighting.n_lamps > 0 && lamp->kind == ZS_LAMP_DIRECTIONAL)
        memcpy(light.dir, lamp->dir, sizeof light.dir);
    if (out->surface->lighting.n_lamps > 0 && lamp->kind != ZS_LAMP_DIRECTIONAL) {
        memcpy(light.pos, lamp->pos, sizeof light.pos);
        light.point = 1;
    }
    return light;
}

/* The shadows of the first light become the last instances. */
static int add_shadows(struct sim_effect_scene *out, const struct sim_scene *from, const struct sim_options *o)
{
    struct sim_effect_ground *g = out->ground;
    const uint32_t n = from->scene.n_instances;
    const struct zs_shadow_light light = shadow_light(out, from);
    struct zs_shadow_plane plane;
    for (int k = 0; k < 3; k++) {
        plane.normal[k] = (zs_q2_30)lrint(g->floor.up[k] * 1073741824.0);
        plane.at[k] = g->floor.instance.pose.pos[k];
    }
    g->shade = (struct zs_material){ .shader = &zs_shade_shadow, .rgb = { 96, 96, 96 }, .cull = ZS_CULL_NONE };
    g->shadow = sim_alloc((size_t)n + 1, sizeof *g->shadow);
    g->pos = sim_alloc((size_t)n + 1, sizeof *g->pos);
    g->n_shadows = n;
    for (uint32_t i = 0; i < n; i++) {
        const struct zs_instance *caster = &from->scene.instance[i];
        struct zs_instance *shadow = &out->instance[out->scene.n_instances];
        g->pos[i] = sim_alloc((size_t)caster->mesh->n_verts + 1, sizeof *g->pos[i]);
        *shadow = (struct zs_instance){ .material = &g->shade };
        const int err = zs_shadow_flatten(shadow, &g->shadow[i], g->pos[i], caster, &plane, &light);
        if (err == ZS_ERR_VECTOR)
            return sim_refuse(o->model, 0, "--shadow planar: the light comes from below the floor, or along it; put it higher");
        if (err != ZS_OK)
            return sim_refuse(o->model, 0, "--shadow planar: %s", zs_error_string(err));
        out->scene.n_instances++;
    }
    return SIM_OK;
}

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
        fog->curve = ZS_FOG_EXPONENTIAL;
        fog->end = end > INT32_MAX ? INT32_MAX : end < 1.0 ? 1 : (int32_t)lrint(end);
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
    const int lit = e->n_lights > 0 || e->specular_text != NULL || e->per_pixel;
    memset(out, 0, sizeof *out);
    out->scene = from->scene;
    out->camera = from->camera;
    out->samples = e->samples;
    out->instance = sim_alloc(2 * (size_t)n + 2, sizeof *out->instance);
    out->surface = sim_alloc(1, sizeof *out->surface);
    memcpy(out->instance, from->scene.instance, n * sizeof *out->instance);
    out->scene.instance = out->instance;
    out->hooks = sim_alloc(1, sizeof *out->hooks);
    int status = SIM_OK;
    if (lit)
        status = make_lit(out, n, from, view, o);
    if (status != SIM_OK)
        return status;
    if (e->has_alpha)
        make_transparent(out, n, e);
    if (e->filter != SIM_FILTER_NEAREST)
        make_filtered(out, n, e->filter);
    if (e->fog != SIM_FOG_NONE)
        status = make_fog(out, from, o);
    if (status != SIM_OK)
        return status;
    if (e->dither != SIM_DITHER_NONE && e->levels != SIM_LEVELS_565)
        make_levels(out, e);
    else if (e->dither != SIM_DITHER_NONE)
        status = make_dithered(out, n, from, o);
    if (status == SIM_OK && e->shadow != SIM_SHADOW_NONE)
        add_floor(out, model, from, view, o);
    if (status == SIM_OK && e->shadow == SIM_SHADOW_PLANAR)
        status = add_shadows(out, from, o);
    return status;
}

void sim_effect_free(struct sim_effect_scene *s)
{
    if (s->surface != NULL)
        SIM_FREE(s->surface->blend, s->surface->plain, s->surface->lit);
    for (uint32_t i = 0; s->ground != NULL && i < s->ground->n_shadows; i++)
        free(s->ground->pos[i]);
    if (s->ground != NULL)
        SIM_FREE(s->ground->shadow, s->ground->pos);
    SIM_FREE(s->instance, s->surface, s->hooks, s->ground);
    memset(s, 0, sizeof *s);
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
    return zs_render(r, &s->scene, &s->camera, sink);
}

int sim_effect_draw(const struct sim_effect_scene *scene, struct sim_frame *frame, const struct zs_config *config,
                    const char *what, const struct zs_sink *to)
{
    struct sim_effect_scene s = *scene;
    struct zs_config c = *config;
    const struct sim_drawing drawing = { draw, &s, config->width, config->height, s.samples > 1 };
    if (s.hooks->hook[0].draw == zs_fog_draw) {
        const int err = zs_fog_set(&s.hooks->fog, &c, &s.camera);
        if (err != ZS_OK)
            return err;
    }
    if (c.varyings < s.varyings)
        c.varyings = s.varyings;
    c.method = s.method;
    if (s.method != NULL) { /* least pools of zs_method_transparent */
        c.max_tris = c.max_tris < 2 ? 2 : c.max_tris;
        c.max_verts = c.max_verts < 6 ? 6 : c.max_verts;
    }
    if (s.samples > 1) {
        c.width = (uint16_t)(2 * c.width);
        c.height = (uint16_t)(2 * c.height);
        c.strip_h = (uint16_t)(2 * c.strip_h);
        s.camera.focal *= 2;
    }
    return sim_frame_render_by(frame, &drawing, &c, what, to);
}
