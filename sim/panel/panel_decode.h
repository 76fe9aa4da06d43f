/* `zsim panel`: a recorded stream of a panel's bytes to pictures of its glass.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PANEL_DECODE_H
#define SIM_PANEL_DECODE_H

/* The arguments after "panel". Return an enum sim_status. */
int sim_panel(int argc, char **argv);

#endif
