/* What the show shows: one scene, and the memory it gets. A scene's own file ends with SHOW(...); see my_scene.c.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SHOW_H
#define SHOW_H

#include "scenes.h"
#include "zstrip.h"

#ifndef SHOW_WIDTH
#define SHOW_WIDTH 240 /* px of the picture: with SHOW_ROTATE 1 or 3 of the glass, turned */
#endif
#ifndef SHOW_HEIGHT
#define SHOW_HEIGHT 240
#endif

struct show {
    const struct demo *demo;
    uint16_t rate; /* frames of its animation a second, 1 .. 1000 */
    uint16_t rows; /* of a strip */
    uint16_t tris, verts;
    uint8_t attrs;
    uint32_t *arena;
    uint32_t arena_bytes;
};
extern const struct show show;

#define SHOW(scene, rate, rows, tris, verts, attrs)                                               \
    ZS_ARENA(show_arena, ZS_ARENA_BYTES(SHOW_WIDTH, SHOW_HEIGHT, rows, tris, verts, attrs, 2));   \
    const struct show show = { &scene, rate, rows, tris, verts, attrs, show_arena, sizeof show_arena }

#endif
