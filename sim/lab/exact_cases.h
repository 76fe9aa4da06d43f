/* What can be known exactly: triangles whose corners fall on sub-pixels, drawn through the public
 * interface, against whole-number arithmetic.
 *
 * One world unit is 1/256 px at the distance EXACT_Z, and distances are EXACT_Z times powers of
 * two: so a corner's screen position and its 1 / z are exact.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_EXACT_CASES_H
#define SIM_EXACT_CASES_H

#include <stdint.h>

#include "zstrip.h"

#define SIM_EXACT_MAPPINGS 6 /* the sixth: linear in an orthographic view */
extern const char *const sim_exact_mapping[SIM_EXACT_MAPPINGS];
extern const struct zs_depth *const sim_exact_depth[SIM_EXACT_MAPPINGS];

/* The sentence for a scene that zs_render refused. An exit status. */
int sim_exact_refuse(int err);

struct sim_exact_triangles {
    uint64_t triangles, pixels; /* compared, covered or not */
    uint64_t wrong;             /* pixels whose coverage is not the int64 oracle's */
    uint64_t keys[SIM_EXACT_MAPPINGS];
    double key_worst[SIM_EXACT_MAPPINGS]; /* |key - exact|, buckets; exact at most 2^bits - 2 */
};
/* n random triangles, one a frame of 320x240, all shapes from slivers to the guard band. Seeds
 * seed, seed + 1 ... Return SIM_OK or SIM_REFUSED, as all here. */
int sim_exact_triangles(struct sim_exact_triangles *out, uint64_t seed, uint32_t n);

struct sim_exact_edges {
    uint64_t meshes, pixels;              /* pixels inside, each to be hit once */
    uint64_t cracks, double_hits, beyond; /* beyond: drawn outside */
};
/* n random meshes that fill a rectangle: grids, fans, points dropped into triangles. Half face the
 * camera, of exactly known corners; half are tilted, most of them cut at near. Tilted ones with
 * slivers are counted for cracks alone: where snapping turns a sliver over, it and its neighbours
 * share pixels in any renderer that snaps. */
int sim_exact_edges(struct sim_exact_edges *out, uint64_t seed, uint32_t n);
/* Pixels that two triangles of the scene's draw: the last one differs from the last one of the
 * reverse order, depth aside. */
int sim_exact_double_hits(uint64_t *out, const struct zs_scene *scene,
                          const struct zs_camera *camera, uint16_t width, uint16_t height);

struct sim_exact_layers {
    uint64_t pixels, swapped; /* the farther one of two layers is seen */
    uint64_t unequal;         /* ... though its key alone is another */
};
/* n pairs of layers so many buckets apart, at any distance, far / near 10 to 10^5, under all
 * mappings. */
int sim_exact_layers(struct sim_exact_layers *out, uint64_t seed, uint32_t n, double buckets);

struct sim_exact_texels {
    uint64_t coordinates, differ,
        far;      /* differ: not the texel that is right; far: nor the one beside it */
    double worst; /* how far outside of the texel taken a coordinate lies, texels */
};
/* n triangles with a texture of 256x256 and this ratio of w, a power of two up to 32. */
int sim_exact_texels(struct sim_exact_texels *out, uint64_t seed, uint32_t n, uint32_t ratio);

#endif
