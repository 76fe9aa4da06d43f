/* A shadow map of a model, drawn from where its light comes from.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LIGHT_MAP_H
#define SIM_LIGHT_MAP_H

#include "quantise.h"
#include "zs_shadow.h"

#include "zs_lights.h"

#define SIM_LIGHT_MAP_SIZE 256

struct sim_light_map {
    struct zs_shadow_map map;
    uint16_t *key; /* the map's */
};

/* Draw the map of the model's instances for a lamp, or for scene->light where lamp is NULL. A spot light's view is its
 * cone; a point light's is that of the model's sphere. Return ZS_OK or an error, ZS_ERR_NEAR where the lamp stands in
 * the model's sphere or close to it; sim_light_map_free in either case. */
int sim_light_map_draw(struct sim_light_map *out, const struct sim_model *model, const struct sim_scene *scene,
                       const struct zs_lamp *lamp);
void sim_light_map_free(struct sim_light_map *map);

#endif
