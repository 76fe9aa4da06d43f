/* How far filters of textures are from a picture of 16 x 16 samples a pixel: RMS over the channels, of 255. The samples
 * are frames of 16 times the size, with the nearest texel.
 *
 *     make t T=aliasing && build/test/test_aliasing
 *
 * prints the table of zs_filter.h. With a folder in ZS_PICTURES, writes the frames there.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "picture.h"
#include "zs_filter.h"

#define W 160
#define H 120
#define MORE 16

/* ---- A chain of levels ------------------------------------------------------------------------ */

#define LOG2 7u
static uint16_t chain[2u << 2 * LOG2];

/* Coarser levels: each texel is the mean of four, as colours are, without gamma. */
static struct zs_texture chain_of(uint16_t (*color)(uint32_t x, uint32_t y))
{
    uint16_t *level = chain;
    for (uint32_t i = 0; i < 1u << 2 * LOG2; i++)
        level[i] = color(i & ((1u << LOG2) - 1u), i >> LOG2);
    for (uint32_t size = 1u << LOG2; size > 1; size /= 2) {
        uint16_t *const next = level + size * size;
        for (uint32_t i = 0; i < size * size / 4; i++) {
            const uint16_t *const at = level + i / (size / 2) * 2 * size + i % (size / 2) * 2;
            const uint16_t four[4] = { at[0], at[1], at[size], at[size + 1] };
            uint32_t r = 2, g = 2, b = 2;
            for (int k = 0; k < 4; k++) {
                r += four[k] >> 11;
                g += four[k] >> 5 & 63;
                b += four[k] & 31;
            }
            next[i] = (uint16_t)(r / 4 << 11 | g / 4 << 5 | b / 4);
        }
        level = next;
    }
    return (struct zs_texture){
        .format = &zs_texel_565, .texel = chain, .log2_w = LOG2, .log2_h = LOG2, .n_levels = LOG2 + 1
    };
}

static uint16_t checker(uint32_t x, uint32_t y)
{
    return (x >> 4 ^ y >> 4) & 1 ? ZS_RGB565(0xf0f0e8) : ZS_RGB565(0x203060);
}

static uint16_t bricks(uint32_t x, uint32_t y)
{
    const uint32_t row = y >> 4, column = (x + (row & 1) * 16) >> 5,
                   grain = (x * 7919u ^ y * 104729u) * 2654435761u >> 29;
    if (y % 16 < 2 || (x + (row & 1) * 16) % 32 < 2)
        return ZS_RGB565(0xc8c4b8);
    return zs_rgb565((uint8_t)(130 + column * 7 % 40 + grain * 6), (uint8_t)(50 + row * 11 % 20 + grain * 4),
                     (uint8_t)(40 + grain * 3));
}

/* ---- Scenes ----------------------------------------------------------------------------------- */

static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const int16_t floor_pos[4][3] = {
    { -8000, -20, 0 }, { 8000, -20, 0 }, { 8000, -20, -16000 }, { -8000, -20, -16000 }
};
static const int16_t floor_uv[4][2] = { { -16000, 0 }, { 16000, 0 }, { 16000, 32000 }, { -16000, 32000 } };
static const int16_t card_pos[4][3] = { { -40, -40, 0 }, { 40, -40, 0 }, { 40, 40, 0 }, { -40, 40, 0 } };
static const int16_t card_uv[4][2] = { { 0, 256 }, { 256, 256 }, { 256, 0 }, { 0, 0 } };

struct stage {
    const char *name;
    uint16_t (*color)(uint32_t x, uint32_t y);
    int floor;        /* else a card that turns */
    int32_t distance; /* of the card */
    int frames;
};
static const struct stage stages[] = {
    { "checker floor to the horizon", checker, 1, 0, 1 },    { "brick floor to the horizon", bricks, 1, 0, 1 },
    { "checker card that turns, far", checker, 0, 320, 12 }, { "brick card that turns, far", bricks, 0, 320, 12 },
    { "brick card that turns, near", bricks, 0, 60, 12 },
};
#define STAGES (sizeof stages / sizeof stages[0])

static struct picture draw(const struct stage *s, int frame, const struct zs_texture *t,
                           const struct zs_shader *shader, int more)
{
    const struct zs_mesh mesh = {
        .pos = s->floor ? floor_pos : card_pos, .tri = tri, .uv = s->floor ? floor_uv : card_uv,
        .uv_bits = (uint8_t)(s->floor ? 7 : 8), .n_verts = 4, .n_tris = 2, .radius = 65535
    };
    const struct zs_material material = { .shader = shader, .cull = ZS_CULL_NONE, .texture = t };
    struct zs_instance instance = { .mesh = &mesh, .material = &material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x80a0c0) };
    const struct zs_config config = picture_config(W * more, H * more, &zs_depth_float);
    struct zs_camera camera;
    if (zs_camera_perspective(&camera, ZS_DEGREES(60), (uint16_t)(H * more), 4, 30000))
        abort();
    if (!s->floor) {
        zs_pose_turn(&instance.pose, (zs_turn)(frame * 2000), (zs_turn)(frame * 700), (zs_turn)(frame * 5461));
        instance.pose.pos[2] = -s->distance;
    }
    struct picture p = picture_draw(&config, &scene, &camera);
    assert_int_equal(p.err, ZS_OK);
    return p;
}

static double channel(uint16_t c, int k)
{
    return k == 0 ? (c >> 11) * 255 / 31. : k == 1 ? (c >> 5 & 63) * 255 / 63. : (c & 31) * 255 / 31.;
}

/* The mean of MORE x MORE samples, where all of them are on the surface; else less than 0. */
static void reference(const struct picture *samples, double *out)
{
    for (int i = 0; i < W * H; i++) {
        double sum[3] = { 0 };
        int covered = 1;
        for (int j = 0; j < MORE * MORE; j++) {
            const int at = (i / W * MORE + j / MORE) * W * MORE + i % W * MORE + j % MORE;
            covered &= samples->key[at] != ZS_DEPTH_CLEAR;
            for (int k = 0; k < 3; k++)
                sum[k] += channel(samples->color[at], k) / (MORE * MORE);
        }
        for (int k = 0; k < 3; k++)
            out[3 * i + k] = covered ? sum[k] : -1;
    }
}

static void write_picture(const struct picture *p, const char *name, size_t stage)
{
    const char *folder = getenv("ZS_PICTURES");
    char path[400];
    if (!folder)
        return;
    snprintf(path, sizeof path, "%s/%u-%s.ppm", folder, (unsigned)stage, name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fprintf(f, "P6\n%d %d\n255\n", p->w, p->h);
    for (int i = 0; i < p->w * p->h; i++)
        for (int k = 0; k < 3; k++)
            fputc((int)(channel(p->color[i], k) + 0.5), f);
    fclose(f);
}

/* ---- The table -------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    const struct zs_shader *shader;
} filters[4] = { { "nearest", &zs_shade_texture },
                 { "bilinear", &zs_shade_bilinear },
                 { "mipmap", &zs_shade_mipmap },
                 { "mipmap-bilinear", &zs_shade_mipmap_bilinear } };

static double rms[STAGES][4];

static void measure(void **state)
{
    static double want[3 * W * H];
    printf("%-30s %9s %9s %9s %9s\n", "RMS, of 255", "nearest", "bilinear", "mipmap", "both");
    for (size_t s = 0; s < STAGES; s++) {
        const struct zs_texture t = chain_of(stages[s].color);
        double square[4] = { 0 };
        uint64_t n = 0;
        for (int frame = 0; frame < stages[s].frames; frame++) {
            struct picture samples = draw(&stages[s], frame, &t, &zs_shade_texture, MORE);
            reference(&samples, want);
            picture_free(&samples);
            for (int f = 0; f < 4; f++) {
                struct picture p = draw(&stages[s], frame, &t, filters[f].shader, 1);
                for (int i = 0; i < 3 * W * H; i++)
                    if (want[i] >= 0) {
                        const double off = channel(p.color[i / 3], i % 3) - want[i];
                        square[f] += off * off;
                        n += f == 0;
                    }
                write_picture(&p, filters[f].name, s);
                picture_free(&p);
            }
        }
        assert_true(n > 3000);
        printf("%-30s", stages[s].name);
        for (int f = 0; f < 4; f++) {
            rms[s][f] = sqrt(square[f] / (double)n);
            printf(" %9.1f", rms[s][f]);
        }
        printf("\n");
    }
}

/* Far away, mipmaps are closer than the nearest texel by a half at least; near, bilinear is closest. */
static void filters_pay(void **state)
{
    if (rms[0][0] <= 0) /* by itself, as `make mutate` runs it */
        measure(state);
    for (size_t s = 0; s < STAGES - 1; s++)
        assert_true(rms[s][3] < rms[s][1] && rms[s][2] < rms[s][0] && rms[s][3] < rms[s][0] * 0.75);
    assert_true(rms[STAGES - 1][0] > 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(measure), cmocka_unit_test(filters_pay) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
