/* Scenes that isolate what a renderer does, one stage or kernel each: what costs by stage are fitted from (make costs).
 * Generated with integers alone, so that every machine draws the same; none is a demo or bench scene.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PROBES_H
#define PROBES_H

#include "scenes.h"
#include "zs_method.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PROBE_CELLS_X 24u
#define PROBE_CELLS_Y 20u
#define PROBE_VERTS ((PROBE_CELLS_X + 1u) * (PROBE_CELLS_Y + 1u))
#define PROBE_TRIS (2u * PROBE_CELLS_X * PROBE_CELLS_Y)
#define PROBE_LAYERS 3u
#define PROBE_NAME_CHARS 48u
#define PROBE_WIDTH_MAX 320u
#define PROBE_HEIGHT_MAX 96u

/* Bytes of arena that take every probe. */
#define PROBE_ARENA_BYTES                                                                                      \
    ZS_ARENA_BYTES(PROBE_WIDTH_MAX, PROBE_HEIGHT_MAX, 40, PROBE_LAYERS * PROBE_TRIS + 64,                      \
                   PROBE_LAYERS * PROBE_VERTS + 64, 3, 1)

struct probe {
    char name[PROBE_NAME_CHARS];
    uint8_t common; /* flag: one of many that tell much the same */
    struct zs_config config;
    struct demo_frame frame; /* points to arrays that the next probe overwrites */
};

/* Fill *p with probe i. Return 0: there are no more. Meshes and textures are static: one probe at a time. */
int probe_make(struct probe *p, uint32_t i);

#ifdef __cplusplus
}
#endif

#endif
