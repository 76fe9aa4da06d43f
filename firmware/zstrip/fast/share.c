/* Two renderers share a walk of the scene: zs_share.h.
 *
 * Each bins its part into its own pools, for all strips. Then the second one moves its triangles
 * and vertices up by as many as the first one has, and each copies the other's: both have the pools
 * and bins of one walk. Order in the pool is scene order, so that lists, ties and the frame are
 * those of one walk.
 *
 * A part binds the loop over instances by the hook of damage tracking, and the loop over triangles
 * by that of batches. Instances with few triangles, and those that are not binned in batches, are
 * in the part that has their first triangle. Where a pool gets full, the part is given up.
 *
 * Worth, two cores of an RP2040, emulated, frames a second: teapot 27.8 to 30.5, china 21.7 to
 * 23.7, knot 42.6 to 50.2, city 37.4 to 44.7, flyover 20.4 to 24.6. Takes 2.0 KB there, and of the
 * 7.6 million cycles of both cores in teapot 0.25 for marks, moves and copies.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/damage.h"
#include "core/fast.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/primitive.h"
#include "core/walk.h"
#include "fast/clusters.h"
#include "fast/parts.h"
#include "fast/screen.h"
#include "fast/sweep.h"
#include "zs_share.h"

/* ---- Step 0: bin a part ---------------------------------------------------------------------- */

/* Find the triangles of an instance that are in the part. Instances come in order. */
ZS_RARE static int in_part(const struct zs_renderer *r, uint32_t number, struct zs_region *region)
{
    struct zs_share_part *const p = r->share;
    for (; p->number != number; p->number++)
        p->first += zs_primitives_of(zs_instance_of(r, p->number));
    const struct zs_instance *const in = zs_instance_of(r, number);
    const uint32_t n = zs_primitives_of(in);
    p->from = zs_maxu32(p->begin, p->first) - p->first;
    p->to = zs_minu32(p->end, p->first + n) - zs_minu32(p->end, p->first);
    if (n <= ZS_PARTS_FEW || !zs_parts_batched(r, in)) {
        p->to = p->from == 0 && p->to ? n : 0;
        p->from = 0;
    }
    region->x = 0;
    region->x_end = r->view.width;
    return p->ok > 0 && p->from < p->to;
}

/* Transform the vertices that the part's triangles have. */
ZS_RARE static void part_open(struct zs_renderer *r)
{
    struct zs_share_part *const p = r->share;
    r->by_clusters = r->by_clusters ? 2u : 0u;
    if (!zs_batch_room(r) || (r->by_clusters && r->clusters_hooks->verts(r)))
        return;
    zs_mark_none(r);
    zs_mark_verts(r, p->from, p->to);
    r->n_verts = r->vert_base + zs_marked_verts(r);
    if (r->vert_base == 0) {
        p->of = r->xform.number;
        p->least = 0;
        const uint8_t *const mark = (const uint8_t *)r->vert_map;
        while (p->least < r->n_verts && !mark[p->least])
            p->least++;
    }
}

static uint32_t part_bin(struct zs_renderer *r, uint32_t from, uint32_t end,
                         uint32_t outcome[ZS_OUTCOMES], uint32_t *piece)
{
    struct zs_share_part *const p = r->share;
    const uint32_t first = zs_maxu32(from, p->from), last = zs_minu32(end, p->to);
    if (p->ok > 0 && first < last && zs_batch_bin(r, first, last, outcome, piece) < last)
        p->ok = -1; /* a pool is full */
    return end;
}

/* Triangles that are assembled one by one have filled the pools. */
static void part_full(struct zs_renderer *r)
{
    r->share->ok = -1;
    zs_bin_empty(r);
}

ZS_RARE static void bin(struct zs_renderer *r, struct zs_share_part *p, uint32_t core, uint32_t cut)
{
    static const struct zs_track_ops instances = { .touches = in_part };
    static const struct zs_method pools = { .full = part_full };
    static const struct zs_fast_batch part = { .needs = zs_screen_needs, .open = part_open,
                                               .bin = part_bin, .screen = zs_screen,
                                               .full = zs_parts_begin };
    const struct zs_fast_batch *const batch = r->batch;
    if (r->track || r->passes || r->config.method != &zs_method_buffer || !batch)
        return;
    uint64_t n = 0;
    for (uint32_t i = 0; i < r->n_instances; i++)
        n += zs_primitives_of(zs_instance_of(r, i));
    if (n > UINT32_MAX) /* they are counted in 32 bits */
        return;
    const uint32_t at = (uint32_t)(n * cut >> 16);
    *p = (struct zs_share_part){ .begin = core ? at : 0u, .end = core ? (uint32_t)n : at, .ok = 1 };
    r->share = p;
    r->track = &instances;
    r->batch = &part;
    r->config.method = &pools;
    zs_walk(r, r->n_strips);
    r->share = 0;
    r->track = 0;
    r->batch = batch;
    r->config.method = &zs_method_buffer;
    if (r->band_end < r->n_strips)
        p->ok = -1;
    if (r->n_tris == 0)
        r->n_verts = 0;
    if (r->vert_packed || r->n_tris == 0 || r->tri[0].instance != p->of)
        p->least = 0; /* vertices were packed, perhaps all away, or are not those of part_open */
    p->tris = r->n_tris;
    p->verts = r->n_verts;
}

/* ---- Steps 1 to 3: put the parts together ---------------------------------------------------- */

/* Copy a triangle to a pool where those of its part come `tris` and their vertices `up` later. */
static inline void copy(struct zs_tri *to, const struct zs_tri *from, uint32_t tris, uint32_t up)
{
    const uint32_t next = from->next;
    to->instance = from->instance;
    to->paint = from->paint;
    for (int k = 0; k < 3; k++)
        to->v[k] = (uint16_t)(from->v[k] + up);
    to->next = (uint16_t)(next == ZS_NIL ? next : next + tris);
}

/* Move the second part's triangles and vertices behind those of the first, and its bins' lists,
 * whose newest triangles come first, before the first part's. */
static ZS_NOINLINE void move(const struct zs_share *s, struct zs_renderer *r,
                             const struct zs_renderer *first)
{
    const uint32_t tris = s->tris, verts = s->verts, size = r->config.varyings;
    const uint32_t n = s->verts_end - verts, least = r->n_verts - n, up = verts - least;
    for (uint32_t t = r->n_tris; t--;)
        copy(&r->tri[tris + t], &r->tri[t], tris, up);
    for (uint32_t k = 0; k < r->n_strips; k++) {
        uint16_t *at = &r->bin[k];
        if (*at != ZS_NIL)
            *at = (uint16_t)(*at + tris);
        while (*at != ZS_NIL)
            at = &r->tri[*at].next;
        *at = first->bin[k];
    }
    /* from the end on which they do not run over each other */
    const int32_t step = verts > least ? -1 : 1;
    struct zs_vertex *v = r->vert + (verts > least ? s->verts_end - 1u : verts);
    for (uint32_t k = 0; k < n; k++, v += step)
        *v = *(v - (int32_t)up);
    uint16_t *at = r->attr + (verts > least ? s->verts_end * size - 1u : verts * size);
    for (uint32_t k = 0; k < n * size; k++, at += step)
        *at = *(at - (int32_t)(up * size));
}

/* See whether all fits, and put the second part behind the first. */
ZS_RARE static void second_part(struct zs_share *s, int packed)
{
    const struct zs_share_part *const p = s->part;
    struct zs_renderer *const first = s->r[0], *const r = s->r[1];
    s->tris = first->n_tris;
    s->verts = first->n_verts;
    s->tris_end = s->tris + r->n_tris;
    s->verts_end = s->verts + r->n_verts - (packed ? 0u : p[1].least);
    s->joined = p[0].ok > 0 && p[1].ok > 0 && s->tris_end <= r->config.max_tris &&
                s->verts_end <= r->config.max_verts;
    if (s->joined)
        move(s, r, first);
}

/* Copy the other renderer's part, which the bounds of tiles (fast/tiles.c) do not know. */
static ZS_NOINLINE void join(const struct zs_share *s, struct zs_renderer *r, uint32_t core)
{
    const struct zs_renderer *const other = s->r[!core];
    const uint32_t tri = core ? 0u : s->tris, tri_end = core ? s->tris : s->tris_end;
    const uint32_t vert = core ? 0u : s->verts, vert_end = core ? s->verts : s->verts_end;
    for (uint32_t t = tri; t < tri_end; t++)
        copy(&r->tri[t], &other->tri[t], 0, 0);
    for (uint32_t v = vert; v < vert_end; v++)
        r->vert[v] = other->vert[v];
    for (uint32_t k = vert * r->config.varyings; k < vert_end * r->config.varyings; k++)
        r->attr[k] = other->attr[k];
    for (uint32_t k = 0; !core && k < r->n_strips; k++)
        r->bin[k] = other->bin[k];
    r->n_tris = s->tris_end;
    r->n_verts = s->verts_end;
    r->large = 0;
}

ZS_RARE void zs_share_set(struct zs_share *share, struct zs_renderer *first,
                          struct zs_renderer *second, uint32_t cut)
{
    const struct zs_share set = { .r = { first, second }, .cut = cut };
    *share = set;
}

ZS_RARE int zs_share_step(struct zs_share *s, uint32_t core, uint32_t step)
{
    struct zs_renderer *const r = s->r[core];
    struct zs_share_part *const p = s->part;
    const int packed = p[0].verts + p[1].verts - p[1].least > r->config.max_verts;
    if (step == 0)
        bin(r, &p[core], core, s->cut);
    if (step == 1 && packed && p[core].ok)
        zs_bin_pack(r);
    if (step == 2 && core)
        second_part(s, packed);
    if (step == 3 && s->joined)
        join(s, r, core);
    else if (step == 3 && p[core].ok)
        zs_frame_open(r);
    return s->joined;
}
