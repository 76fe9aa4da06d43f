/* `zsim depths`: which depth mapping tells surfaces apart, and how far.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEPTHS_H
#define SIM_DEPTHS_H

/* Arguments after the command's name. Return an exit status. */
int sim_depths(int argc, char **argv);

#endif
