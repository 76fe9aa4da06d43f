/* A scene's frame from the double-precision reference, and the judge of ours beside it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_REFERENCE_FRAME_H
#define SIM_REFERENCE_FRAME_H

#include "error_bound.h"
#include "reference.h"
#include "zstrip.h"

/* A frame as the reference draws it, and what it was drawn with. Points into itself: keep it where it is. */
struct sim_reference_frame {
    struct ref_triangle *tri;
    size_t n_tris;
    struct ref_camera camera;
    struct ref_light light;
    struct ref_depth depth;
    struct ref_image image; /* all that there is of it */
    struct sim_judge judge;
};

/* SIM_OK, or what ref_render says; sim_reference_frame_free is due in either case. */
int sim_reference_frame_draw(struct sim_reference_frame *t, const struct zs_scene *scene,
                             const struct zs_camera *camera, const struct zs_config *config);
void sim_reference_frame_free(struct sim_reference_frame *t);

#endif
