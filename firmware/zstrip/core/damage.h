/* Damage tracking: the functions that skip strips and columns that have not changed. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CORE_DAMAGE_H
#define ZS_CORE_DAMAGE_H

#include "zstrip.h"

struct zs_job;
struct zs_row;

/* Comparison of finished strips with what the panel shows (damage/strip_sums.c). It is linked if
 * the program calls zs_damage_compare. */
struct zs_strip_hash_ops {
    /* Compare the strip's hashes with the panel's; set dirty_x and dirty_w. */
    void (*look)(struct zs_renderer *r, struct zs_strip *out);
    /* Drop the hashes in a rectangle, so that it counts as changed. NULL: the whole frame. */
    void (*forget)(struct zs_renderer *r, const struct zs_rect *rect);
};

/* A rectangle of the frame: rows [y, y_end), columns [x, x_end). */
struct zs_region {
    uint16_t y, y_end, x, x_end;
};

/* Tracking of instances, to draw only dirty strips and columns (damage/track.c). It is linked if
 * the program calls zs_damage_track. */
struct zs_track_ops {
    /* Find the dirty strips of a new frame, and lower draw_end to the end of the last one. Calls
     * zs_frame_check if anything differs from the frame before. May set r->scene. */
    int (*check)(struct zs_renderer *r, const struct zs_scene *scene);
    /* Return 1 if r->strip is dirty, and set r->window. Return 0 if it is clean: the strip is
     * skipped, and its triangles are passed on to the next strip. */
    int (*due)(struct zs_renderer *r);
    /* Mark the strips and columns of a rectangle as dirty. NULL: the whole frame. */
    void (*forget)(struct zs_renderer *r, const struct zs_rect *rect);
    /* Intersect the bounds of an instance with the dirty rows and columns of the strips that are
     * binned. Return 0 if the intersection is empty. */
    int (*touches)(const struct zs_renderer *r, uint32_t number, struct zs_region *region);

    /* For strips in which only the columns of r->window are drawn: */

    /* Return 1 if job->tri lies outside these columns. Sets job->tri_end. */
    int (*beside)(struct zs_job *job);
    /* Return 1 if enough of job->tri lies outside these columns that it pays to clip its spans. */
    int (*reaches)(const struct zs_job *job);
    /* Draw the part of a piece that lies in these columns; arguments as zs_piece_fn. */
    void (*piece)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step);
};

#endif
