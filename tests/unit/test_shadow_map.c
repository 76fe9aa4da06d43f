/* Shadow maps: what is lit, against rays to the light in doubles; colours where all is lit; odd maps and lights.
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
#include "zs_damage.h"
#include "zs_lines.h"
#include "zs_method.h"
#include "zs_shadow.h"

/* ---- Boxes on the ground ----------------------------------------------------------------------- */

#define BOXES 5
#define THINGS (BOXES + 1)
#define MAP_MAX 200

static const struct zs_mesh box = { .pos = box_pos, .tri = box_tri, .n_verts = 8, .n_tris = 12, .radius = 87 },
                            ground = {
                                .pos = ground_pos, .tri = ground_tri, .n_verts = 4, .n_tris = 2, .radius = 142
                            };

struct place {
    struct zs_instance thing[THINGS], caster[THINGS];
    struct zs_shadowed_material material;
    struct zs_shadow_map map;
    struct zs_depth_state bias;
    struct zs_scene scene, casters;
    struct zs_camera camera, sun;
    uint16_t key[MAP_MAX * MAP_MAX];
    double extent; /* of the light's view */
};

/* A light over the ground, from any side; the map may be smaller than the scene. */
static int place_make(struct place *s, struct prng *p)
{
    static const struct place none;
    *s = none;
    const int32_t unit = prng_pick(p, 2) ? 1 : 100; /* world units of a step, and so on */
    s->material = (struct zs_shadowed_material){
        .material = { .shader = &zs_shade_shadowed_flat, .rgb = ZS_RGB(0xf0e0d0) }, .map = &s->map
    };
    for (int k = 0; k < THINGS; k++) {
        struct zs_instance *in = &s->thing[k];
        in->mesh = k ? &box : &ground;
        in->material = &s->material.material;
        zs_pose_identity(&in->pose);
        in->pose.scale = (zs_uq16_16)(unit * (k ? prng_range(p, 60000, 200000) : 10 * 65536));
        if (k) {
            zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
            for (int a = 0; a < 3; a++)
                in->pose.pos[a] = unit * (a == 1 ? prng_range(p, 130, 400) : prng_range(p, -500, 500));
        }
    }
    int32_t dir[3], eye[3];
    const int32_t up[3] = { 1, 2, 3 }, at[3] = { 0, 100 * unit, 0 };
    do
        for (int a = 0; a < 3; a++)
            dir[a] = a == 1 ? -prng_range(p, 300, 1000) : prng_range(p, -900, 900);
    while (0);
    double to[3] = { dir[0], dir[1], dir[2] };
    unit_of(to);
    for (int a = 0; a < 3; a++)
        eye[a] = (int32_t)(at[a] - to[a] * 3000 * unit);
    const int32_t height = unit * prng_range(p, 1200, 3500);
    s->extent = height;
    s->map.key = s->key;
    s->map.w = (uint16_t)prng_range(p, 60, MAP_MAX);
    s->map.h = (uint16_t)prng_range(p, 60, MAP_MAX);
    s->map.soft = (uint8_t)prng_pick(p, 2);
    s->bias = (struct zs_depth_state){ .bias = 4, .slope_bias = (int16_t)(s->map.soft ? 544 : 288) };
    int err = zs_camera_orthographic(&s->sun, height, 100 * unit, 6000 * unit);
    err = err ? err : zs_camera_look_along(&s->sun, eye, dir, up);
    err = err ? err : zs_camera_perspective(&s->camera, ZS_DEGREES(50), 60, 100 * unit, 20000 * unit);
    err = err ? err
              : zs_camera_orbit(&s->camera, at, prng_range(p, 1200, 1800) * unit, (zs_turn)prng_next(p),
                                (int16_t)prng_range(p, 2000, 12000));
    s->scene = (struct zs_scene){ .instance = s->thing,
                                  .n_instances = THINGS,
                                  .background = 0x001f,
                                  .light = { .ambient = ZS_Q16_ONE / 4, .diffuse = ZS_Q16_ONE / 4 * 3 } };
    s->casters = (struct zs_scene){ .instance = s->caster,
                                    .n_instances = zs_shadow_casters(s->caster, s->thing, THINGS, &s->bias) };
    return err;
}

static int map_draw(struct place *s, struct prng *p)
{
    const int err = map_drawn(&s->map, &s->casters, &s->sun, &zs_depth_linear, p);
    if (!err)
        zs_shadow_map_light(&s->map, &s->scene.light);
    return err;
}

/* ---- Rays in doubles --------------------------------------------------------------------------- */

enum { LIT = 1, DARK = 2 };

/* Whether a point of a face is lit, moved by so many texels over the face's plane: LIT, DARK, or both where a caster is
 * so near that the bias decides. */
static int lit(const struct place *s, const struct face *f, const double at[3], double dx, double dy)
{
    const double texel = s->extent / s->map.h, bucket = (double)(s->sun.z_far - s->sun.z_near) / 65536 / 65535;
    double axis[3][3], to[3], from[3], rel[3];
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            axis[k][a] = s->sun.rot[3 * k + a] / (double)ZS_Q30_ONE; /* right, up, back */
    for (int a = 0; a < 3; a++)
        to[a] = axis[2][a];
    const double move[3] = { texel * (dx * axis[0][0] + dy * axis[1][0]), texel * (dx * axis[0][1] + dy * axis[1][1]),
                             texel * (dx * axis[0][2] + dy * axis[1][2]) };
    const double along = -dot(f->n, move) / dot(f->n, to); /* back onto the plane */
    for (int a = 0; a < 3; a++) {
        from[a] = at[a] + move[a] + along * to[a];
        rel[a] = from[a] - s->sun.pos[a];
    }
    if (fabs(dot(rel, axis[0])) > s->extent / 2 * s->map.w / s->map.h || fabs(dot(rel, axis[1])) > s->extent / 2)
        return LIT; /* beside the map */
    int is = LIT;
    for (int k = 0; k < n_faces; k++) {
        const struct face *c = &faces[k];
        /* from behind, towards the light: a caster's front is hit from the light's side */
        double start[3], down[3];
        for (int a = 0; a < 3; a++) {
            start[a] = from[a] + 1e6 * to[a];
            down[a] = -to[a];
        }
        if (dot(c->n, to) <= 0)
            continue;
        const double above = 1e6 - hit(c, start, down); /* how far it is above the point */
        if (isinf(above))
            continue;
        if (above > 1e-3 ? above + along < 0 : above + along > 0 && fabs(above) > 1e-3)
            is = LIT | DARK; /* at an edge of the face: a texel of another one decides, at the point's own distance */
        if (!(above > 1e-3))
            continue;
        const double gx = fabs(dot(c->n, axis[0]) / dot(c->n, to)), gy = fabs(dot(c->n, axis[1]) / dot(c->n, to));
        const double pushed = s->bias.bias * bucket + s->bias.slope_bias / 256.0 * texel * fmax(gx, gy) + 4 * bucket;
        if (above > pushed + texel * (gx + gy)) /* the texel's middle is elsewhere on the caster */
            return DARK;
        is = LIT | DARK;
    }
    return is;
}

/* ---- Pictures ---------------------------------------------------------------------------------- */

static unsigned lights, darks, edges, wrong_edges;

static int rays_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    const int w = 80, h = 60;
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    CASE_CHECK(map_draw(&s, &p) == ZS_OK);
    struct zs_config c = picture_config(w, h, &zs_depth_float);
    picture_any_way(&p, &c, 2, 6);
    struct picture is = picture_draw(&c, &s.scene, &s.camera);
    CASE_CHECK(is.err == ZS_OK);
    faces_make(s.thing, THINGS);
    int right = 1;
    for (int y = 0; right && y < h; y++)
        for (int x = y % 4; right && x < w; x += 4) {
            double at[3], beside[3];
            const struct face *f = seen(&s.camera, w, h, x + 0.5, y + 0.5, at);
            int sure = f != NULL;
            for (int k = 0; sure && k < 4; k++) /* not at an edge of the picture's triangles */
                sure = seen(&s.camera, w, h, x + 0.5 + (k & 1 ? 0.03 : -0.03), y + 0.5 + (k & 2 ? 0.03 : -0.03),
                            beside) == f;
            if (!sure)
                continue;
            const double slope = dot(f->n, (double[3]){ s.sun.rot[6], s.sun.rot[7], s.sun.rot[8] }) / ZS_Q30_ONE;
            if (slope < 0.05)
                continue; /* hardly lit at all */
            const uint32_t dim = (0xf0 * 257u / 4u * 31u + 32768u) / 65535u;
            const uint32_t red = is.color[y * w + x] >> 11;
            const uint32_t full = (uint32_t)(0xf0 / 255.0 * (0.25 + 0.75 * slope) * 31 + 0.5);
            const int got = red <= dim + (full - dim) / 2 ? DARK : LIT;
            const int want = lit(&s, f, at, 0, 0);
            int around = want;
            for (int k = 0; k < 49 && around != (LIT | DARK); k++)
                around |= lit(&s, f, at, 0.39 * (k % 7 - 3), 0.39 * (k / 7 - 3));
            if (around == (LIT | DARK)) {
                edges++;
                wrong_edges += want != (LIT | DARK) && got != want;
                continue;
            }
            lights += want == LIT;
            darks += want == DARK;
            if (want == LIT ? red + 1 < full || red > full + 1 : red != dim && slope > 0.1)
                right = case_wrong(
                    "(%d, %d) of face %d, slope %g, soft %d, map %d x %d has red %u of %u to %u, should be %s", x, y,
                    (int)(f - faces), slope, s.map.soft, s.map.w, s.map.h, red, dim, full,
                    want == LIT ? "lit" : "dark");
        }
    picture_free(&is);
    return right;
}

static void rays(void **state)
{
    (void)state;
    CASES(rays_case, 20);
    printf("  %u lit and %u dark pixels, all right; within a texel of an edge %u, %.1f %% of them on the other side\n",
           lights, darks, edges, 100.0 * wrong_edges / edges);
    if (cases_all())
        assert_true(lights > 5000 && darks > 500);
}

/* Map and picture are the same whatever strips, pools and accelerators are; the picture by other methods too. */
static int way_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    static uint16_t key[MAP_MAX * MAP_MAX];
    const struct zs_depth *const depths[3] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear };
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    CASE_CHECK(map_draw(&s, NULL) == ZS_OK);
    memcpy(key, s.key, sizeof key);
    struct zs_config c = picture_config(70, 50, depths[prng_pick(&p, 3)]);
    struct picture one = picture_draw(&c, &s.scene, &s.camera);
    CASE_CHECK(map_draw(&s, &p) == ZS_OK);
    CASE_CHECK(!memcmp(key, s.key, sizeof key));
    picture_any_way(&p, &c, 2, 6);
    int right = picture_again(&one, &c, &s.scene, &s.camera, "another way");
    const struct zs_config usual = picture_config(70, 50, c.depth);
    c = usual;
    c.method = prng_pick(&p, 2) ? &zs_method_raycast : &zs_method_hiz;
    struct picture other = picture_draw(&c, &s.scene, &s.camera);
    right = right && !other.err && !memcmp(one.color, other.color, 70 * 50 * sizeof other.color[0]);
    PICTURES_FREE(&one, &other);
    return right || case_wrong("another method");
}

/* Where nothing throws shadows, the colours are those of the library's lit shaders. */
static int colors_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct place s;
    static zs_q1_15 normal[8][3];
    CASE_CHECK(place_make(&s, &p) == ZS_OK);
    s.casters.n_instances = 0;
    CASE_CHECK(map_draw(&s, &p) == ZS_OK);
    struct zs_config c = picture_config(70, 50, &zs_depth_float);
    c.varyings = 4;
    struct picture is = picture_draw(&c, &s.scene, &s.camera);
    struct zs_material plain = { .shader = &zs_shade_flat, .rgb = s.material.material.rgb };
    for (int k = 0; k < THINGS; k++)
        s.thing[k].material = &plain;
    struct picture want = picture_draw(&c, &s.scene, &s.camera);
    int right = picture_same(&is, &want, "flat");
    PICTURES_FREE(&is, &want);

    struct zs_mesh round = box;
    for (int v = 0; v < 8; v++)
        for (int a = 0; a < 3; a++)
            normal[v][a] = (zs_q1_15)(box_pos[v][a] * 18918 / 50);
    round.normal = (const zs_q1_15(*)[3])normal;
    s.scene.instance++;
    s.scene.n_instances--;
    s.material.material.shader = &zs_shade_shadowed_smooth;
    for (int k = 1; k < THINGS; k++) {
        s.thing[k].mesh = &round;
        s.thing[k].material = &s.material.material;
    }
    is = picture_draw(&c, &s.scene, &s.camera);
    plain.shader = &zs_shade_smooth;
    for (int k = 1; k < THINGS; k++)
        s.thing[k].material = &plain;
    want = picture_draw(&c, &s.scene, &s.camera);
    right = right && !is.err && !want.err;
    for (int k = 0; right && k < is.w * is.h; k++) {
        const uint32_t a = is.color[k], b = want.color[k];
        right = abs((int)(a >> 11) - (int)(b >> 11)) <= 1 && abs((int)(a >> 5 & 63u) - (int)(b >> 5 & 63u)) <= 1 &&
                abs((int)(a & 31u) - (int)(b & 31u)) <= 1;
    }
    PICTURES_FREE(&is, &want);
    return right || case_wrong("colours");
}

/* ---- Odd maps and lights ----------------------------------------------------------------------- */

static uint32_t darker(const struct place *s)
{
    const struct zs_config c = picture_config(80, 60, &zs_depth_float);
    struct picture is = picture_draw(&c, &s->scene, &s->camera);
    uint32_t n = 0;
    assert_int_equal(is.err, ZS_OK);
    for (int k = 0; k < is.w * is.h; k++)
        n += is.color[k] >> 11 == (0xf0 * 257u / 4u * 31u + 32768u) / 65535u;
    picture_free(&is);
    return n;
}

static void stress_47_odd_maps_and_lights(void **state)
{
    (void)state;
    static struct place s;
    struct prng p = { 3 };
    assert_int_equal(place_make(&s, &p), ZS_OK);
    s.scene.n_instances = s.casters.n_instances = 1; /* the ground alone: all lit */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    assert_int_equal(darker(&s), 0);
    s.bias.bias = INT16_MAX; /* keys stop at the largest one: no shadow anywhere */
    s.scene.n_instances = s.casters.n_instances = THINGS;
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    s.scene.n_instances = 1;
    assert_true(darker(&s) < 50 * 60);
    s.bias.bias = INT16_MIN; /* keys stop at 0: all that the light sees is dark */
    s.bias.slope_bias = INT16_MIN;
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    assert_true(darker(&s) > 0);
    s.bias = (struct zs_depth_state){ .bias = 4, .slope_bias = 512 };

    s.map.w = s.map.h = 1; /* a map of one texel */
    for (s.map.soft = 0; s.map.soft < 2; s.map.soft++) {
        assert_int_equal(map_draw(&s, NULL), ZS_OK);
        (void)darker(&s);
    }
    s.map.w = s.map.h = 64;
    s.map.soft = 0;

    const int32_t level[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 }, below[3] = { 0, 1, 0 }, side[3] = { 1, 0, 0 },
                  aside[3] = { 400000000, 0, 400000000 };
    const int32_t *const eye = s.sun.pos;
    const int32_t from[3] = { eye[0], eye[1], eye[2] };
    assert_int_equal(zs_camera_look_along(&s.sun, from, level, up), ZS_OK); /* along the ground, which is not lit */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    assert_true(darker(&s) > 500);
    assert_int_equal(zs_camera_look_along(&s.sun, from, below, side), ZS_OK); /* from below */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    assert_true(darker(&s) > 500);
    const int32_t down[3] = { 0, -1, 0 };
    assert_int_equal(zs_camera_look_along(&s.sun, aside, down, side), ZS_OK); /* all is outside its view: lit */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    assert_int_equal(darker(&s), 0);
}

/* Between four texels, of which one at a time is lit, the light is what is left of it by where the point lies. */
static void light_between_four_texels(void **state)
{
    (void)state;
    for (int lit_one = 0; lit_one < 4; lit_one++) {
        uint16_t key[4] = { 0, 0, 0, 0 };
        const struct zs_shadow_map map = { .key = key, .w = 2, .h = 2, .soft = 1 };
        key[lit_one] = 9;
        for (uint32_t y = 0; y < 16; y++)
            for (uint32_t x = 0; x < 16; x++) {
                const uint32_t across = lit_one & 1 ? x : 16 - x, down = lit_one & 2 ? y : 16 - y;
                assert_int_equal(zs_shadow_share(&map, 32768 + 4096 * (int32_t)x, 32768 + 4096 * (int32_t)y, 5),
                                 across * down);
            }
    }
}

/* A mesh whose sphere is wrong: a vertex far outside of it has a place all the same, at the end of its range. */
static void a_vertex_far_outside_its_sphere(void **state)
{
    (void)state;
    static struct place s;
    struct prng p = { 4 };
    static const int16_t far[4][3] = { { -32768, 0, 32767 }, { 32767, 0, 32767 }, { 32767, 0, -32768 },
                                       { -32768, 0, -32768 } };
    static const int16_t middle[2][3] = { { 32767, 0, -32768 }, { 0 } };
    for (int k = 0; k < 4; k++) {
        assert_int_equal(place_make(&s, &p), ZS_OK);
        assert_int_equal(map_draw(&s, NULL), ZS_OK);
        struct zs_mesh wrong = ground;
        wrong.pos = far;
        wrong.radius = (uint16_t)(k & 1);
        memcpy(wrong.center, middle[k / 2], sizeof wrong.center);
        s.thing[0].mesh = &wrong;
        s.thing[0].pose.scale = 65536;
        s.scene.n_instances = 1;
        const struct zs_config c = picture_config(80, 60, &zs_depth_float);
        struct picture is = picture_draw(&c, &s.scene, &s.camera);
        assert_int_equal(is.err, ZS_OK);
        picture_free(&is);
    }
}

static void errors(void **state)
{
    (void)state;
    static struct place s;
    struct prng p = { 4 };
    struct zs_renderer r;
    static uint32_t arena[100000];
    assert_int_equal(place_make(&s, &p), ZS_OK);
    struct zs_config c = {
        .width = s.map.w, .height = s.map.h, .strip_h = 8, .max_tris = 99, .max_verts = 99, .depth = &zs_depth_linear
    };
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_shadow_map_draw(NULL, &r, &s.casters, &s.sun), ZS_ERR_NULL);
    assert_int_equal(zs_shadow_map_draw(&s.map, NULL, &s.casters, &s.sun), ZS_ERR_NULL);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, NULL, &s.sun), ZS_ERR_NULL);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.camera), ZS_ERR_DEPTH);
    s.map.w++;
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_SIZE);
    s.map.w--;
    s.map.h++;
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_SIZE);
    s.map.h--;
    uint16_t *const key = s.map.key;
    s.map.key = NULL;
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_NULL);
    s.map.key = key;
    s.sun.pos[0] = INT32_MIN;
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_RANGE);
    assert_int_equal(s.map.drawn, 0);
    s.sun.pos[0] = 0;
    static uint32_t memory[ZS_DAMAGE_WORDS(THINGS, MAP_MAX, 1)];
    assert_int_equal(zs_damage_track(&r, memory, THINGS), ZS_OK);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    c.method = &zs_method_hiz;
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_DEPTH);
    c.method = NULL;
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    static uint64_t sums[MAP_MAX * MAP_MAX];
    struct zs_strip_hashes hashes;
    assert_int_equal(damage_compare_anew(&r, &hashes, sums, 1), ZS_OK);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_SEQUENCE);
    c.depth = &zs_depth_none;
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_shadow_map_draw(&s.map, &r, &s.casters, &s.sun), ZS_ERR_DEPTH);

    struct zs_config draw = picture_config(80, 60, &zs_depth_float);
#define REFUSED_WITH(error) assert_int_equal(picture_error(&draw, &s.scene, &s.camera), error)
    REFUSED_WITH(ZS_ERR_NULL); /* not drawn yet */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    REFUSED_WITH(ZS_OK);
    s.material.map = NULL;
    REFUSED_WITH(ZS_ERR_NULL);
    s.material.map = &s.map;
    s.map.key = NULL;
    REFUSED_WITH(ZS_ERR_NULL);
    s.map.key = key;
    s.sun.height /= 5000; /* a texel is less than four steps */
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    REFUSED_WITH(ZS_ERR_RANGE);
    s.sun.height *= 5000;
    s.sun.z_far = s.sun.z_near + (s.sun.z_far - s.sun.z_near) / 5000;
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    REFUSED_WITH(ZS_ERR_RANGE);
    s.sun.z_far = s.sun.z_near + (s.sun.z_far - s.sun.z_near) * 5000;
    assert_int_equal(map_draw(&s, NULL), ZS_OK);
    draw.varyings = 2;
    REFUSED_WITH(ZS_ERR_VARYINGS);
    draw.varyings = 3;
    s.material.material.shader = &zs_shade_shadowed_smooth;
    REFUSED_WITH(ZS_ERR_VARYINGS);
    draw.varyings = 4;
    REFUSED_WITH(ZS_ERR_MESH);
#undef REFUSED_WITH
}

/* What cannot cast a shadow is left out: without a material, lines and points, a cull that there is not. */
static void casters_are_chosen(void **state)
{
    (void)state;
    static const struct zs_lines lines;
    static const struct zs_mesh mesh;
    const struct zs_material good = { .shader = &zs_shade_flat, .cull = ZS_CULL_NONE };
    const struct zs_material odd = { .shader = &zs_shade_flat, .cull = ZS_CULL_NONE + 1 };
    const struct zs_material line = { .shader = &zs_shade_flat, .primitive = &lines.primitive };
    const struct zs_instance in[5] = { { .mesh = &mesh }, { .mesh = &mesh, .material = &line },
                                       { .mesh = &mesh, .material = &good, .pose = { .pos = { 7, 8, 9 } } },
                                       { .mesh = &mesh, .material = &odd }, { .mesh = &mesh, .material = &good } };
    static const struct zs_depth_state bias;
    struct zs_instance out[5];
    assert_int_equal(zs_shadow_casters(out, in, 5, &bias), 2);
    assert_memory_equal(&out[0].pose, &in[2].pose, sizeof out[0].pose);
    assert_ptr_equal(out[0].mesh, &mesh);
    assert_ptr_equal(out[0].depth_state, &bias);
    assert_memory_equal(&out[1].pose, &in[4].pose, sizeof out[1].pose);
}

/* A light of zeros is the usual one; with the map's direction it is as bright. */
static void the_maps_light(void **state)
{
    (void)state;
    const struct zs_shadow_map map = { .rot = { 0, 0, 0, 0, 0, 0, 11, -22, 33 } };
    const zs_q2_30 dir[3] = { -11, 22, -33 };
    struct zs_light light = { .ambient = 0 }, own = { .ambient = 5 };
    zs_shadow_map_light(&map, &light);
    assert_memory_equal(light.dir, dir, sizeof dir);
    assert_int_equal(light.ambient, ZS_Q16_ONE / 4);
    assert_int_equal(light.diffuse, ZS_Q16_ONE / 4 * 3);
    zs_shadow_map_light(&map, &own);
    assert_memory_equal(own.dir, dir, sizeof dir);
    assert_int_equal(own.ambient, 5);
    assert_int_equal(own.diffuse, 0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rays),
    cmocka_unit_test(casters_are_chosen),
    CASES_TEST(any_way, way_case, 60),
    CASES_TEST(colors_without_casters, colors_case, 60),
    cmocka_unit_test(stress_47_odd_maps_and_lights),
    cmocka_unit_test(light_between_four_texels),
    cmocka_unit_test(a_vertex_far_outside_its_sphere),
    cmocka_unit_test(the_maps_light),
    cmocka_unit_test(errors),
};
CASES_MAIN(tests)
