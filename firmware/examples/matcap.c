/* Chrome: an environment map. The texture is what a mirror ball shows, looked up by the normal in the camera's axes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_environment.h"

enum { RINGS = 8, SIDES = 16 };

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 256, 160, ZS_VARYINGS_MATCAP);

/* A ball: a vertex is 500 times its normal. The image has 32 by 32 texels: a sky, and ground below. */
static int16_t pos[(RINGS + 1) * SIDES][3], normal[(RINGS + 1) * SIDES][3];
static uint16_t tri[RINGS * SIDES * 2][3], image[32][32];
static const struct zs_mesh ball = { .pos = pos,
                                     .tri = tri,
                                     .normal = normal,
                                     .n_verts = (RINGS + 1) * SIDES,
                                     .n_tris = RINGS * SIDES * 2,
                                     .radius = 502,
                                     .uv_bits = 15 };
static const struct zs_texture texture = { .format = &zs_texel_565, .texel = image, .log2_w = 5, .log2_h = 5 };
static const struct zs_material chrome = { .shader = &zs_shade_matcap, .texture = &texture };

int example_matcap(uint32_t t, const struct zs_sink *sink)
{
    const struct zs_instance instance = { .mesh = &ball, .material = &chrome };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    static const int32_t middle[3] = { 0, 0, 0 };
    struct zs_camera camera;
    for (uint32_t v = 0; v < (RINGS + 1) * SIDES; v++) {
        const zs_turn down = (zs_turn)(v / SIDES * 32768 / RINGS), around = (zs_turn)(v % SIDES * 65536 / SIDES);
        const int64_t flat = zs_sin(down);
        const int32_t n[3] = { (int32_t)(flat * zs_sin(around) >> 30), zs_cos(down),
                               (int32_t)(flat * zs_cos(around) >> 30) };
        for (int k = 0; k < 3; k++) {
            normal[v][k] = (int16_t)((int64_t)n[k] * 32767 >> 30);
            pos[v][k] = (int16_t)((int64_t)n[k] * 500 >> 30);
        }
    }
    for (uint16_t i = 0; i < RINGS * SIDES; i++) { /* two triangles for each field of the ball */
        const uint16_t right = (uint16_t)(i / SIDES * SIDES + (i + 1) % SIDES);
        const uint16_t corner[2][3] = { { i, (uint16_t)(i + SIDES), right },
                                        { right, (uint16_t)(i + SIDES), (uint16_t)(right + SIDES) } };
        for (int k = 0; k < 6; k++)
            tri[2 * i + k / 3][k % 3] = corner[k / 3][k % 3];
    }
    for (int i = 0; i < 32 * 32; i++) { /* a window at the upper left */
        const uint8_t x = (uint8_t)(i % 32), y = (uint8_t)(i / 32), level = (uint8_t)(y * 13);
        image[y][x] = y >= 16                                ? ZS_RGB565(0xa05000)
                      : y >= 6 && y < 12 && x >= 8 && x < 13 ? ZS_RGB565(0xffffff)
                                                             : zs_rgb565(level, level, 255);
    }
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 100, 4000);
    err = err ? err : zs_camera_orbit(&camera, middle, 1600, (zs_turn)(t * 500), ZS_DEGREES(20));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
