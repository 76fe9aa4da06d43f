/* What the meshes that fly with the eye (gen/cockpit.c) and the scene that has them (pieces/cockpit.c) agree upon.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef VIEW_H
#define VIEW_H

#define COCKPIT_DEPTH 2144 /* steps: where half of the picture's shorter side is 1000, with an angle of view of ... */
#define COCKPIT_FOV ZS_DEGREES(50)
#define COCKPIT_SCALE 13107u /* uq16_16: 1/5 world unit to a step */

#endif
