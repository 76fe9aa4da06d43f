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
        if (err != ZS_OK)
            return refuse_shadow(g, caster, &light, from, o, err);
        out->scene.n_instances++;
    }
    return SIM_OK;
}

/* All in the light of a lamp, in its map's shadows. */
static void make_lamp_lit(struct sim_effect_scene *out)
{
    struct sim_effect_ground *g = out->ground;
    g->shadowed_lit = sim_alloc((size_t)out->scene.n_instances + 1, sizeof *g->shadowed_lit);
    out->varyings = ZS_VARYINGS_SHADOWED_LIT;
    for (uint32_t i = 0; i < out->scene.n_instances; i++) {
        struct zs_shadowed_lit *m = &g->shadowed_lit[i];
        *m = (struct zs_shadowed_lit){
            .lit = { .material = *out->instance[i].material, .lighting = &out->surface->lighting }, .map = &g->map.map
        };
        m->lit.material.shader = m->lit.material.texture != NULL ? &zs_shade_shadowed_texture : &zs_shade_shadowed_lit;
        if (m->lit.material.texture != NULL)
            out->varyings = ZS_VARYINGS_SHADOWED_TEXTURE;
        out->instance[i].material = &m->lit.material;
    }
}

/* The floor, the first instance, and all of the model get a shadow map's light. */
static int make_map(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                    const struct sim_options *o)
{
    struct sim_effect_ground *g = out->ground;
    const struct zs_lamp *lamp = out->surface->lighting.n_lamps > 0 ? out->surface->lamp : NULL;
    const int err = sim_light_map_draw(&g->map, model, from, lamp);
    if (err == ZS_ERR_NEAR)
        return sim_refuse(o->model, 0,
                          "--shadow map: the light stands in the model or within a quarter of its radius from it; "
                          "move it to %.3g or more from the model's middle, %.3g,%.3g,%.3g", 1.3 * model->radius,
                          model->center[0], model->center[1], model->center[2]);
    if (err != ZS_OK)
        return sim_refuse(o->model, 0, "--shadow map: %s", zs_error_string(err));
    if (lamp != NULL) {
        make_lamp_lit(out);
        return SIM_OK;
    }
    g->shadowed = sim_alloc((size_t)out->scene.n_instances + 1, sizeof *g->shadowed);
    for (uint32_t i = 0; i < out->scene.n_instances; i++) {
        g->shadowed[i].material = *out->instance[i].material;
        g->shadowed[i].material.shader = &zs_shade_shadowed_smooth;
        g->shadowed[i].map = &g->map.map;
        out->instance[i].material = &g->shadowed[i].material;
    }
    zs_shadow_map_light(&g->map.map, &out->scene.light);
    out->varyings = ZS_VARYINGS_SHADOWED_SMOOTH;
    return SIM_OK;
}

/* The floor becomes a mirror: the last instance, a window in which a second pass is seen. */
static int make_mirror(struct sim_effect_scene *out, const struct sim_scene *from, const struct sim_options *o)
{
    struct sim_effect_ground *g = out->ground;
    const uint32_t n = from->scene.n_instances;
    const struct zs_instance floor = out->instance[0];
    memmove(out->instance, out->instance + 1, n * sizeof *out->instance);
    out->instance[n] = floor;
    g->floor.material.shader = &zs_shade_window;
    const int err = zs_mirror_of(&g->mirror, &floor, 16);
    if (err != ZS_OK)
        return sim_refuse(o->model, 0, "--mirror: %s", zs_error_string(err));
    g->seen = out->scene;
    g->seen.n_instances = n;
    g->seen.n_resolves = 0;                /* hooks run once for the frame */
    const struct zs_rgb b = o->background; /* a third of the way to grey, so that the glass is seen */
    g->seen.background = zs_rgb565((uint8_t)((2 * b.r + 112) / 3), (uint8_t)((2 * b.g + 120) / 3),
                                   (uint8_t)((2 * b.b + 128) / 3));
    return SIM_OK;
}

int sim_effect_ground(struct sim_effect_scene *out, const struct sim_model *model, const struct sim_scene *from,
                      const struct sim_view *view, const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    if (!sim_effects_floor(e))
        return SIM_OK;
    add_floor(out, model, from, view, o);
    return e->mirror                        ? make_mirror(out, from, o)
           : e->shadow == SIM_SHADOW_PLANAR ? add_shadows(out, from, o)
                                            : make_map(out, model, from, o);
}

void sim_effect_ground_free(struct sim_effect_ground *g)
{
    if (g == NULL)
        return;
    for (uint32_t i = 0; i < g->n_shadows; i++)
        free(g->pos[i]);
    sim_light_map_free(&g->map);
    SIM_FREE(g->shadow, g->pos, g->shadowed, g->shadowed_lit);
    free(g);
}
