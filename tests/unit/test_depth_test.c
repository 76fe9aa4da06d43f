/* The depth test (core/depth_test.c): which pixels win, what is written, and the runs that shaders are handed; what
 * takes its place where there is no state (fast/less.c, fast/fast_solid.c); a state's bias.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/rows.h"
#include "zs_fast.h"
#include "zs_shader.h"

#define W 48
#define PAINT 0x4711u

/* ---- A row and a shader that notes its runs -------------------------------------------------- */

static uint16_t depth[2 * W], color[2 * W]; /* two rows of a strip; the second is tested */
static int32_t run[W][2];
static uint32_t n_runs;

static void note(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    for (int32_t i = from; i < to; i++)
        job->color[row->at + i] = PAINT;
    if (n_runs < W) {
        run[n_runs][0] = from;
        run[n_runs][1] = to;
    }
    n_runs++;
}

static const struct zs_shader shader = { .run = note };
static struct zs_renderer r;
static const struct zs_tri tri = { .paint = PAINT };

struct piece {
    struct zs_job job;
    struct zs_row row;
    struct zs_depth_state state;
    int32_t i0, i1;
    uint32_t sum, step, top;
    uint16_t depth[2 * W]; /* before */
};

/* A piece of a row whose keys lie around those that are there. */
static void piece_any(struct prng *p, struct piece *c, int with_state)
{
    const int bits = prng_range(p, 8, 16);
    memset(c, 0, sizeof *c);
    c->top = (1u << bits) - 2u;
    r.view.key_top = ((1u << bits) - 1u) << 16;
    c->i0 = prng_range(p, 0, W - 1);
    c->i1 = prng_range(p, c->i0, W);
    const uint32_t n = (uint32_t)(c->i1 - c->i0) + 1u, slope = 1u << prng_pick(p, 29);
    const uint64_t most = prng_pick(p, 3) ? ((uint64_t)c->top + 1u) << 16 : ((uint64_t)c->top << 16) + 0x1ffffu;
    const uint64_t from = prng_pick(p, 4) ? prng_next(p) % most : most - 1u - prng_pick(p, 0x40000);
    uint64_t to = prng_pick(p, 4) ? from + prng_pick(p, slope) : prng_next(p) % most;
    to = to >= most ? most - 1u : to;
    c->step = (uint32_t)(((int64_t)to - (int64_t)from) / (int64_t)n); /* all sums are in [0, 2^32) */
    c->sum = (uint32_t)from;
    c->row.at = W;
    c->row.i0 = c->row.x0 = c->i0;
    c->row.i1 = c->row.x1 = c->i1;
    c->state = (struct zs_depth_state){ .func = (uint8_t)prng_pick(p, 3), .read_only = (uint8_t)prng_pick(p, 2) };
    c->job.r = &r;
    c->job.shader = &shader;
    c->job.tri = &tri;
    c->job.width = W;
    c->job.depth_state = with_state ? &c->state : NULL;
    c->job.bias = prng_pick(p, 3) ? prng_range(p, -3, 3) : prng_range(p, -65536, 65536);
    c->job.saturates = 1;
    for (int32_t i = 0; i < 2 * W; i++) {
        const int32_t at = i - W - c->i0;
        const int64_t key = (c->sum + (uint32_t)at * c->step) >> 16;
        int64_t there = key + (with_state ? c->job.bias : 0) + prng_range(p, -1, 1);
        if (prng_pick(p, 4) == 0)
            there = prng_pick(p, c->top + 1u);
        there = there < 0 ? 0 : there > c->top ? c->top : there;
        c->depth[i] = (uint16_t)(prng_pick(p, 5) == 0 ? ZS_DEPTH_CLEAR : there);
    }
}

/* ---- Pixel by pixel -------------------------------------------------------------------------- */

/* Does pixel i win, and with which key? */
static int model(const struct piece *c, int32_t i, uint16_t *key)
{
    int64_t k = (c->sum + (uint32_t)(i - c->i0) * c->step) >> 16;
    const int64_t there = c->depth[W + i];
    k = k > c->top ? c->top : k;
    if (c->job.depth_state) {
        k += c->job.bias;
        k = k < 0 ? 0 : k > c->top ? c->top : k;
    }
    *key = (uint16_t)k;
    return k < there || (c->job.depth_state && c->state.func &&
                         (k == there || c->state.func == ZS_DEPTH_ALWAYS));
}

static uint32_t won, lost, ties, held, longest;

/* Draw it by one way, and compare pixels, runs and counts. solid: the way has a loop of its own and calls no shader. */
static int piece_right(struct piece *c, zs_piece_fn *way, int solid, const char *name)
{
    uint32_t n = 0, n_model = 0;
    memcpy(depth, c->depth, sizeof depth);
    memset(color, 0, sizeof color);
    c->job.depth = depth;
    c->job.color = color;
    n_runs = 0;
    r.stats.pixels_written = 0;
    if (c->i0 < c->i1)
        way(&c->job, &c->row, c->i0, c->i1, c->sum, c->step);
    for (int32_t i = -W; i < W; i++) {
        uint16_t key = 0;
        const int in = i >= c->i0 && i < c->i1, wins = in && model(c, i, &key);
        const uint16_t want = wins && !(c->job.depth_state && c->state.read_only) ? key : c->depth[W + i];
        if (depth[W + i] != want || color[W + i] != (wins ? PAINT : 0))
            return case_wrong("%s: pixel %d of [%d, %d): key %u, not %u, %s", name, i, c->i0, c->i1, depth[W + i], want,
                              wins ? "wins" : "does not win");
        if (!in)
            continue;
        n_model += (uint32_t)wins;
        ties += key == c->depth[W + i];
        held += (c->sum + (uint32_t)(i - c->i0) * c->step) >> 16 > c->top;
    }
    CASE_CHECK(r.stats.pixels_written == n_model);
    won += n_model;
    lost += (uint32_t)(c->i1 - c->i0) - n_model;
    CASE_CHECK(!solid || n_runs == 0);
    for (uint32_t k = 0; k < n_runs && !solid; k++) { /* as long as can be, left to right, of nothing else */
        uint16_t any;
        const int32_t from = run[k][0], to = run[k][1];
        CASE_CHECK(from < to && from >= c->i0 && to <= c->i1 && (k == 0 || from > run[k - 1][1]));
        CASE_CHECK((from == c->i0 || !model(c, from - 1, &any)) && (to == c->i1 || !model(c, to, &any)));
        n += (uint32_t)(to - from);
        longest = (uint32_t)(to - from) > longest ? (uint32_t)(to - from) : longest;
    }
    CASE_CHECK(solid || n == n_model);
    return 1;
}

static int state_case(uint64_t seed)
{
    struct prng p = { seed };
    struct piece c;
    piece_any(&p, &c, 1);
    return piece_right(&c, zs_rows_test, 0, "with a state");
}

static int plain_case(uint64_t seed)
{
    static const struct {
        const struct zs_fast *fast;
        int solid;
    } others[] = { { &zs_fast_smooth, 0 }, { &zs_fast_texture, 0 }, { &zs_fast_raw, 1 }, { &zs_fast_flat, 1 } };
    struct prng p = { seed };
    struct piece c;
    piece_any(&p, &c, 0);
    if (!piece_right(&c, zs_rows_test, 0, "core/depth_test.c"))
        return 0;
    for (size_t k = 0; k < sizeof others / sizeof others[0] && c.i0 < c.i1; k++) {
        const uint32_t last = c.sum + (uint32_t)(c.i1 - 1 - c.i0) * c.step;
        const uint32_t most = last > c.sum ? last : c.sum;
        for (int any = 0; any < 2; any++) {
            c.job.saturates = !any;
            if (any && most >> 16 > c.top)
                continue; /* it has been said that none saturates */
            if (!piece_right(&c, others[k].fast->span, others[k].solid, "an accelerator"))
                return 0;
        }
    }
    return 1;
}

static void counts_begin(void)
{
    won = lost = ties = held = longest = 0;
}

static void counts_end(void)
{
    print_message("%u pixels won, %u lost, %u ties, %u keys held at the top, runs up to %u\n", won, lost, ties, held,
                  longest);
    assert_true(!cases_all() || (won > 100000 && lost > 100000 && ties > 10000 && held > 1000 && longest > 10));
}

static void pixels_under_any_state(void **state)
{
    counts_begin();
    CASES(state_case, 40000);
    counts_end();
}

static void nearer_wins_without(void **state)
{
    counts_begin();
    CASES(plain_case, 40000);
    counts_end();
}

/* ---- Bias ------------------------------------------------------------------------------------ */

static uint32_t at_an_end, sloped;

/* Offset and slope times the larger gradient, rounded to whole buckets, halves up. */
static int bias_case(uint64_t seed)
{
    static struct zs_renderer renderer;
    static const struct zs_depth mapping = { .key = NULL };
    struct prng p = { seed };
    struct zs_job job;
    struct zs_vertex v[3];
    const int32_t reach = 16 << prng_pick(&p, 17);
    const uint32_t keys = 1u + (uint32_t)(prng_next(&p) >> 32 >> prng_pick(&p, 32));
    const int16_t offset = (int16_t)(prng_next(&p) >> 48);
    const struct zs_depth_state s = { .bias = offset,
                                      .slope_bias = (int16_t)(prng_pick(&p, 8) ? prng_next(&p) >> 48 : 0) };
    memset(&job, 0, sizeof job);
    for (int k = 0; k < 3; k++)
        v[k] = (struct zs_vertex){ prng_range(&p, -reach, reach), prng_range(&p, -reach, reach), prng_pick(&p, keys) };
    renderer.view.depth = &mapping;
    job.r = &renderer;
    job.depth_state = &s;
    for (int k = 0; k < 3; k++)
        job.v[k] = &v[k];
    job.geom.dx1 = v[1].x - v[0].x;
    job.geom.dx2 = v[2].x - v[0].x;
    job.geom.dy1 = v[1].y - v[0].y;
    job.geom.dy2 = v[2].y - v[0].y;
    const int64_t area = (int64_t)job.geom.dx1 * job.geom.dy2 - (int64_t)job.geom.dx2 * job.geom.dy1;
    if (area <= 0)
        return 1;
    job.geom.area = area;
    const int64_t d1 = (int64_t)v[1].d - v[0].d, d2 = (int64_t)v[2].d - v[0].d;
    __int128 most = 0;
    const __int128 n[2] = { (__int128)d1 * job.geom.dy2 - (__int128)d2 * job.geom.dy1,
                            (__int128)d2 * job.geom.dx1 - (__int128)d1 * job.geom.dx2 };
    for (int k = 0; k < 2; k++) {
        const __int128 g = (n[k] < 0 ? -n[k] : n[k]) * 256 / area; /* 2^-16 buckets a pixel, cut */
        most = g > most ? g : most;
    }
    const __int128 slope = (s.slope_bias * most + (1 << 23)) >> 24;
    __int128 want = s.bias + slope;
    want = want > 65536 ? 65536 : want < -65536 ? -65536 : want;
    const int32_t got = zs_depth_state_bias(&job);
    at_an_end += got == 65536 || got == -65536;
    sloped += got != s.bias;
    return got == want ? 1 : case_wrong("bias %d, not %d: offset %d, slope %d", got, (int)want, s.bias, s.slope_bias);
}

static void bias_is_offset_and_slope(void **state)
{
    at_an_end = sloped = 0;
    CASES(bias_case, 40000);
    print_message("bias: %u at an end, %u with a slope\n", at_an_end, sloped);
    assert_true(!cases_all() || (at_an_end > 1000 && sloped - at_an_end > 1000));
}

static const struct CMUnitTest tests[] = { cmocka_unit_test(pixels_under_any_state),
                                           cmocka_unit_test(nearer_wins_without),
                                           cmocka_unit_test(bias_is_offset_and_slope) };

CASES_MAIN(tests)
