/* Polygon clipping in camera units, one plane after another (Sutherland and Hodgman, CACM 1974).
 *
 * A new vertex is always computed from the inside end of the edge towards the outside end. So two
 * triangles that share an edge get the same vertex, in whatever order they list its ends. At near
 * and far the distances from the plane are exact, and the vertex is the exact intersection rounded
 * once. At the guard band, far outside the frame, and at a mirror's plane, distances are truncated
 * to 31 bits, an error of 2^-30 of the edge.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/clip.h"
#include "core/fx.h"

/* Return the signed distance of a point from a plane, >= 0 inside. |.| < 2^62. */
static int64_t inside(const struct zs_view *view, const struct zs_point *p, uint32_t plane)
{
    const int32_t z = p->c[2];
    if (plane == ZS_OUT_MIRROR)
        return view->mirror->inside(view, p);
    if (plane == ZS_OUT_NEAR)
        return (int64_t)z - view->z_near;
    if (plane == ZS_OUT_FAR)
        return (int64_t)view->z_far - z;
    int64_t limit = (int64_t)view->guard, at = p->c[plane & (ZS_OUT_LEFT | ZS_OUT_RIGHT) ? 0 : 1];
    if (view->perspective) {
        limit = zs_mul_ss(z, (int32_t)view->guard); /* ZS_GUARD_SUBPX */
        at = zs_mul_su((int32_t)at, (uint32_t)1 << view->scale_bits); /* <= 2^31 */
    }
    return plane & (ZS_OUT_LEFT | ZS_OUT_TOP) ? limit + at : limit - at;
}

/* Where an edge crosses a plane: at num / den of its length. */
struct crossing {
    uint32_t num, den; /* num < 2^31, num < den < 2^32 */
    uint32_t rcp;      /* 2^63 / (den 2^lz) */
    int32_t lz;        /* leading zeros of den */
};

/* Return floor(n / den), exact, for n < den 2^32. */
static uint32_t quotient(const struct crossing *at, uint64_t n)
{
    if (ZS_FOR_SIZE)
        return (uint32_t)(n / at->den);
    const uint32_t top = (uint32_t)(n << at->lz >> 32);
    /* off by at most 2^32 / 2^31 for top and 4 for rcp; < 2^31.2 */
    uint32_t q = (uint32_t)(zs_mul_uu(top, at->rcp) >> 31);
    int64_t rest = (int64_t)(n - zs_mul_uu(q, at->den));
    for (; rest < 0; rest += at->den)
        q--;
    for (; rest >= at->den; rest -= at->den)
        q++;
    return q;
}

/* Return a + (b - a) * num / den, nearest. |b - a| < 2^31.1 */
static ZS_SHARED int32_t between(const struct crossing *at, int32_t a, int32_t b)
{
    const uint32_t size = b < a ? (uint32_t)a - (uint32_t)b : (uint32_t)b - (uint32_t)a;
    /* < 2^62.1 + 2^31 */
    const uint32_t offset = quotient(at, zs_mul_uu(size, at->num) + at->den / 2u);
    return (int32_t)(b < a ? (uint32_t)a - offset : (uint32_t)a + offset);
}

/* Compute the intersection of a plane and the edge from a, at distance da > 0 inside, to b, at db >
 * 0 outside. */
static void cross_plane(const struct zs_view *view, struct zs_clip_vertex *out,
                        const struct zs_clip_vertex *a, const struct zs_clip_vertex *b, uint64_t da,
                        uint64_t db, uint32_t plane, uint32_t n_varyings)
{
    for (; (da | db) >> 31; db >>= 1) /* near and far: already below 2^31, so they stay exact */
        da >>= 1;
    const uint32_t den = (uint32_t)da + (uint32_t)db; /* one is >= 2^30, or nothing was shifted */
    ZS_FACT(den > 0);
    const int32_t lz = ZS_FOR_SIZE ? 0 : zs_clz32(den);
    const struct crossing at = { (uint32_t)da, den, ZS_FOR_SIZE ? 0 : zs_recip(den << lz), lz };
    for (int k = 0; k < 3; k++)
        out->p.c[k] = between(&at, a->p.c[k], b->p.c[k]);
    for (uint32_t k = 0; k < n_varyings; k++)
        out->attr[k] = (uint16_t)between(&at, a->attr[k], b->attr[k]);
    if (plane == ZS_OUT_NEAR)
        out->p.c[2] = view->z_near;
    if (plane == ZS_OUT_FAR)
        out->p.c[2] = view->z_far;
}

static int clip_plane(const struct zs_view *view, struct zs_clip_vertex *out,
                      const struct zs_clip_vertex *in, int n, uint32_t plane, uint32_t n_varyings)
{
    int kept = 0;
    int64_t d = n ? inside(view, &in[0].p, plane) : 0;
    for (int i = 0; i < n; i++) {
        const int j = i + 1 < n ? i + 1 : 0;
        const int64_t d_next = inside(view, &in[j].p, plane);
        if (d >= 0 && kept < ZS_CLIP_MAX)
            out[kept++] = in[i];
        /* an end that lies on the plane is the intersection itself: no new vertex */
        if (d && d_next && (d ^ d_next) < 0 && kept < ZS_CLIP_MAX) {
            const int leaves = d > 0;
            cross_plane(view, &out[kept++], &in[leaves ? i : j], &in[leaves ? j : i],
                        (uint64_t)(leaves ? d : d_next), 0u - (uint64_t)(leaves ? d_next : d),
                        plane, n_varyings);
        }
        d = d_next;
    }
    return kept;
}

int zs_clip_polygon(const struct zs_view *view, struct zs_clip_vertex *v, int n, uint32_t planes,
                    uint32_t n_varyings)
{
    struct zs_clip_vertex other[ZS_CLIP_MAX];
    for (uint32_t plane = ZS_OUT_NEAR; plane <= ZS_OUT_MIRROR; plane <<= 1) {
        if (!(planes & plane))
            continue;
        n = clip_plane(view, other, v, n, plane, n_varyings);
        for (int i = 0; i < n; i++)
            v[i] = other[i];
    }
    return n < 3 ? 0 : n;
}
