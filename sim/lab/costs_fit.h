/* `zlab costs`: what a stage costs on a core, fitted from what probes took there.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_COSTS_FIT_H
#define SIM_COSTS_FIT_H

/* The command: the arguments after its name. */
int sim_costs(int argc, char **argv);

#endif
