/* Rotations and vectors of the renderer in double precision.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_DOUBLES_H
#define TESTS_DOUBLES_H

#include <math.h>

#include "zstrip.h"

#define TURN (6.283185307179586476925 / 65536)

static inline double q30(int64_t v)
{
    return ldexp((double)v, -30);
}

/* Largest of |m m^T - 1|. */
static inline double not_a_rotation(const zs_q2_30 m[9])
{
    double worst = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double dot = i == j ? -1 : 0;
            for (int k = 0; k < 3; k++)
                dot += q30(m[3 * i + k]) * q30(m[3 * j + k]);
            worst = fmax(worst, fabs(dot));
        }
    return worst;
}

static inline double apart(const zs_q2_30 m[9], const double want[9])
{
    double worst = 0;
    for (int k = 0; k < 9; k++)
        worst = fmax(worst, fabs(q30(m[k]) - want[k]));
    return worst;
}

static inline void unit3(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

#endif
