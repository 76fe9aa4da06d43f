/* Random scenes: mostly drawable, often odd, sometimes wrong.
 *
 * Every array lies in a block of the heap that is exactly as long as its count says, so that the sanitizer
 * sees a read too far.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_WORLD_H
#define TESTS_FUZZ_WORLD_H

#include "effects.h"
#include "prng.h"
#include "zstrip.h"

#define WORLD_MESHES 4
#define WORLD_TEXTURES 3
#define WORLD_MATERIALS 6
#define WORLD_STATES 4
#define WORLD_INSTANCES 10
#define WORLD_BLOCKS 128

struct world {
    struct zs_mesh mesh[WORLD_MESHES];
    struct zs_texture texture[WORLD_TEXTURES];
    struct zs_material material[WORLD_MATERIALS];
    union effect_material effect[WORLD_MATERIALS]; /* of world_effects */
    struct zs_depth_state state[WORLD_STATES];
    struct zs_instance *instance; /* [n_instances]; the scene may name fewer, none or too many */
    uint32_t n_instances;
    struct zs_scene scene;
    struct zs_background sky;
    struct zs_resolve resolve[2];
    uint16_t sky_seed;
    struct zs_rect overlay[2]; /* of own_draw */
    struct zs_camera camera;
    int trusted; /* 1: every mesh keeps its sphere and its clusters: what is skipped is empty */
    void *block[WORLD_BLOCKS];
    size_t bytes[WORLD_BLOCKS];
    int n_blocks;
};

/* 1 in n. */
static inline int one_in(struct prng *p, uint32_t n)
{
    return prng_pick(p, n) == 0;
}

/* odd: 1 in how many of its choices is beyond what is sensible; 0: none. */
void world_make(struct world *w, struct prng *p, uint32_t odd);
/* Give most of its instances effects, some textures alpha or mipmaps, perhaps a sky, and a hook over strips. e is kept
 * while the world is drawn: drawing changes what its hooks remember. config: of the frame, with its method.
 * 1; 0: a shadow map was not the same twice. */
int world_effects(struct world *w, struct effects *e, struct prng *p, const struct zs_config *config, uint32_t odd);
/* Another camera on the same scene, mostly of the same projection. */
void world_camera(struct world *w, struct prng *p, uint32_t odd);
/* Make one mesh as large as a mesh may be (one instance), or the instances 65535. */
void world_big(struct world *w, struct prng *p);
void world_free(struct world *w);
/* A checksum of everything in it: drawing must change nothing. */
uint64_t world_sum(const struct world *w);
/* One line about it on stderr, for who replays a case. */
void world_print(const struct world *w);

#endif
