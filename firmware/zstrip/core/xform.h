/* Vertex transform: mesh steps to camera units, camera units to the screen. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_XFORM_H
#define ZS_XFORM_H

#include "core/fx.h"
#include "zstrip.h"

struct zs_bounds;

/* A position in camera units: x' to the right, y' down, z the distance. |.| < 2^30 + 2. */
struct zs_point {
    int32_t c[3];
};

enum zs_outcode { /* sides: of the guard band */
    ZS_OUT_NEAR = 1,
    ZS_OUT_FAR = 2,
    ZS_OUT_LEFT = 4,
    ZS_OUT_RIGHT = 8,
    ZS_OUT_TOP = 16,
    ZS_OUT_BOTTOM = 32,
    ZS_OUT_MIRROR = 64 /* behind the plane of the view's mirror */
};
#define ZS_OUT_SIDES (ZS_OUT_LEFT | ZS_OUT_RIGHT | ZS_OUT_TOP | ZS_OUT_BOTTOM)
#define ZS_D_OUT                                                                                   \
    0xffffff00u /* zs_vertex.d = ZS_D_OUT + outcode: not projected, its triangles are clipped */

/* Fill r->xform for an instance. Return 1; 0 if its vertices do not fit camera units, in which case
 * it is outside the view. */
int zs_xform_instance(struct zs_renderer *r, uint32_t number, const struct zs_bounds *b);
/* Transform vertex v of the mesh to camera units. */
void zs_xform_vertex(const struct zs_xform *xf, uint32_t v, struct zs_point *out);
/* Return enum zs_outcode, or-ed; 0: the point is between near and far and in the guard band. */
uint32_t zs_xform_outcode(const struct zs_view *view, const struct zs_point *p);
/* Project a point: screen position and depth. Return 1; 0 if the point is before near or beyond far
 * (*out is then undefined), or outside the guard band (*out is then just outside it). */
int zs_xform_project(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out);
/* The same in place: on entry at->x, y, d are x', y', z. */
int zs_xform_project_at(const struct zs_renderer *r, struct zs_vertex *at);
/* Transform and project vertex v of the current instance. A vertex with an outcode other than 0
 * gets d = ZS_D_OUT + outcode. */
void zs_xform_screen(const struct zs_renderer *r, uint32_t v, struct zs_vertex *out);
/* One row of the transform, for a position in 1/256 steps, |p| <= 2^23; in whole steps, if pos_lo
 * is NULL. */
int32_t zs_xform_fine(const int32_t row[ZS_ROW_WORDS], const int16_t pos[3],
                      const uint8_t pos_lo[3]);

#endif
