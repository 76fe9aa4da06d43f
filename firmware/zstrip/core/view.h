/* The camera of a frame. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_VIEW_H
#define ZS_VIEW_H

#include "zstrip.h"

/* Mapping and viewport of a pass that is the whole frame. */
void zs_view_frame(struct zs_view *view, const struct zs_config *config);
/* Everything that depends on neither scene nor mapping, once the viewport is known. ZS_OK;
 * ZS_ERR_CAMERA; ZS_ERR_RANGE. */
int zs_view_camera(struct zs_view *view, const struct zs_config *config,
                   const struct zs_camera *camera);
/* Choose camera units for a reach in q48_16 world units, and fill the rest. ZS_OK; ZS_ERR_RANGE. */
int zs_view_units(struct zs_view *view, const struct zs_camera *camera, int64_t reach);
/* A length in camera units, nearest, at most 2^30 either way. */
int32_t zs_view_length(const struct zs_view *view, zs_q48_16 length);
/* Unit normal of the plane through the eye and what is so many sub-pixels beside the middle: (x or
 * y, z). */
void zs_view_side(int32_t out[2], uint64_t focal, uint32_t subpx);

#endif
