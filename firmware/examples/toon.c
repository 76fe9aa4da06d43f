/* Toon shading: light at the vertices, and a ramp of a few steps at each pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "icosahedron.h"
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

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 20, 12, 1);

int example_toon(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance instance = { .mesh = &icosahedron, .material = &orange };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    int err = icosahedron_turn(&instance.pose, &camera, t);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
