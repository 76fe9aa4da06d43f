/* A scene's frame from the double-precision reference, and the judge of ours beside it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_TRUTH_H
#define SIM_TRUTH_H

#include "error_bound.h"
#include "reference.h"
#include "zstrip.h"

/* A frame as the reference draws it, and what it was drawn with. Points into itself: keep it where it is. */
struct sim_truth {
    struct ref_triangle *tri;
    size_t n_tris;
    struct ref_camera camera;
    struct ref_light light;
    struct ref_depth depth;
    struct ref_image image; /* all that there is of it */
    struct sim_judge judge;
};

/* SIM_OK, or what ref_render says; sim_truth_free is due in either case. */
int sim_truth_draw(struct sim_truth *t, const struct zs_scene *scene, const struct zs_camera *camera,
                   const struct zs_config *config);
void sim_truth_free(struct sim_truth *t);

#endif
