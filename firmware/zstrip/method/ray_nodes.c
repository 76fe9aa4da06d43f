/* Ray casting: the hierarchy of a mesh, as a walk goes down it.
 *
 * The walk leaves out nodes that are beside the rows for which it bins, or beside the view. A
 * node's sphere is brought to camera units, where it lies in a box: R around the centre on each
 * axis. A point projects to one side of the edge of a row or column, e sub-pixels from the
 * viewport's centre, or to the other, as v - e z / 2^scale_bits has one sign or the other (v: x' or
 * y'; orthographic: v - e 2^scale_bits). On the box, that is extreme at a corner. Clipping keeps a
 * point on its side, so the sign counts before the near plane as well. Slack:
 *   snapping   a vertex beside the edge of a row is snapped to at most half a step, 8 sub-pixels,
 *              beyond it; the samples of the row are 128 sub-pixels from its edges. So there is
 *              none for it
 *   R          4 camera units for the rounding of the vertex, of the centre, of a vertex that
 *              clipping makes, and of the shift below; and R / 2^18 for rotations, which are
 *              inexact by 2^-20. Rows that are multiplied by ratio <= 1 shorten x' and y'.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cull.h"
#include "core/fast.h"
#include "core/pass.h"
#include "core/usual.h"
#include "core/xform.h"
#include "method/raycast.h"
#include "zs_method.h"
#include "zs_shader.h"

/* Return x' or y' of an edge that is e sub-pixels from the viewport's centre, at distance z,
 * camera units, floor. */
static int64_t edge_at(const struct zs_view *view, int32_t e, int64_t z)
{
    return view->perspective ? (e * z) >> view->scale_bits           /* < 2^21 * 2^33 */
                             : e * ((int64_t)1 << view->scale_bits); /* < 2^21 * 2^40 */
}

/* Return 1 if an interval of v and one of z, both of half width `half`, lie beside [from, to). */
static int beside(const struct zs_view *view, int32_t v, int32_t z, int64_t half, int32_t from,
                  int32_t to)
{
    return v + half < edge_at(view, from, from < 0 ? z + half : z - half) ||
           v - half > edge_at(view, to, to < 0 ? z - half : z + half);
}

/* Return 1 if no triangle of a node is drawn in what the walk bins for. The first walk of a frame
 * counts; it leaves out what is beside the view alone. */
static int left_out(const struct zs_renderer *r, const struct zs_bvh_node *node)
{
    static const uint8_t whole[3] = { 0, 0, 0 };
    const struct zs_rays *s = r->method_state;
    const struct zs_view *view = &r->view;
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const int one = r->band_end - r->strip == 1 && !r->counting;
    const int32_t h = r->config.strip_h;
    int32_t x = r->walk_x, x_end = r->walk_end, y = 0, y_end = view->height, c[3];
    /* radius * q32_32 < 2^17 * 2^47; shift is -16 .. 30 */
    int64_t half = (int64_t)((node->radius * zs_usual_scale(r->xform.instance)) >>
                             (32 - view->shift));
    half = half >> 32 ? (int64_t)1 << 32 : half + (half >> 18) + 4; /* in view all is < 2^31 */
    for (int k = 0; k < 3; k++) {
        const int32_t *const row = r->xform.row + k * ZS_ROW_WORDS;
        const int16_t *p = node->center;
        c[k] = mesh->pos_lo ? zs_xform_fine(row, p, whole) : zs_matrix_row(row, p[0], p[1], p[2]);
    }
    if (one) {
        x = s->x;
        x_end = s->x_end;
        y = s->y;
        y_end = s->y_end;
    } else if (!r->counting) {
        y = r->strip * h;
        y_end = r->band_end * h;
    }
    return c[2] + half < view->z_near || c[2] - half > view->z_far ||
           beside(view, c[0], c[2], half, x * ZS_SUBPX_ONE - view->cx,
                  x_end * ZS_SUBPX_ONE - view->cx) ||
           beside(view, c[1], c[2], half, y * ZS_SUBPX_ONE - view->cy,
                  y_end * ZS_SUBPX_ONE - view->cy);
}

static int node_edges(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number)
{
    (void)r;
    (void)b;
    (void)number;
    return 1;
}

static int node_open(struct zs_renderer *r, const struct zs_bounds *b)
{
    (void)b;
    const struct zs_material *const material = r->xform.instance->material;
    ((struct zs_rays *)r->method_state)->node = 0;
    return r->xform.instance->mesh->bvh && !material->primitive && !material->shader->place;
}

static int node_verts(struct zs_renderer *r)
{
    (void)r;
    return 0;
}

/* The triangles of the next leaf. */
static int node_run(struct zs_renderer *r)
{
    struct zs_rays *s = r->method_state;
    const struct zs_bvh_node *const bvh = r->xform.instance->mesh->bvh;
    while (s->node < bvh->skip) {
        const struct zs_bvh_node *node = &bvh[s->node];
        const uint32_t n = r->xform.instance->mesh->n_tris;
        const uint32_t end = node->skip < bvh->skip ? zs_minu32(bvh[node->skip].first, n) : n;
        if (left_out(r, node)) {
            r->stats.tris_cluster += r->counting ? end - node->first : 0u;
            s->node = node->skip;
        } else if (++s->node == node->skip) {
            r->clusters.from = node->first;
            r->clusters.end = end;
            return 1;
        }
    }
    return 0;
}

const struct zs_fast_clusters zs_ray_nodes = {
    .edges = node_edges, .open = node_open, .verts = node_verts, .run = node_run
};
