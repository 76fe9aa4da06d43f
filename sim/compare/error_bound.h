/* How far the integer renderer may be from the reference at a pixel, from what it promises: corners
 * are snapped to the nearest sub-pixel, distances to camera units, keys to buckets. What is left is
 * wrong.
 *
 * With H half a sub-pixel, u a camera unit and f the focal length: a corner at distance z is off by
 * at most H + 3 u f / z px along each axis, and its distance by 3 u. The snapped triangle shows at
 * a sample what the true one shows at most that far away, z being the sample's distance, because a
 * mean of the corners' shifts is taken whose mean of 1 / z is the sample's own.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ERROR_BOUND_H
#define SIM_ERROR_BOUND_H

#include "reference.h"

struct sim_judge {
    const struct ref_triangle *tri; /* [..], id k is tri[k - 1] */
    const struct ref_camera *camera;
    const struct ref_light *light;
    const struct ref_depth *depth;
    int width, height; /* px */
    double sub_pixel;  /* px: 1/256 or 1/16 */
    double unit;       /* world units to a camera unit, at most: sim_judge_unit */
};

/* Camera units are at least 2^28 to the farthest corner of what is in view. */
double sim_judge_unit(const struct ref_triangle *tri, size_t n, const struct ref_camera *camera);

enum sim_verdict {
    SIM_SAME, /* the same triangle, or the same nothing; of one that is there twice, the first */
    SIM_EDGE, /* the sample is within a sub-pixel of an outline of either triangle */
    SIM_TIE,  /* both cover it, and their true keys are within 1.01 bucket and what snapping adds */
    SIM_WRONG
};
/* Of a pixel that shows the triangles with these ids, 0 for none. */
enum sim_verdict sim_judge_pixel(const struct sim_judge *judge, uint32_t ours, uint32_t truth,
                                 int x, int y);

/* 1: two triangles lie in one plane and face the same way. */
int sim_judge_same_plane(const struct ref_triangle *a, const struct ref_triangle *b);

/* By how many buckets the key of a triangle may be off at a sample that it covers, because its
 * corners are snapped. Rounding (0.505) comes on top. INFINITY where the triangle is seen edge-on.
 */
double sim_judge_key_slack(const struct sim_judge *judge, uint32_t id, int x, int y);

/* The range of a colour, codes (31, 63, 31), that a triangle without texture shows as far around a
 * sample as snapping may move it. */
void sim_judge_color(const struct sim_judge *judge, uint32_t id, int x, int y, double lo[3],
                     double hi[3]);
/* The same of light, times 1, and of u and v, in texels, where it has a texture. Return the ratio
 * of 1 / z of what is left of the triangle between near and far, 1 or more. */
double sim_judge_texture(const struct sim_judge *judge, uint32_t id, int x, int y, double light[2],
                         double lo[2], double hi[2]);

#endif
