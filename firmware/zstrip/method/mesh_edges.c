/* The edges of a mesh, and which of them to draw.
 *
 * Every side of a triangle is a record; records are sorted by the places of both ends, so that
 * vertices that were split for their normals or texture coordinates do not make borders.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "zs_lines.h"
#include "zs_shader.h"

/* ---- Finding edges -------------------------------------------------------------------------- */

/* Compare the places of two vertices: < 0, 0, > 0. */
static int32_t place_cmp(const struct zs_mesh *mesh, uint32_t a, uint32_t b)
{
    for (int k = 0; k < 3; k++) {
        int32_t d = (mesh->pos[a][k] - mesh->pos[b][k]) * 256;
        if (mesh->pos_lo)
            d += mesh->pos_lo[a][k] - mesh->pos_lo[b][k];
        if (d)
            return d;
    }
    return 0;
}

static int32_t edge_cmp(const struct zs_mesh *mesh, const struct zs_mesh_edge *a,
                        const struct zs_mesh_edge *b)
{
    for (int k = 0; k < 2; k++) {
        const int32_t d = place_cmp(mesh, a->v[k], b->v[k]);
        if (d)
            return d;
    }
    return 0;
}

/* Like edge_cmp; sides at the same place are in the order of their triangles. */
static int after(const struct zs_mesh *mesh, const struct zs_mesh_edge *a,
                 const struct zs_mesh_edge *b)
{
    const int32_t d = edge_cmp(mesh, a, b);
    return d ? d > 0 : a->tri[0] > b->tri[0];
}

/* Heap sort: let edge[at] sink in the heap edge[0 .. n - 1], whose root is the last in order. */
static void sink(const struct zs_mesh *mesh, struct zs_mesh_edge *edge, uint32_t at, uint32_t n)
{
    const struct zs_mesh_edge it = edge[at];
    for (uint32_t k = 2u * at + 1u; k < n; k = 2u * at + 1u) {
        if (k + 1u < n && after(mesh, &edge[k + 1u], &edge[k]))
            k++;
        if (!after(mesh, &edge[k], &it))
            break;
        edge[at] = edge[k];
        at = k;
    }
    edge[at] = it;
}

static void sort(const struct zs_mesh *mesh, struct zs_mesh_edge *edge, uint32_t n)
{
    for (uint32_t k = n / 2u; k > 0; k--)
        sink(mesh, edge, k - 1u, n);
    for (uint32_t k = n; k > 1u; k--) {
        const struct zs_mesh_edge last = edge[0];
        edge[0] = edge[k - 1u];
        edge[k - 1u] = last;
        sink(mesh, edge, 0, k - 1u);
    }
}

/* Append the three sides of a triangle. Return 0 if it has none. */
static int sides(struct zs_mesh_edge *edge, const struct zs_mesh *mesh, uint32_t t)
{
    const uint16_t *const v = mesh->tri[t];
    for (int k = 0; k < 3; k++)
        if (v[k] >= mesh->n_verts)
            return 0;
    for (int k = 0; k < 3; k++) {
        const uint16_t a = v[k], b = v[k < 2 ? k + 1 : 0];
        const int32_t order = place_cmp(mesh, a, b);
        if (order == 0)
            return 0;
        edge[k].v[0] = order < 0 ? a : b;
        edge[k].v[1] = order < 0 ? b : a;
        edge[k].tri[0] = (uint16_t)t;
        edge[k].tri[1] = ZS_EDGE_NO_TRI;
    }
    return 1;
}

int32_t zs_edges_of(struct zs_mesh_edge *edge, const struct zs_mesh *mesh)
{
    uint32_t n = 0, kept = 0;
    if (!edge || !mesh || (mesh->n_tris && (!mesh->tri || !mesh->pos)))
        return ZS_ERR_NULL;
    if (mesh->n_tris >= ZS_EDGE_NO_TRI)
        return ZS_ERR_SIZE;
    for (uint32_t t = 0; t < mesh->n_tris; t++)
        n += sides(edge + n, mesh, t) ? 3u : 0u;
    sort(mesh, edge, n);
    for (uint32_t at = 0; at < n;) {
        uint32_t end = at + 1u;
        while (end < n && edge_cmp(mesh, &edge[at], &edge[end]) == 0)
            end++;
        struct zs_mesh_edge it = edge[at];
        if (end - at == 2u)
            it.tri[1] = edge[at + 1u].tri[0];
        edge[kept++] = it;
        at = end;
    }
    return (int32_t)kept;
}

/* ---- Choosing edges ------------------------------------------------------------------------- */

/* Where the eye is, in the axes of a mesh. */
struct eye {
    const struct zs_mesh *mesh;
    uint64_t scale; /* world units of a step, q32_32 */
    int64_t at[3];  /* perspective: the eye, q48_16 world units; else the direction to it, q2_30 */
    uint8_t perspective;
    uint8_t known; /* 0: nothing faces it */
};

static void eye_set(struct eye *eye, const struct zs_mesh *mesh, const struct zs_instance *in,
                    const struct zs_camera *camera)
{
    eye->mesh = mesh;
    eye->known = in && camera;
    if (!eye->known)
        return;
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    const zs_q2_30 *const view = zs_usual_rotation(camera->rot);
    eye->perspective = camera->projection == ZS_PERSPECTIVE;
    eye->scale = zs_usual_scale(in);
    for (int j = 0; j < 3; j++) {
        int64_t sum = 0; /* perspective: |.| <= 3 * 2^60 */
        for (int k = 0; k < 3; k++)
            sum += zs_mul_ss(rot[3 * k + j], eye->perspective ? camera->pos[k] - in->pose.pos[k]
                                                              : view[6 + k]);
        eye->at[j] = zs_round_shift(sum, eye->perspective ? 14 : 30);
    }
}

/* Return 1 if a triangle with a normal faces the eye. */
static int faces(const struct eye *eye, uint32_t t, const zs_q1_15 normal[3])
{
    const struct zs_mesh *const mesh = eye->mesh;
    const uint32_t v = mesh->tri[t][0];
    int64_t sum = 0; /* |.| < 2^62 */
    for (int k = 0; k < 3; k++) {
        int64_t to = eye->at[k]; /* |.| < 2^47.6 */
        if (eye->perspective) {
            const int32_t pos = mesh->pos[v][k] * 256 + (mesh->pos_lo ? mesh->pos_lo[v][k] : 0);
            to -= zs_mulshift_s64(pos, eye->scale, 24); /* |.| <= 2^46 */
            to >>= 4;
        }
        sum += to * normal[k];
    }
    return sum > 0;
}

/* Return enum zs_edge_kind, or-ed. */
static uint32_t kinds_of(const struct zs_mesh_edge *edge, const struct eye *eye, zs_q2_30 least)
{
    zs_q1_15 normal[2][3];
    int32_t dot = 0; /* q2_30; below 2^30 + 2^17 */
    if (edge->tri[1] == ZS_EDGE_NO_TRI)
        return ZS_EDGE_BORDER;
    for (int k = 0; k < 2; k++)
        zs_light_face_normal(normal[k], eye->mesh, edge->tri[k]);
    for (int k = 0; k < 3; k++)
        dot += normal[0][k] * normal[1][k];
    uint32_t kinds = dot <= least ? ZS_EDGE_CREASE : 0u;
    if (eye->known &&
        faces(eye, edge->tri[0], normal[0]) != faces(eye, edge->tri[1], normal[1]))
        kinds |= ZS_EDGE_SILHOUETTE;
    return kinds ? kinds : ZS_EDGE_SMOOTH;
}

uint32_t zs_edges_choose(uint16_t (*line)[2], uint32_t room, const struct zs_mesh_edge *edge,
                         uint32_t n, const struct zs_mesh *mesh, uint32_t kinds, zs_turn crease,
                         const struct zs_instance *instance, const struct zs_camera *camera)
{
    struct eye eye;
    uint32_t chosen = 0;
    const zs_q2_30 least = zs_cos(crease);
    eye_set(&eye, mesh, instance, camera);
    for (uint32_t k = 0; k < n && chosen < room; k++) {
        if ((kinds & ZS_EDGE_ALL) != ZS_EDGE_ALL && !(kinds_of(&edge[k], &eye, least) & kinds))
            continue;
        line[chosen][0] = edge[k].v[0];
        line[chosen][1] = edge[k].v[1];
        chosen++;
    }
    return chosen;
}
