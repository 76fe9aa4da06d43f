/* The usual values that 0 stands for in scenes and cameras. Every stage reads such a field through
 * these functions. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_USUAL_H
#define ZS_USUAL_H

#include "zs_renderer.h"

/* Return a pose's rotation, or the identity if it is all 0. */
const zs_q2_30 *zs_usual_rotation(const zs_q2_30 m[9]);

/* Return the world units of a mesh step, q32_32, > 0. */
uint64_t zs_usual_scale(const struct zs_instance *in);

/* Set r->camera and r->light: copies of the camera and the scene's light, with usual values filled
 * in. */
void zs_usual_camera(struct zs_renderer *r, const struct zs_scene *scene,
                     const struct zs_camera *camera);

#endif
