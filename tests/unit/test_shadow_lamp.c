/* Shadow maps of lamps, directional, of a point and of a spot, on colours and on textures, lit at the vertices or at
 * each pixel beside a lamp without a map: what is lit, what is dark, against rays to the lamp in doubles; the colours
 * of either, against the shaders that know no shadows.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "boxes.h"
#include "cases.h"
#include "effect/shadow.h"
#include "picture.h"
#include "zs_shadow.h"

#define BOXES 4
#define THINGS (BOXES + 1)
#define MAP 160
#define W 80
#define H 60
#define PI 3.14159265358979323846

static const int16_t uv[8][2] = { { 0, 0 }, { 3000, 0 }, { 3000, 3000 }, { 0, 3000 },
                                  { 900, 0 }, { 2000, 100 }, { 700, 900 }, { 100, 200 } };
static const uint16_t texels[16] = { 0xffff, 0xf800, 0x07e0, 0x001f, 0xffe0, 0x07ff, 0xf81f, 0x8410,
                                     0xc618, 0x4208, 0xffff, 0xfc10, 0x87f0, 0x841f, 0xfff0, 0x87ff };
static const struct zs_texture texture = { .format = &zs_texel_565, .texel = texels, .log2_w = 2, .log2_h = 2 };
static zs_q1_15 box_normal[8][3];
static const zs_q1_15 ground_normal[4][3] = { { 0, 32767, 0 }, { 0, 32767, 0 }, { 0, 32767, 0 }, { 0, 32767, 0 } };
static const struct zs_mesh box = { .pos = box_pos, .tri = box_tri, .normal = (const zs_q1_15(*)[3])box_normal,
                                    .uv = uv, .uv_bits = 10, .n_verts = 8, .n_tris = 12, .radius = 87 },
                            ground = { .pos = ground_pos, .tri = ground_tri, .normal = ground_normal, .uv = uv,
                                       .uv_bits = 10, .n_verts = 4, .n_tris = 2, .radius = 142 };

struct place {
    struct zs_instance thing[THINGS], caster[THINGS];
    struct zs_shadowed_phong material; /* begins as a struct zs_shadowed_lit does */
    struct zs_lighting lighting;
    struct zs_lamp lamp, other;        /* lamps of the lighting: one, or both */
    struct zs_shine shine;
    struct zs_shadow_map map;
    struct zs_depth_state bias;
    struct zs_scene scene, casters;
    struct zs_camera camera, light;
    uint16_t key[MAP * MAP];
};

static void set_lamp(struct place *s, struct prng *p, int kind)
{
    const int32_t from[3] = { prng_range(p, -700, 700), prng_range(p, 900, 1500), prng_range(p, -700, 700) };
    const double far = sqrt((double)from[0] * from[0] + (double)from[1] * from[1] + (double)from[2] * from[2]);
    s->lamp = (struct zs_lamp){ .kind = (uint8_t)kind, .strength = ZS_Q16_ONE / 4 * 3 };
    if (prng_pick(p, 2))
        s->lamp.range = 4000;
    for (int k = 0; k < 3; k++) {
        s->lamp.pos[k] = from[k];
        s->lamp.dir[k] = (zs_q2_30)lrint((kind == ZS_LAMP_SPOT ? -1.0 : 1.0) * from[k] / far * ZS_Q30_ONE);
    }
    s->lamp.inner = (zs_q2_30)lrint(cos(20 * PI / 180) * ZS_Q30_ONE);
    s->lamp.outer = (zs_q2_30)lrint(cos(30 * PI / 180) * ZS_Q30_ONE);
}

static int place_make(struct place *s, struct prng *p)
{
    static const struct place none;
    *s = none;
    for (int v = 0; v < 8; v++)
        for (int a = 0; a < 3; a++)
            box_normal[v][a] = (zs_q1_15)(box_pos[v][a] * 18918 / 50);
    const int kind = prng_pick(p, 3);
    set_lamp(s, p, kind);
    s->lighting = (struct zs_lighting){ .lamp = &s->lamp, .n_lamps = 1, .ambient = ZS_RGB(0x404040) };
    if (zs_shine_set(&s->shine, 24) != ZS_OK)
        return -1;
    s->other = (struct zs_lamp){ .rgb = ZS_RGB(0x4060c0), .dir = { 0, 858993459, 644245094 } };
    s->material = (struct zs_shadowed_phong){
        .lit = { .material = { .shader = &zs_shade_shadowed_lit, .rgb = ZS_RGB(0xf0e0d0), .texture = &texture },
                 .lighting = &s->lighting, .emission = ZS_RGB(0x000810), .specular = ZS_RGB(0x808080) },
        .map = { &s->map }
    };
    for (int k = 0; k < THINGS; k++) {
        struct zs_instance *in = &s->thing[k];
        in->mesh = k ? &box : &ground;
        in->material = &s->material.lit.material;
        zs_pose_identity(&in->pose);
        in->pose.scale = (zs_uq16_16)(k ? prng_range(p, 60000, 130000) : 6 * 65536);
        if (k) {
            zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
            for (int a = 0; a < 3; a++)
                in->pose.pos[a] = a == 1 ? prng_range(p, 180, 350) : prng_range(p, -330, 330);
        }
    }
    s->map = (struct zs_shadow_map){ .key = s->key, .w = MAP, .h = MAP, .soft = (uint8_t)prng_pick(p, 2) };
    s->bias = (struct zs_depth_state){ .bias = 8, .slope_bias = 544 };
    const int32_t at[3] = { 0, 60, 0 }, up[3] = { 1, 2, 3 };
    int32_t along[3];
    for (int k = 0; k < 3; k++)
        along[k] = at[k] - s->lamp.pos[k];
    int err = kind == ZS_LAMP_DIRECTIONAL ? zs_camera_orthographic(&s->light, 2000, 200, 4000)
                                          : zs_camera_perspective(&s->light, ZS_DEGREES(80), MAP, 300, 4000);
    err = err ? err : zs_camera_look_along(&s->light, s->lamp.pos, along, up);
    for (int k = 0; !err && kind == ZS_LAMP_DIRECTIONAL && k < 3; k++)
        s->lamp.dir[k] = s->light.rot[6 + k];
    err = err ? err : zs_camera_perspective(&s->camera, ZS_DEGREES(50), H, 100, 20000);
    err = err ? err : zs_camera_orbit(&s->camera, at, prng_range(p, 1100, 1500), (zs_turn)prng_next(p),
                                      (int16_t)prng_range(p, 3000, 12000));
    s->scene = (struct zs_scene){ .instance = s->thing, .n_instances = THINGS, .background = 0x001f };
    s->casters = (struct zs_scene){ .instance = s->caster,
                                    .n_instances = zs_shadow_casters(s->caster, s->thing, THINGS, &s->bias) };
    return err;
}

static int map_draw(struct place *s, struct prng *p)
{
    return map_drawn(&s->map, &s->casters, &s->light,
                     s->lamp.kind == ZS_LAMP_DIRECTIONAL ? &zs_depth_linear : &zs_depth_recip, p);
}

/* ---- Rays in doubles --------------------------------------------------------------------------- */

enum { LIT = 1, DARK = 2 };

/* Whether a point of a face is lit: both where the bias decides. texel: how wide one is there. */
static int lit(const struct place *s, const double at[3], double texel)
{
    double from[3], dir[3], nearest = 2, away = 0, slope = 0;
    int on = 0; /* flag: it lies on a face */
    const int flat = s->lamp.kind == ZS_LAMP_DIRECTIONAL;
    for (int a = 0; a < 3; a++) {
        from[a] = flat ? at[a] + 3000.0 * s->lamp.dir[a] / ZS_Q30_ONE : s->lamp.pos[a];
        dir[a] = at[a] - from[a];
        away += dir[a] * dir[a];
    }
    away = sqrt(away);
    for (int k = 0; k < n_faces; k++) {
        const double t = hit(&faces[k], from, dir);
        on |= fabs(t - 1) < 1e-6;
        if (t < nearest) {
            const double straight = -dot(faces[k].n, dir) / away;
            nearest = t;
            slope = sqrt(1 - straight * straight) / straight;
        }
    }
    const double gap = (1 - nearest) * away;
    if (!on)
        return LIT | DARK; /* beyond an edge of a thing either may be seen */
    return gap < 1e-6 * away ? LIT : gap > texel * (4 * slope + 4) + 4 ? DARK : LIT | DARK;
}

/* The same over a disc of some texels. */
static int lit_around(const struct place *s, const struct face *f, const double at[3])
{
    double away = 0, to[3];
    const int flat = s->lamp.kind == ZS_LAMP_DIRECTIONAL;
    for (int a = 0; a < 3; a++) {
        to[a] = flat ? s->lamp.dir[a] / (double)ZS_Q30_ONE : s->lamp.pos[a] - at[a];
        away += to[a] * to[a];
    }
    away = sqrt(away);
    const double straight = dot(f->n, to) / away;
    const double texel = flat ? 2000.0 / MAP : away * 2 * tan(40 * PI / 180) / MAP * 1.4;
    if (straight < 0.15)
        return LIT | DARK; /* hardly lit at all */
    double side[2][3];
    const double length = sqrt(dot(f->e1, f->e1));
    for (int a = 0; a < 3; a++)
        side[0][a] = f->e1[a] / length;
    for (int a = 0; a < 3; a++)
        side[1][a] = f->n[(a + 1) % 3] * side[0][(a + 2) % 3] - f->n[(a + 2) % 3] * side[0][(a + 1) % 3];
    int is = 0;
    for (int k = 0; k < 121 && is != (LIT | DARK); k++) {
        double moved[3];
        for (int a = 0; a < 3; a++)
            moved[a] = at[a] + texel / straight * 0.35 * ((k % 11 - 5) * side[0][a] + (k / 11 - 5) * side[1][a]);
        is |= lit(s, moved, texel);
    }
    return is;
}

/* ---- Pictures ---------------------------------------------------------------------------------- */

static int apart(uint16_t a, uint16_t b)
{
    const int r = abs((a >> 11) - (b >> 11)), g = abs((a >> 5 & 63) - (b >> 5 & 63)), u = abs((a & 31) - (b & 31));
    return r > g ? (r > u ? r : u) : g > u ? g : u;
}

_Static_assert(offsetof(struct zs_shadowed_phong, map) == offsetof(struct zs_shadowed_lit, map), "one for both");
_Static_assert(offsetof(struct place, other) == offsetof(struct place, lamp) + sizeof(struct zs_lamp), "one array");

/* The same by a shader without shadows: in the lamp's light, or without it. */
static struct picture plain(struct place *s, const struct zs_config *c, const struct zs_shader *shader, int dark)
{
    const struct zs_shader *own = s->material.lit.material.shader;
    const struct zs_lighting lighting = s->lighting;
    s->material.lit.material.shader = shader;
    s->lighting.lamp += dark;
    s->lighting.n_lamps -= (uint32_t)dark;
    const struct picture is = picture_draw(c, &s->scene, &s->camera);
    s->material.lit.material.shader = own;
    s->lighting = lighting;
    return is;
}

static unsigned lights[3], darks[3];

static int rays_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    CASE_CHECK(map_draw(&s, &p) == ZS_OK);
    struct zs_config c = picture_config(W, H, &zs_depth_float);
    static const struct {
        const struct zs_shader *shader, *plain;
    } ways[] = { { &zs_shade_shadowed_lit, &zs_shade_lit },
                 { &zs_shade_shadowed_texture, &zs_shade_texture_gloss },
                 { &zs_shade_shadowed_phong, &zs_shade_phong_near },
                 { &zs_shade_shadowed_texture_phong, &zs_shade_texture_phong } };
    const uint32_t way = prng_pick(&p, 4);
    c.varyings = 8;
    s.material.lit.material.shader = ways[way].shader;
    if (way >= 2) {
        s.material.lit.shine = &s.shine;
        s.lighting.n_lamps = 1 + prng_pick(&p, 2);
        s.material.lit.flags = prng_pick(&p, 2) ? ZS_LIT_NEAR_VIEWER : 0;
    }
    struct picture bright = plain(&s, &c, ways[way].plain, 0), dim = plain(&s, &c, ways[way].plain, 1);
    picture_any_way(&p, &c, 2, 6);
    struct picture is = picture_draw(&c, &s.scene, &s.camera);
    CASE_CHECK(is.err == ZS_OK && bright.err == ZS_OK && dim.err == ZS_OK);
    faces_make(s.thing, THINGS);
    int right = 1;
    for (int i = 0; right && i < W * H; i += 11) {
        double at[3], beside[3];
        const struct face *f = seen(&s.camera, W, H, i % W + 0.5, i / W + 0.5, at);
        int sure = f != NULL;
        for (int k = 0; sure && k < 4; k++)
            sure = seen(&s.camera, W, H, i % W + 0.5 + (k & 1 ? 0.05 : -0.05), i / W + 0.5 + (k & 2 ? 0.05 : -0.05),
                        beside) == f;
        const int want = sure ? lit_around(&s, f, at) : LIT | DARK;
        if (want == (LIT | DARK))
            continue;
        (want == LIT ? lights : darks)[s.lamp.kind]++;
        const uint16_t as = want == LIT ? bright.color[i] : dim.color[i];
        if (apart(is.color[i], as) > 1)
            right = case_wrong("(%d, %d), lamp %d, way %d, soft %d: %04x, not %04x; it should be %s", i % W, i / W,
                               s.lamp.kind, (int)way, s.map.soft, is.color[i], as, want == LIT ? "lit" : "dark");
    }
    PICTURES_FREE(&is, &bright, &dim);
    return right;
}

static void rays(void **state)
{
    (void)state;
    CASES(rays_case, 80);
    printf("  pixels, all right: directional %u lit, %u dark; point %u, %u; spot %u, %u\n", lights[0], darks[0],
           lights[1], darks[1], lights[2], darks[2]);
    for (int k = 0; cases_all() && k < 3; k++)
        assert_true(lights[k] > 500 && darks[k] > 50);
}

/* The place of an instance in the map takes the memory of a lit palette: accelerators must not take it for one. */
static int palette_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    static uint8_t index[16];
    for (int i = 0; i < 16; i++)
        index[i] = (uint8_t)(i * 5 % 16);
    const struct zs_texture lit_texture = { .format = &zs_texel_pal8, .texel = index, .palette = texels,
                                            .n_colors = 16, .log2_w = 2, .log2_h = 2 };
    const struct zs_material flat = { .shader = &zs_shade_texture_flat, .texture = &lit_texture };
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    CASE_CHECK(map_draw(&s, NULL) == ZS_OK);
    s.thing[0].material = s.thing[2].material = s.thing[4].material = &flat;
    for (int k = 1; k < THINGS; k++)
        s.thing[k].pose = s.thing[1].pose; /* the same light on all faces, one after the other */
    for (int k = 1; k < THINGS; k++)
        s.thing[k].pose.pos[0] = 130 * k - 300;
    struct zs_config c = picture_config(W, H, &zs_depth_float);
    c.varyings = 6;
    struct picture with = picture_draw(&c, &s.scene, &s.camera);
    c.fast = NULL;
    struct picture without = picture_draw(&c, &s.scene, &s.camera);
    return picture_drawn_alike(&without, &with, "accelerators");
}

static void drawn_with(const struct place *s, const struct zs_config *c, int err)
{
    assert_int_equal(picture_error(c, &s->scene, &s->camera), err);
}

/* What does not fit is refused by name. */
static void refusals(void **state)
{
    (void)state;
    static struct place s;
    struct prng p = { 5 };
    do
        assert_int_equal(place_make(&s, &p), ZS_OK);
    while (s.lamp.kind != ZS_LAMP_SPOT);
    struct zs_config c = picture_config(W, H, &zs_depth_float);
    c.varyings = 6;
    drawn_with(&s, &c, ZS_ERR_NULL); /* the map is not drawn */
    const struct zs_camera good = s.light;
    s.light.z_near = s.light.z_far / 16 * 15 + 65536;
    assert_int_equal(map_draw(&s, NULL), ZS_ERR_CAMERA);
    s.light = good;
    s.light.focal = (zs_uq32_32)(MAP / 4 - 1) << 32;
    assert_int_equal(map_draw(&s, NULL), ZS_ERR_CAMERA);
    s.light = good;
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    s.lighting.n_lamps = 0;
    drawn_with(&s, &c, ZS_ERR_RANGE);
    s.lighting.n_lamps = 1;
    struct zs_shadowed_material old = { .material = { .shader = &zs_shade_shadowed_flat }, .map = &s.map };
    s.thing[0].material = &old.material;
    drawn_with(&s, &c, ZS_ERR_CAMERA); /* it knows orthographic maps alone */
    s.thing[0].material = &s.material.lit.material;
    s.light.z_near = 65536; /* a step is more than a quarter of a texel there */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    drawn_with(&s, &c, ZS_ERR_RANGE);
}

/* ---- Walls before a lamp in the origin that looks down -z ----------------------------------------- */

static const int16_t wall_pos[4][3] = { { -100, -100, 0 }, { 100, -100, 0 }, { 100, 100, 0 }, { -100, 100, 0 } };
static const uint16_t wall_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const zs_q1_15 wall_normal[4][3] = { { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 } };
static const struct zs_mesh wall = { .pos = wall_pos, .tri = wall_tri, .normal = wall_normal, .n_verts = 4,
                                     .n_tris = 2, .radius = 142 };

/* How many of 256 pixels of a wall around (x, 0, -z), which faces the lamp and throws a shadow, are lit; or an error.
 * before: another wall, of half the size, before the lamp; NULL: none. */
static int wall_lit(const struct zs_shader *shader, const struct zs_camera *light, int32_t x, int32_t z, int32_t half,
                    const int32_t *before)
{
    static uint16_t key[MAP * MAP];
    struct zs_shadow_map map = { .key = key, .w = MAP, .h = MAP };
    const struct zs_depth_state bias = { .bias = 4, .slope_bias = 288 };
    const struct zs_lamp lamp = { .kind = ZS_LAMP_POINT };
    const struct zs_lighting lighting = { .lamp = &lamp, .n_lamps = 1 };
    const struct zs_shadowed_lit lit = { .lit = { .material = { .shader = shader, .rgb = ZS_RGB(0xffffff) },
                                                  .lighting = &lighting }, .map = &map };
    const struct zs_shadowed_phong phong = { .lit = lit.lit, .map = { &map } };
    const int each = shader == &zs_shade_shadowed_phong;
    struct zs_instance in[2] = { { .mesh = &wall, .pose.pos = { x, 0, -z } },
                                 { .mesh = &wall, .material = &zs_shadow_caster[0] } }, casters[2];
    in[0].material = each ? &phong.lit.material : &lit.lit.material;
    in[0].pose.scale = (zs_uq16_16)((int64_t)half * 65536 / 100);
    for (int k = 0; before && k < 3; k++)
        in[1].pose.pos[k] = before[k];
    const struct zs_scene scene = { .instance = in, .n_instances = 1 },
                          cast = { .instance = casters,
                                   .n_instances = zs_shadow_casters(casters, in, before ? 2 : 1, &bias) };
    struct zs_camera camera;
    int err = map_drawn(&map, &cast, light, &zs_depth_recip, NULL);
    err = err ? err : zs_camera_orthographic(&camera, half, 1, 4 * half + 1000);
    if (err)
        return err;
    camera.pos[0] = x;
    camera.pos[2] = -z + 2 * half + 100;
    struct zs_config c = picture_config(16, 16, &zs_depth_linear);
    c.varyings = 6;
    struct picture p = picture_draw(&c, &scene, &camera);
    int n = p.err;
    for (int k = 0; !p.err && k < p.w * p.h; k++)
        n += p.color[k] != 0;
    picture_free(&p);
    return n;
}

static void walls_at_the_ends_of_a_view(void **state)
{
    (void)state;
    static const struct zs_shader *const shaders[2] = { &zs_shade_shadowed_lit, &zs_shade_shadowed_phong };
    static const int32_t part[6] = { 900, 930, 970, 990, 994, 999 };
    const int32_t ahead[3] = { 100, 0, -500 }, aside[3] = { 500, 0, -500 };
    struct zs_camera light;
    for (int k = 0; k < 2; k++) {
        /* up to far, a wall is not in its own shadow */
        assert_int_equal(zs_camera_perspective(&light, ZS_DEGREES(60), MAP, 10, 10000), ZS_OK);
        for (int i = 0; i < 6; i++)
            assert_int_equal(wall_lit(shaders[k], &light, 0, 10 * part[i], 100, NULL), 256);
        /* beyond it, it is in that of what is before it, or lit; and never in that of what is elsewhere */
        assert_int_equal(zs_camera_perspective(&light, ZS_DEGREES(100), MAP, 100, 1000), ZS_OK);
        for (int32_t z = 700; z < 60000; z += z / 3) {
            const int behind = wall_lit(shaders[k], &light, z / 5, z, 5, ahead);
            assert_true(z > 2000 ? behind == 0 || behind == 256 : behind == 0);
            assert_int_equal(wall_lit(shaders[k], &light, -z / 5, z, 5, ahead), 256);
            assert_int_equal(wall_lit(shaders[k], &light, z / 2, z, 5, aside), 256);
        }
        /* where near is least of far, as near as that */
        assert_int_equal(zs_camera_perspective(&light, ZS_DEGREES(60), MAP, 1, 4096), ZS_OK);
        light.z_near = 85197; /* 1.3 */
        light.z_far = light.z_near << 12;
        for (int32_t z = 2; z < 5000; z *= 2) { /* varyings are too coarse for large walls */
            const int n = wall_lit(shaders[k], &light, 0, z, z / 2, NULL);
            assert_true(n == 256 || (n == ZS_ERR_RANGE && shaders[k] == &zs_shade_shadowed_lit && z > 2));
        }
        light.z_far += 4096;
        assert_int_equal(wall_lit(shaders[k], &light, 0, 10, 5, NULL), ZS_ERR_CAMERA);
        light.z_near = (zs_q48_16)ZS_WORLD_MAX * 65536;
        light.z_far = light.z_near << 12;
        if (light.z_far <= (zs_q48_16)ZS_FAR_MAX * 65536)
            (void)wall_lit(shaders[k], &light, 0, 10, 5, NULL);
        /* narrow views: what is far beside them is lit */
        assert_int_equal(zs_camera_perspective(&light, ZS_DEGREES(45), MAP, 100, 10000), ZS_OK);
        light.focal = ((zs_uq32_32)8191 << 32) + 0xffffffffu;
        for (int32_t x = 1000; x < 20000; x += 997)
            assert_int_equal(wall_lit(shaders[k], &light, x, 10000, 4, ahead), 256);
        light.focal++;
        assert_int_equal(wall_lit(shaders[k], &light, 0, 10, 5, NULL), ZS_ERR_CAMERA);
    }
}

/* In a map in which all is dark, as wide as may be: what is beside it, before near or too far away for it is lit. */
static void what_a_map_does_not_hold_is_lit(void **state)
{
    (void)state;
    uint16_t key[1] = { 0 };
    const struct zs_shadow_map map = { .key = key, .w = 1, .h = 1, .texels = 65536 / 4, .keys = 65535 << 8 };
    for (int32_t z = 1; z <= 1000; z++)
        assert_int_equal(zs_shadow_cone_share(&map, 0, 0, z, 1000), 256);
    for (int32_t z = 2000; z < 1 << 28; z += z / 3) /* two focal lengths aside */
        for (int32_t over = 2 * z - z / 100; over < 3 * z; over += z / 100)
            for (int k = 0; k < 4; k++) {
                const int32_t aside = k & 1 ? over : -over;
                assert_int_equal(zs_shadow_cone_share(&map, k & 2 ? aside : z, k & 2 ? z : aside, z, 1000),
                                 over < 2 * z ? 0 : 256);
            }
    assert_int_equal(zs_shadow_cone_share(&map, 0, 0, 1 << 29, 1000), 256);
}

static const struct CMUnitTest tests[] = { cmocka_unit_test(rays), CASES_TEST(palettes, palette_case, 20),
                                          cmocka_unit_test(refusals), cmocka_unit_test(walls_at_the_ends_of_a_view),
                                          cmocka_unit_test(what_a_map_does_not_hold_is_lit) };
CASES_MAIN(tests)
