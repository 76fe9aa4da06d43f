/* Instances: the sphere that holds a mesh, against the view. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CULL_H
#define ZS_CULL_H

#include "zstrip.h"

struct zs_bounds {
    int64_t c[3];  /* q48_16 world units, camera axes (right, down, distance), sphere's centre */
    int64_t r;     /* q48_16, rounded up */
    int64_t reach; /* q48_16: no vertex, centre or origin lies further along an axis */
    int64_t slack; /* q48_16: more than the error of c and r; in a walk, of a vertex as well */
};

/* The sphere of an instance in camera axes, unscaled. Return ZS_OK or ZS_ERR_RANGE. */
int zs_cull_bounds(struct zs_bounds *b, const struct zs_instance *in,
                   const struct zs_camera *camera);

/* 1: no part of the sphere can be seen. Conservative. */
int zs_cull_sphere(const struct zs_bounds *b, const struct zs_camera *camera,
                   const struct zs_view *view);

/* In a walk, when camera units are known: bounds of an instance of the scene, with room for what a
 * vertex may be off by. Return 1: no part of it can be seen. */
int zs_cull_walk(struct zs_bounds *b, const struct zs_renderer *r, uint32_t number);

/* An instance's axes in camera axes (right, down, distance), row-major. */
void zs_cull_axes(zs_q2_30 out[9], const struct zs_instance *in, const struct zs_camera *camera);

/* Half of what an orthographic frame holds from left to right, q48_16, at least. */
int64_t zs_cull_half_width(const struct zs_camera *camera, const struct zs_view *view);

#endif
