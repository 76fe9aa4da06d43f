/* Transform of many vertices in one call. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_SCREEN_H
#define ZS_FAST_SCREEN_H

#include "arch/screen_v7m.h"
#include "core/cull.h"

/* Set r->xform.clip_depth and clip_guard: 0 if no vertex of the current instance can fail that clip
 * test. */
void zs_screen_needs(struct zs_renderer *r, const struct zs_bounds *b);
/* Transform and project vertices [v, v + n) of the current instance, as zs_xform_screen, to the
 * pool, where their numbers are recorded. In addition, a vertex with an outcode other than 0 gets
 * an x or y that differs by 2^16 or more from that of any other vertex. */
void zs_screen(const struct zs_renderer *r, uint32_t v, uint32_t n, struct zs_vertex *out);
/* The same for the pool's vertices [slot, end), whose numbers may be any. */
void zs_screen_known(const struct zs_renderer *r, uint32_t slot, uint32_t end);
/* Transform and project vertices [from, from + n) of the mesh into the pool from `slot` on, and
 * record them (zs_bin_mark). */
void zs_batch_verts(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n);

/* What zs_depth.vertices needs of a view. */
static inline struct zs_screen_of zs_screen_of(const struct zs_view *view)
{
    return (struct zs_screen_of){ .near = (uint32_t)view->z_near,
                                  .range = (uint32_t)view->z_far - (uint32_t)view->z_near,
                                  .down = 30 - view->scale_bits,
                                  .common = view->key_common,
                                  .cx = view->cx,
                                  .cy = view->cy,
                                  .mul = view->key_mul,
                                  .lz = view->key_lz,
                                  .fraction = view->key_fraction,
                                  .code = view->key_code,
                                  .view = view };
}

#endif
