/* Two pictures in one frame: the same house from the left and from the right, each in half of the screen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_pass.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 32, 32, ZS_VARYINGS_FLAT);

/* A ridge: the left side of its roof is red, the right one is white. */
static const int16_t pos[6][3] = {
    { -6, -6, 6 }, { 6, -6, 6 }, { 0, 6, 6 }, { -6, -6, -6 }, { 6, -6, -6 }, { 0, 6, -6 }
};
static const uint16_t tri[8][3] = { { 0, 1, 2 }, { 4, 3, 5 }, { 3, 0, 2 }, { 3, 2, 5 },
                                    { 1, 4, 5 }, { 1, 5, 2 }, { 0, 3, 4 }, { 0, 4, 1 } };
static const uint16_t raw[8] = { ZS_RGB565(0x5a3c1e), ZS_RGB565(0x5a3c1e), ZS_RGB565(0xff0000), ZS_RGB565(0xff0000),
                                 ZS_RGB565(0xffffff), ZS_RGB565(0xffffff), ZS_RGB565(0x5a3c1e), ZS_RGB565(0x5a3c1e) };
static const struct zs_mesh house = { .pos = pos, .tri = tri, .face_raw = raw, .n_verts = 6,
                                      .n_tris = 8, .radius = 11 };
static const struct zs_material painted = { .shader = &zs_shade_raw };

int example_split_screen(uint32_t t, const struct zs_sink *sink)
{
    static struct zs_pass_memory memory[2];
    static const int32_t middle[3] = { 0, 0, 0 };
    const struct zs_instance instance = { .mesh = &house, .material = &painted };
    const struct zs_scene day = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x0000ff) };
    const struct zs_scene night = { .instance = &instance, .n_instances = 1 };
    struct zs_camera left, right;
    const struct zs_pass pass[2] = {
        { .scene = &day, .camera = &left, .viewport = { 0, 0, EXAMPLE_W / 2, EXAMPLE_H } },
        { .scene = &night, .camera = &right, .viewport = { EXAMPLE_W / 2, 0, EXAMPLE_W / 2, EXAMPLE_H } }
    };
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&left, ZS_DEGREES(50), EXAMPLE_H, 5, 200);
    right = left;
    err = err ? err : zs_camera_orbit(&left, middle, 24, (zs_turn)(ZS_DEGREES(-60) + t), ZS_DEGREES(10));
    err = err ? err : zs_camera_orbit(&right, middle, 24, (zs_turn)(ZS_DEGREES(60) + t), ZS_DEGREES(10));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render_passes(&screen, pass, memory, 2, sink);
}
