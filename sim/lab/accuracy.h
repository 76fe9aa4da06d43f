/* `zsim accuracy`: how exact the renderer is, measured against the reference and whole numbers.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ACCURACY_H
#define SIM_ACCURACY_H

#include <stdint.h>

/* The command. SIM_OK where every row of its table passes; SIM_REFUSED where one fails, or could
 * not be measured; SIM_USAGE. */
int sim_accuracy(int argc, char **argv);

/* How far off zs_pose_rotate is after n rotations, composed: sub-pixels of 1/256 px, 160 px from the middle, at the worst of
 * those that were looked at (every 64th, and the last). wander: 0 the same step each time, 1 a random one. */
double sim_accuracy_drift(uint64_t seed, uint32_t n, int wander);

#endif
