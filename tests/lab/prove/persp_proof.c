/* persp.c, persp.h, rows.h, less.c, depth_test.c: w of vertices, division by w, the loops over rows and pixels, depth
 * states.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "shade/persp.h"

#include "core/plane.h"

/* Two products of 33 and 23 bits, whose difference is below 2^55, as two's complement. */
/*@ assigns \result \from dv1, dv2, d[0..1];
    ensures bound: \result < 0x80000000000000 || \result > 0xff80000000000000; */
uint64_t zs_plane_numerator(uint64_t dv1, uint64_t dv2, const int32_t d[2]);
#include "core/depth_test.c"
#include "fast/less.c"
#include "shade/persp.c"

#define WIDTH 40 /* of the strip in which the loops run */
#define ROWS 20

static struct zs_renderer renderer;
static struct zs_job job;
static struct zs_shader shader;
static uint16_t depth_rows[ROWS * WIDTH + 1]; /* the loop's pointer stops at or beside the end; RAM goes on there */

static int octave;
static uint64_t any_inverse(const struct zs_view *view, uint32_t d)
{
    (void)view;
    (void)d;
    return any_u64(1, octave == 62 ? OCTAVE_LO(62) : OCTAVE_HI(octave));
}

/* PROVE vertex_w: inverses of 1 .. 2^62 by octave of the largest: every shift, sums and what is kept of them */
void vertex_w(void)
{
    static const struct zs_depth depth = { .inverse = any_inverse };
    static struct zs_vertex v[3];
    uint32_t w[3];
    renderer.view.depth = &depth;
    job.r = &renderer;
    for (int k = 0; k < 3; k++)
        job.v[k] = &v[k];
    for (int perspective = 0; perspective < 2; perspective++)
        for (octave = 0; octave <= 62; octave++) {
            renderer.view.perspective = (uint8_t)perspective;
            zs_persp_w(&job, w);
        }
}

/* PROVE over_w: every sum of w's plane and of an attribute's, by octave of w: held, its reciprocal, the quotient below
 * 2^31 */
void over_w(void)
{
    const uint32_t sum = any_u32(0, UINT32_MAX);
    ASSERT(zs_persp_held(sum) >= 1);
    for (int k = 0; k < 32; k++) {
        job.w.base = any_u32((uint32_t)OCTAVE_LO(k), (uint32_t)OCTAVE_HI(k));
        job.w.gx = job.w.gy = 0;
        uint32_t w;
        int32_t lz;
        const uint32_t rcp = zs_persp_rcp(&job, any_i32(0, 4095), any_i32(0, 4095), &w, &lz);
        ASSERT(w >= 1 && lz >= 0 && lz <= 31);
        ASSERT(zs_persp_over(any_u32(0, UINT32_MAX), w, rcp, lz) <= 0x7fffffff);
    }
}

static void a_run(struct zs_job *j, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)j;
    ASSERT(from >= row->i0 && from <= row->i1 && to >= row->i0 && to <= row->i1);
}

/* state -1: of fast/less.c; 0: none; 1: any */
static void runs_of(int state)
{
    static struct zs_depth_state any;
    any.func = (uint8_t)any_u32(0, ZS_DEPTH_ALWAYS);
    any.read_only = (uint8_t)any_u32(0, 255);
    job.depth_state = state > 0 ? &any : 0;
    job.bias = any_i32(-BIAS_MAX, BIAS_MAX);
    struct zs_row row;
    shader.run = a_run;
    job.r = &renderer;
    job.shader = &shader;
    job.depth = depth_rows;
    renderer.view.key_top = any_u32(0xff0000u, 0xffff0000u);
    for (int k = 0; k < ROWS * WIDTH; k++)
        depth_rows[k] = (uint16_t)any_u32(0, 65535);
    for (int saturates = 0; saturates < 2; saturates++)
        for (int n = 1; n <= 6; n++)
            for (int k = 0; k < 9; k++) {
                const int32_t i0 = k < 8 ? 4 * k : WIDTH - n;
                job.saturates = (uint8_t)saturates;
                row.y = ROWS - 1;
                row.at = (ROWS - 1) * WIDTH;
                row.i0 = i0;
                row.i1 = i0 + n;
                if (state < 0)
                    zs_fast_less(&job, &row, i0, i0 + n, any_u32(0, UINT32_MAX), any_u32(0, UINT32_MAX));
                else
                    zs_rows_test(&job, &row, i0, i0 + n, any_u32(0, UINT32_MAX), any_u32(0, UINT32_MAX));
            }
}

/* PROVE runs -eva-min-loop-unroll=12 -eva-slevel=1000: every piece of up to 6 pixels at nine places in a row of 40, any
 * keys drawn and met, clamped or not: what is read and written lies within the piece, and so do runs */
void runs(void)
{
    runs_of(-1);
}

/* PROVE tests -eva-min-loop-unroll=12 -eva-slevel=1000: the same pieces by the core's test, with a depth state, any,
 * and without: the same */
void tests(void)
{
    runs_of(0);
    runs_of(1);
}

static uint32_t any_key(const struct zs_view *view, uint32_t d)
{
    (void)view;
    (void)d;
    return any_u32(0, UINT32_MAX);
}

/* PROVE biases -eva-use-spec=zs_plane_numerator: every offset, slope, depth and difference of corners below 2^22, areas
 * below 2^46 by octave: at most BIAS_MAX either way. Taken as given: numerators, sums of products modulo 2^64 */
void biases(void)
{
    static struct zs_depth depth;
    static struct zs_depth_state state;
    static struct zs_vertex v[3];
    const int32_t most = ((int32_t)1 << ZS_EXTENT_BITS) - 1;
    renderer.view.depth = &depth;
    job.r = &renderer;
    job.depth_state = &state;
    state.bias = (int16_t)any_i32(-32768, 32767);
    state.slope_bias = (int16_t)any_i32(-32768, 32767);
    for (int k = 0; k < 3; k++) {
        v[k].d = any_u32(0, UINT32_MAX);
        job.v[k] = &v[k];
    }
    job.geom.dx1 = any_i32(-most, most);
    job.geom.dx2 = any_i32(-most, most);
    job.geom.dy1 = any_i32(0, most);
    job.geom.dy2 = any_i32(0, most);
    for (int by_key = 0; by_key < 2; by_key++)
        for (int k = 0; k < 46; k++) {
            depth.key = by_key ? any_key : 0;
            job.geom.area = any_i64((int64_t)OCTAVE_LO(k), (int64_t)OCTAVE_HI(k));
            const int32_t bias = zs_depth_state_bias(&job);
            ASSERT(bias >= -BIAS_MAX && bias <= BIAS_MAX);
        }
}

#include "any_walks.h"

static void a_span(struct zs_job *j, const struct zs_row *row)
{
    ASSERT(row->i0 >= 0 && row->i1 <= j->width);
    ASSERT(row->y >= j->y0 && row->y < j->y1);
    ASSERT(row->at >= 0 && row->at <= (ROWS - 1) * j->width);
}

static void walks_of(int wide)
{
    job.key.gx = any_u32(0, UINT32_MAX);
    job.key.gy = any_u32(0, UINT32_MAX);
    job.key.base = any_u32(0, UINT32_MAX);
    any_walks(a_span, wide);
}

/* PROVE rows -eva-min-loop-unroll=24 -eva-slevel=8: strips of 20 rows of 1 and of 4096 columns, triangles of 1, 16 and
 * up to 20 rows from the first, the fourth and the last on, any columns: what spans are given lies within the strip */
void rows(void)
{
    walks_of(0);
}

/* PROVE wide_rows -eva-min-loop-unroll=24 -eva-slevel=8: the same with sums of 64 bits, any */
void wide_rows(void)
{
    job.w64.gx = any_u64(0, UINT64_MAX);
    job.w64.gy = any_u64(0, UINT64_MAX);
    job.w64.base = any_u64(0, UINT64_MAX);
    walks_of(1);
}
