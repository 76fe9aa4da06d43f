/* What the land's mesh (gen/terrain.c) and the scene that flies over it (flyover.c) agree upon.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LAND_H
#define LAND_H

#define LAND_PERIOD 26624 /* steps: the land repeats in x and z */
#define LAND_RIVER 2600   /* steps: its middle is at x = LAND_RIVER * sin(z / LAND_PERIOD) */

#endif
