/* Frames in several passes.
 *
 * One traversal bins the triangles of all passes, one pass after the other. Instances are numbered
 * through all passes. Columns count from the viewport's left side, so that a pass is drawn like a
 * frame of the viewport's size. Rows count from the frame's top, so that all passes share the
 * frame's bins. While a strip is drawn, the number of a triangle's instance tells where the next
 * pass begins. Its view is then loaded, and its viewport is cleared, once for each strip.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/depth.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/pass.h"
#include "core/raster.h"
#include "core/usual.h"
#include "core/view.h"
#include "zs_pass.h"

/* Make pass k the current one. */
static void load(struct zs_renderer *r, uint32_t k)
{
    const struct zs_pass_memory *m = &r->pass_memory[k];
    r->view = m->view;
    r->camera = m->camera;
    r->light = m->light;
    r->scene = r->pass[k].scene;
    r->first = m->first;
    r->end = m->end;
    r->walk_x = 0;
    r->walk_end = m->view.width;
    r->walk_y = m->view.y;
    r->walk_y_end = (uint16_t)(m->view.y + m->view.height);
    r->pass_now = (uint16_t)k;
    zs_frame_forget_edges(r);
}

/* Load the pass of an instance, unless it is the current one. */
static void pass_use(struct zs_renderer *r, uint32_t number)
{
    uint32_t k = 0;
    if (number >= r->first && number < r->end)
        return;
    while (number >= r->pass_memory[k].end)
        k++;
    load(r, k);
}

/* Clear the viewports of the passes up to k that are not cleared yet. The last of them is then the
 * current pass. */
static void clear_to(struct zs_renderer *r, uint32_t k)
{
    for (; r->passes_begun <= k; r->passes_begun++) {
        load(r, r->passes_begun);
        const struct zs_view *view = &r->view;
        const uint32_t keep = r->pass[r->passes_begun].keep;
        const int32_t top = r->strip * r->config.strip_h, from = zs_max32(view->y, top) - top,
                      to = zs_min32(view->y + view->height, top + r->config.strip_h) - top;
        for (int32_t row = from; row < to; row++) {
            if (!(keep & ZS_KEEP_COLOR))
                zs_raster_background(r, row, view->x, view->width);
            if (!(keep & ZS_KEEP_DEPTH))
                zs_raster_far(r, row, view->x, view->width);
        }
    }
}

static void pass_begin(struct zs_renderer *r)
{
    load(r, 0);
    r->passes_begun = 1; /* for the first pass, the whole strip is cleared */
}

static void pass_reach(struct zs_renderer *r, uint32_t number)
{
    pass_use(r, number);
    const uint32_t k = r->pass_now;
    if (k < r->passes_begun)
        return;
    clear_to(r, k);
}

static void pass_end(struct zs_renderer *r)
{
    clear_to(r, r->n_passes - 1u);
    for (uint32_t k = 0; k < r->n_passes; k++)
        zs_frame_resolve(r, r->pass[k].scene);
}

static const struct zs_pass_kernel kernel = {
    .begin = pass_begin, .use = pass_use, .reach = pass_reach, .end = pass_end
};

/* Set viewport and depth mapping of a pass in r->view. */
static int target_set(struct zs_renderer *r, const struct zs_pass *p)
{
    const struct zs_rect *v = &p->viewport;
    struct zs_view *view = &r->view;
    zs_view_frame(view, &r->config);
    if (p->depth)
        view->depth = p->depth;
    if (!view->depth->span != (r->depth != 0))
        return ZS_ERR_DEPTH;
    if (p->keep > (ZS_KEEP_COLOR | ZS_KEEP_DEPTH))
        return ZS_ERR_RANGE;
    if (v->w == 0 && v->h == 0)
        return ZS_OK;
    if (v->w == 0 || v->h == 0 || (uint32_t)v->x + v->w > r->config.width ||
        (uint32_t)v->y + v->h > r->config.height)
        return ZS_ERR_SIZE;
    view->x = v->x;
    view->y = v->y;
    view->width = v->w;
    view->height = v->h;
    return ZS_OK;
}

static int pass_check(struct zs_renderer *r, const struct zs_pass *p, struct zs_pass_memory *m,
                      uint32_t first)
{
    if (!p->scene || !p->camera)
        return ZS_ERR_NULL;
    int err = target_set(r, p);
    zs_usual_camera(r, p->scene, p->camera);
    err = err ? err : zs_frame_check(r, p->scene);
    if (err)
        return err;
    m->view = r->view;
    m->camera = r->camera;
    m->light = r->light;
    m->first = first;
    m->end = first + p->scene->n_instances; /* < 2^32: first < 2^16 */
    return m->end > 65535u ? ZS_ERR_SIZE : ZS_OK;
}

int zs_frame_begin_passes(struct zs_renderer *r, const struct zs_pass *pass,
                          struct zs_pass_memory *memory, uint32_t n)
{
    uint32_t instances = 0;
    if (!r)
        return ZS_ERR_NULL;
    r->scene = 0;
    if (!pass || !memory)
        return ZS_ERR_NULL;
    if (r->ready != 1 || r->track)
        return ZS_ERR_SEQUENCE;
    if (n < 1 || n > 65535u)
        return ZS_ERR_SIZE;
    for (uint32_t k = 0; k < n; k++) {
        const int err = pass_check(r, &pass[k], &memory[k], instances);
        if (err)
            return err;
        instances = memory[k].end;
    }
    r->passes = &kernel;
    r->draw_end = r->n_strips;
    r->pass = pass;
    r->pass_memory = memory;
    r->n_passes = (uint16_t)n;
    r->n_instances = instances;
    zs_frame_open(r);
    load(r, 0);
    return ZS_OK;
}

int zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass,
                     struct zs_pass_memory *memory, uint32_t n, const struct zs_sink *sink)
{
    if (!sink || !sink->submit)
        return ZS_ERR_NULL;
    const int err = zs_frame_begin_passes(r, pass, memory, n);
    return err ? err : zs_frame_send(r, sink);
}
