/* One colour a triangle: what raw and flat shading share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_SOLID_H
#define ZS_SHADE_SOLID_H

#include "core/rows.h"

void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

#endif
