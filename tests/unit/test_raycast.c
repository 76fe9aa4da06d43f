/* Ray casting: the depth buffer's frame, bit for bit, for any world, mapping, depth state, pools, strips, accelerators
 * and hierarchy; one ray a pixel; and what rays of doubles see.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "../lab/fuzz/kinds.h"
#include "../lab/fuzz/world.h"
#include "own.h"
#include "picture.h"
#include "zs_method.h"

/* Any way to draw the same frame by rays. */
static void any_way(struct prng *p, struct zs_config *c)
{
    c->strip_h = (uint16_t)prng_range(p, 1, c->height);
    if (prng_pick(p, 4)) {
        c->max_tris = (uint16_t)prng_range(p, 4, prng_pick(p, 2) ? 12 : 120);
        c->max_verts = (uint16_t)prng_range(p, 6, prng_pick(p, 2) ? 12 : 120);
    }
    c->buffers = (uint8_t)(1 + prng_pick(p, 2));
    c->fast = fast_any(p);
}

/* A ray ends where it meets something: a shader that leaves pixels alone is not drawn by rays. */
static void make_opaque(struct world *w)
{
    for (int k = 0; k < WORLD_MATERIALS; k++)
        if (!w->material[k].shader->opaque)
            w->material[k].shader = &own_shader;
}

/* ---- The depth buffer's frame ------------------------------------------------------------------ */

static unsigned drawn, cut, curved, stated, clipped;

static int world_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    world_make(&w, &p, 0);
    make_opaque(&w);
    const struct kind_depth *depth = &kind_depths[prng_pick(&p, KINDS(kind_depths))];
    if (w.camera.projection == ZS_ORTHOGRAPHIC)
        depth = &kind_depths[1];
    struct zs_config c = { .width = (uint16_t)prng_range(&p, 1, 60), .height = (uint16_t)prng_range(&p, 1, 50),
                           .max_tris = 4000, .max_verts = 8000, .varyings = ZS_VARYINGS_MAX, .depth = depth->depth,
                           .depth_bits = (uint8_t)(prng_pick(&p, 3) ? 16 : prng_range(&p, 8, 16)),
                           .subpixel_bits = prng_pick(&p, 4) ? 8 : 4 };
    c.strip_h = c.height;
    struct picture want = picture_draw(&c, &w.scene, &w.camera);
    c.method = &zs_method_raycast;
    any_way(&p, &c);
    struct picture is = picture_draw(&c, &w.scene, &w.camera);
    int right = want.err == is.err;
    if (right && !want.err) {
        const size_t px = (size_t)c.width * c.height;
        if (!w.scene.n_resolves)
            memcpy(is.key, want.key, px * 2);
        right = picture_same(&want, &is, depth->name) && is.stats.rays == px;
        drawn += want.covered > 0;
        cut += is.stats.passes > is.stats.strips;
        curved += depth->depth != &zs_depth_recip && w.camera.projection == ZS_PERSPECTIVE;
        clipped += want.stats.tris_clipped > 0;
        for (uint32_t k = 0; k < w.scene.n_instances; k++)
            stated += w.instance[k].depth_state != NULL;
    }
    right = right || case_wrong("errors %d and %d, %u rays", want.err, is.err, is.stats.rays);
    picture_free(&want);
    picture_free(&is);
    world_free(&w);
    return right;
}

static void is_the_frame_of_the_depth_buffer(void **state)
{
    (void)state;
    drawn = cut = curved = stated = clipped = 0;
    CASES(world_case, getenv("ZS_STRESS") ? 10000 : 300);
    if (!getenv("ZS_SEED"))
        assert_true(drawn > 100 && cut > 50 && curved > 50 && stated > 150 && clipped > 50);
}

/* ---- What is refused ------------------------------------------------------------------------- */

static void small_pools_and_no_depth_memory_are_refused(void **state)
{
    static const int16_t corner[3][3] = { { 0, 0, -2000 }, { 900, 0, -2000 }, { 0, 900, -2000 } };
    struct lone l;
    struct zs_camera camera;
    (void)state;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 100, 40000), ZS_OK);
    struct zs_config without = picture_config(64, 48, &zs_depth_none);
    without.method = &zs_method_raycast;
    struct picture none = picture_draw(&without, &(struct zs_scene){ .n_instances = 0 }, &camera);
    assert_int_equal(none.err, ZS_ERR_DEPTH);
    picture_free(&none);
    lone_set(&l, corner, 3, ZS_Q16_ONE);
    for (uint16_t tris = 1; tris <= 5; tris++)
        for (uint16_t verts = 5; verts <= 6; verts++) {
            struct zs_config c = picture_config(64, 48, &zs_depth_float);
            c.method = &zs_method_raycast;
            c.max_tris = tris;
            c.max_verts = verts;
            struct picture is = picture_draw(&c, &l.scene, &camera);
            assert_int_equal(is.err, tris >= 4 && verts == 6 ? ZS_OK : ZS_ERR_SIZE);
            picture_free(&is);
        }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(is_the_frame_of_the_depth_buffer),
                                        cmocka_unit_test(small_pools_and_no_depth_memory_are_refused) };
    cases_program = argv[0];
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
