/* Colours against doubles: within one RGB565 code of the exact value rounded.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "oracle.h"
#include "picture.h"
#include "shapes.h"
#include "easel.h"

#define GUARD (8188 * 256)

/* ---- Counting -------------------------------------------------------------------------------- */

struct tally {
    uint64_t values, off_by_one;
    double squares; /* of differences in parts of 255, for the peak signal-to-noise ratio */
    double worst;   /* from the unrounded value, codes */
};

static struct tally tally;

static const int most_code[3] = { 31, 63, 31 };

static int code_of(uint16_t color, int channel)
{
    return channel == 0 ? color >> 11 : channel == 1 ? color >> 5 & 63 : color & 31;
}

/* One channel: exact in codes, slack in codes for what the caller cannot know. */
static int channel_right(uint16_t color, int channel, double exact, double slack)
{
    const int code = code_of(color, channel), want = (int)floor(exact + 0.5);
    const double error = fabs(code - exact);
    const double step = (code - want) * 255.0 / most_code[channel];
    tally.values++;
    tally.off_by_one += code != want;
    tally.squares += step * step;
    tally.worst = fmax(tally.worst, error - slack);
    return abs(code - want) <= 1 || error <= 0.5 + slack;
}

static void tally_print(const char *what)
{
    const double mean = tally.squares / (double)(tally.values ? tally.values : 1);
    print_message(
        "%s: %llu values, %.3f %% one code off, %.3f codes from the unrounded value at most, "
        "%.1f dB\n",
        what, (unsigned long long)tally.values,
        100.0 * (double)tally.off_by_one / (double)(tally.values ? tally.values : 1), tally.worst,
        10 * log10(255.0 * 255.0 / fmax(mean, 1e-12)));
    memset(&tally, 0, sizeof tally);
}

static double psnr(void)
{
    return 10 * log10(255.0 * 255.0 * (double)tally.values / fmax(tally.squares, 1e-12));
}

/* Cases whose colours are those of doubles, as far as 50 dB tell. */
static void colors_close(const char *test, case_fn *fn, uint64_t n, const char *name)
{
    cases_run(test, fn, n);
    assert_true(psnr() >= 50);
    tally_print(name);
}

/* ---- Smooth, on exactly known geometry ------------------------------------------------------- */

static void smooth_corners(struct prng *p, const struct easel *s, int huge, struct easel_tri *t)
{
    for (int k = 0; k < 3; k++) {
        const int32_t reach_x = huge ? GUARD : s->width * 200,
                      reach_y = huge ? GUARD : s->height * 200;
        t->x[k] = s->width * 128 + prng_range(p, -reach_x, reach_x);
        t->y[k] = s->height * 128 + prng_range(p, -reach_y, reach_y);
        for (int c = 0; c < 3; c++)
            t->rgb[k][c] = (uint16_t)(prng_pick(p, 3)   ? prng_next(p)
                                      : prng_pick(p, 2) ? 65535u
                                                        : 0u);
    }
}

/* 1 / z of a corner up to a factor; w ratio at most `ratio`. */
static double corner_depth(struct prng *p, const struct easel *s, const struct easel_frame *unit,
                           double ratio, double nearest, uint32_t *d)
{
    const double z = nearest * pow(ratio, prng_pick(p, 1025) / 1024.0);
    const double n = s->z_near, f = s->z_far;
    if (s->depth == &zs_depth_linear) {
        *d = (uint32_t)ldexp(z, unit->shift);
        return 1.0 / *d;
    }
    const struct oracle_float o = { easel_float_bits(s->depth), s->depth_bits };
    if (o.e) {
        *d = oracle_float_d(&o, n / z);
        return 0; /* smooth_triangle knows them by the three of them */
    }
    const double top = ((1 << s->depth_bits) - 1) * 65536.0;
    *d = (uint32_t)floor((1 / n - 1 / z) / (1 / n - 1 / f) * top);
    return unit->key_far * 65536 - *d;
}

static int smooth_triangle(uint64_t seed, double ratio)
{
    struct prng p = { seed };
    struct easel s = easel_default(96, 72);
    s.smooth = 1;
    s.strip_h = prng_range(&p, 1, 72);
    if (seed % 3 == 0)
        s.depth = &zs_depth_linear;
    if (seed % 3 == 1) {
        s.depth = seed % 2 ? &zs_depth_e5m11 : seed % 4 ? &zs_depth_e4m12 : &zs_depth_e3m13;
        s.z_far = 1 << 19;
    }
    struct easel_frame f;
    struct easel_tri t;
    easel_draw(&s, &t, 0, &f);
    easel_free(&f);
    smooth_corners(&p, &s, seed % 5 == 0, &t);
    double w[3];
    const double most = s.z_far / ratio / s.z_near;
    const double nearest = s.z_near * pow(most, prng_pick(&p, 1025) / 1024.0 * 0.5);
    for (int k = 0; k < 3; k++)
        w[k] = corner_depth(&p, &s, &f, ratio, nearest, &t.d[k]);
    for (int k = 0; k < 3 && easel_float_bits(s.depth); k++)
        w[k] = (double)easel_inverse(&s, &f, t.d, k);
    easel_draw(&s, &t, 1, &f);
    const struct oracle_tri o = { { t.x[0], t.x[1], t.x[2] }, { t.y[0], t.y[1], t.y[2] } };
    int ok = 1;
    for (int j = 0; j < s.height && ok; j++)
        for (int i = 0; i < s.width && ok; i++) {
            if (f.key[j * s.width + i] == ZS_DEPTH_CLEAR)
                continue;
            int64_t share[3];
            oracle_weights(&o, i, j, share);
            for (int c = 0; c < 3 && ok; c++) {
                double sum = 0, weight = 0;
                for (int k = 0; k < 3; k++) {
                    sum += (double)share[k] * w[k] * t.rgb[k][c];
                    weight += (double)share[k] * w[k];
                }
                const double exact = sum / weight / 65535 * most_code[c];
                if (!channel_right(f.color[j * s.width + i], c, exact, 0))
                    ok = case_wrong(
                        "channel %d at (%d, %d) is %d, not %.4f: (%d %d %u %u) (%d %d %u "
                        "%u) (%d %d %u %u)",
                        c, i, j, code_of(f.color[j * s.width + i], c), exact, t.x[0], t.y[0],
                        t.d[0], t.rgb[0][c], t.x[1], t.y[1], t.d[1], t.rgb[1][c], t.x[2], t.y[2],
                        t.d[2], t.rgb[2][c]);
            }
        }
    easel_free(&f);
    return ok;
}

static int mild_case(uint64_t seed) { return smooth_triangle(seed, 1.3); }
static int strong_case(uint64_t seed) { return smooth_triangle(seed, 16); }
static int extreme_case(uint64_t seed) { return smooth_triangle(seed, 1000); }

static void smooth_is_perspective_correct(void **state)
{
    CASES(mild_case, 400);
    tally_print("smooth, w ratio 1.3");
    CASES(strong_case, 700);
    tally_print("smooth, w ratio 16");
    CASES(extreme_case, 400);
    tally_print("smooth, w ratio 1000");
}

/* A constant colour stays it, to the code, in every triangle: no edge of a mesh shines through. */
static int constant_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = easel_default(96, 72);
    s.smooth = 1;
    if (seed % 2)
        s.depth = &zs_depth_linear;
    struct easel_frame f;
    struct easel_tri t;
    easel_draw(&s, &t, 0, &f);
    easel_free(&f);
    smooth_corners(&p, &s, seed % 5 == 0, &t);
    for (int k = 0; k < 3; k++) {
        (void)corner_depth(&p, &s, &f, 50, 300, &t.d[k]);
        memcpy(t.rgb[k], t.rgb[0], sizeof t.rgb[0]);
    }
    easel_draw(&s, &t, 1, &f);
    int ok = 1;
    for (int i = 0; i < s.width * s.height && ok; i++)
        for (int c = 0; c < 3 && f.key[i] != ZS_DEPTH_CLEAR && ok; c++) {
            const double exact = t.rgb[0][c] / 65535.0 * most_code[c];
            const double fraction = exact - floor(exact);
            ok = code_of(f.color[i], c) == (int)floor(exact + 0.5) || fabs(fraction - 0.5) < 0.002;
            if (!ok)
                (void)case_wrong("%d, not %.5f", code_of(f.color[i], c), exact);
        }
    easel_free(&f);
    return ok;
}

/* ---- Whole scenes ---------------------------------------------------------------------------- */

struct world {
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
    struct zs_camera camera;
    int32_t w, h;
};

static void world_set(struct world *g, const struct shape *s, uint64_t seed)
{
    struct prng p = { seed };
    memset(g, 0, sizeof *g);
    g->w = 100;
    g->h = 90;
    const struct zs_material m = { .shader = &zs_shade_raw, .rgb = { 255, 180, 90 }, .cull = ZS_CULL_BACK };
    g->material = m;
    g->instance.mesh = &s->mesh;
    g->instance.material = &g->material;
    zs_pose_identity(&g->instance.pose);
    zs_pose_turn(&g->instance.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p),
                 (zs_turn)prng_next(&p));
    g->instance.pose.pos[2] = -9000;
    g->scene.instance = &g->instance;
    g->scene.n_instances = 1;
    const int32_t dir[3] = { prng_range(&p, -9, 9), prng_range(&p, -9, 9), 4 };
    (void)zs_unit(g->scene.light.dir, dir);
    g->scene.light.ambient = prng_pick(&p, ZS_Q16_ONE / 2);
    g->scene.light.diffuse = prng_pick(&p, ZS_Q16_ONE + 1); /* sums above 1 are cut */
    if (seed % 3 == 0)
        (void)zs_camera_orthographic(&g->camera, 9000, 100, 20000);
    else
        (void)zs_camera_perspective(&g->camera, 9000, (uint16_t)g->h, 100, 20000);
    if (seed % 7 == 0) { /* cut open: new vertices take their share of the colours */
        g->camera.z_near = (zs_q48_16)8000 * 65536;
        g->material.cull = ZS_CULL_NONE;
    }
}

static void to_world(const struct zs_pose *pose, const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int j = 0; j < 3; j++)
            out[k] += ldexp(pose->rot[3 * k + j], -30) * v[j];
    }
}

/* Full is 1, cut there. normal in mesh space, of any length. */
static double lit(const struct world *g, const double normal[3], double channel)
{
    double n[3], dot = 0;
    const double length =
        sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    to_world(&g->instance.pose, normal, n);
    for (int k = 0; k < 3; k++)
        dot += length > 0 ? n[k] / length * ldexp(g->scene.light.dir[k], -30) : 0;
    const double light = (g->scene.light.ambient + g->scene.light.diffuse * fmax(0, dot)) / 65536.0;
    return fmin(1, channel / 255 * light);
}

static double rgb_channel(const struct zs_rgb *c, int k)
{
    return k == 0 ? c->r : k == 1 ? c->g : c->b;
}

static void corner_at(const struct shape *s, uint32_t v, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = s->pos[v][k] + (s->mesh.pos_lo ? s->pos_lo[v][k] / 256.0 : 0);
}

static void a_ball_or_ring(struct shape *s, uint64_t seed)
{
    if (seed % 2)
        shape_sphere(s, 8, 12, 3000);
    else
        shape_torus(s, 10, 8, 2500, 900);
    if (seed / 2 % 2)
        s->mesh.pos_lo = (const uint8_t (*)[3])s->pos_lo;
}

static int flat_case(uint64_t seed)
{
    static struct shape s;
    struct world g;
    struct prng p = { seed };
    a_ball_or_ring(&s, seed);
    static zs_q1_15 normals[SHAPE_TRIS][3];
    const int given = seed / 4 % 2;
    for (uint32_t t = 0; t < s.mesh.n_tris; t++) {
        const int32_t dir[3] = { prng_range(&p, -99, 99), prng_range(&p, -99, 99), 100 };
        zs_q2_30 unit[3];
        (void)zs_unit(unit, dir);
        for (int k = 0; k < 3; k++)
            normals[t][k] = (zs_q1_15)(unit[k] / 32768);
    }
    if (given)
        s.mesh.face_normal = (const zs_q1_15 (*)[3])normals;
    if (seed / 8 % 2)
        s.mesh.face_rgb = NULL;
    world_set(&g, &s, seed);
    const struct zs_config config = picture_config(g.w, g.h, &zs_depth_linear);
    struct picture id = picture_draw(&config, &g.scene, &g.camera);
    g.material.shader = &zs_shade_flat;
    struct picture f = picture_draw(&config, &g.scene, &g.camera);
    int ok = !id.err && !f.err && f.covered > 500;
    for (int i = 0; i < g.w * g.h && ok; i++) {
        if (id.key[i] == ZS_DEPTH_CLEAR)
            continue;
        const uint32_t t = id.color[i] - 1u;
        double n[3], a[3], b[3], c[3];
        corner_at(&s, s.tri[t][0], a);
        corner_at(&s, s.tri[t][1], b);
        corner_at(&s, s.tri[t][2], c);
        for (int k = 0; k < 3; k++) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            n[k] = given ? normals[t][k]
                         : (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
        }
        const struct zs_rgb *color = s.mesh.face_rgb ? &s.face_rgb[t] : &g.material.rgb;
        for (int k = 0; k < 3 && ok; k++) {
            const double exact = lit(&g, n, rgb_channel(color, k)) * most_code[k];
            if (!channel_right(f.color[i], k, exact, 0))
                ok = case_wrong("triangle %u channel %d is %d, not %.4f", t, k,
                                code_of(f.color[i], k), exact);
        }
    }
    PICTURES_FREE(&id, &f);
    return ok;
}

static void flat_colours_against_doubles(void **state)
{
    colors_close(__func__, flat_case, 150, "flat");
}

/* Perspective-correct colour of a triangle at a sample, codes; and its change a px. */
static double smooth_exact(const struct world *g, const struct shape *s, uint32_t t, int i, int j,
                           int c, double *change)
{
    const struct zs_camera *cam = &g->camera;
    const int perspective = cam->projection == ZS_PERSPECTIVE;
    double x[3], y[3], w[3], value[3];
    for (int k = 0; k < 3; k++) {
        const uint32_t v = s->tri[t][k];
        double at[3], eye[3], n[3];
        corner_at(s, v, at);
        to_world(&g->instance.pose, at, eye);
        const double z = 9000 - eye[2];
        const double scale = perspective ? ldexp((double)cam->focal, -32) / z
                                         : g->h * 65536.0 / (double)cam->height;
        x[k] = g->w / 2.0 + eye[0] * scale;
        y[k] = g->h / 2.0 - eye[1] * scale;
        w[k] = perspective ? 1 / z : 1;
        for (int m = 0; m < 3; m++)
            n[m] = s->normal[v][m];
        const struct zs_rgb *rgb = s->mesh.vertex_rgb ? &s->vertex_rgb[v] : &g->material.rgb;
        value[k] = lit(g, n, rgb_channel(rgb, c)) * most_code[c];
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    double at[3];
    for (int n = 0; n < 3; n++) { /* at the sample, a step right, a step down */
        const double px = i + 0.5 + (n == 1 ? 0.01 : 0), py = j + 0.5 + (n == 2 ? 0.01 : 0);
        double sum = 0, weight = 0;
        for (int k = 0; k < 3; k++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const double share = ((x[b] - x[a]) * (py - y[a]) - (y[b] - y[a]) * (px - x[a])) / area;
            sum += share * w[k] * value[k];
            weight += share * w[k];
        }
        at[n] = sum / weight;
    }
    *change = (fabs(at[1] - at[0]) + fabs(at[2] - at[0])) * 100;
    return at[0];
}

static int smooth_case(uint64_t seed)
{
    static struct shape s;
    struct world g;
    a_ball_or_ring(&s, seed);
    if (seed / 4 % 2)
        s.mesh.vertex_rgb = NULL;
    world_set(&g, &s, seed);
    const struct zs_depth *depth = seed / 8 % 2 && seed % 3 ? &zs_depth_recip : &zs_depth_linear;
    const struct zs_config config = picture_config(g.w, g.h, depth);
    struct picture id = picture_draw(&config, &g.scene, &g.camera);
    g.material.shader = &zs_shade_smooth;
    struct picture f = picture_draw(&config, &g.scene, &g.camera);
    int ok = !id.err && !f.err && f.covered > 500;
    for (int j = 0; j < g.h && ok; j++)
        for (int i = 0; i < g.w && ok; i++) {
            const int at = j * g.w + i;
            ok = id.key[at] == f.key[at];
            for (int c = 0; c < 3 && ok && f.key[at] != ZS_DEPTH_CLEAR; c++) {
                double change;
                const double exact = smooth_exact(&g, &s, id.color[at] - 1u, i, j, c, &change);
                if (!channel_right(f.color[at], c, exact, change * 0.006))
                    ok = case_wrong("triangle %u channel %d at (%d, %d) is %d, not %.4f",
                                    id.color[at] - 1u, c, i, j, code_of(f.color[at], c), exact);
            }
        }
    PICTURES_FREE(&id, &f);
    return ok;
}

static void smooth_colours_against_doubles(void **state)
{
    colors_close(__func__, smooth_case, 150, "smooth scenes");
}

/* Raw colours leave as they are, most significant byte first; RGB565 is the nearest there is. */
static void raw_colours_are_exact(void **state)
{
    for (int v = 0; v < 256; v++) {
        const int got = zs_rgb565((uint8_t)v, (uint8_t)v, (uint8_t)v);
        for (int c = 0; c < 3; c++)
            assert_int_equal(code_of((uint16_t)got, c), (int)floor(v * most_code[c] / 255.0 + 0.5));
    }
    struct lone l;
    static const int16_t pos[3][3] = { { -30000, -30000, 0 },
                                       { 30000, -30000, 0 },
                                       { 0, 30000, 0 } };
    lone_set(&l, pos, 3, ZS_Q16_ONE);
    l.instance.pose.pos[2] = -PIXEL_Z;
    const struct zs_camera camera = pixel_camera(20, 0);
    const struct zs_config config = lone_config(20, 20, &zs_depth_linear);
    static const uint16_t values[] = { 0x0000, 0xffff, 0x1234, 0x00ff, 0xff00, 0x8001 };
    for (int k = 0; k < 6; k++) {
        l.mesh.face_raw = &values[k];
        struct picture p = picture_draw(&config, &l.scene, &camera);
        assert_int_equal(p.color[10 * 20 + 10], values[k]);
        picture_free(&p);
    }
    l.mesh.face_raw = NULL;
    const struct zs_rgb rgb = { 10, 200, 77 };
    l.material.rgb = rgb;
    struct picture p = picture_draw(&config, &l.scene, &camera);
    assert_int_equal(p.color[10 * 20 + 10], zs_rgb565(10, 200, 77));
    picture_free(&p);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(raw_colours_are_exact),
    cmocka_unit_test(flat_colours_against_doubles),
    cmocka_unit_test(smooth_is_perspective_correct),
    CASES_TEST(a_constant_colour_stays_constant, constant_case, 400),
    cmocka_unit_test(smooth_colours_against_doubles)
};

CASES_MAIN(tests)
