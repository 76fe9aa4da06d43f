/* Angles, poses, vectors and cameras, from integers. zstrip.h includes this header.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_MATH_H
#define ZS_MATH_H

#include "zs_scene.h"

ZS_C_BEGIN

/* Sine and cosine of an angle. Error <= 2^-28. No table. */
zs_q2_30 zs_sin(zs_turn a);
zs_q2_30 zs_cos(zs_turn a);

/* Scale a vector to length 1. v  any but 0 0 0; may be out. Error <= 2^-28 a component.
 * Return ZS_OK; ZS_ERR_VECTOR (v is 0 0 0): out is untouched. */
int zs_unit(zs_q2_30 out[3], const int32_t v[3]);

/* Set a pose to no rotation, no shift, scale 1. (A pose of zeros means the same.) */
void zs_pose_identity(struct zs_pose *pose);

/* Set pose->rot to Ry(yaw) * Rx(pitch) * Rz(roll): roll is applied first. pos and scale stay.
 * Error <= 2^-27 an element. */
void zs_pose_turn(struct zs_pose *pose, zs_turn yaw, zs_turn pitch, zs_turn roll);

/* Rotate a pose further, about a world axis. pos and scale stay.
 *
 * axis    any length but 0.
 * Error   <= 2^-28 an element for one call. After any number of calls, about any axes, rot is a
 *         rotation to 2^-27. After a million calls, a point 160 px from the middle is less than a
 *         sub-pixel (1/256 px) away from where exact rotations would have brought it. Quarter turns
 *         of an object that lies along the axes are exact. A matrix that is no rotation to 2^-20 is
 *         made one first (Gram-Schmidt; if its first two rows are parallel or 0, any one; all 0 is
 *         no rotation).
 * Cost    4,700 instructions on a Cortex-M3, 30,000 on a Cortex-M0+.
 * Return  ZS_OK; ZS_ERR_VECTOR (axis is 0 0 0): pose is untouched. */
int zs_pose_rotate(struct zs_pose *pose, const int32_t axis[3], zs_turn angle);

/* Set a perspective camera at the origin that looks down -z.
 *
 * fov_y     the vertical angle of view, 1 .. 32767: ZS_DEGREES(45).
 * height_px the height of the frame, or of the viewport that a pass draws into (zs_pass.h).
 * z_near, z_far  world units, 0 < near < far <= ZS_WORLD_MAX. zs_frame_begin wants far - near >=
 *           far / 65536, too.
 * Return    ZS_OK; ZS_ERR_CAMERA (one of them, or the focal length, is out of range): camera is
 *           untouched. */
ZS_NODISCARD int zs_camera_perspective(struct zs_camera *camera, zs_turn fov_y, uint16_t height_px,
                                       int32_t z_near, int32_t z_far);

/* Set an orthographic camera at the origin that looks down -z.
 *
 * height  world units that the frame's height spans, > 0; zs_frame_begin takes up to 2^30.
 * z_near, z_far  world units, -ZS_WORLD_MAX <= near < far <= ZS_WORLD_MAX.
 * Return  ZS_OK; ZS_ERR_CAMERA (one of them is out of range): camera is untouched. */
ZS_NODISCARD int zs_camera_orthographic(struct zs_camera *camera, int32_t height, int32_t z_near,
                                        int32_t z_far);

/* Place a camera at eye and let it look at a point, or along a direction. Only rot and pos change.
 *
 * eye, at  world units, |coordinate| <= ZS_WORLD_MAX.
 * dir      any length but 0. Its components, and those of up, are above INT32_MIN: with that one,
 *          all are halved, and Error does not hold.
 * up       the direction that points upwards on the screen: any length but 0, not parallel to the
 *          view: from 2^-19 rad on, an angle between them is enough; below 2^-24 it never is. From
 *          (0, y, 1) to 0 0 0 with up = 0 1 0 the limit is 2^-21, y < 2^21.
 * Error    <= 2^-27 an element of rot.
 * Return   ZS_OK; ZS_ERR_RANGE; ZS_ERR_VECTOR (eye is at, or up is parallel to the view): camera is
 *          untouched. */
ZS_NODISCARD int zs_camera_look_at(struct zs_camera *camera, const int32_t eye[3],
                                   const int32_t at[3], const int32_t up[3]);
ZS_NODISCARD int zs_camera_look_along(struct zs_camera *camera, const int32_t eye[3],
                                      const int32_t dir[3], const int32_t up[3]);

/* Look at a point from a distance, with +y upwards.
 *
 * distance  1 .. ZS_WORLD_MAX, world units.
 * yaw       0: the camera stands on the point's +z side; ZS_DEGREES(90): on its +x side.
 * pitch     -16383 .. 16383, a signed angle, 65536 to the turn: ZS_PITCH(20) raises the eye.
 * Return    ZS_OK; ZS_ERR_RANGE (at, distance or the eye beyond the world); ZS_ERR_VECTOR (pitch,
 *           or a distance below 1): camera is untouched. */
ZS_NODISCARD int zs_camera_orbit(struct zs_camera *camera, const int32_t at[3], int32_t distance,
                                 zs_turn yaw, int16_t pitch);

ZS_C_END

#endif
