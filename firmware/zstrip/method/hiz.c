/* The hierarchical depth buffer (Greene 1993): the depth buffer, with an upper bound of the keys in
 * each tile, and in blocks of 4x4 tiles, of 4x4 blocks, up to the strip.
 *
 * What it skips loses the depth test at every pixel: its nearest key is not less than the bound. So
 * the picture and the keys are those of core/buffer.c.
 *
 * Bounds are kept lazily. A bound may be too high, never too low. A tile counts the pixels that
 * were drawn in it; when they are as many as it has, the next test that fails looks at its keys, up
 * to the first that is farther than what is tested. So looking costs at most a load and a
 * comparison for each pixel drawn. Keys grow where something is drawn always (ZS_DEPTH_ALWAYS);
 * bounds are raised there.
 *
 * Fast clear. Nothing is cleared before a strip is drawn. A tile is cleared when the first triangle
 * reaches it, or at the end of the strip; not if the first triangle covers all of it, whose pixels
 * then need no depth test. All of that triangle's pieces are drawn before another's.
 *
 * The hooks of the accelerators `touch` and `tiles` (core/fast.h) are set to functions of this
 * file while a strip is drawn, and bounds lie in their memory.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/raster.h"
#include "core/rows.h"
#include "core/walk.h"
#include "method/hiz.h"
#include "zs_method.h"
#include "zs_shader.h"

/* ---- Hooks in place of the accelerators ------------------------------------------------------ */

static void hiz_cover(struct zs_renderer *r, const struct zs_vertex *a, const struct zs_vertex *b,
                      const struct zs_vertex *c)
{
    (void)r;
    (void)a;
    (void)b;
    (void)c;
}

static uint32_t hiz_seen(struct zs_renderer *r)
{
    (void)r;
    return 0; /* all triangles are tested */
}

static int hiz_hides(struct zs_job *job)
{
    const struct zs_renderer *r = job->r;
    const struct zs_tri *t = job->tri;
    const struct zs_vertex *a = &r->vert[t->v[0]], *b = &r->vert[t->v[1]], *c = &r->vert[t->v[2]];
    if (zs_instance_of(r, t->instance)->depth_state)
        return 0;                                          /* a depth state changes the keys */
    job->tri_end = zs_first_sample(zs_max32(b->y, c->y)); /* a is the top vertex */
    const struct zs_box box = { zs_first_sample(zs_min32(zs_min32(a->x, b->x), c->x)),
                                zs_first_sample(zs_max32(zs_max32(a->x, b->x), c->x)),
                                zs_first_sample(a->y), job->tri_end,
                                zs_minu32(zs_minu32(a->d, b->d), c->d) };
    return zs_hiz_hides_box(r, r->method_state, &box);
}

/* Called in a walk that bins one strip (hiz_full). */
static int hiz_hides_sphere(struct zs_renderer *r, const struct zs_bounds *b)
{
    struct zs_box box;
    return zs_cull_box(r, b, &box) && zs_hiz_hides_box(r, r->method_state, &box);
}

/* In place of clearing the strip. */
static void hiz_begin_strip(struct zs_renderer *r)
{
    r->untouched = 1;
}

static const struct zs_fast_tiles hiz_tiles = {
    .cover = hiz_cover, .seen = hiz_seen, .hides = hiz_hides, .hides_sphere = hiz_hides_sphere,
    .in_vain = INT32_MAX
};
static const struct zs_fast_touch hiz_touch = { .begin = hiz_begin_strip };

/* ---- First touch of a tile ------------------------------------------------------------------- */

/* Return 1 if the triangle covers all of a tile; `row` is the first that it draws there. Left sides
 * are convex and right sides concave, so the first and the last row decide. */
static int covers(const struct zs_job *job, const struct zs_hiz *h, const struct zs_row *row,
                  const struct zs_hiz_place *at)
{
    const int32_t end = at->x + at->columns;
    if (job->depth_state || !job->shader->opaque || row->y - h->y0 != at->y ||
        row->y + at->rows > job->cut_end)
        return 0;
    /* cut[] holds up to ZS_CUT_ROWS rows, the first of which is job->row or as many rows below */
    const struct zs_cut *last = &job->cut[(row->y - job->row) % ZS_CUT_ROWS + at->rows - 1];
    return row->x0 <= at->x && row->x1 >= end && last->x0 <= at->x && last->x1 >= end;
}

/* A triangle reaches a tile on which nothing was drawn. Return its state. */
static ZS_NOINLINE uint8_t touch_tile(struct zs_job *job, struct zs_hiz *h,
                                      const struct zs_row *row, int32_t tx, int32_t ty)
{
    struct zs_renderer *r = job->r;
    const struct zs_hiz_place at = zs_hiz_place_of(r, h, tx, ty);
    if (!covers(job, h, row, &at)) {
        for (int32_t k = 0; k < at.rows; k++)
            zs_raster_clear(r, at.y + k, at.x, at.columns);
        return zs_hiz_seen(r, h, tx, ty);
    }
    for (uint32_t k = 0; h->cover != job->tri && k < h->tiles; k++)
        if (h->state[k] == ZS_HIZ_COVERED)
            h->state[k] = ZS_HIZ_MANY;
    h->cover = job->tri;
    return ZS_HIZ_COVERED;
}

/* Clear the tiles on which nothing was drawn. */
static void clear_rest(struct zs_renderer *r, const struct zs_hiz *h)
{
    for (int32_t y = 0; y < h->rows; y++)
        for (int32_t x = 0, n; x < r->config.width; x += n << h->log2) {
            const uint8_t *state =
                &h->state[zs_hiz_cell_of(h, 0, x >> h->log2, y >> ZS_HIZ_ROWS_LOG2)];
            const int32_t most = ((r->config.width - 1 - x) >> h->log2) + 1;
            for (n = 0; n < most && state[n] == ZS_HIZ_FRESH; n++)
                ;
            zs_raster_clear(r, y, x, zs_min32(n << h->log2, r->config.width - x));
            n = zs_max32(n, 1);
        }
}

/* Draw pixels of a tile that the triangle covers. */
static void untested(struct zs_job *job, const struct zs_row *row, int32_t i, int32_t end,
                     uint32_t sum, uint32_t step)
{
    const uint32_t top = (job->r->view.key_top >> 16) - 1u;
    uint16_t *const line = job->depth + row->at;
    for (int32_t k = i; k < end; k++, sum += step)
        line[k] = (uint16_t)zs_minu32(sum >> 16, top);
    job->r->stats.pixels_untested += (uint32_t)(end - i);
    zs_rows_written(job, end - i);
    job->shader->run(job, row, i, end);
}

/* ---- Pieces of scanlines --------------------------------------------------------------------- */

/* A piece of a scanline in one tile. */
struct piece {
    int32_t i, end;     /* columns */
    uint32_t sum, step; /* as zs_piece_fn */
    int32_t tx, ty;
};

/* How the nearest key of a triangle in a tile is found, uq16_16; at most that of the piece. */
typedef uint32_t nearest_fn(const struct zs_job *job, struct zs_hiz *h, const struct zs_row *row,
                            const struct piece *p);

/* The nearest key of the piece's pixels. Sums do not wrap on covered pixels (core/plane.c). */
static inline uint32_t nearest_pixel(const struct zs_job *job, struct zs_hiz *h,
                                     const struct zs_row *row, const struct piece *p)
{
    (void)job;
    (void)h;
    (void)row;
    return zs_minu32(p->sum, p->sum + zs_wrap_mul(p->step, p->end - 1 - p->i));
}

static uint32_t nearest_vertex(const struct zs_job *job, struct zs_hiz *h, const struct zs_row *row,
                               const struct piece *p)
{
    if (h->of != job->tri) {
        h->of = job->tri;
        h->nearest = zs_hiz_nearest(job->r,
                                    zs_minu32(zs_minu32(job->v[0]->d, job->v[1]->d), job->v[2]->d));
    }
    return zs_minu32(h->nearest, nearest_pixel(job, h, row, p));
}

/* The plane's value at that corner of the tile where it is least. Gradients of slivers may not fit
 * 32 bits; the result is not above the nearest pixel's in any case. */
static uint32_t nearest_corner(const struct zs_job *job, struct zs_hiz *h, const struct zs_row *row,
                               const struct piece *p)
{
    if (!job->r->view.screen_linear && p->step != job->key.gx)
        return nearest_vertex(job, h, row, p);
    const int32_t gx = (int32_t)job->key.gx, gy = (int32_t)job->key.gy;
    const int32_t x = (p->tx << h->log2), y = (p->ty << ZS_HIZ_ROWS_LOG2) + h->y0;
    const int32_t dx = x + (gx < 0 ? (1 << h->log2) - 1 : 0) - p->i,
                  dy = y + (gy < 0 ? ZS_HIZ_ROWS - 1 : 0) - row->y;                /* |.| < 2^13 */
    const int64_t least = (int64_t)p->sum + zs_mul_ss(gx, dx) + zs_mul_ss(gy, dy); /* < 2^46 */
    return least < 0 ? 0u
                     : zs_minu32(least >> 32 ? UINT32_MAX : (uint32_t)least,
                                 nearest_pixel(job, h, row, p));
}

/* Return the key to compare with bounds, for a nearest key before the depth state: what is not
 * above the bound loses everywhere; -1: nothing is known to lose. */
static int32_t losing_key(const struct zs_job *job, uint32_t sum)
{
    const struct zs_depth_state *state = job->depth_state;
    const int32_t top = (int32_t)(job->r->view.key_top >> 16) - 1;
    if (!state)
        return zs_min32((int32_t)(sum >> 16), top);
    if (state->func == ZS_DEPTH_ALWAYS)
        return -1;
    const int32_t key = zs_min32((int32_t)(sum >> 16) + job->bias,
                                 top + zs_min32(job->bias, 0)); /* as zs_rows_test */
    return zs_max32(key, 0) - (state->func == ZS_DEPTH_LESS_EQUAL);
}

/* Draw pixels [from, to) of a piece that begins at i0. */
static ZS_NOINLINE void draw(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t from,
                             int32_t to, uint32_t sum, uint32_t step)
{
    zs_piece_fn *const test = ZS_IF_FAST(job->fast) && job->fast->span && !job->depth_state
                                  ? job->fast->span
                              : job->shader->span ? job->shader->span
                                                  : zs_rows_test;
    if (from < to)
        test(job, row, from, to, sum + zs_wrap_mul(step, from - i0), step);
}

/* Cut a piece at the tiles' borders, and draw what is not hidden. Neighbours are drawn together. */
ZS_ALWAYS_INLINE void cut(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                          uint32_t sum, uint32_t step, nearest_fn *nearest)
{
    struct zs_renderer *r = job->r;
    struct zs_hiz *h = r->method_state;
    struct piece p = { i0, i0, sum, step, i0 >> h->log2, (row->y - h->y0) >> ZS_HIZ_ROWS_LOG2 };
    uint8_t *state = &h->state[zs_hiz_cell_of(h, 0, p.tx, p.ty)];
    int32_t from = i0; /* pixels [from, p.i) are to be drawn */
    for (; p.i < i1; p.tx++, state++, p.sum += zs_wrap_mul(step, p.end - p.i), p.i = p.end) {
        p.end = zs_min32(i1, (p.tx + 1) << h->log2);
        if (*state == ZS_HIZ_FRESH)
            *state = touch_tile(job, h, row, p.tx, p.ty);
        r->stats.tiles_tested++;
        if (*state == ZS_HIZ_COVERED && h->cover == job->tri) {
            draw(job, row, i0, from, p.i, sum, step);
            untested(job, row, p.i, p.end, p.sum, step);
        } else if (zs_hiz_hides(r, h, p.tx, p.ty, losing_key(job, nearest(job, h, row, &p)))) {
            draw(job, row, i0, from, p.i, sum, step);
            r->stats.pixels_hidden += (uint32_t)(p.end - p.i);
        } else {
            if (*state < ZS_HIZ_MANY)
                *state = (uint8_t)zs_min32(*state + (p.end - p.i), ZS_HIZ_MANY);
            if (job->depth_state && job->depth_state->func == ZS_DEPTH_ALWAYS)
                zs_hiz_loosen(h, p.tx, p.ty);
            continue;
        }
        from = p.end;
    }
    draw(job, row, i0, from, i1, sum, step);
}

static void pixel_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                       uint32_t sum, uint32_t step)
{
    cut(job, row, i0, i1, sum, step, nearest_pixel);
}

static void corner_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    cut(job, row, i0, i1, sum, step, nearest_corner);
}

static void vertex_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    cut(job, row, i0, i1, sum, step, nearest_vertex);
}

/* ---- The strip ------------------------------------------------------------------------------- */

/* Before triangles are drawn into the strip: test them. */
static void test_triangles(struct zs_renderer *r)
{
    struct zs_hiz *h = r->method_state;
    h->cover = h->of = 0; /* records of the pool are used again */
    r->tiles = &hiz_tiles;
    r->large = 1;
}

static void test_no_more(struct zs_renderer *r)
{
    r->tiles = 0;
    r->large = 0;
}

/* The rest of the walk bins one strip, and what is drawn of it hides instances. Not after an
 * instance that is always drawn: a part of it may be drawn later (core/walk.c sets r->refit). */
static void hiz_full(struct zs_renderer *r)
{
    test_triangles(r);
    zs_buffer_full(r);
    if (r->refit)
        test_no_more(r);
}

static uint16_t hiz_list(struct zs_renderer *r)
{
    return zs_scene_list(r);
}

static void hiz_strip(struct zs_renderer *r)
{
    struct zs_hiz h;
    const int fresh = r->untouched; /* the strip is not cleared */
    r->untouched = 0;
    h.y0 = r->strip * r->config.strip_h;
    h.rows = zs_strip_rows(r);
    zs_hiz_divide(r, &h);
    zs_fill_run(h.far, ZS_DEPTH_CLEAR, h.cells);
    uint8_t *state = h.state;
    for (int32_t ty = 0; state < h.state + h.tiles; ty++)
        for (int32_t tx = 0; tx < h.columns[0]; tx++)
            *state++ = fresh ? ZS_HIZ_FRESH : zs_hiz_seen(r, &h, tx, ty);
    while (state < h.state + h.cells)
        *state++ = 0;
    r->method_state = &h;
    if (r->strip >= r->band_end)
        zs_walk(r, r->draw_end);
    test_triangles(r);
    zs_raster_strip(r);
    test_no_more(r);
    if (fresh)
        clear_rest(r, &h);
    r->touch = &hiz_touch; /* for the next strip */
}

static int begin(struct zs_renderer *r, zs_piece_fn *span)
{
    if (r->config.depth->span) /* the mapping has no depth memory */
        return ZS_ERR_DEPTH;
    r->span = span;
    return ZS_OK;
}

static int hiz_begin(struct zs_renderer *r)
{
    return begin(r, pixel_span);
}

static int corner_begin(struct zs_renderer *r)
{
    return begin(r, corner_span);
}

static int vertex_begin(struct zs_renderer *r)
{
    return begin(r, vertex_span);
}

const struct zs_method zs_method_hiz = {
    .begin = hiz_begin, .strip = hiz_strip, .full = hiz_full, .list = hiz_list
};
const struct zs_method zs_method_hiz_corner = {
    .begin = corner_begin, .strip = hiz_strip, .full = hiz_full, .list = hiz_list
};
const struct zs_method zs_method_hiz_vertex = {
    .begin = vertex_begin, .strip = hiz_strip, .full = hiz_full, .list = hiz_list
};
