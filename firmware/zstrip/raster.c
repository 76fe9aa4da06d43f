/* A strip's triangles: lists, wide set-up, edges.
 *
 * Lists are kept in pool order, which is scene order, so that "nearer wins" with a strict comparison
 * is "least (key, scene order) wins".
 *
 * Edges. The span of row j, sampled at Y = 256 j + 128, is [first sample at or right of the left edge,
 * first sample at or right of the right edge): samples on a left edge are in, on a right edge out;
 * rows from the first sample at or below the top to the one at or below the bottom: top in, bottom out.
 * That is the top-left rule, and two triangles on an edge compute the same column for it.
 *
 * For an edge from (xa, ya) to (xb, yb), dy > 0, the sample i is at or right of it when
 *   256 dy i >= (xa - 128) dy + (Y - ya) dx
 * so the column is the right side over 256 dy, rounded up, carried on as quotient and remainder.
 *
 * SPDX-License-Identifier: MIT
 */
#include "rows.h"

#define EDGE32_MAX (1 << 15) /* sub-pixels: edges shorter than this each way need 32 bits only */

/* ---- Edges ----------------------------------------------------------------------------------------- */

/* Place edge *e, which runs down from a to b, at a row between them. */
static void edge_start(struct zs_edge *e, const struct zs_vertex *a, const struct zs_vertex *b,
                       int32_t row)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;                 /* |dx|, dy < 2^22 */
    const int32_t off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;    /* 0 <= off <= dy */
    const int32_t column = a->x >> ZS_SUBPX_BITS;
    const int32_t lead = (a->x & (ZS_SUBPX_ONE - 1)) - ZS_SUBPX_HALF; /* -128 .. 127 */
    const int32_t span = dy * ZS_SUBPX_ONE;                           /* < 2^30 */
    int32_t q, rest;
    if (zs_abs32(dx) < EDGE32_MAX && dy < EDGE32_MAX) {
        const int32_t n = lead * dy + off * dx;                       /* |.| < 2^22 + 2^30 */
        q = n / span;
        rest = n - q * span;
    } else {
        const int64_t n = (int64_t)lead * dy + (int64_t)off * dx;     /* |.| < 2^29 + 2^44 */
        const int64_t q64 = n / span;                                 /* |.| <= 2^14 */
        q = (int32_t)q64;
        rest = (int32_t)(n - q64 * span);
    }
    if (rest > 0) { /* towards zero was down: make it up */
        q++;
        rest -= span;
    }
    e->i = column + q;
    e->e = -rest; /* [0, span) */
    e->span = span;
    int32_t step = dx / dy, part = dx - step * dy;
    if (part < 0) {
        step--;
        part += dy;
    }
    e->q = step;
    e->s = part * ZS_SUBPX_ONE; /* [0, span) */
}

static void job_edges(struct zs_job *job, const struct zs_vertex *top, const struct zs_vertex *mid,
                      const struct zs_vertex *bottom)
{
    if (job->row < job->row_end)
        edge_start(&job->edge[0], top, bottom, job->row);
    if (job->row < job->row_mid)
        edge_start(&job->edge[1], top, mid, job->row);
    if (job->row_mid < job->row_end)
        edge_start(&job->edge[2], mid, bottom, job->row_mid);
}

/* ---- Set-up ------------------------------------------------------------------------------------------ */

static int before(const struct zs_vertex *a, const struct zs_vertex *b)
{
    return a->y != b->y ? a->y < b->y : a->x < b->x;
}

static void swap(const struct zs_vertex **a, const struct zs_vertex **b)
{
    const struct zs_vertex *t = *a;
    *a = *b;
    *b = t;
}

/* Fill job for a triangle in rows [y0, y1). Return 0 where none of them is its own. */
static int job_setup(struct zs_job *job, int32_t y0, int32_t y1)
{
    const struct zs_vertex *pool = job->r->vert;
    const struct zs_vertex *top = &pool[job->tri->v[0]], *mid = &pool[job->tri->v[1]],
                           *bottom = &pool[job->tri->v[2]];
    /* by (y, x), so that the order in which a triangle names its vertices does not matter */
    if (before(mid, top))
        swap(&mid, &top);
    if (before(bottom, mid)) {
        swap(&bottom, &mid);
        if (before(mid, top))
            swap(&mid, &top);
    }
    job->row = zs_max32(zs_first_sample(top->y), y0);
    job->row_last = zs_first_sample(bottom->y);
    job->row_end = zs_min32(job->row_last, y1);
    job->row_mid = zs_min32(zs_max32(zs_first_sample(mid->y), job->row), job->row_end);
    if (job->row >= job->row_end)
        return 0;
    const int64_t cross = (int64_t)(mid->x - top->x) * (bottom->y - top->y) -
                          (int64_t)(bottom->x - top->x) * (mid->y - top->y); /* |.| < 2^45 */
    if (cross == 0)
        return 0;
    job->mid_right = cross > 0;
    job_edges(job, top, mid, bottom);
    job->v[0] = top; /* planes want a positive area */
    job->v[1] = cross > 0 ? mid : bottom;
    job->v[2] = cross > 0 ? bottom : mid;
    job->geom.area = cross > 0 ? cross : -cross;
    zs_plane_geom(job);
    return 1;
}

static void draw(struct zs_job *job, const struct zs_tri *tri, int32_t y0, int32_t y1)
{
    struct zs_renderer *r = job->r;
    job->tri = tri;
    if (!job_setup(job, y0, y1))
        return;
    r->stats.tris_setup++;
    const struct zs_instance *instance = &r->scene->instance[tri->instance];
    const struct zs_depth *depth = r->config.depth;
    job->shader = instance->material->shader;
    job->state = instance->state;
    if (job->state) {
        const struct zs_state_kernel *kernel = job->state->kernel;
        job->bias = kernel->bias(job);
    }
    if (!r->view.screen_linear) {
        depth->rows(job);
        return;
    }
    zs_rows_keys(job);
    zs_rows_draw(job);
}

/* ---- Lists ------------------------------------------------------------------------------------------- */

static uint16_t reversed(struct zs_tri *tri, uint16_t list)
{
    uint16_t out = ZS_NIL;
    while (list != ZS_NIL) {
        const uint16_t next = tri[list].next;
        tri[list].next = out;
        out = list;
        list = next;
    }
    return out;
}

/* Two ascending lists into one. */
static uint16_t merged(struct zs_tri *tri, uint16_t a, uint16_t b)
{
    uint16_t head = ZS_NIL, *tail = &head;
    while (a != ZS_NIL && b != ZS_NIL) {
        uint16_t *least = a < b ? &a : &b;
        *tail = *least;
        tail = &tri[*least].next;
        *least = *tail;
    }
    *tail = a != ZS_NIL ? a : b;
    return head;
}

void zs_raster_strip(struct zs_renderer *r)
{
    const int32_t y0 = r->strip * r->config.strip_h;
    const int32_t y1 = zs_min32(y0 + r->config.strip_h, r->config.height);
    const int goes_on = r->strip + 1 < r->band_end;
    uint16_t list = merged(r->tri, r->active, reversed(r->tri, r->bin[r->strip]));
    r->bin[r->strip] = ZS_NIL;

    struct zs_job job;
    job.r = r;
    job.color = r->color[r->strip & 1];
    job.depth = r->depth;
    job.y0 = y0;
    job.width = r->config.width;
    uint16_t *keep = &r->active; /* grows at its end: stays ascending */
    while (list != ZS_NIL) {
        struct zs_tri *t = &r->tri[list];
        draw(&job, t, y0, y1);
        if (goes_on && job.row_last > y1) {
            *keep = list;
            keep = &t->next;
        }
        list = t->next;
    }
    *keep = ZS_NIL;
}
