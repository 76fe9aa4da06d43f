/* A triangle that reaches beyond near, far, the guard band or a mirror's plane is clipped to a
 * polygon, and the polygon is binned as a fan of triangles, its pieces.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/assemble.h"
#include "core/clip.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "core/rotation.h"
#include "zs_shader.h"

struct polygon {
    struct zs_clip_vertex cv[ZS_CLIP_MAX];
    struct zs_vertex v[ZS_CLIP_MAX]; /* snapped */
    int n;
};

#define COORD_MAX ((1u << 30) + 2u) /* camera units: core/xform.h */

/* Return the winding of a triangle on the screen, computed exactly from its vertices in camera
 * units: > 0 if clockwise. The sign of a . (b x c) is the sign of the projected area of all that
 * lies in front of the eye. */
static ZS_RARE ZS_NOINLINE int sense_of(const struct zs_view *view,
                                        const struct zs_clip_vertex v[3])
{
    int32_t p[9]; /* a, b, c */
    for (int k = 0; k < 9; k++)
        p[k] = v[k / 3].p.c[k % 3];
    if (!zs_within(p, 9, COORD_MAX)) /* only if a mesh is larger than its bounding sphere */
        return 0;
    if (!view->perspective) /* the area is a . (b x c) with z = 1 */
        p[2] = p[5] = p[8] = 1;
    int64_t high = 0, low = 0; /* the sum is high * 2^32 + low, 0 <= low < 2^32 */
    for (int k = 0; k < 3; k++) {
        const int64_t n = zs_cross_at(p + 3, p + 6, k); /* |.| < 2^61.1 */
        int32_t upper = (int32_t)(n >> 32);
        ZS_NARROW(upper);
        high += zs_mul_ss(upper, p[k]);      /* |.| < 3 * 2^60 */
        low += zs_mul_su(p[k], (uint32_t)n); /* |.| < 2^62.1 */
        high += low >> 32;
        low &= 0xffffffff;
    }
    return high < 0 ? -1 : high > 0 || low > 0;
}

/* Return twice the area of the k-th piece of the fan around corner fan[0]. */
static ZS_RARE ZS_SHARED int64_t piece_area(const struct polygon *p, const uint8_t *fan, int k)
{
    return zs_assemble_area(&p->v[fan[0]], &p->v[fan[k]], &p->v[fan[k + 1]]);
}

/* Return twice the area of the snapped polygon, and in *fan its corners in order, starting with one
 * whose fan has no piece of the opposite winding. *fan points into `around`. Not every corner will
 * do, because rounding can make the polygon concave by a sub-pixel. The search starts at the corner
 * with the least (y, x), so that the result does not depend on the triangle's order of corners.
 *
 * A polygon that is seen nearly edge-on may have no such corner, because snapping made it cross
 * itself; its snapped area may even have the wrong sign. Then the function returns `sense`, the
 * winding of the triangle before it was clipped, and polygon_bin drops the pieces of the opposite
 * winding. That leaves no hole: the polygon is the signed sum of the pieces, so every sample with
 * the right winding lies in a piece with the right winding. But it can draw beyond the edge of a
 * thin polygon, by less than a sub-pixel's width. */
static ZS_RARE int64_t fan_corner(const struct polygon *p, int sense,
                                  uint8_t around[2 * ZS_CLIP_MAX], const uint8_t **fan)
{
    int first = 0;
    for (int k = 0; k < p->n; k++) {
        around[k] = around[p->n + k] = (uint8_t)k;
        if (p->v[k].y < p->v[first].y || (p->v[k].y == p->v[first].y && p->v[k].x < p->v[first].x))
            first = k;
    }
    for (int i = 0; i < p->n; i++) {
        int64_t area = 0; /* |.| < 8 * 2^45 */
        int signs = 0;
        *fan = around + around[first + i];
        for (int k = 1; k + 1 < p->n; k++) {
            const int64_t piece = piece_area(p, *fan, k);
            area += piece;
            signs |= piece > 0 ? 1 : piece < 0 ? 2 : 0;
        }
        if (signs != 3)
            return area;
    }
    *fan = around + first;
    return sense;
}

static ZS_RARE int32_t held(int32_t at)
{
    const int32_t most = (int32_t)ZS_GUARD_SUBPX;
    return zs_max32(zs_min32(at, most), -most);
}

static ZS_RARE void polygon_project(struct zs_renderer *r, struct polygon *p)
{
    const int32_t cx = r->view.cx, cy = r->view.cy;
    for (int k = 0; k < p->n; k++) {
        struct zs_vertex *v = &p->v[k];
        (void)zs_xform_project(r, &p->cv[k].p, v); /* clipped: near <= z <= far */
        /* rounding to camera units may put a new vertex slightly outside the guard band */
        v->x = cx + held(v->x - cx);
        v->y = cy + held(v->y - cy);
    }
}

/* Append a piece and its three vertices to the pools and bin it. at->slot: numbers of its corners
 * in the polygon. */
static ZS_RARE void piece_push(struct zs_renderer *r, const struct polygon *p,
                               const struct zs_candidate *at, uint16_t paint, uint32_t strip)
{
    uint32_t slot[3];
    for (int k = 0; k < 3; k++) {
        slot[k] = r->n_verts++;
        r->vert[slot[k]] = p->v[at->slot[k]];
        r->vert_src[slot[k]] = ZS_NO_SOURCE;
        for (uint32_t a = 0; a < r->xform.instance->material->shader->n_varyings; a++)
            r->attr[slot[k] * r->config.varyings + a] = p->cv[at->slot[k]].attr[a];
    }
    zs_bin_add(r, slot, paint, strip);
}

/* Bin the pieces of a polygon from *piece on; those before it are binned already. */
static ZS_RARE enum zs_outcome polygon_bin(struct zs_renderer *r, const struct polygon *p,
                                           uint32_t t, int sense, uint32_t *piece)
{
    const struct zs_material *material = r->xform.instance->material;
    const struct zs_shader *shader = material->shader;
    uint8_t around[2 * ZS_CLIP_MAX];
    const uint8_t *fan;
    const int64_t area = fan_corner(p, sense, around, &fan);
    const int ccw = area < 0; /* counter-clockwise: pieces list their corners in reverse order */
    if (area == 0)
        return ZS_OUTCOME_ZERO;
    if (zs_assemble_culled(area, r->xform.cull))
        return ZS_OUTCOME_FACING;
    const uint16_t paint = shader->face ? shader->face(&r->shading, t) : 0u;
    enum zs_outcome all = ZS_OUTCOME_EMPTY;
    for (int k = 1; k + 1 < p->n; k++) {
        const int64_t piece_size = piece_area(p, fan, k);
        if (ccw ? piece_size >= 0 : piece_size <= 0)
            continue;
        struct zs_candidate at = { { fan[ccw ? k + 1 : 0], fan[k], fan[ccw ? 0 : k + 1] }, 0, 0 };
        const enum zs_outcome outcome = zs_assemble_box(r, p->v, &at);
        if (all != ZS_OUTCOME_DRAWN)
            all = outcome;
        if (outcome != ZS_OUTCOME_DRAWN || (uint32_t)k < *piece)
            continue;
        if (ZS_IF_FAST(r->tiles))
            r->tiles->cover(r, &p->v[at.slot[0]], &p->v[at.slot[1]], &p->v[at.slot[2]]);
        const uint32_t strip = zs_bin_place(r, at.y0, at.y1);
        if (strip == ZS_NIL)
            continue;
        if (r->n_tris == r->config.max_tris || r->n_verts + 3u > r->config.max_verts) {
            *piece = (uint32_t)k;
            return ZS_OUTCOME_FULL;
        }
        piece_push(r, p, &at, paint, strip);
    }
    *piece = 0;
    return all;
}

ZS_RARE enum zs_outcome zs_fan_bin(struct zs_renderer *r, uint32_t t, uint32_t *piece)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const struct zs_shader *shader = r->xform.instance->material->shader;
    struct polygon p;
    uint32_t any = 0, all = ~0u, sides = 0;
    for (int k = 0; k < 3; k++) {
        const uint32_t v = mesh->tri[t][k];
        zs_xform_vertex(&r->xform, v, &p.cv[k].p);
        if (shader->vertex)
            shader->vertex(&r->shading, v, p.cv[k].attr);
        const uint32_t code = zs_xform_outcode(&r->view, &p.cv[k].p);
        any |= code;
        all &= code;
    }
    if (all)
        return zs_outcome_outside(all);
    if (r->counting && *piece == 0)
        r->stats.tris_clipped++;
    const int sense = sense_of(&r->view, p.cv);
    p.n = zs_clip_polygon(&r->view, p.cv, 3, any & (ZS_OUT_NEAR | ZS_OUT_FAR), shader->n_varyings);
    for (int k = 0; k < p.n; k++) /* outcodes of the sides are not defined before near */
        sides |= zs_xform_outcode(&r->view, &p.cv[k].p) & (ZS_OUT_SIDES | ZS_OUT_MIRROR);
    if (p.n && sides) {
        p.n = zs_clip_polygon(&r->view, p.cv, p.n, sides, shader->n_varyings);
        if (!p.n)
            return ZS_OUTCOME_OFFSCREEN;
    }
    if (!p.n)
        return any & ZS_OUT_NEAR ? ZS_OUTCOME_NEAR : ZS_OUTCOME_FAR;
    polygon_project(r, &p);
    return polygon_bin(r, &p, t, sense, piece);
}
