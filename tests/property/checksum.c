/* One checksum a scene, the same for every compiler, level and machine.
 *
 * Integers only, no tables of numbers: everything is procedural. Prints "name fnv1a" a line, FNV-1a
 * over the frame's wire bytes and its depth keys; tests/records/checksums.txt has the lines. Each is
 * drawn twice, by the core alone and with all accelerators: where the two differ, that is said and is
 * an error. With an argument, a folder, it also writes each frame there as a PPM, to be looked at
 * before a golden is changed.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>

#include "shapes.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_fast.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_lines.h"
#include "zs_method.h"
#include "zs_overlay.h"
#include "zs_shadow.h"

#define W 120
#define H 90
#define STRIP 11
#define TRIS 2500
#define VERTS 1500

#define VARYINGS ZS_VARYINGS_PHONG_NEAR

ZS_ARENA(arena, ZS_ARENA_BYTES(W, H, STRIP, TRIS, VERTS, VARYINGS, 2));

static struct shape shapes[2];
static int16_t uv[2][SHAPE_VERTS][2];
static uint16_t direct[32 * 64];
static uint8_t byte[64 * 16], nibble[32 * 32 / 2];
static uint16_t colors[256];

struct page {
    const char *name;
    struct zs_config config;
    union {
        struct zs_material material;
        struct zs_lit_material lit;
        struct zs_blend blend;
        struct zs_shadowed_material shadowed;
    } material[5];
    struct zs_instance instance[5];
    struct zs_scene scene;
    struct zs_camera camera;
};

static void add(struct page *p, const struct shape *s, const struct zs_shader *shader, int32_t x,
                int32_t y, int32_t z, uint8_t cull)
{
    const uint32_t n = p->scene.n_instances++;
    const struct zs_material material = { .shader = shader, .rgb = { 230, 140, 250 }, .cull = cull };
    p->material[n].material = material;
    p->instance[n].mesh = &s->mesh;
    p->instance[n].material = &p->material[n].material;
    zs_pose_identity(&p->instance[n].pose);
    zs_pose_turn(&p->instance[n].pose, (zs_turn)(n * 7001u), (zs_turn)(n * 3003u),
                 (zs_turn)(n * 911u));
    p->instance[n].pose.pos[0] = x;
    p->instance[n].pose.pos[1] = y;
    p->instance[n].pose.pos[2] = z;
    p->scene.instance = p->instance;
}

static void look_from(struct page *p, int32_t x, int32_t y, int32_t z)
{
    const int32_t eye[3] = { x, y, z }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    (void)zs_camera_look_at(&p->camera, eye, at, up);
}

static void begin(struct page *p, const char *name, const struct zs_depth *depth)
{
    const struct page none = { 0 };
    static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };
    const struct zs_config config = {
        .width = W, .height = H, .strip_h = STRIP, .max_tris = TRIS, .max_verts = VERTS, .varyings = VARYINGS,
        .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = depth, .fast = fast
    };
    const int32_t light[3] = { 3, 5, 4 };
    *p = none;
    p->name = name;
    p->config = config;
    (void)zs_unit(p->scene.light.dir, light);
    p->scene.light.ambient = ZS_Q16_ONE / 5;
    p->scene.light.diffuse = ZS_Q16_ONE * 4 / 5;
    p->scene.background = 0x10a4;
    (void)zs_camera_perspective(&p->camera, 9000, H, 60, 60000);
}

/* ---- Textures -------------------------------------------------------------------------------- */

static const struct zs_texture texture_565 = { .format = &zs_texel_565, .texel = direct, .log2_w = 6, .log2_h = 5 };
static const struct zs_texture texture_pal8 = { .format = &zs_texel_pal8, .texel = byte, .palette = colors,
                                                .n_colors = 256, .log2_w = 4, .log2_h = 6, .clamp = ZS_CLAMP_U };
static const struct zs_texture texture_pal4 = { .format = &zs_texel_pal4, .texel = nibble, .palette = colors,
                                                .n_colors = 16, .log2_w = 5, .log2_h = 5 };
static const struct zs_texture texture_line = { .format = &zs_texel_565, .texel = direct, .log2_w = 6, .log2_h = 0,
                                                .clamp = ZS_CLAMP_V };

static void make_textures(void)
{
    struct prng dice = { 77 };
    for (uint32_t i = 0; i < 32u * 64u; i++)
        direct[i] = (uint16_t)((i & 63u) * 1040u + (i >> 6) * 33u);
    for (uint32_t i = 0; i < sizeof byte; i++)
        byte[i] = (uint8_t)((i & 15u) * 9u + (i >> 4) * 3u);
    for (uint32_t i = 0; i < sizeof nibble; i++)
        nibble[i] = (uint8_t)prng_next(&dice);
    for (uint32_t i = 0; i < 256u; i++)
        colors[i] = (uint16_t)prng_next(&dice);
}

/* Cover the page's instance n, drawn from shapes[shape], and let it meet depth by a state or NULL.
 * Coordinates are the position's: ten repeats to 20480 steps. */
static void cover(struct page *p, uint32_t n, uint32_t shape, const struct zs_texture *texture,
                  const struct zs_depth_state *state)
{
    struct zs_mesh *mesh = &shapes[shape].mesh;
    for (uint32_t v = 0; v < mesh->n_verts; v++) {
        uv[shape][v][0] = (int16_t)(mesh->pos[v][0] + mesh->pos[v][1] / 2);
        uv[shape][v][1] = (int16_t)(mesh->pos[v][2] - mesh->pos[v][1] / 2);
    }
    mesh->uv = (const int16_t (*)[2])uv[shape];
    mesh->uv_bits = 11;
    p->material[n].material.texture = texture;
    p->instance[n].depth_state = state;
}

/* ---- Scenes ---------------------------------------------------------------------------------- */

static void page_flat(struct page *p)
{
    begin(p, "flat", &zs_depth_recip);
    shape_sphere(&shapes[0], 14, 20, 3000);
    shape_torus(&shapes[1], 24, 12, 4200, 1200);
    add(p, &shapes[0], &zs_shade_flat, 0, 0, 0, ZS_CULL_BACK);
    add(p, &shapes[1], &zs_shade_flat, 500, 0, 0, ZS_CULL_BACK);
    add(p, &shapes[0], &zs_shade_raw, 3500, 900, -2000, ZS_CULL_NONE);
    look_from(p, 2000, 5000, 12000);
}

static void page_smooth(struct page *p)
{
    page_flat(p);
    p->name = "smooth";
    p->config.buffers = 2;
    p->material[0].material.shader = p->material[1].material.shader = &zs_shade_smooth;
    look_from(p, -6000, 7000, 8000);
}

static void page_clipped(struct page *p, const char *name, const struct zs_depth *depth)
{
    begin(p, name, depth);
    shape_ground(&shapes[0], 16, 20000, 700, 7);
    shape_sphere(&shapes[1], 9, 12, 1800);
    add(p, &shapes[0], &zs_shade_smooth, 0, -900, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_smooth, 0, 200, 0, ZS_CULL_NONE);
    /* near opens it: see below */
    add(p, &shapes[1], &zs_shade_flat, 3505, 858, 5191, ZS_CULL_NONE);
    zs_pose_turn(&p->instance[0].pose, 0, 0, 0);
    look_from(p, 2000, 900, 6000);
    p->camera.z_near = (zs_q48_16)700 * 65536; /* the eye is inside the second sphere */
    p->camera.z_far = (zs_q48_16)19000 * 65536;
}

static void page_clipped_recip(struct page *p)
{
    page_clipped(p, "clipped", &zs_depth_recip);
}

static void page_small_pools(struct page *p)
{
    page_clipped(p, "clipped, small pools", &zs_depth_recip);
    p->config.max_tris = 5;
    p->config.max_verts = 7;
    p->config.strip_h = 3;
}

static void page_clipped_linear(struct page *p)
{
    page_clipped(p, "clipped, linear keys", &zs_depth_linear);
    p->config.depth_bits = 12;
}

static void page_coarse_linear(struct page *p)
{
    page_clipped(p, "4 sub-pixel bits, linear keys", &zs_depth_linear);
    p->config.subpixel_bits = 4;
}

static void page_ortho(struct page *p)
{
    begin(p, "orthographic", &zs_depth_linear);
    shape_soup(&shapes[0], 200, 5000, 3);
    shape_torus(&shapes[1], 20, 10, 4200, 1200);
    (void)zs_camera_orthographic(&p->camera, 11000, 6000, 14000);
    look_from(p, 4000, 5000, 8000);
    add(p, &shapes[1], &zs_shade_smooth, 0, 0, 0, ZS_CULL_NONE);
    add(p, &shapes[0], &zs_shade_flat, 0, 0, 0, ZS_CULL_NONE);
}

static void page_coarse(struct page *p)
{
    page_flat(p);
    p->name = "4 sub-pixel bits, 8 bits of depth";
    p->config.subpixel_bits = 4;
    p->config.depth_bits = 8;
    p->camera.z_near = (zs_q48_16)4000 * 65536;
    p->config.max_tris = 100;
    p->config.max_verts = 90;
}

/* Fine positions, scales that are no powers of two, a pose composed a hundred times, an orbiting
 * eye. */
static void page_composed(struct page *p)
{
    begin(p, "composed", &zs_depth_recip);
    shape_torus(&shapes[0], 26, 12, 90, 37);
    shapes[0].mesh.pos_lo = (const uint8_t (*)[3])shapes[0].pos_lo;
    shapes[0].mesh.scale = 1234567;
    add(p, &shapes[0], &zs_shade_smooth, 100, -50, 33, ZS_CULL_BACK);
    add(p, &shapes[0], &zs_shade_flat, -700, 250, -133, ZS_CULL_BACK);
    p->instance[1].pose.scale = 51234;
    const int32_t axis[3] = { 1, -2, 3 }, at[3] = { 0, 0, 0 };
    for (uint32_t n = 0; n < 100; n++)
        (void)zs_pose_rotate(&p->instance[0].pose, axis, (zs_turn)(n * 777u));
    (void)zs_camera_orbit(&p->camera, at, 5000, 40000, 5000);
}

static void dress(struct page *p, uint32_t n, const struct zs_shader *shader, uint32_t shape,
                  const struct zs_texture *texture)
{
    p->material[n].material.shader = shader;
    cover(p, n, shape, texture, 0);
}

static void page_textured(struct page *p)
{
    page_flat(p);
    p->name = "textured, e3m13 keys";
    p->config.depth = &zs_depth_e3m13;
    dress(p, 0, &zs_shade_texture, 0, &texture_565);
    dress(p, 1, &zs_shade_texture_flat, 1, &texture_pal8);
    dress(p, 2, &zs_shade_texture_smooth, 0, &texture_pal4);
}

/* Sub-spans of all lengths, planes through near, coordinates far beyond a clamped texture. */
static void page_textured_clipped(struct page *p)
{
    page_clipped(p, "textured, clipped, e4m12 keys", &zs_depth_e4m12);
    dress(p, 0, &zs_shade_texture_smooth, 0, &texture_pal8);
    dress(p, 1, &zs_shade_texture, 1, &texture_pal4);
    dress(p, 2, &zs_shade_texture_flat, 1, &texture_line);
}

static void page_textured_small_pools(struct page *p)
{
    page_textured_clipped(p);
    p->name = "textured, small pools";
    p->config.max_tris = 5;
    p->config.max_verts = 7;
    p->config.strip_h = 3;
}

static void page_textured_linear(struct page *p)
{
    page_textured_clipped(p);
    p->name = "textured, clipped, linear keys";
    p->config.depth = &zs_depth_linear;
}

static void page_textured_ortho(struct page *p)
{
    page_ortho(p);
    p->name = "textured, orthographic";
    p->material[0].material.shader = &zs_shade_texture_smooth;
    p->material[1].material.shader = &zs_shade_texture;
    cover(p, 0, 1, &texture_565, 0);
    cover(p, 1, 0, &texture_pal4, 0);
}

/* A ball and the ground, again where they are: equal, before what is there without a key of its own,
 * and moved by its slope. */
static void page_states(struct page *p)
{
    static const struct zs_depth_state later = { .func = ZS_DEPTH_LESS_EQUAL }, lent = { .read_only = 1, .bias = -400 };
    static const struct zs_depth_state leans = { .bias = 40, .slope_bias = -300 };
    page_clipped(p, "depth states, e5m11 keys", &zs_depth_e5m11);
    p->scene.n_instances = 1;
    add(p, &shapes[1], &zs_shade_flat, 0, 200, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_texture, 0, 200, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_raw, 600, -1200, 0, ZS_CULL_NONE);
    add(p, &shapes[0], &zs_shade_smooth, 0, -880, 0, ZS_CULL_NONE);
    p->instance[2].pose = p->instance[1].pose;
    p->instance[4].pose = p->instance[0].pose;
    cover(p, 2, 1, &texture_565, &later);
    p->instance[3].depth_state = &lent;
    p->instance[4].depth_state = &leans;
}

static void page_coarse_float(struct page *p)
{
    page_textured_clipped(p);
    p->name = "textured, 4 sub-pixel bits, 8 bits of e5m11";
    p->config.depth = &zs_depth_e5m11;
    p->config.subpixel_bits = 4;
    p->config.depth_bits = 8;
}

/* ---- Effects: integers that are packed into words must not depend on the order of bytes ------------------- */

static uint16_t rgba[32 * 32], alphas[512];
static uint16_t levels[32 * 32 * 3 / 2]; /* and mipmaps */
static const struct zs_texture texture_4444 = { .format = &zs_texel_4444, .texel = rgba, .log2_w = 5, .log2_h = 5 };
static const struct zs_texture texture_pal8a = {
    .format = &zs_texel_pal8a, .texel = byte, .palette = alphas, .n_colors = 256, .log2_w = 4, .log2_h = 6
};
static const struct zs_texture texture_levels = {
    .format = &zs_texel_565, .texel = levels, .log2_w = 5, .log2_h = 5, .n_levels = 6
};

static void make_effect_textures(void)
{
    struct prng dice = { 99 };
    for (uint32_t i = 0; i < 32u * 32u; i++)
        rgba[i] = (uint16_t)(prng_next(&dice) & 0xfff0u) | (uint16_t)((i * 5u >> 3) & 15u);
    for (uint32_t i = 0; i < sizeof levels / sizeof levels[0]; i++)
        levels[i] = (uint16_t)(i * 0x0841u);
    for (uint32_t i = 0; i < 512u; i++)
        alphas[i] = (uint16_t)(prng_next(&dice) & (i < 256u ? 0xffffu : 255u));
}

static struct zs_shine shine;
static const struct zs_lamp lamp[3] = {
    { .dir = { 0, ZS_Q30_ONE, 0 }, .rgb = { 255, 200, 150 } },
    { .kind = ZS_LAMP_POINT, .pos = { 3000, 2000, 5000 }, .range = 20000, .rgb = { 90, 120, 255 } },
    { .kind = ZS_LAMP_SPOT,
      .pos = { 0, 9000, 0 },
      .dir = { 0, -ZS_Q30_ONE, 0 },
      .half = 6000,
      .inner = ZS_Q30_ONE / 10 * 9,
      .outer = ZS_Q30_ONE / 2 }
};
static const struct zs_lighting lamps = { .lamp = lamp, .n_lamps = 3, .ambient = { 40, 40, 60 } };
static const struct zs_lighting sun = { .lamp = lamp, .n_lamps = 1, .ambient = { 40, 40, 60 } };

static void light(struct page *p, uint32_t n, const struct zs_shader *shader, const struct zs_lighting *by)
{
    p->material[n].material.shader = shader;
    p->material[n].lit.lighting = by;
    p->material[n].lit.shine = &shine;
    p->material[n].lit.specular = (struct zs_rgb){ 255, 255, 255 };
}

static void page_lamps(struct page *p)
{
    page_flat(p);
    p->name = "lamps";
    (void)zs_shine_set(&shine, 20);
    light(p, 0, &zs_shade_phong, &sun);
    light(p, 1, &zs_shade_lit, &lamps);
    light(p, 2, &zs_shade_phong_near, &lamps);
    p->material[2].lit.flags = ZS_LIT_NEAR_VIEWER | ZS_LIT_TWO_SIDED;
}

static void page_lamps_textured(struct page *p)
{
    page_textured(p);
    p->name = "lamps on textures, per face";
    light(p, 0, &zs_shade_texture_lit, &lamps);
    light(p, 1, &zs_shade_texture_tinted, &lamps);
    light(p, 2, &zs_shade_lit_face, &lamps);
}

static void page_blended(struct page *p, const char *name, const struct zs_shader *const shader[5], uint8_t alpha)
{
    page_textured(p);
    add(p, &shapes[1], &zs_shade_raw, -2500, 900, 2500, ZS_CULL_NONE);
    add(p, &shapes[0], &zs_shade_raw, 500, 2000, 3500, ZS_CULL_BACK);
    cover(p, 3, 1, &texture_4444, 0);
    cover(p, 4, 0, &texture_pal8a, 0);
    p->name = name;
    for (uint32_t n = 0; n < 5; n++) {
        p->material[n].material.shader = shader[n];
        p->material[n].blend.alpha = alpha;
        p->material[n].blend.phase = (uint8_t)(9 * n);
    }
}

static void page_blend(struct page *p)
{
    static const struct zs_shader *const shader[5] = { &zs_shade_texture_smooth, &zs_blend_smooth, &zs_blend_texture,
                                                       &zs_blend_texture_flat, &zs_blend_flat };
    page_blended(p, "blended, sorted layers", shader, 150);
    p->config.method = &zs_method_transparent;
}

static void page_add(struct page *p)
{
    static const struct zs_shader *const shader[5] = { &zs_shade_flat, &zs_add_smooth, &zs_add_flat, &zs_add_texture,
                                                       &zs_add_texture_smooth };
    page_blended(p, "additive", shader, 180);
}

static void page_stipple(struct page *p)
{
    static const struct zs_shader *const shader[5] = { &zs_stipple_smooth, &zs_stipple_flat, &zs_stipple_texture,
                                                       &zs_stipple_raw, &zs_stipple_texture_smooth };
    page_blended(p, "screen-door", shader, 100);
}

static void page_filters(struct page *p)
{
    page_textured_clipped(p);
    p->name = "bilinear, mipmaps, cut out";
    p->material[0].material.shader = &zs_shade_mipmap_bilinear_smooth;
    p->material[1].material.shader = &zs_shade_cutout;
    p->material[2].material.shader = &zs_shade_bilinear_flat;
    add(p, &shapes[1], &zs_shade_mipmap, 2500, 400, 0, ZS_CULL_NONE);
    cover(p, 0, 0, &texture_levels, 0);
    cover(p, 1, 1, &texture_4444, 0);
    cover(p, 2, 1, &texture_pal8a, 0);
    cover(p, 3, 1, &texture_levels, 0);
}

static void page_environment(struct page *p)
{
    static struct zs_sky_gradient sky;
    static const struct zs_rgb color[4] = { { 20, 60, 160 }, { 200, 220, 255 }, { 120, 110, 90 }, { 60, 40, 20 } };
    static const struct zs_rect all = { 0, 0, W, H };
    page_textured(p);
    p->name = "chrome under a sky";
    for (uint32_t n = 0; n < 3; n++)
        p->material[n].material.shader = &zs_shade_matcap;
    shapes[0].mesh.uv_bits = shapes[1].mesh.uv_bits = 15;
    zs_sky_gradient(&sky, color);
    zs_sky_look(&sky.sky, &p->camera, &all, NULL);
    p->scene.sky = &sky.sky.background;
}

static void page_shadows(struct page *p)
{
    static uint16_t keys[64 * 64];
    static struct zs_shadow_map map = { .key = keys, .w = 64, .h = 64, .soft = 1 };
    static const struct zs_depth_state bias = { .bias = 4, .slope_bias = 544 }, lift = { .read_only = 1, .bias = -9 };
    static struct zs_mesh flat;
    static int16_t pos[SHAPE_VERTS][3];
    static const struct zs_shadow_plane ground = { .normal = { 0, ZS_Q30_ONE, 0 }, .at = { 0, -2000, 0 } };
    static struct zs_renderer r;
    const struct zs_shadow_light down = { .dir = { 0, ZS_Q30_ONE, 0 } };
    const int32_t eye[3] = { 6000, 12000, 5000 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
    struct zs_instance casters[5];
    struct zs_camera sunlight = { .projection = ZS_ORTHOGRAPHIC };
    begin(p, "shadows: map, flat, disc", &zs_depth_recip);
    shape_ground(&shapes[0], 8, 9000, 0, 7);
    shape_sphere(&shapes[1], 12, 16, 1500);
    add(p, &shapes[0], &zs_shade_shadowed_flat, 0, -2000, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_shadowed_smooth, 0, 0, 0, ZS_CULL_BACK);
    add(p, &shapes[1], &zs_shade_flat, 3000, 900, 1500, ZS_CULL_BACK);
    zs_pose_identity(&p->instance[0].pose);
    p->instance[0].pose.pos[1] = -2000;
    p->material[0].shadowed.map = p->material[1].shadowed.map = &map;
    const struct zs_scene scene = { .instance = casters,
                                    .n_instances = zs_shadow_casters(casters, p->instance, 3, &bias) };
    struct zs_config c = p->config;
    c.width = c.height = c.strip_h = 64;
    c.depth = &zs_depth_linear;
    c.max_tris = c.max_verts = 400;
    (void)zs_camera_orthographic(&sunlight, 14000, 1000, 40000);
    (void)zs_camera_look_at(&sunlight, eye, at, up);
    (void)zs_init(&r, &c, arena, sizeof arena);
    (void)zs_shadow_map_draw(&map, &r, &scene, &sunlight);
    zs_shadow_map_light(&map, &p->scene.light);
    add(p, &shapes[1], &zs_shade_shadow, 0, 0, 0, ZS_CULL_NONE);
    p->material[3].material.rgb.g = 120;
    (void)zs_shadow_flatten(&p->instance[3], &flat, pos, &p->instance[2], &ground, &down);
    add(p, &shapes[1], &zs_shade_disc, -3000, -2000, 2000, ZS_CULL_NONE);
    zs_pose_identity(&p->instance[4].pose);
    p->instance[4].pose = (struct zs_pose){ .pos = { -3000, -2000, 2000 }, .scale = 1500u * 512u };
    p->instance[4].mesh = &zs_shadow_disc;
    p->instance[4].depth_state = &lift;
    p->material[4].material.rgb.g = 60;
    look_from(p, 5000, 6000, 11000);
}

static void page_over(struct page *p)
{
    static struct zs_fog fog;
    static const struct zs_item item[] = {
        { .kind = &zs_item_fill, .x = 3, .y = 3, .w = 60, .h = 14, .clear = 100 },
        { .kind = &zs_item_text,
          .x = 5,
          .y = 6,
          .color = 0xffff,
          .text = "21 \xc2\xb0"
                  "C" },
        { .kind = &zs_item_arc, .x = 95, .y = 60, .w = 20, .h = 5, .color = 0xf800, .back = 0x07e0, .value = 30000 },
        { .kind = &zs_item_needle, .x = 95, .y = 60, .w = 18, .h = 3, .size = 4, .color = 0xffe0, .value = 9000 }
    };
    static struct zs_overlay overlay = { .item = item, .n = 4 };
    static struct zs_dither dither;
    static const struct zs_resolve hook[3] = { { .draw = zs_fog_draw, .ctx = &fog },
                                               { .draw = zs_dither_draw, .ctx = &dither },
                                               { .draw = zs_overlay_draw, .ctx = &overlay } };
    page_smooth(p);
    p->name = "fog, dither to greys, overlay";
    p->material[1].material.shader = &zs_shade_smooth_ordered;
    fog = (struct zs_fog){ .color = 0x8410, .start = 8000, .end = 20000, .curve = ZS_FOG_EXPONENTIAL, .sky = 1 };
    (void)zs_fog_set(&fog, &p->config, &p->camera);
    dither = (struct zs_dither){ .format = &zs_dither_grey4, .pattern = &zs_dither_blue };
    p->scene.resolve = hook;
    p->scene.n_resolves = 3;
}

static void page_lines(struct page *p)
{
    static uint16_t pair[SHAPE_TRIS][2];
    static struct zs_lines wire;
    static struct zs_points dots;
    page_flat(p);
    p->name = "lines, points";
    for (uint32_t t = 0; t < shapes[1].mesh.n_tris; t++)
        for (uint32_t k = 0; k < 2; k++)
            pair[t][k] = shapes[1].tri[t][k];
    wire = (struct zs_lines){ ZS_LINES((const uint16_t(*)[2])pair, shapes[1].mesh.n_tris), .width = 2, .on = 5,
                              .off = 2 };
    dots = (struct zs_points){ ZS_POINTS(0, shapes[0].mesh.n_verts), .size = 3 };
    p->material[1].material.primitive = &wire.primitive;
    p->material[2].material.primitive = &dots.primitive;
    p->material[1].material.shader = p->material[2].material.shader = &zs_shade_plain;
}

/* Faces that cross, by each method: the picture of those that decide at every pixel is one. */
static void page_crossing(struct page *p, const char *name, const struct zs_method *method,
                          const struct zs_depth *depth)
{
    page_textured_clipped(p);
    p->name = name;
    p->config.method = method;
    p->config.depth = depth;
}

static void page_painter(struct page *p)
{
    page_crossing(p, "painter", &zs_method_painter, &zs_depth_none);
}

static void page_depthsort(struct page *p)
{
    page_crossing(p, "depth sort", &zs_method_depthsort, &zs_depth_order);
}

static void page_coverage(struct page *p)
{
    page_crossing(p, "coverage", &zs_method_coverage, &zs_depth_order);
}

static void page_hiz(struct page *p)
{
    page_crossing(p, "hierarchical depth buffer", &zs_method_hiz, &zs_depth_e4m12);
}

static void page_raycast(struct page *p)
{
    page_crossing(p, "ray casting", &zs_method_raycast, &zs_depth_e4m12);
}

typedef void page_fn(struct page *p);
static page_fn *const pages[] = { page_flat,
                                  page_smooth,
                                  page_clipped_recip,
                                  page_small_pools,
                                  page_clipped_linear,
                                  page_ortho,
                                  page_coarse,
                                  page_coarse_linear,
                                  page_composed,
                                  page_textured,
                                  page_textured_clipped,
                                  page_textured_small_pools,
                                  page_textured_linear,
                                  page_textured_ortho,
                                  page_states,
                                  page_coarse_float,
                                  page_lamps,
                                  page_lamps_textured,
                                  page_blend,
                                  page_add,
                                  page_stipple,
                                  page_filters,
                                  page_environment,
                                  page_shadows,
                                  page_over,
                                  page_lines,
                                  page_painter,
                                  page_depthsort,
                                  page_coverage,
                                  page_hiz,
                                  page_raycast };
#define N_PAGES (sizeof pages / sizeof pages[0])

/* ---- Drawing --------------------------------------------------------------------------------- */

struct sum {
    uint32_t hash;
    FILE *ppm;
};

static void hash_byte(struct sum *s, uint32_t value)
{
    s->hash = (s->hash ^ value) * 16777619u;
}

static void write_pixel(FILE *f, uint32_t c)
{
    fputc((int)((c >> 11) * 255u / 31u), f);
    fputc((int)((c >> 5 & 63u) * 255u / 63u), f);
    fputc((int)((c & 31u) * 255u / 31u), f);
}

/* All colours in the frame's order, then all keys: whatever the strips are. */
static int draw(struct page *p, struct sum *s)
{
    static struct zs_renderer r;
    static uint16_t keys[W * H];
    int err = zs_init(&r, &p->config, arena, sizeof arena);
    if (!err)
        err = zs_frame_begin(&r, &p->scene, &p->camera);
    struct zs_strip strip;
    while (!err && zs_frame_strip(&r, &strip) == 1) {
        for (uint32_t i = 0; i < (uint32_t)strip.w * strip.h; i++) {
            const uint8_t *px = &strip.px[2 * i];
            keys[(uint32_t)strip.y * W + i] = strip.depth ? strip.depth[i] : 0;
            hash_byte(s, px[0]);
            hash_byte(s, px[1]);
            if (s->ppm)
                write_pixel(s->ppm, (uint32_t)px[0] << 8 | px[1]);
        }
    }
    if (!err)
        err = zs_frame_end(&r);
    for (uint32_t i = 0; i < W * H && !err; i++) {
        hash_byte(s, keys[i] >> 8);
        hash_byte(s, keys[i] & 255u);
    }
    return err;
}

static FILE *open_ppm(const char *folder, unsigned n)
{
    char path[512];
    if (!folder)
        return NULL;
    snprintf(path, sizeof path, "%s/checksum-%u.ppm", folder, n);
    FILE *f = fopen(path, "wb");
    if (f)
        fprintf(f, "P6\n%d %d\n255\n", W, H);
    return f;
}

static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };

int main(int argc, char **argv)
{
    static struct page page;
    int bad = 0;
    make_textures();
    make_effect_textures();
    for (unsigned n = 0; n < N_PAGES; n++) {
        pages[n](&page);
        struct sum s = { 2166136261u, open_ppm(argc > 1 ? argv[1] : NULL, n) }, with = { 2166136261u, NULL };
        int err = draw(&page, &s);
        if (s.ppm)
            fclose(s.ppm);
        page.config.fast = fast;
        err = err ? err : draw(&page, &with);
        if (err) {
            printf("%s: %s\n", page.name, zs_error_string(err));
            bad = 1;
        } else if (with.hash != s.hash) {
            printf("%s: %08lx by the core, %08lx with accelerators\n", page.name, (unsigned long)s.hash,
                   (unsigned long)with.hash);
            bad = 1;
        } else {
            printf("%08lx  %s\n", (unsigned long)s.hash, page.name);
        }
    }
    return bad;
}
