/* Shares of a scene.
 *
 * SPDX-License-Identifier: MIT
 */
#include "scene_share.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

#define VERTS_MAX 65536u /* of a mesh: what 16 bits can name */

/* Vertices of a mesh that triangles of it name: all of [base, base + n), or those in source, as they come. */
struct picked {
    uint32_t base, n;
    uint16_t *source; /* [n]: number in the mesh; NULL: base .. */
};

/* n things of a size that belong to the share. */
static void *block(struct sim_share *share, size_t n, size_t size)
{
    void *p = sim_grow(NULL, n, size); /* all of it is written */
    share->block[share->n_blocks++] = p;
    return p;
}

/* Whether the vertices that n > 0 triangles name lie so close together that they need not be copied. */
static int close_by(struct picked *out, const uint16_t *index, uint32_t n, uint32_t n_verts)
{
    uint16_t least = UINT16_MAX, most = 0;
    for (const uint16_t *const end = index + 3u * n; index < end; index++) {
        least = *index < least ? *index : least;
        most = *index > most ? *index : most;
    }
    out->base = least;
    out->n = most - least + 1u;
    out->source = NULL;
    return most < n_verts && out->n <= n;
}

/* Copy n triangles under new numbers, as they come. One that names no vertex of the mesh does not name one of the copy
 * either. */
static void renumber(struct sim_share *share, struct picked *out, uint16_t *to, const uint16_t *index, uint32_t n,
                     uint32_t n_verts)
{
    uint16_t *number = sim_alloc(VERTS_MAX, sizeof *number); /* + 1 in the copy; 0: not named yet */
    out->source = block(share, 3u * n < n_verts ? 3u * n : n_verts, sizeof *out->source);
    out->n = 0;
    for (const uint16_t *const end = index + 3u * n; index < end; index++) {
        const uint16_t v = *index;
        if (v < n_verts && number[v] == 0) {
            out->source[out->n++] = v;
            number[v] = (uint16_t)out->n; /* at most 65535 */
        }
        *to++ = v < n_verts ? (uint16_t)(number[v] - 1u) : UINT16_MAX;
    }
    free(number);
}

/* Elements of an array by vertex; NULL where there is none. */
static const void *gathered(struct sim_share *share, const void *from, size_t size, const struct picked *picked)
{
    if (from == NULL)
        return NULL;
    if (picked->source == NULL)
        return (const char *)from + picked->base * size;
    char *to = block(share, picked->n, size);
    for (uint32_t i = 0; i < picked->n; i++)
        memcpy(to + i * size, (const char *)from + picked->source[i] * size, size);
    return to;
}

/* Triangles [first, first + n), and which vertices they name. */
static const uint16_t (*picked_tris(struct sim_share *share, struct picked *picked, const struct zs_mesh *mesh,
                                    uint32_t first, uint32_t n))[3]
{
    const uint16_t *index = mesh->tri[first];
    const int close = close_by(picked, index, n, mesh->n_verts);
    if (close && picked->base == 0)
        return mesh->tri + first;
    uint16_t *to = block(share, n, sizeof *mesh->tri);
    if (close)
        for (uint32_t i = 0; i < 3u * n; i++)
            to[i] = (uint16_t)(index[i] - picked->base);
    else
        renumber(share, picked, to, index, n, mesh->n_verts);
    return (const uint16_t (*)[3])(const void *)to;
}

/* Clusters as far as they hold triangles [first, end): what they say of all of theirs holds for some. */
static void cut_clusters(struct sim_share *share, struct zs_mesh *out, const struct zs_mesh *mesh, uint32_t first,
                         uint32_t end)
{
    if (mesh->cluster == NULL)
        return;
    struct zs_cluster *to = block(share, mesh->n_clusters, sizeof *to);
    out->cluster = to;
    out->n_clusters = 0;
    for (uint32_t i = 0; i < mesh->n_clusters; i++) {
        const uint32_t a = mesh->cluster[i].first, b = a + mesh->cluster[i].n_tris;
        if (b <= first || a >= end)
            continue;
        struct zs_cluster *c = &to[out->n_clusters++];
        *c = mesh->cluster[i];
        c->first = (a > first ? a : first) - first;
        c->n_tris = (uint16_t)((b < end ? b : end) - (a > first ? a : first));
    }
}

#define BLOCKS_MAX 8 /* a mesh: triangles, sources, pos, pos_lo, normal, vertex_rgb, uv, clusters */

/* Triangles [first, end) of a mesh, which has more. */
static void cut_mesh(struct sim_share *share, struct zs_mesh *out, const struct zs_mesh *mesh, uint32_t first,
                     uint32_t end)
{
    struct picked picked;
    *out = *mesh;
    out->bvh = NULL;
    share->block = sim_grow(share->block, share->n_blocks + BLOCKS_MAX, sizeof *share->block);
    out->n_tris = end - first;
    out->tri = picked_tris(share, &picked, mesh, first, end - first);
    out->n_verts = picked.n;
    out->pos = gathered(share, mesh->pos, sizeof *mesh->pos, &picked);
    out->pos_lo = gathered(share, mesh->pos_lo, sizeof *mesh->pos_lo, &picked);
    out->normal = gathered(share, mesh->normal, sizeof *mesh->normal, &picked);
    out->vertex_rgb = gathered(share, mesh->vertex_rgb, sizeof *mesh->vertex_rgb, &picked);
    out->uv = gathered(share, mesh->uv, sizeof *mesh->uv, &picked);
    out->face_normal = mesh->face_normal != NULL ? mesh->face_normal + first : NULL;
    out->face_rgb = mesh->face_rgb != NULL ? mesh->face_rgb + first : NULL;
    out->face_raw = mesh->face_raw != NULL ? mesh->face_raw + first : NULL;
    cut_clusters(share, out, mesh, first, end);
}

void sim_share_make(struct sim_share *share, const struct zs_scene *scene, uint64_t first, uint64_t end)
{
    memset(share, 0, sizeof *share);
    share->instance = sim_alloc(scene->n_instances, sizeof *share->instance);
    share->mesh = sim_alloc(scene->n_instances, sizeof *share->mesh);
    share->scene = *scene;
    share->scene.instance = share->instance;
    uint64_t at = 0; /* triangles of the instances before */
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const struct zs_mesh *mesh = scene->instance[i].mesh;
        const uint64_t n = mesh->n_tris;
        const uint64_t from = first > at ? first - at : 0, to = end > at ? end - at : 0;
        share->instance[i] = scene->instance[i];
        if (from >= n || to == 0) { /* its sphere still counts: camera units are chosen by the farthest */
            share->mesh[i] = *mesh;
            share->mesh[i].n_tris = share->mesh[i].n_verts = share->mesh[i].n_clusters = 0;
            share->instance[i].mesh = &share->mesh[i];
        } else if (from > 0 || to < n) {
            cut_mesh(share, &share->mesh[i], mesh, (uint32_t)from, (uint32_t)(to < n ? to : n));
            share->instance[i].mesh = &share->mesh[i];
        }
        at += n;
    }
}

void sim_share_free(struct sim_share *share)
{
    for (uint32_t i = 0; i < share->n_blocks; i++)
        free(share->block[i]);
    free(share->block);
    free(share->instance);
    free(share->mesh);
    memset(share, 0, sizeof *share);
}
