/* Triangles in a good order: clusters that lie close together, vertices numbered as they are used.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_CLUSTER_H
#define SIM_CLUSTER_H

#include <stdint.h>

#include "zstrip.h"

#define SIM_CLUSTER_TRIS 64u

/* Triangles over vertices at integer positions. Borrowed. */
struct sim_shape {
    const int32_t (*fine)[3]; /* [n_verts], 1/256 mesh step, |.| < 2^23 */
    const uint32_t (*tri)[3]; /* [n_tris], none of them without area */
    uint32_t n_verts, n_tris;
};

/* A sphere around points: its middle rounded to steps, its radius up to the next whole step. The
 * smallest of three attempts. n > 0. */
void sim_sphere(int16_t center[3], uint16_t *radius, const int32_t (*fine)[3], uint32_t n);

/* Sort triangles into clusters of at most SIM_CLUSTER_TRIS.
 *
 * order    [n_tris], filled: place -> number in shape->tri.
 * facing   1: cones matter (the material culls back sides), so that triangles that face alike
 *          come together.
 * Return   malloc'ed [*n], complete: spheres hold every vertex, cones every triangle, after
 *          rounding. */
struct zs_cluster *sim_cluster(uint32_t *order, uint32_t *n, const struct sim_shape *shape,
                               int facing);

/* Number vertices in the order of their first use. remap [n_verts], filled: old number -> new,
 * UINT32_MAX where no triangle uses it. Return how many are used. */
uint32_t sim_use_order(uint32_t *remap, const uint32_t (*tri)[3], uint32_t n_tris,
                       uint32_t n_verts);

/* Vertices that a first-in first-out cache of a size would transform, to a triangle. */
double sim_cache_misses(const uint16_t (*tri)[3], uint32_t n_tris, uint32_t n_verts, uint32_t size);

#endif
