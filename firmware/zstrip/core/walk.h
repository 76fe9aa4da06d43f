/* The walk over the scene. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_WALK_H
#define ZS_WALK_H

#include "zstrip.h"

/* Walk once through the scene and bin its triangles in the band: strips [r->strip, end) at first.
 * When a pool is full, the band is shortened (r->band_end). If it is a single strip and a pool is
 * still full, the method makes room (the depth buffer draws the binned triangles and empties the
 * pools), and the walk goes on. */
void zs_walk(struct zs_renderer *r, uint16_t end);

/* What is drawn of the pass in hand: all of its viewport. */
static inline void zs_walk_region(struct zs_renderer *r)
{
    r->walk_x = 0;
    r->walk_end = r->view.width;
    r->walk_y = r->view.y;
    r->walk_y_end = (uint16_t)(r->view.y + r->view.height);
}

#endif
