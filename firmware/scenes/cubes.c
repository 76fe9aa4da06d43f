/* A ring of tumbling cubes around a large one, flat-shaded: each turns about its own three axes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "meshes.h"
#include "stage.h"

#define FRAMES 60u
#define AROUND 8u
#define RADIUS 27500

STAGE_PAINT(paint, zs_shade_flat);

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb dusk = { 24, 20, 44 };
    stage_open(f, dusk);
    stage_light(f, -4, 8, 7, 40, 72);

    /* whole turns in the animation everywhere, so that its last frame meets the first */
    const zs_turn once = stage_turn(t, FRAMES, 1), twice = stage_turn(t, FRAMES, 2);
    zs_pose_turn(stage_put(f, &mesh_cube, &paint, 0, 0, 0, ZS_Q16_ONE * 5u / 4u),
                 (zs_turn)(5000u + once), (zs_turn)(4000u + twice), once);
    for (uint32_t i = 0; i < AROUND; i++) {
        const zs_turn place = (zs_turn)(i * 65536u / AROUND + once);
        const zs_turn phase = (zs_turn)(i * 65536u / AROUND + 3000u);
        zs_pose_turn(stage_put(f, &mesh_cube, &paint, stage_cos(RADIUS, place),
                               stage_sin(7000, (zs_turn)(3u * phase + place)),
                               stage_sin(RADIUS, place), ZS_Q16_ONE * (i & 1u ? 7u : 9u) / 16u),
                     (zs_turn)(phase + twice), (zs_turn)(2u * phase + once),
                     (zs_turn)(3u * phase + (i & 1u ? once : twice)));
    }
    stage_lens(f, 7300, w, h, 20000, 220000);
    zs_camera_orbit(&f->camera, stage_origin, 100000, 2000, 4400);
}

STAGE_DEMO(cubes, "Nine cubes tumble around each other, flat-shaded, a colour a side",
           FRAMES, ZS_VARYINGS_FLAT, zs_depth_float, pose, ZS_FAST_FRAME, ZS_FAST_FLAT);
