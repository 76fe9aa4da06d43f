/* `zsim try`: a model file to pictures and figures, with nothing to choose.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_TRY_H
#define SIM_TRY_H

/* Run with the arguments after "try". Return enum sim_status. */
int sim_try(int argc, char **argv);

#endif
