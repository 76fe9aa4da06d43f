/* The order of a list of triangles, after Newell, Newell and Sancha (1972).
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
 * If many triangles cross, that takes long, and halves of the rectangle take less: in the end they
 * are pixels, each of which looks at each triangle once. So an order may look at triangles * pixels
 * elements; if it needs more, the rectangle is halved. A strip takes at most
 * pixels * triangles * log2(pixels).
 *
 * SPDX-License-Identifier: MIT
 */
#include "method/order.h"
#include "method/sort.h"

/* What the ordering of a list has in hand. */
struct ordering {
    struct zs_piece p, q;     /* the head, and an element that is in its way ... */
    struct zs_linear nearer;  /* ... < 0 where the head is nearer */
    uint16_t list;
    uint32_t moved;
    uint32_t left;            /* elements that may still be asked about or passed */
};

/* Put an element into the sorted part of the list, behind those that are as far. */
static void insert(const struct zs_renderer *r, struct ordering *g, uint32_t t)
{
    uint16_t *link = &g->list;
    uint32_t passed = 0;
    while (passed < g->moved ||
           (*link != ZS_NIL && zs_sort_farthest(r, *link) >= zs_sort_farthest(r, t))) {
        link = &r->tri[*link].next;
        passed++;
    }
    g->left -= zs_minu32(g->left, passed);
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
    struct zs_order *o = r->method_state;
    uint16_t *link = &r->tri[g->list].next;
    for (uint32_t index = 1; *link != ZS_NIL; index++, link = &r->tri[*link].next) {
        if (!g->left) {
            *fits = 0;
            return 0;
        }
        g->left--;
        const uint32_t far = zs_sort_farthest(r, *link);
        /* depths at pixels lie between those of the vertices, but for ZS_PLANE_ERROR */
        if (far < g->p.near && g->p.near - far > 2u * ZS_PLANE_ERROR) {
            if (index >= g->moved)
                break; /* and so are those behind it */
            continue;
        }
        r->stats.pairs++;
        if (!zs_order_in_box(r, *link, g->p.x0, g->p.x1, g->p.y0, g->p.y1))
            continue;
        zs_order_load(r, *link, &g->q);
        if (ZS_STATS)
            o->pair_boxes++;
        if (zs_piece_clear(&g->p, &g->q, &g->nearer))
            continue;
        zs_piece_lines(r, g->list, &g->p);
        zs_piece_lines(r, *link, &g->q);
        if (ZS_STATS)
            o->pair_rows += (uint32_t)(zs_min32(g->p.y1, g->q.y1) - zs_max32(g->p.y0, g->q.y0));
        const uint32_t order = zs_piece_meet(&g->p, &g->q, &g->nearer);
        if (!(order & ZS_PIECE_NEAR))
            continue;
        *fits = make_way(r, g, link, index, order);
        return 0;
    }
    return 1;
}

int zs_order_newell(struct zs_renderer *r, uint16_t list)
{
    struct zs_order *o = r->method_state;
    const uint32_t all = (uint32_t)((o->x1 - o->x0) * (o->y1 - o->y0)); /* <= 2^12 * 2^12 */
    const uint32_t pixels = zs_minu32(all, UINT16_MAX); /* n_tris < 2^16 */
    struct ordering g;
    uint16_t *tail = &o->list;
    int fits = 1;
    g.list = zs_sort_list(r, list);
    g.moved = 0;
    g.left = pixels * r->n_tris;
    o->list = ZS_NIL;
    while (g.list != ZS_NIL) {
        zs_order_load(r, g.list, &g.p);
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
