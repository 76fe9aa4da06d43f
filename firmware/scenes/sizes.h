/* How much a firmware gives each demo scene at 240x240: what takes every frame of its animation in one pass, in strips as
 * high as pay. Less of any costs time, never a pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIZES_H
#define SIZES_H

/* Frames of the animation a second; rows of a strip (an even number of strips lets a frame begin while the one before it
 * still leaves); triangles; vertices; 16-bit words a vertex. */
#define SIZES_teapot 30, 24, 2000, 2000, ZS_ATTRS_SMOOTH
#define SIZES_cubes 30, 24, 2000, 2000, ZS_ATTRS_SMOOTH
#define SIZES_knot 30, 24, 2000, 2000, ZS_ATTRS_SMOOTH
#define SIZES_flyover 20, 24, 2000, 2000, ZS_ATTRS_SMOOTH
#define SIZES_city 30, 24, 2000, 2000, ZS_ATTRS_SMOOTH
#define SIZES_hall 20, 24, 2000, 2000, ZS_ATTRS_SMOOTH
#define SIZES_globe 20, 24, 2000, 2000, ZS_ATTRS_SMOOTH

#endif
