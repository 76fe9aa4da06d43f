/* A procedural texture: veins of marble, computed from where a pixel is in the mesh.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "icosahedron.h"
#include "zs_math.h"
#include "zs_shader.h"

static void marble_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = (uint16_t)(s->instance->mesh->pos[v][k] + 32768);
}

/* Veins are where a sine is near 0; three finer ones, across each other, bend them. */
static void marble_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    uint32_t at = f->v[0] + f->v[1];
    for (uint32_t k = 0; k < 3; k++)
        at += (uint32_t)(zs_sin((zs_turn)((f->v[k] * (k + 2u)) + f->v[(k + 1) % 3])) >> (18 + k));
    const int32_t vein = zs_sin((zs_turn)at) >> 23, dark = 255 - (vein < 0 ? -vein : vein) * 2; /* |vein| <= 128 */
    const uint8_t grey = (uint8_t)(240 - (dark > 0 ? dark * dark / 400 : 0));
    (void)instance;
    *f->color = zs_wire565(grey, grey, (uint8_t)(grey + 10));
}

static const struct zs_shader marble = {
    .vertex = marble_vertex, .fragment = marble_fragment, ZS_FRAGMENTS, .n_varyings = 3, .opaque = 1
};
static const struct zs_material stone = { .shader = &marble };
ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 20, 12, 3);

int example_marble(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance instance = { .mesh = &icosahedron, .material = &stone };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    int err = icosahedron_turn(&instance.pose, &camera, t);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
