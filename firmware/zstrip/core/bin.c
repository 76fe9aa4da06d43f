/* Binning: the pools of vertices and triangles, and a bin for each strip.
 *
 * The band. A walk bins triangles for a band of strips. When a pool is full, vertices that no
 * triangle uses are removed. If that is not enough, the band ends earlier: the triangles that begin
 * below it are removed too. If the band is a single strip and a pool is still full, zs_bin_room
 * returns 0; the depth buffer then draws the binned triangles. So pools that hold one triangle are
 * enough for any scene; it only takes more walks and sets. A bin below the band counts the
 * triangles that begin there, from which the next walk's band is chosen.
 *
 * The vertex cache. vert_map[v & mask] is the index in the pool where vertex v of the mesh may be.
 * It is used only if that index belongs to the current instance and vert_src holds v there, so the
 * map needs no clearing. While r->direct is set, by an accelerator, vertex v is at vert_base + v.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "core/xform.h"
#include "zs_shader.h"

#define ROOM 8u /* records are removed from a full pool until an eighth of it is free */

static void bins_clear(struct zs_renderer *r)
{
    for (uint32_t s = r->strip; s < r->band_end; s++)
        r->bin[s] = ZS_NIL;
}

void zs_bin_empty(struct zs_renderer *r)
{
    r->n_tris = r->n_verts = r->vert_packed = r->tris_packed = r->vert_base = 0;
    r->active = ZS_NIL;
    bins_clear(r);
}

uint32_t zs_bin_place(struct zs_renderer *r, int32_t y0, int32_t y1)
{
    const uint32_t s = (uint32_t)zs_bin_strip(r, zs_max32(y0, r->walk_y));
    if (s >= r->band_end) {
        if (s < r->band_begun)
            r->bin[s]++;
        return ZS_NIL;
    }
    if (s < r->strip)
        return zs_min32(y1, r->walk_y_end) > r->strip * r->config.strip_h ? r->strip : ZS_NIL;
    return s;
}

void zs_bin_add(struct zs_renderer *r, const uint32_t slot[3], uint16_t paint, uint32_t strip)
{
    const uint32_t n = r->n_tris;
    struct zs_tri *t = &r->tri[n];
    t->v[0] = (uint16_t)slot[0];
    t->v[1] = (uint16_t)slot[1];
    t->v[2] = (uint16_t)slot[2];
    t->next = r->bin[strip];
    t->paint = paint;
    t->instance = (uint16_t)r->xform.number;
    r->bin[strip] = (uint16_t)n;
    r->n_tris = n + 1u;
}

/* ---- Vertices -------------------------------------------------------------------------------- */

void zs_bin_mark(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n)
{
    for (uint32_t k = 0; k < n; k++)
        r->vert_src[slot + k] = (uint16_t)(from + k);
    zs_bin_fresh(r, slot, n);
}

void zs_bin_fresh(struct zs_renderer *r, uint32_t slot, uint32_t n)
{
    const uint32_t varyings = r->config.varyings;
    r->stats.verts_transformed += n;
    if (varyings)
        for (uint16_t *at = &r->attr[slot * varyings], *const end = at + n * varyings; at < end;
             at += varyings)
            *at = ZS_ATTR_UNKNOWN;
}

ZS_NOINLINE void zs_bin_attributes(struct zs_renderer *r, uint32_t slot, uint16_t *attr)
{
    const struct zs_shader *shader = r->xform.instance->material->shader;
    shader->vertex(&r->shading, r->vert_src[slot], attr);
}

/* Transform vertex v, and append it to the pool. Return its index; ZS_NIL: the pool is full. */
static ZS_NOINLINE uint32_t vertex_add(struct zs_renderer *r, uint32_t v)
{
    if (r->n_verts == r->config.max_verts)
        return ZS_NIL;
    const uint32_t slot = r->n_verts++;
    r->vert_map[v & zs_bin_mask(r->config.max_verts)] = (uint16_t)slot;
    zs_bin_mark(r, slot, v, 1);
    if (ZS_IF_FAST(r->batch))
        r->batch->screen(r, v, 1, &r->vert[slot]);
    else
        zs_xform_screen(r, v, &r->vert[slot]);
    return slot;
}

ZS_RARE ZS_NOINLINE int zs_bin_corners(struct zs_renderer *r, const uint16_t index[3],
                                       uint32_t slot[3])
{
    const uint16_t *map = r->vert_map, *src = r->vert_src;
    const uint32_t base = r->vert_base, mask = zs_bin_mask(r->config.max_verts);
    for (int k = 0; k < 3; k++) {
        const uint32_t v = index[k];
        uint32_t s = ZS_IF_FAST(r->direct) ? base + v : map[v & mask];
        if (!ZS_IF_FAST(r->direct) && (s >= r->n_verts || s < base || src[s] != v))
            s = vertex_add(r, v);
        if (s == ZS_NIL)
            return 0;
        slot[k] = s;
    }
    return 1;
}

/* ---- Room ------------------------------------------------------------------------------------ */

/* Remove the binned triangles that begin below the band. The others keep their order. */
static ZS_RARE void tris_pack(struct zs_renderer *r)
{
    uint32_t kept = 0;
    bins_clear(r);
    for (uint32_t t = 0; t < r->n_tris; t++) {
        const struct zs_tri tri = r->tri[t];
        const int32_t y0 = zs_max32(zs_first_sample(r->vert[tri.v[0]].y), 0);
        const int32_t s = zs_max32(zs_bin_strip(r, y0), r->strip);
        if (s >= r->band_end)
            continue;
        r->tri[kept] = tri;
        r->tri[kept].next = r->bin[s];
        r->bin[s] = (uint16_t)kept++;
    }
    r->n_tris = kept;
}

ZS_RARE void zs_bin_pack_new(struct zs_renderer *r)
{
    uint16_t *to = r->vert_map; /* used for new indices; the map is rebuilt below */
    const uint32_t varyings = r->config.varyings, first = r->vert_packed;
    for (uint32_t v = first; v < r->n_verts; v++)
        to[v] = ZS_NIL;
    for (uint32_t t = r->tris_packed; t < r->n_tris; t++)
        for (int k = 0; k < 3; k++)
            to[r->tri[t].v[k]] = 0;
    uint32_t kept = first, base = r->vert_base;
    for (uint32_t v = first; v < r->n_verts; v++) {
        if (v == r->vert_base)
            base = kept;
        if (to[v] == ZS_NIL)
            continue;
        to[v] = (uint16_t)kept;
        r->vert[kept] = r->vert[v];
        r->vert_src[kept] = r->vert_src[v];
        for (uint32_t k = 0; k < varyings; k++)
            r->attr[kept * varyings + k] = r->attr[v * varyings + k];
        kept++;
    }
    if (r->vert_base >= r->n_verts)
        base = kept;
    for (uint32_t t = r->tris_packed; t < r->n_tris; t++)
        for (int k = 0; k < 3; k++)
            if (r->tri[t].v[k] >= first)
                r->tri[t].v[k] = to[r->tri[t].v[k]];
    r->n_verts = r->vert_packed = kept;
    r->tris_packed = r->n_tris;
    r->vert_base = base;
    const uint32_t mask = zs_bin_mask(r->config.max_verts);
    for (uint32_t v = base; v < kept; v++)
        if (r->vert_src[v] != ZS_NO_SOURCE)
            r->vert_map[r->vert_src[v] & mask] = (uint16_t)v;
}

ZS_RARE void zs_bin_pack(struct zs_renderer *r)
{
    r->vert_packed = r->tris_packed = 0;
    zs_bin_pack_new(r);
}

/* Return 1 if all / share + more of a pool's `all` records are free, or all of them are. */
static ZS_RARE int roomy(uint32_t used, uint32_t all, uint32_t share, uint32_t more)
{
    return all - used >= zs_minu32(all / share + more, all);
}

ZS_RARE void zs_bin_count(struct zs_renderer *r)
{
    r->stats.max_tris_used = zs_maxu32(r->stats.max_tris_used, r->n_tris);
    r->stats.max_verts_used = zs_maxu32(r->stats.max_verts_used, r->n_verts);
}

/* Take strips from the band's end, until more than an eighth of the triangles begin below it or one
 * strip is left. From then on, a bin below the band holds the number of its triangles. */
static ZS_RARE void shrink(struct zs_renderer *r)
{
    uint32_t dropped = 0;
    do {
        uint16_t n = 0;
        r->band_end--;
        for (uint32_t t = r->bin[r->band_end]; t != ZS_NIL; t = r->tri[t].next)
            n++;
        r->bin[r->band_end] = n;
        dropped += n;
    } while (r->band_end - r->strip > 1 && dropped <= r->n_tris / ROOM);
    tris_pack(r);
    r->vert_packed = r->tris_packed = 0;
}

/* A quarter of the vertices is made free, not an eighth, in two cases: in the first walk, since
 * most triangles that follow lie below the band; and in a band of one strip, since drawing it in
 * sets costs little. */
ZS_RARE int zs_bin_room(struct zs_renderer *r)
{
    r->direct = 0;
    zs_bin_count(r);
    for (;;) {
        const int one = r->band_end - r->strip == 1;
        if (roomy(r->n_tris, r->config.max_tris, ROOM, 1)) {
            zs_bin_pack_new(r);
            if (roomy(r->n_verts, r->config.max_verts, one || r->counting ? ROOM / 2u : ROOM, 3))
                return 1;
        }
        if (one)
            return 0;
        shrink(r);
    }
}

ZS_RARE void zs_bin_band(struct zs_renderer *r, uint16_t end)
{
    const int32_t bottom = r->band_end * r->config.strip_h;
    uint32_t n = 0;
    if (!r->counting && r->strip == r->band_end) {
        /* at most what the pool has held, and what the vertex pool has vertices for */
        const uint32_t tris = r->tris_packed ? r->tris_packed : r->n_tris;
        const uint32_t verts = r->vert_packed ? r->vert_packed : r->n_verts;
        const uint32_t most = zs_minu32(r->stats.max_tris_used,
                                        tris * r->config.max_verts / (verts + 1u));
        for (uint32_t t = 0; t < r->n_tris; t++) {
            const uint16_t *v = r->tri[t].v;
            n += zs_first_sample(zs_max32(r->vert[v[1]].y, r->vert[v[2]].y)) > bottom;
        }
        for (uint32_t s = r->strip; s < end; s++) {
            n += r->bin[s];
            if (n > most)
                end = (uint16_t)zs_maxu32(s, r->strip + 1u);
        }
    }
    r->band_end = r->band_begun = end;
    zs_bin_empty(r);
}
