/* Checks of data that cannot be trusted. A mesh or texture that passes is drawn without a read out
 * of bounds, and as the headers promise.
 *
 * All tests are exact, in integers that no data can overflow; comments give the bound of each
 * intermediate result.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "zs_check.h"
#include "zs_method.h"
#include "zs_shader.h"

static const char *const flaws[] = {
    "no flaw",
    "an array, a palette or a texel format is missing or not known",
    "an array is not aligned as its elements",
    "more than 65535 vertices",
    "a triangle names a vertex that is not there",
    "a vertex outside the mesh's sphere",
    "a vertex normal whose length is neither 1 nor 0",
    "a face normal whose length is neither 1 nor 0",
    "more than 15 fraction bits in the texture coordinates",
    "clusters that do not hold all triangles, in order, each once",
    "a vertex outside its cluster's sphere",
    "a triangle that its cluster's cone does not hold",
    "a triangle flatter than its cluster says",
    "a texture whose width or height is out of range",
    "a palette whose number of colours is out of range",
    "a clamp that is none",
    "a texel that its palette does not hold",
    "more mipmap levels than the texture's size allows",
    "nodes that are no hierarchy over all triangles, in order, each in one leaf",
    "a vertex outside its node's sphere"
};
_Static_assert(sizeof flaws / sizeof flaws[0] == ZS_FLAW_NODE_SPHERE + 1, "one for each flaw");

const char *zs_flaw_string(enum zs_flaw flaw)
{
    const unsigned n = (unsigned)flaw;
    return n < sizeof flaws / sizeof flaws[0] ? flaws[n] : "unknown flaw";
}

static enum zs_flaw found(enum zs_flaw flaw, uint32_t *index, uint32_t at)
{
    if (index)
        *index = at;
    return flaw;
}

/* Return 1 if a pointer is aligned, so that no core traps on an access. NULL is aligned. */
static int aligned(const void *p, size_t bytes)
{
    return ((uintptr_t)p & (bytes - 1u)) == 0;
}

/* ---- Spheres --------------------------------------------------------------------------------- */

/* Compute the vector from a point, in steps, to a vertex; out in 1/256 step. |.| < 2^24 */
static void vertex_from(const struct zs_mesh *m, uint32_t v, const int16_t point[3], int32_t out[3])
{
    zs_mesh_place(m, v, out);
    for (int k = 0; k < 3; k++)
        out[k] -= point[k] * 256;
}

static int in_sphere(const struct zs_mesh *m, uint32_t v, const int16_t center[3], uint16_t radius)
{
    int32_t d[3];
    vertex_from(m, v, center, d);
    int64_t square = 0; /* <= 3 * 2^48 */
    for (int k = 0; k < 3; k++)
        square += (int64_t)d[k] * d[k];
    const int64_t r = (int64_t)radius * 256; /* < 2^24 */
    return square <= r * r;
}

/* ---- Normals --------------------------------------------------------------------------------- */

/* Return 1 if the length of a normal is 0, or within 2 % of 32767. */
static int unit_or_none(const zs_q1_15 n[3])
{
    int64_t square = 0; /* <= 3 * 2^30 */
    for (int k = 0; k < 3; k++)
        square += (int64_t)n[k] * n[k];
    const int64_t full = 32767 * 32767, percent2 = square * 10000; /* < 2^45 */
    return square == 0 || (percent2 >= 98 * 98 * full && percent2 <= 102 * 102 * full);
}

/* ---- Cones -------------------------------------------------------------------------------------
 *
 * With A = axis, C = cutoff (127 is 1), r = radius, and d the vector from the eye to the sphere's
 * centre, struct zs_cluster (zs_scene.h) promises for each triangle of the cluster: if
 *
 *     d . A >= C |d| + 127 r                                                               (1)
 *
 * then the eye is not in front of the triangle. With N its normal (p1 - p0) x (p2 - p0), of any
 * length, and o = p0 - centre, that is
 *
 *     (d + o) . N >= 0                                                                     (2)
 *
 * With C < 0, (1) holds for directions in more than a half space. No plane has all of these behind
 * it, so C < 0 is refused. For C >= 0, (1) is a convex set of d, and the least d . N in it follows
 * by duality: d . N - u (d . A - C |d| - 127 r) is bounded below, by 127 r u, exactly if |N - u A|
 * <= u C. So (2) holds in all of (1) if (and, where (1) has an interior, only if) there is a u >= 0
 * with
 *
 *     |N - u A| <= u C   and   127 r u + o . N >= 0
 *
 * Squared, with K = |A|^2 - C^2 and m = N . A, the first is  K u^2 - 2 m u + |N|^2 <= 0.
 *
 * K <= 0: By the Cauchy-Schwarz inequality, (1) holds for no eye unless r = 0. If r = 0, all
 * vertices
 *         are one point (the sphere has been checked), and nothing is drawn. So there is nothing to
 *         check.
 * K > 0:  A solution exists if m >= 0 and m^2 >= K |N|^2: the sine of the angle between N and A is
 *         at most C / |A|. That is exact. u = m / K is one solution, and 127 r m + K (o . N) >= 0
 *         is the second condition for it. (The largest u would be slightly less strict. As |o . N|
 *         <= r |N|, the condition always holds while K <= 127^2. An axis that rounding made longer,
 *         at most 127.87, fails it only for a plane that intersects the sphere beyond 0.993 r
 *         behind the centre.)
 *
 * A triangle without area has N = 0, and passes.
 *
 * For a tool that makes clusters: A may be rounded in any way. C is |A| times the sine of the
 * widest angle between the rounded A and a normal, rounded up; 127 if that angle is 90 degrees or
 * more. */

/* A sum of unsigned products, 128 bits. */
struct wide {
    uint64_t hi, lo;
};

static void add_product(struct wide *sum, uint64_t a, uint64_t b)
{
    const uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    const uint64_t low = a0 * b0;
    const uint64_t mid = a1 * b0 + (low >> 32);    /* <= (2^32 - 1)^2 + 2^32 - 1 < 2^64 */
    const uint64_t mid2 = a0 * b1 + (uint32_t)mid; /* the same */
    const uint64_t lo = mid2 << 32 | (uint32_t)low;
    sum->lo += lo;
    sum->hi += a1 * b1 + (mid >> 32) + (mid2 >> 32) + (sum->lo < lo);
}

static int at_least(const struct wide *a, const struct wide *b)
{
    return a->hi != b->hi ? a->hi > b->hi : a->lo >= b->lo;
}

static uint64_t magnitude(int64_t v)
{
    return v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
}

/* Compute the normal of a triangle, and the vector from a point to its first vertex, in 1/256 step.
 * |n| components < 2^49, |o| < 2^24 */
static void plane_of(const struct zs_mesh *m, uint32_t t, const int16_t point[3], int64_t n[3],
                     int32_t o[3])
{
    int32_t b[3], c[3]; /* edges, |.| < 2^24 */
    vertex_from(m, m->tri[t][0], point, o);
    vertex_from(m, m->tri[t][1], point, b);
    vertex_from(m, m->tri[t][2], point, c);
    for (int k = 0; k < 3; k++) {
        b[k] -= o[k]; /* a difference of two vertices: the point cancels out */
        c[k] -= o[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (int64_t)b[i] * c[j] - (int64_t)b[j] * c[i];
    }
}

/* Return 1 if a triangle passes the test above. excess: K, 1 .. 2^14. */
static int in_cone(const struct zs_mesh *mesh, const struct zs_cluster *c, uint32_t t,
                   int32_t excess)
{
    int64_t n[3], m = 0; /* |m| <= |A| |N| < 2^7 * 2^49.8 */
    int32_t o[3];
    plane_of(mesh, t, c->center, n, o);
    for (int k = 0; k < 3; k++)
        m += n[k] * c->axis[k];
    if (m < 0)
        return 0;
    struct wide left = { 0, 0 }, right = { 0, 0 }; /* < 2^116 */
    add_product(&left, (uint64_t)m, (uint64_t)m);
    for (int k = 0; k < 3; k++) {
        const uint64_t size = magnitude(n[k]);
        add_product(&right, size * (uint32_t)excess, size); /* < 2^63 * 2^49 */
    }
    if (!at_least(&left, &right))
        return 0;
    struct wide front = { 0, 0 }, behind = { 0, 0 }; /* < 2^91 */
    add_product(&front, (uint64_t)m, 127u * 256u * c->radius);
    for (int k = 0; k < 3; k++)
        add_product((n[k] < 0) == (o[k] < 0) ? &front : &behind, magnitude(n[k]) * (uint32_t)excess,
                    magnitude(o[k]));
    return at_least(&front, &behind);
}

/* Return 1 if twice the area, squared, is at least the square of height times longest side, or if
 * two vertices are one point. height in 1/256 step, < 2^20. */
static int high_enough(const struct zs_mesh *mesh, uint32_t t, uint32_t height)
{
    const uint16_t *const tri = mesh->tri[t];
    int64_t n[3];
    uint64_t longest = 0; /* squared, <= 3 * 2^48 */
    int32_t a[3], b[3];
    for (int k = 0; k < 3; k++) {
        uint64_t square = 0;
        vertex_from(mesh, tri[k], mesh->center, a);
        vertex_from(mesh, tri[k < 2 ? k + 1 : 0], mesh->center, b);
        for (int j = 0; j < 3; j++)
            square += (uint64_t)((int64_t)(a[j] - b[j]) * (a[j] - b[j]));
        if (square == 0)
            return 1;
        longest = square > longest ? square : longest;
    }
    plane_of(mesh, t, mesh->center, n, a);
    struct wide left = { 0, 0 }, right = { 0, 0 }; /* < 2^100 */
    for (int k = 0; k < 3; k++)
        add_product(&left, magnitude(n[k]), magnitude(n[k]));
    add_product(&right, (uint64_t)height * height, longest);
    return at_least(&left, &right);
}

/* ---- Clusters -------------------------------------------------------------------------------- */

static int cluster_spheres(const struct zs_mesh *m, const struct zs_cluster *c)
{
    for (uint32_t i = 0; i < c->n_tris; i++)
        for (int k = 0; k < 3; k++)
            if (!in_sphere(m, m->tri[c->first + i][k], c->center, c->radius))
                return 0;
    return 1;
}

static int cluster_cone(const struct zs_mesh *m, const struct zs_cluster *c)
{
    int32_t square = 0; /* <= 3 * 2^14 */
    for (int k = 0; k < 3; k++)
        square += c->axis[k] * c->axis[k];
    if (c->cutoff == 127)
        return 1;
    if (c->cutoff < 0 || square > 128 * 128)
        return 0;
    const int32_t excess = square - c->cutoff * c->cutoff;
    if (excess <= 0)
        return 1;
    for (uint32_t i = 0; i < c->n_tris; i++)
        if (!in_cone(m, c, c->first + i, excess))
            return 0;
    return 1;
}

static enum zs_flaw clusters_check(const struct zs_mesh *m, uint32_t *index)
{
    uint32_t next = 0; /* triangle; <= n_tris */
    for (uint32_t i = 0; i < m->n_clusters; i++) {
        const struct zs_cluster *c = &m->cluster[i];
        if (c->first != next || c->n_tris == 0 || c->n_tris > m->n_tris - next)
            return found(ZS_FLAW_CLUSTERS, index, i);
        next += c->n_tris;
    }
    if (next != m->n_tris)
        return found(ZS_FLAW_CLUSTERS, index, m->n_clusters);
    for (uint32_t i = 0; i < m->n_clusters; i++)
        if (!cluster_spheres(m, &m->cluster[i]))
            return found(ZS_FLAW_CLUSTER_SPHERE, index, i);
    for (uint32_t i = 0; i < m->n_clusters; i++)
        if (!cluster_cone(m, &m->cluster[i]))
            return found(ZS_FLAW_CLUSTER_CONE, index, i);
    for (uint32_t i = 0, t = 0; i < m->n_clusters; i++)
        for (const uint32_t end = t + m->cluster[i].n_tris; t < end; t++)
            if (!high_enough(m, t, m->cluster[i].height * 16u))
                return found(ZS_FLAW_CLUSTER_HEIGHT, index, i);
    return found(ZS_FLAW_NONE, index, 0);
}

/* ---- Hierarchies ----------------------------------------------------------------------------- */

/* Return the triangle behind the last one of node k < n, as the renderer finds it. */
static uint32_t node_end(const struct zs_mesh *m, uint32_t k, uint32_t n)
{
    return m->bvh[k].skip < n ? m->bvh[m->bvh[k].skip].first : m->n_tris;
}

/* Return 1 if node k of n is a leaf or has children, one after another, that end where it does. */
static int node_whole(const struct zs_mesh *m, uint32_t k, uint32_t n)
{
    uint32_t child = k + 1u;
    while (child < m->bvh[k].skip && m->bvh[child].skip > child)
        child = m->bvh[child].skip;
    return child == m->bvh[k].skip && child <= n && m->bvh[k].first < node_end(m, k, n) &&
           (child == k + 1u || m->bvh[k + 1u].first == m->bvh[k].first);
}

/* Every node is looked at as a child once: by the one whose child it is, as children end where
 * their parent does. */
static enum zs_flaw nodes_check(const struct zs_mesh *m, uint32_t *index)
{
    const uint32_t n = m->bvh[0].skip;
    if (n == 0 || (n - 1u) / 2u >= m->n_tris || m->bvh[0].first)
        return found(ZS_FLAW_NODES, index, 0);
    for (uint32_t k = 0; k < n; k++)
        if (m->bvh[k].skip <= k || m->bvh[k].skip > n || node_end(m, k, n) > m->n_tris)
            return found(ZS_FLAW_NODES, index, k);
    for (uint32_t k = 0; k < n; k++)
        if (!node_whole(m, k, n))
            return found(ZS_FLAW_NODES, index, k);
    for (uint32_t k = 0; k < n; k++)
        for (uint32_t t = m->bvh[k].first; t < node_end(m, k, n); t++)
            for (int v = 0; v < 3; v++)
                if (!in_sphere(m, m->tri[t][v], m->bvh[k].center, m->bvh[k].radius))
                    return found(ZS_FLAW_NODE_SPHERE, index, k);
    return found(ZS_FLAW_NONE, index, 0);
}

/* ---- Meshes ---------------------------------------------------------------------------------- */

static int mesh_aligned(const struct zs_mesh *m)
{
    return aligned(m->pos, sizeof(int16_t)) && aligned(m->tri, sizeof(uint16_t)) &&
           aligned(m->normal, sizeof(zs_q1_15)) && aligned(m->face_normal, sizeof(zs_q1_15)) &&
           aligned(m->face_raw, sizeof(uint16_t)) && aligned(m->uv, sizeof(int16_t)) &&
           aligned(m->cluster, sizeof(uint32_t)) && aligned(m->bvh, sizeof(uint32_t));
}

enum zs_flaw zs_mesh_check(const struct zs_mesh *m, uint32_t *index)
{
    if (!m || (!m->pos && m->n_verts) || (!m->tri && m->n_tris) || (!m->cluster && m->n_clusters))
        return found(ZS_FLAW_NULL, index, 0);
    if (!mesh_aligned(m))
        return found(ZS_FLAW_ALIGN, index, 0);
    if (m->n_verts > 65535u)
        return found(ZS_FLAW_COUNT, index, m->n_verts);
    for (uint32_t t = 0; t < m->n_tris; t++)
        for (int k = 0; k < 3; k++)
            if (m->tri[t][k] >= m->n_verts)
                return found(ZS_FLAW_INDEX, index, t);
    for (uint32_t v = 0; v < m->n_verts; v++)
        if (!in_sphere(m, v, m->center, m->radius))
            return found(ZS_FLAW_SPHERE, index, v);
    for (uint32_t v = 0; m->normal && v < m->n_verts; v++)
        if (!unit_or_none(m->normal[v]))
            return found(ZS_FLAW_NORMAL, index, v);
    for (uint32_t t = 0; m->face_normal && t < m->n_tris; t++)
        if (!unit_or_none(m->face_normal[t]))
            return found(ZS_FLAW_FACE_NORMAL, index, t);
    if (m->uv && m->uv_bits > 15u)
        return found(ZS_FLAW_UV_BITS, index, m->uv_bits);
    const enum zs_flaw flaw = m->cluster ? clusters_check(m, index) : found(ZS_FLAW_NONE, index, 0);
    return flaw == ZS_FLAW_NONE && m->bvh ? nodes_check(m, index) : flaw;
}

/* ---- Textures -------------------------------------------------------------------------------- */

/* Return the number of colours that the texels of a format can index; 0: it has no palette. */
static uint32_t colors_max(const struct zs_texel *format)
{
    return format == &zs_texel_pal8 ? 256u : format == &zs_texel_pal4 ? 16u : 0u;
}

/* at: row * width + column, < 2^21. The width is even if two texels share a byte. */
static uint32_t texel_at(const struct zs_texture *x, uint32_t at)
{
    const uint8_t *texel = x->texel;
    return x->format == &zs_texel_pal4 ? texel[at >> 1] >> (at & 1u) * 4u & 15u : texel[at];
}

enum zs_flaw zs_texture_check(const struct zs_texture *x, uint32_t *index)
{
    if (!x || !x->texel)
        return found(ZS_FLAW_NULL, index, 0);
    const uint32_t most = colors_max(x->format);
    if (most ? !x->palette : x->format != &zs_texel_565) /* also if it is NULL */
        return found(ZS_FLAW_NULL, index, 0);
    if (!aligned(most ? x->palette : x->texel, sizeof(uint16_t)))
        return found(ZS_FLAW_ALIGN, index, 0);
    if (x->log2_w > ZS_TEXTURE_LOG2_MAX || (x->format == &zs_texel_pal4 && x->log2_w == 0))
        return found(ZS_FLAW_SIZE, index, x->log2_w);
    if (x->log2_h > ZS_TEXTURE_LOG2_MAX)
        return found(ZS_FLAW_SIZE, index, x->log2_h);
    if (most && (x->n_colors == 0 || x->n_colors > most))
        return found(ZS_FLAW_COLORS, index, x->n_colors);
    if (x->clamp > (ZS_CLAMP_U | ZS_CLAMP_V))
        return found(ZS_FLAW_CLAMP, index, x->clamp);
    if (x->n_levels > x->log2_w + (most != 16u) || x->n_levels > x->log2_h + 1)
        return found(ZS_FLAW_LEVELS, index, x->n_levels);
    const uint32_t first = (uint32_t)1 << (x->log2_w + x->log2_h), one = x->n_levels > 0;
    const uint32_t n = (4u * first - (first >> 2u * (x->n_levels - one))) / 3u; /* < 2^21 */
    for (uint32_t i = 0; most && i < n; i++)
        if (texel_at(x, i) >= x->n_colors)
            return found(ZS_FLAW_TEXEL, index, i);
    return found(ZS_FLAW_NONE, index, 0);
}
