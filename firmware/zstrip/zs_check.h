/* Checks of data that cannot be trusted: a mesh from a card, a texture from a file.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CHECK_H
#define ZS_CHECK_H

#include "zs_scene.h"

ZS_C_BEGIN

/* "index" is what the functions below report besides. */
enum zs_flaw {
    ZS_FLAW_NONE = 0,
    ZS_FLAW_NULL,        /* pos, tri, cluster, texel, palette or format is missing, or the format is
                            not one of the library's */
    ZS_FLAW_ALIGN,       /* an array is not aligned for its elements */
    ZS_FLAW_COUNT,       /* more than 65535 vertices; index: how many */
    ZS_FLAW_INDEX,       /* index: a triangle with a vertex number >= n_verts */
    ZS_FLAW_SPHERE,      /* index: a vertex outside the mesh's sphere */
    ZS_FLAW_NORMAL,      /* index: a vertex whose normal is not of length 1 (0.98 .. 1.02, or 0) */
    ZS_FLAW_FACE_NORMAL, /* index: a face whose normal is not of length 1 (the same) */
    ZS_FLAW_UV_BITS,     /* uv is given and uv_bits is above 15; index: uv_bits */
    ZS_FLAW_CLUSTERS, /* index: a cluster that does not begin where the one before ended, is empty
                         or goes beyond n_tris; n_clusters: triangles follow the last one */
    ZS_FLAW_CLUSTER_SPHERE, /* index: a cluster with a vertex outside its sphere */
    ZS_FLAW_CLUSTER_CONE,   /* index: a cluster with a triangle that its cone does not hold (check.c
                               says when), a cutoff below 0 or an axis longer than 128 */
    ZS_FLAW_CLUSTER_HEIGHT, /* index: a cluster with a triangle that is flatter than its height */
    ZS_FLAW_SIZE,           /* a texture's log2_w or log2_h is out of range; index: that value */
    ZS_FLAW_COLORS,         /* a texture's n_colors is out of range; index: n_colors */
    ZS_FLAW_CLAMP,          /* a texture's clamp is no enum zs_clamp; index: clamp */
    ZS_FLAW_TEXEL,          /* index: row * width + column of a texel >= n_colors; those of coarser
                               levels follow */
    ZS_FLAW_LEVELS,         /* more levels than its size allows (zs_filter.h); index: n_levels */
    ZS_FLAW_NODES,      /* index: a node of bvh whose first or skip is not that of a hierarchy over
                           all triangles, in order, each in one leaf; 0: more than 2 * n_tris */
    ZS_FLAW_NODE_SPHERE /* index: a node with a vertex outside its sphere */
};

/* Find the first flaw: whatever would make the renderer read out of bounds or draw wrongly. A mesh
 * and a texture that pass are drawn without a read out of bounds by every shader that
 * zs_frame_begin accepts for them.
 *
 * mesh, texture  all of it is read, nothing beyond its counts. NULL: ZS_FLAW_NULL. Of mesh.bvh node
 *                0 is read, and as many nodes as its skip says, if these are at most 2 * n_tris:
 *                see to it first that so many were loaded.
 * index          set to the triangle, vertex, cluster, texel or value that is named above, else 0;
 *                NULL: not wanted.
 *                Textures with alpha: zs_alpha_texture_check (zs_filter.h).
 * Cost           linear in the data, times the depth of bvh; once after loading.
 * Return         ZS_FLAW_NONE or the flaw. */
enum zs_flaw zs_mesh_check(const struct zs_mesh *mesh, uint32_t *index);
enum zs_flaw zs_texture_check(const struct zs_texture *texture, uint32_t *index);

/* One English clause for a flaw, without a full stop; never NULL. Static storage. */
const char *zs_flaw_string(enum zs_flaw flaw);

ZS_C_END

#endif
