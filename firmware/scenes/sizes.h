/* How much a firmware gives each demo scene at 240x240: what takes every frame of its animation in one pass, in strips
 * as high as pay. Less of any costs time, never a pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIZES_H
#define SIZES_H

/* Frames of the animation a second; rows of a strip; triangles; vertices; 16-bit words a vertex. */
#define SIZES_teapot 30, 60, 1792, 1664, ZS_VARYINGS_SMOOTH
#define SIZES_china 20, 60, 1792, 1664, ZS_VARYINGS_TEXTURE_SMOOTH
#define SIZES_cubes 30, 60, 64, 80, ZS_VARYINGS_FLAT
#define SIZES_knot 30, 60, 1088, 1088, ZS_VARYINGS_SMOOTH
#define SIZES_flyover 20, 60, 960, 5376, ZS_VARYINGS_FLAT
#define SIZES_city 30, 60, 1408, 1600, ZS_VARYINGS_FLAT
#define SIZES_hall 20, 60, 640, 1536, ZS_VARYINGS_TEXTURE_SMOOTH
#define SIZES_globe 20, 60, 1088, 1472, ZS_VARYINGS_TEXTURE_SMOOTH
/* Showpieces: they fit into a Pico. */
#define SIZES_stilllife 8, 24, 3860, 4080, ZS_VARYINGS_SMOOTH
#define SIZES_forest 8, 60, 440, 1320, ZS_VARYINGS_SMOOTH
#define SIZES_cockpit 12, 30, 1300, 4200, ZS_VARYINGS_SMOOTH

/* The same for two cores, each with an arena of this size of its own: strips as high as pay and fit into a Pico.
 * Flyover has fewer vertices than one pass takes: they are given up, and worked on again where they come again. */
#define SIZES_2_teapot 30, 24, 1792, 1760, ZS_VARYINGS_SMOOTH
#define SIZES_2_china 20, 24, 1728, 1728, ZS_VARYINGS_TEXTURE_SMOOTH
#define SIZES_2_cubes 30, 30, 64, 80, ZS_VARYINGS_FLAT
#define SIZES_2_knot 30, 30, 1088, 1664, ZS_VARYINGS_SMOOTH
#define SIZES_2_flyover 20, 24, 960, 3400, ZS_VARYINGS_FLAT
#define SIZES_2_city 30, 40, 1408, 1600, ZS_VARYINGS_FLAT
#define SIZES_2_hall 20, 30, 640, 1536, ZS_VARYINGS_TEXTURE_SMOOTH
#define SIZES_2_globe 20, 24, 1088, 1472, ZS_VARYINGS_TEXTURE_SMOOTH
#define SIZES_2_forest 8, 24, 440, 1320, ZS_VARYINGS_SMOOTH /* of the showpieces the one that gains by it */

#endif
