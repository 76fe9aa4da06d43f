/* A walk through a hall of textures in all formats, under all textured shadings: floor and walls
 * pass through the near plane, and the pictures lie in the walls' very planes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hall.h"
#include "meshes.h"
#include "stage.h"

#define FRAMES 60u
#define EYE 1550 /* its height, steps */
#define START 52u /* of its period: the first picture shows a poster whole */

STAGE_COVER(tiles, zs_shade_texture_flat, texture_tiles);
STAGE_COVER(planks, zs_shade_texture_flat, texture_planks);
STAGE_COVER(bricks, zs_shade_texture_flat, texture_bricks);
STAGE_COVER(marble, zs_shade_texture_smooth, texture_marble);
STAGE_COVER(poster, zs_shade_texture, texture_poster);
STAGE_COVER(sign, zs_shade_texture, texture_sign);
STAGE_COVER(crate, zs_shade_texture_flat, texture_crate);

/* Before the wall that it lies in, by two buckets and a quarter of what a pixel changes them; the
 * wall keeps its own keys. */
static const struct zs_depth_state on_the_wall = { .read_only = 1, .bias = -2, .slope_bias = -64 };

static void put_hall(struct demo_frame *f)
{
    stage_put(f, &mesh_hall_floor, &tiles, 0, 0, 0, ZS_Q16_ONE);
    stage_put(f, &mesh_hall_ceiling, &planks, 0, 0, 0, ZS_Q16_ONE);
    stage_put(f, &mesh_hall_walls, &bricks, 0, 0, 0, ZS_Q16_ONE);
    stage_put(f, &mesh_poster, &poster, 0, 0, 0, ZS_Q16_ONE);
    f->instance[f->scene.n_instances - 1u].depth_state = &on_the_wall;
    stage_put(f, &mesh_sign, &sign, 0, 0, 0, ZS_Q16_ONE);
    f->instance[f->scene.n_instances - 1u].depth_state = &on_the_wall;
    stage_put(f, &mesh_hall_columns, &marble, 0, 0, 0, ZS_Q16_ONE);
}

/* In every period, as it comes into view: one stands and turns, a smaller one tumbles. */
static void put_crates(struct demo_frame *f, uint32_t t)
{
    for (int32_t k = 0; k < 5; k++) {
        const int32_t z = -k * HALL_PERIOD;
        zs_pose_turn(stage_put(f, &mesh_crate, &crate, -760, HALL_CRATE, z - 3100, ZS_Q16_ONE),
                     (zs_turn)(6000u + stage_turn(t, FRAMES, 1)), 0, 0);
        zs_pose_turn(stage_put(f, &mesh_crate, &crate, 800,
                               1150 + stage_sin(120, stage_turn(t, FRAMES, 1)), z - 3700,
                               ZS_Q16_ONE * 5u / 8u),
                     (zs_turn)(0u - stage_turn(t, FRAMES, 1)), stage_turn(t, FRAMES, 1),
                     stage_turn(t, FRAMES, 1));
    }
}

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb far_end = { 24, 22, 30 };
    static const int32_t up[3] = { 0, 1, 0 };
    t = (t + START) % FRAMES;
    stage_open(f, far_end);
    stage_light(f, 2, 5, 3, 46, 64);
    put_hall(f);
    put_crates(f, t);

    const zs_turn turn = stage_turn(t, FRAMES, 1);
    const int32_t z = -(int32_t)(t * HALL_PERIOD / FRAMES);
    const int32_t eye[3] = { 250 + stage_sin(160, turn), EYE, z };
    const int32_t at[3] = { stage_sin(900, turn), EYE - 200, z - 3000 };
    stage_lens(f, 13000, w, h, 160, HALL_PERIOD * 23 / 5); /* beyond it, crates are missing */
    zs_camera_look_at(&f->camera, eye, at, up);
}

STAGE_DEMO(hall, "A walk through a hall of tiles, bricks, wood and marble, with pictures on its walls",
           FRAMES, ZS_VARYINGS_TEXTURE_SMOOTH, zs_depth_float, pose, ZS_FAST_FRAME, ZS_FAST_TEXTURE,
           ZS_FAST_TEXTURE_FLAT, ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_565, ZS_FAST_PAL8, ZS_FAST_PAL4);
