/* Skies against directions in double precision, environment maps and billboards against what they say.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "fast_lists.h"
#include "picture.h"
#include "zs_environment.h"
#include "zs_shader.h"

/* ---- Skies ---------------------------------------------------------------------------------------- */

#define PI 3.14159265358979323846
#define LOG2_W 10
#define LOG2_H 9

static uint16_t column_image[1 << LOG2_H][1 << LOG2_W], row_image[1 << LOG2_H][1 << LOG2_W];

static uint16_t from_wire(uint16_t c)
{
    const uint8_t *b = (const uint8_t *)&c;
    return (uint16_t)(b[0] << 8 | b[1]);
}

static int any_camera(struct zs_camera *camera, struct prng *p, int32_t h)
{
    int32_t dir[3], up[3];
    const int32_t eye[3] = { prng_range(p, -999, 999), prng_range(p, -999, 999), prng_range(p, -999, 999) };
    for (int k = 0; k < 3; k++) {
        dir[k] = prng_range(p, -1000, 1000);
        up[k] = prng_range(p, -1000, 1000);
    }
    if (prng_pick(p, 2)) {
        up[0] = up[2] = 0;
        up[1] = 1000;
    }
    const zs_turn fov = (zs_turn)prng_range(p, ZS_DEGREES(10), ZS_DEGREES(100));
    return zs_camera_perspective(camera, fov, (uint16_t)h, 5, 4000) == ZS_OK &&
           zs_camera_look_along(camera, eye, dir, up) == ZS_OK;
}

struct view {
    double row[3][3]; /* right, up, back; in a mirror too */
    double f;         /* px; 0: orthographic */
    struct zs_rect at;
};

static struct view view_of(const struct zs_camera *camera, const struct zs_rect *at, const double *normal)
{
    struct view v = { .f = camera->projection == ZS_PERSPECTIVE ? ldexp((double)camera->focal, -32) : 0, .at = *at };
    for (int i = 0; i < 3; i++) {
        double along = 0;
        for (int k = 0; k < 3; k++)
            along += normal ? q30(camera->rot[3 * i + k]) * normal[k] : 0;
        for (int k = 0; k < 3; k++)
            v.row[i][k] = q30(camera->rot[3 * i + k]) - (normal ? 2 * along * normal[k] : 0);
    }
    return v;
}

/* The direction of a pixel of the frame, turns: yaw from -z to +x, and pitch. */
static void direction(const struct view *v, int x, int y, double *yaw, double *pitch)
{
    double d[3];
    for (int k = 0; k < 3; k++)
        d[k] = v->f == 0 ? -v->row[2][k]
                         : v->row[0][k] * (x + 0.5 - v->at.x - v->at.w / 2.0) -
                               v->row[1][k] * (y + 0.5 - v->at.y - v->at.h / 2.0) - v->row[2][k] * v->f;
    *yaw = atan2(d[0], -d[2]) / (2 * PI);
    *pitch = atan2(d[1], hypot(d[0], d[2])) / (2 * PI);
}

/* How far a place is beside texel i, texels. */
static double beside(double place, int i)
{
    return place < i ? i - place : place > i + 1 ? place - i - 1 : 0;
}

static unsigned sky_pixels;
static double worst_px, worst_level;

static int panorama_case(uint64_t seed)
{
    static const struct zs_texture images[2] = {
        { .format = &zs_texel_565, .texel = column_image, .log2_w = LOG2_W, .log2_h = LOG2_H },
        { .format = &zs_texel_565, .texel = row_image, .log2_w = LOG2_W, .log2_h = LOG2_H }
    };
    struct prng p = { seed };
    struct zs_camera camera;
    struct zs_mirror mirror;
    static struct zs_sky sky;
    struct zs_rect at = { (uint16_t)prng_pick(&p, 50), (uint16_t)prng_pick(&p, 50), (uint16_t)prng_range(&p, 1, 320),
                          (uint16_t)prng_range(&p, 1, 240) };
    const int16_t top = (int16_t)prng_range(&p, -8000, 16384);
    const int16_t bottom = (int16_t)prng_range(&p, -16384, top - 64);
    const int32_t point[3] = { 0, 0, 0 };
    int32_t normal[3] = { prng_range(&p, -9, 9), prng_range(&p, -9, 9), prng_range(&p, 1, 9) };
    if (!any_camera(&camera, &p, at.h))
        return 1; /* up along the view */
    const int mirrored = prng_pick(&p, 3) == 0;
    CASE_CHECK(zs_mirror_plane(&mirror, point, normal) == ZS_OK);
    const double n[3] = { q30(mirror.normal[0]), q30(mirror.normal[1]), q30(mirror.normal[2]) };
    const struct view v = view_of(&camera, &at, mirrored ? n : NULL);
    for (int i = 0; i < 2; i++) {
        CASE_CHECK(zs_sky_panorama(&sky, &images[i], top, bottom) == ZS_OK);
        zs_sky_look(&sky, &camera, &at, mirrored ? &mirror : NULL);
        for (int k = 0; k < 300; k++) {
            const int x = at.x + (int)prng_pick(&p, at.w), y = at.y + (int)prng_pick(&p, at.h);
            uint16_t c;
            double yaw, pitch, off;
            sky.background.fill(sky.background.ctx, &c, (uint16_t)x, (uint16_t)y, 1);
            c = from_wire(c);
            direction(&v, x, y, &yaw, &pitch);
            if (i == 0) {
                const double place = (yaw + 0.5) * (1 << LOG2_W);
                off = fmin(beside(place, c), fmin(beside(place - (1 << LOG2_W), c), beside(place + (1 << LOG2_W), c)));
                off *= cos(pitch * 2 * PI) / (1 << LOG2_W);
            } else {
                const double span = (top - bottom) / 65536.0, place = (top / 65536.0 - pitch) / span * (1 << LOG2_H);
                off = beside(fmax(0, fmin((1 << LOG2_H) - 1e-9, place)), c) / (1 << LOG2_H);
                off = fmax(0, off - ldexp(1, -17)) * span;
            }
            const double px = fmax(0, off - 0x1p-16) * 2 * PI * v.f, level = fabs(pitch) < 1 / 16.0 ? px * v.f : 0;
            sky_pixels++;
            worst_px = fmax(worst_px, px);
            worst_level = fmax(worst_level, level);
            if (px > 0.4 || level > 21)
                return case_wrong("%s at %d, %d: %g turn off, f %g, pitch %g turn", i ? "row" : "column", x, y, off,
                                  v.f, pitch);
        }
    }
    return 1;
}

static void a_panorama_is_where_it_should_be(void **state)
{
    (void)state;
    for (int y = 0; y < 1 << LOG2_H; y++)
        for (int x = 0; x < 1 << LOG2_W; x++) {
            column_image[y][x] = (uint16_t)x;
            row_image[y][x] = (uint16_t)y;
        }
    sky_pixels = 0;
    worst_px = worst_level = 0;
    CASES(panorama_case, 600);
    print_message("%u pixels, at most %.3f px off, at the horizon %.1f / f px\n", sky_pixels, worst_px, worst_level);
    if (cases_all())
        assert_true(sky_pixels > 200000);
}

/* The same pixel in any call. */
static int cut_case(uint64_t seed)
{
    static const struct zs_texture image = {
        .format = &zs_texel_565, .texel = column_image, .log2_w = LOG2_W, .log2_h = LOG2_H
    };
    static struct zs_sky sky;
    struct prng p = { seed };
    struct zs_camera camera;
    const struct zs_rect at = { (uint16_t)prng_pick(&p, 40), 0, 90, 60 };
    uint16_t whole[160], cut[160];
    if (!any_camera(&camera, &p, at.h))
        return 1;
    CASE_CHECK(zs_sky_panorama(&sky, &image, (int16_t)prng_range(&p, 0, 16384), -5000) == ZS_OK);
    zs_sky_look(&sky, &camera, &at, NULL);
    for (uint16_t y = 0; y < 60; y += 7) {
        sky.background.fill(&sky, whole, 0, y, 160);
        for (int x = 0; x < 160;) {
            const int n = prng_range(&p, 1, 160 - x < 30 ? 160 - x : 30);
            sky.background.fill(&sky, cut + x, (uint16_t)x, y, (uint16_t)n);
            x += n;
        }
        CASE_CHECK(memcmp(whole, cut, sizeof cut) == 0);
    }
    return 1;
}

/* Where a row of pixels goes straight up, 45 degrees from the horizon, groups of 16 are interpolated: each pixel's row
 * of the image is where the line between the group's and the next one's first has it, and not where its own is. */
static void a_group_is_interpolated(void **state)
{
    static const struct zs_texture image = {
        .format = &zs_texel_565, .texel = row_image, .log2_w = LOG2_W, .log2_h = LOG2_H
    };
    static const int32_t eye[3] = { 0, 0, 0 }, ahead[3] = { 0, 0, -1 }, left[3] = { -1, 0, 0 };
    static const struct zs_rect at = { 0, 0, 320, 240 };
    static struct zs_sky sky;
    struct zs_camera camera;
    uint16_t px[320];
    double worst = 0;
    int groups = 0;
    (void)state;
    for (int y = 0; y < 1 << LOG2_H; y++)
        for (int x = 0; x < 1 << LOG2_W; x++)
            row_image[y][x] = (uint16_t)y;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(100), 240, 1, 100), ZS_OK);
    assert_int_equal(zs_camera_look_along(&camera, eye, ahead, left), ZS_OK);
    assert_int_equal(zs_sky_panorama(&sky, &image, 9216, 7168), ZS_OK);
    zs_sky_look(&sky, &camera, &at, NULL);
    const struct view v = view_of(&camera, &at, NULL);
    sky.background.fill(&sky, px, 0, 120, 320);
    for (int x = 0; x < 320; x++)
        px[x] = from_wire(px[x]);
    for (int x = 0; x + 16 < 320; x += 16) {
        if (px[x] == 0 || px[x] == 511 || px[x + 16] == 0 || px[x + 16] == 511)
            continue;
        groups++;
        for (int k = 1; k < 16; k++) {
            double yaw, pitch;
            direction(&v, x + k, 120, &yaw, &pitch);
            assert_true(fabs(px[x + k] - px[x] - (px[x + 16] - px[x]) * k / 16.0) <= 1);
            worst = fmax(worst, fabs(px[x + k] + 0.5 - (9216 / 65536.0 - pitch) * 32 * (1 << LOG2_H)));
        }
    }
    assert_int_equal(groups, 1);
    assert_true(worst > 2);
}

/* A picture of one row shows it at every height, one of one column all around. */
static void a_panorama_of_one_row(void **state)
{
    static const uint16_t color[16] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 };
    (void)state;
    for (int column = 0; column < 2; column++) {
        const struct zs_texture image = { .format = &zs_texel_565, .texel = color,
                                          .log2_w = column ? 0 : 4, .log2_h = column ? 4 : 0 };
        static struct zs_sky sky;
        struct zs_camera camera;
        static const int32_t eye[3] = { 0, 0, 0 }, ahead[3] = { 0, 0, -1000 }, up[3] = { 0, 1, 0 };
        uint16_t row[64], first[64] = { 0 };
        uint32_t seen = 0;
        const struct zs_rect at = { 0, 0, 64, 48 };
        assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 10, 1000), ZS_OK);
        assert_int_equal(zs_camera_look_at(&camera, eye, ahead, up), ZS_OK);
        assert_int_equal(zs_sky_panorama(&sky, &image, 16384, -16384), ZS_OK);
        zs_sky_look(&sky, &camera, &at, NULL);
        for (uint16_t y = 0; y < 48; y++) {
            sky.background.fill(&sky, row, 0, y, 64);
            if (y == 0)
                memcpy(first, row, sizeof row);
            if (!column && y == 24)
                assert_memory_equal(row + 24, first + 24, 16 * sizeof *row); /* near the middle, columns are upright */
            for (int x = 0; x < 64; x++) {
                assert_true(zs_wire16(row[x]) >= 1 && zs_wire16(row[x]) <= 16);
                seen |= 1u << zs_wire16(row[x]);
                if (column) /* as high to the left as to the right */
                    assert_true(abs(zs_wire16(row[x]) - zs_wire16(row[63 - x])) <= 1);
            }
        }
        assert_true((seen & (seen - 1u)) != 0); /* more than one of them */
    }
}

/* Straight up is the first colour, straight down the last one, and the horizon is level. */
static void a_gradient_follows_the_pitch(void **state)
{
    static const struct zs_rgb color[4] = { { 0, 0, 255 }, { 248, 252, 248 }, { 128, 64, 0 }, { 0, 0, 0 } };
    static struct zs_sky_gradient g;
    static const int32_t eye[3] = { 0, 0, 0 };
    const struct zs_rect at = { 0, 0, 64, 48 };
    (void)state;
    zs_sky_gradient(&g, color);
    for (int degrees = -90; degrees <= 90; degrees += 15) {
        struct zs_camera camera;
        uint16_t row[64];
        const int32_t dir[3] = { 0, (int32_t)lrint(1e6 * sin(degrees * PI / 180)),
                                 -(int32_t)lrint(1e6 * cos(degrees * PI / 180)) };
        const int32_t up[3] = { 0, abs(degrees) == 90 ? 0 : 1, abs(degrees) == 90 ? 1 : 0 };
        assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 1, 100), ZS_OK);
        assert_int_equal(zs_camera_look_along(&camera, eye, dir, up), ZS_OK);
        zs_sky_look(&g.sky, &camera, &at, NULL);
        const struct view v = view_of(&camera, &at, NULL);
        for (int y = 0; y < 48; y++) {
            g.sky.background.fill(&g.sky, row, 0, (uint16_t)y, 64);
            for (int x = 0; x < 64; x++) {
                double yaw, pitch;
                direction(&v, x, y, &yaw, &pitch);
                const double k = (0.25 - pitch) * 2 * ZS_SKY_COLORS, slack = 0.35;
                const int low = (int)fmax(0, floor(k - slack)), high = (int)fmin(ZS_SKY_COLORS - 1, floor(k + slack));
                assert_true(from_wire(row[x]) == g.color[low] || from_wire(row[x]) == g.color[high]);
            }
        }
    }
    assert_int_equal(g.color[0], ZS_RGB565(0x0000ff));
    assert_int_equal(g.color[ZS_SKY_COLORS / 2 - 1], zs_rgb565(248, 252, 248));
    assert_int_equal(g.color[ZS_SKY_COLORS / 2], zs_rgb565(128, 64, 0));
    assert_int_equal(g.color[ZS_SKY_COLORS - 1], 0);
    struct zs_camera camera;
    uint16_t pixel[2];
    assert_int_equal(zs_camera_orthographic(&camera, 100, 1, 100), ZS_OK);
    const int32_t down[3] = { 0, -1, 0 }, north[3] = { 0, 0, -1 };
    assert_int_equal(zs_camera_look_along(&camera, eye, down, north), ZS_OK);
    zs_sky_look(&g.sky, &camera, &at, NULL); /* one direction */
    g.sky.background.fill(&g.sky, pixel, 0, 0, 1);
    g.sky.background.fill(&g.sky, pixel + 1, 63, 47, 1);
    assert_int_equal(pixel[0], 0);
    assert_int_equal(pixel[1], 0);
}

static void wrong_skies_are_refused(void **state)
{
    static const uint8_t texel[8];
    struct zs_texture image = { .format = &zs_texel_pal8, .texel = texel, .log2_w = 1, .log2_h = 1 };
    struct zs_sky sky;
    (void)state;
    assert_int_equal(zs_sky_panorama(&sky, &image, 100, 0), ZS_ERR_NULL); /* no palette */
    assert_int_equal(zs_sky_panorama(&sky, NULL, 100, 0), ZS_ERR_NULL);
    assert_int_equal(zs_sky_panorama(NULL, &image, 100, 0), ZS_ERR_NULL);
    image.format = &zs_texel_565;
    image.log2_w = 11;
    assert_int_equal(zs_sky_panorama(&sky, &image, 100, 0), ZS_ERR_TEXTURE);
    image.log2_w = 1;
    assert_int_equal(zs_sky_panorama(&sky, &image, 63, 0), ZS_ERR_RANGE);
    assert_int_equal(zs_sky_panorama(&sky, &image, 16385, 0), ZS_ERR_RANGE);
    assert_int_equal(zs_sky_panorama(&sky, &image, 0, -16385), ZS_ERR_RANGE);
    assert_int_equal(zs_sky_panorama(&sky, &image, 64, 0), ZS_OK);
}

/* ---- Environment maps ---------------------------------------------------------------------------------- */

static double worst_map;

static int map_case(uint64_t seed)
{
    struct prng p = { seed };
    int16_t normal[1][3];
    const struct zs_texture texture = { .log2_w = (uint8_t)prng_pick(&p, 11), .log2_h = (uint8_t)prng_pick(&p, 11) };
    const struct zs_material material = { .texture = &texture };
    const uint32_t least = texture.log2_w > texture.log2_h ? texture.log2_w : texture.log2_h;
    const struct zs_mesh mesh = { .normal = normal, .uv_bits = (uint8_t)prng_range(&p, (int32_t)least + 1, 15) };
    struct zs_instance in = { .mesh = &mesh, .material = &material };
    struct zs_camera camera;
    const struct zs_shading s = { .instance = &in, .camera = &camera };
    uint16_t out[2];
    double n[3], world[3] = { 0, 0, 0 };
    if (!any_camera(&camera, &p, 100))
        return 1;
    zs_pose_turn(&in.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    for (int k = 0; k < 3; k++)
        n[k] = prng_range(&p, -99, 99) + 0.5;
    if (prng_pick(&p, 4) == 0) /* at the border */
        for (int k = 0; k < 3; k++) {
            n[k] = 0;
            for (int i = 0; i < 3; i++)
                n[k] += q30(in.pose.rot[3 * i + k]) * q30(camera.rot[i]);
        }
    unit3(n);
    for (int k = 0; k < 3; k++) {
        normal[0][k] = (int16_t)lrint(32767 * n[k]);
        n[k] = normal[0][k] / 32768.0;
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            world[k] += q30(in.pose.rot[3 * k + i]) * n[i];
    zs_shade_matcap.vertex(&s, 0, out);
    for (int i = 0; i < 2; i++) {
        double along = 0;
        for (int k = 0; k < 3; k++)
            along += q30(camera.rot[3 * i + k]) * world[k];
        const double size = ldexp(1, i ? texture.log2_h : texture.log2_w), step = ldexp(1, -mesh.uv_bits);
        const double want = 0.5 + (i ? -along : along) / 2 * (1 - 1 / size);
        const double got = (out[i] - 32768) * step, off = fabs(got - want) - step / 2;
        if (off > worst_map)
            worst_map = off;
        CASE_CHECK(off < ldexp(1, -15) * sqrt(2));
        CASE_CHECK(got >= 0.5 / size - step && got <= 1 - 0.5 / size + step);
    }
    return 1;
}

static void a_map_is_looked_up_by_the_normal(void **state)
{
    (void)state;
    worst_map = 0;
    CASES(map_case, 20000);
    print_message("off by at most 2^%.1f\n", log2(worst_map));
}

/* A quad that faces the camera shows one texel: the one that its normals say. */
static void a_map_is_drawn(void **state)
{
    static const int16_t pos[4][3] = { { -50, -50, 0 }, { 50, -50, 0 }, { 50, 50, 0 }, { -50, 50, 0 } };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    static uint16_t texel[16][16];
    static const struct zs_texture texture = { .format = &zs_texel_565, .texel = texel, .log2_w = 4, .log2_h = 4 };
    int16_t normal[4][3];
    const struct zs_material material = { .shader = &zs_shade_matcap, .texture = &texture };
    struct zs_mesh mesh = {
        .pos = pos, .tri = tri, .normal = normal, .n_verts = 4, .n_tris = 2, .radius = 71, .uv_bits = 15
    };
    const struct zs_instance in = { .mesh = &mesh, .material = &material, .pose.pos = { 0, 0, -40 } };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_camera camera;
    const struct zs_config c = picture_config(32, 24, &zs_depth_float);
    (void)state;
    for (int i = 0; i < 256; i++)
        texel[i / 16][i % 16] = (uint16_t)(i + 1);
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 24, 5, 100), ZS_OK);
    for (int i = -9; i <= 9; i += 3)
        for (int k = -9; k <= 9; k += 3) {
            double n[3] = { i * 0.1 + 0.01, k * 0.1 + 0.01, 0 };
            const double rest = 1 - n[0] * n[0] - n[1] * n[1];
            if (rest <= 0)
                continue;
            n[2] = sqrt(rest);
            for (int v = 0; v < 4; v++)
                for (int j = 0; j < 3; j++)
                    normal[v][j] = (int16_t)lrint(32767 * n[j]);
            struct picture got = picture_draw(&c, &scene, &camera);
            assert_int_equal(got.err, ZS_OK);
            const int u = (int)floor(8 + n[0] * 7.5), w = (int)floor(8 - n[1] * 7.5);
            for (int at = 0; at < 32 * 24; at++)
                assert_int_equal(got.color[at], 16 * w + u + 1);
            picture_free(&got);
        }
    struct zs_texture wrong = texture;
    struct zs_material other = { .shader = &zs_shade_matcap, .texture = &wrong };
    const struct zs_instance bad = { .mesh = &mesh, .material = &other };
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_OK);
    mesh.uv_bits = 4;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_ERR_MESH);
    mesh.uv_bits = 16;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_ERR_MESH);
    mesh.uv_bits = 5;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_OK);
    mesh.normal = NULL;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_ERR_MESH);
    mesh.normal = normal;
    wrong.log2_w = 11;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_ERR_TEXTURE);
    wrong.log2_w = 4;
    wrong.texel = NULL;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_ERR_NULL);
    other.texture = NULL;
    assert_int_equal(zs_shade_matcap.check(&bad, &c), ZS_ERR_NULL);
}

/* ---- Billboards ------------------------------------------------------------------------------------------ */

/* Its picture is an upright rectangle of its size over its distance. */
static int billboard_case(uint64_t seed)
{
    static const int16_t pos[4][3] = { { -300, -200, 0 }, { 300, -200, 0 }, { 300, 200, 0 }, { -300, 200, 0 } };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    static const struct zs_material material = { .shader = &zs_shade_raw, .rgb = { 255, 255, 255 } };
    static const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 361 };
    struct zs_instance in = { .mesh = &mesh, .material = &material };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct prng p = { seed };
    struct zs_camera camera;
    if (!any_camera(&camera, &p, 120))
        return 1;
    const int32_t away = prng_range(&p, 500, 3000);
    for (int k = 0; k < 3; k++)
        in.pose.pos[k] = camera.pos[k] + (int32_t)lrint(away * -q30(camera.rot[6 + k]) + prng_range(&p, -100, 100));
    zs_pose_face(&in.pose, &camera);
    double c[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            c[i] += q30(camera.rot[3 * i + k]) * (in.pose.pos[k] - camera.pos[k]);
    const double f = ldexp((double)camera.focal, -32), z = -c[2];
    const struct zs_config config = picture_config(160, 120, &zs_depth_float);
    struct picture got = picture_draw(&config, &scene, &camera);
    int ok = got.err == ZS_OK;
    for (int y = 0; y < 120 && ok; y++)
        for (int x = 0; x < 160 && ok; x++) {
            const double dx = 300 - fabs((x + 0.5 - 80) * z / f - c[0]),
                         dy = 200 - fabs((60 - y - 0.5) * z / f - c[1]);
            const double close = 0.01 * z / f, in_it = fmin(dx, dy);
            if (fabs(in_it) > close)
                ok = (got.color[y * 160 + x] == 0xffff) == (in_it > 0) || case_wrong("pixel %d, %d", x, y);
        }
    picture_free(&got);
    return ok;
}

static int upright_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_pose pose = { .pos = { prng_range(&p, -9999, 9999), prng_range(&p, -9999, 9999), 20000 } };
    struct zs_camera camera;
    int32_t up[3];
    double y[3], eye[3], along = 0, want[9];
    if (!any_camera(&camera, &p, 100))
        return 1;
    if (seed % 4 == 0) /* all rays are parallel: where it stands does not matter */
        camera.projection = ZS_ORTHOGRAPHIC;
    for (int k = 0; k < 3; k++)
        up[k] = prng_range(&p, -99, 99);
    up[1] |= 1;
    for (int k = 0; seed % 4 == 1 && k < 3; k++) /* it is some 5,000 beside the axis, and far along it */
        camera.pos[k] = pose.pos[k] + 1000000 * up[k] + (k == 0 ? 5000 : 0);
    CASE_CHECK(zs_pose_face_upright(&pose, &camera, up) == ZS_OK);
    for (int k = 0; k < 3; k++)
        y[k] = up[k];
    unit3(y);
    for (int k = 0; k < 3; k++) {
        eye[k] = seed % 4 == 0 ? q30(camera.rot[6 + k]) : camera.pos[k] - pose.pos[k];
        along += y[k] * eye[k];
    }
    for (int k = 0; k < 3; k++)
        eye[k] -= along * y[k];
    unit3(eye);
    for (int k = 0; k < 3; k++) {
        want[3 * k] = y[(k + 1) % 3] * eye[(k + 2) % 3] - y[(k + 2) % 3] * eye[(k + 1) % 3];
        want[3 * k + 1] = y[k];
        want[3 * k + 2] = eye[k];
    }
    CASE_CHECK(apart(pose.rot, want) < 0x1p-26);
    CASE_CHECK(not_a_rotation(pose.rot) < 0x1p-26);
    return 1;
}

static void a_tree_stands_upright(void **state)
{
    struct zs_pose pose = { .pos = { 5, 5, 5 } };
    const struct zs_pose before = pose;
    struct zs_camera camera = { .pos = { 5, 9, 5 } };
    int32_t up[3] = { 0, 0, 0 };
    (void)state;
    CASES(upright_case, 2000);
    assert_int_equal(zs_pose_face_upright(&pose, &camera, up), ZS_ERR_VECTOR);
    for (int t = 0; t < 4; t++) { /* the eye is above */
        static const int32_t way[4][3] = { { 0, 4, 0 }, { 1, 2, 3 }, { 3, -4, 12 }, { 7, 5, -2 } };
        for (int k = 0; k < 3; k++)
            camera.pos[k] = pose.pos[k] + 1000 * way[t][k];
        assert_int_equal(zs_pose_face_upright(&pose, &camera, way[t]), ZS_ERR_VECTOR);
    }
    up[1] = 7;
    camera.pos[0] = -ZS_WORLD_MAX - 1;
    assert_int_equal(zs_pose_face_upright(&pose, &camera, up), ZS_ERR_RANGE);
    assert_memory_equal(&pose, &before, sizeof pose);
}

/* A camera that zs_frame_begin refuses: any colours, but no shift beyond a word (UBSan). */
static void a_sky_bears_any_camera(void **state)
{
    static struct zs_sky_gradient sky;
    static const struct zs_rgb color[4] = { { 1, 2, 3 }, { 9, 9, 9 }, { 50, 50, 50 }, { 255, 255, 255 } };
    static const struct zs_rect all = { 0, 0, 64, 48 };
    uint16_t out[64];
    (void)state;
    zs_sky_gradient(&sky, color);
    for (int bit = 0; bit < 64; bit++) {
        const struct zs_camera camera = { .focal = UINT64_MAX >> bit };
        zs_sky_look(&sky.sky, &camera, &all, NULL);
        for (uint16_t y = 0; y < 48; y += 47)
            sky.sky.background.fill(sky.sky.background.ctx, out, 0, y, 64);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_sky_bears_any_camera),
    cmocka_unit_test(a_panorama_is_where_it_should_be),
    CASES_TEST(a_row_may_be_cut, cut_case, 200),
    cmocka_unit_test(a_group_is_interpolated),
    cmocka_unit_test(a_panorama_of_one_row),
    cmocka_unit_test(a_gradient_follows_the_pitch),
    cmocka_unit_test(wrong_skies_are_refused),
    cmocka_unit_test(a_map_is_looked_up_by_the_normal),
    cmocka_unit_test(a_map_is_drawn),
    CASES_TEST(a_billboard_is_parallel_to_the_screen, billboard_case, 200),
    cmocka_unit_test(a_tree_stands_upright),
};
CASES_MAIN(tests)
