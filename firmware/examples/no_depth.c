/* No depth memory: cards that are drawn from far to near cover each other. The strip's depth buffer, a third of the
 * arena here, is not there.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"

ZS_RENDERER_NO_DEPTH(screen, EXAMPLE_W, EXAMPLE_H, 8, 16, 16, ZS_VARYINGS_FLAT);

static const int16_t pos[4][3] = { { -4, -6, 0 }, { 4, -6, 0 }, { 4, 6, 0 }, { -4, 6, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh card = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 8 };
static const struct zs_material red = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xff0000) },
                                green = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x00ff00) },
                                blue = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x0000ff) };

int example_no_depth(uint32_t t, const struct zs_sink *sink)
{
    const struct zs_instance cards[3] = { /* the farthest first */
        { .mesh = &card, .material = &red, .pose.pos = { -5 + (int32_t)t, 1, -30 } },
        { .mesh = &card, .material = &green, .pose.pos = { 0, 0, -28 } },
        { .mesh = &card, .material = &blue, .pose.pos = { 5, -1, -26 } } };
    const struct zs_scene scene = { .instance = cards, .n_instances = 3 };
    struct zs_camera camera;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(35), EXAMPLE_H, 5, 200);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
