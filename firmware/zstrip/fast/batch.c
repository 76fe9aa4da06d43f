/* Whole meshes at a time. If the pool has room for all vertices of a mesh, they are transformed in
 * one loop; else those of each batch are gathered. Triangles are assembled in batches: a loop with
 * 32-bit products rejects those that face away, then the others are binned. Parts of a mesh that do
 * not reach the band are left out: fast/parts.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/assemble.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "zs_shader.h"
#include "core/xform.h"
#include "fast/parts.h"
#include "fast/screen.h"
#include "zs_fast.h"

static inline const int32_t *xy(const struct zs_vertex *v)
{
    return (const int32_t *)(const void *)v;
}
_Static_assert(offsetof(struct zs_vertex, x) == 0 && offsetof(struct zs_vertex, y) == 4,
               "x and y come first");

/* ---- Vertices -------------------------------------------------------------------------------- */

void zs_batch_verts(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n)
{
    zs_bin_mark(r, slot, from, n);
    zs_screen(r, from, n, &r->vert[slot]);
}

/* Transform all vertices of the current mesh, if there is room; without those that only culled
 * clusters use. Else batches gather theirs. */
static void batch_open(struct zs_renderer *r)
{
    const uint32_t n = r->xform.instance->mesh->n_verts, room = r->config.max_verts - r->n_verts;
    r->slow_first = 0;
    r->batched = (uint8_t)zs_parts_batched(r, r->xform.instance);
    if (!r->batched)
        return;
    if (n > r->config.max_verts)
        zs_parts_begin(r, 0);
    if (ZS_IF_FAST(r->parts_tris) && !r->counting && !zs_parts_whole(r))
        return;
    if (n > room && n - room <= r->n_verts - r->vert_packed) { /* there may be room */
        zs_bin_count(r);
        zs_bin_pack_new(r);
    }
    const uint32_t base = r->n_verts;
    r->vert_base = base;
    r->direct = n <= r->config.max_verts - base;
    if (!r->direct)
        return;
    r->n_verts += n;
    if (!r->by_clusters || !r->clusters_hooks->verts(r))
        zs_batch_verts(r, base, 0, n);
}

/* ---- Facing ---------------------------------------------------------------------------------- */

/* Triangles are assembled in batches. The first loop rejects those that face away. */
#define BATCH 40 /* at most 64 */
struct batch {
    const uint16_t (*tri)[3];     /* the batch's first triangle */
    const struct zs_vertex *pool; /* what their numbers count from */
    const struct zs_shader *shader;
    uint32_t n_verts;    /* what their numbers are below */
    uint32_t base;       /* the index of `pool` in the vertex pool */
    int32_t away;        /* 1, -1 or 0: area * away > 0 means culled by its facing */
    uint32_t *fate;      /* [ZS_FATES]: counts of rejected triangles */
    uint32_t *piece;     /* of a clipped triangle, as in zs_assemble_tri */
    uint8_t left[BATCH]; /* the triangles that remain: 4 * number in the batch, + 1 if the triangle
                            is counter-clockwise, + 2 if it is a slow case */
    uint16_t corner[BATCH][3]; /* gathered: their vertices' indices in the pool */
};

/* Count a rejected triangle, for a reason other than its facing. */
static ZS_NOINLINE void dropped(struct batch *s, enum zs_fate fate)
{
    s->fate[fate]++;
    s->fate[ZS_FATE_FACING]--; /* because reject() counts all rejected triangles there */
}

/* Handle a triangle that is large, or has a vertex outside near, far or the guard band. Return 0 if
 * it is outside the view, and reject it; 1: zs_assemble_tri takes it. */
static ZS_NOINLINE int slow_case(struct batch *s, const uint16_t index[3])
{
    const struct zs_vertex *const pool = s->pool;
    if (index[0] >= s->n_verts || index[1] >= s->n_verts || index[2] >= s->n_verts)
        return 1;
    const uint32_t all = pool[index[0]].d & pool[index[1]].d & pool[index[2]].d;
    if (all <= ZS_D_OUT)
        return 1;
    dropped(s, zs_fate_outside(all));
    return 0;
}

/* Reject the triangles that are outside a plane of the view, and the small ones that face away, for
 * which 32-bit products suffice. Return how many remain. Vertices outside near, far or the guard
 * band need no test of their own: zs_screen places them so far from all others that their triangles
 * are never small. */
ZS_IN_ORDER static ZS_NOINLINE uint32_t reject(struct batch *s, uint32_t n)
{
    const struct zs_vertex *const pool = s->pool;
    const uint16_t(*tri)[3] = s->tri;
    const uint32_t n_verts = s->n_verts;
    const uint32_t end = 4u * n;
    uint8_t *out = s->left;
    for (uint32_t t = 0; t < end; t += 4u, tri++) {
        const uint32_t i = (*tri)[0], j = (*tri)[1], k = (*tri)[2];
        uint32_t wide = 1;
        int32_t area = 0;
        if (i < n_verts && j < n_verts && k < n_verts)
            area = zs_area_short(xy(pool + i), xy(pool + j), xy(pool + k), &wide);
        if (wide) {
            if (slow_case(s, *tri))
                *out++ = (uint8_t)(t + 2u);
        } else if (area == 0) {
            dropped(s, ZS_FATE_ZERO);
        } else if (area * s->away <= 0) {
            *out++ = (uint8_t)(t + ((uint32_t)area >> 31));
        }
    }
    ZS_ANEW(s); /* so the compiler does not keep s->left in a register during the loop */
    const uint32_t left = (uint32_t)(out - s->left);
    s->fate[ZS_FATE_FACING] += end / 4u - left;
    return left;
}

/* ---- Boxes and bins -------------------------------------------------------------------------- */

ZS_ALWAYS_INLINE void turn(struct zs_candidate *at)
{
    const uint32_t first = at->slot[0];
    at->slot[0] = at->slot[1];
    at->slot[1] = at->slot[2];
    at->slot[2] = first;
}

/* The same as zs_assemble_box, with all values in registers. */
ZS_ALWAYS_INLINE enum zs_fate box(struct zs_renderer *r, const struct zs_vertex *a,
                                  const struct zs_vertex *b, const struct zs_vertex *c,
                                  struct zs_candidate *at)
{
    const int32_t ax = a->x, ay = a->y, bx = b->x, by = b->y, cx = c->x, cy = c->y;
    int32_t least = ax, most = bx, top = ay, bottom = by;
    if (by < ay || (by == ay && bx < ax)) {
        bottom = ay;
        top = by;
        turn(at);
        if (cy < by || (cy == by && cx < bx)) {
            top = cy;
            turn(at);
        } else if (cy > ay) {
            bottom = cy;
        }
    } else if (cy < ay || (cy == ay && cx < ax)) {
        top = cy;
        turn(at);
        turn(at);
    } else if (cy > by) {
        bottom = cy;
    }
    if (most < least) {
        least = bx;
        most = ax;
    }
    if (cx < least)
        least = cx;
    else if (cx > most)
        most = cx;
    const int32_t x0 = zs_first_sample(least), x1 = zs_first_sample(most);
    const int32_t y0 = zs_first_sample(top), y1 = zs_first_sample(bottom);
    at->y0 = y0;
    at->y1 = y1;
    if (x1 <= r->walk_x || x0 >= r->walk_end || y1 <= r->walk_y || y0 >= r->walk_y_end)
        return ZS_FATE_OFFSCREEN;
    if (x0 >= x1 || y0 >= y1)
        return ZS_FATE_EMPTY;
    return ZS_FATE_DRAWN;
}

/* Bin a candidate that passed the facing test. Inlined, so that *at stays in registers. */
ZS_ALWAYS_INLINE enum zs_fate bin(struct zs_renderer *r, const struct zs_shader *shader, uint32_t t,
                                  struct zs_candidate *at)
{
    const enum zs_fate fate = box(r, &r->vert[at->slot[0]], &r->vert[at->slot[1]],
                                  &r->vert[at->slot[2]], at);
    if (fate != ZS_FATE_DRAWN)
        return fate;
    const uint32_t strip = zs_bin_first(r, at->y0, at->y1);
    if (strip == ZS_NIL) {
        zs_bin_below(r, at->y0);
        return fate;
    }
    if (r->n_tris == r->config.max_tris)
        return ZS_FATE_FULL;
    if (shader->vertex) {
        const uint32_t varyings = r->config.varyings;
        zs_bin_corner(r, at->slot[0], varyings);
        zs_bin_corner(r, at->slot[1], varyings);
        zs_bin_corner(r, at->slot[2], varyings);
    }
    zs_bin_push(r, at->slot, shader->face ? shader->face(&r->shading, t) : 0u, strip);
    return ZS_FATE_DRAWN;
}

/* Bin the n remaining triangles of the batch that begins at triangle `from`. Return how many are
 * done; fewer than n if a pool is full. */
static uint32_t bin_all(struct zs_renderer *r, const struct batch *s, uint32_t from, uint32_t n,
                        uint32_t fate[ZS_FATES])
{
    for (const uint8_t *left = s->left, *const end = left + n; left < end; left++) {
        const uint32_t what = *left, t = from + what / 4u;
        enum zs_fate f;
        if (what & 2u) {
            f = zs_assemble_tri(r, t, s->piece);
        } else {
            const uint16_t *index = s->tri[what / 4u];
            const uint32_t base = s->base, second = base + index[1], third = base + index[2];
            struct zs_candidate at;
            at.slot[0] = base + index[0];
            at.slot[1] = what & 1u ? third : second;
            at.slot[2] = what & 1u ? second : third;
            f = bin(r, s->shader, t, &at);
        }
        if (f == ZS_FATE_FULL)
            return (uint32_t)(left - s->left);
        fate[f]++;
    }
    return n;
}

/* A pool got full at triangle t of a batch. Subtract the rejects from t on, because they will be
 * counted again. */
static ZS_RARE ZS_NOINLINE void drop_less(struct batch *s, uint32_t from, uint32_t n, uint32_t t,
                                          uint32_t fate[ZS_FATES])
{
    uint32_t less[ZS_FATES] = { 0 };
    s->fate = less;
    s->tri += t - from;
    (void)reject(s, from + n - t);
    for (uint32_t k = 0; k < ZS_FATES; k++)
        fate[k] -= less[k];
}

/* ---- Gathering ------------------------------------------------------------------------------- */

/* Transform the vertices that were appended to the pool from `slot` on. Their numbers are known. */
static void transform_new(struct zs_renderer *r, uint32_t slot)
{
    const uint16_t *src = r->vert_src;
    while (slot < r->n_verts) {
        const uint32_t from = src[slot];
        uint32_t n = 1;
        while (slot + n < r->n_verts && src[slot + n] == from + n)
            n++;
        zs_batch_verts(r, slot, from, n);
        slot += n;
    }
}

/* Find the vertices of the mesh's triangles [from, from + n) in the pool, or transform them into
 * it. Return how many triangles have theirs; fewer than n if the pool is full. */
static ZS_NOINLINE uint32_t gather(struct zs_renderer *r, struct batch *s, uint32_t from,
                                   uint32_t n)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint32_t cap = r->config.max_verts, base = r->vert_base, mask = zs_bin_mask(cap);
    const uint32_t first = r->n_verts;
    uint16_t *const src = r->vert_src, *const map = r->vert_map;
    const uint16_t *index = mesh->tri[from], *const end = index + 3u * n;
    uint16_t *to = s->corner[0];
    uint32_t top = first;
    for (; index != end; index++, to++) {
        const uint32_t v = *index;
        uint16_t *const entry = map + (v & mask);
        uint32_t slot = *entry;
        if (slot - base >= top - base || src[slot] != v) {
            slot = ZS_NIL; /* a number out of range: a slow case */
            if (v < mesh->n_verts) {
                if (top == cap)
                    break;
                slot = top++;
                *entry = (uint16_t)slot;
                src[slot] = (uint16_t)v;
            }
        }
        *to = (uint16_t)slot;
    }
    r->n_verts = top;
    transform_new(r, first);
    s->tri = (const uint16_t(*)[3])s->corner;
    s->n_verts = top;
    return (uint32_t)(to - s->corner[0]) / 3u;
}

static ZS_NOINLINE uint32_t batch_bin(struct zs_renderer *r, uint32_t from, uint32_t end,
                                      uint32_t fate[ZS_FATES], uint32_t *piece)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_mesh *mesh = in->mesh;
    const uint32_t cull = in->material->cull;
    struct batch s;
    s.n_verts = mesh->n_verts;
    s.away = cull == ZS_CULL_BACK ? 1 : cull == ZS_CULL_FRONT ? -1 : 0;
    s.fate = fate;
    s.piece = piece;
    s.shader = in->material->shader;
    s.base = r->direct ? r->vert_base : 0u;
    s.pool = &r->vert[s.base];
    if (r->slow_first) {
        const enum zs_fate f = zs_assemble_tri(r, from, piece);
        if (f == ZS_FATE_FULL)
            return from;
        r->slow_first = 0;
        fate[f]++;
        from++;
    }
    for (uint32_t n; from < end; from += n) {
        n = zs_minu32(end - from, BATCH);
        if (r->parts_tris && (n = zs_parts_next(r, &from, end, n)) == 0)
            break;
        s.tri = mesh->tri + from;
        if (!r->direct && (n = gather(r, &s, from, n)) == 0)
            return from;
        const uint32_t left = reject(&s, n);
        if (r->parts_tris)
            zs_parts_note(r, from, s.pool, s.tri, s.left, left);
        const uint32_t done = bin_all(r, &s, from, left, fate);
        if (done < left) {
            const uint32_t t = from + s.left[done] / 4u;
            r->slow_first = !r->direct && s.left[done] & 2u;
            drop_less(&s, from, n, t, fate);
            return t;
        }
    }
    return end;
}

static const struct zs_fast_batch batch = { .needs = zs_screen_needs,
                                            .open = batch_open,
                                            .bin = batch_bin,
                                            .screen = zs_screen,
                                            .full = zs_parts_begin,
                                            .spare = zs_parts_end,
                                            .beside = zs_parts_beside };
const struct zs_fast zs_fast_batch = { .batch = &batch };
