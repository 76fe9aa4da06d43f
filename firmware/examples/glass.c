/* Glass: panes of alpha before and behind each other and a solid box, listed in any order. zs_method_transparent draws
 * the box first, then the panes from far to near; the green one is a glow, added to what is there.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_blend.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 40, 40, ZS_VARYINGS_FLAT);

static const int16_t pos[4][3] = { { -9, -8, 0 }, { 9, -8, 0 }, { 9, 8, 0 }, { -9, 8, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh card = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 13 };

static const struct zs_material box = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x808080) };
static const struct zs_blend red = { .material = { .shader = &zs_blend_raw, .rgb = ZS_RGB(0xff0000) }, .alpha = 128 },
                             blue = { .material = { .shader = &zs_blend_raw, .rgb = ZS_RGB(0x0000ff) }, .alpha = 128 },
                             glow = { .material = { .shader = &zs_add_raw, .rgb = ZS_RGB(0x00a000) }, .alpha = 128 };

int example_glass(uint32_t t, const struct zs_sink *sink)
{
    const struct zs_instance things[4] = { /* in any order */
        { .mesh = &card, .material = &red.material, .pose.pos = { -8 + (int32_t)t, 3, -40 } },
        { .mesh = &card, .material = &glow.material, .pose.pos = { 11, -6, -40 } },
        { .mesh = &card, .material = &blue.material, .pose.pos = { 0, -3, -50 } },
        { .mesh = &card, .material = &box, .pose.pos = { 4, 0, -45 } } };
    const struct zs_scene scene = { .instance = things, .n_instances = 4 };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    screen_config.method = &zs_method_transparent;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(35), EXAMPLE_H, 5, 200);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
