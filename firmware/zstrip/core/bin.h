/* Pools and bins: what waits for its strip. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_BIN_H
#define ZS_BIN_H

#include "core/fx.h"
#include "core/job.h"

#define ZS_NO_SOURCE 65535u /* vert_src of a vertex made by clipping: meshes have at most 65535 */
#define ZS_ATTR_UNKNOWN                                                                            \
    0xa55au /* first attribute of a vertex that no binned triangle holds yet. One whose attribute  \
               is the same is made again, with the same outcome */

/* Both empty, the bins too; the next vertex is the current instance's first. */
void zs_bin_empty(struct zs_renderer *r);
/* Drop vertices that no binned triangle holds. Places change. */
void zs_bin_pack(struct zs_renderer *r);
/* Free at least a quarter of both pools; the band may lose strips. Return 0: the band is one strip,
 * and they are full of it. */
int zs_bin_room(struct zs_renderer *r);
/* Whose vertices [from, from + n) of the mesh are, which have been transformed to places from
 * `slot` on. */
void zs_bin_mark(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n);
/* The pool's places of a triangle's corners, transformed. Return 0: the pool is full. */
int zs_bin_corners(struct zs_renderer *r, const uint16_t index[3], uint32_t slot[3]);
/* High-water marks of both pools into the statistics. */
void zs_bin_count(struct zs_renderer *r);

/* 0 <= row < ZS_SIZE_MAX, of the frame */
static inline int32_t zs_bin_strip(const struct zs_renderer *r, int32_t row)
{
    return (int32_t)((uint32_t)row * r->strip_mul >> r->strip_shift);
}

/* The first strip of [r->strip, r->band_end) that rows [y0, y1) of the frame have a part in, or
 * ZS_NIL. */
static inline uint32_t zs_bin_first(const struct zs_renderer *r, int32_t y0, int32_t y1)
{
    uint32_t s = (uint32_t)zs_bin_strip(r, zs_max32(y0, r->walk_y));
    if (s < r->strip)
        s = zs_min32(y1, r->walk_y_end) > r->strip * r->config.strip_h ? r->strip : ZS_NIL;
    return s < r->band_end ? s : ZS_NIL;
}

/* A triangle into a strip's bin; there is room for it. */
static inline void zs_bin_push(struct zs_renderer *r, const uint32_t slot[3], uint16_t paint,
                               uint32_t strip)
{
    const uint32_t n = r->n_tris;
    struct zs_tri *t = &r->tri[n];
    t->v[0] = (uint16_t)slot[0];
    t->v[1] = (uint16_t)slot[1];
    t->v[2] = (uint16_t)slot[2];
    t->next = r->bin[strip];
    t->paint = paint;
    t->instance = (uint16_t)r->xform.number;
    r->bin[strip] = (uint16_t)n;
    r->n_tris = n + 1u;
}

/* Both, called: where few triangles come. */
uint32_t zs_bin_place(const struct zs_renderer *r, int32_t y0, int32_t y1);
void zs_bin_add(struct zs_renderer *r, const uint32_t slot[3], uint16_t paint, uint32_t strip);

/* Attributes of a vertex, made when the first triangle that holds it is binned. */
void zs_bin_attributes(struct zs_renderer *r, uint32_t slot, uint16_t *attr);
static inline void zs_bin_corner(struct zs_renderer *r, uint32_t slot, uint32_t varyings)
{
    uint16_t *attr = &r->attr[slot * varyings];
    if (*attr == ZS_ATTR_UNKNOWN)
        zs_bin_attributes(r, slot, attr);
}

#endif
