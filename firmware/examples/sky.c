/* A sky around the eye, and trees in it: the sky turns with the camera, the trees turn to it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_environment.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 64, 64, ZS_VARYINGS_TEXTURE);

/* A tree is a flat thing that faces the camera. Its mesh is in 1/100 world unit. */
static const int16_t pos[5][3] = { { -40, 0, 0 }, { 40, 0, 0 }, { 0, 900, 0 }, { -250, 250, 0 }, { 250, 250, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 3, 4, 2 } };
static const uint16_t raw[2] = { ZS_RGB565(0x5a3c1e), ZS_RGB565(0x00ff00) };
static const struct zs_mesh tree = { .pos = pos,
                                     .tri = tri,
                                     .face_raw = raw,
                                     .n_verts = 5,
                                     .n_tris = 2,
                                     .scale = ZS_Q16_ONE / 100,
                                     .center = { 0, 450, 0 },
                                     .radius = 460 };
static const struct zs_material painted = { .shader = &zs_shade_raw };

/* Mountains, 64 by 16 texels, around the horizon. */
static uint16_t image[16][64];
static const struct zs_texture mountains = { .format = &zs_texel_565, .texel = image, .log2_w = 6, .log2_h = 4 };

int example_sky(uint32_t t, const struct zs_sink *sink)
{
    static const struct zs_rect whole = { 0, 0, EXAMPLE_W, EXAMPLE_H };
    static const int32_t place[3][3] = { { -9, -3, -30 }, { 3, -3, -40 }, { 12, -3, -26 } };
    static const int32_t up[3] = { 0, 1, 0 };
    static struct zs_sky sky;
    struct zs_instance instance[3] = { { 0 } };
    const struct zs_scene scene = { .instance = instance, .n_instances = 3, .sky = &sky.background };
    struct zs_camera camera;
    for (int x = 0; x < 64; x++) {
        const int height = 6 + (zs_sin((zs_turn)(x * 5120)) >> 29) + (zs_sin((zs_turn)(x * 9216)) >> 29);
        for (int y = 0; y < 16; y++)
            image[y][x] = y < 12 - height ? ZS_RGB565(0x0000ff) : y < 12 ? ZS_RGB565(0xff00ff) : ZS_RGB565(0xffff00);
    }
    const int32_t eye[3] = { 0, 0, 0 }, dir[3] = { zs_sin((zs_turn)(t * 500)), 0, -zs_cos((zs_turn)(t * 500)) };
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 1, 200);
    err = err ? err : zs_camera_look_along(&camera, eye, dir, up);
    err = err ? err : zs_sky_panorama(&sky, &mountains, ZS_PITCH(30), ZS_PITCH(-15));
    zs_sky_look(&sky, &camera, &whole, NULL);
    for (int k = 0; k < 3 && !err; k++) {
        instance[k] = (struct zs_instance){ .mesh = &tree, .material = &painted };
        for (int i = 0; i < 3; i++)
            instance[k].pose.pos[i] = place[k][i];
        err = zs_pose_face_upright(&instance[k].pose, &camera, up);
    }
    screen_config.depth = &zs_depth_float;
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
