/* Kernels for a colour a face, shared by raw and flat shading. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_SOLID_H
#define ZS_SHADE_SOLID_H

#include "pipeline.h"

void zs_solid_rows(struct zs_job *job);
void zs_solid_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                   uint32_t gx);
void zs_solid_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

#endif
