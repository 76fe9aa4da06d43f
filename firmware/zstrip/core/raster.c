/* A strip's triangles: lists, wide set-up, edges.
 *
 * Lists are kept in pool order, which is scene order but for instances that have no key in common (order.c), so that "nearer
 * wins" with a strict comparison is "least (key, scene order) wins".
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
#include "core/rows.h"

/* ---- Edges ----------------------------------------------------------------------------------------- */

#define EDGE32_MAX (1 << 15) /* sub-pixels: edges shorter than this each way need 32 bits only */

/* (fraction * dy + off * part) / span of an edge that is entered below its first row; apart, because few are.
 * At most 2^14. */
static ZS_NOINLINE int32_t edge_below(int32_t fraction, int32_t dy, int32_t off, int32_t part)
{
    if (dy < EDGE32_MAX)
        return (fraction * dy + off * part) / (dy * ZS_SUBPX_ONE);        /* < 2^23 + 2^30 */
#if ZS_LEAN /* the same without a division of 64 bits */
    return (fraction + (int32_t)zs_muldiv_u64((uint32_t)off, (uint32_t)part, (uint32_t)dy)) >> ZS_SUBPX_BITS;
#else
    return (int32_t)((zs_mul_ss(fraction, dy) + zs_mul_ss(off, part)) / (dy * ZS_SUBPX_ONE)); /* < 2^44.1 */
#endif
}

/* Columns of the edge that runs down from a to b, in n > 0 rows from `row` on, all of them between the two.
 * out[0], out[2], ...
 *
 * With dx = q dy + part the right side above over 256 dy is
 *   (lead + off q) / 256 + off part / (256 dy),  off part / (256 dy) < 1 in the first row of the edge. */
static ZS_NOINLINE void edge_columns(int16_t *out, int32_t n, const struct zs_vertex *a, const struct zs_vertex *b,
                         int32_t row)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;                 /* |dx|, dy < 2^22 */
    int32_t q = dx < 0 ? -1 : 0;
    if ((uint32_t)(dx + dy) > (uint32_t)dy * 2u) { /* not steep: |dx| > dy */
        q = dx / dy;
        q -= dx < q * dy;
    }
    int32_t part = dx - q * dy;                                       /* [0, dy] */
    ZS_FACT(part >= 0 && part <= dy);
    const int32_t off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;    /* 0 <= off <= dy */
    const int32_t at = a->x - ZS_SUBPX_HALF + off * q;                /* < 2^24 */
    int32_t i = at >> ZS_SUBPX_BITS, fraction = at & (ZS_SUBPX_ONE - 1);
    uint32_t rest = zs_wrap_mul((uint32_t)fraction, dy) + zs_wrap_mul((uint32_t)off, part); /* modulo 2^32 */
    const int32_t span = dy * ZS_SUBPX_ONE;                           /* < 2^30 */
    if (off >= ZS_SUBPX_ONE) {
        const int32_t k = edge_below(fraction, dy, off, part);
        rest -= zs_wrap_mul((uint32_t)k, span);
        i += k;
    }
    ZS_FACT(rest < (uint32_t)span * 2u);
    int32_t e = -(int32_t)rest;                                       /* (-2 span, 0]; becomes [0, span) */
    for (; e < 0; e += span)
        i++;
    *out = (int16_t)i; /* |.| <= 2^14 + 1 in rows of the triangle; e = i * span - exact */
    part *= ZS_SUBPX_ONE;
    for (int16_t *const end = out + 2 * n; (out += 2) != end; *out = (int16_t)i) {
        i += q;
        e -= part;
        if (e < 0) {
            e += span;
            i++;
        }
        ZS_FACT(e >= 0 && e < span);
    }
}

#if !ZS_LEAN

/* A side of a tiny triangle: columns are sum / span, counted from ZS_TINY_SIDE left of the top corner, so that what is divided is
 * positive; a product is below 2^29.1. */
struct side {
    uint32_t sum, span, step;
};

/* From a corner x right of column 0, off above a row's samples, along an edge. */
static inline struct side side_of(int32_t x, int32_t off, int32_t dx, int32_t dy)
{
    const uint32_t span = (uint32_t)dy * ZS_SUBPX_ONE;
    const struct side s = { (uint32_t)(x * dy + off * dx) + span - 1u, span, (uint32_t)dx * ZS_SUBPX_ONE };
    return s;
}

/* The next n rows. */
static inline struct zs_cut *sides_cut(struct zs_cut *cut, int32_t n, int32_t from, struct side *left, struct side *right)
{
    for (struct zs_cut *const end = cut + n; cut != end; cut++) {
        ZS_FACT(left->span >= ZS_SUBPX_ONE && right->span >= ZS_SUBPX_ONE); /* no rows beside a level edge */
        cut->x0 = (int16_t)(from + (int32_t)(left->sum / left->span));
        cut->x1 = (int16_t)(from + (int32_t)(right->sum / right->span));
        left->sum += left->step;
        right->sum += right->step;
    }
    return cut;
}

/* zs_raster_cuts by division, both sides at once, of a tiny triangle on cores that divide. */
ZS_IN_ORDER static ZS_NOINLINE void tiny_cuts(struct zs_job *job, int32_t row, int32_t end)
{
    const struct zs_geom *g = &job->geom;
    const int32_t ax = job->v[0]->x, ay = job->v[0]->y, from = (ax >> ZS_SUBPX_BITS) - ZS_TINY_SIDE;
    const int32_t x = ax - ZS_SUBPX_HALF - from * ZS_SUBPX_ONE, off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - ay;
    const int32_t upper = zs_max32(zs_min32(job->row_mid, end) - row, 0); /* rows above the middle vertex */
    struct side left = side_of(x, off, g->dx2, g->dy2), right = side_of(x, off, g->dx1, g->dy1);
    struct zs_cut *const cut = sides_cut(job->cut, upper, from, &left, &right);
    const int32_t lower = end - row - upper, down = off + upper * ZS_SUBPX_ONE;
    if (lower <= 0)
        return;
    if (job->mid_right)
        right = side_of(x + g->dx1, down - g->dy1, g->dx2 - g->dx1, g->dy2 - g->dy1);
    else
        left = side_of(x + g->dx2, down - g->dy2, g->dx1 - g->dx2, g->dy1 - g->dy2);
    (void)sides_cut(cut, lower, from, &left, &right);
}

#endif

void zs_raster_cuts(struct zs_job *job, int32_t row)
{
    const int32_t mid_right = job->mid_right, end = zs_min32(job->row_end, row + ZS_CUT_ROWS);
    const struct zs_vertex *mid = job->v[2 - mid_right];
    int16_t *piece = mid_right ? &job->cut[0].x1 : &job->cut[0].x0;
    job->row = row;
    job->cut_end = end;
#if !ZS_LEAN
    if (ZS_DIVIDES && job->geom.tiny) {
        tiny_cuts(job, row, end);
        return;
    }
#endif
    edge_columns(mid_right ? &job->cut[0].x0 : &job->cut[0].x1, end - row, job->v[0], job->v[1 + mid_right], row);
    const int32_t upper = zs_min32(job->row_mid, end) - row; /* rows above the middle vertex */
    if (upper > 0) {
        edge_columns(piece, upper, job->v[0], mid, row);
        piece += 2 * upper;
        row += upper;
    }
    if (row < end)
        edge_columns(piece, end - row, mid, job->v[1 + mid_right], row);
}

/* ---- Set-up ------------------------------------------------------------------------------------------ */

#if ZS_LEAN

/* Fill job for its triangle in its strip: rows, sides, plane.c's geometry. Return 0 where it has no row there. */
static int job_setup(struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const struct zs_vertex *a = &pool[job->tri->v[0]], *b = &pool[job->tri->v[1]], *c = &pool[job->tri->v[2]];
    const int32_t b_row = zs_first_sample(b->y), c_row = zs_first_sample(c->y);
    struct zs_geom *g = &job->geom;
    job->row = zs_max32(zs_first_sample(a->y), job->y0);
    job->row_end = zs_min32(zs_max32(b_row, c_row), job->y1);
    if (job->row >= job->row_end)
        return 0;
    job->row_mid = zs_min32(b_row, c_row);
    job->v[0] = a;
    job->v[1] = b;
    job->v[2] = c;
    job->mid_right = b->y < c->y || (b->y == c->y && b->x < c->x);
    g->dx1 = b->x - a->x; /* |.| < 2^22 */
    g->dx2 = c->x - a->x;
    g->dy1 = b->y - a->y;
    g->dy2 = c->y - a->y;
    g->area = zs_mul_ss(g->dx1, g->dy2) - zs_mul_ss(g->dx2, g->dy1); /* < 2^45 */
    g->ia = a->x >> ZS_SUBPX_BITS;
    g->ja = a->y >> ZS_SUBPX_BITS;
    const int32_t width = zs_max32(zs_max32(g->dx1, g->dx2), 0) - zs_min32(zs_min32(g->dx1, g->dx2), 0);
    if (width + zs_max32(g->dy1, g->dy2) <= ZS_SMALL_EXTENT) { /* the first vertex is the top one */
        const int lz = zs_clz32((uint32_t)g->area); /* 1 .. 31: area <= width * height <= 2^30 */
        g->exp = -lz;
        g->rcp = zs_recip((uint32_t)g->area << lz);
    } else {
        g->rcp = 0;
        g->ia = zs_min32(zs_max32(g->ia, 0), job->width - 1);
        g->ja = zs_min32(zs_max32(g->ja, 0), job->r->config.height - 1);
    }
    g->ax = g->ia * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->x; /* small: -127 .. 128; large: < 2^22.1 */
    g->ay = g->ja * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;
    job->r->stats.tris_setup++;
    zs_raster_cuts(job, job->row);
    return 1;
}

#else

/* 1: no row has a pixel, and there are no more rows than have been cut. */
static int covers_nothing(const struct zs_job *job)
{
    if (job->cut_end < job->row_end)
        return 0;
    for (int32_t k = 0; k < job->cut_end - job->row; k++)
        if (job->cut[k].x0 < job->cut[k].x1)
            return 0;
    return 1;
}

static int sides(struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v;
    const struct zs_vertex *a = &pool[v[0]], *b = &pool[v[1]], *c = &pool[v[2]];
    const int32_t b_row = zs_first_sample(b->y), c_row = zs_first_sample(c->y);
    job->row = zs_max32(zs_first_sample(a->y), job->y0);
    job->row_mid = zs_min32(b_row, c_row);
    job->row_last = zs_max32(b_row, c_row);
    job->row_end = zs_min32(job->row_last, job->y1);
    if (job->row >= job->row_end)
        return 0;
    zs_plane_sides(job, a, b, c);
    return 1;
}

/* Fill job for its triangle in its strip. Return 0 where it has no pixel there. */
static ZS_NOINLINE int job_setup(struct zs_job *job)
{
    if (!sides(job))
        return 0;
    job->r->stats.tris_setup++;
    zs_raster_cuts(job, job->row);
    if (covers_nothing(job))
        return 0;
    zs_plane_geom(job);
    return 1;
}

#endif

#if !ZS_LEAN

ZS_ALWAYS_INLINE void keys_span(struct zs_job *job, const struct zs_row *row)
{
    if (job->fresh)
        zs_fresh_row(job, row);
    zs_rows_piece(job, row, row->i0, row->i1 - row->i0, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx);
}

/* Not inline, so that its frame is not on the stack below start(). */
ZS_NOINLINE void zs_raster_spans(struct zs_job *job)
{
    zs_rows_walk(job, keys_span);
}

#endif

void zs_raster_keys(struct zs_job *job)
{
    const struct zs_shader *shader = job->shader;
    zs_plane32(&job->geom, job->v[0]->d, job->v[1]->d, job->v[2]->d, ZS_PLANE_KEY, &job->key);
    job->key.base += 0x8000u; /* nearest: half a bucket; keys stay below 2^32 - 2^15 (plane.c) */
#if ZS_LEAN
    (void)shader;
    zs_raster_rows(job, 1);
#else
    if (!job->state) {
        shader->rows(job);
        return;
    }
    job->saturates = (uint8_t)zs_keys_may_saturate(job);
    if (shader->start)
        shader->start(job);
    zs_raster_spans(job);
#endif
}

#if ZS_LEAN

/* Test pixels [i0, i1) of a row, and colour those runs of them that are nearest. */
static void plain_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    const struct zs_shader *shader = job->shader;
    const uint32_t top = (job->r->view.key_top >> 16) - 1u;
    uint16_t *const line = job->depth + row->at, *at = line + i0, *const end = line + i1;
    for (; at < end; at++, sum += gx) { /* at a pixel that lost */
        const uint16_t *const from = at;
        for (uint32_t key; at < end && (key = zs_minu32(sum >> 16, top)) < *at; sum += gx)
            *at++ = (uint16_t)key;
        if (at > from) {
            zs_rows_written(job, (int32_t)(at - from));
            shader->run(job, row, (int32_t)(from - line), (int32_t)(at - line));
        }
    }
}

void zs_raster_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    if (job->state) {
        const struct zs_state_kernel *kernel = job->state->kernel;
        kernel->span(job, row, i0, i1, sum, gx);
    } else {
        plain_span(job, row, i0, i1, sum, gx);
    }
}

void zs_raster_rows(struct zs_job *job, int linear)
{
    struct zs_renderer *r = job->r;
    const struct zs_depth *depth = r->config.depth;
    const struct zs_shader *shader = job->shader;
    struct zs_row row;
    if (shader->start)
        shader->start(job);
    row.y = job->row;
    row.at = (row.y - job->y0) * job->width; /* < 2^24 */
    row.key = job->key.base - zs_wrap_mul(job->key.gx, job->geom.ia) + zs_wrap_mul(job->key.gy, row.y - job->geom.ja);
    for (;;) {
        for (const struct zs_cut *cut = job->cut; row.y < job->cut_end; row.y++, cut++) {
            row.x0 = cut->x0;
            row.x1 = cut->x1;
            row.i0 = zs_max32(row.x0, 0);
            row.i1 = zs_min32(row.x1, job->width);
            if (row.i0 < row.i1) {
                r->stats.pixels_tested += (uint32_t)(row.i1 - row.i0);
                if (linear)
                    zs_raster_span(job, &row, row.i0, row.i1, row.key + zs_wrap_mul(job->key.gx, row.i0), job->key.gx);
                else
                    depth->row(job, &row);
            }
            row.key += job->key.gy;
            row.at += job->width;
        }
        if (row.y >= job->row_end)
            break;
        zs_raster_cuts(job, row.y);
    }
}

#endif

static ZS_NOINLINE void draw(struct zs_job *job)
{
    const struct zs_renderer *r = job->r;
    const struct zs_depth *depth = r->config.depth;
    if (job->state) {
        const struct zs_state_kernel *kernel = job->state->kernel;
        job->bias = kernel->bias(job);
    }
    if (r->view.screen_linear)
        zs_raster_keys(job);
    else
        depth->rows(job);
}

#if ZS_LEAN

/* All triangles of the pool, which is in scene order, are looked at. */
void zs_raster_strip(struct zs_renderer *r)
{
    struct zs_job job;
    job.r = r;
    job.color = r->color[0];
    job.depth = r->depth;
    job.y0 = r->strip * r->config.strip_h;
    job.y1 = zs_min32(job.y0 + r->config.strip_h, r->config.height);
    job.width = r->config.width;
    for (uint32_t t = 0; t < r->n_tris; t++) {
        job.tri = &r->tri[t];
        const struct zs_instance *instance = &r->scene->instance[job.tri->instance];
        job.shader = instance->material->shader;
        job.state = instance->state;
        if (job_setup(&job))
            draw(&job);
    }
}

#else

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

/* The strip's triangles, out of their bin and the list of those that went on. */
static uint16_t take_list(struct zs_renderer *r)
{
    const uint16_t list = merged(r->tri, r->active, reversed(r->tri, r->bin[r->strip]));
    r->bin[r->strip] = ZS_NIL;
    return list;
}

void zs_raster_pass(struct zs_renderer *r)
{
    r->active = take_list(r); /* those that end here too: they have no row in a strip below */
}

/* Are all of a triangle's vertices beyond a depth? */
static inline int beyond(const struct zs_job *job, uint32_t d)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v;
    return pool[v[0]].d > d && pool[v[1]].d > d && pool[v[2]].d > d;
}

#define IN_VAIN 16 /* triangles of a strip that turned out not to be hidden: no more are asked */

void zs_raster_strip(struct zs_renderer *r)
{
    const int32_t y0 = r->strip * r->config.strip_h;
    const int32_t y1 = zs_min32(y0 + r->config.strip_h, r->config.height);
    const int goes_on = r->strip + 1 < r->band_end;
    uint16_t list = take_list(r);

    struct zs_job job;
    job.r = r;
    job.color = r->color[0];
    job.depth = r->depth;
    job.y0 = y0;
    job.y1 = y1;
    job.width = r->config.width;
    job.fresh = 0;
    r->lit.of = 0;
    uint32_t number = ZS_NIL; /* of the instance that is known; not one's, there are at most 65535 */
    int small = 0;
    uint16_t *keep = &r->active; /* grows at its end: stays ascending */
    uint32_t seen = r->large ? zs_hidden_seen(r) : UINT32_MAX;
    int32_t in_vain = 0;
    if (r->window[0] > r->walk_least || r->window[1] < r->walk_most) { /* all are asked */
        seen = 0;
        in_vain = INT32_MIN;
    }
    const int part = r->window[1] - r->window[0] < r->config.width; /* then there is a track */
    const struct zs_track_kernel *track = r->track;
    while (list != ZS_NIL) {
        struct zs_tri *t = &r->tri[list];
        job.tri = t;
        int hides = 0;
        if (seen != UINT32_MAX && beyond(&job, seen)) {
            hides = zs_hidden(&job);
            r->stats.tris_hidden += (uint32_t)hides;
            in_vain = hides ? 0 : in_vain + 1;
            if (in_vain == IN_VAIN)
                seen = UINT32_MAX;
        }
        if (t->instance != number) {
            const struct zs_instance *instance = &r->scene->instance[t->instance];
            number = t->instance;
            job.shader = instance->material->shader;
            job.state = instance->state;
            job.fresh = 0;
            small = ZS_DIVIDES && !r->fresh && r->view.piece_shift && !job.state && job.shader->small;
        }
        const struct zs_shader *shader = job.shader;
        if (!hides) {
            if (r->fresh && !zs_fresh_takes(&job))
                number = ZS_NIL; /* small triangles from now on */
            if (!(small && shader->small(&job))) {
                if (part && !r->fresh)
                    track->split(&job);
                if (job_setup(&job))
                    draw(&job);
            }
        }
        if (goes_on && job.row_last > y1) {
            *keep = list;
            keep = &t->next;
        }
        list = t->next;
    }
    *keep = ZS_NIL;
}


#endif
