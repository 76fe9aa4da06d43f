/* Cluster culling: clusters of a mesh that cannot be seen are not drawn, and the vertices that only
 * they use are not transformed.
 *
 * All tests are in mesh steps. The planes of the view and the eye are converted to them once for
 * each instance. A cluster is culled only if it could not have drawn a pixel.
 *
 * SPHERES. A cluster is culled if its sphere lies outside one of the planes: near, far, the sides
 * of the frame, the upper and lower edge of the rows that are drawn. The distance of a plane from
 * the mesh's centre is exact to b->slack, which includes the error of a vertex (zs_cull_walk).
 * Normals are rounded to 2^-13. That changes the distance of a cluster's centre by at most 2^-13
 * sqrt 3 of its distance from the mesh's centre, in all below radius / 4096. Planes that the mesh's
 * sphere does not reach are not tested.
 *
 * CONES. A cluster is culled if all its triangles show the culled side. struct zs_cluster
 * (zs_scene.h) states the condition for the exact triangles. But facing is decided after the
 * vertices have been rounded to camera units and snapped, which may flip a triangle that is small
 * or nearly edge-on. So the eye has to be behind every triangle by a margin.
 *
 * Let E be a length such that each snapped vertex (on its ray, at its distance) lies within E of
 * its exact position. Move the three vertices from the exact to the snapped positions in straight
 * lines. If the triangle flips on the way, there is a moment when a plane P through the eye
 * contains all three; so each exact vertex lies within E of P. Let T be the triangle's plane, h the
 * eye's distance from T, a the angle between P and T, D the distance of a vertex from the eye, t
 * the triangle's least height.
 *   P and T parallel:   h <= E
 *   else, with L the line where they intersect: the vertices lie in T within E / sin a of L. A
 *   strip of that width holds no triangle with a least height above 2 E / sin a, so sin a <= 2 E /
 *   t. The point of P nearest to a vertex is at most E from T, so E / sin a from L, and at most D +
 *   E from the eye. So h = sin a * (distance of the eye from L) <= sin a * (D + E) + E
 * So h > E + 2 E (D + E) / t =: M is sufficient. (Orthographic: all rays have one direction, P
 * contains it, and sin a is at least the sine s of its angle with T; s > 2 E / t is sufficient.
 * That is the same condition with a distance D as the unit and without radii.)
 *
 * With A = axis, C = cutoff (127 is 1), r = radius, d the vector from the eye to the sphere's
 * centre, N the normal of a triangle of the cluster: zs_mesh_check (support/check.c) checks that |N
 * - u A| <= u C for u = N . A / K > 0, K = |A|^2 - C^2 <= 128^2, and u >= |N| / sqrt K. So if d . A
 * >= C |d| + 128 r, then d . N >= u (d . A - C |d|) >= 128 r u >= r |N|, and the eye is behind the
 * triangle, because the distance of the triangle's plane from the sphere's centre is at most r.
 * With -d for d, the eye is in front of it. If the condition holds for every eye within M, the eye
 * is behind by at least M. Moving the eye by m changes d . A by at most 128 m, and C |d| by C m. So
 * the condition is
 *   d . A >= C |d| + 128 r + (128 + C) M                                              (*)
 *
 * E, in world units, has two parts. Snapping: 1/2 step of 2^snap sub-pixels, and less than 2^-8 of
 * a step for arithmetic, in each direction, times sqrt 2: below 3/4 2^snap, times distance /
 * focal length. And 32 camera units for the rounding in core/xform.c (3 for each axis, twice that
 * where it is divided by a ratio above 1/2, sqrt 3 for three axes). D is at most D_all, the far
 * side of the mesh's sphere. The position of the eye in mesh axes has an error of b->slack and of 6
 * units of d (2^eye_shift steps): the rounding of three coordinates, each to 1, rotated; that of
 * their sums, 1/2 for each axis; that of the cluster's centre, 1 for each axis: below 3 sqrt 3.
 * Rotations that are inexact by 2^-20 move it by less than b->slack.
 *
 * All this holds for triangles that are not clipped; a piece of a clipped triangle is smaller than
 * the triangle. So a cluster that reaches the near or far plane gets no cone test, and, if any
 * vertex may be outside the guard band, neither does one that reaches a side plane. A triangle with
 * two equal vertices has no area, however it is rounded.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cull.h"
#include "core/damage.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/usual.h"
#include "core/view.h"
#include "fast/screen.h"
#include "zs_fast.h"
#include "zs_shader.h"

#define CLUSTERS_MIN 5u /* in fewer, set-up takes what tests could save */
#define PLANE_BITS 12
#define EYE_BITS 14 /* |d| in units */
#define EYE_SHIFT_MAX 20
#define EYE_OFF 6
#define MARGIN_MAX (1 << 16)

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

/* Set the plane of an edge of the part that is drawn, `at` sub-pixels from the viewport's centre.
 * sign 1: the part is below the edge (a row) or to its right (a column); -1: above, or to its left.
 */
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

/* zs_fast_clusters.edges. The first traversal tests against all rows of the pass in place of the
 * band's, so that its counts do not depend on pool sizes and strip height. */
static ZS_RARE int cluster_edges(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number)
{
    const struct zs_track_kernel *track = r->track;
    const int32_t h = r->config.strip_h;
    struct zs_part part = { r->walk_y, r->walk_y_end, 0, r->view.width };
    int outside = 0;
    if (!r->counting) {
        part.y = (uint16_t)zs_max32(r->strip * h, part.y);
        part.y_end = (uint16_t)zs_min32(r->band_end * h, part.y_end);
        if (part.y >= part.y_end)
            return 0;
    }
    if (track)
        (void)track->touches(r, number, &part);
    const int columns = part.x > 0 ||
                        part.x_end < r->view.width; /* else: the viewport's side planes */
    const uint16_t edges[4] = { part.y, part.y_end, part.x, part.x_end };
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
    if (b->slack > b->r) /* the error is larger than the mesh: nothing to gain, and steps() might
                            overflow */
        return 0;
    const int32_t slack = steps(by, b->slack, PLANE_BITS) +
                          (((mesh->radius >> 12) + 2) << PLANE_BITS);
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
        int32_t at = steps(by, d, PLANE_BITS) + slack; /* |.| < 3 * 2^28 */
        for (int j = 0; j < 3; j++) {
            const int64_t sum = zs_mul_ss(n[0], axis[3 * lateral + j]) +
                                zs_mul_ss(n[1], axis[6 + j]); /* <= 2^61 */
            plane[j] = (int16_t)zs_round_shift(sum, 60 - PLANE_BITS);
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
    all = (all + most) / 2 + b->r + b->slack +
          1; /* D_all: |c| <= (|x| + |y| + |z| + the largest) / 2; <= 2^49 */
    uint64_t e = view->perspective
                     ? zs_muldiv_u64((uint64_t)all, (uint64_t)step << 22, camera->focal)
                     : zs_muldiv_u64((uint64_t)camera->height, step,
                                     view->height * (uint64_t)(8 * ZS_SUBPX_HALF));
    e += (((uint64_t)1 << 24) >> (view->shift + 3)) +
         2u; /* 32 camera units; shift is at least -3 */
    if (e >= (uint64_t)all)
        return;
    if (view->perspective) {
        /* all < 2^(64 - lz), scale >= 2^(63 - by->lz): in steps, below 2^(17 - lz + by->lz) */
        shift = zs_max32(17 - zs_clz64((uint64_t)all) + by->lz - EYE_BITS, 0);
        if (shift > EYE_SHIFT_MAX)
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
        const uint64_t d = ((uint64_t)steps(by, all, -shift) + 1u + (off >> 10) + 1u) *
                           off; /* < 2^42 */
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

static ZS_RARE int cluster_open(struct zs_renderer *r, const struct zs_bounds *b)
{
    struct zs_clusters *c = &r->clusters;
    const struct zs_instance *in = r->xform.instance;
    const struct zs_mesh *mesh = in->mesh;
    const uint64_t scale = zs_usual_scale(in);
    zs_q2_30 axis[9];
    struct ruler by;
    if (mesh->n_clusters < CLUSTERS_MIN || in->material->shader->place)
        return 0;
    if (!r->batch)
        zs_screen_needs(r, b);
    by.lz = zs_clz64(scale);
    by.rcp = zs_recip((uint32_t)(scale << by.lz >> 32));
    c->next = 0;
    c->n_planes = c->n_whole = c->known = c->counted = 0;
    c->cone = 0;
    zs_cull_axes(axis, in, &r->camera);
    const int cut = r->xform.clip_depth | r->xform.clip_guard;
    if (planes_open(r, b, &by, axis) || !cut)
        cone_open(r, b, &by, axis);
    return c->n_planes || c->cone;
}

/* ---- Tests ----------------------------------------------------------------------------------- */

/* Return 1 if (*) holds. For a mesh that zs_mesh_check would refuse, sums may wrap, and the result
 * is arbitrary. */
static int turned_away(const struct zs_clusters *k, const struct zs_mesh *mesh,
                       const struct zs_cluster *c)
{
    const int32_t down = k->eye_shift;
    if (c->height == 0 || c->cutoff == 127 || c->cutoff < 0)
        return 0;
    const int32_t x = ((c->center[0] - mesh->center[0]) >> down) +
                      k->eye[0]; /* |.| < 2^17 at worst */
    const int32_t y = ((c->center[1] - mesh->center[1]) >> down) + k->eye[1];
    const int32_t z = ((c->center[2] - mesh->center[2]) >> down) + k->eye[2];
    int32_t ahead = (x * c->axis[0] + y * c->axis[1] + z * c->axis[2]) * k->cone -
                    128 * ((c->radius >> down) + 1);
    if (ahead <= 0)
        return 0;
    const uint32_t square = (uint32_t)x * (uint32_t)x + (uint32_t)y * (uint32_t)y +
                            (uint32_t)z * (uint32_t)z; /* < 3 * 2^28.1 */
    const uint32_t margin = k->margin + k->thin / c->height + 1u;
    if (margin > MARGIN_MAX || k->margin > MARGIN_MAX)
        return 0;
    ahead -= (128 + c->cutoff) * (int32_t)margin; /* < 2^24 */
    return ahead > 0 && zs_mul_uu((uint32_t)ahead, (uint32_t)ahead) >=
                            zs_mul_uu((uint32_t)(c->cutoff * c->cutoff), square);
}

/* Return 1 if cluster i is culled. */
static int left_out(const struct zs_renderer *r, uint32_t i)
{
    const struct zs_clusters *k = &r->clusters;
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const struct zs_cluster *c = &mesh->cluster[i];
    const int32_t x = c->center[0], y = c->center[1], z = c->center[2],
                  reach = c->radius << PLANE_BITS; /* < 2^28 */
    int whole = k->cone;
    for (uint32_t p = 0; p < k->n_planes; p++) {
        const int16_t *n = k->plane[p];
        const int32_t d = n[0] * x + n[1] * y + n[2] * z +
                          k->at[p]; /* <= 2^27.8 + 2^27.8 + 3 * 2^28 < 2^30.4 */
        if (d < -reach)
            return 1;
        if (p < k->n_whole && d - reach <= k->sure)
            whole = 0;
    }
    return whole && turned_away(k, mesh, c);
}

/* ---- Runs ------------------------------------------------------------------------------------ */

/* Bytes: a mark for each vertex, then a flag for each cluster. They are stored in vert_map, which
 * is not used while r->direct is set. */
static uint8_t *marks(const struct zs_renderer *r)
{
    return (uint8_t *)r->vert_map;
}

/* Return the number of triangles of cluster i, which begins at triangle t; limited to the mesh's.
 */
static uint32_t tris_of(const struct zs_mesh *mesh, uint32_t i, uint32_t t)
{
    return zs_minu32(mesh->cluster[i].n_tris, mesh->n_tris - t);
}

static ZS_RARE int cluster_run(struct zs_renderer *r)
{
    struct zs_clusters *k = &r->clusters;
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint8_t *flag = r->direct && k->known ? marks(r) + ZS_ROUND4(mesh->n_verts) : 0;
    const int counting = r->counting && !k->counted;
    k->from = k->end;
    for (; k->next < mesh->n_clusters; k->next++) {
        const uint32_t n = tris_of(mesh, k->next, k->end);
        const int out = flag ? flag[k->next] : left_out(r, k->next);
        if (out && k->from < k->end)
            return 1; /* the next call tests this cluster again */
        if (counting) {
            r->stats.clusters_in++;
            r->stats.clusters_culled += (uint32_t)out;
            r->stats.tris_cluster += out ? n : 0u;
        }
        k->end += n;
        if (out)
            k->from = k->end;
    }
    k->end = mesh->n_tris; /* triangles in no cluster are drawn */
    return k->from < k->end;
}

static void run_again(struct zs_clusters *k)
{
    k->next = k->from = k->end = 0;
}

/* Test all clusters. Return the number of triangles in culled ones. */
static uint32_t ask(struct zs_renderer *r)
{
    struct zs_clusters *k = &r->clusters;
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    uint8_t *flag = marks(r) + ZS_ROUND4(mesh->n_verts);
    uint32_t out = 0, t = 0, tris = 0;
    const int room = ZS_ROUND4(mesh->n_verts) + mesh->n_clusters <= 2u * r->config.max_verts;
    for (uint32_t i = 0; i < mesh->n_clusters; i++) {
        const uint32_t n = tris_of(mesh, i, t), is = (uint32_t)left_out(r, i);
        if (room)
            flag[i] = (uint8_t)is;
        out += is;
        tris += is ? n : 0u;
        t += n;
    }
    k->known = (uint8_t)room;
    k->counted = 1;
    if (r->counting) {
        r->stats.clusters_in += mesh->n_clusters;
        r->stats.clusters_culled += out;
        r->stats.tris_cluster += tris;
    }
    return tris;
}

/* Mark the vertices of the triangles that are drawn. */
static void mark(struct zs_renderer *r)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint32_t n_verts = mesh->n_verts;
    uint8_t *mark = marks(r);
    zs_fill_run(r->vert_map, 0, ZS_ROUND4(n_verts) / 2u);
    while (cluster_run(r)) {
        const uint16_t(*tri)[3] = mesh->tri + r->clusters.from,
              (*const end)[3] = mesh->tri + r->clusters.end;
        for (; tri < end; tri++) {
            const uint32_t a = (*tri)[0], b = (*tri)[1], c = (*tri)[2];
            if (a < n_verts)
                mark[a] = 1;
            if (b < n_verts)
                mark[b] = 1;
            if (c < n_verts)
                mark[c] = 1;
        }
    }
    run_again(&r->clusters);
}

/* zs_fast_clusters.verts. To find out which vertices are needed takes half the time of transforming
 * them. So if less than a third of the triangles are culled, all vertices are transformed. */
static int cluster_verts(struct zs_renderer *r)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint32_t n = mesh->n_verts, out = ask(r);
    if (out == 0)
        r->by_clusters = 0;
    if (out * 3u < mesh->n_tris)
        return 0;
    mark(r);
    const uint8_t *const flag = marks(r);
    for (uint32_t v = 0; v < n; v++) {
        while (v + 4u <= n && !(flag[v] | flag[v + 1u] | flag[v + 2u] | flag[v + 3u]))
            v += 4u;
        const uint32_t from = v;
        while (v < n && flag[v])
            v++;
        if (from < v)
            zs_batch_verts(r, r->vert_base + from, from, v - from);
    }
    return 1;
}

static const struct zs_fast_clusters clusters = {
    .edges = cluster_edges, .open = cluster_open, .verts = cluster_verts, .run = cluster_run
};
const struct zs_fast zs_fast_clusters = { .clusters = &clusters };
