/* Polygons against near, far and the guard band. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CLIP_H
#define ZS_CLIP_H

#include "core/xform.h"

#define ZS_CLIP_MAX 9 /* a triangle and six planes */

struct zs_clip_vertex {
    struct zs_point p;
    uint16_t attr[ZS_VARYINGS_MAX ? ZS_VARYINGS_MAX : 1];
};

/* Clip a convex polygon of n vertices in place at the planes of the outcodes in `planes`.
 * v has room for ZS_CLIP_MAX. Return the number of vertices left, 0 or 3 .. ZS_CLIP_MAX. */
int zs_clip_polygon(const struct zs_view *view, struct zs_clip_vertex *v, int n, uint32_t planes,
                    uint32_t n_varyings);

#endif
