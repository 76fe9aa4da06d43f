/* Partitions of a rectangle, for tests of shared edges.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef GRID_H
#define GRID_H

#include <stdint.h>

#include "prng.h"

#define GRID_MAX 32 /* cells each way */

struct grid {
    uint32_t n_corners, n_tris;
    int32_t at[(GRID_MAX + 1) * (GRID_MAX + 1)][2]; /* x, y */
    uint32_t tri[2 * GRID_MAX * GRID_MAX][3];       /* numbers of corners; all turn the same way */
};

/* Whether b is on one side of the way from a to c, or on the other. */
static inline int grid_side(const int32_t a[2], const int32_t c[2], const int32_t b[2])
{
    return (int64_t)(c[0] - a[0]) * (b[1] - a[1]) - (int64_t)(b[0] - a[0]) * (c[1] - a[1]) < 0;
}

/* nx x ny cells over box, which is x0, y0, x1, y1. Inner corners move by less than half a cell; each cell is cut along
 * the diagonal that lies inside it. */
static inline void grid_make(struct grid *g, struct prng *p, const int32_t box[4], int nx, int ny)
{
    const int32_t w = box[2] - box[0], h = box[3] - box[1];
    const int32_t jx = w / nx * 49 / 100, jy = h / ny * 49 / 100;
    g->n_corners = g->n_tris = 0;
    for (int y = 0; y <= ny; y++)
        for (int x = 0; x <= nx; x++) {
            int32_t *at = g->at[g->n_corners++];
            at[0] = box[0] + (int32_t)((int64_t)w * x / nx) + (x && x < nx ? prng_range(p, -jx, jx) : 0);
            at[1] = box[1] + (int32_t)((int64_t)h * y / ny) + (y && y < ny ? prng_range(p, -jy, jy) : 0);
        }
    for (int y = 0; y < ny; y++)
        for (int x = 0; x < nx; x++) {
            const uint32_t a = (uint32_t)(y * (nx + 1) + x), b = a + 1, c = a + (uint32_t)nx + 1, d = c + 1;
            const int inside = grid_side(g->at[a], g->at[d], g->at[b]) != grid_side(g->at[a], g->at[d], g->at[c]);
            uint32_t (*t)[3] = &g->tri[g->n_tris];
            t[0][0] = a;
            t[0][1] = b;
            t[0][2] = inside ? d : c;
            t[1][0] = d;
            t[1][1] = c;
            t[1][2] = inside ? a : b;
            g->n_tris += 2;
        }
}

#endif
