/* The usual test of a piece of a row: nearer wins. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_LESS_H
#define ZS_FAST_LESS_H

#include "core/rows.h"

/* zs_fast.span of a shader that colours runs. */
void zs_fast_less(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t gx);
/* zs_fast.rows of one. */
int zs_fast_less_rows(struct zs_job *job);

#endif
