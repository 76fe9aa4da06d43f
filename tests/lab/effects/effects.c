/* What a pixel takes by each shader: two frames of a card that faces the camera, W and W / 2 px wide; the difference
 * of their instructions over that of their pixels. So what a frame, a strip and a triangle take is left out, and what
 * begins a run is not. What it takes by each hook: a frame with it less one without. No accelerators, depth buffer,
 * perspective, strips of 24 rows. Then what a vertex takes by some of them. A line of CSV each: name, instructions for
 * 100 pixels (vertices), the checksum of the picture.
 * tests/lab/effects.sh runs it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "../card.h"
#include "backdrop.h"
#include "hal.h"
#include "report.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_fast.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_overlay.h"
#include "zs_pass.h"
#include "zs_shadow.h"
#include "zs_supersample.h"

#define W 160
#define H 120
#define LOG2 5u
#define MAP 32

#ifndef CYCLES_A_TICK
#define CYCLES_A_TICK 0 /* where ticks do not count instructions: 125 on the Pico, whose cycles are printed then */
#endif

ZS_RENDERER(screen, W, H, 24, 600, 400, ZS_VARYINGS_MAX);
ZS_RENDERER_2X2(fine, W / 2, H / 2, 12, 16, 16, ZS_VARYINGS_MAX);
ZS_RENDERER(sun, MAP, MAP, MAP, 16, 16, 0);

/* ---- A card ------------------------------------------------------------------------------------------------------ */

static uint16_t texels[2u << 2 * LOG2], palette[512], keys[MAP * MAP], cone_keys[MAP * MAP];
static struct zs_texture texture;
static const zs_q1_15 normal[4][3] = {
    { -9000, 0, 31500 }, { 9000, 0, 31500 }, { 9000, 0, 31500 }, { -9000, 0, 31500 }
};
static int16_t pos[4][3], uv[4][2];
static const struct zs_mesh card = CARD(pos, normal, uv, 15, 4000);

static const struct zs_mesh *shape = &card; /* what is drawn */
static const struct zs_background *backdrop;
static struct zs_pass_memory memory[2];
static int behind; /* flag: a pass without instances is seen in windows */
static const struct zs_material *before; /* of a card in front of the one that is drawn; NULL: there is none */
static struct zs_mirror mirror;
static int mirrored; /* 1: what is drawn is seen in a mirror, by a second pass; 2: in that pass, without */

/* A card of w px at the left; a texel is `size` 1/16 px. The camera sees a world unit as a px at distance 120. */
static void cut(int32_t w, int32_t size)
{
    for (int k = 0; k < 4; k++) {
        const int32_t x = k == 1 || k == 2 ? w : 0, y = k < 2 ? H : 0;
        pos[k][0] = (int16_t)(x - W / 2);
        pos[k][1] = (int16_t)(H / 2 - y);
        pos[k][2] = -H / 2;
        uv[k][0] = (int16_t)((x * 16 << 15 >> LOG2) / size);
        uv[k][1] = (int16_t)((y * 16 << 15 >> LOG2) / size);
    }
}

/* Instructions of a frame. samples: 1; 3: four, not averaged; 4: averaged. sum, if not NULL, becomes the checksum of
 * what is sent, which takes instructions, too. */
static uint64_t taken(const struct zs_material *material, const struct zs_resolve *hook, int samples, uint64_t *sum,
                      int *err)
{
    const struct zs_instance instance[2] = {
        { .mesh = &card, .material = before, .pose.pos = { 0, 0, 1 } },
        { .mesh = shape, .material = material, .pose.pos = { 0, 0, mirrored == 2 ? -H : 0 } }
    };
    const struct zs_scene scene = {
        .instance = before ? instance : &instance[1], .n_instances = before ? 2 : 1, .resolve = hook,
        .n_resolves = hook != 0, .sky = backdrop
    };
    const struct zs_sink sink = { .submit = sum ? report_hash : report_drop, .ctx = sum };
    struct zs_renderer *r = samples > 1 ? &fine : &screen;
    struct zs_camera camera;
    screen_config.depth = fine_config.depth = &zs_depth_float;
    if (sum)
        *sum = REPORT_HASH;
    *err = *err ? *err : zs_camera_perspective(&camera, ZS_DEGREES(90), H, 8, 4000);
    *err = *err ? *err : samples > 1 ? ZS_INIT(fine) : ZS_INIT(screen);
    if (samples > 1)
        *err = *err ? *err : zs_supersample_init(&fine_2x2, &fine, &sink);
    const uint64_t start = hal_ticks();
    const struct zs_scene empty = { .n_instances = 0 };
    const struct zs_pass pass[2] = { { .scene = &scene, .camera = &camera },
                                     { .scene = &empty, .camera = &camera, .mask = &zs_mask_window } },
                         again[2] = { { .scene = &empty, .camera = &camera },
                                      { .scene = &scene, .camera = &camera,
                                        .mirror = mirrored == 1 ? &mirror : 0 } };
    *err = *err       ? *err
           : behind   ? zs_render_passes(r, pass, memory, 2, &sink)
           : mirrored ? zs_render_passes(r, again, memory, 2, &sink)
                      : zs_render(r, &scene, &camera, samples == 4 ? &fine_2x2.sink : &sink);
    const uint32_t a_tick = hal_tick_instructions();
    return (hal_ticks() - start) * (a_tick ? a_tick : CYCLES_A_TICK);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static const struct zs_lamp lamp[1] = { { .dir = { 0, 0, ZS_Q30_ONE } } };
static const struct zs_lamp point[1] = { { .kind = ZS_LAMP_POINT, .pos = { 0, 0, 40 } } };
static const struct zs_lamp beside[1] = { { .dir = { 0, 1069655912, 93578768 } } }; /* no highlight reaches the eye */
static const struct zs_lighting beside_light = { .lamp = beside, .n_lamps = 1 };
static const struct zs_lamp away[2] = { { .dir = { 0, 0, -ZS_Q30_ONE } }, { .dir = { 0, 0, -ZS_Q30_ONE } } };
static const struct zs_lighting dark_light = { .lamp = away, .n_lamps = 1 },
                                dark_lights = { .lamp = away, .n_lamps = 2 };
static const struct zs_lighting far_light = { .lamp = lamp, .n_lamps = 1 },
                                near_light = { .lamp = point, .n_lamps = 1 };
static struct zs_shine shine;
static struct zs_shadow_map map = { .key = keys, .w = MAP, .h = MAP };
static const struct zs_lamp above[1] = { { .kind = ZS_LAMP_POINT, .pos = { 0, 0, 340 } } };
static const struct zs_lighting above_light = { .lamp = above, .n_lamps = 1 };
static struct zs_shadow_map cone = { .key = cone_keys, .w = MAP, .h = MAP };
static struct zs_fog fog = { .color = 0x8410, .start = 20, .end = 200 };
static const struct zs_dither grey = { .format = &zs_dither_grey4, .pattern = &zs_dither_ordered },
                              mono = { .format = &zs_dither_mono, .pattern = &zs_dither_blue },
                              rgb332 = { .format = &zs_dither_rgb332, .pattern = &zs_dither_blue };

static void print(const char *name, uint64_t more, uint32_t pixels, uint64_t sum, int err)
{
    hal_write(err ? "# FAILED: " : "");
    hal_write(name);
    report_field(more * 100u / pixels);
    report_field(sum);
    hal_write("\n");
}

/* A shader, by two widths of the card. */
static void row(const char *name, const struct zs_material *material)
{
    int err = 0;
    uint64_t sum;
    cut(W, name[0] == '1' ? 16 : 128);
    const uint64_t whole = taken(material, 0, 1, 0, &err);
    (void)taken(material, 0, 1, &sum, &err);
    cut(W / 2, name[0] == '1' ? 16 : 128);
    print(name, whole - taken(material, 0, 1, 0, &err), W / 2 * H, sum, err);
}

/* ---- Vertices ------------------------------------------------------------------------------------------------ */

#define SIDE 16 /* squares of a sheet, each way */

static int16_t sheet_pos[(SIDE + 1) * (SIDE + 1)][3], sheet_uv[(SIDE + 1) * (SIDE + 1)][2];
static zs_q1_15 sheet_normal[(SIDE + 1) * (SIDE + 1)][3];
static uint16_t sheet_tri[2 * SIDE * SIDE][3];
static struct zs_mesh sheet = {
    .pos = sheet_pos, .tri = sheet_tri, .normal = sheet_normal, .uv = sheet_uv, .uv_bits = 15, .radius = 4000
};

/* What the card covers, as a sheet of so many squares each way. */
static void sheet_set(uint16_t side)
{
    const uint16_t across = (uint16_t)(side + 1u);
    for (uint16_t v = 0; v < across * across; v++) {
        sheet_pos[v][0] = (int16_t)(W * (v % across) / side - W / 2);
        sheet_pos[v][1] = (int16_t)(H * (v / across) / side - H / 2);
        sheet_pos[v][2] = -H / 2;
        for (int k = 0; k < 2; k++)
            sheet_uv[v][k] = (int16_t)(sheet_pos[v][k] * 100);
        for (int k = 0; k < 3; k++)
            sheet_normal[v][k] = normal[v & 1u][k];
    }
    for (uint16_t t = 0; t < 2 * side * side; t++) {
        const uint16_t at = (uint16_t)(t / 2 / side * across + t / 2 % side);
        sheet_tri[t][0] = at;
        sheet_tri[t][1] = (uint16_t)(t & 1u ? at + across + 1 : at + 1);
        sheet_tri[t][2] = (uint16_t)(t & 1u ? at + across : at + across + 1);
    }
    sheet.n_verts = (uint32_t)across * across;
    sheet.n_tris = 2u * side * side;
}

/* A vertex, with its share of two triangles, by a sheet of 16 x 16 squares and one of 8 x 8, less what it takes by
 * zs_shade_raw. */
static void vertex_row(const char *name, const struct zs_material *material)
{
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc08040) };
    uint64_t frame[2][2], sum;
    int err = 0;
    shape = &sheet;
    for (uint16_t fine_one = 0; fine_one < 2; fine_one++) {
        sheet_set((uint16_t)(fine_one ? SIDE : SIDE / 2));
        frame[0][fine_one] = taken(&raw, 0, 1, 0, &err);
        frame[1][fine_one] = taken(material, 0, 1, 0, &err);
    }
    (void)taken(material, 0, 1, &sum, &err);
    print(name, frame[1][1] - frame[1][0] - (frame[0][1] - frame[0][0]),
          (SIDE + 1) * (SIDE + 1) - (SIDE / 2 + 1) * (SIDE / 2 + 1), sum, err);
    shape = &card;
}

/* A triangle with its vertices in a mirror, beside one in a pass without, where accelerators walk the scene. */
static void mirror_row(const char *name)
{
    static const struct zs_fast *const frame_alone[] = { ZS_FAST_FRAME, ZS_FAST_END };
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc08040), .cull = ZS_CULL_NONE };
    static const int32_t at[3] = { 0, 0, -H }, facing[3] = { 0, 0, 1 };
    uint64_t frame[2][2], sum;
    int err = zs_mirror_plane(&mirror, at, facing);
    shape = &sheet;
    screen_config.fast = frame_alone;
    for (uint16_t fine_one = 0; fine_one < 2; fine_one++) {
        sheet_set((uint16_t)(fine_one ? SIDE : SIDE / 2));
        for (mirrored = 1; mirrored < 3; mirrored++)
            frame[mirrored - 1][fine_one] = taken(&raw, 0, 1, 0, &err);
    }
    mirrored = 1;
    (void)taken(&raw, 0, 1, &sum, &err);
    mirrored = 0;
    screen_config.fast = 0;
    shape = &card;
    print(name, frame[0][1] - frame[0][0] - (frame[1][1] - frame[1][0]), 2 * (SIDE * SIDE - SIDE * SIDE / 4), sum, err);
}

/* A hook, over every pixel of a frame that the card covers, by leaving it out. */
static void hook_row(const char *name, const struct zs_resolve *hook)
{
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc08040) };
    int err = 0;
    uint64_t sum;
    cut(W, 16);
    const uint64_t with = taken(&raw, hook, 1, 0, &err);
    (void)taken(&raw, hook, 1, &sum, &err);
    print(name, with - taken(&raw, 0, 1, 0, &err), W * H, sum, err);
}

/* What lies behind everything, and a pass that is seen in windows, by the pixel of the frame. */
static void behind_row(const char *name, const struct zs_background *sky)
{
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc08040) };
    int err = 0;
    uint64_t sum;
    cut(W, 16);
    const uint64_t without = taken(&raw, 0, 1, 0, &err);
    backdrop = sky;
    behind = !sky;
    const uint64_t with = taken(&raw, 0, 1, 0, &err);
    (void)taken(&raw, 0, 1, &sum, &err);
    backdrop = 0;
    behind = 0;
    print(name, with - without, W * H, sum, err);
}

/* An item of an overlay, by the pixel of the rectangle that holds it. */
static void item_row(const char *name, const struct zs_item *item)
{
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc08040) };
    struct zs_overlay none = { .n = 0 }, overlay = { .item = item, .n = 1 };
    const struct zs_resolve hook[2] = { { .draw = zs_overlay_draw, .ctx = &none },
                                        { .draw = zs_overlay_draw, .ctx = &overlay } };
    int err = zs_overlay_check(&overlay);
    int32_t box[4];
    uint64_t sum;
    item->kind->bounds(item, box);
    cut(W, 16);
    const uint64_t with = taken(&raw, &hook[1], 1, 0, &err);
    (void)taken(&raw, &hook[1], 1, &sum, &err);
    print(name, with - taken(&raw, &hook[0], 1, 0, &err), (uint32_t)((box[2] - box[0]) * (box[3] - box[1])), sum, err);
}

#define PLAIN(name_, shader_)                                                                                         \
    {                                                                                                                 \
        const struct zs_material m = { .shader = &shader_, .rgb = ZS_RGB(0xc08040), .texture = &texture };            \
        row(name_, &m);                                                                                               \
    }
#define BLEND(name_, shader_)                                                                                         \
    {                                                                                                                 \
        const struct zs_blend m = { .material = { .shader = &shader_, .rgb = ZS_RGB(0xc08040), .texture = &texture }, \
                                    .alpha = 100 };                                                                   \
        row(name_, &m.material);                                                                                      \
    }
#define LIT(name_, shader_, lighting_, shine_, specular_)                                                             \
    {                                                                                                                 \
        const struct zs_lit_material m = {                                                                            \
            .material = { .shader = &shader_, .rgb = ZS_RGB(0xc08040), .texture = &texture },                         \
            .lighting = &lighting_,                                                                                   \
            .shine = shine_,                                                                                          \
            .specular = specular_                                                                                     \
        };                                                                                                            \
        row(name_, &m.material);                                                                                      \
    }
#define HOOK(name_, draw_, ctx_)                                                                                      \
    {                                                                                                                 \
        const struct zs_resolve hook = { .draw = draw_, .ctx = (void *)(uintptr_t)ctx_ };                             \
        hook_row(name_, &hook);                                                                                       \
    }
#define MAPPED(name_, shader_)                                                                                        \
    {                                                                                                                 \
        const struct zs_shadowed_material m = { .material = { .shader = &shader_, .rgb = ZS_RGB(0xc08040) },          \
                                                .map = &map };                                                        \
        row(name_, &m.material);                                                                                      \
    }

#define LAMP_MAPPED(name_, shader_, lighting_, map_)                                                                  \
    {                                                                                                                 \
        const struct zs_shadowed_lit m = {                                                                            \
            .lit = { .material = { .shader = &shader_, .rgb = ZS_RGB(0xc08040), .texture = &texture },                \
                     .lighting = &lighting_ },                                                                        \
            .map = &map_                                                                                              \
        };                                                                                                            \
        row(name_, &m.lit.material);                                                                                  \
    }

#define PHONG_MAPPED(name_, shader_, lighting_, map_)                                                                 \
    {                                                                                                                 \
        const struct zs_shadowed_phong m = {                                                                          \
            .lit = { .material = { .shader = &shader_, .rgb = ZS_RGB(0xc08040), .texture = &texture },                \
                     .lighting = &lighting_, .shine = &shine, .specular = ZS_RGB(0xffffff) },                         \
            .map = { &map_ }                                                                                          \
        };                                                                                                            \
        row(name_, &m.lit.material);                                                                                  \
    }

/* Layers and a screen-door of lit, with a layer and a sum of errors of the function's own. */
#define LIT_LAYERS(before)                                                                                            \
    err |= zs_layered_set(&layer, &zs_shade_lit, &zs_layer_mix, 100);                                                 \
    LIT(before "a layer of lit", layer.shader, far_light, 0, none)                                                    \
    zs_layered_fog(&layer, &fog);                                                                                     \
    LIT(before "a layer of lit, in fog", layer.shader, far_light, 0, none)                                            \
    err |= zs_layered_set(&layer, &zs_shade_lit, &zs_layer_door, 100);                                                \
    LIT(before "screen-door of lit", layer.shader, far_light, 0, none)

/* Shaders that are made of others. */
static void made(void)
{
    static struct zs_layered layer;
    static struct zs_filtered soft;
    static const struct zs_rgb none = ZS_RGB(0), white = ZS_RGB(0xffffff);
    int err = 0;
    LIT_LAYERS("")
    err |= zs_filtered_set(&soft, &zs_shade_texture_gloss, &zs_filter_linear);
    LIT("texture_gloss, bilinear", soft.shader, far_light, &shine, white)
    PHONG_MAPPED("shadowed_phong", zs_shade_shadowed_phong, far_light, map)
    PHONG_MAPPED("shadowed_phong, point", zs_shade_shadowed_phong, above_light, cone)
    PHONG_MAPPED("shadowed_phong, dark", zs_shade_shadowed_phong, dark_light, map)
    PHONG_MAPPED("shadowed_texture_phong", zs_shade_shadowed_texture_phong, far_light, map)
    if (err)
        hal_write("# FAILED: layers and filters\n");
}

static void colors(void)
{
    const struct zs_rgb none = ZS_RGB(0), white = ZS_RGB(0xffffff);
    PLAIN("raw", zs_shade_raw)
    PLAIN("smooth", zs_shade_smooth)
    BLEND("blend", zs_blend_raw)
    BLEND("add", zs_add_raw)
    BLEND("screen-door", zs_stipple_raw)
    BLEND("blend_smooth", zs_blend_smooth)
    LIT("lit", zs_shade_lit, far_light, 0, none)
    LIT("phong, matt", zs_shade_phong, far_light, 0, none)
    LIT("phong, shining", zs_shade_phong, far_light, &shine, white)
    LIT("phong_near, point", zs_shade_phong_near, near_light, &shine, white)
    LIT("phong, no highlight", zs_shade_phong, beside_light, &shine, white)
    LIT("phong by two, dark", zs_shade_phong, dark_lights, &shine, white)
    LIT("phong_near, dark", zs_shade_phong_near, dark_light, &shine, white)
    LIT("phong_near, two dark", zs_shade_phong_near, dark_lights, &shine, white)
    LIT("phong_near, matt", zs_shade_phong_near, far_light, 0, none)
    LIT("phong_near, shining", zs_shade_phong_near, far_light, &shine, white)
    PLAIN("smooth_ordered", zs_shade_smooth_ordered)
    MAPPED("shadowed_flat", zs_shade_shadowed_flat)
    MAPPED("shadowed_smooth", zs_shade_shadowed_smooth)
    LAMP_MAPPED("shadowed_lit", zs_shade_shadowed_lit, far_light, map)
    LAMP_MAPPED("shadowed_lit, point", zs_shade_shadowed_lit, above_light, cone)
    map.soft = 1;
    MAPPED("shadowed_smooth, soft", zs_shade_shadowed_smooth)
}

static void textures(void)
{
    const struct zs_rgb white = ZS_RGB(0xffffff);
    PLAIN("texture", zs_shade_texture)
    PLAIN("bilinear, 8 px a texel", zs_shade_bilinear)
    PLAIN("1 px a texel: bilinear", zs_shade_bilinear)
    PLAIN("1 px a texel: mipmap", zs_shade_mipmap)
    PLAIN("1 px a texel: mipmap_bilinear", zs_shade_mipmap_bilinear)
    PLAIN("matcap", zs_shade_matcap)
    BLEND("blend_texture", zs_blend_texture)
    LIT("texture_lit", zs_shade_texture_lit, far_light, 0, ((struct zs_rgb){ 0 }))
    PLAIN("texture_smooth", zs_shade_texture_smooth)
    LIT("texture_gloss", zs_shade_texture_gloss, far_light, &shine, white)
    LIT("texture_gloss, no highlight", zs_shade_texture_gloss, beside_light, &shine, white)
    LIT("texture_gloss_tinted", zs_shade_texture_gloss_tinted, far_light, &shine, white)
    LIT("texture_phong", zs_shade_texture_phong, far_light, &shine, white)
    LIT("texture_phong, dark", zs_shade_texture_phong, dark_light, &shine, white)
    LAMP_MAPPED("shadowed_texture, soft", zs_shade_shadowed_texture, far_light, map)
    LAMP_MAPPED("shadowed_texture, point", zs_shade_shadowed_texture, above_light, cone)
    made();
    BLEND("blend_texture_smooth", zs_blend_texture_smooth)
    texture.format = &zs_texel_4444;
    PLAIN("cutout, 4444", zs_shade_cutout)
    const struct zs_material front = { .shader = &zs_shade_raw };
    before = &front;
    PLAIN("raw, hidden", zs_shade_raw)
    PLAIN("cutout, hidden", zs_shade_cutout)
    before = 0;
    texture.format = &zs_texel_pal8a;
    PLAIN("cutout, pal8a", zs_shade_cutout)
    texture.format = &zs_texel_4444;
    PLAIN("cutout_smooth, 4444", zs_shade_cutout_smooth)
}

static void hooks(void)
{
    HOOK("fog", zs_fog_draw, &fog)
    HOOK("dither to rgb332", zs_dither_draw, &rgb332)
    HOOK("dither to 16 greys", zs_dither_draw, &grey)
    HOOK("dither to 1 bit", zs_dither_draw, &mono)
    const struct zs_material raw = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xc08040) };
    int err = 0;
    uint64_t sum;
    cut(W, 16);
    const uint64_t averaged = taken(&raw, 0, 4, 0, &err);
    (void)taken(&raw, 0, 4, &sum, &err);
    print("4 samples averaged", averaged - taken(&raw, 0, 3, 0, &err), W / 2 * (H / 2), sum, err);
}

static void plain_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    *f->color = (uint16_t)(*f->color + (f->v[0] ^ f->v[1]));
}

static void plain_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = (uint16_t)(s->instance->mesh->normal[v][k] + 32768);
}

static const struct zs_shader own = { .vertex = plain_vertex, .fragment = plain_fragment, ZS_FRAGMENTS,
                                      .n_varyings = 3 };

/* What lies behind, on top, and in windows; a fragment stage of a program's own. */
static void around(void)
{
    static struct zs_sky_gradient gradient;
    static struct zs_sky panorama;
    static const struct zs_rgb color[4] = { ZS_RGB(0x102040), ZS_RGB(0x80a0c0), ZS_RGB(0x404020), ZS_RGB(0x201008) };
    static uint16_t picture[32 * 32];
    static const struct zs_rect whole = { 0, 0, W, H };
    static const struct zs_sprite sprite = { .pixel = picture, .w = 32, .h = 32, .format = ZS_SPRITE_565 };
    static const struct zs_item item[] = {
        { .kind = &zs_item_fill, .x = 20, .y = 20, .w = 100, .h = 80, .color = 0x1234 },
        { .kind = &zs_item_sprite, .x = 20, .y = 20, .sprite = &sprite },
        { .kind = &zs_item_text, .x = 8, .y = 20, .color = 0xffff, .text = "A line of text, some 8." },
        { .kind = &zs_item_arc, .x = 80, .y = 60, .w = 40, .h = 6, .color = 0x1234, .back = 0x4321, .value = 40000 },
        { .kind = &zs_item_arc, .x = 80, .y = 60, .w = 40, .color = 0x1234, .value = 65535 },
        { .kind = &zs_item_needle, .x = 80, .y = 60, .w = 40, .h = 6, .color = 0x1234, .size = 6, .value = 9000 },
        { .kind = &zs_item_ticks, .x = 80, .y = 60, .w = 40, .h = 6, .color = 0x1234, .value = 8 },
    };
    static const char *const name[] = { "an overlay's fill", "an overlay's sprite", "an overlay's text",
                                        "an overlay's ring", "an overlay's disc", "an overlay's needle",
                                        "an overlay's ticks" };
    struct zs_camera camera;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(90), H, 8, 4000);
    zs_sky_gradient(&gradient, color);
    zs_sky_look(&gradient.sky, &camera, &whole, 0);
    err = err ? err : zs_sky_panorama(&panorama, &texture, 8000, -8000);
    zs_sky_look(&panorama, &camera, &whole, 0);
    if (err)
        hal_write("# FAILED: skies\n");
    struct backdrop glow;
    const struct zs_background mine = { .fill = backdrop_glow_fill, .ctx = &glow };
    backdrop_colors(&glow, color[0], color[1]);
    backdrop_glow(&glow, W, H, 7, 5, 44);
    behind_row("a sky of one's own", &mine);
    mirror_row("a triangle in a mirror");
    behind_row("a sky of a gradient", &gradient.sky.background);
    behind_row("a sky of a panorama", &panorama.background);
    behind_row("a pass in windows", 0);
    for (uint32_t i = 0; i < sizeof item / sizeof item[0]; i++)
        item_row(name[i], &item[i]);
    texture.format = &zs_texel_565;
    PLAIN("window", zs_shade_window)
    PLAIN("a fragment of one's own", own)
}

/* The same shaders by the vertex. */
#define row vertex_row
static void made_vertices(void)
{
    static struct zs_layered layer;
    static const struct zs_rgb none = ZS_RGB(0);
    int err = 0;
    LIT_LAYERS("a vertex: ")
    if (err)
        hal_write("# FAILED: layers\n");
}

static void vertices(void)
{
    const struct zs_rgb white = ZS_RGB(0xffffff);
    texture.format = &zs_texel_565;
    PLAIN("a vertex: smooth", zs_shade_smooth)
    PLAIN("a vertex: texture", zs_shade_texture)
    LIT("a vertex: lit", zs_shade_lit, far_light, 0, ((struct zs_rgb){ 0 }))
    LIT("a vertex: lit, shining", zs_shade_lit, far_light, &shine, white)
    LIT("a vertex: lit, dark", zs_shade_lit, dark_light, &shine, white)
    LIT("a vertex: lit, point", zs_shade_lit, near_light, 0, ((struct zs_rgb){ 0 }))
    LIT("a vertex: phong, matt", zs_shade_phong, far_light, 0, ((struct zs_rgb){ 0 }))
    LIT("a vertex: texture_lit", zs_shade_texture_lit, far_light, 0, ((struct zs_rgb){ 0 }))
    PLAIN("a vertex: texture_smooth", zs_shade_texture_smooth)
    LIT("a vertex: texture_gloss", zs_shade_texture_gloss, far_light, &shine, white)
    LIT("a vertex: gloss, no highlight", zs_shade_texture_gloss, beside_light, &shine, white)
    LIT("a vertex: texture_gloss_tinted", zs_shade_texture_gloss_tinted, far_light, &shine, white)
    LIT("a vertex: texture_phong", zs_shade_texture_phong, far_light, &shine, white)
    PLAIN("a vertex: matcap", zs_shade_matcap)
    PLAIN("a vertex: bilinear", zs_shade_bilinear)
    MAPPED("a vertex: shadowed_smooth", zs_shade_shadowed_smooth)
    BLEND("a vertex: blend_smooth", zs_blend_smooth)
    PLAIN("a vertex: smooth_ordered", zs_shade_smooth_ordered)
    PLAIN("a vertex: a fragment of one's own", own)
    made_vertices();
    texture.format = &zs_texel_4444;
    BLEND("a vertex: blend_texture_smooth", zs_blend_texture_smooth)
    PLAIN("a vertex: cutout_smooth", zs_shade_cutout_smooth)
}
#undef row

static int ready(void)
{
    const struct zs_material raw = { .shader = &zs_shade_raw };
    const struct zs_instance instance = { .mesh = &card, .material = &raw };
    struct zs_instance caster[1];
    const struct zs_scene scene = { .instance = caster, .n_instances = zs_shadow_casters(caster, &instance, 1, 0) };
    static const int32_t eye[3] = { 0, 0, 100 }, along[3] = { 0, 0, -ZS_Q30_ONE }, up[3] = { 0, ZS_Q30_ONE, 0 };
    struct zs_camera camera;
    texture = (struct zs_texture){
        .format = &zs_texel_565, .texel = texels, .palette = palette, .log2_w = LOG2, .log2_h = LOG2,
        .n_levels = LOG2 + 1u
    };
    for (uint32_t i = 0; i < sizeof texels / sizeof texels[0]; i++)
        texels[i] = (uint16_t)(i * 40503u);
    cut(W, 16);
    int err = zs_shine_set(&shine, 20);
    err = err ? err : zs_camera_orthographic(&camera, (zs_q48_16)8000 << 16, 1, 1000);
    err = err ? err : zs_camera_look_along(&camera, eye, along, up);
    sun_config.depth = &zs_depth_linear;
    screen_config.depth = &zs_depth_float;
    err = err ? err : ZS_INIT(sun);
    err = err ? err : zs_shadow_map_draw(&map, &sun, &scene, &camera);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(80), MAP, 300, 1300);
    err = err ? err : zs_camera_look_along(&camera, above[0].pos, along, up);
    sun_config.depth = &zs_depth_recip;
    err = err ? err : ZS_INIT(sun);
    err = err ? err : zs_shadow_map_draw(&cone, &sun, &scene, &camera);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(90), H, 8, 4000);
    return err ? err : zs_fog_set(&fog, &screen_config, &camera);
}

int main(void)
{
    if (hal_init())
        hal_exit(1);
    const int err = ready();
    if (err) {
        hal_write("# FAILED: ");
        hal_write(zs_error_string(err));
        hal_exit(1);
    }
    colors();
    textures();
    hooks();
    around();
    vertices();
    hal_exit(0);
}
