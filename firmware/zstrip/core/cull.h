/* Instance culling: bounding spheres against the view frustum. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CULL_H
#define ZS_CULL_H

#include "zstrip.h"

/* An instance's bounding sphere, relative to the eye, in camera axes (right, down, distance). */
struct zs_bounds {
    int64_t c[3];  /* centre, q48_16 world units */
    int64_t r;     /* radius, q48_16, rounded up */
    int64_t reach; /* q48_16: upper bound of |coordinate| along any axis, for the sphere and for the
                      instance's origin */
    int64_t slack; /* q48_16: above the error of c and r; from zs_cull_walk, of a transformed vertex
                      as well */
};

/* Compute the sphere, in world units, that bounds all that an instance draws; primitives may draw
 * beyond their vertices (core/primitive.h). Return ZS_OK; ZS_ERR_RANGE: a field of the instance is
 * out of range; ZS_ERR_NULL: its primitive has no ops; or the error of the primitive's widen hook.
 * r->camera and the size of r->view are set. */
int zs_cull_bounds(struct zs_bounds *b, const struct zs_renderer *r, const struct zs_instance *in);

/* Return 1 if the sphere is outside the view frustum. Conservative: 0 if in doubt. */
int zs_cull_sphere(const struct zs_bounds *b, const struct zs_camera *camera,
                   const struct zs_view *view);

struct zs_box {
    int32_t x0, x1, y0, y1; /* px: columns [x0, x1), rows [y0, y1) */
    uint32_t nearest;       /* zs_vertex.d of the nearest point */
};
/* Find a box of the frame that holds all that is drawn of a bounding sphere. Return 0 if the sphere
 * reaches before near or begins beyond far. */
int zs_cull_box(const struct zs_renderer *r, const struct zs_bounds *b, struct zs_box *box);

/* During a walk, when camera units are known: compute the bounds of an instance, with slack for
 * the rounding of its vertices. Return 1 if the instance is outside the view frustum. */
int zs_cull_walk(struct zs_bounds *b, const struct zs_renderer *r, uint32_t number);

/* Compute the rotation from instance axes to camera axes (right, down, distance), row-major. */
void zs_cull_axes(zs_q2_30 out[9], const struct zs_instance *in, const struct zs_camera *camera);

/* Half of the width that an orthographic camera sees, q48_16 world units, rounded up. */
int64_t zs_cull_half_width(const struct zs_camera *camera, const struct zs_view *view);

#endif
