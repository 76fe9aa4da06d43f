/* Any shader as a layer (effect/layered.c, layered_door.c), filters in other shaders (effect/filtered.c), hooks between
 * passes (zs_pass.early), and fog of layers, behind them and in mirrors: each against pictures of the parts, pixel by
 * pixel and without a tolerance.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "picture.h"
#include "shapes.h"
#include "zs_blend.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_method.h"
#include "zs_shadow.h"

#define W 72
#define H 56
#define SKY 0x39e7

static struct shape ball, ground;
static int16_t ball_uv[SHAPE_VERTS][2];
static uint16_t texel[16 * 16 * 2];

/* ---- A shader of a user's that looks at what is there -------------------------------------------- */

static void odd_fragment(const struct zs_instance *in, struct zs_fragment *f)
{
    (void)in;
    if ((f->x ^ f->y) & 1u)
        *f->color = (uint16_t)(f->paint + f->x);
}
static uint16_t odd_face(const struct zs_shading *s, uint32_t t)
{
    (void)s;
    return (uint16_t)(t * 7u);
}
static const struct zs_shader odd = { .face = odd_face, .fragment = odd_fragment, ZS_FRAGMENTS };

/* ---- A scene: a ball, of which one layer is seen, over bumpy ground ------------------------------- */

struct place {
    struct zs_lamp lamp[2];
    struct zs_lighting lighting;
    struct zs_shine shine;
    struct zs_texture texture;
    struct zs_mesh mesh;
    struct zs_lit_material material;
    struct zs_material floor;
    struct zs_instance thing[2]; /* the ground, the ball */
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
};

static int place_make(struct place *s, struct prng *p)
{
    static const struct place none;
    *s = none;
    shape_sphere(&ball, 6 + prng_pick(p, 6), 7 + prng_pick(p, 7), 2000);
    shape_uv(&ball, ball_uv, p, 3000, 10);
    shape_ground(&ground, 4, 4000, 300, prng_next(p));
    for (uint32_t i = 0; i < sizeof texel / sizeof texel[0]; i++)
        texel[i] = (uint16_t)prng_next(p);
    s->texture = (struct zs_texture){ .format = &zs_texel_565, .texel = texel, .log2_w = 4, .log2_h = 4,
                                      .n_levels = 5 };
    s->lamp[0] = (struct zs_lamp){ .rgb = ZS_RGB(0xffe0c0), .dir = { 0, 858993459, 644245094 } };
    s->lamp[1] = (struct zs_lamp){ .kind = ZS_LAMP_POINT, .rgb = ZS_RGB(0x4080ff), .pos = { 3000, 2500, 1000 } };
    s->lighting = (struct zs_lighting){ .lamp = s->lamp, .n_lamps = 1 + prng_pick(p, 2), .ambient = ZS_RGB(0x303030) };
    s->mesh = ball.mesh;
    s->material = (struct zs_lit_material){
        .material = { .rgb = ZS_RGB(0xc08040), .texture = &s->texture },
        .lighting = &s->lighting, .shine = &s->shine, .specular = ZS_RGB(0x808080)
    };
    s->floor = (struct zs_material){ .shader = &zs_shade_flat, .cull = ZS_CULL_NONE };
    zs_pose_identity(&s->thing[0].pose);
    zs_pose_identity(&s->thing[1].pose);
    s->thing[0].mesh = &ground.mesh;
    s->thing[0].material = &s->floor;
    s->thing[0].pose.pos[1] = -2400;
    s->thing[1].mesh = &s->mesh;
    s->thing[1].material = &s->material.material;
    zs_pose_turn(&s->thing[1].pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), 0);
    s->scene = (struct zs_scene){ .instance = s->thing, .n_instances = 2, .background = SKY };
    const int32_t at[3] = { 0, -800, 0 };
    int err = zs_shine_set(&s->shine, 20);
    err = err ? err : zs_camera_perspective(&s->camera, ZS_DEGREES(55), H, 500, 30000);
    err = err ? err : zs_camera_orbit(&s->camera, at, prng_range(p, 6000, 9000), (zs_turn)prng_next(p),
                                      (int16_t)prng_range(p, 1500, 9000));
    static const struct zs_depth *const depths[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear };
    s->config = picture_config(W, H, depths[prng_pick(p, 3)]);
    s->config.varyings = 8;
    return err;
}

static struct picture drawn(const struct place *s, struct prng *p, const struct zs_method *method, int any_way)
{
    struct zs_config c = s->config;
    c.method = method;
    if (any_way)
        picture_any_way(p, &c, 4, 8);
    return picture_draw(&c, &s->scene, &s->camera);
}

/* ---- Layers -------------------------------------------------------------------------------------- */

/* Within one code of exact arithmetic on the stored alpha. */
static int mixed(const struct picture *under, const struct picture *source, const struct picture *is, uint8_t alpha,
                 int add)
{
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++) {
            const int shift = c == 0 ? 11 : c == 1 ? 5 : 0, mask = c == 1 ? 63 : 31;
            const int old = under->color[i] >> shift & mask, new = source->color[i] >> shift & mask;
            const int got = is->color[i] >> shift & mask;
            const int seen = source->key[i] != under->key[i] || new != old;
            double want = old;
            if (seen)
                want = add ? old + new * alpha / 255.0 : new * alpha / 255.0 + old * (1 - alpha / 255.0);
            if (add && seen && source->key[i] == under->key[i])
                continue; /* not known whether it is seen there */
            want = want > mask ? mask : want;
            if (got - want > 1.001 || want - got > 1.001)
                return case_wrong("(%d, %d): channel %d is %d instead of %g; alpha %d", i % W, i / W, c, got, want,
                                  alpha);
        }
    return 1;
}

static const struct zs_shader *const any[] = {
    &zs_shade_raw,        &zs_shade_flat,          &zs_shade_smooth,          &zs_shade_texture,
    &zs_shade_lit,        &zs_shade_lit_face,      &zs_shade_phong_near,      &zs_shade_texture_lit,
    &zs_shade_texture_gloss, &zs_shade_texture_phong, &zs_shade_texture_tinted, &zs_shade_bilinear_smooth,
    &zs_shade_mipmap_bilinear, &zs_shade_matcap
};
#define ANY (sizeof any / sizeof any[0])

static int layer_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    static struct zs_layered layer;
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    const struct zs_shader *of = any[prng_pick(&p, ANY)];
    const int add = (int)prng_pick(&p, 2);
    const uint8_t alpha = (uint8_t)prng_next(&p);
    if (of == &zs_shade_matcap)
        s.mesh.uv_bits = 15;
    s.material.material.shader = of;
    struct picture source = drawn(&s, &p, NULL, 0);
    s.scene.n_instances = 1;
    struct picture under = drawn(&s, &p, NULL, 0);
    s.scene.n_instances = 2;
    CASE_CHECK(zs_layered_set(&layer, of, add ? &zs_layer_add : &zs_layer_mix, alpha) == ZS_OK);
    s.material.material.shader = &layer.shader;
    struct picture is = drawn(&s, &p, &zs_method_transparent, 1);
    struct picture again = drawn(&s, &p, &zs_method_transparent, 1);
    CASE_CHECK(source.err == ZS_OK && under.err == ZS_OK && is.err == ZS_OK);
    const int right = mixed(&under, &source, &is, alpha, add) && picture_same(&is, &again, "ways");
    PICTURES_FREE(&source, &under, &is, &again);
    return right;
}

/* Layers of the plain shaders are those of zs_blend_, zs_add_ and zs_stipple_, bit for bit. */
static int same_case(uint64_t seed)
{
    static const struct {
        const struct zs_shader *of, *family[3];
    } plain[] = {
        { &zs_shade_smooth, { &zs_blend_smooth, &zs_add_smooth, &zs_stipple_smooth } },
        { &zs_shade_texture, { &zs_blend_texture, &zs_add_texture, &zs_stipple_texture } },
        { &zs_shade_texture_flat, { &zs_blend_texture_flat, &zs_add_texture_flat, &zs_stipple_texture_flat } },
        { &zs_shade_texture_smooth, { &zs_blend_texture_smooth, &zs_add_texture_smooth, &zs_stipple_texture_smooth } },
    };
    static const struct zs_layer_kind *const kinds[] = { &zs_layer_mix, &zs_layer_add, &zs_layer_door };
    static const struct {
        const struct zs_method *method;
        const struct zs_depth *depth; /* NULL: any */
    } by[] = { { &zs_method_transparent, NULL }, { &zs_method_painter, &zs_depth_none },
               { &zs_method_depthsort, &zs_depth_order } };
    struct prng p = { seed };
    static struct place s;
    static struct zs_layered layer;
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    const uint32_t k = prng_pick(&p, 4), kind = prng_pick(&p, 3), m = seed % 4 < 2 ? 0 : (uint32_t)(seed % 4) - 1;
    if (by[m].depth)
        s.config.depth = by[m].depth;
    const uint8_t alpha = (uint8_t)prng_next(&p), phase = (uint8_t)prng_pick(&p, 64);
    struct zs_blend blend = { .material = s.material.material, .alpha = alpha, .phase = phase };
    blend.material.shader = plain[k].family[kind];
    s.thing[1].material = &blend.material;
    struct picture want = drawn(&s, &p, by[m].method, 0);
    CASE_CHECK(zs_layered_set(&layer, plain[k].of, kinds[kind], alpha) == ZS_OK);
    layer.phase = phase;
    s.material.material.shader = &layer.shader;
    s.thing[1].material = &s.material.material;
    struct picture is = drawn(&s, &p, by[m].method, 1);
    CASE_CHECK(want.err == ZS_OK);
    return picture_drawn_alike(&want, &is, "the plain family");
}

/* One that reads old colours, and leaves pixels as they are. */
static void user_fragment(void **state)
{
    (void)state;
    static struct place s;
    static struct zs_layered layer;
    struct prng p = { 3 };
    assert_int_equal(place_make(&s, &p), ZS_OK);
    s.material.material.shader = &odd;
    struct picture source = drawn(&s, &p, NULL, 0);
    assert_int_equal(zs_layered_set(&layer, &odd, &zs_layer_mix, 255), ZS_OK);
    s.material.material.shader = &layer.shader;
    struct picture is = drawn(&s, &p, &zs_method_transparent, 1);
    assert_memory_equal(source.color, is.color, sizeof *is.color * W * H);
    PICTURES_FREE(&source, &is);
}

/* ---- Filters ------------------------------------------------------------------------------------- */

static int filter_case(uint64_t seed)
{
    static const struct {
        const struct zs_shader *of, *linear, *levels, *both;
    } plain[] = {
        { &zs_shade_texture, &zs_shade_bilinear, &zs_shade_mipmap, &zs_shade_mipmap_bilinear },
        { &zs_shade_texture_flat, &zs_shade_bilinear_flat, &zs_shade_mipmap_flat, &zs_shade_mipmap_bilinear_flat },
        { &zs_shade_texture_smooth, &zs_shade_bilinear_smooth, &zs_shade_mipmap_smooth,
          &zs_shade_mipmap_bilinear_smooth },
    };
    static const struct zs_filter_kind *const kinds[] = { &zs_filter_linear, &zs_filter_levels,
                                                          &zs_filter_levels_linear };
    struct prng p = { seed };
    static struct place s;
    static struct zs_filtered filtered;
    static struct zs_layered layer;
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    const uint32_t k = prng_pick(&p, 3), kind = prng_pick(&p, 3);
    s.material.material.shader = kind == 0 ? plain[k].linear : kind == 1 ? plain[k].levels : plain[k].both;
    struct picture want = drawn(&s, &p, NULL, 0);
    CASE_CHECK(zs_filtered_set(&filtered, plain[k].of, kinds[kind]) == ZS_OK);
    s.material.material.shader = &filtered.shader;
    if (prng_pick(&p, 2)) { /* an opaque layer of it */
        CASE_CHECK(zs_layered_set(&layer, &filtered.shader, &zs_layer_door, 255) == ZS_OK);
        s.material.material.shader = &layer.shader;
    }
    struct picture is = drawn(&s, &p, NULL, 1);
    return picture_drawn_alike(&want, &is, "the plain filter");
}

/* In a texture of one colour, filters change nothing, whatever lights it. */
static int one_color_case(uint64_t seed)
{
    static const struct zs_shader *const lit[] = { &zs_shade_texture_lit, &zs_shade_texture_gloss,
                                                   &zs_shade_texture_gloss_tinted, &zs_shade_texture_phong,
                                                   &zs_shade_matcap };
    static const struct zs_filter_kind *const kinds[] = { &zs_filter_linear, &zs_filter_levels,
                                                          &zs_filter_levels_linear };
    struct prng p = { seed };
    static struct place s;
    static struct zs_filtered filtered;
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    for (uint32_t i = 1; i < sizeof texel / sizeof texel[0]; i++)
        texel[i] = texel[0];
    s.material.material.shader = lit[prng_pick(&p, 5)];
    if (s.material.material.shader == &zs_shade_matcap)
        s.mesh.uv_bits = 15;
    struct picture want = drawn(&s, &p, NULL, 0);
    CASE_CHECK(zs_filtered_set(&filtered, s.material.material.shader, kinds[prng_pick(&p, 3)]) == ZS_OK);
    s.material.material.shader = &filtered.shader;
    struct picture is = drawn(&s, &p, NULL, 1);
    return picture_drawn_alike(&want, &is, "a texture of one colour");
}

/* ---- Fog ----------------------------------------------------------------------------------------- */

static int fog_make(struct zs_fog *fog, struct place *s, struct prng *p)
{
    memset(fog, 0, sizeof *fog);
    fog->color = (uint16_t)prng_next(p);
    fog->curve = (uint8_t)prng_pick(p, 2);
    fog->start = prng_range(p, -2000, 7000);
    fog->end = fog->start + prng_range(p, 1, 9000);
    return zs_fog_set(fog, &s->config, &s->camera);
}

/* Fog behind a layer, by an early hook, and fog of the layer: that of a frame in which it is opaque, mixed in. */
static int fog_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    static struct zs_layered layer;
    static struct zs_fog fog;
    CASE_CHECK(place_make(&s, &p) == ZS_OK && fog_make(&fog, &s, &p) == ZS_OK);
    const struct zs_resolve hook = { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &fog };
    const uint8_t alpha = (uint8_t)prng_next(&p);
    s.scene.resolve = &hook;
    s.scene.n_resolves = 1;
    s.material.material.shader = &zs_shade_lit;
    struct picture source = drawn(&s, &p, NULL, 0);
    struct zs_mesh none = ball.mesh, no_ground = ground.mesh; /* they reach as far */
    none.n_tris = no_ground.n_tris = 0;
    struct zs_instance back[2] = { s.thing[0], s.thing[1] }, front[2] = { s.thing[0], s.thing[1] };
    const struct zs_material plain = { .shader = &zs_shade_raw };
    back[1].mesh = &none;
    back[1].material = &plain;
    front[0].mesh = &no_ground;
    const struct zs_scene behind = { .instance = back, .n_instances = 2, .background = SKY, .resolve = &hook,
                                     .n_resolves = 1 };
    const struct zs_scene before = { .instance = front, .n_instances = 2 };
    struct picture under = picture_draw(&s.config, &behind, &s.camera);
    CASE_CHECK(zs_layered_set(&layer, &zs_shade_lit, &zs_layer_mix, alpha) == ZS_OK);
    s.material.material.shader = &layer.shader;
    struct picture clear = drawn(&s, &p, &zs_method_transparent, 0);
    zs_layered_fog(&layer, &fog);
    zs_layered_fog(&layer, NULL); /* no fog again */
    struct picture cleared = drawn(&s, &p, &zs_method_transparent, 0);
    CASE_CHECK(clear.err == ZS_OK && picture_same(&clear, &cleared, "without fog"));
    picture_free(&clear);
    picture_free(&cleared);
    zs_layered_fog(&layer, &fog);
    const struct zs_pass pass[2] = {
        { .scene = &behind, .camera = &s.camera, .early = 1 },
        { .scene = &before, .camera = &s.camera, .keep = ZS_KEEP_COLOR | ZS_KEEP_DEPTH }
    };
    struct zs_config c = s.config;
    c.method = &zs_method_transparent;
    struct picture is = picture_passes(&c, pass, 2);
    picture_any_way(&p, &c, 4, 8);
    struct picture again = picture_passes(&c, pass, 2);
    CASE_CHECK(source.err == ZS_OK && under.err == ZS_OK && is.err == ZS_OK);
    const int right = mixed(&under, &source, &is, alpha, 0) && picture_same(&is, &again, "ways");
    PICTURES_FREE(&source, &under, &is, &again);
    return right;
}

/* Fog of a room and of what its mirror shows: the picture of either alone, fogged, is found where it is seen. */
static int mirror_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    static struct zs_fog fog[2];
    static struct zs_mirror mirror;
    static const int16_t pos[4][3] = { { -4000, 0, 4000 }, { 4000, 0, 4000 }, { 4000, 0, -4000 }, { -4000, 0, -4000 } };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    static const struct zs_mesh glass = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 5660 };
    static const struct zs_material window = { .shader = &zs_shade_window }, opaque = { .shader = &zs_shade_raw };
    CASE_CHECK(place_make(&s, &p) == ZS_OK && fog_make(&fog[0], &s, &p) == ZS_OK);
    fog[1] = fog[0];
    const struct zs_resolve plain = { .draw = zs_fog_draw, .ctx = &fog[0] };
    struct zs_resolve hook[2] = { plain, plain };
    hook[1].ctx = &fog[1];
    struct zs_instance in[2] = { s.thing[1], s.thing[0] };
    s.material.material.shader = &zs_shade_lit;
    in[1].mesh = &glass;
    in[1].material = &opaque;
    CASE_CHECK(zs_mirror_of(&mirror, &in[1], 0) == ZS_OK);
    struct zs_scene room = { .instance = in, .n_instances = 2, .background = SKY, .resolve = &hook[0],
                             .n_resolves = 1 };
    struct zs_scene seen = { .instance = in, .n_instances = 1, .background = 0x1234, .resolve = &hook[1],
                             .n_resolves = 1 };
    struct zs_pass pass[2] = { { .scene = &room, .camera = &s.camera, .early = 1 },
                               { .scene = &seen, .camera = &s.camera, .mirror = &mirror } };
    struct picture front = picture_passes(&s.config, pass, 1), image = picture_passes(&s.config, pass + 1, 1);
    room.n_resolves = 0;
    const uint16_t color = fog[0].color;
    struct picture glass_at = picture_passes(&s.config, pass, 1); /* raw 0, where the floor is seen */
    room.n_resolves = 1;
    in[1].material = &window;
    pass[1].mask = &zs_mask_window;
    fog[0].sky = ZS_FOG_WINDOWS;
    fog[1].sky = ZS_FOG_MASKED;
    struct zs_config c = s.config;
    picture_any_way(&p, &c, 4, 8);
    struct picture is = picture_passes(&c, pass, 2);
    CASE_CHECK(front.err == ZS_OK && image.err == ZS_OK && is.err == ZS_OK && glass_at.err == ZS_OK);
    int right = 1;
    for (int i = 0; right && i < W * H; i++) {
        const int in_glass = glass_at.color[i] == 0 && glass_at.key[i] != ZS_DEPTH_CLEAR;
        if (in_glass && image.key[i] == 0)
            continue; /* nearer than near: no fog */
        const uint16_t want = in_glass ? image.color[i] : front.color[i];
        if (is.color[i] != want)
            right = case_wrong("(%d, %d): %04x instead of %04x, %s the mirror; fog %04x", i % W, i / W, is.color[i],
                               want, in_glass ? "in" : "beside", color);
    }
    PICTURES_FREE(&front, &image, &glass_at, &is);
    return right;
}

/* ---- Refusals ------------------------------------------------------------------------------------ */

static void refusals(void **state)
{
    (void)state;
    static struct place s;
    static struct zs_layered layer, twice;
    static struct zs_filtered filtered, again;
    struct prng p = { 9 };
    assert_int_equal(zs_layered_set(NULL, &zs_shade_lit, &zs_layer_mix, 9), ZS_ERR_NULL);
    assert_int_equal(zs_layered_set(&layer, NULL, &zs_layer_mix, 9), ZS_ERR_NULL);
    assert_int_equal(zs_layered_set(&layer, &zs_shade_lit, NULL, 9), ZS_ERR_NULL);
    assert_int_equal(zs_layered_set(&layer, &zs_shade_cutout, &zs_layer_mix, 9), ZS_ERR_RANGE);
    assert_int_equal(zs_layered_set(&layer, &zs_blend_flat, &zs_layer_door, 9), ZS_ERR_RANGE);
    assert_int_equal(zs_layered_set(&layer, &zs_shade_window, &zs_layer_mix, 9), ZS_ERR_RANGE);
    assert_int_equal(zs_layered_set(&layer, &zs_shade_lit, &zs_layer_mix, 9), ZS_OK);
    assert_int_equal(zs_layered_set(&twice, &layer.shader, &zs_layer_mix, 9), ZS_ERR_RANGE);
    assert_int_equal(zs_filtered_set(NULL, &zs_shade_texture, &zs_filter_linear), ZS_ERR_NULL);
    assert_int_equal(zs_filtered_set(&filtered, &zs_shade_texture, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_filtered_set(&filtered, &zs_shade_cutout, &zs_filter_linear), ZS_ERR_RANGE);
    assert_int_equal(zs_filtered_set(&filtered, &zs_shade_texture_tinted, &zs_filter_linear), ZS_ERR_RANGE);
    assert_int_equal(zs_filtered_set(&filtered, &zs_blend_texture, &zs_filter_linear), ZS_ERR_RANGE);
    static const struct zs_shader *const others[] = {
        &zs_shade_bilinear, &zs_shade_bilinear_flat, &zs_shade_bilinear_smooth, &zs_shade_mipmap,
        &zs_shade_mipmap_flat, &zs_shade_mipmap_smooth, &zs_shade_mipmap_bilinear, &zs_shade_mipmap_bilinear_flat,
        &zs_shade_mipmap_bilinear_smooth, &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth, &zs_shade_lit,
        &zs_shade_phong, &zs_shade_shadowed_lit, &zs_shade_window, &zs_shade_smooth_ordered
    };
    for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
        assert_int_equal(zs_filtered_set(&filtered, others[k], &zs_filter_linear), ZS_ERR_RANGE);
    assert_int_equal(zs_filtered_set(&filtered, &zs_shade_texture_gloss, &zs_filter_levels), ZS_OK);
    assert_int_equal(zs_filtered_set(&again, &filtered.shader, &zs_filter_linear), ZS_ERR_RANGE);
    assert_int_equal(zs_layered_set(&layer, &filtered.shader, &zs_layer_mix, 9), ZS_OK);
    assert_int_equal(zs_filtered_set(&again, &layer.shader, &zs_filter_linear), ZS_ERR_RANGE);
    /* a chain of levels that is cut, through a layer too */
    assert_int_equal(place_make(&s, &p), ZS_OK);
    s.texture.n_levels = 6;
    assert_int_equal(zs_layered_set(&layer, &filtered.shader, &zs_layer_mix, 9), ZS_OK);
    const struct zs_shader *const either[] = { &filtered.shader, &layer.shader };
    for (int k = 0; k < 2; k++) {
        s.material.material.shader = either[k];
        struct picture is = drawn(&s, &p, &zs_method_transparent, 0);
        assert_int_equal(is.err, ZS_ERR_TEXTURE);
        picture_free(&is);
    }
}

static const struct CMUnitTest tests[] = { CASES_TEST(layers, layer_case, 150),
                                          CASES_TEST(as_the_plain_families, same_case, 160),
                                          cmocka_unit_test(user_fragment),
                                          CASES_TEST(filters, filter_case, 80),
                                          CASES_TEST(filters_of_one_color, one_color_case, 60),
                                          CASES_TEST(fog_behind_layers, fog_case, 100),
                                          CASES_TEST(fog_in_mirrors, mirror_case, 100),
                                          cmocka_unit_test(refusals) };
CASES_MAIN(tests)
