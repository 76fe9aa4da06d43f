/* For tests/checks/v7m.c: small triangles of one colour by the functions in C, on a core that has them by hand.
 *
 * SPDX-License-Identifier: MIT
 */
#define ZS_V7M 0
#define zs_fast_raw solid_in_c
#define zs_fast_flat solid_flat_in_c
#include "fast/fast_solid.c"
