/* What is wrong with a picture, as a board would be told (zs_explain.h).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_EXPLANATION_H
#define SIM_EXPLANATION_H

#include "zstrip.h"

/* Print each sentence on stderr, a line each behind the program's name and `file`. The scene is drawn again, by a
 * renderer of its own, in one pass. unit: a world unit, in units of the model. Return the number of sentences. */
uint32_t sim_explain(const char *file, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config, double unit);

#endif
