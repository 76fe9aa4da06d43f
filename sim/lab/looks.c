/* A ball or a teapot with effects on it, in front of the eye, on a mirror or not.
 *
 * SPDX-License-Identifier: MIT
 */
#include "looks.h"

#include "meshes.h"
#include "pieces.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_method.h"
#include "zs_shadow.h"

#define W 160u
#define H 120u
#define MAP 64
#define FAR 600000

enum { PLAIN, LIT, MAPPED };                    /* materials */
enum { NONE, MIX, ADD, DOOR };                  /* layers */
enum { NEAREST, LINEAR, LEVELS };               /* filters */
enum { MIRROR = 1, FOG = 2, DITHER = 4, DULL = 8 }; /* flags; DULL: without highlights */
enum { SUN, SUNS, LAMP, LAMPS };                /* lights: one or two parallel ones, or at points */

static const struct {
    const char *name;
    const struct zs_shader *shader;
    uint8_t material, lights, layer, filter, flags, varyings, textured;
} looks[] = {
    { "smooth", &zs_shade_smooth, PLAIN, 0, NONE, NEAREST, 0, 3, 0 },
    { "texture", &zs_shade_texture, PLAIN, 0, NONE, NEAREST, 0, 3, 1 },
    { "lit", &zs_shade_lit, LIT, SUN, NONE, NEAREST, 0, 3, 0 },
    { "lit, a layer", &zs_shade_lit, LIT, SUN, MIX, NEAREST, 0, 3, 0 },
    { "lit by points, a layer that is added", &zs_shade_lit, LIT, LAMPS, ADD, NEAREST, 0, 3, 0 },
    { "lit, a screen-door", &zs_shade_lit, LIT, SUN, DOOR, NEAREST, 0, 3, 0 },
    { "smooth, a layer in fog", &zs_shade_smooth, PLAIN, 0, MIX, NEAREST, FOG, 3, 0 },
    { "lit, dithered", &zs_shade_lit, LIT, SUN, NONE, NEAREST, DITHER, 3, 0 },
    { "lit, dithered, a layer", &zs_shade_lit, LIT, SUN, MIX, NEAREST, DITHER, 3, 0 },
    { "a flat colour in fog", &zs_shade_flat, PLAIN, 0, NONE, NEAREST, FOG, 3, 0 },
    { "phong", &zs_shade_phong, LIT, SUN, NONE, NEAREST, 0, 3, 0 },
    { "phong, dull", &zs_shade_phong, LIT, SUN, NONE, NEAREST, DULL, 3, 0 },
    { "phong, two lamps", &zs_shade_phong, LIT, SUNS, NONE, NEAREST, 0, 3, 0 },
    { "phong, a layer in fog", &zs_shade_phong, LIT, SUN, MIX, NEAREST, FOG, 3, 0 },
    { "phong by a point", &zs_shade_phong_near, LIT, LAMP, NONE, NEAREST, 0, 6, 0 },
    { "phong by two points, dull", &zs_shade_phong_near, LIT, LAMPS, NONE, NEAREST, DULL, 6, 0 },
    { "gloss", &zs_shade_texture_gloss, LIT, SUN, NONE, NEAREST, 0, 4, 1 },
    { "gloss, bilinear", &zs_shade_texture_gloss, LIT, SUN, NONE, LINEAR, 0, 4, 1 },
    { "gloss, mipmaps, a layer", &zs_shade_texture_gloss, LIT, LAMP, MIX, LEVELS, 0, 4, 1 },
    { "texture lit by points, bilinear", &zs_shade_texture_lit, LIT, LAMPS, NONE, LINEAR, DULL, 3, 1 },
    { "bilinear, a screen-door", &zs_shade_bilinear_smooth, PLAIN, 0, DOOR, NEAREST, 0, 3, 1 },
    { "texture phong, bilinear", &zs_shade_texture_phong, LIT, SUN, NONE, LINEAR, 0, 8, 1 },
    { "texture phong by points", &zs_shade_texture_phong, LIT, LAMPS, NONE, NEAREST, 0, 8, 1 },
    { "shadows of two lamps", &zs_shade_shadowed_phong, MAPPED, LAMPS, NONE, NEAREST, 0, 6, 0 },
    { "shadows on a texture", &zs_shade_shadowed_texture_phong, MAPPED, LAMP, NONE, NEAREST, 0, 8, 1 },
    { "smooth on a mirror", &zs_shade_smooth, PLAIN, 0, NONE, NEAREST, MIRROR, 3, 0 },
    { "texture on a mirror", &zs_shade_texture_smooth, PLAIN, 0, NONE, NEAREST, MIRROR, 3, 1 },
    { "lit on a mirror, in fog", &zs_shade_lit, LIT, SUN, NONE, NEAREST, MIRROR | FOG, 3, 0 },
    { "gloss, bilinear, on a mirror", &zs_shade_texture_gloss, LIT, SUN, NONE, LINEAR, MIRROR, 4, 1 },
    { "lit on a mirror, a layer", &zs_shade_lit, LIT, SUN, MIX, NEAREST, MIRROR, 3, 0 },
};
#define LOOKS (sizeof looks / sizeof looks[0])

static const struct zs_lamp sun[2] = { { .dir = { 619925131, 619925131, 619925131 } },
                                       { .dir = { 0, 0, ZS_Q30_ONE }, .rgb = ZS_RGB(0x604830) } },
                            lamp[2] = { { .kind = ZS_LAMP_POINT, .pos = { 90000, 90000, 90000 } },
                                        { .kind = ZS_LAMP_POINT, .pos = { -90000, 60000, 50000 } } };
static const struct zs_lighting light[] = { { .lamp = sun, .n_lamps = 1, .ambient = ZS_RGB(0x303030) },
                                            { .lamp = sun, .n_lamps = 2, .ambient = ZS_RGB(0x303030) },
                                            { .lamp = lamp, .n_lamps = 1, .ambient = ZS_RGB(0x303030) },
                                            { .lamp = lamp, .n_lamps = 2, .ambient = ZS_RGB(0x303030) } };
static struct zs_shine shine;
static struct zs_shadowed_phong material; /* begins with the others */
static struct zs_filtered filtered;
static struct zs_layered layered;
static struct zs_shader dithered;
static struct zs_fog fog;
static const struct zs_resolve in_fog = { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &fog };
static uint16_t key[2][MAP * MAP];
static struct zs_shadow_map map[2] = { { .key = key[0], .w = MAP, .h = MAP }, { .key = key[1], .w = MAP, .h = MAP } };
static struct zs_camera camera;
static struct zs_scene scene[3];
static struct zs_instance room[2], image;
static struct zs_mirror mirror;
static const int16_t plate_pos[4][3] = { { -30000, 0, -30000 }, { -30000, 0, 30000 }, { 30000, 0, 30000 },
                                         { 30000, 0, -30000 } };
static const uint16_t plate_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh plate = { .pos = plate_pos, .tri = plate_tri, .n_verts = 4, .n_tris = 2, .radius = 42427 };
static const struct zs_material glass = { .shader = &zs_shade_window };

/* Maps of both lamps, each drawn by a renderer of its own. */
static int draw_maps(const struct zs_instance *of)
{
    ZS_RENDERER(sight, MAP, MAP, MAP, 4000, 2000, 0);
    struct zs_instance caster[1];
    const struct zs_scene casters = { .instance = caster, .n_instances = zs_shadow_casters(caster, of, 1, NULL) };
    const int32_t up[3] = { 0, 1, 0 };
    int err = ZS_OK;
    for (int k = 0; k < 2; k++) {
        struct zs_camera eye;
        int32_t along[3];
        for (int c = 0; c < 3; c++)
            along[c] = -lamp[k].pos[c];
        sight_config.depth = &zs_depth_recip;
        err = err ? err : ZS_INIT(sight);
        err = err ? err : zs_camera_perspective(&eye, ZS_DEGREES(50), MAP, 40000, FAR);
        err = err ? err : zs_camera_look_along(&eye, lamp[k].pos, along, up);
        err = err ? err : zs_shadow_map_draw(&map[k], &sight, &casters, &eye);
    }
    return err;
}

static int make_material(uint32_t i)
{
    const int textured = looks[i].textured;
    const struct zs_shader *shader = looks[i].shader;
    int err = zs_shine_set(&shine, 24);
    material = (struct zs_shadowed_phong){ .lit = { .material = { .rgb = ZS_RGB(0xc08040),
                                                                  .texture = textured ? &texture_forest_floor : NULL },
                                                    .lighting = &light[looks[i].lights],
                                                    .specular = ZS_RGB(0xc0c0c0) },
                                           .map = { &map[0], &map[1] } };
    material.lit.shine = looks[i].flags & DULL ? NULL : &shine;
    if (looks[i].flags & DITHER) {
        dithered = zs_shade_smooth_ordered;
        dithered.vertex = shader->vertex;
        dithered.check = shader->check;
        shader = &dithered;
    }
    if (!err && looks[i].filter != NEAREST) {
        err = zs_filtered_set(&filtered, shader,
                              looks[i].filter == LINEAR ? &zs_filter_linear : &zs_filter_levels_linear);
        shader = &filtered.shader;
    }
    if (!err && looks[i].layer != NONE) {
        err = zs_layered_set(&layered, shader,
                             looks[i].layer == MIX   ? &zs_layer_mix
                             : looks[i].layer == ADD ? &zs_layer_add
                                                     : &zs_layer_door,
                             120);
        if (looks[i].flags & FOG)
            zs_layered_fog(&layered, &fog);
        shader = &layered.shader;
    }
    material.lit.material.shader = shader;
    return err;
}

/* As zsim render has its passes: what stands on the mirror, then what is seen in it; a layer after that. */
static void make_passes(struct look *out, uint32_t i)
{
    const int layer = looks[i].layer == MIX || looks[i].layer == ADD, mirrors = looks[i].flags & MIRROR;
    const struct zs_instance thing = room[0];
    out->pass[0] = (struct zs_pass){ .scene = &scene[0], .camera = &camera };
    out->n = 1;
    image = thing;
    scene[0] = (struct zs_scene){ .instance = room, .n_instances = 1 };
    if (looks[i].flags & FOG && !layer) {
        scene[0].resolve = &in_fog;
        scene[0].n_resolves = 1;
    }
    if (!mirrors)
        return;
    room[layer ? 0 : 1] = (struct zs_instance){ .mesh = &plate, .material = &glass,
                                                .pose = { .pos = { 0, -32000, 0 }, .scale = 2 * ZS_Q16_ONE } };
    scene[0].n_instances = layer ? 1 : 2;
    (void)zs_mirror_of(&mirror, &room[layer ? 0 : 1], 16);
    scene[1] = (struct zs_scene){ .instance = &image, .n_instances = 1, .background = 0x4208 };
    out->pass[0].early = scene[0].n_resolves > 0;
    out->pass[1] = (struct zs_pass){ .scene = &scene[1], .camera = &camera, .mirror = &mirror,
                                     .mask = &zs_mask_window };
    out->n = 2;
    if (!layer)
        return;
    scene[2] = (struct zs_scene){ .instance = &image, .n_instances = 1 };
    out->pass[2] = (struct zs_pass){ .scene = &scene[2], .camera = &camera, .keep = ZS_KEEP_COLOR };
    out->n = 3;
}

static int make_shown(struct look *out, uint32_t i)
{
    static const int32_t middle[3] = { 0, -6000, 0 };
    const struct zs_config config = { .width = W, .height = H, .depth_bits = 16, .depth = &zs_depth_float };
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), H, 8000, FAR);
    zs_camera_orbit(&camera, middle, 110000, ZS_DEGREES(20), ZS_DEGREES(18));
    fog = (struct zs_fog){ .color = 0x8410, .start = 60000, .end = 240000 };
    err = err ? err : zs_fog_set(&fog, &config, &camera);
    err = err ? err : make_material(i);
    room[0] = (struct zs_instance){ .mesh = &mesh_globe, .material = &material.lit.material };
    zs_pose_turn(&room[0].pose, ZS_DEGREES(33), 0, 0);
    if (!err && looks[i].material == MAPPED)
        err = draw_maps(room);
    make_passes(out, i);
    out->name = looks[i].name;
    out->method = looks[i].layer == MIX || looks[i].layer == ADD ? &zs_method_transparent : NULL;
    out->varyings = looks[i].varyings;
    out->w = W;
    out->h = H;
    return err;
}

/* A showpiece, twice in its loop. */
static int make_piece(struct look *out, uint32_t i)
{
    static struct demo_frame frame;
    const struct piece *const piece = pieces[i / 2];
    piece->demo.pose(&frame, i % 2 ? piece->demo.frames / 3u : 0u, piece->demo.width, piece->demo.height);
    *out = (struct look){ .name = piece->demo.name, .n = piece->n_passes ? piece->n_passes : 1u,
                          .method = piece->method, .w = piece->demo.width, .h = piece->demo.height,
                          .varyings = (uint8_t)piece->demo.varyings };
    out->pass[0] = (struct zs_pass){ .scene = &frame.scene, .camera = &frame.camera };
    for (uint32_t k = 0; k < piece->n_passes; k++)
        out->pass[k] = piece->pass[k];
    return ZS_OK;
}

int look_make(struct look *out, uint32_t i, int *err)
{
    *out = (struct look){ .n = 0 };
    if (i >= LOOKS + 2u * n_pieces)
        return 0;
    *err = i < LOOKS ? make_shown(out, i) : make_piece(out, i - (uint32_t)LOOKS);
    return 1;
}

int look_draw(const struct look *look, struct zs_renderer *r, const struct zs_sink *sink)
{
    static struct zs_pass_memory memory[3];
    return look->n == 1 ? zs_render(r, look->pass[0].scene, look->pass[0].camera, sink)
                        : zs_render_passes(r, look->pass, memory, look->n, sink);
}
