/* What 0 stands for in scenes and cameras. Every stage that reads one of these fields
 * asks here. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_USUAL_H
#define ZS_USUAL_H

#include "zs_renderer.h"

/* A pose's rotation, or the identity where it is all 0. */
const zs_q2_30 *zs_usual_rotation(const zs_q2_30 m[9]);

/* World units to a mesh step, q32_32, > 0. */
uint64_t zs_usual_scale(const struct zs_instance *in);

/* r->camera and r->light of a frame: copies in which nothing is left out. */
void zs_usual_camera(struct zs_renderer *r, const struct zs_scene *scene,
                     const struct zs_camera *camera);

#endif
