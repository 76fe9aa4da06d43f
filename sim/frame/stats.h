/* Numbers as JSON.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_STATS_H
#define SIM_STATS_H

#include <stdio.h>

#include "frame.h"

/* One object, written key by key; a value that is not finite becomes null. Errors: see ferror. */
struct sim_json {
    FILE *file;
    int n; /* keys so far */
};

void sim_json_begin(struct sim_json *json, FILE *f);
void sim_json_number(struct sim_json *json, const char *key, double value);
void sim_json_vector(struct sim_json *json, const char *key, const double v[3]); /* _x, _y, _z */
void sim_json_end(struct sim_json *json);

/* Everything that a frame took: counts, means and the bytes of each pool. */
void sim_stats_frame(struct sim_json *json, const struct sim_frame *frame,
                     const struct zs_config *config);

#endif
