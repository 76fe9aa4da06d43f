/* The walk over the scene: cull instances, bin their triangles, and handle full pools.
 *
 * When a pool is full, the walk stops at a cursor (instance, triangle, piece of a clipped
 * triangle), makes room, and goes on from there. If a single strip fills the pools, the method
 * makes room. The depth buffer draws the binned triangles and empties the pools; the picture does
 * not depend on the number of such sets, because the least (key, scene order) wins a pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cull.h"
#include "core/damage.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/primitive.h"
#include "core/walk.h"
#include "core/xform.h"
#include "zs_shader.h"

/* The position of the walk. */
struct cursor {
    uint32_t tri, piece;
    uint16_t instance;
    uint8_t open; /* 1: the instance's triangles are being binned; tri is the next one */
    zs_assemble_fn *assemble;      /* bins one triangle, or one primitive */
    uint32_t outcome[ZS_OUTCOMES]; /* the walk's triangles so far, counted by outcome */
};

/* Add the counts of the frame's first walk to the statistics. */
static ZS_RARE void count(struct zs_renderer *r, const uint32_t outcome[ZS_OUTCOMES])
{
    uint8_t *const at = (uint8_t *)&r->stats + offsetof(struct zs_stats, tris_drawn);
    for (int k = 0; k < ZS_OUTCOMES && r->counting; k++)
        ((uint32_t *)(void *)at)[k] += outcome[k];
}
_Static_assert(offsetof(struct zs_stats, tris_offscreen) - offsetof(struct zs_stats, tris_drawn) ==
                       4 * ZS_OUTCOME_OFFSCREEN &&
                   offsetof(struct zs_stats, tris_index) - offsetof(struct zs_stats, tris_drawn) ==
                       4 * ZS_OUTCOME_INDEX,
               "counts are in the order of outcomes");

/* Cull an instance, or set r->xform for it. Return 0 if it is culled or hidden, or if no strip that
 * it can reach is dirty. Not inlined, so that its variables are off the stack during binning.
 */
static ZS_RARE ZS_NOINLINE int instance_open(struct zs_renderer *r, uint32_t number)
{
    struct zs_bounds b;
    const struct zs_instance *in = zs_instance_of(r, number);
    const struct zs_track_ops *track = r->track;
    const struct zs_fast_clusters *clusters =
        in->mesh->cluster ? ZS_IF_FAST(r->clusters_hooks) : 0;
    const struct zs_depth_state *state = in->depth_state;
    struct zs_region region;
    if (track) {
        if (!track->touches(r, number, &region))
            return 0;
        r->walk_x = region.x;
        r->walk_end = region.x_end;
        r->walk_least = (uint16_t)zs_minu32(r->walk_least, region.x);
        r->walk_most = (uint16_t)zs_maxu32(r->walk_most, region.x_end);
    }
    if (zs_cull_walk(&b, r, number))
        return 0;
    if (ZS_IF_FAST(!in->material->shader->opaque || (state && state->func == ZS_DEPTH_ALWAYS))) {
        r->tiles = 0; /* what it covers may be seen; the keys that it writes have no bound */
        r->large = 0;
        r->refit = 1;
    }
    if (ZS_IF_FAST(r->large) && !state && r->tiles->hides_sphere(r, &b)) {
        r->stats.instances_hidden += r->counting;
        return 0;
    }
    if (clusters && !clusters->edges(r, &b, number))
        return 0;
    if (!zs_xform_instance(r, number, &b))
        return 0;
    if (ZS_IF_FAST(r->batch))
        r->batch->needs(r, &b);
    r->clusters.from = r->clusters.end = 0;
    r->by_clusters = clusters && clusters->open(r, &b);
    return 1;
}

/* Go to the next run of triangles of the current instance, [r->clusters.from, r->clusters.end).
 * Return 0 if there is none: without clusters, the first run had all triangles. */
static ZS_RARE int next_run(struct zs_renderer *r, struct cursor *at)
{
    if (!ZS_IF_FAST(r->by_clusters) || !r->clusters_hooks->run(r))
        return 0;
    at->tri = r->clusters.from;
    return 1;
}

/* Open the cursor's instance and count it. Return 0 if it has nothing to bin. */
static ZS_RARE int instance_begin(struct zs_renderer *r, struct cursor *at)
{
    const struct zs_instance *const in = zs_instance_of(r, at->instance);
    const struct zs_primitive *const primitive = in->material->primitive;
    zs_assemble_fn *assemble = zs_assemble_tri;
    uint32_t all = in->mesh->n_tris;
    if (primitive) {
        all = primitive->n;
        assemble = primitive->ops->assemble;
    }
    at->assemble = assemble;
    if (ZS_IF_FAST(r->parts_tris) && r->batch->beside(r, at->instance))
        return 0;
    r->stats.instances_in += r->counting;
    r->stats.tris_in += all * r->counting;
    if (!instance_open(r, at->instance)) {
        r->stats.instances_culled += r->counting;
        r->stats.tris_frustum += all * r->counting;
        return 0;
    }
    r->vert_base = r->n_verts;
    if (!ZS_NO_FAST)
        r->direct = r->batched = 0;
    if (ZS_IF_FAST(r->batch))
        r->batch->open(r);
    at->piece = 0;
    if (ZS_IF_FAST(r->by_clusters))
        return next_run(r, at);
    at->tri = 0;
    r->clusters.end = all;
    return all != 0;
}

/* Bin the open instance's triangles from the cursor on. Return 0 if a pool is full. */
static ZS_NOINLINE int instance_bin(struct zs_renderer *r, struct cursor *at)
{
    do {
        if (ZS_IF_FAST(r->batched)) {
            at->tri = r->batch->bin(r, at->tri, r->clusters.end, at->outcome, &at->piece);
            if (at->tri < r->clusters.end)
                return 0;
        }
        for (; at->tri < r->clusters.end; at->tri++) {
            const enum zs_outcome outcome = at->assemble(r, at->tri, &at->piece);
            if (outcome == ZS_OUTCOME_FULL)
                return 0;
            at->outcome[outcome]++;
        }
    } while (next_run(r, at));
    return 1;
}

ZS_RARE void zs_walk(struct zs_renderer *r, uint16_t end)
{
    struct cursor at = { 0 };
    zs_bin_band(r, end);
    r->stats.passes++;
    r->walk_most = 0;
    r->walk_least = r->config.width;
    zs_walk_region(r);
    while (at.instance < r->n_instances) {
        if (r->passes)
            r->passes->use(r, at.instance);
        if (!at.open)
            at.open = (uint8_t)instance_begin(r, &at);
        if (at.open && !instance_bin(r, &at)) {
            if (ZS_IF_FAST(r->parts_tris) && r->batch->spare(r, at.tri))
                continue;
            if (!zs_bin_room(r))
                r->config.method->full(r);
            if (ZS_IF_FAST(r->batch))
                r->batch->full(r, at.tri);
            continue;
        }
        at.open = 0;
        at.instance++;
    }
    count(r, at.outcome);
    zs_bin_count(r);
    r->counting = 0;
}
