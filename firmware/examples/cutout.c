/* A tree of two crossed cards: texels without alpha let the other card, the floor and the sky be seen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_filter.h"

/* ---- The texture: 0 is nothing, 1 and 2 are leaves, 3 is the trunk ----------------------------------------------- */

#define ROW(a, b, c, d, e, f, g, h) 0x##b##a, 0x##d##c, 0x##f##e, 0x##h##g /* the left texel in the low four bits */
static const uint8_t texel[8 * 4] = {
    ROW(0, 0, 0, 1, 1, 0, 0, 0), ROW(0, 0, 1, 2, 0, 1, 0, 0), ROW(0, 1, 0, 1, 1, 2, 1, 0), ROW(1, 2, 1, 0, 2, 1, 0, 1),
    ROW(1, 1, 0, 1, 1, 0, 2, 1), ROW(0, 0, 2, 1, 0, 1, 1, 0), ROW(0, 0, 0, 3, 3, 0, 0, 0), ROW(0, 0, 0, 3, 3, 0, 0, 0),
};
static const uint16_t palette[2 * 4] = { 0, ZS_RGB565(0x30a020), ZS_RGB565(0x90d040), ZS_RGB565(0x704020),
                                         0, 255, 255, 255 }; /* colours, then alphas */
static const struct zs_texture leaves = { .format = &zs_texel_pal4a, .texel = texel, .palette = palette, .n_colors = 4,
                                          .log2_w = 3, .log2_h = 3, .clamp = ZS_CLAMP_U | ZS_CLAMP_V };

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 16, 16, ZS_VARYINGS_TEXTURE);

static const int16_t pos[8][3] = { { -8, 0, 0 }, { 8, 0, 0 },  { 8, 16, 0 },  { -8, 16, 0 },
                                   { 0, 0, 8 },  { 0, 0, -8 }, { 0, 16, -8 }, { 0, 16, 8 } };
static const int16_t uv[8][2] = { { 0, 256 }, { 256, 256 }, { 256, 0 }, { 0, 0 },
                                  { 0, 256 }, { 256, 256 }, { 256, 0 }, { 0, 0 } };
static const uint16_t tri[4][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 6, 7 } };
static const struct zs_mesh cards = {
    .pos = pos, .uv = uv, .uv_bits = 8, .tri = tri, .n_verts = 8, .n_tris = 4, .center = { 0, 8, 0 }, .radius = 12
};
static const struct zs_material tree = { .shader = &zs_shade_cutout, .texture = &leaves, .cull = ZS_CULL_NONE };

static const int16_t ground_pos[4][3] = { { -40, 0, 40 }, { 40, 0, 40 }, { 40, 0, -40 }, { -40, 0, -40 } };
static const struct zs_mesh ground_mesh = { .pos = ground_pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 57 };
static const struct zs_material ground = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc0a060) };

int example_cutout(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance instance[2] = { { .mesh = &cards, .material = &tree },
                                       { .mesh = &ground_mesh, .material = &ground } };
    const struct zs_scene scene = { .instance = instance, .n_instances = 2, .background = ZS_RGB565(0x60a0f0) };
    struct zs_camera camera;
    const int32_t at[3] = { 0, 7, 0 };
    screen_config.depth = &zs_depth_float;
    zs_pose_turn(&instance[0].pose, (zs_turn)(t * 500u + 6000u), 0, 0);
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 5, 200);
    err = err ? err : zs_camera_orbit(&camera, at, 26, 0, ZS_DEGREES(15));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
