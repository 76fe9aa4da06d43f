/* Blending shaders and screen-door patterns: every alpha with every pair of codes against doubles; depth tests against
 * opaque shaders that do not write; patterns against a matrix built another way.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "../lab/fuzz/world.h"
#include "cases.h"
#include "picture.h"
#include "zs_blend.h"
#include "zs_filter.h"
#include "zs_lines.h"
#include "zs_method.h"

/* ---- Every alpha, every pair of codes --------------------------------------------------------- */

#define N 64 /* columns: old colours; rows: sources */

static uint16_t old_of(uint32_t x)
{
    return (uint16_t)((x * 7u & 31u) << 11 | (x * 11u & 63u) << 5 | (x * 5u & 31u));
}

/* Another permutation of the codes in each channel: a channel that leaks into its neighbour is seen. */
static uint16_t source_of(uint32_t y)
{
    return (uint16_t)((y * 13u & 31u) << 11 | (y * 5u & 63u) << 5 | (y * 3u & 31u));
}

static void old_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    (void)ctx;
    (void)y;
    for (uint32_t k = 0; k < n; k++) {
        const uint16_t c = old_of(x + k);
        ((uint8_t *)&out[k])[0] = (uint8_t)(c >> 8);
        ((uint8_t *)&out[k])[1] = (uint8_t)c;
    }
}

static const uint32_t first_bit[3] = { 11, 5, 0 }, most[3] = { 31, 63, 31 };

/* The largest error of a channel. */
static double error_of(uint32_t is, uint32_t old, uint32_t source, double alpha, int add)
{
    double worst = 0;
    for (int c = 0; c < 3; c++) {
        const double d = old >> first_bit[c] & most[c], s = source >> first_bit[c] & most[c];
        const double sum = add ? d + s * alpha / 255. : (s * alpha + d * (255. - alpha)) / 255.;
        const double want = sum > most[c] ? most[c] : sum;
        worst = fmax(worst, fabs((is >> first_bit[c] & most[c]) - want));
    }
    return worst;
}

/* A row of the frame is a strip of two triangles of one source colour. An orthographic camera: a unit is a pixel. */
struct rows {
    int16_t pos[N * 4][3], uv[N * 4][2];
    uint16_t tri[N * 2][3], raw[N * 2], texel[N * N], palette[2 * N];
    uint8_t number[N * N];
    struct zs_texture texture;
    struct zs_mesh mesh;
};

static void rows_set(struct rows *m)
{
    for (uint32_t y = 0; y < N; y++) {
        for (uint32_t k = 0; k < 4; k++) {
            const uint32_t right = k == 1 || k == 2, down = k >= 2;
            m->pos[4 * y + k][0] = right ? N / 2 : -N / 2;
            m->pos[4 * y + k][1] = (int16_t)(N / 2 - (int32_t)(y + down));
            m->pos[4 * y + k][2] = -2;
            m->uv[4 * y + k][0] = right ? 64 : 0;
            m->uv[4 * y + k][1] = (int16_t)(y + down);
        }
        for (uint32_t k = 0; k < 2; k++) {
            const uint16_t at = (uint16_t)(4 * y);
            const uint16_t corner[2][3] = { { at, (uint16_t)(at + 2), (uint16_t)(at + 1) },
                                            { at, (uint16_t)(at + 3), (uint16_t)(at + 2) } };
            memcpy(m->tri[2 * y + k], corner[k], sizeof corner[k]);
            m->raw[2 * y + k] = source_of(y);
        }
        for (uint32_t x = 0; x < N; x++)
            m->texel[y * N + x] = source_of(y);
        memset(m->number + y * N, (int)y, N);
        m->palette[y] = source_of(y);
    }
    m->texture = (struct zs_texture){ .format = &zs_texel_565, .texel = m->texel, .log2_w = 6, .log2_h = 6 };
    m->mesh = (struct zs_mesh){ .pos = m->pos, .tri = m->tri, .face_raw = m->raw, .uv = m->uv, .uv_bits = 6,
                                .n_verts = 4 * N, .n_tris = 2 * N, .radius = 60 };
}

/* depth_state: func ALWAYS takes the general loop, NULL the usual one. */
static void all_pairs(const struct zs_shader *shader, int add, const struct zs_depth_state *state,
                      const struct zs_depth *depth, uint32_t step)
{
    static struct rows m;
    const struct zs_background sky = { .fill = old_fill };
    struct zs_camera camera;
    double worst = 0;
    rows_set(&m);
    assert_int_equal(zs_camera_orthographic(&camera, N, 1, 10), ZS_OK);
    for (uint32_t alpha = 0; alpha < 256; alpha += step) {
        const struct zs_blend blend = { .material = { .shader = shader, .texture = &m.texture, .cull = ZS_CULL_NONE },
                                        .alpha = (uint8_t)alpha };
        const struct zs_instance instance = { .mesh = &m.mesh, .material = &blend.material, .depth_state = state };
        const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .sky = &sky };
        const struct zs_config c = picture_config(N, N, depth);
        struct picture is = picture_draw(&c, &scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        assert_int_equal(is.covered, 0);
        for (uint32_t y = 0; y < N; y++)
            for (uint32_t x = 0; x < N; x++) {
                const uint16_t old = old_of(x), source = source_of(y), got = is.color[y * N + x];
                worst = fmax(worst, error_of(got, old, source, alpha, add));
                if (alpha == 0 || (!add && old == source))
                    assert_int_equal(got, old);
                if (alpha == 255 && !add)
                    assert_int_equal(got, source);
            }
        picture_free(&is);
    }
    print_message("largest error %.4f code\n", worst);
    assert_true(worst < 1.);
}

static const struct zs_depth_state always = { .func = ZS_DEPTH_ALWAYS };

static void one_color_is_mixed_within_a_code(void **state)
{
    (void)state;
    all_pairs(&zs_blend_raw, 0, NULL, &zs_depth_linear, 1);
    all_pairs(&zs_blend_raw, 0, &always, &zs_depth_linear, 15);
    all_pairs(&zs_blend_raw, 0, NULL, &zs_depth_none, 15);
}

static void one_color_is_added_within_a_code(void **state)
{
    (void)state;
    all_pairs(&zs_add_raw, 1, NULL, &zs_depth_linear, 1);
    all_pairs(&zs_add_raw, 1, &always, &zs_depth_linear, 15);
    all_pairs(&zs_add_raw, 1, NULL, &zs_depth_none, 15);
}

static void texels_are_mixed_and_added_within_a_code(void **state)
{
    (void)state;
    all_pairs(&zs_blend_texture, 0, NULL, &zs_depth_linear, 1);
    all_pairs(&zs_add_texture, 1, NULL, &zs_depth_linear, 1);
}

/* Texels with alphas of their own: their product with the material's. */
static void texels_with_alpha(void **state)
{
    static struct rows m;
    const struct zs_background sky = { .fill = old_fill };
    struct zs_camera camera;
    struct prng p = { 3 };
    double worst = 0;
    (void)state;
    rows_set(&m);
    assert_int_equal(zs_camera_orthographic(&camera, N, 1, 10), ZS_OK);
    m.texture = (struct zs_texture){ .format = &zs_texel_pal8a, .texel = m.number, .palette = m.palette, .n_colors = N,
                                     .log2_w = 6, .log2_h = 6 };
    for (uint32_t k = 0; k < 512; k++) {
        const uint32_t texels = k < 256 ? k : prng_pick(&p, 256), alpha = k < 256 ? 255 - k % 2 : prng_pick(&p, 256);
        const int add = (int)prng_pick(&p, 2);
        const struct zs_blend blend = { .material = { .shader = add ? &zs_add_texture : &zs_blend_texture,
                                                      .texture = &m.texture, .cull = ZS_CULL_NONE },
                                        .alpha = (uint8_t)alpha };
        const struct zs_instance instance = { .mesh = &m.mesh, .material = &blend.material };
        const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .sky = &sky };
        struct zs_config c = picture_config(N, N, &zs_depth_linear);
        for (uint32_t y = 0; y < N; y++)
            m.palette[N + y] = (uint16_t)texels;
        c.strip_h = (uint16_t)prng_range(&p, 1, N);
        struct picture is = picture_draw(&c, &scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        for (uint32_t y = 0; y < N; y++)
            for (uint32_t x = 0; x < N; x++) {
                const uint16_t old = old_of(x), source = source_of(y), got = is.color[y * N + x];
                worst = fmax(worst, error_of(got, old, source, texels * alpha / 255., add));
                if (texels == 0 || alpha == 0)
                    assert_int_equal(got, old);
                if (texels == 255 && alpha == 255 && !add)
                    assert_int_equal(got, source);
            }
        picture_free(&is);
    }
    print_message("largest error %.4f code\n", worst);
    assert_true(worst < 1.);
}

/* ---- Random worlds ---------------------------------------------------------------------------- */

/* A world in two ways: some instances with a shader of a kind, and the same with what that should draw. */
struct twins {
    struct world w;
    struct zs_instance *as[2];
    struct zs_blend blend[WORLD_MATERIALS][2];
    struct zs_depth_state *state;
    uint32_t changed;
};

static int family_of(const struct zs_shader *shader)
{
    for (int k = 0; k < 6; k++)
        if (layer_shaders[k][OPAQUE] == shader)
            return k;
    return -1;
}

/* kinds: the shader of each; NOTHING: one that draws nothing. read_only: keys of the second are not written. */
#define NOTHING (-1)
static void twins_make(struct twins *t, struct prng *p, int kind, int other, uint8_t alpha, uint8_t phase,
                       int read_only)
{
    world_make(&t->w, p, 0);
    const uint32_t n = t->w.n_instances;
    t->changed = 0;
    t->state = calloc(n ? n : 1, sizeof *t->state);
    for (int k = 0; k < 2; k++) {
        t->as[k] = calloc(n ? n : 1, sizeof *t->as[k]);
        for (int j = 0; j < WORLD_MATERIALS; j++) {
            const int family = family_of(t->w.material[j].shader);
            const int to = k ? other : kind;
            t->blend[j][k] = (struct zs_blend){ .material = t->w.material[j], .alpha = alpha, .phase = phase };
            if (family >= 0)
                t->blend[j][k].material.shader = to == NOTHING ? &zs_shade_none : layer_shaders[family][to];
        }
        for (uint32_t i = 0; i < n; i++) {
            struct zs_instance *in = &t->as[k][i];
            *in = t->w.instance[i];
            const int j = in->material ? (int)(in->material - t->w.material) : 0;
            if (i % 2 || !in->material || family_of(in->material->shader) < 0)
                continue;
            in->material = &t->blend[j][k].material;
            t->changed++;
            if (k == 0 || !read_only)
                continue;
            if (in->depth_state)
                t->state[i] = *in->depth_state;
            t->state[i].read_only = 1;
            in->depth_state = &t->state[i];
        }
    }
}

static void twins_free(struct twins *t)
{
    free(t->as[0]);
    free(t->as[1]);
    free(t->state);
    world_free(&t->w);
}

static struct zs_config any_config(struct prng *p, const struct twins *t)
{
    static const struct zs_depth *const any[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_e3m13, &zs_depth_e5m11,
                                                  &zs_depth_float, &zs_depth_none };
    const int perspective = t->w.camera.projection == ZS_PERSPECTIVE;
    struct zs_config c = picture_config(prng_range(p, 1, 90), prng_range(p, 1, 70),
                                        perspective ? any[prng_pick(p, 6)] : any[prng_pick(p, 4) ? 1 : 5]);
    c.varyings = ZS_VARYINGS_MAX;
    c.depth_bits = (uint8_t)prng_range(p, 8, 16);
    return c;
}

static struct picture drawn(const struct twins *t, int k, const struct zs_config *c)
{
    struct zs_scene scene = t->w.scene;
    if (scene.instance == t->w.instance)
        scene.instance = t->as[k];
    return picture_draw(c, &scene, &t->w.camera);
}

static unsigned pixels;

/* Both twins, drawn in different ways, are the same, bit for bit, keys too. */
static int same_case(uint64_t seed, int kind, int other, uint8_t alpha, int read_only)
{
    struct prng p = { seed };
    static struct twins t;
    twins_make(&t, &p, kind, other, alpha, (uint8_t)prng_pick(&p, 64), read_only);
    struct zs_config c = any_config(&p, &t);
    c.fast = NULL;
    struct picture want = drawn(&t, 1, &c);
    if (prng_pick(&p, 4) == 0 && c.depth != &zs_depth_none)
        c.method = &zs_method_hiz;
    picture_any_way(&p, &c, 1, 3);
    struct picture is = drawn(&t, 0, &c);
    pixels += t.changed && !is.err ? is.covered : 0;
    const int right = picture_alike(&want, &is, "the other way");
    if (!right)
        world_print(&t.w);
    twins_free(&t);
    return right;
}

static int all_case(uint64_t seed)
{
    return same_case(seed, BLEND, OPAQUE, 255, 1);
}

static int nothing_case(uint64_t seed)
{
    return same_case(seed, seed % 2 ? BLEND : ADD, NOTHING, 0, 1);
}

static int door_open_case(uint64_t seed)
{
    return same_case(seed, STIPPLE, NOTHING, 0, 1);
}

static int door_shut_case(uint64_t seed)
{
    return same_case(seed, STIPPLE, OPAQUE, 255, 0);
}

static int way_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint8_t alpha = (uint8_t)prng_pick(&p, 256);
    const int kind = BLEND + (int)prng_pick(&p, 3);
    return same_case(seed, kind, kind, alpha, 0);
}

/* ---- Keys that saturate ----------------------------------------------------------------------- */

static int16_t far_pos[6][3];

/* Two triangles at the far plane, where keys are held to the last bucket, the second with any depth state: by a shader
 * of its own test, and by the opaque one. */
static int far_case(uint64_t seed)
{
    static const uint16_t tri[1][3] = { { 0, 1, 2 } };
    static const struct zs_depth *const any[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_e3m13, &zs_depth_e5m11 };
    struct prng p = { seed };
    const int door = (int)prng_pick(&p, 2);
    struct zs_camera camera;
    struct zs_mesh mesh[2];
    struct zs_depth_state state = { .func = (uint8_t)prng_pick(&p, 3), .read_only = !door || prng_pick(&p, 2),
                                    .bias = (int16_t)prng_range(&p, -3, 3) };
    const struct zs_depth_state *const asked = door && prng_pick(&p, 3) == 0 ? NULL : &state;
    struct zs_blend blend[2] = {
        { .material = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x00ff00), .cull = ZS_CULL_NONE }, .alpha = 255 },
        { .material = { .rgb = ZS_RGB(0xff0000), .cull = ZS_CULL_NONE }, .alpha = 255 }
    };
    struct picture is[2];
    for (int k = 0; k < 6; k++) {
        far_pos[k][2] = (int16_t)-prng_range(&p, 9997, 10000);
        far_pos[k][0] = (int16_t)prng_range(&p, -4000, 4000);
        far_pos[k][1] = (int16_t)prng_range(&p, -4000, 4000);
    }
    for (int k = 0; k < 2; k++)
        mesh[k] = (struct zs_mesh){ .pos = far_pos + 3 * k, .tri = tri, .n_verts = 3, .n_tris = 1, .radius = 65535 };
    if (zs_camera_perspective(&camera, ZS_DEGREES(40), 24, 100, 10000))
        return case_wrong("camera");
    struct zs_config c = picture_config(32, 24, any[prng_pick(&p, 4)]);
    c.depth_bits = (uint8_t)prng_range(&p, 8, 16);
    for (int k = 0; k < 2; k++) {
        blend[1].material.shader = k == 0 ? &zs_shade_raw : door ? &zs_stipple_raw : &zs_blend_raw;
        const struct zs_instance in[2] = { { .mesh = &mesh[0], .material = &blend[0].material },
                                           { .mesh = &mesh[1], .material = &blend[1].material, .depth_state = asked } };
        const struct zs_scene scene = { .instance = in, .n_instances = 2 };
        c.fast = NULL;
        is[k] = picture_draw(&c, &scene, &camera);
    }
    const int right = !is[0].err && !is[1].err && picture_same(&is[0], &is[1], "at the far plane");
    pixels += is[1].covered;
    PICTURES_FREE(&is[0], &is[1]);
    return right || case_wrong("errors %d and %d", is[0].err, is[1].err);
}

/* ---- The pattern ------------------------------------------------------------------------------ */

/* Bayer's matrix by its recursion: M of 2n is 4 M of n + { 0, 2; 3, 1 }. */
static uint32_t bayer_of(uint32_t x, uint32_t y, uint32_t n)
{
    static const uint32_t two[2][2] = { { 0, 2 }, { 3, 1 } };
    if (n == 1)
        return 0;
    n /= 2;
    return 4 * bayer_of(x % n, y % n, n) + two[y / n % 2][x / n % 2];
}

/* Each pixel is that of the frame with the instances, opaque, or of that without them. */
static int pattern_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct twins t;
    const uint8_t alpha = (uint8_t)prng_pick(&p, 256), phase = (uint8_t)prng_pick(&p, 256);
    twins_make(&t, &p, STIPPLE, OPAQUE, alpha, phase, 0);
    struct zs_config c = any_config(&p, &t);
    c.fast = NULL;
    struct picture all = drawn(&t, 1, &c);
    twins_free(&t);
    p.state = seed;
    prng_pick(&p, 256);
    prng_pick(&p, 256);
    twins_make(&t, &p, STIPPLE, NOTHING, alpha, phase, 1);
    struct picture none = drawn(&t, 1, &c);
    const uint32_t level = (alpha * 64u + 127u) / 255u;
    for (int32_t y = 0; !all.err && y < all.h; y++)
        for (int32_t x = 0; x < all.w; x++) {
            const uint32_t at = (uint32_t)(y * all.w + x);
            if (bayer_of((uint32_t)x + phase % 8u, (uint32_t)y + phase / 8u, 8) < level)
                continue;
            all.color[at] = none.color[at];
            all.key[at] = none.key[at];
        }
    picture_any_way(&p, &c, 1, 3);
    struct picture is = drawn(&t, 0, &c);
    all.covered = is.covered;
    const int right = all.err == is.err && none.err == is.err && (is.err || picture_same(&all, &is, "by the pattern"));
    pixels += t.changed && !is.err ? is.covered : 0;
    PICTURES_FREE(&all, &none, &is);
    twins_free(&t);
    return right || case_wrong("errors %d, %d and %d", all.err, none.err, is.err);
}

static void every_level_has_its_share(void **state)
{
    static struct rows m;
    struct zs_camera camera;
    (void)state;
    rows_set(&m);
    assert_int_equal(zs_camera_orthographic(&camera, N, 1, 10), ZS_OK);
    for (uint32_t alpha = 0; alpha < 256; alpha++) {
        const struct zs_blend blend = { .material = { .shader = &zs_stipple_raw, .cull = ZS_CULL_NONE },
                                        .alpha = (uint8_t)alpha, .phase = (uint8_t)(alpha % 64) };
        const struct zs_instance instance = { .mesh = &m.mesh, .material = &blend.material };
        const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
        const struct zs_config c = picture_config(N, N, &zs_depth_linear);
        struct picture is = picture_draw(&c, &scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        assert_int_equal(is.covered, (alpha * 64 + 127) / 255 * (N * N / 64));
        picture_free(&is);
    }
}

/* In a viewport, the pattern stays where it is in the frame. */
static void the_pattern_is_the_frames(void **state)
{
    static struct rows m;
    struct zs_camera camera;
    (void)state;
    rows_set(&m);
    assert_int_equal(zs_camera_orthographic(&camera, 40, 1, 10), ZS_OK);
    const struct zs_blend blend = { .material = { .shader = &zs_stipple_raw, .cull = ZS_CULL_NONE }, .alpha = 100 };
    const struct zs_instance instance = { .mesh = &m.mesh, .material = &blend.material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    const struct zs_pass pass = { .scene = &scene, .camera = &camera, .viewport = { 13, 5, 30, 40 } };
    struct zs_config c = picture_config(N, N, &zs_depth_linear);
    c.strip_h = 7;
    struct picture is = picture_passes(&c, &pass, 1);
    assert_int_equal(is.err, ZS_OK);
    for (uint32_t y = 0; y < N; y++)
        for (uint32_t x = 0; x < N; x++)
            assert_int_equal(is.key[y * N + x] != ZS_DEPTH_CLEAR,
                             x >= 13 && x < 43 && y >= 5 && y < 45 && bayer_of(x, y, 8) < (100 * 64 + 127) / 255);
    picture_free(&is);
}

/* ---- What is refused ------------------------------------------------------------------------- */

static int refused(const struct zs_shader *shader, const struct zs_mesh *mesh, const struct zs_texture *texture,
                   uint8_t phase, uint8_t varyings)
{
    struct zs_camera camera;
    const struct zs_blend blend = { .material = { .shader = shader, .texture = texture },
                                    .alpha = 100,
                                    .phase = phase };
    const struct zs_instance instance = { .mesh = mesh, .material = &blend.material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    struct zs_config c = picture_config(N, N, &zs_depth_linear);
    c.varyings = varyings;
    if (zs_camera_orthographic(&camera, N, 1, 10))
        return 1;
    struct picture is = picture_draw(&c, &scene, &camera);
    picture_free(&is);
    return is.err;
}

static void what_shaders_lack_is_refused(void **state)
{
    static struct rows m;
    (void)state;
    rows_set(&m);
    struct zs_mesh bare = m.mesh;
    bare.uv = NULL;
    for (int kind = BLEND; kind <= STIPPLE; kind++) {
        assert_int_equal(refused(layer_shaders[0][kind], &bare, NULL, 0, 0), ZS_OK);
        assert_int_equal(refused(layer_shaders[1][kind], &bare, NULL, 0, 0), ZS_OK);
        assert_int_equal(refused(layer_shaders[2][kind], &bare, NULL, 0, 3), ZS_ERR_MESH);
        assert_int_equal(refused(layer_shaders[2][kind], &bare, NULL, 0, 2), ZS_ERR_VARYINGS);
        assert_int_equal(refused(layer_shaders[3][kind], &m.mesh, &m.texture, 0, 2), ZS_OK);
        assert_int_equal(refused(layer_shaders[3][kind], &m.mesh, &m.texture, 0, 1), ZS_ERR_VARYINGS);
        for (int k = 3; k < 6; k++) {
            assert_int_equal(refused(layer_shaders[k][kind], &bare, &m.texture, 0, 3), ZS_ERR_MESH);
            assert_int_equal(refused(layer_shaders[k][kind], &m.mesh, NULL, 0, 3), k < 5 ? ZS_ERR_NULL : ZS_ERR_MESH);
        }
        assert_int_equal(refused(layer_shaders[5][kind], &m.mesh, &m.texture, 0, 3), ZS_ERR_MESH);
    }
    assert_int_equal(refused(&zs_stipple_raw, &bare, NULL, 255, 0), ZS_OK);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(one_color_is_mixed_within_a_code),
    cmocka_unit_test(one_color_is_added_within_a_code),
    cmocka_unit_test(texels_are_mixed_and_added_within_a_code),
    cmocka_unit_test(texels_with_alpha),
    CASES_COUNT(alpha_255_is_the_opaque_shader_that_writes_no_key, all_case, 300, &pixels, 50000, "pixels"),
    CASES_COUNT(alpha_0_is_nothing, nothing_case, 200, &pixels, 20000, "pixels"),
    CASES_COUNT(a_door_of_alpha_0_is_nothing, door_open_case, 100, &pixels, 10000, "pixels"),
    CASES_COUNT(a_door_of_alpha_255_is_the_opaque_shader, door_shut_case, 200, &pixels, 20000, "pixels"),
    CASES_COUNT(blending_is_the_same_in_any_way, way_case, 300, &pixels, 50000, "pixels"),
    CASES_COUNT(keys_saturate_as_those_of_the_opaque_shader, far_case, 1500, &pixels, 50000, "pixels"),
    CASES_COUNT(pixels_of_a_door_are_by_the_pattern, pattern_case, 200, &pixels, 20000, "pixels"),
    cmocka_unit_test(every_level_has_its_share),
    cmocka_unit_test(the_pattern_is_the_frames),
    cmocka_unit_test(what_shaders_lack_is_refused)
};

CASES_MAIN(tests)
