/* The same turns in long double, and how far the renderer's matrix is from them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "rotation_drift.h"

#include <math.h>
#include <string.h>

#include "prng.h"
#include "sim.h"
#include "zstrip.h"

/* Rodrigues' rotation about an axis of whole numbers by 16-bit turns. */
static void exact_turn(long double out[9], const int32_t axis[3], zs_turn angle)
{
    const long double turn = (long double)angle / 65536 * 6.283185307179586476925286766559L;
    const long double length = sqrtl((long double)axis[0] * axis[0] +
                                     (long double)axis[1] * axis[1] +
                                     (long double)axis[2] * axis[2]);
    const long double c = cosl(turn), s = sinl(turn);
    const long double u[3] = { axis[0] / length, axis[1] / length, axis[2] / length };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = (i == j ? c : 0) + (1 - c) * u[i] * u[j];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[3 * j + i] += s * u[k];
        out[3 * i + j] -= s * u[k];
    }
}

static void exact_compose(long double m[9], const long double turn[9])
{
    long double out[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = turn[3 * i] * m[j] + turn[3 * i + 1] * m[3 + j] +
                             turn[3 * i + 2] * m[6 + j];
    memcpy(m, out, sizeof out);
}

/* Sub-pixels that a point at the lever is off by, at most: the longest of the columns' differences.
 */
static double apart(const zs_q2_30 rot[9], const long double m[9])
{
    double worst = 0;
    for (int j = 0; j < 3; j++) {
        double square = 0;
        for (int i = 0; i < 3; i++) {
            const double off = (double)(rot[3 * i + j] / 1073741824.0L - m[3 * i + j]);
            square += off * off;
        }
        worst = fmax(worst, sqrt(square));
    }
    return worst * SIM_ROTATION_LEVER * 256;
}

double sim_rotation_drift(uint64_t seed, uint32_t n, int wander)
{
    struct prng r = { seed };
    int32_t axis[3] = { 1, 2, 3 };
    zs_turn angle = 4099;
    struct zs_pose pose;
    long double m[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, turn[9];
    double worst = 0;
    zs_pose_identity(&pose);
    for (uint32_t k = 0; k < n; k++) {
        if (wander) {
            for (int c = 0; c < 3; c++)
                axis[c] = prng_range(&r, -1000, 1000);
            axis[0] |= 1;
            const uint32_t shift = prng_pick(&r, 12);
            angle = (zs_turn)((prng_next(&r) & 65535u) >> shift);
        }
        (void)zs_pose_rotate(&pose, axis, angle);
        if (k == 0 || wander)
            exact_turn(turn, axis, angle);
        exact_compose(m, turn);
        if (k % 64 == 0 || k == n - 1)
            worst = fmax(worst, apart(pose.rot, m));
        if (k % 4096 == 0)
            sim_progress("rotations", k, n);
    }
    sim_progress_end();
    return worst;
}
