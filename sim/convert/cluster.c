/* Clusters by meshoptimizer's meshlet builder; spheres and cones computed again, on the integers
 * that the renderer will see, so that rounding can only make them larger.
 *
 * Chosen by figures, 64 triangles to a cluster. Misses to a triangle of a vertex cache (first in
 * first out, 16 and 32 entries), mean radius as a share of the model's extent, and the share of
 * triangles whose cluster turns its back to a far eye, over all directions:
 *
 *                                    teapot, 2832           torus, 2304            torus, 160000
 *   cache order, cut every 64    .73 .67  .168   7 %    .72 .69  .260  14 %    .75 .74  .051  45 %
 *   order for 16, cut every 64   .64 .63  .152   7 %    .62 .62  .223  17 %    .60 .60  .028  45 %
 *   meshlets, cone weight 0      .79 .65  .126   7 %    .76 .65  .186   9 %    .78 .66  .025  43 %
 *   meshlets, cone weight 1/2    .80 .67  .152  13 %    .76 .65  .206  16 %    .78 .66  .025  43 %
 *   meshlets, cone weight 1      .80 .67  .160  18 %    .86 .74  .292  22 %    .79 .69  .037  45 %
 *
 * The renderer keeps a vertex as long as its pool has room, so misses of a small cache count least;
 * of the others, a weight of 1/2 gives most of the cones and keeps the radii. Sorting for the cache
 * once more inside each cluster gained .04 at 16 entries and lost .03 at 32, so it is left out.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cluster.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"

#define VERTS_MAX 192u /* of a cluster: as many as 64 triangles can have */
#define FACING_WEIGHT 0.5f
#define APPROACHES 100

/* ---- Spheres --------------------------------------------------------------------------------- */

/* Squared distance of the point farthest from a middle given in steps, 1/256 step squared. Exact.
 * */
static int64_t farthest(const int16_t center[3], const int32_t (*fine)[3], uint32_t n,
                        uint32_t *which)
{
    int64_t most = -1;
    for (uint32_t i = 0; i < n; i++) {
        int64_t squared = 0; /* < 3 * 2^48 */
        for (int k = 0; k < 3; k++) {
            const int64_t d = fine[i][k] - 256 * (int32_t)center[k];
            squared += d * d;
        }
        if (squared > most) {
            most = squared;
            *which = i;
        }
    }
    return most;
}

/* The least whole radius, in steps, whose square is enough. */
static uint16_t radius_of(int64_t squared)
{
    int64_t r = (int64_t)(sqrt((double)squared) / 256.0);
    while (r > 0 && (r - 1) * (r - 1) * 65536 >= squared)
        r--;
    while (r * r * 65536 < squared)
        r++;
    return (uint16_t)r; /* <= sqrt(3) * 32768 + 1 */
}

static void to_steps(int16_t out[3], const double fine[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (int16_t)fmin(fmax(rint(fine[k] / 256.0), INT16_MIN), INT16_MAX);
}

/* Towards the farthest point, by ever smaller steps (Badoiu and Clarkson 2003). */
static void approach(double middle[3], const int32_t (*fine)[3], uint32_t n)
{
    for (int i = 1; i <= APPROACHES; i++) {
        double most = -1.0;
        uint32_t which = 0;
        for (uint32_t v = 0; v < n; v++) {
            double d[3];
            for (int k = 0; k < 3; k++)
                d[k] = fine[v][k] - middle[k];
            const double squared = sim_dot(d, d);
            if (squared > most) {
                most = squared;
                which = v;
            }
        }
        for (int k = 0; k < 3; k++)
            middle[k] += (fine[which][k] - middle[k]) / (i + 1);
    }
}

static void box_middle(double middle[3], const int32_t (*fine)[3], uint32_t n)
{
    for (int k = 0; k < 3; k++) {
        int32_t lo = fine[0][k], hi = fine[0][k];
        for (uint32_t i = 1; i < n; i++) {
            lo = fine[i][k] < lo ? fine[i][k] : lo;
            hi = fine[i][k] > hi ? fine[i][k] : hi;
        }
        middle[k] = (lo + hi) / 2.0;
    }
}

void sim_sphere(int16_t center[3], uint16_t *radius, const int32_t (*fine)[3], uint32_t n)
{
    int64_t least = INT64_MAX;
    double middle[3];
    uint32_t which = 0;
    box_middle(middle, fine, n);
    for (int attempt = 0; attempt < 3; attempt++) {
        int16_t at[3];
        if (attempt > 0)
            approach(middle, fine, n);
        to_steps(at, middle);
        const int64_t squared = farthest(at, fine, n, &which);
        if (squared < least) {
            least = squared;
            memcpy(center, at, sizeof at);
        }
    }
    *radius = radius_of(least);
}

/* ---- Cones ----------------------------------------------------------------------------------- */

/* The normal of a triangle, any length. Exact below 2^53. */
static void normal_of(double out[3], const struct sim_shape *s, const uint32_t tri[3])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = s->fine[tri[1]][k] - s->fine[tri[0]][k];
        b[k] = s->fine[tri[2]][k] - s->fine[tri[0]][k];
    }
    sim_cross(out, a, b);
}

/* A cutoff, of 127, for an axis that has been rounded. With A = axis / 127, d the direction from
 * the eye to the sphere's middle and s = radius / |d|, what is culled has d . A >= c + s. All
 * normals within the angle w of the axis face away if the angle between d and A is below 90 degrees
 * - w by so much that d . n >= s; that holds where d . A / |A| >= sin w + s, since sin b - sin w <=
 * sin(b - w) for 0 <= w <= b <= 90 degrees. So c = |A| sin w + max(0, |A| - 1) is enough for s <=
 * 1. */
static int8_t cutoff_of(const signed char axis[3], const struct sim_shape *s,
                        const uint32_t (*tri)[3], uint32_t n)
{
    const double a[3] = { axis[0] / 127.0, axis[1] / 127.0, axis[2] / 127.0 };
    const double length = sqrt(sim_dot(a, a));
    double least = 1.0, most_sine = 0.0;
    for (uint32_t i = 0; i < n; i++) {
        double normal[3], across[3];
        normal_of(normal, s, tri[i]);
        (void)sim_unit(normal);
        sim_cross(across, normal, a);
        least = fmin(least, sim_dot(normal, a));
        most_sine = fmax(most_sine, sqrt(sim_dot(across, across)));
    }
    if (!(least > 1e-6) || !(length > 0.5))
        return 127;
    const double c = 127.0 * (most_sine + fmax(0.0, length - 1.0)) + 1e-6; /* across holds |A| */
    return (int8_t)fmin(ceil(c), 127.0);
}

/* ---- Heights --------------------------------------------------------------------------------- */

/* Of the flattest triangle over its longest side, 1/16 step, rounded down, by a little more than doubles lose. */
static uint16_t height_of(const struct sim_shape *s, const uint32_t (*tri)[3], uint32_t n)
{
    double least = 65535.0;
    for (uint32_t i = 0; i < n; i++) {
        double normal[3], longest = 0.0, shortest = INFINITY;
        normal_of(normal, s, tri[i]);
        for (int k = 0; k < 3; k++) {
            double side[3];
            for (int j = 0; j < 3; j++)
                side[j] = s->fine[tri[i][k]][j] - s->fine[tri[i][(k + 1) % 3]][j];
            longest = fmax(longest, sim_dot(side, side));
            shortest = fmin(shortest, sim_dot(side, side));
        }
        if (shortest > 0.0)
            least = fmin(least, sqrt(sim_dot(normal, normal) / longest) / 16.0);
    }
    return (uint16_t)floor(least * (1.0 - 1e-9));
}

/* ---- Clusters -------------------------------------------------------------------------------- */

/* The distinct points of a cluster, for its sphere. */
static uint32_t points_of(int32_t (*out)[3], const struct sim_shape *s, const uint32_t (*tri)[3],
                          uint32_t n)
{
    uint32_t seen[3 * SIM_CLUSTER_TRIS], found = 0;
    for (uint32_t i = 0; i < 3 * n; i++) {
        const uint32_t v = tri[i / 3][i % 3];
        uint32_t k = 0;
        while (k < found && seen[k] != v)
            k++;
        if (k < found)
            continue;
        seen[found] = v;
        memcpy(out[found++], s->fine[v], sizeof *out);
    }
    return found;
}

static void describe(struct zs_cluster *c, const struct sim_shape *s, const float *point,
                     const uint32_t (*tri)[3])
{
    int32_t fine[3 * SIM_CLUSTER_TRIS][3];
    const uint32_t n = points_of(fine, s, tri, c->n_tris);
    const struct meshopt_Bounds b =
        meshopt_computeClusterBounds(tri[0], 3u * c->n_tris, point, s->n_verts, 3 * sizeof *point);
    sim_sphere(c->center, &c->radius, (const int32_t(*)[3])fine, n);
    for (int k = 0; k < 3; k++)
        c->axis[k] = (int8_t)(b.cone_axis_s8[k] < -127 ? -127 : b.cone_axis_s8[k]);
    c->cutoff = cutoff_of(b.cone_axis_s8, s, tri, c->n_tris);
    if (c->cutoff == 127)
        memset(c->axis, 0, sizeof c->axis);
    c->height = height_of(s, tri, c->n_tris);
}

/* Which triangle of the shape is this? Among equal ones each is given out once, in order. */
struct finder {
    uint32_t *head, *next, mask; /* number + 1; 0: none */
};

static uint32_t hash_of(const uint32_t tri[3])
{
    uint32_t h = tri[0] * 2654435761u;
    h = (h ^ h >> 15 ^ tri[1]) * 2246822519u;
    h = (h ^ h >> 13 ^ tri[2]) * 3266489917u;
    return h ^ h >> 16;
}

static void finder_fill(struct finder *f, const struct sim_shape *s)
{
    f->mask = 15;
    while (f->mask < s->n_tris)
        f->mask = 2 * f->mask + 1;
    f->head = sim_alloc((size_t)f->mask + 1, sizeof *f->head);
    f->next = sim_alloc(s->n_tris, sizeof *f->next);
    for (uint32_t t = s->n_tris; t-- > 0;) {
        uint32_t *head = &f->head[hash_of(s->tri[t]) & f->mask];
        f->next[t] = *head;
        *head = t + 1;
    }
}

static uint32_t finder_take(struct finder *f, const struct sim_shape *s, const uint32_t tri[3])
{
    for (uint32_t *at = &f->head[hash_of(tri) & f->mask]; *at != 0; at = &f->next[*at - 1]) {
        const uint32_t t = *at - 1;
        if (memcmp(s->tri[t], tri, sizeof s->tri[t]) == 0) {
            *at = f->next[t];
            return t;
        }
    }
    (void)sim_refuse(NULL, 0,
                     "meshoptimizer returned a triangle that it was not given; please report this");
    exit(SIM_REFUSED);
}

static struct zs_cluster *sort(uint32_t *order, uint32_t *n, const struct sim_shape *s,
                               const float *point, const struct meshopt_Meshlet *set,
                               const unsigned *vertex, const unsigned char *corner)
{
    struct zs_cluster *cluster = sim_alloc(*n, sizeof *cluster);
    struct finder f;
    uint32_t first = 0;
    finder_fill(&f, s);
    for (uint32_t i = 0; i < *n; i++) {
        uint32_t tri[SIM_CLUSTER_TRIS][3];
        for (uint32_t k = 0; k < 3 * set[i].triangle_count; k++)
            tri[k / 3][k % 3] = vertex[set[i].vertex_offset + corner[set[i].triangle_offset + k]];
        for (uint32_t k = 0; k < set[i].triangle_count; k++)
            order[first + k] = finder_take(&f, s, tri[k]);
        cluster[i].first = first;
        cluster[i].n_tris = (uint16_t)set[i].triangle_count;
        describe(&cluster[i], s, point, (const uint32_t(*)[3])tri);
        first += set[i].triangle_count;
        if (i % 256 == 0)
            sim_progress("clustering", i, *n);
    }
    free(f.head);
    free(f.next);
    return cluster;
}

struct zs_cluster *sim_cluster(uint32_t *order, uint32_t *n, const struct sim_shape *s, int facing)
{
    const size_t n_index = 3 * (size_t)s->n_tris;
    const size_t most = meshopt_buildMeshletsBound(n_index, VERTS_MAX, SIM_CLUSTER_TRIS);
    struct meshopt_Meshlet *set = sim_alloc(most, sizeof *set);
    unsigned *vertex = sim_alloc(most * VERTS_MAX, sizeof *vertex);
    unsigned char *corner = sim_alloc(most * SIM_CLUSTER_TRIS, 3);
    float *point = sim_alloc(3 * (size_t)s->n_verts, sizeof *point);
    for (size_t i = 0; i < 3 * (size_t)s->n_verts; i++)
        point[i] = (float)s->fine[i / 3][i % 3] / 256.0f; /* 24 bits: exact */
    sim_progress("clustering", 0, 1);
    *n = (uint32_t)meshopt_buildMeshlets(set, vertex, corner, s->tri[0], n_index, point, s->n_verts,
                                         3 * sizeof *point, VERTS_MAX, SIM_CLUSTER_TRIS,
                                         facing ? FACING_WEIGHT : 0.0f);
    struct zs_cluster *cluster = sort(order, n, s, point, set, vertex, corner);
    free(set);
    free(vertex);
    free(corner);
    free(point);
    return cluster;
}

/* ---- Order of vertices ----------------------------------------------------------------------- */

uint32_t sim_use_order(uint32_t *remap, const uint32_t (*tri)[3], uint32_t n_tris, uint32_t n_verts)
{
    return (uint32_t)meshopt_optimizeVertexFetchRemap(remap, tri[0], 3 * (size_t)n_tris, n_verts);
}

double sim_cache_misses(const uint16_t (*tri)[3], uint32_t n_tris, uint32_t n_verts, uint32_t size)
{
    uint32_t *index = sim_alloc(3 * (size_t)n_tris, sizeof *index);
    for (size_t i = 0; i < 3 * (size_t)n_tris; i++)
        index[i] = tri[i / 3][i % 3];
    const struct meshopt_VertexCacheStatistics cache =
        meshopt_analyzeVertexCache(index, 3 * (size_t)n_tris, n_verts, size, 0, 0);
    free(index);
    return (double)cache.acmr;
}
