/* Two parallel walls, to find which depth mapping tells them apart, and how far.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_STUDY_WALLS_H
#define SIM_STUDY_WALLS_H

#include "zstrip.h"

#define STUDY_WALLS_W 96      /* px */
#define STUDY_WALLS_H 72      /* px */
#define STUDY_WALLS_NEAR 2048 /* world units */

/* A wall across the view on a grid of 24 bits; its corners in steps of 2^-8. */
struct study_wall {
    struct zs_mesh mesh;
    int16_t pos[4][3];
    uint8_t lo[4][3];
};

/* z: distance of its middle, world units; slope: change of z by x and y, as parts. */
void study_wall(struct study_wall *w, double z, const double slope[2]);

/* Draw two walls, w[0] the nearer one, in one order. 1: it is seen everywhere; 0: not; < 0: an enum zs_err. */
int study_walls_in_order(const struct zs_depth *depth, int bits, double far_over_near, const struct study_wall w[2],
                         int swap);

#endif
