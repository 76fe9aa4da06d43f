/* Rasterisation of one strip: set-up of its triangles, and their scanlines.
 *
 * The method gives the list of triangles (core/method.h).
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/damage.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/plane.h"
#include "core/raster.h"
#include "core/raster_fast.h"
#include "core/rows.h"
#include "zs_shader.h"

void zs_raster_background(struct zs_renderer *r, int32_t row, int32_t x, int32_t n)
{
    const struct zs_background *sky = r->scene->sky;
    uint16_t *const at = r->color[0] + row * r->config.width + x;
    if (sky)
        sky->fill(sky->ctx, at, (uint16_t)x, (uint16_t)(r->strip * r->config.strip_h + row),
                  (uint16_t)n);
    else
        zs_fill_run(at, zs_wire16(r->scene->background), (uint32_t)n);
}

void zs_raster_far(struct zs_renderer *r, int32_t row, int32_t x, int32_t n)
{
    if (r->depth)
        zs_fill_run(r->depth + row * r->config.width + x, ZS_DEPTH_CLEAR, (uint32_t)n);
}

ZS_NOINLINE void zs_raster_clear(struct zs_renderer *r, int32_t row, int32_t x, int32_t n)
{
    if (n <= 0)
        return;
    zs_raster_far(r, row, x, n);
    zs_raster_background(r, row, x, n);
}

ZS_NOINLINE void zs_raster_clear_all(struct zs_renderer *r)
{
    const int32_t width = r->config.width, rows = zs_strip_rows(r);
    const int32_t at_once = r->scene->sky ? 1 : rows; /* a sky is filled row by row */
    for (int32_t row = 0; row < rows; row += at_once)
        zs_raster_clear(r, row, 0, width * at_once);
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* Set the rows of job->tri in its strip, and its sides. Return 0 if it has no row there. */
static int sides(struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v;
    const struct zs_vertex *a = &pool[v[0]], *b = &pool[v[1]], *c = &pool[v[2]];
    const int32_t b_row = zs_first_sample(b->y), c_row = zs_first_sample(c->y);
    job->row = zs_max32(zs_first_sample(a->y), job->y0);
    job->row_mid = zs_min32(b_row, c_row);
    job->tri_end = zs_max32(b_row, c_row);
    job->row_end = zs_min32(job->tri_end, job->y1);
    if (job->row >= job->row_end)
        return 0;
    zs_plane_sides(job, a, b, c);
    return 1;
}

/* Set up job for its triangle in its strip. Return 0 if the triangle covers no pixel there. */
static ZS_NOINLINE int job_setup(struct zs_job *job)
{
    if (!sides(job))
        return 0;
    job->r->stats.tris_setup++;
    zs_edges_cut(job, job->row);
    if (zs_edges_none(job))
        return 0;
    zs_plane_geom(job);
    return 1;
}

/* ---- Rows ------------------------------------------------------------------------------------ */

static void linear_span(struct zs_job *job, const struct zs_row *row)
{
    if (ZS_IF_FAST(job->split & ZS_SPLIT_TOUCH))
        job->r->touch->row(job, row);
    job->piece(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0),
               job->key.gx);
}

/* Not inlined, so that its variables are not on the stack while shader->start runs. */
static ZS_NOINLINE void linear_walk(struct zs_job *job)
{
    zs_rows_walk(job, linear_span, 0);
}

/* Compute the plane of the keys of a triangle whose edges are set up. Return 0 if they are not
 * linear. */
static ZS_NOINLINE int key_plane(struct zs_job *job)
{
    const struct zs_renderer *r = job->r; /* all else is loaded again: fewer registers to save */
    const int linear = r->view.screen_linear || r->view.depth->planes(job);
    const uint32_t a = job->v[0]->d, b = job->v[1]->d, c = job->v[2]->d;
    job->saturates = zs_maxu32(zs_maxu32(a, b), c) >= job->key_limit;
    if (linear && r->depth) {
        zs_plane32(&job->geom, a, b, c, ZS_PLANE_KEY, &job->key);
        /* half a bucket, to round to nearest; keys are below 2^32 - 2^15 (plane.c) */
        job->key.base += 0x8000u;
    }
    return linear;
}

/* Compute the gradients of a triangle whose edges are set up, and draw its scanlines. */
static ZS_NOINLINE void draw(struct zs_job *job, int linear)
{
    const struct zs_renderer *r = job->r;
    if (job->depth_state)
        job->bias = zs_depth_state_bias(job);
    if (job->shader->start && !zs_fast_start(job))
        job->shader->start(job);
    if (linear && ZS_IF_FAST(job->rows) && !job->split &&
        (!job->depth_state || zs_fast_moved(job)) && job->rows(job))
        return;
    job->piece = job->split & ZS_SPLIT_WINDOW ? r->track->piece
                 : ZS_IF_FAST(job->split)     ? r->touch->piece
                                              : job->span;
    if (linear)
        linear_walk(job);
    else
        r->view.depth->walk(job);
}

void zs_raster_leave(struct zs_renderer *r)
{
    r->active = r->config.method->list(r); /* also those that end here: they draw nothing below */
}

/* ---- The strip ------------------------------------------------------------------------------- */

/* Which rejects to try in a strip: triangles that are hidden, or outside the columns drawn. */
struct sight {
    uint32_t seen;   /* zs_fast_tiles.seen; UINT32_MAX: do not test for hidden triangles */
    int32_t in_vain; /* successive triangles that were tested and not hidden */
    int beside;      /* 1: some binned triangles may lie outside the columns that are drawn */
};

static struct sight sight_of(struct zs_renderer *r)
{
    struct sight s = { UINT32_MAX, 0, r->window[0] > r->walk_least || r->window[1] < r->walk_most };
    if (ZS_IF_FAST(r->large))
        s.seen = r->tiles->seen(r);
    return s;
}

/* Return 1 if all vertices of a triangle are beyond a depth. */
static inline int beyond(const struct zs_job *job, uint32_t d)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v;
    return pool[v[0]].d > d && pool[v[1]].d > d && pool[v[2]].d > d;
}

/* Return 1 if job->tri draws no pixel in the strip; job->tri_end is then set. */
static ZS_NOINLINE int unseen(struct zs_job *job, struct sight *s)
{
    if (s->beside && job->r->track->beside(job))
        return 1;
    if (!ZS_IF_FAST(s->seen != UINT32_MAX) || !beyond(job, s->seen))
        return 0;
    const int hides = job->r->tiles->hides(job);
    s->in_vain = hides ? 0 : s->in_vain + 1;
    if (s->in_vain == job->r->tiles->in_vain)
        s->seen = UINT32_MAX;
    return hides;
}

/* Find the accelerator of a shader or of a texel format. NULL: there is none. A shader without
 * varyings that has none takes that of one with the same `run` (zs_solid_run): faces lit by lamps
 * (1,012 of them take 40 % less on the M3, 24 on the M0), lines (450 edges, 41 and 15 %) and points
 * (400 of 8 px, 49 and 29 %). */
static const struct zs_fast *fast_of(const struct zs_renderer *r, const struct zs_shader *shader,
                                     const struct zs_texel *format)
{
    const struct zs_fast *like = 0;
    if (ZS_IF_FAST(r->config.fast))
        for (const struct zs_fast *const *at = r->config.fast; *at; at++) {
            const struct zs_fast *const one = *at;
            if (shader ? one->shader == shader : format && one->format == format)
                return one;
            if (shader && one->shader && !shader->n_varyings && !shader->span &&
                one->shader->run == shader->run)
                like = one;
        }
    return like;
}

/* Set the fields of job that depend on the instance. Return the accelerator's function that draws
 * its triangles without set-up; NULL: there is none. */
static ZS_NOINLINE int (*job_instance(struct zs_job *job, uint32_t number))(struct zs_job *)
{
    const struct zs_renderer *r = job->r;
    const struct zs_instance *instance = zs_instance_of(r, number);
    const struct zs_material *material = instance->material;
    if (job->shader != material->shader) {
        job->shader = material->shader;
        if (!ZS_NO_FAST)
            job->fast = fast_of(r, job->shader, 0);
    }
    if (job->texture != material->texture) {
        job->texture = material->texture;
        if (!ZS_NO_FAST) {
            const struct zs_fast *of = fast_of(r, 0, job->texture ? job->texture->format : 0);
            job->texel = of ? of->texel : 0;
        }
    }
    if (!ZS_NO_FAST)
        job->gather = job->texel ? job->texel->gather : 0;
    job->depth_state = r->depth ? instance->depth_state : 0;
    job->split = 0;
    job->span = r->span;
    if (!ZS_NO_FAST)
        job->rows = 0;
    if (r->span != zs_rows_test)
        return 0;
    if (job->shader->span)
        job->span = job->shader->span;
    const struct zs_depth_state *const state = job->depth_state;
    if (!ZS_IF_FAST(job->fast) || (state && (state->func != ZS_DEPTH_LESS || state->read_only)))
        return 0;
    job->rows = job->fast->rows;
    if (job->fast->span && !state)
        job->span = job->fast->span;
    return !r->untouched && r->view.piece_shift && (!state || zs_fast_moves(job)) ? job->fast->draw
                                                                                  : 0;
}

/* Set the fields of job that depend on the pass: the part of its viewport in the strip. */
static void job_target(struct zs_job *job)
{
    const struct zs_renderer *r = job->r;
    const int32_t first = r->strip * r->config.strip_h;
    job->top = r->view.y;
    job->bottom = r->view.y + r->view.height;
    job->pitch = r->config.width;
    job->width = r->view.width;
    /* y0 == y1 where the viewport is not in the strip */
    const int32_t last = first + zs_strip_rows(r);
    job->y0 = zs_min32(zs_max32(first, job->top), last);
    job->y1 = zs_max32(zs_min32(last, job->bottom), job->y0);
    const int32_t at = (job->y0 - first) * job->pitch + r->view.x;
    job->color = r->color[0] + at;
    job->depth = r->depth ? r->depth + at : 0;
    zs_fast_target(job, r);
    job->key_limit = r->view.key_top - 0x10000u; /* a bucket below B - 1: room for half a bucket and
                                                    the error of the plane (plane.c) */
}

static void job_begin(struct zs_job *job, struct zs_renderer *r)
{
    job->r = r;
    job_target(job);
    job->shader = 0;
    job->texture = 0;
    if (!ZS_NO_FAST) {
        job->fast = 0;
        job->texel = 0;
        r->lit.of = 0;
    }
    job->key.base = job->key.gx = job->key.gy = 0; /* for a pass without depth memory */
}

void zs_raster_strip(struct zs_renderer *r)
{
    int goes_on = r->strip + 1 < r->band_end;
    const int windowed = r->window[1] - r->window[0] < r->config.width; /* r->track is set then */
    uint16_t list = r->config.method->list(r);
    uint16_t *keep = &r->active; /* appended to, so it stays in the list's order */
    /* the instance that job is set for; ZS_NIL is none: they end at 65534 */
    uint32_t number = ZS_NIL;
    struct zs_job job;
    int (*whole)(struct zs_job *) = 0;
    job_begin(&job, r);
    struct sight sight = sight_of(r);
    const int asked = sight.beside || sight.seen != UINT32_MAX;
    zs_fast_chain(&job, asked ? 0 : r->tri);
    zs_fast_keep(&job, goes_on ? &keep : 0);
    while (list != ZS_NIL) {
        struct zs_tri *t = &r->tri[list];
        job.tri = t;
        if (asked && unseen(&job, &sight)) {
            r->stats.tris_hidden++;
        } else {
            if (t->instance != number) {
                number = t->instance;
                if (r->passes) {
                    r->passes->reach(r, number);
                    job_target(&job);
                    goes_on = r->strip + 1 < r->band_end && job.y1 < job.bottom;
                    zs_fast_keep(&job, goes_on ? &keep : 0);
                }
                whole = job_instance(&job, number);
            }
            if (ZS_IF_FAST(r->untouched) && !r->touch->takes(&job))
                number = ZS_NIL; /* first touch has ended: call job_instance again, which may now
                                    return a function for small triangles */
            if (!ZS_IF_FAST(whole) || !whole(&job)) {
                if (windowed && !ZS_IF_FAST(r->untouched))
                    job.split = r->track->reaches(&job) ? ZS_SPLIT_WINDOW : 0;
                const enum zs_set_up done = whole && zs_fast_tried(&job) ? ZS_SET_UP_NOT
                                                                         : zs_fast_setup(&job);
                if (done != ZS_SET_UP_NONE && (done || job_setup(&job)))
                    draw(&job, done || key_plane(&job));
            }
        }
        t = zs_fast_reached(&job, t, &list); /* one that was declined as well */
        if (goes_on && job.tri_end > job.y1) { /* set by what has drawn, declined or hidden it */
            *keep = list;
            keep = &t->next;
        }
        list = t->next;
    }
    *keep = ZS_NIL;
}
