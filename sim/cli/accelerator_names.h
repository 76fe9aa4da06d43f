/* Accelerators by name, for command lines: "all", "none", names with commas between, or "all" without some, as
 * all-tiles-touch.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ACCELERATOR_NAMES_H
#define SIM_ACCELERATOR_NAMES_H

#include "zs_fast.h"

#define SIM_FAST_MAX 32 /* of a list */

/* The accelerators that are drawn with; the last one NULL. */
struct sim_fast {
    const struct zs_fast *list[SIM_FAST_MAX + 1];
};

/* Fill *fast from text; NULL: all. SIM_OK; SIM_USAGE: said why. */
int sim_fast_take(struct sim_fast *fast, const char *text);

/* A list without one of them, which zs_fast.h declares. */
void sim_fast_without(struct sim_fast *fast, const struct zs_fast *const *list, const struct zs_fast *gone);

/* All names, on one line. Static storage. */
const char *sim_fast_list(void);

#endif
