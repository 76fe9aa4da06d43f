/* What the renderer does at every pixel: compared, written; and in every strip.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PIXEL_COUNTS_H
#define SIM_PIXEL_COUNTS_H

#include "frame.h"

struct sim_counts {
    struct sim_frame frame; /* as sim_frame_render draws it */
    uint32_t *tested;       /* [height][width]: how many drawn triangles cover it; sums up to pixels_tested */
    uint32_t *untested;     /* [height][width]: of these, drawn without a comparison; sums up to pixels_untested */
    uint32_t *written;      /* [height][width]: of these, was nearer; sums up to pixels_written */
    uint32_t *setups;       /* [n_strips]; sums up to tris_setup */
    uint32_t n_strips;
};

/* Draw a frame and count. The renderer is the one of every frame, with a depth mapping that looks on and without
 * accelerators of shaders and texels.
 *
 * counts  any state; on ZS_OK it owns memory (sim_counts_free), else it is empty.
 * Return  as sim_frame_render; SIM_FRAME_BROKEN also where pixels are not as many as the renderer says.
 *         Needs ZS_STATS = 1. */
int sim_counts_draw(struct sim_counts *counts, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct zs_config *config);
void sim_counts_free(struct sim_counts *counts);

#endif
