/* Polygons to triangles.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_POLYGON_H
#define SIM_POLYGON_H

#include <stdint.h>

/* Cut a polygon of n >= 3 corners into n - 2 triangles, out[n - 2], numbers of corners, in the polygon's order.
 *
 * point   its corners, in order. They may repeat, as where a hole is joined to the outline, and need not lie in a
 *         plane.
 * A convex polygon becomes a fan from its first corner. Any other one is cut ear by ear on the plane of its area. One
 * that crosses itself gets triangles too, but not all of them are inside.
 * Cost    tests for ears: 3 n times the number of corners that turn inwards, at most; steps: n * n / 2.
 * Source  Meisters, Polygons have ears, 1975. */
void sim_polygon_cut(const double (*point)[3], uint32_t n, uint32_t (*out)[3]);

#endif
