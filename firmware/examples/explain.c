/* Why is the picture black? A program in which four numbers are wrong, one after the other, and what zs_explain says of
 * each. Here a sink takes the pictures; on a board `say` would send its text to a UART.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_explain.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 32, 32, ZS_VARYINGS_FLAT);

static const int16_t pos[5][3] = { { -1, 0, 1 }, { 1, 0, 1 }, { 1, 0, -1 }, { -1, 0, -1 }, { 0, 2, 0 } };
static const uint16_t tri[6][3] = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 }, { 0, 3, 2 }, { 0, 2, 1 } };
static const struct zs_mesh pyramid = { .pos = pos, .tri = tri, .n_verts = 5, .n_tris = 6, .center = { 0, 1, 0 },
                                        .scale = 1000 * ZS_Q16_ONE, .radius = 2 };
static const struct zs_material sand = { .shader = &zs_shade_flat, .rgb = ZS_RGB(0xe0c070) };

/* What was said, one sentence a line. On a board: static void say(void *uart, const char *text) { puts(text); } */
char example_said[256];

static void say(void *ctx, const char *text)
{
    uint32_t *n = (uint32_t *)ctx;
    for (; *text && *n < sizeof example_said - 1u; text++)
        example_said[(*n)++] = *text;
    example_said[*n] = 0;
}

int example_explain(uint32_t t, const struct zs_sink *sink)
{
    static const int32_t middle[3] = { 0, 1000, 0 };
    struct zs_instance one = { .mesh = &pyramid, .material = &sand };
    struct zs_scene scene = { .instance = &one, .n_instances = 1, .background = ZS_RGB565(0x203050) };
    struct zs_camera camera;
    uint32_t n = 0;
    scene.light.dir[1] = ZS_Q30_ONE;
    scene.light.ambient = scene.light.diffuse = ZS_Q16_ONE / 2;
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 1000, 20000);
    err = err ? err : zs_camera_orbit(&camera, middle, 4500, ZS_DEGREES(30), ZS_DEGREES(20));
    if (t == 1)
        one.pose.pos[2] = -50000; /* metres were meant */
    else if (t == 2)
        one.pose.scale = 1; /* ZS_Q16_ONE is 1 */
    else if (t == 3) {
        scene.light.dir[1] = 1;  /* here ZS_Q30_ONE is 1 */
        scene.light.ambient = 1; /* and here ZS_Q16_ONE */
    } else if (t == 4)
        scene.instance = 0;
    err = err ? err : ZS_INIT(screen);
    err = err ? err : zs_render(&screen, &scene, &camera, sink);
    example_said[0] = 0;
    (void)zs_explain(&screen, &scene, &camera, say, &n); /* nothing, if nothing is wrong */
    return err;
}
