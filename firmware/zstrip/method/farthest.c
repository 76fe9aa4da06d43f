/* The farthest triangles of a strip, in bounded memory: method/sort.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method/sort.h"

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
