/* A planet turns, its moon goes around it, and stars are behind them: spheres without a seam.
 *
 * SPDX-License-Identifier: MIT
 */
#include "meshes.h"
#include "stage.h"

#define FRAMES 60u
#define ORBIT 41000 /* of the moon, steps of the globe's mesh, whose radius is 28000 */

STAGE_COVER(earth, zs_shade_texture_smooth, texture_earth);
STAGE_COVER(moon, zs_shade_texture_smooth, texture_moon);
STAGE_COVER(stars, zs_shade_texture, texture_stars);

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb black = { 0, 0, 0 };
    const zs_turn turn = stage_turn(t, FRAMES, 1), orbit = (zs_turn)(turn + 58800u);
    stage_open(f, black);
    stage_light(f, 6, 3, 4, 7, 100);
    zs_pose_turn(stage_put(f, &mesh_globe, &earth, 0, 0, 0, ZS_Q16_ONE), turn, 0, 63500);
    zs_pose_turn(stage_put(f, &mesh_globe, &moon, stage_sin(ORBIT, orbit), stage_sin(-9000, orbit),
                           stage_cos(ORBIT, orbit), ZS_Q16_ONE / 4u),
                 orbit, 0, 0);
    stage_put(f, &mesh_sky, &stars, 0, 0, 0, ZS_Q16_ONE * 16u);
    stage_lens(f, 8200, w, h, 20000, 1200000);
    zs_camera_orbit(&f->camera, stage_origin, 116000, 0, 2600);
}

STAGE_DEMO(globe, "A planet and its moon under the stars, smooth light over textures of three sizes",
           FRAMES, ZS_VARYINGS_TEXTURE_SMOOTH, zs_depth_float, pose, ZS_FAST_FRAME, ZS_FAST_TEXTURE,
           ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_PAL8, ZS_FAST_PAL4);
