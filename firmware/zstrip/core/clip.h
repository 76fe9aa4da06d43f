/* Polygon clipping at the near and far planes, the guard band and the plane of a mirror. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CLIP_H
#define ZS_CLIP_H

#include "core/xform.h"

#define ZS_CLIP_MAX 10 /* a triangle and seven planes */

struct zs_clip_vertex {
    struct zs_point p;
    uint16_t attr[ZS_VARYINGS_MAX ? ZS_VARYINGS_MAX : 1];
};

/* Clip a convex polygon of n vertices in place, at the planes whose outcode bits are in `planes`. v
 * has room for ZS_CLIP_MAX vertices. Return the new number of vertices, 0 or 3 .. ZS_CLIP_MAX. */
int zs_clip_polygon(const struct zs_view *view, struct zs_clip_vertex *v, int n, uint32_t planes,
                    uint32_t n_varyings);

#endif
