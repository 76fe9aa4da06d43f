/* A sky that a function colours. It is asked for pixels where nothing was drawn: what the scene covers costs nothing.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"

ZS_ARENA(arena, ZS_ARENA_BYTES(EXAMPLE_W, EXAMPLE_H, 8, 8, 8, ZS_VARYINGS_FLAT, 1));
static struct zs_renderer renderer;

static const int16_t pos[3][3] = { { -12, -9, 0 }, { 12, -9, 0 }, { 0, 7, 0 } };
static const uint16_t tri[1][3] = { { 0, 1, 2 } };
static const struct zs_mesh hill = { .pos = pos, .tri = tri, .n_verts = 3, .n_tris = 1, .scale = ZS_Q16_ONE, .radius = 16 };
static const struct zs_material green = { .shader = &zs_shade_raw, .rgb = { 40, 160, 60 } };

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
    static const struct zs_config config = { .width = EXAMPLE_W, .height = EXAMPLE_H, .strip_h = 8, .max_tris = 8,
                                             .max_verts = 8, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                             .depth = &zs_depth_linear };
    static const struct zs_background background = { .fill = sky };
    struct zs_instance instance = { .mesh = &hill, .material = &green };
    struct zs_camera camera;
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .sky = &background };
    zs_pose_identity(&instance.pose);
    instance.pose.pos[0] = (int32_t)t;
    instance.pose.pos[2] = -20;
    int err = zs_camera_orthographic(&camera, 24, 1, 100);
    const int32_t eye[3] = { 0, 0, 0 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    err = err ? err : zs_camera_look_along(&camera, eye, along, up);
    err = err ? err : zs_init(&renderer, &config, arena, sizeof arena);
    return err ? err : zs_render(&renderer, &scene, &camera, sink);
}
