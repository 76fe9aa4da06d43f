/* What 0 stands for in scenes, cameras and configurations.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/usual.h"

static const zs_q2_30 identity[9] = { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE };

const zs_q2_30 *zs_usual_rows(const zs_q2_30 m[9])
{
    for (int k = 3; k < 9; k++)
        if (m[k])
            return m;
    return identity;
}

void zs_usual_light(struct zs_light *out, const struct zs_light *light, const zs_q2_30 camera[9])
{
    *out = *light;
    if (light->dir[0] | light->dir[1] | light->dir[2] || light->ambient | light->diffuse)
        return;
    for (int k = 0; k < 3; k++) { /* (-1, 2, 2) / 3 in right, up, back, to world axes */
        const int64_t sum = 2 * ((int64_t)camera[3 + k] + camera[6 + k]) - camera[k]; /* < 2^33.4 */
        out->dir[k] = (zs_q2_30)(zs_mulshift_s64(sum, 0x55555555u, 32)); /* 1 / 3 */
    }
    out->ambient = ZS_Q16_ONE / 4;
    out->diffuse = ZS_Q16_ONE / 4 * 3;
}

void zs_usual_config(struct zs_config *config)
{
    config->buffers = config->buffers ? config->buffers : 1;
    config->subpixel_bits = config->subpixel_bits ? config->subpixel_bits : 8;
    config->depth_bits = config->depth_bits ? config->depth_bits : 16;
}
