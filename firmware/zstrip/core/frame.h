/* Frames: checks, and the loop over strips. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FRAME_H
#define ZS_FRAME_H

#include "zstrip.h"

/* Everything that a frame of r->camera can be refused for; fills r->view. Return ZS_OK or an error.
 */
int zs_frame_check(struct zs_renderer *r, const struct zs_scene *scene);
/* Begin the frame that has been checked; r->scene is set, or will be. */
void zs_frame_open(struct zs_renderer *r);
/* The frame's strips to a sink, and its end. */
int zs_frame_send(struct zs_renderer *r, const struct zs_sink *sink);
/* What the scene's resolve hooks draw over the strip in hand. */
void zs_frame_resolve(const struct zs_renderer *r, const struct zs_scene *scene);
/* r->edge holds those of another camera. */
static inline void zs_frame_forget_edges(struct zs_renderer *r)
{
    r->edge_of[0] = r->edge_of[1] = r->edge_of[2] = r->edge_of[3] = UINT16_MAX;
}

#endif
