/* `zsim render`: a model file to a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RENDER_H
#define SIM_RENDER_H

/* Run with the arguments after "render". Return enum sim_status. */
int sim_render(int argc, char **argv);

#endif
