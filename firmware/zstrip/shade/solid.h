/* Triangles of one colour: the run function of raw and flat shading. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_SOLID_H
#define ZS_SHADE_SOLID_H

#include "core/rows.h"

void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

#endif
