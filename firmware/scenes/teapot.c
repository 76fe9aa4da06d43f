/* The Utah teapot on a table: smooth-shaded, and in painted china.
 *
 * SPDX-License-Identifier: MIT
 */
#include "meshes.h"
#include "stage.h"

#define FRAMES 48u

static const struct zs_material glaze = { .shader = &zs_shade_smooth, .rgb = { 255, 158, 74 }, .cull = ZS_CULL_BACK };
STAGE_COVER(china, zs_shade_texture_smooth, texture_glaze);
static const struct zs_material liquid = { .shader = &zs_shade_smooth, .rgb = { 92, 40, 16 }, .cull = ZS_CULL_BACK };
STAGE_PAINT(wood, zs_shade_smooth);

static void set(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h, const struct zs_material *pot)
{
    static const struct zs_rgb night = { 14, 24, 56 };
    static const int32_t at[3] = { 0, -2200, 0 };
    stage_open(f, night);
    stage_light(f, -5, 7, 6, 22, 82);

    const zs_turn yaw = stage_turn(t, FRAMES, 1);
    zs_pose_turn(stage_put(f, &mesh_teapot, pot, 0, 0, 0, ZS_Q16_ONE), yaw, 0, 0);
    zs_pose_turn(stage_put(f, &mesh_tea, &liquid, 0, 0, 0, ZS_Q16_ONE), yaw, 0, 0);
    stage_put(f, &mesh_table, &wood, 0, 0, 0, ZS_Q16_ONE);

    stage_lens(f, 6900, w, h, 20000, 180000);
    zs_camera_orbit(&f->camera, at, 88000, 0, 4300);
}

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    set(f, t, w, h, &glaze);
}

static void pose_china(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    set(f, t, w, h, &china);
}

STAGE_DEMO(teapot, "The Utah teapot turns on a table, lit from the upper left, smooth-shaded",
           FRAMES, ZS_VARYINGS_SMOOTH, zs_depth_float, pose, ZS_FAST_FRAME, ZS_FAST_SMOOTH);

STAGE_DEMO(china, "The teapot in painted china: smooth light over a texture",
           FRAMES, ZS_VARYINGS_TEXTURE_SMOOTH, zs_depth_float, pose_china, ZS_FAST_FRAME, ZS_FAST_SMOOTH,
           ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_PAL8);
