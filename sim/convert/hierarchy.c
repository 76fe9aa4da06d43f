/* A hierarchy of spheres by halves: the clusters of a mesh are sorted along the longest side of
 * their box and cut in two, again and again; then the triangles of each cluster.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hierarchy.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_method.h"

struct builder {
    const struct sim_shape *shape;
    struct zs_bvh_node *node;
    uint32_t n;
    uint32_t *order, *sorted;           /* places of triangles: as they were, as they will be */
    struct zs_cluster *cluster, *moved; /* the same of clusters */
    uint32_t placed;                    /* triangles that have a place */
    uint32_t n_moved;
    int32_t (*fine)[3];                 /* room for the points of a node */
};

struct item {
    int32_t at[3]; /* its middle, 1/256 step times 3 */
    uint32_t number;
    int64_t key;
};

static int by_key(const void *a, const void *b)
{
    const struct item *p = a, *q = b;
    if (p->key != q->key)
        return p->key < q->key ? -1 : 1;
    return (p->number > q->number) - (p->number < q->number);
}

/* Sort items along the longest side of the box of their middles. */
static void sort(struct item *item, uint32_t n)
{
    int64_t most = -1;
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        int64_t lo = item[0].at[k], hi = lo;
        for (uint32_t i = 1; i < n; i++) {
            lo = item[i].at[k] < lo ? item[i].at[k] : lo;
            hi = item[i].at[k] > hi ? item[i].at[k] : hi;
        }
        if (hi - lo > most) {
            most = hi - lo;
            axis = k;
        }
    }
    for (uint32_t i = 0; i < n; i++)
        item[i].key = item[i].at[axis];
    qsort(item, n, sizeof *item, by_key);
}

/* Begin a node, whose triangles will be placed from here on. */
static uint32_t node_begin(struct builder *b)
{
    b->node[b->n].first = b->placed;
    return b->n++;
}

/* End a node: its triangles are placed. */
static void node_end(struct builder *b, uint32_t k)
{
    struct zs_bvh_node *const node = &b->node[k];
    uint32_t n = 0;
    for (uint32_t t = node->first; t < b->placed; t++)
        for (int c = 0; c < 3; c++)
            memcpy(b->fine[n++], b->shape->fine[b->shape->tri[b->sorted[t]][c]], sizeof *b->fine);
    sim_sphere(node->center, &node->radius, (const int32_t(*)[3])b->fine, n);
    node->skip = b->n;
}

/* The nodes of triangles. into: the node that holds just these, or UINT32_MAX. */
static void triangles(struct builder *b, struct item *item, uint32_t n, uint32_t into)
{
    const uint32_t k = into != UINT32_MAX ? into : node_begin(b);
    if (n <= SIM_LEAF_TRIS) {
        for (uint32_t i = 0; i < n; i++)
            b->sorted[b->placed++] = item[i].number;
    } else {
        sort(item, n);
        triangles(b, item, n / 2, UINT32_MAX);
        triangles(b, item + n / 2, n - n / 2, UINT32_MAX);
    }
    if (into == UINT32_MAX)
        node_end(b, k);
}

/* The node of one cluster, and those below it. */
static void place_cluster(struct builder *b, uint32_t number, uint32_t k)
{
    struct item item[SIM_CLUSTER_TRIS];
    const struct zs_cluster *c = &b->cluster[number];
    for (uint32_t i = 0; i < c->n_tris; i++) {
        item[i].number = b->order[c->first + i];
        const uint32_t *tri = b->shape->tri[item[i].number];
        for (int a = 0; a < 3; a++)
            item[i].at[a] = b->shape->fine[tri[0]][a] + b->shape->fine[tri[1]][a] + b->shape->fine[tri[2]][a];
    }
    b->moved[b->n_moved] = *c;
    b->moved[b->n_moved++].first = b->placed;
    triangles(b, item, c->n_tris, k);
}

static void clusters(struct builder *b, struct item *item, uint32_t n)
{
    const uint32_t k = node_begin(b);
    if (n == 1) {
        place_cluster(b, item->number, k);
    } else {
        sort(item, n);
        clusters(b, item, n / 2);
        clusters(b, item + n / 2, n - n / 2);
    }
    node_end(b, k);
}

struct zs_bvh_node *sim_hierarchy(uint32_t *n, uint32_t *order, struct zs_cluster *cluster,
                                  uint32_t n_clusters, const struct sim_shape *shape)
{
    struct builder b = { .shape = shape, .order = order, .cluster = cluster };
    struct item *item = sim_alloc(n_clusters, sizeof *item);
    b.node = sim_alloc(2 * ((size_t)shape->n_tris + n_clusters), sizeof *b.node);
    b.sorted = sim_alloc(shape->n_tris, sizeof *b.sorted);
    b.moved = sim_alloc(n_clusters, sizeof *b.moved);
    b.fine = sim_alloc(3 * (size_t)shape->n_tris, sizeof *b.fine);
    for (uint32_t i = 0; i < n_clusters; i++) {
        item[i].number = i;
        for (int a = 0; a < 3; a++)
            item[i].at[a] = cluster[i].center[a];
    }
    clusters(&b, item, n_clusters);
    memcpy(order, b.sorted, shape->n_tris * sizeof *order);
    memcpy(cluster, b.moved, n_clusters * sizeof *cluster);
    free(item);
    free(b.sorted);
    free(b.moved);
    free(b.fine);
    *n = b.n;
    return b.node;
}
