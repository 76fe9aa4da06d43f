/* Ambient and one directional light.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pipeline.h"

uint32_t zs_light_intensity(const struct zs_renderer *r, const zs_q1_15 n[3])
{
    const struct zs_light *light = &r->scene->light;
    const int32_t *l = r->xform.light; /* q2_30 */
    const int64_t dot = (int64_t)n[0] * l[0] + (int64_t)n[1] * l[1] + (int64_t)n[2] * l[2];
    if (dot <= 0) /* q19_45, |.| < 2^46.6 */
        return light->ambient;
    /* normals end at 32767: dot / (32767 * 2^15) is dot / 2^30 (1 + 2^-15 + ...) */
    const uint32_t lambert = (uint32_t)((dot + (dot >> 15)) >> 15);       /* uq2_30, < 2^31.6 */
    return light->ambient + (uint32_t)(((uint64_t)light->diffuse * lambert + (1u << 29)) >> 30);
}
