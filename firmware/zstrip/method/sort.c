/* Sorting the triangles of a pool, and taking triangles out of it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method/sort.h"

uint16_t zs_sort_merge(const struct zs_renderer *r, uint16_t a, uint16_t b)
{
    uint16_t head = ZS_NIL, *tail = &head;
    while (a != ZS_NIL && b != ZS_NIL) {
        const uint32_t da = zs_sort_farthest(r, a), db = zs_sort_farthest(r, b);
        uint16_t *first = da > db || (da == db && a < b) ? &a : &b;
        *tail = *first;
        tail = &r->tri[*first].next;
        *first = *tail;
    }
    *tail = a != ZS_NIL ? a : b;
    return head;
}

/* run[k] is ZS_NIL or a sorted list of 2^k triangles, as in binary counting. */
uint16_t zs_sort_list(struct zs_renderer *r, uint16_t list)
{
    uint16_t run[16], all = ZS_NIL;
    for (int k = 0; k < 16; k++)
        run[k] = ZS_NIL;
    while (list != ZS_NIL) {
        uint16_t one = list;
        int k = 0;
        list = r->tri[one].next;
        r->tri[one].next = ZS_NIL;
        for (; run[k] != ZS_NIL; k++) { /* pools hold less than 2^16 - 1 triangles */
            one = zs_sort_merge(r, run[k], one);
            run[k] = ZS_NIL;
        }
        run[k] = one;
        r->stats.sorted++;
    }
    for (int k = 0; k < 16; k++)
        all = zs_sort_merge(r, run[k], all);
    return all;
}

void zs_sort_pack(struct zs_renderer *r)
{
    uint32_t kept = 0;
    r->bin[r->strip] = ZS_NIL;
    for (uint32_t t = 0; t < r->n_tris; t++) {
        if (r->tri[t].next == ZS_NIL)
            continue;
        r->tri[kept] = r->tri[t];
        r->tri[kept].next = r->bin[r->strip];
        r->bin[r->strip] = (uint16_t)kept++;
    }
    r->n_tris = kept;
    zs_bin_pack(r);
}

/* ---- The farthest triangles, in bounded memory ----------------------------------------------- */

/* Return 1 if triangle t is beside the columns that are drawn (zs_damage_columns). The walk for
 * all dirty strips bins it, for another strip's columns, and a walk for this strip does not: it
 * must not count among ties. */
static int beside(const struct zs_renderer *r, uint32_t t)
{
    const uint16_t *v = r->tri[t].v;
    const int32_t a = r->vert[v[0]].x, b = r->vert[v[1]].x, c = r->vert[v[2]].x;
    return zs_first_sample(zs_min32(zs_min32(a, b), c)) >= r->window[1] ||
           zs_first_sample(zs_max32(zs_max32(a, b), c)) <= r->window[0];
}

int zs_farthest_belongs(const struct zs_renderer *r, struct zs_farthest *f, uint32_t t)
{
    const uint32_t d = zs_sort_farthest(r, t);
    if ((f->dropped && d <= f->near) || beside(r, t))
        return 0;
    if (!f->again || d < f->d)
        return 1;
    return d == f->d && f->passed++ >= f->ties;
}

/* Keep the first n triangles of a sorted list, and drop the others. */
static void keep_first(struct zs_renderer *r, struct zs_farthest *f, uint16_t list, uint32_t n)
{
    for (uint32_t k = 0; list != ZS_NIL; k++) {
        const uint16_t next = r->tri[list].next;
        if (k == n)
            f->near = zs_sort_farthest(r, list);
        r->tri[list].next = k < n ? 0 : ZS_NIL;
        list = next;
    }
    zs_sort_pack(r);
    f->sifted = n;
    f->dropped = 1;
}

void zs_farthest_room(struct zs_renderer *r, struct zs_farthest *f)
{
    const uint32_t tris = r->config.max_tris, verts = r->config.max_verts;
    for (uint32_t n; (n = r->n_tris) > 1 &&
                     (tris - n < tris / 4u + 1u || verts - r->n_verts < verts / 4u + 3u);)
        keep_first(r, f, zs_sort_list(r, r->bin[r->strip]), n - n / 4u - 1u);
}

struct zs_farthest zs_farthest_next(const struct zs_renderer *r, const struct zs_farthest *f)
{
    struct zs_farthest next = { .d = f->near, .again = 1 };
    next.ties = f->again && f->d == f->near ? f->ties : 0u;
    for (uint32_t t = 0; t < r->n_tris; t++)
        next.ties += zs_sort_farthest(r, t) == f->near;
    return next;
}
