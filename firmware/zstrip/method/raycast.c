/* Ray casting: the loops of the depth buffer in the inverse order. For each pixel of a strip, a ray
 * finds the triangle that is seen there; then the strip's visible triangles colour their pixels.
 *
 * All rays start in the eye, so a ray is a point on the screen: the pixel's sample. It hits a
 * triangle if the snapped triangle covers the sample, by the rule of core/edges.c, and the key at
 * the hit is that of the planes of core/plane.c. Among the hits the depth test of
 * core/depth_test.c decides, in scene order. So the frame is that of the depth buffer, bit for bit.
 *
 * BOXES. What a ray tests first are boxes on the screen: a box for each triangle of the strip, in
 * scene order, a box around each four of these, and so on up to a top level of at most four. A box
 * holds the columns and rows of the samples that its triangles may cover (exactly: from the first
 * sample right of or below their vertices to the last), and a bound of their keys. There is no
 * slack in it: it is computed from the snapped vertices. The children of box i are boxes 4 i ..
 * 4 i + 3 of the level below, so a ray needs no stack. zsim convert puts triangles that lie close
 * together next to each other, so such boxes are small.
 *
 * PACKETS. Rays that are neighbours in a row go down the boxes together. The first one finds the
 * triangles whose boxes hold its sample, and the column up to which the rays to its right would
 * find the same ones: where one of these boxes ends or another begins. From there on each ray is on
 * its own. It first meets the triangle which the ray before has hit, unless there are depth states,
 * for which order matters; then the others, but not those in whose box every key is beyond the key
 * found so far.
 *
 * The key of a pixel is at least the least key of the vertices minus `below`: planes are exact to
 * less than half a bucket where keys are linear on the screen, half a bucket is added before keys
 * are cut to whole buckets, and so `below` is 0; for other mappings it is 2.
 *
 * MEMORY. The configuration's triangle pool is shared out between triangles and boxes (begin). The
 * depth memory holds the numbers of the triangles that the rays have hit, until they are coloured.
 * If there are resolve hooks, which may read keys, a second ray for each pixel writes the key
 * afterwards.
 *
 * If the pools cannot hold what is in a strip, the strip is cut into regions, each of which takes
 * a walk over the scene: half of the rows or columns, again and again, down to a pixel. If the
 * pools cannot hold what is in a pixel, its ray is cast in several parts: the pools keep the
 * triangle that is seen so far.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/plane.h"
#include "core/raster.h"
#include "core/rows.h"
#include "core/usual.h"
#include "core/walk.h"
#include "core/xform.h"
#include "zs_method.h"
#include "zs_shader.h"

#define CHILDREN_LOG2 2
#define CHILDREN (1u << CHILDREN_LOG2)
#define LEVELS 8 /* 4^8 boxes */

struct box {
    int16_t x0, x1, y0, y1; /* columns [x0, x1), rows [y0, y1) of the frame: |.| <= 2^14 + 1 */
    uint16_t near;          /* the least key in it plus 1; 0: not known */
    uint16_t tri;           /* level 0: number of the triangle in the pool */
};
_Static_assert(sizeof(struct box) == sizeof(struct zs_tri), "boxes and triangles share a pool");

/* A ray's state: what a depth buffer and the pixel's colour would say of the triangles so far. */
struct seen {
    uint32_t key; /* ZS_DEPTH_CLEAR: none was written */
    uint32_t box; /* of the triangle, at level 0; ZS_NIL: the background */
};

#define PACKET 32 /* triangles that a packet may meet; if they are more, it is a single ray */

struct state {
    int32_t x, x_end, y, y_end; /* the region: columns and rows of the frame */
    struct seen first;          /* what rays begin with. Not empty only in a region of a pixel */
    uint16_t list;              /* visible triangles */
    uint8_t levels;
    uint8_t states;             /* 1: some triangle has a depth state */
    uint16_t count[LEVELS];     /* number of boxes of a level */
    struct box *level[LEVELS];
    struct zs_plane *plane;     /* [n_planes]: keys of the first triangles, at pixel 0, 0 ... */
    uint32_t n_planes;
    const struct zs_fast_clusters *others; /* the configuration's, for meshes without a hierarchy */
    uint32_t node;              /* the current instance's next node */
    int32_t column;             /* for `caught`: a pixel's column, and its key */
    uint32_t sum;
};

/* zs_tri.next while rays are cast: flags. */
#define HIT 1u   /* a ray has hit the triangle */
#define KNOWN 2u /* its plane is known */

/* ---- Memory ---------------------------------------------------------------------------------- */

/* The number of boxes for n triangles. */
static uint32_t boxes_of(uint32_t n)
{
    uint32_t sum = n;
    while (n > CHILDREN) {
        n = (n + CHILDREN - 1u) >> CHILDREN_LOG2;
        sum += n;
    }
    return sum;
}

/* The boxes: the arena's last bytes, which zs_init leaves over as max_tris is less than the
 * program's. */
static struct box *boxes(const struct zs_renderer *r)
{
    const struct zs_config *c = &r->config;
    return (struct box *)(void *)((uint8_t *)r->attr +
                                  ZS_ROUND4((uint32_t)c->max_verts * c->varyings * 2u));
}

static int32_t strip_end(const struct zs_renderer *r)
{
    return zs_min32((r->strip + 1) * r->config.strip_h, r->config.height);
}

/* ---- Boxes ----------------------------------------------------------------------------------- */

static void box_add(struct box *b, const struct box *other)
{
    b->x0 = (int16_t)zs_min32(b->x0, other->x0);
    b->x1 = (int16_t)zs_max32(b->x1, other->x1);
    b->y0 = (int16_t)zs_min32(b->y0, other->y0);
    b->y1 = (int16_t)zs_max32(b->y1, other->y1);
    b->near = (uint16_t)zs_minu32(b->near, other->near);
}

/* Set the box of a triangle of the pool. */
static void box_of(struct box *b, const struct zs_renderer *r, uint32_t t)
{
    const struct zs_vertex *pool = r->vert;
    const uint16_t *v = r->tri[t].v;
    const struct zs_view *view = &r->view;
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
    uint32_t d = UINT32_MAX;
    for (int k = 0; k < 3; k++) {
        x0 = zs_min32(x0, pool[v[k]].x);
        x1 = zs_max32(x1, pool[v[k]].x);
        y1 = zs_max32(y1, pool[v[k]].y);
        d = zs_minu32(d, pool[v[k]].d);
    }
    b->x0 = (int16_t)zs_first_sample(x0);
    b->x1 = (int16_t)zs_first_sample(x1);
    b->y0 = (int16_t)zs_first_sample(pool[v[0]].y);
    b->y1 = (int16_t)zs_first_sample(y1);
    b->tri = (uint16_t)t;
    const uint32_t below = view->screen_linear ? 0u : 2u;
    const uint32_t key = (view->depth->key ? view->depth->key(view, d) : d) >> 16;
    b->near = (uint16_t)zs_minu32(key > below ? key - below + 1u : 0u, view->key_top >> 16);
}

/* Build the boxes of a list of triangles. */
static void boxes_build(struct zs_renderer *r, struct state *s, uint16_t list)
{
    struct box *at = boxes(r);
    uint32_t n = 0;
    s->states = 0;
    s->level[0] = at;
    for (; list != ZS_NIL; n++) {
        struct zs_tri *t = &r->tri[list];
        box_of(&at[n], r, list);
        if (zs_instance_of(r, t->instance)->depth_state) {
            at[n].near = 0;
            s->states = 1;
        }
        list = t->next;
        t->next = 0;
    }
    s->plane = (struct zs_plane *)(void *)(r->vert + r->n_verts);
    s->n_planes = s->states ? 0 : r->config.max_verts - r->n_verts;
    s->count[0] = (uint16_t)n;
    s->levels = 1;
    while (n > CHILDREN) {
        struct box *const up = at + n;
        uint32_t k = 0;
        for (uint32_t i = 0; i < n; i++) {
            if (i & (CHILDREN - 1u))
                box_add(&up[k - 1u], &at[i]);
            else
                up[k++] = at[i];
        }
        s->level[s->levels] = at = up;
        s->count[s->levels++] = (uint16_t)(n = k);
    }
}

/* ---- Hits ------------------------------------------------------------------------------------ */

/* Return 1 if a triangle covers the sample of a pixel: strictly inside of its right and lower
 * edges, and inside of or on the others. */
static int covers(const struct zs_renderer *r, const struct zs_tri *t, int32_t x, int32_t y)
{
    const int32_t at_x = x * ZS_SUBPX_ONE + ZS_SUBPX_HALF, at_y = y * ZS_SUBPX_ONE + ZS_SUBPX_HALF;
    const struct zs_vertex *p = &r->vert[t->v[2]];
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *q = &r->vert[t->v[k]];
        const int32_t dx = q->x - p->x, dy = q->y - p->y; /* |.| < 2^22 */
        const int64_t side = zs_mul_ss(dx, at_y - p->y) - zs_mul_ss(dy, at_x - p->x); /* < 2^45 */
        if (side < 0 || (side == 0 && (dy > 0 || (dy == 0 && dx < 0))))
            return 0;
        p = q;
    }
    return 1;
}

/* Set up a job for the keys of a triangle. job->split: 1 if they are not linear on the screen. */
static void aim(struct zs_job *job, const struct zs_tri *t)
{
    const struct zs_renderer *r = job->r;
    const struct zs_depth *depth = r->view.depth;
    job->tri = t;
    zs_plane_sides(job, &r->vert[t->v[0]], &r->vert[t->v[1]], &r->vert[t->v[2]]);
    zs_plane_geom(job);
    job->split = (uint8_t)!(r->view.screen_linear || depth->planes(job));
    if (!job->split) {
        zs_plane32(&job->geom, job->v[0]->d, job->v[1]->d, job->v[2]->d, ZS_PLANE_KEY, &job->key);
        job->key.base += 0x8000u; /* as in core/raster.c */
    }
    job->depth_state = zs_instance_of(r, t->instance)->depth_state;
    job->bias = job->depth_state ? zs_depth_state_bias(job) : 0;
}

/* A zs_piece_fn: keep the key of the pixel that is asked for. */
static void caught(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                   uint32_t sum, uint32_t step)
{
    struct state *s = job->r->method_state;
    (void)row;
    if (s->column >= i0 && s->column < i1)
        s->sum = sum + zs_wrap_mul(step, s->column - i0);
}

/* Return the key of a pixel, uq16_16 with half a bucket added, of a triangle whose keys are not
 * linear on the screen: from the mapping's own function for a scanline. */
static ZS_NOINLINE uint32_t curved_sum(struct zs_job *job, int32_t x, int32_t y)
{
    const struct zs_geom *g = &job->geom;
    struct state *s = job->r->method_state;
    struct zs_row row = { .y = y, .i0 = x, .i1 = x + 1 };
    if (!job->r->view.pixelwise) { /* a scanline is cut into pieces, which begin with the span */
        job->row_mid = zs_min32(zs_first_sample(job->v[1]->y), zs_first_sample(job->v[2]->y));
        job->row_end = y + 1;
        zs_edges_cut(job, y);
        row.i0 = zs_max32(job->cut[0].x0, 0);
        row.i1 = zs_min32(job->cut[0].x1, job->width);
    }
    row.key = job->key.base - zs_wrap_mul(job->key.gx, g->ia) +
              zs_wrap_mul(job->key.gy, y - g->ja); /* as zs_rows_walk */
    row.w = job->w64.base - zs_times(job->w64.gx, g->ia) + zs_times(job->w64.gy, y - g->ja);
    s->column = x;
    job->r->view.depth->row(job, &row);
    return s->sum;
}

/* Return the key of a pixel, uq16_16 with half a bucket added, of the triangle of box k. */
static uint32_t sum_at(struct zs_job *job, const struct state *s, uint32_t k, int32_t x, int32_t y)
{
    struct zs_tri *t = &job->r->tri[s->level[0][k].tri];
    struct zs_plane *const plane = &s->plane[k];
    if (k < s->n_planes && t->next & KNOWN)
        return plane->base + zs_wrap_mul(plane->gx, x) + zs_wrap_mul(plane->gy, y);
    if (job->tri != t)
        aim(job, t);
    if (job->split)
        return curved_sum(job, x, y);
    const struct zs_plane *key = &job->key;
    const uint32_t base = key->base - zs_wrap_mul(key->gx, job->geom.ia) -
                          zs_wrap_mul(key->gy, job->geom.ja);
    if (k < s->n_planes) {
        const struct zs_plane at = { base, key->gx, key->gy };
        *plane = at;
        t->next |= KNOWN;
    }
    return base + zs_wrap_mul(key->gx, x) + zs_wrap_mul(key->gy, y);
}

/* The depth test of a triangle with a depth state, as in core/depth_test.c. */
static ZS_NOINLINE void stated(struct zs_job *job, struct seen *seen, uint32_t k, uint32_t sum,
                               const struct zs_depth_state *state)
{
    const int32_t top = (int32_t)(job->r->view.key_top >> 16) - 1;
    const int32_t moved = zs_min32((int32_t)(sum >> 16) + job->bias, top + zs_min32(job->bias, 0));
    const uint32_t key = moved < 0 ? 0u : (uint32_t)moved;
    if (state->func != ZS_DEPTH_ALWAYS && key >= seen->key + (state->func == ZS_DEPTH_LESS_EQUAL))
        return;
    seen->box = k;
    if (!state->read_only)
        seen->key = key;
}

/* A ray meets the triangle of box k, which holds the ray's sample. */
static void meet(struct zs_job *job, const struct state *s, struct seen *seen, uint32_t k,
                 int32_t x, int32_t y)
{
    const struct zs_renderer *r = job->r;
    const struct box *b = &s->level[0][k];
    if (b->near > seen->key + 1u || !covers(r, &r->tri[b->tri], x, y))
        return;
    const uint32_t sum = sum_at(job, s, k, x, y);
    if (s->states) { /* then there are no planes: the job is this triangle's */
        const struct zs_depth_state *state =
            zs_instance_of(r, r->tri[b->tri].instance)->depth_state;
        if (state) {
            stated(job, seen, k, sum, state);
            return;
        }
    }
    const uint32_t key = zs_minu32(sum >> 16, (r->view.key_top >> 16) - 1u);
    if (key < seen->key || (key == seen->key && k < seen->box)) {
        seen->key = key;
        seen->box = k;
    }
}

/* ---- Rays ------------------------------------------------------------------------------------ */

struct packet {
    int32_t end;   /* one beyond its last column */
    uint32_t n;
    uint16_t box[PACKET];
};

/* Find the triangles that rays from column x on meet. If they are too many, the packet is a single
 * ray, and *seen is what it has seen of those that are not in the packet. */
static ZS_NOINLINE void gather(struct zs_job *job, const struct state *s, struct packet *p,
                               struct seen *seen, int32_t x, int32_t y)
{
    const uint32_t top = s->levels - 1u;
    uint32_t level = top, i = 0;
    p->n = 0;
    p->end = s->x_end;
    while (i < s->count[level]) {
        const struct box *b = &s->level[level][i];
        if (y >= b->y0 && y < b->y1 && x < b->x1) {
            if (x < b->x0) {
                p->end = zs_min32(p->end, b->x0);
            } else if (level > 0) {
                level--;
                i <<= CHILDREN_LOG2;
                continue;
            } else {
                p->end = zs_min32(p->end, b->x1);
                if (p->n == PACKET) {
                    for (p->end = x + 1; p->n > 0; p->n--)
                        meet(job, s, seen, p->box[PACKET - p->n], x, y);
                }
                p->box[p->n++] = (uint16_t)i;
            }
        }
        i++;
        while (level < top && (!(i & (CHILDREN - 1u)) || i == s->count[level])) {
            i = (i + CHILDREN - 1u) >> CHILDREN_LOG2;
            level++;
        }
    }
}

/* Cast the ray of a pixel. *seen: what it has seen so far; then what it sees. last: the box of the
 * triangle that it meets first, or ZS_NIL. */
static void cast(struct zs_job *job, const struct state *s, const struct packet *p,
                 struct seen *seen, uint32_t last, int32_t x, int32_t y)
{
    if (last != ZS_NIL)
        meet(job, s, seen, last, x, y);
    for (uint32_t k = 0; k < p->n; k++)
        if (p->box[k] != last)
            meet(job, s, seen, p->box[k], x, y);
}

static void job_begin(struct zs_job *job, struct zs_renderer *r)
{
    job->r = r;
    job->tri = 0;
    job->piece = caught;
    job->top = 0;
    job->bottom = r->config.height;
    job->width = r->config.width;
    job->key.base = job->key.gx = job->key.gy = 0;
    job->w64.base = job->w64.gx = job->w64.gy = 0;
}

/* Return `last` if it is in the packet and may be met first. */
static uint32_t first_of(const struct state *s, const struct packet *p, uint32_t last)
{
    if (!s->states)
        for (uint32_t k = 0; k < p->n; k++)
            if (p->box[k] == last)
                return last;
    return ZS_NIL;
}

/* Cast the rays of the region, and keep what they hit in the depth memory: numbers of triangles; or
 * keys. Return what the last ray has seen. */
static ZS_NOINLINE struct seen rays(struct zs_renderer *r, const struct state *s, int keys)
{
    struct zs_job job;
    struct packet p;
    struct seen seen = s->first;
    job_begin(&job, r);
    for (int32_t y = s->y; y < s->y_end; y++) {
        uint16_t *const line = r->depth + (y - r->strip * r->config.strip_h) * r->config.width;
        for (int32_t x = s->x; x < s->x_end;) {
            uint32_t last = seen.box;
            seen = s->first;
            gather(&job, s, &p, &seen, x, y);
            last = first_of(s, &p, last);
            for (; x < p.end; x++) {
                cast(&job, s, &p, &seen, last, x, y);
                if (seen.box == ZS_NIL || keys) {
                    line[x] = (uint16_t)seen.key;
                } else {
                    line[x] = s->level[0][seen.box].tri;
                    r->tri[line[x]].next |= HIT;
                }
                if (x + 1 < p.end) {
                    last = s->states ? ZS_NIL : seen.box;
                    seen = s->first;
                }
            }
        }
    }
    return seen;
}

/* r->span: colour the pixels whose rays have hit this triangle. */
static void ray_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                     uint32_t sum, uint32_t step)
{
    const struct state *s = job->r->method_state;
    uint16_t *const line = job->depth + row->at;
    const uint32_t t = (uint32_t)(job->tri - job->r->tri);
    (void)sum;
    (void)step;
    if (row->y < s->y || row->y >= s->y_end)
        return;
    i1 = zs_min32(i1, s->x_end);
    for (int32_t i = zs_max32(i0, s->x); i < i1; i++) {
        const int32_t from = i;
        for (; i < i1 && line[i] == t; i++)
            line[i] = ZS_NIL;
        if (i > from) {
            zs_rows_written(job, i - from);
            job->shader->run(job, row, from, i);
        }
    }
}

/* ---- The mesh's hierarchy --------------------------------------------------------------------
 *
 * The walk leaves out nodes that are beside the rows for which it bins, or beside the view. A
 * node's sphere is brought to camera units, where it lies in a box: R around the centre on each
 * axis. Its points project to the side of a row's or column's edge, e sub-pixels from the
 * viewport's centre, where v - e z / 2^scale_bits has one sign (v: x' or y'). On the box, that is
 * extreme at a corner. Slack:
 *   snapping   a vertex beside the edge of a row is snapped to at most half a step, 8 sub-pixels,
 *              beyond it; the samples of the row are 128 sub-pixels from its edges (fast/clusters.c)
 *   R          4 camera units for the rounding of the vertex, of the centre, of a vertex that
 *              clipping makes, and of the shift below; and R / 2^18 for rotations, which are
 *              inexact by 2^-20. Rows that are multiplied by ratio <= 1 shorten x' and y'. */

/* Return x' or y' of an edge that is e sub-pixels from the viewport's centre, at distance z,
 * camera units, floor. */
static int64_t edge_at(const struct zs_view *view, int32_t e, int64_t z)
{
    return view->perspective ? (e * z) >> view->scale_bits /* < 2^21 * 2^33 */
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
    const struct state *s = r->method_state;
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
        c[k] = mesh->pos_lo ? zs_xform_fine(row, p, whole) : zs_row(row, p[0], p[1], p[2]);
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

static const struct zs_bvh_node *hierarchy(const struct zs_renderer *r)
{
    return r->xform.instance->mesh->bvh;
}

static int node_edges(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number)
{
    const struct zs_fast_clusters *others = ((const struct state *)r->method_state)->others;
    return zs_instance_of(r, number)->mesh->bvh || !others || others->edges(r, b, number);
}

static int node_open(struct zs_renderer *r, const struct zs_bounds *b)
{
    struct state *s = r->method_state;
    s->node = 0;
    return hierarchy(r) ? 1 : s->others && s->others->open(r, b);
}

static int node_verts(struct zs_renderer *r)
{
    const struct state *s = r->method_state;
    return !hierarchy(r) && s->others->verts(r);
}

/* The triangles of the next leaf. */
static int node_run(struct zs_renderer *r)
{
    struct state *s = r->method_state;
    const struct zs_bvh_node *const bvh = hierarchy(r);
    if (!bvh)
        return s->others->run(r);
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

static const struct zs_fast_clusters nodes = {
    .edges = node_edges, .open = node_open, .verts = node_verts, .run = node_run
};

/* ---- Regions --------------------------------------------------------------------------------- */

/* Remove the triangles with next == ZS_NIL from the pool; the others are binned anew. */
static void pack(struct zs_renderer *r)
{
    uint32_t kept = 0;
    r->bin[r->strip] = ZS_NIL;
    for (uint32_t t = 0; t < r->n_tris; t++) {
        if (r->tri[t].next == ZS_NIL)
            continue;
        r->tri[kept] = r->tri[t];
        r->tri[kept].next = r->bin[r->strip];
        r->bin[r->strip] = (uint16_t)kept++;
    }
    r->n_tris = kept;
    zs_bin_pack(r);
}

/* Drop the triangles beside the region. */
static void keep_region(struct zs_renderer *r, const struct state *s)
{
    for (uint32_t t = 0; t < r->n_tris; t++) {
        struct box b;
        box_of(&b, r, t);
        const int in = b.x0 < s->x_end && b.x1 > s->x && b.y0 < s->y_end && b.y1 > s->y;
        r->tri[t].next = in ? 0 : ZS_NIL;
    }
    pack(r);
}

/* Cast the ray of a region of one pixel at the triangles in the pool, and keep the one that is
 * seen. To test that one again later changes nothing. */
static void keep_seen(struct zs_renderer *r, struct state *s)
{
    boxes_build(r, s, zs_method_buffer.list(r));
    s->first = rays(r, s, 0);
    for (uint32_t k = 0; k < s->count[0]; k++)
        r->tri[s->level[0][k].tri].next = k == s->first.box ? 0 : ZS_NIL;
    pack(r);
    if (s->first.box != ZS_NIL)
        s->first.box = 0;
}

/* Make the region smaller, until a quarter of both pools is free. */
static void ray_full(struct zs_renderer *r)
{
    const uint32_t tris = r->config.max_tris, verts = r->config.max_verts;
    struct state *s = r->method_state;
    for (;;) {
        keep_region(r, s);
        if (tris - r->n_tris > tris / 4u && verts - r->n_verts >= verts / 4u + 3u)
            return;
        if (s->y_end - s->y > 1)
            s->y_end = s->y + (s->y_end - s->y) / 2;
        else if (s->x_end - s->x > 1)
            s->x_end = s->x + (s->x_end - s->x) / 2;
        else
            break;
    }
    keep_seen(r, s);
}

/* Return the list of the triangles, in scene order, that are marked as hit, or that go on in the
 * strip below. */
static uint16_t chosen(struct zs_renderer *r, const struct state *s, int hit)
{
    const int32_t end = strip_end(r);
    uint16_t list = ZS_NIL, *to = &list;
    for (uint32_t i = 0; i < s->count[0]; i++) {
        const struct box *b = &s->level[0][i];
        if (hit ? r->tri[b->tri].next & HIT : b->y1 > end) {
            *to = b->tri;
            to = &r->tri[b->tri].next;
        }
    }
    *to = ZS_NIL;
    return list;
}

/* Draw the region, whose triangles are binned. */
static void region_draw(struct zs_renderer *r, struct state *s)
{
    boxes_build(r, s, zs_method_buffer.list(r));
    (void)rays(r, s, 0);
    r->stats.rays += (uint32_t)((s->y_end - s->y) * (s->x_end - s->x));
    s->list = chosen(r, s, 1);
    zs_raster_strip(r);
    if (r->scene->n_resolves) {
        s->n_planes = 0; /* flags are gone */
        (void)rays(r, s, 1);
    }
    r->active = r->strip + 1 < r->band_end ? chosen(r, s, 0) : ZS_NIL;
}

/* Begin a region: all that is left of the strip. Return 0 if nothing is left. */
static int region_next(const struct zs_renderer *r, struct state *s)
{
    const struct seen nothing = { ZS_DEPTH_CLEAR, ZS_NIL };
    s->first = nothing;
    if (s->x_end < r->window[1]) {
        s->x = s->x_end;
    } else {
        s->x = r->window[0];
        s->y = s->y_end;
        s->y_end = strip_end(r);
    }
    s->x_end = r->window[1];
    return s->y < s->y_end;
}

static void ray_strip(struct zs_renderer *r)
{
    struct state s;
    r->method_state = &s;
    s.others = r->clusters_hooks;
    r->clusters_hooks = &nodes;
    s.x_end = r->window[1];
    s.y_end = r->strip * r->config.strip_h;
    for (int again = 0; region_next(r, &s); again = 1) {
        if (again || r->strip >= r->band_end)
            zs_walk(r, again ? (uint16_t)(r->strip + 1u) : r->draw_end);
        region_draw(r, &s);
    }
    r->clusters_hooks = s.others;
    r->method_state = 0;
}

static uint16_t ray_list(struct zs_renderer *r)
{
    const struct state *s = r->method_state;
    return s ? s->list : zs_method_buffer.list(r); /* a strip is left out: zs_raster_leave */
}

static int ray_begin(struct zs_renderer *r)
{
    struct zs_config *c = &r->config;
    uint32_t tris = c->max_tris / 2u;
    if (c->depth->span)
        return ZS_ERR_DEPTH;
    while (tris + boxes_of(tris) > c->max_tris)
        tris--;
    if (tris < 2 || c->max_verts < 6)
        return ZS_ERR_SIZE;
    c->max_tris = (uint16_t)tris;
    r->span = ray_span;
    r->method_state = 0;
    return ZS_OK;
}

const struct zs_method zs_method_raycast = { .begin = ray_begin,
                                             .strip = ray_strip,
                                             .full = ray_full,
                                             .list = ray_list };
