/* False colours: what drawing a frame took, pixel by pixel or strip by strip, with a legend below.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_FALSE_COLORS_H
#define SIM_FALSE_COLORS_H

#include "image.h"
#include "zstrip.h"

enum sim_show {
    SIM_SHOW_FRAME,      /* nothing of that: the frame */
    SIM_SHOW_DEPTH,      /* distance along the view */
    SIM_SHOW_COMPLEXITY, /* triangles that cover a pixel, hidden ones too; culled faces do not count */
    SIM_SHOW_OVERDRAW,   /* how often a pixel was written */
    SIM_SHOW_TESTED,     /* how often a key was compared there; grey: drawn without */
    SIM_SHOW_STRIPS      /* bars: set-ups of a strip, over the darkened frame */
};
#define SIM_SHOW_WORDS "frame|depth|complexity|overdraw|tested|strips" /* in their order */

/* What the picture says in numbers: of pixels or strips. Distances: 0. */
struct sim_show_sum {
    double sum, most;
};

/* Pixels of the picture of a frame of w x h px. */
uint32_t sim_show_width(uint32_t w);
uint32_t sim_show_height(uint32_t h);

/* Draw a frame, any but SIM_SHOW_FRAME.
 *
 * unit    what a world unit is in the legend's distances.
 * out     on ZS_OK it owns memory (sim_picture_free).
 * sum     filled; NULL: not wanted.
 * Return  as sim_frame_render; SIM_FRAME_BROKEN also where counts are not what the renderer says they are. */
int sim_show_draw(struct sim_picture *out, struct sim_show_sum *sum, enum sim_show kind, const struct zs_scene *scene,
                  const struct zs_camera *camera, const struct zs_config *config, double unit);

#endif
