/* The triangles of a strip in order of depth: rectangles, and bounded memory.
 *
 * A rectangle, at first the strip, is brought in order (newell.c) and drawn. If records for pieces
 * run out, if a piece has too many half-planes or if a cycle has no line that splits, the rectangle
 * is halved: columns first, then rows. A single pixel needs no list: its nearest triangle is found
 * by a loop or, if a shader mixes colours, its layers from far to near, up to eight at a time.
 * Rectangles tile the strip, so that every pixel is drawn in one.
 *
 * If the triangle pool is full and the band is a single strip, the rectangle is halved too, and
 * triangles beside it leave the pool; later walks find them again. At a single pixel all but those
 * to draw leave it, of which there may be one. So any pool of two triangles will do.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/method.h"
#include "core/raster.h"
#include "core/walk.h"
#include "method/order.h"
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

int zs_order_in_box(const struct zs_renderer *r, uint32_t t, int32_t x0, int32_t x1, int32_t y0,
                    int32_t y1)
{
    const uint16_t *v = r->tri[t].v;
    const struct zs_vertex *a = &r->vert[v[0]], *b = &r->vert[v[1]], *c = &r->vert[v[2]];
    return zs_first_sample(a->y) < y1 && zs_first_sample(zs_max32(b->y, c->y)) > y0 &&
           zs_first_sample(zs_min32(a->x, zs_min32(b->x, c->x))) < x1 &&
           zs_first_sample(zs_max32(a->x, zs_max32(b->x, c->x))) > x0;
}

/* Return 1 if its box has a sample in the rectangle. */
static int touches(const struct zs_renderer *r, uint32_t t)
{
    const struct zs_order *o = r->method_state;
    return zs_order_in_box(r, t, o->x0, o->x1, o->y0, o->y1);
}

void zs_order_load(const struct zs_renderer *r, uint32_t t, struct zs_piece *p)
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

/* Find the triangles of the pool to draw at the rectangle's only pixel: the nearest or, of layers,
 * the farthest before the limit, o->most of them. Return their number. Triangles are met once, in
 * scene order. */
static ZS_NOINLINE uint32_t pixel_pick(const struct zs_renderer *r)
{
    struct zs_order *o = r->method_state;
    const int layers = layered(r);
    const uint32_t most = layers ? o->most : 1;
    struct zs_piece p;
    uint32_t n = o->kept;
    for (uint32_t t = o->kept; t < r->n_tris; t++) {
        if (!touches(r, t))
            continue;
        zs_order_load(r, t, &p);
        zs_piece_plane(&p);
        zs_piece_lines(r, t, &p);
        if (!zs_piece_meet(&p, 0, &p.plane))
            continue;
        const struct zs_layer is = { zs_linear_at(&p.plane, o->x0, o->y0), o->met++ };
        if (layers && !before(&is, &o->limit))
            continue;
        uint32_t at = n;
        while (at > 0 && (layers ? before(&o->best[at - 1], &is) : before(&is, &o->best[at - 1])))
            at--;
        if (at == most)
            continue;
        n = zs_minu32(n + 1u, most);
        for (uint32_t k = n - 1u; k > at; k--) {
            o->best[k] = o->best[k - 1u];
            o->pick[k] = o->pick[k - 1u];
        }
        o->best[at] = is;
        o->pick[at] = (uint16_t)t;
    }
    return n;
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

#define MANY 256 /* triangles: for longer lists, halves are worth another look at the pool */

/* Return 1 if a list is long and its triangles are narrow beside the rectangle: the pairs in two
 * halves are fewer. */
static int too_many(const struct zs_renderer *r, uint16_t list)
{
    const struct zs_order *o = r->method_state;
    const uint32_t width = (uint32_t)(o->x1 - o->x0);
    uint32_t n = 0, sum = 0; /* < 2^16; < 2^28 */
    for (; list != ZS_NIL; list = r->tri[list].next, n++) {
        const struct zs_vertex *a = &r->vert[r->tri[list].v[0]], *b = &r->vert[r->tri[list].v[1]],
                               *c = &r->vert[r->tri[list].v[2]];
        const int32_t x0 = zs_min32(a->x, zs_min32(b->x, c->x)) >> ZS_SUBPX_BITS;
        const int32_t x1 = zs_max32(a->x, zs_max32(b->x, c->x)) >> ZS_SUBPX_BITS;
        sum += (uint32_t)(zs_min32(x1, o->x1) - zs_max32(x0, o->x0) + 1);
    }
    return n > MANY && sum * 4u < n * width; /* n * width < 2^28 */
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
        return !too_many(r, list) && zs_order_newell(r, list);
    o->kept = pixel_pick(r);
    o->list = ZS_NIL;
    for (uint32_t k = o->kept; k-- > 0;) {
        r->tri[o->pick[k]].next = o->list;
        o->list = o->pick[k];
    }
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
    if (!is_pixel(o) || o->kept < o->most || !layered(r))
        return 0;
    o->limit = o->best[o->kept - 1u];
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
    o->most = zs_minu32(r->config.max_verts / 6u, (r->config.max_tris - spare) / 2u);
    o->most = zs_maxu32(1, zs_minu32(o->most, ZS_ORDER_LAYERS));
    o->torn = o->partial = 0;
    o->pair_boxes = o->pair_rows = 0;
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

/* Return 0 if a triangle that touches it lies beside the rectangle. */
static int reaches(const struct zs_renderer *r, uint32_t t)
{
    const struct zs_order *o = r->method_state;
    return !zs_piece_beside(r, t, o->x0, o->x1, o->y0, o->y1);
}

/* Remove from the pool what lies beside the rectangle; at a single pixel, all but the best. */
static void sift(struct zs_renderer *r)
{
    struct zs_order *o = r->method_state;
    const uint32_t n = is_pixel(o) ? pixel_pick(r) : 0;
    uint32_t kept = 0;
    for (uint32_t t = 0; t < r->n_tris; t++) {
        uint32_t k = 0;
        while (k < n && o->pick[k] != t)
            k++;
        if (k < n)
            o->pick[k] = (uint16_t)kept++; /* its number in the packed pool, <= t */
        r->tri[t].next = k < n || (!is_pixel(o) && touches(r, t) && reaches(r, t)) ? 0 : ZS_NIL;
    }
    o->kept = n;
    zs_sort_pack(r);
}

/* Free a quarter of both pools; at a single pixel, half, or all but one triangle. */
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
