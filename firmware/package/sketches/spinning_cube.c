/* A cube that turns.
 *
 * SPDX-License-Identifier: MIT
 */
#include "spinning_cube.h"

#include "zs_fast.h"

static const int16_t corner[8][3] = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 },
                                      { -1, -1, 1 },  { 1, -1, 1 },  { 1, 1, 1 },  { -1, 1, 1 } };
static const uint16_t face[12][3] = { { 4, 5, 6 }, { 4, 6, 7 }, { 1, 0, 3 }, { 1, 3, 2 }, { 5, 1, 2 }, { 5, 2, 6 },
                                      { 0, 4, 7 }, { 0, 7, 3 }, { 7, 6, 2 }, { 7, 2, 3 }, { 0, 1, 5 }, { 0, 5, 4 } };
static const struct zs_rgb color[12] = { ZS_RGB(0xe63c28), ZS_RGB(0xe63c28), ZS_RGB(0xe63c28), ZS_RGB(0xe63c28),
                                         ZS_RGB(0xf0be3c), ZS_RGB(0xf0be3c), ZS_RGB(0xf0be3c), ZS_RGB(0xf0be3c),
                                         ZS_RGB(0x466edc), ZS_RGB(0x466edc), ZS_RGB(0x466edc), ZS_RGB(0x466edc) };
static const struct zs_mesh cube = { .pos = corner, .tri = face, .face_rgb = color, .n_verts = 8, .n_tris = 12,
                                     .scale = 1000 * ZS_Q16_ONE, .radius = 2 };
static const struct zs_material painted = { .shader = &zs_shade_flat };
static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };

ZS_RENDERER(screen, 240, 240, CUBE_ROWS, 64, 64, ZS_VARYINGS_FLAT);
static struct zs_instance one = { .mesh = &cube, .material = &painted };
static const struct zs_scene scene = { .instance = &one, .n_instances = 1, .background = ZS_RGB565(0x0a143c) };
static struct zs_camera camera;

int cube_begin(uint16_t w, uint16_t h)
{
    static const int32_t middle[3] = { 0, 0, 0 };
    screen_config.width = w;
    screen_config.height = h;
    screen_config.strip_h = h < CUBE_ROWS ? h : CUBE_ROWS;
    screen_config.depth = &zs_depth_float;
    screen_config.fast = fast;
    int err = ZS_INIT(screen);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), w < h ? w : h, 1000, 20000);
    return err ? err : zs_camera_orbit(&camera, middle, 5000, 0, ZS_PITCH(25));
}

static void turn(uint32_t frame)
{
    zs_pose_turn(&one.pose, (zs_turn)(frame * 512u), (zs_turn)(frame * 200u), 0);
}

int cube_draw(uint32_t frame, const struct zs_sink *sink)
{
    turn(frame);
    return zs_render(&screen, &scene, &camera, sink);
}

int cube_open(uint32_t frame)
{
    turn(frame);
    return zs_frame_begin(&screen, &scene, &camera);
}

struct zs_renderer *cube_renderer(void)
{
    return &screen;
}
