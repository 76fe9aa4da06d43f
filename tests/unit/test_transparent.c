/* Sorted layers: the frame of single triangles, drawn one after another in an order that qsort has made; the same for
 * any pools, strips and accelerators; faces that cross, by this method and by depth sort.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "../lab/fuzz/world.h"
#include "cases.h"
#include "method_needs.h"
#include "own.h"
#include "picture.h"
#include "ways.h"
#include "zs_blend.h"
#include "zs_lines.h"
#include "zs_method.h"

/* ---- Against single triangles ----------------------------------------------------------------- */

#define TRIS 60
#define MATERIALS 5

static int16_t pos[TRIS * 3][3];
static uint16_t color[TRIS];
static uint8_t of_material[TRIS];
static const uint16_t one[1][3] = { { 0, 1, 2 } };
static struct zs_blend material[MATERIALS];
static struct zs_mesh mesh[TRIS];
static struct zs_instance instances[TRIS], sorted[TRIS];

static int is_layer(uint32_t t)
{
    return material[of_material[t]].material.shader->layer;
}

/* Opaque ones in scene order, then layers from far to near. */
static int in_order(const void *a, const void *b)
{
    const uint32_t ta = *(const uint32_t *)a, tb = *(const uint32_t *)b;
    const int32_t da = ways_distance(pos, ta), db = ways_distance(pos, tb);
    if (is_layer(ta) != is_layer(tb))
        return is_layer(ta) - is_layer(tb);
    if (is_layer(ta) && da != db)
        return (da < db) - (da > db);
    return (ta > tb) - (ta < tb);
}

/* A layer of a user's own; it does not commute with others. */
static void tint(const struct zs_instance *instance, struct zs_fragment *f)
{
    *f->color = (uint16_t)(*f->color * 3u + instance->material->rgb.r + f->x);
}

static const struct zs_shader tint_shader = { .fragment = tint, ZS_FRAGMENTS, ZS_LAYER };

static void materials_set(struct prng *p)
{
    static const struct zs_shader *const any[] = { &zs_shade_raw, &zs_blend_raw, &zs_add_raw, &zs_stipple_raw,
                                                   &tint_shader };
    for (uint32_t k = 0; k < MATERIALS; k++)
        material[k] = (struct zs_blend){ .material = { .shader = any[k], .cull = ZS_CULL_NONE, .rgb.r = 77 },
                                         .alpha = (uint8_t)prng_pick(p, 256),
                                         .phase = (uint8_t)prng_pick(p, 64) };
}

/* Triangle t, an instance of some material, in front of a camera that looks down -z. */
static void triangle_set(uint32_t t, struct prng *p, int32_t nearest, int32_t depth)
{
    color[t] = (uint16_t)(prng_next(p) | 1u);
    of_material[t] = (uint8_t)prng_pick(p, MATERIALS);
    for (uint32_t v = 3 * t; v < 3 * t + 3; v++) {
        pos[v][2] = (int16_t)-(nearest + prng_range(p, 0, depth));
        pos[v][0] = (int16_t)(prng_range(p, -800, 800) * -pos[v][2] / 1000);
        pos[v][1] = (int16_t)(prng_range(p, -800, 800) * -pos[v][2] / 1000);
    }
    mesh[t] = (struct zs_mesh){ .pos = pos + 3 * t, .tri = one, .face_raw = color + t, .n_verts = 3, .n_tris = 1,
                                .radius = 65535 };
    instances[t] = (struct zs_instance){ .mesh = &mesh[t], .material = &material[of_material[t]].material };
}

/* New materials, the camera, and the triangles in the scene's order. */
static int begin(struct prng *p, struct zs_camera *camera, uint32_t order[TRIS], uint32_t n)
{
    materials_set(p);
    for (uint32_t t = 0; t < n; t++)
        order[t] = t;
    return !zs_camera_perspective(camera, ZS_DEGREES(60), 48, 100, 40000) || case_wrong("camera");
}

static unsigned walks, layers_drawn;

/* The method shows the first n instances as no method does that gets them in this order. */
static int as_in_order(struct prng *p, const uint32_t *order, uint32_t n, const struct zs_camera *camera,
                       const struct zs_depth *depth, const struct zs_method *method)
{
    for (uint32_t k = 0; k < n; k++)
        sorted[k] = instances[order[k]];
    const struct zs_scene in_that_order = { .instance = sorted, .n_instances = n, .background = 0x7bcf };
    const struct zs_scene scene = { .instance = instances, .n_instances = n, .background = 0x7bcf };
    struct zs_config c = picture_config(64, 48, depth);
    c.fast = NULL;
    struct picture want = picture_draw(&c, &in_that_order, camera);
    c.method = method;
    picture_any_way(p, &c, 2, 6);
    struct picture is = picture_draw(&c, &scene, camera);
    walks += is.stats.passes;
    return picture_drawn_alike(&want, &is, "single triangles");
}

/* Triangles between near and far and inside the guard band, many of them equally far, each an instance of some material
 * and depth state: the frame is that of the depth buffer, drawn in the order of in_order. */
static int single_case(uint64_t seed)
{
    static const struct zs_depth_state any[3] = { { .func = ZS_DEPTH_LESS_EQUAL }, { .bias = -300 },
                                                   { .slope_bias = 512 } };
    struct prng p = { seed };
    const uint32_t n = (uint32_t)prng_range(&p, 1, TRIS);
    const int32_t nearest = prng_range(&p, 101, 5000), depth = prng_range(&p, 0, prng_pick(&p, 2) ? 4 : 20000);
    struct zs_camera camera;
    uint32_t order[TRIS];
    if (!begin(&p, &camera, order, n))
        return 0;
    for (uint32_t t = 0; t < n; t++) {
        triangle_set(t, &p, nearest, depth);
        if (prng_pick(&p, 4) == 0)
            instances[t].depth_state = &any[prng_pick(&p, 3)];
        layers_drawn += (unsigned)is_layer(t);
    }
    qsort(order, n, sizeof order[0], in_order);
    return as_in_order(&p, order, n, &camera, prng_pick(&p, 2) ? &zs_depth_float : &zs_depth_recip,
                       &zs_method_transparent);
}

/* The painter's algorithm with the same materials: all of them from far to near. */
static int far_first(const void *a, const void *b)
{
    const uint32_t ta = *(const uint32_t *)a, tb = *(const uint32_t *)b;
    const int32_t da = ways_distance(pos, ta), db = ways_distance(pos, tb);
    return da != db ? (da < db) - (da > db) : (ta > tb) - (ta < tb);
}

static int painter_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t n = (uint32_t)prng_range(&p, 1, TRIS);
    struct zs_camera camera;
    uint32_t order[TRIS];
    if (!begin(&p, &camera, order, n))
        return 0;
    for (uint32_t t = 0; t < n; t++) {
        triangle_set(t, &p, prng_range(&p, 101, 5000), prng_range(&p, 0, 4));
    }
    qsort(order, n, sizeof order[0], far_first);
    return as_in_order(&p, order, n, &camera, &zs_depth_none, &zs_method_painter);
}

/* ---- Any pools, any mapping ------------------------------------------------------------------- */

static struct zs_blend blends[WORLD_MATERIALS];

/* Replace some materials of a world by layers. */
static void world_layers(struct world *w, struct prng *p)
{
    for (uint32_t j = 0; j < WORLD_MATERIALS; j++) {
        blends[j] = (struct zs_blend){ .material = w->material[j],
                                       .alpha = (uint8_t)prng_pick(p, 256),
                                       .phase = (uint8_t)prng_pick(p, 64) };
        for (int k = 0; k < 6; k++)
            if (w->material[j].shader == layer_shaders[k][0])
                blends[j].material.shader = layer_shaders[k][prng_pick(p, 4)];
    }
    for (uint32_t i = 0; i < w->n_instances; i++)
        if (w->instance[i].material)
            w->instance[i].material = &blends[w->instance[i].material - w->material].material;
}

static unsigned again;

static int way_case(uint64_t seed)
{
    static const struct ways of = { 90, 70, .depth = &zs_depth_float, .ortho = &zs_depth_linear,
                                    .method = { &zs_method_transparent }, .more = world_layers, .again = &again };
    return ways_alike(seed, &of);
}

/* Leave junk where a strip's state was on the stack. */
static __attribute__((noinline)) void scribble(void)
{
    volatile uint8_t junk[4096];
    for (size_t i = 0; i < sizeof junk; i++)
        junk[i] = 0xff;
}

/* Strips that another core draws are left out between those that are drawn; these are the picture's. */
static int skip_case(uint64_t seed)
{
    static uint32_t arena[400000];
    struct prng p = { seed };
    static struct world w;
    world_make(&w, &p, 0);
    world_layers(&w, &p);
    struct zs_config c = picture_config(prng_range(&p, 1, 90), prng_range(&p, 20, 70),
                                        w.camera.projection ? &zs_depth_linear : &zs_depth_float);
    c.method = &zs_method_transparent;
    c.varyings = ZS_VARYINGS_MAX;
    struct picture want = picture_draw(&c, &w.scene, &w.camera);
    picture_any_way(&p, &c, 2, 6);
    c.strip_h = (uint16_t)prng_range(&p, 1, 9);
    struct zs_renderer r;
    struct zs_strip s;
    int ok = want.err || (zs_arena_bytes(&c) <= sizeof arena && !zs_init(&r, &c, arena, sizeof arena) &&
                          !zs_frame_begin(&r, &w.scene, &w.camera));
    for (int more = ok && !want.err; ok && more; scribble()) {
        if (prng_pick(&p, 2)) {
            more = zs_frame_skip(&r);
        } else if ((more = zs_frame_strip(&r, &s)) != 0) {
            for (int32_t i = 0; i < s.w * s.h; i++)
                ok &= (s.px[2 * i] << 8 | s.px[2 * i + 1]) == want.color[s.y * want.w + i];
        }
    }
    picture_free(&want);
    world_free(&w);
    return ok;
}

/* A scene without layers is the depth buffer's. */
static int opaque_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    world_make(&w, &p, 0);
    struct zs_config c = picture_config(80, 60, w.camera.projection ? &zs_depth_linear : &zs_depth_e5m11);
    c.varyings = ZS_VARYINGS_MAX;
    struct picture want = picture_draw(&c, &w.scene, &w.camera);
    c.method = &zs_method_transparent;
    picture_any_way(&p, &c, 2, 6);
    struct picture is = picture_draw(&c, &w.scene, &w.camera);
    world_free(&w);
    return picture_alike(&want, &is, "the depth buffer");
}

/* ---- Thousands of layers ---------------------------------------------------------------------- */

#define MANY 3000

/* Panes behind each other, in a mesh in mixed order; seen by an orthographic camera. Each pixel against the sum of all,
 * far to near, in integers of this test. */
static void stress_43_thousands_of_layers(void **state)
{
    static int16_t at[4 * MANY][3];
    static uint16_t tri[2 * MANY][3], raw[2 * MANY];
    static const int16_t side[4][2] = { { -8, -8 }, { 8, -8 }, { 8, 8 }, { -8, 8 } };
    struct zs_camera camera;
    struct prng p = { 5 };
    uint32_t place[MANY];
    (void)state;
    for (uint32_t k = 0; k < MANY; k++)
        place[k] = k;
    for (uint32_t k = MANY - 1; k > 0; k--) {
        const uint32_t other = prng_pick(&p, k + 1), was = place[k];
        place[k] = place[other];
        place[other] = was;
    }
    static uint16_t of_place[MANY];
    for (uint32_t k = 0; k < MANY; k++) {
        for (uint32_t v = 0; v < 4; v++) {
            at[4 * k + v][0] = side[v][0];
            at[4 * k + v][1] = side[v][1];
            at[4 * k + v][2] = (int16_t)-(int32_t)(10 + 5 * place[k]);
        }
        const uint16_t first = (uint16_t)(4 * k);
        const uint16_t two[2][3] = { { first, (uint16_t)(first + 1), (uint16_t)(first + 2) },
                                     { first, (uint16_t)(first + 2), (uint16_t)(first + 3) } };
        memcpy(tri[2 * k], two, sizeof two);
        raw[2 * k] = raw[2 * k + 1] = of_place[place[k]] = (uint16_t)prng_next(&p);
    }
    const struct zs_mesh panes = { .pos = at, .tri = tri, .face_raw = raw, .n_verts = 4 * MANY, .n_tris = 2 * MANY,
                                   .center = { 0, 0, -7500 }, .radius = 7600 };
    const struct zs_blend pane = { .material = { .shader = &zs_blend_raw, .cull = ZS_CULL_NONE }, .alpha = 255 / 2 };
    const struct zs_instance instance = { .mesh = &panes, .material = &pane.material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = 0x1234 };
    assert_int_equal(zs_camera_orthographic(&camera, 16, 1, 20000), ZS_OK);
    double want[3] = { 0x1234 >> 11, 0x1234 >> 5 & 63, 0x1234 & 31 };
    for (uint32_t k = MANY; k-- > 0;) /* the error of one shrinks by those over it: within 2 codes */
        for (int c = 0; c < 3; c++) {
            const double source = c == 0 ? of_place[k] >> 11 : c == 1 ? of_place[k] >> 5 & 63 : of_place[k] & 31;
            want[c] = (want[c] * 128. + source * 127.) / 255.;
        }
    uint16_t first = 0;
    for (int pools = 0; pools < 3; pools++) {
        struct zs_config c = picture_config(16, 16, &zs_depth_linear);
        c.method = &zs_method_transparent;
        c.max_tris = pools == 0 ? 6000 : pools == 1 ? 800 : 100;
        c.max_verts = pools == 0 ? 12000 : pools == 1 ? 1600 : 200;
        c.strip_h = pools == 0 ? 16 : 9;
        struct picture is = picture_draw(&c, &scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        assert_true(pools == 0 ? is.stats.passes == 1 : is.stats.passes > 8);
        if (pools == 0)
            first = is.color[0];
        for (int k = 0; k < 16 * 16; k++)
            assert_int_equal(is.color[k], first);
        const double got[3] = { first >> 11, first >> 5 & 63, first & 31 };
        for (int ch = 0; ch < 3; ch++)
            assert_true(got[ch] - want[ch] < 2.01 && want[ch] - got[ch] < 2.01);
        picture_free(&is);
    }
}

#define TIES 60

/* Panes in one place, in two instances, some turned round or cut along the other diagonal: the first in scene order is
 * blended first, whatever pools and strips are. */
static void stress_48_ties_of_transparent_faces(void **state)
{
    static const int16_t at[4][3] = { { -8, -8, -50 }, { 8, -8, -50 }, { 8, 8, -50 }, { -8, 8, -50 } };
    static const uint16_t half[4][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 2, 3 }, { 1, 3, 0 } };
    static uint16_t tri[2 * TIES][3], raw[2 * TIES];
    struct zs_camera camera;
    struct prng p = { 9 };
    (void)state;
    for (uint32_t k = 0; k < 2 * TIES; k++) {
        const uint16_t *of = half[k % 2 + (k / 2 % 3 ? 0 : 2)];
        for (uint32_t v = 0; v < 3; v++)
            tri[k][v] = of[(v + k) % 3];
        raw[k] = k % 2 ? raw[k - 1] : (uint16_t)prng_next(&p);
    }
    struct zs_mesh panes[2];
    for (int k = 0; k < 2; k++)
        panes[k] = (struct zs_mesh){ .pos = at, .tri = (const uint16_t(*)[3])(tri + k * TIES), .n_verts = 4,
                                     .face_raw = raw + k * TIES, .n_tris = TIES, .center = { 0, 0, -50 },
                                     .radius = 12 };
    const struct zs_blend pane = { .material = { .shader = &zs_blend_raw, .cull = ZS_CULL_NONE }, .alpha = 100 };
    const struct zs_instance instance[2] = { { .mesh = &panes[0], .material = &pane.material },
                                             { .mesh = &panes[1], .material = &pane.material } };
    const struct zs_scene scene = { .instance = instance, .n_instances = 2, .background = 0x1234 };
    assert_int_equal(zs_camera_orthographic(&camera, 16, 1, 100), ZS_OK);
    double want[3] = { 0x1234 >> 11, 0x1234 >> 5 & 63, 0x1234 & 31 };
    for (uint32_t k = 0; k < 2 * TIES; k += 2) { /* on the left below, where each pane has one triangle */
        const double source[3] = { raw[k] >> 11, raw[k] >> 5 & 63, raw[k] & 31 };
        for (int c = 0; c < 3; c++)
            want[c] = (want[c] * 155. + source[c] * 100.) / 255.;
    }
    uint16_t first = 0;
    for (int pools = 0; pools < 4; pools++) {
        struct zs_config c = picture_config(16, 16, &zs_depth_linear);
        c.method = &zs_method_transparent;
        c.max_tris = pools == 0 ? 200 : pools == 1 ? 30 : pools == 2 ? 7 : 2;
        c.max_verts = pools == 0 ? 200 : 6;
        c.strip_h = pools % 2 ? 9 : 16;
        struct picture is = picture_draw(&c, &scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        if (pools == 0)
            first = is.color[0];
        for (int k = 0; k < 16 * 16; k++)
            assert_int_equal(is.color[k], first);
        picture_free(&is);
    }
    const double got[3] = { first >> 11, first >> 5 & 63, first & 31 };
    for (int c = 0; c < 3; c++)
        assert_true(got[c] - want[c] < 2.6 && want[c] - got[c] < 2.6); /* an error of one, times 255 / 100 */
}

/* ---- Faces that cross ------------------------------------------------------------------------- */

/* Two panes that cross in the frame's middle column: on the left the first is nearer, on the right the second. */
static void crossing(struct picture *is, const struct zs_method *method, const struct zs_depth *depth, uint16_t tris,
                     uint16_t verts)
{
    static const int16_t at[8][3] = { { -20, -20, -30 }, { 20, -20, -70 }, { 20, 20, -70 }, { -20, 20, -30 },
                                      { -20, -20, -71 }, { 20, -20, -31 }, { 20, 20, -31 }, { -20, 20, -71 } };
    static const uint16_t tri[4][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 6, 7 } };
    static const uint16_t raw[4] = { 0xf800, 0xf800, 0x07e0, 0x07e0 };
    static const struct zs_mesh two = { .pos = at, .tri = tri, .face_raw = raw, .n_verts = 8, .n_tris = 4,
                                        .center = { 0, 0, -50 }, .radius = 50 };
    static const struct zs_blend half = { .material = { .shader = &zs_blend_raw, .cull = ZS_CULL_NONE }, .alpha = 128 };
    static const struct zs_instance instance = { .mesh = &two, .material = &half.material };
    static const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    struct zs_camera camera;
    struct zs_config c = picture_config(32, 32, depth);
    c.method = method;
    c.max_tris = tris;
    c.max_verts = verts;
    assert_int_equal(zs_camera_orthographic(&camera, 32, 10, 100), ZS_OK);
    *is = picture_draw(&c, &scene, &camera);
    assert_int_equal(is->err, ZS_OK);
}

/* Pixels at which the pane that is nearer there is not the one that was drawn last: it has the larger share. */
static uint32_t wrong_pixels(const struct picture *is)
{
    uint32_t wrong = 0;
    for (int32_t y = 0; y < 32; y++)
        for (int32_t x = 0; x < 32; x++) {
            const uint32_t v = is->color[y * 32 + x], red = v >> 11, green = v >> 6 & 31u;
            assert_true(red >= 7 && green >= 7 && red + green >= 22 && red + green <= 25);
            if (x != 15 && x != 16)
                wrong += x < 16 ? red < green : green < red;
        }
    return wrong;
}

static void faces_that_cross_need_depth_sort(void **state)
{
    struct picture is;
    (void)state;
    crossing(&is, &zs_method_transparent, &zs_depth_linear, 100, 100);
    const uint32_t wrong = wrong_pixels(&is);
    print_message("sorted layers: %u of 960 pixels in the wrong order\n", wrong);
    assert_in_range(wrong, 300, 700); /* a half */
    picture_free(&is);
    crossing(&is, &zs_method_depthsort, &zs_depth_order, 100, 100);
    assert_int_equal(wrong_pixels(&is), 0);
    assert_true(is.stats.splits > 0);
    struct picture least; /* rectangles of a pixel */
    crossing(&least, &zs_method_depthsort, &zs_depth_order, 2, 6);
    assert_true(picture_same(&is, &least, "rectangles of a pixel"));
    picture_free(&least);
    crossing(&least, &zs_method_depthsort, &zs_depth_order, 5, 13);
    assert_true(picture_same(&is, &least, "small rectangles"));
    PICTURES_FREE(&least, &is);
}

/* Layers in random worlds by depth sort: the same for any pools, down to rectangles of a pixel. */
static int depthsort_case(uint64_t seed)
{
    static const struct ways of = { 12, 9, .depth = &zs_depth_order, .method = { &zs_method_depthsort },
                                    .more = world_layers };
    return ways_alike(seed, &of);
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(is_that_of_single_triangles, single_case, 400,
                 { "walks", &walks, 10000 }, { "layers drawn", &layers_drawn, 3000 }),
    CASES_TEST(painter_blends_from_far_to_near, painter_case, 100),
    CASES_TEST(the_same_with_strips_left_out, skip_case, 60),
    CASES_COUNTS(is_the_same_in_any_way, way_case, 80, { "scenes in several walks", &again, 20 }),
    CASES_TEST(without_layers_is_the_depth_buffer, opaque_case, 150),
    cmocka_unit_test(stress_43_thousands_of_layers),
    cmocka_unit_test(stress_48_ties_of_transparent_faces),
    cmocka_unit_test(faces_that_cross_need_depth_sort),
    CASES_TEST(depth_sort_blends_the_same_in_any_way, depthsort_case, 15),
    METHOD_NEEDS_TEST(small_pools_and_no_depth_memory_are_refused,
                      &zs_method_transparent, &zs_depth_float, &zs_depth_none, 2),
};

CASES_MAIN(tests)
