/* Clipping in camera units: Sutherland and Hodgman, CACM 1974, plane after plane.
 *
 * A new vertex is always computed from the end of the edge that is inside towards the one outside, so
 * that the two triangles on an edge get the same vertex whatever order they name its ends in. Before
 * near and far the distances are exact, and the vertex is the exact crossing rounded once; at the
 * guard band, far outside the frame, they are cut to 31 bits: 2^-30 of the edge.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cold.h"
#include "pipeline.h"

/* How far a point is inside a plane: >= 0 inside. |.| < 2^62. */
static ZS_RARE int64_t inside(const struct zs_view *view, const struct zs_point *p, uint32_t plane)
{
    const int32_t z = p->c[2];
    if (plane == ZS_OUT_NEAR)
        return (int64_t)z - view->z_near;
    if (plane == ZS_OUT_FAR)
        return (int64_t)view->z_far - z;
    const int64_t limit = view->perspective ? (int64_t)view->guard * z : (int64_t)view->guard;
    const int32_t up = view->perspective ? view->scale_bits : 0;
    const int64_t at = (int64_t)p->c[plane & (ZS_OUT_LEFT | ZS_OUT_RIGHT) ? 0 : 1] *
                       ((int64_t)1 << up);
    return plane & (ZS_OUT_LEFT | ZS_OUT_TOP) ? limit + at : limit - at;
}

/* a + (b - a) * num / den, nearest. 0 <= num < den < 2^32, |b - a| < 2^31.1 */
static ZS_RARE int32_t between(int32_t a, int32_t b, int64_t num, int64_t den)
{
    const int64_t part = ((int64_t)b - a) * num; /* num < 2^31: |.| < 2^62.1 */
    const int64_t half = den / 2;
    return (int32_t)(a + (part < 0 ? -((-part + half) / den) : (part + half) / den));
}

/* The crossing of the edge from a (da >= 0) to b (db < 0). */
static ZS_RARE void cross_plane(const struct zs_view *view, struct zs_clip_vertex *out,
                        const struct zs_clip_vertex *a, const struct zs_clip_vertex *b, int64_t da,
                        int64_t db, uint32_t plane, uint32_t n_attrs)
{
    while ((da | -db) >> 31) { /* exact already for near and far */
        da >>= 1;
        db /= 2;
    }
    const int64_t den = da - db;
    if (den == 0) { /* both distances vanished beside each other: cannot be for da, -db >= 1 */
        *out = *a;
        return;
    }
    for (int k = 0; k < 3; k++)
        out->p.c[k] = between(a->p.c[k], b->p.c[k], da, den);
    for (uint32_t k = 0; k < n_attrs; k++)
        out->attr[k] = (uint16_t)between(a->attr[k], b->attr[k], da, den);
    if (plane == ZS_OUT_NEAR)
        out->p.c[2] = view->z_near;
    if (plane == ZS_OUT_FAR)
        out->p.c[2] = view->z_far;
}

static ZS_RARE int clip_plane(const struct zs_view *view, struct zs_clip_vertex *out,
                      const struct zs_clip_vertex *in, int n, uint32_t plane, uint32_t n_attrs)
{
    int kept = 0;
    int64_t d = n ? inside(view, &in[0].p, plane) : 0;
    for (int i = 0; i < n; i++) {
        const int j = i + 1 < n ? i + 1 : 0;
        const int64_t d_next = inside(view, &in[j].p, plane);
        if (d >= 0 && kept < ZS_CLIP_MAX)
            out[kept++] = in[i];
        /* an end on the plane is its own crossing */
        if (d > 0 && d_next < 0 && kept < ZS_CLIP_MAX)
            cross_plane(view, &out[kept++], &in[i], &in[j], d, d_next, plane, n_attrs);
        else if (d < 0 && d_next > 0 && kept < ZS_CLIP_MAX)
            cross_plane(view, &out[kept++], &in[j], &in[i], d_next, d, plane, n_attrs);
        d = d_next;
    }
    return kept;
}

ZS_RARE int zs_clip_polygon(const struct zs_view *view, struct zs_clip_vertex *v, int n, uint32_t planes,
                    uint32_t n_attrs)
{
    struct zs_clip_vertex other[ZS_CLIP_MAX];
    for (uint32_t plane = ZS_OUT_NEAR; plane <= ZS_OUT_BOTTOM; plane <<= 1) {
        if (!(planes & plane))
            continue;
        n = clip_plane(view, other, v, n, plane, n_attrs);
        for (int i = 0; i < n; i++)
            v[i] = other[i];
    }
    return n < 3 ? 0 : n;
}
