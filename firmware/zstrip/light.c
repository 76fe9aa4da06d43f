/* Ambient and one directional light.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pipeline.h"

uint32_t zs_light_intensity(const struct zs_renderer *r, const zs_q1_15 n[3])
{
    const struct zs_light *light = &r->scene->light;
    const int32_t *l = r->xform.light; /* q18_14, length 1 to 2^-14 */
    const int32_t dot = n[0] * l[0] + n[1] * l[1] + n[2] * l[2]; /* each < 2^29.1, sum < 2^30.8 */
    if (dot <= 0)
        return light->ambient;
    /* normals end at 32767: dot / (32767 * 2^14) to 2^-15 is dot / 2^29 (1 + 2^-15) */
    const uint32_t lambert = (uint32_t)dot + ((uint32_t)dot >> 15);
    const uint32_t sum = light->ambient +
                         (uint32_t)(((uint64_t)light->diffuse * lambert + (1u << 28)) >> 29);
    return sum > ZS_Q16_ONE ? ZS_Q16_ONE : sum;
}
