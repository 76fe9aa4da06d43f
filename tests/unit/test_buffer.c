/* The depth buffer as a method (core/buffer.c): a strip's triangles come in scene order, each once, those that go on
 * from above and those that begin here alike.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "core/bin.h"
#include "core/method.h"
#include "picture.h"

#define TRIS 40

static unsigned both, none;

/* A list that goes on and a bin, as binning leaves them: the one ascends, the other begins with the newest. */
static int list_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_tri tri[TRIS];
    uint16_t bin[3] = { 7, ZS_NIL, 9 };
    struct zs_renderer r;
    memset(&r, 0, sizeof r);
    r.tri = tri;
    r.bin = bin;
    r.strip = 1;
    r.active = ZS_NIL;
    const uint32_t share = prng_pick(&p, 4), of = prng_pick(&p, 4);
    uint16_t *end = &r.active;
    uint32_t here[TRIS], n = 0, begun = 0;
    for (uint32_t t = 0; t < TRIS; t++) {
        tri[t].next = 12345;
        if (prng_pick(&p, 4) < share) { /* it begins here */
            tri[t].next = bin[1];
            bin[1] = (uint16_t)t;
            begun++;
        } else if (prng_pick(&p, 4) < of) { /* it goes on */
            *end = (uint16_t)t;
            end = &tri[t].next;
            *end = ZS_NIL;
        } else {
            continue;
        }
        here[n++] = t;
    }
    both += begun && begun < n;
    none += !n;
    uint16_t at = zs_scene_list(&r);
    CASE_CHECK(bin[0] == 7 && bin[1] == ZS_NIL && bin[2] == 9);
    for (uint32_t k = 0; k < n; k++) {
        if (at != here[k])
            return case_wrong("triangle %u is %u of the list, not %u", at, k, here[k]);
        at = tri[at].next;
    }
    CASE_CHECK(at == ZS_NIL);
    return 1;
}

/* Pools of one triangle: the strip is drawn in as many sets, each counted, with the same picture. */
static void full_pools_are_drawn_and_counted(void **state)
{
    (void)state;
    static const int16_t pos[5][3] = { { -3000, 3000, -PIXEL_Z }, { 3000, 2500, -PIXEL_Z }, { -2500, -3000, -PIXEL_Z },
                                       { 2500, -2500, -PIXEL_Z }, { 0, -3000, -PIXEL_Z } };
    static struct lone l;
    lone_set(&l, pos, 5, ZS_Q16_ONE);
    const struct zs_camera camera = pixel_camera(32, 0);
    struct zs_config c = lone_config(32, 32, &zs_depth_linear);
    struct picture usual = picture_draw(&c, &l.scene, &camera);
    assert_true(picture_shows(&usual, 100));
    c.max_tris = 1;
    c.max_verts = 3;
    c.strip_h = 32;
    struct picture few = picture_draw(&c, &l.scene, &camera);
    assert_true(picture_same(&usual, &few, "a pool of one triangle"));
    assert_int_equal(usual.stats.passes, 1);
    assert_true(few.stats.passes >= usual.stats.tris_drawn);
    PICTURES_FREE(&usual, &few);
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(lists_are_in_scene_order, list_case, 4000, { "lists of both kinds", &both, 1000 },
                 { "empty lists", &none, 50 }),
    cmocka_unit_test(full_pools_are_drawn_and_counted),
};
CASES_MAIN(tests)
