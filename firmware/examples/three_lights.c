/* Three coloured lights on a ball, with highlights, lit at each pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "icosahedron.h"
#include "zs_lights.h"

static const struct zs_lamp lamp[3] = {
    /* of length 1: 0.6 0.8 0 and the like */
    { .rgb = ZS_RGB(0xff2020), .dir = { -858993459, 644245094, 0 } },
    { .rgb = ZS_RGB(0x20ff20), .dir = { 858993459, 644245094, 0 } },
    { .rgb = ZS_RGB(0x4040ff), .dir = { 0, -644245094, 858993459 } },
};
static const struct zs_lighting lights = { .lamp = lamp, .n_lamps = 3, .ambient = ZS_RGB(0x202020) };
static struct zs_shine gloss;
static const struct zs_lit_material white = { .material = { .shader = &zs_shade_phong, .rgb = ZS_RGB(0xc0c0c0) },
                                              .lighting = &lights,
                                              .shine = &gloss,
                                              .specular = ZS_RGB(0xffffff) };

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 20, 12, 3);

int example_three_lights(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance instance = { .mesh = &icosahedron, .material = &white.material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    int err = icosahedron_turn(&instance.pose, &camera, t);
    err = err ? err : zs_shine_set(&gloss, 24);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
