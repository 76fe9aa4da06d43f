/* The fan of a clipped triangle (core/fan.c): its corners stay in the guard band. That it goes on with its next piece
 * where pools are full: test_walk.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cases.h"
#include "internals.h"
#include "picture.h"
#include "shapes.h"

#define W 70
#define H 50

static uint32_t held; /* corners on the guard band's edge */

/* A large triangle, of which a part is close to the eye: where it is cut at the guard band, a new vertex is rounded to
 * a camera unit, which is many sub-pixels there. The corners of what is drawn are inside all the same. */
static int guard_case(uint64_t seed)
{
    static struct lone l;
    static struct zs_renderer r;
    static uint8_t arena[1 << 18];
    struct prng p = { seed };
    int16_t pos[6][3] = { { 0, 0, 0 } };
    for (int k = 0; k < 9; k++)
        pos[k / 3][k % 3] = (int16_t)prng_range(&p, -32000, 32000);
    lone_set(&l, (const int16_t (*)[3])pos, 3, ZS_Q16_ONE << prng_pick(&p, 8));
    const int32_t reach = 32000 << prng_pick(&p, 8);
    l.instance.pose.pos[2] = -prng_range(&p, 0, reach / 64);
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, (zs_turn)prng_range(&p, 3000, 20000), H, 1 + reach / 4096, 1 << 26);
    struct zs_config c = lone_config(W, H, &zs_depth_recip);
    c.subpixel_bits = prng_pick(&p, 2) ? 8 : 4;
    struct zs_strip strip;
    assert_true(zs_arena_bytes(&c) <= sizeof arena);
    CASE_CHECK(zs_init(&r, &c, arena, sizeof arena) == ZS_OK);
    if (zs_frame_begin(&r, &l.scene, &camera) != ZS_OK) /* a camera that is refused */
        return 1;
    CASE_CHECK(zs_frame_strip(&r, &strip) == 1);
    for (uint32_t k = 0; k < 3u * r.n_tris; k++) {
        const struct zs_vertex *v = &r.vert[r.tri[k / 3].v[k % 3]];
        const int64_t x = v->x - r.view.cx, y = v->y - r.view.cy;
        if (x > ZS_GUARD_SUBPX || x < -ZS_GUARD_SUBPX || y > ZS_GUARD_SUBPX || y < -ZS_GUARD_SUBPX)
            return case_wrong("a corner at %d, %d of the middle", (int)x, (int)y);
        held += x == ZS_GUARD_SUBPX || x == -ZS_GUARD_SUBPX || y == ZS_GUARD_SUBPX || y == -ZS_GUARD_SUBPX;
    }
    return zs_frame_end(&r) == ZS_OK;
}

static const struct CMUnitTest tests[] = {
    CASES_COUNT(a_cut_vertex_stays_in_the_guard_band, guard_case, 3000,
                &held, 200, "corners at the edge of the guard band"),
};

CASES_MAIN(tests)
