/* Vertices: mesh steps to camera units, camera units to the screen. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_XFORM_H
#define ZS_XFORM_H

#include "core/fx.h"
#include "zstrip.h"

struct zs_bounds;

/* One vertex in camera units: x' to the right, y' down, z the distance. |.| < 2^30 + 2. */
struct zs_point {
    int32_t c[3];
};

enum zs_outcode {
    ZS_OUT_NEAR = 1,
    ZS_OUT_FAR = 2,
    ZS_OUT_LEFT = 4,
    ZS_OUT_RIGHT = 8,
    ZS_OUT_TOP = 16,
    ZS_OUT_BOTTOM = 32
};
#define ZS_OUT_SIDES (ZS_OUT_LEFT | ZS_OUT_RIGHT | ZS_OUT_TOP | ZS_OUT_BOTTOM)
#define ZS_D_OUT                                                                                   \
    0xffffff00u /* zs_vertex.d at or above it: not projected, to be clipped; plus the outcode */

/* Fill r->xform for an instance. Return 0 where its vertices do not fit camera units (it cannot be
 * seen then), else 1. */
int zs_xform_instance(struct zs_renderer *r, uint32_t number, const struct zs_bounds *b);
void zs_xform_vertex(const struct zs_xform *xf, uint32_t v, struct zs_point *out);
/* enum zs_outcode, or-ed; 0: inside near, far and guard. */
uint32_t zs_xform_outcode(const struct zs_view *view, const struct zs_point *p);
/* Screen position and depth. Return 1; 0 where the point is before near, beyond far (*out is not of
 * use then) or beside the guard band (*out is then just beside it). */
int zs_xform_project(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out);
/* The same in place: z is d. */
int zs_xform_project_at(const struct zs_renderer *r, struct zs_vertex *at);
/* All three for vertex v of the current instance. One that is not inside near, far and guard has d
 * = ZS_D_OUT + outcode. */
void zs_xform_screen(const struct zs_renderer *r, uint32_t v, struct zs_vertex *out);
/* A row of the transform, of a position in 1/256 steps, |p| <= 2^23. */
int32_t zs_xform_fine(const int32_t row[ZS_ROW_WORDS], const int16_t pos[3],
                      const uint8_t pos_lo[3]);

#endif
