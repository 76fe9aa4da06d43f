/* Clipping at each plane against fractions of 128 bits: what is inside stays, a new vertex lies on its edge where the
 * plane cuts it, within what core/clip.c says, and is the same for both triangles of the edge.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "internals.h"
#include "picture.h"

typedef __int128 wide;

#define ATTRS 3u

/* The view of a random camera, as a frame has it. */
static int view_make(struct zs_view *view, struct prng *p)
{
    static uint32_t arena[4000];
    static struct zs_renderer r;
    const struct zs_scene none = { .background = 1 };
    struct zs_camera camera;
    struct zs_config c = { .width = (uint16_t)prng_range(p, 1, 400), .height = (uint16_t)prng_range(p, 1, 300),
                           .strip_h = 1, .max_tris = 8, .max_verts = 8, .depth = &zs_depth_linear };
    const int32_t near = prng_range(p, 10, 2000), far = near + prng_range(p, 100, 1 << prng_range(p, 7, 22));
    int err = prng_pick(p, 3) ? zs_camera_perspective(&camera, ZS_DEGREES(60), c.height, near, far)
                              : zs_camera_orthographic(&camera, prng_range(p, 10, 100000), near, far);
    err = err ? err : zs_init(&r, &c, arena, sizeof arena);
    err = err ? err : zs_frame_begin(&r, &none, &camera);
    *view = r.view;
    return err;
}

/* The distance from a plane, >= 0 inside, in units of the plane. */
static wide inside(const struct zs_view *view, const int32_t c[3], uint32_t plane)
{
    if (plane == ZS_OUT_NEAR)
        return (wide)c[2] - view->z_near;
    if (plane == ZS_OUT_FAR)
        return (wide)view->z_far - c[2];
    const int axis = plane == ZS_OUT_LEFT || plane == ZS_OUT_RIGHT ? 0 : 1;
    const wide at = view->perspective ? (wide)c[axis] * ((wide)1 << view->scale_bits) : c[axis];
    const wide limit = view->perspective ? (wide)c[2] * (int32_t)view->guard : (wide)view->guard;
    return plane == ZS_OUT_LEFT || plane == ZS_OUT_TOP ? limit + at : limit - at;
}

/* Is `is` a + (b - a) num / den, off by at most half a unit and 2^-30 of the edge where the plane is no exact one? */
static int cut_at(wide is, wide a, wide b, wide num, wide den, int exact)
{
    const wide off = (is - a) * den - (b - a) * num, length = b < a ? a - b : b - a;
    return 2 * (off < 0 ? -off : off) <= den + (exact ? 0 : (length * den >> 29) + 1);
}

static void corner_make(struct zs_clip_vertex *v, const struct zs_view *view, struct prng *p)
{
    const int32_t far = view->z_far < 1 << 29 ? 2 * view->z_far : 1 << 30;
    for (int k = 0; k < 2; k++)
        v->p.c[k] = prng_range(p, -(1 << prng_range(p, 1, 30)), 1 << prng_range(p, 1, 30));
    v->p.c[2] = prng_pick(p, 8) ? prng_range(p, -far / 4, far) : prng_pick(p, 2) ? view->z_near : view->z_far;
    for (uint32_t k = 0; k < ATTRS; k++)
        v->attr[k] = (uint16_t)prng_next(p);
}

static unsigned cuts, whole;

/* One triangle at one plane. */
static int plane_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_view view;
    CASE_CHECK(view_make(&view, &p) == ZS_OK);
    for (int t = 0; t < 60; t++) {
        struct zs_clip_vertex in[3], out[ZS_CLIP_MAX], back[ZS_CLIP_MAX];
        const uint32_t plane = 1u << prng_pick(&p, 6);
        wide d[3];
        for (int k = 0; k < 3; k++) {
            corner_make(&in[k], &view, &p);
            d[k] = inside(&view, in[k].p.c, plane);
            out[k] = in[k];
            back[k] = in[k];
        }
        back[0] = in[2]; /* the other way round */
        back[2] = in[0];
        const int n = zs_clip_polygon(&view, out, 3, plane, ATTRS), m = zs_clip_polygon(&view, back, 3, plane, ATTRS);
        int want = 0;
        struct zs_clip_vertex kept[6];
        for (int k = 0; k < 3; k++) {
            const int j = (k + 1) % 3;
            if (d[k] >= 0)
                kept[want++] = in[k];
            if ((d[k] > 0 && d[j] < 0) || (d[k] < 0 && d[j] > 0)) {
                const int a = d[k] > 0 ? k : j, b = d[k] > 0 ? j : k;
                struct zs_clip_vertex *v = &out[want < n ? want : 0];
                for (int c = 0; c < 3; c++)
                    if (n >= 3 && !cut_at(v->p.c[c], in[a].p.c[c], in[b].p.c[c], d[a], d[a] - d[b],
                                          plane <= ZS_OUT_FAR))
                        return case_wrong("plane %u: coordinate %d of a new vertex is %d", plane, c, v->p.c[c]);
                for (uint32_t c = 0; c < ATTRS; c++)
                    CASE_CHECK(n < 3 || cut_at(v->attr[c], in[a].attr[c], in[b].attr[c], d[a], d[a] - d[b],
                                               plane <= ZS_OUT_FAR));
                if (plane <= ZS_OUT_FAR && n >= 3)
                    CASE_CHECK(v->p.c[2] == (plane == ZS_OUT_NEAR ? view.z_near : view.z_far));
                kept[want++] = *v;
                cuts++;
            }
        }
        if (n != (want < 3 ? 0 : want) || m != n)
            return case_wrong("plane %u: %d vertices, and %d the other way round, not %d", plane, n, m, want);
        for (int k = 0; k < n; k++)
            CASE_CHECK(!memcmp(kept[k].p.c, out[k].p.c, sizeof kept[k].p.c) &&
                       !memcmp(kept[k].attr, out[k].attr, ATTRS * sizeof kept[k].attr[0]));
        for (int k = 0; k < n; k++) { /* each is there the other way round */
            int found = 0;
            for (int i = 0; i < m; i++)
                found |= !memcmp(out[k].p.c, back[i].p.c, sizeof out[k].p.c) &&
                         !memcmp(out[k].attr, back[i].attr, ATTRS * sizeof out[k].attr[0]);
            CASE_CHECK(found);
        }
        whole += n == 3 && d[0] >= 0 && d[1] >= 0 && d[2] >= 0;
    }
    return 1;
}

/* All planes at once: between near and far exactly, no more vertices than there is room for, in their order. */
static int all_planes_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_view view;
    CASE_CHECK(view_make(&view, &p) == ZS_OK);
    for (int t = 0; t < 60; t++) {
        struct zs_clip_vertex v[ZS_CLIP_MAX];
        for (int k = 0; k < 3; k++)
            corner_make(&v[k], &view, &p);
        const int n = zs_clip_polygon(&view, v, 3, 63, ATTRS);
        CASE_CHECK(n == 0 || (n >= 3 && n <= 9));
        for (int k = 0; k < n; k++)
            CASE_CHECK(v[k].p.c[2] >= view.z_near && v[k].p.c[2] <= view.z_far);
        struct zs_clip_vertex again[ZS_CLIP_MAX];
        memcpy(again, v, sizeof v);
        const int same = zs_clip_polygon(&view, again, n, ZS_OUT_NEAR | ZS_OUT_FAR, ATTRS);
        CASE_CHECK(same == n && !memcmp(again, v, (size_t)n * sizeof *v));
    }
    return 1;
}

static const struct CMUnitTest tests[] = {
    CASES_COUNTS(each_plane, plane_case, 1500, { "new vertices", &cuts, 30000 }, { "whole triangles", &whole, 3000 }),
    CASES_TEST(all_planes, all_planes_case, 500),
};
CASES_MAIN(tests)
