/* One triangle of one colour: all that a picture takes. A mesh, a material, an instance of them, a scene, a camera,
 * and a renderer with its memory.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"

/* Width, height, rows of a strip, triangles and vertices at a time, values a vertex: all the RAM */
ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 4, 4, ZS_VARYINGS_FLAT);

static const int16_t pos[3][3] = { { -10, -8, 0 }, { 10, -8, 0 }, { 0, 8, 0 } };
static const uint16_t tri[1][3] = { { 0, 1, 2 } }; /* counter-clockwise, as seen from its front */
static const struct zs_mesh triangle = { .pos = pos, .tri = tri, .n_verts = 3, .n_tris = 1, .radius = 13 };
static const struct zs_material orange = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xff8000) };

int example_first_triangle(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance one = { .mesh = &triangle, .material = &orange };
    const struct zs_scene scene = { .instance = &one, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    static const int32_t middle[3] = { 0, 0, 0 };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    zs_pose_turn(&one.pose, 0, 0, (zs_turn)(t * 1000u)); /* a turn is 65,536 */
    int err = zs_camera_perspective(&camera, ZS_DEGREES(40), EXAMPLE_H, 5, 200);
    err = err ? err : zs_camera_orbit(&camera, middle, 30, 0, 0);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
