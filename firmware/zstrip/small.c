/* Triangles of one colour and up to 64 pixels each way, set up and drawn in one go: what the stages would do one by
 * one, with the same outcome bit for bit, where a call a stage costs more than the pixels. For cores that divide; without,
 * remainders are quicker (raster.c). The same for other shaders does not pay: their set-up wants what the stages leave.
 *
 * Columns of an edge are as in raster.c, but counted from ZS_TINY_SIDE left of the top corner, so that the numerator is positive.
 * Extents are at most ZS_TINY = 2^14 sub-pixels, and so are offsets in rows of an edge: each product is below 2^29.1.
 * An edge's rows have 0 <= off < dy, so that x dy + off dx lies between x dy and (x + dx) dy, those of its ends: no column
 * lies beside the corners', which set-up has looked at.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade_solid.h"

#if ZS_LEAN
#elif ZS_DIVIDES

#define KEY_SAFE 0x20000u /* of piece_base - d, which is 0xffff where a key is B - 1 */

/* What the rows are drawn from: apart from set-up, whose registers they need. The column of a side in the next row is
 * sum / span, counted from ZS_TINY_SIDE left of the top corner; the left side and the right one. */
struct walk {
    uint32_t side[4];              /* span, step; span, step */
    uint32_t down[2];              /* a row: bytes of depth, key */
    uint32_t sum[2];
    uint32_t key, gx;              /* at column 0 of them; a pixel */
    int32_t row, mid, end;         /* in the frame: the first, the first below the middle corner, one beyond the last */
    uintptr_t left;                /* from a row's first depth to one left of column 0 */
    uint32_t turn;                 /* the side that turns at the middle corner, and what it becomes there */
    uint32_t next[2], next_sum;
};

/* The pixels right of `at` up to `end`, as zs_solid_pixels. */
ZS_ALWAYS_INLINE int32_t pixels(uint16_t *at, uint16_t *const end, uintptr_t beside, uint32_t sum, uint32_t gx, uint16_t paint)
{
    int32_t written = 0;
    do {
        if (sum >> 16 < *++at) {
            *at = (uint16_t)zs_high(sum);
            *(uint16_t *)((uintptr_t)at + beside) = paint;
            if (ZS_STATS)
                written++;
        }
        sum += gx;
    } while (at != end);
    return written;
}

static ZS_NOINLINE void small_rows(struct zs_job *job, struct walk *w)
{
    const uint32_t pitch = w->down[0];
    const uintptr_t beside = zs_solid_beside(job);
    const uint16_t paint = job->tri->paint;
    uintptr_t depth = (uintptr_t)job->depth + (uint32_t)(w->row - job->y0) * pitch + w->left;
    uintptr_t end = depth + (uint32_t)(w->mid - w->row) * pitch;
    const uintptr_t last = depth + (uint32_t)(w->end - w->row) * pitch;
    uint32_t tested = 0, key = w->key; /* modulo 2^32, as sums are: below 2^29.2 in rows that are drawn */
    int32_t written = 0;
    for (;;) {
        uint32_t left = w->sum[0], right = w->sum[1];
        while (depth != end) {
            uint32_t span, step, down, by;
            zs_two(w->side, 0, &span, &step);
            const uint32_t x0 = left / span; /* 1 .. 2 ZS_TINY_SIDE; span is 256 .. 2^22 */
            left += step;
            zs_two(w->side, 2, &span, &step);
            const uint32_t x1 = right / span;
            right += step;
            if (x0 < x1) {
                tested += x1 - x0;
                written += pixels((uint16_t *)depth + x0, (uint16_t *)depth + x1, beside, key + w->gx * x0, w->gx, paint);
            }
            zs_two(w->side, 4, &down, &by);
            depth += down;
            key += by;
        }
        end = last;
        if (depth == end)
            break;
        w->sum[0] = left;
        w->sum[1] = right;
        const uint32_t turn = w->turn;
        w->side[2 * turn] = w->next[0];
        w->side[2 * turn + 1] = w->next[1];
        w->sum[turn] = w->next_sum;
    }
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

/* zs_plane_quotient of a key: most need 32 bits. |n| <= 2^46; shift: leading zeros of the area, which came out of rcp */
static inline int32_t gradient(int64_t n, uint32_t rcp, int32_t shift)
{
    const int32_t low = (int32_t)n;
    if (n != low)
        return zs_plane_quotient(n, rcp, shift, ZS_PLANE_KEY);
    const int32_t sign = low >> 31; /* |low| = (low ^ sign) - sign <= 2^31, q <= 2^26 */
    const uint32_t q = ((zs_umulh(((uint32_t)low ^ (uint32_t)sign) - (uint32_t)sign, rcp) >> (22 - shift)) + 1u) >> 1;
    return (int32_t)(q ^ (uint32_t)sign) - sign;
}

ZS_IN_ORDER int zs_small_draw(struct zs_job *job)
{
    struct zs_renderer *r = job->r;
    const struct zs_vertex *pool = r->vert;
    const uint16_t *v = job->tri->v;
    const struct zs_vertex *a = &pool[v[0]], *b = &pool[v[1]], *c = &pool[v[2]];
    const int32_t ax = a->x, ay = a->y, dx1 = b->x - ax, dx2 = c->x - ax, dy1 = b->y - ay, dy2 = c->y - ay;
    if (!zs_tiny(dx1, dx2, dy1, dy2)) /* |.| < 2^22, 0 <= dy */
        return 0;
    const int32_t area = dx1 * dy2 - dx2 * dy1; /* <= 2^29 */
    if (area < ZS_TINY_AREA)
        return 0;
    const uint32_t d = a->d, at = r->view.piece_base, key_a = at - d, key_b = at - b->d, key_c = at - c->d;
    const uint32_t shift_piece = r->view.piece_shift;
    if (((key_a ^ key_b) | (key_a ^ key_c)) >> shift_piece)
        return 0;
    /* below it they may reach B - 1 when rounded; all lie in the last piece: it has 2^19 or more */
    if (!(key_a >> shift_piece) && (key_a < KEY_SAFE || key_b < KEY_SAFE || key_c < KEY_SAFE))
        return 0;
    const int32_t column = ax >> ZS_SUBPX_BITS;
    if ((column < ZS_TINY_SIDE || column > job->width - ZS_TINY_SIDE) &&
        (zs_first_sample(ax + zs_min32(zs_min32(dx1, dx2), 0)) < 0 ||
         zs_first_sample(ax + zs_max32(zs_max32(dx1, dx2), 0)) > job->width))
        return 0;
    const int32_t last = zs_first_sample(ay + zs_max32(dy1, dy2)), row = zs_max32(zs_first_sample(ay), job->y0);
    const int32_t n = zs_min32(last, job->y1) - row;
    job->row_last = last;
    if (n <= 0)
        return 1;

    const int shift = zs_clz32((uint32_t)area); /* 2 .. 18 */
    const uint32_t rcp = zs_recip_inline((uint32_t)area << shift);
    const int32_t dv1 = (int32_t)(key_a - key_b), dv2 = (int32_t)(key_a - key_c); /* of one piece: |.| < 2^31 */
    const int32_t gx = gradient(zs_mul_ss(dv1, dy2) - zs_mul_ss(dv2, dy1), rcp, shift);
    const int32_t up = gradient(zs_mul_ss(dv1, dx2) - zs_mul_ss(dv2, dx1), rcp, shift);
    if (gx == ZS_TOO_STEEP || up == ZS_TOO_STEEP)
        return 0;
    struct walk w; /* |gx|, |up| <= 2^27; x is 2^14 .. 2^14.1, 0 <= off < 2^14: from is below 2^42.1 */
    const int32_t x = (ax & (ZS_SUBPX_ONE - 1)) + ZS_TINY_SIDE * ZS_SUBPX_ONE - ZS_SUBPX_HALF, off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - ay;
    const int64_t from = zs_mul_ss(gx, x) + zs_mul_ss(up, off) - 128; /* to column 0 and row, negative, a half added */
    r->stats.tris_setup++;
    w.key = d + 0x8000u + (uint32_t)(-from >> 8);
    w.gx = (uint32_t)gx;
    w.down[0] = (uint32_t)job->width * 2u;
    w.down[1] = 0u - (uint32_t)up;
    w.row = row;
    w.end = row + n;
    w.left = (uintptr_t)(intptr_t)((column - ZS_TINY_SIDE - 1) * 2);

    w.side[0] = (uint32_t)dy2 * ZS_SUBPX_ONE;
    w.side[1] = (uint32_t)dx2 * ZS_SUBPX_ONE;
    w.side[2] = (uint32_t)dy1 * ZS_SUBPX_ONE;
    w.side[3] = (uint32_t)dx1 * ZS_SUBPX_ONE;
    w.sum[0] = (uint32_t)(x * dy2 + off * dx2) + w.side[0] - 1u;
    w.sum[1] = (uint32_t)(x * dy1 + off * dx1) + w.side[2] - 1u;
    w.turn = dy1 < dy2;
    const int32_t mid_dx = w.turn ? dx1 : dx2, mid_dy = w.turn ? dy1 : dy2, dx = w.turn ? dx2 : dx1, dy = w.turn ? dy2 : dy1;
    w.mid = zs_max32(zs_min32(zs_first_sample(ay + mid_dy), w.end), row);
    if (w.mid < w.end) { /* x + mid_dx is 2^7 .. 2^15.1, its offset 0 .. to_dy: both products below 2^29.1 */
        const int32_t to_dx = dx - mid_dx, to_dy = dy - mid_dy; /* |.| < 2^15; 0 < to_dy < 2^14 */
        w.next[0] = (uint32_t)to_dy * ZS_SUBPX_ONE;
        w.next[1] = (uint32_t)to_dx * ZS_SUBPX_ONE;
        w.next_sum = (uint32_t)((x + mid_dx) * to_dy + (off + (w.mid - row) * ZS_SUBPX_ONE - mid_dy) * to_dx) + w.next[0] - 1u;
    }
    small_rows(job, &w);
    return 1;
}

#else

int zs_small_draw(struct zs_job *job) /* not called */
{
    (void)job;
    return 0;
}

#endif
