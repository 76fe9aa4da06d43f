/* The simulator for a page: what engine.js calls. One scene, one set of options, one frame at a time.
 *
 * Texts come and go as '\0'-terminated UTF-8; answers are JSON (answer.h). What is refused says why on stderr, as zsim
 * does, and changes nothing.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_ENGINE_H
#define WEB_ENGINE_H

#include "demo_frame.h"
#include "model.h"
#include "render.h"
#include "scenes.h"
#include "wrong.h"

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

struct web {
    struct sim_options options; /* of zsim render; its texts lie in *words */
    char *words;                /* '\0'-terminated one by one */
    struct sim_orbit orbit;
    const struct demo *scene; /* NULL: a model */
    const char *name;         /* of either; NULL: nothing was chosen */
    uint32_t time;            /* frame of a scene's animation */
    struct sim_model model;
    struct sim_options chosen; /* the options, with the shading that was chosen for the model */
    struct sim_kept_scene kept; /* of that model with these; sim_kept_free where either changes */
    struct sim_rendered drawn; /* the last good frame; width 0: none */
    struct web_wrong wrong;    /* of the last comparison */
};
extern struct web web;

/* From here on this scene, or *model, is drawn with these options, as *drawn shows; all of it becomes web's. */
void web_choose(const struct demo *scene, const char *name, const struct sim_model *model,
                const struct sim_options *chosen, const struct sim_rendered *drawn);

/* A demo scene's frame. SIM_OK; SIM_REFUSED, said why. */
int web_scene_draw(struct sim_rendered *out, const struct demo *scene, const struct sim_options *o);
/* Does the glass of a panel show fewer levels than the frame has? */
int web_has_levels(const struct sim_options *o);
/* The configuration that options mean for a scene. */
void web_scene_config(struct zs_config *config, const struct demo *scene,
                      const struct sim_options *o);

/* The model that was handed over, as options ask for it; *o gets the shading that is chosen. */
int web_model_load(struct sim_model *model, struct sim_options *o);
/* Its frame. scene may be NULL. */
int web_model_draw(struct sim_rendered *out, struct sim_kept_scene *scene, const struct sim_model *model,
                   const struct sim_options *o);

/* Call `use` with what the next frame is drawn from, of the chosen model or the chosen scene. Return as
 * sim_render_scene. */
int web_scene_scene(int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx);
int web_model_scene(int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx);

#endif
