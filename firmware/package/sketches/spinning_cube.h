/* A cube that turns: what the examples of sinks draw. 240x240 px at most; strips of 16 rows, 24 KB of RAM.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SPINNING_CUBE_H
#define SPINNING_CUBE_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CUBE_ROWS 16

/* Set the renderer up for a display of w x h px, 1 to 240 each. Returns an enum zs_err. */
int cube_begin(uint16_t w, uint16_t h);

/* Draw a frame and send it, strip by strip. Returns an enum zs_err, or the sink's own error. */
int cube_draw(uint32_t frame, const struct zs_sink *sink);

/* The same for programs that fetch strips themselves: after it, zs_frame_strip(cube_renderer(), ...). */
int cube_open(uint32_t frame);
struct zs_renderer *cube_renderer(void);

#ifdef __cplusplus
}
#endif

#endif
