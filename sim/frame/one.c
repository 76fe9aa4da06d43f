/* One mesh before a camera.
 *
 * SPDX-License-Identifier: MIT
 */
#include "one.h"

#include <string.h>

#include "frame.h"

void sim_one_open(struct sim_one *one, uint16_t width, uint16_t height)
{
    memset(one, 0, sizeof *one);
    one->material.shader = &zs_shade_raw;
    one->instance.mesh = &one->mesh;
    one->instance.material = &one->material;
    zs_pose_identity(&one->instance.pose);
    one->scene.instance = &one->instance;
    one->scene.n_instances = 1;
    sim_frame_config(&one->config, width, height, ZS_VARYINGS_TEXTURE);
}
