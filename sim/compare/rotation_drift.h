/* How far rotations drift that are composed again and again.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ROTATION_DRIFT_H
#define SIM_ROTATION_DRIFT_H

#include <stdint.h>

#define SIM_ROTATION_LEVER 160 /* px: half of 320 */

/* How far off zs_pose_rotate is after n rotations, composed: sub-pixels of 1/256 px, SIM_ROTATION_LEVER from the
 * middle, at the worst of those that were looked at (every 64th, and the last). wander: 0 the same step each time, 1 a
 * random one. */
double sim_rotation_drift(uint64_t seed, uint32_t n, int wander);

#endif
