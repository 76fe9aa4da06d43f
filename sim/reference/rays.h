/* rays.h - the picture of reference.h by rays in double precision, and what rays add to it.
 *
 * The inverse order of the loops: for each pixel, a ray from the eye through the pixel's centre
 * finds the nearest triangle, in a hierarchy of boxes. It shares no code with firmware/, and with
 * reference.c only the types. A ray from the point that is seen to the light finds shadows; one that
 * is reflected there finds what a mirror shows (Whitted 1980).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RAYS_H
#define SIM_RAYS_H

#include "reference.h"

struct ref_rays {
    int shadows;        /* 1: a point has ambient light alone where a triangle is between it and the light */
    int bounces;        /* most reflections of a ray, 0 .. 16 */
    const double *mirror; /* [n] by triangle, 0 .. 1: the share of its colour that is reflected; NULL: 0 */
    size_t cast;        /* filled: rays of all kinds */
};

/* Fill image->id, z and rgb565, as far as they are wanted; the other buffers are left alone.
 * Triangles are REF_SHADE_RAW, or all others as REF_SHADE_FLAT with rgb[0]. A tie is the earlier
 * triangle's. Culling is by the side that the ray sees; shadows and reflections meet both sides.
 * Arguments and return as ref_render. */
int ref_cast(const struct ref_triangle *triangles, size_t n, const struct ref_camera *camera,
             const struct ref_light *light, uint16_t background, int width, int height,
             struct ref_rays *rays, struct ref_image *image);

#endif
