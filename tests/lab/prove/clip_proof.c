/* clip.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "core/clip.c"

#define C_MAX (((int32_t)1 << 30) + 1)

static struct zs_view view;

static void any_view(int perspective)
{
    view.perspective = (uint8_t)perspective;
    view.z_near = perspective ? any_i32(256, 1 << 30) : any_i32(-(1 << 30), 1 << 30);
    view.z_far = any_i32(-(1 << 30), 1 << 30);
    view.scale_bits = perspective ? any_i32(8, 31) : any_i32(0, 40);
    view.guard = perspective ? (uint64_t)ZS_GUARD_SUBPX
                             : any_u64((uint64_t)ZS_GUARD_SUBPX, (uint64_t)ZS_GUARD_SUBPX << 40);
}

static void any_vertex(struct zs_clip_vertex *v)
{
    for (int k = 0; k < 3; k++) {
        v->p.c[k] = any_i32(-C_MAX, C_MAX);
        v->attr[k] = (uint16_t)any_u32(0, 65535);
    }
}

/* PROVE distances: every point in camera units, every plane, both projections: below 2^62 */
void distances(void)
{
    struct zs_clip_vertex v;
    any_vertex(&v);
    for (int perspective = 0; perspective < 2; perspective++)
        for (uint32_t plane = ZS_OUT_NEAR; plane <= ZS_OUT_BOTTOM; plane <<= 1) {
            any_view(perspective);
            /* an orthographic guard is (8188 px) 2^scale_bits: up to 2^61 */
            const int64_t d = inside(&view, &v.p, plane);
            ASSERT(d < (int64_t)1 << 62 && d > -((int64_t)1 << 62));
        }
}

/* PROVE crossings: edges of any two points, distances of either sign below 2^62, every plane, 0 .. 3 attributes */
void crossings(void)
{
    struct zs_clip_vertex a, b, out;
    any_view(1);
    any_vertex(&a);
    any_vertex(&b);
    for (uint32_t plane = ZS_OUT_NEAR; plane <= ZS_OUT_BOTTOM; plane <<= 1)
        cross_plane(&view, &out, &a, &b, any_i64(1, ((int64_t)1 << 62) - 1), any_i64(1, ((int64_t)1 << 62) - 1), plane,
                    any_u32(0, 3));
}

/* PROVE polygons -eva-min-loop-unroll=10 -eva-slevel-function=clip_plane:3000: polygons of 3 and 4 corners, any, at the
 * near plane and one of the guard band: what is read was written, and nothing beyond nine corners is */
void polygons(void)
{
    static const int corners[2] = { 3, 4 };
    struct zs_clip_vertex v[ZS_CLIP_MAX];
    any_view(1);
    for (int c = 0; c < 2; c++)
        for (uint32_t plane = ZS_OUT_NEAR; plane <= ZS_OUT_TOP; plane <<= 4) {
            for (int i = 0; i < corners[c]; i++)
                any_vertex(&v[i]);
            const int left = zs_clip_polygon(&view, v, corners[c], plane, 3);
            ASSERT(left >= 0 && left <= ZS_CLIP_MAX);
        }
}
