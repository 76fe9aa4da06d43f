/* The table of `zsim demo`.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEMO_TABLE_H
#define SIM_DEMO_TABLE_H

#include "demo_frame.h"
#include "frame.h"
#include "reference.h"
#include "scenes.h"

/* Sums over the frames of a scene. */
struct sim_demo_tally {
    struct zs_stats stats; /* of the first frame */
    uint32_t arena, passes_max, frames;
    struct ref_diff diff; /* counts summed, worst values kept */
    uint64_t off_by_one;
    double z_sum;
    int not_compared; /* flag: effects, or a shader of its own: the reference knows neither */
};

/* Add how far a frame is from the reference. SIM_OK; SIM_REFUSED, said why. */
int sim_demo_compare(struct sim_demo_tally *sum, const struct demo_frame *f, const struct demo *demo,
                     const struct zs_config *config, const struct sim_frame *frame);

/* Its lines on standard output. first: the number of the frame whose triangles and pixels are counted. */
void sim_demo_table_head(long first);
void sim_demo_table_row(const struct demo *demo, const struct sim_demo_tally *t);
void sim_demo_table_foot(void);

#endif
