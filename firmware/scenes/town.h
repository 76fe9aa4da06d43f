/* What the town's mesh (gen/city.c) and the scene that shows it (city.c) agree upon.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TOWN_H
#define TOWN_H

#define TOWN_BLOCKS 5   /* to a side */
#define TOWN_PITCH 5000 /* steps from block to block; streets run between them */
#define TOWN_CURB 90    /* steps that a block lies above the street */

#endif
