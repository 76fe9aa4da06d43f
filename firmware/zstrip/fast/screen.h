/* Transform of many vertices in one call. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_SCREEN_H
#define ZS_FAST_SCREEN_H

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

#if ZS_V7M
/* What zs_screen_v7m needs of a view. */
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
/* Project vertices from `at` on that are in camera units. Return `end`, or the first one that is
 * for screen_slowly (fast/screen.c). */
struct zs_vertex *zs_screen_v7m(const struct zs_screen_of *of, struct zs_vertex *at,
                                struct zs_vertex *end);
/* Return the depth of a vertex: view->depth->vertex. */
uint32_t zs_screen_depth(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
#endif

#endif
