/* What large triangles hide. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_TILES_H
#define ZS_FAST_TILES_H

#include "zstrip.h"

/* 1: nothing in columns [x0, x1) and rows [y0, y1) can win whose vertices' zs_vertex.d are
 * `nearest` or more, in no strip that is still to be drawn. Without a state. */
struct zs_box {
    int32_t x0, x1, y0, y1; /* px */
};
int zs_hidden_box(struct zs_renderer *r, const struct zs_box *box, uint32_t nearest);

#endif
