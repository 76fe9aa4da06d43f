/* Vertices in one go. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_SCREEN_H
#define ZS_FAST_SCREEN_H

#include "core/cull.h"

/* Which clip tests the current instance's vertices need, to r->xform: those that none can fail are
 * left out. */
void zs_screen_needs(struct zs_renderer *r, const struct zs_bounds *b);
/* Vertices [v, v + n) of the current instance, as zs_xform_screen. One that is not inside near, far
 * and guard has, besides, an x or y that is 2^16 or more away from any other vertex's. */
void zs_screen(const struct zs_renderer *r, uint32_t v, uint32_t n, struct zs_vertex *out);
/* The same into places from `slot` on, and whose they are. */
void zs_batch_verts(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n);

#endif
