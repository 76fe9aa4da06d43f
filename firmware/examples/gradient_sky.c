/* A sky that a function colours. It is asked for pixels where nothing was drawn: what the scene covers costs nothing.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 8, 8, ZS_VARYINGS_FLAT);

static const int16_t pos[3][3] = { { -12, -9, 0 }, { 12, -9, 0 }, { 0, 7, 0 } };
static const uint16_t tri[1][3] = { { 0, 1, 2 } };
static const struct zs_mesh hill = { .pos = pos, .tri = tri, .n_verts = 3, .n_tris = 1, .radius = 16 };
static const struct zs_material green = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x28a03c) };

static void sky(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    const uint8_t level = (uint8_t)(y * 255 / EXAMPLE_H); /* blue above, white below */
    (void)ctx;
    (void)x;
    for (uint16_t k = 0; k < n; k++)
        out[k] = zs_wire565(level, level, 255);
}

int example_gradient_sky(uint32_t t, const struct zs_sink *sink)
{
    static const struct zs_background background = { .fill = sky };
    const struct zs_instance instance = { .mesh = &hill, .material = &green, .pose.pos = { (int32_t)t, 0, -20 } };
    struct zs_camera camera;
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .sky = &background };
    screen_config.depth = &zs_depth_linear;
    int err = zs_camera_orthographic(&camera, 24, 1, 100);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
