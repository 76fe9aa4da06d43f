/* Three doubles.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VEC_H
#define SIM_VEC_H

#include <math.h>

static inline void sim_sub(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

static inline double sim_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void sim_cross(double out[3], const double a[3], const double b[3])
{
    const double c[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                          a[0] * b[1] - a[1] * b[0] };
    for (int k = 0; k < 3; k++)
        out[k] = c[k];
}

/* Scale to length 1 and return the length; 0: v is left alone. */
static inline double sim_unit(double v[3])
{
    const double length = sqrt(sim_dot(v, v));
    for (int k = 0; k < 3 && length > 0.0; k++)
        v[k] /= length;
    return length;
}

/* v turned by an angle about a unit axis (Rodrigues' formula). out may be v. */
static inline void sim_turned(double out[3], const double v[3], const double axis[3], double angle)
{
    double across[3];
    const double c = cos(angle), s = sin(angle), along = sim_dot(axis, v) * (1.0 - c);
    sim_cross(across, axis, v);
    for (int k = 0; k < 3; k++)
        out[k] = c * v[k] + s * across[k] + along * axis[k];
}

#endif
