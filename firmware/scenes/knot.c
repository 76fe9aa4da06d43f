/* A smooth torus knot with colours at its vertices; the camera goes around it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "meshes.h"
#include "stage.h"

#define FRAMES 60u

STAGE_PAINT(ribbon, zs_shade_smooth);

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb black = { 10, 12, 20 };
    stage_open(f, black);
    stage_light(f, -5, 7, 5, 36, 80);
    stage_put(f, &mesh_knot, &ribbon, 0, 0, 0, ZS_Q16_ONE);
    stage_lens(f, 8000, w, h, 10000, 120000);
    zs_camera_orbit(&f->camera, stage_origin, 40000, stage_turn(t, FRAMES, 1),
                    (int16_t)stage_sin(5200, stage_turn(t, FRAMES, 1)));
}

STAGE_DEMO(knot, "The camera goes around a torus knot in all colours, smooth-shaded",
           FRAMES, ZS_VARYINGS_SMOOTH, zs_depth_float, pose, ZS_FAST_FRAME, ZS_FAST_SMOOTH);
