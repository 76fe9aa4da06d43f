/* A town from above under an orthographic camera, with cars in its streets.
 *
 * SPDX-License-Identifier: MIT
 */
#include "meshes.h"
#include "stage.h"
#include "town.h"

#define FRAMES 60u

STAGE_PAINT(walls, zs_shade_flat);
static const struct zs_material cars[3] = {
    { .shader = &zs_shade_flat, .rgb = { 235, 60, 60 }, .cull = ZS_CULL_BACK },
    { .shader = &zs_shade_flat, .rgb = { 250, 205, 60 }, .cull = ZS_CULL_BACK },
    { .shader = &zs_shade_flat, .rgb = { 240, 244, 250 }, .cull = ZS_CULL_BACK },
};

/* Once around the town in the animation, in the street between the blocks `street` - 1 and `street`
 * from its middle, which is a block. */
static void drive(struct demo_frame *f, uint32_t t, uint32_t start, int32_t street,
                  const struct zs_material *paint)
{
    const int32_t side = (2 * street - 1) * TOWN_PITCH;
    const uint32_t way = (uint32_t)stage_turn(t + start, FRAMES, 1) * 4u; /* 65536 to a side */
    const uint32_t corner = way >> 16;
    const int32_t along = (int32_t)((int64_t)side * (int32_t)(way & 65535u) / 65536) - side / 2;
    const int32_t off = side / 2 + 340; /* keeps to its lane */
    static const int8_t axes[4][4] = {  /* x: along, off; z: along, off */
        { 1, 0, 0, 1 }, { 0, 1, -1, 0 }, { -1, 0, 0, -1 }, { 0, -1, 1, 0 },
    };
    const int8_t *axis = axes[corner];
    zs_pose_turn(stage_put(f, &mesh_car, paint, axis[0] * along + axis[1] * off, 0,
                           axis[2] * along + axis[3] * off, ZS_Q16_ONE * 5u / 4u),
                 (zs_turn)(corner * 16384u + 49152u), 0, 0);
}

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb morning = { 206, 226, 240 };
    static const int32_t middle[3] = { 0, 1500, 0 };
    stage_open(f, morning);
    stage_light(f, -4, 8, 6, 48, 62);
    stage_put(f, &mesh_city, &walls, 0, 0, 0, ZS_Q16_ONE);
    for (uint32_t i = 0; i < 9; i++)
        drive(f, t, i * 13u, 1 + (int32_t)(i % 2u), &cars[i % 3u]);

    /* The square's diagonal must fit the picture's shorter side. */
    const int32_t span = 37500;
    zs_camera_orthographic(&f->camera, w < h ? (int32_t)((int64_t)span * h / w) : span, 10000,
                           110000);
    zs_camera_orbit(&f->camera, middle, 60000, (zs_turn)(8192u + stage_turn(t, FRAMES, 1)), 6200);
}

STAGE_DEMO(city, "A town turns under an orthographic camera while cars go round in its streets",
           FRAMES, ZS_VARYINGS_FLAT, zs_depth_linear, pose, ZS_FAST_FRAME, ZS_FAST_FLAT);
