/* The view: a camera in camera units, with its viewport. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_VIEW_H
#define ZS_VIEW_H

#include "zstrip.h"

/* Set the depth mapping and the viewport for a pass that is the whole frame. */
void zs_view_frame(struct zs_view *view, const struct zs_config *config);
/* Check the camera, and compute what depends on neither scene nor mapping. The viewport must be
 * set. Return ZS_OK, ZS_ERR_CAMERA or ZS_ERR_RANGE. */
int zs_view_camera(struct zs_view *view, const struct zs_config *config,
                   const struct zs_camera *camera);
/* Choose camera units for a reach in q48_16 world units, and compute the other fields. Return
 * ZS_OK, ZS_ERR_RANGE or ZS_ERR_NEAR. */
int zs_view_units(struct zs_view *view, const struct zs_camera *camera, int64_t reach);
/* Compute the camera axes in world axes, as rows: right, down, distance. */
void zs_view_axes(zs_q2_30 out[9], const struct zs_camera *camera);
/* Convert a length to camera units, nearest, clamped to -2^30 .. 2^30. */
int32_t zs_view_length(const struct zs_view *view, zs_q48_16 length);
/* Compute the unit normal, as (x or y, z), of the plane through the eye and a column or row that is
 * `subpx` sub-pixels from the viewport's centre. */
void zs_view_side(int32_t out[2], uint64_t focal, uint32_t subpx);

#endif
