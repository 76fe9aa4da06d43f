/* Occlusion culling by large triangles. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_TILES_H
#define ZS_FAST_TILES_H

#include "core/cull.h"

/* Return 1 if a triangle inside the box, without a depth state and with no vertex nearer than the
 * depth `nearest` (zs_vertex.d), cannot pass the depth test in any strip still to be drawn. */
int zs_hidden_box(struct zs_renderer *r, const struct zs_box *box, uint32_t nearest);

#endif
