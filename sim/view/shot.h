/* The picture that a command line draws, by the same calls as that command.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_SHOT_H
#define SIM_VIEW_SHOT_H

#include "demo_frame.h"
#include "render.h"
#include "words.h"

/* All zero: none yet. */
struct view_shot {
    struct view_words words; /* of `zsim render`, where they name a model, else of `zsim demo` */
    struct sim_rendered seen; /* its `shown` is empty before the first */
    struct sim_options o;    /* of a model: what the words say; points into them */
    struct sim_model model;
    char *loaded_by;         /* the words that the model was loaded by; NULL: none was */
    struct sim_kept_scene *kept; /* of the model; NULL: none yet */
    char *kept_by;               /* the words that it was made by; NULL: it is empty */
    enum sim_shade shade;    /* that its file asks for, or the words */
    int shade_chosen;
    uint32_t n_frames;       /* of a scene's animation */
    uint32_t serial;         /* grows with each picture */
};

/* Draw. reload: the model's file may have changed. SIM_OK; SIM_REFUSED, SIM_USAGE, said why, *shot is as it was. */
int view_shot_take(struct view_shot *shot, const struct view_words *words, int reload);
void view_shot_free(struct view_shot *shot);

/* Move the eye of a model's words from where it is in the shot: about the upright axis and up by degrees, from or to
 * what it looks at by a factor. */
void view_shot_orbit(const struct view_shot *shot, struct view_words *words, double turn, double rise, double factor);
/* Of a scene's words, beside where its camera stands: move it likewise; where it is. */
void view_scene_turn(struct view_words *words, double turn, double rise, double factor);
struct sim_orbit view_scene_orbit(const struct view_words *words);
/* Move what it looks at, and the eye with it, by pixels of the picture. */
void view_shot_pan(const struct view_shot *shot, struct view_words *words, double dx, double dy);

#endif
