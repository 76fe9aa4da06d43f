/* A scene of a few things, each with a material of its own, and how it is drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_THINGS_H
#define TESTS_THINGS_H

#include "prng.h"
#include "zstrip.h"

#define THINGS_MAX 5

/* Begins as all 0. Keep it where it is while the scene is used. */
struct things {
    struct zs_material material[THINGS_MAX];
    struct zs_instance instance[THINGS_MAX];
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
};

/* One more, turned at random about two axes, at the origin; its material is the caller's to fill. */
static inline struct zs_instance *things_add(struct things *t, const struct zs_mesh *mesh, struct prng *p)
{
    const uint32_t k = t->scene.n_instances++;
    struct zs_instance *in = &t->instance[k];
    t->scene.instance = t->instance;
    in->mesh = mesh;
    in->material = &t->material[k];
    zs_pose_identity(&in->pose);
    const zs_turn yaw = (zs_turn)prng_next(p), pitch = (zs_turn)prng_next(p);
    zs_pose_turn(&in->pose, yaw, pitch, 0);
    return in;
}

#endif
