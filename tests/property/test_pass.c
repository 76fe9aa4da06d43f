/* Frames in several passes: each viewport holds the picture that a frame of its size would; what a pass keeps; what is
 * refused. Targets without depth memory, and instances that are not tested.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "../lab/fuzz/world.h"
#include "own.h"
#include "picture.h"
#include "zs_blend.h"
#include "zs_method.h"
#include "zs_pass.h"
#include "zs_shader.h"

#define PASSES 4

#define ONE(name_, ...) &zs_depth_##name_,
static const struct zs_depth *const mappings[] = { ZS_DEPTH_EACH(ONE) };
#undef ONE

/* Ample pools, no accelerators. */
static struct zs_config plain_config(uint16_t w, uint16_t h, const struct zs_depth *depth)
{
    return (struct zs_config){ .width = w, .height = h, .strip_h = h, .max_tris = 4000, .max_verts = 4000,
                               .varyings = ZS_VARYINGS_MAX, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                               .depth = depth };
}

/* A world whose meshes hold what they say. */
static void world_sound(struct world *w, struct prng *p)
{
    for (world_make(w, p, 0); !w->trusted; world_make(w, p, 0))
        world_free(w);
}

/* A world whose pixels do not depend on where in the frame they are, nor on what was there. */
static void world_anywhere(struct world *w, struct prng *p)
{
    world_sound(w, p);
    w->scene.sky = NULL;
    w->scene.resolve = NULL;
    w->scene.n_resolves = 0;
    for (int k = 0; k < WORLD_MATERIALS; k++)
        if (w->material[k].shader == &own_shader || w->material[k].shader == &glass_shader)
            w->material[k].shader = &zs_shade_raw;
}

static const struct zs_depth *mapping_for(struct prng *p, const struct zs_camera *camera)
{
    return camera->projection == ZS_ORTHOGRAPHIC ? &zs_depth_linear : mappings[prng_pick(p, 6)];
}

static uint16_t wide(struct prng *p, uint16_t most)
{
    return (uint16_t)prng_range(p, 1, most);
}

/* ---- Viewports -------------------------------------------------------------------------------- */

static unsigned drawn_cases, passes_kept;

/* Overlapping viewports of any size, each with a scene, a camera and a mapping of its own. */
static int viewports_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w[PASSES];
    struct zs_pass pass[PASSES] = { 0 };
    struct zs_config c = plain_config(wide(&p, 90), wide(&p, 70), &zs_depth_linear);
    const uint32_t n = 1 + prng_pick(&p, PASSES);
    struct picture want = { .w = c.width, .h = c.height };
    int ok = 1;
    want.color = malloc(2u * c.width * c.height);
    want.key = malloc(2u * c.width * c.height);
    for (uint32_t k = 0; k < n; k++) {
        struct zs_rect *v = &pass[k].viewport;
        world_anywhere(&w[k], &p);
        pass[k].scene = &w[k].scene;
        pass[k].camera = &w[k].camera;
        pass[k].depth = mapping_for(&p, &w[k].camera);
        if (k == 0)
            for (int i = 0; i < c.width * c.height; i++) {
                want.color[i] = w[k].scene.background;
                want.key[i] = ZS_DEPTH_CLEAR;
            }
        *v = (struct zs_rect){ 0, 0, wide(&p, c.width), wide(&p, c.height) };
        v->x = (uint16_t)prng_pick(&p, c.width - v->w + 1u);
        v->y = (uint16_t)prng_pick(&p, c.height - v->h + 1u);
        if (prng_pick(&p, 5) == 0)
            *v = (struct zs_rect){ 0 };
        const uint16_t vw = v->w ? v->w : c.width, vh = v->h ? v->h : c.height;
        const struct zs_config alone = plain_config(vw, vh, pass[k].depth);
        struct picture one = picture_draw(&alone, pass[k].scene, pass[k].camera);
        want.err = want.err ? want.err : one.err;
        for (int y = 0; y < vh && !one.err; y++)
            for (int x = 0; x < vw; x++) {
                want.color[(v->y + y) * c.width + v->x + x] = one.color[y * vw + x];
                want.key[(v->y + y) * c.width + v->x + x] = one.key[y * vw + x];
            }
        picture_free(&one);
    }
    for (int way = 0; way < 3 && ok; way++) {
        struct zs_config any = c;
        picture_any_way(&p, &any, 1, 3);
        struct picture got = picture_passes(&any, pass, n);
        if (want.err)
            ok = got.err == want.err || case_wrong("error %d, not %d", got.err, want.err);
        else
            ok = picture_same(&want, &got, "passes") || case_wrong("%u passes in strips of %u", n, any.strip_h);
        drawn_cases += !want.err;
        picture_free(&got);
    }
    for (uint32_t k = 0; k < n; k++)
        world_free(&w[k]);
    picture_free(&want);
    return ok;
}

/* ---- What is kept ------------------------------------------------------------------------------ */

/* A second pass over the colours of the first: where it draws nothing, those stay. Its depth begins anew, so that it is
 * in front. */
static int over_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w[2];
    struct zs_config c = plain_config(wide(&p, 90), wide(&p, 70), &zs_depth_linear);
    struct zs_pass pass[2] = { 0 };
    int ok = 1;
    for (int k = 0; k < 2; k++) {
        world_anywhere(&w[k], &p);
        pass[k] = (struct zs_pass){ .scene = &w[k].scene, .camera = &w[k].camera,
                                    .depth = mapping_for(&p, &w[k].camera) };
    }
    pass[1].keep = ZS_KEEP_COLOR;
    struct zs_config first = c, second = c;
    first.depth = pass[0].depth;
    second.depth = pass[1].depth;
    struct picture want = picture_draw(&first, pass[0].scene, pass[0].camera);
    w[1].scene.background = 0;
    struct picture black = picture_draw(&second, pass[1].scene, pass[1].camera);
    w[1].scene.background = 0xffff;
    struct picture white = picture_draw(&second, pass[1].scene, pass[1].camera);
    if (!want.err && !black.err) {
        for (int i = 0; i < c.width * c.height; i++) {
            if (black.color[i] == white.color[i])
                want.color[i] = black.color[i];
            want.key[i] = black.key[i];
        }
        picture_any_way(&p, &c, 1, 3);
        struct picture got = picture_passes(&c, pass, 2);
        ok = picture_same(&want, &got, "over") || case_wrong("over");
        picture_free(&got);
        passes_kept++;
    }
    PICTURES_FREE(&want, &black, &white);
    world_free(&w[0]);
    world_free(&w[1]);
    return ok;
}

/* One scene cut in two passes that keep colours and keys is the scene, where both have its units. */
static int cut_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static struct zs_renderer r;
    static uint32_t arena[60000];
    static struct zs_pass_memory memory[2];
    int ok = 1;
    world_anywhere(&w, &p);
    struct zs_config c = plain_config(wide(&p, 90), wide(&p, 70), mapping_for(&p, &w.camera));
    struct zs_scene part[2] = { w.scene, w.scene };
    part[0].n_instances = prng_pick(&p, w.scene.n_instances + 1u);
    part[1].n_instances -= part[0].n_instances;
    part[1].instance += part[0].n_instances;
    part[1].background = (uint16_t)~w.scene.background; /* not to be seen */
    const struct zs_pass pass[2] = {
        { .scene = &part[0], .camera = &w.camera },
        { .scene = &part[1], .camera = &w.camera, .keep = ZS_KEEP_COLOR | ZS_KEEP_DEPTH }
    };
    if (zs_init(&r, &c, arena, sizeof arena) || zs_frame_begin(&r, &w.scene, &w.camera))
        goto out;
    const int32_t shift = r.view.shift;
    if (zs_frame_begin_passes(&r, pass, memory, 2) || memory[0].view.shift != shift || memory[1].view.shift != shift)
        goto out;
    struct picture want = picture_draw(&c, &w.scene, &w.camera);
    picture_any_way(&p, &c, 1, 3);
    struct picture got = picture_passes(&c, pass, 2);
    ok = picture_same(&want, &got, "cut in two") || case_wrong("cut in two");
    PICTURES_FREE(&want, &got);
    passes_kept++;
out:
    world_free(&w);
    return ok;
}

/* ---- Where a pixel is ---------------------------------------------------------------------------- */

static void place_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    *f->color = (uint16_t)(f->x << 8 | f->y);
}
static const struct zs_shader place = { .fragment = place_fragment, ZS_FRAGMENTS };

static void place_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    for (uint16_t k = 0; k < n; k++)
        out[k] = (uint16_t)((x + k) << 8 | y);
}

static uint32_t hooks;

static void place_draw(void *ctx, const struct zs_target *t)
{
    *(uint32_t *)ctx += (uint32_t)(t->y1 - t->y0) * (uint32_t)(t->x1 - t->x0);
    for (uint32_t y = t->y0; y < t->y1; y++)
        for (uint32_t x = t->x0; x < t->x1; x++) {
            const uint16_t c = t->color[(y - t->y0) * t->pitch + x];
            hooks += c == (uint16_t)(x << 8 | y);
        }
}

/* Fragments, skies and hooks are told places in the frame, not in the viewport. */
static void places_are_of_the_frame(void **state)
{
    static const int16_t pos[3][3] = { { -9, -9, 0 }, { 9, -9, 0 }, { 0, 9, 0 } };
    static const uint16_t tri[1][3] = { { 0, 1, 2 } };
    static const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = 3, .n_tris = 1, .scale = ZS_Q16_ONE,
                                         .radius = 13 };
    static const struct zs_material material = { .shader = &place };
    static const struct zs_background sky = { .fill = place_fill };
    uint32_t pixels[2] = { 0, 0 };
    struct zs_resolve hook[2] = { { .draw = place_draw, .ctx = &pixels[0] },
                                  { .draw = place_draw, .ctx = &pixels[1] } };
    struct zs_instance instance = { .mesh = &mesh, .material = &material };
    struct zs_camera camera;
    zs_pose_identity(&instance.pose);
    instance.pose.pos[2] = -20;
    assert_int_equal(zs_camera_orthographic(&camera, 24, 1, 100), ZS_OK);
    const int32_t eye[3] = { 0, 0, 0 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    assert_int_equal(zs_camera_look_along(&camera, eye, along, up), ZS_OK);
    struct zs_scene scene[2];
    for (int k = 0; k < 2; k++)
        scene[k] = (struct zs_scene){ .instance = &instance, .n_instances = 1, .sky = &sky, .resolve = &hook[k],
                                      .n_resolves = 1 };
    const struct zs_pass pass[2] = { { .scene = &scene[0], .camera = &camera, .viewport = { 3, 5, 20, 22 } },
                                     { .scene = &scene[1], .camera = &camera, .viewport = { 30, 17, 17, 9 } } };
    struct zs_config c = plain_config(50, 30, &zs_depth_linear);
    for (uint16_t h = 1; h <= 30; h += 7) {
        pixels[0] = pixels[1] = hooks = 0;
        c.strip_h = h;
        struct picture got = picture_passes(&c, pass, 2);
        assert_int_equal(got.err, ZS_OK);
        for (int y = 0; y < got.h; y++)
            for (int x = 0; x < got.w; x++) {
                const uint16_t seen = got.color[y * got.w + x];
                assert_int_equal((uint16_t)(seen << 8 | seen >> 8), x << 8 | y);
            }
        assert_int_equal(got.covered > 100, 1);
        assert_int_equal(pixels[0], 50 * 30); /* each once, when all has been drawn */
        assert_int_equal(pixels[1], 50 * 30);
        assert_int_equal(hooks, 2 * 50 * 30);
        picture_free(&got);
        const struct zs_pass twice[2] = { pass[0],
                                          { .scene = &scene[0], .camera = &camera, .viewport = { 0, 0, 9, 9 } } };
        pixels[0] = 0;
        got = picture_passes(&c, twice, 2);
        assert_int_equal(got.err, ZS_OK);
        assert_int_equal(pixels[0], 50 * 30); /* one scene in two passes: once */
        picture_free(&got);
    }
}

/* Methods refuse them, but for the one that mixes layers. */
static void passes_with_a_method(void **state)
{
#define METHOD(name_, depth_, tris_, verts_, records_) { &zs_method_##name_, depth_, ZS_ERR_PASS },
    static const struct {
        const struct zs_method *method;
        const struct zs_depth *depth;
        int err;
    } of[] = { { &zs_method_transparent, NULL, ZS_OK }, ZS_METHOD_EACH(METHOD) };
    static struct zs_renderer r;
    static uint32_t arena[9000];
    static const struct zs_scene none = { .n_instances = 0 };
    struct zs_pass_memory memory[1];
    struct zs_camera camera;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 30, 1, 100), ZS_OK);
    const struct zs_pass pass = { .scene = &none, .camera = &camera };
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        struct zs_config c = plain_config(40, 30, of[k].depth ? of[k].depth : &zs_depth_recip);
        c.method = of[k].method;
        c.max_tris = c.max_verts = 100;
        assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
        assert_int_equal(zs_frame_begin_passes(&r, &pass, memory, 1), of[k].err);
    }
    assert_non_null(strstr(zs_error_string(ZS_ERR_PASS), ", or passes with a method"));
}

/* ---- What is refused ----------------------------------------------------------------------------- */

static void wrong_passes_are_refused(void **state)
{
    static struct zs_renderer r;
    static struct zs_pass_memory memory[2];
    static uint32_t arena[9000], track[ZS_DAMAGE_WORDS(4, 30, 8)];
    static struct world w;
    struct prng p = { 7 };
    world_anywhere(&w, &p);
    w.camera.projection = ZS_PERSPECTIVE;
    struct zs_config c = plain_config(40, 30, &zs_depth_linear);
    c.strip_h = 8;
    c.max_tris = c.max_verts = 100;
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    const struct zs_scene none = { .n_instances = 0 };
    struct zs_camera camera;
    assert_int_equal(zs_camera_orthographic(&camera, 24, 1, 100), ZS_OK);
    const int32_t eye[3] = { 0, 0, 0 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    assert_int_equal(zs_camera_look_along(&camera, eye, along, up), ZS_OK);
    const struct zs_pass good = { .scene = &none, .camera = &camera, .viewport = { 10, 10, 30, 20 } };
    struct zs_pass pass[2] = { good, good };
    struct zs_strip strip;
#define REFUSED(field, value, error) \
    do { \
        pass[1].field = value; \
        assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), error); \
        assert_int_equal(zs_frame_strip(&r, &strip), ZS_ERR_SEQUENCE); \
        pass[1] = good; \
        assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), ZS_OK); \
    } while (0)
    REFUSED(scene, NULL, ZS_ERR_NULL);
    REFUSED(camera, NULL, ZS_ERR_NULL);
    REFUSED(viewport.w, 31, ZS_ERR_PASS);
    REFUSED(viewport.w, 0, ZS_ERR_PASS);
    REFUSED(viewport.h, 21, ZS_ERR_PASS);
    REFUSED(viewport.h, 0, ZS_ERR_PASS);
    REFUSED(viewport.x, 11, ZS_ERR_PASS);
    REFUSED(viewport.y, 65535, ZS_ERR_PASS);
    REFUSED(keep, 4, ZS_ERR_PASS);
    REFUSED(depth, &zs_depth_none, ZS_ERR_PASS);
    pass[1].viewport.w = pass[1].viewport.h = 0;
    REFUSED(viewport.x, 1, ZS_ERR_PASS); /* 0 by 0 is the whole frame only at 0, 0 */
    pass[1].depth = &zs_depth_e3m13;
    pass[1].camera = &w.camera;
    pass[1].scene = &w.scene;
    REFUSED(keep, ZS_KEEP_DEPTH, ZS_ERR_PASS); /* keys of another mapping */
    REFUSED(depth, &zs_depth_recip, ZS_ERR_DEPTH); /* orthographic */
    assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 0), ZS_ERR_SIZE);
    assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 65536), ZS_ERR_SIZE);
    assert_int_equal(zs_frame_begin_passes(&r, NULL, memory, 2), ZS_ERR_NULL);
    assert_int_equal(zs_frame_begin_passes(&r, pass, NULL, 2), ZS_ERR_NULL);
    assert_int_equal(zs_frame_begin_passes(NULL, pass, memory, 2), ZS_ERR_NULL);
    assert_int_equal(zs_render_passes(&r, pass, memory, 2, NULL), ZS_ERR_NULL);
    assert_int_equal(zs_frame_end(&r), ZS_ERR_SEQUENCE);
    assert_int_equal(zs_damage_track(&r, track, 4), ZS_OK);
    assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), ZS_ERR_SEQUENCE);
    world_free(&w);
}

/* 65,535 instances fit a frame, not each of its passes. */
static void instances_of_all_passes_are_counted(void **state)
{
    static struct zs_renderer r;
    static struct zs_pass_memory memory[2];
    static uint32_t arena[9000];
    static struct zs_instance many[40000];
    static const struct zs_mesh mesh = { .scale = ZS_Q16_ONE };
    static const struct zs_material material = { .shader = &zs_shade_raw };
    struct zs_config c = plain_config(40, 30, &zs_depth_linear);
    c.max_tris = c.max_verts = 100;
    for (size_t k = 0; k < 40000; k++) {
        many[k] = (struct zs_instance){ .mesh = &mesh, .material = &material };
        zs_pose_identity(&many[k].pose);
    }
    struct zs_camera camera;
    assert_int_equal(zs_camera_orthographic(&camera, 24, 1, 100), ZS_OK);
    const int32_t eye[3] = { 0, 0, 0 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    assert_int_equal(zs_camera_look_along(&camera, eye, along, up), ZS_OK);
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    const struct zs_scene first = { .instance = many, .n_instances = 40000 };
    struct zs_scene second = { .instance = many, .n_instances = 25535 };
    const struct zs_pass pass[2] = { { .scene = &first, .camera = &camera }, { .scene = &second, .camera = &camera } };
    assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), ZS_OK);
    second.n_instances++;
    assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), ZS_ERR_SIZE);
}

/* After a frame in passes, the next one has all its accelerators again, and the whole frame. */
static void a_plain_frame_after_passes(void **state)
{
    static struct zs_renderer r;
    static struct zs_pass_memory memory[2];
    static uint32_t arena[60000];
    static struct world w;
    for (uint64_t seed = 1; seed < 20; seed++) {
        struct prng p = { seed };
        world_anywhere(&w, &p);
        struct zs_config c = plain_config(70, 60, mapping_for(&p, &w.camera));
        c.fast = fast_all;
        struct picture want = picture_draw(&c, &w.scene, &w.camera);
        if (!want.err) {
            const struct zs_pass pass[2] = { { .scene = &w.scene, .camera = &w.camera, .viewport = { 9, 9, 20, 20 } },
                                             { .scene = &w.scene, .camera = &w.camera, .viewport = { 2, 30, 9, 9 } } };
            struct zs_strip s;
            assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
            const void *const tiles = r.tiles, *const touch = r.touch;
            assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), ZS_OK);
            assert_int_equal(zs_frame_strip(&r, &s), 1);
            assert_int_equal(zs_frame_begin(&r, &w.scene, &w.camera), ZS_OK);
            assert_true(r.tiles == tiles && r.touch == touch);
            assert_int_equal(zs_frame_strip(&r, &s), 1);
            for (int i = 0; i < 70 * 60; i++)
                assert_int_equal(s.px[2 * i] << 8 | s.px[2 * i + 1], want.color[i]);
        }
        picture_free(&want);
        world_free(&w);
    }
}

/* ---- Without depth memory -------------------------------------------------------------------------- */

/* Without depth memory: as with it where no instance is tested. zs_depth_linear finds the same w for attributes. */
static int untested_case(uint64_t seed)
{
    struct prng p = { seed };
    static const struct zs_depth_state always = { .func = ZS_DEPTH_ALWAYS };
    static struct world w;
    int ok = 1;
    world_sound(&w, &p);
    w.scene.n_resolves = 0; /* they read keys */
    struct zs_config c = plain_config(wide(&p, 90), wide(&p, 70), &zs_depth_none);
    struct zs_config with = c;
    with.depth = &zs_depth_linear;
    assert_int_equal(zs_arena_bytes(&with) - zs_arena_bytes(&c), ZS_DEPTH_BYTES(c.width, c.strip_h));
    picture_any_way(&p, &c, 1, 3);
    picture_any_way(&p, &with, 1, 3);
    struct picture got = picture_draw(&c, &w.scene, &w.camera); /* with any depth states: they have no effect */
    for (uint32_t k = 0; k < w.scene.n_instances; k++)
        w.instance[k].depth_state = &always;
    struct picture want = picture_draw(&with, &w.scene, &w.camera);
    if (want.err || got.err) {
        ok = want.err == got.err || case_wrong("errors %d and %d", want.err, got.err);
    } else {
        for (int i = 0; i < got.w * got.h && ok; i++)
            ok = got.key[i] == 0 || case_wrong("a key");
        memcpy(got.key, want.key, 2u * (size_t)got.w * (size_t)got.h);
        ok = ok && (picture_same(&want, &got, "untested") || case_wrong("untested"));
        drawn_cases++;
    }
    PICTURES_FREE(&got, &want);
    world_free(&w);
    return ok;
}

static const struct CMUnitTest tests[] = {
    CASES_COUNT(viewports_hold_frames_of_their_size, viewports_case, 100, &drawn_cases, 200, "frames drawn"),
    CASES_COUNT(a_pass_over_the_colours_of_another, over_case, 60, &passes_kept, 40, "passes over others"),
    CASES_COUNT(a_scene_cut_in_two_passes, cut_case, 100, &passes_kept, 20, "scenes cut"),
    cmocka_unit_test(places_are_of_the_frame),
    cmocka_unit_test(wrong_passes_are_refused),
    cmocka_unit_test(passes_with_a_method),
    cmocka_unit_test(instances_of_all_passes_are_counted),
    cmocka_unit_test(a_plain_frame_after_passes),
    CASES_COUNT(without_depth_memory_the_later_covers, untested_case, 100, &drawn_cases, 60, "frames drawn"),
};
CASES_MAIN(tests)
