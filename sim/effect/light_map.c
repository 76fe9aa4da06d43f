/* The light's renderer, its camera, its casters.
 *
 * SPDX-License-Identifier: MIT
 */
#include "light_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "effect_options.h"
#include "frame.h"
#include "sim.h"
#include "vec.h"

#define DEGREES 57.29577951308232

/* Look from there that way, any side up. */
static int aim(struct zs_camera *c, const int32_t eye[3], const int32_t along[3])
{
    int32_t up[3] = { 0, 0, 0 };
    int least = 0;
    for (int k = 0; k < 3; k++)
        if (abs(along[k]) < abs(along[least]))
            least = k;
    up[least] = ZS_Q30_ONE;
    return zs_camera_look_along(c, eye, along, up);
}

/* From a lamp into its cone, or at the sphere around the model; far reaches to where the floor may lie. */
static int look_from(struct zs_camera *c, const struct sim_model *model, const struct sim_scene *scene,
                     const struct zs_lamp *lamp)
{
    const double r = model->radius / scene->unit;
    double to[3], half = (SIM_SPOT_DARK + 1.0) / DEGREES;
    int32_t along[3];
    for (int k = 0; k < 3; k++)
        to[k] = (model->center[k] - scene->origin[k]) / scene->unit - lamp->pos[k];
    const double far = sqrt(sim_dot(to, to)), near = far - 1.05 * r;
    if (near < 0.2 * r)
        return ZS_ERR_NEAR;
    for (int k = 0; k < 3; k++)
        along[k] = lamp->kind == ZS_LAMP_SPOT ? lamp->dir[k] : (int32_t)lrint(to[k] / far * 1073741823.0);
    if (lamp->kind != ZS_LAMP_SPOT)
        half = asin(1.02 * r / far);
    const int err = aim(c, lamp->pos, along);
    c->projection = ZS_PERSPECTIVE;
    c->focal = (zs_uq32_32)(SIM_LIGHT_MAP_SIZE / 2 / tan(half) * 4294967296.0);
    c->z_near = llrint((lamp->kind == ZS_LAMP_SPOT ? 0.2 * r : near) * 65536.0);
    c->z_far = llrint((far + 4.0 * r) * 65536.0);
    return err;
}

/* A camera that looks along the light at the sphere around the model; far reaches to where the floor may lie. */
static int look(struct zs_camera *c, const struct sim_model *model, const struct sim_scene *scene,
                const zs_q2_30 light[3])
{
    const double r = model->radius / scene->unit;
    int32_t eye[3], along[3];
    for (int k = 0; k < 3; k++) {
        const double dir = light[k] / 1073741824.0;
        eye[k] = (int32_t)lrint((model->center[k] - scene->origin[k]) / scene->unit + 2.0 * r * dir);
        along[k] = -light[k];
    }
    const int err = aim(c, eye, along);
    c->projection = ZS_ORTHOGRAPHIC;
    c->height = llrint(2.1 * r * 65536.0);
    c->z_near = llrint(0.9 * r * 65536.0);
    c->z_far = llrint(6.0 * r * 65536.0);
    return err;
}

int sim_light_map_draw(struct sim_light_map *out, const struct sim_model *model, const struct sim_scene *scene,
                       const struct zs_lamp *lamp)
{
    static const struct zs_depth_state usual = { .bias = 4, .slope_bias = 512 },
                                       of_lamps = { .bias = 4, .slope_bias = 544 };
    const int cone = lamp != NULL && lamp->kind != ZS_LAMP_DIRECTIONAL;
    const uint32_t n = scene->scene.n_instances, size = SIM_LIGHT_MAP_SIZE;
    struct zs_config config;
    struct zs_camera camera;
    struct zs_renderer renderer;
    memset(&camera, 0, sizeof camera);
    out->key = sim_alloc((size_t)size * size, sizeof *out->key);
    out->map = (struct zs_shadow_map){ .key = out->key, .w = (uint16_t)size, .h = (uint16_t)size, .soft = 1 };
    sim_frame_config(&config, (uint16_t)size, (uint16_t)size, 0);
    config.depth = cone ? &zs_depth_recip : &zs_depth_linear;
    const uint32_t bytes = zs_arena_bytes(&config);
    void *arena = sim_alloc(bytes / 4u + 1u, 4);
    struct zs_instance *casters = sim_alloc((size_t)n + 1, sizeof *casters);
    const struct zs_scene seen = { .instance = casters,
                                   .n_instances = zs_shadow_casters(casters, scene->scene.instance, n,
                                                                   lamp != NULL ? &of_lamps : &usual) };
    int err = cone ? look_from(&camera, model, scene, lamp)
                   : look(&camera, model, scene, lamp != NULL ? lamp->dir : scene->scene.light.dir);
    err = err ? err : zs_init(&renderer, &config, arena, bytes);
    err = err ? err : zs_shadow_map_draw(&out->map, &renderer, &seen, &camera);
    SIM_FREE(arena, casters);
    return err;
}

void sim_light_map_free(struct sim_light_map *map)
{
    free(map->key);
    map->key = NULL;
}
