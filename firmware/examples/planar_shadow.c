/* A flat shadow: a turning cross, flattened onto the floor in every frame, and a soft disc under a card.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_shadow.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 16, 24, ZS_VARYINGS_DISC);

static const int16_t cross_pos[8][3] = { { -40, 5, 0 },  { -40, 17, 0 }, { 40, 17, 0 }, { 40, 5, 0 },
                                         { -6, -30, 0 }, { 6, -30, 0 },  { 6, 52, 0 },  { -6, 52, 0 } };
static const uint16_t cross_tri[4][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 6, 7 } };
static const int16_t floor_pos[4][3] = { { -200, 0, 200 }, { 200, 0, 200 }, { 200, 0, -200 }, { -200, 0, -200 } };
static const uint16_t square[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh cross = { .pos = cross_pos, .tri = cross_tri, .n_verts = 8, .n_tris = 4, .radius = 54 },
                            ground = { .pos = floor_pos, .tri = square, .n_verts = 4, .n_tris = 2, .radius = 283 };
static const struct zs_material red = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xff0000), .cull = ZS_CULL_NONE },
                                white = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff) },
                                dark = { .shader = &zs_shade_shadow, .rgb = ZS_RGB(0x404040), .cull = ZS_CULL_NONE },
                                soft = { .shader = &zs_shade_disc, .rgb = ZS_RGB(0x000000) };
static const struct zs_depth_state on_floor = { .read_only = 1, .bias = -8 };

int example_planar_shadow(uint32_t t, const struct zs_sink *sink)
{
    static int16_t flat_pos[8][3];
    struct zs_mesh flat;
    struct zs_instance things[4] = { { .mesh = &ground, .material = &white },
                                     { .mesh = &cross, .material = &red, .pose.pos = { -40, 34, 0 } },
                                     { .mesh = &zs_shadow_disc,
                                       .material = &soft,
                                       .depth_state = &on_floor,
                                       .pose = { .pos = { 90, 0, 0 }, .scale = 50 * 512 } },
                                     { .material = &dark } };
    const struct zs_shadow_plane plane = { .normal = { 0, ZS_Q30_ONE, 0 } };
    struct zs_shadow_light light = { .point = 0 };
    const struct zs_scene scene = { .instance = things, .n_instances = 4, .background = ZS_RGB565(0x0000ff) };
    struct zs_camera camera;
    const int32_t at[3] = { 0, 20, 0 }, from[3] = { -2, 3, -3 };
    screen_config.depth = &zs_depth_float;
    zs_pose_turn(&things[1].pose, (zs_turn)(t * 1000u), 0, 0);
    int err = zs_unit(light.dir, from);
    err = err ? err : zs_shadow_flatten(&things[3], &flat, flat_pos, &things[1], &plane, &light);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 50, 2000);
    err = err ? err : zs_camera_orbit(&camera, at, 300, 0, ZS_DEGREES(35));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
