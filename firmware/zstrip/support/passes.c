/* Frames in several passes.
 *
 * One walk bins the triangles of all passes, one pass after the other. Instances are numbered
 * through all passes. Columns count from the viewport's left side, so that a pass is drawn like a
 * frame of the viewport's size. Rows count from the frame's top, so that all passes share the
 * frame's bins. While a strip is drawn, the number of a triangle's instance tells where the next
 * pass begins. Its view is then loaded, and its viewport is cleared, once for each strip.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/raster.h"
#include "core/usual.h"
#include "core/view.h"
#include "core/walk.h"
#include "zs_environment.h"

/* Make pass k the current one. */
static void load(struct zs_renderer *r, uint32_t k)
{
    struct zs_pass_memory *const list = r->pass_memory, *const m = &list[k];
    r->view = m->view;
    r->camera = m->camera;
    r->light = m->light;
    r->scene = list->pass[k].scene;
    r->first = m->first;
    if (ZS_IF_FAST(1)) { /* these know nothing of mirrors */
        r->batch = m->view.mirror ? 0 : list->batch;
        r->clusters_hooks = m->view.mirror ? 0 : list->clusters;
    }
    list->now = (uint16_t)k;
    zs_walk_region(r);
    zs_frame_forget_edges(r);
}

/* Load the pass of an instance, unless it is the current one. */
static void pass_use(struct zs_renderer *r, uint32_t number)
{
    const struct zs_pass_memory *const list = r->pass_memory;
    uint32_t k = number < r->first ? 0u : list->now;
    while (number >= list[k].end)
        k++;
    if (k != list->now)
        load(r, k);
}

/* Prepare a row of a pass's viewport. The whole strip has been cleared for the first pass. */
static void row_begin(struct zs_renderer *r, uint32_t k, int32_t row)
{
    const struct zs_pass_memory *const list = r->pass_memory;
    const struct zs_view *const view = &list[k].view;
    const struct zs_pass *const pass = &list->pass[k];
    const struct zs_mask *const next = k + 1u < list->n ? pass[1].mask : 0;
    if (pass->mask) {
        pass->mask->open(r, row, view->x, view->width);
    } else if (k) {
        if (!(pass->keep & ZS_KEEP_COLOR))
            zs_raster_background(r, row, view->x, view->width);
        if (!(pass->keep & ZS_KEEP_DEPTH))
            zs_raster_far(r, row, view->x, view->width);
    }
    if (next)
        next->before(r, row, view->x, view->width, !pass->mask && !(pass->keep & ZS_KEEP_DEPTH));
}

/* Prepare the viewports of passes up to k. Another pass may be in hand then. */
static void clear_to(struct zs_renderer *r, uint32_t k)
{
    struct zs_pass_memory *const list = r->pass_memory;
    const int32_t top = r->strip * r->config.strip_h;
    for (; list->begun <= k; list->begun++) {
        const struct zs_view *view = &list[list->begun].view;
        const struct zs_pass *const before = &list->pass[list->begun ? list->begun - 1u : 0u];
        const int32_t from = zs_max32(view->y, top) - top,
                      to = zs_min32(view->y + view->height, top + r->config.strip_h) - top;
        if (list->begun && before->early)
            zs_frame_resolve(r, before->scene);
        if (from < to && list->begun != list->now)
            load(r, list->begun); /* the background is its scene's */
        for (int32_t row = from; row < to; row++)
            row_begin(r, list->begun, row);
    }
}

static void pass_begin(struct zs_renderer *r)
{
    load(r, 0);
    r->pass_memory->begun = 0;
}

static void pass_reach(struct zs_renderer *r, uint32_t number)
{
    uint32_t k = 0;
    while (number >= r->pass_memory[k].end)
        k++;
    clear_to(r, k);
    if (k != r->pass_memory->now)
        load(r, k);
}

static void pass_end(struct zs_renderer *r)
{
    const struct zs_pass_memory *const list = r->pass_memory;
    const struct zs_pass *const pass = list->pass;
    clear_to(r, list->n - 1u);
    for (uint32_t k = 0; k < list->n; k++) {
        uint32_t before = 0; /* one scene in several passes is resolved once */
        while (pass[before].scene != pass[k].scene)
            before++;
        if (before == k && (!pass[k].early || k + 1u == list->n))
            zs_frame_resolve(r, pass[k].scene);
    }
}

static const struct zs_pass_ops kernel = {
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
    if (!view->depth->span != (r->depth != 0) || p->keep > (ZS_KEEP_COLOR | ZS_KEEP_DEPTH))
        return ZS_ERR_PASS;
    if (!(v->x | v->y | v->w | v->h))
        return ZS_OK;
    if (v->w == 0 || v->h == 0 || (uint32_t)v->x + v->w > r->config.width ||
        (uint32_t)v->y + v->h > r->config.height)
        return ZS_ERR_PASS;
    view->x = v->x;
    view->y = v->y;
    view->width = v->w;
    view->height = v->h;
    return ZS_OK;
}

static int pass_check(struct zs_renderer *r, const struct zs_pass *p, struct zs_pass_memory *m,
                      uint32_t first)
{
    const struct zs_mirror *mirror = p->mirror;
    if (!p->scene || !p->camera || (mirror && !mirror->ops))
        return ZS_ERR_NULL;
    int err = target_set(r, p);
    zs_usual_camera(r, p->scene, p->camera); /* the usual light is also that in a mirror */
    if (!err)
        err = mirror ? mirror->ops->check(r, mirror, p->scene, &m->mirror)
                     : zs_frame_check(r, p->scene);
    if (err < 0)
        return err;
    const uint32_t n = err ? 0u : p->scene->n_instances;
    m->view = r->view;
    m->camera = r->camera;
    m->light = r->light;
    m->first = (uint16_t)first;
    m->end = (uint16_t)(first + n); /* < 2^17 */
    return first + n > 65535u ? ZS_ERR_SIZE : ZS_OK;
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
    if (!r->config.method->passes)
        return ZS_ERR_PASS;
    if (n < 1 || n > 65535u)
        return ZS_ERR_SIZE;
    for (uint32_t k = 0; k < n; k++) {
        int err = pass_check(r, &pass[k], &memory[k], instances);
        if (!err && pass[k].mask)
            err = pass[k].mask->check(r, &pass[k], &memory[k], k);
        if (err)
            return err;
        if (k && (pass[k].keep & ZS_KEEP_DEPTH) && memory[k].view.depth != memory[k - 1].view.depth)
            return ZS_ERR_PASS;
        instances = memory[k].end;
    }
    r->passes = &kernel;
    r->draw_end = r->n_strips;
    r->pass_memory = memory;
    memory->pass = pass;
    memory->n = (uint16_t)n;
    r->n_instances = (uint16_t)instances;
    zs_frame_open(r);
    if (ZS_IF_FAST(1)) {
        memory->batch = r->batch;
        memory->clusters = r->clusters_hooks;
    }
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
