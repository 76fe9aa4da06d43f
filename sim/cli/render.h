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

/* A frame, and what is known of it; sim_render_free. */
struct sim_rendered {
    struct sim_view view; /* of a model */
    struct zs_config config;
    struct sim_frame frame;
    struct sim_picture shown; /* with --show, or what is seen on a --panel; else empty */
    struct sim_lost lost[SIM_LOST_KINDS];
    uint32_t parts;           /* that the model has as meshes */
    uint64_t verts;           /* of all of them */
};

/* Draw a model that is loaded, as the options say, and write no file. SIM_OK; else what is refused was said, *out
 * empty. kept may be NULL. */
int sim_render_all(struct sim_rendered *out, struct sim_kept_scene *kept, const struct sim_model *model,
                   const struct sim_options *o);
void sim_render_free(struct sim_rendered *r);

/* What a frame is drawn from. With effects the configuration is the one that the renderer gets: of four samples a pixel
 * twice the size each way, with their method and varyings. */
struct sim_drawn_scene {
    const struct zs_scene *scene;
    const struct zs_camera *camera;
    uint32_t passes;                 /* that it is drawn in; scene is that of the first ... */
    const struct zs_pass *pass;      /* ... of these; NULL: not known, of a demo scene */
    struct zs_config config;
    long samples;                    /* a pixel: 1 or 4 */
    size_t data_bytes;               /* of the model, as firmware keeps it */
};

/* Call `use` with what sim_render_all would draw; all of it is borrowed until it returns. Return what `use` does, or
 * why there is no scene, as sim_render_all. */
int sim_render_scene(struct sim_kept_scene *kept, const struct sim_model *model, const struct sim_options *o,
                     int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx);

/* Fill r->shown with what --out shows, if it is not there. */
void sim_rendered_show(struct sim_rendered *r);

/* That picture alone; it is the caller's after SIM_OK. */
int sim_render_model(struct sim_picture *seen, struct sim_kept_scene *kept, const struct sim_model *model,
                     const struct sim_options *o);

/* Run with the arguments after "render". Return enum sim_status. */
int sim_render(int argc, char **argv);

#endif
