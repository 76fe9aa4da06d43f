/* The gallery's cards of lines and effects: one model, drawn by zsim render's options.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_GALLERY_EFFECTS_H
#define SIM_GALLERY_EFFECTS_H

#include "image.h"

struct gallery_effect {
    const char *id, *title;
    const char *options;      /* of zsim render, one blank between two words */
    const char *take, *fails; /* when to take it, what it gets wrong or costs */
};

#define GALLERY_LINES 5 /* the first of them: lines and points in place of faces */
#define GALLERY_EFFECTS 22
extern const struct gallery_effect gallery_effects[GALLERY_EFFECTS];

/* Draw the card. SIM_OK; SIM_REFUSED, said why. */
int gallery_effect_draw(struct sim_picture *out, const struct gallery_effect *effect);

#endif
