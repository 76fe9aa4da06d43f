/* `zsim demo`: the demo scenes, drawn as a board would.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEMO_H
#define SIM_DEMO_H

#include "option_table.h"
#include "render.h"

/* One frame of one scene, as the arguments after "demo" say, among which are --scene NAME, --start and --frames 1, with
 * what is shown of it. Nothing is written. n_frames: of its animation. SIM_OK, sim_render_free of it; SIM_REFUSED,
 * SIM_USAGE, said why. */
int sim_demo_seen(struct sim_rendered *seen, uint32_t *n_frames, int argc, char **argv);

/* The rows of its table. */
const struct sim_option *sim_demo_rows(size_t *n);

/* Run with the arguments after "demo". Return enum sim_status. */
int sim_demo(int argc, char **argv);

#endif
