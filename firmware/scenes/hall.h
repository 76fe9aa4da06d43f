/* What the hall's meshes (gen/hall.c) and the scene that walks through it (hall.c) agree upon. A
 * step is a millimetre; the hall runs along -z.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef HALL_H
#define HALL_H

#define HALL_PERIOD 4000 /* steps: the hall repeats in z */
#define HALL_BEHIND 1    /* periods behind the origin ... */
#define HALL_AHEAD 6     /* ... and ahead of it */
#define HALL_HALF 1600   /* from its middle to a wall */
#define HALL_HEIGHT 3000
#define HALL_CRATE 350   /* half an edge */

#endif
