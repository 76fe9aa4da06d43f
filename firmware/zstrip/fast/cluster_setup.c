/* Cluster culling: the planes, the eye and the margins of an instance's tests. clusters.c derives
 * them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/damage.h"
#include "core/fx.h"
#include "core/usual.h"
#include "core/view.h"
#include "fast/clusters.h"
#include "fast/screen.h"
#include "zs_shader.h"

#define CLUSTERS_MIN 5u /* in fewer, set-up takes what tests could save */
#define EYE_BITS 14 /* |d| in units */
#define EYE_OFF 6

/* ---- Rows and columns of the frame -----------------------------------------------------------
 *
 * A point above the plane of a row's upper edge is snapped to at most half a step (8 sub-pixels)
 * below it. The samples of the row are 128 sub-pixels below its upper edge, so the point only
 * affects the rows above. The same holds for lower edges, and for columns. */

/* Return v * n / 2^30, truncated. */
static ZS_RARE int64_t part_of(int64_t v, int32_t n)
{
    return n < 0 ? -zs_mulshift_s64(v, 0u - (uint64_t)n, 30) : zs_mulshift_s64(v, (uint64_t)n, 30);
}

/* Return n . c for a unit normal with the components `lateral` and `away`, q48_16, within 2. */
static ZS_RARE int64_t along(int32_t lateral, int64_t c, int32_t away, int64_t z)
{
    return part_of(c, lateral) + part_of(z, away);
}

/* Set the plane of an edge of the region that is drawn, `at` sub-pixels from the viewport's centre.
 * sign 1: the region is below the edge (a row) or right of it (a column); -1: above, or left. */
static ZS_RARE void edge_set(struct zs_edge *e, const struct zs_renderer *r, int32_t at,
                             int32_t sign)
{
    const struct zs_view *view = &r->view;
    int32_t n[2] = { ZS_Q30_ONE, 0 };
    e->at = 0;
    if (view->perspective)
        zs_view_side(n, r->camera.focal, (uint32_t)zs_abs32(at));
    else
        e->at = -sign * zs_mulshift_s64(at,
                                        zs_muldiv_u64((uint64_t)r->camera.height, (uint64_t)1 << 20,
                                                      view->height * (uint64_t)ZS_SUBPX_HALF),
                                        21);
    e->lateral = sign * n[0];
    e->z = at < 0 ? sign * n[1] : -sign * n[1];
}

/* The first walk tests against all rows of the pass in place of the band's, so that its counts do
 * not depend on pool sizes and strip height. */
ZS_RARE int zs_cluster_edges(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number)
{
    const struct zs_track_ops *track = r->track;
    const int32_t h = r->config.strip_h;
    struct zs_region region = { r->walk_y, r->walk_y_end, 0, r->view.width };
    int outside = 0;
    if (!r->counting) {
        region.y = (uint16_t)zs_max32(r->strip * h, region.y);
        region.y_end = (uint16_t)zs_min32(r->band_end * h, region.y_end);
        if (region.y >= region.y_end)
            return 0;
    }
    if (track)
        (void)track->touches(r, number, &region);
    /* without: the viewport's side planes */
    const int columns = region.x > 0 || region.x_end < r->view.width;
    const uint16_t edges[4] = { region.y, region.y_end, region.x, region.x_end };
    for (int k = 0; k < (columns ? 4 : 2); k++) {
        struct zs_edge *e = &r->edge[k];
        if (r->edge_of[k] != edges[k])
            edge_set(e, r, edges[k] * ZS_SUBPX_ONE - (k < 2 ? r->view.cy : r->view.cx),
                     1 - 2 * (k & 1));
        r->edge_of[k] = edges[k];
        outside |= along(e->lateral, b->c[k < 2], e->z, b->c[2]) + e->at < -b->r - b->slack;
    }
    return !outside || r->counting;
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* The conversion from world units to mesh steps. */
struct ruler {
    uint32_t rcp; /* 2^63 / the leading 32 bits of scale */
    int32_t lz;   /* leading zeros of scale */
};

/* Convert q48_16 world units to 2^-bits steps, truncated. bits -20 .. 12, |steps| < 2^30 */
static ZS_RARE int32_t steps(const struct ruler *by, int64_t length, int32_t bits)
{
    return (int32_t)zs_mulshift_s64(length, by->rcp, 79 - by->lz - bits);
}

/* Return the offset of plane k, and its normal as (lateral, away). The planes are near, far, then
 * the left, right, upper and lower edge of what is drawn. */
static ZS_RARE int64_t plane_of(const struct zs_renderer *r, int k, int32_t n[2])
{
    const struct zs_view *view = &r->view;
    if (k < 2) {
        n[0] = 0;
        n[1] = k ? -ZS_Q30_ONE : ZS_Q30_ONE;
        return k ? r->camera.z_far : -r->camera.z_near;
    }
    const struct zs_edge *e = &r->edge[k < 4 ? k : k - 4];
    if (k < 4 && r->walk_x == 0 && r->walk_end == r->view.width) {
        n[0] = view->perspective ? view->side[0][0] : ZS_Q30_ONE;
        n[0] = k & 1 ? -n[0] : n[0];
        n[1] = view->perspective ? view->side[0][1] : 0;
        return view->perspective ? 0 : zs_cull_half_width(&r->camera, view);
    }
    n[0] = e->lateral;
    n[1] = e->z;
    return e->at;
}

/* Set the planes that intersect the mesh's sphere. Return 0 if that is not possible. */
static ZS_RARE int planes_open(struct zs_renderer *r, const struct zs_bounds *b,
                               const struct ruler *by, const zs_q2_30 axis[9])
{
    struct zs_clusters *c = &r->clusters;
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const int64_t reach = b->r + b->slack;
    if (b->slack > b->r) /* nothing to gain, and steps() might overflow */
        return 0;
    const int32_t slack = steps(by, b->slack, ZS_PLANE_BITS) +
                          (((mesh->radius >> 12) + 2) << ZS_PLANE_BITS);
    c->sure = 2 * slack;
    for (int k = 0; k < 6; k++) {
        int32_t n[2];
        const int lateral = k < 4 ? 0 : 1;
        int64_t d = plane_of(r, k, n);
        d += along(n[0], b->c[lateral], n[1], b->c[2]);
        if (d > reach)
            continue;
        d = d < -reach ? -reach : d;
        int16_t *plane = c->plane[c->n_planes];
        int32_t at = steps(by, d, ZS_PLANE_BITS) + slack; /* |.| < 2^29.6 */
        for (int j = 0; j < 3; j++) {
            const int64_t side = zs_mul_ss(n[0], axis[3 * lateral + j]);
            const int64_t sum = side + zs_mul_ss(n[1], axis[6 + j]); /* <= 2^61 */
            plane[j] = (int16_t)zs_round_shift(sum, 60 - ZS_PLANE_BITS);
            at -= plane[j] * mesh->center[j]; /* all three: <= 2^27.8 */
        }
        c->at[c->n_planes++] = at;
        if (k < 2 || r->xform.clip_guard)
            c->n_whole = c->n_planes;
    }
    return 1;
}

/* Set the eye and the margins of (*). Leaves cone at 0 if the cone test cannot be used. */
static ZS_RARE void cone_open(struct zs_renderer *r, const struct zs_bounds *b,
                              const struct ruler *by, const zs_q2_30 axis[9])
{
    struct zs_clusters *c = &r->clusters;
    const struct zs_view *view = &r->view;
    const struct zs_camera *camera = &r->camera;
    const uint32_t step = 3u << view->snap; /* quarters of a sub-pixel */
    const int32_t cull = r->xform.instance->material->cull;
    int64_t most = 0, all = 0, at[3] = { 0, 0, 0 };
    int32_t shift = 0, v[3];
    if (cull == ZS_CULL_NONE || view->ratio < ZS_Q30_ONE / 2)
        return;
    for (int k = 0; k < 3; k++) {
        const int64_t size = b->c[k] < 0 ? -b->c[k] : b->c[k];
        most = size > most ? size : most;
        all += size;
    }
    /* D_all <= 2^49: |c| <= (|x| + |y| + |z| + the largest) / 2 */
    all = (all + most) / 2 + b->r + b->slack + 1;
    uint64_t e = view->perspective
                     ? zs_muldiv_u64((uint64_t)all, (uint64_t)step << 22, camera->focal)
                     : zs_muldiv_u64((uint64_t)camera->height, step,
                                     view->height * (uint64_t)(8 * ZS_SUBPX_HALF));
    /* 32 camera units; shift is at least -3 */
    e += (((uint64_t)1 << 24) >> (view->shift + 3)) + 2u;
    if (e >= (uint64_t)all)
        return;
    if (view->perspective) {
        /* all < 2^(64 - lz), scale >= 2^(63 - by->lz): in steps, below 2^(17 - lz + by->lz) */
        shift = zs_max32(17 - zs_clz64((uint64_t)all) + by->lz - EYE_BITS, 0);
        if (shift > ZS_EYE_SHIFT_MAX)
            return;
        for (int k = 0; k < 3; k++)
            v[k] = steps(by, b->c[k], -shift);
        c->eye_shift = (uint8_t)shift;
    } else {
        v[0] = v[1] = 0;
        v[2] = 1 << EYE_BITS;
        c->eye_shift = 31; /* so the cluster's position and radius count for at most 1 */
    }
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k < 3; k++)
            at[j] += zs_mul_ss(axis[3 * k + j], v[k]);
        c->eye[j] = (int32_t)zs_round_shift(at[j], 30);
    }
    /* 1/1024 unit; thin: 2 E (D + E) / t with t in 1/16 step */
    const int32_t fine = view->perspective ? 10 - shift : 10;
    if (e > (uint64_t)b->r && !view->perspective)
        return; /* E exceeds the mesh: steps() might overflow */
    const uint64_t off = (uint64_t)steps(by, (int64_t)e, fine) + 1u; /* < 2^26 */
    uint64_t thin;
    if (view->perspective) {
        /* < 2^42 */
        const uint64_t d = ((uint64_t)steps(by, all, -shift) + 1u + (off >> 10) + 1u) * off;
        thin = (d << shift >> 5) + 1u;
        c->margin = (uint32_t)(off >> 10) + 1u + EYE_OFF + (uint32_t)steps(by, b->slack, -shift) +
                    1u;
    } else {
        thin = (off << EYE_BITS >> 5) + 1u;
        c->margin = EYE_OFF;
    }
    c->thin = thin > UINT32_MAX ? UINT32_MAX : (uint32_t)thin;
    c->cone = cull == ZS_CULL_FRONT ? -1 : 1;
}

ZS_RARE int zs_cluster_open(struct zs_renderer *r, const struct zs_bounds *b)
{
    struct zs_clusters *c = &r->clusters;
    const struct zs_instance *in = r->xform.instance;
    const struct zs_mesh *mesh = in->mesh;
    const uint64_t scale = zs_usual_scale(in);
    zs_q2_30 axis[9];
    struct ruler by;
    if (mesh->n_clusters < CLUSTERS_MIN || in->material->shader->place || in->material->primitive)
        return 0;
    if (!r->batch)
        zs_screen_needs(r, b);
    by.lz = zs_clz64(scale);
    by.rcp = zs_recip((uint32_t)(scale << by.lz >> 32));
    c->next = 0;
    c->n_planes = c->n_whole = c->known = c->counted = 0;
    c->cone = 0;
    zs_cull_axes(axis, in, &r->camera);
    const int clips = r->xform.clip_depth | r->xform.clip_guard;
    if (planes_open(r, b, &by, axis) || !clips)
        cone_open(r, b, &by, axis);
    return c->n_planes || c->cone;
}
