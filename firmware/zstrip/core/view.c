/* The view: a camera in camera units.
 *
 * World units are the user's choice, and may be coarse or fine. The renderer works in camera units,
 * 2^shift for each world unit. The shift is chosen once for each frame, so that the farthest
 * coordinate in view is below 2^30, and about 2^29 or more unless the shift is at its limit. So 30
 * bits hold every position, whatever the user's unit is.
 *
 * x' and y' are the camera's x and -y times ratio. The focal length is ratio * 2^scale_bits
 * sub-pixels, with 1/2 < ratio <= 1 (less for focal lengths below half a pixel). So the projection
 * is x' * 2^scale_bits / z, and x' needs no more bits than x.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"
#include "core/view.h"

/* camera units; with a smaller z_near, positions at the near plane are not exact enough */
#define NEAR_MIN 256
#define SCALE_BITS_MIN 8  /* perspective: keeps the shift of a projection below 63 bits */
#define SCALE_BITS_MAX 40 /* orthographic: keeps view->guard below 2^61 */
#define WORLD_MAX_Q16 ((zs_q48_16)ZS_WORLD_MAX * 65536)

static int range_ok(const struct zs_camera *camera)
{
    if (camera->z_near >= camera->z_far || camera->z_far > (zs_q48_16)ZS_FAR_MAX * 65536 ||
        camera->z_near > WORLD_MAX_Q16 || camera->z_near < -WORLD_MAX_Q16)
        return 0;
    if (camera->projection == ZS_ORTHOGRAPHIC)
        return camera->height >= ZS_HEIGHT_MIN && camera->height <= 2 * WORLD_MAX_Q16;
    return camera->projection == ZS_PERSPECTIVE && camera->z_near > 0 &&
           camera->z_far - camera->z_near >= camera->z_far / 65536 &&
           camera->focal >= ZS_FOCAL_MIN && camera->focal <= ZS_FOCAL_MAX;
}

/* Split num / den into ratio * 2^*bits with ratio in (1/2, 1], q2_30. 2^24 <= num < 2^37,
 * ZS_HEIGHT_MIN <= den < 2^47, so num / den <= 2^33 and -24 <= *bits <= 33. */
static int32_t split_ratio(uint64_t num, uint64_t den, int32_t *bits)
{
    int32_t up = zs_clz64(num) - zs_clz64(den) + 31; /* num 2^up / den in (2^30, 2^32), or up < 0 */
    if (up < 0)
        up = 0;
    uint64_t r = zs_muldiv_u64(num, (uint64_t)zs_scale2(1, up), den); /* 2^30 .. 2^33 */
    for (; r > (uint64_t)ZS_Q30_ONE; r >>= 1)
        up--;
    *bits = 30 - up;
    return (int32_t)r;
}

void zs_view_side(int32_t out[2], uint64_t focal, uint32_t subpx)
{
    uint64_t half = (uint64_t)subpx << 24; /* uq32_32 px, <= 2^44 */
    while (focal >> 30 || half >> 30) {
        focal >>= 1;
        half >>= 1;
    }
    const int32_t v[3] = { (int32_t)focal, (int32_t)half, 0 };
    int32_t n[3] = { 0, ZS_Q30_ONE, 0 };
    (void)zs_unit(n, v); /* perspective: v is not 0, as the larger one is in [2^29, 2^30), or focal
                            is 2^16 or more; for orthographic cameras the sides are not read */
    out[0] = n[0];
    out[1] = n[1];
}

void zs_view_frame(struct zs_view *view, const struct zs_config *config)
{
    view->depth = config->depth;
    view->mirror = 0;
    view->width = config->width;
    view->height = config->height;
    view->x = view->y = 0;
}

int zs_view_camera(struct zs_view *view, const struct zs_config *config,
                   const struct zs_camera *camera)
{
    if (!range_ok(camera) || !zs_rotation_ok(camera->rot))
        return ZS_ERR_CAMERA;
    if (!zs_within(camera->pos, 3, ZS_WORLD_MAX))
        return ZS_ERR_RANGE;
    for (int k = 0; k < 3; k++)
        view->pos[k] = camera->pos[k];
    view->perspective = camera->projection == ZS_PERSPECTIVE;
    view->cx = view->width * ZS_SUBPX_HALF;
    view->cy = view->y * ZS_SUBPX_ONE + view->height * ZS_SUBPX_HALF;
    view->snap = ZS_SUBPX_BITS - config->subpixel_bits;
    zs_view_side(view->side[0], camera->focal, view->width * (uint32_t)ZS_SUBPX_HALF);
    zs_view_side(view->side[1], camera->focal, view->height * (uint32_t)ZS_SUBPX_HALF);
    return ZS_OK;
}

/* Set ratio, scale_bits and guard. They express the focal length in sub-pixels (perspective) or the
 * sub-pixels for each camera unit (orthographic). */
static int scale_set(struct zs_view *view, const struct zs_camera *camera)
{
    int32_t bits;
    if (view->perspective) {
        const uint64_t focal = camera->focal << 8; /* uq32_32 sub-pixels, <= 2^63 */
        /* bits: the least with focal <= 2^(32 + bits) */
        const uint32_t high = (uint32_t)((focal - 1u) >> 32);
        bits = high ? 32 - zs_clz32(high) : 0;
        bits = zs_max32(bits, SCALE_BITS_MIN);
        /* focal / 2^(bits + 2), nearest */
        view->ratio = (int32_t)zs_round_shift((int64_t)(focal >> 1), bits + 1);
        view->scale_bits = bits;
        view->guard = (uint64_t)ZS_GUARD_SUBPX;
        return ZS_OK;
    }
    const uint64_t num = (uint64_t)view->height << 24; /* q16 sub-pixels */
    view->ratio = split_ratio(num, (uint64_t)camera->height, &bits);
    view->scale_bits = view->shift - bits; /* log2 of camera units for each sub-pixel */
    if (view->scale_bits < 0)
        return ZS_ERR_RANGE;                 /* units are coarser than sub-pixels */
    if (view->scale_bits > SCALE_BITS_MAX) { /* finer than needed: coarser units lose nothing */
        view->shift -= view->scale_bits - SCALE_BITS_MAX;
        view->scale_bits = SCALE_BITS_MAX;
    }
    view->guard = (uint64_t)zs_scale2(ZS_GUARD_SUBPX, view->scale_bits); /* < 2^61 */
    return ZS_OK;
}

int32_t zs_view_length(const struct zs_view *view, zs_q48_16 length)
{
    const int32_t n = view->shift - 16;
    const int64_t most = 1 << 30; /* farther than anything in view */
    const int64_t near_by = zs_held64(length, n >= 0 ? most >> n : INT64_MAX);
    return (int32_t)zs_held64(zs_scale2(near_by, n), most);
}

void zs_view_axes(zs_q2_30 out[9], const struct zs_camera *camera)
{
    for (int k = 0; k < 3; k++) {
        out[k] = camera->rot[k];
        out[3 + k] = -camera->rot[3 + k];
        out[6 + k] = -camera->rot[6 + k];
    }
}

int zs_view_units(struct zs_view *view, const struct zs_camera *camera, int64_t reach)
{
    const int64_t near_mag = zs_size64(camera->z_near);
    if (reach < near_mag)
        reach = near_mag; /* keys count from the near plane */
    if (view->perspective && camera->z_far <= 2 * camera->z_near && reach < camera->z_far)
        reach = camera->z_far;
    reach += reach / 64 + 1; /* for rounding, and so that z_far > z_near in camera units */
    view->shift = zs_clz64((uint64_t)reach) - 64 + 30 + 16; /* reach * 2^(shift - 16) < 2^30 */
    if (view->shift > 30)
        view->shift = 30;
    const int err = scale_set(view, camera); /* may lower the shift */
    if (err)
        return err;
    view->z_near = zs_view_length(view, camera->z_near);
    view->z_far = zs_view_length(view, camera->z_far);
    if (view->z_near >= view->z_far || (view->perspective && view->z_near < NEAR_MIN))
        return ZS_ERR_NEAR;
    zs_view_axes(view->rot, camera);
    for (int k = 0; k < 6; k++)
        view->rot[k] = (int32_t)zs_round_shift(zs_mul_ss(view->rot[k], view->ratio), 30);
    return ZS_OK;
}
