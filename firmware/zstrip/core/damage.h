/* What leaves out strips and columns that have not changed. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CORE_DAMAGE_H
#define ZS_CORE_DAMAGE_H

#include "zstrip.h"

struct zs_job;
struct zs_row;

/* What has changed since it was given out last: linked where zs_damage_compare is named. */
struct zs_watch_kernel {
    void (*look)(struct zs_renderer *r, struct zs_strip *out);         /* fills dirty_x, dirty_w */
    void (*forget)(struct zs_renderer *r, const struct zs_rect *rect); /* NULL: all */
};

/* A part of the frame: rows [y, y_end), columns [x, x_end). */
struct zs_part {
    uint16_t y, y_end, x, x_end;
};

/* Which strips, and columns of them, need not be drawn: linked where zs_damage_track is named. */
struct zs_track_kernel {
    /* zs_frame_check, or less where nothing differs; finds the strips that are due; lowers
     * draw_end. May set r->scene. */
    int (*check)(struct zs_renderer *r, const struct zs_scene *scene);
    int (*due)(
        struct zs_renderer *r); /* 0: r->strip need not be drawn; passes on. 1: sets r->window */
    void (*forget)(struct zs_renderer *r, const struct zs_rect *rect); /* NULL: all */
    /* Rows and columns of the walk's strips that the instance may be in and that are due. 0: there
     * are none. */
    int (*touches)(const struct zs_renderer *r, uint32_t number, struct zs_part *part);
    /* Of a strip of which only the columns of r->window are drawn. 1: job->tri lies beside them;
     * job->row_last is set. */
    int (*beside)(struct zs_job *job);
    /* 1: so much of it lies beside them that its rows are split. */
    int (*reaches)(const struct zs_job *job);
    /* Draw the columns of a piece that lie in them; as zs_piece_fn. */
    void (*piece)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step);
};

#endif
