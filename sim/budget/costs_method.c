/* Counting where another method than the depth buffer removes hidden surfaces.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>

#include "core/job.h"
#include "costs_look.h"
#include "method/hiz.h"
#include "method/order.h"
#include "method/raycast.h"
#include "zs_blend.h"
#include "zs_method.h"

int sim_look_is(const struct zs_method *method)
{
    return sim_now.method_of == method;
}

static int is_order(void)
{
    return sim_look_is(&zs_method_depthsort) || sim_look_is(&zs_method_coverage);
}

int sim_look_is_hiz(void)
{
    return sim_look_is(&zs_method_hiz) || sim_look_is(&zs_method_hiz_corner) || sim_look_is(&zs_method_hiz_vertex);
}

/* Words of a row of coverage's bits, of columns [i0, i1), where pixels are to be drawn: others cost next to nothing. */
static void count_words(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1)
{
    const struct zs_order *o = job->r->method_state;
    if (!o->bits || !zs_order_clip(job, row->y, &i0, &i1))
        return;
    const uint32_t *const bits = o->bits + (row->y - o->y0) * o->words;
    const int32_t end = i1 - o->x0;
    for (int32_t at = i0 - o->x0; at < end; at = (at | 31) + 1) {
        const uint32_t left = ~bits[at >> 5] >> (at & 31);
        const int32_t n = end - at < 32 - (at & 31) ? end - at : 32 - (at & 31);
        sim_now.n[SIM_COST_word_covered] += (left & UINT32_MAX >> (32 - n)) != 0;
    }
}

/* A row of a triangle, or a piece of one, before the method has chosen pixels of it. */
static void on_method_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                           uint32_t gx)
{
    if (!sim_look_is_hiz() && (job->tri != sim_now.method_tri || row->y < sim_now.method_row)) { /* hiz: by on_planes */
        sim_look_setup(job, 0);
    }
    sim_now.method_tri = job->tri;
    sim_now.method_row = row->y;
    if (sim_look_is(&zs_method_painter))
        sim_now.n[SIM_COST_span_painter]++;
    else if (sim_look_is_hiz())
        sim_now.n[SIM_COST_span_tiles]++;
    else if (sim_look_is(&zs_method_raycast)) {
        sim_now.n[SIM_COST_span_ray]++;
        sim_now.n[SIM_COST_px_ray] += i1 - i0;
    } else {
        const int near_first = sim_look_is(&zs_method_coverage);
        sim_now.n[near_first ? SIM_COST_span_covered : SIM_COST_span_sorted]++;
        if (near_first)
            count_words(job, row, i0, i1);
    }
    sim_now.method_span(job, row, i0, i1, sum, gx);
}

/* The method says no to mappings by their address. */
static int on_method_begin(struct zs_renderer *r)
{
    r->config.depth = sim_now.of;
    const int err = sim_now.method_of->begin(r);
    r->config.depth = &sim_now.depth;
    sim_now.method_span = r->span;
    r->span = on_method_span;
    return err;
}

/* What the method's own state has counted since the last time. */
static void count_state(struct zs_renderer *r)
{
    if (is_order()) {
        struct zs_order *o = r->method_state;
        sim_now.n[SIM_COST_pair_boxes] += o->pair_boxes;
        sim_now.n[SIM_COST_pair_row] += o->pair_rows;
        o->pair_boxes = o->pair_rows = 0;
    } else if (sim_look_is(&zs_method_raycast)) {
        struct zs_rays *s = r->method_state;
        const struct zs_ray_counts *const c = &s->counted;
        sim_now.n[SIM_COST_ray_box] += c->boxes;
        sim_now.n[SIM_COST_ray_tri] += c->boxed;
        sim_now.n[SIM_COST_ray_side] += c->sides;
        sim_now.n[SIM_COST_ray_plane] += c->aims;
        sim_now.n[SIM_COST_plane_wide] += c->wide;
        sim_now.n[SIM_COST_ray_piece] += c->pieces;
        s->counted = (struct zs_ray_counts){ 0 };
    } else if (sim_look_is_hiz()) {
        const struct zs_hiz *h = r->method_state;
        sim_now.n[SIM_COST_tile_row] += h->rows * h->columns[0];
    }
}

static uint16_t on_method_list(struct zs_renderer *r)
{
    const uint16_t list = sim_now.method_of->list(r);
    if (r->method_state) /* not where a strip is left out */
        count_state(r);
    const double n = r->stats.sorted - sim_now.sorted;
    sim_now.method_tri = NULL;
    sim_now.sorted = r->stats.sorted;
    if (n > 1.0)
        sim_now.n[SIM_COST_sorted_log] += n * log2(n);
    return list;
}

static uint16_t on_layers_list(struct zs_renderer *r)
{
    const uint16_t list = zs_method_transparent.list(r);
    const double n = r->stats.sorted - sim_now.sorted;
    sim_now.sorted = r->stats.sorted;
    if (n > 1.0)
        sim_now.n[SIM_COST_sorted_log] += n * log2(n);
    return list;
}

/* Of the depth mapping, for rays and for triangles that they have hit. */
static void on_ray_row(struct zs_job *job, const struct zs_row *row)
{
    sim_now.n[SIM_COST_ray_curved]++;
    sim_now.of->row(job, row);
}

void sim_look_method(struct zs_config *config)
{
    if (config->method == &zs_method_transparent) { /* the depth buffer's stages, and a sort */
        sim_now.method = *config->method;
        sim_now.method.list = on_layers_list;
        config->method = &sim_now.method;
    }
    if (!config->method || config->method == &sim_now.method)
        return;
    sim_now.method_of = config->method;
    sim_now.method = *config->method;
    sim_now.method.begin = on_method_begin;
    sim_now.method.list = on_method_list;
    config->method = &sim_now.method;
    if (sim_look_is_hiz()) /* set-ups are found by on_planes */
        return;
    sim_now.depth.planes = sim_now.of->planes;
    if (sim_now.of->row)
        sim_now.depth.row = on_ray_row;
}

void sim_look_count_method(void)
{
    const struct zs_stats *s = &sim_now.r->stats;
    double *n = sim_now.n;
    n[SIM_COST_sorted] = s->sorted;
    if (!sim_now.method_of)
        return;
    n[SIM_COST_pair] = s->pairs;
    n[SIM_COST_setup_order] = is_order() ? s->tris_setup : 0;
    n[SIM_COST_tile] = s->tiles_tested;
    n[SIM_COST_tile_triangle] = sim_look_is_hiz() ? s->tris_setup + s->tris_hidden : 0;
    n[SIM_COST_px_tile_hidden] = s->pixels_hidden;
    n[SIM_COST_tile_px_untested] = sim_look_is_hiz() ? s->pixels_untested : 0;
    n[SIM_COST_ray] = s->rays;
}
