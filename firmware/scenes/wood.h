/* What the forest's meshes (gen/forest.c) and the scene that walks through it (pieces/forest.c) agree upon. A step is a
 * millimetre; the path runs along -z.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WOOD_H
#define WOOD_H

#define WOOD_PERIOD 24000 /* steps: the path and the ground repeat in z */
#define WOOD_BEND 1100    /* steps: the path's middle is at x = WOOD_BEND * sin(z / WOOD_PERIOD) */
#define WOOD_HALF 11000   /* of the ground, to each side of the path's middle */

#endif
