/* `zsim render`: a model file to a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RENDER_H
#define SIM_RENDER_H

#include "frame.h"
#include "framing.h"
#include "image.h"
#include "model.h"
#include "quantise.h"
#include "render_options.h"

/* What is shown of a frame, and what it took. */
struct sim_seen {
    struct sim_picture picture;
    struct zs_stats stats;
    struct sim_view view; /* of a model */
};

/* Draw a model that is loaded, as the options say, and write no file. seen is the caller's after SIM_OK; else what is
 * refused was said. kept may be NULL. */
int sim_render_model(struct sim_picture *seen, struct sim_kept_scene *kept, const struct sim_model *model,
                     const struct sim_options *o);

/* A frame of a model with all that is known of it; sim_render_free. *out may not move. */
struct sim_rendered {
    struct sim_view view;
    struct zs_config config;
    struct sim_frame frame;
    struct sim_picture shown; /* with --show, or what is seen on a --panel; else empty */
    struct sim_lost lost[SIM_LOST_KINDS];
    uint32_t parts;           /* that the model has as meshes */
    uint64_t verts;           /* of all of them */
};

/* The same as sim_render_model. */
int sim_render_all(struct sim_rendered *out, struct sim_kept_scene *kept, const struct sim_model *model,
                   const struct sim_options *o);
/* What --out shows of it; seen is the caller's. */
void sim_rendered_picture(struct sim_picture *seen, struct sim_rendered *r);
void sim_render_free(struct sim_rendered *r);

/* Run with the arguments after "render". Return enum sim_status. */
int sim_render(int argc, char **argv);

#endif
