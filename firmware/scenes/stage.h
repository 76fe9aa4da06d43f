/* What every scene does to fill a struct demo_frame.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef STAGE_H
#define STAGE_H

#include "scenes.h"

/* A demo scene, demo_ID: composed for 240 x 240 px; last the accelerators for what is in it. */
#define STAGE_DEMO(id, what_, frames_, varyings_, depth_, pose_, ...) \
    static const struct zs_fast *const fast_##id[] = { __VA_ARGS__, ZS_FAST_END }; \
    const struct demo demo_##id = { .name = #id, .what = what_, .width = 240, .height = 240, .frames = frames_, \
                                    .varyings = varyings_, .depth = &depth_, .fast = fast_##id, .pose = pose_ }

/* Begin: no instances, this background. */
void stage_open(struct demo_frame *f, struct zs_rgb background);

/* What cameras turn around in most scenes: 0, 0, 0. */
extern const int32_t stage_origin[3];

/* A material whose colours are those of the mesh. */
#define STAGE_PAINT(name, shade) \
    static const struct zs_material name = { .shader = &shade, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_BACK }
/* A material that is a texture and nothing else. */
#define STAGE_COVER(name, shade, image) \
    static const struct zs_material name = { .shader = &shade, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_BACK, \
                                             .texture = &image }

/* One parallel light from a direction of any length but 0; percent of full. */
void stage_light(struct demo_frame *f, int32_t x, int32_t y, int32_t z, uint32_t ambient_percent,
                 uint32_t diffuse_percent);

/* Append an instance, unrotated; its rotation is the caller's to set. Never NULL: a scene has at
 * most DEMO_INSTANCES_MAX. */
struct zs_pose *stage_put(struct demo_frame *f, const struct zs_mesh *mesh,
                          const struct zs_material *material, int32_t x, int32_t y, int32_t z,
                          zs_uq16_16 scale);

/* A perspective camera whose field of view spans the picture's shorter side. */
void stage_lens(struct demo_frame *f, zs_turn fov, uint16_t w, uint16_t h, int32_t z_near,
                int32_t z_far);

/* Set the camera's pose: at the origin, along -z. The other fields stay. */
static inline void stage_unturned(struct zs_camera *camera)
{
    struct zs_pose none;
    zs_pose_identity(&none);
    for (int i = 0; i < 9; i++)
        camera->rot[i] = none.rot[i];
    for (int i = 0; i < 3; i++)
        camera->pos[i] = 0;
}

/* A program that shows scenes from other sides (sim/frame/demo_frame.c) defines STAGE_ORBIT and this function: where a
 * piece's camera has been placed, before all that depends on it, it is turned about a point so many units in front of
 * it; 0: on the spot. */
#ifdef STAGE_ORBIT
void stage_orbit(struct zs_camera *camera, int32_t distance);
#else
static inline void stage_orbit(struct zs_camera *camera, int32_t distance)
{
    (void)camera;
    (void)distance;
}
#endif

/* The angle of frame t of n, turned a whole number of times, so that the animation closes. */
zs_turn stage_turn(uint32_t t, uint32_t n, uint32_t times);

/* radius * sin or cos, rounded to the nearest; |radius| <= 2^29. */
int32_t stage_sin(int32_t radius, zs_turn a);
int32_t stage_cos(int32_t radius, zs_turn a);

#endif
