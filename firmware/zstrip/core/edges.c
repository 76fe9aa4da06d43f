/* Edges: the columns at which they cross the scanlines of a triangle.
 *
 * Scanline j is sampled at Y = 256 j + 128. Its span is [first sample at or right of the left edge,
 * first sample at or right of the right edge): a sample on a left edge is inside, one on a right
 * edge outside. The rows are those from the first sample at or below the top vertex up to, but not
 * including, the first at or below the bottom vertex: a sample level with the top is inside, one
 * level with the bottom outside. Together that is the top-left rule. Two triangles that share an
 * edge compute the same columns for it.
 *
 * For an edge from (xa, ya) to (xb, yb), dy > 0, sample i is at or right of it if
 *   256 dy i >= (xa - 128) dy + (Y - ya) dx
 * So the column is the right-hand side divided by 256 dy, rounded up. It is stepped from row to row
 * as a quotient and a remainder.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/edges.h"
#include "core/fx.h"

#define EDGE32_MAX (1 << 15) /* sub-pixels: for an edge with dy below this, 32 bits suffice */

/* Return (fraction * dy + off * rem) / span, for an edge that is entered below its first row. Not
 * inlined, because that is rare. At most 2^14; rounded down, or one less. */
static ZS_NOINLINE int32_t edge_below(int32_t fraction, int32_t dy, int32_t off, int32_t rem)
{
    if (ZS_FOR_SIZE)
        return (int32_t)((zs_mul_ss(fraction, dy) + zs_mul_ss(off, rem)) / (dy * ZS_SUBPX_ONE));
    if (dy < EDGE32_MAX)
        return (fraction * dy + off * rem) / (dy * ZS_SUBPX_ONE); /* < 2^23 + 2^30 */
    /* n < 2^44.1, and the divisor is 2^23 or more. Both are shifted down until n has 32 bits. The
     * quotient is at most 2^14, so the divisor keeps 17 bits or more, and the result is too small
     * by at most one, which the caller adds. */
    const uint64_t n = zs_mul_uu((uint32_t)fraction, (uint32_t)dy) +
                       zs_mul_uu((uint32_t)off, (uint32_t)rem);
    const int32_t down = zs_max32(32 - zs_clz64(n | 1u), 0);
    return (int32_t)((uint32_t)(n >> down) / (((uint32_t)dy * ZS_SUBPX_ONE >> down) + 1u));
}

/* Find the columns of the edge that runs down from a to b, in n > 0 rows from `row` on, into
 * out[0], out[2], ... All rows lie between a and b.
 *
 * With dx = q dy + rem, the right-hand side above divided by 256 dy is
 *   (lead + off q) / 256 + off rem / (256 dy)
 * where lead = xa - 128 and off = Y - ya. In the edge's first row, off rem / (256 dy) < 1. */
static ZS_NOINLINE void edge_columns(int16_t *out, int32_t n, const struct zs_vertex *a,
                                     const struct zs_vertex *b, int32_t row)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y; /* |dx|, dy < 2^22 */
    int32_t q = dx < 0 ? -1 : 0;
    if (ZS_FOR_SIZE || (uint32_t)(dx + dy) > (uint32_t)dy * 2u) { /* not steep: |dx| > dy */
        q = dx / dy;
        q -= dx < q * dy;
    }
    int32_t rem = dx - q * dy; /* [0, dy] */
    ZS_FACT(rem >= 0 && rem <= dy);
    const int32_t off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y; /* 0 <= off <= dy */
    const int32_t at = a->x - ZS_SUBPX_HALF + off * q;             /* < 2^24 */
    int32_t i = at >> ZS_SUBPX_BITS, fraction = at & (ZS_SUBPX_ONE - 1);
    /* modulo 2^32 */
    uint32_t rest = zs_wrap_mul((uint32_t)fraction, dy) + zs_wrap_mul((uint32_t)off, rem);
    const int32_t span = dy * ZS_SUBPX_ONE;           /* < 2^30 */
    if (off >= ZS_SUBPX_ONE) {
        const int32_t k = edge_below(fraction, dy, off, rem);
        rest -= zs_wrap_mul((uint32_t)k, span);
        i += k;
    }
    ZS_FACT(rest < (uint32_t)span * 2u);
    int32_t e = -(int32_t)rest; /* (-2 span, 0]; becomes [0, span) */
    for (; e < 0; e += span)
        i++;
    *out = (int16_t)i; /* |.| <= 2^14 + 1 in rows of the triangle; e: i is too large by e / span */
    rem *= ZS_SUBPX_ONE;
    for (int16_t *const end = out + 2 * n; (out += 2) != end; *out = (int16_t)i) {
        i += q;
        e -= rem;
        if (e < 0) {
            e += span;
            i++;
        }
        ZS_FACT(e >= 0 && e < span);
    }
}

void zs_edges_columns(struct zs_job *job, int32_t row)
{
    const int32_t mid_right = job->mid_right, end = job->cut_end;
    const struct zs_vertex *mid = job->v[2 - mid_right];
    int16_t *piece = mid_right ? &job->cut[0].x1 : &job->cut[0].x0;
    edge_columns(mid_right ? &job->cut[0].x0 : &job->cut[0].x1, end - row, job->v[0],
                 job->v[1 + mid_right], row);
    const int32_t upper = zs_min32(job->row_mid, end) - row; /* rows above the middle vertex */
    if (upper > 0) {
        edge_columns(piece, upper, job->v[0], mid, row);
        piece += 2 * upper;
        row += upper;
    }
    if (row < end)
        edge_columns(piece, end - row, mid, job->v[1 + mid_right], row);
}
