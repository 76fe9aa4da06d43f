/* Fog: a road of posts that fade into the sky's colour. It is mixed in by the keys of the depth buffer.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_fog.h"

#define POSTS 6

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 64, 64, ZS_VARYINGS_FLAT);

static const int16_t pos[4][3] = { { -2, 0, 0 }, { 2, 0, 0 }, { 2, 30, 0 }, { -2, 30, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh post = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 31 };
static const int16_t ground_pos[4][3] = { { -400, 0, 0 }, { 400, 0, 0 }, { 400, 0, -600 }, { -400, 0, -600 } };
static const struct zs_mesh ground = { .pos = ground_pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 730 };
static const struct zs_material black = { .shader = &zs_shade_raw },
                                green = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x106010) };

int example_fog(uint32_t t, const struct zs_sink *sink)
{
    static struct zs_fog fog = { .color = ZS_RGB565(0xc0c8d0), .start = 20, .end = 400 };
    static const struct zs_resolve hook = { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &fog };
    struct zs_instance instance[1 + 2 * POSTS] = { { .mesh = &ground, .material = &green } };
    for (int k = 0; k < 2 * POSTS; k++) {
        instance[1 + k].mesh = &post;
        instance[1 + k].material = &black;
        instance[1 + k].pose.pos[0] = k % 2 ? 20 : -20;
        instance[1 + k].pose.pos[2] = -(30 + k / 2 * 60);
    }
    const struct zs_scene scene = { .instance = instance,
                                    .n_instances = 1 + 2 * POSTS,
                                    .resolve = &hook,
                                    .n_resolves = 1,
                                    .background = ZS_RGB565(0xc0c8d0) };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(60), EXAMPLE_H, 5, 1000);
    camera.pos[1] = 14;
    camera.pos[2] = -(int32_t)(t % 60);
    err = err ? err : ZS_INIT(screen);
    /* the fog knows the keys of the camera's planes: again when these change, not when the camera moves */
    err = err ? err : zs_fog_set(&fog, &screen_config, &camera);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
