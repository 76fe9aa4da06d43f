/* Rasterisation of one strip. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_RASTER_H
#define ZS_RASTER_H

#include "core/fx.h"
#include "zstrip.h"

/* The rows of strip r->strip; the last one may have fewer than the others. */
static inline int32_t zs_strip_rows(const struct zs_renderer *r)
{
    return zs_min32(r->config.strip_h, r->config.height - r->strip * r->config.strip_h);
}

/* Draw the triangles of strip r->strip, in the order of the method's list. Those that continue in
 * the strip below are left in r->active. */
void zs_raster_strip(struct zs_renderer *r);
/* Skip strip r->strip: pass its triangles on to the strip below without drawing them. */
void zs_raster_leave(struct zs_renderer *r);
/* Clear colour and depth, to the background and ZS_DEPTH_CLEAR: n pixels of a row of the strip from
 * column x on, or the whole strip. */
void zs_raster_clear(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);
void zs_raster_clear_all(struct zs_renderer *r);
/* Clear colour alone, or depth alone; n > 0. */
void zs_raster_background(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);
void zs_raster_far(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);

#endif
