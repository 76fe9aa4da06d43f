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
/* Triangle t is binned by itself, and not noted: its part may reach all rows. */
void zs_parts_unknown(struct zs_renderer *r, uint32_t t);
/* Note the rows of one part's triangles, which begin at triangle `from` of the mesh: of the binned
 * ones [tri, end), and [y0, y1) of the others; y0 >= y1: there are none. */
void zs_parts_note(struct zs_renderer *r, uint32_t from, const struct zs_tri *tri,
                   const struct zs_tri *end, int32_t y0, int32_t y1);

#endif
