/* A zstrip scene as the double-precision reference sees it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SCENE_REFERENCE_H
#define SIM_SCENE_REFERENCE_H

#include "reference.h"
#include "zstrip.h"

/* All triangles of a scene in scene order, in world units; ids count from 1. An id is what
 * sim_frame_ids draws. Return malloc'ed memory (free it), *n triangles; their textures lie in the
 * same block. An instance whose state moves its keys is moved along the rays through the eye by a
 * hundredth of what that many 16-bit buckets may be: so that it is before (behind) what it coincides
 * with, at the same place on the screen. camera NULL, orthographic: it stays. */
struct ref_triangle *sim_reference_triangles(const struct zs_scene *scene, const struct zs_camera *camera,
                                             size_t *n);

/* enum ref_mapping of a depth mapping with a camera. */
int sim_reference_mapping(const struct zs_depth *depth, const struct zs_camera *camera);

/* The camera of a frame of height px, and the light. */
void sim_reference_camera(struct ref_camera *out, const struct zs_camera *camera);
void sim_reference_light(struct ref_light *out, const struct zs_light *light, const struct zs_camera *camera);

#endif
