/* What stands where in the window: the picture, settings and figures beside it, sentences below it, and the keys.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_DESK_H
#define SIM_VIEW_DESK_H

#include "canvas.h"
#include "figures.h"
#include "settings.h"
#include "shot.h"

#define VIEW_SIDE_CELLS 34
#define VIEW_MARGIN 14 /* px */
#define VIEW_PITCH 18  /* px, from a line to the next; of the side in a low window down to VIEW_CELL_H */
#define VIEW_SIDE_W (VIEW_SIDE_CELLS * VIEW_CELL_W + 2 * VIEW_MARGIN)
#define VIEW_BAR_LINES 6
#define VIEW_BAR_H (VIEW_BAR_LINES * VIEW_PITCH + VIEW_MARGIN)
#define VIEW_LEAST_W (VIEW_SIDE_W + 256)
#define VIEW_SIDE_LINES 43
#define VIEW_LEAST_H (VIEW_SIDE_LINES * VIEW_PITCH) /* or as high as the desktop is, but not below the next */
#define VIEW_LOWEST_H (VIEW_SIDE_LINES * VIEW_CELL_H)

struct view_desk {
    const struct view_shot *shot;       /* what is seen */
    const struct view_words *wish;      /* what was asked for: more than that where it was refused */
    const struct view_figures *figures;
    const char *said;                   /* why it was refused, or what was done; "": nothing */
    int refused;                        /* flag: it says why something was refused */
    const char *line;                   /* the command that draws it */
    int keys;                           /* flag: the keys are shown */
};

/* The largest whole scale of a picture in a window; at least 1. */
int view_desk_scale(const struct sim_picture *picture, int w, int h);

/* Draw into a window's pixels. */
void view_desk_draw(const struct view_desk *desk, struct view_canvas *canvas, uint32_t *to, int w, int h, int pitch);

#endif
