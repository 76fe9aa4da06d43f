/* Ray casting: boxes, hits and rays.
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
 * are cut to whole buckets, and so `below` is 0; for other mappings it is 2 (linear keys under
 * perspective are at most 2^-31 of the distance too small, and far - near is at least 2^-16 of it).
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/pass.h"
#include "core/plane.h"
#include "core/rows.h"
#include "method/raycast.h"
#include "zs_shader.h"

#define PACKET 16 /* triangles that a packet may meet; if they are more, it is a single ray */

/* Add to one of zs_ray_counts, if ZS_STATS is 1. */
#if ZS_STATS
#define COUNT(r, what, n) (((struct zs_rays *)(r)->method_state)->counted.what += (n))
#else
#define COUNT(r, what, n) ((void)(r))
#endif

/* ---- Boxes ----------------------------------------------------------------------------------- */

static void box_add(struct zs_ray_box *b, const struct zs_ray_box *other)
{
    b->x0 = (int16_t)zs_min32(b->x0, other->x0);
    b->x1 = (int16_t)zs_max32(b->x1, other->x1);
    b->y0 = (int16_t)zs_min32(b->y0, other->y0);
    b->y1 = (int16_t)zs_max32(b->y1, other->y1);
    b->near = (uint16_t)zs_minu32(b->near, other->near);
}

/* Set the box of a triangle of the pool. */
void zs_rays_box(struct zs_ray_box *b, const struct zs_renderer *r, uint32_t t)
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
void zs_rays_build(struct zs_renderer *r, struct zs_rays *s, struct zs_ray_box *at, uint16_t list)
{
    uint32_t n = 0;
    s->states = 0;
    s->level[0] = at;
    for (; list != ZS_NIL; n++) {
        struct zs_tri *t = &r->tri[list];
        zs_rays_box(&at[n], r, list);
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
    while (n > ZS_RAY_CHILDREN) {
        struct zs_ray_box *const up = at + n;
        uint32_t k = 0;
        for (uint32_t i = 0; i < n; i++) {
            if (i & (ZS_RAY_CHILDREN - 1u))
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
static ZS_NOINLINE int covers(const struct zs_renderer *r, const struct zs_tri *t, int32_t x,
                              int32_t y)
{
    const int32_t at_x = x * ZS_SUBPX_ONE + ZS_SUBPX_HALF, at_y = y * ZS_SUBPX_ONE + ZS_SUBPX_HALF;
    const struct zs_vertex *p = &r->vert[t->v[2]];
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *q = &r->vert[t->v[k]];
        COUNT(r, sides, 1);
        const int32_t dx = q->x - p->x, dy = q->y - p->y; /* |.| < 2^22 */
        const int64_t side = zs_mul_ss(dx, at_y - p->y) - zs_mul_ss(dy, at_x - p->x); /* < 2^45 */
        if (side < 0 || (side == 0 && (dy > 0 || (dy == 0 && dx < 0))))
            return 0;
        p = q;
    }
    return 1;
}

/* Set up a job for the keys of a triangle. job->split has another meaning here than in core/: 1 if
 * keys are not linear on the screen. */
static ZS_NOINLINE void aim(struct zs_job *job, const struct zs_tri *t)
{
    const struct zs_renderer *r = job->r;
    const struct zs_depth *depth = r->view.depth;
    COUNT(r, aims, 1);
    job->tri = t;
    zs_plane_sides(job, &r->vert[t->v[0]], &r->vert[t->v[1]], &r->vert[t->v[2]]);
    zs_plane_geom(job);
    COUNT(r, wide, job->geom.rcp == 0);
    job->split = (uint8_t) !(r->view.screen_linear || depth->planes(job));
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
    struct zs_rays *s = job->r->method_state;
    (void)row;
    COUNT(job->r, pieces, 1);
    if (s->column >= i0 && s->column < i1)
        s->sum = sum + zs_wrap_mul(step, s->column - i0);
}

/* Return the key of a pixel, uq16_16 with half a bucket added, of a triangle whose keys are not
 * linear on the screen: from the mapping's own function for a scanline. */
static ZS_NOINLINE uint32_t curved_sum(struct zs_job *job, int32_t x, int32_t y)
{
    const struct zs_geom *g = &job->geom;
    struct zs_rays *s = job->r->method_state;
    struct zs_row row = { .y = y, .i0 = x, .i1 = x + 1 };
    if (!job->r->view.pixelwise) { /* a scanline has pieces, which begin with the span */
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
static uint32_t sum_at(struct zs_job *job, const struct zs_rays *s, uint32_t k, int32_t x,
                       int32_t y)
{
    struct zs_tri *t = &job->r->tri[s->level[0][k].tri];
    struct zs_plane *const plane = &s->plane[k];
    if (k < s->n_planes && t->next & ZS_RAY_KNOWN)
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
        t->next |= ZS_RAY_KNOWN;
    }
    return base + zs_wrap_mul(key->gx, x) + zs_wrap_mul(key->gy, y);
}

/* The depth test of a triangle with a depth state, as in core/depth_test.c. */
static ZS_NOINLINE void stated(struct zs_job *job, struct zs_ray_seen *seen, uint32_t k,
                               uint32_t sum, const struct zs_depth_state *state)
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
static void meet(struct zs_job *job, const struct zs_rays *s, struct zs_ray_seen *seen, uint32_t k,
                 int32_t x, int32_t y)
{
    const struct zs_renderer *r = job->r;
    const struct zs_ray_box *b = &s->level[0][k];
    COUNT(r, boxed, 1);
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
    int32_t end; /* one beyond its last column */
    uint32_t n;
    uint16_t box[PACKET];
};

/* Find the triangles that rays from column x on meet. If they are too many, the packet is a single
 * ray, and *seen is what it has seen of those that are not in the packet. */
static ZS_NOINLINE void gather(struct zs_job *job, const struct zs_rays *s, struct packet *p,
                               struct zs_ray_seen *seen, int32_t x, int32_t y)
{
    const uint32_t top = s->levels - 1u;
    uint32_t level = top, i = 0;
    p->n = 0;
    p->end = s->x_end;
    while (i < s->count[level]) {
        const struct zs_ray_box *b = &s->level[level][i];
        COUNT(job->r, boxes, 1);
        if (y >= b->y0 && y < b->y1 && x < b->x1) {
            if (x < b->x0) {
                p->end = zs_min32(p->end, b->x0);
            } else if (level > 0) {
                level--;
                i <<= ZS_RAY_CHILDREN_LOG2;
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
        while (level < top && (!(i & (ZS_RAY_CHILDREN - 1u)) || i == s->count[level])) {
            i = (i + ZS_RAY_CHILDREN - 1u) >> ZS_RAY_CHILDREN_LOG2;
            level++;
        }
    }
}

/* Cast the ray of a pixel. *seen: what it has seen so far; then what it sees. last: the box of the
 * triangle that it meets first, or ZS_NIL. */
static void cast(struct zs_job *job, const struct zs_rays *s, const struct packet *p,
                 struct zs_ray_seen *seen, uint32_t last, int32_t x, int32_t y)
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
static uint32_t first_of(const struct zs_rays *s, const struct packet *p, uint32_t last)
{
    if (!s->states)
        for (uint32_t k = 0; k < p->n; k++)
            if (p->box[k] == last)
                return last;
    return ZS_NIL;
}

/* Cast the rays of the region, and keep what they hit in the depth memory: numbers of triangles; or
 * keys. Return what the last ray has seen. */
ZS_NOINLINE struct zs_ray_seen zs_rays_cast(struct zs_renderer *r, const struct zs_rays *s,
                                            int keys)
{
    struct zs_job job;
    struct packet p;
    struct zs_ray_seen seen = s->first;
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
                    r->tri[line[x]].next |= ZS_RAY_HIT;
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
void zs_rays_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step)
{
    const struct zs_rays *s = job->r->method_state;
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
