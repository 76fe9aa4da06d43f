/* The usual depth test (less) for a piece of a scanline. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_LESS_H
#define ZS_FAST_LESS_H

#include "core/rows.h"

/* zs_fast.span for a shader with a run function. */
void zs_fast_less(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t gx);
/* zs_fast.rows for such a shader. */
int zs_fast_less_rows(struct zs_job *job);

#endif
