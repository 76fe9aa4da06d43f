/* A mirror on a wall: what it shows is a pass of its own, seen only where the glass is.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_environment.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 64, 64, ZS_VARYINGS_FLAT);

/* A ridge whose front is green; its back, which only the mirror shows, is red. */
static const int16_t pos[6][3] = { { -6, -6, 6 },  { 6, -6, 6 },  { 0, 6, 6 },
                                   { -6, -6, -6 }, { 6, -6, -6 }, { 0, 6, -6 } };
static const uint16_t tri[8][3] = { { 0, 1, 2 }, { 4, 3, 5 }, { 3, 0, 2 }, { 3, 2, 5 },
                                    { 1, 4, 5 }, { 1, 5, 2 }, { 0, 3, 4 }, { 0, 4, 1 } };
static const uint16_t raw[8] = { ZS_RGB565(0x00ff00), ZS_RGB565(0xff0000), ZS_RGB565(0xffff00), ZS_RGB565(0xffff00),
                                 ZS_RGB565(0xffffff), ZS_RGB565(0xffffff), ZS_RGB565(0x5a3c1e), ZS_RGB565(0x5a3c1e) };
static const struct zs_mesh house = {
    .pos = pos, .tri = tri, .face_raw = raw, .n_verts = 6, .n_tris = 8, .radius = 11
};
static const int16_t corner[4][3] = { { -20, -12, 0 }, { 20, -12, 0 }, { 20, 12, 0 }, { -20, 12, 0 } };
static const uint16_t half[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh plate = { .pos = corner, .tri = half, .n_verts = 4, .n_tris = 2, .radius = 24 };

static const struct zs_material painted = { .shader = &zs_shade_raw };
static const struct zs_material glass = { .shader = &zs_shade_window };

int example_mirror(uint32_t t, const struct zs_sink *sink)
{
    static struct zs_pass_memory memory[2];
    static struct zs_mirror mirror;
    static const int32_t middle[3] = { -2, 0, -12 };
    struct zs_instance instance[2] = { { .mesh = &house, .material = &painted, .pose.pos = { 2, -5, 0 } },
                                       { .mesh = &plate, .material = &glass, .pose.pos = { 0, 0, -20 } } };
    const struct zs_scene room = { .instance = instance, .n_instances = 2 }; /* the glass comes last */
    const struct zs_scene seen = { .instance = instance, .n_instances = 1, .background = ZS_RGB565(0x0000ff) };
    struct zs_camera camera;
    const struct zs_pass pass[2] = {
        { .scene = &room, .camera = &camera },
        { .scene = &seen, .camera = &camera, .mirror = &mirror, .mask = &zs_mask_window }
    };
    zs_pose_turn(&instance[0].pose, (zs_turn)(t * 500), 0, 0);
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(40), EXAMPLE_H, 5, 200);
    err = err ? err : zs_camera_orbit(&camera, middle, 48, ZS_DEGREES(40), ZS_DEGREES(12));
    err = err ? err : zs_mirror_of(&mirror, &instance[1], 0);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render_passes(&screen, pass, memory, 2, sink);
}
