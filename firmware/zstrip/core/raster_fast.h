/* Where core/raster.c calls accelerators: for the set-up of a triangle (zs_fast.set_up), for the
 * start of its shader, and to learn how far zs_fast.draw has gone on in the list. On cores that
 * have no such hooks these functions do nothing. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_RASTER_FAST_H
#define ZS_RASTER_FAST_H

#include "core/edges.h"
#include "core/fast.h"
#include "core/job.h"

#if ZS_CHAIN_USED
/* Let fast->draw go on to triangles of the pool `all` that follow in the list; 0: one a call. */
#define zs_fast_chain(job, all) ((void)((job)->chain = (all)))
/* Return job->tri, to which fast->draw has gone on from t; *list: its number. */
static inline struct zs_tri *zs_fast_reached(const struct zs_job *job, struct zs_tri *t,
                                             uint16_t *list)
{
    if (job->tri == t)
        return t;
    *list = (uint16_t)(job->tri - job->r->tri);
    return job->r->tri + *list;
}
#else
#define zs_fast_chain(job, all) ((void)0)
#define zs_fast_reached(job, t, list) (t)
#endif
#if ZS_CHAIN_KEEPS
/* Say where the list ends of triangles that go on below the strip; 0: there are none. */
#define zs_fast_keep(job, at) ((void)((job)->keep = (at)))
#else
#define zs_fast_keep(job, at) ((void)0)
#endif

/* 1: fast->draw moves keys by the instance's depth state itself (fast/solid_v7m.c). */
#define zs_fast_moves(job)                                                                         \
    (ZS_V7M && !(job)->shader->n_varyings && !(job)->depth_state->slope_bias)

/* Move the plane of the keys by the bias of a depth state, so that what draws without a state draws
 * the same, and so do the core's rows if an accelerator declines then. Return 0 if a key may be
 * below 0 or saturate. A ball of 1,012 triangles with a bias takes 35 % less on the M0 (1.87 to
 * 1.23 million instructions; textured, 9 %); on the M3, with what fast/solid_v7m.c does, 53 % (1.21
 * to 0.57). 130 bytes. */
static ZS_RARE __attribute__((unused)) int zs_fast_moved(struct zs_job *job)
{
    const uint32_t a = job->v[0]->d, b = job->v[1]->d, c = job->v[2]->d;
    const int32_t least = (int32_t)(zs_minu32(zs_minu32(a, b), c) >> 16),
                  most = (int32_t)(zs_maxu32(zs_maxu32(a, b), c) >> 16),
                  limit = (int32_t)(job->key_limit >> 16);
    if (job->saturates || least + job->bias < 0 || most + job->bias >= limit)
        return 0;
    job->key.base += (uint32_t)job->bias << 16;
    job->bias = 0;
    return 1;
}

/* What accelerators of Armv6-M do in place of set-up: nothing is done where a core has none. */
#if ZS_SET_UP
/* Return the first accelerator that has a set-up, or NULL. */
static inline const struct zs_fast *zs_fast_with_set_up(const struct zs_renderer *r)
{
    const struct zs_fast *const *at = r->config.fast;
    while (at && *at && !(*at)->set_up)
        at++;
    return at ? *at : 0;
}

#if ZS_RP2040
/* Forget what fast->draw keeps of an instance. */
#define zs_fast_forget(job) ((void)((job)->kept.of = ZS_NIL))
/* 1: fast->draw has declined, and has tried what zs_fast_setup does: do not try it again. On an
 * RP2040 worth 1 % of a scene of small smooth triangles in perspective, 0.3 % of teapot and knot,
 * 0.2 % of china. */
#define zs_fast_tried(job) ((job)->kept.of == (job)->tri->instance || !(job)->texture)
#else
#define zs_fast_forget(job) ((void)0)
#define zs_fast_tried(job) 0
#endif

/* Set what a strip's job needs for zs_fast.set_up. */
static inline void zs_fast_target(struct zs_job *job, const struct zs_renderer *r)
{
    job->piece_shift = r->view.piece_shift;
    job->key_slow = r->view.key_slow;
    job->key_known = r->view.key_known;
    const struct zs_fast *of = job->depth && job->piece_shift ? zs_fast_with_set_up(r) : 0;
    job->set_up = of ? of->set_up : 0;
    zs_fast_forget(job);
}

/* In place of job_setup and key_plane. Return ZS_SET_UP_NOT if it is not done. */
static inline enum zs_set_up zs_fast_setup(struct zs_job *job)
{
    const enum zs_set_up done = job->set_up ? job->set_up(job) : ZS_SET_UP_NOT;
    if (done == ZS_SET_UP_ROWS) {
        job->r->stats.tris_setup++;
        zs_edges_cut(job, job->row);
        return zs_edges_none(job) ? ZS_SET_UP_NONE : ZS_SET_UP_ROWS;
    }
    return done;
}

/* In place of shader->start. Return 0 if it is not done. */
static inline int zs_fast_start(struct zs_job *job)
{
    return job->rows && job->fast->start && job->fast->start(job);
}
#else
#define zs_fast_target(job, r) zs_kept_forget(job)
#define zs_fast_tried(job) 0
#define zs_fast_setup(job) ((void)(job), ZS_SET_UP_NOT)
#define zs_fast_start(job) ((void)(job), 0)
#endif

#endif
