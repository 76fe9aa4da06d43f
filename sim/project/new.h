/* `zsim new`: a project of its own around a model.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_NEW_H
#define SIM_NEW_H

/* argv without the program's and the command's name. Returns an enum sim_status. */
int sim_new(int argc, char **argv);

#endif
