/* Occlusion culling: triangles that large triangles hide are rejected before set-up.
 *
 * The frame is divided into tiles, 2^ZS_TILE_LOG2 columns wide and as high as a strip. When a
 * triangle covers all of a tile, or two triangles that share an edge cover it together, no final
 * key in the tile is above the farthest key of these triangles: that is the tile's bound. If the
 * nearest key of another triangle is above the bounds of all tiles that it touches, the triangle
 * wins no pixel, in whatever order they are drawn, because a pixel keeps the least key. (Equal keys
 * decide nothing, so the comparison is strict.) So the frame is the same with and without this
 * file. In the same way an instance is hidden if the nearest key of its bounding box is above the
 * bounds of all its tiles. A triangle never hides itself: its own nearest key is not above a bound
 * that it set.
 *
 * Bounds are computed when the first walk of a frame meets a triangle at least LARGE columns wide.
 * They are computed for all strips at once, and hold for all sets and later walks of the frame. A
 * frame without such triangles pays a look at the width of each triangle that core/assemble.c or
 * core/fan.c takes, and no more; fast/batch.c bins triangles of up to 128 px without it.
 *
 * Bounds are neither set by triangles with a depth state, nor do these ask for them; core/walk.c
 * ends the use of bounds where keys may grow. Frames in passes, and mappings and methods with a
 * depth test of their own, do without (core/frame.c). What it is worth: zs_fast.h.
 *
 * Columns: the left side of a triangle is a convex function of the row and the right side a concave
 * one. So in a strip, each side is farthest inwards in the first or the last row. Sides are moved
 * inwards by the error of the slope (side()).
 *
 * Keys: the keys of a triangle are at most that of its farthest vertex. The keys that are drawn are
 * within 0.13 bucket of the exact ones (NUMERICS.md: 0.005 up to 640 pixels of width and height, (W
 * + H + 1) / 2^17 beyond); MARGIN covers that. The plane through the vertices' keys, evaluated at a
 * tile's four corners, would be a tighter bound. It is not used; HISTORY.md has the figures.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/pass.h"
#include "core/job.h"
#include "fast/tiles.h"
#include "zs_fast.h"

#define TILE (1 << ZS_TILE_LOG2)
#define LARGE (2 * TILE) /* columns: so wide that a row covers a tile wherever it begins */
#define MARGIN 0x2200    /* of a bucket, in 2^-16: 0.13 */
_Static_assert(2 * ZS_SIZE_MAX + 1 <= MARGIN,
               "the error of a plane's keys, (W + H + 1) / 2^17 bucket");

/* Return the key of a depth d, rounded, with a margin added (add > 0) or subtracted, saturated. */
static uint32_t key_of(const struct zs_renderer *r, uint32_t d, int32_t add)
{
    const struct zs_depth *depth = r->view.depth;
    const uint32_t key = depth->key ? depth->key(&r->view, d) : d; /* uq16_16, <= key_top */
    const uint32_t most = r->view.key_top - 0x10000u;              /* keys saturate here */
    if (add < 0)
        return (key < 0x8000u - (uint32_t)add ? 0u
                                              : zs_minu32(key + 0x8000u + (uint32_t)add, most)) >>
               16;
    /* no carry: key < 2^32 - 2^17 */
    return (key >= most ? most : zs_minu32(key + 0x8000u + (uint32_t)add, most)) >> 16;
}

/* ---- Bounds ---------------------------------------------------------------------------------- */

enum {
    LONG,
    UPPER,
    LOWER
}; /* edges: top to bottom vertex; top to middle; middle to bottom */

/* Return the column where an edge crosses a scanline, moved inwards by the error, so that the
 * result is never outside the edge. The error of the slope is below 2^-shift; flooring the product
 * adds less than a sub-pixel. */
static int32_t side(const struct zs_cover *c, int edge, int32_t row, int right)
{
    const struct zs_vertex *a = &c->v[edge == LOWER];
    const int32_t off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y; /* 0 .. dy */
    const int32_t x = a->x + (c->slope[edge] * off >> c->shift[edge]),
                  error = (off >> c->shift[edge]) + 2;
    return zs_first_sample(right ? x - error : x + error);
}

/* Return the first column of a row (right = 0), or one beyond the last (right = 1), moved inwards.
 */
static int32_t column(const struct zs_cover *c, int32_t row, int right)
{
    const int edge = c->mid_right != right ? LONG : row < c->row_mid ? UPPER : LOWER;
    return side(c, edge, row, right);
}

/* Compute the slope dx / dy of an edge in 2^-shift, truncated: |slope * dy| <= 2^30. */
static void slope(struct zs_cover *c, int edge, const struct zs_vertex *a,
                  const struct zs_vertex *b)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    int32_t shift = zs_clz32((uint32_t)(zs_abs32(dx) | 1)) - 2; /* |dx| < 2^22: 8 or more */
    shift = zs_min32(shift, 12);
    c->shift[edge] = (uint8_t)shift;
    c->slope[edge] = dy ? dx * (1 << shift) / dy : 0;
}

/* Lower the bounds of tiles [at, end) to `farthest`. */
static void bound_tiles(uint16_t *at, const uint16_t *end, uint32_t farthest)
{
    for (; at < end; at++)
        *at = (uint16_t)zs_minu32(*at, farthest);
}

static int32_t strip_of(const struct zs_renderer *r, int32_t row) /* 0 .. ZS_SIZE_MAX - 1 */
{
    return (int32_t)((uint32_t)row * r->strip_mul >> r->strip_shift);
}

/* Set bounds in the strips whose rows are all in [row, row_end) but not all in [done, done_end).
 * The tiles are covered by one triangle (left == right), or by two that share an edge across all
 * these rows, one to the left and one to the right of it. */
static void bound_rows(struct zs_renderer *r, const struct zs_cover *left,
                       const struct zs_cover *right, int32_t row, int32_t row_end, int32_t done,
                       int32_t done_end)
{
    const int32_t h = r->config.strip_h, height = r->config.height, width = r->config.width;
    const int32_t tiles = (int32_t)ZS_TILES(width);
    const uint32_t farthest = zs_maxu32(left->farthest, right->farthest);
    if (row >= height || row_end <= 0)
        return;
    int32_t s = strip_of(r, zs_max32(row, 0));
    s = zs_max32(s + (s * h < row), r->strip);
    const int32_t end = zs_min32(row_end < height ? strip_of(r, row_end) : r->n_strips,
                                 r->draw_end);
    if (s >= end || (s * h >= done && zs_min32(end * h, height) <= done_end))
        return;
    uint16_t *bound = r->bound + s * tiles;
    const int32_t first = s * h, last = zs_min32(end * h, height) - 1;
    if (column(left, first, 0) <= 0 && column(right, first, 1) >= width &&
        column(left, last, 0) <= 0 &&
        column(right, last, 1) >= width) { /* so the rows between are covered as well */
        bound_tiles(bound, r->bound + end * tiles, farthest);
        return;
    }
    for (int32_t y0 = first; s < end; s++, y0 += h, bound += tiles) {
        const int32_t y1 = zs_min32(y0 + h, height);
        if (y0 >= done && y1 <= done_end)
            continue;
        const int32_t x0 = zs_max32(column(left, y0, 0), column(left, y1 - 1, 0));
        const int32_t x1 = zs_min32(column(right, y0, 1), column(right, y1 - 1, 1));
        bound_tiles(bound + ((zs_max32(x0, 0) + TILE - 1) >> ZS_TILE_LOG2),
                    bound + (x1 >= width ? tiles : x1 >> ZS_TILE_LOG2), farthest);
    }
}

/* Set the bounds of the tiles that a triangle covers by itself, except in rows that bound_both has
 * done already. */
static void bound_one(struct zs_renderer *r, const struct zs_cover *c)
{
    bound_rows(r, c, c, zs_first_sample(c->v[0].y), zs_first_sample(c->v[2].y), c->done[0],
               c->done[1]);
}

/* If two triangles share an edge and lie on opposite sides of it, set the bounds of the tiles that
 * they cover together. */
static void bound_both(struct zs_renderer *r, struct zs_cover *a, struct zs_cover *b)
{
    int in_a = 0, in_b = 0; /* bit k: vertex k is shared */
    for (int k = 0; k < 9; k++)
        if (a->v[k / 3].x == b->v[k % 3].x && a->v[k / 3].y == b->v[k % 3].y &&
            a->v[k / 3].d == b->v[k % 3].d) {
            in_a |= 1 << k / 3;
            in_b |= 1 << k % 3;
        }
    if ((in_a != 3 && in_a != 5 && in_a != 6) || (in_b != 3 && in_b != 5 && in_b != 6))
        return;
    const int right_a = (in_a == 5) != a->mid_right,
              right_b = (in_b == 5) != b->mid_right; /* 1: the edge is its right side */
    if (right_a == right_b)
        return;
    a->done[0] = b->done[0] = zs_max32(zs_first_sample(a->v[in_a == 6].y), 0);
    a->done[1] = b->done[1] = zs_min32(zs_first_sample(a->v[in_a == 3 ? 1 : 2].y),
                                       r->config.height);
    bound_rows(r, right_a ? a : b, right_a ? b : a, a->done[0], a->done[1], 0, 0);
}

/* Set the bounds for the last large triangle alone. That was postponed until it was known whether
 * the next one shares an edge with it. */
static void bound_last(struct zs_renderer *r)
{
    if (r->cover_waits)
        bound_one(r, &r->cover[!r->cover_next]);
    r->cover_waits = 0;
}

/* Return 1 if no bound in the strips still to be drawn is above a key; a triangle with this nearest
 * key cannot lower any bound. Usually the first tile decides. Bounds only decrease, so the answer 1
 * for a key holds for all larger keys (bound_most). */
static int bounds_nothing(struct zs_renderer *r, uint32_t key)
{
    if (key >= r->bound_most)
        return 1;
    const uint32_t tiles = ZS_TILES(r->config.width);
    const uint16_t *bound = r->bound + r->strip * tiles, *const end = r->bound +
                                                                      r->draw_end * tiles;
    while (bound < end && key >= *bound)
        bound++;
    if (bound < end)
        return 0;
    r->bound_most = (uint16_t)key;
    return 1;
}

static inline int above(const struct zs_vertex *a, const struct zs_vertex *b)
{
    return a->y < b->y || (a->y == b->y && a->x < b->x);
}

static ZS_NOINLINE void tiles_cover(struct zs_renderer *r, const struct zs_vertex *a,
                                    const struct zs_vertex *b, const struct zs_vertex *c)
{
    const int32_t left = zs_min32(zs_min32(a->x, b->x), c->x),
                  right = zs_max32(zs_max32(a->x, b->x), c->x);
    if (right - left < LARGE * ZS_SUBPX_ONE || right <= 0 || left >= r->config.width * ZS_SUBPX_ONE)
        return;
    const int32_t row = zs_max32(zs_first_sample(zs_min32(zs_min32(a->y, b->y), c->y)),
                                 r->strip * r->config.strip_h);
    const int32_t row_end = zs_first_sample(zs_max32(zs_max32(a->y, b->y), c->y));
    if (row_end - row < r->config.strip_h && (row_end < r->config.height || row >= row_end))
        return; /* it does not cover all rows of any strip */
    if (!r->counting || r->xform.instance->depth_state || r->view.pixelwise > 1)
        return;      /* bounds are complete by now; keys are others, or not sure */
    if (!r->large) { /* the frame's first large triangle */
        zs_fill_run(r->bound, ZS_DEPTH_CLEAR, ZS_TILES(r->config.width) * r->n_strips);
        r->large = 1;
        r->bound_most = ZS_DEPTH_CLEAR;
        r->cover_known = r->cover_waits = r->cover_next = 0;
    }
    const uint32_t nearest = zs_minu32(zs_minu32(a->d, b->d), c->d),
                   farthest = zs_maxu32(zs_maxu32(a->d, b->d), c->d);
    if (bounds_nothing(r, key_of(r, nearest, 0)))
        return;
    struct zs_cover *now = &r->cover[r->cover_next], *const old = &r->cover[!r->cover_next];
    while (above(b, a) || above(c, a)) { /* rotate the top vertex to the front */
        const struct zs_vertex *const first = a;
        a = b;
        b = c;
        c = first;
    }
    now->mid_right = (uint8_t)above(b, c);
    if (!now->mid_right) {
        const struct zs_vertex *const middle = c;
        c = b;
        b = middle;
    }
    now->v[0] = *a;
    now->v[1] = *b;
    now->v[2] = *c;
    now->row_mid = zs_first_sample(b->y);
    now->farthest = key_of(r, farthest, MARGIN);
    slope(now, LONG, a, c);
    slope(now, UPPER, a, b);
    slope(now, LOWER, b, c);
    now->done[0] = now->done[1] = 0;
    if (r->cover_known)
        bound_both(r, now, old);
    bound_last(r);
    r->cover_known = r->cover_waits = 1;
    r->cover_next = !r->cover_next;
}

/* ---- Tests ----------------------------------------------------------------------------------- */

static uint32_t tiles_seen(struct zs_renderer *r)
{
    bound_last(r);
    const uint32_t tiles = ZS_TILES(r->config.width);
    const uint16_t *bound = r->bound + r->strip * tiles, *const end = bound + tiles;
    uint32_t least = ZS_DEPTH_CLEAR, most = 0;
    for (; bound < end; bound++) {
        least = zs_minu32(least, *bound);
        most = zs_maxu32(most, *bound);
    }
    r->bound_strip = (uint16_t)most;
    const struct zs_depth *depth = r->view.depth;
    return least == ZS_DEPTH_CLEAR ? UINT32_MAX
           : depth->key            ? 0u
                                   : least << 16; /* least <= ZS_DEPTH_CLEAR - 1 */
}

static int tiles_hide(struct zs_job *job)
{
    const struct zs_renderer *r = job->r;
    const struct zs_tri *t = job->tri;
    const struct zs_vertex *a = &r->vert[t->v[0]], *b = &r->vert[t->v[1]], *c = &r->vert[t->v[2]];
    if (zs_instance_of(r, t->instance)->depth_state)
        return 0;                                          /* a depth state changes the keys */
    job->tri_end = zs_first_sample(zs_max32(b->y, c->y)); /* a is the top vertex */
    const uint32_t nearest = key_of(r, zs_minu32(zs_minu32(a->d, b->d), c->d), -MARGIN);
    if (nearest > r->bound_strip)
        return 1;
    const int32_t x0 = zs_max32(zs_first_sample(zs_min32(zs_min32(a->x, b->x), c->x)),
                                r->window[0]);
    const int32_t x1 = zs_min32(zs_first_sample(zs_max32(zs_max32(a->x, b->x), c->x)),
                                r->window[1]);
    const uint16_t *bound = r->bound + r->strip * ZS_TILES(r->config.width);
    for (int32_t k = x0 >> ZS_TILE_LOG2; k <= (x1 - 1) >> ZS_TILE_LOG2; k++)
        if (nearest <= bound[k])
            return 0;
    return 1;
}

int zs_hidden_box(struct zs_renderer *r, const struct zs_box *box, uint32_t nearest)
{
    const int32_t h = r->config.strip_h;
    int32_t x0 = zs_max32(box->x0, 0), x1 = zs_min32(box->x1, r->config.width) - 1;
    int32_t y0 = zs_max32(box->y0, r->strip * h),
            y1 = zs_min32(box->y1, zs_min32(r->draw_end * h, r->config.height)) - 1;
    if (!r->large || x0 > x1 || y0 > y1)
        return 0;
    bound_last(r);
    x0 >>= ZS_TILE_LOG2;
    x1 >>= ZS_TILE_LOG2;
    y0 = strip_of(r, y0);
    y1 = strip_of(r, y1);
    const uint32_t key = key_of(r, nearest, -MARGIN), tiles = ZS_TILES(r->config.width);
    const uint16_t *bound = r->bound + (uint32_t)y0 * tiles;
    for (; y0 <= y1; y0++, bound += tiles)
        for (int32_t x = x0; x <= x1; x++)
            if (key <= bound[x])
                return 0;
    return 1;
}

static int tiles_sphere(struct zs_renderer *r, const struct zs_bounds *b)
{
    struct zs_box box;
    return r->large && zs_cull_box(r, b, &box) && zs_hidden_box(r, &box, box.nearest);
}

static const struct zs_fast_tiles tiles = {
    .cover = tiles_cover, .seen = tiles_seen, .hides = tiles_hide, .hides_sphere = tiles_sphere,
    .in_vain = 16
};
const struct zs_fast zs_fast_tiles = { .tiles = &tiles };
