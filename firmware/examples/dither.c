/* Dithering: light that grows from left to right, above as it is, for a panel of 256 colours, of 16 greys, of black
 * and white.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_dither.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 8, 8, ZS_VARYINGS_SMOOTH);

static const int16_t pos[4][3] = { { -24, -16, 0 }, { 24, -16, 0 }, { 24, 16, 0 }, { -24, 16, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const zs_q1_15 normal[4][3] = { { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 } };
static const struct zs_rgb rgb[4] = { { 0, 0, 0 }, { 255, 255, 255 }, { 255, 255, 255 }, { 0, 0, 0 } };
static const struct zs_mesh mesh = {
    .pos = pos, .tri = tri, .normal = normal, .vertex_rgb = rgb, .n_verts = 4, .n_tris = 2, .radius = 29
};
/* RGB565 itself, dithered where the shader still has all bits */
static const struct zs_material material = { .shader = &zs_shade_smooth_blue };

static const struct zs_dither below[3] = { { .format = &zs_dither_rgb332, .pattern = &zs_dither_blue },
                                           { .format = &zs_dither_grey4, .pattern = &zs_dither_ordered },
                                           { .format = &zs_dither_mono, .pattern = &zs_dither_blue } };

/* A program for one panel makes zs_dither_draw itself the hook, and one of the above its ctx. */
static void draw(void *ctx, const struct zs_target *target)
{
    (void)ctx;
    if (target->y0 >= 8) /* strips have eight rows */
        zs_dither_draw((void *)&below[target->y0 / 8 - 1], target);
}

int example_dither(uint32_t t, const struct zs_sink *sink)
{
    static const struct zs_resolve hook = { .draw = draw };
    const struct zs_instance instance = { .mesh = &mesh, .material = &material, .pose.pos = { 0, 0, -50 } };
    const struct zs_scene scene = {
        .instance = &instance, .n_instances = 1, .resolve = &hook, .n_resolves = 1, .light = { .ambient = ZS_Q16_ONE }
    };
    struct zs_camera camera;
    (void)t;
    screen_config.depth = &zs_depth_linear;
    int err = zs_camera_orthographic(&camera, EXAMPLE_H, 1, 100);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
