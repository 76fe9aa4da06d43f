/* One texture, three ways: the nearest texel, bilinear, mipmap. Three passes side by side; a floor of checks recedes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_filter.h"
#include "zs_pass.h"

/* ---- The texture: 4 x 4, then its levels of 2 x 2 and 1 x 1 (zsim convert --mipmap writes such) ------------------ */

#define X ZS_RGB565(0xf8f8f8)
#define O ZS_RGB565(0x102060)
#define M ZS_RGB565(0x848cac) /* their mean */
static const uint16_t texel[16 + 4 + 1] = { X, X, O, O, X, X, O, O, O, O, X, X, O, O, X, X, X, O, O, X, M };
static const struct zs_texture checks = {
    .format = &zs_texel_565, .texel = texel, .log2_w = 2, .log2_h = 2, .n_levels = 3
};

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 24, 32, ZS_VARYINGS_TEXTURE);

static const int16_t pos[4][3] = { { -64, 0, 0 }, { 64, 0, 0 }, { 64, 0, -256 }, { -64, 0, -256 } };
static const int16_t uv[4][2] = { { 0, 0 }, { 128, 0 }, { 128, 256 }, { 0, 256 } }; /* in 1/16: 8 and 16 repeats */
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh floor_mesh = {
    .pos = pos, .uv = uv, .uv_bits = 4, .tri = tri, .n_verts = 4, .n_tris = 2, .center = { 0, 0, -128 }, .radius = 144
};
static const struct zs_material material[3] = { { .shader = &zs_shade_texture, .texture = &checks },
                                                { .shader = &zs_shade_bilinear, .texture = &checks },
                                                { .shader = &zs_shade_mipmap_bilinear, .texture = &checks } };

int example_filters(uint32_t t, const struct zs_sink *sink)
{
    static struct zs_pass_memory memory[3];
    struct zs_instance instance[3];
    struct zs_scene scene[3];
    struct zs_pass pass[3];
    struct zs_camera camera = { 0 };
    int err = zs_camera_perspective(&camera, ZS_DEGREES(75), EXAMPLE_H, 2, 400);
    camera.pos[0] = (int32_t)(t % 16u);
    camera.pos[1] = 10;
    for (uint16_t k = 0; k < 3; k++) {
        instance[k] = (struct zs_instance){ .mesh = &floor_mesh, .material = &material[k] };
        scene[k] = (struct zs_scene){ .instance = &instance[k], .n_instances = 1, .background = ZS_RGB565(0x80b0f0) };
        pass[k] = (struct zs_pass){ .scene = &scene[k],
                                    .camera = &camera,
                                    .viewport = { (uint16_t)(k * 16u), 0, 16, EXAMPLE_H } };
    }
    screen_config.depth = &zs_depth_float;
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render_passes(&screen, pass, memory, 3, sink);
}
