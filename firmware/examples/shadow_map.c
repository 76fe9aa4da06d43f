/* A shadow map: boxes that throw shadows on the ground and on each other.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_shadow.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 60, 60, ZS_VARYINGS_SHADOWED_FLAT);
ZS_RENDERER(sun, 64, 64, 8, 60, 60, ZS_VARYINGS_FLAT);

static const int16_t box_pos[8][3] = { { -9, 0, 9 },  { 9, 0, 9 },  { 9, 60, 9 },  { -9, 60, 9 },
                                       { -9, 0, -9 }, { 9, 0, -9 }, { 9, 60, -9 }, { -9, 60, -9 } };
static const uint16_t box_tri[10][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 5, 4, 7 }, { 5, 7, 6 }, { 1, 5, 6 },
                                         { 1, 6, 2 }, { 4, 0, 3 }, { 4, 3, 7 }, { 3, 2, 6 }, { 3, 6, 7 } };
static const int16_t ground_pos[4][3] = { { -99, 0, 99 }, { 99, 0, 99 }, { 99, 0, -99 }, { -99, 0, -99 } };
static const struct zs_mesh box = { .pos = box_pos, .tri = box_tri, .n_verts = 8, .n_tris = 10, .radius = 62 },
                            ground = { .pos = ground_pos, .tri = box_tri, .n_verts = 4, .n_tris = 2, .radius = 141 };

int example_shadow_map(uint32_t t, const struct zs_sink *sink)
{
    static uint16_t keys[64 * 64];
    static struct zs_shadow_map map = { .key = keys, .w = 64, .h = 64 };
    static const struct zs_shadowed_material
        green = { .material = { .shader = &zs_shade_shadowed_flat, .rgb = ZS_RGB(0x40c040) }, .map = &map },
        white = { .material = { .shader = &zs_shade_shadowed_flat, .rgb = ZS_RGB(0xffffff) }, .map = &map };
    static const struct zs_depth_state bias = { .bias = 4, .slope_bias = 288 };
    const struct zs_instance things[3] = {
        { .mesh = &ground, .material = &green.material },
        { .mesh = &box, .material = &white.material, .pose.pos = { -40 + (int32_t)t, 0, 10 } },
        { .mesh = &box, .material = &white.material, .pose.pos = { 10, 0, 0 } }
    };
    struct zs_instance casters[3];
    const struct zs_scene seen_by_sun = { .instance = casters,
                                          .n_instances = zs_shadow_casters(casters, things, 3, &bias) };
    struct zs_scene scene = { .instance = things,
                              .n_instances = 3,
                              .background = ZS_RGB565(0x0000ff),
                              .light = { .ambient = ZS_Q16_ONE / 8, .diffuse = ZS_Q16_ONE / 8 * 7 } };
    struct zs_camera camera, from_sun;
    const int32_t eye[3] = { -300, 300, 150 }, at[3] = { 0, 20, 0 }, up[3] = { 0, 1, 0 };
    sun_config.depth = &zs_depth_linear;
    screen_config.depth = &zs_depth_float;
    int err = ZS_INIT(sun);
    err = err ? err : zs_camera_orthographic(&from_sun, 290, 200, 700);
    err = err ? err : zs_camera_look_at(&from_sun, eye, at, up);
    err = err ? err : zs_shadow_map_draw(&map, &sun, &seen_by_sun, &from_sun);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 50, 2000);
    err = err ? err : zs_camera_orbit(&camera, at, 230, ZS_DEGREES(10), ZS_DEGREES(35));
    err = err ? err : ZS_INIT(screen);
    if (err)
        return err;
    zs_shadow_map_light(&map, &scene.light);
    return zs_render(&screen, &scene, &camera, sink);
}
