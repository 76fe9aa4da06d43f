/* Dithering: colours that a panel shows as they are, means that are the colour, and light without bands, against
 * doubles.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "glass_level.h"
#include "picture.h"
#include "zs_dither.h"

static const struct zs_dither_pattern *const patterns[] = { &zs_dither_ordered, &zs_dither_blue };
static const struct zs_dither_format *const formats[] = { &zs_dither_rgb332, &zs_dither_grey4, &zs_dither_mono };

/* An RGB565 value as frames have it, and back. */
static uint16_t wire(uint16_t v)
{
    const uint8_t bytes[2] = { (uint8_t)(v >> 8), (uint8_t)v };
    uint16_t out;
    memcpy(&out, bytes, 2);
    return out;
}

/* ---- Patterns ----------------------------------------------------------------------------------- */

static void patterns_have_each_rank_once(void **state)
{
    for (int k = 0; k < 2; k++) {
        const unsigned n = 1u << 2 * patterns[k]->log2;
        uint8_t seen[256] = { 0 };
        for (unsigned i = 0; i < n; i++) {
            assert_true(patterns[k]->rank[i] < n);
            assert_int_equal(seen[patterns[k]->rank[i]]++, 0);
        }
    }
    for (unsigned y = 0; y < 8; y++)
        for (unsigned x = 0; x < 8; x++)
            assert_int_equal(zs_dither_ordered.rank[8 * y + x], quantise_order(x, y));
}

/* Blue noise: at every level of grey, the waves that are longer than 16 / 3 px have a tenth of what white noise has. */
static void the_noise_is_blue(void **state)
{
    const double turn = 2 * 3.14159265358979323846 / 16;
    double low = 0, all = 0;
    for (int level = 16; level < 256; level += 16)
        for (int v = 0; v < 16; v++)
            for (int u = 0; u < 16; u++) {
                double re = 0, im = 0;
                for (int y = 0; y < 16; y++)
                    for (int x = 0; x < 16; x++)
                        if (zs_dither_blue.rank[16 * y + x] < level)
                            re += cos(turn * (u * x + v * y)), im += sin(turn * (u * x + v * y));
                const int fu = u > 8 ? 16 - u : u, fv = v > 8 ? 16 - v : v;
                const double power = (re * re + im * im) / (level * (256 - level)), f = hypot(fu, fv);
                if (f > 0 && f <= 3)
                    low += power / 28;
                if (f > 0)
                    all += power / 255;
            }
    assert_true(low < all / 10);
}

/* ---- Formats ------------------------------------------------------------------------------------ */

/* Dither an area of one colour; the frame's corner is at (x0, y0). */
static void fill(uint16_t px[16][16], uint16_t color, const struct zs_dither *d, unsigned x0, unsigned y0)
{
    uint16_t row[64];
    for (unsigned y = 0; y < 16; y++) {
        const struct zs_target t = {
            .color = row, .y0 = (uint16_t)(y0 + y), .y1 = (uint16_t)(y0 + y + 1), .x0 = (uint16_t)x0,
            .x1 = (uint16_t)(x0 + 16), .pitch = 64
        };
        for (unsigned x = 0; x < 64; x++)
            row[x] = wire(color);
        zs_dither_draw((void *)d, &t);
        for (unsigned x = 0; x < 64; x++)
            if (x < x0 || x >= x0 + 16)
                assert_int_equal(row[x], wire(color));
        for (unsigned x = 0; x < 16; x++)
            px[y][x] = wire(row[x0 + x]);
    }
}

static unsigned panel_r(uint16_t v)
{
    const unsigned c = v >> 11;
    return c << 3 | c >> 2;
}

static unsigned panel_g(uint16_t v)
{
    const unsigned c = v >> 5 & 63;
    return c << 2 | c >> 4;
}

static unsigned panel_b(uint16_t v)
{
    const unsigned c = v & 31;
    return c << 3 | c >> 2;
}

/* What a panel of the format shows of a pixel, as a part of full; per channel k where it has colours. */
static double shown(int format, uint16_t v, int k, unsigned x, unsigned y)
{
    if (format == 0)
        return k == 0 ? (v >> 13) / 7.0 : k == 1 ? (v >> 8 & 7) / 7.0 : (v >> 3 & 3) / 3.0;
    if (format == 1)
        return quantise_level(panel_r(v), panel_g(v), panel_b(v)) / 15.0;
    return quantise_bit(panel_r(v), panel_g(v), panel_b(v), x, y);
}

/* A colour's channel, or its grey, as a part of full. */
static double meant(int format, uint16_t v, int k)
{
    const double r = (v >> 11) / 31.0, g = (v >> 5 & 63) / 63.0, b = (v & 31) / 31.0;
    return format ? (77 * r + 150 * g + 29 * b) / 256 : k == 0 ? r : k == 1 ? g : b;
}

static const double steps[3][3] = { { 7, 7, 3 }, { 15, 15, 15 }, { 1, 1, 1 } };

/* Each pixel is at the level above or below; their mean is the colour. Black and white stay. */
static int mean_case(uint64_t seed)
{
    struct prng p = { seed };
    static const uint16_t some[] = { 0, 0xffff, 0xf800, 0x07e0, 0x001f, 0x8410 };
    const uint16_t color = prng_pick(&p, 8) ? (uint16_t)prng_next(&p) : some[prng_pick(&p, 6)];
    for (int f = 0; f < 3; f++)
        for (int k = 0; k < 2; k++) {
            uint16_t px[16][16];
            const struct zs_dither d = { .format = formats[f], .pattern = patterns[k] };
            const unsigned x0 = prng_pick(&p, 48), y0 = prng_pick(&p, 1000), side = 1u << patterns[k]->log2;
            fill(px, color, &d, x0, y0);
            for (int c = 0; c < (f ? 1 : 3); c++) {
                const double is = meant(f, color, c) * steps[f][c];
                double sum = 0;
                for (unsigned y = 0; y < side; y++)
                    for (unsigned x = 0; x < side; x++) {
                        const double level = shown(f, px[y][x], c, x0 + x, y0 + y) * steps[f][c];
                        sum += level;
                        if (fabs(level - is) > 1.001)
                            return case_wrong("format %d: level %f of %f", f, level, is);
                    }
                if (fabs(sum / (side * side) - is) > 1.0 / (2 * side * side) + 0.001)
                    return case_wrong("format %d, pattern %d: mean %f of %f", f, k, sum / (side * side), is);
            }
            if (color == 0 || color == 0xffff)
                for (unsigned y = 0; y < 16; y++)
                    for (unsigned x = 0; x < 16; x++)
                        CASE_CHECK(px[y][x] == color);
        }
    return 1;
}

/* The thresholds are at home in the frame: a pixel is the same in any strip and any columns; and a second time
 * nothing changes. */
static void pixels_are_the_frames(void **state)
{
    uint16_t whole[32][40], part[32][40];
    for (int f = 0; f < 3; f++)
        for (int k = 0; k < 2; k++) {
            struct prng p = { 7 };
            const struct zs_dither d = { .format = formats[f], .pattern = patterns[k] };
            const struct zs_target all = { .color = whole[0], .y1 = 32, .x1 = 40, .pitch = 40 };
            for (int i = 0; i < 32 * 40; i++)
                whole[i / 40][i % 40] = part[i / 40][i % 40] = (uint16_t)prng_next(&p);
            zs_dither_draw((void *)&d, &all);
            for (uint16_t y = 0; y < 32; y += 5)
                for (uint16_t x = 0; x < 40; x += 7) {
                    const struct zs_target t = {
                        .color = part[y], .y0 = y, .y1 = (uint16_t)(y + 5 < 32 ? y + 5 : 32), .x0 = x,
                        .x1 = (uint16_t)(x + 7 < 40 ? x + 7 : 40), .pitch = 40
                    };
                    zs_dither_draw((void *)&d, &t);
                }
            assert_memory_equal(whole, part, sizeof whole);
            if (f == 2) {
                zs_dither_draw((void *)&d, &all);
                assert_memory_equal(whole, part, sizeof whole);
            }
        }
}

/* ---- Smooth shading ----------------------------------------------------------------------------- */

#define SIDE 128

/* A square that fills the frame, its colour growing: red to the right, green to the top, blue to the left; straight
 * on, or tilted. */
static struct picture light(const struct zs_shader *shader, int tilted, struct prng *any, uint8_t from, uint8_t to,
                            int hidden)
{
    static const zs_q1_15 normal[4][3] = { { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 }, { 0, 0, 32767 } };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    const int16_t near = tilted ? 500 : 0, far = tilted ? -4000 : 0;
    const int16_t pos[4][3] = {
        { -1600, -1600, near }, { 1600, -1600, near }, { 1600, 1600, far }, { -1600, 1600, far }
    };
    const struct zs_rgb rgb[4] = { { from, from, to }, { to, from, from }, { to, to, from }, { from, to, to } };
    const struct zs_mesh mesh = {
        .pos = pos, .tri = tri, .normal = normal, .vertex_rgb = rgb, .n_verts = 4, .n_tris = 2, .radius = 6000
    };
    const struct zs_material material = { .shader = shader, .cull = ZS_CULL_NONE };
    static const int16_t small[4][3] = {
        { -300, -400, 800 }, { 200, -400, 800 }, { 200, 500, 800 }, { -300, 500, 800 }
    };
    const struct zs_mesh block = { .pos = small, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 2000 };
    const struct zs_material black = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    const struct zs_instance in[2] = { { .mesh = &block, .material = &black },
                                       { .mesh = &mesh, .material = &material } };
    const struct zs_scene scene = { .instance = in + !hidden,
                                    .n_instances = 1u + (hidden != 0),
                                    .light = { .ambient = ZS_Q16_ONE } };
    struct zs_camera camera;
    struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_recip);
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), SIDE, 100, 20000), ZS_OK);
    camera.pos[2] = 2000;
    if (any)
        picture_any_way(any, &c, 12, 12);
    return picture_draw(&c, &scene, &camera);
}

static double channel(uint16_t c, int k)
{
    return k == 0 ? c >> 11 : k == 1 ? c >> 5 & 63 : c & 31;
}

/* Straight on: what the colour of channel k should be at a pixel, in codes. */
static double exact(int k, int x, int y, double from, double to)
{
    const double focal = SIDE / 2.0 / tan(3.14159265358979323846 / 6);
    const double u = ((x + 0.5 - SIDE / 2.0) * 2000 / focal + 1600) / 3200,
                 v = (1600 - (y + 0.5 - SIDE / 2.0) * 2000 / focal) / 3200;
    const double part = k == 0 ? from + (to - from) * u : k == 1 ? from + (to - from) * v : to + (from - to) * u;
    return part / 255 * (k == 1 ? 63 : 31);
}

/* The largest error of the mean over squares of 16 x 16 px, in codes. */
static double bands(const struct picture *p, double from, double to)
{
    double worst = 0;
    for (int k = 0; k < 3; k++)
        for (int y = 0; y + 16 <= SIDE; y += 16)
            for (int x = 0; x + 16 <= SIDE; x += 16) {
                double sum = 0;
                for (int i = 0; i < 256; i++)
                    sum += channel(p->color[(y + i / 16) * SIDE + x + i % 16], k) -
                           exact(k, x + i % 16, y + i / 16, from, to);
                worst = fmax(worst, fabs(sum / 256));
            }
    return worst;
}

static const struct zs_shader *const dithered[] = { &zs_shade_smooth_ordered, &zs_shade_smooth_blue };

static void light_without_bands(void **state)
{
    static const uint8_t ends[][2] = { { 100, 112 }, { 0, 255 }, { 0, 4 }, { 250, 255 }, { 30, 200 } };
    for (unsigned e = 0; e < sizeof ends / sizeof *ends; e++) {
        const uint8_t from = ends[e][0], to = ends[e][1];
        struct picture plain = light(&zs_shade_smooth, 0, NULL, from, to, 0);
        assert_int_equal(plain.err, ZS_OK);
        for (int k = 0; k < 2; k++) {
            struct picture p = light(dithered[k], 0, NULL, from, to, 0);
            assert_int_equal(p.err, ZS_OK);
            for (int i = 0; i < SIDE * SIDE; i++)
                for (int c = 0; c < 3; c++) {
                    const double off = channel(p.color[i], c) - exact(c, i % SIDE, i / SIDE, from, to);
                    assert_true(fabs(off) < 1.01);
                }
            assert_true(bands(&p, from, to) < (to - from < 20 ? 0.035 : 0.1)); /* steep light goes over the pattern */
            if (to - from < 20)
                assert_true(bands(&plain, from, to) > 0.4);
            picture_free(&p);
        }
        picture_free(&plain);
    }
}

/* In perspective: at most a code from the plain shader's colour. */
static void tilted_light_is_that_of_the_plain_shader(void **state)
{
    struct picture plain = light(&zs_shade_smooth, 1, NULL, 0, 255, 0);
    assert_int_equal(plain.err, ZS_OK);
    for (int k = 0; k < 2; k++) {
        struct picture p = light(dithered[k], 1, NULL, 0, 255, 0);
        double sum = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            for (int c = 0; c < 3; c++) {
                const double off = channel(p.color[i], c) - channel(plain.color[i], c);
                assert_true(fabs(off) <= 1);
                sum += off;
            }
        assert_true(fabs(sum / (SIDE * SIDE * 3)) < 0.02);
        assert_int_equal(p.covered, plain.covered);
        picture_free(&p);
    }
    picture_free(&plain);
}

/* What lies before the surface cuts its rows into runs: no other pixel changes. */
static void hidden_pixels_change_no_other(void **state)
{
    for (int k = 0; k < 4; k++) {
        struct picture a = light(dithered[k % 2], k / 2, NULL, 0, 255, 0);
        struct picture b = light(dithered[k % 2], k / 2, NULL, 0, 255, 1);
        int hidden = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            if (b.key[i] == a.key[i])
                assert_int_equal(a.color[i], b.color[i]);
            hidden += b.key[i] != a.key[i];
        }
        assert_in_range(hidden, 500, SIDE * SIDE / 2);
        PICTURES_FREE(&a, &b);
    }
}

static int way_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct zs_shader *shader = dithered[prng_pick(&p, 2)];
    const int tilted = (int)prng_pick(&p, 2);
    struct picture a = light(shader, tilted, NULL, 20, 220, 0), b = light(shader, tilted, &p, 20, 220, 0);
    return picture_drawn_alike(&a, &b, "dithered");
}

/* What zs_shade_smooth refuses. */
static void wrong_meshes_are_named(void **state)
{
    static const int16_t pos[3][3] = { { 0 } };
    static const uint16_t tri[1][3] = { { 0, 1, 2 } };
    const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = 3, .n_tris = 1, .radius = 9 };
    struct zs_camera camera;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 30, 10, 3000), ZS_OK);
    for (int k = 0; k < 2; k++) {
        const struct zs_material material = { .shader = dithered[k] };
        const struct zs_instance in = { .mesh = &mesh, .material = &material };
        const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
        struct zs_config c = picture_config(30, 30, &zs_depth_recip);
        assert_int_equal(picture_error(&c, &scene, &camera), ZS_ERR_MESH);
        c.varyings = 2;
        assert_int_equal(picture_error(&c, &scene, &camera), ZS_ERR_VARYINGS);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(patterns_have_each_rank_once),
    cmocka_unit_test(the_noise_is_blue),
    CASES_TEST(means_are_the_colour, mean_case, 4000),
    cmocka_unit_test(pixels_are_the_frames),
    cmocka_unit_test(light_without_bands),
    cmocka_unit_test(tilted_light_is_that_of_the_plain_shader),
    CASES_TEST(any_way_draws_the_same, way_case, 60),
    cmocka_unit_test(wrong_meshes_are_named),
    cmocka_unit_test(hidden_pixels_change_no_other),
};
CASES_MAIN(tests)
