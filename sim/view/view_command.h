/* `zsim view`: a model or demo scene in a window, drawn anew as it is turned, set or written.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_VIEW_COMMAND_H
#define SIM_VIEW_VIEW_COMMAND_H

/* Run with the arguments after "view". Return enum sim_status. */
int sim_view(int argc, char **argv);

#endif
