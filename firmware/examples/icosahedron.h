/* A ball of 20 triangles, for examples that show light and shaders.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICOSAHEDRON_H
#define ICOSAHEDRON_H

#include "examples.h"
#include "zs_math.h"

#define A 17225 /* corners of an icosahedron are its normals too: A * A + B * B is 32767^2 */
#define B 27873
static const int16_t icosahedron_pos[12][3] = { { -A, B, 0 }, { A, B, 0 }, { -A, -B, 0 }, { A, -B, 0 },
                                                { 0, -A, B }, { 0, A, B }, { 0, -A, -B }, { 0, A, -B },
                                                { B, 0, -A }, { B, 0, A }, { -B, 0, -A }, { -B, 0, A } };
#undef A
#undef B
static const uint16_t icosahedron_tri[20][3] = {
    { 0, 11, 5 }, { 0, 5, 1 },  { 0, 1, 7 },   { 0, 7, 10 }, { 0, 10, 11 }, /* about corner 0 */
    { 1, 5, 9 },  { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 },   /* beside these */
    { 3, 9, 4 },  { 3, 4, 2 },  { 3, 2, 6 },   { 3, 6, 8 },  { 3, 8, 9 },   /* about corner 3 */
    { 4, 9, 5 },  { 2, 4, 11 }, { 6, 2, 10 },  { 8, 6, 7 },  { 9, 8, 1 }    /* beside these */
};
static const struct zs_mesh icosahedron = {
    .pos = icosahedron_pos, .normal = icosahedron_pos, .tri = icosahedron_tri,
    .n_verts = 12, .n_tris = 20, .radius = 32768
};

/* The ball as it is turned in frame t, and a camera that looks at it from a little above. Return ZS_OK or an error. */
static inline int icosahedron_turn(struct zs_pose *pose, struct zs_camera *camera, uint32_t t)
{
    zs_pose_turn(pose, (zs_turn)(t * 700u), 0, 0);
    const int err = zs_camera_perspective(camera, ZS_DEGREES(50), EXAMPLE_H, 10000, 200000);
    return err ? err : zs_camera_orbit(camera, pose->pos, 88000, 0, ZS_DEGREES(15));
}

#endif
