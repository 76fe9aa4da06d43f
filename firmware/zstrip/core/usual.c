/* The usual values that 0 stands for in scenes and cameras.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"
#include "core/usual.h"

const zs_q2_30 *zs_usual_rotation(const zs_q2_30 m[9])
{
    static const zs_q2_30 identity[9] = { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE };
    for (int k = 0; k < 9; k++)
        if (m[k])
            return m; /* a rotation has an element that is not 0 */
    return identity;
}

uint64_t zs_usual_scale(const struct zs_instance *in)
{
    const zs_uq16_16 mesh = in->mesh->scale, pose = in->pose.scale;
    return zs_mul_uu(mesh ? mesh : ZS_Q16_ONE, pose ? pose : ZS_Q16_ONE);
}

void zs_usual_camera(struct zs_renderer *r, const struct zs_scene *scene,
                     const struct zs_camera *camera)
{
    static const zs_q2_30 over_left[3] = { -357913941, 715827883, 715827883 }; /* right, up, back */
    const zs_q2_30 *const rot = zs_usual_rotation(camera->rot);
    struct zs_light *const light = &r->light;
    r->camera = *camera;
    for (int k = 0; k < 9; k++)
        r->camera.rot[k] = rot[k];
    *light = scene->light;
    if ((uint32_t)(light->dir[0] | light->dir[1] | light->dir[2]) | light->ambient | light->diffuse)
        return;
    zs_rotation_row(light->dir, over_left, rot); /* from camera axes to world axes */
    light->ambient = ZS_Q16_ONE / 4;
    light->diffuse = ZS_Q16_ONE / 4 * 3;
}
