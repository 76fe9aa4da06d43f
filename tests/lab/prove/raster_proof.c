/* edges.c, those of the core and of fast/.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "core/edges.c"
#include "fast/fast_edges.c"

#define COORD_LO (-ZS_GUARD_SUBPX - 1)
#define COORD_HI (ZS_GUARD_SUBPX + 1 + ZS_SIZE_MAX * ZS_SUBPX_HALF)

/* PROVE edge_below_first_row: fractions of 8 bits, every dy below 2^22 by octave, 0 <= off, rem <= dy */
void edge_below_first_row(void)
{
    for (int k = 0; k < ZS_EXTENT_BITS; k++) {
        const int32_t most = (int32_t)OCTAVE_HI(k);
        const int32_t n = edge_below(any_i32(0, 255), any_i32((int32_t)OCTAVE_LO(k), most), any_i32(0, most),
                                     any_i32(0, most));
        ASSERT(n >= 0 && n <= 1 << (k > 6 ? k - 5 : 1));
    }
}

static void edges_of(int32_t lo, int32_t hi)
{
    static const int32_t at[3] = { COORD_LO, 0, COORD_HI };
    int16_t out[2 * ZS_CUT_ROWS];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < ZS_EXTENT_BITS; k++) {
            const int32_t dy = any_i32((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k));
            const struct zs_vertex a = { at[i], at[i], 0 }, b = { at[i] + any_i32(lo, hi), at[i] + dy, 0 };
            const int32_t first = zs_first_sample(at[i]);
            for (int32_t n = 1; n <= ZS_CUT_ROWS; n += ZS_CUT_ROWS - 1)
                edge_columns(out, n, &a, &b, first + any_i32(0, (int32_t)(OCTAVE_HI(k) >> ZS_SUBPX_BITS)));
        }
}

/* PROVE edges -eva-min-loop-unroll=17: |dx| < 2^22, every dy below 2^22 by octave, the upper end at
 * both ends of its range and at 0, 1 and 16 rows by their distance from it, 0 .. dy and up to a sample more; remainders
 * below their divisors: taken as given */
void edges(void)
{
    const int32_t most = ((int32_t)1 << ZS_EXTENT_BITS) - 1;
    edges_of(-most, most);
}

/* PROVE tiny_edges -eva-min-loop-unroll=17: every triangle of up to 2^14 sub-pixels each way, its top corner at both
 * ends of its range and at 0, rows from its first, 17th, 49th and 65th on, 1, 2, 15 and 16 of them, the middle corner
 * above all, below one, below all; on either side; that no row lies beside a level edge: taken as given */
void tiny_edges(void)
{
    static const int32_t at[3] = { COORD_LO, 0, COORD_HI };
    static const int32_t from[4] = { 0, 16, 48, 64 }, number[4] = { 1, 2, 15, 16 };
    static struct zs_job job;
    static struct zs_vertex a;
    job.v[0] = &a;
    for (int i = 0; i < 96; i++)
        for (int mid = 0; mid < 3; mid++) {
            const int32_t n = number[i & 3], row = zs_first_sample(at[i >> 5]) + from[i >> 2 & 3];
            a.x = a.y = at[i >> 5];
            job.mid_right = (uint8_t)(i >> 4 & 1);
            job.row_mid = row + (mid == 2 ? n : mid);
            job.cut_end = row + n;
            job.geom.tiny = 1;
            for (int k = 0; k < 2; k++) {
                job.geom.dx[k] = any_i32(-ZS_TINY, ZS_TINY);
                job.geom.dy[k] = any_i32(0, ZS_TINY);
            }
            ASSERT(tiny_cuts(&job, row) == 1);
        }
}
