/* Turned forms: a profile around the y axis.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LATHE_H
#define LATHE_H

#include "gen.h"

#define LATHE_STEPS 4 /* mesh steps to a unit of a profile: meshes are written with LATHE_SCALE */
#define LATHE_SCALE (65536u / LATHE_STEPS)

/* A point of a profile, from its upper end to its lower one as seen on the right side, for a surface that is seen from
 * outside; the other way round for one that is seen from within. The curve passes through all points (Catmull-Rom). */
struct lathe_point {
    int32_t r, y;         /* units; r 0 at the ends alone: a pole */
    uint8_t rows;         /* of the mesh, from here to the next point */
    struct gen_rgb color; /* of vertices and faces, from here to the next */
};

/* Append the turned form with so many sides. */
void lathe(struct gen_mesh *m, const struct lathe_point *point, int n_points, int64_t sides);

/* The same around the line from (x, y, z) upwards. */
void lathe_at(struct gen_mesh *m, const struct lathe_point *point, int n_points, int64_t sides, const int64_t at[3]);

/* An array's, as arguments: lathe(m, LATHE_OF(vase), 32). */
#define LATHE_OF(points) points, (int)(sizeof(points) / sizeof(points)[0])

#endif
