/* Rasterisation of one strip. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_RASTER_H
#define ZS_RASTER_H

#include "zstrip.h"

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
