/* Parts of meshes, and the rows in which each is drawn. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PARTS_H
#define ZS_PARTS_H

#include "core/job.h"

#define ZS_PARTS_FEW 40u /* triangles of a mesh */
/* Return 1 if an instance's triangles are binned in batches. With more than ZS_PARTS_FEW, that does
 * not depend on what was binned before. */
int zs_parts_batched(const struct zs_renderer *r, const struct zs_instance *in);
/* Begin to note the rows of parts, from triangle t of the current instance on. */
void zs_parts_begin(struct zs_renderer *r, uint32_t t);
/* A pool is full at triangle t of the current instance, before the band has lost a strip. If few
 * triangles follow, do without parts, and return 1: there is more room for triangles. */
int zs_parts_end(struct zs_renderer *r, uint32_t t);
/* Called for each instance in a walk. Return 1 if none of its parts reaches the band. */
int zs_parts_beside(struct zs_renderer *r, uint32_t number);
/* Return 1 if all parts of the current instance reach the band. */
int zs_parts_whole(const struct zs_renderer *r);
/* Move *from on to a part that reaches the band. Return how many of n triangles are in that part; 0
 * if there is none before `end`. */
uint32_t zs_parts_next(const struct zs_renderer *r, uint32_t *from, uint32_t end, uint32_t n);
/* Return 1 if the rows of triangles from `from` on have to be noted. They are in one part. */
int zs_parts_noted(struct zs_renderer *r, uint32_t from);
/* Note the rows of n triangles of one part, which begins at triangle `from` or before it. The k-th
 * of them has the vertices pool[tri[left[k] / 4]]; with left[k] & 2 it may have a vertex number
 * that is out of range, or vertices that are not on the screen. */
void zs_parts_note(struct zs_renderer *r, uint32_t from, const struct zs_vertex *pool,
                   const uint16_t (*tri)[3], const uint8_t *left, uint32_t n);

#endif
