/* Binning: the pools of vertices and triangles, and a bin of triangles for each strip. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_BIN_H
#define ZS_BIN_H

#include "core/fx.h"
#include "core/job.h"

#define ZS_NO_SOURCE 65535u /* vert_src of a vertex made by clipping: meshes have at most 65535 */
/* The first attribute of a vertex whose attributes are not computed yet, because no binned triangle
 * uses it. If a computed attribute has this value by chance, it is computed again, with the same
 * result. */
#define ZS_ATTR_UNKNOWN 0xa55au

/* Empty both pools and the bins. The next vertex will be the current instance's first. */
void zs_bin_empty(struct zs_renderer *r);
/* Remove the vertices that no binned triangle uses. Indices in the pool change. */
void zs_bin_pack(struct zs_renderer *r);
/* As zs_bin_pack, but looks only at what was added since the last packing. No triangle may have
 * been removed since. */
void zs_bin_pack_new(struct zs_renderer *r);
/* Make room: free at least an eighth of both pools. The band may lose strips. Return 0: the band is
 * a single strip, and there is still no room. */
int zs_bin_room(struct zs_renderer *r);
/* Record that the pool's vertices [slot, slot + n) are the mesh's vertices [from, from + n), with
 * attributes not computed yet. */
void zs_bin_mark(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n);
/* The same for vertices whose numbers are recorded already. */
void zs_bin_fresh(struct zs_renderer *r, uint32_t slot, uint32_t n);
/* Find a triangle's three vertices in the pool, or transform them into it. Return 0: the pool is
 * full. */
int zs_bin_corners(struct zs_renderer *r, const uint16_t index[3], uint32_t slot[3]);
/* Empty the pools and choose the band: from r->strip on, at most to `end`; it ends earlier where
 * counts of an earlier walk say that the pools would overflow. */
void zs_bin_band(struct zs_renderer *r, uint16_t end);
/* Update the pools' high-water marks in the statistics. */
void zs_bin_count(struct zs_renderer *r);

/* With n entries in vert_map, vertex v has the entry v & zs_bin_mask(n). */
static inline uint32_t zs_bin_mask(uint32_t n)
{
    return 0x7fffffffu >> zs_clz32(n);
}

/* The strip of a row of the frame, 0 <= row < ZS_SIZE_MAX. */
static inline int32_t zs_bin_strip(const struct zs_renderer *r, int32_t row)
{
    return (int32_t)((uint32_t)row * r->strip_mul >> r->strip_shift);
}

/* The first strip in [r->strip, r->band_end) that intersects a triangle's rows [y0, y1), or ZS_NIL.
 * Triangles that begin below the band are counted. */
uint32_t zs_bin_place(struct zs_renderer *r, int32_t y0, int32_t y1);
/* Append a triangle to the pool and to a strip's bin. The pool must have room. */
void zs_bin_add(struct zs_renderer *r, const uint32_t slot[3], uint16_t paint, uint32_t strip);

/* Compute the attributes of a vertex. zs_bin_corner does so when the first triangle that uses the
 * vertex is binned. */
void zs_bin_attributes(struct zs_renderer *r, uint32_t slot, uint16_t *attr);
static inline void zs_bin_corner(struct zs_renderer *r, uint32_t slot, uint32_t varyings)
{
    uint16_t *attr = &r->attr[slot * varyings];
    if (*attr == ZS_ATTR_UNKNOWN)
        zs_bin_attributes(r, slot, attr);
}

#endif
