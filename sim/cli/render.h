/* `zsim render`: a model file to a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RENDER_H
#define SIM_RENDER_H

#include "image.h"
#include "model.h"
#include "quantise.h"
#include "render_options.h"

/* Draw a model that is loaded, as the options say, and write no file. seen is the caller's after SIM_OK; else what is
 * refused was said. kept may be NULL. */
int sim_render_model(struct sim_picture *seen, struct sim_kept_scene *kept, const struct sim_model *model,
                     const struct sim_options *o);

/* Run with the arguments after "render". Return enum sim_status. */
int sim_render(int argc, char **argv);

#endif
