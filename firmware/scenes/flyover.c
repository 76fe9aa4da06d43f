/* A low flight along a river: the ground crosses the near plane, copies of one square of land lie
 * side by side, and after one period the flight begins again.
 *
 * SPDX-License-Identifier: MIT
 */
#include "land.h"
#include "meshes.h"
#include "stage.h"

#define FRAMES 60u
#define HEIGHT 1250 /* of the eye, steps; the river lies at 260 */

STAGE_PAINT(ground, zs_shade_flat);

/* The river's middle at z; the mesh's own z begins at -LAND_PERIOD / 2. */
static int32_t river(int32_t z)
{
    const int32_t turn = (z + LAND_PERIOD / 2) * 65536 / LAND_PERIOD; /* |z| + half < 32768 */
    return stage_sin(LAND_RIVER, (zs_turn)turn);
}

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb sky = { 150, 200, 240 };
    static const int32_t up[3] = { 0, 1, 0 };
    stage_open(f, sky);
    stage_light(f, -6, 5, 2, 42, 76);

    /* Towards -z, from the middle of the first square to that of the next: a period is seen. */
    const int32_t z = -(int32_t)(t % FRAMES * LAND_PERIOD / FRAMES);
    const int32_t ahead = z - LAND_PERIOD / 5;
    const int32_t eye[3] = { river(z), HEIGHT, z };
    const int32_t at[3] = { river(ahead), HEIGHT - 420, ahead };
    for (int32_t row = 0; row >= -2; row--)
        for (int32_t column = -1; column <= 1; column++)
            stage_put(f, &mesh_terrain, &ground, column * LAND_PERIOD, 0, row * LAND_PERIOD,
                      ZS_Q16_ONE);

    stage_lens(f, 11000, w, h, 300, LAND_PERIOD * 5 / 4);
    zs_camera_look_at(&f->camera, eye, at, up);
}

STAGE_DEMO(flyover, "A low flight along a river between hills, flat-shaded, cut at the near plane",
           FRAMES, ZS_VARYINGS_FLAT, zs_depth_float, pose, ZS_FAST_FRAME, ZS_FAST_CLUSTERS, ZS_FAST_FLAT);
