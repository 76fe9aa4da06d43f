/* Hierarchies of spheres: see nodes.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "nodes.h"

/* A sphere around the vertices of triangles [from, end), by its box's middle. 0: a vertex is out of range. */
static int sphere(struct zs_bvh_node *to, const struct zs_mesh *m, uint32_t from, uint32_t end)
{
    int32_t lo[3] = { 32767, 32767, 32767 }, hi[3] = { -32768, -32768, -32768 };
    int64_t most = 0, r = 0;
    for (uint32_t i = 3 * from; i < 3 * end; i++) {
        const uint32_t v = m->tri[i / 3][i % 3];
        if (v >= m->n_verts)
            return 0;
        for (int k = 0; k < 3; k++) {
            lo[k] = m->pos[v][k] < lo[k] ? m->pos[v][k] : lo[k];
            hi[k] = m->pos[v][k] > hi[k] ? m->pos[v][k] : hi[k];
        }
    }
    for (int k = 0; k < 3; k++)
        to->center[k] = (int16_t)((lo[k] + hi[k]) / 2);
    for (uint32_t i = 3 * from; i < 3 * end; i++) {
        int64_t square = 0;
        for (int k = 0; k < 3; k++) {
            const uint32_t v = m->tri[i / 3][i % 3];
            const int64_t d = (m->pos[v][k] - to->center[k]) * 256 + (m->pos_lo ? m->pos_lo[v][k] : 0);
            square += d * d;
        }
        most = square > most ? square : most;
    }
    while (r * r * 65536 < most)
        r += 1 + r / 256; /* rounded up, a little more where it is large */
    to->radius = (uint16_t)(r > 65535 ? 65535 : r);
    return r <= 65535;
}

/* Build nodes over triangles [from, end) from node *n on. 0: that is not possible. */
static int build(struct zs_bvh_node *at, uint32_t *n, uint32_t room, const struct zs_mesh *m, uint32_t from,
                 uint32_t end, uint32_t leaf)
{
    const uint32_t k = (*n)++;
    if (k >= room || !sphere(&at[k], m, from, end))
        return 0;
    at[k].first = from;
    if (end - from > leaf) {
        const uint32_t mid = from + (end - from) / 2;
        if (!build(at, n, room, m, from, mid, leaf) || !build(at, n, room, m, mid, end, leaf))
            return 0;
    }
    at[k].skip = *n;
    return 1;
}

uint32_t nodes_make(struct zs_bvh_node *at, uint32_t room, const struct zs_mesh *m, uint32_t leaf)
{
    uint32_t n = 0;
    return m->n_tris && build(at, &n, room, m, 0, m->n_tris, leaf) ? n : 0;
}
