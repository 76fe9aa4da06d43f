/* Toon shading: light at the vertices, and a ramp of a few steps at each pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_math.h"
#include "zs_shader.h"

static void toon_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const uint32_t light = zs_light_intensity(s, s->instance->mesh->normal[v]);
    out[0] = (uint16_t)(light > 65535u ? 65535u : light);
}

static void toon_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    static const uint8_t ramp[8] = { 90, 90, 90, 90, 170, 170, 235, 255 };
    const struct zs_rgb *c = &instance->material->rgb;
    const uint32_t light = ramp[f->v[0] >> 13];
    *f->color = light == 255u ? 0xffffu
                              : zs_wire565((uint8_t)(c->r * light / 255u), (uint8_t)(c->g * light / 255u),
                                           (uint8_t)(c->b * light / 255u));
}

static const struct zs_shader toon = {
    .vertex = toon_vertex, .fragment = toon_fragment, ZS_FRAGMENTS, .n_varyings = 1, .opaque = 1
};
static const struct zs_material orange = { .shader = &toon, .rgb = ZS_RGB(0xff8020) };

#define A 17225 /* corners of an icosahedron are its normals too: A * A + B * B is 32767^2 */
#define B 27873
static const int16_t shape[12][3] = { { -A, B, 0 }, { A, B, 0 }, { -A, -B, 0 }, { A, -B, 0 },
                                      { 0, -A, B }, { 0, A, B }, { 0, -A, -B }, { 0, A, -B },
                                      { B, 0, -A }, { B, 0, A }, { -B, 0, -A }, { -B, 0, A } };
static const uint16_t tri[20][3] = { { 0, 11, 5 }, { 0, 5, 1 },  { 0, 1, 7 },   { 0, 7, 10 }, { 0, 10, 11 },
                                     { 1, 5, 9 },  { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 },
                                     { 3, 9, 4 },  { 3, 4, 2 },  { 3, 2, 6 },   { 3, 6, 8 },  { 3, 8, 9 },
                                     { 4, 9, 5 },  { 2, 4, 11 }, { 6, 2, 10 },  { 8, 6, 7 },  { 9, 8, 1 } };
static const struct zs_mesh ball = {
    .pos = shape, .normal = shape, .tri = tri, .n_verts = 12, .n_tris = 20, .radius = 32768
};
ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 20, 12, 1);

int example_toon(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance instance = { .mesh = &ball, .material = &orange };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    zs_pose_turn(&instance.pose, (zs_turn)(t * 700u), 0, 0);
    int err = zs_camera_perspective(&camera, ZS_DEGREES(50), EXAMPLE_H, 10000, 200000);
    err = err ? err : zs_camera_orbit(&camera, instance.pose.pos, 88000, 0, ZS_DEGREES(15));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
