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

#endif
