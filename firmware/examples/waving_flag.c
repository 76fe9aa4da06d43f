/* A position stage: a flag whose vertices move in the wind.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_shader.h"

#define N 16 /* columns: vertices 2 k and 2 k + 1 are the ends of column k */
static uint16_t tri[N * 2][3], phase; /* phase: of the wind; does not change while a frame is drawn */

static int32_t wave_at(uint32_t k) /* how far column k is from the flag's plane: nothing at the pole, column 0 */
{
    return (zs_sin((zs_turn)(k * 5500u - phase)) >> 24) * (int32_t)k / 4;
}

static void flag_position(const struct zs_shading *s, uint32_t v, int16_t out[3])
{
    (void)s;
    out[0] = (int16_t)(v / 2 * 50 - N * 25);
    out[1] = v & 1u ? -300 : 300;
    out[2] = (int16_t)wave_at(v / 2);
}

static void flag_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const int32_t light = 170 + wave_at(v / 2) - wave_at(v / 2 + 1u); /* by the slope */
    (void)s;
    out[0] = (uint16_t)(light < 90 ? 90 : light > 255 ? 255 : light);
    out[1] = v & 1u ? 65535 : 0;
}

static void flag_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    const uint8_t light = (uint8_t)f->v[0], other = f->v[1] / 21846u == 1u ? light : 0; /* stripes */
    (void)instance;
    *f->color = zs_wire565(light, other, other);
}

static const struct zs_shader shader = { .position = flag_position, ZS_POSITIONS, .vertex = flag_vertex,
                                         .fragment = flag_fragment, ZS_FRAGMENTS, .n_varyings = 2, .opaque = 1 };
static int16_t pos[N * 2 + 2][3]; /* the stage needs none of it */
static const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = N * 2 + 2, .n_tris = N * 2, .radius = 700 };
ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, N * 2, N * 2 + 2, 2);

int example_waving_flag(uint32_t t, const struct zs_sink *sink)
{
    const struct zs_material flag = { .shader = &shader, .cull = ZS_CULL_NONE };
    const struct zs_instance instance = { .mesh = &mesh, .material = &flag };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    phase = (uint16_t)(t * 3000u);
    for (uint32_t k = 0; k < N * 6; k++)
        tri[k / 3][k % 3] = (uint16_t)(k / 3 + k % 3);
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 100, 4000);
    err = err ? err : zs_camera_orbit(&camera, instance.pose.pos, 1100, ZS_DEGREES(25), ZS_DEGREES(15));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
