/* Lights (effect/lights.c, lit.c, lit_phong.c, lit_texture.c) against the formula of zs_lights.h in double precision:
 * at points, and pixel by pixel on frames; the same frame in any way of drawing it; what is refused.
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
    double edge;                          /* out: how near it is to where the formula jumps, as a cosine */
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
static void any_lights(struct lights *l, struct prng *p, const int32_t around[3], int32_t reach, int kinds,
                       unsigned flags)
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

/* Run cases and judge what they counted together. 0: one seed was run alone, of which nothing is asked. */
static int tally_of(const char *test, case_fn *fn, uint64_t n, const char *what)
{
    tally_begin();
    cases_run(test, fn, n);
    if (!cases_all())
        return 0;
    tally_end(what);
    return 1;
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
        formula(&l.material, l.power, l.material.material.rgb, &at, l.material.flags & ZS_LIT_TWO_SIDED && side < 0,
                want);
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
    if (tally_of(__func__, point_case, 4000, "points"))
        assert_true(lit_points > 40000);
}

static int shine_case(uint64_t seed)
{
    struct prng p = { seed };
    struct lights l;
    const struct zs_camera camera = { .projection = ZS_ORTHOGRAPHIC,
                                      .rot = { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE } };
    const int32_t zero[3] = { 0, 0, 0 };
    struct zs_mesh mesh = { .scale = 0 };
    struct zs_instance in = { .mesh = &mesh, .material = &l.material.material };
    const struct zs_shading s = { .instance = &in, .camera = &camera };
    memset(&l, 0, sizeof l);
    l.power = (unsigned)(seed < 256 ? seed : 1 + prng_pick(&p, 255));
    CASE_CHECK(zs_shine_set(&l.shine, l.power) == ZS_OK);
    l.lamp[0].dir[2] = ZS_Q30_ONE;
    l.lighting = (struct zs_lighting){ .lamp = l.lamp, .n_lamps = 1 };
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
    (void)tally_of(__func__, shine_case, 255, "powers");
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
        if (!counted((px >> 11) / 31.0, want[0], 31) || !counted((px >> 5 & 63) / 63.0, want[1], 63) ||
            !counted((px & 31) / 31.0, want[2], 31))
            right = case_wrong("pixel %d,%d: %u %u %u in place of %.2f %.2f %.2f (power %u, flags %u, %u lamps)",
                               i % W, i / W, px >> 11, px >> 5 & 63, px & 31, want[0] * 31, want[1] * 63, want[2] * 31,
                               l.power, l.material.flags, (unsigned)l.lighting.n_lamps);
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
    if (tally_of(__func__, phong_case, 300, "phong"))
        assert_true(lit_pixels > 150000 && blocks > 80000);
}

static void is_the_formula_at_pixels_near_lamps(void **state)
{
    (void)state;
    lit_pixels = 0;
    if (tally_of(__func__, near_case, 200, "phong near"))
        assert_true(lit_pixels > 80000);
}

/* ---- Any way of drawing ----------------------------------------------------------------------- */

static const struct zs_shader *const shaders[] = { &zs_shade_lit_face,    &zs_shade_lit,
                                                   &zs_shade_phong,       &zs_shade_phong_near,
                                                   &zs_shade_texture_lit, &zs_shade_texture_tinted,
                                                   &zs_shade_texture_gloss,
                                                   &zs_shade_texture_gloss_tinted,
                                                   &zs_shade_texture_phong };
#define SHADERS (sizeof shaders / sizeof shaders[0])

/* Up to 7 steps from where the mesh has it, towards its middle. */
static void shaking_position(const struct zs_shading *s, uint32_t v, int16_t out[3])
{
    const struct zs_mesh *mesh = s->instance->mesh;
    for (int k = 0; k < 3; k++) {
        const int32_t by = (int32_t)(v * 7919u >> k & 7u), at = mesh->pos[v][k];
        out[k] = (int16_t)(at > mesh->center[k] + 7 ? at - by : at < mesh->center[k] - 7 ? at + by : at);
    }
}

static unsigned drawn[SHADERS + 1], in_sets;

/* A random world whose materials are lit ones, drawn with ample and with small pools, with any accelerators. */
static int way_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static struct lights l[WORLD_INSTANCES];
    static struct zs_shader shaking[WORLD_INSTANCES];
    static struct zs_instance in[WORLD_INSTANCES];
    static const int32_t around[3] = { 0, 0, 0 };
    unsigned used = 0;
    world_make(&w, &p, 0);
    struct zs_scene scene = w.scene;
    scene.instance = in;
    for (uint32_t i = 0; i < scene.n_instances; i++) {
        in[i] = w.scene.instance[i];
        if (in[i].material->primitive)
            continue;
        const uint32_t k = prng_pick(&p, SHADERS + 1);
        any_lights(&l[i], &p, around, 20000, k == 2 ? 1 : 3, k == 2 ? 3 : 7);
        l[i].material.material = *in[i].material;
        const int textured = in[i].mesh->uv && in[i].material->texture;
        if ((k && !in[i].mesh->normal) || (k >= 4 && k < SHADERS && !textured))
            continue;
        if (k < SHADERS) {
            l[i].material.material.shader = shaders[k];
        } else { /* a flat or smooth shader with a position stage */
            shaking[i] = *in[i].material->shader;
            shaking[i].position = shaking_position;
            shaking[i].place = zs_positions_place;
            l[i].material.material.shader = &shaking[i];
        }
        in[i].material = &l[i].material.material;
        used |= 1u << k;
    }
    struct zs_config c = {
        .width = (uint16_t)prng_range(&p, 1, 90), .height = (uint16_t)prng_range(&p, 1, 70), .max_tris = 4000,
        .max_verts = 8000, .varyings = ZS_VARYINGS_MAX, .depth = &zs_depth_recip
    };
    if (w.camera.projection == ZS_ORTHOGRAPHIC)
        c.depth = &zs_depth_linear;
    c.strip_h = c.height;
    struct picture ample = picture_draw(&c, &scene, &w.camera);
    picture_any_way(&p, &c, 1, 3);
    struct picture is = picture_draw(&c, &scene, &w.camera);
    for (unsigned k = 0; k <= SHADERS; k++)
        drawn[k] += !ample.err && used >> k & 1u && ample.covered;
    in_sets += is.stats.passes > is.stats.strips;
    world_free(&w);
    return picture_alike(&ample, &is, "another way");
}

static void is_the_same_in_any_way(void **state)
{
    (void)state;
    memset(drawn, 0, sizeof drawn);
    in_sets = 0;
    CASES(way_case, 250);
    if (!cases_all())
        return;
    for (unsigned k = 0; k <= SHADERS; k++)
        assert_true(drawn[k] > 20);
    assert_true(in_sets > 20);
}

/* ---- Positions -------------------------------------------------------------------------------- */

/* A mesh whose shader moves its vertices is drawn as the mesh of those places. */
static int moved_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static int16_t pos[65536][3];
    struct zs_mesh mesh;
    world_make(&w, &p, 0);
    if (!w.n_instances || w.scene.instance[0].material->primitive) {
        world_free(&w);
        return 1;
    }
    struct zs_material material = *w.scene.instance[0].material;
    struct zs_instance in = w.scene.instance[0];
    struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_shader shader = *material.shader;
    material.shader = &shader;
    material.cull = ZS_CULL_NONE;
    mesh = *in.mesh;
    if (!mesh.face_normal)
        mesh.face_normal = mesh.normal; /* any: positions must not be read for them */
    /* stages that read mesh.pos themselves are no part of this */
    if (shader.by_fragment || (shader.face && (!mesh.normal || mesh.n_tris > mesh.n_verts))) {
        world_free(&w);
        return 1;
    }
    mesh.cluster = NULL;
    mesh.radius = 65535;
    in.material = &material;
    in.mesh = &mesh;
    struct zs_config c = {
        .width = 60, .height = 50, .max_tris = 4000, .max_verts = 8000, .varyings = ZS_VARYINGS_MAX,
        .depth = &zs_depth_recip
    };
    if (w.camera.projection == ZS_ORTHOGRAPHIC)
        c.depth = &zs_depth_linear;
    picture_any_way(&p, &c, 1, 3);
    shader.position = shaking_position;
    shader.place = zs_positions_place;
    struct picture is = picture_draw(&c, &scene, &w.camera);
    const struct zs_shading s = { .instance = &w.scene.instance[0] };
    for (uint32_t v = 0; v < mesh.n_verts; v++)
        shaking_position(&s, v, pos[v]);
    shader.place = NULL;
    mesh.pos = (const int16_t(*)[3])pos;
    static const uint8_t zeros[65536][3];
    if (mesh.pos_lo)
        mesh.pos_lo = zeros;
    struct picture want = picture_draw(&c, &scene, &w.camera);
    drawn[0] += !is.err && is.covered;
    world_free(&w);
    return picture_alike(&want, &is, "moved");
}

static void positions_are_those_of_the_shader(void **state)
{
    (void)state;
    drawn[0] = 0;
    CASES(moved_case, 300);
    if (cases_all())
        assert_true(drawn[0] > 50);
}

/* ---- Stress ----------------------------------------------------------------------------------- */

/* One lamp at a point of a mesh of one-unit steps, seen along -z; the colour of a white surface, codes of 63. */
struct spot_light {
    struct zs_lamp lamp;
    struct zs_lighting lighting;
    struct zs_lit_material material;
    struct zs_mesh mesh;
    struct zs_instance in;
    struct zs_camera camera;
};

static void stress_begin(struct spot_light *s)
{
    memset(s, 0, sizeof *s);
    s->lighting.lamp = &s->lamp;
    s->lighting.n_lamps = 1;
    s->material.lighting = &s->lighting;
    s->material.material.rgb = (struct zs_rgb){ 255, 255, 255 };
    s->in = (struct zs_instance){ .mesh = &s->mesh, .material = &s->material.material };
    assert_int_equal(zs_camera_perspective(&s->camera, ZS_DEGREES(60), 48, 1, 40000), ZS_OK);
}

static double stress_at(const struct spot_light *s, int32_t x, int32_t y, int32_t z, zs_q1_15 nx, zs_q1_15 ny,
                        zs_q1_15 nz)
{
    struct zs_instance in = s->in;
    in.mesh = &s->mesh;
    in.material = &s->material.material;
    struct zs_lit_material material = s->material;
    struct zs_lighting lighting = s->lighting;
    lighting.lamp = &s->lamp;
    material.lighting = &lighting;
    in.material = &material.material;
    const struct zs_shading shading = { .instance = &in, .camera = &s->camera };
    const int32_t p[3] = { x, y, z };
    const zs_q1_15 n[3] = { nx, ny, nz };
    uint16_t out[3];
    zs_lit_color(&shading, s->material.material.rgb, p, n, out);
    return out[1] / 65535.0 * 63;
}

static void stress_31_normals_near_zero(void **state)
{
    struct spot_light s;
    (void)state;
    stress_begin(&s);
    s.lamp.dir[2] = ZS_Q30_ONE;
    s.lighting.ambient = (struct zs_rgb){ 51, 51, 51 };
    assert_true(fabs(stress_at(&s, 0, 0, 0, 0, 0, 0) - 63 * 0.2) < 0.1); /* none: ambient light */
    for (zs_q1_15 length = 1; length < 100; length++) { /* any length has a direction */
        assert_true(stress_at(&s, 0, 0, 0, 0, 0, length) > 62.9);
        assert_true(fabs(stress_at(&s, 0, 0, 0, 0, 0, (zs_q1_15)-length) - 63 * 0.2) < 0.1);
        assert_true(fabs(stress_at(&s, 0, 0, 0, length, 0, length) - 63 * fmin(1, 0.2 + sqrt(0.5))) < 0.2);
    }
    assert_true(fabs(stress_at(&s, 0, 0, 0, -32768, -32768, -32768) - 63 * 0.2) < 0.1);
    assert_true(fabs(stress_at(&s, 0, 0, 0, 32767, 32767, 32767) - 63 * (0.2 + sqrt(1 / 3.0))) < 0.2);
}

static void stress_32_edge_of_a_spot(void **state)
{
    struct spot_light s;
    (void)state;
    stress_begin(&s);
    s.lamp = (struct zs_lamp){ .kind = ZS_LAMP_SPOT, .dir = { 0, 0, -ZS_Q30_ONE }, .pos = { 0, 0, 1000 } };
    for (int wide = 0; wide < 2; wide++) {
        s.lamp.inner = wide ? ZS_Q30_ONE : (zs_q2_30)(ZS_Q30_ONE * 0.9) + ZS_Q30_ONE / 256;
        s.lamp.outer = wide ? -ZS_Q30_ONE : (zs_q2_30)(ZS_Q30_ONE * 0.9);
        double before = 64;
        for (int32_t x = 0; x < 1000 * 256; x += 64) { /* outwards: never brighter, and no step */
            const double c = 1000 / hypot(1000, x / 256.0), d = stress_at(&s, x, 0, 0, 0, 0, 32767);
            const double t = fmin(1, fmax(0, (c - q30(s.lamp.outer)) / (q30(s.lamp.inner) - q30(s.lamp.outer))));
            assert_true(fabs(d - 63 * c * t * t * (3 - 2 * t)) < 2);
            assert_true(d <= before + 0.3);
            before = d;
        }
    }
    assert_true(stress_at(&s, 0, 0, 1001 * 256, 0, 0, -32767) < 0.1); /* behind the lamp, at the cone's far end */
}

static void stress_33_a_lamp_at_the_surface(void **state)
{
    struct spot_light s;
    (void)state;
    stress_begin(&s);
    s.lighting.ambient = (struct zs_rgb){ 51, 51, 51 };
    s.lamp = (struct zs_lamp){ .kind = ZS_LAMP_POINT, .pos = { 5, 6, 7 }, .half = 1, .range = 1 };
    s.material.flags = ZS_LIT_NEAR_VIEWER | ZS_LIT_TWO_SIDED;
    assert_true(fabs(stress_at(&s, 5 * 256, 6 * 256, 7 * 256, 0, 0, 32767) - 63 * 0.2) < 0.1); /* at it: none */
    assert_true(stress_at(&s, 5 * 256, 6 * 256, 7 * 256 + 16, 0, 0, -32767) > 62); /* 1/16 from it */
    assert_true(fabs(stress_at(&s, 5 * 256, 6 * 256, 8 * 256, 0, 0, -32767) - 63 * 0.2) < 0.1); /* at its range */
    s.camera.pos[0] = 5; /* the eye at the surface, too */
    s.camera.pos[1] = 6;
    s.camera.pos[2] = 7;
    assert_true(fabs(stress_at(&s, 5 * 256, 6 * 256, 7 * 256, 0, 0, 32767) - 63 * 0.2) < 0.1);
}

static void stress_34_far_away_lamps(void **state)
{
    struct spot_light s;
    (void)state;
    stress_begin(&s);
    s.lamp = (struct zs_lamp){ .kind = ZS_LAMP_POINT, .pos = { 0, 0, ZS_WORLD_MAX } };
    s.in.pose.pos[2] = -ZS_WORLD_MAX;
    assert_true(stress_at(&s, 0, 0, 0, 0, 0, 32767) > 62.9);
    s.lamp.half = 1u << 30;
    assert_true(fabs(stress_at(&s, 0, 0, 0, 0, 0, 32767) - 31.5) < 0.1);
    s.lamp.half = 1;
    assert_true(stress_at(&s, 0, 0, 0, 0, 0, 32767) < 0.1);
    s.lamp.half = 0;
    s.lamp.range = 1u << 30;
    assert_true(stress_at(&s, 0, 0, 0, 0, 0, 32767) < 0.1);
    s.lamp.range = 1;
    assert_true(stress_at(&s, 0, 0, 0, 0, 0, 32767) < 0.1);
}

static void stress_35_more_light_than_white(void **state)
{
    struct spot_light s;
    struct zs_shine shine;
    struct zs_lamp many[ZS_LIGHTS_MAX];
    (void)state;
    stress_begin(&s);
    for (int i = 0; i < ZS_LIGHTS_MAX; i++)
        many[i] = (struct zs_lamp){ .dir = { 0, 0, ZS_Q30_ONE + (1 << 17) }, .strength = 4 * ZS_Q16_ONE };
    assert_int_equal(zs_shine_set(&shine, 255), ZS_OK);
    struct zs_lighting lighting = { .lamp = many, .n_lamps = ZS_LIGHTS_MAX, .ambient = { 255, 255, 255 } };
    s.material.shine = &shine;
    s.material.specular = s.material.emission = (struct zs_rgb){ 255, 255, 255 };
    s.material.lighting = &lighting;
    const struct zs_shading shading = { .instance = &s.in, .camera = &s.camera };
    const int32_t p[3] = { 0, 0, 0 };
    const zs_q1_15 n[3] = { 0, 0, 32767 };
    uint16_t out[3];
    for (unsigned flags = 0; flags < 8; flags++) {
        s.material.flags = (uint8_t)flags;
        zs_lit_color(&shading, s.material.material.rgb, p, n, out);
        assert_true(out[0] == 65535 && out[1] == 65535 && out[2] == 65535);
    }
}

/* ---- What is refused -------------------------------------------------------------------------- */

static const int16_t one_pos[3][3] = { { 0, 0, -200 }, { 90, 0, -200 }, { 0, 90, -200 } };
static const uint16_t one_tri[1][3] = { { 0, 1, 2 } };
static const zs_q1_15 one_normal[3][3] = { { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 } };

static int refused_with(struct lights *l, const struct zs_mesh *mesh, uint8_t varyings)
{
    struct zs_camera camera;
    const struct zs_instance in = { .mesh = mesh, .material = &l->material.material };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_config c = picture_config(8, 8, &zs_depth_float);
    c.varyings = varyings;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 8, 100, 40000), ZS_OK);
    return picture_error(&c, &scene, &camera);
}

static int refused(struct lights *l, const struct zs_mesh *mesh)
{
    return refused_with(l, mesh, ZS_VARYINGS_MAX);
}

/* Each shader takes as many varyings as zs_lights.h says, and is refused with one less. */
static void varyings_are_as_many_as_is_said(void **state)
{
    static const uint8_t many[SHADERS] = { 0, 3, 3, 6, 3, 5, 4, 8, 8 };
    static const int16_t uv[3][2] = { { 0 } };
    static const uint16_t texel[1] = { 0 };
    static const struct zs_texture texture = { .format = &zs_texel_565, .texel = texel };
    const struct zs_mesh mesh = { .pos = one_pos, .tri = one_tri, .normal = one_normal, .uv = uv, .n_verts = 3,
                                  .n_tris = 1, .radius = 300 };
    struct lights l = { .lighting = { .n_lamps = 0 } };
    (void)state;
    l.material.lighting = &l.lighting;
    l.material.material.texture = &texture;
    for (unsigned k = 0; k < SHADERS; k++) {
        l.material.material.shader = shaders[k];
        assert_int_equal(refused_with(&l, &mesh, many[k]), ZS_OK);
        if (many[k])
            assert_int_equal(refused_with(&l, &mesh, (uint8_t)(many[k] - 1)), ZS_ERR_VARYINGS);
    }
}

static void bad_lights_are_refused(void **state)
{
    const struct zs_mesh mesh = { .pos = one_pos, .tri = one_tri, .normal = one_normal, .n_verts = 3, .n_tris = 1,
                                  .radius = 300 };
    const struct zs_mesh bare = { .pos = one_pos, .tri = one_tri, .n_verts = 3, .n_tris = 1, .radius = 300 };
    struct zs_lamp many[ZS_LIGHTS_MAX + 1];
    struct lights good, l;
    (void)state;
    memset(&good, 0, sizeof good);
    good.lighting.n_lamps = 1;
    good.lamp[0] = (struct zs_lamp){
        .kind = ZS_LAMP_SPOT, .dir = { 0, 0, -ZS_Q30_ONE }, .inner = ZS_Q30_ONE, .outer = ZS_Q30_ONE / 2, .range = 10
    };
    good.material.material.shader = &zs_shade_lit;
#define AGAIN(change, want)                                                                                           \
    do {                                                                                                              \
        l = good;                                                                                                     \
        l.lighting.lamp = l.lamp;                                                                                     \
        l.material.lighting = &l.lighting;                                                                            \
        change;                                                                                                       \
        assert_int_equal(refused(&l, &mesh), want);                                                                   \
    } while (0)
    AGAIN(, ZS_OK);
    AGAIN(l.material.lighting = NULL, ZS_ERR_NULL);
    AGAIN(l.lighting.lamp = NULL, ZS_ERR_NULL);
    AGAIN((l.lighting.lamp = NULL, l.lighting.n_lamps = 0), ZS_OK);
    for (int i = 0; i <= ZS_LIGHTS_MAX; i++)
        many[i] = good.lamp[0];
    AGAIN((l.lighting.lamp = many, l.lighting.n_lamps = ZS_LIGHTS_MAX), ZS_OK);
    AGAIN((l.lighting.lamp = many, l.lighting.n_lamps = ZS_LIGHTS_MAX + 1), ZS_ERR_RANGE);
    AGAIN(l.lamp[0].kind = 3, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].strength = 4 * ZS_Q16_ONE, ZS_OK);
    AGAIN(l.lamp[0].strength = 4 * ZS_Q16_ONE + 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].pos[1] = ZS_WORLD_MAX, ZS_OK);
    AGAIN(l.lamp[0].pos[1] = ZS_WORLD_MAX + 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].pos[0] = -ZS_WORLD_MAX - 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].pos[2] = INT32_MIN, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].range = (1u << 30) + 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].half = (1u << 30) + 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].inner = ZS_Q30_ONE + 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].outer = -ZS_Q30_ONE - 1, ZS_ERR_RANGE);
    AGAIN(l.lamp[0].outer = ZS_Q30_ONE - ZS_Q30_ONE / 256, ZS_OK);
    AGAIN(l.lamp[0].outer = ZS_Q30_ONE - ZS_Q30_ONE / 256 + 1, ZS_ERR_RANGE);
    AGAIN((l.lamp[0].inner = 0, l.lamp[0].outer = ZS_Q30_ONE / 2), ZS_ERR_RANGE);
    AGAIN(l.lamp[0].dir[2] = 0, ZS_ERR_VECTOR);
    AGAIN(l.lamp[0].dir[2] += 1 << 17, ZS_OK);
    AGAIN(l.lamp[0].dir[2] += 1 << 19, ZS_ERR_VECTOR);
    AGAIN(l.lamp[0].dir[2] -= 1 << 19, ZS_ERR_VECTOR);
    AGAIN(l.lamp[0].dir[0] = INT32_MIN, ZS_ERR_VECTOR);
    AGAIN((l.lamp[0].kind = ZS_LAMP_POINT, l.lamp[0].dir[2] = 0, l.lamp[0].inner = 0), ZS_OK);
    AGAIN((l.lamp[0].kind = ZS_LAMP_DIRECTIONAL, l.lamp[0].pos[0] = INT32_MIN, l.lamp[0].range = UINT32_MAX), ZS_OK);
    AGAIN(l.material.flags = 7, ZS_OK);
    AGAIN(l.material.flags = 8, ZS_ERR_RANGE);
    AGAIN(l.material.material.shader = &zs_shade_phong, ZS_ERR_RANGE);
    AGAIN((l.lamp[0].kind = 0, l.material.material.shader = &zs_shade_phong), ZS_OK);
    AGAIN((l.lamp[0].kind = 0, l.material.flags = ZS_LIT_NEAR_VIEWER, l.material.material.shader = &zs_shade_phong),
          ZS_ERR_RANGE);
    AGAIN(l.material.material.shader = &zs_shade_phong_near, ZS_OK);
    AGAIN(l.material.material.shader = &zs_shade_texture_lit, ZS_ERR_NULL);
    for (unsigned k = 0; k < 4; k++) {
        AGAIN((l.material.material.shader = shaders[k], l.lamp[0].kind = 0), ZS_OK);
        assert_int_equal(refused(&l, &bare), k == 0 ? ZS_OK : ZS_ERR_MESH);
    }
    assert_int_equal(zs_shine_set(NULL, 1), ZS_ERR_NULL);
    assert_int_equal(zs_shine_set(&l.shine, 0), ZS_ERR_RANGE);
    assert_int_equal(zs_shine_set(&l.shine, 256), ZS_ERR_RANGE);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(is_the_formula_at_points), cmocka_unit_test(all_powers),
    cmocka_unit_test(is_the_formula_at_pixels), cmocka_unit_test(is_the_formula_at_pixels_near_lamps),
    cmocka_unit_test(is_the_same_in_any_way),   cmocka_unit_test(positions_are_those_of_the_shader),
    cmocka_unit_test(stress_31_normals_near_zero),
    cmocka_unit_test(stress_32_edge_of_a_spot),
    cmocka_unit_test(stress_33_a_lamp_at_the_surface),
    cmocka_unit_test(stress_34_far_away_lamps),
    cmocka_unit_test(stress_35_more_light_than_white),
    cmocka_unit_test(varyings_are_as_many_as_is_said),
    cmocka_unit_test(bad_lights_are_refused)
};

CASES_MAIN(tests)
