/* A strip's triangles. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_RASTER_H
#define ZS_RASTER_H

#include "zstrip.h"

/* Draw the strip r->strip's bin and the active list; leaves those that go on in r->active. */
void zs_raster_strip(struct zs_renderer *r);
/* Do not draw it, but pass its triangles on to the strip below. */
void zs_raster_pass(struct zs_renderer *r);
/* Background and ZS_DEPTH_CLEAR: n pixels of the strip's row, from column x on; everywhere in the
 * strip. */
void zs_raster_clear(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);
void zs_raster_clear_all(struct zs_renderer *r);
/* One of the two alone; n > 0. */
void zs_raster_background(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);
void zs_raster_far(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);

#endif
