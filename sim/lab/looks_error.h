/* `zlab looks`: how far the estimate is from what looks take.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LOOKS_ERROR_H
#define SIM_LOOKS_ERROR_H

/* Run with the arguments after "looks". Return enum sim_status. */
int sim_looks(int argc, char **argv);

#endif
