/* The triangles of a strip in order of depth, after Newell, Newell and Sancha (1972).
 *
 * The list is sorted by farthest vertex. Its head P is drawn next if it is nearer than no other
 * element Q at any pixel that both have. Only elements as far as P's nearest vertex are asked. If Q
 * is in the way, it is drawn before P: it moves to the head. If P and Q cross, or if Q was moved
 * already (a cycle), P is split along the line on the screen where both are equally near: its
 * farther part stays at the head, its nearer part goes back to the list. In a cycle, that line may
 * miss P; then it splits Q.
 *
 * The list has two parts. The first `moved` elements were moved to the head; the rest is sorted. An
 * element is moved at most once, as it leaves the first part only when it is drawn, and records for
 * pieces are limited. So the loop ends.
 *
 * If records run out, if a piece has too many half-planes or if a cycle has no line that splits,
 * the rectangle is halved: columns first, then rows. A single pixel needs no order: the nearest
 * triangle is found by a loop. Rectangles tile the strip, so that every pixel is drawn in one.
 *
 * If the triangle pool is full and the band is a single strip, the rectangle is halved too, and
 * triangles beside it leave the pool; later walks find them again. At a single pixel all but the
 * nearest leave it. So any pool of two triangles will do.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/method.h"
#include "core/raster.h"
#include "core/walk.h"
#include "method/newell.h"
#include "method/sort.h"
#include "zs_method.h"
#include "zs_shader.h"

int zs_order_begin(struct zs_renderer *r)
{
    r->method_state = 0;
    if (r->config.depth != &zs_depth_order)
        return ZS_ERR_DEPTH;
    return r->config.max_tris >= 2 && r->config.max_verts >= 6 ? ZS_OK : ZS_ERR_SIZE;
}

/* ---- Rectangles ------------------------------------------------------------------------------ */

static int is_pixel(const struct zs_order *o)
{
    return o->x1 - o->x0 == 1 && o->y1 - o->y0 == 1;
}

static void halve(struct zs_order *o)
{
    if (o->x1 - o->x0 > 1)
        o->x1 -= (o->x1 - o->x0) / 2;
    else
        o->y1 -= (o->y1 - o->y0) / 2;
    o->torn = 1;
}

/* Forget the triangles that were met. */
static void pixel_begin(struct zs_order *o)
{
    o->met = o->kept = 0;
}

static void rectangle_begin(struct zs_order *o)
{
    pixel_begin(o);
    o->limit.d = INT64_MAX;
}

/* Go on to the next rectangle, at most twice as large as the last one. Return 0 if there is none.
 * top, bottom: the strip's rows. */
static int next_rectangle(const struct zs_renderer *r, struct zs_order *o, int32_t top,
                          int32_t bottom)
{
    const int32_t w = o->x1 - o->x0, h = o->y1 - o->y0, end = r->window[1];
    rectangle_begin(o);
    if (o->y1 < bottom) {
        o->y0 = o->y1;
        o->y1 = zs_min32(bottom, o->y1 + 2 * h);
        return 1;
    }
    o->y0 = top;
    o->y1 = bottom;
    o->x0 = o->x1;
    o->x1 = zs_min32(end, o->x1 + 2 * w);
    return o->x0 < end;
}

/* Return 1 if the box of a triangle or piece has a sample in columns [x0, x1), rows [y0, y1). */
static int in_box(const struct zs_renderer *r, uint32_t t, int32_t x0, int32_t x1, int32_t y0,
                  int32_t y1)
{
    const uint16_t *v = r->tri[t].v;
    const struct zs_vertex *a = &r->vert[v[0]], *b = &r->vert[v[1]], *c = &r->vert[v[2]];
    return zs_first_sample(a->y) < y1 && zs_first_sample(zs_max32(b->y, c->y)) > y0 &&
           zs_first_sample(zs_min32(a->x, zs_min32(b->x, c->x))) < x1 &&
           zs_first_sample(zs_max32(a->x, zs_max32(b->x, c->x))) > x0;
}

/* Return 1 if it has a sample in the rectangle. */
static int touches(const struct zs_renderer *r, uint32_t t)
{
    const struct zs_order *o = r->method_state;
    return in_box(r, t, o->x0, o->x1, o->y0, o->y1);
}

/* Load an element, its box clipped to the rectangle. */
static void load(const struct zs_renderer *r, uint32_t t, struct zs_piece *p)
{
    const struct zs_order *o = r->method_state;
    zs_piece_load(r, t, p);
    p->x0 = zs_max32(p->x0, o->x0);
    p->x1 = zs_min32(p->x1, o->x1);
    p->y0 = zs_max32(p->y0, o->y0);
    p->y1 = zs_min32(p->y1, o->y1);
}

/* ---- A single pixel -------------------------------------------------------------------------- */

/* Return 1 if every layer of a pixel has to be drawn: some shader leaves pixels alone, or mixes. */
static int layered(const struct zs_renderer *r)
{
    const struct zs_order *o = r->method_state;
    for (uint32_t k = 0; k < r->n_instances && !o->near_first; k++)
        if (!r->scene->instance[k].material->shader->opaque)
            return 1;
    return 0;
}

static int before(const struct zs_layer *a, const struct zs_layer *b)
{
    return a->d != b->d ? a->d < b->d : a->number < b->number;
}

/* Return the triangle of the pool to draw at the rectangle's only pixel: the nearest or, of layers,
 * the farthest before the limit. ZS_NIL: none. Triangles are met once, in scene order. */
static ZS_NOINLINE uint32_t pixel_pick(const struct zs_renderer *r)
{
    struct zs_order *o = r->method_state;
    const int layers = layered(r);
    struct zs_piece p;
    uint32_t at = o->kept ? 0 : ZS_NIL;
    for (uint32_t t = o->kept; t < r->n_tris; t++) {
        if (!touches(r, t))
            continue;
        load(r, t, &p);
        zs_piece_plane(&p);
        zs_piece_lines(r, t, &p);
        if (!zs_piece_meet(&p, 0, &p.plane))
            continue;
        const struct zs_layer is = { zs_linear_at(&p.plane, o->x0, o->y0), o->met++ };
        if (layers && !before(&is, &o->limit))
            continue;
        if (at == ZS_NIL || (layers ? before(&o->best, &is) : before(&is, &o->best))) {
            o->best = is;
            at = t;
        }
    }
    return at;
}

/* ---- The list -------------------------------------------------------------------------------- */

/* What the ordering of a list has in hand. */
struct ordering {
    struct zs_piece p, q;     /* the head, and an element that is in its way ... */
    struct zs_linear nearer;  /* ... < 0 where the head is nearer */
    uint16_t list;
    uint32_t moved;
};

/* Put an element into the sorted part of the list, behind those that are as far. */
static void insert(const struct zs_renderer *r, struct ordering *g, uint32_t t)
{
    uint16_t *link = &g->list;
    for (uint32_t k = 0; k < g->moved; k++)
        link = &r->tri[*link].next;
    while (*link != ZS_NIL && zs_sort_farthest(r, *link) >= zs_sort_farthest(r, t))
        link = &r->tri[*link].next;
    r->tri[t].next = *link;
    *link = (uint16_t)t;
}

/* Make a piece of element t: its part that is nearer than triangle `other`, or the part that is
 * not. Return its record; there is room. */
static uint32_t piece_make(struct zs_renderer *r, uint32_t t, uint32_t other, uint32_t nearer)
{
    struct zs_order *o = r->method_state;
    const uint32_t piece = o->used;
    struct zs_tri *cut = &r->tri[piece + 1u];
    o->used += 2;
    r->tri[piece] = r->tri[t];
    cut->ZS_PIECE_SOURCE = (uint16_t)zs_piece_source(r, t);
    cut->ZS_PIECE_OTHER = (uint16_t)other;
    cut->ZS_PIECE_PARENT = (uint16_t)(t < r->n_tris ? ZS_NIL : t);
    cut->ZS_PIECE_NEARER = (uint16_t)nearer;
    return piece;
}

/* Split an element, which is in no list now, by the plane of a triangle. Its farther part becomes
 * the head of the list. Return 0 if memory does not suffice. */
static int split(struct zs_renderer *r, struct ordering *g, uint32_t t, uint32_t other)
{
    struct zs_order *o = r->method_state;
    if (o->end - o->used < 4 || zs_piece_depth(r, t) == ZS_PIECE_CUTS)
        return 0;
    const uint32_t far = piece_make(r, t, other, 0);
    r->tri[far].next = g->list;
    g->list = (uint16_t)far;
    g->moved++;
    insert(r, g, piece_make(r, t, other, 1));
    r->stats.splits++;
    o->torn = 1;
    return 1;
}

/* Element *link, the index-th of the list, is in the way of the head. Move or split. Return 0: the
 * rectangle has to be halved. */
static int make_way(struct zs_renderer *r, struct ordering *g, uint16_t *link, uint32_t index,
                    uint32_t order)
{
    const uint16_t p = g->list, q = *link;
    if (order == ZS_PIECE_NEAR && index >= g->moved) {
        *link = r->tri[q].next;
        r->tri[q].next = g->list;
        g->list = q;
        g->moved++;
        return 1;
    }
    if (order != ZS_PIECE_NEAR || zs_piece_meet(&g->p, 0, &g->nearer) & ZS_PIECE_FAR) {
        g->list = r->tri[p].next;
        g->moved -= g->moved > 0;
        return split(r, g, p, g->q.source);
    }
    /* the line where both are equally near misses the head: the part of q at which the head's plane
     * is nearer is drawn before the head */
    if (!(zs_piece_meet(&g->q, 0, &g->nearer) & ZS_PIECE_FAR))
        return 0;
    *link = r->tri[q].next;
    g->moved--;
    const uint32_t source = g->p.source;
    return split(r, g, q, source);
}

/* Find an element that is in the way of the head, g->p. Return 1 if there is none; 0: then the
 * list has changed, or *fits is 0 and the rectangle has to be halved. */
static int is_next(struct zs_renderer *r, struct ordering *g, int *fits)
{
    uint16_t *link = &r->tri[g->list].next;
    for (uint32_t index = 1; *link != ZS_NIL; index++, link = &r->tri[*link].next) {
        const uint32_t far = zs_sort_farthest(r, *link);
        /* depths at pixels lie between those of the vertices, but for ZS_PLANE_ERROR */
        if (far < g->p.near && g->p.near - far > 2u * ZS_PLANE_ERROR) {
            if (index >= g->moved)
                break; /* and so are those behind it */
            continue;
        }
        r->stats.pairs++;
        if (!in_box(r, *link, g->p.x0, g->p.x1, g->p.y0, g->p.y1))
            continue;
        load(r, *link, &g->q);
        if (zs_piece_clear(&g->p, &g->q, &g->nearer))
            continue;
        zs_piece_lines(r, g->list, &g->p);
        zs_piece_lines(r, *link, &g->q);
        const uint32_t order = zs_piece_meet(&g->p, &g->q, &g->nearer);
        if (!(order & ZS_PIECE_NEAR))
            continue;
        *fits = make_way(r, g, link, index, order);
        return 0;
    }
    return 1;
}

/* Bring a list in order. Return 0 if the rectangle has to be halved. */
static ZS_NOINLINE int order_list(struct zs_renderer *r, uint16_t list)
{
    struct zs_order *o = r->method_state;
    struct ordering g;
    uint16_t *tail = &o->list;
    int fits = 1;
    g.list = zs_sort_list(r, list);
    g.moved = 0;
    o->list = ZS_NIL;
    while (g.list != ZS_NIL) {
        load(r, g.list, &g.p);
        if (!is_next(r, &g, &fits)) {
            if (!fits)
                return 0;
            continue;
        }
        const uint16_t head = g.list;
        g.list = r->tri[head].next;
        g.moved -= g.moved > 0;
        r->tri[head].next = ZS_NIL;
        if (o->near_first) {
            r->tri[head].next = o->list;
            o->list = head;
        } else {
            *tail = head;
            tail = &r->tri[head].next;
        }
    }
    return 1;
}

/* ---- The strip ------------------------------------------------------------------------------- */

/* The strip's triangles, in any order. */
static uint16_t binned(struct zs_renderer *r)
{
    uint16_t list = r->active, *tail = &list;
    while (*tail != ZS_NIL)
        tail = &r->tri[*tail].next;
    *tail = r->bin[r->strip];
    r->bin[r->strip] = ZS_NIL;
    r->active = ZS_NIL;
    return list;
}

/* The triangles of the pool in the rectangle, in any order. */
static uint16_t gathered(struct zs_renderer *r)
{
    uint16_t list = ZS_NIL;
    for (uint32_t t = r->n_tris; t-- > 0;)
        if (touches(r, t)) {
            r->tri[t].next = list;
            list = (uint16_t)t;
        }
    return list;
}

/* Take records of the pool for the bits of a rectangle. Return 0 if they do not suffice. */
static int bits_take(struct zs_renderer *r, struct zs_order *o)
{
    o->bits = 0;
    o->end = r->config.max_tris;
    if (!o->near_first || is_pixel(o))
        return 1;
    o->words = (o->x1 - o->x0 + 31) / 32;
    const uint32_t words = (uint32_t)(o->words * (o->y1 - o->y0)); /* <= 2^7 * 2^12 */
    const uint32_t records = (words + 2u) / 3u;
    if (o->end - r->n_tris < records)
        return 0;
    o->end -= records;
    o->bits = (uint32_t *)(void *)&r->tri[o->end];
    for (uint32_t k = 0; k < words; k++)
        o->bits[k] = 0;
    return 1;
}

/* Bring the rectangle's triangles in order. Return 0 if it has to be halved. */
static int rectangle_order(struct zs_renderer *r, uint16_t list)
{
    struct zs_order *o = r->method_state;
    o->used = r->n_tris;
    o->cuts_of = 0;
    if (!bits_take(r, o))
        return 0;
    if (!is_pixel(o))
        return order_list(r, list);
    o->list = (uint16_t)pixel_pick(r);
    if (o->list != ZS_NIL)
        r->tri[o->list].next = ZS_NIL;
    return 1;
}

/* Bin the rectangle's triangles, and those of strips below up to band_end. */
static void walk(struct zs_renderer *r, uint16_t band_end, uint32_t spare)
{
    struct zs_order *o = r->method_state;
    const uint16_t all = r->config.max_tris;
    o->partial = 0;
    pixel_begin(o);
    r->config.max_tris = (uint16_t)(all - spare);
    zs_walk(r, band_end);
    r->config.max_tris = all;
}

/* Make r->active anew: the triangles that have rows in this strip or above, and below. */
static void go_on(struct zs_renderer *r, int32_t bottom)
{
    r->active = ZS_NIL;
    for (uint32_t t = r->n_tris; t-- > 0;) {
        const uint16_t *v = r->tri[t].v;
        if (zs_first_sample(r->vert[v[0]].y) >= bottom ||
            zs_first_sample(zs_max32(r->vert[v[1]].y, r->vert[v[2]].y)) <= bottom)
            continue;
        r->tri[t].next = r->active;
        r->active = (uint16_t)t;
    }
}

/* Return 1 if the rectangle is a pixel that may have more layers, before those drawn. */
static int next_layer(const struct zs_renderer *r, struct zs_order *o)
{
    if (!is_pixel(o) || o->list == ZS_NIL || !layered(r))
        return 0;
    o->limit = o->best;
    pixel_begin(o);
    return 1;
}

void zs_order_strip(struct zs_renderer *r, struct zs_order *o, uint32_t spare)
{
    const int32_t top = r->strip * r->config.strip_h;
    const int32_t bottom = zs_min32(top + r->config.strip_h, r->config.height);
    o->x0 = r->window[0];
    o->x1 = r->window[1];
    o->y0 = top;
    o->y1 = bottom;
    o->torn = o->partial = 0;
    rectangle_begin(o);
    r->method_state = o;
    if (r->strip >= r->band_end)
        walk(r, r->draw_end, spare);
    for (uint16_t list = o->partial ? gathered(r) : binned(r);;) {
        for (; !rectangle_order(r, list); list = gathered(r))
            halve(o);
        zs_raster_strip(r);
        if (!next_layer(r, o) && !next_rectangle(r, o, top, bottom))
            break;
        if (o->partial)
            walk(r, (uint16_t)(r->strip + 1u), spare);
        list = gathered(r);
    }
    r->bin[r->strip] = ZS_NIL;
    if (o->torn)
        go_on(r, bottom);
    r->method_state = 0;
}

uint16_t zs_order_list(struct zs_renderer *r)
{
    const struct zs_order *o = r->method_state;
    return o ? o->list : binned(r);
}

/* ---- Bounded memory -------------------------------------------------------------------------- */

/* Remove from the pool what does not touch the rectangle; at a single pixel, all but the nearest.
 */
static void sift(struct zs_renderer *r)
{
    struct zs_order *o = r->method_state;
    const uint32_t only = is_pixel(o) ? pixel_pick(r) : ZS_NIL;
    for (uint32_t t = 0; t < r->n_tris; t++)
        r->tri[t].next = t == only || (!is_pixel(o) && touches(r, t)) ? 0 : ZS_NIL;
    o->kept = only != ZS_NIL;
    zs_sort_pack(r);
}

/* Free a quarter of both pools; at a single pixel, all but one triangle. */
void zs_order_full(struct zs_renderer *r)
{
    struct zs_order *o = r->method_state;
    const uint32_t tris = r->config.max_tris, verts = r->config.max_verts;
    for (sift(r); !is_pixel(o) && (tris - r->n_tris < tris / 4u + 1u ||
                                   verts - r->n_verts < verts / 4u + 3u);
         sift(r)) {
        halve(o);
    }
    o->partial = 1;
}

/* ---- Spans ----------------------------------------------------------------------------------- */

int zs_order_clip(struct zs_job *job, int32_t y, int32_t *i0, int32_t *i1)
{
    const struct zs_renderer *r = job->r;
    struct zs_order *o = r->method_state;
    const uint32_t t = (uint32_t)(job->tri - r->tri);
    *i0 = zs_max32(*i0, o->x0);
    *i1 = zs_min32(*i1, o->x1);
    if (y < o->y0 || y >= o->y1 || *i0 >= *i1)
        return 0;
    if (t < r->n_tris)
        return 1;
    if (o->cuts_of != job->tri) {
        o->cuts_of = job->tri;
        o->n_cuts = zs_piece_cuts(r, t, o->line);
    }
    for (int32_t k = 0; k < o->n_cuts; k++)
        if (!zs_linear_clip(&o->line[k], y, i0, i1))
            return 0;
    return 1;
}
