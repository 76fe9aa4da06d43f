/* A floor below the model: in shadow, in a shadow map's light, or a mirror.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"

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

static void lay_floor(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                      const struct sim_view *view, const struct sim_options *o)
{
    struct sim_effect_ground *g = sim_alloc(1, sizeof *g);
    out->ground = g;
    sim_floor_lay(&g->floor, model, from, o->up);
    if (o->effects.mirror && o->effects.shadow != SIM_SHADOW_NONE) { /* light cells mirror, dark ones lie in shadow */
        sim_floor_half(&g->window, &g->floor, 0);
        sim_floor_half(&g->matt, &g->floor, 1);
    }
    widen_planes(&out->camera, from, view, &g->floor, o);
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

/* World units of a point above the floor. */
static double above(const struct sim_effect_ground *g, const double at[3])
{
    double up = 0.0;
    for (int k = 0; k < 3; k++)
        up += (at[k] - g->floor.instance.pose.pos[k]) * g->floor.up[k];
    return up;
}

/* Say what is wrong with a light that throws no shadow of a part, and what would be right. */
static int refuse_shadow(const struct sim_effect_ground *g, const struct zs_instance *caster,
                         const struct zs_shadow_light *light, const struct sim_scene *from,
                         const struct sim_options *o, int err)
{
    const struct zs_mesh *mesh = caster->mesh;
    const double step = (mesh->scale ? mesh->scale / 65536.0 : 1.0) *
                        (caster->pose.scale ? caster->pose.scale / 65536.0 : 1.0);
    double lamp[3], middle[3];
    for (int k = 0; k < 3; k++) {
        lamp[k] = light->pos[k];
        middle[k] = caster->pose.pos[k];
        for (int j = 0; j < 3; j++)
            middle[k] += mesh->center[j] * step * (caster->pose.rot[0] ? caster->pose.rot[3 * k + j] / 1073741824.0
                                                                       : j == k);
    }
    const double high = above(g, lamp), top = above(g, middle) + mesh->radius * step;
    if (light->point && high <= top * 257.0 / 256.0)
        return sim_refuse(o->model, 0,
                          "--shadow planar: the light is %.4g above the floor, and the model reaches up to %.4g, as a "
                          "sphere around its highest part: put the light above that, or take --shadow map",
                          high * from->unit, top * from->unit);
    if (err == ZS_ERR_VECTOR)
        return sim_refuse(o->model, 0,
                          "--shadow planar: the light comes from below the floor, or along it; put it higher");
    if (err == ZS_ERR_RANGE)
        return sim_refuse(o->model, 0,
                          "--shadow planar: the shadow is longer than a scene can be; put the light higher above the "
                          "model, or take --shadow map");
    return sim_refuse(o->model, 0, "--shadow planar: %s", zs_error_string(err));
}

/* The shadows of the first light. */
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
    g->dark = (struct zs_material){ .shader = &zs_shade_shadow, .rgb = { 96, 96, 96 }, .cull = ZS_CULL_NONE };
    g->shade = sim_alloc((size_t)n + 1, sizeof *g->shade);
    g->shadow = sim_alloc((size_t)n + 1, sizeof *g->shadow);
    g->pos = sim_alloc((size_t)n + 1, sizeof *g->pos);
    g->n_shadows = n;
    for (uint32_t i = 0; i < n; i++) {
        const struct zs_instance *caster = &from->scene.instance[i];
        struct zs_instance *shadow = &g->shade[i];
        g->pos[i] = sim_alloc((size_t)caster->mesh->n_verts + 1, sizeof *g->pos[i]);
        *shadow = (struct zs_instance){ .material = &g->dark };
        const int err = zs_shadow_flatten(shadow, &g->shadow[i], g->pos[i], caster, &plane, &light);
        if (err != ZS_OK)
            return refuse_shadow(g, caster, &light, from, o, err);
    }
    return SIM_OK;
}

/* A map for each light; the floor and the model lie in their shadows. */
static int make_maps(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                     const struct sim_options *o)
{
    struct sim_effect_ground *g = out->ground;
    const struct sim_effect_surface *s = out->surface;
    const uint32_t n_lamps = s->lighting.n_lamps;
    for (uint32_t k = 0; k < (n_lamps > 0 ? n_lamps : 1u); k++) {
        const int err = sim_light_map_draw(&g->map[k], model, from, n_lamps > 0 ? &s->lamp[k] : NULL);
        if (err == ZS_ERR_NEAR)
            return sim_refuse(o->model, 0,
                              "--shadow map: the light stands in the model or within a quarter of its radius from it; "
                              "move it to %.3g or more from the model's middle, %.3g,%.3g,%.3g", 1.3 * model->radius,
                              model->center[0], model->center[1], model->center[2]);
        if (err != ZS_OK)
            return sim_refuse(o->model, 0, "--shadow map: %s", zs_error_string(err));
    }
    if (n_lamps == 0)
        zs_shadow_map_light(&g->map[0].map, &out->scene.light);
    return sim_effect_shadowed(out, from->scene.n_instances, o);
}

/* The floor becomes a mirror, or its light cells do: a window in which a second pass is seen. */
static int make_mirror(struct sim_effect_scene *out, const struct sim_options *o)
{
    struct sim_effect_ground *g = out->ground;
    struct zs_instance *window = g->window.mesh.n_tris > 0 ? &g->window.instance : &g->floor.instance;
    const int err = zs_mirror_of(&g->mirror, &g->floor.instance, 16);
    g->glass = g->floor.material;
    g->glass.shader = &zs_shade_window;
    window->material = &g->glass;
    return err == ZS_OK ? SIM_OK : sim_refuse(o->model, 0, "--mirror: %s", zs_error_string(err));
}

int sim_effect_ground(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                      const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    if (!sim_effects_floor(e))
        return SIM_OK;
    lay_floor(out, model, from, view, o);
    const int status = e->shadow == SIM_SHADOW_PLANAR ? add_shadows(out, from, o)
                       : e->shadow == SIM_SHADOW_MAP  ? make_maps(out, model, from, o)
                                                      : SIM_OK;
    return status == SIM_OK && e->mirror ? make_mirror(out, o) : status;
}

void sim_effect_ground_free(struct sim_effect_ground *g)
{
    if (g == NULL)
        return;
    for (uint32_t i = 0; i < g->n_shadows; i++)
        free(g->pos[i]);
    for (int k = 0; k < SIM_LIGHTS_MAX; k++)
        sim_light_map_free(&g->map[k]);
    SIM_FREE(g->shadow, g->pos, g->shade);
    free(g);
}
