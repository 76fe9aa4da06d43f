/* Lights (effect/lights.c, lit.c, lit_phong.c, lit_texture.c) against the formula of zs_lights.h in double precision: at
 * points, and pixel by pixel on frames; the same frame in any way of drawing it; what is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "../lab/fuzz/world.h"
#include "picture.h"
#include "zs_lights.h"

/* ---- The formula ------------------------------------------------------------------------------ */

struct place {
    double pos[3], n[3], eye[3], axis[3]; /* world; n of any length; axis: unit, to a distant viewer */
    int distant;                          /* orthographic */
    double edge; /* out: how near it is to where the formula jumps, as a cosine */
};

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double lamp_left(const struct zs_lamp *lamp, struct place *at, double l[3])
{
    if (lamp->kind == ZS_LAMP_DIRECTIONAL) {
        for (int k = 0; k < 3; k++)
            l[k] = q30(lamp->dir[k]);
        return 1;
    }
    for (int k = 0; k < 3; k++)
        l[k] = lamp->pos[k] - at->pos[k];
    const double d = sqrt(dot3(l, l));
    if (d < 0x1p-3)
        at->edge = 0;
    if (d == 0)
        return 0;
    unit3(l);
    double left = 1;
    if (lamp->range) {
        const double t = 1 - d * d / ((double)lamp->range * lamp->range);
        left *= t < 0 ? 0 : t * t;
    }
    if (lamp->half)
        left /= 1 + d * d / ((double)lamp->half * lamp->half);
    if (lamp->kind == ZS_LAMP_SPOT) {
        double c = 0;
        for (int k = 0; k < 3; k++)
            c -= l[k] * q30(lamp->dir[k]);
        const double t = fmin(1, fmax(0, (c - q30(lamp->outer)) / (q30(lamp->inner) - q30(lamp->outer))));
        left *= t * t * (3 - 2 * t);
    }
    return left;
}

/* The colour, 0 .. 1. turned: the side that is seen is the other one. */
static void formula(const struct zs_lit_material *m, unsigned power, struct zs_rgb rgb, struct place *at, int turned,
                    double out[3])
{
    const struct zs_lighting *lights = m->lighting;
    const uint8_t base[3] = { rgb.r, rgb.g, rgb.b }, specular[3] = { m->specular.r, m->specular.g, m->specular.b };
    const uint8_t ambient[3] = { lights->ambient.r, lights->ambient.g, lights->ambient.b };
    const uint8_t emission[3] = { m->emission.r, m->emission.g, m->emission.b };
    double n[3], v[3], to_eye[3], diffuse[3], shine[3] = { 0, 0, 0 };
    const int none = dot3(at->n, at->n) == 0;
    at->edge = 1;
    for (int k = 0; k < 3; k++) {
        n[k] = turned ? -at->n[k] : at->n[k];
        to_eye[k] = at->distant ? at->axis[k] : at->eye[k] - at->pos[k];
        diffuse[k] = ambient[k] / 255.0;
    }
    if (!none)
        unit3(n);
    unit3(to_eye);
    memcpy(v, m->flags & ZS_LIT_NEAR_VIEWER ? to_eye : at->axis, sizeof v);
    for (uint32_t i = 0; i < lights->n_lamps && !none; i++) {
        const struct zs_lamp *lamp = &lights->lamp[i];
        const struct zs_rgb white = { 255, 255, 255 }, c = lamp->rgb.r | lamp->rgb.g | lamp->rgb.b ? lamp->rgb : white;
        const double color[3] = { c.r / 255.0, c.g / 255.0, c.b / 255.0 };
        double l[3], h[3], gloss = 0;
        const double left = lamp_left(lamp, at, l) * (lamp->strength ? lamp->strength / 65536.0 : 1);
        const double nl = dot3(n, l);
        if (left > 0)
            at->edge = fmin(at->edge, fabs(nl));
        if (nl <= 0)
            continue;
        for (int k = 0; k < 3; k++)
            h[k] = m->flags & ZS_LIT_REFLECT ? 2 * nl * n[k] - l[k] : l[k] + v[k];
        if (dot3(h, h) > 1e-12) {
            if (!(m->flags & ZS_LIT_REFLECT)) {
                at->edge = fmin(at->edge, dot3(h, h));
                unit3(h);
            }
            gloss = pow(fmax(0, m->flags & ZS_LIT_REFLECT ? dot3(h, v) : dot3(n, h)), power);
        }
        for (int k = 0; k < 3; k++) {
            diffuse[k] += color[k] * left * nl;
            shine[k] += color[k] * left * gloss;
        }
    }
    for (int k = 0; k < 3; k++)
        out[k] = fmin(1, base[k] / 255.0 * diffuse[k] + (m->shine ? specular[k] / 255.0 * shine[k] : 0) +
                             emission[k] / 255.0);
}

/* ---- Random lights ---------------------------------------------------------------------------- */

static struct zs_rgb any_rgb(struct prng *p)
{
    const uint32_t c = prng_pick(p, 4) ? prng_next(p) & 0xffffffu : 0xffffffu;
    return (struct zs_rgb)ZS_RGB(c);
}

static void any_unit(struct prng *p, zs_q2_30 out[3])
{
    int32_t v[3];
    do
        for (int k = 0; k < 3; k++)
            v[k] = prng_range(p, -999, 999);
    while (zs_unit(out, v));
}

struct lights {
    struct zs_lamp lamp[ZS_LIGHTS_MAX];
    struct zs_lighting lighting;
    struct zs_shine shine;
    struct zs_lit_material material;
    unsigned power;
};

/* Lamps around a point, up to `reach` world units away. */
static void any_lights(struct lights *l, struct prng *p, const int32_t around[3], int32_t reach, int kinds, unsigned flags)
{
    memset(l, 0, sizeof *l);
    l->lighting.n_lamps = (uint32_t)prng_range(p, 0, ZS_LIGHTS_MAX);
    l->lighting.lamp = l->lamp;
    if (prng_pick(p, 2))
        l->lighting.ambient = (struct zs_rgb)ZS_RGB(prng_next(p) & 0x3f3f3fu);
    for (uint32_t i = 0; i < l->lighting.n_lamps; i++) {
        struct zs_lamp *lamp = &l->lamp[i];
        lamp->kind = (uint8_t)prng_pick(p, (uint32_t)kinds);
        lamp->rgb = prng_pick(p, 3) ? any_rgb(p) : (struct zs_rgb){ 0, 0, 0 };
        lamp->strength = prng_pick(p, 3) ? prng_pick(p, ZS_Q16_ONE + 1) : prng_pick(p, 4) * ZS_Q16_ONE;
        any_unit(p, lamp->dir);
        for (int k = 0; k < 3; k++)
            lamp->pos[k] = around[k] + prng_range(p, -reach, reach);
        lamp->range = prng_pick(p, 2) ? (uint32_t)prng_range(p, 1, 3 * reach) : 0;
        lamp->half = prng_pick(p, 2) ? (uint32_t)prng_range(p, 1, 2 * reach) : 0;
        lamp->inner = prng_range(p, -ZS_Q30_ONE / 2, ZS_Q30_ONE);
        lamp->outer = (zs_q2_30)(lamp->inner - prng_range(p, ZS_Q30_ONE / 256, ZS_Q30_ONE / 2));
    }
    l->power = prng_pick(p, 3) ? (unsigned)prng_range(p, 1, 128) : 1u << prng_pick(p, 8);
    l->material.lighting = &l->lighting;
    l->material.specular = any_rgb(p);
    if (prng_pick(p, 3) == 0)
        l->material.emission = (struct zs_rgb)ZS_RGB(prng_next(p) & 0x1f1f1fu);
    l->material.material.rgb = any_rgb(p);
    l->material.flags = (uint8_t)(prng_pick(p, 8) & flags);
    if (prng_pick(p, 4) && zs_shine_set(&l->shine, l->power) == ZS_OK)
        l->material.shine = &l->shine;
}

static struct {
    unsigned long n, beyond_two;
    double worst;
} tally;

/* Count how far a value is off, in codes: `most` is full. */
static int counted(double is, double want, int most)
{
    const double off = fabs(is - want) * most;
    tally.n++;
    tally.beyond_two += off > 2;
    tally.worst = fmax(tally.worst, off);
    return off <= 3;
}

static void tally_begin(void)
{
    memset(&tally, 0, sizeof tally);
}

static void tally_end(const char *name)
{
    print_message("%s: %lu values, %lu beyond two codes, worst %.2f\n", name, tally.n, tally.beyond_two, tally.worst);
    assert_true(tally.beyond_two * 1000 <= tally.n);
}

/* ---- At points -------------------------------------------------------------------------------- */

static void world_of(const struct zs_instance *in, const double p[3], double out[3], int turn_only)
{
    const double scale = (in->mesh->scale ? in->mesh->scale : 65536) / 65536.0 *
                         (in->pose.scale ? in->pose.scale : 65536) / 65536.0;
    int any = 0;
    for (int k = 0; k < 9; k++)
        any |= in->pose.rot[k] != 0;
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int j = 0; j < 3; j++)
            sum += (any ? q30(in->pose.rot[3 * k + j]) : k == j) * p[j];
        out[k] = turn_only ? sum : sum * scale + in->pose.pos[k];
    }
}

static unsigned long lit_points;

/* A mesh of random scale and pose, lamps within a few of its sizes, normals of any length. */
static int point_case(uint64_t seed)
{
    struct prng p = { seed };
    struct lights l;
    struct zs_mesh mesh = { .scale = prng_pick(&p, 4) ? ZS_Q16_ONE : 1u << prng_range(&p, 6, 26) };
    struct zs_instance in = { .mesh = &mesh, .material = &l.material.material };
    struct zs_camera camera;
    struct place at;
    const int32_t steps = prng_pick(&p, 2) ? 100 : 32767;
    CASE_CHECK(zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 1, 40000) == ZS_OK);
    camera.projection = prng_pick(&p, 4) ? ZS_PERSPECTIVE : ZS_ORTHOGRAPHIC;
    const double size = steps * (mesh.scale / 65536.0);
    const int32_t reach = (int32_t)fmin(fmax(4 * size, 2), 1 << 28);
    for (int k = 0; k < 3; k++) {
        in.pose.pos[k] = prng_range(&p, -1000, 1000);
        camera.pos[k] = in.pose.pos[k] + prng_range(&p, -2 * reach, 2 * reach);
    }
    if (prng_pick(&p, 4))
        zs_pose_turn(&in.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    struct zs_pose turn = { .scale = 0 };
    zs_pose_turn(&turn, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), 0);
    memcpy(camera.rot, turn.rot, sizeof camera.rot);
    any_lights(&l, &p, in.pose.pos, reach, 3, 7);
    CASE_CHECK(zs_lighting_check(&l.lighting) == ZS_OK);
    const struct zs_shading s = { .instance = &in, .camera = &camera };
    for (int i = 0; i < 20; i++) {
        double local[3], n[3], want[3];
        zs_q1_15 normal[3];
        int32_t point[3];
        uint16_t is[3];
        for (int k = 0; k < 3; k++) {
            point[k] = prng_range(&p, -steps * 256, steps * 256);
            local[k] = point[k] / 256.0;
            n[k] = prng_range(&p, -999, 999);
        }
        n[0] += n[0] == 0;
        unit3(n);
        const double length = prng_pick(&p, 4) ? 32767 : prng_range(&p, 300, 32767);
        for (int k = 0; k < 3; k++) {
            normal[k] = (zs_q1_15)lrint(n[k] * length);
            n[k] = normal[k];
            at.eye[k] = camera.pos[k];
            at.axis[k] = q30(camera.rot[6 + k]);
        }
        at.distant = camera.projection == ZS_ORTHOGRAPHIC;
        world_of(&in, local, at.pos, 0);
        world_of(&in, n, at.n, 1);
        double to[3];
        for (int k = 0; k < 3; k++)
            to[k] = at.distant ? at.axis[k] : at.eye[k] - at.pos[k];
        const double side = dot3(at.n, to) / sqrt(dot3(at.n, at.n) * dot3(to, to));
        formula(&l.material, l.power, l.material.material.rgb, &at,
                l.material.flags & ZS_LIT_TWO_SIDED && side < 0, want);
        if (at.edge < 0x1p-11 || (l.material.flags & ZS_LIT_TWO_SIDED && fabs(side) < 0x1p-11) ||
            sqrt(dot3(to, to)) < 0.125)
            continue;
        double nearest = 1e9;
        for (uint32_t j = 0; j < l.lighting.n_lamps; j++)
            if (l.lamp[j].kind != ZS_LAMP_DIRECTIONAL) {
                double d[3];
                for (int k = 0; k < 3; k++)
                    d[k] = l.lamp[j].pos[k] - at.pos[k];
                nearest = fmin(nearest, sqrt(dot3(d, d)));
            }
        if (nearest * 64 < mesh.scale / 65536.0)
            continue;
        zs_lit_color(&s, l.material.material.rgb, point, normal, is);
        lit_points++;
        for (int k = 0; k < 3; k++)
            if (!counted(is[k] / 65535.0, want[k], 63))
                return case_wrong("point %d channel %d: %.4f in place of %.4f (power %u, flags %u, edge %g)", i, k,
                                  is[k] / 65535.0 * 63, want[k] * 63, l.power, l.material.flags, at.edge);
    }
    return 1;
}

static void is_the_formula_at_points(void **state)
{
    (void)state;
    lit_points = 0;
    tally_begin();
    CASES(point_case, 4000);
    if (getenv("ZS_SEED"))
        return;
    tally_end("points");
    assert_true(lit_points > 40000);
}

static int shine_case(uint64_t seed)
{
    struct prng p = { seed };
    struct lights l;
    const struct zs_camera camera = { .projection = ZS_ORTHOGRAPHIC, .rot = { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE } };
    const int32_t zero[3] = { 0, 0, 0 };
    struct zs_mesh mesh = { .scale = 0 };
    struct zs_instance in = { .mesh = &mesh, .material = &l.material.material };
    const struct zs_shading s = { .instance = &in, .camera = &camera };
    memset(&l, 0, sizeof l);
    l.power = (unsigned)(seed < 256 ? seed : 1 + prng_pick(&p, 255));
    CASE_CHECK(zs_shine_set(&l.shine, l.power) == ZS_OK);
    l.lamp[0].dir[2] = ZS_Q30_ONE;
    l.lighting = (struct zs_lighting){ l.lamp, 1, { 0, 0, 0 } };
    l.material = (struct zs_lit_material){ .lighting = &l.lighting, .shine = &l.shine, .specular = { 255, 255, 255 } };
    for (int i = 0; i <= 100; i++) { /* angles up to where the power is 1/300 */
        const double a = acos(pow(300, -1.0 / l.power)) * i / 100;
        const zs_q1_15 n[3] = { (zs_q1_15)lrint(sin(a) * 32767), 0, (zs_q1_15)lrint(cos(a) * 32767) };
        uint16_t is[3];
        zs_lit_color(&s, (struct zs_rgb){ 0, 0, 0 }, zero, n, is);
        const double want = pow(n[2] / hypot(n[0], n[2]), l.power);
        if (!counted(is[1] / 65535.0, want, 63) || fabs(is[1] / 65535.0 - want) * 63 > 1.5)
            return case_wrong("power %u, %d: %g in place of %g", l.power, i, is[1] / 65535.0, want);
    }
    return 1;
}

static void all_powers(void **state)
{
    (void)state;
    tally_begin();
    CASES(shine_case, 255);
    if (!getenv("ZS_SEED"))
        tally_end("powers");
}

/* ---- On frames -------------------------------------------------------------------------------- */

#define W 96
#define H 72

/* Where the ray of a pixel meets the plane of three points: their shares in it. Return 0 outside of them. */
static int shares(double corner[3][3], const double ray[3], double share[3])
{
    double n[3], e[3][3];
    for (int k = 0; k < 3; k++) {
        e[0][k] = corner[1][k] - corner[0][k];
        e[1][k] = corner[2][k] - corner[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
    const double t = dot3(n, corner[0]) / dot3(n, ray);
    for (int i = 0; i < 3; i++) {
        double a[3], b[3], c[3];
        for (int k = 0; k < 3; k++) {
            a[k] = corner[(i + 1) % 3][k] - t * ray[k];
            b[k] = corner[(i + 2) % 3][k] - t * ray[k];
        }
        for (int k = 0; k < 3; k++)
            c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        share[i] = dot3(c, n) / dot3(n, n);
        if (share[i] < 0)
            return 0;
    }
    return t > 0;
}

static unsigned long lit_pixels, blocks;

/* One triangle, seen under perspective, mostly with normals up to 60 degrees apart. */
static int frame_case(uint64_t seed, int kind)
{
    struct prng p = { seed };
    struct lights l;
    int16_t pos[3][3];
    zs_q1_15 normal[3][3];
    static const uint16_t tri[1][3] = { { 0, 1, 2 } };
    struct zs_mesh mesh = { .pos = pos, .tri = tri, .normal = normal, .n_verts = 3, .n_tris = 1, .radius = 65535 };
    struct zs_instance in = { .mesh = &mesh, .material = &l.material.material };
    struct zs_camera camera;
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    const int32_t around[3] = { 0, 0, -1500 };
    const unsigned flags = kind == 0 ? ZS_LIT_REFLECT | ZS_LIT_TWO_SIDED : 7;
    const int spread = prng_pick(&p, 4) ? 300 : 900, deep = prng_pick(&p, 2);
    const double slack = 0.02;
    if (zs_camera_perspective(&camera, ZS_DEGREES(60), H, 100, 40000))
        return case_wrong("camera");
    any_lights(&l, &p, around, 3000, kind == 1 ? 3 : 1, flags);
    if (kind == 0 && prng_pick(&p, 3)) {
        l.lighting.n_lamps = 1;
        l.material.flags &= ZS_LIT_TWO_SIDED;
        any_unit(&p, l.lamp[0].dir);
        if (prng_pick(&p, 2)) {
            l.lamp[0].dir[2] = abs(l.lamp[0].dir[2]);
            l.lamp[0].strength = 0;
        }
    }
    l.material.material.shader = kind == 0 ? &zs_shade_phong : &zs_shade_phong_near;
    l.material.material.cull = ZS_CULL_NONE;
    double middle[3] = { prng_range(&p, -500, 500), prng_range(&p, -500, 500), 500 };
    for (int v = 0; v < 3; v++) {
        const int32_t z = deep ? prng_range(&p, 300, 6000) : 1500 + prng_range(&p, -300, 300);
        double n[3];
        pos[v][2] = (int16_t)-z;
        for (int k = 0; k < 2; k++)
            pos[v][k] = (int16_t)(prng_range(&p, -900, 900) * z / 1000);
        for (int k = 0; k < 3; k++)
            n[k] = middle[k] + prng_range(&p, -spread, spread);
        unit3(n);
        for (int k = 0; k < 3; k++)
            normal[v][k] = (zs_q1_15)lrint(n[k] * 32767);
    }
    struct zs_config c = picture_config(W, H, &zs_depth_float);
    c.varyings = 6;
    struct picture is = picture_draw(&c, &scene, &camera);
    if (is.err)
        return case_wrong("error %d", is.err);
    double corner[3][3], to[3][3], face[3];
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            corner[v][k] = pos[v][k];
    for (int k = 0; k < 3; k++) {
        to[0][k] = corner[1][k] - corner[0][k];
        to[1][k] = corner[2][k] - corner[0][k];
    }
    for (int k = 0; k < 3; k++)
        face[k] = to[0][(k + 1) % 3] * to[1][(k + 2) % 3] - to[0][(k + 2) % 3] * to[1][(k + 1) % 3];
    const int turned = l.material.flags & ZS_LIT_TWO_SIDED && dot3(face, corner[0]) > 0;
    const double focal = ldexp((double)camera.focal, -32);
    int right = 1;
    for (int32_t i = 0; i < W * H && right; i++) {
        const double ray[3] = { (i % W + 0.5 - W / 2.0) / focal, -((double)(i / W) + 0.5 - H / 2.0) / focal, -1 };
        double share[3], want[3];
        struct place at = { .axis = { 0, 0, 1 } };
        if (is.key[i] == ZS_DEPTH_CLEAR || !shares(corner, ray, share))
            continue;
        for (int k = 0; k < 3; k++)
            for (int v = 0; v < 3; v++) {
                at.pos[k] += share[v] * corner[v][k];
                at.n[k] += share[v] * normal[v][k] / 32767;
            }
        const double length = sqrt(dot3(at.n, at.n));
        if (length < slack)
            continue;
        formula(&l.material, l.power, l.material.material.rgb, &at, turned, want);
        if (at.edge < 0x1p-9 / length)
            continue;
        const uint32_t px = is.color[i];
        lit_pixels++;
        blocks += kind == 0 && l.lighting.n_lamps == 1;
        if (!counted((px >> 11) / 31.0, want[0], 31) ||
            !counted((px >> 5 & 63) / 63.0, want[1], 63) ||
            !counted((px & 31) / 31.0, want[2], 31))
            right = case_wrong("pixel %d,%d: %u %u %u in place of %.2f %.2f %.2f (power %u, flags %u, %u lamps)", i % W,
                               i / W, px >> 11, px >> 5 & 63, px & 31, want[0] * 31, want[1] * 63, want[2] * 31, l.power,
                               l.material.flags, (unsigned)l.lighting.n_lamps);
    }
    picture_free(&is);
    return right;
}

static int phong_case(uint64_t seed)
{
    return frame_case(seed, 0);
}

static int near_case(uint64_t seed)
{
    return frame_case(seed, 1);
}

static void is_the_formula_at_pixels(void **state)
{
    (void)state;
    lit_pixels = blocks = 0;
    tally_begin();
    CASES(phong_case, 600);
    if (getenv("ZS_SEED"))
        return;
    tally_end("phong");
    assert_true(lit_pixels > 200000 && blocks > 100000);
}

static void is_the_formula_at_pixels_near_lamps(void **state)
{
    (void)state;
    lit_pixels = 0;
    tally_begin();
    CASES(near_case, 300);
    if (getenv("ZS_SEED"))
        return;
    tally_end("phong near");
    assert_true(lit_pixels > 100000);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(is_the_formula_at_points),
    cmocka_unit_test(all_powers),
    cmocka_unit_test(is_the_formula_at_pixels),
    cmocka_unit_test(is_the_formula_at_pixels_near_lamps)
};

CASES_MAIN(tests)
