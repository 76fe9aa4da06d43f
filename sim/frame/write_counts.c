/* A fragment stage that counts.
 *
 * SPDX-License-Identifier: MIT
 */
#include "write_counts.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_shader.h"

struct counting {
    struct zs_material material; /* first: the instance's */
    uint32_t *written;
    uint16_t width;
};

static void count(const struct zs_instance *instance, struct zs_fragment *f)
{
    const struct counting *c = (const struct counting *)instance->material;
    c->written[(size_t)f->y * c->width + f->x]++;
}

static const struct zs_shader counting = { .fragment = count, ZS_FRAGMENTS, .opaque = 1 };

int sim_writes_count(uint32_t *written, struct zs_stats *stats, const struct zs_scene *scene,
                     const struct zs_camera *camera, const struct zs_config *config)
{
    const uint32_t n = scene->n_instances;
    struct zs_instance *instance = sim_alloc(n, sizeof *instance);
    struct counting *material = sim_alloc(n, sizeof *material);
    struct zs_scene counted = *scene;
    struct sim_frame frame;
    memset(written, 0, (size_t)config->width * config->height * sizeof *written);
    for (uint32_t i = 0; i < n; i++) {
        material[i] = (struct counting){ *scene->instance[i].material, written, config->width };
        material[i].material.shader = &counting;
        instance[i] = scene->instance[i];
        instance[i].material = &material[i].material;
    }
    counted.instance = instance;
    const int err = sim_frame_render(&frame, &counted, camera, config, NULL);
    if (!err && stats)
        *stats = frame.stats;
    sim_frame_free(&frame);
    SIM_FREE(instance, material);
    return err;
}
