/* Which texel a pixel shows, found from the renderer itself.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_TEXEL_NUMBERS_H
#define SIM_TEXEL_NUMBERS_H

#include "zstrip.h"

/* The number of the texel that is seen at every pixel, row * width + column + 1 of its texture; 0
 * where there is none, or where smooth light is so weak that it hides it. texel: [height][width].
 * Frames of the same geometry, camera and profile, one for every three bits of the largest number
 * and one more, with textures of the same sizes that hold a bit in each channel. What is lit at its
 * vertices keeps its shader and light: they have a say in where the renderer divides.
 * Return  ZS_OK, an enum zs_err, or SIM_FRAME_BROKEN. */
int sim_frame_texels(uint32_t *texel, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config);

#endif
