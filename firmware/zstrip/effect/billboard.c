/* Billboards: poses that turn to the camera.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "zs_environment.h"

void zs_pose_face(struct zs_pose *pose, const struct zs_camera *camera)
{
    const zs_q2_30 *const rot = zs_usual_rotation(camera->rot);
    for (int k = 0; k < 9; k++)
        pose->rot[k] = rot[k % 3 * 3 + k / 3];
}

int zs_pose_face_upright(struct zs_pose *pose, const struct zs_camera *camera, const int32_t up[3])
{
    int64_t wide[3];
    zs_q2_30 y[3], z[3], x[3];
    int32_t to[3];
    if (zs_unit(y, up))
        return ZS_ERR_VECTOR;
    for (int k = 0; k < 3; k++) { /* |.| <= 2^30 for places in the world */
        if (zs_size32(pose->pos[k]) > ZS_WORLD_MAX || zs_size32(camera->pos[k]) > ZS_WORLD_MAX)
            return ZS_ERR_RANGE;
        to[k] = camera->pos[k] - pose->pos[k];
    }
    if (camera->projection == ZS_ORTHOGRAPHIC)
        for (int k = 0; k < 3; k++)
            to[k] = zs_usual_rotation(camera->rot)[6 + k]; /* all of its rays are parallel */
    for (int k = 0; k < 3; k++)
        wide[k] = zs_cross_at(up, to, k); /* |.| <= 2^62: right, across the ray to the eye */
    if (zs_unit64(x, wide))
        return ZS_ERR_VECTOR;
    zs_cross(z, x, y);
    for (int k = 0; k < 3; k++) {
        pose->rot[3 * k] = x[k];
        pose->rot[3 * k + 1] = y[k];
        pose->rot[3 * k + 2] = z[k];
    }
    return ZS_OK;
}
