/* sim/compare/scene_reference.c against the renderer: one scene in every texel format, clamping and shader.
 *
 * A prism of four walls round the eye, the texture 2 x 3 times on each, through zs_render and through the
 * reference. "ok" and "FAILED" lines.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "reference.h"
#include "texel_numbers.h"
#include "scene_reference.h"

#define W 160
#define H 120
#define LOG2_W 5
#define LOG2_H 4
#define TEXELS (1 << (LOG2_W + LOG2_H))

static const int16_t pos[8][3] = { { -100, -80, -100 }, { 100, -80, -100 }, { 100, -80, 100 }, { -100, -80, 100 },
                                   { -100, 80, -100 },  { 100, 80, -100 },  { 100, 80, 100 },  { -100, 80, 100 } };
static const uint16_t tri[8][3] = { { 0, 1, 5 }, { 0, 5, 4 }, { 1, 2, 6 }, { 1, 6, 5 },
                                    { 2, 3, 7 }, { 2, 7, 6 }, { 3, 0, 4 }, { 3, 4, 7 } };
static const int16_t normal[8][3] = { { 18918, 0, 26754 }, { -18918, 0, 26754 }, { -18918, 0, -26754 },
                                      { 18918, 0, -26754 }, { 32767, 0, 0 }, { 0, 0, 32767 },
                                      { -23170, 0, -23170 }, { 0, 32767, 0 } };
static const int16_t uv[8][2] = { { 0, 6000 }, { 4096, 6144 }, { 0, 6144 }, { 4096, 6144 },
                                  { 0, -7 },   { 4096, 0 },    { 0, 0 },    { 4000, 0 } }; /* 11 bits */
static uint16_t texel565[TEXELS], palette[16];
static uint8_t texel8[TEXELS], texel4[TEXELS / 2];

static void fill_texels(void)
{
    uint32_t seed = 1;
    for (int i = 0; i < 16; i++)
        palette[i] = (uint16_t)((seed = seed * 1664525u + 1013904223u) >> 16);
    for (int i = 0; i < TEXELS; i++) {
        seed = seed * 1664525u + 1013904223u;
        const uint8_t index = (uint8_t)(seed >> 28);
        texel8[i] = index;
        texel565[i] = palette[index];
        texel4[i / 2] = (uint8_t)(texel4[i / 2] | index << (i % 2 * 4));
    }
}

/* Draw and compare; what is wrong, or NULL. rgb565: ours, for the caller to free. */
static const char *compare(const struct zs_scene *scene, const struct zs_camera *camera,
                           const struct zs_depth *mapping, uint16_t **rgb565, struct ref_diff *d)
{
    static uint32_t ours_id[W * H], ours_texel[W * H], id[W * H], texel[W * H];
    static uint16_t true_565[W * H], true_key[W * H];
    static double u[W * H], v[W * H];
    static const struct ref_texture *texture[W * H];
    struct zs_config config;
    struct sim_frame frame;
    struct ref_camera ref_camera;
    struct ref_light light;
    size_t n;
    sim_frame_config(&config, W, H, ZS_VARYINGS_TEXTURE_SMOOTH);
    config.depth = mapping;
    if (sim_frame_render(&frame, scene, camera, &config, NULL) != ZS_OK ||
        sim_frame_ids(ours_id, scene, camera, &config) != ZS_OK ||
        sim_frame_texels(ours_texel, scene, camera, &config) != ZS_OK)
        return "the renderer refuses it";
    *rgb565 = frame.rgb565;
    const struct ref_depth depth = { sim_reference_mapping(mapping, camera), 16 };
    struct ref_triangle *all = sim_reference_triangles(scene, camera, &n);
    sim_reference_camera(&ref_camera, camera);
    sim_reference_light(&light, &scene->light, camera);
    struct ref_image truth = { .rgb565 = true_565, .key = true_key, .id = id, .u = u, .v = v,
                               .texel = texel, .texture = texture };
    const struct ref_image ours = { .rgb565 = frame.rgb565, .key = frame.key, .id = ours_id,
                                    .texel = ours_texel };
    const int bad = ref_render(all, n, &ref_camera, &light, &depth, scene->background, W, H, &truth, NULL, NULL) ||
                    ref_compare(&ours, &truth, &depth, &ref_camera, W, H, d);
    free(all);
    free(frame.key);
    if (bad)
        return "the reference refuses it";
    return d->texels < W * H / 2                ? "hardly a texel was compared"
           : d->texel_differ * 50 > d->texels    ? "more than 2 % of the texels differ"
           : d->texel_far * 1000 > d->texels     ? "texels are more than 1/8 off"
           : d->channel_max_diff > 1            ? "colours are more than one code off"
           : d->key_off * 100 > d->key_compared  ? "keys are more than 1 apart"
           : d->id_differ + d->missing + d->extra > 4 ? "other pixels are covered"
                                               : NULL;
}

int main(void)
{
    static const struct {
        const char *name;
        const struct zs_shader *shader;
        const struct zs_depth *depth;
    } kinds[] = { { "unlit", &zs_shade_texture, &zs_depth_e4m12 },
                  { "flat", &zs_shade_texture_flat, &zs_depth_e3m13 },
                  { "smooth", &zs_shade_texture_smooth, &zs_depth_e5m11 } };
    const struct zs_texture format[3] = {
        { .format = &zs_texel_565, .texel = texel565, .log2_w = LOG2_W, .log2_h = LOG2_H },
        { .format = &zs_texel_pal8, .texel = texel8, .palette = palette, .n_colors = 16, .log2_w = LOG2_W,
          .log2_h = LOG2_H },
        { .format = &zs_texel_pal4, .texel = texel4, .palette = palette, .n_colors = 16, .log2_w = LOG2_W,
          .log2_h = LOG2_H },
    };
    const struct zs_mesh mesh = { .pos = pos, .tri = tri, .normal = normal, .n_verts = 8, .n_tris = 8,
                                  .scale = 100 * ZS_Q16_ONE, .radius = 180, .uv = uv, .uv_bits = 11 };
    static const int32_t eye[3] = { 2000, 500, 3000 }, at[3] = { 0, 0, -4000 }, up[3] = { 0, 1, 0 };
    struct zs_camera camera;
    int n_bad = 0;
    fill_texels();
    if (zs_camera_perspective(&camera, 14000, H, 200, 60000) || zs_camera_look_at(&camera, eye, at, up))
        return 1;
    for (int kind = 0; kind < 3; kind++)
        for (unsigned clamp = 0; clamp < 4; clamp++) {
            uint16_t *picture[3] = { NULL, NULL, NULL };
            const char *wrong = NULL;
            for (int f = 0; f < 3; f++) {
                struct zs_texture texture = format[f];
                texture.clamp = (uint8_t)clamp;
                const struct zs_material material = { .shader = kinds[kind].shader, .rgb = { 9, 9, 9 },
                                                      .cull = ZS_CULL_NONE, .texture = &texture };
                struct zs_instance one = { .mesh = &mesh, .material = &material };
                zs_pose_identity(&one.pose);
                zs_pose_turn(&one.pose, 1234, 300, 0);
                const struct zs_scene scene = { .instance = &one, .n_instances = 1,
                                                .light = { .dir = { 0, ZS_Q30_ONE / 2, ZS_Q30_ONE / 2 },
                                                           .ambient = ZS_Q16_ONE / 3, .diffuse = ZS_Q16_ONE },
                                                .background = 0x1234 };
                struct ref_diff d = { 0 };
                const char *now = compare(&scene, &camera, kinds[kind].depth, &picture[f], &d);
                if (f == 0)
                    printf("measured: %s, clamp %u: %zu of %zu texels differ, at most %.3f off; %zu channels "
                           "one code off\n", kinds[kind].name, clamp, d.texel_differ, d.texels,
                           d.texel_max_distance, d.channel_off_one);
                wrong = wrong ? wrong : now;
                if (!wrong && memcmp(picture[f], picture[0], W * H * sizeof(uint16_t)) != 0)
                    wrong = "the formats give different pictures";
            }
            for (int f = 0; f < 3; f++)
                free(picture[f]);
            printf("%s truth_of_textures_%s_clamp_%u%s%s\n", wrong ? "FAILED" : "ok", kinds[kind].name, clamp,
                   wrong ? ": " : "", wrong ? wrong : "");
            n_bad += wrong != NULL;
        }
    return n_bad > 0;
}
