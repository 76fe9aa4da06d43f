/* Whole meshes at a time. If the pool has room for all vertices of a mesh, they are transformed in
 * one loop; else those of some triangles at a time are gathered. Triangles of up to 128 px are
 * assembled in one loop, too, with 32-bit products; others by the core, one by one (slow cases).
 * Parts of a mesh that do not reach the band are left out: fast/parts.c. Declined are primitives,
 * shaders that move vertices, and a few others (zs_parts_batched). What it is worth: zs_fast.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/assemble.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "core/xform.h"
#include "fast/parts.h"
#include "fast/screen.h"
#include "fast/sweep.h"
#include "shade/stages.h"
#include "zs_fast.h"
#include "zs_shader.h"

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

int zs_batch_room(struct zs_renderer *r)
{
    const uint32_t n = r->xform.instance->mesh->n_verts, room = r->config.max_verts - r->n_verts;
    r->slow_first = 0;
    r->batched = (uint8_t)zs_parts_batched(r, r->xform.instance);
    if (!r->batched)
        return 0;
    if (n > r->config.max_verts)
        zs_parts_begin(r, 0);
    if (ZS_IF_FAST(r->parts_tris) && !r->counting && !zs_parts_whole(r))
        return 0;
    if (n > room && n - room <= r->n_verts - r->vert_packed) { /* there may be room */
        zs_bin_count(r);
        zs_bin_pack_new(r);
    }
    const uint32_t base = r->n_verts;
    r->vert_base = base;
    r->direct = n <= r->config.max_verts - base;
    if (r->direct)
        r->n_verts += n;
    return r->direct;
}

/* Transform all vertices of the current mesh, if there is room; without those that only culled
 * clusters use. Else batches gather theirs. */
static void batch_open(struct zs_renderer *r)
{
    if (zs_batch_room(r) && (!r->by_clusters || !r->clusters_hooks->verts(r)))
        zs_batch_verts(r, r->vert_base, 0, r->n_verts - r->vert_base);
}

/* ---- Facing, box and bin --------------------------------------------------------------------- */

/* A triangle on the screen, as zs_area_short sets it, and its vertices' numbers in the mesh. */
struct corners {
    int32_t at[6];
    uint32_t i, j;
    const uint16_t *k; /* loaded when it is needed: it would be spilled */
};

/* Return 1 if a triangle that is too wide for 16 bits, or has a vertex that is not projected, is
 * outside the view, and count it. */
SWEEP_PART int zs_sweep_outside(struct zs_sweep *s, const uint16_t index[3])
{
    const struct zs_vertex *const pool = s->pool;
    const uint32_t n_verts = s->n_verts;
    if (index[0] >= n_verts || index[1] >= n_verts || index[2] >= n_verts)
        return 0;
    const uint32_t all = pool[index[0]].d & pool[index[1]].d & pool[index[2]].d;
    if (all > ZS_D_OUT)
        s->outcome[zs_outcome_outside(all)]++;
    return all > ZS_D_OUT;
}

/* Take a triangle that place() does not: it is wide, has a vertex that is not projected, or comes
 * when the pool is full. Return 0: there is no room for it. */
static ZS_NOINLINE int slow_case(struct zs_sweep *s, uint32_t t)
{
    struct zs_renderer *r = s->r;
    r->n_tris = s->n;
    const enum zs_outcome outcome = zs_assemble_tri(r, t, s->piece);
    s->placed -= r->n_tris - s->n;
    s->n = r->n_tris;
    s->out = &r->tri[s->n];
    if (outcome == ZS_OUTCOME_FULL)
        return 0;
    s->outcome[outcome]++;
    return 1;
}

/* Return the strip of a box that is empty or does not begin in rows that are drawn in the band.
 * ZS_NIL: none; it is counted. */
SWEEP_PART uint32_t zs_sweep_aside(struct zs_sweep *s, int32_t empty, int32_t y0, int32_t y1)
{
    struct zs_renderer *r = s->r;
    uint32_t strip = ZS_NIL;
    enum zs_outcome outcome = ZS_OUTCOME_DRAWN;
    if (y1 <= r->walk_y || y0 >= r->walk_y_end)
        outcome = ZS_OUTCOME_OFFSCREEN;
    else if (empty || y0 >= y1)
        outcome = ZS_OUTCOME_EMPTY;
    else
        strip = zs_bin_place(r, y0, y1);
    if (strip == ZS_NIL) {
        s->outcome[outcome]++;
        if (outcome == ZS_OUTCOME_DRAWN) {
            s->y0 = zs_min32(s->y0, y0);
            s->y1 = zs_max32(s->y1, y1);
        }
    }
    return strip;
}

/* Bin triangle t, whose corners are clockwise, unless it holds no sample that is drawn: as
 * zs_assemble_box and zs_bin_add, with all values in registers. */
ZS_ALWAYS_INLINE void place(struct zs_sweep *s, uint32_t t, const struct corners *c)
{
    const int32_t x = c->at[0], y = c->at[1], dx1 = c->at[2], dx2 = c->at[4];
    int32_t dy1 = c->at[3], dy2 = c->at[5];
    ZS_ANEW(dy1); /* so that the rows of the second and third vertex are not kept besides */
    ZS_ANEW(dy2);
    uint32_t v0 = c->i, v1 = c->j,
             v2 = *c->k; /* the top one first; the left one of two on a level */
    int32_t top = 0, bottom = zs_max32(dy1, dy2);
    if (((dy1 + (dx1 >> 31)) | (dy2 + (dx2 >> 31))) < 0) {
        if (dy1 - dy2 + ((dx1 - dx2) >> 31) < 0) {
            v0 = c->j;
            v1 = *c->k;
            v2 = c->i;
            top = dy1;
            bottom = dy2 & ~(dy2 >> 31);
        } else {
            v0 = *c->k;
            v1 = c->i;
            v2 = c->j;
            top = dy2;
            bottom = dy1 & ~(dy1 >> 31);
        }
    }
    const int32_t least = zs_min32(dx1, dx2), most = zs_max32(dx1, dx2);
    const int32_t x0 = zs_first_sample(x + (least & least >> 31)),
                  x1 = zs_first_sample(x + (most & ~(most >> 31))), y0 = zs_first_sample(y + top),
                  y1 = zs_first_sample(y + bottom);
    if (ZS_SELDOM(x1 <= s->x || x0 >= s->x_end)) {
        s->outcome[ZS_OUTCOME_OFFSCREEN]++;
        return;
    }
    uint32_t strip;
    if (ZS_SELDOM((uint32_t)y0 - s->row >= s->rows || x0 >= x1 || y0 >= y1)) {
        strip = zs_sweep_aside(s, x0 >= x1, y0, y1);
        if (strip == ZS_NIL)
            return;
    } else {
        strip = (uint32_t)y0 * s->strip_mul >> s->strip_shift;
    }
    struct zs_tri *const out = s->out;
    const uint32_t base = s->base;
    out->v[0] = (uint16_t)(base + v0);
    out->v[1] = (uint16_t)(base + v1);
    out->v[2] = (uint16_t)(base + v2);
    out->instance = s->instance;
    out->next = s->bin[strip];
    s->bin[strip] = (uint16_t)s->n++;
    s->out = out + 1;
    if (s->varyings) {
        zs_bin_corner(s->r, base + v0, s->varyings);
        zs_bin_corner(s->r, base + v1, s->varyings);
        zs_bin_corner(s->r, base + v2, s->varyings);
    }
    out->paint = s->face ? s->face(&s->r->shading, t) : 0u;
}

/* Bin triangles [t, end), whose vertices' numbers are at tri. Return `end`, or the triangle for
 * which the pool is full. Vertices outside near, far or the guard band need no test of their own:
 * zs_screen places them so far from all others that their triangles are never small. */
SWEEP_EACH uint32_t zs_sweep_each(struct zs_sweep *s, uint32_t t, uint32_t end,
                                  const uint16_t (*tri)[3])
{
    for (; t < end; t++, tri++) {
        /* counter-clockwise in the mesh, as most that are not culled */
        const uint32_t i = (*tri)[0], j = (*tri)[2], k = (*tri)[1], n_verts = s->n_verts;
        uint32_t wide = 1;
        int32_t at[6], area = 0;
        if (i < n_verts && j < n_verts && k < n_verts) {
            const struct zs_vertex *const pool = s->pool;
            area = zs_area_short(at, xy(pool + i), xy(pool + j), xy(pool + k), &wide);
        }
        if (wide ? zs_sweep_outside(s, *tri) : area * s->keep < 0)
            continue;
        if (ZS_SELDOM(!wide && area == 0)) {
            s->outcome[ZS_OUTCOME_ZERO]++;
        } else if (wide || s->out == s->full || ZS_V7M) { /* there all others are binned by hand */
            if (s->by_batches || !slow_case(s, t))
                break;
        } else {
            struct corners c = { { at[0], at[1], at[2], at[3], at[4], at[5] }, i, j, &(*tri)[1] };
            if (ZS_SELDOM(area < 0))
                c = (struct corners){
                    { at[0], at[1], at[4], at[5], at[2], at[3] }, i, k, &(*tri)[2]
                };
            ZS_ANEW(c.k);
            place(s, t, &c);
        }
    }
    return t;
}

#if ZS_SET_UP || ZS_V7M

#if ZS_V7M
/* Compute the attributes of a record's vertices. */
ZS_NOINLINE void zs_sweep_attributes(const struct zs_sweep *s, const struct zs_tri *of)
{
    for (int k = 0; k < 3; k++)
        zs_bin_corner(s->r, of->v[k], s->varyings);
}

/* zs_sweep_by_hand where front faces are culled, by corners in the other order: 16 triangles at a
 * time are copied. */
ZS_NOINLINE uint32_t zs_sweep_turned(struct zs_sweep *s, uint32_t t, uint32_t end,
                                     const uint16_t (*tri)[3])
{
    uint16_t turned[16][3];
    uint32_t n;
    s->keep = 1;
    do {
        const uint32_t from = t;
        n = zs_minu32(end - t, 16u);
        for (uint32_t k = 0; k < n; k++, tri++) {
            turned[k][0] = (*tri)[0];
            turned[k][1] = (*tri)[2];
            turned[k][2] = (*tri)[1];
        }
        t = zs_sweep_by_hand(s, from, from + n, (const uint16_t(*)[3])turned);
        n -= t - from;
    } while (n == 0 && t != end);
    s->keep = -1;
    return t;
}
#endif

/* The same for all, most of them by hand: on Armv7-M as many as the pool has room for. */
static inline uint32_t sweep(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3])
{
    for (;;) {
#if ZS_V7M
        const uint32_t most = zs_minu32(end - t, (uint32_t)(s->full - s->out));
        const uint32_t at = s->keep < 0 ? zs_sweep_turned(s, t, t + most, tri)
                                        : zs_sweep_by_hand(s, t, t + most, tri);
#else
        const uint32_t most = end - t;
        const uint32_t at = zs_sweep_by_hand(s, t, end, tri);
#endif
        const int all = at - t == most && most; /* of them; not each has taken a record */
        tri += at - t;
        t = at;
        if (t == end)
            return t;
        if (all)
            continue;
        if (zs_sweep_each(s, t, t + 1, tri) == t)
            return t;
        t++;
        tri++;
    }
}

#else

ZS_IN_ORDER static ZS_NOINLINE uint32_t sweep(struct zs_sweep *s, uint32_t t, uint32_t end,
                                              const uint16_t (*tri)[3])
{
    return zs_sweep_each(s, t, end, tri);
}

#endif

/* The sum of all outcomes. */
static uint32_t sum(const uint32_t outcome[ZS_OUTCOMES])
{
    uint32_t n = 0;
    for (uint32_t k = 0; k < ZS_OUTCOMES; k++)
        n += outcome[k];
    return n;
}

/* sweep(), which counts all outcomes but this one. */
static uint32_t counted(struct zs_sweep *s, uint32_t from, uint32_t end, const uint16_t (*tri)[3])
{
    s->placed = 0u - s->n;
    s->y0 = INT32_MAX;
    s->y1 = INT32_MIN;
    s->before = sum(s->outcome) - from;
    const uint32_t reached = sweep(s, from, end, tri);
    s->r->n_tris = s->n;
    s->outcome[ZS_OUTCOME_DRAWN] += s->placed + s->n;
    s->outcome[ZS_OUTCOME_FACING] += s->before + reached - sum(s->outcome);
    return reached;
}

/* ---- Pools that do not hold the scene -------------------------------------------------------- */

#define BATCH 40 /* triangles, whose vertices are gathered, and whose rows are noted */

/* Find the vertices of the mesh's triangles [from, from + n) in the pool, or transform them into
 * it. Return how many triangles have theirs; fewer than n if the pool is full. */
static ZS_NOINLINE uint32_t gather(struct zs_renderer *r, uint32_t from, uint32_t n,
                                   uint16_t (*corner)[3])
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint32_t cap = r->config.max_verts, base = r->vert_base, mask = zs_bin_mask(cap);
    const uint32_t first = r->n_verts;
    uint16_t *const src = r->vert_src, *const map = r->vert_map;
    const uint16_t *index = mesh->tri[from], *const end = index + 3u * n;
    uint16_t *to = corner[0];
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
    zs_bin_fresh(r, first, top - first);
    zs_screen_known(r, first, top);
    return (uint32_t)(to - corner[0]) / 3u;
}

/* Bin triangles [from, end) in batches. Return the triangle that it reached: one that is a slow
 * case, or for which a pool is full. */
static ZS_NOINLINE uint32_t by_batches(struct zs_sweep *s, uint32_t from, uint32_t end)
{
    struct zs_renderer *r = s->r;
    uint16_t corner[BATCH][3];
    for (uint32_t n, reached; from < end; from = reached) {
        const uint16_t(*tri)[3];
        n = zs_minu32(end - from, BATCH);
        if (r->parts_tris && (n = zs_parts_next(r, &from, end, n)) == 0)
            break;
        tri = r->xform.instance->mesh->tri + from;
        if (!r->direct) {
            if ((n = gather(r, from, n, corner)) == 0) {
                s->full_verts = 1;
                return from;
            }
            tri = (const uint16_t(*)[3])corner;
            s->n_verts = r->n_verts;
        }
        const int noted = r->parts_tris && zs_parts_noted(r, from);
        const struct zs_tri *const first = s->out;
        reached = counted(s, from, from + n, tri);
        if (noted)
            zs_parts_note(r, from, first, s->out, s->y0, s->y1);
        if (reached < from + n)
            return reached;
    }
    return end;
}

static void begin(struct zs_sweep *s, struct zs_renderer *r)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_shader *shader = in->material->shader;
    const uint32_t cull = in->material->cull;
    const int32_t height = r->config.strip_h, row = zs_max32(r->walk_y, r->strip * height),
                  end_row = zs_min32(r->walk_y_end, r->band_end * height);
    s->r = r;
    s->base = r->direct ? (uint16_t)r->vert_base : 0u;
    s->pool = &r->vert[s->base];
    s->n_verts = in->mesh->n_verts;
    s->keep = cull == ZS_CULL_BACK ? 1 : cull == ZS_CULL_FRONT ? -1 : 0;
    s->x = r->walk_x;
    s->x_end = r->walk_end;
    s->row = (uint32_t)row;
    s->rows = (uint32_t)zs_max32(end_row - row, 0);
    s->strip_mul = r->strip_mul;
    s->strip_shift = r->strip_shift;
    s->bin = r->bin;
    s->varyings = shader->vertex ? r->config.varyings : 0u;
    s->face = shader->face;
#if ZS_V7M
    if ((s->raw = shader->opaque == ZS_RAW ? in->mesh->face_raw : 0) != 0)
        s->face = 0;
#endif
    s->instance = (uint16_t)r->xform.number;
    s->n = r->n_tris;
    s->out = r->tri + s->n;
    s->full = r->tri + r->config.max_tris;
}

/* In batches, a slow case is assembled here, without their memory on the stack. */
ZS_NOINLINE uint32_t zs_batch_bin(struct zs_renderer *r, uint32_t from, uint32_t end,
                                  uint32_t *outcome, uint32_t *piece)
{
    struct zs_sweep s;
    s.outcome = outcome;
    s.piece = piece;
    s.by_batches = !r->direct || r->parts_tris;
    s.full_verts = 0;
    for (;; r->slow_first = 1) {
        if (r->slow_first) {
            const enum zs_outcome f = zs_assemble_tri(r, from, piece);
            if (f == ZS_OUTCOME_FULL)
                return from;
            r->slow_first = 0;
            if (r->parts_tris)
                zs_parts_unknown(r, from);
            outcome[f]++;
            from++;
        }
        begin(&s, r);
        if (!s.by_batches)
            return counted(&s, from, end, r->xform.instance->mesh->tri + from);
        from = by_batches(&s, from, end);
        if (from == end || s.full_verts)
            return from;
    }
}

static const struct zs_fast_batch batch = {
    .needs = zs_screen_needs, .open = batch_open, .bin = zs_batch_bin, .screen = zs_screen,
    .full = zs_parts_begin, .spare = zs_parts_end, .beside = zs_parts_beside
};
const struct zs_fast zs_fast_batch = { .batch = &batch };
