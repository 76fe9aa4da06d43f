/* A ball of coloured glass with a highlight, before a wall: any shader with its own material becomes a layer, here that
 * of three_lights.c. zs_method_transparent draws the wall first. The wall shows through, the highlight stays.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "icosahedron.h"
#include "zs_blend.h"
#include "zs_lights.h"

static const struct zs_lamp lamp = { .rgb = ZS_RGB(0xffffff), .dir = { 0, 644245094, 858993459 } }; /* 0 0.6 0.8 */
static const struct zs_lighting lights = { .lamp = &lamp, .n_lamps = 1, .ambient = ZS_RGB(0x404040) };
static struct zs_shine gloss;
static struct zs_layered glass; /* the shader, and how much it hides: alpha */
static const struct zs_lit_material green = { .material = { .shader = &glass.shader, .rgb = ZS_RGB(0x20c040) },
                                              .lighting = &lights,
                                              .shine = &gloss,
                                              .specular = ZS_RGB(0xffffff) };

/* The wall: its left half is white, its right half is red. */
static const int16_t pos[6][3] = { { -99, -70, 0 }, { 0, -70, 0 }, { 99, -70, 0 },
                                   { -99, 70, 0 },  { 0, 70, 0 },  { 99, 70, 0 } };
static const uint16_t tri[4][3] = { { 0, 1, 4 }, { 0, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 } };
static const uint16_t raw[4] = { 0xffff, 0xffff, ZS_RGB565(0xff0000), ZS_RGB565(0xff0000) };
static const struct zs_mesh halves = { .pos = pos, .tri = tri, .face_raw = raw, .n_verts = 6, .n_tris = 4,
                                       .scale = 1000 * ZS_Q16_ONE, .radius = 122 };
static const struct zs_material wall = { .shader = &zs_shade_raw };

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 24, 20, 3);

int example_layered(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance things[2] = { { .mesh = &icosahedron, .material = &green.material },
                                     { .mesh = &halves, .material = &wall, .pose.pos = { 0, 0, -50000 } } };
    const struct zs_scene scene = { .instance = things, .n_instances = 2 };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    screen_config.method = &zs_method_transparent;
    int err = icosahedron_turn(&things[0].pose, &camera, t);
    err = err ? err : zs_shine_set(&gloss, 24);
    err = err ? err : zs_layered_set(&glass, &zs_shade_phong, &zs_layer_mix, 128);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
