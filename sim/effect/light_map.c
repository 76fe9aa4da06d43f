/* The light's renderer, its camera, its casters.
 *
 * SPDX-License-Identifier: MIT
 */
#include "light_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "sim.h"
#include "vec.h"

/* A camera that looks along the light at the sphere around the model; far reaches to where the floor may lie. */
static int look(struct zs_camera *c, const struct sim_model *model, const struct sim_scene *scene)
{
    const double r = model->radius / scene->unit;
    int32_t eye[3], along[3], up[3] = { 0, 0, 0 };
    int least = 0;
    for (int k = 0; k < 3; k++) {
        const double dir = scene->scene.light.dir[k] / 1073741824.0;
        eye[k] = (int32_t)lrint((model->center[k] - scene->origin[k]) / scene->unit + 2.0 * r * dir);
        along[k] = -scene->scene.light.dir[k];
        if (abs(along[k]) < abs(along[least]))
            least = k;
    }
    up[least] = ZS_Q30_ONE;
    const int err = zs_camera_look_along(c, eye, along, up);
    c->projection = ZS_ORTHOGRAPHIC;
    c->height = llrint(2.1 * r * 65536.0);
    c->z_near = llrint(0.9 * r * 65536.0);
    c->z_far = llrint(6.0 * r * 65536.0);
    return err;
}

int sim_light_map_draw(struct sim_light_map *out, const struct sim_model *model, const struct sim_scene *scene)
{
    static const struct zs_depth_state bias = { .bias = 4, .slope_bias = 512 };
    const uint32_t n = scene->scene.n_instances, size = SIM_LIGHT_MAP_SIZE;
    struct zs_config config;
    struct zs_camera camera;
    struct zs_renderer renderer;
    memset(&camera, 0, sizeof camera);
    out->key = sim_alloc((size_t)size * size, sizeof *out->key);
    out->map = (struct zs_shadow_map){ .key = out->key, .w = (uint16_t)size, .h = (uint16_t)size, .soft = 1 };
    sim_frame_config(&config, (uint16_t)size, (uint16_t)size, 0);
    config.depth = &zs_depth_linear;
    const uint32_t bytes = zs_arena_bytes(&config);
    void *arena = sim_alloc(bytes / 4u + 1u, 4);
    struct zs_instance *casters = sim_alloc((size_t)n + 1, sizeof *casters);
    const struct zs_scene seen = { .instance = casters,
                                   .n_instances = zs_shadow_casters(casters, scene->scene.instance, n, &bias) };
    int err = look(&camera, model, scene);
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
