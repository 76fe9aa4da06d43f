/* Random scenes drawn by one method: the frame is the same in any other way.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_WAYS_H
#define TESTS_WAYS_H

#include "../lab/fuzz/world.h"

struct ways {
    int32_t width, height; /* px, at most */
    const struct zs_depth *depth;
    const struct zs_depth *ortho; /* for orthographic cameras; NULL: depth */
    const struct zs_method *method[2]; /* one of them; method[1] NULL: the first */
    void (*more)(struct world *w, struct prng *p); /* change the scene; NULL: as it is */
    unsigned *again, *splits; /* counted: scenes in several walks, triangles split; may be NULL */
};

/* How far ahead of the camera, at the origin, a triangle's farthest corner is: three positions a triangle. */
static inline int32_t ways_distance(const int16_t (*pos)[3], uint32_t triangle)
{
    int32_t z = 0;
    for (uint32_t k = 0; k < 3; k++)
        z = -pos[3 * triangle + k][2] > z ? -pos[3 * triangle + k][2] : z;
    return z;
}

/* A case: a scene by seed, drawn whole and in any other way. Return 1: alike, or refused alike. */
int ways_alike(uint64_t seed, const struct ways *of);

#endif
