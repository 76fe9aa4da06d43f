/* `zsim depths`: which depth mapping tells surfaces apart, and how far.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEPTHS_H
#define SIM_DEPTHS_H

#include "zstrip.h"

/* Arguments after the command's name. Return an exit status. */
int sim_depths(int argc, char **argv);

#define SIM_DEPTHS_W 96 /* px */
#define SIM_DEPTHS_H_PX 72
#define SIM_DEPTHS_NEAR 2048 /* world units */

/* A wall across the view on a grid of 24 bits; its corners in steps of 2^-8. */
struct sim_depths_wall {
    struct zs_mesh mesh;
    int16_t pos[4][3];
    uint8_t lo[4][3];
};

/* z: distance of its middle, world units; slope: change of z by x and y, as parts; beyond: how much farther it stands. */
void sim_depths_wall(struct sim_depths_wall *w, double z, const double slope[2], double beyond);

/* Draw two walls, w[0] the nearer one, in one order. 1: it is seen everywhere; 0: not; < 0: an enum zs_err. */
int sim_depths_in_order(const struct zs_depth *depth, int bits, double far_over_near, const struct sim_depths_wall w[2],
                        int swap);

#endif
