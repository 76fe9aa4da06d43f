/* `zsim render`: a model file to a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RENDER_H
#define SIM_RENDER_H

#include "framing.h"
#include "image.h"
#include "model.h"
#include "render_options.h"

/* What --out of a frame shows, and what the frame took. */
struct sim_seen {
    struct sim_picture picture;
    struct zs_stats stats;
    struct sim_view view; /* of a model */
};

/* Draw a model that is loaded, as the options say, and write no file. seen is the caller's after SIM_OK; else what is
 * refused was said. */
int sim_render_model(struct sim_picture *seen, const struct sim_model *model, const struct sim_options *o);

/* The same with what it took, and false colours where --show asks for them. sim_picture_free of its picture. */
int sim_render_seen(struct sim_seen *seen, const struct sim_model *model, const struct sim_options *o);

/* Run with the arguments after "render". Return enum sim_status. */
int sim_render(int argc, char **argv);

#endif
