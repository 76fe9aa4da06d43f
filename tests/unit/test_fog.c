/* Fog against that of the true distance, in doubles: each key of each mapping, and a plane that goes into the distance.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "../lab/fuzz/world.h"
#include "cases.h"
#include "picture.h"
#include "zs_dither.h"
#include "zs_fog.h"
#include "zs_overlay.h"

/* ---- The mappings and the fog, from their formulas ---------------------------------------------- */

struct mapping {
    double n, f, top; /* near, far, 2^bits - 1 */
    int kind, bits;   /* 0: recip, 1: linear, 2: float of e bits */
    int e;
};

static double key_of(const struct mapping *m, double z)
{
    if (m->kind == 0)
        return m->top * m->f / (m->f - m->n) * (z - m->n) / z;
    if (m->kind == 1)
        return (z - m->n) / (m->f - m->n) * m->top;
    const double r = m->n / z, last = pow(2, m->e) - 2;
    const double k = fmin(fmax(floor(-log2(r)), 0), last);
    return m->top + 1 - ((last - k) * pow(2, m->bits - m->e) + r * pow(2, k + 1 + m->bits - m->e));
}

/* The distance of a key, by halves; infinite beyond all keys. */
static double distance_of(const struct mapping *m, double key)
{
    double lo = m->n, hi = m->n + (m->f - m->n) * 4;
    if (key <= 0)
        return m->n;
    for (int k = 0; k < 40 && key_of(m, hi) < key; k++)
        hi *= 4;
    if (key_of(m, hi) < key)
        return INFINITY;
    for (int k = 0; k < 60; k++) {
        const double mid = lo + (hi - lo) / 2;
        if (key_of(m, mid) < key)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

static double fog_at(const struct zs_fog *fog, double z)
{
    if (isinf(z))
        return 1;
    const double t = fog->curve == ZS_FOG_LINEAR ? (z - fog->start) / ((double)fog->end - fog->start)
                                                 : 1 - exp(-(z - fog->start) / ((double)fog->end - fog->start));
    return fmin(fmax(t, 0), 1);
}

/* ---- Every key ---------------------------------------------------------------------------------- */

#define ONE(name_, ...) &zs_depth_##name_,
static const struct zs_depth *const depths[] = { ZS_DEPTH_EACH(ONE) };
#undef ONE

static struct zs_camera camera_make(struct prng *p, struct mapping *m)
{
    struct zs_camera c = { .projection = (uint8_t)(m->kind == 1 && prng_pick(p, 2) ? ZS_ORTHOGRAPHIC
                                                                                   : ZS_PERSPECTIVE) };
    c.focal = (zs_uq32_32)(1 + prng_pick(p, 1000)) << 32;
    c.height = (zs_q48_16)(1 + prng_pick(p, 100000)) << 16;
    c.z_near = (int64_t)exp2(prng_real(p, 17, 40));
    const double ratio = exp2(prng_real(p, 0.1, prng_pick(p, 4) ? 10 : 16));
    c.z_far = (int64_t)((double)c.z_near * ratio) + 65536;
    if (c.projection == ZS_ORTHOGRAPHIC && prng_pick(p, 2))
        c.z_near = -c.z_near;
    for (int k = 0; k < 3; k++)
        c.pos[k] = prng_range(p, -ZS_WORLD_MAX, ZS_WORLD_MAX);
    m->n = (double)c.z_near / 65536;
    m->f = (double)c.z_far / 65536;
    return c;
}

static void fog_make(struct prng *p, struct zs_fog *fog, const struct mapping *m)
{
    const double a = m->n + (m->f - m->n) * prng_real(p, -0.2, 1), b = a + (m->f - m->n) * prng_real(p, 0.01, 1.2);
    memset(fog, 0, sizeof *fog);
    fog->color = (uint16_t)prng_next(p);
    fog->sky = (uint8_t)prng_pick(p, 2);
    fog->curve = (uint8_t)prng_pick(p, 2);
    fog->start = (int32_t)fmin(a, 2e9);
    fog->end = (int32_t)fmin(b, 2.1e9) + 1;
    if (fog->curve)
        fog->end = (int32_t)(fog->start + ((int64_t)fog->end - fog->start) / 3) + 1;
}

static double channel(uint16_t c, int k)
{
    return k == 0 ? c >> 11 : k == 1 ? c >> 5 & 63 : c & 31;
}

#define N 150
static unsigned set, mixed;

static int key_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_fog fog;
    const uint32_t which = prng_pick(&p, 6);
    struct mapping m = { .kind = which < 2 ? (int)which : 2, .bits = prng_pick(&p, 3) ? 16 : prng_range(&p, 8, 16) };
    m.top = pow(2, m.bits) - 1;
    const struct zs_camera camera = camera_make(&p, &m);
    m.e = which == 5 ? (m.f <= m.n * 128 ? 3 : m.f <= m.n * 32768 ? 4 : 5) : (int)which + 1;
    fog_make(&p, &fog, &m);
    const struct zs_config config = { .width = 320,
                                      .height = 240,
                                      .depth = depths[which],
                                      .depth_bits = (uint8_t)(m.bits == 16 && prng_pick(&p, 2) ? 0 : m.bits) };
    const int err = zs_fog_set(&fog, &config, &camera);
    if (err == ZS_ERR_RANGE && camera.projection == ZS_ORTHOGRAPHIC)
        return 1; /* sub-pixels too fine for what is in view */
    if (err)
        return case_wrong("%s", zs_error_string(err));
    set++;
    const uint32_t most = (uint32_t)fmin(m.top - 1, key_of(&m, m.f) + 0.5); /* no pixel is beyond far */
    uint16_t color[N], old[N], depth[N];
    for (int k = 0; k < N; k++) {
        old[k] = (uint16_t)prng_next(&p);
        color[k] = (uint16_t)(old[k] << 8 | old[k] >> 8);
        const uint32_t back = prng_pick(&p, 1u << prng_pick(&p, (uint32_t)m.bits));
        const uint32_t key = k % 2 ? prng_pick(&p, most + 1) : back > most ? 0 : most - back;
        depth[k] = prng_pick(&p, 20) ? (uint16_t)key : ZS_DEPTH_CLEAR;
    }
    const struct zs_target t = { .color = color, .depth = depth, .y1 = 1, .x1 = N, .pitch = N };
    zs_fog_draw(&fog, &t);
    const double end = fog.curve == ZS_FOG_LINEAR ? fog.end : fog.start + 4.9 * ((double)fog.end - fog.start);
    const double least = m.n > 0 ? m.n : 1, units = fmin(fmax(end, fabs(m.n)), m.f) / least / 0x1p28;
    for (int k = 0; k < N; k++) {
        const uint16_t now = (uint16_t)(color[k] << 8 | color[k] >> 8);
        if (depth[k] == ZS_DEPTH_CLEAR) {
            CASE_CHECK(now == (fog.sky ? fog.color : old[k]));
            continue;
        }
        const double a = fmin(distance_of(&m, depth[k] - 0.03), m.f), b = fmin(distance_of(&m, depth[k] + 0.03), m.f);
        const double lo = fog_at(&fog, a - fabs(a) * units) - 1 / 128.0,
                     hi = fog_at(&fog, b + fabs(b) * units) + 1 / 128.0;
        mixed += lo > 0 && hi < 1;
        for (int c = 0; c < 3; c++) {
            const double from = channel(old[k], c), by = channel(fog.color, c) - from, is = channel(now, c);
            if (is < fmin(from + by * lo, from + by * hi) - 0.5001 ||
                is > fmax(from + by * lo, from + by * hi) + 0.5001)
                return case_wrong("mapping %u, %d bits, key %u: %04x on %04x in %04x, fog %f to %f", which, m.bits,
                                  depth[k], now, old[k], fog.color, lo, hi);
        }
    }
    return 1;
}

/* ---- A scene ------------------------------------------------------------------------------------ */

/* A floor, seen along: a row's distance is known. */
static void a_floor_in_fog(void **state)
{
    static const int16_t pos[4][3] = {
        { -30000, 0, 10 }, { 30000, 0, 10 }, { 30000, 0, -30000 }, { -30000, 0, -30000 }
    };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 65535 };
    const struct zs_material white = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff), .cull = ZS_CULL_NONE };
    const struct zs_instance floor = { .mesh = &mesh, .material = &white };
    for (uint32_t which = 0; which < 6; which++)
        for (int curve = 0; curve < 2; curve++) {
            struct zs_camera camera;
            struct zs_fog fog = {
                .color = ZS_RGB565(0x000000), .curve = (uint8_t)curve, .start = 300, .end = curve ? 2300 : 9000
            };
            const struct zs_resolve hook = { .draw = zs_fog_draw, .ctx = &fog };
            const struct zs_scene scene = {
                .instance = &floor, .n_instances = 1, .background = ZS_RGB565(0x0000ff), .resolve = &hook,
                .n_resolves = 1
            };
            struct zs_config c = picture_config(40, 60, depths[which]);
            struct mapping m = { .kind = which < 2 ? (int)which : 2, .bits = 16, .top = 65535, .n = 100, .f = 30000 };
            m.e = which == 5 ? 4 : (int)which + 1;
            c.strip_h = 7;
            assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 60, 100, 30000), ZS_OK);
            camera.pos[1] = 100;
            assert_int_equal(zs_fog_set(&fog, &c, &camera), ZS_OK);
            struct picture p = picture_draw(&c, &scene, &camera);
            assert_int_equal(p.err, ZS_OK);
            for (int y = 0; y < 60; y++) {
                const uint16_t now = p.color[y * 40 + 20];
                const double z = 100 * ((double)camera.focal / 0x1p32) / (y + 0.5 - 30), key = key_of(&m, z);
                if (y < 30) {
                    assert_int_equal(now, ZS_RGB565(0x0000ff));
                    continue;
                }
                if (z > 20000)
                    continue; /* near the floor's end */
                const double lo = fog_at(&fog, distance_of(&m, key - 1) * 0.998),
                             hi = fog_at(&fog, distance_of(&m, key + 1) * 1.002);
                for (int k = 0; k < 3; k++) {
                    const double full = k == 1 ? 63 : 31;
                    assert_true(channel(now, k) < full * (1 - lo + 1 / 128.0) + 0.51);
                    assert_true(channel(now, k) > full * (1 - hi - 1 / 128.0) - 0.51);
                }
            }
            picture_free(&p);
        }
}

/* Fog, an overlay and dithering over random scenes, in any strips, pools and accelerators: the same picture. */
static int way_case(uint64_t seed)
{
    struct prng p = { seed };
    struct world w;
    struct zs_config plain = picture_config(prng_range(&p, 1, 60), prng_range(&p, 1, 50), &zs_depth_linear), other;
    world_make(&w, &p, 0);
    struct zs_fog fog = {
        .color = (uint16_t)prng_next(&p), .start = 0, .end = 1 << 20, .sky = (uint8_t)prng_pick(&p, 2)
    };
    const struct zs_item items[] = {
        { .kind = &zs_item_text, .x = -3, .y = 5, .size = 2, .color = 0xffff, .clear = 90, .text = "Fog \xc3\xbc" },
        { .kind = &zs_item_arc, .x = 20, .y = 20, .w = 18, .h = 4, .from = 40000, .sweep = 50000, .value = 30000,
          .color = 0x1234 }
    };
    struct zs_overlay over = { .item = items, .n = 2 };
    struct zs_dither dither = { .format = prng_pick(&p, 2) ? &zs_dither_rgb332 : &zs_dither_grey4,
                                .pattern = prng_pick(&p, 2) ? &zs_dither_ordered : &zs_dither_blue };
    const struct zs_resolve hook[] = { { .draw = zs_fog_draw, .ctx = &fog },
                                       { .draw = zs_overlay_draw, .ctx = &over },
                                       { .draw = zs_dither_draw, .ctx = &dither } };
    w.scene.resolve = hook;
    w.scene.n_resolves = 1u + prng_pick(&p, 3);
    if (zs_fog_set(&fog, &plain, &w.camera))
        w.scene.n_resolves = 0;
    other = plain;
    picture_any_way(&p, &other, 12, 12);
    struct picture a = picture_draw(&plain, &w.scene, &w.camera), b = picture_draw(&other, &w.scene, &w.camera);
    set += !a.err && w.scene.n_resolves;
    world_free(&w);
    return picture_alike(&a, &b, "hooks");
}

/* ---- What is wrong, what changes ----------------------------------------------------------------- */

static void wrong_fog_is_named(void **state)
{
    struct zs_camera persp, ortho;
    const struct zs_config c = picture_config(40, 30, &zs_depth_float),
                           none = { .width = 9, .height = 9, .depth = &zs_depth_none };
    struct zs_config bits = c, empty = c;
    const struct zs_fog good = { .start = 1, .end = 2000 };
    struct zs_fog fog = good, back = { .start = 5, .end = 5 },
                  thin = { .curve = ZS_FOG_EXPONENTIAL, .start = 3, .end = 2 }, odd = { .curve = 2, .end = 9 };
    bits.depth_bits = 7;
    empty.depth = NULL;
    assert_int_equal(zs_camera_perspective(&persp, ZS_DEGREES(60), 30, 10, 3000), ZS_OK);
    assert_int_equal(zs_camera_orthographic(&ortho, 30, 10, 3000), ZS_OK);
    assert_int_equal(zs_fog_set(NULL, &c, &persp), ZS_ERR_NULL);
    assert_int_equal(zs_fog_set(&fog, NULL, &persp), ZS_ERR_NULL);
    assert_int_equal(zs_fog_set(&fog, &c, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_fog_set(&fog, &empty, &persp), ZS_ERR_NULL);
    assert_int_equal(zs_fog_set(&back, &c, &persp), ZS_ERR_RANGE);
    assert_int_equal(zs_fog_set(&thin, &c, &persp), ZS_ERR_RANGE);
    assert_int_equal(zs_fog_set(&odd, &c, &persp), ZS_ERR_RANGE);
    assert_int_equal(zs_fog_set(&fog, &none, &persp), ZS_ERR_DEPTH);
    assert_int_equal(zs_fog_set(&fog, &bits, &persp), ZS_ERR_DEPTH);
    assert_int_equal(zs_fog_set(&fog, &c, &ortho), ZS_ERR_DEPTH);
    persp.z_near = 0;
    assert_int_equal(zs_fog_set(&fog, &c, &persp), ZS_ERR_CAMERA);
    assert_memory_equal(&fog, &good, sizeof fog);
}

/* No depth memory: nothing is drawn. The hook tells of a change once. */
static void fog_without_keys_and_changes(void **state)
{
    uint16_t color[4] = { 1, 2, 3, 4 };
    const struct zs_target t = { .color = color, .y1 = 1, .x1 = 4, .pitch = 4 };
    const struct zs_config c = picture_config(40, 30, &zs_depth_float);
    struct zs_camera camera;
    struct zs_rect rect;
    struct zs_fog fog = { .end = 2000, .sky = 1 };
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 30, 10, 3000), ZS_OK);
    assert_int_equal(zs_fog_set(&fog, &c, &camera), ZS_OK);
    zs_fog_draw(&fog, &t);
    for (int k = 0; k < 4; k++)
        assert_int_equal(color[k], k + 1);
    for (int k = 0; k < 3; k++) {
        assert_int_equal(zs_fog_changes(&fog, &rect), 1);
        assert_true(rect.w >= ZS_SIZE_MAX && rect.h >= ZS_SIZE_MAX && !rect.x && !rect.y);
        assert_int_equal(zs_fog_changes(&fog, &rect), 0);
        if (k == 0)
            fog.color = 5;
        else
            fog.end = 1000;
        assert_int_equal(zs_fog_set(&fog, &c, &camera), ZS_OK);
    }
}

/* No fog up to far: what shows that there is no surface is sky all the same, and masked pixels are left. */
static void sky_beyond_clear_air(void **state)
{
    const struct zs_config c = picture_config(40, 30, &zs_depth_float);
    const uint16_t depth[4] = { 100, ZS_DEPTH_CLEAR - 1u, 0, ZS_DEPTH_CLEAR };
    struct zs_camera camera;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 30, 10, 3000), ZS_OK);
    for (uint8_t sky = 0; sky < 8; sky++) {
        uint16_t color[4] = { 1, 2, 3, 4 };
        const struct zs_target t = { .color = color, .depth = (uint16_t *)depth, .y1 = 1, .x1 = 4, .pitch = 4 };
        struct zs_fog fog = { .color = 0x1234, .start = 5000, .end = 9000, .sky = sky };
        assert_int_equal(zs_fog_set(&fog, &c, &camera), ZS_OK);
        zs_fog_draw(&fog, &t);
        const int paints = sky & ZS_FOG_SKY, windows = sky & ZS_FOG_WINDOWS;
        assert_int_equal(color[0], 1);
        assert_int_equal(color[1], paints && windows ? 0x3412 : 2);
        assert_int_equal(color[2], 3);
        assert_int_equal(color[3], paints ? 0x3412 : 4);
    }
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(fog_is_that_of_the_distance, key_case, 1000,
                 { "scenes", &set, 850 }, { "pixels that are mixed", &mixed, 30000 }),
    cmocka_unit_test(a_floor_in_fog),
    CASES_COUNTS(any_way_draws_the_same, way_case, 100, { "scenes", &set, 30 }),
    cmocka_unit_test(wrong_fog_is_named),
    cmocka_unit_test(sky_beyond_clear_air),
    cmocka_unit_test(fog_without_keys_and_changes),
};
CASES_MAIN(tests)
