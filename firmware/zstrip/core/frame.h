/* Frames: the checks before a frame, and the loop over strips. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FRAME_H
#define ZS_FRAME_H

#include "zstrip.h"

/* Make all checks that can refuse a frame with r->camera, and fill r->view. Return ZS_OK or an
 * error. */
int zs_frame_check(struct zs_renderer *r, const struct zs_scene *scene);
/* Begin a frame after its checks. The caller sets r->scene before or after. */
void zs_frame_open(struct zs_renderer *r);
/* Send all strips of the frame to a sink, and end the frame. Return ZS_OK or the sink's error. */
int zs_frame_send(struct zs_renderer *r, const struct zs_sink *sink);
/* Call the scene's resolve hooks for the current strip. */
void zs_frame_resolve(const struct zs_renderer *r, const struct zs_scene *scene);
/* Invalidate r->edge, because the camera is another one. */
static inline void zs_frame_forget_edges(struct zs_renderer *r)
{
    r->edge_of[0] = r->edge_of[1] = r->edge_of[2] = r->edge_of[3] = UINT16_MAX;
}

#endif
