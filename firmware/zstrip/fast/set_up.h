/* Set-up of tiny triangles in assembler. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_SET_UP_H
#define ZS_FAST_SET_UP_H

#include "core/job.h"

#if ZS_SET_UP
/* zs_fast.set_up */
enum zs_set_up zs_set_up(struct zs_job *job);
/* zs_fast.start of smooth colours */
int zs_set_up_smooth(struct zs_job *job);
/* Set what job->texture is to triangles of job->tri's instance. */
void zs_texture_set_of(const struct zs_job *job, struct zs_texture_set *set);
/* Compute the planes of an affine triangle whose texture repeats, and of its light. 0: declined. */
int zs_set_up_texture(struct zs_job *job, const struct zs_texture_set *set);
#define ZS_SET_UP_HOOK .set_up = zs_set_up,
#define ZS_SET_UP_SMOOTH .start = zs_set_up_smooth,
#else
#define ZS_SET_UP_HOOK
#define ZS_SET_UP_SMOOTH
#endif

#endif
