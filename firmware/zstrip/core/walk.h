/* The walk of the scene. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_WALK_H
#define ZS_WALK_H

#include "zstrip.h"

/* Walk the scene and bin what lies in strips [r->strip, r->band_end); the band shrinks where the
 * pools are full, and a single strip's triangles are drawn in sets. */
void zs_walk(struct zs_renderer *r);

/* What is drawn of the pass in hand: all of its viewport. */
static inline void zs_walk_region(struct zs_renderer *r)
{
    r->walk_x = 0;
    r->walk_end = r->view.width;
    r->walk_y = r->view.y;
    r->walk_y_end = (uint16_t)(r->view.y + r->view.height);
}

#endif
