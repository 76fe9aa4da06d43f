/* What 0 stands for in scenes, cameras and configurations. Every stage that reads one of these fields
 * asks here. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_USUAL_H
#define ZS_USUAL_H

#include "zs_setup.h"

/* m, or the identity where m is all 0. m is not checked: its first row is 0 0 0. */
const zs_q2_30 *zs_usual_rows(const zs_q2_30 m[9]);

/* A pose's or a camera's rotation. A rotation's first row is not 0 0 0. */
static inline const zs_q2_30 *zs_usual_rotation(const zs_q2_30 m[9])
{
    return m[0] | m[1] | m[2] ? m : zs_usual_rows(m);
}

/* World units to a mesh step, q32_32, > 0. */
static inline uint64_t zs_usual_scale(const struct zs_instance *in)
{
    const zs_uq16_16 mesh = in->mesh->scale, pose = in->pose.scale;
    return (uint64_t)(mesh ? mesh : ZS_Q16_ONE) * (pose ? pose : ZS_Q16_ONE);
}

/* *out = *light, or the usual light of a camera with that rotation. */
void zs_usual_light(struct zs_light *out, const struct zs_light *light, const zs_q2_30 camera[9]);

/* buffers, sub-pixel bits and depth bits. */
void zs_usual_config(struct zs_config *config);

#endif
