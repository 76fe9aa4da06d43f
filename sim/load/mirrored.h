/* Textures that a file repeats mirrored. The renderer repeats a picture as it is: so the picture gets its mirror image
 * beside it, and texture coordinates are halved.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MIRRORED_H
#define SIM_MIRRORED_H

#include "model.h"

enum sim_axes { SIM_AXIS_U = 1, SIM_AXIS_V = 2 }; /* or-ed */

/* Return those of `axes` along which a face of the material leaves the picture. Inside it, mirrored is as good as any.
 */
unsigned sim_mirror_leaves(const struct sim_model *model, uint32_t material, unsigned axes);

/* Append the mirror image, to the right and below.
 * Return SIM_OK; SIM_REFUSED, said why: it is too large for that, and stays as it was. */
int sim_mirror_picture(struct sim_image *image, unsigned axes, const char *name);

/* Halve the material's texture coordinates. */
void sim_mirror_uv(struct sim_model *model, uint32_t material, unsigned axes);

#endif
