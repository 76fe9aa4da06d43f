/* Shares of a scene: the same instances with some of their triangles, for threads that draw a frame together.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SCENE_SHARE_H
#define SIM_SCENE_SHARE_H

#include "zstrip.h"

/* A scene with triangles [first, end) of all of another's, counted in scene order. Where it has all of a mesh's, the
 * mesh is the other's own; else one with the vertices that its triangles name. Spheres, poses and order are as they
 * were, so that every triangle is drawn with the same bits. Memory of its own. */
struct sim_share {
    struct zs_scene scene;
    struct zs_instance *instance; /* [n_instances] */
    struct zs_mesh *mesh;         /* [n_instances] */
    void **block;                 /* [n_blocks], what the copies' arrays lie in */
    uint32_t n_blocks;
};

/* *share: any state. The scene is borrowed until sim_share_free. */
void sim_share_make(struct sim_share *share, const struct zs_scene *scene, uint64_t first, uint64_t end);
void sim_share_free(struct sim_share *share);

#endif
