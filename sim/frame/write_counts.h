/* How often every pixel is coloured, under any method.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_WRITE_COUNTS_H
#define SIM_WRITE_COUNTS_H

#include "frame.h"

/* Draw a frame with a shader that counts in place of each material's.
 *
 * written  [height][width], filled; its sum is the frame's pixels_written.
 * stats    of that frame; NULL: not wanted.
 * Return   as sim_frame_render. */
int sim_writes_count(uint32_t *written, struct zs_stats *stats, const struct zs_scene *scene,
                     const struct zs_camera *camera, const struct zs_config *config);

#endif
