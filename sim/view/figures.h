/* What a picture would take on boards, as `zsim budget` counts it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_FIGURES_H
#define SIM_VIEW_FIGURES_H

#include "budget.h"
#include "shot.h"

struct view_figures {
    int known;                /* flag: the rest is set */
    int plain;                /* flag: effects, lines and points of it are not counted */
    struct budget_ram ram;    /* pools as the words say, or for one pass */
    double fps[BUDGET_USUAL_PARTS]; /* NAN: not known */
    double error;                   /* percent that these may be off; 0: not known */
    int too_small[BUDGET_USUAL_PARTS]; /* flag: RAM or flash */
};

/* Count; where that is refused, nothing is known. */
void view_figures_count(struct view_figures *f, const struct view_shot *shot);

#endif
