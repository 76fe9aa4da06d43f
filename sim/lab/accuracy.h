/* `zlab accuracy`: how exact the renderer is, measured against the reference and whole numbers.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ACCURACY_H
#define SIM_ACCURACY_H

/* The command. SIM_OK where every row of its table passes; SIM_REFUSED where one fails, or could
 * not be measured; SIM_USAGE. */
int sim_accuracy(int argc, char **argv);

#endif
