/* float.c's rows across more than two octaves: what pieces, rows and their loop are given.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "core/rows.h"

/* That piece and step fit: float_pieces (depth_float_proof.c). */
/*@ requires piece: 1 <= n && row->i0 <= i && i + n <= row->i1;
    requires octave: 1 <= down <= job->w64_scale;
    assigns \nothing; */
static ZS_NOINLINE void float_piece(struct zs_job *job, const struct zs_row *row, uint64_t w, int32_t down, int32_t i,
                                    int32_t n);
/* Shown by float_bisections for n of 2 and more. Given: it is not asked of a row's last pixel, which has the
 * octave that the row's end has. The numbers are those of crossings. */
/*@ assigns \result \from w, gx, n, down, last;
    ensures some: \result == 1 || \result == 2 || \result == 3 || \result == 4;
    ensures fewer: \result < n; */
static ZS_NOINLINE int32_t pixels_within(uint64_t w, uint64_t gx, int32_t n, int32_t down, int32_t last);
/*@ requires octave: 1 <= down_end <= job->w64_scale;
    assigns \nothing; */
static ZS_NOINLINE void crossing_row(struct zs_job *job, const struct zs_row *row, uint64_t w, int32_t down_end);
/*@ requires columns: 0 <= row->i0 && row->i1 <= job->width;
    requires rows: job->y0 <= row->y < job->y1 && 0 <= row->at <= (job->y1 - 1 - job->y0) * job->pitch;
    assigns \nothing; */
static ZS_NOINLINE void float_row(struct zs_job *job, const struct zs_row *row, uint64_t w);
/*@ requires in_strip: 0 <= row->i0 && row->i1 <= job->width;
    requires of_rows: job->y0 <= row->y < job->y1 && 0 <= row->at <= (job->y1 - 1 - job->y0) * job->pitch;
    assigns \nothing; */
static inline void pair_span(struct zs_job *job, const struct zs_row *row);
#include "depth/float.c"

#define ROWS 20

static struct zs_renderer renderer;
static struct zs_job job;

/* PROVE float_crossings -eva-use-spec=float_piece,pixels_within: rows of 1 .. 5 pixels, any w and step, the
 * nearest vertex in every octave, any octave at the end: pieces lie in the row, of 1 pixel and more; that
 * pixels_within is not asked of a row's last pixel is taken as given */
void float_crossings(void)
{
    for (int32_t last = 1; last <= 31; last++)
        for (int32_t n = 1; n <= 5; n++) {
            const struct zs_row row = { 0, 0, 0, -5, 4096, 4090 - n, 4090, 0 };
            job.w64_scale = last;
            job.w64.gx = any_u64(0, UINT64_MAX);
            crossing_row(&job, &row, any_u64(0, UINT64_MAX), any_i32(1, last));
        }
}

/* PROVE float_row_ends -eva-use-spec=float_piece,crossing_row: rows of 1, 2 and 4096 pixels, any w and step, the
 * nearest vertex in every octave: that w and its end lie in one octave where one piece is drawn is taken as given */
void float_row_ends(void)
{
    static const int32_t number[3] = { 1, 2, 4096 };
    for (int32_t last = 1; last <= 31; last++)
        for (int k = 0; k < 3; k++) {
            const struct zs_row row = { 0, 0, 0, -5, 4096, 4096 - number[k], 4096, 0 };
            job.width = job.pitch = 4096;
            job.y1 = 1;
            job.w64_scale = last;
            job.w64.gx = any_u64(0, UINT64_MAX);
            float_row(&job, &row, any_u64(0, UINT64_MAX));
        }
}

#include "any_walks.h"

static void a_span(struct zs_job *j, const struct zs_row *row)
{
    any_row(j, row);
}

/* PROVE float_walks -eva-use-spec=float_row,pair_span -eva-min-loop-unroll=24 -eva-slevel=8: strips of 20 rows
 * of 1 and of 4096 columns, triangles of 1, 16 and up to 20 rows from the first, the fourth and the last on, any
 * columns, planes and anchors: what rows are given lies within the strip */
void float_walks(void)
{
    job.w64.gx = any_u64(0, UINT64_MAX);
    job.w64.gy = any_u64(0, UINT64_MAX);
    job.w64.base = any_u64(0, UINT64_MAX);
    job.two_octaves = (uint8_t)any_u32(0, 1);
    any_walks(a_span, 1);
}
