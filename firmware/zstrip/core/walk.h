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

#endif
