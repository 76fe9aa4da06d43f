/* Windows: where the pass after them is seen.
 *
 * The keys of the pass with the windows are the mask. Before it is drawn, pixels on which nothing
 * is drawn get the largest key but one. A window that passes the depth test writes ZS_DEPTH_CLEAR,
 * which no surface writes. When the next pass begins, pixels with that key get its background, and
 * all others the key 0, below which no key lies. So the pass is drawn by the usual test, and each
 * pixel of the mask is exact.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/raster.h"
#include "core/rows.h"
#include "zs_environment.h"
#include "zs_shader.h"

/* As zs_rows_test with ZS_DEPTH_LESS_EQUAL. */
static void window_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    const int32_t top = (int32_t)(job->r->view.key_top >> 16) - 1;
    const int32_t bias = job->depth_state ? job->bias : 0, most = top + zs_min32(bias, 0);
    uint16_t *const line = job->depth + row->at;
    const struct zs_pass_memory *const passes = job->r->passes ? job->r->pass_memory : 0;
    const int32_t least = passes && passes->pass[passes->now].mask; /* 0: beside the mask */
    for (int32_t i = i0; i < i1; i++, sum += step)
        if (zs_max32(zs_min32((int32_t)(sum >> 16) + bias, most), least) <= line[i]) {
            line[i] = ZS_DEPTH_CLEAR;
            zs_rows_written(job, 1);
        }
}

/* Methods other than the depth buffer call this. */
static void window_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)job;
    (void)row;
    (void)from;
    (void)to;
}

/* A window's key is farther than what it hides: bounds of keys (method/hiz.c) do not hold. */
static int window_check(const struct zs_instance *in, const struct zs_config *config)
{
    (void)in;
    return config->method->passes || config->depth->span ? ZS_OK : ZS_ERR_DEPTH;
}

const struct zs_shader zs_shade_window = { .run = window_run,
                                           .span = window_span,
                                           .check = window_check };

static int mask_check(const struct zs_renderer *r, const struct zs_pass *pass,
                      const struct zs_pass_memory *memory, uint32_t number)
{
    const struct zs_scene *const scene = pass->scene;
    const struct zs_view *const view = &memory->view, *const before = &memory[number ? -1 : 0].view;
    if (number == 0 || pass->keep || !r->depth || view->x != before->x || view->y != before->y ||
        view->width != before->width || view->height != before->height)
        return ZS_ERR_PASS;
    for (uint32_t k = 0; k < scene->n_instances; k++) {
        const struct zs_depth_state *state = scene->instance[k].depth_state;
        if (state && state->func != ZS_DEPTH_LESS)
            return ZS_ERR_PASS;
    }
    return ZS_OK;
}

static void mask_before(struct zs_renderer *r, int32_t row, int32_t x, int32_t n, int fresh)
{
    uint16_t *key = r->depth + row * r->config.width + x;
    if (fresh) {
        zs_fill_run(key, ZS_DEPTH_CLEAR - 1u, (uint32_t)n);
        return;
    }
    for (uint16_t *const end = key + n; key != end; key++)
        if (*key == ZS_DEPTH_CLEAR)
            *key = ZS_DEPTH_CLEAR - 1u;
}

static void mask_open(struct zs_renderer *r, int32_t row, int32_t x, int32_t n)
{
    uint16_t *const first = r->depth + row * r->config.width + x, *const end = first + n;
    for (uint16_t *key = first; key != end;) {
        while (key != end && *key != ZS_DEPTH_CLEAR)
            *key++ = 0;
        uint16_t *const from = key;
        while (key != end && *key == ZS_DEPTH_CLEAR)
            key++;
        if (key != from)
            zs_raster_background(r, row, x + (int32_t)(from - first), (int32_t)(key - from));
    }
}

const struct zs_mask zs_mask_window = { .check = mask_check,
                                        .before = mask_before,
                                        .open = mask_open };
