/* The painter's algorithm: the picture of drawing single triangles from far to near, one after another; the same for
 * any pools, strips and accelerators.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "method_needs.h"
#include "own.h"
#include "picture.h"
#include "ways.h"
#include "zs_method.h"

/* ---- Against single triangles ----------------------------------------------------------------- */

#define TRIS 60

static int16_t pos[TRIS * 3][3];
static uint16_t corners[TRIS][3], color[TRIS];
static const uint16_t one[1][3] = { { 0, 1, 2 } };

static int far_first(const void *a, const void *b)
{
    const uint32_t ta = *(const uint32_t *)a, tb = *(const uint32_t *)b;
    const int32_t da = ways_distance(pos, ta), db = ways_distance(pos, tb);
    return da != db ? (da < db) - (da > db) : (ta > tb) - (ta < tb);
}

static unsigned walks, sets_drawn;

/* Triangles between near and far and inside the guard band, many of them equally far: the frame is that of one instance
 * for each triangle, without depth memory, in an order that qsort has made. */
static int single_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t n = (uint32_t)prng_range(&p, 1, TRIS);
    const int32_t nearest = prng_range(&p, 101, 5000), depth = prng_range(&p, 0, prng_pick(&p, 2) ? 4 : 20000);
    struct zs_mesh all = { .pos = pos, .tri = corners, .face_raw = color, .n_verts = 3 * n, .n_tris = n,
                           .radius = 65535 };
    const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    const struct zs_instance instance = { .mesh = &all, .material = &material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = 7 };
    struct zs_camera camera;
    uint32_t order[TRIS];
    static struct zs_mesh mesh[TRIS];
    static struct zs_instance instances[TRIS];

    if (zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 100, 40000))
        return case_wrong("camera");
    for (uint32_t t = 0; t < n; t++) {
        order[t] = t;
        color[t] = (uint16_t)(prng_next(&p) | 1u);
        for (uint32_t v = 3 * t; v < 3 * t + 3; v++) {
            pos[v][2] = (int16_t)-(nearest + prng_range(&p, 0, depth));
            pos[v][0] = (int16_t)(prng_range(&p, -800, 800) * -pos[v][2] / 1000);
            pos[v][1] = (int16_t)(prng_range(&p, -800, 800) * -pos[v][2] / 1000);
            corners[t][v % 3] = (uint16_t)v;
        }
    }
    qsort(order, n, sizeof order[0], far_first);
    for (uint32_t k = 0; k < n; k++) {
        const uint32_t t = order[k];
        mesh[k] = (struct zs_mesh){ .pos = pos + 3 * t, .tri = one, .face_raw = color + t, .n_verts = 3, .n_tris = 1,
                                    .radius = 65535 };
        instances[k] = (struct zs_instance){ .mesh = &mesh[k], .material = &material };
    }
    const struct zs_scene sorted = { .instance = instances, .n_instances = n, .background = 7 };
    struct zs_config c = picture_config(64, 48, &zs_depth_none);
    c.fast = NULL;
    struct picture want = picture_draw(&c, &sorted, &camera);
    c.method = &zs_method_painter;
    picture_any_way(&p, &c, 2, 6);
    struct picture is = picture_draw(&c, &scene, &camera);
    walks += is.stats.passes;
    sets_drawn += is.stats.tris_drawn;
    return picture_drawn_alike(&want, &is, "single triangles");
}

/* ---- Any pools, any mapping ------------------------------------------------------------------- */

static unsigned again;

static int way_case(uint64_t seed)
{
    static const struct ways of = { 90, 70, .depth = &zs_depth_none, .method = { &zs_method_painter },
                                    .again = &again };
    return ways_alike(seed, &of);
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(is_that_of_single_triangles, single_case, 300,
                 { "walks", &walks, 10000 }, { "triangles drawn", &sets_drawn, 5000 }),
    CASES_COUNTS(is_the_same_in_any_way, way_case, 200, { "scenes in several walks", &again, 50 }),
    METHOD_NEEDS_TEST(small_pools_and_depth_memory_are_refused,
                      &zs_method_painter, &zs_depth_none, &zs_depth_float, 2),
    METHOD_NEEDS_TEST(depths_of_depth_sort_are_refused, &zs_method_painter, &zs_depth_none, &zs_depth_order, 2)
};

CASES_MAIN(tests)
