/* Triangles of one colour and up to 64 pixels each way, set up and drawn in one go: what the stages would do one by
 * one, with the same outcome bit for bit, where a call a stage costs more than the pixels. For cores that divide; without,
 * remainders are quicker (raster.c).
 *
 * Columns of an edge are as in raster.c, but counted from one left of the triangle, so that the numerator is positive.
 * Extents are at most ZS_TINY = 2^14 sub-pixels, and so are offsets in rows of an edge: each product is below 2^28.1.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade_solid.h"

#if ZS_DIVIDES

/* Columns of an edge that begins x to the right of column 0, in n rows, off below its beginning in the first of them;
 * out[0], out[2], ... */
static inline void columns(int16_t *out, int32_t n, int32_t x, int32_t off, int32_t dx, int32_t dy)
{
    const uint32_t span = (uint32_t)dy * ZS_SUBPX_ONE;
    uint32_t sum = (uint32_t)(x * dy + off * dx) + span - 1u;
    for (int16_t *const end = out + 2 * n; out < end; out += 2) {
        *out = (int16_t)(sum / span);
        sum += (uint32_t)dx * ZS_SUBPX_ONE;
    }
}

/* The spans that are cut, from column `left` on. key: at that column in the first row. */
static inline void draw(struct zs_job *job, uint32_t key, int32_t gx, int32_t gy, int32_t left, int32_t row, int32_t n)
{
    const int32_t width = job->width;
    const uint16_t paint = job->tri->paint;
    const uintptr_t beside = zs_solid_beside(job);
    uint16_t *const depth = job->depth;
    int32_t at = (row - job->y0) * width + left; /* with a column that is in the frame: in the strip */
    const int32_t least = zs_max32(-left, 0), most = width - left; /* of columns, counted from `left` */
    uint32_t tested = 0;
    int32_t written = 0;
    for (const struct zs_cut *cut = job->cut, *const end = cut + n; cut != end; cut++) {
        const int32_t i0 = zs_max32(cut->x0, least), m = zs_min32(cut->x1, most) - i0;
        if (m > 0) {
            tested += (uint32_t)m;
            written += zs_solid_pixels(depth + (at + i0), beside, m, key + zs_wrap_mul((uint32_t)gx, i0), (uint32_t)gx,
                                       paint, 0, 0);
        }
        at += width;
        key += (uint32_t)gy;
    }
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

int zs_small_draw(struct zs_job *job)
{
    struct zs_renderer *r = job->r;
    const struct zs_vertex *pool = r->vert;
    const struct zs_vertex *a = &pool[job->tri->v[0]], *b = &pool[job->tri->v[1]], *c = &pool[job->tri->v[2]], *swap;
    struct zs_geom *g = &job->geom;
    if (b->y < a->y || (b->y == a->y && b->x < a->x)) {
        swap = a;
        a = b;
        b = swap;
    }
    if (c->y < a->y || (c->y == a->y && c->x < a->x)) {
        swap = a;
        a = c;
        c = swap;
    }
    int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    if (((uint32_t)(dx1 + ZS_TINY) | (uint32_t)(dx2 + ZS_TINY) | ((uint32_t)dy1 | (uint32_t)dy2) * 2u) >= 2u * ZS_TINY)
        return 0;
    int32_t area = dx1 * dy2 - dx2 * dy1; /* |.| <= 2^29 */
    if (area < 0) {
        swap = b;
        b = c;
        c = swap;
        const int32_t x1 = dx1, y1 = dy1;
        dx1 = dx2;
        dx2 = x1;
        dy1 = dy2;
        dy2 = y1;
        area = -area;
    }
    if (area < ZS_TINY_AREA)
        return 0;
    const uint32_t limit = r->view.key_top - 0x10000u, at = r->view.piece_base, d = a->d;
    if (d >= limit || b->d >= limit || c->d >= limit || (((at - d) ^ (at - b->d)) | ((at - d) ^ (at - c->d))) >>
        r->view.piece_shift)
        return 0;
    const int32_t last = zs_first_sample(a->y + zs_max32(dy1, dy2)), row = zs_max32(zs_first_sample(a->y), job->y0);
    const int32_t n = zs_min32(last, job->y1) - row;
    job->row_last = last;
    if (n <= 0)
        return 1;
    if (n > ZS_CUT_ROWS)
        return 0;
    g->dx[0] = dx1;
    g->dx[1] = dx2;
    g->dy[0] = dy1;
    g->dy[1] = dy2;

    const int32_t left = zs_first_sample(a->x + zs_min32(zs_min32(dx1, dx2), 0)) - 1;
    const int32_t x = a->x - ZS_SUBPX_HALF - left * ZS_SUBPX_ONE, off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;
    struct zs_cut *const cuts = job->cut;
    int32_t dx = dx1, dy = dy1, mid_dx = dx2, mid_dy = dy2; /* the long edge; to the vertex between its ends */
    int16_t *long_side = &cuts[0].x1, *side = &cuts[0].x0;
    if (dy1 < dy2) {
        dx = dx2;
        dy = dy2;
        mid_dx = dx1;
        mid_dy = dy1;
        long_side = &cuts[0].x0;
        side = &cuts[0].x1;
    }
    const int32_t k = zs_max32(zs_min32(zs_first_sample(a->y + mid_dy) - row, n), 0); /* rows above that vertex */
    columns(long_side, n, x, off, dx, dy);
    if (k > 0)
        columns(side, k, x, off, mid_dx, mid_dy);
    if (k < n)
        columns(side + 2 * k, n - k, x + mid_dx, off + k * ZS_SUBPX_ONE - mid_dy, dx - mid_dx, dy - mid_dy);
    const struct zs_cut *cut = cuts, *const end = cuts + n;
    while (cut->x0 >= cut->x1)
        if (++cut == end) {
            r->stats.tris_setup++;
            return 1;
        }

    const int lz = zs_clz32((uint32_t)area);
    g->exp = -lz;
    g->rcp = zs_recip((uint32_t)area << lz);
    const int32_t dv1 = (int32_t)(b->d - d), dv2 = (int32_t)(c->d - d);
    const int32_t gx = zs_plane_tiny_gradient(g, dv1, dv2, g->dy, ZS_PLANE_KEY);
    const int32_t up = zs_plane_tiny_gradient(g, dv1, dv2, g->dx, ZS_PLANE_KEY);
    if (gx == ZS_TOO_STEEP || up == ZS_TOO_STEEP)
        return 0;
    r->stats.tris_setup++;
    const int32_t gy = -up;
    const int32_t ax = ZS_SUBPX_HALF - (a->x & (ZS_SUBPX_ONE - 1)), ay = ZS_SUBPX_HALF - (a->y & (ZS_SUBPX_ONE - 1));
    const int32_t low = (gx & 255) * ax + (gy & 255) * ay + 128; /* as small_base in plane.c */
    uint32_t key = d + (uint32_t)((gx >> 8) * ax + (gy >> 8) * ay + (low >> 8)) + 0x8000u +
                   zs_wrap_mul((uint32_t)gx, left - (a->x >> ZS_SUBPX_BITS)) +
                   zs_wrap_mul((uint32_t)gy, row - (a->y >> ZS_SUBPX_BITS));
    draw(job, key, gx, gy, left, row, n);
    return 1;
}

#else

int zs_small_draw(struct zs_job *job) /* not called */
{
    (void)job;
    return 0;
}

#endif
