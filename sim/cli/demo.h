/* `zsim demo`: the demo scenes, drawn as a board would.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEMO_H
#define SIM_DEMO_H

/* Run with the arguments after "demo". Return enum sim_status. */
int sim_demo(int argc, char **argv);

#endif
