/* What the shaders of zs_filter.h take: a frame of one card, in a plane of the screen or leaning back, at several sizes
 * of a texel. One line of CSV a shader and picture: instructions for each 100 pixels of it, without strip and set-up:
 * the frame with the card, less the frame with a card of zs_shade_raw. No accelerators; strips of 24 rows.
 *
 *     make -f firmware/boards/firmware.mk BOARD=mps2 NAME=filters APP_SRC=tests/lab/filters/filters.c \
 *         APP_FLAGS=-Ifirmware/app run
 *
 * SPDX-License-Identifier: MIT
 */
#include "../card.h"
#include "hal.h"
#include "report.h"
#include "zs_filter.h"
#include "zstrip.h"

#define W 320
#define H 240
#define LOG2 7u

ZS_RENDERER(screen, W, H, 24, 64, 64, 3);
static uint16_t chain[2u << 2 * LOG2], palette[512];
static struct zs_texture texture;

static const zs_q1_15 up[4][3] = { { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 } };
static int16_t pos[4][3] = { { -160, -120, -120 }, { 160, -120, -120 }, { 160, 120, -120 }, { -160, 120, -120 } };
static int16_t uv[4][2];

static int draw(const struct zs_shader *shader, uint64_t *instructions)
{
    const struct zs_mesh mesh = CARD(pos, up, uv, 8, 65535);
    const struct zs_material material = { .shader = shader, .cull = ZS_CULL_NONE, .texture = &texture };
    const struct zs_instance instance = { .mesh = &mesh, .material = &material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    const struct zs_sink drop = { .submit = report_drop };
    struct zs_camera camera;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(90), H, 8, 4000);
    screen_config.depth = &zs_depth_float;
    screen_config.subpixel_bits = 8;
    err = err ? err : ZS_INIT(screen);
    const uint64_t start = hal_ticks();
    err = err ? err : zs_render(&screen, &scene, &camera, &drop);
    *instructions = (hal_ticks() - start) * hal_tick_instructions();
    return err;
}

static const struct {
    const char *name;
    const struct zs_shader *shader;
} shaders[] = { { "texture", &zs_shade_texture },
                { "bilinear", &zs_shade_bilinear },
                { "bilinear_flat", &zs_shade_bilinear_flat },
                { "bilinear_smooth", &zs_shade_bilinear_smooth },
                { "mipmap", &zs_shade_mipmap },
                { "mipmap_bilinear", &zs_shade_mipmap_bilinear },
                { "cutout", &zs_shade_cutout } };

static const struct {
    const char *name;
    const struct zs_texel *format;
    uint16_t n_colors;
} formats[] = { { "565", &zs_texel_565, 0 },
                { "pal8", &zs_texel_pal8, 256 },
                { "4444", &zs_texel_4444, 0 },
                { "pal8a", &zs_texel_pal8a, 256 } };

/* uv for so many 1/16 texels a pixel, both ways. */
static int measure(const char *picture, int32_t texels)
{
    int err = 0;
    for (int k = 0; k < 4; k++) {
        uv[k][0] = (int16_t)((k == 1 || k == 2 ? W : 0) * texels * 16 >> LOG2);
        uv[k][1] = (int16_t)((k >= 2 ? H : 0) * texels * 16 >> LOG2);
    }
    for (uint32_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
        uint64_t plain, taken;
        texture = (struct zs_texture){
            .format = formats[f].format, .texel = chain, .palette = formats[f].n_colors ? palette : 0,
            .n_colors = formats[f].n_colors, .log2_w = LOG2, .log2_h = LOG2, .n_levels = LOG2 + 1u
        };
        err = err ? err : draw(&zs_shade_raw, &plain);
        for (uint32_t s = 0; !err && s < sizeof shaders / sizeof shaders[0]; s++) {
            err = draw(shaders[s].shader, &taken);
            hal_write(picture);
            report_field((uint64_t)texels);
            hal_write(",");
            hal_write(formats[f].name);
            hal_write(",");
            hal_write(shaders[s].name);
            report_field((taken - plain) * 100u / (W * H));
            hal_write("\n");
        }
    }
    return err;
}

int main(void)
{
    static const int32_t texels[] = { 0, 1, 2, 4, 8, 16, 32 };
    int err = 0;
    if (hal_init())
        hal_exit(1);
    for (uint32_t i = 0; i < sizeof chain / sizeof chain[0]; i++)
        chain[i] = (uint16_t)(i * 40503u);
    for (uint32_t i = 0; i < sizeof texels / sizeof texels[0]; i++)
        err = err ? err : measure("flat", texels[i]);
    for (int k = 2; k < 4; k++) { /* the upper corners lean back */
        pos[k][2] = -360;
        pos[k][0] = (int16_t)(pos[k][0] * 3);
        pos[k][1] = 360;
    }
    for (uint32_t i = 0; i < sizeof texels / sizeof texels[0]; i++)
        err = err ? err : measure("leaning", texels[i]);
    if (err)
        hal_write("# FAILED\n");
    hal_exit(err != 0);
}
