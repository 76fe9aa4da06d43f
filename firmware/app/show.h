/* What the show shows: one scene, on what glass, and the memory it gets. A scene's own file ends with SHOW(...); see
 * my_scene.c. What is to be chosen stands here, each with a value that -D on the command line (make firmware
 * DEFINES='-D...') or BOARD_FLAGS of a board.mk replace.
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

/* The panel: a type of panel.h. Its glass shows the picture alone, or is larger and shows it from SHOW_X, SHOW_Y on.
 * What its wire may take is the board's to know: SPI_DIVIDER or SPI_MHZ in pins.h. */
#ifndef SHOW_PANEL
#define SHOW_PANEL panel_st7789
#endif
#ifndef SHOW_PIXEL_BITS
#define SHOW_PIXEL_BITS 16 /* on its wire: 4 for a grey panel, 1 for a one-bit panel */
#endif
#ifndef SHOW_ROTATE
#define SHOW_ROTATE 0 /* quarter turns */
#endif
#ifndef SHOW_GLASS_WIDTH
#define SHOW_GLASS_WIDTH (SHOW_ROTATE & 1 ? SHOW_HEIGHT : SHOW_WIDTH) /* px, not turned */
#endif
#ifndef SHOW_GLASS_HEIGHT
#define SHOW_GLASS_HEIGHT (SHOW_ROTATE & 1 ? SHOW_WIDTH : SHOW_HEIGHT)
#endif
#ifndef SHOW_X
#define SHOW_X 0
#endif
#ifndef SHOW_Y
#define SHOW_Y 0
#endif
#ifndef SHOW_INVERT
#define SHOW_INVERT 1 /* IPS glass */
#endif
#ifndef SHOW_BGR
#define SHOW_BGR 0 /* 1: most GC9A01 and ILI9341 modules */
#endif

/* Quality and memory. A scene asks for rows, triangles and vertices; parts with little RAM give it less, which costs
 * time and never a pixel. */
#ifndef SHOW_SUBPIXEL
#define SHOW_SUBPIXEL 8 /* sub-pixel bits, 4 or 8 */
#endif
#ifndef SHOW_BUFFERS
#define SHOW_BUFFERS 2 /* strips in RAM. 1: nothing is drawn while pixels leave, unless they were converted */
#endif
#ifndef SHOW_ROWS_MAX
#define SHOW_ROWS_MAX SHOW_HEIGHT /* one-bit panels: a multiple of 8, grey ones of 2; a scene's own rows are made one */
#endif
#ifndef SHOW_TRIS_MAX
#define SHOW_TRIS_MAX ZS_POOL_MAX
#endif
#ifndef SHOW_VERTS_MAX
#define SHOW_VERTS_MAX ZS_POOL_MAX
#endif

/* How hidden surfaces are removed: METHOD= of make firmware sets these. */
#ifndef SHOW_MAPPING
#define SHOW_MAPPING show.demo->depth
#endif
#ifndef SHOW_NO_KEYS
#define SHOW_NO_KEYS 0 /* 1: the method keeps no depth keys */
#endif
#ifndef SHOW_RECORDS
#define SHOW_RECORDS 0 /* 1: it keeps records of its own in the pool of triangles */
#endif

/* Cores that draw: 2 with CORES=2, on a board that has a second one. Strips and pools are there twice then. */
#ifndef SHOW_CORES
#define SHOW_CORES 1
#endif

struct show {
    const struct demo *demo;
    uint16_t rate; /* frames of its animation a second, 1 .. 1000 */
    uint16_t rows; /* of a strip */
    uint16_t tris, verts;
    uint8_t varyings;
    uint32_t *arena, *scratch; /* scratch: for the panel */
    uint32_t arena_bytes, scratch_bytes;
#if SHOW_CORES == 2
    uint32_t *arena_2; /* the second core's, as large */
#endif
};
extern const struct show show;

#define SHOW_LEAST(a, b) ((a) < (b) ? (a) : (b))
#define SHOW_GRAIN (SHOW_PIXEL_BITS > 4 ? 1 : SHOW_PIXEL_BITS > 1 ? 2 : 8) /* rows: a one-bit panel has pages */
#define SHOW_WHOLE(rows) (((rows) + SHOW_GRAIN - 1) / SHOW_GRAIN * SHOW_GRAIN)
#define SHOW_ARENA_BYTES(rows, tris, verts, varyings) \
    (ZS_ARENA_BYTES(SHOW_WIDTH, SHOW_HEIGHT, rows, tris, verts, varyings, SHOW_BUFFERS) - \
     (SHOW_NO_KEYS ? ZS_DEPTH_BYTES(SHOW_WIDTH, rows) : 0u))
#define SHOW_SCRATCH(rows) (SHOW_PIXEL_BITS < 16 ? (SHOW_WIDTH + 7) / 8 * SHOW_PIXEL_BITS * (rows) : 4)
#define SHOW(scene, rate, rows, tris, verts, varyings) \
    SHOW_CUT(scene, rate, SHOW_WHOLE(SHOW_LEAST(rows, SHOW_ROWS_MAX)), \
             SHOW_LEAST(SHOW_RECORDS ? (tris) * 5 / 2 + 64 : (tris), SHOW_TRIS_MAX), \
             SHOW_LEAST(verts, SHOW_VERTS_MAX), varyings)
#if SHOW_CORES == 2
#define SHOW_ARENA_2(bytes) ZS_ARENA(show_arena_2, bytes);
#define SHOW_ITS_ARENA_2 , show_arena_2
#else
#define SHOW_ARENA_2(bytes)
#define SHOW_ITS_ARENA_2
#endif
#define SHOW_CUT(scene, rate, rows, tris, verts, varyings)                                                    \
    ZS_ARENA(show_arena, SHOW_ARENA_BYTES(rows, tris, verts, varyings));                                      \
    SHOW_ARENA_2(sizeof show_arena)                                                                        \
    ZS_ARENA(show_scratch, SHOW_SCRATCH(rows));                                                            \
    const struct show show = { &scene, rate, rows, tris, verts, varyings, show_arena, show_scratch,           \
                               sizeof show_arena, sizeof show_scratch SHOW_ITS_ARENA_2 }

#endif
