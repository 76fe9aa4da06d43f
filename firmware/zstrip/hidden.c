/* What large triangles hide in a strip, known before anything is drawn.
 *
 * The strip is cut into tiles of 2^ZS_TILE_LOG2 columns, as high as it is. A triangle that covers all of a tile, or two
 * that share an edge and cover it together, leave no key there beyond their farthest: the tile's bound. A triangle whose
 * nearest key lies beyond the bounds of all tiles that it touches wins no pixel, in whatever order the two are drawn,
 * because a pixel keeps the least key; equal keys prove nothing. So the frame is the same with and without.
 *
 * Bounds come from the triangles of one set (a pool's filling) and stay for the sets after it in the same strip. Only
 * triangles of LARGE columns are looked at for bounds, and nothing is done in frames that have none.
 *
 * Columns: the left side of a triangle is a convex function of the row and the right side a concave one, so that both are
 * farthest inwards in the strip's first or last row. Keys: a plane's are within 0.13 bucket of its vertices' (NUMERICS.md:
 * 0.005 up to 640 pixels of width and height, (W + H + 1) / 2^17 beyond), which MARGIN covers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cold.h"
#include "pipeline.h"

#define LARGE (2 << ZS_TILE_LOG2) /* columns: covers a tile wherever it lies */
#define MARGIN 0x2200 /* of a bucket, in 2^-16: 0.13 */
_Static_assert(2 * ZS_SIZE_MAX + 1 <= MARGIN, "the error of a plane's keys, (W + H + 1) / 2^17 bucket");

static uint32_t key_of(const struct zs_renderer *r, uint32_t d, int32_t add)
{
    const struct zs_depth *depth = r->config.depth;
    const uint32_t key = depth->key ? depth->key(&r->view, d) : d, top = r->view.key_top; /* key <= top */
    const uint32_t most = top - 0x10000u; /* keys saturate here */
    const int64_t sum = (int64_t)key + 0x8000 + add;
    return (sum < 0 ? 0u : sum > most ? most : (uint32_t)sum) >> 16;
}

/* The corners of a triangle and the columns of its box that are in the frame. Return how many those are. */
static int32_t box(const struct zs_job *job, const struct zs_vertex *v[3], int32_t *x0, int32_t *x1)
{
    for (int k = 0; k < 3; k++)
        v[k] = &job->r->vert[job->tri->v[k]];
    *x0 = zs_max32(zs_first_sample(zs_min32(zs_min32(v[0]->x, v[1]->x), v[2]->x)), 0);
    *x1 = zs_min32(zs_first_sample(zs_max32(zs_max32(v[0]->x, v[1]->x), v[2]->x)), job->width);
    return *x1 - *x0;
}

int zs_hidden(struct zs_job *job)
{
    const struct zs_renderer *r = job->r;
    const struct zs_vertex *v[3];
    int32_t x0, x1;
    if (box(job, v, &x0, &x1) <= 0)
        return 0;
    const uint32_t d = v[0]->d < v[1]->d ? v[0]->d : v[1]->d;
    const uint32_t nearest = key_of(r, d < v[2]->d ? d : v[2]->d, -MARGIN);
    for (int32_t t = x0 >> ZS_TILE_LOG2; t <= (x1 - 1) >> ZS_TILE_LOG2; t++)
        if (nearest <= r->bound[t])
            return 0;
    if (r->scene->instance[job->tri->instance].state)
        return 0; /* keys of its own */
    job->row_last = zs_first_sample(zs_max32(zs_max32(v[0]->y, v[1]->y), v[2]->y));
    return 1;
}

/* ---- Bounds ------------------------------------------------------------------------------------------ */

/* A triangle that has samples in every row of the strip. */
struct cover {
    const struct zs_vertex *v[3];
    struct zs_cut first, last; /* its spans in the strip's first and last row */
    uint32_t farthest;         /* key */
};

static void bound_tiles(struct zs_job *job, int32_t x0, int32_t x1, uint32_t farthest)
{
    uint16_t *bound = job->r->bound;
    const int32_t up = (1 << ZS_TILE_LOG2) - 1;
    const int32_t end = x1 >= job->width ? (job->width + up) >> ZS_TILE_LOG2 : x1 >> ZS_TILE_LOG2;
    for (int32_t t = (zs_max32(x0, 0) + up) >> ZS_TILE_LOG2; t < end; t++)
        if (farthest < bound[t])
            bound[t] = (uint16_t)farthest;
}

/* Return 0: not a triangle for bounds. */
static int cover_of(struct zs_job *job, struct cover *c)
{
    int32_t x0, x1;
    if (box(job, c->v, &x0, &x1) < LARGE || job->r->scene->instance[job->tri->instance].state)
        return 0;
    if (!zs_raster_sides(job) || job->row != job->y0 || job->row_end != job->y1)
        return 0;
    job->row_end = job->y0 + 1;
    zs_raster_cuts(job, job->y0);
    c->first = job->cut[0];
    job->row_end = job->y1;
    zs_raster_cuts(job, job->y1 - 1);
    c->last = job->cut[0];
    const uint32_t d = c->v[0]->d > c->v[1]->d ? c->v[0]->d : c->v[1]->d;
    c->farthest = key_of(job->r, d > c->v[2]->d ? d : c->v[2]->d, MARGIN);
    return 1;
}

/* Do two triangles have an edge in common that passes all rows of the strip? */
static int share_edge(const struct zs_job *job, const struct cover *a, const struct cover *b)
{
    int32_t y[2];
    int n = 0;
    for (int k = 0; k < 9 && n < 2; k++)
        if (a->v[k / 3]->x == b->v[k % 3]->x && a->v[k / 3]->y == b->v[k % 3]->y)
            y[n++] = a->v[k / 3]->y;
    return n == 2 && zs_first_sample(zs_min32(y[0], y[1])) <= job->y0 &&
           zs_first_sample(zs_max32(y[0], y[1])) >= job->y1;
}

static void bound_both(struct zs_job *job, const struct cover *left, const struct cover *right)
{
    if (left->first.x1 == right->first.x0 && left->last.x1 == right->last.x0)
        bound_tiles(job, zs_max32(left->first.x0, left->last.x0), zs_min32(right->first.x1, right->last.x1),
                    left->farthest > right->farthest ? left->farthest : right->farthest);
}

/* Columns that are less than LARGE apart, most likely: a quick look. */
static inline int narrow(const struct zs_vertex *pool, const struct zs_tri *t)
{
    const int32_t x = pool[t->v[0]].x + LARGE / 2 * ZS_SUBPX_ONE;
    return ((uint32_t)(x - pool[t->v[1]].x) | (uint32_t)(x - pool[t->v[2]].x)) < LARGE * ZS_SUBPX_ONE;
}

uint32_t zs_hidden_bounds(struct zs_job *job, uint32_t list)
{
    const struct zs_renderer *r = job->r;
    struct cover c[2];
    int n = 0, old = 0; /* c[old] is the one before, if n */
    for (; list != ZS_NIL; list = r->tri[list].next) {
        if (narrow(r->vert, &r->tri[list]))
            continue;
        job->tri = &r->tri[list];
        struct cover *now = &c[!old];
        if (!cover_of(job, now))
            continue;
        bound_tiles(job, zs_max32(now->first.x0, now->last.x0), zs_min32(now->first.x1, now->last.x1), now->farthest);
        if (n++ && share_edge(job, now, &c[old])) {
            bound_both(job, now, &c[old]);
            bound_both(job, &c[old], now);
        }
        old = !old;
    }
    uint32_t least = ZS_DEPTH_CLEAR;
    for (uint32_t t = 0; t < ZS_TILES(r->config.width); t++)
        if (r->bound[t] < least)
            least = r->bound[t];
    const struct zs_depth *depth = r->config.depth;
    return least == ZS_DEPTH_CLEAR ? UINT32_MAX : depth->key ? 0u : least << 16; /* least <= ZS_DEPTH_CLEAR - 1 */
}
