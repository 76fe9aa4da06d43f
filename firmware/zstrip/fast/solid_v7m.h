/* Small triangles of one colour on Armv7-M (fast/solid_v7m.c). Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SOLID_V7M_H
#define ZS_SOLID_V7M_H

#include "core/job.h"

#if ZS_V7M
/* In place of small_draw (fast/fast_solid.c). */
int zs_solid_v7m(struct zs_job *job);
#endif

#endif
