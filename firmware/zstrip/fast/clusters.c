/* Cluster culling: clusters of a mesh that cannot be seen are not drawn, and the vertices that only
 * they use are not transformed. cluster_setup.c prepares an instance's tests; it declines meshes of
 * few clusters, primitives and shaders that move vertices. What it is worth: zs_fast.h.
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
#include "fast/clusters.h"

#include "core/damage.h"
#include "core/fast.h"
#include "core/fx.h"
#include "fast/screen.h"
#include "zs_fast.h"
#include "zs_share.h"

#define MARGIN_MAX ((1u << 16) - 1u) /* a mask */

/* ---- Tests ----------------------------------------------------------------------------------- */

/* Return 1 if (*) holds. For a mesh that zs_mesh_check would refuse, sums may wrap, and the result
 * is arbitrary. */
static int turned_away(const struct zs_clusters *k, const struct zs_mesh *mesh,
                       const struct zs_cluster *c)
{
    const int32_t down = k->eye_shift;
    if (c->height == 0 || c->cutoff == 127 || c->cutoff < 0)
        return 0;
    /* |.| < 2^14.05 for a valid mesh, < 2^17 for any */
    const int32_t x = ((c->center[0] - mesh->center[0]) >> down) + k->eye[0];
    const int32_t y = ((c->center[1] - mesh->center[1]) >> down) + k->eye[1];
    const int32_t z = ((c->center[2] - mesh->center[2]) >> down) + k->eye[2];
    int32_t ahead = (x * c->axis[0] + y * c->axis[1] + z * c->axis[2]) * k->cone -
                    128 * ((c->radius >> down) + 1);
    if (ahead <= 0)
        return 0;
    const uint32_t square = (uint32_t)x * (uint32_t)x + (uint32_t)y * (uint32_t)y +
                            (uint32_t)z * (uint32_t)z; /* valid: < 3 * 2^28.1 */
    const uint32_t thin = k->thin / c->height, margin = k->margin + thin + 1u; /* may wrap */
    if ((k->margin | thin | margin) > MARGIN_MAX)
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
                  reach = c->radius << ZS_PLANE_BITS; /* < 2^28 */
    int whole = k->cone;
    for (uint32_t p = 0; p < k->n_planes; p++) {
        const int16_t *n = k->plane[p];
        /* <= 2^27.8 + 2^27.8 + 2^29.6 < 2^30.4 */
        const int32_t d = n[0] * x + n[1] * y + n[2] * z + k->at[p];
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

/* Return the number of triangles of cluster i, which begins at triangle t: at most the mesh's. */
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
    const struct zs_share_part *const part = r->by_clusters == 2 ? r->share : 0;
    k->from = k->end;
    for (; k->next < mesh->n_clusters; k->next++) {
        const uint32_t n = tris_of(mesh, k->next, k->end);
        const int out = part && (k->end >= part->to || k->end + n <= part->from) ? 1
                        : flag ? flag[k->next] : left_out(r, k->next);
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

void zs_mark_none(struct zs_renderer *r)
{
    zs_fill_run(r->vert_map, 0, ZS_ROUND4(r->xform.instance->mesh->n_verts) / 2u);
}

void zs_mark_verts(struct zs_renderer *r, uint32_t from, uint32_t to)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint32_t n_verts = mesh->n_verts;
    uint8_t *mark = marks(r);
    const uint16_t(*tri)[3] = mesh->tri + from, (*const end)[3] = mesh->tri + to;
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

uint32_t zs_marked_verts(struct zs_renderer *r)
{
    const uint8_t *const flag = marks(r);
    const uint32_t n = r->xform.instance->mesh->n_verts;
    uint32_t end = 0;
    for (uint32_t v = 0; v < n; v++) {
        while (v + 4u <= n && !(flag[v] | flag[v + 1u] | flag[v + 2u] | flag[v + 3u]))
            v += 4u;
        const uint32_t from = v;
        while (v < n && flag[v])
            v++;
        if (from == v)
            continue;
        zs_batch_verts(r, r->vert_base + from, from, v - from);
        end = v;
    }
    return end;
}

/* zs_fast_clusters.verts. To find out which vertices are needed takes half the time of transforming
 * them. So if less than a third of the triangles are culled, all vertices are transformed. */
static int cluster_verts(struct zs_renderer *r)
{
    const uint32_t out = ask(r);
    if (out == 0)
        r->by_clusters = 0;
    if (out * 3u < r->xform.instance->mesh->n_tris)
        return 0;
    zs_mark_none(r);
    while (cluster_run(r))
        zs_mark_verts(r, r->clusters.from, r->clusters.end);
    run_again(&r->clusters);
    (void)zs_marked_verts(r);
    return 1;
}

static const struct zs_fast_clusters clusters = {
    .edges = zs_cluster_edges, .open = zs_cluster_open, .verts = cluster_verts, .run = cluster_run
};
const struct zs_fast zs_fast_clusters = { .clusters = &clusters };
