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
