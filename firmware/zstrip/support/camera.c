/* Cameras from angles, points and directions, in integers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"

static void origin(struct zs_camera *camera, uint8_t projection, int32_t z_near, int32_t z_far)
{
    for (int k = 0; k < 9; k++)
        camera->rot[k] = k % 4 == 0 ? ZS_Q30_ONE : 0;
    camera->pos[0] = camera->pos[1] = camera->pos[2] = 0;
    camera->projection = projection;
    camera->z_near = (zs_q48_16)z_near * 65536;
    camera->z_far = (zs_q48_16)z_far * 65536;
}

int zs_camera_perspective(struct zs_camera *camera, zs_turn fov_y, uint16_t height_px,
                          int32_t z_near, int32_t z_far)
{
    if (fov_y == 0 || fov_y > 32767u || z_near <= 0 || z_near >= z_far || z_far > ZS_WORLD_MAX)
        return ZS_ERR_CAMERA;
    /* focal = height / 2 / tan(fov / 2). Half of an odd angle is the mean of its neighbours' sines.
     */
    const zs_turn low = (zs_turn)(fov_y / 2u), high = (zs_turn)(fov_y - low);
    const int64_t s = (int64_t)zs_sin(low) + zs_sin(high); /* both q2_30, twice sin and cos */
    const int64_t c = (int64_t)zs_cos(low) + zs_cos(high);
    const zs_uq32_32 focal = zs_muldiv_u64((uint64_t)c, (uint64_t)height_px << 31, (uint64_t)s);
    if (focal < ZS_FOCAL_MIN || focal > ZS_FOCAL_MAX)
        return ZS_ERR_CAMERA;
    origin(camera, ZS_PERSPECTIVE, z_near, z_far);
    camera->focal = focal;
    camera->height = 0;
    return ZS_OK;
}

int zs_camera_orthographic(struct zs_camera *camera, int32_t height, int32_t z_near, int32_t z_far)
{
    if (height <= 0 || z_near >= z_far || z_far > ZS_WORLD_MAX || z_near < -ZS_WORLD_MAX)
        return ZS_ERR_CAMERA;
    origin(camera, ZS_ORTHOGRAPHIC, z_near, z_far);
    camera->focal = 0;
    camera->height = (zs_q48_16)height * 65536;
    return ZS_OK;
}

static int in_world(const int32_t p[3])
{
    for (int k = 0; k < 3; k++)
        if (p[k] > ZS_WORLD_MAX || p[k] < -ZS_WORLD_MAX)
            return 0;
    return 1;
}

/* Scale v by a power of two, so that the largest component is in [2^30, 2^31). That is exact,
 * except with a component of -2^31: then all are halved. v is not 0 0 0. */
static void stretch(int32_t out[3], const int32_t v[3])
{
    uint32_t mag = 0;
    for (int k = 0; k < 3; k++)
        mag |= v[k] < 0 ? 0u - (uint32_t)v[k] : (uint32_t)v[k];
    for (int k = 0; k < 3; k++)
        out[k] = mag >> 31 ? v[k] / 2 : v[k] * ((int32_t)1 << (zs_clz32(mag) - 1));
}

int zs_camera_look_along(struct zs_camera *camera, const int32_t eye[3], const int32_t dir[3],
                         const int32_t up[3])
{
    zs_q2_30 forward[3], right[3];
    int32_t f[3], u[3];
    int64_t cross[3], most = 0;
    if (!in_world(eye))
        return ZS_ERR_RANGE;
    if (zs_unit(forward, dir) || zs_unit(right, up))
        return ZS_ERR_VECTOR; /* one of them is 0 */
    stretch(f, dir);
    stretch(u, up);
    for (int k = 0; k < 3;
         k++) { /* of the vectors as given: exact, also if they are nearly parallel */
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        cross[k] = (int64_t)f[i] * u[j] - (int64_t)f[j] * u[i]; /* |.| < 2^63 - 2^32 */
        most |= cross[k] < 0 ? -cross[k] : cross[k];
    }
    if (most >> 40 == 0) /* sine of the angle below about 2^-21: treated as parallel */
        return ZS_ERR_VECTOR;
    (void)zs_unit64(right, cross);
    for (int k = 0; k < 3; k++) {
        camera->rot[k] = right[k];
        camera->rot[6 + k] = -forward[k];
        camera->pos[k] = eye[k];
    }
    zs_cross(camera->rot + 3, camera->rot + 6, camera->rot);
    return ZS_OK;
}

int zs_camera_look_at(struct zs_camera *camera, const int32_t eye[3], const int32_t at[3],
                      const int32_t up[3])
{
    if (!in_world(eye) || !in_world(at))
        return ZS_ERR_RANGE;
    const int32_t dir[3] = { at[0] - eye[0], at[1] - eye[1], at[2] - eye[2] }; /* <= 2^30 */
    return zs_camera_look_along(camera, eye, dir, up);
}

int zs_camera_orbit(struct zs_camera *camera, const int32_t at[3], int32_t distance, zs_turn yaw,
                    int16_t pitch)
{
    if (pitch <= -16384 || pitch >= 16384 || distance <= 0)
        return ZS_ERR_VECTOR;
    if (distance > ZS_WORLD_MAX || !in_world(at))
        return ZS_ERR_RANGE;
    const int64_t flat = zs_cos((zs_turn)pitch);
    const zs_q2_30 out[3] = { (zs_q2_30)zs_round_shift(flat * zs_sin(yaw), 30),
                              zs_sin((zs_turn)pitch),
                              (zs_q2_30)zs_round_shift(flat * zs_cos(yaw), 30) };
    int32_t eye[3], dir[3];
    for (int k = 0; k < 3; k++) {
        eye[k] = at[k] + (int32_t)zs_round_shift((int64_t)out[k] * distance, 30);
        dir[k] = -out[k];
    }
    const int32_t up[3] = { 0, 1, 0 };
    return zs_camera_look_along(camera, eye, dir, up);
}
