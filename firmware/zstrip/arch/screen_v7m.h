/* The loop over vertices of depth/float_v7m.c, and what it needs of a view. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SCREEN_V7M_H
#define ZS_SCREEN_V7M_H

#include "arch/wide.h"

struct zs_vertex;
struct zs_view;

struct zs_screen_of {
    uint32_t near, range; /* z_near; z_far less it */
    int32_t down;         /* 30 less view.scale_bits */
    uint32_t common;      /* view.key_common */
    int32_t cx, cy;
    uint32_t mul;         /* view.key_mul */
    int32_t lz;           /* view.key_lz */
    uint32_t fraction, code; /* view.key_fraction, key_code */
    const struct zs_view *view;
};

/* zs_depth.vertices of the float mappings, if ZS_V7M. */
struct zs_vertex *zs_screen_v7m(const struct zs_screen_of *of, struct zs_vertex *at,
                                struct zs_vertex *end);

#endif
